// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl_mesh.h>

#include <algorithm>
#include <stdexcept>

#include <swiftlet/mesh_contacts.h>
#include <swiftlet/world.h>

namespace swiftlet::fcl {
namespace {

/// Both bodies in A's frame.
struct Setting {
  Setting(const PlacedMesh& a, const PlacedMesh& b)
      : a_in_world(orthonormal(a.in_world)), b_in_a(relative(a_in_world, orthonormal(b.in_world))) {}
  /// All regions where the surfaces cross, or touch: are no farther apart than `touching`.
  std::vector<MeshContact> regions(const PlacedMesh& a, const PlacedMesh& b, double touching) const {
    std::vector<MeshContact> found(16);
    MeshContacts told;
    while ((told = contacts(a.body, b.body, b_in_a, touching, found)).status == Status::Budget)
      found.resize(std::max<std::size_t>(2 * found.size(), told.count));
    found.resize(told.stored);
    std::erase_if(found, [touching](const MeshContact& region) { return region.lower > touching; });
    return found;
  }
  Vec3 in_world(const Vec3& p_a) const { return a_in_world.rotation * p_a + a_in_world.translation; }

  Pose a_in_world, b_in_a;
};

int users_triangle(const MeshBody& of, std::uint32_t triangle) {
  return of.mesh() && triangle < of.mesh()->triangle_count() ? int(of.mesh()->source_triangle()[triangle]) : -1;
}

MeshMeeting in_world(const PlacedMesh& a, const PlacedMesh& b, const Setting& at, const Answer& answer, const MeshSeed& seed) {
  return {answer.status,
          answer.verdict,
          answer.lower,
          users_triangle(a.body, seed.triangle_a),
          users_triangle(b.body, seed.triangle_b),
          at.in_world(answer.point_a),
          at.in_world(answer.point_b)};
}

}  // namespace

MeshHolder::MeshHolder(const MeshModel& mesh) : mesh_(mesh) {
  if (!mesh.is_whole()) throw std::invalid_argument("the mesh was cut: it has no triangles");
}

std::vector<std::array<std::uint32_t, 3>> triangles_in_users_order(const MeshModel& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles(mesh.triangle_count());
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[mesh.source_triangle()[i]] = mesh.triangle(i);
  return triangles;
}

std::vector<MeshTouch> touches_of(const PlacedMesh& a, const PlacedMesh& b) {
  const Setting at(a, b);
  const double touching = tolerance(a.body, b.body, at.b_in_a);
  std::vector<MeshTouch> touches;
  for (const MeshContact& region : at.regions(a, b, touching)) {
    MeshTouch touch{users_triangle(a.body, region.triangle_a), users_triangle(b.body, region.triangle_b)};
    const Manifold points = manifold(a.body, b.body, at.b_in_a, region, {.margin = touching});
    touch.normal = at.a_in_world.rotation * points.normal;
    for (std::uint32_t i = 0; i < points.count; ++i) {
      touch.point = at.in_world((points.points[i].point_a + points.points[i].point_b) / 2);
      touch.depth = std::max(-points.points[i].separation, touching);
      touches.push_back(touch);
    }
  }
  std::stable_sort(touches.begin(), touches.end(), [](const MeshTouch& x, const MeshTouch& y) { return x.depth > y.depth; });
  return touches;
}

MeshMeeting meeting_of(const PlacedMesh& a, const PlacedMesh& b, MeshSeed& seed) {
  const Setting at(a, b);
  return in_world(a, b, at, intersects(a.body, b.body, at.b_in_a, seed), seed);
}

MeshMeeting distance_of(const PlacedMesh& a, const PlacedMesh& b, const Options& options, MeshSeed& seed) {
  const Setting at(a, b);
  return in_world(a, b, at, distance(a.body, b.body, at.b_in_a, seed, options), seed);
}

}  // namespace swiftlet::fcl
