// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The signed distance. The depth [van den Bergen 2001] is bounded from level pair to finer level pair: a coarse pair's
// Minkowski difference encloses the exact one, so its heights are no less, and exceed the exact ones by at most its deviation.
// Near 0 `distance` decides the sign. Knows levels and seeds. Each file that includes this compiles it for the registers of its
// own flags: see depth.cpp. Nothing here is defined for other files.
#pragma once

#include <swiftlet/depth.h>

#include <algorithm>
#include <cmath>

#include "body/half_edge.h"
#include "body/support.h"
#include "depth/epa.h"
#include "depth/facet_proof.h"
#include "numeric/width.h"
#include "pair/difference.h"
#include "pair/gjk.h"
#include "pair/intersection.h"
#include "pair/start.h"
#include "pair/support_gjk.h"
#include "pair/walk.h"
#include "pair/witness.h"
#include "query/ask.h"
#include "query/model_pair.h"
#include "query/radii.h"
#include "query/seed.h"

namespace swiftlet {

SWIFTLET_BOTH_WIDTHS(void, signed_distance, const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                     const Options& options, Answer& answer);
SWIFTLET_BOTH_WIDTHS(void, signed_within, const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                     const Effort& effort, Within& result);

namespace {

/// The vertices of a feature in order; of a face with more than four, the first four.
struct Span {
  int count = 0;
  std::array<std::uint32_t, 4> vertex{};
  bool is_whole = true;  ///< the feature has no other vertices
};
Span span_of(const ConvexView& view, FeatureId feature) {
  const std::uint32_t i = feature.index();
  if (feature.kind() == FeatureKind::Vertex) return {1, {i}};
  if (feature.kind() == FeatureKind::Edge) return {2, {origin(view, i), view.half_edges[i].head}};
  Span span;
  std::uint32_t h = view.face_first[i];
  do {
    span.vertex[std::size_t(span.count++)] = origin(view, h);
    h = next_in_face(view, h);
  } while (h != view.face_first[i] && span.count < 4);
  span.is_whole = h == view.face_first[i];
  return span;
}
/// The corners of a triangle between vertices of a face that holds the point of the face below `p`.
template <class Body>
Span triangle_below(const Body& body, FeatureId face, const Vec& p) {
  const Combination c = below(body, face.index(), p);
  return {3, {c.vertex[0], c.vertex[1], c.vertex[2]}};
}

/// What a search has found.
struct Found {
  DepthEnd end = DepthEnd::NotConverged;
  double lower = -kInfinity, upper = kInfinity;  ///< bounds on the depth of the exact hulls
  Vec normal{0, 0, 0}, point_a{0, 0, 0}, point_b{0, 0, 0};
  bool has_points = false;
  FeatureId feature_a, feature_b;
  int level_a = 0, level_b = 0;
};

/// The search for the depth, from level pair to finer level pair until the bounds suffice.
class Deepening : public Found {
 public:
  Deepening(const Setting& at, const Limits& limits, const StopRule& asked)
      : pair_(*at.a, *at.b, at.motion, at.quality.error, limits),
        a_(*at.a),
        b_(*at.b),
        line_(pair_.line()),
        budget_(limits.budget),
        trace_(limits.trace),
        law_two_(pair_.law_two()),
        stop_(asked.beyond_by(law_two_).at_least(law_two_)),
        finest_a_(pair_.finest_a()),
        finest_b_(pair_.finest_b()) {}

  /// `floor`: as `DepthGoal::floor`. `visited`: the number of level pairs that are in the trace already.
  [[gnu::noinline, gnu::flatten]] void run(const PairSeed& seed, double floor = 0, int visited = 0) {
    floor_ = floor;
    levels_visited = visited;
    lower = -kInfinity, upper = kInfinity;
    // Coarse pairs may pass a threshold. To a tolerance they cost more than the finest pair, where the walk ends at a facet.
    place_ = stop_.is_threshold() ? coarsest_place(a_, b_) : Place{finest_a_, finest_b_, {}};
    turn_ = seed.met && seed.level_a < a_.level_count() && seed.level_b < b_.level_count()
                ? turn_of(line_, seed, a_.level(seed.level_a), b_.level(seed.level_b), Warm::TwiceAsFar)
                : Turn::Far;
    const bool remembers = turn_ != Turn::Far && (seed.normal[0] | seed.normal[1] | seed.normal[2]) != 0;
    Vec direction = remembers ? swiftlet::direction(seed) : lowest_seen();
    for (;;) {
      const double error = deviation();
      const std::uint32_t steps_before = steps, tests_before = plane_tests;
      solve(seed, direction, error);
      note(trace_, std::size_t(levels_visited++),
           {place_.level_a, place_.level_b, -upper, -lower, steps - steps_before, plane_tests - tests_before});
      if (is_finest() || end == DepthEnd::Apart || end == DepthEnd::Budget || answered()) break;
      direction = normal;
      place_ = {std::max(place_.level_a - 1, finest_a_), std::max(place_.level_b - 1, finest_b_), {}};
    }
    if (end == DepthEnd::NotConverged && steps >= budget_.steps) end = DepthEnd::Budget;
    if (end == DepthEnd::NotConverged && answered()) end = DepthEnd::Converged;
  }

  /// Takes steps that were spent elsewhere off the budget.
  void spend(std::uint32_t spent) { budget_.steps = steps_left(budget_.steps, spent); }
  std::uint32_t left() const { return steps_left(budget_.steps, steps); }

  /// Runs from a cold start. What is known stays if the budget ends that.
  void run_anew() {
    const Found known = *this;
    run({}, 0, levels_visited);
    if (end == DepthEnd::Budget) Found::operator=(known);
  }

  /// Bounds the depth of touching bodies by their height along a unit direction, whatever was known of it. `floor`: as `run`'s.
  void touch(const Vec& n, FeatureId from_a, FeatureId from_b, double floor) {
    place_ = {finest_a_, finest_b_, {}};
    const PairView pair = pair_.view_at(place_);
    floor_ = floor;
    lower = -kInfinity, has_points = false;
    ++steps, upper = -supports(pair, n, any_vertex(pair.a, from_a), any_vertex(pair.b, from_b), plane_tests).lower;
    normal = n, level_a = finest_a_, level_b = finest_b_;
    end = answered() ? DepthEnd::Converged : DepthEnd::NotConverged;
  }

  Status status() const {
    if (end == DepthEnd::Converged || (stop_.is_threshold() && end == DepthEnd::Apart)) return Status::Converged;
    if (end == DepthEnd::Budget) return Status::Budget;
    return place_.level_a == 0 && place_.level_b == 0 ? Status::NotConverged : Status::LevelLimit;
  }
  /// True if the depth is surely above law 2's bound: the bodies overlap and do not count as touching.
  bool proved() const { return lower > law_two_; }

  /// True if no other start decides a threshold otherwise: the bounds pass it by more than law 2's bound, or the start was
  /// cold.
  bool decided() const { return turn_ == Turn::Far || stop_.passed(lower, upper) || end == DepthEnd::Budget; }
  /// True if the bounds are narrow enough, with `floor` as the lower bound if that is better.
  bool narrow(double floor) const { return stop_.narrow(max(lower, floor), upper); }

  void store(PairSeed& seed) const {
    turn_ == Turn::Little ? remember(vec4(normal), seed) : remember(line_, normal, seed);
    seed.a = feature_a, seed.b = feature_b;
    seed.level_a = std::uint8_t(place_.level_a), seed.level_b = std::uint8_t(place_.level_b);
    seed.met = true;
  }

  const ModelPair& pair() const { return pair_; }

  std::uint32_t steps = 0, plane_tests = 0;
  int levels_visited = 0;

 private:
  double deviation() const { return pair_.deviation(place_.level_a, place_.level_b); }
  /// True if no finer level pair may be read.
  bool is_finest() const { return place_.level_a == finest_a_ && place_.level_b == finest_b_; }
  bool answered() const { return stop_.met(max(lower, floor_), upper); }

  /// The direction along which support maps show the Minkowski difference lowest: the line of centres, or the axis across the
  /// thinnest side of either body's box. Without maps, the line of centres.
  Vec lowest_seen() const {
    const auto across = [](const Shape& body) { return least_axis(body.size()); };
    const ConvexView &view_a = a_.level(finest_a_).view, &view_b = b_.level(finest_b_).view;
    Vec lowest = normalised(line_.in_a);
    if (a_.map_level() == a_.level_count() || b_.map_level() == b_.level_count()) return lowest;
    double least = kInfinity;
    for (const Vec& axis : {lowest, across(a_), rotate(pair_.motion, across(b_))}) {
      if (max_abs(axis) == 0) continue;  // bodies with one centre have no line of centres
      const Vec n = dot(axis, line_.in_a) < 0 ? -axis : axis, own = rotate_back(pair_.motion, -n);
      const Vec p = vec(view_a.vertices[about_farthest(a_, finest_a_, n)]),
                q = vec(view_b.vertices[about_farthest(b_, finest_b_, own)]);
      if (const double height = dot(n, p - apply(pair_.motion, q)); height < least) least = height, lowest = n;
    }
    return lowest;
  }

  /// Returns a start with `direction` and the pairs of a vertex of each feature, sorted so that their differences go around a
  /// polygon. Of a face of many corners and a vertex, the triangle below the vertex stands for the face. If there are more than
  /// four pairs, the vertices of A's feature are paired with the first vertex of B's alone.
  static DepthStart start_at(const PairView& pair, const MarchStart& features, const Vec& direction) {
    Span a = span_of(pair.a, features.a), b = span_of(pair.b, features.b);
    const Resting body = body_a(pair);
    const Moved other = body_b(pair);
    if (!a.is_whole && b.count == 1) a = triangle_below(body, features.a, other.point(b.vertex[0]));
    if (!b.is_whole && a.count == 1) b = triangle_below(other, features.b, other.local(body.point(a.vertex[0])));
    if (a.count == 2 && b.count == 2)
      return {4,
              {a.vertex[0], a.vertex[0], a.vertex[1], a.vertex[1]},
              {b.vertex[0], b.vertex[1], b.vertex[1], b.vertex[0]},
              direction,
              features.a,
              features.b};
    if (a.count == 1)
      return {b.count, {a.vertex[0], a.vertex[0], a.vertex[0], a.vertex[0]}, b.vertex, direction, features.a, features.b};
    DepthStart s{a.count, a.vertex, {b.vertex[0], b.vertex[0], b.vertex[0], b.vertex[0]}, direction, features.a, features.b};
    if (b.count > 1) s.feature_a = s.feature_b = {};
    return s;
  }

  /// Moves B along a direction until it is free; the features that are nearest then give the next direction, until they span a
  /// facet of the Minkowski difference that holds the nearest point. Returns true if it is proved to. `at` becomes where the
  /// search ended.
  bool slide(const PairView& pair, const Level& of_a, const Level& of_b, MarchStart from, const DepthGoal& goal, DepthStart& at,
             Depth& found) {
    Vec n = normalised(at.direction);
    const Resting body = body_a(pair);
    const Moved other = body_b(pair);
    const bool has_maps = of_a.map_side > 0 && of_b.map_side > 0;
    bool far = from.a.kind() == FeatureKind::None, climbs = far;
    if (far)
      from = {{FeatureKind::Vertex, about_farthest(a_, place_.level_a, n)},
              {FeatureKind::Vertex, about_farthest(b_, place_.level_b, other.into(-n))}};
    else
      from = settled(pair, from, plane_tests);
    for (int round = 0; round < kSlides; ++round) {
      std::uint32_t va = any_vertex(pair.a, from.a), vb = any_vertex(pair.b, from.b);
      if (climbs) va = ascend(pair.a, n, va, plane_tests), vb = ascend(pair.b, other.into(-n), vb, plane_tests);
      const double height = dot(n, body.point(va) - other.point(vb));
      if (!(height > 0)) {
        if (climbs) break;
        climbs = true;
        continue;
      }
      Motion m = pair_.motion;
      m.t = m.t + n * (height * kSlideBy);
      const PairView apart = moved_by(pair, m, height * kSlideBy);
      if (far && has_maps) {
        const SupportGjk seen = search_maps(apart, of_a, of_b, 0, kExact, sample_axis(apart, of_a, of_b, n));
        from = seen.start;
        const bool turns = dot(seen.seen.normal, n) < kSlideTurn;
        n = seen.seen.normal;
        if (turns) continue;
      }
      Walk w = walk(apart, from.a, from.b, PlaneRule::MostViolated, left());
      steps += w.steps, plane_tests += w.plane_tests;
      if (w.end != WalkEnd::Minimum) {
        if (climbs) break;
        climbs = true;
        continue;
      }
      from = {w.a, w.b};
      Vec next = normalised(w.nearest.normal);
      at = start_at(pair, from, next);
      const bool proved = prove_facet(pair, of_a, of_b, at, {apart, w.nearest, m.t - pair_.motion.t}, goal, plane_tests, found);
      steps += found.steps;
      if (proved) return true;
      const bool is_facet = found.upper < kInfinity;
      if (is_facet && dot(found.normal, found.normal) == 0) return false;
      if (is_facet) next = normalised(found.normal);
      far = dot(next, n) < kSlideTurn;
      climbs = far || is_facet;
      n = next;
    }
    at = start_at(pair, from, n);
    return false;
  }

  /// The depth of one level pair: proved at the local minimum near the seed's features, else found by EPA, which costs more.
  Depth depth_of(const PairView& pair, const Level& of_a, const Level& of_b, const PairSeed& seed, const Vec& direction,
                 DepthGoal goal) {
    const bool fits = turn_ != Turn::Far && seed.level_a == place_.level_a && seed.level_b == place_.level_b;
    Depth found;
    DepthStart at;
    at.direction = direction;
    if ((fits || goal.wants_facet()) && steps < budget_.steps &&
        slide(pair, of_a, of_b, fits ? MarchStart{seed.a, seed.b} : MarchStart{}, goal, at, found))
      return found;
    if (!goal.wants_facet()) at = {}, at.direction = direction;
    goal.step_budget = left();
    found = epa(pair, of_a, of_b, at, goal, plane_tests);
    steps += found.steps;
    return found;
  }

  void solve(const PairSeed& seed, const Vec& direction, double error) {
    const Level &of_a = a_.level(place_.level_a), &of_b = b_.level(place_.level_b);
    const PairView pair = pair_.view_at(place_);
    const DepthGoal goal(stop_, pair.law_two, error, is_finest(), floor_);
    const Depth found = depth_of(pair, of_a, of_b, seed, direction, goal);
    end = found.end;
    if (found.lower > 0) lower = max(lower, error > 0 ? (found.lower - error) - 2 * kU * (found.lower + error) : found.lower);
    if (end == DepthEnd::Converged && error > 0 && !stop_.met(max(lower, floor_), min(upper, found.upper)))
      end = DepthEnd::NotConverged;  // the depth of these levels is known, and that is not as precise as asked
    if (found.upper > upper + law_two_) return;
    upper = found.upper;
    normal = found.normal;
    level_a = place_.level_a, level_b = place_.level_b;
    has_points = found.active.count > 0;
    if (!has_points) return;
    point_a = found.point_a, point_b = found.point_b;
    feature_a = found.feature_a, feature_b = found.feature_b;
    if (feature_a.kind() != FeatureKind::None) return;
    feature_a = feature_of(of_a.view, found.active, found.active.a);
    feature_b = feature_of(of_b.view, found.active, found.active.b);
    if (!goal.wants_facet() || !stop_.is_exact()) return;  // the points need not lie on the surfaces
    const HeldPoint a = held_at_a(pair, feature_a, point_a, plane_tests), b = held_at_b(pair, feature_b, point_b, plane_tests);
    feature_a = a.feature, point_a = a.point;
    feature_b = b.feature, point_b = b.point;
  }

  const ModelPair pair_;
  const Shape &a_, &b_;
  const Line line_;
  Budget budget_;
  const std::span<LevelRecord> trace_;
  const double law_two_;
  const StopRule stop_;
  const int finest_a_, finest_b_;
  double floor_ = 0;
  Turn turn_ = Turn::Far;  ///< from the seed's pose, if the bodies overlapped there
  Place place_{};
};

/// How far the points of `s` are from where its bounds put them along its normal.
double aside(const Answer& s) {
  const Vec n = vec(s.normal), between = vec(s.point_b) - vec(s.point_a);
  const double along = min(max(dot(between, n), s.lower), max(s.lower, s.upper));
  return norm(between - n * along);
}

/// Writes the depth found into `s`: minus its upper bound is `lower`; normal, points and what holds them as far as known.
void take(const Deepening& deep, Answer& s) {
  s.lower = -deep.upper;
  s.normal = eigen(deep.normal);
  // A touching answer keeps its own points, which are as near, unless they lie too far aside of the depth's normal.
  const bool has_points = !s.point_a.hasNaN(), rests = s.verdict == Verdict::Touching && aside(s) <= deep.pair().law_two();
  if (deep.has_points ? rests : has_points) return;
  s.level_a = std::int16_t(deep.level_a), s.level_b = std::int16_t(deep.level_b);
  if (!deep.has_points) return;
  s.point_a = eigen(deep.point_a), s.point_b = eigen(deep.point_b);
  s.feature_a = deep.feature_a, s.feature_b = deep.feature_b;
}

void add_work(const Deepening& deep, Answer& s) {
  s.steps += deep.steps;
  s.plane_tests += deep.plane_tests;
  s.levels_visited = std::uint8_t(std::max(int(s.levels_visited), deep.levels_visited));
}

/// Joins `s`, the answer of a distance that is not surely above 0, and the depth into one interval.
void join(const Deepening& deep, Answer& s, OverlapProof& proof, PairSeed& seed) {
  const bool overlapping = deep.proved() || s.verdict == Verdict::Overlapping;
  if (s.status == Status::Converged || s.status == Status::LevelLimit) s.status = deep.status();
  if (overlapping) s.verdict = Verdict::Overlapping;
  s.upper = min(overlapping ? min(s.upper, 0) : s.upper, -deep.lower);
  if (s.upper < 0) proof = {};
  take(deep, s);
  if (overlapping) deep.store(seed);
}

/// Completes the answer of a distance with lower bound 0 whose bodies are separated by a plane that the depth found.
void part(const Deepening& deep, Answer& s) {
  s.verdict = Verdict::Disjoint;
  s.lower = -deep.upper;
  s.upper = max(s.upper, s.lower);
  s.normal = eigen(deep.normal);
}

/// Narrows the upper bound of a touching pair's distance in 106 bits, for when law 2 allows the bounds of distance and depth
/// one by one, but not together.
void sharpen(const ModelPair& pair, Answer& s) {
  const Place place{s.level_a, s.level_b, {s.feature_a, s.feature_b}};
  const PairView view = pair.view_at(place);
  const MarchStart from = settled(view, place.start, s.plane_tests);
  Certificate c = certify(view, witness(view, from.a, from.b), s.plane_tests);
  sharpen(view, c, s.plane_tests);
  s.upper = max(s.lower, min(s.upper, c.upper + pair.deviation(s.level_a, s.level_b)));
}

/// Fills an answer by the depth alone, without a distance.
void overlap_part(const Deepening& deep, Answer& s) {
  s.normal.setZero();
  s.status = deep.status();
  s.upper = -deep.lower;
  take(deep, s);
  if (deep.proved()) s.verdict = Verdict::Overlapping;
  if (deep.upper < 0) s.verdict = Verdict::Disjoint;
  add_work(deep, s);
}

/// True if a signed answer is as narrow as asked: an error relative to the bodies' depth may be met where one relative to the
/// hulls' is not. Not inlined, as most depths do not end at a level and would save registers for it.
[[gnu::noinline]] bool is_met(const StopRule& asked, const Answer& s) {
  return s.lower > 0 ? asked.narrow(s.lower, s.upper) : asked.narrow(-s.upper, -s.lower);
}

/// Turns a signed answer about the hulls, and its trace, into those about the bodies, of which `asked` asks.
void finish(const Setting& at, const Limits& limits, const StopRule& asked, OverlapProof& proof, Answer& s) {
  s.is_signed = true;
  if (!(s.lower > -kInfinity)) s.normal.setZero();
  if (!at.radii.none()) {
    at.radii.round_signed(limits.trace, s.levels_visited);
    at.radii.round_signed(s, proof, at.law_two());
  }
  if (s.status == Status::LevelLimit && is_met(asked.at_least(at.law_two()), s)) s.status = Status::Converged;
  seal(at.radii, proof, limits.tuning, s);
}

/// Sets the lower bounds of a trace that are not above 0 to -infinity: a distance of 0 says nothing of the depth.
void make_signed(std::span<LevelRecord> trace, int visited) {
  for (LevelRecord& record : trace.first(std::min(trace.size(), std::size_t(visited)))) {
    if (!(record.lower > 0)) record.lower = -kInfinity;
  }
}

/// As `signed_distance`. `answer` must be a default one.
[[gnu::flatten]] void answer_signed(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options,
                                    Answer& answer) {
  if (options.tuning.proof) *options.tuning.proof = {};
  const Setting at(a, b, b_in_a);
  if (const Status fault = at.fault(); fault != Status::Converged) return refuse(a, b, fault, true, answer);
  Limits limits(options.budget, options.tuning);
  Deepening deep(at, limits, {allowed_error(options.absolute), allowed_error(options.relative)});
  OverlapProof proof;
  const StopRule of_bodies{allowed_error(options.absolute), allowed_error(options.relative), options.beyond};
  if (seed.met) deep.run(seed);
  if (deep.proved()) {
    deep.store(seed);
    overlap_part(deep, answer);
    return finish(at, limits, of_bodies, proof, answer);
  }
  const int visited = deep.levels_visited;
  if (!limits.trace.empty()) limits.trace = limits.trace.last(std::max(1, int(limits.trace.size()) - visited));
  StopRule of_hulls = at.radii.of_hulls(of_bodies, at.law_two());
  of_hulls.above = max(of_hulls.above, 0);  // a distance of 0, which any overlap has, is beyond nothing
  Budget left = options.budget;
  left.steps = deep.left();
  Limits rest(left, options.tuning);
  rest.trace = limits.trace;
  ask_hulls({*at.a, *at.b, at.motion, at.quality.error, rest}, of_hulls, seed, answer, proof);
  deep.spend(answer.steps);
  make_signed(limits.trace, answer.levels_visited);
  limits.trace = options.tuning.trace;
  answer.levels_visited = std::uint8_t(answer.levels_visited + visited);
  if (!(answer.lower > 0)) {
    const bool touching = answer.verdict == Verdict::Touching;
    PairSeed here = touching ? seed : PairSeed{};  // features at which bodies overlap need not be the deepest
    here.met = touching;
    const double floor = -answer.upper;  // the depth is at least minus the distance's upper bound
    bool known = deep.end == DepthEnd::Apart || (deep.steps > 0 && deep.narrow(floor));
    if (touching) known = false;  // within rounding of contact what a seed told does not count
    if (touching && !answer.normal.hasNaN()) {
      deep.touch(vec(answer.normal), answer.feature_a, answer.feature_b, floor);
      known = deep.narrow(floor);
    }
    const bool is_spent = deep.end == DepthEnd::Budget && deep.left() == 0;  // what is known stays
    if (!known && !is_spent) deep.run(here, floor, answer.levels_visited);
    if (deep.end == DepthEnd::Apart)
      part(deep, answer);
    else
      join(deep, answer, proof, seed);
    if (touching && answer.status == Status::NotConverged) {
      sharpen(deep.pair(), answer);
      if (answer.upper - answer.lower <= deep.pair().law_two()) answer.status = Status::Converged;
    }
  }
  add_work(deep, answer);
  finish(at, limits, of_bodies, proof, answer);
}

/// As `signed_within`. `result` must be a default one.
[[gnu::flatten]] void answer_signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                                           const Effort& effort, Within& result) {
  if (effort.tuning.proof) *effort.tuning.proof = {};
  const Setting at(a, b, b_in_a);
  if (const Status fault = at.fault(); fault != Status::Converged) return refuse(a, b, fault, true, result.answer);
  const Limits limits(effort.budget, effort.tuning);
  const double of_hulls = threshold + at.radii.sum();
  OverlapProof proof;
  if (of_hulls < 0) {
    Deepening deep(at, limits, {0, 0, -of_hulls, -of_hulls});
    deep.run(seed);
    if (!deep.decided()) deep.run_anew();  // within rounding of the threshold a cold start decides
    if (deep.proved()) deep.store(seed);
    overlap_part(deep, result.answer);
  } else {
    Answer& s = result.answer;
    ask_hulls({*at.a, *at.b, at.motion, at.quality.error, limits}, {0, 0, of_hulls, of_hulls}, seed, s, proof);
    make_signed(limits.trace, s.levels_visited);
    if (!(s.lower > 0)) s.lower = -kInfinity;
    // With radii, a threshold of about minus their sum asks whether the hulls overlap, which a distance of 0 does not tell. Nor
    // does one of levels that deviate by more than the threshold.
    const bool tells_little = !at.radii.none() || s.status == Status::LevelLimit;
    if (s.lower < 0 && s.status != Status::Budget && tells_little && !(s.upper < of_hulls)) {
      const Status of_distance = s.status;
      Deepening deep(at, limits, {0, 0, -of_hulls, -of_hulls});
      deep.spend(s.steps);
      deep.run({}, -s.upper, s.levels_visited);
      if (deep.end == DepthEnd::Apart)
        part(deep, s);
      else
        join(deep, s, proof, seed);
      if (s.status == Status::NotConverged) s.status = of_distance;  // touching, within law 2's bound
      add_work(deep, s);
    }
  }
  finish(at, limits, {}, proof, result.answer);
  decide(result, threshold);
  if (result.decision != Decision::Undecided && result.answer.status == Status::LevelLimit)
    result.answer.status = Status::Converged;
}

}  // namespace
}  // namespace swiftlet
