// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Composes the block of a mesh, reads it, and checks that nothing in it can lead a query outside of it.
#include "mesh_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace swiftlet {
namespace {

constexpr char kMagic[8] = {'s', 'w', 'i', 'f', 't', 'm', 's', 'h'};

constexpr std::uint64_t aligned(std::uint64_t offset) { return (offset + 63) / 64 * 64; }

std::uint64_t hash_of_header(MeshHeader header) {
  header.header_hash = 0;
  return hash_of(std::as_bytes(std::span(&header, 1)));
}

/// The sections in the order of the file, each with its name, the size of an element and how many there are.
struct Part {
  const char* name;
  Section MeshHeader::*section;
  std::size_t size;
  std::uint32_t MeshHeader::*count;
};
constexpr Part kParts[] = {{"nodes", &MeshHeader::nodes, sizeof(Node), &MeshHeader::node_count},
                           {"triangles", &MeshHeader::triangles, sizeof(Corners), &MeshHeader::triangle_count},
                           {"vertices", &MeshHeader::vertices, sizeof(Vec), &MeshHeader::vertex_count},
                           {"sources of triangles", &MeshHeader::source_triangle, 4, &MeshHeader::triangle_count},
                           {"sources of vertices", &MeshHeader::source_vertex, 4, &MeshHeader::vertex_count}};

template <class T>
std::span<const T> section_of(const Block& block, const Section& section) {
  return {reinterpret_cast<const T*>(block.bytes.data() + section.offset), std::size_t(section.bytes / sizeof(T))};
}

std::string fault(const MeshHeader& h) {
  if (h.triangle_count == 0 || h.triangle_count > kMostTriangles || h.vertex_count == 0 || h.node_count == 0 ||
      h.vertex_count > 3 * std::uint64_t{kMostTriangles} || h.node_count > kMostTriangles)
    return "a count out of range";
  if (h.depth < 1 || h.depth > kMostDepth || h.unit < -160 || h.unit > 160) return "a depth or unit out of range";
  const double largest = power_of_two(h.unit);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(h.box_min[axis] <= h.box_max[axis] && h.box_min[axis] >= -largest && h.box_max[axis] <= largest))
      return "a box out of range";
  }
  if (!std::isfinite(h.volume)) return "a volume that is no number";
  return "";
}

/// Checks nodes level by level: the children of one are all of the next, one after the other, so that a way down ends after
/// `depth` steps, whatever the boxes say.
std::string fault(const MeshHeader& h, std::span<const Node> nodes) {
  std::uint64_t child = 1, triangles = 0, level_end = 1;
  std::uint32_t depth = 1;
  for (std::uint64_t i = 0; i < nodes.size(); ++i) {
    if (i == level_end) ++depth, level_end = child;
    const Node& node = nodes[i];
    const std::uint64_t count = std::uint64_t(node.count());
    if (i >= child) return "node " + std::to_string(i) + " of no other";
    if (node.lowest()) {
      triangles += count;
      if (node.first() + count > h.triangle_count) return "node " + std::to_string(i) + " with triangles that do not exist";
    } else {
      if (node.first() != child) return "node " + std::to_string(i) + " with children out of order";
      child += count;
    }
    // Sizes are not negative: of two nodes one at most is much the larger one, and opened alone.
    const auto within = [](const float* p, int size, float least, float most) {
      return std::all_of(p, p + size, [=](float x) { return x >= least && x <= most; });
    };
    if (!within(node.centre[0], 3 * kFanOut, -8, 8) || !within(node.half[0], 3 * kFanOut, 0, 8) ||
        !within(node.extent, 3, 0, 8) || !within(node.axis[0], 6, -2, 2) ||
        !std::all_of(node.origin, node.origin + 3, [](double x) { return std::fabs(x) <= 8; }))
      return "node " + std::to_string(i) + " with a number out of range";
  }
  if (child != nodes.size() || depth != h.depth) return "nodes that are too few or too many";
  return triangles == h.triangle_count ? "" : "nodes that miss triangles";
}

}  // namespace

AlignedBytes compose(const MeshParts& parts) {
  MeshHeader header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = kMeshFileVersion;
  header.depth = std::uint32_t(parts.depth);
  header.unit = parts.unit;
  header.node_count = std::uint32_t(parts.nodes.size());
  header.triangle_count = std::uint32_t(parts.triangles.size());
  header.vertex_count = std::uint32_t(parts.vertices.size());
  for (int axis = 0; axis < 3; ++axis)
    header.box_min[axis] = eigen(parts.box_min)[axis], header.box_max[axis] = eigen(parts.box_max)[axis];
  const MeshTopology& t = parts.topology;
  header.components = t.components, header.open_edges = t.open_edges, header.non_manifold_edges = t.non_manifold_edges;
  header.flipped_edges = t.flipped_edges, header.flat_triangles = t.flat_triangles, header.duplicates = t.duplicates;
  header.volume = t.volume;

  const std::span<const std::byte> data[] = {std::as_bytes(std::span(parts.nodes)), std::as_bytes(std::span(parts.triangles)),
                                             std::as_bytes(std::span(parts.vertices)),
                                             std::as_bytes(std::span(parts.source_triangle)),
                                             std::as_bytes(std::span(parts.source_vertex))};
  std::uint64_t offset = sizeof header;
  for (std::size_t i = 0; i < std::size(kParts); ++i) {
    offset = aligned(offset);
    header.*kParts[i].section = {offset, data[i].size(), hash_of(data[i])};
    offset += data[i].size();
  }
  header.total_bytes = offset;
  header.header_hash = hash_of_header(header);
  AlignedBytes block{std::size_t(offset)};
  std::memcpy(block.data(), &header, sizeof header);
  for (std::size_t i = 0; i < std::size(kParts); ++i)
    std::memcpy(block.data() + (header.*kParts[i].section).offset, data[i].data(), data[i].size());
  return block;
}

bool is_mesh_block(std::span<const std::byte> start) {
  return start.size() >= sizeof kMagic && std::memcmp(start.data(), kMagic, sizeof kMagic) == 0;
}

Result<MeshModel> MeshReader::read(Block block) {
  const auto bad = [](const std::string& what) { return Error{ErrorCode::BadFormat, what}; };
  if (!is_mesh_block(block.bytes)) return bad("this is no mesh file");
  MeshHeader h{};
  if (block.bytes.size() < sizeof h) return bad("the file ends within its header");
  std::memcpy(&h, block.bytes.data(), sizeof h);
  if (h.version != kMeshFileVersion) {
    return Error{ErrorCode::BadVersion, "file version " + std::to_string(h.version) + " where this library reads " +
                                            std::to_string(kMeshFileVersion) + ": build the mesh again"};
  }
  if (h.header_hash != hash_of_header(h)) return bad("damaged header");
  if (const std::string f = fault(h); !f.empty()) return bad("the header has " + f);
  std::uint64_t offset = sizeof h;
  for (const Part& part : kParts) {
    const Section& section = h.*part.section;
    offset = aligned(offset);
    if (section.offset != offset || section.bytes != std::uint64_t(h.*part.count) * part.size)
      return bad(std::string("the size of its ") + part.name + " does not fit its header");
    offset += section.bytes;
  }
  if (h.total_bytes != offset) return bad("its size does not fit its header");
  if (block.bytes.size() != offset)
    return bad("it has " + std::to_string(block.bytes.size()) + " bytes where its header says " + std::to_string(offset));
  std::uint64_t end = sizeof h;
  for (const Part& part : kParts) {
    const Section& section = h.*part.section;
    const auto gap = block.bytes.subspan(end, section.offset - end);
    if (std::any_of(gap.begin(), gap.end(), [](std::byte b) { return b != std::byte{0}; })) return bad("damaged padding");
    end = section.offset + section.bytes;
    if (hash_of(block.bytes.subspan(section.offset, section.bytes)) != section.hash)
      return bad(std::string("damaged ") + part.name);
  }

  auto content = std::make_shared<MeshModel::Content>();
  MeshModel::Content& c = *content;
  c.header = h;
  c.topology = {h.components, h.open_edges, h.non_manifold_edges, h.flipped_edges, h.flat_triangles, h.duplicates, h.volume};
  for (int axis = 0; axis < 3; ++axis) c.extent = std::max({c.extent, std::fabs(h.box_min[axis]), std::fabs(h.box_max[axis])});
  c.nodes = section_of<Node>(block, h.nodes);
  c.triangles = section_of<Corners>(block, h.triangles);
  c.vertices = section_of<Vec>(block, h.vertices);
  c.source_triangle = section_of<std::uint32_t>(block, h.source_triangle);
  c.source_vertex = section_of<std::uint32_t>(block, h.source_vertex);
  c.block = std::move(block);
  if (const std::string f = fault(h, c.nodes); !f.empty()) return bad("it has " + f);
  for (const Corners& corners : c.triangles) {
    if (std::max({corners[0], corners[1], corners[2]}) >= h.vertex_count)
      return bad("triangle " + std::to_string(&corners - c.triangles.data()) + " has a vertex that does not exist");
  }
  const double largest = power_of_two(h.unit);
  for (const Vec& v : c.vertices) {
    const auto legal = [&](double x) { return x == 0 || (std::fabs(x) >= kLeastExtent && std::fabs(x) <= largest); };
    if (!legal(v.x) || !legal(v.y) || !legal(v.z))
      return bad("vertex " + std::to_string(&v - c.vertices.data()) + " has a coordinate out of range");
  }
  return MeshModel(std::move(content));
}

}  // namespace swiftlet
