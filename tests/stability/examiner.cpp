// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "examiner.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>

namespace swiftlet::stability {
namespace {

constexpr std::uint64_t kSolveEvery = 24, kColdEvery = 8, kManifoldEvery = 32;
constexpr std::size_t kMostFailures = 8;
/// Of one march, a hundred times what any takes in Release: sanitizers are slow.
constexpr double kMostSeconds = 2;

template <class T>
void mix(std::uint64_t& hash, const T& value) {
  std::uint64_t bits = 0;
  static_assert(sizeof value <= sizeof bits);
  std::memcpy(&bits, &value, sizeof value);
  hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
  hash ^= hash >> 29;
}

bool lie_within(const Answer& one, const Answer& other, double bound) {
  return std::fabs(one.lower - other.lower) <= bound && std::fabs(one.upper - other.upper) <= bound;
}
/// Both intervals, where they should agree.
std::string against(const Answer& one, const Answer& other) {
  char text[160];
  std::snprintf(text, sizeof text, ": [%a, %a] and [%a, %a]", other.lower, other.upper, one.lower, one.upper);
  return text;
}

std::string hex(const PairSeed& seed) {
  unsigned char bytes[sizeof seed];
  std::memcpy(bytes, &seed, sizeof seed);
  std::string result;
  for (const unsigned char byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    result += digits;
  }
  return result;
}

/// The same options, and where the proof of an overlap goes.
Options proving(Options options, OverlapProof& proof) {
  options.tuning.proof = &proof;
  return options;
}

/// What is wrong with the outcome of a query for an exact answer, before anything is recomputed.
std::string unsettled(const Answer& answer, double width) {
  if (answer.status != Status::Converged) return "the status is " + std::to_string(int(answer.status));
  if (answer.verdict == Verdict::Undecided) return "no verdict";
  return answer.upper - answer.lower <= width
             ? ""
             : "wider than law 2 allows, by the factor " + std::to_string((answer.upper - answer.lower) / width);
}

/// The gap of the bodies along a unit vector, in doubles.
double rounded_gap(const Subject& a, const Subject& b, const Pose& b_in_a, const Vec3& n) {
  const Vec3 n_b = b_in_a.rotation.transpose() * n;
  double most = -std::numeric_limits<double>::infinity(), least = -most;
  for (const Vec3& p : a.points) most = std::max(most, n.dot(p));
  for (const Vec3& p : b.points) least = std::min(least, n_b.dot(p));
  return n.dot(b_in_a.translation) + least - most;
}

/// Of this thread, so that others on the machine do not count.
double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

bool same_points(const Manifold& one, const Manifold& other) {
  const auto kept = [&](const ManifoldPoint& p) {
    return std::any_of(other.points.begin(), other.points.begin() + other.count, [&](const ManifoldPoint& q) {
      return p.feature_a == q.feature_a && p.feature_b == q.feature_b && p.point_a == q.point_a && p.point_b == q.point_b;
    });
  };
  return one.count == other.count && std::all_of(one.points.begin(), one.points.begin() + one.count, kept);
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  pairs += other.pairs, judged += other.judged, answers += other.answers, solved += other.solved, trials += other.trials,
      hits += other.hits;
  for (std::size_t v = 0; v < verdicts.size(); ++v) verdicts[v] += other.verdicts[v];
  for (std::size_t d = 0; d < doubts.size(); ++d) doubts[d] += other.doubts[d];
  failed += other.failed;
  steps = std::max(steps, other.steps);
  depths += other.depths;
  manifolds += other.manifolds;
  supports = std::max(supports, other.supports);
  widest = std::max(widest, other.widest);
  hash += other.hash;
  return *this;
}

Pair::Pair(Examiner& examiner, const Subject& a, const Subject& b, const Pose& b_in_a)
    : examiner_(examiner),
      a_(a),
      b_(b),
      b_in_a_(b_in_a),
      judge_(a, b, b_in_a),
      is_judged_(examiner.tally.pairs++ % examiner.judge_every_ == 0) {
  if (is_judged_ && (examiner.tally.pairs - 1) / examiner.judge_every_ % kSolveEvery == 0) judge_.truth();
}

Pair::~Pair() { examiner_.tally.judged += is_judged_, examiner_.tally.solved += judge_.has_truth(); }

Answer Pair::ask(PairSeed& seed) {
  const std::uint64_t choice = examiner_.random.bits();  // whichever way: the next pair does not depend on it
  return is_judged_ ? examine(seed, choice) : compare(seed, choice);
}

Answer Pair::examine(PairSeed& seed, std::uint64_t choice) {
  const PairSeed start = seed;
  const Answer answer = exact(seed);
  PairSeed used = start;
  OverlapProof proof;
  const Effort effort{.tuning = {.proof = &proof}};
  const Answer met = swiftlet::intersects(a_.model, b_.model, b_in_a_, used, effort);
  count(met);
  judged(judge_.verdict(met, proof), "intersects", start);
  require(met.verdict == answer.verdict, "intersects and distance differ in their verdict");

  const double bound = law_two(), d = answer.lower;
  const double thresholds[] = {
      0, answer.lower, answer.upper, d + bound / 8, d + 2 * bound, d / 2, 2 * d, d + 1e3 * bound, std::max(0.0, d - 2 * bound)};
  const double threshold = thresholds[choice / 2 % std::size(thresholds)];
  used = start;
  const Within within = swiftlet::within(a_.model, b_.model, b_in_a_, threshold, used, effort);
  count(within.answer);
  judged(judge_.decision(within, threshold, proof), "within", start);

  used = start;
  const Answer deep = exact_depth(used);
  require(deep.verdict == answer.verdict, "the signed distance differs in its verdict");
  if (examiner_.tally.pairs / examiner_.judge_every_ % kColdEvery == 0) {
    PairSeed cold, cold_depth;
    agree(deep, exact_depth(cold_depth), "a cold start");
    agree(answer, exact(cold), "a cold start");
    carefully(start, answer);
  }
  if (choice % 2) seed = used;
  return answer;
}

Answer Pair::compare(PairSeed& seed, std::uint64_t choice) {
  is_judged_ = false;
  PairSeed used = seed;
  const PairSeed start = seed;
  const Answer answer = distance(a_.model, b_.model, b_in_a_, seed);
  const Answer deep = signed_distance(a_.model, b_.model, b_in_a_, used);
  count(answer), count(deep);
  count_doubt(start, {}, answer);
  const double bound = law_two();
  judged(unsettled(answer, bound), "distance", start);
  judged(unsettled(deep, deep.verdict == Verdict::Touching ? 2 * bound : bound), "signed distance", start);
  require(std::fabs(deep.lower - rounded_gap(a_, b_, b_in_a_, deep.normal)) <= 2 * bound, "the signed distance is not the gap");
  require(deep.verdict == answer.verdict, "the signed distance differs in its verdict");
  PairSeed again = used;
  agree(deep, signed_distance(a_.model, b_.model, b_in_a_, again), "where it ended");
  const Answer swapped = signed_distance(b_.model, a_.model, inverse(b_in_a_));
  judged(unsettled(swapped, 2 * bound), "signed distance, swapped,", {});  // its pose is rounded
  if (!lie_within(deep, swapped, 2 * bound))
    require(false, "another signed distance with the bodies swapped" + against(deep, swapped));
  if (choice % 2) seed = used;
  return answer;
}

void Pair::march() {
  const double before = cpu_seconds();
  const MarchResult found = swiftlet::march(a_.model.level(0).view, b_.model.level(0).view, b_in_a_);
  require(cpu_seconds() - before < kMostSeconds, "a march takes seconds");
  Answer answer;
  switch (found.status) {
    case MarchStatus::Disjoint: answer.verdict = Verdict::Disjoint; break;
    case MarchStatus::Touching: answer.verdict = Verdict::Touching; break;
    case MarchStatus::Overlapping: answer.verdict = Verdict::Overlapping; break;
    default: return require(false, "a march ends with the status " + std::to_string(int(found.status)));
  }
  answer.status = Status::Converged;
  answer.lower = found.lower, answer.upper = found.upper, answer.normal = found.normal;
  answer.point_a = found.point_a, answer.point_b = found.point_b;
  answer.feature_a = found.a, answer.feature_b = found.b;
  answer.steps = found.steps, answer.plane_tests = found.plane_tests;
  count(answer);
  if (is_judged_) judged(judge_.verdict(answer, found.proof), "march", {});
}

Answer Pair::exact(PairSeed& seed, const Options& options) {
  const PairSeed start = seed;
  OverlapProof proof;
  const Answer answer = distance(a_.model, b_.model, b_in_a_, seed, proving(options, proof));
  count(answer);
  count_doubt(start, options, answer);
  judged(is_judged_ ? judge_.exact(answer, proof) : unsettled(answer, law_two()), "distance", start);
  if (is_judged_ && answer.verdict != Verdict::Overlapping) manifolds(answer);
  examiner_.tally.widest = std::max(examiner_.tally.widest, (answer.upper - answer.lower) / judge_.law_two());
  return answer;
}

Answer Pair::limited(Query query, Judgement judgement, const char* name, PairSeed& seed, const Options& options) {
  const PairSeed start = seed;
  OverlapProof proof;
  const Answer answer = query(a_.model, b_.model, b_in_a_, seed, proving(options, proof));
  count(answer);
  judged((judge_.*judgement)(answer, proof), name, start);
  return answer;
}

Answer Pair::loose(PairSeed& seed, const Options& options) {
  return limited(distance, &Judge::interval, "distance, not exact,", seed, options);
}

Answer Pair::coarse_depth(PairSeed& seed, const Options& options) {
  return limited(signed_distance, &Judge::coarse, "signed distance, coarse,", seed, options);
}

Answer Pair::exact_depth(PairSeed& seed) {
  const PairSeed start = seed;
  OverlapProof proof;
  const Answer answer = signed_distance(a_.model, b_.model, b_in_a_, seed, proving({}, proof));
  count(answer);
  judged(judge_.exact(answer, proof), "signed distance", start);
  const double width = (answer.verdict == Verdict::Touching ? 2 : 1) * law_two();
  examiner_.tally.widest = std::max(examiner_.tally.widest, (answer.upper - answer.lower) / width);
  PairSeed again = seed;
  agree(answer, signed_distance(a_.model, b_.model, b_in_a_, again), "where it ended");
  manifolds(answer);
  return answer;
}

void Pair::carefully(PairSeed seed, const Answer& answer) {
  const PairSeed start = seed;
  OverlapProof proof;
  const Options options{.tuning = {.careful = true, .proof = &proof}};
  const Answer careful = distance(a_.model, b_.model, b_in_a_, seed, options);
  judged(judge_.exact(careful, proof), "careful distance", start);
  agree(answer, careful, "the careful path");
  const ConvexView &a = a_.model.level(0).view, &b = b_.model.level(0).view;
  MarchRule rule;
  const MarchResult found = swiftlet::march(a, b, b_in_a_, {}, rule);
  rule.careful = true;
  const MarchResult proved = swiftlet::march(a, b, b_in_a_, {}, rule);
  require(proved.doubt == Doubt::Asked, "a careful march does not say so");
  require(proved.status == found.status && std::fabs(proved.lower - found.lower) <= law_two() &&
              std::fabs(proved.upper - found.upper) <= law_two(),
          "a march and the careful one differ");
}

void Pair::manifolds(const Answer& answer) {
  shapes::Random& random = examiner_.manifold_options_;
  if (random.bits() % kManifoldEvery > 0 || answer.status != Status::Converged) return;
  const double infinity = std::numeric_limits<double>::infinity(), size = a_.extent + b_.extent;
  const double margins[] = {0, infinity, infinity, law_two(), 1e-3 * size, size};
  ManifoldOptions options;
  options.margin = margins[random.bits() % std::size(margins)];
  if (random.bits() % 2) options.most_points = 1 + std::uint32_t(random.bits() % kMostManifoldPoints);
  if (random.bits() % 4 == 0) options.flatness = 0;
  const Manifold before = examiner_.manifold_, first = manifold(a_.model, b_.model, b_in_a_, answer, options, before),
                 again = manifold(a_.model, b_.model, b_in_a_, answer, options, first);
  examiner_.manifold_ = first;
  for (const Manifold* p : {&first, &again}) {
    count(*p);
    judged(judge_.manifold(*p, answer, options, before), p == &first ? "manifold" : "manifold, again,", {});
  }
  require(same_points(first, again), "a manifold does not keep its points");
}

void Pair::agree(const Answer& one, const Answer& other, const char* what) {
  if (one.verdict == other.verdict && lie_within(one, other, law_two())) return;
  require(false,
          std::string(one.is_signed ? "another signed distance from " : "another answer from ") + what + against(one, other));
}

void Pair::require(bool holds, const std::string& what) {
  if (holds) return;
  Examiner& e = examiner_;
  ++e.tally.failed;
  if (has_failed_ || e.failures.size() >= kMostFailures) return;
  has_failed_ = true;
  Case c;
  c.name = e.label_ + "-" + std::to_string(e.failures.size());
  c.category = {e.family_};
  c.source = "generated";
  c.license = "BSD-3-Clause";
  c.symptom = what;
  c.a = a_.points;
  c.b = b_.points;
  c.b_in_world = b_in_a_;
  if (const oracle::Truth& truth = judge_.truth(); !truth.overlapping) c.expected = Expected{1, truth.distance};
  e.failures.push_back(std::move(c));
}

void Pair::judged(const std::string& wrong, const char* query, const PairSeed& seed) {
  if (wrong.empty()) return;
  require(false, std::string(query) + " from the seed " + hex(seed) + ": " + wrong);
}

void Examiner::count(const Answer& answer) {
  ++tally.answers;
  if (answer.is_signed && answer.verdict == Verdict::Overlapping) {
    ++tally.depths;
    tally.supports = std::max(tally.supports, answer.steps);
  } else if (!answer.is_signed) {
    ++tally.verdicts[std::size_t(answer.verdict)];
    tally.steps = std::max(tally.steps, answer.steps);
  }
  mix(tally.hash, answer.status), mix(tally.hash, answer.verdict), mix(tally.hash, answer.lower), mix(tally.hash, answer.upper);
  for (const Vec3& v : {answer.normal, answer.point_a, answer.point_b})
    for (const double x : v) mix(tally.hash, std::isnan(x) ? 0 : x);
  mix(tally.hash, answer.feature_a), mix(tally.hash, answer.feature_b), mix(tally.hash, answer.steps);
}

void Pair::count_doubt(PairSeed seed, Options options, const Answer& answer) {
  if (answer.status != Status::Converged || answer.verdict == Verdict::Overlapping) return;
  std::array<LevelRecord, 1> last;
  options.tuning.trace = last;
  distance(a_.model, b_.model, b_in_a_, seed, options);
  ++examiner_.tally.doubts[std::size_t(last[0].doubt)];
}

void Pair::count(const Manifold& manifold) {
  ++examiner_.tally.manifolds;
  std::uint64_t& hash = examiner_.tally.hash;
  mix(hash, manifold.count), mix(hash, manifold.face_a), mix(hash, manifold.face_b);
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    for (const Vec3& v : {p.point_a, p.point_b})
      for (const double x : v) mix(hash, x);
    mix(hash, p.separation), mix(hash, p.feature_a), mix(hash, p.feature_b);
  }
}

}  // namespace swiftlet::stability
