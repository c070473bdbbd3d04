// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The benchmark's scenes are what they claim: near enough, varied enough, at the distance they name. Knows scenes.h.
#include "scenes.h"

#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "folder.h"
#include "oracle.h"

namespace swiftlet {
namespace {

using namespace yardstick;

const Shelf& shelf() {
  static const Folder folder;
  static const Shelf shelf(folder.path());
  return shelf;
}

std::vector<Vec3> points(const Model& model) {
  std::vector<Vec3> result;
  for (const Vertex& v : model.level(0).view.vertices) result.emplace_back(v.x, v.y, v.z);
  return result;
}

oracle::Truth truth(const Scene& scene, const Query& query) {
  const BodyPair pair = scene.pairs[query.pair];
  return oracle::distance(points(scene.models[pair.a]), points(scene.models[pair.b]), query.b_in_a);
}

TEST(Scenes, OrbitsComeAsNearAsTheySayAndRepeatNoPose) {
  for (const double closest : {2.0, 3.0}) {
    for (const double step : kSteps) {
      const Scene scene = orbit(shelf(), shapes::Family::Long, 200, closest, step);
      const Coverage covered = coverage(scene);
      EXPECT_NEAR(covered.closest, closest, 0.01 * closest) << scene.name;
      EXPECT_GT(covered.distinct_share, 0.9) << scene.name;
      EXPECT_EQ(scene.queries.size(), 10'000u);
    }
  }
}

TEST(Scenes, BodiesOfAPairDiffer) {
  const Scene scene = random_poses(shelf(), shapes::Family::Fat, 200);
  EXPECT_NE(scene.models[0].hash(), scene.models[1].hash());
  EXPECT_EQ(coverage(scene).distinct_share, 1);
  EXPECT_NEAR(coverage(scene).closest, 2, 1e-9);
}

TEST(Scenes, SolvedPosesAreAtTheirDistance) {
  for (const shapes::Family family : shapes::kFamilies) {
    for (const double distance : {kClose, kSliding}) {
      const Scene scene = at_distance(shelf(), family, 200, distance, 10.4, {4, 50});
      for (std::size_t i = 0; i < scene.queries.size(); i += 10) {
        EXPECT_NEAR(truth(scene, scene.queries[i]).distance, distance, 1e-12 + 1e-6 * distance) << scene.name << " " << i;
      }
      EXPECT_GT(coverage(scene).distinct_share, 0.9);
    }
    EXPECT_EQ(overlapping_share(shallow(shelf(), family, 200, 10.4, 1e-3, {4, 50})), 1);
    EXPECT_EQ(overlapping_share(shallow(shelf(), family, 200, 10.4, -1e-3, {4, 50})), 0) << "as much apart as it would overlap";
  }
}

TEST(Scenes, MixedPosesOverlapAboutHalfTheTime) {
  for (const shapes::Family family : shapes::kFamilies) {
    for (const double step : {1.04, 10.4, 178.3}) {
      const double share = overlapping_share(mixed(shelf(), family, 200, step));
      EXPECT_GT(share, 0.3) << shapes::name(family) << " " << step;
      EXPECT_LT(share, 0.7) << shapes::name(family) << " " << step;
    }
  }
}

TEST(Scenes, OverlappingPosesOverlapAndTheirCentresAreNear) {
  for (const shapes::Family family : shapes::kFamilies) {
    for (const Scene& scene : {orbit(shelf(), family, 200, 2, 10.4, {4, 50}), random_poses(shelf(), family, 200, {4, 50})}) {
      const Scene near = overlapping(scene);
      EXPECT_EQ(overlapping_share(near), 1) << near.name;
      EXPECT_LE(coverage(near).closest, 0.8 + 1e-12);
      EXPECT_GT(coverage(near).closest, family == shapes::Family::Fat ? 0.8 - 1e-12 : 0.1);
    }
  }
}

TEST(Scenes, PosesRoundedToFloatsAreFloats) {
  for (const Query& query : rounded_to_float(random_poses(shelf(), shapes::Family::Fat, 200, {4, 50})).queries) {
    const Pose& pose = query.b_in_a;
    EXPECT_EQ(pose.rotation, pose.rotation.cast<float>().cast<double>());
    EXPECT_EQ(pose.translation, pose.translation.cast<float>().cast<double>());
    EXPECT_GT((pose.rotation.transpose() * pose.rotation - Mat3::Identity()).norm(), 1e-10);
  }
}

TEST(Scenes, UnequalPairsComeAsNearAsTheirRadii) {
  const Scene small = ten_to_one(shelf(), 200, 10.4), crossed = plate_and_long(shelf(), 200, 10.4);
  EXPECT_NEAR(coverage(small).closest, 1.1, 0.011);
  EXPECT_NEAR(small.models[1].radius(), 0.1, 1e-12);
  EXPECT_NEAR(coverage(crossed).closest, 2, 0.02);
}

TEST(Scenes, CrowdAsksItsPairsInTurn) {
  const Scene scene = crowd(shelf(), 20, 10.4, 3);
  ASSERT_EQ(scene.pairs.size(), 100u);
  ASSERT_EQ(scene.queries.size(), 300u);
  for (std::uint32_t i = 0; i < 300; ++i) EXPECT_EQ(scene.queries[i].pair, i % 100);
  EXPECT_EQ(coverage(scene).distinct_share, 1);
}

TEST(Scenes, BodiesAreBuiltOnce) {
  const Folder folder;
  const Shelf fresh(folder.path()), again(folder.path());
  const Shelf::Entry built = fresh.ellipsoid(shapes::Family::Plate, 200, 2),
                     loaded = again.ellipsoid(shapes::Family::Plate, 200, 2);
  EXPECT_EQ(built.model.hash(), loaded.model.hash());
  EXPECT_NEAR(built.build_seconds, loaded.build_seconds, 1e-4 * built.build_seconds) << "what building took, not loading";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "one model, one time";
}

}  // namespace
}  // namespace swiftlet
