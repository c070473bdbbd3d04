// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// SWIFT++'s trees and queries with every set of accelerations, against brute force over all pairs of triangles; of solids
// inside solids by rational arithmetic.
#include <swiftlet/build_hull_tree.h>
#include <swiftlet/hull_tree.h>
#include <swiftlet/march.h>
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "solid_truth.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The surface of the unit cubes of a lattice that are filled.
template <class Filled>
Soup cubes(int nx, int ny, int nz, const Filled& filled) {
  Soup soup;
  const auto is_filled = [&](int x, int y, int z) {
    return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && filled(x, y, z);
  };
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) {
        if (!is_filled(x, y, z)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (int side = 0; side < 2; ++side) {
            int next[3] = {x, y, z};
            next[axis] += side ? 1 : -1;
            if (is_filled(next[0], next[1], next[2])) continue;
            Vec3 corner(x, y, z), u = Vec3::Zero(), v = Vec3::Zero();
            corner[axis] += side;
            (side ? u : v)[(axis + 1) % 3] = 1, (side ? v : u)[(axis + 2) % 3] = 1;
            soup.add(corner, corner + u, corner + u + v);
            soup.add(corner, corner + u + v, corner + v);
          }
        }
      }
    }
  }
  return soup;
}

Decomposition one_by_one(const MeshModel& mesh) {
  Decomposition d;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    d.triangles.push_back(t);
    d.patches.push_back({t, t + 1, 0, true});
  }
  return d;
}

struct Body {
  std::string name;
  Soup soup;
  HullTree tree;
};

template <class T>
T needed(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

Body body(const std::string& name, const Soup& soup, bool by_patches, HullSplit split = HullSplit::Midpoint) {
  const MeshModel mesh = soup.mesh();
  const Decomposition patches = by_patches ? needed(decompose(mesh)) : one_by_one(mesh);
  HullTreeOptions options;
  options.split = split;
  return {name, soup, needed(build_hull_tree(mesh, patches, options))};
}

Soup posts() {
  return cubes(7, 3, 5, [](int x, int y, int z) { return z < 1 || (y == 1 && (x == 1 || x == 5)); });
}
Soup middled(Soup soup) { return moved(scaled(std::move(soup), 0.25), Mat3::Identity(), Vec3(-0.75, -0.375, -0.5)); }
Soup dented(int times) {
  Soup soup = ball(times);
  for (Vec3& p : soup.points)
    p *= 0.8 + 0.2 * std::sin(9 * p.x() + 2) * std::cos(7 * p.y() - 5 * p.z());  // equal points stay equal
  return soup;
}

std::vector<HullSearch> searches() {
  std::vector<HullSearch> all;
  for (int bits = 0; bits < 8; ++bits) all.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
  HullSearch other;
  other.start = HullStart::Centres, all.push_back(other);
  other.front = true, other.features = false, all.push_back(other);
  other.priority = true, other.most_queued = 3, all.push_back(other);
  return all;
}
std::string name_of(const HullSearch& s) {
  return std::string(s.piece_caching ? " PC" : "") + (s.priority ? " PD" : "") + (s.front ? " FT" : "");
}

/// The distance of the bodies, by brute force; 0 of a closed one inside another.
double truth(const Body& a, const Body& b, const Pose& pose) {
  const double surfaces = brute_force(a.soup, b.soup, pose);
  if (!(surfaces > 0)) return 0;
  const auto of_a = triangles<Number>(a.soup), of_b = triangles<Number>(b.soup, pose);
  // One vertex of each is enough: the bodies have one component each.
  if (a.tree.body().is_solid() && inside(of_a, of_b[0][0])) return 0;
  if (b.tree.body().is_solid() && inside(of_b, of_a[0][0])) return 0;
  return surfaces;
}

double radius_of(const Body& b) {
  double radius = 0;
  for (const Vec3& p : b.soup.points) radius = std::max(radius, p.norm());
  return radius;
}

class Trial {
 public:
  Trial(const Body& a, const Body& b) : a_(a), b_(b) {
    for (const HullSearch& search : searches()) {
      for (int kind = 0; kind < 4; ++kind) pairs_.emplace_back(a.tree, b.tree, search);
    }
  }

  void judge(const Pose& pose) {
    const double d = truth(a_, b_, pose), slack = 2 * tolerance(a_.tree.body(), b_.tree.body(), pose);
    overlaps_ += d == 0, apart_ += d > slack;
    std::size_t next = 0;
    for (const HullSearch& search : searches()) {
      SCOPED_TRACE(a_.name + ", " + b_.name + name_of(search) + ", distance " + std::to_string(d));
      HullPair &exact = pairs_[next++], &rough = pairs_[next++], &yes_no = pairs_[next++], &contacts = pairs_[next++];
      check(exact.distance(pose).answer, d, slack, slack);
      const Answer loose = rough.distance(pose, 0, 0.1).answer;
      check(loose, d, slack, std::max(slack, 0.1 * d));
      const Answer meet = yes_no.intersects(pose).answer;
      if (d > slack) {
        EXPECT_EQ(meet.verdict, Verdict::Disjoint);
      }
      // Of surfaces in contact within rounding either verdict is right.
      if (d == 0 && touching_by_a_margin(pose)) {
        EXPECT_EQ(meet.verdict, Verdict::Overlapping);
      }
      for (const double factor : {0.5, 0.9, 1.1, 2.0}) {
        if (d > 100 * slack) {
          EXPECT_EQ(yes_no.within(pose, factor * d), factor > 1 ? Decision::Yes : Decision::No) << factor;
        }
      }
      const Answer far = exact.distance(pose, 0, 0, d / 2).answer;
      EXPECT_LE(far.lower, d + slack);
      if (d > 100 * slack) {
        EXPECT_GT(far.lower, d / 2);
      }
      check_contacts(contacts, pose, d, slack);
    }
  }
  int overlaps() const { return overlaps_; }
  int apart() const { return apart_; }

 private:
  void check(const Answer& answer, double d, double slack, double width) const {
    ASSERT_TRUE(answer.status == Status::Converged) << int(answer.status);
    EXPECT_LE(answer.lower, d + slack);
    EXPECT_GE(answer.upper, d - slack);
    EXPECT_LE(answer.upper - answer.lower, width * 1.001);
    if (d > slack) {
      EXPECT_EQ(answer.verdict, Verdict::Disjoint);
      const double apart = (answer.point_b - answer.point_a).norm();
      EXPECT_NEAR(apart, answer.upper, slack);
    }
    if (answer.verdict == Verdict::Overlapping) {
      EXPECT_LE(d, slack);
    }
  }
  /// True if also slightly moved bodies meet: the truth of `brute_force` is rounded.
  bool touching_by_a_margin(const Pose& pose) const {
    const double by = 1e-6;
    for (int k = 0; k < 6; ++k) {
      Pose moved = pose;
      moved.translation[k / 2] += k % 2 ? by : -by;
      if (truth(a_, b_, moved) > 0) return false;
    }
    return true;
  }
  void check_contacts(HullPair& pair, const Pose& pose, double d, double slack) const {
    const double reach = d + 0.05;
    const std::vector<HullAnswer>& found = pair.contacts(pose, reach);
    if (found.size() == 1 && found[0].answer.verdict == Verdict::Overlapping) {
      EXPECT_LE(d, slack);
      return;
    }
    // Every pair of pieces within reach is there.
    std::set<std::pair<std::uint32_t, std::uint32_t>> pieces;
    for (const HullAnswer& contact : found) {
      pieces.insert({contact.node_a, contact.node_b});
      EXPECT_LE(contact.answer.lower, reach + slack);
      EXPECT_LE(contact.answer.lower, patches_apart(contact.node_a, contact.node_b, pose) + slack);
    }
    EXPECT_EQ(pieces.size(), found.size()) << "a pair of pieces is there twice";
    for (std::uint32_t i = 0; i < a_.tree.nodes().size(); ++i) {
      if (!a_.tree.nodes()[i].is_piece()) continue;
      for (std::uint32_t k = 0; k < b_.tree.nodes().size(); ++k) {
        if (!b_.tree.nodes()[k].is_piece() || pieces.count({i, k}) != 0) continue;
        if (patches_near(i, k, pose, reach)) {
          EXPECT_GE(patches_apart(i, k, pose), reach - slack);
        }
      }
    }
  }
  /// Looks at balls first: most are far.
  bool patches_near(std::uint32_t i, std::uint32_t k, const Pose& pose, double reach) const {
    const HullNode &a = a_.tree.nodes()[i], &b = b_.tree.nodes()[k];
    const Vec3 way = pose.rotation * b.centre + pose.translation - a.centre;
    return way.norm() <= reach + a.radius + b.radius;
  }
  double patches_apart(std::uint32_t i, std::uint32_t k, const Pose& pose) const {
    const auto part = [](const Body& of, const HullNode& node) {
      Soup soup;
      for (std::uint32_t t = node.first; t < node.end; ++t) {
        const auto c = of.tree.mesh().triangle(of.tree.triangles()[t]);
        soup.add(of.tree.mesh().vertex(c[0]), of.tree.mesh().vertex(c[1]), of.tree.mesh().vertex(c[2]));
      }
      return soup;
    };
    return brute_force(part(a_, a_.tree.nodes()[i]), part(b_, b_.tree.nodes()[k]), pose);
  }

  const Body &a_, &b_;
  std::vector<HullPair> pairs_;
  int overlaps_ = 0, apart_ = 0;
};

/// Random poses, and motions that sink in and come out again.
void judge_pair(const Body& a, const Body& b, int random_poses, int motion) {
  Trial trial(a, b);
  Random random(1);
  const double reach = radius_of(a) + radius_of(b);
  for (int i = 0; i < random_poses; ++i)
    trial.judge({random.rotation(), reach * random.uniform(0.1, 1.2) * random.on_sphere()});
  const Vec3 axis = random.on_sphere(), from = random.on_sphere();
  for (int i = 0; i < motion; ++i) {
    const double away = reach * (0.3 + std::fabs(2.0 * i / motion - 1) * 0.7);
    trial.judge({Eigen::AngleAxisd(0.02 * i, axis).toRotationMatrix(), away * from});
  }
  EXPECT_GT(trial.apart(), 3);
  EXPECT_GT(trial.overlaps(), 1);
}

TEST(HullTree, AnswersOfSolidsAreTrueWithAnyAccelerations) {
  const Body ring = body("torus", torus(8, 5), true), ring2 = body("torus again", torus(7, 4, 0.3), true, HullSplit::Mean),
             dent = body("dented ball", dented(1), true, HullSplit::Median),
             post = body("posts", middled(posts()), true, HullSplit::Gap);
  judge_pair(ring, ring2, 8, 12);
  judge_pair(dent, ring, 8, 12);
  judge_pair(post, dent, 8, 8);
}

TEST(HullTree, AnswersOfSurfacesAreTrueWithAnyAccelerations) {
  Random random(3);
  const Body sheet = body("sheet", patch(5, [](double x, double y) { return 0.4 * std::sin(3 * x) * std::cos(2 * y); }), true),
             soup = body("soup", scattered(random, 30, 0.5), true), alone = body("triangles", dented(1), false),
             ring = body("torus", torus(8, 5), true);
  judge_pair(sheet, ring, 8, 16);
  judge_pair(soup, sheet, 8, 16);
  judge_pair(alone, soup, 8, 12);
}

TEST(HullTree, ASolidInsideAnotherOverlaps) {
  const Body outer = body("outer", dented(2), true), inner = body("inner", scaled(tetrahedron(), 0.02), true);
  for (const HullSearch& search : searches()) {
    HullPair pair(outer.tree, inner.tree, search);
    EXPECT_EQ(pair.intersects({}).answer.verdict, Verdict::Overlapping);
    EXPECT_EQ(pair.distance({}).answer.upper, 0);
    EXPECT_EQ(pair.intersects(shift(5, 0, 0)).answer.verdict, Verdict::Disjoint);
  }
}

// Pieces of a cavity's walls, or of a mesh that is inside out, have the solid on their other side.
TEST(HullTree, WhatIsInACavityIsApart) {
  Soup wall = box({-2, -2, -2}, {2, 2, 2});
  wall.add(dented(2));  // which way its triangles face does not matter
  Soup outward = wall;
  for (std::size_t t = 12; t < wall.triangles.size(); ++t) std::swap(wall.triangles[t][1], wall.triangles[t][2]);
  for (Soup* soup : {&wall, &outward}) {
    Soup inside_out = *soup;
    for (Corners& c : inside_out.triangles) std::swap(c[1], c[2]);
    for (const Soup& of : {*soup, inside_out}) {
      const Body cave = body("cave", of, true), guest = body("guest", scaled(tetrahedron(), 0.02), true);
      for (const HullSearch& search : searches()) {
        HullPair pair(cave.tree, guest.tree, search);
        EXPECT_EQ(pair.intersects({}).answer.verdict, Verdict::Disjoint);
        EXPECT_NEAR(pair.distance({}).answer.upper, brute_force(of, guest.soup, {}), 1e-12);
        EXPECT_EQ(pair.intersects(shift(1.5, 0, 0)).answer.verdict, Verdict::Overlapping);
        EXPECT_EQ(pair.intersects(shift(2.5, 0, 0)).answer.verdict, Verdict::Disjoint);
      }
    }
  }
}

// The hull of two posts is free between their tops: a plate above touches both, a knob between them is near neither.
TEST(HullTree, AFreeFaceDoesNotAnswer) {
  const Body post = body("posts", posts(), true), plate = body("plate", box({0, 0, 0}, {9, 5, 1}), true),
             knob = body("knob", box({0, 0, 0}, {1, 1, 1}), true);
  for (const HullSearch& search : searches()) {
    HullPair above(post.tree, plate.tree, search), between(post.tree, knob.tree, search);
    EXPECT_NEAR(above.distance(shift(-1, -1, 5.5)).answer.upper, 0.5, 1e-13);
    EXPECT_GE(above.contacts(shift(-1, -1, 5.5), 0.6).size(), 2u);
    EXPECT_NEAR(between.distance(shift(3, 1, 4.5)).answer.upper, 1, 1e-13);
  }
}

TEST(HullTree, FacesAreOfTheSurfaceExactlyWhereItCoversThem) {
  const Body post = body("posts", posts(), true);
  const ConvexView root = post.tree.hull(post.tree.nodes()[0]);
  int original = 0, free = 0;
  for (std::uint32_t f = 0; f < root.face_first.size(); ++f) {
    Vec3 middle = Vec3::Zero();
    int corners = 0;
    bool top = true;
    for (const std::uint32_t v : FaceLoop(root, f)) {
      const Vec3 p(root.vertices[v].x, root.vertices[v].y, root.vertices[v].z);
      middle += p, ++corners, top = top && p.z() == 5;
    }
    middle /= corners;
    // The floor and the base's sides are the surface's; of the roof over the posts only their tops are, which are parts of a
    // face.
    const bool is_original = FaceClass(root.tags[f]) == FaceClass::Original;
    (is_original ? original : free) += 1;
    EXPECT_FALSE(top && is_original);
    if (middle.z() == 0 || middle.z() == 0.5) {
      EXPECT_TRUE(is_original) << middle.transpose();
    }
  }
  EXPECT_EQ(original, 5);
  EXPECT_GT(free, 3);
}

TEST(HullTree, EveryNodeHoldsItsTrianglesAndEveryTriangleIsInOnePiece) {
  for (const HullSplit split : {HullSplit::Median, HullSplit::Midpoint, HullSplit::Mean, HullSplit::Gap}) {
    const Body b = body("dented ball", dented(2), true, split);
    std::vector<int> times(b.tree.mesh().triangle_count());
    for (std::size_t i = 0; i < b.tree.nodes().size(); ++i) {
      const HullNode& node = b.tree.nodes()[i];
      for (std::uint32_t k = node.first; k < node.end; ++k) {
        if (node.is_piece()) ++times[b.tree.triangles()[k]];
        for (const std::uint32_t v : b.tree.mesh().triangle(b.tree.triangles()[k])) {
          const Vec3 p = b.tree.mesh().vertex(v);
          const Vertex point{p.x(), p.y(), p.z(), 0, 0};
          ConvexView alone;
          alone.vertices = {&point, 1}, alone.extent = p.cwiseAbs().maxCoeff(), alone.centre = p;
          EXPECT_LE(march(b.tree.hull(node), alone, Pose()).lower, 1e-15);
        }
      }
      for (const std::uint32_t child : node.child) {
        if (child != kNone) {
          EXPECT_GT(child, i);
        }
      }
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ptrdiff_t(times.size()));
  }
}

TEST(HullTree, WhatHullsHaveAlikeIsStoredOnce) {
  Soup twice = torus(8, 5);
  const std::vector<Corners> once = twice.triangles;
  twice.triangles.insert(twice.triangles.end(), once.begin(), once.end());
  const Body ring = body("torus, given twice", twice, true);
  std::size_t vertices = 0, half_edges = 0;
  for (const HullNode& node : ring.tree.nodes()) vertices += node.vertices.count, half_edges += node.half_edges.count;
  const HullArrays& arrays = ring.tree.hulls();
  // The pieces are there twice, and what is above them is of both.
  EXPECT_LT(4 * arrays.vertices.size(), 3 * vertices);
  EXPECT_LT(4 * arrays.half_edges.size(), 3 * half_edges);
  EXPECT_GT(ring.tree.bytes(), sizeof(Vertex) * arrays.vertices.size() + sizeof(HalfEdge) * arrays.half_edges.size());
}

TEST(HullTree, TheFrontGrowsInContactAndFallsBackToTheRoots) {
  const Body ring = body("torus", torus(16, 8), true);
  HullSearch search;
  search.front = true;
  HullPair pair(ring.tree, ring.tree, search);
  const Pose linked{(Mat3() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished(), Vec3(1, 0, 0)};
  (void)pair.distance(linked);
  const std::size_t grown = pair.front_size();
  EXPECT_GT(grown, 4u);
  const std::uint64_t first = pair.asked();
  (void)pair.distance(linked);
  EXPECT_LT(pair.asked() - first, first);
  std::size_t before = pair.front_size();
  for (int i = 0; i < 100; ++i) {
    (void)pair.distance(shift(100, 0, 0));
    EXPECT_LE(pair.front_size(), before);
    before = pair.front_size();
  }
  EXPECT_EQ(before, 1u);
}

// An open body is no solid, though a patch of it may be nearly a whole ball: its thousands of triangles are not paired one by
// one.
TEST(HullTree, LargePatchesOfOpenBodiesAreSearched) {
  Soup open = ball(4);
  open.triangles.pop_back();
  const Body bowl = body("bowl", open, true);
  ASSERT_FALSE(bowl.tree.body().is_solid());
  const MeshModel mesh = open.mesh();
  for (const HullSearch& search : searches()) {
    HullPair pair(bowl.tree, bowl.tree, search);
    for (const double x : {0.5, 1.2, 1.9, 2.1}) {
      const Pose pose = shift(x, 0.03, 0.02);
      const Answer answer = pair.distance(pose).answer, truth = distance(mesh, mesh, pose);
      EXPECT_NEAR(answer.upper, truth.upper, 2 * tolerance(mesh, mesh, pose));
      EXPECT_EQ(answer.verdict, truth.verdict);
      EXPECT_LT(answer.plane_tests, 2000u);
    }
  }
}

TEST(HullTree, WhatIsNotOfTheMeshIsRefused) {
  const MeshModel mesh = torus(6, 4).mesh();
  Decomposition patches = one_by_one(mesh);
  patches.triangles[0] = patches.triangles[1];
  EXPECT_EQ(build_hull_tree(mesh, patches).error().code, ErrorCode::BadValue);
  patches = one_by_one(mesh);
  patches.patches.pop_back();
  EXPECT_EQ(build_hull_tree(mesh, patches).error().code, ErrorCode::BadValue);
  patches = one_by_one(mesh);
  patches.patches.back().end += 1;  // was read beyond the end
  EXPECT_EQ(build_hull_tree(mesh, patches).error().code, ErrorCode::BadValue);
  HullTreeOptions options;
  options.progress = [](double, std::string_view) { return false; };
  EXPECT_EQ(build_hull_tree(mesh, one_by_one(mesh), options).error().code, ErrorCode::Cancelled);
}

/// A box whose faces are dented: its pieces do not hold the middle.
Soup dented_box() {
  Soup soup;
  for (int i = 0; i < 8; ++i) soup.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, base = side % 2 << axis;
    const std::uint32_t corners[] = {base, base | 1u << u, base | 1u << u | 1u << v, base | 1u << v};
    Vec3 middle = Vec3::Zero();
    middle[axis] = side % 2 ? 0.7 : -0.7;
    const auto centre = std::uint32_t(soup.points.size());
    soup.points.push_back(middle);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 4];
      soup.triangles.push_back(side % 2 ? std::array{centre, from, to} : std::array{centre, to, from});
    }
  }
  return soup;
}

TEST(HullTree, ContactsOfASolidInASolidAreOneOverlap) {
  const Body outer = body("dented box", dented_box(), true), inner = body("small", scaled(dented_box(), 0.05), true);
  HullPair pair(outer.tree, inner.tree);
  ASSERT_EQ(pair.intersects({}).answer.verdict, Verdict::Overlapping);
  for (const double reach : {0.0, 0.1, 0.5, 2.0}) {
    const std::vector<HullAnswer>& found = pair.contacts({}, reach);
    ASSERT_EQ(found.size(), 1u) << reach;
    EXPECT_EQ(found[0].answer.verdict, Verdict::Overlapping);
  }
}

/// As of any distance, it asks for the exact one.
TEST(HullTree, AnErrorThatIsNoNumberIsZero) {
  const Body ring = body("torus", torus(6, 4), true);
  HullPair pair(ring.tree, ring.tree);
  const Pose apart{Mat3::Identity(), {5, 0.1, 0.2}};
  const Answer exact = pair.distance(apart).answer;
  ASSERT_EQ(exact.status, Status::Converged);
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), -1.0, -std::numeric_limits<double>::infinity()}) {
    for (const Answer& answer : {pair.distance(apart, none).answer, pair.distance(apart, 0, none).answer}) {
      EXPECT_EQ(answer.status, Status::Converged) << none;
      EXPECT_EQ(answer.lower, exact.lower) << none;
      EXPECT_EQ(answer.upper, exact.upper) << none;
    }
  }
}

TEST(HullTree, BadPosesAreStatuses) {
  const Body ring = body("torus", torus(6, 4), true);
  HullPair pair(ring.tree, ring.tree);
  Pose bad;
  bad.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pair.distance(bad).answer.status, Status::InvalidPose);
  EXPECT_EQ(pair.within(bad, 1), Decision::Undecided);
  EXPECT_TRUE(pair.contacts(bad, 1).empty());
  EXPECT_TRUE(pair.contacts({}, std::numeric_limits<double>::quiet_NaN()).empty());
}

}  // namespace
}  // namespace swiftlet
