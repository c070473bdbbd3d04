// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The layer above in miniature: SWIFT++ [Ehmann & Lin 2001] on the installed headers, its answers against brute force over all
// pairs of triangles. Prints what it cost; ends with 1 where one answer differs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "patches.h"
#include "traversal.h"
#include "tree.h"
#include "triangles.h"

namespace hull_tree {
namespace {

struct Body {
  std::string name;
  Mesh mesh;
  std::vector<std::uint32_t> patch;  ///< per triangle
  Tree tree;
};

Body body(const char* name, const Mesh& mesh) {
  const auto patches = convex_patches(mesh);
  Body b{name, mesh, std::vector<std::uint32_t>(mesh.triangles.size()), hull_tree_of(mesh, patches)};
  for (std::uint32_t k = 0; k < patches.size(); ++k)
    for (const std::uint32_t t : patches[k]) b.patch[t] = k;
  return b;
}

// ---- What is wrong ----------------------------------------------------------------------------------------------------------

int checked = 0, failed = 0;

void expect(bool holds, const char* claim, const std::string& where, double have, double want) {
  ++checked;
  if (holds) return;
  if (++failed <= 20) std::printf("WRONG %s: %s: %.17g, truth %.17g\n", where.c_str(), claim, have, want);
}

/// The distance of a point on a feature from the surface: from the mesh's own point, or from its triangles in the node.
double off_surface(const Body& b, const Node& node, swiftlet::FeatureId feature, const Pose& in_a, const Vec3& p_a) {
  const auto point = [&](std::uint32_t p) { return Vec3(in_a.rotation * b.mesh.points[p] + in_a.translation); };
  if (feature.kind() == swiftlet::FeatureKind::Vertex) return (p_a - point(node.point[feature.index()])).norm();
  double least = kInfinity;
  for (const std::uint32_t t : node.triangle) {
    const auto& [i, j, k] = b.mesh.triangles[t];
    least = std::min(least, distance(p_a, Triangle{point(i), point(j), point(k)}));
  }
  return least;
}

/// The witness points are as far apart as the bounds say, on the features they came with, and on the surface where those are
/// the surface's.
void expect_witness(const Body& a, const Body& b, const Pose& pose, const Witness& w, double slack, const std::string& where) {
  const double apart = (w.point_b - w.point_a).norm();
  expect(apart >= w.lower - slack && apart <= w.upper + slack, "the points are as far apart as the bounds", where, apart,
         w.upper);
  const Node &node_a = a.tree.nodes[w.node_a], &node_b = b.tree.nodes[w.node_b];
  if (w.a == swiftlet::FeatureId{} || w.b == swiftlet::FeatureId{})  // a leaf inside another: no feature
    return expect(w.overlapping, "only nodes that overlap lack a feature", where, w.upper, 0);
  const double off_a = off_feature(node_a, w.a, {}, w.point_a), off_b = off_feature(node_b, w.b, pose, w.point_b);
  expect(off_a <= slack, "A's point is on its feature", where, off_a, 0);
  expect(off_b <= slack, "B's point is on its feature", where, off_b, 0);
  if (tag_of(node_a, w.a) == Original) {
    const double off = off_surface(a, node_a, w.a, {}, w.point_a);
    expect(off <= slack, "A's point is on the surface", where, off, 0);
  }
  if (tag_of(node_b, w.b) == Original) {
    const double off = off_surface(b, node_b, w.b, pose, w.point_b);
    expect(off <= slack, "B's point is on the surface", where, off, 0);
  }
}

// ---- What it costs ----------------------------------------------------------------------------------------------------------

/// Nanoseconds of this process, whatever else the machine does.
double now() { return double(std::clock()) * (1e9 / CLOCKS_PER_SEC); }

struct Cost {
  std::uint64_t queries = 0, pairs = 0, steps = 0;
  double ns = 0;

  template <class Query>
  auto of(Pair& pair, Query query) {
    const Work before = pair.work();
    const double begin = now();
    const auto answer = query();
    ns += now() - begin;
    ++queries;
    pairs += pair.work().pairs - before.pairs;
    steps += pair.work().steps - before.steps;
    return answer;
  }
  double per_query(double total) const { return queries ? total / double(queries) : 0; }
};

struct Way {
  const char* name;
  Settings settings;
};
const Way kWays[] = {{"roots, centres", {Start::Centres, false}},
                     {"roots, table", {Start::Table, false}},
                     {"roots, parent", {Start::Parent, false}},
                     {"roots, parent, 3 steps, 6, 12, ...", {Start::Parent, false, 3}},
                     {"front, stored", {Start::Parent, true}}};
constexpr std::size_t kWayCount = std::size(kWays), kRoots = 2, kFront = 4;

enum Kind { Intersects, Within, Approximate, Exact, Contacts, kKindCount };
const char* const kKinds[] = {"intersects", "within", "distance to 10 %", "distance", "contacts"};

/// One row of the report: a motion of a pair of bodies.
struct Row {
  std::string name;
  int poses = 0, meeting = 0;
  double brute_ns = 0;
  Cost cost[kKindCount][kWayCount];
};

// ---- Trials -----------------------------------------------------------------------------------------------------------------

class Trial {
 public:
  Trial(const Body& a, const Body& b, const char* motion) : a_(a), b_(b), soup_a_(soup(a.mesh)) {
    row_.name = a.name + ", " + b.name + ": " + motion;
    for (int kind = 0; kind < kKindCount; ++kind)
      for (const Way& way : kWays) pairs_.emplace_back(a.tree, b.tree, way.settings);
  }

  void judge(const Pose& pose) {
    const double size = std::max(a_.tree.size, b_.tree.size) + pose.translation.norm();
    const double slack = tolerance(a_.tree, b_.tree, pose);  // more than the rounding of a brute-force distance
    const double begin = now();
    const Soup soup_b = soup(b_.mesh, pose);
    const double d = distance(soup_a_, soup_b);
    row_.brute_ns += now() - begin;
    ++row_.poses;
    row_.meeting += d <= slack;

    const double reach = d + 0.02 * a_.tree.size;
    const std::vector<double> by_patch =
        patch_distances(soup_a_, soup_b, a_.patch, b_.patch, a_.tree.leaf_count, b_.tree.leaf_count, reach);
    for (std::size_t k = 0; k < kWayCount; ++k) {
      const std::string where = row_.name + ", pose " + std::to_string(row_.poses) + ", " + kWays[k].name;
      const auto ask = [&](Kind kind, auto query) {
        Pair& pair = pairs_[kind * kWayCount + k];
        return row_.cost[kind][k].of(pair, [&] { return query(pair); });
      };

      const bool meet = ask(Intersects, [&](Pair& pair) { return pair.within(pose, 0); });
      if (d > slack || d == 0) expect(meet == (d == 0), "they meet", where, meet, d);

      for (const double threshold : {0.9 * d, 1.1 * d, 0.1 * size}) {
        const bool near = ask(Within, [&](Pair& pair) { return pair.within(pose, threshold); });
        if (std::fabs(d - threshold) > slack) expect(near == (d < threshold), "they are within", where, near, d);
      }

      const Witness rough = ask(Approximate, [&](Pair& pair) { return pair.distance(pose, 0, 0.1); });
      expect(rough.lower - slack <= d && d <= rough.upper + slack, "rough bounds hold the distance", where, rough.upper, d);
      expect(rough.upper - rough.lower <= std::max(0.1 * rough.lower, slack), "rough bounds are within 10 %", where,
             rough.upper, d);
      expect_witness(a_, b_, pose, rough, slack, where);

      const Witness exact = ask(Exact, [&](Pair& pair) { return pair.distance(pose); });
      expect(exact.lower - slack <= d && d <= exact.upper + slack, "bounds hold the distance", where, exact.upper, d);
      expect(exact.upper - exact.lower <= slack, "bounds are narrow", where, exact.upper - exact.lower, slack);
      expect_witness(a_, b_, pose, exact, slack, where);

      const std::vector<Witness> contacts = ask(Contacts, [&](Pair& pair) { return pair.contacts(pose, reach); });
      expect_contacts(pose, contacts, d, by_patch, reach, slack, where);
    }
  }

  const Row& finished() {
    for (const Pair& pair : pairs_)
      expect(pair.unanswered() == 0, "every leaf pair has a verdict", row_.name, double(pair.unanswered()), 0);
    return row_;
  }

 private:
  /// Every pair of patches within reach is there, at its own distance; or one that overlaps.
  void expect_contacts(const Pose& pose, const std::vector<Witness>& contacts, double d, std::vector<double> missing,
                       double reach, double slack, const std::string& where) {
    if (contacts.size() == 1 && contacts[0].overlapping) return expect(d <= slack, "they overlap", where, 0, d);
    for (const Witness& w : contacts) {
      double& entry = missing[std::size_t(w.node_a) * b_.tree.leaf_count + w.node_b];
      // A patch is part of its hull's surface; where two hulls are nearest between contained faces, another patch is nearer.
      expect(w.lower <= entry + slack, "no patches are nearer than their hulls", where, w.lower, entry);
      if (tag_of(a_.tree.nodes[w.node_a], w.a) == Original && tag_of(b_.tree.nodes[w.node_b], w.b) == Original &&
          w.upper < reach - slack)
        expect(std::fabs(w.upper - entry) <= slack, "a contact is as far as its patches", where, w.upper, entry);
      expect_witness(a_, b_, pose, w, slack, where);
      entry = kInfinity;
    }
    for (const double left : missing)
      if (left < kInfinity) expect(left >= reach - slack, "every contact is found", where, left, reach);
  }

  const Body &a_, &b_;
  Soup soup_a_;
  std::vector<Pair> pairs_;
  Row row_;
};

Pose random_pose(const Body& a, const Body& b, Random& random) {
  return {random.rotation(), random.direction() * random.uniform(0.4, 2.2) * (a.tree.size + b.tree.size) / 2};
}

Row random_poses(const Body& a, const Body& b, int count) {
  Trial trial(a, b, "random");
  Random random(1);
  for (int k = 0; k < count; ++k) trial.judge(random_pose(a, b, random));
  return trial.finished();
}

/// Turning steadily, sinking in and coming out again.
Row coherent_motion(const Body& a, const Body& b, int count) {
  Trial trial(a, b, "coherent");
  Random random(2);
  const Vec3 axis = random.direction(), from = random.direction();
  Pair pair(a.tree, b.tree, {});
  const auto pose = [&](int k, double away) { return Pose{rotation(axis, 0.01 * k), away * from}; };
  double contact = 1.5 * (a.tree.size + b.tree.size);
  while (!pair.within(pose(count / 2, contact), 0)) contact -= 0.01 * a.tree.size;
  for (int k = 0; k < count; ++k) trial.judge(pose(k, contact + a.tree.size * (std::fabs(k - count / 2.0) / count - 0.2)));
  return trial.finished();
}

/// From random poses along the way between the nearest points until a gap is left, or none, or less.
Row near_contact(const Body& a, const Body& b, int count) {
  Trial trial(a, b, "near contact");
  Random random(3);
  const double gaps[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 0, -1e-14, -1e-10, -1e-6, -1e-2};
  Pair pair(a.tree, b.tree, {});
  for (int k = 0; k < count;) {
    Pose pose = random_pose(a, b, random);
    const Witness w = pair.distance(pose);
    if (w.upper == 0) continue;
    pose.translation -= (w.point_b - w.point_a) * (1 - gaps[k % int(std::size(gaps))] * a.tree.size / w.upper);
    trial.judge(pose);
    ++k;
  }
  return trial.finished();
}

/// Integer bodies at integer poses: coplanar, collinear and equal features, brute force without rounding.
Row lattice_poses(const Body& a, const Body& b, int count, int unit, int reach) {
  Trial trial(a, b, "lattice");
  Random random(4);
  const auto step = [&] { return double(unit * (int(random.bits() % std::uint64_t(2 * reach + 1)) - reach)); };
  for (int k = 0; k < count; ++k) trial.judge({random.quarter_turns(), Vec3(step(), step(), step())});
  return trial.finished();
}

/// Trap: pruning by the best contact so far loses all but the nearest. Two posts of different heights stand on a plate below
/// another one; both tops are contacts, each at its own distance, from every start.
void two_bumps() {
  const Body posts =
      body("posts", cubes(7, 3, 5, [](int x, int y, int z) { return z < 1 || (y == 1 && (x == 1 || (x == 5 && z < 4))); }));
  const Body plate = body("plate", cubes(9, 5, 1, [](int, int, int) { return true; }));
  for (const Way& way : kWays) {
    for (const double tilt : {0.0, 1e-9, 1e-3}) {
      Pair pair(posts.tree, plate.tree, way.settings);
      const Pose pose{rotation(Vec3::UnitY(), tilt), Vec3(-1, -1, 5.5)};
      std::vector<double> at;
      for (const Witness& w : pair.contacts(pose, 2)) at.push_back(w.upper);
      std::ranges::sort(at);
      const bool both = at.size() == 2 && std::fabs(at[0] - 0.5) < 0.01 && std::fabs(at[1] - 1.5) < 0.01;
      expect(both, "both posts touch", way.name, double(at.size()), 2);
    }
  }
}

/// Trap: a free face as near as the surface. The hull of two posts of equal height is free between their tops.
void free_as_near_as_surface() {
  const Body posts = body("posts", cubes(7, 3, 5, [](int x, int y, int z) { return z < 1 || (y == 1 && (x == 1 || x == 5)); }));
  const Body plate = body("plate", cubes(9, 5, 1, [](int, int, int) { return true; }));
  const Body knob = body("knob", cubes(1, 1, 1, [](int, int, int) { return true; }));
  for (const Way& way : kWays) {
    Pair with_plate(posts.tree, plate.tree, way.settings), with_knob(posts.tree, knob.tree, way.settings);
    const Witness w = with_plate.distance({Mat3::Identity(), Vec3(-1, -1, 5.5)});
    expect(std::fabs(w.upper - 0.5) < 1e-13, "the plate is half above the posts", way.name, w.upper, 0.5);
    const Witness between =
        with_knob.distance({Mat3::Identity(), Vec3(3, 1, 4.5)});  // beside both, above the free face's middle
    expect(std::fabs(between.upper - 1) < 1e-13, "the knob is one from either post", way.name, between.upper, 1);
  }
}

void print(const Body& b) {
  std::array<int, 3> tags{};
  int flat = 0;
  for (const Node& node : b.tree.nodes) {
    flat += node.model.dimension() == 2;
    for (const std::uint8_t t : node.tags) ++tags[t];
  }
  std::printf("%-6s %5zu triangles, %4u patches, %3d flat nodes; faces of all nodes: %d original, %d contained, %d free\n",
              b.name.c_str(), b.mesh.triangles.size(), b.tree.leaf_count, flat, tags[Original], tags[Contained], tags[Free]);
}

void print(const std::vector<Row>& rows) {
  std::printf(
      "\nexact distance, per query    poses  meet |  roots: pairs   steps        ns |  front: pairs   steps        ns |    "
      "brute ns\n");
  for (const Row& row : rows) {
    const Cost &roots = row.cost[Exact][kRoots], &front = row.cost[Exact][kFront];
    std::printf("%-28s %5d %5d | %13.1f %7.1f %9.0f | %13.1f %7.1f %9.0f | %11.0f\n", row.name.c_str(), row.poses, row.meeting,
                roots.per_query(double(roots.pairs)), roots.per_query(double(roots.steps)), roots.per_query(roots.ns),
                front.per_query(double(front.pairs)), front.per_query(double(front.steps)), front.per_query(front.ns),
                row.brute_ns / row.poses);
  }
  std::printf("\nall motions, per query                                     pairs      steps         ns  steps per pair\n");
  for (int kind = 0; kind < kKindCount; ++kind) {
    for (std::size_t way = 0; way < kWayCount; ++way) {
      Cost sum;
      for (const Row& row : rows) {
        const Cost& cost = row.cost[kind][way];
        sum.queries += cost.queries, sum.pairs += cost.pairs, sum.steps += cost.steps, sum.ns += cost.ns;
      }
      std::printf("%-18s %-34s %9.1f %10.1f %10.0f %15.2f\n", kKinds[kind], kWays[way].name, sum.per_query(double(sum.pairs)),
                  sum.per_query(double(sum.steps)), sum.per_query(sum.ns), double(sum.steps) / double(sum.pairs));
    }
  }
}

int run() {
  const double begin = now();
  const Body ring = body("torus", torus(1, 0.3, 20, 10)), tied = body("knot", knot(0.4, 60, 6)), cog = body("gear", gear(8)),
             comb = body("comb", cubes(9, 3, 4, [](int x, int, int z) { return z < 2 || x % 2 == 0; })),
             frame = body("frame", cubes(7, 6, 2, [](int x, int y, int) { return x < 2 || x > 4 || y < 2 || y > 3; }));
  for (const Body* b : {&ring, &tied, &cog, &comb, &frame}) print(*b);
  std::printf("built in %.0f ms\n", (now() - begin) * 1e-6);

  two_bumps();
  free_as_near_as_surface();
  std::vector<Row> rows;
  const std::pair<const Body*, const Body*> pairs[] = {{&ring, &ring}, {&tied, &ring}, {&cog, &cog}, {&comb, &frame}};
  for (const auto& [a, b] : pairs) {
    rows.push_back(random_poses(*a, *b, 30));
    rows.push_back(coherent_motion(*a, *b, 50));
    rows.push_back(near_contact(*a, *b, 36));
  }
  rows.push_back(lattice_poses(cog, cog, 40, 8, 16));
  rows.push_back(lattice_poses(comb, frame, 40, 1, 7));
  print(rows);
  std::printf("\n%d claims checked, %d wrong; %.1f s\n", checked, failed, (now() - begin) * 1e-9);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace hull_tree

int main() { return hull_tree::run(); }
