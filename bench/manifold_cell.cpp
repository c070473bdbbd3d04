// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold_cell.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include <swiftlet/build.h>
#include <swiftlet/depth.h>

#include "shapes.h"

namespace swiftlet::bench {
namespace {

constexpr double kOutside = 1e-6, kDegree = std::numbers::pi / 180, kStep = 0.1 * kDegree;
constexpr double kShallow[] = {1e-6, 1e-2};

/// The facets' planes, for heights over a body.
class Planes {
 public:
  explicit Planes(const ConvexView& view) {
    const auto point = [&](std::uint32_t v) { return Vec3(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z); };
    for (const HalfEdge& h : view.half_edges) {
      const Vertex& ring = view.vertices[h.head];  // the facet's next half-edge follows the twin, clockwise
      const std::uint32_t next = h.twin == ring.ring_begin ? h.twin + ring.ring_count - 1 : h.twin - 1;
      const Vec3 p = point(view.half_edges[h.twin].head), u = point(h.head) - p, v = point(view.half_edges[next].head) - p;
      const Vec3 n(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
      if (n.norm() > 0) planes_.push_back({n / n.norm(), n.dot(p) / n.norm()});
    }
  }
  /// Below 0 inside.
  double height(const Vec3& p) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& [n, offset] : planes_) most = std::max(most, n.dot(p) - offset);
    return most;
  }

 private:
  std::vector<std::pair<Vec3, double>> planes_;
};

/// What a pass of answers is worth.
void judge(const ManifoldCell& cell, std::span<const Contacts> all, Row& row) {
  const Planes a(cell.a.level(0).view), b(cell.b.level(0).view);
  const double radius = std::max(cell.a.radius(), cell.b.radius());
  double sum = 0, points = 0;
  const auto mix = [&](std::uint64_t word) { row.hash = (row.hash ^ word) * 0x100000001b3u, row.hash ^= row.hash >> 29; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Pose &pose = cell.poses[i], back = inverse(pose);
    const Contacts& c = all[i];
    row.failed += c.count == 0;
    mix(c.count);
    for (std::uint32_t k = 0; k < c.count; ++k) {
      const auto& [p, q] = c.points[k];
      const double over_a = a.height(p), over_b = b.height(back.rotation * q + back.translation),
                   off = std::max(std::fabs(over_a), std::fabs(over_b)) / radius;
      row.error = std::max(row.error, off);
      row.wrong += std::max(over_a, over_b) > kOutside * radius;
      sum += off, ++points;
      mix(std::uint64_t(std::llround((q - p).norm() / (1e-9 * radius))));
    }
  }
  row.mean_error = points > 0 ? sum / points : 0;
  row.steps = points / double(all.size());
  row.flagged = row.failed > 0 || row.wrong > 0 || row.error > kOutside;
}

}  // namespace

Model prism(std::uint32_t sides) {
  return std::move(build((sides == 4 ? shapes::cube() : shapes::prism(sides, 1, 1)).points)).value().model;
}

ManifoldCell stacked(const Model& prism, double depth, std::uint32_t poses) {
  double height = 0;
  for (const Vertex& v : prism.level(0).view.vertices) height = std::max(height, 2 * v.z);
  ManifoldCell cell{"", prism, prism, {}};
  for (std::uint32_t i = 0; i < poses; ++i) {
    Pose pose;
    pose.rotation = shapes::rotation(Vec3::UnitZ(), i * kStep);
    pose.translation = {0.4 * std::cos(0.7 * i * kStep), 0.4 * std::sin(0.7 * i * kStep), height - depth};
    cell.poses.push_back(pose);
  }
  return cell;
}

std::vector<ManifoldCell> manifold_cells(const Shelf& shelf, std::uint32_t poses) {
  std::vector<ManifoldCell> cells;
  for (const double depth : kShallow) {
    const std::string end = depth < 1e-3 ? "/touching" : "/shallow";
    for (const std::uint32_t sides : {4u, 12u, 60u, 100u, 200u, 400u, 1000u}) {
      cells.push_back(stacked(prism(sides), depth, poses));
      cells.back().name = (sides == 4 ? "box" : "prism" + std::to_string(sides)) + end;
    }
    const Scene scene = shallow(shelf, shapes::Family::Fat, 2'000, 0.1, depth, {1, poses});
    ManifoldCell fat{"fat2000" + end, scene.models[0], scene.models[1], {}};
    for (const Query& query : scene.queries) fat.poses.push_back(query.b_in_a);
    cells.push_back(std::move(fat));
  }
  return cells;
}

std::vector<Row> measure(const ManifoldCell& cell, int rounds) {
  const SceneBody a{&cell.a, cell.a.level(0).view, 0}, b{&cell.b, cell.b.level(0).view, 0};
  const double to_ns = 1e9 / double(cell.poses.size());
  std::vector<Row> rows;
  std::vector<std::unique_ptr<ManifoldSession>> sessions;
  for (const ManifoldMethod& method : manifold_methods()) {
    for (const bool cold : {false, true}) {
      if (cold && !method.keeps_state) continue;
      sessions.push_back(method.open(a, b, cold));
      Row row;
      row.scene = cell.name, row.question = Question::Manifold, row.series = method.name + (cold ? " cold" : "");
      row.queries = cell.poses.size(), row.rounds = std::size_t(rounds), row.floor_ns = 1;
      rows.push_back(row);
    }
  }
  std::vector<Answer> answers;
  PairSeed seed;
  for (const Pose& pose : cell.poses) answers.push_back(signed_distance(cell.a, cell.b, pose, seed));
  std::vector<std::vector<double>> times(rows.size());
  std::vector<Contacts> contacts(cell.poses.size());
  for (int round = 0; round <= rounds; ++round) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto begin = std::chrono::steady_clock::now();
      sessions[i]->ask(cell.poses, answers, contacts);
      const double ns = to_ns * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      if (round > 0) times[i].push_back(ns);
      if (round == rounds) judge(cell, contacts, rows[i]);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    rows[i].ns = times[i][times[i].size() / 2];
    const auto quartile = [&](std::size_t k) { return times[i][k * (times[i].size() - 1) / 4]; };
    rows[i].spread = (quartile(3) - quartile(1)) / rows[i].ns;
  }
  return rows;
}

}  // namespace swiftlet::bench
