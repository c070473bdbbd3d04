// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A component of a surface is connected: if it is apart from the other surface, one of its points tells where it is.
#include "solid.h"

#include "body/shape.h"
#include "boxes.h"
#include "inside.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {

/// So many vertices of a body that touches a solid are tried, and so far from the triangle that touches, over the root of its
/// area, are points beside it.
constexpr std::uint32_t kTriedVertices = 32;
constexpr double kBeside[] = {0x1p-4, -0x1p-4, 0x1p-10, -0x1p-10};

/// What a guest may have inside a solid.
class Visit {
 public:
  Visit(const MeshView& solid, const MeshView& guest, const Pose& b_in_a, bool solid_is_b, const MeshQuestion& question,
        MeshFinding& finding)
      : solid_(solid),
        guest_(guest),
        pose_(b_in_a),
        solid_is_b_(solid_is_b),
        question_(question),
        finding_(finding),
        volume_(*solid.content, b_in_a, solid_is_b) {}

  /// Of surfaces that are apart.
  bool of_components() {
    const auto inside = [&](const Vec& p, FeatureId feature) { return volume_.holds(p) && meet(p, feature); };
    if (!guest_.content) return inside(guest_.convex->point, {});
    for (const std::uint32_t t : guest_.content->shells) {
      const std::uint32_t v = guest_.triangles[t][0];
      if (inside(guest_.vertices[v], {FeatureKind::Vertex, v})) return true;
    }
    return false;
  }

  /// Of surfaces that may touch.
  bool of_some_points() {
    const auto deep = [&](const Vec& p, FeatureId feature) { return volume_.holds(p) && is_off(p) && meet(p, feature); };
    if (!guest_.content) {
      const ShapeOf shape(guest_.convex->body);
      const std::span<const Vertex> vertices = (*shape).level(0).view.vertices;
      if (vertices.empty()) return deep(guest_.convex->point, {});  // of a model without level 0
      Vec sum{0, 0, 0};
      for (const Vertex& v : vertices) sum = sum + vec(v) * (1 / double(vertices.size()));
      return deep(sum, {}) ||
             spread(std::uint32_t(vertices.size()), [&](std::uint32_t v) { return deep(vec(vertices[v]), {}); });
    }
    for (const std::uint32_t t : guest_.content->shells) {
      const std::uint32_t v = guest_.triangles[t][0];
      if (deep(guest_.vertices[v], {FeatureKind::Vertex, v})) return true;
    }
    if (spread(guest_.content->header.vertex_count, [&](std::uint32_t v) {
          return deep(guest_.vertices[v], {FeatureKind::Vertex, v});
        }))
      return true;
    const std::uint32_t touching = solid_is_b_ ? finding_.triangle_a : finding_.triangle_b;
    if (touching == kNone) return false;
    const Corners& corners = guest_.triangles[touching];
    for (const std::uint32_t v : corners) {
      if (deep(guest_.vertices[v], {FeatureKind::Vertex, v})) return true;
    }
    if (!guest_.solid) return false;
    const Enclosure own(*guest_.content, Pose(), false);
    const Vec &p = guest_.vertices[corners[0]], &q = guest_.vertices[corners[1]], &r = guest_.vertices[corners[2]];
    const Vec middle = p * (1.0 / 3) + q * (1.0 / 3) + r * (1.0 / 3);
    const Vec n = normalised(cross(q - p, r - p));
    const double size = std::sqrt(norm(q - p) * norm(r - p));
    for (const double share : kBeside) {
      const Vec beside = legal(middle + n * (share * size));
      if (own.holds(beside) && deep(beside, {})) return true;
    }
    // Of solids whose vertices all lie in each other's faces, as boxes moved along a side.
    const Vec between = middle_in_common();
    return own.holds(between) && deep(between, {});
  }

 private:
  /// Calls `tried` with up to `kTriedVertices` of `count` numbers, evenly spread, until it returns true.
  template <class Tried>
  static bool spread(std::uint32_t count, const Tried& tried) {
    const std::uint32_t step = count / kTriedVertices + 1;
    for (std::uint32_t i = 0; i < count; i += step) {
      if (tried(i)) return true;
    }
    return false;
  }
  static Box box_around(const MeshView& mesh) {
    const MeshHeader& h = mesh.content->header;
    return {{h.box_min[0], h.box_min[1], h.box_min[2]}, {h.box_max[0], h.box_max[1], h.box_max[2]}};
  }
  /// The middle of what the guest's box and the one around the solid's, in the guest's frame, have in common.
  Vec middle_in_common() const {
    const Motion to_guest = swiftlet::motion(solid_is_b_ ? pose_ : inverse(pose_));
    const Box box = box_around(solid_);
    Box turned;
    for (int i = 0; i < 8; ++i) {
      const Vec corner{(i & 1 ? box.most : box.least).x, (i & 2 ? box.most : box.least).y, (i & 4 ? box.most : box.least).z},
          at = apply(to_guest, corner);
      turned = i == 0 ? Box{at, at} : around(turned, {at, at});
    }
    const Box both = common(box_around(guest_), turned);
    return legal((both.least + both.most) * 0.5);
  }
  /// True if a point of the guest is farther than law 2's bound from the solid's surface.
  bool is_off(const Vec& p) const {
    const MeshView point(MeshBody(Body::point(eigen(p))));
    MeshSeed cold;
    MeshFinding found;
    const StopRule beyond{0, 0, 2 * question_.law_two, question_.law_two};
    search(solid_is_b_ ? point : solid_, solid_is_b_ ? solid_ : point, pose_,
           {beyond, question_.law_two, question_.size, ~std::uint32_t{0}}, cold, found);
    finding_.nodes += found.nodes, finding_.triangles += found.triangles;
    return found.lower > question_.law_two;
  }
  bool meet(const Vec& p, FeatureId feature) {
    finding_.verdict = Verdict::Overlapping;
    finding_.lower = finding_.upper = 0;
    finding_.point_a = finding_.point_b = solid_is_b_ ? p : apply(swiftlet::motion(pose_), p);
    finding_.normal = {0, 0, 0};
    finding_.feature_a = solid_is_b_ ? feature : FeatureId();
    finding_.feature_b = solid_is_b_ ? FeatureId() : feature;
    finding_.level_a = finding_.level_b = 0;
    return true;
  }

  const MeshView &solid_, &guest_;
  const Pose& pose_;
  const bool solid_is_b_;
  const MeshQuestion& question_;
  MeshFinding& finding_;
  const Enclosure volume_;
};

/// True if the surfaces are too far apart for one body to be inside the other: of a point inside, a side of the box is no
/// farther than half the box is wide. The margin is more than a legal pose stretches lengths by.
bool too_far_apart(const MeshView& solid, double lower) {
  const MeshHeader& h = solid.content->header;
  double width = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) width = min(width, h.box_max[axis] - h.box_min[axis]);
  return lower > 0.501 * width;
}

}  // namespace

void look_inside(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshFinding& finding) {
  for (const bool solid_is_b : {false, true}) {
    const MeshView &solid = solid_is_b ? b : a, &guest = solid_is_b ? a : b;
    if (!solid.solid || too_far_apart(solid, finding.lower)) continue;
    if (guest.content && guest.triangle_count == 0) {
      // Nothing tells where its components are, unless a plane parts all of it from the solid.
      QueryPose placed;
      if (!(gap_of_roots({*a.root, *a.nodes}, {*b.root, *b.nodes}, b_in_a, 0, placed) > 0)) finding.lower = 0;
      continue;
    }
    Visit visit(solid, guest, b_in_a, solid_is_b, question, finding);
    if (finding.lower > 0 ? visit.of_components() : visit.of_some_points()) return;
  }
}

}  // namespace swiftlet
