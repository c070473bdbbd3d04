// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about meshes that are made on the spot, for answers.cpp: the same on every machine, and no builder is needed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include "answers.h"
#include "soups.h"

namespace swiftlet::answers {

/// What `contacts` says: how many regions there are, and those that were stored.
struct Regions {
  MeshContacts found;
  std::vector<MeshContact> regions;
};

void visit(const Regions& all, auto&& fields) {
  fields.pair("status", all.found.status, "is_counted", all.found.is_counted);
  fields.pair("count", all.found.count, "stored", all.found.stored);
  fields.pair("steps", all.found.steps, "plane_tests", all.found.plane_tests);
  for (std::uint32_t i = 0; i < all.regions.size(); ++i) {
    const MeshContact& r = all.regions[i];
    fields.element("region", i);
    fields.number("lower", r.lower), fields.number("upper", r.upper);
    fields.pair("verdict", r.verdict, "triangle_a", r.triangle_a);
    fields.count("triangle_b", r.triangle_b);
    fields.feature("feature_a", r.feature_a), fields.feature("feature_b", r.feature_b);
    fields.numbers("point_a", r.point_a), fields.numbers("point_b", r.point_b);
    fields.numbers("normal", r.normal);
    fields.numbers("box_min", r.box_min), fields.numbers("box_max", r.box_max);
  }
  fields.element();
}

/// Closed and open, convex and not, of separate triangles that touch and cross, on a lattice, and two that were cut. The first
/// `kClosed` bound volumes. From bits, sums, products and square roots only.
inline constexpr std::size_t kClosed = 4;
inline std::vector<MeshModel> meshes() {
  shapes::Random random(11);
  soups::Soup dented = soups::ball(2);
  for (Vec3& p : dented.points) p *= random.uniform(0.4, 1);
  soups::Soup tangle = soups::tangled(random, 12, 30);
  for (Vec3& p : tangle.points) p = (4 * p).array().round() / 4;
  tangle.triangles.insert(tangle.triangles.end(), {tangle.triangles[0], {0, 0, 1}, {2, 2, 2}});
  const MeshModel fine = soups::ball(3).mesh();
  return {soups::ball(2).mesh(),
          soups::box({-1, -0.75, -0.5}, {1, 0.75, 0.5}).mesh(),
          dented.mesh(),
          soups::scaled(soups::tetrahedron(), 0.125).mesh(),
          soups::patch(8, [](double x, double y) { return 0.25 * (x * x - y * y) - 0.5; }).mesh(),
          tangle.mesh(),
          fine.cut({.deviation = std::nextafter(fine.deviation(1), 4)}),
          fine.cut({.deviation = std::nextafter(fine.deviation(2), 4)})};
}

/// Calls ask(a, b, its numbers, round, next pose) for so many poses of each pair of meshes.
template <class Ask>
void each_mesh_pose(std::uint64_t seed, int rounds, Ask ask) {
  const std::vector<MeshModel> all = meshes();
  Poses poses(seed);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b)
      for (int i = 0; i < rounds; ++i) ask(all[a], all[b], Asked{{}, {}, a, b, i}, poses.next(), poses);
}

/// Calls take(asked, answer) for each answer; so do those below. Meshes with radii and solids among them, and of every fifth
/// pose a convex body in the place of one mesh.
template <class Take>
void each_mesh_answer(const std::vector<Model>& models, int rounds, Take take) {
  MeshSeed warm, loose, near, met, deep, solid;
  each_mesh_pose(4, rounds, [&](const MeshModel& a, const MeshModel& b, Asked asked, Pose pose, Poses& poses) {
    const auto took = [&](const char* query, const char* how, const Answer& answer) {
      asked.query = query, asked.how = how;
      take(asked, answer);
    };
    if (asked.round == 0) warm = loose = near = met = deep = solid = {};
    if (asked.round % 2) pose.translation *= 0.5;  // through each other and inside one another more often
    const double radius = asked.round % 3 ? 0 : 0.125;
    const MeshBody of_a(a, radius), of_b(b, radius);
    MeshSeed random;
    random.triangle_a = std::uint32_t(poses.bits() % 300), random.triangle_b = std::uint32_t(poses.bits() % 300);
    random.pair = poses.seed();
    took("mesh_distance", "warm", distance(of_a, of_b, pose, warm));
    took("mesh_distance", "cold", distance(of_a, of_b, pose));
    took("mesh_distance", "random", distance(of_a, of_b, pose, random));
    took("mesh_distance", "swapped", distance(of_b, of_a, inverse(pose)));
    took("mesh_distance", "loose", distance(of_a, of_b, pose, loose, {.relative = 0.1}));
    took("mesh_distance", "beyond", distance(of_a, of_b, pose, {.beyond = 0.5}));
    Options limited;
    limited.budget.steps = std::uint32_t(asked.round % 7);
    took("mesh_distance", "limited", distance(of_a, of_b, pose, limited));
    took("mesh_intersects", "warm", intersects(of_a, of_b, pose, met));
    took("mesh_within", "warm", within(of_a, of_b, pose, 0.25, near).answer);
    took("mesh_closest_features", "warm", closest_features(of_a, of_b, pose, near).answer);
    took("mesh_signed_distance", "warm", signed_distance(of_a, of_b, pose, deep));
    took("mesh_signed_within", "warm", signed_within(of_a, of_b, pose, -0.125, deep).answer);
    if (asked.a < kClosed && asked.b < kClosed) {
      const MeshBody full_a = MeshBody::solid(a, radius), full_b = MeshBody::solid(b);
      took("mesh_distance", "solid", distance(full_a, full_b, pose, solid));
      took("mesh_signed_distance", "solid", signed_distance(full_a, full_b, pose, solid));
    }
    if (asked.round % 5) return;
    took("mesh_distance", "model", distance(of_a, Body(models[asked.b % models.size()], radius), pose));
    took("mesh_distance", "box", distance(Body::box({-0.5, -0.25, -1}, {0.5, 0.75, 1}), of_b, pose));
  });
}

/// As many regions as fit into a span that is sometimes too short.
template <class Take>
void each_mesh_contact(int rounds, Take take) {
  each_mesh_pose(5, rounds, [&](const MeshModel& a, const MeshModel& b, Asked asked, Pose pose, Poses&) {
    pose.translation *= 0.5;
    Regions all;
    all.regions.resize(asked.round % 4 ? 16 : 2);
    all.found = contacts(a, b, pose, asked.round % 3 ? 0.0625 : 0, all.regions);
    all.regions.resize(all.found.stored);
    asked.query = "contacts", asked.how = "cold";
    take(asked, all);
  });
}

/// Of each region, after that of the pose before and alone.
template <class Take>
void each_mesh_manifold(int rounds, Take take) {
  Manifold before;
  each_mesh_pose(6, rounds, [&](const MeshModel& a, const MeshModel& b, Asked asked, Pose pose, Poses& poses) {
    pose.translation *= 0.5;
    ManifoldOptions options;
    options.margin = 0.25;
    options.most_points = 1 + std::uint32_t(poses.bits() % kMostManifoldPoints);
    std::array<MeshContact, 2> regions;
    const MeshContacts found = contacts(a, b, pose, 0.125, regions);
    asked.query = "mesh_manifold";
    for (std::uint32_t i = 0; i < found.stored; ++i) {
      asked.how = i == 0 ? "nearest" : "next";
      take(asked, before = manifold(a, b, pose, regions[i], options, before));
    }
  });
}

}  // namespace swiftlet::answers
