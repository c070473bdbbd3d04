// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts triangles by exact signs. A sign that is 0 is that of what the infinitesimal vector, epsilon along x, its square along
// y and its cube along z, makes of it [Edelsbrunner & Muecke 1990]: of the first coordinate that is not 0 of a normal.
#include "through.h"

#include <cmath>

#include <swiftlet/mesh_visit.h>

#include "numeric/exact.h"
#include "numeric/tolerance.h"

namespace swiftlet::bullet {
namespace {

/// The point with coordinates that no mesh may have put to 0.
Vec3 legal(const Vec3& p) {
  return p.unaryExpr([](double x) { return std::fabs(x) < kLeastCoordinate ? 0 : x; });
}

/// The sign of the first coordinate of (b - a) x (d - c) that is not 0; 0 if all are.
int leading_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec n = rounded(exact::edge_normal(a.data(), b.data(), kAtRest, d.data(), c.data()));
  const double first = n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
  return (first > 0) - (first < 0);
}

struct Triangle {
  Triangle(const MeshModel& mesh, std::uint32_t index) {
    const auto corners = mesh.triangle(index);
    p = mesh.vertex(corners[0]), q = mesh.vertex(corners[1]), r = mesh.vertex(corners[2]);
  }
  /// On which side a point is.
  int side(const Vec3& of) const { return exact::orientation(p.data(), q.data(), r.data(), of.data()); }
  bool in_plane_of(const Triangle& t) const { return t.side(p) == 0 && t.side(q) == 0 && t.side(r) == 0; }

  Vec3 p, q, r;
};

struct Way {
  bool crosses(const Triangle& t) const {
    const auto side = [&](const Vec3& of) {
      const int sign = t.side(of);
      return sign != 0 ? sign : leading_sign(t.p, t.q, t.p, t.r);
    };
    if (side(from) == side(to)) return false;
    const int turn = passes(t.p, t.q);
    return passes(t.q, t.r) == turn && passes(t.r, t.p) == turn;
  }
  /// On which side the line through both ends passes the line from u to v.
  int passes(const Vec3& u, const Vec3& v) const {
    const int sign = exact::orientation(from.data(), to.data(), u.data(), v.data());
    return sign != 0 ? sign : leading_sign(from, to, u, v);
  }

  Vec3 from, to;
};

/// Calls `on_crossed(index, triangle)` for each triangle that the way crosses.
template <class OnCrossed>
void for_crossed(const MeshModel& mesh, const Way& way, const OnCrossed& on_crossed) {
  struct Visitor final : MeshVisitor {
    Visitor(const MeshModel& m, const Way& w, const OnCrossed& f) : mesh(m), way(w), on_crossed(f) {}
    bool enters(const Vec3& box_min, const Vec3& box_max) override {
      return (least.array() <= box_max.array()).all() && (most.array() >= box_min.array()).all();
    }
    bool visit(std::uint32_t index) override {
      if (const Triangle triangle(mesh, index); way.crosses(triangle)) on_crossed(index, triangle);
      return true;
    }
    const MeshModel& mesh;
    const Way& way;
    const OnCrossed& on_crossed;
    const Vec3 least = way.from.cwiseMin(way.to), most = way.from.cwiseMax(way.to);
  } visitor(mesh, way, on_crossed);
  visit_triangles(mesh, visitor);
}

}  // namespace

bool leads_through(const MeshModel& mesh, const Vec3& from, const Vec3& to) {
  const Way way{legal(from), legal(to)};
  bool is_odd = false;
  for_crossed(mesh, way, [&](std::uint32_t index, const Triangle& triangle) {
    bool is_first = true;  // in its plane
    for_crossed(mesh, way, [&](std::uint32_t other, const Triangle& beside) {
      is_first = is_first && (other >= index || !beside.in_plane_of(triangle));
    });
    is_odd ^= is_first;
  });
  return is_odd;
}

}  // namespace swiftlet::bullet
