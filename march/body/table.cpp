// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Brute-force nearest vertices for the table, and support vertices with their excess for the maps.
#include "body/table.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "body/support_map.h"
#include "numeric/vec.h"

namespace swiftlet {

std::string spec_fault(const TableSpec& spec) {
  if (spec.resolution > lut::Resolution::Degrees5) return "the table has none of the resolutions that there are";
  if (!(spec.radius_factor >= 1 && spec.radius_factor <= 1e6)) return "the table's radius factor is not between 1 and 1e6";
  if (spec.map_side > kMaxMapSide || !(spec.map_side == 0 || std::has_single_bit(spec.map_side)))
    return "the support map's side is neither 0 nor a power of two up to 64";
  return {};
}

void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices) {
  const lut::Resolution resolution = vertices.empty() ? lut::Resolution::None : spec.resolution;  // it needs level 0
  const std::uint32_t samples = lut::sample_count(resolution);
  const Vec centre{parts.header.centre[0], parts.header.centre[1], parts.header.centre[2]};
  const double distance = spec.radius_factor * parts.header.radius;
  std::vector<std::uint32_t> table(samples);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const std::array<double, 3> direction = lut::sample(resolution, i);
    const Vec point = centre + Vec{direction[0], direction[1], direction[2]} * distance;
    double least2 = std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const Vec d = vec(vertices[v]) - point;
      if (const double d2 = dot(d, d); d2 < least2) least2 = d2, table[i] = v;
    }
  }
  const auto bytes = std::as_bytes(std::span(table));
  parts.table.assign(bytes.begin(), bytes.end());
  parts.header.resolution = std::uint32_t(resolution);
  parts.header.radius_factor = spec.radius_factor;
}

namespace {

Vec direction(std::uint32_t side, std::uint32_t face, std::uint32_t i, std::uint32_t j) {
  const std::array<double, 3> p = lut::cube_point(side, face, i, j);
  return {p[0], p[1], p[2]};
}

std::uint32_t highest(std::span<const Vertex> vertices, const Vec& n) {
  std::uint32_t best = 0;
  double most = dot(n, vec(vertices[0]));
  for (std::uint32_t v = 1; v < vertices.size(); ++v) {
    if (const double height = dot(n, vec(vertices[v])); height > most) most = height, best = v;
  }
  return best;
}

std::vector<std::uint32_t> support_map(std::span<const Vertex> vertices, std::uint32_t side, double extent) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t face = 0; face < 6; ++face) {
    std::vector<double> heights;  // the body's, at the corners of the cells
    for (std::uint32_t j = 0; j <= side; ++j) {
      for (std::uint32_t i = 0; i <= side; ++i) {
        const Vec n = direction(side, face, 2 * i, 2 * j);
        heights.push_back(dot(n, vec(vertices[highest(vertices, n)])));
      }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i < side; ++i) {
        const std::uint32_t v = highest(vertices, direction(side, face, 2 * i + 1, 2 * j + 1));
        double excess = 0;
        for (const std::uint32_t corner : {0, 1, 2, 3}) {
          const std::uint32_t x = i + corner % 2, y = j + corner / 2;
          const double height = dot(direction(side, face, 2 * x, 2 * y), vec(vertices[v]));
          excess = std::max(excess, heights[y * (side + 1) + x] - height);
        }
        cells.push_back(map_entry(v, extent > 0 ? excess / extent : 0));
      }
    }
  }
  return cells;
}

}  // namespace

void fill_maps(BlockParts& parts, const TableSpec& spec, std::span<const std::span<const Vertex>> levels) {
  parts.header.map_side = spec.map_side;
  std::size_t finest = parts.header.finest_level;
  while (finest + 1 < levels.size() && levels[finest].size() > kMappedVertices) ++finest;
  if (levels[finest].size() > kMapVertices) return;
  std::vector<std::vector<std::uint32_t>> maps;
  std::uint32_t side = spec.map_side;
  for (std::size_t i = finest; i < levels.size() && side > 0; ++i, side = std::max(side / 2, 1u)) {
    maps.push_back(support_map(levels[i], side, parts.level_headers[i].extent));
    parts.level_headers[i].map_side = side;
  }
  for (const std::vector<std::uint32_t>& map : maps) {
    const auto bytes = std::as_bytes(std::span(map));
    parts.maps.insert(parts.maps.end(), bytes.begin(), bytes.end());
  }
}

}  // namespace swiftlet
