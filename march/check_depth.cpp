// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A depth by its definition: the least height of all planes that can bound the Minkowski difference. Nothing here expands.
#include <swiftlet/check.h>

#include <algorithm>
#include <array>
#include <vector>

#include "brute.h"
#include "ring.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec narrowed(const Wide& v) { return {double(v.x), double(v.y), double(v.z)}; }

/// An edge in the common frame, and from its tail the vertices across the two facets beside it.
struct Rim {
  Wide tail, along;
  std::array<Wide, 2> beside;
  std::array<Vec, 2> beside_rough;
  Vec along_rough;
  std::size_t sides = 0;
};

std::vector<Rim> rims(const ConvexView& view, const Motion& m) {
  std::vector<Rim> all;
  const auto point = [&](std::uint32_t v) { return wide(m, vec(view.vertices[v])); };
  for (std::uint32_t h = 0; h < view.head.size(); ++h) {
    if (view.twin[h] < h) continue;
    Rim rim;
    rim.tail = point(origin(view, h));
    rim.along = point(view.head[h]) - rim.tail;
    rim.along_rough = narrowed(rim.along);
    for (const std::uint32_t side : {h, view.twin[h]}) {
      if (view.face[side] == kNone) continue;
      rim.beside[rim.sides] = point(view.head[next_in_facet(view, side)]) - rim.tail;
      rim.beside_rough[rim.sides] = narrowed(rim.beside[rim.sides]);
      ++rim.sides;
    }
    all.push_back(rim);
  }
  return all;
}

/// Whether the edge's body is nowhere higher along n than the edge, up to `error` for a vertex across: locally is enough.
bool is_extreme(const Rim& rim, const Wide& n, int sign, double error) {
  for (std::size_t k = 0; k < rim.sides; ++k) {
    if (sign * double(dot(n, rim.beside[k])) > error) return false;
  }
  return true;
}
bool may_be_extreme(const Rim& rim, const Vec& n, int sign, double error) {
  for (std::size_t k = 0; k < rim.sides; ++k) {
    if (sign * dot(n, rim.beside_rough[k]) > error) return false;
  }
  return true;
}

/// The least height, or infinity where no plane can bound the difference.
class LeastHeight {
 public:
  explicit LeastHeight(const Scene& scene) : scene_(scene) {}

  double find() {
    faces(scene_.a, kAtRest);
    faces(scene_.b, scene_.b_in_a);
    const std::vector<Rim> of_a = rims(scene_.a, kAtRest), of_b = rims(scene_.b, scene_.b_in_a);
    for (const Rim& a : of_a) {
      for (const Rim& b : of_b) edges(a, b);
    }
    return least_;
  }

 private:
  void faces(const ConvexView& view, const Motion& m) {
    each_facet(view, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      const Wide p = wide(m, vec(view.vertices[i]));
      const Vec n = narrowed(cross(wide(m, vec(view.vertices[j])) - p, wide(m, vec(view.vertices[k])) - p));
      if (norm(n) > 0) least_ = std::min(least_, -std::max(gap(n), gap(-n)));
    });
  }
  double gap(const Vec& n) const { return gap_along(scene_.a.vertices, scene_.b.vertices, scene_.b_in_a, n); }
  void edges(const Rim& a, const Rim& b) {
    const Vec &u = a.along_rough, &v = b.along_rough, rough = cross(u, v);
    const double doubt = kCrossError * std::sqrt(dot(u, u) * dot(v, v)), error = 2 * kSqrt3 * doubt * scene_.magnitude;
    for (const int sign : {1, -1}) {
      if (!may_be_extreme(a, rough, sign, error) || !may_be_extreme(b, rough, -sign, error)) continue;
      const Wide n = cross(a.along, b.along);
      const double length = norm(narrowed(n)), slack = kDoubleDoubleError * norm(u) * norm(v) * scene_.magnitude;
      if (!(length > 0) || !is_extreme(a, n, sign, slack) || !is_extreme(b, n, -sign, slack)) continue;
      least_ = std::min(least_, sign * double(dot(n, a.tail - b.tail)) / length);
    }
  }

  const Scene& scene_;
  double least_ = kInfinity;
};

/// What the answer claims of a distance.
Answer distance_part(const SignedAnswer& s) {
  Answer d;
  d.status = s.status;
  d.verdict = s.verdict;
  d.lower = std::max(s.lower, 0.0), d.upper = std::max(s.upper, 0.0);
  d.normal = s.normal;
  d.point_a = s.point_a, d.point_b = s.point_b;
  d.level_a = s.level_a, d.level_b = s.level_b;
  d.feature_a = s.feature_a, d.feature_b = s.feature_b;
  d.proof = s.proof;
  return d;
}

}  // namespace

Check check(const Model& a, const Model& b, const Pose& b_in_a, const SignedAnswer& answer) {
  if (answer.status == Status::InvalidPose || answer.status == Status::InvalidRadius || answer.lower > 0)
    return check(a, b, b_in_a, distance_part(answer));
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) return failed("the pose is not legal");
  if (answer.level_a < a.finest_level() || answer.level_a >= a.level_count() || answer.level_b < b.finest_level() ||
      answer.level_b >= b.level_count()) {
    return failed("levels (%d, %d) are not there", answer.level_a, answer.level_b);
  }
  if (!(answer.upper >= answer.lower)) return failed("[%.17g, %.17g] is no interval", answer.lower, answer.upper);
  const Level &finest_a = a.level(a.finest_level()), &finest_b = b.level(b.finest_level());
  const Scene whole = scene(finest_a.view, finest_b.view, m, quality.error);
  if (std::isfinite(answer.lower)) {
    const double gap = gap_along(a, b, m, vec(answer.normal));
    if (!(gap * (gap < 0 ? 1 - kNormError : 1 + kNormError) + kDoubleDoubleError * whole.magnitude >= answer.lower))
      return failed("lower is %.17g, but the gap along the normal is %.17g", answer.lower, gap);
  }
  if (answer.upper >= 0) return check(a, b, b_in_a, distance_part(answer));
  if (answer.verdict == Verdict::Disjoint) return failed("disjoint with an upper bound of %.17g", answer.upper);
  const double depth = LeastHeight(whole).find() - finest_a.deviation - finest_b.deviation * std::sqrt(1 + 3 * quality.error);
  if (!(depth < kInfinity)) return failed("upper is %.17g, but the bodies share a plane", answer.upper);
  if (!(-answer.upper <= depth * (1 + kNormError) + kDoubleDoubleError * whole.magnitude))
    return failed("upper is %.17g, but the depth is %.17g", answer.upper, depth);
  const Level &level_a = a.level(answer.level_a), &level_b = b.level(answer.level_b);
  const Scene pair = scene(level_a.view, level_b.view, m, quality.error);
  const Vec p = vec(answer.point_a), q = vec(answer.point_b);
  if (!holds(level_a.view, p, pair.law_two)) return failed("point_a is not in level %d of A", answer.level_a);
  if (!holds(level_b.view, apply(motion(inverse(b_in_a)), q), pair.law_two))
    return failed("point_b is not in level %d of B", answer.level_b);
  return kPassed;
}

}  // namespace swiftlet
