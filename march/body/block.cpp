// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Composes a block from its sections, and reads one: headers, hashes and structure are checked before a section is believed.
#include "body/block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <swiftlet/model_file.h>

#include "body/half_edge.h"
#include "body/structure.h"
#include "body/support_map.h"
#include "numeric/tolerance.h"

namespace swiftlet {
namespace {

struct FreeAligned {
  std::align_val_t alignment;
  void operator()(std::byte* p) const { ::operator delete[](p, alignment); }
};

/// Zeroed bytes that begin a cache line, or, where they fill one, a large page, which Linux is asked for: queries of a large
/// body read some 20 small pages each, and the TLB holds few of the body's pages.
std::shared_ptr<std::byte[]> zeroed(std::size_t size) {
  constexpr std::size_t kLargePage = std::size_t{1} << 21;
  const std::align_val_t alignment{size < kLargePage ? 64 : kLargePage};
  std::shared_ptr<std::byte[]> bytes(static_cast<std::byte*>(::operator new[](size, alignment)), FreeAligned{alignment});
#ifdef __linux__
  if (size >= kLargePage) madvise(bytes.get(), size, MADV_HUGEPAGE);  // if it declines, pages are small
#endif
  std::memset(bytes.get(), 0, size);
  return bytes;
}

static_assert(std::endian::native == std::endian::little, "the block is little-endian; a byte-swapping reader is not written");
static_assert(sizeof(Vertex) == 32 && sizeof(FacePlane) == 40 && sizeof(HalfEdge) == 12 && sizeof(FeatureId) == 4);

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 60;  // so that sums of offsets do not overflow

constexpr char kMagic[8] = {'\x89', 'S', 'W', 'L', '\r', '\n', '\x1a', '\n'};  // modelled on PNG's: a text transfer breaks it

constexpr std::uint64_t aligned(std::uint64_t offset) { return (offset + 63) & ~std::uint64_t{63}; }

std::uint64_t header_bytes(std::uint64_t level_count) { return sizeof(BlockHeader) + level_count * sizeof(LevelHeader); }

std::uint64_t section_bytes(const LevelHeader& level, bool finest, bool coarsest) {
  const std::uint64_t v = level.vertex_count, h = level.half_edge_count, f = level.face_count, p = level.plane_count;
  return 32 * v + 40 * p + 4 * (3 * h + f) + (finest ? 0 : 4 * (v + f)) + (coarsest ? 0 : 4 * f);
}

std::span<const std::byte> part(std::span<const std::byte> block, const Section& section) {
  return block.subspan(section.offset, section.bytes);
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

AlignedBytes::AlignedBytes(std::size_t size) : size_(size), data_(zeroed(size)) {}

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
  for (std::size_t i = levels.size(); i-- > header.finest_level;) place(levels[i].section, parts.levels[i]);
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
  for (std::size_t i = header.finest_level; i < levels.size(); ++i)
    write(levels[i].section.offset, parts.levels[i].data(), parts.levels[i].size());
  write(header.maps.offset, parts.maps.data(), parts.maps.size());
  write(header.table.offset, parts.table.data(), parts.table.size());
  write(header.source.offset, parts.source.data(), parts.source.size());
  return block;
}

std::uint64_t Headers::prefix(int level) const {
  if (level < int(block.finest_level)) return 0;
  if (level == int(block.finest_level)) return block.total_bytes;
  const Section& section = levels[std::size_t(level)].section;
  return section.offset + section.bytes;
}

std::string length_fault(const Headers& headers, std::uint64_t bytes) {
  if (headers.block.total_bytes == bytes) return {};
  return "the file has " + std::to_string(bytes) + " bytes, its header says " + std::to_string(headers.block.total_bytes);
}

int Headers::finest(const Detail& detail) const {
  int level = int(levels.size()) - 1;
  while (level > int(block.finest_level) && !(levels[std::size_t(level)].deviation < detail.deviation) &&
         prefix(level - 1) <= detail.bytes)
    --level;
  return level;
}

namespace {

/// An error text if a number in a header is out of range, else empty.
std::string fault(const BlockHeader& h) {
  if (h.total_bytes > kMostBytes) return "more bytes than there can be";
  if (h.finest_level >= h.level_count) return "no level is in the block";
  const bool numbers = finite({h.radius_factor, h.radius, h.inner_radius, h.box_min[0], h.box_min[1], h.box_min[2],
                               h.box_max[0], h.box_max[1], h.box_max[2]});
  const bool near = std::all_of(h.centre, h.centre + 3, [](double c) { return std::fabs(c) <= kMostCoordinate; });
  if (!numbers || !near || h.resolution > 3 || h.dimension > 3 || !(h.radius_factor >= 1) || !(h.radius >= 0) ||
      !(h.inner_radius >= 0) || !(h.scale_around >= 0) || !(h.scale_inside >= 0 && h.scale_inside < kInfinity) ||
      h.map_cells > kMostMapCells)
    return "a number in the header is out of range";
  return {};
}

/// True if the entries have the bound that `kMapError` takes for granted.
bool is_frame(std::span<const float, 6> frame) {
  double sum = 0;
  for (const float entry : frame) sum += std::fabs(double(entry));
  return sum <= kMostMapFrame && frame[0] > 0 && frame[3] > 0 && frame[5] > 0;
}

std::string fault(const LevelHeader& l, bool finest, bool coarsest) {
  if (l.section.bytes != section_bytes(l, finest, coarsest)) return "has the wrong size";
  if (l.vertex_count < 1) return "is empty";
  if (!finite({l.deviation, l.volume, l.edge_length, l.reach}) || !(l.reach >= 0) || !is_frame(l.map_frame) ||
      !(l.extent == 0 || (l.extent >= kLeastExtent && l.extent <= kMostCoordinate)) || !(l.deviation >= 0) ||
      (finest && l.deviation != 0))
    return "has a number out of range";
  if (l.rims > l.plane_count || l.plane_count > l.face_count || l.half_edge_count > kMaxIndex || l.vertex_count > kMaxIndex)
    return "has bad counts";
  return l.map_side > kMaxMapSide ? "has a support map whose side is out of range" : "";
}

/// An error text unless the sections follow one another to the block's end and levels left out have offset 0.
std::string layout_fault(const Headers& h) {
  std::uint64_t end = header_bytes(h.levels.size());
  bool fits = true;
  const auto follows = [&](const Section& s) {
    fits = fits && s.offset == aligned(end) && s.bytes <= h.block.total_bytes && s.offset <= h.block.total_bytes - s.bytes;
    end = s.offset + s.bytes;
    return fits;
  };
  if (!follows(h.block.maps)) return "the support maps lie outside the file";
  for (std::size_t i = h.levels.size(); i-- > 0;) {
    const Section& section = h.levels[i].section;
    if (i >= h.block.finest_level ? !follows(section) : section.offset != 0)
      return "level " + std::to_string(i) + " lies outside the file";
  }
  if (!follows(h.block.table)) return "the table lies outside the file";
  if (!follows(h.block.source)) return "the source map lies outside the file";
  return end == h.block.total_bytes ? "" : "bytes after the end";
}

/// An error text unless the sections have the sizes that the headers imply. Without level 0 a block has no table or source map.
std::string size_fault(const Headers& h) {
  std::uint64_t map_cells = 0;
  for (const LevelHeader& l : h.levels) map_cells += lut::octahedron_cell_count(l.map_side);
  if (h.block.maps.bytes != 4 * map_cells) return "the support maps have the wrong size";
  if (h.block.table.bytes != 4 * std::uint64_t{lut::sample_count(lut::Resolution(h.block.resolution))})
    return "the table has the wrong size";
  const std::uint64_t ids = std::uint64_t{h.levels[0].vertex_count} + h.levels[0].face_count + 1;
  const bool whole = h.block.finest_level == 0;
  if (h.block.source_face_count > kMostBytes || h.block.source.bytes != (whole ? 4 * (ids + h.block.source_face_count) : 0))
    return "the source map has the wrong size";
  return whole || h.block.table.bytes == 0 ? "" : "a table without level 0";
}

std::uint64_t end_of(const Section& section) { return section.offset + section.bytes; }

/// An error text unless all bytes from offset `before` to the section are zero and the section's bytes have its hash.
std::string damage(std::span<const std::byte> block, std::uint64_t before, const Section& section, const std::string& name) {
  const auto gap = block.subspan(before, section.offset - before);
  if (std::any_of(gap.begin(), gap.end(), [](std::byte b) { return b != std::byte{0}; })) return "damaged before " + name;
  return hash_of(part(block, section)) == section.hash ? "" : "damaged " + name;
}

/// The squared cosine of the angle that `edges` edges span on a level of so many vertices, which is taken to have as many edges
/// per radian as the root of that; 0 if they span a right angle. The angle is taken as its chord, whose square is 2 - 2 cos.
double cos2_of(double edges, std::uint32_t vertices) {
  const double cosine = 1 - edges * edges / (2 * double(vertices));
  return cosine > 0 ? cosine * cosine : 0;
}

/// True if a map frame differs little from a multiple of the identity: the level is about as wide in all directions.
bool is_round(const std::array<double, 6>& m) {
  return std::fabs(m[3] - m[0]) + std::fabs(m[5] - m[0]) + std::fabs(m[1]) + std::fabs(m[2]) + std::fabs(m[4]) < kRound * m[0];
}

/// A level with the numbers that the headers give and without arrays.
Level described(const BlockHeader& block, const LevelHeader& l) {
  Level level;
  level.map_side = l.map_side;
  level.map_frame = map_frame(l);
  level.is_round = is_round(level.map_frame);
  level.map_doubt = l.map_side == 0 ? 0 : kMapDoubt * l.extent / (double(l.map_side) * double(l.map_side));
  level.edge_length = l.edge_length;
  level.same_cos2 = cos2_of(kSameEdges, l.vertex_count);
  level.near_cos2 = cos2_of(l.map_side == 0  ? kWarmEdgesUnmapped
                            : level.is_round ? kWarmEdgesRound
                                             : kWarmEdges,
                            l.vertex_count);
  level.view.rims = l.rims;
  level.view.extent = l.extent;
  level.view.centre = Vec3(block.centre[0], block.centre[1], block.centre[2]);
  level.view.reach = l.reach;
  level.deviation = l.deviation;
  level.volume = l.volume;
  level.bytes = l.section.bytes;
  level.edge_count = l.edge_count;
  level.triangle_count = l.triangle_count;
  return level;
}

// Each function sets spans to the arrays of a section and returns an error text, or an empty string if the section is sound.

std::string take_maps(std::span<const std::byte> block, const Headers& h, std::vector<Level>& levels) {
  if (std::string f = damage(block, header_bytes(h.levels.size()), h.block.maps, "the support maps"); !f.empty()) return f;
  Cursor cursor(part(block, h.block.maps));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i].support_map = cursor.take<std::uint32_t>(lut::octahedron_cell_count(h.levels[i].map_side));
    for (const std::uint32_t entry : levels[i].support_map) {
      if (map_vertex(entry) >= h.levels[i].vertex_count)
        return "level " + std::to_string(i) + ": the support map names no vertex";
    }
  }
  return {};
}

std::string take_level(std::span<const std::byte> block, const Headers& h, std::size_t i, Level& level) {
  const bool coarsest = i + 1 == h.levels.size();
  const std::string name = "level " + std::to_string(i);
  const LevelHeader& l = h.levels[i];
  const Section& before = coarsest ? h.block.maps : h.levels[i + 1].section;
  if (std::string f = damage(block, end_of(before), l.section, name); !f.empty()) return f;
  Cursor cursor(part(block, l.section));
  level.view.vertices = cursor.take<Vertex>(l.vertex_count);
  level.view.planes = cursor.take<FacePlane>(l.plane_count);
  const auto half_edges = cursor.take<HalfEdge>(l.half_edge_count);
  level.view.half_edges = half_edges;
  level.view.face_first = cursor.take<std::uint32_t>(l.face_count);
  level.feature_count = feature_count(level.view);
  if (i != 0) level.child_vertex = cursor.take<std::uint32_t>(l.vertex_count);
  if (i != 0) level.child_face = cursor.take<FeatureId>(l.face_count);
  if (!coarsest) level.parent_face = cursor.take<std::uint32_t>(l.face_count);
  std::string fault = topology_fault(level.view);
  if (fault.empty() && h.levels.size() > 1 && l.face_count == 0) fault = "a level without faces has no others";
  if (fault.empty()) fault = plane_fault(level.view);
  if (fault.empty()) fault = rim_fault(level.view);
  if (fault.empty()) {
    fault = link_fault(level, i == 0 ? 0 : h.levels[i - 1].vertex_count, i == 0 ? 0 : h.levels[i - 1].face_count,
                       coarsest ? 0 : h.levels[i + 1].vertex_count);
  }
  return fault.empty() ? "" : name + ": " + fault;
}

std::string take_table(std::span<const std::byte> block, const Headers& h, std::span<const std::uint32_t>& table) {
  if (std::string f = damage(block, end_of(h.levels[h.block.finest_level].section), h.block.table, "the table"); !f.empty())
    return f;
  table = Cursor(part(block, h.block.table)).take<std::uint32_t>(h.block.table.bytes / 4);
  const bool named = std::all_of(table.begin(), table.end(), [&](std::uint32_t v) { return v < h.levels[0].vertex_count; });
  return named ? "" : "the table names no vertex";
}

std::string take_source(std::span<const std::byte> block, const Headers& h, SourceMap& source) {
  if (std::string f = damage(block, end_of(h.block.table), h.block.source, "the source map"); !f.empty()) return f;
  if (h.block.finest_level > 0) return {};
  Cursor cursor(part(block, h.block.source));
  source.vertex = cursor.take<std::uint32_t>(h.levels[0].vertex_count);
  source.face_begin = cursor.take<std::uint32_t>(std::size_t{h.levels[0].face_count} + 1);
  source.face = cursor.take<std::uint32_t>(h.block.source_face_count);
  const auto& begin = source.face_begin;
  const bool in_order =
      begin.front() == 0 && begin.back() == h.block.source_face_count && std::is_sorted(begin.begin(), begin.end());
  return in_order ? "" : "the source map is out of order";
}

}  // namespace

bool is_model_block(std::span<const std::byte> start) {
  return start.size() >= sizeof kMagic && std::memcmp(start.data(), kMagic, sizeof kMagic) == 0;
}

Result<Headers> BlockReader::read_headers(std::span<const std::byte> start) {
  Headers h;
  if (start.size() < sizeof h.block) return bad("too short for a swiftlet model");
  std::memcpy(&h.block, start.data(), sizeof h.block);
  if (!is_model_block(start)) return bad("not a swiftlet model");
  if (h.block.version != kModelFileVersion) {
    return Error{ErrorCode::BadVersion, "model version " + std::to_string(h.block.version) + ", this library reads version " +
                                            std::to_string(kModelFileVersion) +
                                            ": build it again with `swiftlet build MESH -o MODEL`"};
  }
  const std::uint64_t size = header_bytes(h.block.level_count);
  if (h.block.level_count < 1 || h.block.level_count > kMaxLevels) return bad("bad level count");
  if (start.size() < size) return bad("ends within its header");
  std::vector<std::byte> hashed(start.begin(), start.begin() + std::ptrdiff_t(size));
  std::memset(hashed.data() + offsetof(BlockHeader, header_hash), 0, sizeof h.block.header_hash);
  if (hash_of(hashed) != h.block.header_hash) return bad("damaged header");
  h.levels.resize(h.block.level_count);
  std::memcpy(h.levels.data(), start.data() + sizeof h.block, h.levels.size() * sizeof(LevelHeader));

  if (std::string f = fault(h.block); !f.empty()) return bad(f);
  for (std::size_t i = 0; i < h.levels.size(); ++i) {
    const std::string f = fault(h.levels[i], i == 0, i + 1 == h.levels.size());
    if (!f.empty()) return bad("level " + std::to_string(i) + " " + f);
  }
  if (std::string f = layout_fault(h); !f.empty()) return bad(f);
  if (std::string f = size_fault(h); !f.empty()) return bad(f);
  return h;
}

Result<Model> BlockReader::read(Block block) {
  const Result<Headers> headers = read_headers(block.bytes);
  if (!headers) return headers.error();
  if (const std::string f = length_fault(headers.value(), block.bytes.size()); !f.empty()) return bad(f);
  return read(std::move(block), int(headers.value().block.finest_level));
}

Result<Model> BlockReader::read(Block block, int finest) {
  Result<Headers> headers = read_headers(block.bytes);
  if (!headers) return headers.error();
  if (headers.value().prefix(finest) > block.bytes.size()) return bad("ends before level " + std::to_string(finest) + " does");
  const int count = int(headers.value().levels.size());
  auto body = std::make_shared<Model::Content>(Model::Content{std::move(block), std::move(headers).value(), count, {}, {}, {}});
  for (const LevelHeader& l : body->headers.levels) {
    body->levels.push_back(described(body->headers.block, l));
    body->levels.back().prefix = body->headers.prefix(int(body->levels.size()) - 1);
  }
  const BlockHeader& block_header = body->headers.block;
  body->levels[0].view.inner_radius = block_header.inner_radius;
  body->levels[0].scale_around = block_header.scale_around, body->levels[0].scale_inside = block_header.scale_inside;
  if (const std::string f = take_maps(body->block.bytes, body->headers, body->levels); !f.empty()) return bad(f);
  return with_levels(std::move(body), finest);
}

Result<Model> BlockReader::refined(const Model& model, int finest) {
  return with_levels(std::make_shared<Model::Content>(*model.content_), finest);
}

Result<Model> BlockReader::with_levels(std::shared_ptr<Model::Content> body, int finest) {
  const auto bytes = body->block.bytes;
  const Headers& h = body->headers;
  while (body->finest > finest) {
    const auto i = std::size_t(--body->finest);
    if (const std::string f = take_level(bytes, h, i, body->levels[i]); !f.empty()) return bad(f);
  }
  if (finest == int(h.block.finest_level)) {
    if (const std::string f = take_table(bytes, h, body->table); !f.empty()) return bad(f);
    if (const std::string f = take_source(bytes, h, body->source); !f.empty()) return bad(f);
  }
  int map_level = int(body->levels.size());  // all levels coarser than one with a map have maps
  while (map_level > 0 && body->levels[std::size_t(map_level) - 1].map_side > 0) --map_level;
  const std::span<const Level> levels = body->levels;
  const double radius = h.block.radius;
  return Model(std::move(body), levels, radius, std::max(map_level, finest), finest);
}

BlockParts BlockReader::parts(const Model& model, int finest) {
  const Model::Content& body = *model.content_;
  const Headers& h = body.headers;
  const auto copy = [&](const Section& section, std::uint64_t bytes) {
    const auto from = part(body.block.bytes, section).last(bytes);
    return std::vector<std::byte>(from.begin(), from.end());
  };
  BlockParts parts;
  parts.header = h.block;
  parts.level_headers = h.levels;
  parts.levels.resize(h.levels.size());
  std::uint64_t map_cells = 0;
  for (std::size_t i = 0; i < h.levels.size(); ++i) {
    LevelHeader& l = parts.level_headers[i];
    if (int(i) < finest) {
      l.section.offset = 0;
      l.map_side = 0;
    } else {
      parts.levels[i] = copy(l.section, l.section.bytes);
      map_cells += lut::octahedron_cell_count(l.map_side);
    }
  }
  parts.maps = copy(h.block.maps, 4 * map_cells);  // the maps lie finest first, so these are the last
  parts.header.finest_level = std::uint32_t(finest);
  if (finest == 0) {
    parts.table = copy(h.block.table, h.block.table.bytes);
    parts.source = copy(h.block.source, h.block.source.bytes);
  } else {
    parts.header.resolution = 0;
    parts.header.source_face_count = 0;
  }
  return parts;
}

}  // namespace swiftlet
