// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models as handles: files, arrays, and what they hold as plain pointers; executors.
#include <swiftlet/check.h>
#include <swiftlet/march.h>
#include <swiftlet/model_file.h>

#include <cstddef>
#include <exception>
#include <mutex>
#include <type_traits>
#include <vector>

#include "handles.h"
#include "sized.h"

using namespace swiftlet;
using namespace swiftlet::c;

static_assert(sizeof(swiftlet_vertex) == sizeof(Vertex) &&
              offsetof(swiftlet_vertex, ring_begin) == offsetof(Vertex, ring_begin));
static_assert(offsetof(swiftlet_vertex, z) == offsetof(Vertex, z) &&
              offsetof(swiftlet_vertex, ring_count) == offsetof(Vertex, ring_count));
static_assert(sizeof(swiftlet_half_edge) == sizeof(HalfEdge) &&
              offsetof(swiftlet_half_edge, twin) == offsetof(HalfEdge, twin) &&
              offsetof(swiftlet_half_edge, face) == offsetof(HalfEdge, face));
static_assert(sizeof(swiftlet_face_plane) == sizeof(FacePlane) &&
              offsetof(swiftlet_face_plane, thickness) == offsetof(FacePlane, thickness) &&
              offsetof(swiftlet_face_plane, over) == offsetof(FacePlane, over));
static_assert(sizeof(swiftlet_feature) == sizeof(FeatureId) && std::is_trivially_copyable_v<FeatureId>);
static_assert(int(lut::Resolution::None) == SWIFTLET_TABLE_NONE &&
              int(lut::Resolution::Degrees22) == SWIFTLET_TABLE_DEGREES_22);
static_assert(int(lut::Resolution::Degrees11) == SWIFTLET_TABLE_DEGREES_11 &&
              int(lut::Resolution::Degrees5) == SWIFTLET_TABLE_DEGREES_5);

namespace {

TableSpec table_of(const swiftlet_table_spec& spec) {
  return {enumerator(spec.resolution, lut::Resolution::Degrees5, "table.resolution"), spec.radius_factor, spec.map_cells};
}

swiftlet_table_spec plain(const TableSpec& spec) { return {std::int32_t(spec.resolution), spec.map_cells, spec.radius_factor}; }

swiftlet_model_options default_options() { return {sizeof(swiftlet_model_options), 0, plain(TableSpec{}), nullptr}; }

/// An optional array whose length follows from another's.
std::span<const std::uint32_t> optional(const std::uint32_t* from, std::size_t count) {
  return from ? std::span(from, count) : std::span<const std::uint32_t>();
}

LevelArrays arrays_of(const swiftlet_level_arrays& from) {
  LevelArrays to;
  to.vertices = points_of(from.vertices, from.vertex_count, "levels.vertices");
  if (from.face_vertex_count) need(from.face_vertices, "levels.face_vertices");
  to.face_vertices = optional(from.face_vertices, from.face_vertex_count);
  to.face_sizes = optional(from.face_sizes, from.face_count);
  const std::size_t faces = from.face_sizes ? from.face_count : from.face_vertex_count / 3;
  to.vertex_source = optional(from.vertex_source, from.vertex_count);
  if (from.face_source_begin) {
    to.face_source_begin = std::span(from.face_source_begin, faces + 1);
    const std::uint32_t count = to.face_source_begin.back();
    if (count) need(from.face_source, "levels.face_source");
    to.face_source = optional(from.face_source, count);
  }
  to.child_vertex = optional(from.child_vertex, from.vertex_count);
  to.child_of_face = optional(from.child_of_face, faces);
  return to;
}

void hand_out(Model model, swiftlet_model** to) { *to = new swiftlet_model{std::move(model)}; }

const Level& level_of(const Model& model, std::int32_t index) {
  need(index >= 0 && index < model.level_count(), "the model has no such level");
  return model.level(index);
}

/// The same array, as C names what is in it.
template <class To, class From>
const To* plain(std::span<const From> from) {
  static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
  return from.empty() ? nullptr : reinterpret_cast<const To*>(from.data());
}

const std::uint32_t* plain(std::span<const std::uint32_t> from) { return from.empty() ? nullptr : from.data(); }

swiftlet_level plain(const Level& level) {
  const ConvexView& view = level.view;
  swiftlet_level to{};
  to.map_side = level.map_side;
  to.deviation = level.deviation, to.volume = level.volume;
  to.vertices = plain<swiftlet_vertex>(view.vertices), to.vertex_count = view.vertices.size();
  to.half_edges = plain<swiftlet_half_edge>(view.half_edges), to.half_edge_count = view.half_edges.size();
  to.face_first = plain(view.face_first), to.face_count = view.face_first.size();
  to.planes = plain<swiftlet_face_plane>(view.planes), to.plane_count = view.planes.size();
  to.child_vertex = plain(level.child_vertex), to.child_face = plain<swiftlet_feature>(level.child_face);
  to.parent_face = plain(level.parent_face);
  to.support_map = plain(level.support_map), to.support_map_count = level.support_map.size();
  std::copy(level.map_frame.begin(), level.map_frame.end(), to.map_frame);
  to.extent = view.extent, to.inner_radius = view.inner_radius, to.reach = view.reach;
  copy(view.centre, to.centre);
  to.edge_length = level.edge_length;
  to.bytes = level.bytes, to.prefix = level.prefix;
  to.edge_count = level.edge_count, to.triangle_count = level.triangle_count;
  return to;
}

}  // namespace

// ---- Executors -------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_executor_on_threads(uint32_t thread_count, swiftlet_executor** executor, swiftlet_error* error) {
  return guard(error, [&] {
    need(executor, "executor");
    *executor = new swiftlet_executor{on_threads(thread_count)};
  });
}

namespace {

/// Tasks on their way through C, which no exception may cross.
struct Crossing {
  const std::function<void(std::size_t)>& task;
  std::mutex mutex;
  std::exception_ptr failure;

  static void run(void* context, std::size_t index) {
    auto& crossing = *static_cast<Crossing*>(context);
    try {
      crossing.task(index);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(crossing.mutex);
      crossing.failure = std::current_exception();
    }
  }
};

}  // namespace

swiftlet_code swiftlet_executor_create(swiftlet_execute execute, void* data, swiftlet_executor** executor,
                                       swiftlet_error* error) {
  return guard(error, [&] {
    need(reinterpret_cast<const void*>(execute), "execute");
    need(executor, "executor");
    *executor = new swiftlet_executor{[=](std::size_t count, const std::function<void(std::size_t)>& task) {
      Crossing crossing{task, {}, {}};
      execute(count, Crossing::run, &crossing, data);
      if (crossing.failure) std::rethrow_exception(crossing.failure);
    }};
  });
}

void swiftlet_executor_release(swiftlet_executor* executor) { delete executor; }

// ---- Models ----------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_model_options_init(swiftlet_model_options* options, size_t size, swiftlet_error* error) {
  return init(default_options(), options, size, error);
}

swiftlet_code swiftlet_model_load(const char* path, const swiftlet_detail* detail, swiftlet_model** model,
                                  swiftlet_error* error) {
  return guard(error, [&] {
    need(model, "model");
    hand_out(must(load(path_of(path), detail_of(detail))), model);
  });
}

swiftlet_code swiftlet_model_map(const char* path, const swiftlet_detail* detail, swiftlet_model** model,
                                 swiftlet_error* error) {
  return guard(error, [&] {
    need(model, "model");
    hand_out(must(map(path_of(path), detail_of(detail))), model);
  });
}

swiftlet_code swiftlet_model_salvage(const char* path, char* note, size_t note_size, swiftlet_model** model,
                                     swiftlet_error* error) {
  return guard(error, [&] {
    need(model, "model");
    Salvaged salvaged = must(salvage(path_of(path)));
    hand_out(std::move(salvaged.model), model);
    copy_note(salvaged.note, note, note_size);
  });
}

swiftlet_code swiftlet_model_from_bytes(const void* bytes, size_t byte_count, const swiftlet_detail* detail,
                                        swiftlet_model** model, swiftlet_error* error) {
  return guard(error, [&] {
    need(model, "model");
    hand_out(must(load(bytes_of(bytes, byte_count), detail_of(detail))), model);
  });
}

swiftlet_code swiftlet_model_from_levels(const swiftlet_level_arrays* levels, size_t level_count,
                                         const swiftlet_model_options* options, swiftlet_model** model, swiftlet_error* error) {
  return guard(error, [&] {
    need(model, "model");
    need(levels, "levels");
    std::vector<LevelArrays> arrays;
    const std::size_t stride = level_count > 0 ? levels->size : 0;
    for (std::size_t i = 0; i < level_count; ++i) {
      swiftlet_level_arrays level{};
      read_bytes(reinterpret_cast<const char*>(levels) + i * stride, stride, offsetof(swiftlet_level_arrays, face_count), level,
                 "levels");
      arrays.push_back(arrays_of(level));
    }
    ModelOptions made;
    if (options) {
      swiftlet_model_options room = default_options();
      const swiftlet_model_options& asked = read(options, room, "options");
      made.repair = asked.repair != 0;
      made.table = table_of(asked.table);
      if (asked.executor) made.executor = asked.executor->execute;
    }
    hand_out(must(Model::from_levels(arrays, made)), model);
  });
}

swiftlet_code swiftlet_model_save(const swiftlet_model* model, const char* path, uint64_t* written, swiftlet_error* error) {
  return guard(error, [&] {
    const std::size_t size = must(save(model_of(model), path_of(path)));
    if (written) *written = size;
  });
}

swiftlet_code swiftlet_model_cut(const swiftlet_model* model, const swiftlet_detail* detail, swiftlet_model** cut,
                                 swiftlet_error* error) {
  return guard(error, [&] {
    need(cut, "cut");
    hand_out(model_of(model).cut(detail_of(detail)), cut);
  });
}

swiftlet_code swiftlet_model_ensure(const swiftlet_model* model, int32_t level, swiftlet_model** ensured,
                                    swiftlet_error* error) {
  return guard(error, [&] {
    need(ensured, "ensured");
    Model copied = model_of(model);
    must(copied.ensure(level));
    hand_out(std::move(copied), ensured);
  });
}

swiftlet_code swiftlet_model_with_table(const swiftlet_model* model, const swiftlet_table_spec* spec,
                                        swiftlet_model** with_table, swiftlet_error* error) {
  return guard(error, [&] {
    need(spec, "spec");
    need(with_table, "with_table");
    hand_out(must(model_of(model).with_table(table_of(*spec))), with_table);
  });
}

const swiftlet_model* swiftlet_model_retain(const swiftlet_model* model) { return retain(model); }
void swiftlet_model_release(const swiftlet_model* model) { release(model); }

swiftlet_code swiftlet_model_get_info(const swiftlet_model* model, swiftlet_model_info* info, swiftlet_error* error) {
  return guard(error, [&] {
    const Model& m = model_of(model);
    need(info, "info");
    check_output(info, "info", offsetof(swiftlet_model_info, centre));
    swiftlet_model_info to{};
    to.level_count = m.level_count(), to.finest_level = m.finest_level(), to.dimension = m.dimension();
    copy(m.centre(), to.centre);
    to.radius = m.radius(), to.extent = m.extent();
    copy(m.box_min(), to.box_min);
    copy(m.box_max(), to.box_max);
    to.volume = m.volume();
    to.table = plain(m.table_spec());
    to.map_level = m.map_level();
    write(to, info);
  });
}

swiftlet_code swiftlet_model_get_level(const swiftlet_model* model, int32_t index, swiftlet_level* level,
                                       swiftlet_error* error) {
  return guard(error, [&] {
    const Level& from = level_of(model_of(model), index);
    need(level, "level");
    check_output(level, "level", offsetof(swiftlet_level, vertices));
    write(plain(from), level);
  });
}

swiftlet_code swiftlet_model_face(const swiftlet_model* model, int32_t level, uint32_t face, uint32_t* vertices,
                                  size_t capacity, size_t* count, swiftlet_error* error) {
  return guard(error, [&] {
    const ConvexView& view = level_of(model_of(model), level).view;
    need(face < view.face_first.size(), "the level has no such face");
    if (capacity) need(vertices, "vertices");
    need(count, "count");
    std::size_t found = 0;
    for (const std::uint32_t vertex : FaceLoop(view, face)) {
      if (found < capacity) vertices[found] = vertex;
      ++found;
    }
    *count = found;
  });
}

swiftlet_code swiftlet_model_get_source(const swiftlet_model* model, swiftlet_source_map* source, swiftlet_error* error) {
  return guard(error, [&] {
    const SourceMap from = model_of(model).source();
    need(source, "source");
    check_output(source, "source");
    swiftlet_source_map to{};
    to.vertex = plain(from.vertex), to.vertex_count = from.vertex.size();
    to.face_begin = plain(from.face_begin), to.face_begin_count = from.face_begin.size();
    to.face = plain(from.face), to.face_source_count = from.face.size();
    write(to, source);
  });
}

swiftlet_code swiftlet_model_support(const swiftlet_model* model, const double* direction, uint32_t* vertex,
                                     swiftlet_error* error) {
  return guard(error, [&] {
    need(vertex, "vertex");
    *vertex = model_of(model).support(vector_of(direction, "direction"));
  });
}

swiftlet_code swiftlet_model_get_table(const swiftlet_model* model, const uint32_t** table, size_t* count,
                                       swiftlet_error* error) {
  return guard(error, [&] {
    const std::span<const std::uint32_t> from = model_of(model).table();
    need(table, "table");
    need(count, "count");
    *table = plain(from);
    *count = from.size();
  });
}

swiftlet_code swiftlet_model_table_start(const swiftlet_model* model, const double* direction, swiftlet_feature* vertex,
                                         swiftlet_error* error) {
  return guard(error, [&] {
    need(vertex, "vertex");
    const FeatureId found = table_start(model_of(model), vector_of(direction, "direction"));
    *vertex = std::uint32_t(found.kind()) << 30 | found.index();
  });
}

swiftlet_code swiftlet_model_get_bytes(const swiftlet_model* model, const void** bytes, size_t* byte_count,
                                       swiftlet_error* error) {
  return guard(error, [&] {
    const std::span<const std::byte> from = model_of(model).bytes();
    need(bytes, "bytes");
    need(byte_count, "byte_count");
    *bytes = from.data();
    *byte_count = from.size();
  });
}

swiftlet_code swiftlet_model_get_hash(const swiftlet_model* model, uint64_t* hash, swiftlet_error* error) {
  return guard(error, [&] {
    need(hash, "hash");
    *hash = model_of(model).hash();
  });
}
