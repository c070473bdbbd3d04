// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include <swiftlet/model_file.h>

#include "ring.h"
#include "support_map.h"
#include "tolerance.h"

namespace swiftlet {
namespace {

static_assert(std::endian::native == std::endian::little, "the block is little-endian; a byte-swapping reader is not written");
static_assert(sizeof(Vertex) == 32 && sizeof(FacePlane) == 32 && sizeof(Handle) == 4);

constexpr char kMagic[8] = {'\x89', 'S', 'W', 'L', '\r', '\n', '\x1a', '\n'};  // as PNG's: text transfer breaks it

constexpr std::uint64_t aligned(std::uint64_t offset) { return (offset + 63) & ~std::uint64_t{63}; }

std::uint64_t header_bytes(std::uint64_t level_count) { return sizeof(BlockHeader) + level_count * sizeof(LevelHeader); }

std::uint64_t section_bytes(const LevelHeader& level, bool finest, bool coarsest) {
  const std::uint64_t v = level.vertex_count, h = level.half_edge_count, f = level.face_count, p = level.plane_count;
  return 32 * (v + p) + 4 * (3 * h + f) + (finest ? 0 : 4 * (v + f)) + (coarsest ? 0 : 4 * f);
}

Error bad(std::string message) { return {ErrorCode::BadFormat, std::move(message)}; }

/// Hands out the arrays of a section in order.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> section) : rest_(section) {}
  template <class T>
  std::span<const T> take(std::size_t count) {
    const auto* data = reinterpret_cast<const T*>(rest_.data());
    rest_ = rest_.subspan(count * sizeof(T));
    return {data, count};
  }

 private:
  std::span<const std::byte> rest_;
};

bool finite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Whether exact signs of products of these are exact: beyond, a climb need not end.
bool in_range(std::initializer_list<double> coordinates) {
  return std::all_of(coordinates.begin(), coordinates.end(),
                     [](double x) { return x == 0 || (std::fabs(x) >= kLeastCoordinate && std::fabs(x) <= kMostCoordinate); });
}

bool all_below(std::span<const std::uint32_t> values, std::size_t limit) {
  return std::all_of(values.begin(), values.end(), [limit](std::uint32_t v) { return v < limit; });
}

/// Whether rings, twins and face loops fit together, so that every walk over them stays inside and every loop closes.
/// Returns what does not, or nothing.
std::string topology_fault(const ConvexView& v) {
  const std::size_t half_edges = v.head.size(), faces = v.face_first.size();
  std::uint64_t next_ring = 0;
  for (std::size_t i = 0; i < v.vertices.size(); ++i) {
    const Vertex& r = v.vertices[i];
    if (!in_range({r.x, r.y, r.z})) return "vertex " + std::to_string(i) + " is out of range";
    if (std::fmax(std::fmax(std::fabs(r.x), std::fabs(r.y)), std::fabs(r.z)) > v.extent) return "the extent is too small";
    if (r.ring_begin != next_ring || (r.ring_count == 0 && half_edges != 0)) return "ring of vertex " + std::to_string(i);
    next_ring += r.ring_count;
  }
  if (next_ring != half_edges) return "rings do not cover the half-edges";
  if (!all_below(v.head, v.vertices.size()) || !all_below(v.twin, half_edges) || !all_below(v.face_first, half_edges))
    return "index out of range";
  for (std::size_t i = 0; i < v.vertices.size(); ++i) {
    const Vertex& r = v.vertices[i];
    for (std::uint32_t h = r.ring_begin; h < r.ring_begin + r.ring_count; ++h) {
      if (v.twin[h] == h || v.twin[v.twin[h]] != h || v.head[v.twin[h]] != i || v.head[h] == i)
        return "twin of half-edge " + std::to_string(h);
      if (v.face[h] >= faces && !(v.face[h] == kNone && faces == 0)) return "face of half-edge " + std::to_string(h);
    }
  }
  std::size_t sides = 0;
  for (std::uint32_t f = 0; f < faces; ++f) {
    std::size_t length = 0;
    std::uint32_t h = v.face_first[f];
    do {
      if (v.face[h] != f || is_diagonal(v, h) || ++length > half_edges) return "loop of face " + std::to_string(f);
      // As next_in_face, but a ring of nothing but diagonals ends the hunt.
      const std::uint32_t first = next_in_facet(v, h);
      const Vertex& ring = v.vertices[origin(v, first)];
      std::uint32_t tries = 0;
      for (h = first; is_diagonal(v, h) && tries < ring.ring_count; ++tries) h = clockwise(ring, h);
    } while (h != v.face_first[f]);
    if (length < 3 || (length > 3 && f >= v.planes.size())) return "size of face " + std::to_string(f);
    sides += length;
  }
  std::size_t borders = 0;
  for (std::uint32_t h = 0; h < half_edges; ++h) borders += faces != 0 && !is_diagonal(v, h);
  return sides == borders ? "" : "half-edges outside every loop";
}

std::string plane_fault(const ConvexView& v) {
  for (std::size_t i = 0; i < v.planes.size(); ++i) {
    const FacePlane& p = v.planes[i];
    const double length2 = p.x * p.x + p.y * p.y + p.z * p.z;
    if (!(std::fabs(length2 - 1) < kUnitNormalError) || !(p.thickness >= 0) || !finite({p.thickness}))
      return "plane " + std::to_string(i);
  }
  return "";
}

std::string link_fault(const Level& level, const Level* finer, const Level* coarser) {
  if (finer) {
    if (!all_below(level.child_vertex, finer->view.vertices.size())) return "child of a vertex";
    for (const Handle h : level.child_face) {
      const bool vertex = h.kind() == FeatureKind::Vertex && h.index() < finer->view.vertices.size();
      const bool face = h.kind() == FeatureKind::Face && h.index() < finer->view.face_first.size();
      if (!vertex && !face) return "child of a face";
    }
  }
  return coarser && !all_below(level.parent_face, coarser->view.vertices.size()) ? "parent of a face" : "";
}

}  // namespace

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;  // the product moves bits up only
  }
  return hash;
}

AlignedBytes compose(const BlockParts& parts) {
  BlockHeader header = parts.header;
  std::vector<LevelHeader> levels = parts.level_headers;
  std::uint64_t offset = header_bytes(levels.size());
  const auto place = [&offset](Section& section, const std::vector<std::byte>& bytes) {
    offset = aligned(offset);
    section = {offset, bytes.size(), hash_of(bytes)};
    offset += bytes.size();
  };
  place(header.maps, parts.maps);
  for (std::size_t i = levels.size(); i-- > 0;) place(levels[i].section, parts.levels[i]);
  place(header.table, parts.table);
  place(header.source, parts.source);

  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = kModelFileVersion;
  header.level_count = std::uint32_t(levels.size());
  header.total_bytes = offset;
  header.header_hash = 0;
  AlignedBytes block(offset);
  const auto write = [&block](std::uint64_t at, const void* from, std::size_t bytes) {
    if (bytes != 0) std::memcpy(block.data() + at, from, bytes);
  };
  write(0, &header, sizeof header);
  write(sizeof header, levels.data(), levels.size() * sizeof(LevelHeader));
  header.header_hash = hash_of(block.view().first(header_bytes(levels.size())));
  write(0, &header, sizeof header);
  for (std::size_t i = 0; i < levels.size(); ++i)
    write(levels[i].section.offset, parts.levels[i].data(), parts.levels[i].size());
  write(header.maps.offset, parts.maps.data(), parts.maps.size());
  write(header.table.offset, parts.table.data(), parts.table.size());
  write(header.source.offset, parts.source.data(), parts.source.size());
  return block;
}

Result<BlockHeader> BlockReader::read_header(std::span<const std::byte> start, std::uint64_t file_size) {
  BlockHeader header;
  if (start.size() < sizeof header) return bad("too short for a swiftlet model");
  std::memcpy(&header, start.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) return bad("not a swiftlet model");
  if (header.version != kModelFileVersion) {
    return Error{ErrorCode::BadVersion, "model version " + std::to_string(header.version) + ", this library reads version " +
                                            std::to_string(kModelFileVersion) + ": build the model again"};
  }
  if (header.total_bytes != file_size) {
    return bad("the file has " + std::to_string(file_size) + " bytes, its header says " + std::to_string(header.total_bytes));
  }
  if (header.level_count < 1 || header.level_count > kMaxLevels || header_bytes(header.level_count) > file_size)
    return bad("bad level count");
  return header;
}

Result<Model> BlockReader::read(AlignedBytes block) {
  const std::span<const std::byte> bytes = block.view();
  const Result<BlockHeader> checked = read_header(bytes, bytes.size());
  if (!checked) return checked.error();
  const BlockHeader& header = checked.value();

  std::vector<std::byte> headers(bytes.begin(), bytes.begin() + std::ptrdiff_t(header_bytes(header.level_count)));
  std::memset(headers.data() + offsetof(BlockHeader, header_hash), 0, sizeof header.header_hash);
  if (hash_of(headers) != header.header_hash) return bad("damaged header");
  std::vector<LevelHeader> level_headers(header.level_count);
  std::memcpy(level_headers.data(), bytes.data() + sizeof header, header.level_count * sizeof(LevelHeader));

  // Sections in file order, none overlapping, none past the end; only zeros between them.
  std::uint64_t expected = header_bytes(header.level_count);
  std::string fault;
  const auto section = [&](const Section& s, const std::string& name) -> std::span<const std::byte> {
    if (!fault.empty()) return {};
    if (s.offset != aligned(expected) || s.bytes > bytes.size() || s.offset > bytes.size() - s.bytes)
      return fault = name + " lies outside the file", bytes.first(0);
    const auto gap = bytes.subspan(expected, s.offset - expected);
    if (std::any_of(gap.begin(), gap.end(), [](std::byte b) { return b != std::byte{0}; }))
      return fault = "damaged before " + name, bytes.first(0);
    expected = s.offset + s.bytes;
    const auto part = bytes.subspan(s.offset, s.bytes);
    if (hash_of(part) != s.hash) fault = "damaged " + name;
    return part;
  };
  const int count = int(header.level_count);
  std::vector<std::span<const std::byte>> parts(header.level_count);
  const auto maps_part = section(header.maps, "the support maps");
  for (int i = count - 1; i >= 0; --i) {
    const std::string name = "level " + std::to_string(i);
    if (level_headers[i].section.bytes != section_bytes(level_headers[i], i == 0, i == count - 1))
      return bad(name + " has the wrong size");
    if (level_headers[i].vertex_count < 1) return bad(name + " is empty");
    parts[i] = section(level_headers[i].section, name);
  }
  const auto table_part = section(header.table, "the table"), source_part = section(header.source, "the source map");
  if (!fault.empty()) return bad(fault);
  if (expected != bytes.size()) return bad("bytes after the end");

  const bool numbers = finite({header.radius_factor, header.radius, header.box_min[0], header.box_min[1], header.box_min[2],
                               header.box_max[0], header.box_max[1], header.box_max[2]});
  const bool near = std::all_of(header.centre, header.centre + 3, [](double c) { return std::fabs(c) <= kMostCoordinate; });
  if (!numbers || !near || header.resolution > 3 || header.dimension > 3 || !(header.radius_factor >= 1) ||
      !(header.radius >= 0) || header.map_side > kMaxMapSide || header.reserved != 0) {
    return bad("a number in the header is out of range");
  }

  auto body = std::make_shared<Model::Body>(Model::Body{std::move(block), header, {}, {}, {}});
  std::uint64_t map_cells = 0;
  for (const LevelHeader& l : level_headers) {
    if (l.map_side > kMaxMapSide) return bad("a support map's side is out of range");
    map_cells += lut::cube_cell_count(l.map_side);
  }
  if (maps_part.size() != 4 * map_cells) return bad("the support maps have the wrong size");
  for (int i = 0; i < count; ++i) {
    const LevelHeader& l = level_headers[i];
    const std::string name = "level " + std::to_string(i) + ": ";
    if (!finite({l.deviation, l.volume, l.edge_length}) || l.reserved != 0 ||
        !(l.extent == 0 || (l.extent >= kLeastExtent && l.extent <= kMostCoordinate)) || !(l.deviation >= 0) ||
        (i == 0 && l.deviation != 0))
      return bad(name + "a number is out of range");
    Cursor cursor(parts[i]);
    Level level;
    level.view.vertices = cursor.take<Vertex>(l.vertex_count);
    level.view.planes = cursor.take<FacePlane>(l.plane_count);
    level.view.head = cursor.take<std::uint32_t>(l.half_edge_count);
    level.view.twin = cursor.take<std::uint32_t>(l.half_edge_count);
    level.view.face = cursor.take<std::uint32_t>(l.half_edge_count);
    level.view.face_first = cursor.take<std::uint32_t>(l.face_count);
    if (i != 0) level.child_vertex = cursor.take<std::uint32_t>(l.vertex_count);
    if (i != 0) level.child_face = cursor.take<Handle>(l.face_count);
    if (i != count - 1) level.parent_face = cursor.take<std::uint32_t>(l.face_count);
    map_cells -= lut::cube_cell_count(l.map_side);  // coarsest first
    level.support_map = Cursor(maps_part.subspan(4 * map_cells)).take<std::uint32_t>(lut::cube_cell_count(l.map_side));
    level.map_side = l.map_side;
    for (const std::uint32_t entry : level.support_map) {
      if (map_vertex(entry) >= l.vertex_count) return bad(name + "the support map names no vertex");
    }
    level.edge_length = l.edge_length;
    level.view.extent = l.extent;
    level.view.centre = Vec3(header.centre[0], header.centre[1], header.centre[2]);
    level.deviation = l.deviation;
    level.volume = l.volume;
    level.bytes = l.section.bytes;
    level.edge_count = l.edge_count;
    level.triangle_count = l.triangle_count;
    if (l.plane_count > l.face_count || l.half_edge_count > kMaxIndex || l.vertex_count > kMaxIndex)
      return bad(name + "bad counts");
    if (const std::string f = topology_fault(level.view); !f.empty()) return bad(name + f);
    if (const std::string f = plane_fault(level.view); !f.empty()) return bad(name + f);
    body->levels.push_back(level);
  }
  for (int i = 0; i < count; ++i) {
    const std::string f =
        link_fault(body->levels[i], i > 0 ? &body->levels[i - 1] : nullptr, i + 1 < count ? &body->levels[i + 1] : nullptr);
    if (!f.empty()) return bad("level " + std::to_string(i) + ": " + f);
  }

  const ConvexView& exact = body->levels[0].view;
  const std::uint64_t samples = lut::sample_count(lut::Resolution(header.resolution));
  if (table_part.size() != 4 * samples) return bad("the table has the wrong size");
  body->table = Cursor(table_part).take<std::uint32_t>(samples);
  if (!all_below(body->table, exact.vertices.size())) return bad("the table names no vertex");

  const std::uint64_t v = exact.vertices.size(), f = exact.face_first.size();
  if (header.source_face_count > bytes.size() || source_part.size() != 4 * (v + f + 1 + header.source_face_count))
    return bad("the source map has the wrong size");
  Cursor cursor(source_part);
  body->source.vertex = cursor.take<std::uint32_t>(v);
  body->source.face_begin = cursor.take<std::uint32_t>(f + 1);
  body->source.face = cursor.take<std::uint32_t>(header.source_face_count);
  const auto& begin = body->source.face_begin;
  if (begin.front() != 0 || begin.back() != header.source_face_count || !std::is_sorted(begin.begin(), begin.end()))
    return bad("the source map is out of order");
  const std::span<const Level> levels = body->levels;
  int map_level = count;  // every level from the finest map on has one
  while (map_level > 0 && levels[map_level - 1].map_side > 0) --map_level;
  return Model(std::move(body), levels, map_level);
}

}  // namespace swiftlet
