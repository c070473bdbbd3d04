// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "table.h"

#include <limits>

#include "vec.h"

namespace swiftlet {

void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices) {
  const std::uint32_t samples = lut::sample_count(spec.resolution);
  const Vec centre{parts.header.centre[0], parts.header.centre[1], parts.header.centre[2]};
  const double distance = spec.radius_factor * parts.header.radius;
  std::vector<std::uint32_t> table(samples);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const std::array<double, 3> direction = lut::sample(spec.resolution, i);
    const Vec point = centre + Vec{direction[0], direction[1], direction[2]} * distance;
    double least2 = std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const Vec d = vec(vertices[v]) - point;
      if (const double d2 = dot(d, d); d2 < least2) least2 = d2, table[i] = v;
    }
  }
  const auto bytes = std::as_bytes(std::span(table));
  parts.table.assign(bytes.begin(), bytes.end());
  parts.header.resolution = std::uint32_t(spec.resolution);
  parts.header.radius_factor = spec.radius_factor;
}

}  // namespace swiftlet
