// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// RECIPES.md's scene: things on a table, a mesh among them, and a gripper that comes down. Ends with 1 where a block does not
// do what the page says.
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <swiftlet/scene.h>

namespace {

using swiftlet::Body;
using swiftlet::Model;
using swiftlet::Pose;

Pose at(double x, double y, double z) {
  Pose pose;
  pose.translation = {x, y, z};
  return pose;
}

std::string text(const swiftlet::Scene& scene, swiftlet::BodyId id) { return std::string(scene.name(id)); }

int run(const Model& cup, const swiftlet::MeshModel& bowl) {
  swiftlet::Scene scene;
  (void)scene.add("table", Body::box({-1, -1, -0.05}, {1, 1, 0}), Pose{});  // a name that is taken gives BodyId{}
  (void)scene.add("ball", Body::point({0, 0, 0}, 0.06), at(0.25, 0, 0.075));
  // A scene keeps its own copy of a model, which shares the block.
  const swiftlet::BodyId id = scene.add("cup", cup, at(0, 0, 0.101));
  (void)scene.add("bowl", bowl, at(-0.5, 0.5, 0.015));  // a MeshModel; with a radius, a MeshBody

  for (const swiftlet::ScenePair& pair : scene.within(0.02))
    std::printf("%s and %s are near\n", text(scene, pair.a).c_str(), text(scene, pair.b).c_str());
  const swiftlet::NearestPair nearest = scene.nearest();
  std::printf("nearest: %s and %s, %.6f apart\n", text(scene, nearest.a).c_str(), text(scene, nearest.b).c_str(),
              nearest.answer.value());

  scene.move(id, at(0.1, 0, 0.099));  // or: scene.move(scene.find("cup"), ...)
  for (const swiftlet::SceneContact& contact : scene.contacts({.margin = 0.01}))
    std::printf("%s and %s: %u points, %.6f apart\n", text(scene, contact.a).c_str(), text(scene, contact.b).c_str(),
                contact.manifold.count, contact.answer.value());

  swiftlet::Scene gripper;
  const swiftlet::BodyId left = gripper.add("left", Body::segment({0, 0, 0}, {0, 0, 0.2}, 0.02), at(-0.3, 0, 0.1));
  const swiftlet::BodyId right = gripper.add("right", Body::segment({0, 0, 0}, {0, 0, 0.2}, 0.02), at(0.5, 0, 0.1));
  gripper.ask_only([&](swiftlet::BodyId a, swiftlet::BodyId b) { return a != left || b != right; });  // they may meet
  std::printf("%.3f free, of its own %s\n", gripper.nearest(scene).lower, gripper.overlapping().empty() ? "too" : "not");
  const bool blocked = !scene.overlapping(swiftlet::Scene(Body::box({-0.1, -0.1, 0}, {0.1, 0.1, 0.1}), at(0.3, 0, 0))).empty();
  std::printf("a box there: %s\n", blocked ? "no" : "yes");
  scene.remove(scene.find("ball"));
  return nearest.answer.upper > 0.002 || !blocked || scene.size() != 3;
}

}  // namespace

int main() {
  std::vector<swiftlet::Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 0.1 : -0.1, i & 2 ? 0.1 : -0.1, i & 4 ? 0.1 : -0.1);
  const std::uint32_t quads[] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  const std::uint32_t sizes[] = {4, 4, 4, 4, 4, 4};
  swiftlet::LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = quads;
  arrays.face_sizes = sizes;
  const auto cup = Model::from_level(arrays);
  if (!cup) return std::puts(cup.error().message.c_str()), 1;

  std::vector<swiftlet::Vec3> rim{{0, 0, 0}};  // an open pyramid, upside down
  for (const auto& [x, y] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}}) rim.emplace_back(0.2 * x, 0.2 * y, 0.1);
  const std::array<std::uint32_t, 3> sides_of_bowl[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const auto bowl = swiftlet::MeshModel::from_triangles(rim, sides_of_bowl);
  if (!bowl) return std::puts(bowl.error().message.c_str()), 1;
  return run(cup.value(), bowl.value());
}
