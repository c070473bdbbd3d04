// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Numpy's arrays from the library's memory, and the other way round. Knows nothing of bodies or queries.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <swiftlet/pose.h>

namespace swiftlet::python {

/// A read-only view of memory that `owner` keeps alive.
template <class T>
pybind11::array view(const T* data, std::vector<pybind11::ssize_t> shape, std::vector<pybind11::ssize_t> strides,
                     pybind11::handle owner) {
  static const T kNothing{};
  pybind11::array result(pybind11::dtype::of<T>(), std::move(shape), std::move(strides), data ? data : &kNothing, owner);
  pybind11::detail::array_proxy(result.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return result;
}
template <class T>
pybind11::array view(std::span<const T> values, pybind11::handle owner) {
  return view(values.data(), {pybind11::ssize_t(values.size())}, {sizeof(T)}, owner);
}

/// A copy, read-only.
pybind11::array frozen(pybind11::array array);
pybind11::array to_array(const Vec3& v);
pybind11::array to_array(std::span<const std::uint32_t> values);

/// Points of shape (n, 3), floats or integers of any width, rounded to float64; else an error that names `name`.
std::vector<Vec3> to_points(pybind11::handle points, const char* name);
Vec3 to_vec3(pybind11::handle point, const char* name);
/// Indices of shape (n,), each from 0 to 2^32 - 1.
std::vector<std::uint32_t> to_indices(pybind11::handle indices, const char* name);
/// Triangles of shape (n, 3).
std::vector<std::array<std::uint32_t, 3>> to_triangles(pybind11::handle triangles, const char* name);
/// Triangles, or loops of any length, as the indices one after the other and, unless all are triangles, how many each has.
std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> to_faces(pybind11::handle faces, const char* name);
/// The bytes of any object that has a contiguous buffer; `buffer` must live as long as they are read.
std::span<const std::byte> to_bytes(const pybind11::buffer_info& buffer);
/// str, bytes or os.PathLike; no byte of it is 0.
std::string to_path(pybind11::handle path);

}  // namespace swiftlet::python
