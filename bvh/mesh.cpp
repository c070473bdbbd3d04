// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What users see of a mesh, and its file. Knows the block through `MeshReader`.
#include <swiftlet/mesh.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "body/file.h"
#include "mesh_block.h"
#include "tree.h"
#include "weld.h"

namespace swiftlet {

Result<MeshModel> MeshModel::from_triangles(std::span<const Vec3> points,
                                            std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const MeshOptions& options) {
  // Shares of the time that the steps take.
  constexpr double kWelded = 0.3, kBuilt = 0.95;
  const auto go_on = [&](double fraction) { return !options.progress || options.progress(fraction); };
  const auto cancelled = [] { return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"}; };
  if (!go_on(0)) return cancelled();
  Result<Soup> soup = weld(points, triangles);
  if (!soup) return soup.error();
  if (!go_on(kWelded)) return cancelled();
  MeshParts parts;
  if (!grow_tree(soup.value(), {}, parts, [&](double f) { return go_on(kWelded + f * (kBuilt - kWelded)); }))
    return cancelled();
  if (!go_on(kBuilt)) return cancelled();
  Result<MeshModel> mesh = MeshReader::read(compose(parts));
  if (mesh) go_on(1);
  return mesh;
}

std::size_t MeshModel::vertex_count() const { return content_->vertices.size(); }
std::size_t MeshModel::triangle_count() const { return content_->triangles.size(); }
Vec3 MeshModel::vertex(std::size_t index) const { return eigen(content_->vertices[index]); }
std::array<std::uint32_t, 3> MeshModel::triangle(std::size_t index) const { return content_->triangles[index]; }
std::span<const std::uint32_t> MeshModel::source_vertex() const { return content_->source_vertex; }
std::span<const std::uint32_t> MeshModel::source_triangle() const { return content_->source_triangle; }
const MeshTopology& MeshModel::topology() const { return content_->topology; }
Vec3 MeshModel::box_min() const { return Vec3(content_->header.box_min); }
Vec3 MeshModel::box_max() const { return Vec3(content_->header.box_max); }
double MeshModel::extent() const { return content_->root.extent; }
std::size_t MeshModel::node_count() const { return content_->nodes.size(); }
std::size_t MeshModel::hull_count() const { return content_->hulls.size(); }
bool MeshModel::is_whole() const { return content_->is_whole(); }
int MeshModel::level_count() const { return int(content_->header.levels); }
int MeshModel::depth() const { return int(content_->header.depth); }
double MeshModel::deviation(int levels) const { return levels < depth() ? content_->header.deviation[levels - 1] : 0; }
std::span<const std::byte> MeshModel::bytes() const { return content_->block.bytes; }
std::uint64_t MeshModel::hash() const { return hash_of(bytes()); }

MeshModel MeshModel::cut(const Detail& detail) const {
  const std::uint32_t levels = MeshReader::levels(content_->header, detail);
  if (levels == content_->header.levels) return *this;
  return MeshReader::cut(bytes(), levels).value();  // of a block that was read before
}

Result<std::size_t> save(const MeshModel& mesh, const std::filesystem::path& path) { return replace_file(path, mesh.bytes()); }

Result<MeshModel> load_mesh(std::span<const std::byte> bytes) {
  AlignedBytes block(bytes.size());
  std::copy(bytes.begin(), bytes.end(), block.data());
  return MeshReader::read(std::move(block));
}

Result<MeshModel> load_mesh(const std::filesystem::path& path, const Detail& detail) {
  const Result<OwnedBytes> file = map_file(path);
  if (!file) return file.error();
  const std::span<const std::byte> bytes = file.value().bytes;
  const Result<MeshHeader> header = MeshReader::read_header(bytes);
  if (!header) return named(path, header.error());
  const std::uint32_t levels = MeshReader::levels(header.value(), detail);
  Result<MeshModel> mesh = levels < header.value().levels ? MeshReader::cut(bytes, levels) : load_mesh(bytes);
  if (!mesh) return named(path, mesh.error());
  return mesh;
}

Result<SalvagedMesh> salvage_mesh(const std::filesystem::path& path) {
  const Result<OwnedBytes> file = map_file(path);
  if (!file) return file.error();
  const std::span<const std::byte> bytes = file.value().bytes;
  const Result<MeshHeader> header = MeshReader::read_header(bytes);
  if (!header) return named(path, header.error());
  const MeshHeader& h = header.value();
  if (bytes.size() >= h.total_bytes) {
    Result<MeshModel> mesh = load_mesh(bytes);
    if (!mesh) return named(path, mesh.error());
    return SalvagedMesh{std::move(mesh).value(), ""};
  }
  const std::string length =
      "it has " + std::to_string(bytes.size()) + " bytes where its header says " + std::to_string(h.total_bytes) + ": ";
  const std::uint32_t levels = MeshReader::levels(h, {0, bytes.size()});
  if (levels == h.depth)
    return named(path, {ErrorCode::BadFormat, length + "of a mesh of one level none can be left out, and the last " +
                                                  std::to_string(h.total_bytes - bytes.size()) + " bytes are missing"});
  Result<MeshModel> mesh = MeshReader::cut(bytes, levels);
  if (!mesh) return named(path, mesh.error());
  return SalvagedMesh{std::move(mesh).value(), utf8(path) + ": " + length + std::to_string(levels) + " of " +
                                                   std::to_string(h.depth) + " levels of nodes are complete"};
}

Result<MeshModel> map_mesh(const std::filesystem::path& path) {
  Result<OwnedBytes> file = map_file(path);
  if (!file) return file.error();
  Result<MeshModel> mesh = MeshReader::read(std::move(file).value());
  if (!mesh) return named(path, mesh.error());
  return mesh;
}

bool is_mesh_file(const std::filesystem::path& path) {
  if (!irregularity(path).empty()) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<std::byte, 8> start{};
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  return file && is_mesh_block(start);
}

}  // namespace swiftlet
