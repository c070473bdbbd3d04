// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The judge of contact manifolds, in rational arithmetic.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "exact_check.h"
#include "manifold_oracle.h"

namespace swiftlet::stability {
namespace {

/// The least share of a convex polygon that the largest one of so many corners has, one of which is given: what
/// `Manifold.LargestPolygonsKeepTheSharesOfTheHeader` finds by a search. A manifold before keeps its points while others have
/// no more than 17/16 of the area.
constexpr double kShares[] = {
    0, 0, 0, 0.316 * 16 / 17, 0.57 * 16 / 17, 0.72 * 16 / 17, 0.80 * 16 / 17, 0.85 * 16 / 17, 0.89 * 16 / 17};
/// A manifold of many corners is chosen from 10 to 20, whose chords cut off about equal areas: on a circle ten of equal chords
/// keep 0.935. Up to this many corners nothing is allowed for that.
constexpr std::size_t kCorners = 20;
constexpr double kKept = 0.93;

bool is_named(const ConvexView& view, FeatureId feature) {
  switch (feature.kind()) {
    case FeatureKind::None: return false;
    case FeatureKind::Vertex: return feature.index() < view.vertices.size();
    case FeatureKind::Edge:
      return feature.index() < view.half_edges.size() && feature.index() < view.half_edges[feature.index()].twin;
    case FeatureKind::Face: return feature.index() < view.face_first.size();
  }
  return false;
}

/// What a model's faces are flat to by themselves, over the extent: 4 ulps of the corners' own precision.
double own_flatness(const Subject& subject) {
  const auto is_single = [](const Vertex& v) { return float(v.x) == v.x && float(v.y) == v.y && float(v.z) == v.z; };
  const std::span<const Vertex> corners = subject.model.level(0).view.vertices;
  return std::all_of(corners.begin(), corners.end(), is_single) ? 0x1p-21 : 0x1p-50;
}
/// What a manifold takes for one face, over the extent: what is asked for, or what the faces are flat to by themselves.
double flatness_of(const ManifoldOptions& options, const Subject& subject) {
  return std::max(std::min(options.flatness, kMostFlatness), own_flatness(subject));
}

/// Whether a point is a corner of what the contact faces have in common; a deepest point that is none is the answer's.
bool is_corner(const Manifold& manifold, const ManifoldPoint& p) {
  const bool is_of_a = p.feature_a.kind() == FeatureKind::Vertex && p.feature_b == manifold.face_b,
             is_of_b = p.feature_b.kind() == FeatureKind::Vertex && p.feature_a == manifold.face_a;
  return is_of_a || is_of_b || (p.feature_a.kind() == FeatureKind::Edge && p.feature_b.kind() == FeatureKind::Edge);
}

/// Of one body: a point less its radius, what it is said to lie on, the contact face, and where the body is.
struct Claim {
  const Subject& subject;
  const Pose& pose;
  Vec3 point;
  FeatureId feature, face;

  /// `beside`: how far from what it is named after the point may be.
  std::string fault(const ManifoldOptions& options, double bound, double beside) const {
    const ConvexView& view = subject.model.level(0).view;
    if (!is_named(view, feature)) return "no feature is named";
    const bool on_face = feature.kind() == FeatureKind::Face;
    const std::vector<Vec3> corners = on_face ? subject.points : vertices_of(view, feature);
    const double flatness = flatness_of(options, subject), depth = flatness * view.extent + bound;
    const auto is_within = [&](const std::vector<Vec3>& hull, double off) {
      return oracle::is_within({&point, 1}, hull, pose, off);
    };
    // The border of a face that is flat only nearly may turn inwards; an edge there is named for the chord that cuts it off.
    const auto is_on_chord = [&] {
      std::vector<Vec3> ends;
      for (const std::uint32_t f : oracle::flat_faces(view, face, flatness)) {
        for (const Vec3& corner : vertices_of(view, {FeatureKind::Face, f})) ends.push_back(corner);
      }
      for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          if (is_within({ends[i], ends[k]}, beside)) return true;
        }
      }
      return false;
    };
    // An edge opposite a vertex holds the answer's point, which lies within law 2's bound of the line through the vertex.
    if (!is_within(corners, feature.kind() == FeatureKind::Edge ? bound + beside : beside)) {
      if (on_face) return "is not in the body";
      if (feature.kind() != FeatureKind::Edge || face.kind() != FeatureKind::Face || !is_on_chord())
        return "is not on what it is named after";
    }
    const double height = oracle::height_over(view, pose, point);
    return height >= -depth ? "" : "is " + std::to_string(-height / depth) + " times the flatness below the surface";
  }
};

}  // namespace

std::string Judge::manifold(const Manifold& manifold, const Answer& answer, const ManifoldOptions& options,
                            const Manifold& before) const {
  const double bound = law_two_ + 0x1p-47 * (answer.radius_a + answer.radius_b);
  const Vec3& n = manifold.normal;
  // At rest corners may miss the other face by twice the flatness, so that they keep their names.
  const double flatness = std::min(options.flatness, kMostFlatness), extent = std::max(a_.extent, b_.extent),
               beside = bound + ((n - before.normal).norm() <= 8 * flatness ? 2 * flatness * extent : 0);
  if (manifold.count > std::min(options.most_points, kMostManifoldPoints)) return "more points than asked for";
  if (manifold.count == 0)
    return answer.upper > options.margin || options.most_points == 0 ? "" : "no point, but the bodies are near enough";
  if (n != answer.normal) return "another normal than the answer's";
  // Where the answer's feature is a vertex that does not hold the point, the manifold looks for the feature that does.
  const auto is_badly_chosen = [&](const Subject& subject, const Pose& pose, const Vec3& own_n, const Vec3& point,
                                   FeatureId feature, FeatureId face) {
    const ConvexView& view = subject.model.level(0).view;
    return face.kind() == FeatureKind::Face &&
           (feature.kind() != FeatureKind::Vertex ||
            oracle::is_within({&point, 1}, vertices_of(view, feature), pose, bound / 2)) &&
           !oracle::faces_best(view, own_n, feature, face);
  };
  if (is_badly_chosen(a_, Pose{}, n, answer.point_a - answer.radius_a * n, answer.feature_a, manifold.face_a))
    return "another face of A at the answer's feature faces better";
  if (is_badly_chosen(b_, b_in_a_, -(b_in_a_.rotation.transpose() * n), answer.point_b + answer.radius_b * n, answer.feature_b,
                      manifold.face_b))
    return "another face of B at the answer's feature faces better";
  double least = manifold.points[0].separation;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    const std::string name = "point " + std::to_string(i);
    if (!(p.point_a + p.point_b).allFinite()) return name + " is not finite";
    if (!(p.separation <= options.margin + bound)) return name + " is farther apart than the margin";
    if (!((p.point_b - p.point_a - p.separation * n).norm() <= 2 * bound)) return name + ": not one above the other";
    for (std::uint32_t k = 0; k < i; ++k) {
      const ManifoldPoint& q = manifold.points[k];
      if (p.feature_a == q.feature_a && p.feature_b == q.feature_b) return name + " has the name of another";
    }
    const Claim of_a{a_, Pose{}, p.point_a - answer.radius_a * n, p.feature_a, manifold.face_a},
        of_b{b_, b_in_a_, p.point_b + answer.radius_b * n, p.feature_b, manifold.face_b};
    if (const std::string wrong = of_a.fault(options, bound, beside); !wrong.empty()) return name + " of A " + wrong;
    if (const std::string wrong = of_b.fault(options, bound, beside); !wrong.empty()) return name + " of B " + wrong;
    least = std::min(least, p.separation);
  }
  // At rest the deepest point of the manifold before stays while it is nearly the deepest.
  const double slack = bound + flatness * extent;
  if (!(least >= answer.lower - bound && least <= answer.upper + slack))
    return "the least separation is off the answer's by " +
           std::to_string(std::max(answer.lower - least, least - answer.upper) / bound) + " of law 2's bound";
  if (!(manifold.points[0].separation <= least + slack)) return "the first point is not the deepest";
  return area_of(manifold, options, beside);
}

std::string Judge::area_of(const Manifold& manifold, const ManifoldOptions& options, double bound) const {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < manifold.count; ++i) points.push_back(manifold.points[i].point_a);
  const Vec3 &n = manifold.normal, first = points[0];
  const double shown = oracle::area(points, n), length = a_.extent + b_.extent, blur = 16 * bound * length;
  // A deepest point inside of the area comes first, and is not on its border.
  std::vector<Vec3> border(points.begin() + 1, points.end());
  const std::vector<Vec3> corners = is_corner(manifold, manifold.points[0]) ? points : border;
  double bordered = oracle::area(border, n);
  if (bordered < shown - blur) border = points, bordered = shown;
  Vec3 around = Vec3::Zero();
  for (std::size_t i = 0; i < border.size(); ++i)
    around += (border[i] - first).cross(border[i + 1 == border.size() ? 0 : i + 1] - first);
  if (!(std::fabs(around.dot(n) / 2 - bordered) <= blur)) return "the points are not in order around their area";
  if (!std::isinf(options.margin) || manifold.face_a.kind() != FeatureKind::Face || manifold.face_b.kind() != FeatureKind::Face)
    return "";
  const ConvexView &a = a_.model.level(0).view, &b = b_.model.level(0).view;
  const oracle::Overlay truth =
      oracle::overlay(a, oracle::flat_faces(a, manifold.face_a, std::min(options.flatness, kMostFlatness)), b,
                      oracle::flat_faces(b, manifold.face_b, std::min(options.flatness, kMostFlatness)), b_in_a_, n, first);
  const double common = truth.area;
  const auto text = [&](const char* what) {
    return std::to_string(manifold.count) + what + std::to_string(shown / common) + " of the area in common";
  };
  // The answer's point may lie on a facet that is merged into another face, and so beside the contact face by its flatness.
  const double aside =
      is_corner(manifold, manifold.points[0]) ? 0 : own_flatness(a_) * a_.extent + own_flatness(b_) * b_.extent;
  if (!(shown <= common + blur + aside * length && oracle::area(corners, n) <= common + blur)) return text(" points span ");
  // Faces that are one within the flatness are a line where they are seen narrower than that.
  const auto thin = [&](const Subject& subject, const ConvexView& view, FeatureId face, const Mat3& rotation) {
    const double across = (rotation * oracle::face_normal(view, face)).cross(manifold.normal).norm();
    return flatness_of(options, subject) * view.extent * across * length;
  };
  const double narrow = thin(a_, a, manifold.face_a, Mat3::Identity()) + thin(b_, b, manifold.face_b, b_in_a_.rotation);
  // Beside a deepest point inside of the area the others keep what one fewer does.
  const std::uint32_t most = std::min(options.most_points, kMostManifoldPoints);
  const double share = kShares[truth.depth > bound ? most - 1 : most] * (truth.corners > kCorners ? kKept : 1);
  return shown >= share * common - blur - narrow ? "" : text(" points keep but ");
}

}  // namespace swiftlet::stability
