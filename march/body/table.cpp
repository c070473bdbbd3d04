// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Brute-force nearest vertices for the table; support vertices with their excess for the maps, and the frames of these.
#include "body/table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "body/ellipsoid.h"
#include "body/half_edge.h"
#include "body/support.h"
#include "body/support_map.h"
#include "numeric/chunks.h"
#include "numeric/vec.h"

namespace swiftlet {

std::string spec_fault(const TableSpec& spec) {
  if (spec.resolution > lut::Resolution::Degrees5) return "the table has none of the resolutions that there are";
  if (!(spec.radius_factor >= 1 && spec.radius_factor <= 1e6)) return "the table's radius factor is not between 1 and 1e6";
  if (spec.map_cells > kMostMapCells) return "the support maps have more than 64 cells per vertex";
  return {};
}

void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices, const Executor& executor) {
  const lut::Resolution resolution = vertices.empty() ? lut::Resolution::None : spec.resolution;  // it needs level 0
  const std::uint32_t samples = lut::sample_count(resolution);
  const Vec centre{parts.header.centre[0], parts.header.centre[1], parts.header.centre[2]};
  const double distance = spec.radius_factor * parts.header.radius;
  std::vector<std::uint32_t> table(samples);
  run_tasks(executor, samples, [&](std::size_t task) {
    const auto i = std::uint32_t(task);
    const std::array<double, 3> direction = lut::sample(resolution, i);
    const Vec point = centre + Vec{direction[0], direction[1], direction[2]} * distance;
    double least2 = kInfinity;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const Vec d = vec(vertices[v]) - point;
      if (const double d2 = dot(d, d); d2 < least2) least2 = d2, table[i] = v;
    }
  });
  const auto bytes = std::as_bytes(std::span(table));
  parts.table.assign(bytes.begin(), bytes.end());
  parts.header.resolution = std::uint32_t(resolution);
  parts.header.radius_factor = spec.radius_factor;
}

namespace {

/// The moments of a level's surface about its centroid, over its area, for coordinates in extents: xx, xy, xz, yy, yz, zz.
/// Those of a triangle are those of three points in the middle of its sides. A body without faces counts by its vertices.
std::array<double, 6> moments(const ConvexView& view) {
  const double scale = view.extent > 0 ? 1 / view.extent : 0;
  double weight = 0;
  std::array<double, 3> first{};
  std::array<double, 6> second{};
  const auto add = [&](const Vec& p, double w) {
    weight += w;
    for (const auto& [k, x] : {std::pair{0u, p.x}, {1u, p.y}, {2u, p.z}}) first[k] += w * x;
    for (const auto& [k, xx] :
         {std::pair{0u, p.x * p.x}, {1u, p.x * p.y}, {2u, p.x * p.z}, {3u, p.y * p.y}, {4u, p.y * p.z}, {5u, p.z * p.z}})
      second[k] += w * xx;
  };
  const Vec o = vec(view.vertices[0]);
  const auto at = [&](std::uint32_t v) { return (vec(view.vertices[v]) - o) * scale; };
  for (const std::uint32_t first_edge : view.face_first) {
    const std::uint32_t corner = origin(view, first_edge);
    for (std::uint32_t h = next_in_face(view, first_edge); view.half_edges[h].head != corner; h = next_in_face(view, h)) {
      const Vec p = at(corner), q = at(origin(view, h)), r = at(view.half_edges[h].head);
      const double area = norm(cross(q - p, r - p));
      add((p + q) * 0.5, area), add((q + r) * 0.5, area), add((r + p) * 0.5, area);
    }
  }
  if (!(weight > 0)) {
    for (std::uint32_t v = 0; v < view.vertices.size(); ++v) add(at(v), 1);
  }
  const double x = first[0] / weight, y = first[1] / weight, z = first[2] / weight;
  const std::array<double, 6> of_centroid{x * x, x * y, x * z, y * y, y * z, z * z};
  for (std::size_t k = 0; k < 6; ++k) second[k] = second[k] / weight - of_centroid[k];
  return second;
}

/// Writes the map frame of a level: the transposed Cholesky factor of the moments, times what makes points M^-T x differ by at
/// most 2 in a coordinate. If that leaves the bounds of a frame, which no body known does, the frame is a multiple of identity.
void write_frame(LevelHeader& header, const ConvexView& view) {
  const auto [xx, xy, xz, yy, yz, zz] = moments(view);
  const double least = max(kLeastMoment * (xx + yy + zz), std::numeric_limits<float>::min());
  const double a = std::sqrt(xx + least), b = xy / a, c = xz / a, d = std::sqrt(max(yy - b * b, 0) + least),
               e = (yz - b * c) / d, f = std::sqrt(max(zz - c * c - e * e, 0) + least);
  const Vec o = vec(view.vertices[0]);
  const std::array<double, 6> frame{a, b, c, d, e, f};
  double low[3] = {}, high[3] = {};  // of the points M^-T (x - o), with x and o in extents
  for (const Vertex& v : view.vertices) {
    const auto [x, y, z] = ball_coordinates(frame, (vec(v) - o) * (view.extent > 0 ? 1 / view.extent : 0));
    for (const auto& [k, image] : {std::pair{0u, x}, {1u, y}, {2u, z}}) {
      low[k] = min(low[k], image), high[k] = max(high[k], image);
    }
  }
  const double scale = max(max(high[0] - low[0], high[1] - low[1]), high[2] - low[2]) / 2 * kFrameSlack;
  double sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += std::fabs(frame[k] * scale);
  for (std::size_t k = 0; k < 6; ++k) {
    header.map_frame[k] = sum > 0 && sum < kMostMapFrame / 2 ? float(frame[k] * scale)
                          : k == 0 || k == 3 || k == 5       ? 2.0f
                                                             : 0.0f;
  }
}

constexpr std::size_t kRowsPerTask = 16;  ///< of a support map: the first climb of a task is a long one

std::vector<std::uint32_t> support_map(const ConvexView& view, std::uint32_t side, const std::array<double, 6>& frame,
                                       const Executor& executor) {
  std::vector<std::uint32_t> cells(lut::octahedron_cell_count(side));
  if (!(view.extent > 0)) return cells;
  const auto direction = [&](std::uint32_t lower, std::uint32_t i, std::uint32_t j) {
    const std::array<double, 3> p = lut::octahedron_point(side, lower, i, j);
    return from_map(frame, {p[0] / side, p[1] / side, p[2] / side});
  };
  struct Corner {
    Vec n;
    std::uint32_t top;
  };
  // Both halves of the octahedron, row by row. A task has its rows' corners and those of the row after them.
  over_chunks(executor, 2 * std::size_t(side), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<Corner> corners(2 * (side + 1));
    std::uint32_t tests = 0, near = 0;
    const auto climb_row = [&](std::uint32_t lower, std::uint32_t j) {
      Corner* const row = &corners[j % 2 * (side + 1)];
      for (std::uint32_t i = 0; i <= side; ++i) {
        const Vec n = direction(lower, 2 * i, 2 * j);
        row[i] = {n, near = support(view, rescaled(n), near, tests)};
      }
      near = row[0].top;
      return row;
    };
    for (auto at = std::uint32_t(begin); at < end; ++at) {
      const std::uint32_t lower = at / side, j = at % side;
      const Corner* const row = at == begin || j == 0 ? climb_row(lower, j) : &corners[j % 2 * (side + 1)];
      const Corner* const after = climb_row(lower, j + 1);
      for (std::uint32_t i = 0; i < side; ++i) {
        const std::uint32_t v = ascend(view, direction(lower, 2 * i + 1, 2 * j + 1), row[i].top, tests);
        double excess = 0;
        for (const Corner* corner : {row + i, row + i + 1, after + i, after + i + 1})
          excess = std::max(excess, excess_at(frame, corner->n, vec(view.vertices[corner->top]) - vec(view.vertices[v])));
        cells[at * side + i] = map_entry(v, excess);
      }
    }
  });
  return cells;
}

}  // namespace

double excess_at(const std::array<double, 6>& frame, const Vec& n, const Vec& above) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const double of_frame = std::fabs(frame[0]) * x + (std::fabs(frame[1]) + std::fabs(frame[3])) * y +
                          (std::fabs(frame[2]) + std::fabs(frame[4]) + std::fabs(frame[5])) * z;
  const double of_height = x * std::fabs(above.x) + y * std::fabs(above.y) + z * std::fabs(above.z);
  return max(0, dot(n, above)) + 2 * kFrameError * of_frame + kDotError * of_height;
}

void fill_maps(BlockParts& parts, const TableSpec& spec, std::span<const ConvexView> levels, const Executor& executor) {
  parts.header.map_cells = spec.map_cells;
  for (std::size_t i = parts.header.finest_level; i < levels.size(); ++i) {
    LevelHeader& header = parts.level_headers[i];
    const std::size_t count = levels[i].vertices.size();
    std::copy_n(LevelHeader{}.map_frame, std::size(header.map_frame), header.map_frame);
    if (spec.map_cells == 0 || count > kMapVertices) continue;
    write_frame(header, levels[i]);
    header.map_side = std::clamp(std::uint32_t(std::sqrt(double(count) * spec.map_cells / 2)), kLeastMapSide, kMaxMapSide);
    const std::vector<std::uint32_t> map = support_map(levels[i], header.map_side, map_frame(header), executor);
    const auto bytes = std::as_bytes(std::span(map));
    parts.maps.insert(parts.maps.end(), bytes.begin(), bytes.end());
  }
  if (parts.header.finest_level > 0) return;
  const std::array<double, 6> frame = map_frame(parts.level_headers[0]);
  const Vec centre{parts.header.centre[0], parts.header.centre[1], parts.header.centre[2]};
  parts.header.scale_around = scale_around(levels[0], centre, frame);
  parts.header.scale_inside = scale_inside(levels[0], centre, frame);
}

}  // namespace swiftlet
