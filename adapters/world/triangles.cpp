// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A direction of contact is right where no triangle that holds the point rises above the plane across the direction: it then
// lies in the normal cone of the surface there [Rockafellar 1970, sec. 2], between the normals of the faces at an edge. Other
// directions come from triangles that are looked at alone, of which an inner edge is the nearest part or the shortest way out.
// These are replaced by the normal of the face, on the side from which the model came.
#include <swiftlet/triangles.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include <swiftlet/depth.h>

#include "along.h"

namespace swiftlet {
namespace {

bool is_less_separated(const TrianglePoint& p, const TrianglePoint& q) { return p.separation < q.separation; }

}  // namespace

// ---- The surface -----------------------------------------------------------------------------------------------------------

SurfaceTriangle::SurfaceTriangle(const Vec3& p, const Vec3& q, const Vec3& r)
    : corners{p, q, r},
      least(p.cwiseMin(q).cwiseMin(r)),
      most(p.cwiseMax(q).cwiseMax(r)),
      front(normal_of(Body::triangle(p, q, r), Side::Front)) {}

bool SurfaceTriangle::covers(const Vec3& p, double slack) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = corners[(i + 1) % 3] - corners[i];
    if (front.cross(edge).dot(p - corners[i]) < -slack * edge.norm()) return false;
  }
  return true;
}

Vec3 SurfaceTriangle::nearest_to(const Vec3& p) const {
  if (has_plane() && covers(p, 0)) return p - front.dot(p - corners[0]) * front;
  double least2 = std::numeric_limits<double>::infinity();
  Vec3 nearest = corners[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = corners[(i + 1) % 3] - corners[i], away = p - corners[i];
    const double length2 = edge.squaredNorm(), t = length2 > 0 ? std::clamp(edge.dot(away) / length2, 0., 1.) : 0;
    if (const double d2 = (away - t * edge).squaredNorm(); d2 < least2) least2 = d2, nearest = corners[i] + t * edge;
  }
  return nearest;
}

void SurfacePatch::clear() {
  triangles_.clear();
  by_x_.clear();
  widest_ = 0;
}

void SurfacePatch::add(const Vec3& p, const Vec3& q, const Vec3& r) {
  triangles_.emplace_back(p, q, r);
  widest_ = std::max(widest_, triangles_.back().most[0] - triangles_.back().least[0]);
}

void SurfacePatch::sort() {
  by_x_.resize(triangles_.size());
  std::iota(by_x_.begin(), by_x_.end(), 0u);
  std::sort(by_x_.begin(), by_x_.end(),
            [&](std::uint32_t i, std::uint32_t j) { return triangles_[i].least[0] < triangles_[j].least[0]; });
}

template <class Reach, class Visit>
void SurfacePatch::for_near(double x, const Reach& reach, const Visit& visit) {
  if (by_x_.size() != triangles_.size()) sort();
  auto next = std::lower_bound(by_x_.begin(), by_x_.end(), x - reach() - widest_,
                               [&](std::uint32_t i, double least) { return triangles_[i].least[0] < least; });
  for (; next != by_x_.end() && triangles_[*next].least[0] <= x + reach(); ++next) visit(*next);
}

bool SurfacePatch::is_supported(const Vec3& p, const Vec3& direction, double slack) {
  bool is_below = true;
  for_near(
      p[0], [&] { return slack; },
      [&](std::uint32_t i) {
        const SurfaceTriangle& t = triangles_[i];
        if ((p.array() < t.least.array() - slack).any() || (p.array() > t.most.array() + slack).any()) return;
        if (!t.has_plane() || std::abs(t.front.dot(p - t.corners[0])) > slack || !t.covers(p, slack)) return;
        for (const Vec3& q : t.corners) is_below = is_below && !(direction.dot(q - p) > slack);
      });
  return is_below;
}

std::optional<SurfacePatch::Place> SurfacePatch::nearest_to(const Vec3& p, double reach) {
  std::optional<Place> nearest;
  for_near(
      p[0], [&] { return reach; },
      [&](std::uint32_t i) {
        const SurfaceTriangle& t = triangles_[i];
        if ((p - p.cwiseMax(t.least).cwiseMin(t.most)).squaredNorm() > reach * reach) return;
        const Vec3 point = t.nearest_to(p);
        const double apart = (p - point).norm();
        if (nearest ? apart >= reach : apart > reach) return;
        nearest = {i, point}, reach = apart;
      });
  return nearest;
}

// ---- A body and the surface ------------------------------------------------------------------------------------------------

/// One step's pair, as all triangles see it.
struct TrianglePair::View {
  Body a;
  Pose a_in_world, b_in_a;
  Mat3 into_b;
  Ball ball;     ///< around the body, without its radius, in its frame
  Vec3 centre;   ///< the ball's, in the surface's frame
  Vec3 moved_a;  ///< how far the body moved since the step before, in its frame
  double radius, beyond, one_place;
  bool is_solid;

  Vec3 in_b(const Vec3& p_a) const { return into_b * (p_a - b_in_a.translation); }
};

void TrianglePair::clear() {
  surface_.clear();
  now_.clear();
}

void TrianglePair::add(std::uint64_t name, const Vec3& p, const Vec3& q, const Vec3& r) {
  surface_.add(legal(p), legal(q), legal(r));
  now_.push_back({name, {}});
}

/// Recalls what is known of each triangle.
void TrianglePair::recall() {
  for (Memory& memory : now_) {
    const auto known = std::lower_bound(memories_.begin(), memories_.end(), memory.name,
                                        [](const Memory& m, std::uint64_t name) { return m.name < name; });
    if (known != memories_.end() && known->name == memory.name) memory = *known;
  }
}

/// The points of contact with one triangle.
class TrianglePair::Meeting {
 public:
  Meeting(TrianglePair& pair, const View& view, std::uint32_t number)
      : pair_(pair),
        view_(view),
        t_(pair.surface_.triangles()[number]),
        memory_(pair.now_[number]),
        number_(number),
        b_(Body::triangle(t_.corners[0], t_.corners[1], t_.corners[2], view.radius)),
        radii_(view.a.radius() + view.radius),
        first_(pair.points_.size()) {}

  void add_points() {
    find();
    const auto first = pair_.points_.begin() + std::ptrdiff_t(first_);
    if (first != pair_.points_.end()) std::min_element(first, pair_.points_.end(), is_less_separated)->is_deepest_of_its = true;
  }

 private:
  void find() {
    if ((view_.centre - t_.nearest_to(view_.centre)).norm() > view_.ball.radius + radii_ + view_.beyond) {
      memory_.is_met = memory_.is_over = false;
      return;
    }
    if (t_.has_plane() && !view_.is_solid && !memory_.is_met) meet();
    Answer face;
    if (t_.has_plane()) {
      face = above_face();
      if (face.lower > view_.beyond) return;
      if (face.lower + radii_ >= 0 && is_over(face.point_b)) return add_those_over(face);  // the nearest point, without a walk
    }
    const Answer alone = signed_distance(view_.a, b_, view_.b_in_a, memory_.seed, {.beyond = view_.beyond});
    bool is_apart = alone.lower + radii_ > 0;
    if (t_.has_plane() && is_apart && !view_.is_solid) {
      const Side before = memory_.side;
      if (see(alone, view_.b_in_a) && memory_.side != before) {
        if (may_have_gone_around(alone)) {
          face = above_face();
        } else {
          memory_.side = before, is_apart = false;
        }
      }
    }
    if (alone.status == Status::Beyond) return;
    if (!alone.normal.hasNaN()) {
      const Vec3 direction = view_.into_b * -alone.normal;
      // Not through to the other side, nor across a solid.
      const bool leads_back = (is_apart && !view_.is_solid) || up().dot(direction) >= -kOnePlace;
      if (leads_back && pair_.surface_.is_supported(view_.in_b(core_b(alone)), direction, view_.one_place))
        return add_all(alone);
    }
    if (!t_.has_plane() || (is_apart && face.lower + radii_ < 0)) return;  // apart, and its lowest point is elsewhere
    add_those_over(face);
    // Deep in the body and not below its lowest face: no deeper than the shortest way out of the triangle alone.
    const bool is_missed = pair_.points_.size() == first_ && !is_apart && !alone.normal.hasNaN();
    if (!is_missed) return;
    const Vec3 on_b = core_b(alone) - face.normal * view_.radius;
    add(face.normal, on_b - face.normal * alone.lower, on_b, alone.lower);
  }

  /// Finds the side on which the body was in the step before: where its nearest point was or, if they overlapped, its centre.
  void meet() {
    memory_.is_met = true;
    memory_.side = t_.side_of(view_.centre - view_.into_b * view_.moved_a);
    Pose before = view_.b_in_a;
    before.translation += view_.moved_a;
    PairSeed seed;
    const Answer alone = distance(view_.a, b_, before, seed);
    if (alone.lower + radii_ > 0) see(alone, before);
  }
  /// Learns the body's side from the nearest points of both, which are apart. Where the triangle's point is on its border, the
  /// body may be beside it, over another triangle: then a side stays that was learnt from a point inside. Returns whether it
  /// learnt one.
  bool see(const Answer& alone, const Pose& b_in_a) {
    if (alone.normal.hasNaN()) return false;
    const double height = t_.front.dot(b_in_a.rotation.transpose() * -alone.normal);
    const Vec3 at = b_in_a.rotation.transpose() * (core_b(alone) - b_in_a.translation);
    const bool is_over = t_.covers(at, -view_.one_place);
    if (std::abs(height) <= kOnePlace || (memory_.is_over && !is_over)) return false;
    memory_.side = height < 0 ? Side::Back : Side::Front, memory_.is_over = is_over;
    return true;
  }
  /// Whether the body, apart from the triangle but for its radius and on the other side than remembered, came there around the
  /// border. A point or segment may have passed through since the step before: it is then below the triangle.
  bool may_have_gone_around(const Answer& alone) const {
    const BodyKind kind = view_.a.kind();
    return kind == BodyKind::Model || kind == BodyKind::Box || alone.lower > 0 || !t_.covers(view_.centre, 0);
  }
  /// Towards the body.
  Vec3 up() const { return memory_.side == Side::Front ? t_.front : Vec3(-t_.front); }
  Answer above_face() const { return above(view_.a, b_, view_.b_in_a, memory_.side, up()); }
  Vec3 core_b(const Answer& answer) const { return answer.point_b + answer.normal * view_.radius; }
  /// Of a point that is moved along the normal by the radius, too.
  bool is_over(const Vec3& p_a) const { return t_.covers(view_.in_b(p_a), view_.one_place); }

  Manifold manifold_of(const Answer& answer) const {
    const ManifoldOptions options{.margin = view_.beyond, .most_points = kMostManifoldPoints};
    return manifold(view_.a, b_, view_.b_in_a, answer, options);
  }
  void add_all(const Answer& answer) {
    const Manifold all = manifold_of(answer);
    for (std::uint32_t i = 0; i < all.count; ++i) add(all, i);
  }
  void add_those_over(const Answer& face) {
    const Manifold all = manifold_of(face);
    for (std::uint32_t i = 0; i < all.count; ++i) {
      if (is_over(all.points[i].point_b)) add(all, i);
    }
  }
  void add(const Manifold& all, std::uint32_t i) {
    add(all.normal, all.points[i].point_a, all.points[i].point_b, all.points[i].separation);
  }
  void add(const Vec3& normal, const Vec3& point_a, const Vec3& point_b, double separation) {
    pair_.points_.push_back({view_.a_in_world.rotation * normal, transform(view_.a_in_world, point_a),
                             transform(view_.a_in_world, point_b), separation, number_, false});
  }

  TrianglePair& pair_;
  const View& view_;
  const SurfaceTriangle& t_;
  Memory& memory_;
  const std::uint32_t number_;
  const Body b_;
  const double radii_;
  const std::size_t first_;  ///< of its points
};

std::span<const TrianglePoint> TrianglePair::contacts(const Placed& a, const Pose& surface, double radius, const Vec3& moved,
                                                      double beyond, bool is_solid) {
  points_.clear();
  const Pose a_in_world = orthonormal(a.in_world), surface_in_world = orthonormal(surface);
  const Pose b_in_a = relative(a_in_world, surface_in_world);
  const Mat3 into_b = b_in_a.rotation.transpose();
  const Ball ball = ball_around(a.body);
  const double size = a.body.model() ? ball.radius : ball.radius + a.body.radius();
  View view{a.body, a_in_world, b_in_a, into_b, ball, {}, {}, radius, beyond, kOnePlace * size, is_solid};
  view.centre = view.in_b(ball.centre);
  view.moved_a = a_in_world.rotation.transpose() * moved;
  recall();
  for (std::uint32_t i = 0; i < now_.size(); ++i) Meeting(*this, view, i).add_points();

  memories_.assign(now_.begin(), now_.end());
  std::sort(memories_.begin(), memories_.end(), [](const Memory& m, const Memory& n) { return m.name < n.name; });
  return points_;
}

namespace {

/// Twice the area of a triangle, seen along `normal`; positive where it turns left.
double twice_area(const Vec3& normal, const Vec3& p, const Vec3& q, const Vec3& r) { return normal.dot((q - p).cross(r - p)); }

}  // namespace

Spread spread(std::span<const TrianglePoint> points, double touching) {
  Spread chosen;
  const auto place = [&](std::uint32_t i) -> const Vec3& { return points[chosen.index[i]].point_b; };
  const auto take_most = [&](double least, auto&& gain) {
    for (const double farthest : {touching, std::numeric_limits<double>::infinity()}) {
      double most = least;
      std::uint32_t found = 0;
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (points[i].separation > farthest) continue;
        if (const double g = gain(points[i].point_b); g > most) most = g, found = i;
      }
      if (most <= least) continue;
      chosen.index[chosen.count++] = found;
      return true;
    }
    return false;
  };
  if (points.empty()) return chosen;
  const auto deepest = std::min_element(points.begin(), points.end(), is_less_separated);
  chosen.index[chosen.count++] = std::uint32_t(deepest - points.begin());
  const Vec3& n = deepest->normal;
  if (!take_most(0, [&](const Vec3& p) { return (p - place(0)).squaredNorm(); })) return chosen;
  const Vec3 line = place(1) - place(0);
  if (!take_most(kOnePlace * line.squaredNorm(),
                 [&](const Vec3& p) { return std::abs(twice_area(n, place(0), place(1), p)); })) {
    // All lie on one line, such as a body's edge: its other end.
    take_most(0, [&](const Vec3& p) { return line.dot(place(0) - p); });
    return chosen;
  }
  if (twice_area(n, place(0), place(1), place(2)) < 0) std::swap(chosen.index[1], chosen.index[2]);
  take_most(0, [&](const Vec3& p) {
    double gain = 0;
    for (std::uint32_t i = 0; i < 3; ++i) gain = std::max(gain, -twice_area(n, place(i), place((i + 1) % 3), p));
    return gain;
  });
  return chosen;
}

}  // namespace swiftlet
