// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes as handles: files, arrays, and what they hold.
#include <cstddef>

#include "handles.h"
#include "sized.h"

using namespace swiftlet;
using namespace swiftlet::c;

namespace {

void hand_out(MeshModel mesh, swiftlet_mesh** to) { *to = new swiftlet_mesh{std::move(mesh)}; }

/// Requires [first, first + count) to be of `size`.
void need_range(std::size_t first, std::size_t count, std::size_t size) {
  need(first <= size && count <= size - first, "the mesh has no such range");
}

}  // namespace

swiftlet_code swiftlet_mesh_from_triangles(const double* points, size_t point_count, const uint32_t* triangles,
                                           size_t triangle_count, swiftlet_progress progress, void* progress_data,
                                           swiftlet_mesh** mesh, swiftlet_error* error) {
  return guard(error, [&] {
    need(mesh, "mesh");
    if (triangle_count) need(triangles, "triangles");
    static_assert(sizeof(std::array<std::uint32_t, 3>) == 3 * sizeof(std::uint32_t));
    MeshOptions options;
    if (progress) options.progress = [=](double fraction) { return progress(fraction, progress_data) != 0; };
    const auto* corners = reinterpret_cast<const std::array<std::uint32_t, 3>*>(triangles);
    hand_out(must(MeshModel::from_triangles(points_of(points, point_count, "points"), {corners, triangle_count}, options)),
             mesh);
  });
}

swiftlet_code swiftlet_mesh_refit(const swiftlet_mesh* mesh, const double* points, size_t point_count, swiftlet_mesh** refitted,
                                  swiftlet_error* error) {
  return guard(error, [&] {
    need(refitted, "refitted");
    hand_out(must(refit(mesh_of(mesh), points_of(points, point_count, "points"))), refitted);
  });
}

swiftlet_code swiftlet_mesh_load(const char* path, const swiftlet_detail* detail, swiftlet_mesh** mesh, swiftlet_error* error) {
  return guard(error, [&] {
    need(mesh, "mesh");
    hand_out(must(load_mesh(path_of(path), detail_of(detail))), mesh);
  });
}

swiftlet_code swiftlet_mesh_map(const char* path, swiftlet_mesh** mesh, swiftlet_error* error) {
  return guard(error, [&] {
    need(mesh, "mesh");
    hand_out(must(map_mesh(path_of(path))), mesh);
  });
}

swiftlet_code swiftlet_mesh_salvage(const char* path, char* note, size_t note_size, swiftlet_mesh** mesh,
                                    swiftlet_error* error) {
  return guard(error, [&] {
    need(mesh, "mesh");
    SalvagedMesh salvaged = must(salvage_mesh(path_of(path)));
    hand_out(std::move(salvaged.mesh), mesh);
    copy_note(salvaged.note, note, note_size);
  });
}

swiftlet_code swiftlet_mesh_from_bytes(const void* bytes, size_t byte_count, swiftlet_mesh** mesh, swiftlet_error* error) {
  return guard(error, [&] {
    need(mesh, "mesh");
    hand_out(must(load_mesh(bytes_of(bytes, byte_count))), mesh);
  });
}

swiftlet_code swiftlet_mesh_save(const swiftlet_mesh* mesh, const char* path, uint64_t* written, swiftlet_error* error) {
  return guard(error, [&] {
    const std::size_t size = must(save(mesh_of(mesh), path_of(path)));
    if (written) *written = size;
  });
}

swiftlet_code swiftlet_mesh_cut(const swiftlet_mesh* mesh, const swiftlet_detail* detail, swiftlet_mesh** cut,
                                swiftlet_error* error) {
  return guard(error, [&] {
    need(cut, "cut");
    hand_out(mesh_of(mesh).cut(detail_of(detail)), cut);
  });
}

swiftlet_code swiftlet_is_mesh_file(const char* path, int32_t* is_mesh, swiftlet_error* error) {
  return guard(error, [&] {
    need(is_mesh, "is_mesh");
    *is_mesh = is_mesh_file(path_of(path));
  });
}

const swiftlet_mesh* swiftlet_mesh_retain(const swiftlet_mesh* mesh) { return retain(mesh); }
void swiftlet_mesh_release(const swiftlet_mesh* mesh) { release(mesh); }

swiftlet_code swiftlet_mesh_get_info(const swiftlet_mesh* mesh, swiftlet_mesh_info* info, swiftlet_error* error) {
  return guard(error, [&] {
    const MeshModel& m = mesh_of(mesh);
    need(info, "info");
    check_output(info, "info", offsetof(swiftlet_mesh_info, volume));
    const MeshTopology& topology = m.topology();
    swiftlet_mesh_info to{};
    to.is_closed = topology.closed();
    to.vertex_count = m.vertex_count(), to.triangle_count = m.triangle_count();
    to.volume = topology.volume;
    copy(m.box_min(), to.box_min);
    copy(m.box_max(), to.box_max);
    to.extent = m.extent(), to.deviation = m.deviation();
    to.node_count = m.node_count(), to.hull_count = m.hull_count();
    to.is_whole = m.is_whole(), to.level_count = m.level_count(), to.depth = m.depth();
    to.components = topology.components, to.open_edges = topology.open_edges;
    to.non_manifold_edges = topology.non_manifold_edges, to.flipped_edges = topology.flipped_edges;
    to.flat_triangles = topology.flat_triangles, to.duplicates = topology.duplicates;
    to.source_vertex = m.source_vertex().data(), to.source_triangle = m.source_triangle().data();
    write(to, info);
  });
}

swiftlet_code swiftlet_mesh_deviation(const swiftlet_mesh* mesh, int32_t levels, double* deviation, swiftlet_error* error) {
  return guard(error, [&] {
    need(deviation, "deviation");
    need(levels >= 1 && levels < mesh_of(mesh).depth(), "levels are from 1 to depth - 1");
    *deviation = mesh_of(mesh).deviation(levels);
  });
}

swiftlet_code swiftlet_mesh_vertices(const swiftlet_mesh* mesh, size_t first, size_t count, double* vertices,
                                     swiftlet_error* error) {
  return guard(error, [&] {
    need_range(first, count, mesh_of(mesh).vertex_count());
    if (count) need(vertices, "vertices");
    for (std::size_t i = 0; i < count; ++i) copy(mesh->mesh.vertex(first + i), vertices + 3 * i);
  });
}

swiftlet_code swiftlet_mesh_triangles(const swiftlet_mesh* mesh, size_t first, size_t count, uint32_t* triangles,
                                      swiftlet_error* error) {
  return guard(error, [&] {
    need_range(first, count, mesh_of(mesh).triangle_count());
    if (count) need(triangles, "triangles");
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<std::uint32_t, 3> corners = mesh->mesh.triangle(first + i);
      std::copy(corners.begin(), corners.end(), triangles + 3 * i);
    }
  });
}

swiftlet_code swiftlet_mesh_get_bytes(const swiftlet_mesh* mesh, const void** bytes, size_t* byte_count,
                                      swiftlet_error* error) {
  return guard(error, [&] {
    const std::span<const std::byte> from = mesh_of(mesh).bytes();
    need(bytes, "bytes");
    need(byte_count, "byte_count");
    *bytes = from.data();
    *byte_count = from.size();
  });
}

swiftlet_code swiftlet_mesh_get_hash(const swiftlet_mesh* mesh, uint64_t* hash, swiftlet_error* error) {
  return guard(error, [&] {
    need(hash, "hash");
    *hash = mesh_of(mesh).hash();
  });
}
