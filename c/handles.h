// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is behind the handles, and plain views of the caller's arrays.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

#include <swiftlet/executor.h>
#include <swiftlet/mesh.h>
#include <swiftlet/model.h>

#include "failure.h"

struct swiftlet_model {
  swiftlet::Model model;
  mutable std::atomic<std::uint64_t> references{1};
};

struct swiftlet_mesh {
  swiftlet::MeshModel mesh;
  mutable std::atomic<std::uint64_t> references{1};
};

struct swiftlet_executor {
  swiftlet::Executor execute;
};

namespace swiftlet::c {

template <class Handle>
const Handle* retain(const Handle* handle) {
  if (handle) handle->references.fetch_add(1, std::memory_order_relaxed);
  return handle;
}

template <class Handle>
void release(const Handle* handle) {
  if (handle && handle->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete handle;
}

inline const Model& model_of(const swiftlet_model* handle, const char* name = "model") {
  need(handle, name);
  return handle->model;
}

inline const MeshModel& mesh_of(const swiftlet_mesh* handle, const char* name = "mesh") {
  need(handle, name);
  return handle->mesh;
}

/// The caller's UTF-8.
inline std::filesystem::path path_of(const char* path) {
  need(path, "path");
  return std::filesystem::path(reinterpret_cast<const char8_t*>(path));
}

inline Detail detail_of(const swiftlet_detail* detail) { return detail ? Detail{detail->deviation, detail->bytes} : Detail{}; }

static_assert(sizeof(Vec3) == 3 * sizeof(double) && alignof(Vec3) == alignof(double));

/// Three numbers each.
inline std::span<const Vec3> points_of(const double* numbers, std::size_t count, const char* name) {
  if (count == 0) return {};
  need(numbers, name);
  return {reinterpret_cast<const Vec3*>(numbers), count};
}

inline std::span<const std::byte> bytes_of(const void* bytes, std::size_t count) {
  if (count) need(bytes, "bytes");
  return {static_cast<const std::byte*>(bytes), count};
}

inline void copy(const Vec3& from, double* to) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

inline Vec3 vector_of(const double* numbers, const char* name) {
  need(numbers, name);
  return {numbers[0], numbers[1], numbers[2]};
}

/// What a file cut short lacks.
inline void copy_note(const std::string& text, char* note, std::size_t size) {
  if (note && size) copy_text(text, note, size);
}

}  // namespace swiftlet::c
