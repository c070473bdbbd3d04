// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two meshes meet in regions, of each of which the kernel knows the nearest points and one normal. A body that lies in a bowl
// has one region and many normals: so each vertex in a region is a place of contact too, along the way to the nearest point of
// the other surface, where the rule for edges (triangles.h) lets it count. A vertex beyond the other surface is pushed back: of
// a solid inside is beyond; of any other surface a vertex is beyond that crossed it since both met. Where one body was inside
// the other as a whole, no face tells which side is out: it is pushed along the shortest way that separates both until they do.
#include "mesh_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <swiftlet/depth.h>

#include "body/shape.h"
#include "through.h"

namespace swiftlet::bullet {
namespace {

TriangleId id_of(const PlacedMeshShape& of, std::uint32_t triangle) {
  if (!of.shape || triangle >= of.mesh().triangle_count()) return {};
  return {0, int(of.mesh().source_triangle()[triangle])};
}

/// Unit, or 0 of a triangle whose corners lie on one line.
Vec3 front_of(const MeshModel& mesh, std::uint32_t triangle) {
  const auto [p, q, r] = mesh.triangle(triangle);
  return SurfaceTriangle(mesh.vertex(p), mesh.vertex(q), mesh.vertex(r)).front;
}

bool holds(const MeshContact& region, const Vec3& p, double around) {
  return (p.array() >= region.box_min.array() - around).all() && (p.array() <= region.box_max.array() + around).all();
}

}  // namespace

MeshBody PlacedMeshShape::core() const {
  if (!shape) return without_radius(convex);
  return shape->is_solid() ? MeshBody::solid(mesh()) : MeshBody(mesh());
}

MayMeet::MayMeet(const SearchBox& box) : box_(box), width_(box.in_mesh.rotation.cwiseAbs()) {
  const Vec3 middle = transform(box.in_mesh, (box.least + box.most) / 2), half = width_ * (box.most - box.least) / 2;
  least_ = middle - half, most_ = middle + half;
}

bool MayMeet::operator()(const Vec3& box_min, const Vec3& box_max) const {
  if ((box_min.array() > most_.array()).any() || (box_max.array() < least_.array()).any()) return false;
  const Vec3 half = width_.transpose() * (box_max - box_min) / 2;
  const Vec3 middle = box_.in_mesh.rotation.transpose() * ((box_min + box_max) / 2 - box_.in_mesh.translation);
  return (middle.array() - half.array() <= box_.most.array()).all() &&
         (middle.array() + half.array() >= box_.least.array()).all();
}

std::optional<TrianglePoint> Enclosed::way_out(const PlacedMeshShape& mesh, const Placed& body, const Vec3& centre,
                                               const Vec3& moved) {
  const bool is_first = state_ == State::Unknown;
  state_ = State::Outside;
  if (!mesh.shape->is_solid()) return std::nullopt;
  const Pose mesh_in_world = orthonormal(mesh.in_world), body_in_world = orthonormal(body.in_world);
  const Vec3 in_world = transform(body_in_world, centre), asked = is_first ? Vec3(in_world - moved) : in_world;
  const Body point = Body::point(transform(inverse(mesh_in_world), asked));
  if (intersects(mesh.core(), point, Pose{}).verdict != Verdict::Overlapping) return std::nullopt;
  const MeshBody rounded = MeshBody::solid(mesh.mesh(), mesh.radius());
  const Answer answer = signed_distance(rounded, body.body, relative(mesh_in_world, body_in_world));
  if (answer.normal.hasNaN() || !std::isfinite(answer.lower)) return std::nullopt;
  state_ = State::Inside;
  const Vec3 out = mesh_in_world.rotation * answer.normal;
  return TrianglePoint{-out, in_world, in_world - out * answer.lower, answer.lower, 0, true};
}

/// One step of a pair, in A's frame.
struct MeshPair::Step {
  Step(const PlacedMeshShape& of_a, const PlacedMeshShape& of_b, const Vec3& moved, const std::optional<Pose>& before,
       double beyond_)
      : a(of_a),
        b(of_b),
        a_in_world(orthonormal(of_a.in_world)),
        b_in_a(relative(a_in_world, orthonormal(of_b.in_world))),
        b_in_a_before(before ? *before : b_in_a),
        moved_in_a(a_in_world.rotation.transpose() * moved),
        beyond(beyond_),
        radii(of_a.radius() + of_b.radius()) {
    if (!before) b_in_a_before.translation += moved_in_a;
  }

  const PlacedMeshShape &a, &b;
  const Pose a_in_world, b_in_a;
  Pose b_in_a_before;
  const Vec3 moved_in_a;
  const double beyond, radii;
  bool meet = false;  ///< the bodies without their margins do
};

/// The vertices of one mesh as places of contact with the surface of the other.
class MeshPair::Corners {
 public:
  Corners(MeshPair& pair, const Step& step, bool of_a)
      : pair_(pair),
        step_(step),
        of_a_(of_a),
        own_(of_a ? step.a : step.b),
        other_(of_a ? step.b : step.a),
        in_other_(of_a ? inverse(step.b_in_a) : step.b_in_a),
        in_other_before_(of_a ? inverse(step.b_in_a_before) : step.b_in_a_before),
        through_(pair.through_[of_a ? 0 : 1]),
        near_(pair.near_) {}

  void add_points() {
    gather();
    near_.through.clear();
    for (const Candidate& c : near_.candidates) {
      if (look(c)) near_.through.push_back(c.vertex);
    }
    through_.swap(near_.through);
  }

 private:
  /// The triangles of the regions, and the own vertices there.
  void gather() {
    const MeshModel& mesh = own_.mesh();
    near_.own.clear(), near_.other.clear(), near_.others.clear(), near_.candidates.clear();
    for (const MeshContact& region : pair_.regions_) {
      const Vec3 middle = (region.box_min + region.box_max) / 2, before = of_a_ ? step_.moved_in_a : -step_.moved_in_a;
      const double around = (transform(in_other_, middle) - transform(in_other_before_, middle)).norm() + before.norm();
      const auto box = [&](double slack, bool in_a) {
        const Vec3 more = Vec3::Constant(slack);
        return SearchBox{region.box_min - more, region.box_max + more, in_a ? Pose{} : inverse(step_.b_in_a)};
      };
      const auto inside = [&](const Vec3& p) { return holds(region, of_a_ ? p : transform(step_.b_in_a, p), around); };
      for_triangles(mesh, box(around, of_a_), [&](std::uint32_t t, const Vec3& p, const Vec3& q, const Vec3& r) {
        near_.own.add(p, q, r);
        const auto [i, j, k] = mesh.triangle(t);
        if (inside(p)) near_.candidates.push_back({i, t});
        if (inside(q)) near_.candidates.push_back({j, t});
        if (inside(r)) near_.candidates.push_back({k, t});
      });
      if (!other_.shape) continue;
      const auto add_other = [&](std::uint32_t t, const Vec3& p, const Vec3& q, const Vec3& r) {
        near_.other.add(p, q, r), near_.others.push_back(t);
      };
      for_triangles(other_.mesh(), box(2 * around + reach(), !of_a_), add_other);
    }
    auto& all = near_.candidates;
    for (const std::uint32_t v : through_) all.push_back({v, kNone});
    std::sort(all.begin(), all.end(), [](const Candidate& c, const Candidate& d) {
      return std::pair(c.vertex, c.triangle) < std::pair(d.vertex, d.triangle);
    });
    const auto is_same = [](const Candidate& c, const Candidate& d) { return c.vertex == d.vertex; };
    all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  }

  /// What is known of a vertex, in the other body's frame.
  struct Known {
    bool is_through = false;
    double apart = HUGE_VAL;  ///< from the surface, below 0 where the vertex is beyond it
    Vec3 up = Vec3::Zero();   ///< unit, away from the surface; 0 unless it is near and known
    std::uint32_t triangle = kNone;
  };

  /// Adds the contact of a vertex, if it is one. Returns whether it is beyond the other surface.
  bool look(const Candidate& c) {
    const Vec3 own = own_.mesh().vertex(c.vertex), p = transform(in_other_, own);
    const bool was_through = std::binary_search(through_.begin(), through_.end(), c.vertex);
    const Known near = other_.shape ? near_mesh(p, transform(in_other_before_, own), was_through) : near_convex(p);
    const double separation = near.apart - step_.radii;
    if (near.up == Vec3::Zero() || separation > step_.beyond) return near.is_through;
    const Vec3 up = in_other_.rotation.transpose() * near.up;  // in the own frame
    if (!near_.own.is_supported(own, -up, kOnePlace * own_.mesh().extent())) return near.is_through;
    const PointIds ids{id_of(own_, c.triangle), id_of(other_, near.triangle)};
    if (of_a_) {
      const Vec3 on_own = own - up * own_.radius();
      pair_.add(step_, -up, on_own, on_own - up * separation, separation, ids);
    } else {
      const Vec3 on_own = p - near.up * own_.radius();
      pair_.add(step_, near.up, on_own - near.up * separation, on_own, separation, {ids.second, ids.first});
    }
    return near.is_through;
  }

  Known near_convex(const Vec3& p) {
    Known near;
    const Answer answer =
        signed_distance(without_radius(other_.convex), Body::point(p), Pose{}, seed_.pair, {.beyond = reach()});
    if (answer.status == Status::Beyond || answer.normal.hasNaN()) return near;
    near.apart = answer.lower, near.up = answer.normal;
    return near;
  }

  Known near_mesh(const Vec3& p, const Vec3& before, bool was_through) {
    const MeshModel& mesh = other_.mesh();
    const bool is_solid = other_.is_solid();
    const double one_place = kOnePlace * mesh.extent(), way = is_solid ? 0 : (p - before).norm();
    Known near;
    near.is_through = is_solid ? step_.meet && intersects(other_.core(), Body::point(p), Pose{}).verdict == Verdict::Overlapping
                               : was_through;
    const auto place = near.is_through ? nearest_of_all(p) : nearest_there(p, std::max(reach(), way + one_place));
    if (!place) return near;
    const double apart = (p - place->point).norm();
    if (way > 0 && apart <= way + one_place && leads_through(mesh, before, p)) near.is_through = !was_through;
    near.triangle = place->triangle;
    near.apart = near.is_through ? -apart : apart;
    if (apart > one_place)
      near.up = (p - place->point) / near.apart;
    else if (is_solid && near.triangle < mesh.triangle_count())
      near.up = front_of(mesh, near.triangle);  // it lies in the surface
    return near;
  }

  /// By the triangles of the regions, which hold all that is within reach.
  std::optional<SurfacePatch::Place> nearest_there(const Vec3& p, double within) {
    std::optional<SurfacePatch::Place> place = near_.other.nearest_to(p, within);
    if (place) place->triangle = near_.others[place->triangle];
    return place;
  }
  std::optional<SurfacePatch::Place> nearest_of_all(const Vec3& p) {
    const Answer answer = distance(other_.mesh(), Body::point(p), Pose{}, seed_);
    if (answer.point_a.hasNaN()) return std::nullopt;
    return SurfacePatch::Place{seed_.triangle_a, answer.point_a};
  }
  double reach() const { return step_.beyond + step_.radii; }

  MeshPair& pair_;
  const Step& step_;
  const bool of_a_;
  const PlacedMeshShape &own_, &other_;
  const Pose in_other_, in_other_before_;
  std::vector<std::uint32_t>& through_;
  Near& near_;
  MeshSeed seed_;
};

void MeshPair::add(const Step& step, const Vec3& normal, const Vec3& point_a, const Vec3& point_b, double separation,
                   PointIds ids) {
  points_.push_back({step.a_in_world.rotation * normal, transform(step.a_in_world, point_a),
                     transform(step.a_in_world, point_b), separation, std::uint32_t(ids_.size()), true});
  ids_.push_back(ids);
}

/// Adds the points where both surfaces face each other along the region's normal. Where vertices are beyond, they tell whether
/// this leads back; where none is, the region's normal of the step before, or else the way that both came.
void MeshPair::add_region(const Step& step, const MeshContact& region, std::size_t of_vertices) {
  const ManifoldOptions options{.margin = step.beyond, .most_points = kMostManifoldPoints};
  const Manifold all = manifold(step.a.surface(), step.b.surface(), step.b_in_a, region, options);
  if (all.count == 0) return;
  const bool crosses = region.normal.hasNaN();
  Vec3 normal = all.normal, back = Vec3::Zero();
  for (std::size_t i = 0; i < of_vertices; ++i) {
    const TrianglePoint& p = points_[i];
    const bool is_beyond = p.separation < -step.radii;
    const Vec3 in_a = step.a_in_world.rotation.transpose() * (p.point_a - step.a_in_world.translation);
    if (is_beyond && holds(region, in_a, 0)) back += step.a_in_world.rotation.transpose() * p.normal;
  }
  if (back != Vec3::Zero() && back.normalized().dot(normal) < (crosses ? kAlike : 0)) return;
  if (crosses && back == Vec3::Zero()) {
    Vec3 came = step.moved_in_a;
    double nearest = HUGE_VAL;
    for (const Known& known : known_) {
      if (const double away = (known.place - region.point_a).norm(); away < nearest) nearest = away, came = known.normal;
    }
    if (came.dot(normal) < 0) normal = -normal;
  }
  found_.push_back({region.point_a, normal});
  const PointIds ids{id_of(step.a, region.triangle_a), id_of(step.b, region.triangle_b)};
  for (std::uint32_t i = 0; i < all.count; ++i) {
    const ManifoldPoint& p = all.points[i];
    add(step, normal, p.point_a, p.point_a + normal * p.separation, p.separation, ids);
  }
}

/// Adds the shortest way that is known to lead out of a solid, at the centre of the smaller body, which it does not turn.
bool MeshPair::add_way_out(const Step& step) {
  const Answer out = signed_distance(step.a.core(), step.b.core(), step.b_in_a);
  if (out.normal.hasNaN() || !std::isfinite(out.lower)) return false;
  const bool at_b = step.b.shape && step.b.mesh().extent() < step.a.mesh().extent();
  const MeshModel& smaller = (at_b ? step.b : step.a).mesh();
  const Vec3 middle = (smaller.box_min() + smaller.box_max()) / 2;
  const double separation = out.lower - step.radii;
  const Vec3 way = out.normal * separation, place = at_b ? transform(step.b_in_a, middle) : middle;
  add(step, out.normal, at_b ? place - way : place, at_b ? place : place + way, separation, {});
  known_.clear();
  for (auto& through : through_) through.clear();
  return true;
}

std::span<const TrianglePoint> MeshPair::contacts(const PlacedMeshShape& a, const PlacedMeshShape& b, const Vec3& moved,
                                                  double beyond) {
  points_.clear(), ids_.clear();
  Step step(a, b, moved, b_in_a_before_, beyond);
  regions_.resize(std::max<std::size_t>(regions_.capacity(), 16));
  MeshContacts told;
  while ((told = swiftlet::contacts(a.surface(), b.surface(), step.b_in_a, beyond, regions_)).status == Status::Budget &&
         regions_.size() < told.count + 1024)
    regions_.resize(2 * regions_.size());
  regions_.resize(told.stored);
  b_in_a_before_ = step.b_in_a;

  const bool cross = std::any_of(regions_.begin(), regions_.end(), [](const MeshContact& r) { return r.normal.hasNaN(); });
  const bool any_solid = a.is_solid() || b.is_solid();
  step.meet = cross || (any_solid && intersects(a.core(), b.core(), step.b_in_a, seed_).verdict == Verdict::Overlapping);
  nested_ = step.meet && (nested_ || !cross);
  if (nested_ && add_way_out(step)) return points_;
  Corners(*this, step, true).add_points();
  if (b.shape) Corners(*this, step, false).add_points();
  const std::size_t of_vertices = points_.size();
  found_.clear();
  for (const MeshContact& region : regions_) add_region(step, region, of_vertices);
  known_.swap(found_);
  return points_;
}

std::optional<TrianglePoint> MeshPair::nearest(const PlacedMeshShape& a, const PlacedMeshShape& b, double beyond) {
  points_.clear(), ids_.clear();
  const Step step(a, b, Vec3::Zero(), std::nullopt, beyond);
  const MeshBody core_a = a.core(), core_b = b.core();
  const Answer near = distance(core_a, core_b, step.b_in_a, seed_, {.beyond = beyond + step.radii});
  if (near.status == Status::Beyond) return std::nullopt;
  if (near.lower > 0 && !near.normal.hasNaN()) {
    const PointIds ids{id_of(a, seed_.triangle_a), id_of(b, seed_.triangle_b)};
    const Vec3 on_a = near.point_a + near.normal * a.radius();
    const double separation = near.lower - step.radii;
    add(step, near.normal, on_a, on_a + near.normal * separation, separation, ids);
    return points_.front();
  }
  contacts(a, b, Vec3::Zero(), std::min(beyond, 0.));
  if (points_.empty()) return std::nullopt;
  return *std::min_element(points_.begin(), points_.end(),
                           [](const TrianglePoint& p, const TrianglePoint& q) { return p.separation < q.separation; });
}

void contacts(const PlacedMeshShape& a, const HalfSpace& b, double beyond, std::vector<TrianglePoint>& points,
              std::vector<PointIds>& ids) {
  const Pose in_world = orthonormal(a.in_world);
  const Vec3 up = in_world.rotation.transpose() * b.normal;
  const double ground = b.offset - b.normal.dot(in_world.translation);  // of the plane, along `up`
  const double highest = ground + a.radius() + beyond;
  points.clear(), ids.clear();
  const auto add = [&](std::uint32_t t) {
    for (const std::uint32_t v : a.mesh().triangle(t)) {
      const Vec3 p = a.mesh().vertex(v);
      const double height = up.dot(p), separation = height - ground - a.radius();
      if (height > highest) continue;
      const Vec3 point = transform(in_world, p) - b.normal * a.radius();
      points.push_back({-b.normal, point, point - b.normal * separation, separation, std::uint32_t(ids.size()), true});
    }
    ids.push_back({id_of(a, t), {}});
    return true;
  };
  struct Visitor final : MeshVisitor {
    Visitor(const Vec3& up_, double highest_, const decltype(add)& to) : up(up_), highest(highest_), visited(to) {}
    bool enters(const Vec3& box_min, const Vec3& box_max) override {
      return up.cwiseMax(0).dot(box_min) + up.cwiseMin(0).dot(box_max) <= highest;
    }
    bool visit(std::uint32_t t) override { return visited(t); }
    const Vec3& up;
    const double highest;
    const decltype(add)& visited;
  } visitor(up, highest, add);
  visit_triangles(a.mesh(), visitor);
}

}  // namespace swiftlet::bullet
