// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers recomputed pair by pair without the trees, and trees without a query.
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include <swiftlet/depth.h>

#include "body/half_edge.h"
#include "body/shape.h"
#include "inside.h"
#include "mesh_block.h"
#include "numeric/tolerance.h"
#include "numeric/wide.h"
#include "query/radii.h"
#include "search.h"
#include "weld.h"

namespace swiftlet {
namespace {

bool is_unit(const Vec3& n) {
  const Wide wide_n = wide(vec(n));
  return std::fabs(double(dot(wide_n, wide_n) - 1.0)) <= kUnitError;
}

/// Whether a query takes it as a point; coordinates too small for one count as 0.
bool is_point(const Vec3& p) {
  const Vec q = legal(vec(p));
  return is_legal_coordinate(q.x) && is_legal_coordinate(q.y) && is_legal_coordinate(q.z);
}
Body point_at(const Vec3& p, double radius = 0) { return Body::point(eigen(legal(vec(p))), radius); }

/// The convex parts of a body, each with the body's radius.
struct Parts {
  explicit Parts(const MeshBody& body) : of(body), count(body.mesh() ? body.mesh()->triangle_count() : 1) {}
  Body operator[](std::size_t i) const {
    if (!of.mesh()) return of.convex();
    const std::array<std::uint32_t, 3> corners = of.mesh()->triangle(i);
    const auto at = [&](std::size_t k) { return of.mesh()->vertex(corners[k]); };
    return Body::triangle(at(0), at(1), at(2), of.radius());
  }
  /// How far points of a convex body's level may be off the body; of a mesh 0.
  double deviation(int level) const {
    if (of.mesh()) return 0;
    const ShapeOf shape(of.convex());
    return (*shape).level(level).deviation;
  }
  /// The part that a feature belongs to, as a body without a radius: a point, a segment or a triangle; of a convex body all.
  Body feature(FeatureId id) const {
    if (!of.mesh()) return of.convex();
    const std::uint32_t i = id.index();
    const auto at = [&](std::uint32_t v) { return of.mesh()->vertex(v); };
    if (id.kind() == FeatureKind::Vertex) return Body::point(at(i));
    const std::array<std::uint32_t, 3> c = of.mesh()->triangle(id.kind() == FeatureKind::Edge ? i / 3 : i);
    if (id.kind() == FeatureKind::Edge) return Body::segment(at(c[i % 3]), at(c[(i + 1) % 3]));
    return Body::triangle(at(c[0]), at(c[1]), at(c[2]));
  }
  bool has_level(int level) const { return level >= 0 && level < (of.mesh() ? 1 : (*ShapeOf(of.convex())).level_count()); }
  /// `loose`: of an answer that balls may have given, which names no feature of a convex body.
  bool names(FeatureId id, int level, bool loose) const {
    if (!has_level(level)) return false;
    if (!of.mesh()) {
      const ShapeOf shape(of.convex());
      return (loose && id.kind() == FeatureKind::None) || names_feature((*shape).level(level).view, id);
    }
    const std::size_t triangles = of.mesh()->triangle_count();
    return id.kind() == FeatureKind::Vertex ? id.index() < of.mesh()->vertex_count()
           : id.kind() == FeatureKind::Edge ? id.index() < 3 * triangles
                                            : id.kind() == FeatureKind::Face && id.index() < triangles;
  }
  /// Whether a body that does not meet the surface of this solid has a part inside.
  bool encloses(const MeshBody& guest, const Pose& b_in_a, bool is_b) const {
    if (!of.is_solid()) return false;
    const Enclosure volume(MeshReader::content(*of.mesh()), b_in_a, is_b);
    if (!guest.mesh()) return volume.holds_without_tree(ConvexLeaf(guest.convex()).point);
    const MeshReader::Content& content = MeshReader::content(*guest.mesh());
    return std::any_of(content.triangles.begin(), content.triangles.end(),
                       [&](const Corners& corners) { return volume.holds_without_tree(content.vertices[corners[0]]); });
  }
  /// The greatest height of the body along `n`, a direction of the frame that `at` moves it into.
  double top(const Vec3& n, const Pose& at) const {
    double most = -HUGE_VAL;
    const auto add = [&](const Vec3& p) { most = std::max(most, n.dot(at.rotation * p + at.translation)); };
    if (of.mesh()) {
      for (std::size_t v = 0; v < of.mesh()->vertex_count(); ++v) add(of.mesh()->vertex(v));
    } else {
      const ShapeOf shape(of.convex());
      const Model* const model = of.convex().model();  // whose finest level holds the body
      for (const Vertex& v : (*shape).level(model ? model->finest_level() : 0).view.vertices) add(eigen(vec(v)));
    }
    return most + n.norm() * of.radius();
  }
  /// A lower bound on the distance of a point, in A's frame, from the body, of a solid from its volume. Infinite where a query
  /// would refuse the point.
  double distance_to(const Vec3& p, const Pose& at, bool is_b) const {
    if (!is_point(p)) return HUGE_VAL;
    if (of.is_solid() && Enclosure(MeshReader::content(*of.mesh()), at, is_b).holds_without_tree(vec(p))) return 0;
    const Body point = point_at(p);
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) {
      const Body part = (*this)[i];
      least = std::min(least, (is_b ? distance(point, part, at) : distance(part, point, at)).lower);
    }
    return least;
  }
  /// An upper bound on the radius of a ball around a point, in A's frame, that lies in the body. The point must lie in it.
  double free_ball(const Vec3& p, const Pose& at, bool is_b) const {
    if (!of.mesh()) {
      const Body point = point_at(p);
      return std::max(0.0, -(is_b ? signed_distance(point, of.convex(), at) : signed_distance(of.convex(), point, at)).lower);
    }
    if (!of.is_solid() || !Enclosure(MeshReader::content(*of.mesh()), at, is_b).holds_without_tree(vec(p))) return of.radius();
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) {
      const MeshBody plain(*of.mesh());
      const Body part = Parts(plain)[i], point = point_at(p);
      least = std::min(least, (is_b ? distance(point, part, at) : distance(part, point, at)).upper);
    }
    return least + of.radius();
  }

  const MeshBody& of;
  std::size_t count;
};

bool unknown(const Vec3& v) { return std::isnan(v[0]) && std::isnan(v[1]) && std::isnan(v[2]); }

/// Whether the bodies overlap, or one is a model whose finest level leaves that open.
bool may_meet(const Parts& a, const Parts& b, const Pose& b_in_a) {
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t k = 0; k < b.count; ++k) {
      const Verdict verdict = distance(a[i], b[k], b_in_a).verdict;
      if (verdict == Verdict::Overlapping || verdict == Verdict::Undecided) return true;
    }
  }
  return a.encloses(b.of, b_in_a, false) || b.encloses(a.of, b_in_a, true);
}

/// What is wrong with the interval of an answer about a depth; "" if nothing.
std::string depth_fault(const Parts& a, const Parts& b, const Pose& b_in_a, const Answer& answer, double law_two) {
  std::ostringstream text;
  text.precision(17);
  if (answer.lower > -HUGE_VAL) {
    const Vec3& n = answer.normal;
    if (!is_unit(n)) return "the normal is no unit vector";
    const bool by_plane = a.top(n, {}) + b.top(-n, b_in_a) + answer.lower <= law_two;
    if (!by_plane && may_meet(a, b, {b_in_a.rotation, b_in_a.translation + (law_two - answer.lower) * n}))
      text << "moved by " << -answer.lower << " along the normal, the bodies still meet";
  }
  double upper = HUGE_VAL;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t k = 0; k < b.count; ++k) upper = std::min(upper, signed_distance(a[i], b[k], b_in_a).lower);
  }
  if (a.encloses(b.of, b_in_a, false) || b.encloses(a.of, b_in_a, true)) upper = std::min(upper, 0.0);
  const Vec3& p = answer.point_a;
  if (answer.verdict == Verdict::Overlapping && a.distance_to(p, {}, false) <= law_two &&
      b.distance_to(p, b_in_a, true) <= law_two)
    upper = std::min(upper, -a.free_ball(p, {}, false) - b.free_ball(p, b_in_a, true));
  if (!(answer.upper >= upper - law_two)) text << "upper is " << answer.upper << " where only " << upper << " is proved";
  return text.str();
}

}  // namespace

Check check(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Answer& answer) {
  const auto fail = [](const auto&... words) {
    std::ostringstream text;
    text.precision(17);
    (text << ... << words);
    return Check{false, text.str()};
  };
  const double law_two = tolerance(a, b, b_in_a);
  if (std::isnan(law_two)) {
    return answer.status >= Status::InvalidPose ? Check{true, ""}
                                                : fail("the bodies or the pose are refused, the answer is not");
  }
  if (answer.status == Status::NotAsked || answer.status >= Status::InvalidPose) return fail("the answer says nothing");
  for (const MeshBody* body : {&a, &b}) {
    if (body->mesh() && !body->mesh()->is_whole()) return fail("the triangles of a mesh that was cut are not there");
  }
  if (!(answer.upper >= answer.lower)) return fail("[", answer.lower, ", ", answer.upper, "] is no interval");
  if (Radii(answer) != Radii(a.radius(), b.radius())) return fail("the answer is of other radii");
  const bool has_normal = !unknown(answer.normal), has_points = !unknown(answer.point_a) || !unknown(answer.point_b);
  if (has_normal && !is_unit(answer.normal)) return fail("the normal is no unit vector");
  if (has_points && !(is_point(answer.point_a) && is_point(answer.point_b))) return fail("a point is no point");
  const Parts of_a(a), of_b(b);
  if (answer.is_signed && !(answer.lower > 0)) {
    if (const std::string fault = depth_fault(of_a, of_b, b_in_a, answer, law_two); !fault.empty()) return fail(fault);
    Answer met = answer;
    met.is_signed = false, met.lower = 0, met.upper = std::max(answer.upper, 0.0);
    return check(a, b, b_in_a, met);
  }
  double lower = HUGE_VAL, upper = HUGE_VAL, touching_depth = 0;
  bool overlapping = false;
  for (std::size_t i = 0; i < of_a.count; ++i) {
    for (std::size_t k = 0; k < of_b.count; ++k) {
      const Answer pair = distance(of_a[i], of_b[k], b_in_a);
      lower = std::min(lower, pair.lower), upper = std::min(upper, pair.upper);
      if (pair.verdict != Verdict::Overlapping) continue;
      overlapping = true;
      if (answer.verdict == Verdict::Touching)
        touching_depth = std::max(touching_depth, -signed_distance(of_a[i], of_b[k], b_in_a).upper);
    }
  }
  if (lower > 0 && !overlapping && (of_a.encloses(b, b_in_a, false) || of_b.encloses(a, b_in_a, true))) {
    if (answer.verdict == Verdict::Touching && lower > law_two) return fail("Touching, but one body is inside the other");
    lower = upper = 0, overlapping = true;
  }
  // Each bound here is within law 2's bound of the truth, and so is what the answer may claim.
  if (!(answer.lower <= upper)) return fail("lower is ", answer.lower, " where the distance is at most ", upper);
  if (!(answer.upper >= lower)) return fail("upper is ", answer.upper, " where the distance is at least ", lower);
  if (answer.verdict == Verdict::Disjoint && overlapping) return fail("Disjoint, but two triangles cross");
  if (answer.verdict == Verdict::Overlapping && !(upper <= law_two)) return fail("Overlapping, ", lower, " apart");
  if (answer.verdict == Verdict::Touching && !(lower <= law_two)) return fail("Touching, ", lower, " apart");
  if (touching_depth > law_two) return fail("Touching, but two parts are ", touching_depth, " in each other");
  if (answer.verdict == Verdict::Undecided && answer.lower > 0) return fail("undecided with a lower bound of ", answer.lower);
  // Of bodies that meet, the points may be any one that they share, and a body all around it has no feature there.
  const bool shared = (answer.point_b - answer.point_a).norm() <= law_two && lower <= law_two;
  const bool exact = answer.upper - answer.lower <= law_two;
  if (answer.verdict == Verdict::Overlapping || shared) {
    const auto names = [](const Parts& of, FeatureId id, int level) {
      return of.has_level(level) && (id.kind() == FeatureKind::None || of.names(id, level, true));
    };
    if (!names(of_a, answer.feature_a, answer.level_a) || !names(of_b, answer.feature_b, answer.level_b))
      return fail("a feature that does not exist");
    if (!has_points) return {true, ""};
    if (const double off = of_a.distance_to(answer.point_a, {}, false) - of_a.deviation(answer.level_a); off > law_two)
      return fail("point_a is ", off, " off its body");
    if (const double off = of_b.distance_to(answer.point_b, b_in_a, true) - of_b.deviation(answer.level_b); off > law_two)
      return fail("point_b is ", off, " off its body");
  } else if (answer.upper < HUGE_VAL) {
    if (!of_a.names(answer.feature_a, answer.level_a, !exact) || !of_b.names(answer.feature_b, answer.level_b, !exact))
      return fail("a feature that does not exist");
    const Body points[] = {point_at(answer.point_a, answer.radius_a), point_at(answer.point_b, answer.radius_b)};
    if (const double off = distance(of_a.feature(answer.feature_a), points[0], {}).lower;
        !(off <= law_two + of_a.deviation(answer.level_a)))
      return fail("point_a is ", off, " off its feature");
    const Answer far = distance(points[1], of_b.feature(answer.feature_b), b_in_a);
    if (!(far.lower <= law_two + of_b.deviation(answer.level_b))) return fail("point_b is ", far.lower, " off its feature");
    const Vec3 between = answer.point_b - answer.point_a;
    const double coarse = of_a.deviation(answer.level_a) + of_b.deviation(answer.level_b);
    if (!(std::fabs(between.norm() - answer.upper) <= law_two + answer.upper - answer.lower + coarse))
      return fail("the points are ", between.norm(), " apart, upper is ", answer.upper);
    // A loose interval may come with the normal of a plane that parts two parts, of which the points are not the nearest.
    const Vec3 aside = between - between.norm() * answer.normal;
    if (answer.lower > law_two && !(exact ? aside.norm() <= law_two : between.dot(answer.normal) > 0))
      return fail("the normal does not lead from point_a to point_b");
  }
  return {true, ""};
}

Check verify(const MeshModel& mesh) {
  const MeshReader::Content& c = MeshReader::content(mesh);
  const auto fail = [](std::size_t node, const std::string& what) {
    return Check{false, "node " + std::to_string(node) + ": " + what};
  };
  if (!mesh.is_whole()) return {false, "the mesh was cut: nothing tells whether its boxes hold the surface"};
  const std::vector<TriangleRange> below = triangles_below(c.nodes);
  std::vector<bool> seen(c.triangles.size());
  for (std::size_t i = c.nodes.size(); i-- > 0;) {
    const Node& node = c.nodes[i];
    const std::uint32_t first = node.first(), last = first + std::uint32_t(node.count()) - 1;
    for (std::uint32_t child = first; child <= last; ++child) {
      if (node.lowest() && seen[child]) return fail(i, "triangle " + std::to_string(child) + " is in another one too");
      if (node.lowest()) seen[child] = true;
      if (!node.lowest() && child > first && below[child].begin != below[child - 1].end) return fail(i, "children apart");
    }
    const Axes axes = axes_of(node);
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l <= k; ++l) {
        if (!(std::fabs(dot(axes.row[k], axes.row[l]) - (k == l)) <= kAxisError))
          return fail(i, "axes that are not orthonormal");
      }
    }
    const Vec origin{node.origin[0], node.origin[1], node.origin[2]};
    for (int child = 0; child < node.count(); ++child) {
      const std::uint32_t at = first + std::uint32_t(child);
      const TriangleRange range = node.lowest() ? TriangleRange{at, at + 1} : below[at];
      for (std::uint32_t t = range.begin; t < range.end; ++t) {
        for (const std::uint32_t v : c.triangles[t]) {
          const Vec p = scaled(c.vertices[v], -c.header.unit) - origin;
          for (int k = 0; k < 3; ++k) {
            // Off by 4 u of |p| and by u of the vertex and the origin, which the margin of the box holds twice over.
            const double off = std::fabs(dot(axes.row[k], p) - double(node.centre[k][child]));
            if (!(off <= double(node.half[k][child])) ||
                !(off <= double(node.extent[k]) + std::fabs(double(node.centre[k][child]))))
              return fail(i, "triangle " + std::to_string(t) + " reaches out of its box");
            if (!(std::fabs(double(node.centre[k][child])) + double(node.half[k][child]) <= double(node.extent[k])))
              return fail(i, "a child's box reaches out of it");
          }
        }
      }
    }
  }
  if (!(below[0].begin == 0 && below[0].end == c.triangles.size())) return fail(0, "triangles are missing");
  std::vector<std::uint32_t> seen_for(c.vertices.size(), kNone);  // the node
  for (const NodeHull& hull : c.hulls) {
    if (const Check sound = verify(hull.model); !sound) return fail(hull.node, "its hull: " + sound.message);
    // Most are inside, or corners of the hull: what is in a face or on an edge takes exact arithmetic, a millisecond each.
    const Body body(hull.model);
    std::set<std::tuple<double, double, double>> corners;
    for (const Vertex& v : hull.model.level(0).view.vertices) corners.insert({v.x, v.y, v.z});
    for (std::uint32_t t = below[hull.node].begin; t < below[hull.node].end; ++t) {
      for (const std::uint32_t v : c.triangles[t]) {
        const Vec& p = c.vertices[v];
        if (std::exchange(seen_for[v], hull.node) == hull.node || corners.count({p.x, p.y, p.z}) > 0) continue;
        if (intersects(body, Body::point(eigen(p)), {}).verdict == Verdict::Disjoint)
          return fail(hull.node, "triangle " + std::to_string(t) + " reaches out of its hull");
      }
    }
  }
  Soup soup{{c.vertices.begin(), c.vertices.end()}, {}, {c.triangles.begin(), c.triangles.end()}, {}, {}};
  const std::vector<std::uint32_t> first = survey(soup);
  soup.topology.volume = c.topology.volume;  // a sum in another order
  if (soup.topology != c.topology) return {false, "the edges of the mesh are others"};
  std::set<std::uint32_t> components;
  for (const std::uint32_t t : c.shells) components.insert(first[t]);
  if (components.size() != soup.shells.size()) return {false, "a component has no triangle among the shells"};
  Vec3 least = mesh.vertex(c.triangles[0][0]), most = least;
  for (const Corners& corners : c.triangles) {
    for (const std::uint32_t v : corners) least = least.cwiseMin(mesh.vertex(v)), most = most.cwiseMax(mesh.vertex(v));
  }
  if (least != mesh.box_min() || most != mesh.box_max()) return {false, "the box of the mesh is another"};
  if (c.header.unit != unit_of(mesh.extent())) return {false, "the unit of the mesh is another"};
  return {true, ""};
}

}  // namespace swiftlet
