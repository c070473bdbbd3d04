// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The benchmark's methods against the oracle, and its comparison against methods that are wrong on purpose. What a peer gets
// wrong is printed and bounded; it is never left out.
#include <gtest/gtest.h>

#include <cstdio>
#include <deque>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/query.h>

#include "method.h"
#include "nearest.h"
#include "oracle.h"
#include "shapes.h"
#include "verdict.h"

namespace swiftlet::bench {
namespace {

/// Bodies, pairs, poses, and the oracle's word on each.
struct Scene {
  std::string name;
  std::deque<Model> models;
  std::deque<Mesh> meshes;
  std::vector<SceneBody> bodies;
  std::vector<BodyPair> pairs;
  std::vector<Query> queries;
  std::vector<Certified> truth;
  double radius = 0;

  void add_body(Mesh mesh) {
    models.push_back(std::move(build(mesh)).value().model);
    meshes.push_back(std::move(mesh));
    bodies.push_back({&models.back(), models.back().level(0).view, 0});
    radius = std::max(radius, models.back().radius());
  }
  void add_query(std::uint32_t pair, const Pose& pose) {
    const oracle::Truth t = oracle::distance(meshes[pairs[pair].a].points, meshes[pairs[pair].b].points, pose);
    queries.push_back({pair, pose});
    truth.push_back({t.bounds.lower, t.bounds.upper, !t.overlapping, t.overlapping});
  }
};

/// Every two of: cubes, a prism, a plate-like one, ellipsoids of 100 vertices. Random poses; `closest` and `farthest` are
/// centre distances in sums of radii.
Scene random_scene(std::string name, std::uint64_t seed, double closest, double farthest, bool disjoint_only) {
  Scene scene;
  scene.name = std::move(name);
  scene.add_body(shapes::cube());
  scene.add_body(shapes::box({1, 2, 3}));
  scene.add_body(shapes::prism(7, 1, 2));
  scene.add_body(shapes::prism(12, 1.5, .3));
  for (const shapes::Family family : shapes::kFamilies) scene.add_body(shapes::ellipsoid(shapes::semi_axes(family), 196, seed));
  for (std::uint32_t a = 0; a < scene.bodies.size(); ++a) {
    for (std::uint32_t b = a; b < scene.bodies.size(); ++b) scene.pairs.push_back({a, b});
  }
  shapes::Random random(seed);
  for (std::uint32_t pair = 0; pair < scene.pairs.size(); ++pair) {
    const double sum = scene.models[scene.pairs[pair].a].radius() + scene.models[scene.pairs[pair].b].radius();
    for (int i = 0; i < 40;) {
      const Pose pose{random.rotation(), random.on_sphere() * sum * random.uniform(closest, farthest)};
      scene.add_query(pair, pose);
      if (disjoint_only && scene.truth.back().upper < 1e-3 * scene.radius) {
        scene.queries.pop_back(), scene.truth.pop_back();
      } else {
        ++i;
      }
    }
  }
  return scene;
}

const Scene& disjoint_scene() {
  static const Scene scene = random_scene("disjoint", 31, .5, 1.6, true);
  return scene;
}
const Scene& mixed_scene() {
  static const Scene scene = random_scene("mixed", 32, .1, 1.1, false);
  return scene;
}

/// Boxes and prisms that share the frame, faces parallel: where GJKs stop early.
const Scene& aligned_scene() {
  static const Scene scene = [] {
    Scene s;
    s.name = "aligned";
    for (Mesh& mesh :
         std::vector<Mesh>{shapes::cube(), shapes::box({1, 2, 3}), shapes::box({.1, 5, 5}), shapes::prism(8, 1, 2)})
      s.add_body(mesh);
    for (std::uint32_t a = 0; a < 4; ++a) {
      for (std::uint32_t b = 0; b < 4; ++b) s.pairs.push_back({a, b});
    }
    for (std::uint32_t pair = 0; pair < s.pairs.size(); ++pair) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double at : {5.5, 6., 8., 11.}) {
          for (const double aside : {0., .25, 1., 3.}) {
            Pose pose;
            pose.translation[axis] = at;
            pose.translation[(axis + 1) % 3] = aside;
            s.add_query(pair, pose);
          }
        }
      }
    }
    return s;
  }();
  return scene;
}

Comparison run_distances(const Method& method, const Scene& scene) {
  const auto session = method.open(scene.bodies, scene.pairs);
  std::vector<Outcome> outcomes(scene.queries.size());
  session->distances(scene.queries, outcomes);
  return compare(outcomes, scene.truth, scene.radius);
}
Comparison run_booleans(const Method& method, const Scene& scene) {
  const auto session = method.open(scene.bodies, scene.pairs);
  std::vector<Outcome> outcomes(scene.queries.size());
  session->intersections(scene.queries, outcomes);
  return compare_verdicts(outcomes, scene.truth);
}

void print(const Scene& scene, const Method& method, const Comparison& c) {
  std::printf("%-9s %-24s %s\n", scene.name.c_str(), method.name().c_str(), text(c, scene.radius).c_str());
}

/// How many of so many answers a method may get wrong: none, but for the peers whose defects are known.
double allowed(const Method& method, std::size_t count) { return method.capabilities().wrong_share * double(count); }

std::size_t count_off(const Method& method, const Scene& scene, double claimed) {
  const auto session = method.open(scene.bodies, scene.pairs);
  std::vector<Outcome> outcomes(scene.queries.size());
  session->distances(scene.queries, outcomes);
  std::size_t off = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    off += !compare({&outcomes[i], 1}, {&scene.truth[i], 1}, scene.radius).right(claimed);
  }
  return off;
}

TEST(Methods, HaveNamesAndSettingsOfTheirOwn) {
  std::set<std::string> names;
  for (const auto& method : all_methods()) {
    EXPECT_TRUE(names.insert(method->name()).second) << method->name();
    EXPECT_FALSE(method->settings().empty());
    std::printf("%-24s %s\n", method->name().c_str(), method->settings().c_str());
  }
  for (const std::string& name : absent_peers()) std::printf("%-24s absent\n", name.c_str());
  EXPECT_TRUE(names.contains("swiftlet"));
}

TEST(Methods, AgreeWithTheOracleOnDisjointPairs) {
  const Scene& scene = disjoint_scene();
  for (const auto& method : all_methods()) {
    if (!method->capabilities().distance) continue;
    const Comparison c = run_distances(*method, scene);
    print(scene, *method, c);
    const double claimed = method->capabilities().stated_error * scene.radius;
    const std::size_t off = count_off(*method, scene, claimed);
    if (off > 0)
      std::printf("  %s: %zu of %zu beyond its stated %.1g r\n", method->name().c_str(), off, c.count, claimed / scene.radius);
    EXPECT_LE(double(off), allowed(*method, c.count)) << method->name();
  }
}

TEST(Methods, DecideIntersectionAsTheOracleDoes) {
  const Scene& scene = mixed_scene();
  std::size_t overlapping = 0;
  for (const Certified& t : scene.truth) overlapping += t.overlapping;
  ASSERT_GT(double(overlapping), .3 * double(scene.truth.size()));
  ASSERT_LT(double(overlapping), .7 * double(scene.truth.size()));
  for (const auto& method : all_methods()) {
    const Comparison c = run_booleans(*method, scene);
    print(scene, *method, c);
    EXPECT_LE(double(c.wrong()), allowed(*method, c.count)) << method->name();
  }
}

TEST(Methods, AreRightAboutOverlapWhenAskedForDistance) {
  const Scene& scene = mixed_scene();
  for (const auto& method : all_methods()) {
    if (!method->capabilities().distance) continue;
    const Comparison c = run_distances(*method, scene);
    print(scene, *method, c);
    EXPECT_LE(double(c.wrong() + c.failures), allowed(*method, c.count)) << method->name();
  }
}

/// Every GJK but Bullet's detector and FCL's own stops early here, by up to 0.6 r [fcl#508]; ours must not.
TEST(Methods, AreComparedOnParallelFaces) {
  const Scene& scene = aligned_scene();
  for (const auto& method : all_methods()) {
    if (!method->capabilities().distance) continue;
    const Comparison c = run_distances(*method, scene);
    print(scene, *method, c);
    const Capabilities can = method->capabilities();
    EXPECT_TRUE(!can.certified || c.right(can.stated_error * scene.radius)) << method->name();
  }
}

TEST(Methods, KeepToWhatIsAllowedWhenApproximate) {
  const Scene& scene = disjoint_scene();
  const double absolute = 1e-2 * scene.radius;
  for (const auto& method : all_methods()) {
    if (!method->capabilities().approximate) continue;
    const auto session = method->open(scene.bodies, scene.pairs);
    std::vector<Outcome> outcomes(scene.queries.size());
    session->approximations(scene.queries, absolute, 1e-2, outcomes);
    const Comparison c = compare(outcomes, scene.truth, scene.radius);
    print(scene, *method, c);
    EXPECT_TRUE(!method->capabilities().certified || c.right(absolute)) << method->name();
  }
}

TEST(Methods, AnswerTheSameAfterForgetting) {
  const Scene& scene = disjoint_scene();
  for (const auto& method : all_methods()) {
    if (!method->capabilities().distance) continue;
    const auto session = method->open(scene.bodies, scene.pairs);
    std::vector<Outcome> first(scene.queries.size()), again(scene.queries.size());
    session->distances(scene.queries, first);
    session->forget();
    session->distances(scene.queries, again);
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(first[i].distance, again[i].distance) << method->name() << " query " << i;
      ASSERT_EQ(first[i].steps, again[i].steps) << method->name() << " query " << i;
    }
  }
}

// ---- The comparison itself -------------------------------------------------------------------------------------------------

/// swiftlet's answers, each bent by a function of the query's number.
std::vector<Outcome> bent(const Scene& scene, const std::function<void(std::size_t, Outcome&)>& bend) {
  const auto methods = all_methods();
  const auto session = methods.front()->open(scene.bodies, scene.pairs);
  std::vector<Outcome> outcomes(scene.queries.size());
  session->distances(scene.queries, outcomes);
  for (std::size_t i = 0; i < outcomes.size(); ++i) bend(i, outcomes[i]);
  return outcomes;
}

TEST(Verdict, FlagsAPeerThatIsOffByAMillionth) {
  const Scene& scene = disjoint_scene();
  const double radius = scene.radius;
  for (const double off : {1e-6, -1e-6}) {
    const Comparison c =
        compare(bent(scene, [&](std::size_t, Outcome& o) { o.distance += off * radius; }), scene.truth, radius);
    EXPECT_FALSE(c.right(1e-9 * radius));
    EXPECT_TRUE(c.right(1.1e-6 * radius));
    EXPECT_NEAR(c.max_error, 1e-6 * radius, 1e-12 * radius);
    EXPECT_NE(c.hash, c.true_hash);
  }
  const Comparison once =
      compare(bent(scene, [&](std::size_t i, Outcome& o) { o.distance += i == 77 ? 1e-6 * radius : 0; }), scene.truth, radius);
  EXPECT_FALSE(once.right(1e-9 * radius));
  EXPECT_EQ(once.worst, 77u);
  EXPECT_NE(once.hash, once.true_hash);
}

TEST(Verdict, HashesEqualAnswersAlike) {
  const Scene& scene = mixed_scene();
  const double radius = scene.radius;
  const Comparison exact = compare(bent(scene, [](std::size_t, Outcome&) {}), scene.truth, radius);
  EXPECT_EQ(exact.hash, exact.true_hash);
  EXPECT_TRUE(exact.right(1e-12 * radius));
  const Comparison near = compare(bent(scene, [&](std::size_t i, Outcome& o) { o.distance *= i % 2 ? 1 + 1e-13 : 1 - 1e-13; }),
                                  scene.truth, radius);
  EXPECT_EQ(near.hash, exact.hash);
}

TEST(Verdict, CountsEveryKindOfWrongAnswer) {
  const Scene& scene = mixed_scene();
  const auto all = [&](const Outcome& answer) {
    return compare(std::vector<Outcome>(scene.queries.size(), answer), scene.truth, scene.radius);
  };
  std::size_t overlapping = 0;
  for (const Certified& t : scene.truth) overlapping += t.overlapping;
  EXPECT_EQ(all({.overlapping = true}).false_overlaps, scene.truth.size() - overlapping);
  EXPECT_EQ(all({.distance = 1}).missed_overlaps, overlapping);
  EXPECT_EQ(all({.failed = true}).failures, scene.truth.size());
  EXPECT_EQ(all({.distance = std::numeric_limits<double>::quiet_NaN()}).failures, scene.truth.size());
  EXPECT_EQ(all({.distance = -1}).failures, scene.truth.size());
  const std::vector<Outcome> never(scene.queries.size());  // `return false` wins no row
  const Comparison verdicts = compare_verdicts(never, scene.truth);
  EXPECT_EQ(verdicts.missed_overlaps, overlapping);
  EXPECT_NE(verdicts.hash, verdicts.true_hash);
}

TEST(Verdict, CertifiesWhatTheOracleKnows) {
  const Scene& scene = mixed_scene();
  const Truth truth = certify(scene.bodies, scene.pairs, scene.queries);
  EXPECT_EQ(truth.unproved, 0u) << truth.first_failure;
  EXPECT_LT(truth.widest, 1e-12 * scene.radius);
  ASSERT_EQ(truth.queries.size(), scene.truth.size());
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    EXPECT_EQ(truth.queries[i].disjoint, scene.truth[i].disjoint) << i;
    EXPECT_EQ(truth.queries[i].overlapping, scene.truth[i].overlapping) << i;
    EXPECT_LE(truth.queries[i].lower, scene.truth[i].upper) << i;
    EXPECT_GE(truth.queries[i].upper, scene.truth[i].lower) << i;
  }
}

TEST(Verdict, MeasuresErrorsAgainstWhatTheOracleSays) {
  const Scene& scene = mixed_scene();
  const double off = 1e-15 * scene.radius;
  for (std::size_t i = 0; i < scene.queries.size(); ++i) {
    const BodyPair pair = scene.pairs[scene.queries[i].pair];
    const auto apart = nearest(scene.bodies[pair.a].view, scene.bodies[pair.b].view, scene.queries[i].b_in_a);
    EXPECT_EQ(apart.has_value(), scene.truth[i].disjoint) << i;
    if (!apart) continue;
    EXPECT_GE(*apart, scene.truth[i].lower - off) << i;
    EXPECT_LE(*apart, scene.truth[i].upper + off) << i;
  }
}

}  // namespace
}  // namespace swiftlet::bench
