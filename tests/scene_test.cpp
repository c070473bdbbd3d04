// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes beside brute force: every pair asked on its own, cold, and of meshes every pair of triangles. Bodies of all kinds and
// sizes, that touch exactly, far from the origin, mirrored, moved, removed; on any executor the same bytes.
#include <swiftlet/scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <set>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <broad_phase.h>
#include <random.h>
#include <soups.h>
#include <swiftlet/depth.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/model_file.h>

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
using shapes::Random;
using Ids = std::set<std::pair<BodyId, BodyId>>;

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    std::vector<Model> read;
    for (const char* name : {"fat_a", "fat_b", "plate", "long"})
      read.push_back(load(std::string(SWIFTLET_TEST_DIR "/data/models/") + name + ".swl").value());
    return read;
  }();
  return all;
}

/// A cube of any side is a box; a model of one, by arrays.
Model cube_model(double side) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(side / 2 * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  const std::uint32_t quads[] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6},
                      sizes[] = {4, 4, 4, 4, 4, 4};
  LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = quads;
  arrays.face_sizes = sizes;
  return Model::from_level(arrays).value();
}

const std::vector<Model>& cubes() {
  static const std::vector<Model> all{cube_model(1), cube_model(0.125), cube_model(4)};
  return all;
}

Body any_body(Random& random) {
  const double radius = random.bits() % 3 ? 0 : random.uniform(0, 0.3);
  const auto p = [&] { return Vec3(0.7 * random.in_ball()); };
  switch (random.bits() % 8) {
    case 0: return Body::point(p(), radius);
    case 1: return Body::segment(p(), p(), radius);
    case 2: return Body::triangle(p(), p(), p(), radius);
    case 3: return Body::box({-0.5, -0.25, 0}, {0.5, 0.25, 0.125}, radius);
    case 4: return Body(cubes()[random.bits() % cubes().size()], radius);
    default: return Body(models()[random.bits() % models().size()], radius);
  }
}

/// Closed and open, flat, duplicate and scattered triangles.
const std::vector<MeshModel>& meshes() {
  static const std::vector<MeshModel> all = [] {
    Random random(101);
    soups::Soup twice = soups::tetrahedron();
    twice.add(soups::tetrahedron());
    return std::vector<MeshModel>{soups::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).mesh(), soups::torus(12, 6).mesh(),
                                  soups::scattered(random, 30, 0.5).mesh(), twice.mesh(),
                                  soups::patch(4, [](double x, double y) { return x * y; }).mesh()};
  }();
  return all;
}

/// Half of them meshes.
MeshBody any_mesh_body(Random& random) {
  if (random.bits() % 2) return any_body(random);
  return {meshes()[random.bits() % meshes().size()], random.bits() % 3 ? 0 : random.uniform(0, 0.3)};
}

/// On a lattice, where cubes touch exactly, or anywhere; one in eight mirrored. Around `centre`.
Pose any_pose(Random& random, double reach, const Vec3& centre) {
  Pose pose;
  if (random.bits() % 4 == 0) {
    for (double& x : pose.translation) x = std::round(reach * random.uniform(-1, 1));
  } else {
    pose.rotation = random.rotation();
    pose.translation = reach * random.in_ball();
  }
  if (random.bits() % 8 == 0) pose.rotation.col(0) *= -1;
  pose.translation += centre;
  return pose;
}

/// Of pairs in order; each is listed once but for its regions of contact.
Ids ids(const auto& pairs) {
  Ids all;
  for (const ScenePair& pair : pairs) all.emplace(pair.a, pair.b);
  if constexpr (!std::is_same_v<std::decay_t<decltype(pairs[0])>, SceneContact>) {
    EXPECT_EQ(all.size(), pairs.size()) << "a pair twice";
  }
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(),
                             [](const ScenePair& x, const ScenePair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); }));
  return all;
}

/// visit(a, b, body of a, body of b, b_in_a) for all pairs.
void all_pairs(const Scene& scene, const Scene& other, const auto& visit) {
  for (const BodyId a : scene.bodies()) {
    for (const BodyId b : other.bodies()) {
      if (&scene == &other && !(a < b)) continue;
      visit(a, b, scene.mesh_body(a), other.mesh_body(b), relative(scene.pose(a), other.pose(b)));
    }
  }
}

/// Of two convex bodies 1.
std::size_t region_count(const Scene& scene, const Scene& other, const ScenePair& pair, double reach) {
  const MeshBody a = scene.mesh_body(pair.a), b = other.mesh_body(pair.b);
  if (!a.mesh() && !b.mesh()) return 1;
  std::vector<MeshContact> regions(1000);
  const MeshContacts told = swiftlet::contacts(a, b, relative(scene.pose(pair.a), other.pose(pair.b)), reach, regions);
  EXPECT_EQ(told.status, Status::Converged);
  return told.count;
}

/// Asks everything and compares with every pair asked on its own.
void expect_as_brute_force(Scene& scene, const Scene& other, double reach) {
  Ids overlapping, within, up_to, in_contact;
  std::map<std::pair<BodyId, BodyId>, std::pair<Answer, double>> distances, depths;
  double upper = kInfinity, lower = kInfinity;
  all_pairs(scene, other, [&](BodyId a, BodyId b, const MeshBody& body_a, const MeshBody& body_b, const Pose& pose) {
    const double bound = tolerance(body_a, body_b, pose);
    if (intersects(body_a, body_b, pose).verdict != Verdict::Disjoint) overlapping.emplace(a, b);
    if (swiftlet::within(body_a, body_b, pose, reach).decision != Decision::No) within.emplace(a, b);
    const Answer d = distance(body_a, body_b, pose);
    const bool convex = !body_a.mesh() && !body_b.mesh();
    const Answer s = convex ? signed_distance(body_a.convex(), body_b.convex(), pose) : d;
    if (d.lower <= reach) up_to.emplace(a, b);
    if (s.lower <= reach) in_contact.emplace(a, b);
    distances[{a, b}] = {d, bound};
    depths[{a, b}] = {s, bound};
    lower = std::min(lower, d.lower);
    upper = std::min(upper, d.upper);
  });
  EXPECT_EQ(ids(scene.overlapping(other)), overlapping);
  EXPECT_EQ(ids(scene.within(other, reach)), within);
  const auto found = scene.distances(other, {.beyond = reach});
  EXPECT_EQ(ids(found), up_to);
  for (const ScenePair& pair : found) {
    const auto& [alone, bound] = distances[{pair.a, pair.b}];
    EXPECT_LE(pair.answer.lower, alone.upper);
    EXPECT_LE(alone.lower, pair.answer.upper);
    EXPECT_LE(pair.answer.upper - pair.answer.lower, bound);
  }
  const auto contacts = scene.contacts(other, {.margin = reach});
  EXPECT_EQ(ids(contacts), in_contact);
  std::map<std::pair<BodyId, BodyId>, double> least;
  std::size_t regions = 0;
  for (const SceneContact& contact : contacts) {
    if (!least.count({contact.a, contact.b})) regions += region_count(scene, other, contact, reach);
    const auto& [alone, bound] = depths[{contact.a, contact.b}];
    double& lower_of_pair = least.try_emplace({contact.a, contact.b}, kInfinity).first->second;
    lower_of_pair = std::min(lower_of_pair, contact.answer.lower);
    EXPECT_LE(alone.lower, contact.answer.upper);
    // Where triangles cross, the manifold alone has a normal.
    if (!scene.mesh_body(contact.a).mesh() && !other.mesh_body(contact.b).mesh())
      EXPECT_EQ(contact.manifold.count > 0, !contact.answer.normal.hasNaN());
    else
      EXPECT_GT(contact.manifold.count, 0u);
  }
  for (const auto& [pair, lower_of_pair] : least) EXPECT_LE(lower_of_pair, depths[pair].first.upper);
  EXPECT_EQ(contacts.size(), regions);
  const NearestPair nearest = scene.nearest(other);
  ASSERT_EQ(scene.has(nearest.a), !distances.empty());
  if (distances.empty()) return;
  EXPECT_LE(nearest.lower, upper);
  EXPECT_LE(lower, nearest.answer.upper);
  const double bound = distances[{nearest.a, nearest.b}].second;
  EXPECT_LE(nearest.answer.upper - nearest.lower, 2 * bound);
}

TEST(BoxTree, FindsWhatBruteForceFinds) {
  Random random(1);
  BoxTree trees[2];
  std::map<std::uint32_t, WorldBox> boxes[2];
  for (int step = 0; step < 3000; ++step) {
    const std::size_t which = random.bits() % 2;
    const auto item = std::uint32_t(random.bits() % 60);
    if (boxes[which].count(item) && random.bits() % 4 == 0) {
      trees[which].remove(item);
      boxes[which].erase(item);
    } else {
      WorldBox box;
      const double size = std::ldexp(1, int(random.bits() % 12) - 10), far = random.bits() % 50 ? 0 : 1e12;
      for (std::size_t i = 0; i < 3; ++i) {
        box.min[i] = std::round(8 * random.uniform(-5, 5)) / 8 + far;
        box.max[i] = box.min[i] + size;
      }
      if (boxes[which].count(item) && random.bits() % 2) {  // a small move
        box = boxes[which][item];
        for (std::size_t i = 0; i < 3; ++i) box.min[i] += 1e-3, box.max[i] += 1e-3;
      }
      trees[which].put(item, box);
      boxes[which][item] = box;
    }
    if (step % 10) continue;
    for (const std::size_t other : {which, 1 - which}) {
      for (const double most : {0.0, 0.5, kInfinity, kNaN}) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found, wanted;
        for (const auto& [a, b] : trees[which].near(trees[other], most)) found.emplace_back(a, b);
        for (const auto& [a, box_a] : boxes[which]) {
          for (const auto& [b, box_b] : boxes[other])
            if ((which != other || a < b) && !(squared_gap(box_a, box_b) > most)) wanted.emplace_back(a, b);
        }
        EXPECT_EQ(found, wanted);
      }
      const auto any = trees[which].nearest(trees[other], [](BoxTree::Pair) { return true; });
      EXPECT_EQ(any.has_value(), which == other ? boxes[which].size() > 1 : !boxes[0].empty() && !boxes[1].empty());
      std::size_t all = 0;
      trees[which].nearest(trees[other], [&](BoxTree::Pair) { return ++all, false; });
      EXPECT_EQ(all, trees[which].near(trees[other], kInfinity).size());
    }
  }
}

WorldBox cube_box(double side, double x = 0) { return {{x - side, -side, -side}, {x + side, side, side}}; }

/// Where surfaces alone would make a chain: as many levels as boxes.
TEST(BoxTree, IsNoChainWhateverTheBoxes) {
  constexpr std::uint32_t kCount = 3000, kMost = 3 * 12 + 16;
  Random random(5);
  std::vector<double> any(kCount);
  for (double& x : any) x = random.uniform(0.5, 100);
  const std::function<WorldBox(std::uint32_t)> families[] = {
      [](std::uint32_t) { return cube_box(1); },                                         // equal
      [](std::uint32_t) { return cube_box(1e50); },                                      // of refused poses
      [](std::uint32_t) { return WorldBox{}; },                                          // without surface
      [](std::uint32_t i) { return cube_box(1.0 + i); },                                 // nested, outwards
      [](std::uint32_t i) { return cube_box(1.0 + kCount - i); },                        // nested, inwards
      [&](std::uint32_t i) { return cube_box(any[i]); },                                 // nested
      [](std::uint32_t i) { return cube_box(std::exp2(i % 100), std::exp2(i % 100)); },  // each as large as all before
      [](std::uint32_t i) {
        return WorldBox{{double(i), 0, 0}, {double(i) + 1, 0, 0}};
      },                                                                                       // in a row
      [&](std::uint32_t i) { return i % 2 ? cube_box(any[i]) : cube_box(0.01, 10 * any[i]); }  // small ones in large ones
  };
  BoxTree tree, one;
  one.put(0, cube_box(1));
  for (std::size_t family = 0; family < std::size(families); ++family) {
    SCOPED_TRACE(family);
    BoxTree own;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      own.put(i, families[family](i));
      tree.put(i, families[family](i));  // moves those of the last family
      if (i % 100) continue;
      EXPECT_LE(own.height(), 3 * std::log2(i + 1) + 3 + 16);
      EXPECT_LE(tree.height(), kMost);
    }
    EXPECT_LE(own.height(), kMost);
    EXPECT_LE(tree.height(), kMost);
    for (std::uint32_t i = 0; i < kCount; i += 3) own.remove(i);
    for (std::uint32_t i = 0; i < kCount; i += 3) own.put(i, families[(family + 1) % std::size(families)](i));
    EXPECT_LE(own.height(), kMost);
    EXPECT_EQ(own.near(one, kInfinity).size(), kCount);
  }
}

/// Where surfaces prefer no child, the tree is at most half as high again as a balanced one.
TEST(BoxTree, IsBalancedWhereBoxesAreEqual) {
  BoxTree tree;
  for (std::uint32_t i = 0; i < 4096; ++i) tree.put(i, cube_box(1));
  EXPECT_LE(tree.height(), 12u * 3 / 2);
}

/// The box of a pose that was refused once does not stay, and an item that shakes does not lose its leaf's.
TEST(BoxTree, ShrinksALeafThatIsMuchTooLarge) {
  BoxTree tree;
  tree.put(0, cube_box(1));
  for (std::uint32_t i = 1; i < 20; ++i) tree.put(i, cube_box(1, 3 * i));
  const WorldBox before = tree.leaf_box(0);
  tree.put(0, cube_box(1e50));
  EXPECT_LE(tree.leaf_box(0).min[0], -1e50);
  EXPECT_EQ(tree.near(tree, 0).size(), 19u);
  tree.put(0, cube_box(1));
  EXPECT_EQ(tree.leaf_box(0).min, before.min);
  EXPECT_EQ(tree.leaf_box(0).max, before.max);
  for (const double x : {0.12, -0.12, 0.0, 0.124, -0.124}) {
    tree.put(0, cube_box(1, x));
    EXPECT_EQ(tree.leaf_box(0).min, before.min) << x;
    EXPECT_EQ(tree.leaf_box(0).max, before.max) << x;
  }
}

/// Scenes of bodies of `make`.
void expect_all_as_brute_force(const auto& make, std::uint64_t seeds, int count) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Random random(seed);
    const Vec3 centre = seed % 3 == 2 ? Vec3(1e15, -3e14, 7e14) : Vec3(0, 0, 0);
    const double reach = std::array{1.5, 3.0, 6.0, 12.0}[seed % 4];
    Scene scene, other;
    for (int i = 0; i < count; ++i) (void)scene.add("", make(random), any_pose(random, reach, centre));
    for (int i = 0; i < 15; ++i) (void)other.add("", make(random), any_pose(random, reach, centre));
    for (int step = 0; step < 4; ++step) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " step " << step);
      expect_as_brute_force(scene, scene, 0.2);
      expect_as_brute_force(scene, other, step == 2 ? 5 : 0.1);
      for (Scene* moved : {&scene, &other}) {
        for (const BodyId id : moved->bodies()) {
          Pose pose = moved->pose(id);
          pose.translation += 0.05 * random.in_ball();
          if (random.bits() % 8 == 0) pose = any_pose(random, reach, centre);
          EXPECT_TRUE(moved->move(id, pose));
        }
      }
    }
  }
}

TEST(Scene, AnswersAsBruteForce) { expect_all_as_brute_force(any_body, 24, 40); }
TEST(Scene, WithMeshesAnswersAsBruteForce) { expect_all_as_brute_force(any_mesh_body, 12, 25); }

/// A table stands on four legs, each a region with a corner of its foot at each of its points.
TEST(Scene, ListsEachRegionOfMeshesInContact) {
  soups::Soup table = soups::box({-1, -1, 0.9}, {1, 1, 1});
  for (const double x : {-0.9, 0.7}) {
    for (const double y : {-0.9, 0.7}) table.add(soups::box({x, y, 0}, {x + 0.2, y + 0.2, 0.9}));
  }
  const MeshModel legs = table.mesh(), floor = soups::patch(9, [](double, double) { return 0.0; }).mesh();
  Scene scene;
  (void)scene.add("table", legs, {.translation = {0, 0, 0.001}});
  (void)scene.add("floor", floor, {});
  for (int frame = 0; frame < 3; ++frame) {
    const auto contacts = scene.contacts({.margin = 0.01});
    ASSERT_EQ(contacts.size(), 4u);
    for (const SceneContact& contact : contacts) {
      EXPECT_EQ(contact.manifold.count, 4u);
      EXPECT_NEAR(contact.answer.lower, 0.001, 1e-12);
      for (std::uint32_t i = 0; i < contact.manifold.count; ++i)
        EXPECT_NEAR(contact.manifold.points[i].separation, 0.001, 1e-9);
    }
  }
}

/// More regions than a first look has room for: spikes on a floor.
TEST(Scene, ListsAllOfManyRegions) {
  soups::Soup spikes;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      spikes.add(soups::moved(soups::scaled(soups::tetrahedron(), 0.2), Mat3::Identity(), Vec3(x, y, 0.2)));
  const MeshModel bed = spikes.mesh();
  Scene scene;
  (void)scene.add("floor", Body::box({-5, -5, -1}, {25, 25, 0}), {});
  (void)scene.add("spikes", bed, {.translation = {0, 0, 0.001}});
  const auto contacts = scene.contacts({.margin = 0.01});
  EXPECT_EQ(contacts.size(), 400u);
  for (const SceneContact& contact : contacts) EXPECT_EQ(contact.answer.status, Status::Converged);
}

/// A table that slides keeps the points of each foot.
TEST(Scene, RegionsKeepTheirPoints) {
  soups::Soup table = soups::box({-1, -1, 0.9}, {1, 1, 1});
  for (const double x : {-0.9, 0.7}) {
    for (const double y : {-0.9, 0.7}) table.add(soups::box({x, y, 0}, {x + 0.2, y + 0.2, 0.9}));
  }
  const MeshModel legs = table.mesh(), floor = soups::scaled(soups::patch(9, [](double, double) { return 0.0; }), 2).mesh();
  Scene scene;
  (void)scene.add("floor", floor, {});
  const BodyId id = scene.add("table", legs, {.translation = {0, 0, 0.001}});
  const auto corners = [](const SceneContact& contact) {
    std::set<std::uint32_t> all;
    for (std::uint32_t i = 0; i < contact.manifold.count; ++i) all.insert(contact.manifold.points[i].feature_b.index());
    return all;
  };
  std::set<std::set<std::uint32_t>> before, after;
  for (const SceneContact& contact : scene.contacts({.margin = 0.01})) before.insert(corners(contact));
  EXPECT_TRUE(scene.move(id, {.translation = {1e-4, 2e-4, 0.001}}));
  for (const SceneContact& contact : scene.contacts({.margin = 0.01})) after.insert(corners(contact));
  EXPECT_EQ(before.size(), 4u);
  EXPECT_EQ(before, after);
}

TEST(Scene, FindsASolidInASolid) {
  const MeshModel outer = soups::ball(2).mesh(), inner = soups::scaled(soups::ball(1), 0.25).mesh();
  for (const bool solid : {false, true}) {
    Scene scene;
    (void)scene.add("outer", solid ? MeshBody::solid(outer) : MeshBody(outer), {});
    (void)scene.add("inner", inner, {});
    EXPECT_EQ(scene.overlapping().size(), solid ? 1u : 0u);
    const auto contacts = scene.contacts({.margin = 0.01});
    ASSERT_EQ(contacts.size(), solid ? 1u : 0u);
    if (solid) {
      EXPECT_LT(contacts[0].answer.upper, -0.5);
    }
  }
}

/// However near the surfaces are: their regions are apart, the bodies are not.
TEST(Scene, FindsASolidInASolidBesideItsWall) {
  const MeshModel outer = soups::ball(2).mesh(), inner = soups::scaled(soups::ball(1), 0.25).mesh();
  Pose aside;
  aside.translation = {0.7, 0, 0};
  for (const bool solid : {false, true}) {
    Scene scene;
    (void)scene.add("outer", solid ? MeshBody::solid(outer) : MeshBody(outer), {});
    (void)scene.add("inner", inner, aside);
    const auto contacts = scene.contacts({.margin = 0.2});
    ASSERT_GE(contacts.size(), 1u);
    for (const SceneContact& contact : contacts)
      EXPECT_EQ(contact.answer.verdict, solid ? Verdict::Overlapping : Verdict::Disjoint);
    if (solid) {
      EXPECT_LT(contacts[0].answer.upper, -0.25);
    }
  }
}

/// Of a mesh as of a convex body: pairs that are proved to be less deep are left out.
TEST(Scene, AMarginBelowZeroAsksForDepth) {
  const MeshModel ball = soups::ball(2).mesh(), shell = soups::scaled(soups::ball(2), 3).mesh();
  const Body convex(models()[0]);
  int listed = 0, left_out = 0;
  for (const double radius : {0.0, 0.1}) {
    for (const double aside : {0.25, 1.875, 2.5}) {  // deep, nearly apart, apart
      Pose pose;
      pose.translation = {aside, 0, 0};
      const MeshBody solid = MeshBody::solid(ball, radius);
      for (const MeshBody& other : {solid, MeshBody(ball, radius), MeshBody(shell, radius), MeshBody(convex)}) {
        const Answer depth = signed_distance(solid, other, pose);
        for (const double margin : {-0.01, -0.2}) {
          const Answer stopped = signed_distance(solid, other, pose, {.beyond = margin});
          EXPECT_LE(stopped.lower, depth.upper);
          EXPECT_GE(stopped.upper, depth.lower);
          EXPECT_EQ(stopped.lower > 0, depth.lower > 0) << radius << ' ' << aside << ' ' << margin;
          Scene scene;
          (void)scene.add("ball", solid, {});
          (void)scene.add("other", other, pose);
          const auto contacts = scene.contacts({.margin = margin});
          ASSERT_EQ(contacts.size(), depth.lower <= margin ? 1u : 0u) << radius << ' ' << aside << ' ' << margin;
          contacts.empty() ? ++left_out : ++listed;
          if (contacts.empty()) continue;
          EXPECT_EQ(contacts[0].answer.verdict, Verdict::Overlapping);
          EXPECT_LE(contacts[0].answer.lower, margin);
          EXPECT_LE(contacts[0].answer.upper, 0);
          EXPECT_EQ(contacts[0].manifold.count, 0u);
        }
      }
    }
  }
  EXPECT_GE(listed, 12);
  EXPECT_GE(left_out, 12);
}

/// A body that takes the place of one that was removed has no contacts from before.
TEST(Scene, ContactsOfARemovedBodyGoWithIt) {
  Random random(31);
  const Body floor = Body::box({-2, -2, -1}, {2, 2, 1}), block = Body::box({-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 300; ++i) {
    const auto above = [&] {
      const double turn = random.uniform(0, 6);
      Pose pose;
      pose.rotation << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1;
      pose.translation = {random.uniform(-1, 1), random.uniform(-1, 1), 2};
      return pose;
    };
    const Pose first = above(), second = above();
    Scene used, fresh;
    (void)used.add("floor", floor, {});
    const BodyId gone = used.add("block", block, first);
    (void)used.contacts({.margin = 0.01});
    used.remove(gone);
    for (Scene* scene : {&used, &fresh}) {
      if (scene == &fresh) (void)fresh.add("floor", floor, {});
      ASSERT_EQ(scene->add("block", block, second).index, gone.index);
    }
    const ManifoldOptions options{.margin = 0.01, .most_points = 2};
    const auto contacts = used.contacts(options), wanted = fresh.contacts(options);
    ASSERT_EQ(contacts.size(), 1u);
    ASSERT_EQ(wanted.size(), 1u);
    const Manifold &m = contacts[0].manifold, &w = wanted[0].manifold;
    ASSERT_EQ(m.count, w.count);
    for (std::uint32_t k = 0; k < m.count; ++k) EXPECT_EQ(m.points[k].point_a, w.points[k].point_a) << i;
  }
}

/// As a distance takes it: it bounds nothing.
TEST(Scene, TheNearestPairUpToNaNIsTheNearest) {
  Scene scene;
  for (const double x : {0.0, 50.0, 53.0}) {
    Pose pose;
    pose.translation = {x, 0, 0};
    (void)scene.add("", Body(models()[0]), pose);
  }
  const NearestPair nearest = scene.nearest({.beyond = kNaN}), wanted = scene.nearest();
  EXPECT_EQ(nearest.a, wanted.a);
  EXPECT_EQ(nearest.b, wanted.b);
  EXPECT_EQ(nearest.lower, wanted.lower);
  EXPECT_TRUE(scene.has(nearest.a));
}

/// In whatever order the bodies came, and whatever bound is asked for.
TEST(Scene, TheNearestPairIsTheOneThatOverlaps) {
  const MeshModel ball = soups::ball(2).mesh();
  const std::vector<MeshBody> bodies{MeshBody(ball), MeshBody(Body(models()[0]))};
  for (const MeshBody& body : bodies) {
    std::vector<int> order{0, 1, 2, 3};
    const double places[4][2] = {{0, 0}, {1.45, 1.45}, {50, 0}, {50.5, 0}};
    do {
      for (const double beyond : {0.0, 0.1, 10.0, kInfinity}) {
        Scene scene;
        for (const int i : order) {
          Pose pose;
          pose.translation = {places[i][0], places[i][1], 0};
          (void)scene.add(std::to_string(i), body, pose);
        }
        const NearestPair nearest = scene.nearest({.beyond = beyond});
        ASSERT_TRUE(scene.has(nearest.a));
        EXPECT_EQ(nearest.answer.verdict, Verdict::Overlapping);
        EXPECT_EQ(nearest.answer.upper, 0);
        EXPECT_EQ(nearest.lower, 0);
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

/// Every pair of triangles of every pair of meshes, in long doubles.
TEST(Scene, FindsMeshesAsTheirTrianglesAre) {
  Random random(23);
  const soups::Soup soups[] = {soups::torus(9, 5), soups::tetrahedron(), soups::scattered(random, 20, 0.6)};
  int near = 0, far = 0;
  for (int round = 0; round < 6; ++round) {
    Scene scene;
    std::vector<std::size_t> kind;
    for (int i = 0; i < 12; ++i) {
      kind.push_back(random.bits() % std::size(soups));
      const MeshModel mesh = soups[kind.back()].mesh();
      (void)scene.add("", mesh, any_pose(random, 3.5, {0, 0, 0}));
    }
    Ids within, overlapping;
    for (const ScenePair& pair : scene.within(0.3)) within.emplace(pair.a, pair.b);
    for (const ScenePair& pair : scene.overlapping()) overlapping.emplace(pair.a, pair.b);
    double least = kInfinity;
    all_pairs(scene, scene, [&](BodyId a, BodyId b, const MeshBody& body_a, const MeshBody& body_b, const Pose& pose) {
      const double truth = soups::brute_force(soups[kind[a.index]], soups[kind[b.index]], pose);
      const double bound = tolerance(body_a, body_b, pose);
      least = std::min(least, truth);
      (truth < 0.3 ? near : far)++;
      EXPECT_TRUE((within.count({a, b}) > 0) == (truth < 0.3) || std::abs(truth - 0.3) <= bound) << truth;
      EXPECT_TRUE((overlapping.count({a, b}) > 0) == (truth == 0) || (truth > 0 && truth <= bound)) << truth;
    });
    const NearestPair nearest = scene.nearest();
    EXPECT_LE(nearest.lower, least + 1e-14);
    EXPECT_GE(nearest.answer.upper, least - 1e-14);
  }
  EXPECT_GT(near, 40);
  EXPECT_GT(far, 100);
}

/// Pairs whose boxes just do not touch, but of which queries say Touching: law 2's bound is widest in frames as far from
/// orthonormal as queries take.
TEST(Scene, MissesNoPairThatTouches) {
  Random random(3);
  int touching = 0;
  for (int round = 0; round < 600; ++round) {
    const double side = std::array{1.0, 0.125, 4.0}[std::size_t(round % 3)], strain = 2e-7 * (round % 2);
    const Body cube = cubes()[std::size_t(round % 3)];
    Pose first{Mat3::Identity() * (1 + strain), random.in_ball()}, second = first;
    second.translation += side * Vec3((1 + strain) * (1 + 1e-15 * (round % 8)), random.uniform(-1, 1), random.uniform(-1, 1));
    Scene scene;
    (void)scene.add("", cube, first);
    (void)scene.add("", cube, second);
    touching += int(intersects(cube, cube, relative(first, second)).verdict == Verdict::Touching);
    expect_as_brute_force(scene, scene, 0);
  }
  EXPECT_GT(touching, 300);
}

/// Where coordinates in the world are rounded by more than boxes are larger than bodies.
TEST(Scene, FindsWhatTouchesFarFromTheOrigin) {
  for (const double far : {1e12, 1e15}) {
    const double ulp = std::nextafter(far, 2 * far) - far;
    for (int i = 0; i < 64; ++i) {
      const double end = 1 + ulp * i / 64;
      Scene scene;
      (void)scene.add("", Body::box({0, 0, 0}, {end, 1, 1}), {.translation = {far, 0, 0}});
      (void)scene.add("", Body::box({end - 1, 0, 0}, {end, 1, 1}), {.translation = {far + 1, 0, 0}});
      EXPECT_EQ(scene.overlapping().size(), 1u) << far << ' ' << i;
    }
  }
}

TEST(Scene, NamesIdsAndChurn) {
  Random random(7);
  Scene scene;
  std::map<std::string, BodyId> there;
  std::vector<BodyId> gone;
  for (int step = 0; step < 400; ++step) {
    const std::string name = "body " + std::to_string(random.bits() % 50);
    const auto found = there.find(name);
    EXPECT_EQ(scene.find(name), found == there.end() ? BodyId{} : found->second);
    if (found == there.end()) {
      const BodyId id = scene.add(name, any_mesh_body(random), any_pose(random, 4, {0, 0, 0}));
      EXPECT_TRUE(scene.has(id));
      EXPECT_EQ(scene.name(id), name);
      EXPECT_EQ(std::count(gone.begin(), gone.end(), id), 0) << "an id came back";
      there[name] = id;
    } else if (random.bits() % 2) {
      EXPECT_EQ(scene.add(name, any_body(random), Pose{}), BodyId{}) << "a name twice";
      EXPECT_TRUE(scene.move(found->second, any_pose(random, 4, {0, 0, 0})));
    } else {
      EXPECT_TRUE(scene.remove(found->second));
      gone.push_back(found->second);
      there.erase(found);
    }
    EXPECT_EQ(scene.size(), there.size());
    if (step % 20 == 0) expect_as_brute_force(scene, scene, 0.1);
  }
  for (const BodyId id : gone) {
    EXPECT_FALSE(scene.has(id) || scene.move(id, Pose{}) || scene.remove(id));
    EXPECT_TRUE(scene.name(id).empty());
    EXPECT_TRUE(std::isnan(scene.pose(id).translation[0]));
  }
  EXPECT_FALSE(scene.remove({}));
  EXPECT_EQ(scene.find(""), BodyId{});
}

TEST(Scene, OfNoneAndOne) {
  Scene none, one(models()[0], Pose{});
  for (Scene* scene : {&none, &one}) {
    EXPECT_TRUE(scene->overlapping().empty() && scene->within(kInfinity).empty() && scene->contacts().empty());
    EXPECT_EQ(scene->nearest().a, BodyId{});
    EXPECT_EQ(scene->nearest().lower, kInfinity);
  }
  EXPECT_TRUE(none.overlapping(one).empty() && one.overlapping(none).empty());
  EXPECT_EQ(one.overlapping(Scene(models()[1], Pose{})).size(), 1u);
  Pose away;
  away.translation = {10, 0, 0};
  const NearestPair far = one.nearest(Scene(models()[1], away), {.beyond = 2});
  EXPECT_EQ(far.a, BodyId{});
  EXPECT_EQ(far.lower, 2);
}

/// The model may go: the scene shares its block.
TEST(Scene, KeepsItsModels) {
  Scene scene;
  {
    const Model model = cube_model(2);
    (void)scene.add("a", model, Pose{});
    (void)scene.add("b", Body(model, 0.5), Pose{.translation = {0.5, 0, 0}});
  }
  {
    const MeshModel mesh = soups::box({-1, -1, -1}, {1, 1, 1}).mesh();
    (void)scene.add("c", MeshBody(mesh, 0.25), Pose{.translation = {0, 0, 2}});
  }
  Scene moved = std::move(scene);
  EXPECT_EQ(moved.overlapping().size(), 3u);
  EXPECT_EQ(moved.body(moved.find("b")).radius(), 0.5);
  EXPECT_EQ(moved.mesh_body(moved.find("b")).convex().model(), moved.body(moved.find("b")).model());
  EXPECT_EQ(moved.mesh_body(moved.find("c")).radius(), 0.25);
  EXPECT_EQ(moved.mesh_body(moved.find("c")).mesh()->triangle_count(), 12u);
  EXPECT_EQ(intersects(moved.body(moved.find("c")), models()[0], Pose{}).status, Status::InvalidBody) << "no convex body";
}

TEST(Scene, WhatQueriesRefuseIsListedWithItsStatus) {
  Scene scene;
  const BodyId a = scene.add("a", models()[0], Pose{});
  const BodyId b = scene.add("b", models()[1], Pose{.translation = {100, 0, 0}});
  EXPECT_TRUE(scene.overlapping().empty());
  Pose bad;
  bad.translation[1] = kNaN;
  EXPECT_TRUE(scene.move(b, bad));
  for (const auto& pairs : {scene.overlapping(), scene.within(0.1), scene.distances({.beyond = 1})}) {
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].answer.status, Status::InvalidPose);
  }
  ASSERT_EQ(scene.contacts().size(), 1u);
  EXPECT_EQ(scene.contacts()[0].manifold.count, 0u);
  EXPECT_EQ(scene.nearest().answer.status, Status::InvalidPose);
  EXPECT_EQ(scene.nearest().lower, 0);
  EXPECT_TRUE(scene.move(b, Pose{.translation = {100, 0, 0}}));
  EXPECT_TRUE(scene.overlapping().empty());
  EXPECT_EQ(scene.nearest().answer.status, Status::Converged);
  bad = {.rotation = 1.1 * Mat3::Identity()};
  EXPECT_EQ(scene.overlapping(Scene(models()[0], bad)).size(), 2u);
  // The relative pose of two that err alike is legal.
  Scene alike;
  (void)alike.add("a", models()[0], bad);
  bad.translation[0] = 100;
  (void)alike.add("b", models()[1], bad);
  EXPECT_EQ(alike.overlapping().at(0).answer.status, Status::InvalidPose);
  EXPECT_EQ(alike.nearest().answer.status, Status::InvalidPose);
  EXPECT_EQ(scene.overlapping(Scene(Body(), Pose{})).at(1).answer.status, Status::InvalidBody);
  EXPECT_EQ(scene.overlapping(Scene(Body(models()[0], -1), Pose{})).at(0).answer.status, Status::InvalidRadius);
  EXPECT_EQ(scene.within(kNaN).size(), 1u) << "no pair is proved farther apart than NaN";
  EXPECT_EQ(scene.within(Scene(models()[0], Pose{}), 50).size(), 1u);
  EXPECT_TRUE(scene.has(a));
}

bool same_bytes(const auto& left, const auto& right) {
  if (left.size() != right.size()) return false;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].a != right[i].a || left[i].b != right[i].b ||
        std::memcmp(&left[i].answer, &right[i].answer, sizeof(Answer)) != 0)
      return false;
  }
  return true;
}

TEST(Scene, OnThreadsTheSameBytes) {
  const Executor threads = on_threads(4);
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    while (count > 0) task(--count);
  };
  Random random(11);
  Scene scenes[3];
  scenes[1].run_by({.executor = threads});
  scenes[2].run_by({.executor = backwards});
  for (int i = 0; i < 400; ++i) {
    const MeshBody body = i % 8 ? MeshBody(any_body(random)) : any_mesh_body(random);
    const Pose pose = any_pose(random, 6, {0, 0, 0});
    for (Scene& scene : scenes) (void)scene.add("", body, pose);
  }
  std::size_t listed = 0;
  for (int step = 0; step < 5; ++step) {
    const auto overlapping = scenes[0].overlapping();
    const auto within = scenes[0].within(0.2);
    const auto distances = scenes[0].distances({.relative = 0.01, .beyond = 0.3});
    const auto contacts = scenes[0].contacts({.margin = 0.05});
    const std::vector<NearestPair> nearest{scenes[0].nearest()};
    listed += overlapping.size();
    for (Scene* scene : {&scenes[1], &scenes[2]}) {
      EXPECT_TRUE(same_bytes(overlapping, scene->overlapping()));
      EXPECT_TRUE(same_bytes(within, scene->within(0.2)));
      EXPECT_TRUE(same_bytes(distances, scene->distances({.relative = 0.01, .beyond = 0.3})));
      const auto again = scene->contacts({.margin = 0.05});
      EXPECT_TRUE(same_bytes(contacts, again));
      for (std::size_t i = 0; i < again.size(); ++i) {
        ASSERT_EQ(contacts[i].manifold.count, again[i].manifold.count);
        for (std::uint32_t k = 0; k < again[i].manifold.count; ++k)
          EXPECT_EQ(contacts[i].manifold.points[k].point_a, again[i].manifold.points[k].point_a);
      }
      EXPECT_TRUE(same_bytes(nearest, std::vector{scene->nearest()}));
    }
    for (const BodyId id : scenes[0].bodies()) {
      Pose pose = scenes[0].pose(id);
      pose.translation += 0.05 * random.in_ball();
      for (Scene& scene : scenes) scene.move(id, pose);
    }
  }
  EXPECT_GT(listed, 1000u);
}

/// What is kept of pairs changes the work, never the truth.
std::pair<std::uint64_t, std::uint64_t> steps_warm_and_cold(const auto& make) {
  Random random(13);
  Scene warm;
  for (int i = 0; i < 60; ++i) (void)warm.add("", make(random), any_pose(random, 4, {0, 0, 0}));
  std::uint64_t steps_warm = 0, steps_cold = 0;
  for (int step = 0; step < 30; ++step) {
    Scene cold;
    for (const BodyId id : warm.bodies()) {
      Pose pose = warm.pose(id);
      pose.translation += 0.01 * random.in_ball();
      warm.move(id, pose);
      EXPECT_EQ(cold.add("", warm.mesh_body(id), pose), id);
    }
    const auto left = warm.distances({.beyond = 0.5}), right = cold.distances({.beyond = 0.5});
    EXPECT_EQ(ids(left), ids(right));
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i].answer.verdict, right[i].answer.verdict);
      EXPECT_LE(left[i].answer.lower, right[i].answer.upper);
      EXPECT_LE(right[i].answer.lower, left[i].answer.upper);
      steps_warm += left[i].answer.steps;
      steps_cold += right[i].answer.steps;
    }
  }
  return {steps_warm, steps_cold};
}

TEST(Scene, WarmAsCold) {
  const auto [warm, cold] = steps_warm_and_cold(any_body);
  EXPECT_LT(2 * warm, cold);
}
TEST(Scene, WithMeshesWarmAsCold) {
  const auto [warm, cold] = steps_warm_and_cold(any_mesh_body);
  EXPECT_LT(4 * warm, 3 * cold);
}

/// Bytes of the heap that are in use.
std::size_t heap() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;  // nothing tells
#endif
}

/// By what the steps after the first hundred make the heap grow: turn(step).
std::ptrdiff_t growth(const auto& turn) {
  std::size_t before = 0;
  for (int step = 0; step < 4000; ++step) {
    if (step == 100) before = heap();
    turn(step);
  }
  return std::ptrdiff_t(heap() - before);
}
constexpr std::ptrdiff_t kLittle = 20'000;  // a hundredth of what 3 900 seeds take

TEST(Scene, ForgetsScenesThatAreGone) {
  Scene scene(cubes()[0], Pose{});
  EXPECT_LE(growth([&](int) { EXPECT_EQ(scene.overlapping(Scene(cubes()[0], Pose{})).size(), 1u); }), kLittle);
}

TEST(Scene, UsesThePlacesOfRemovedBodiesAgain) {
  Scene scene(cubes()[0], Pose{});
  EXPECT_LE(growth([&](int) { EXPECT_TRUE(scene.remove(scene.add("name", cubes()[0], Pose{}))); }), kLittle);
}

TEST(Scene, ForgetsPairsThatParted) {
  Scene scene;
  const BodyId visitor = scene.add("", cubes()[0], Pose{});
  for (int i = 0; i < 4000; ++i) (void)scene.add("", cubes()[0], {.translation = {2.0 * i, 0, 0}});
  const auto visit = [&](int step) {
    scene.move(visitor, {.translation = {2.0 * step, 0.5, 0}});
    EXPECT_EQ(scene.overlapping().size(), 1u);
  };
  EXPECT_LE(growth(visit), kLittle);
}

TEST(Scene, AsksOnlyWhatIsWanted) {
  Random random(17);
  Scene scene, other;
  for (int i = 0; i < 10; ++i) {
    (void)scene.add("", cubes()[0], Pose{.translation = {0.5 * i, 0, 0}});
    (void)other.add("", cubes()[0], Pose{.translation = {0.5 * i, 0, 0}});
  }
  EXPECT_EQ(scene.overlapping().size(), 9u + 8u);  // those that touch too
  scene.ask_only([](BodyId a, BodyId b) { return b.index - a.index > 2; });
  EXPECT_TRUE(scene.overlapping().empty());
  const NearestPair nearest = scene.nearest();
  EXPECT_EQ(nearest.b.index - nearest.a.index, 3u);
  EXPECT_NEAR(nearest.answer.value(), 0.5, 1e-12);
  EXPECT_EQ(scene.overlapping(other).size(), 10u + 2 * (9u + 8u));
  scene.ask_only([](BodyId, BodyId) { return false; });
  EXPECT_EQ(scene.nearest().a, BodyId{});
}

/// Below a distance of 1e-162 squares are 0; law 2's bound is 2^-450 at least.
TEST(Scene, ListsPairsAtDistancesWhoseSquaresAreNone) {
  for (int exponent = -1060; exponent < -400; exponent += 3) {
    for (const Vec3& direction : {Vec3(1, 1, 1), Vec3(1, 0, 0), Vec3(0.7, -0.1, 0)}) {
      const Vec3 aside = std::ldexp(1, exponent) * direction;
      Scene scene;
      (void)scene.add("", Body::point({0, 0, 0}), Pose{});
      (void)scene.add("", Body::point({0, 0, 0}), Pose{.translation = aside});
      const Body point = Body::point({0, 0, 0});
      const Pose pose = relative(Pose{}, {.translation = aside});
      SCOPED_TRACE(exponent);
      EXPECT_EQ(scene.overlapping().size(), intersects(point, point, pose).verdict != Verdict::Disjoint);
      for (const double share : {0.0, 0.5, 0.999, 1.0, 1.001, 2.0}) {
        const double threshold = share * aside.stableNorm();
        EXPECT_EQ(scene.within(threshold).size(), within(point, point, pose, threshold).decision != Decision::No);
        EXPECT_EQ(scene.distances({.beyond = threshold}).size(), distance(point, point, pose).lower <= threshold);
      }
    }
  }
}

/// No pair is as near as a number below 0, as `distances` says, whatever is refused.
TEST(Scene, TheNearestPairIsNotBeyond) {
  Scene scene;
  for (const double x : {0.0, 0.5, 0.75}) (void)scene.add("", cubes()[0], Pose{.translation = {x, 0, 0}});
  for (const double beyond : {-1.0, -0.0, 0.0, 1.0, kNaN}) {
    SCOPED_TRACE(beyond);
    const NearestPair nearest = scene.nearest({.beyond = beyond});
    const bool is_found = !(beyond < 0);
    EXPECT_EQ(scene.has(nearest.a), is_found);
    EXPECT_EQ(nearest.lower, is_found ? 0 : beyond);
    EXPECT_EQ(scene.distances({.beyond = beyond}).empty(), !is_found);
  }
  Scene refused;
  for (const double x : {0.0, 9.0}) (void)refused.add("", Body::point({0, 0, 0}, -1), Pose{.translation = {x, 0, 0}});
  EXPECT_TRUE(refused.distances({.beyond = -1}).empty());
  EXPECT_EQ(refused.nearest({.beyond = -1}).a, BodyId{});
  EXPECT_EQ(refused.distances({.beyond = 0}).size(), 1u);
  EXPECT_EQ(refused.nearest({.beyond = 0}).answer.status, Status::InvalidRadius);
}

TEST(Scene, WhatWasStoppedIsListedAsNotAsked) {
  Scene scene;
  for (int i = 0; i < 300; ++i) (void)scene.add("", cubes()[0], Pose{.translation = {1.001 * i, 0, 0}});
  EXPECT_TRUE(scene.overlapping().empty());
  int tasks = 0;
  scene.run_by({.stop = [&tasks] { return ++tasks > 1; }});
  const auto pairs = scene.within(0.000999);
  EXPECT_GT(pairs.size(), 50u);
  for (const ScenePair& pair : pairs) EXPECT_EQ(pair.answer.status, Status::NotAsked);
  tasks = 0;
  scene.run_by({.stop = [&tasks] { return ++tasks == 2; }});
  EXPECT_EQ(scene.within(0.000999).size(), pairs.size()) << "it stays stopped";
  EXPECT_EQ(tasks, 2);
  scene.run_by({});
  EXPECT_TRUE(scene.within(0.000999).empty());
}

/// A point of contact keeps its place while two others' bodies come and go.
TEST(Scene, ManifoldsStay) {
  Scene scene;
  const BodyId floor = scene.add("floor", Body::box({-50, -50, -1}, {50, 50, 0}), Pose{});
  std::vector<BodyId> dice;
  for (int i = 0; i < 30; ++i) dice.push_back(scene.add("", cubes()[0], Pose{.translation = {1.5 * i - 20, 0, 0.501}}));
  auto before = scene.contacts({.margin = 0.01});
  ASSERT_EQ(before.size(), dice.size());
  EXPECT_EQ(before[0].a, floor);
  for (const SceneContact& contact : before) EXPECT_EQ(contact.manifold.count, 4u);
  EXPECT_TRUE(scene.remove(dice[4]));
  for (const BodyId id : dice) {
    Pose pose = scene.pose(id);
    pose.translation += Vec3(1e-3, 0, -2e-4);
    if (id != dice[4]) scene.move(id, pose);
  }
  const auto after = scene.contacts({.margin = 0.01});
  ASSERT_EQ(after.size(), dice.size() - 1);
  for (const SceneContact& contact : after) {
    const auto old = std::find_if(before.begin(), before.end(), [&](const SceneContact& c) { return c.b == contact.b; });
    ASSERT_NE(old, before.end());
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(contact.manifold.points[k].feature_b, old->manifold.points[k].feature_b);
  }
}

}  // namespace
}  // namespace swiftlet
