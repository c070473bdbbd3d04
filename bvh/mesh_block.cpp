// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Composes the block of a mesh, reads it, and checks that nothing in it can lead a query outside of it.
#include "mesh_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

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
constexpr Part kParts[] = {{"hulls", &MeshHeader::hulls, sizeof(HullRecord), &MeshHeader::hull_count},
                           {"models of hulls", &MeshHeader::hull_models, 64, &MeshHeader::hull_units},
                           {"shells", &MeshHeader::shells, 4, &MeshHeader::components},
                           {"triangles", &MeshHeader::triangles, sizeof(Corners), &MeshHeader::triangle_count},
                           {"vertices", &MeshHeader::vertices, sizeof(Vec), &MeshHeader::vertex_count},
                           {"sources of triangles", &MeshHeader::source_triangle, 4, &MeshHeader::triangle_count},
                           {"sources of vertices", &MeshHeader::source_vertex, 4, &MeshHeader::vertex_count}};
/// A cut block has these of the parts alone.
constexpr std::size_t kPartsOfNodes = 2;

/// How many of a part's elements a block with this header holds.
std::uint64_t held(const MeshHeader& h, std::size_t part) {
  return part < kPartsOfNodes || h.levels == h.depth ? h.*kParts[part].count : 0;
}

template <class T>
std::span<const T> section_of(const Block& block, const Section& section) {
  return {reinterpret_cast<const T*>(block.bytes.data() + section.offset), std::size_t(section.bytes / sizeof(T))};
}

/// What lies one after the other behind a header, gaps apart, each with its name.
std::vector<std::pair<Section, std::string>> sections_of(const MeshHeader& h) {
  std::vector<std::pair<Section, std::string>> sections;
  for (std::uint32_t k = 0; k < h.levels; ++k) sections.emplace_back(h.level[k], "nodes of level " + std::to_string(k));
  for (const Part& part : kParts) sections.emplace_back(h.*part.section, part.name);
  return sections;
}

/// What is wrong with where a header says that its sections lie: each has its size and follows the one before, so that all
/// together are no larger than the file.
std::string misplaced(const MeshHeader& h) {
  for (std::size_t i = 0; i < std::size(kParts); ++i) {
    if ((h.*kParts[i].section).bytes != held(h, i) * kParts[i].size)
      return std::string("the size of its ") + kParts[i].name + " does not fit its header";
  }
  std::uint64_t offset = sizeof h;
  for (const auto& [section, name] : sections_of(h)) {
    offset = aligned(offset);
    if (section.offset != offset) return "its " + name + " do not begin where they should";
    offset += section.bytes;
  }
  return h.total_bytes == offset ? "" : "its size does not fit its header";
}

/// No coordinate of a legal mesh is larger.
double most_coordinate(const MeshHeader& h) { return min(power_of_two(h.unit), kMostCoordinate); }

std::string fault(const MeshHeader& h) {
  if (h.triangle_count == 0 || h.triangle_count > kMostTriangles || h.vertex_count == 0 || h.node_count == 0 ||
      h.vertex_count > 3 * std::uint64_t{kMostTriangles} || h.node_count > kMostTriangles)
    return "a count out of range";
  if (h.unused != 0) return "a word that is not 0";
  if (h.depth < 1 || h.depth > kMostDepth || h.levels < 1 || h.levels > h.depth || h.components > h.triangle_count ||
      h.unit < -160 || h.unit > 160)
    return "a depth or unit out of range";
  const double largest = most_coordinate(h);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(h.box_min[axis] <= h.box_max[axis] && h.box_min[axis] >= -largest && h.box_max[axis] <= largest))
      return "a box out of range";
  }
  if (!std::isfinite(h.volume)) return "a volume that is no number";
  for (std::uint32_t k = 0; k < kMostDepth; ++k) {
    if (!(h.deviation[k] >= 0 && h.deviation[k] < HUGE_VAL)) return "a deviation out of range";
    if (h.level[k].bytes > std::uint64_t{h.node_count} * sizeof(Node) || h.level[k].bytes % sizeof(Node) != 0 ||
        (h.level[k].bytes > 0) != (k < h.levels))
      return "a level out of range";
  }
  return "";
}

/// Checks nodes level by level: the children of one are all of the next, one after the other, so that a way down ends after
/// `depth` steps, whatever the boxes say.
std::string fault(const MeshHeader& h, std::span<const Node> nodes) {
  std::uint64_t child = 1, level_end = 0;
  std::uint32_t level = 0;
  for (std::uint64_t i = 0; i < nodes.size(); ++i) {
    if (i == level_end) {
      level_end = i + h.level[level++].bytes / sizeof(Node);
      if (level_end != child) return "a level of too few or too many nodes";
    }
    const Node& node = nodes[i];
    const std::uint64_t count = std::uint64_t(node.count());
    if (node.lowest()) {
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
  if (h.levels < h.depth) return child > nodes.size() && child <= h.node_count ? "" : "nodes that are too few or too many";
  if (child != nodes.size() || nodes.size() != h.node_count) return "nodes that are too few or too many";
  // Each triangle is below one lowest node if those of children follow one another, from the first to the last.
  const std::vector<TriangleRange> below = triangles_below(nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t first = nodes[i].first();
    for (std::uint32_t k = 1; !nodes[i].lowest() && k < std::uint32_t(nodes[i].count()); ++k) {
      if (below[first + k].begin != below[first + k - 1].end)
        return "node " + std::to_string(i) + " with triangles out of order";
    }
  }
  return below[0].begin == 0 && below[0].end == h.triangle_count ? "" : "nodes that miss triangles";
}

/// The size of each level of nodes, and how far the boxes below it reach from the surface inside them: a bound, since
/// axes are unit to `kAxisError`.
void measure_levels(const MeshParts& parts, MeshHeader& header) {
  std::size_t begin = 0, end = 1;
  double lowest = 0;
  for (int k = 0; k < parts.depth; ++k) {
    double inner = 0;
    std::size_t next = end;
    for (std::size_t i = begin; i < end; ++i) {
      const Node& node = parts.nodes[i];
      for (int child = 0; child < node.count(); ++child) {
        const Vec half{node.half[0][child], node.half[1][child], node.half[2][child]};
        double& most = node.lowest() ? lowest : inner;
        most = max(most, norm(half));
      }
      next += node.lowest() ? 0 : std::size_t(node.count());
    }
    header.level[k].bytes = (end - begin) * sizeof(Node);
    header.deviation[k] = times_power_of_two(2 * (max(lowest, inner) * (1 + 4 * kAxisError) + kMiddleError), parts.unit);
    begin = end, end = next;
  }
}

/// Fits the ball of a root around its body's vertices: that of few of them, each the farthest from the ball of those before
/// [Badoiu & Clarkson 2003].
void fit_ball(std::span<const Vec> vertices, Root& root) {
  constexpr int kPoints = 8, kSteps = 64;
  const auto farthest = [](std::span<const Vec> points, const Vec& from, double& most) {
    std::size_t found = 0;
    most = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec way = points[i] - from;
      if (const double square = dot(way, way); square > most) most = square, found = i;
    }
    return points[found];
  };
  Vec points[kPoints], centre = root.middle;
  for (std::size_t count = 0; count < kPoints; ++count) {
    double square;
    points[count] = farthest(vertices, centre, square);
    if (const double reach = std::sqrt(square); reach < root.reach) root.reach = reach, root.centre = centre;
    for (int step = 1; step <= kSteps; ++step)
      centre = centre + (farthest({points, count + 1}, centre, square) - centre) * (1.0 / (step + 1));
  }
  const Vec aside = root.middle - root.centre;
  root.aside = root.axes_x * aside.x + root.axes_y * aside.y + root.axes_z * aside.z;
  root.inside = min(min(root.half.x - std::fabs(root.aside.x), root.half.y - std::fabs(root.aside.y)),
                    root.half.z - std::fabs(root.aside.z));
}

/// Writes a block: the header, whose levels have their sizes, and what follows it, in the order of the file.
AlignedBytes assemble(MeshHeader header, std::span<const std::byte> nodes,
                      const std::array<std::span<const std::byte>, std::size(kParts)>& data) {
  std::uint64_t offset = aligned(sizeof header);
  for (std::uint32_t k = 0; k < header.levels; ++k) {
    Section& level = header.level[k];
    level = {offset, level.bytes,
             hash_of(nodes.subspan(std::size_t(offset - aligned(sizeof header)), std::size_t(level.bytes)))};
    offset += level.bytes;
  }
  for (std::size_t i = 0; i < data.size(); ++i) {
    offset = aligned(offset);
    header.*kParts[i].section = {offset, data[i].size(), hash_of(data[i])};
    offset += data[i].size();
  }
  header.total_bytes = offset;
  header.header_hash = hash_of_header(header);
  AlignedBytes block{std::size_t(offset)};
  const auto put = [&](std::uint64_t at, std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(block.data() + at, bytes.data(), bytes.size());
  };
  put(0, std::as_bytes(std::span(&header, 1)));
  put(header.level[0].offset, nodes);
  for (std::size_t i = 0; i < data.size(); ++i) put((header.*kParts[i].section).offset, data[i]);
  return block;
}

std::string named(const HullRecord& r, const std::string& what) {
  return "the hull of node " + std::to_string(r.node) + ": " + what;
}
/// What is wrong with a record before which there are hulls of nodes below `node`, and `offset` bytes of their models.
std::string fault(const MeshHeader& h, const HullRecord& r, std::size_t node, std::uint64_t offset) {
  if (r.node < node) return "hulls out of order";
  return r.offset == offset && r.bytes <= h.hull_models.bytes - offset ? "" : named(r, "its model is not in the file");
}

/// The hulls that a block holds, or what is wrong with them.
std::string read_hulls(const MeshHeader& h, const Block& block, MeshReader::Content& content) {
  std::uint64_t offset = 0;
  for (const HullRecord& r : section_of<HullRecord>(block, h.hulls)) {
    if (r.node >= content.nodes.size()) return "hulls out of order";
    if (std::string f = fault(h, r, content.hull_of.size(), offset); !f.empty()) return f;
    const auto at = std::size_t(h.hull_models.offset + offset);
    Result<Model> model = BlockReader::read(Block{block.owner, block.bytes.subspan(at, std::size_t(r.bytes))});
    if (!model) return named(r, model.error().message);
    content.hull_of.resize(r.node, kNone);
    content.hull_of.push_back(std::uint32_t(content.hulls.size()));
    content.hulls.push_back({r.node, r.first_triangle, std::move(model).value()});
    offset = aligned(offset + r.bytes);
  }
  return offset == h.hull_models.bytes ? "" : "hulls that do not fill their section";
}

/// Finds out what the marks on nodes say.
void place_patches(MeshReader::Content& content) {
  for (const NodeHull& hull : content.hulls) {
    if (content.nodes[hull.node].of_patch()) content.patch_place.resize(hull.node + 1, PatchPlace::Elsewhere);
  }
  std::vector<PatchPlace>& place = content.patch_place;
  for (std::size_t i = place.size(); i-- > 0;) {
    const Node& node = content.nodes[i];
    if (node.of_patch() && content.hull_at(std::uint32_t(i))) {
      place[i] = PatchPlace::At;
    } else if (!node.lowest()) {
      for (std::size_t k = node.first(), end = k + std::size_t(node.count()); k < std::min(end, place.size()); ++k)
        place[i] = place[k] != PatchPlace::Elsewhere ? PatchPlace::Above : place[i];
    }
  }
  if (!content.is_whole()) return;
  const std::vector<TriangleRange> below = place.empty() ? std::vector<TriangleRange>() : triangles_below(content.nodes);
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    if (place[i] == PatchPlace::At) content.patches.push_back({below[i].begin, below[i].end, i});
  }
  std::sort(content.patches.begin(), content.patches.end(),
            [](const PatchRange& x, const PatchRange& y) { return std::tie(x.begin, x.node) < std::tie(y.begin, y.node); });
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

  header.levels = header.depth;
  measure_levels(parts, header);
  std::vector<HullRecord> hulls;
  std::vector<std::byte> models;
  for (const NodeHull& hull : parts.hulls) {
    const std::span<const std::byte> bytes = hull.model.bytes();
    hulls.push_back({hull.node, hull.first_triangle, models.size(), bytes.size()});
    models.insert(models.end(), bytes.begin(), bytes.end());
    models.resize(std::size_t(aligned(models.size())));
  }
  header.hull_count = std::uint32_t(hulls.size()), header.hull_units = std::uint32_t(models.size() / 64);
  return assemble(header, std::as_bytes(std::span(parts.nodes)),
                  {std::as_bytes(std::span(hulls)), models, std::as_bytes(std::span(parts.shells)),
                   std::as_bytes(std::span(parts.triangles)), std::as_bytes(std::span(parts.vertices)),
                   std::as_bytes(std::span(parts.source_triangle)), std::as_bytes(std::span(parts.source_vertex))});
}

std::vector<TriangleRange> triangles_below(std::span<const Node> nodes) {
  std::vector<TriangleRange> below(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const std::uint32_t first = nodes[i].first(), end = first + std::uint32_t(nodes[i].count());
    below[i] = nodes[i].lowest() ? TriangleRange{first, end} : TriangleRange{below[first].begin, below[end - 1].end};
  }
  return below;
}

bool is_mesh_block(std::span<const std::byte> start) {
  return start.size() >= sizeof kMagic && std::memcmp(start.data(), kMagic, sizeof kMagic) == 0;
}

Result<MeshHeader> MeshReader::read_header(std::span<const std::byte> start) {
  const auto bad = [](const std::string& what) { return Error{ErrorCode::BadFormat, what}; };
  if (!is_mesh_block(start)) return bad("this is no mesh file");
  MeshHeader h{};
  if (start.size() < sizeof h) return bad("the file ends within its header");
  std::memcpy(&h, start.data(), sizeof h);
  if (h.version != kMeshFileVersion) {
    return Error{ErrorCode::BadVersion, "file version " + std::to_string(h.version) + " where this library reads " +
                                            std::to_string(kMeshFileVersion) +
                                            ": build it again with `swiftlet build --mesh MESH -o FILE`"};
  }
  if (h.header_hash != hash_of_header(h)) return bad("damaged header");
  if (const std::string f = fault(h); !f.empty()) return bad("the header has " + f);
  return h;
}

std::uint32_t MeshReader::levels(const MeshHeader& h, const Detail& detail) {
  std::uint32_t levels = h.levels;
  for (std::uint32_t k = 1; k < h.levels && detail.deviation > 0; ++k) {
    if (h.deviation[k - 1] < detail.deviation) levels = std::min(levels, k);
  }
  if (levels == h.depth && h.total_bytes > detail.bytes) --levels;
  while (levels > 1 && h.level[levels - 1].offset + h.level[levels - 1].bytes > detail.bytes) --levels;
  return std::max(levels, 1u);
}

Result<MeshModel> MeshReader::cut(std::span<const std::byte> bytes, std::uint32_t levels) {
  const Result<MeshHeader> whole = read_header(bytes);
  if (!whole) return whole.error();
  MeshHeader header = whole.value();
  const auto bad = [](const std::string& what) { return Error{ErrorCode::BadFormat, what}; };
  if (const std::string f = misplaced(header); !f.empty()) return bad(f);
  // Not all of it is where it says: a section's end may be beyond what is left, or lie about it.
  const auto is_whole = [&](const Section& s) {
    return s.offset <= bytes.size() && s.bytes <= bytes.size() - s.offset &&
           hash_of(bytes.subspan(std::size_t(s.offset), std::size_t(s.bytes))) == s.hash;
  };
  std::vector<std::byte> nodes;
  for (std::uint32_t k = 0; k < levels; ++k) {
    const Section& level = header.level[k];
    if (!is_whole(level)) return bad("nodes of level " + std::to_string(k) + " are missing or damaged");
    const auto of_level = bytes.subspan(std::size_t(level.offset), std::size_t(level.bytes));
    nodes.insert(nodes.end(), of_level.begin(), of_level.end());
  }
  std::vector<HullRecord> hulls;
  std::vector<std::byte> models;
  if (is_whole(header.hulls) && is_whole(header.hull_models)) {
    std::uint64_t offset = 0;
    for (std::uint32_t i = 0; i < header.hull_count; ++i) {
      HullRecord r;
      std::memcpy(&r, bytes.data() + header.hulls.offset + i * sizeof r, sizeof r);
      if (r.node >= nodes.size() / sizeof(Node)) break;
      const std::size_t next = hulls.empty() ? 0 : std::size_t{hulls.back().node} + 1;
      if (const std::string f = fault(header, r, next, offset); !f.empty()) return bad("it has " + f);
      offset = aligned(offset + r.bytes);
      const auto model = bytes.subspan(std::size_t(header.hull_models.offset + r.offset), std::size_t(r.bytes));
      hulls.push_back({r.node, r.first_triangle, models.size(), r.bytes});
      models.insert(models.end(), model.begin(), model.end());
      models.resize(std::size_t(aligned(models.size())));
    }
  }
  header.levels = levels;
  for (std::uint32_t k = levels; k < kMostDepth; ++k) header.level[k] = {};
  header.hull_count = std::uint32_t(hulls.size()), header.hull_units = std::uint32_t(models.size() / 64);
  return read(assemble(header, nodes, {std::as_bytes(std::span(hulls)), models, {}, {}, {}, {}, {}}));
}

Result<MeshModel> MeshReader::read(Block block) {
  const auto bad = [](const std::string& what) { return Error{ErrorCode::BadFormat, what}; };
  const Result<MeshHeader> header = read_header(block.bytes);
  if (!header) return header.error();
  const MeshHeader& h = header.value();
  if (const std::string f = misplaced(h); !f.empty()) return bad(f);
  if (block.bytes.size() != h.total_bytes)
    return bad("it has " + std::to_string(block.bytes.size()) + " bytes where its header says " +
               std::to_string(h.total_bytes));
  std::uint64_t end = sizeof h;
  for (const auto& [section, name] : sections_of(h)) {
    const auto gap = block.bytes.subspan(std::size_t(end), std::size_t(section.offset - end));
    if (std::any_of(gap.begin(), gap.end(), [](std::byte b) { return b != std::byte{0}; })) return bad("damaged padding");
    end = section.offset + section.bytes;
    if (hash_of(block.bytes.subspan(std::size_t(section.offset), std::size_t(section.bytes))) != section.hash)
      return bad("damaged " + name);
  }

  auto content = std::make_shared<MeshModel::Content>();
  MeshModel::Content& c = *content;
  c.header = h;
  c.topology = {h.components, h.open_edges, h.non_manifold_edges, h.flipped_edges, h.flat_triangles, h.duplicates, h.volume};
  std::uint64_t of_nodes = 0;
  for (std::uint32_t k = 0; k < h.levels; ++k) of_nodes += h.level[k].bytes;
  c.nodes = section_of<Node>(block, {h.level[0].offset, of_nodes, 0});
  c.shells = section_of<std::uint32_t>(block, h.shells);
  c.triangles = section_of<Corners>(block, h.triangles);
  c.vertices = section_of<Vec>(block, h.vertices);
  c.source_triangle = section_of<std::uint32_t>(block, h.source_triangle);
  c.source_vertex = section_of<std::uint32_t>(block, h.source_vertex);
  c.block = std::move(block);
  if (const std::string f = fault(h, c.nodes); !f.empty()) return bad("it has " + f);
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max({extent, std::fabs(h.box_min[axis]), std::fabs(h.box_max[axis])});
  c.root = root_of(c.nodes[0], h.unit, extent);
  if (!c.vertices.empty()) fit_ball(c.vertices, c.root);
  if (const std::string f = read_hulls(h, c.block, c); !f.empty()) return bad("it has " + f);
  place_patches(c);
  for (const std::uint32_t t : c.shells) {
    if (t >= h.triangle_count) return bad("a shell has a triangle that does not exist");
  }
  for (const Corners& corners : c.triangles) {
    if (std::max({corners[0], corners[1], corners[2]}) >= h.vertex_count)
      return bad("triangle " + std::to_string(&corners - c.triangles.data()) + " has a vertex that does not exist");
  }
  std::vector<bool> is_named(c.source_triangle.size());
  for (const std::uint32_t source : c.source_triangle) {
    if (source >= is_named.size() || is_named[source]) return bad("the sources of its triangles are not each of them once");
    is_named[source] = true;
  }
  const double largest = most_coordinate(h);
  for (const Vec& v : c.vertices) {
    const auto legal = [&](double x) { return x == 0 || (std::fabs(x) >= kLeastExtent && std::fabs(x) <= largest); };
    if (!legal(v.x) || !legal(v.y) || !legal(v.z))
      return bad("vertex " + std::to_string(&v - c.vertices.data()) + " has a coordinate out of range");
  }
  return MeshModel(std::move(content));
}

MeshParts MeshReader::parts(const MeshModel& mesh) {
  const Content& c = content(mesh);
  const auto copied = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };
  MeshParts parts;
  parts.unit = c.header.unit, parts.depth = int(c.header.depth);
  parts.box_min = vec(mesh.box_min()), parts.box_max = vec(mesh.box_max());
  parts.topology = c.topology;
  parts.hulls = c.hulls;
  copied(c.nodes, parts.nodes), copied(c.shells, parts.shells), copied(c.triangles, parts.triangles);
  copied(c.vertices, parts.vertices), copied(c.source_triangle, parts.source_triangle);
  copied(c.source_vertex, parts.source_vertex);
  return parts;
}

}  // namespace swiftlet
