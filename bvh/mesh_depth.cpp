// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Signed distances of meshes. Apart, they are distances. Of an overlap an interval is known: from below a translation after
// which a distance is above 0, and from above what separates two triangles that cross, or two balls around one point.
#include <algorithm>
#include <cmath>

#include <swiftlet/depth.h>
#include <swiftlet/mesh_query.h>

#include "body/shape.h"
#include "body/support.h"
#include "inside.h"
#include "mesh_setting.h"

namespace swiftlet {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// So often is the best direction turned towards a lower height.
constexpr int kTurns = 16;

/// The vertices of a body by their heights along directions of its own frame.
class Supports {
 public:
  explicit Supports(const MeshView& of) : of_(of) {
    if (of.convex) shape_.emplace(of.convex->body);
  }
  /// A vertex than which none is higher along `n` by more than a product with `n` is rounded.
  Vec highest(const Vec& n) const {
    if (!shape_) return highest_of_mesh(n);
    const ConvexView& view = (**shape_).level((**shape_).finest_level()).view;
    std::uint32_t tests = 0;
    return vec(view.vertices[support(view, n, 0, tests)]);
  }

 private:
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  Vec highest_of_mesh(const Vec& n) const {
    const double unit = power_of_two(of_.root->unit);
    double best = -kInfinity;
    Vec at{};
    Entry stack[(kFanOut - 1) * kMostDepth + 1];
    int top = 0;
    stack[top++] = {0, kInfinity};
    while (top > 0) {
      const Entry entry = stack[--top];
      if (!(entry.bound > best)) continue;
      const Node& node = of_.nodes[entry.node];
      if (node.lowest()) {
        for (std::uint32_t t = node.first(); t < node.first() + std::uint32_t(node.count()); ++t) {
          for (const std::uint32_t v : of_.triangles[t]) {
            if (const double height = dot(n, of_.vertices[v]); height > best) best = height, at = of_.vertices[v];
          }
        }
        continue;
      }
      const Vec of_n = axes_of(node).along(n);
      const double along[3] = {of_n.x, of_n.y, of_n.z};
      const double base = dot(n, Vec{node.origin[0], node.origin[1], node.origin[2]});
      const int bottom = top;
      for (int i = 0; i < node.count(); ++i) {
        double bound = base, size = 0;
        for (int k = 0; k < 3; ++k) {
          const double centre = node.centre[k][i], half = node.half[k][i];
          bound += along[k] * centre + std::fabs(along[k]) * half, size += std::fabs(centre) + half;
        }
        bound = unit * (bound + kBoxSlack * size + kBoxHeightError);
        if (bound > best) stack[top++] = {node.first() + std::uint32_t(i), bound};
      }
      std::sort(stack + bottom, stack + top, [](const Entry& x, const Entry& y) { return x.bound < y.bound; });
    }
    return at;
  }

  const MeshView& of_;
  std::optional<ShapeOf> shape_;
};

/// So many poses are asked about to shorten a way out, and points to enlarge two balls, while each gains one part in so many.
constexpr int kEscapes = 12, kBalls = 16;
constexpr double kLeastGain = 0x1p-8;
/// A way out begins longer than what hulls need, so that the surfaces are apart: by this fraction.
constexpr double kRoom = 0x1p-10;
/// Other ways begin with this share of the shortest one, or as two balls part, with `kLeastLength` of it or more; they are so
/// much longer each time.
constexpr double kFirstLength = 0x1p-6, kLeastLength = 0x1p-20, kLonger = 4;

/// A translation along a unit direction that separates the bodies.
struct Way {
  double length = kInfinity;  ///< below 0 if they are so far apart; proved
  Vec n{};                    ///< from A to B
  Vec of_a{}, of_b{};         ///< the vertices that are deepest along it, each in its own frame
};

/// Bounds the depth of two bodies that are not apart.
class Depth {
 public:
  /// No more than `steps` are spent on translations that no plane proves.
  Depth(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, std::uint32_t steps)
      : a_(a), b_(b), pose_(b_in_a), at_(a, b, b_in_a), of_a_(at_.a), of_b_(at_.b), steps_(steps) {}

  bool is_whole() const { return at_.a.is_whole() && at_.b.is_whole(); }

  /// The shortest of the ways along some directions.
  Way way_out(const Answer& answer, const MeshSeed& seed) {
    if (at_.a.has_hull(0) && at_.b.has_hull(0)) return way_of_hulls();
    Way best;
    try_axes(at_.a, false, best), try_axes(at_.b, true, best);
    try_both(middle(at_.b, true) - middle(at_.a, false), best);
    if (!answer.normal.hasNaN()) try_both(vec(answer.normal), best);
    try_both({double(seed.direction[0]), double(seed.direction[1]), double(seed.direction[2])}, best);
    if (seed.triangle_a < at_.a.triangle_count && seed.triangle_b < at_.b.triangle_count) {
      if (at_.a.triangles) try_both(normal(at_.a, seed.triangle_a), best);
      if (at_.b.triangles) try_both(rotate(at_.motion, normal(at_.b, seed.triangle_b)), best);
    }
    descend(best);
    return best;
  }

  /// The shorter ones of the ways that begin as the bodies' hulls part, as two balls part, and as the triangles that met face.
  Way shorter(Way best, const MeshSeed& seed) {
    best = shorter(best, best.n, best.length * (1 + kRoom));
    const auto from = [&](const Vec& direction, double length) {
      const Vec n = normalised(direction);
      length = max(length, best.length * kLeastLength);  // balls where bodies touch have no size
      for (; dot(n, n) > 0.5 && length < best.length && steps_ > 0; length *= kLonger) {
        const double before = best.length;
        best = shorter(best, n, length);
        if (best.length < before) return;
      }
    };
    if (balls_.of_a >= 0) from(balls_.away_b - balls_.away_a, balls_.sum() * (1 + kRoom));
    if (at_.a.triangles && at_.b.triangles && seed.triangle_a < at_.a.triangle_count && seed.triangle_b < at_.b.triangle_count)
      from(normalised(normal(at_.a, seed.triangle_a)) - normalised(rotate(at_.motion, normal(at_.b, seed.triangle_b))),
           best.length * kFirstLength);
    return best;
  }

  /// A way that is no longer than one along which the bodies come apart from `length` on; no plane need part them after it.
  /// Where they are apart by g, so they are after any translation that differs by less. The nearest translation that a plane
  /// across their nearest points allows is asked about next, or from there half the way back.
  Way shorter(Way best, const Vec& n, double length) {
    Vec free = n * length;
    MeshSeed seed;
    Answer answer = after(free, seed);
    if (!(answer.lower > 0)) return best;
    for (int left = kEscapes; left > 0;) {
      // The moved pose is rounded.
      const double gap = answer.lower * (1 - kRoom) - 4 * kU * at_.size, way = norm(free) - gap;
      if (!(way > 0)) return best;  // so little that it is none
      if (way < best.length) {
        best.length = grown(way), best.n = normalised(free);
        between_ = vec(answer.point_a) - best.n * (way / 2);
      }
      const Vec m = vec(answer.normal);
      const double height = dot(m, free) - gap;
      Vec next = height > 0 ? m * height : free * 0.5;
      for (;; next = (free + next) * 0.5) {
        if (left-- == 0 || !(norm(next - free) > kLeastGain * best.length)) return best;
        answer = after(next, seed);
        if (answer.lower > 0) break;
      }
      free = next;
    }
    return best;
  }

  /// An upper bound on the signed distance; `at` becomes a point, in A's frame, that proves it, if there is one.
  double least_upper(const Way& way, const Answer& answer, const MeshSeed& seed, std::optional<Vec3>& at) {
    double upper = kInfinity;
    if (seed.triangle_a < at_.a.triangle_count && seed.triangle_b < at_.b.triangle_count) {
      upper = signed_distance(part(a_, at_.a, seed.triangle_a), part(b_, at_.b, seed.triangle_b), pose_).upper;
    }
    const auto take = [&](double depth, const Vec& p) {
      if (-depth < upper) upper = -depth, at = eigen(p);
    };
    // Vertices of one body inside the other: those that are deepest, and the one that the query found. A vertex of a coarser
    // level need not be a point of the body.
    const auto take_vertex = [&](const Vec& p, bool of_b) {
      if (!(of_b ? at_.b : at_.a).is_whole()) return;
      const double free = free_ball(of_b ? a_ : b_, !of_b, p, of_b);
      if (free >= 0) take(rounded_down(free + (of_b ? b_ : a_).radius()), of_b ? apply(at_.motion, p) : p);
    };
    take_vertex(way.of_b, true), take_vertex(way.of_a, false);
    const auto named = [](const MeshView& of, FeatureId feature) {
      return of.triangles && feature.kind() == FeatureKind::Vertex;
    };
    if (answer.verdict == Verdict::Overlapping && named(at_.a, answer.feature_a))
      take_vertex(at_.a.vertices[answer.feature_a.index()], false);
    if (answer.verdict == Verdict::Overlapping && named(at_.b, answer.feature_b))
      take_vertex(at_.b.vertices[answer.feature_b.index()], true);
    if (!has_volume(a_) || !has_volume(b_)) return upper;
    // Points between: in the middle of the overlap along the way, below the middles of both bodies and of what is deepest.
    const Vec p = way.of_a, q = apply(at_.motion, way.of_b), deepest = (p + q) * 0.5;
    const double height = dot(way.n, deepest);
    const Vec between = (middle(at_.a, false) + middle(at_.b, true)) * 0.5;
    const auto take_point = [&](const Vec& point) {
      const Balls balls = balls_around(legal(point));
      if (balls.sum() > balls_.sum()) balls_ = balls;
    };
    for (const Vec& point : {deepest, between, between + way.n * (height - dot(way.n, between)), common_middle()})
      take_point(point);
    if (between_) take_point(*between_);
    // Or beside the triangles that met, on the inner side of both.
    if (at_.a.triangles && at_.b.triangles && !answer.point_a.hasNaN() && seed.triangle_a < at_.a.triangle_count &&
        seed.triangle_b < at_.b.triangle_count) {
      const Vec inward =
          normalised(normal(at_.a, seed.triangle_a)) + normalised(rotate(at_.motion, normal(at_.b, seed.triangle_b)));
      for (const double share : {0x1p-3, 0x1p-6, 0x1p-9})
        take_point(vec(answer.point_a) - normalised(inward) * (share * way.length));
    }
    if (balls_.of_a < 0) return upper;
    balls_ = larger(balls_);
    take(rounded_down(balls_.sum()), balls_.at);
    return upper;
  }

 private:
  /// Two balls around a point, one in each body.
  struct Balls {
    double of_a = -1, of_b = -1;
    Vec at{};
    Vec away_a{}, away_b{};  ///< unit directions from the nearest point of each surface
    double sum() const { return of_a + of_b; }
  };
  Balls balls_around(const Vec& p) const {
    Balls balls;
    balls.at = p;
    balls.of_a = free_ball(a_, false, p, false, &balls.away_a);
    if (balls.of_a >= 0) balls.of_b = free_ball(b_, true, p, false, &balls.away_b);
    return balls.of_b < 0 ? Balls() : balls;
  }
  /// Moves the point to where the sum of both radii is greater. Within both balls it stays in both bodies.
  Balls larger(Balls best) const {
    double step = 0.5;
    for (int i = 0; i < kBalls; ++i) {
      const Balls next = balls_around(legal(best.at + (best.away_a + best.away_b) * (step * min(best.of_a, best.of_b))));
      if (next.sum() > best.sum()) {
        best = next;
      } else {
        step *= 0.5;
      }
    }
    return best;
  }

  static bool has_volume(const MeshBody& body) { return body.is_solid() || !body.mesh(); }
  static double rounded_down(double x) { return x * (1 - 4 * kU); }
  static Body part(const MeshBody& body, const MeshView& view, std::uint32_t triangle) {
    if (!view.triangles) return body.convex();
    const auto at = [&](std::size_t k) { return eigen(view.vertices[view.triangles[triangle][k]]); };
    return Body::triangle(at(0), at(1), at(2), body.radius());
  }
  static Vec normal(const MeshView& of, std::uint32_t triangle) {
    const Corners& c = of.triangles[triangle];
    return cross(of.vertices[c[1]] - of.vertices[c[0]], of.vertices[c[2]] - of.vertices[c[0]]);
  }
  /// Of the root's box, in A's frame.
  Vec middle(const MeshView& of, bool is_b) const { return is_b ? apply(at_.motion, of.root->middle) : of.root->middle; }
  /// The middle of what both bodies' boxes along A's axes have in common, if they have.
  Vec common_middle() const {
    double x[3];
    for (int k = 0; k < 3; ++k) {
      const Vec n{double(k == 0), double(k == 1), double(k == 2)}, own = rotate_back(at_.motion, n);
      const auto of_b = [&](const Vec& direction) { return dot(n, apply(at_.motion, of_b_.highest(direction))); };
      const double most = min(dot(n, of_a_.highest(n)), of_b(own)), least = max(dot(n, of_a_.highest(-n)), of_b(-own));
      x[k] = least + (most - least) / 2;
    }
    return {x[0], x[1], x[2]};
  }

  /// The shortest way of all, by the kernel.
  Way way_of_hulls() const {
    const Answer answer = signed_distance(at_.a.hull(0), at_.b.hull(0), pose_);
    Way way = along(answer.normal.hasNaN() ? Vec{0, 0, 1} : vec(answer.normal));
    if (!answer.normal.hasNaN()) way.length = min(way.length, grown(at_.radii.sum() - answer.lower));
    return way;
  }

  /// A length that is no less after `kMoveError`.
  static double grown(double length) { return length + kMoveError * std::fabs(length); }

  Way along(const Vec& n) const {
    Way way{kInfinity, n, of_a_.highest(n), {}};
    const Vec own = rotate_back(at_.motion, n);
    way.of_b = of_b_.highest(-own);
    const double gap = dot(own, way.of_b) + (dot(n, at_.motion.t) - dot(n, way.of_a));
    way.length = grown(at_.radii.sum() - gap + kAheadError * at_.size + kAheadOfItself * std::fabs(gap));
    return way;
  }
  void try_both(const Vec& direction, Way& best) const {
    const Vec n = normalised(direction);
    if (!(dot(n, n) > 0.5)) return;
    for (const Vec& m : {n, -n}) {
      if (const Way way = along(m); way.length < best.length) best = way;
    }
  }
  void try_axes(const MeshView& of, bool is_b, Way& best) const {
    for (const Vec& n : axes_of(*of.nodes).row) try_both(is_b ? rotate(at_.motion, n) : n, best);
  }
  /// Turns the direction against the vertices that bound it, by less and less: the height is convex around its least.
  void descend(Way& best) const {
    double turn = 0.25;
    for (int i = 0; i < kTurns; ++i) {
      const Vec w = normalised(best.of_a - apply(at_.motion, best.of_b));
      const Vec across = w - best.n * dot(w, best.n);
      const Way next = along(normalised(best.n - across * turn));
      if (next.length < best.length)
        best = next;
      else
        turn *= 0.5;
    }
  }

  /// The bodies' distance after B was moved.
  Answer after(const Vec& by, MeshSeed& seed) {
    Pose moved = pose_;
    moved.translation += eigen(by);
    Options options;
    options.budget.steps = steps_;
    const Answer answer = distance(a_, b_, moved, seed, options);
    steps_ -= std::min(steps_, answer.steps + answer.plane_tests);
    return answer;
  }

  /// A radius, proved, of a ball around a point that lies in a body; below 0 if the point is not known to be in it. The point
  /// is in B's frame if `in_b`.
  double free_ball(const MeshBody& of, bool is_b, const Vec& p, bool in_b, Vec* away = nullptr) const {
    const bool own = is_b == in_b, turned = is_b && !own;  // in its own frame the body takes A's place
    const Pose& at = own ? identity_ : pose_;
    const Body point = Body::point(eigen(p));
    if (!of.mesh()) {
      const Answer answer = turned ? signed_distance(point, of.convex(), at) : signed_distance(of.convex(), point, at);
      // The normal is the way out of the body for the point, or in A's place the way that the point goes.
      if (away && !answer.normal.hasNaN()) *away = vec(answer.normal) * (turned ? 1.0 : -1.0);
      return answer.upper <= 0 ? -answer.upper : -1;
    }
    if (!of.is_solid() || !Enclosure(MeshReader::content(*of.mesh()), at, turned).holds(p)) return -1;
    const MeshBody surface(*of.mesh()), guest(point);
    const Answer answer = distance(turned ? guest : surface, turned ? surface : guest, at);
    if (away && !answer.normal.hasNaN()) *away = vec(answer.normal) * (turned ? -1.0 : 1.0);
    return rounded_down(answer.lower + of.radius());
  }

  const MeshBody &a_, &b_;
  const Pose& pose_;
  const Pose identity_{};
  const MeshSetting at_;
  const Supports of_a_, of_b_;
  std::uint32_t steps_;
  Balls balls_;                 ///< the largest so far
  std::optional<Vec> between_;  ///< in the middle of what the shortest way leaves, where bodies touch after it
};

/// Makes an answer about a distance of bodies that are not apart one about their depth.
[[gnu::noinline]] void deepen(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const MeshSeed& seed,
                              const Options& options, double threshold, Answer& answer) {
  const std::uint32_t spent = answer.steps + answer.plane_tests;
  Depth depth(a, b, b_in_a, options.budget.steps - std::min(options.budget.steps, spent));
  Way way = depth.way_out(answer, seed);
  const double asked = tolerance(a, b, b_in_a);
  const Vec3 nearest = answer.normal;  // from point_a to point_b
  const auto bound = [&] {
    std::optional<Vec3> at;  // a point in both bodies, where balls around it prove the bound
    const double upper = depth.least_upper(way, answer, seed, at);
    if (upper < answer.upper) {
      answer.upper = upper;
      if (upper < 0 && at) answer.point_a = answer.point_b = *at;
    }
    if (answer.upper < 0) answer.verdict = Verdict::Overlapping;
    answer.lower = min(-way.length, answer.upper);
    const bool apart = answer.lower > 0;  // which the distance, being loose or cut short, did not show
    answer.normal = apart ? nearest : eigen(way.n);
    if (apart && answer.verdict == Verdict::Undecided) answer.verdict = Verdict::Disjoint;
    return answer.upper - answer.lower <=
           max(max(allowed_error(options.absolute), allowed_error(options.relative) * -answer.upper), asked);
  };
  bool narrow = bound();
  if (!narrow && !(answer.lower > threshold || answer.upper <= threshold)) {
    way = depth.shorter(way, seed);
    narrow = bound();
  }
  if (narrow)
    answer.status = Status::Converged;
  else if (answer.status != Status::Budget)
    answer.status = depth.is_whole() ? Status::NotConverged : Status::LevelLimit;
}

/// A threshold below 0 ends what is done for a depth where the interval is on one side of it.
Answer signed_distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Options& options,
                       double threshold) {
  if (!a.mesh() && !b.mesh()) return signed_distance(a.convex(), b.convex(), b_in_a, seed.pair, options);
  Options apart = options;
  if (apart.beyond < 0) apart.beyond = 0;  // a distance that ends earlier does not tell that the bodies are apart
  Answer answer = distance(a, b, b_in_a, seed, apart);
  answer.is_signed = true;
  const auto was_cut = [](const MeshBody& body) { return body.mesh() && !body.mesh()->is_whole(); };
  if (answer.status >= Status::InvalidPose || (!(answer.lower > 0) && (was_cut(a) || was_cut(b))))
    answer.lower = -kInfinity;
  else if (!(answer.lower > 0))
    deepen(a, b, b_in_a, seed, options, threshold, answer);
  return answer;
}

}  // namespace

Answer signed_distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Options& options) {
  return signed_distance(a, b, b_in_a, seed, options, kUnknown);
}
Answer signed_distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Options& options) {
  MeshSeed cold;
  return signed_distance(a, b, b_in_a, cold, options);
}

Within signed_within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed,
                     const Effort& effort) {
  if (!a.mesh() && !b.mesh()) return signed_within(a.convex(), b.convex(), b_in_a, threshold, seed.pair, effort);
  if (!(threshold < 0)) {
    Within result = within(a, b, b_in_a, threshold, seed, effort);
    result.answer.is_signed = true;
    if (!(result.answer.lower > 0)) result.answer.lower = -kInfinity, result.answer.normal = Vec3::Constant(kUnknown);
    return result;
  }
  const Options options{.beyond = 0, .budget = effort.budget, .tuning = {}};
  Within result{Decision::Undecided, signed_distance(a, b, b_in_a, seed, options, threshold)};
  decide(result, threshold);
  if (result.decision != Decision::Undecided) result.answer.status = Status::Converged;
  return result;
}
Within signed_within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, const Effort& effort) {
  MeshSeed cold;
  return signed_within(a, b, b_in_a, threshold, cold, effort);
}

}  // namespace swiftlet
