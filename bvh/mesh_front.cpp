// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The memory of a front, and when it pays.
#include <swiftlet/mesh_front.h>

#include <algorithm>
#include <cmath>

#include "front.h"
#include "mesh_block.h"
#include "mesh_tolerance.h"

namespace swiftlet {
namespace {

// Instructions, about: choices of time, no bound rests on them. bench/TRIED.md.
constexpr double kPlainNode = 1200, kPlainTriangle = 600, kFrontNode = 2300, kFrontTriangle = 750, kGroup = 110, kAnyGroup = 3;
/// A plain search that opens fewer nodes has nothing to spare, nor has one that ended before all was looked at.
constexpr std::uint32_t kLeastNodes = 8;
/// A front begins anew where queries take this many times the mean since it began.
constexpr double kMuchMore = 1.5;
/// It is given up where it saves less than a tenth; for so many queries, four times as many each time.
constexpr double kLeastGain = 0.9;
/// Or until B moves this many times as slowly as then, which one of so many queries finds out.
constexpr double kSlower = 0.5;
constexpr int kOneOf = 8;
/// What a plain search costs is seen again after the first queries, and then after so many times what the front gains: that
/// takes a thirtieth of the time.
constexpr int kSeenFirst = 8;
constexpr double kSeenAgain = 32, kSeenAgainMost = 1024;
constexpr int kFirstPause = 64, kLongestPause = 512, kPauseFactor = 4;
/// Where points of B go farther in a query than this share of half B's size, it is not begun.
constexpr double kFast = 0.125;

double square_of_difference(const Motion& p, const Motion& q) {
  const Vec x = p.row_x - q.row_x, y = p.row_y - q.row_y, z = p.row_z - q.row_z;
  return dot(x, x) + dot(y, y) + dot(z, z);
}

bool is_of(const std::optional<MeshModel>& held, const MeshModel& mesh) {
  return held && &MeshReader::content(*held) == &MeshReader::content(mesh);
}

}  // namespace

MeshFront::State::State(std::size_t pairs)
    : capacity(std::uint32_t(std::min<std::size_t>(pairs, std::size_t{1} << 31) / kFanOut)),
      bounds(capacity),
      ids(capacity),
      ends((capacity + kFanOut - 1) / kFanOut),
      arms(ends.size()),
      near(std::size_t{capacity} * kFanOut),
      holes(capacity),
      next_pause(kFirstPause) {}

void MeshFront::State::serve(const MeshModel& a, const MeshModel& b) {
  if (is_of(mesh_a, a) && is_of(mesh_b, b)) return;
  mesh_a = a, mesh_b = b;
  forget();
  has_pose = pays = false, plain = 0, pause = rested = 0, next_pause = kFirstPause;
}

bool MeshFront::State::moves_to(const Motion& b_in_a, int unit_of_pair, const Vec& middle_of_b, double reach) {
  begins = false;
  if (capacity == 0) return false;
  const bool follows = has_pose && unit == unit_of_pair;
  if (!follows) holds = false;
  // The greatest stretch of a difference of two rotations is its root of the sum of squares over the root of 2, but for what
  // both lack of right angles.
  const double frobenius = follows ? std::sqrt(square_of_difference(b_in_a, pose)) : 0;
  const double turn = min(frobenius, frobenius * kHalfRoot + kTurnSlack), way = follows ? norm(middle_of_b - middle) : 0;
  has_pose = true, unit = unit_of_pair, pose = b_in_a, middle = middle_of_b;
  gone += way * (1 + kFloatUp), turned += turn * (1 + kFloatUp);
  if (gone > kMostGone || turned > kMostTurned) holds = false;
  const double step = (way + turn * reach) / (1 + rested);
  const bool is_slow = follows && rested == 0 && step <= kFast * reach;
  rested = 0;
  pace = follows ? pace + (step - pace) / 4 : step;
  if (pause > 0 && !(follows && pace < kSlower * pace_given_up)) return false;
  pause = 0;
  if (holds) return --until_seen > 0;
  if (!pays || !is_slow) return false;
  groups = holes_left = 0;
  gone = turned = 0;
  return holds = begins = true;
}

bool MeshFront::State::rests() {
  if (pause == 0) return false;
  --pause;
  if (pause % kOneOf == 0) return false;
  ++rested;
  return true;
}

void MeshFront::State::give_up() {
  pause = next_pause, next_pause = std::min(kPauseFactor * next_pause, kLongestPause);
  pace_given_up = pace;
}

void MeshFront::State::settle(bool used, bool done, std::uint32_t nodes, std::uint32_t triangles, std::uint32_t asked) {
  if (!used || begins) {
    plain = kPlainNode * nodes + kPlainTriangle * triangles;
    pays = nodes >= kLeastNodes && !done;
    if (!pays) holds = false, pause = std::max(pause, kOneOf);
  }
  const bool seen = !used && holds;
  if (seen) until_seen = int(min(kSeenAgain * max(plain / recent, 1), kSeenAgainMost));
  if (seen && recent > kLeastGain * plain) {
    holds = false;
    give_up();
  }
  if (!used) return;
  const double cost = kGroup * asked + kAnyGroup * groups + kFrontNode * nodes + kFrontTriangle * triangles;
  if (begins) {
    spent = cost, queries = 1, recent = plain / 2, until_seen = kSeenFirst;
    return;
  }
  spent += cost, queries += 1;
  recent += (cost - recent) / 4;
  const double mean = spent / queries;
  if (!(recent > plain || recent > kMuchMore * mean)) return;
  holds = false;
  if (mean > kLeastGain * plain)
    give_up();
  else
    next_pause = kFirstPause;
}

std::uint32_t MeshFront::State::take(const FrontIds& of, float arm_of_it) {
  std::uint32_t group;
  if (holes_left > 0) {
    group = holes[--holes_left];
  } else {
    group = groups++;
    if (group % kFanOut == 0) {
      std::fill_n(ends[group / kFanOut].of, kFanOut, HUGE_VALF);
      arms[group / kFanOut] = {};
    }
  }
  ids[group] = of, arm_of(group) = arm_of_it;
  return group;
}

void MeshFront::State::drop(FrontPlace place) {
  const std::uint32_t group = place / kFanOut, i = place % kFanOut;
  bounds[group].h[i] = -HUGE_VALF;
  ids[group].live &= ~(1u << i);
  if (ids[group].live != 0) return;
  end_of(group) = HUGE_VALF, arm_of(group) = 0;
  holes[holes_left++] = group;
}

MeshFront::MeshFront(std::size_t pairs) : state_(std::make_unique<State>(pairs)) {}
MeshFront::~MeshFront() = default;
MeshFront::MeshFront(MeshFront&&) noexcept = default;
MeshFront& MeshFront::operator=(MeshFront&&) noexcept = default;
std::size_t MeshFront::capacity() const { return state_ ? std::size_t{state_->capacity} * kFanOut : 0; }
std::size_t MeshFront::size() const {
  return state_ && state_->holds ? std::size_t{state_->groups - state_->holes_left} * kFanOut : 0;
}
void MeshFront::clear() {
  if (!state_) return;
  state_->mesh_a.reset(), state_->mesh_b.reset();
  state_->forget();
}

}  // namespace swiftlet
