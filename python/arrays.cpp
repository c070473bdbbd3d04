// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <cstring>

#include "failure.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

/// A contiguous array of float64 or int64, converted as numpy's assignment does: to float64 rounded, to int64 modulo 2^64.
template <class T>
py::array_t<T> converted(py::handle object, const char* name, const char* wanted, bool (*fits)(char kind)) {
  const py::module_ numpy = py::module_::import("numpy");
  const py::array array = numpy.attr("asarray")(object);
  if (!fits(array.dtype().kind()) && array.size() > 0)
    throw py::type_error(std::string(name) + ": expected " + wanted + ", got " + what_came(array));
  return numpy.attr("ascontiguousarray")(array, py::dtype::of<T>());
}
bool is_number(char kind) { return kind == 'f' || kind == 'i' || kind == 'u'; }
bool is_integer(char kind) { return kind == 'i' || kind == 'u'; }

[[noreturn]] void refuse(const char* name, const char* wanted, py::handle came) {
  throw py::value_error(std::string(name) + ": expected " + wanted + ", got " + what_came(came));
}

/// Integers of any width, modulo 2^64, and whether they came without a sign.
struct Integers {
  py::array_t<std::int64_t> array;
  bool is_unsigned;
};

Integers integers(py::handle object, const char* name, const char* wanted) {
  const py::array array = py::module_::import("numpy").attr("asarray")(object);
  return {converted<std::int64_t>(array, name, wanted, is_integer), array.dtype().kind() == 'u'};
}

std::vector<std::uint32_t> indices_of(const Integers& integers, const char* name) {
  std::vector<std::uint32_t> result(std::size_t(integers.array.size()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::int64_t value = integers.array.data()[i];
    if (value < 0 || value > 0xffffffffll)
      throw py::value_error(std::string(name) + ": entry " + std::to_string(i) + " is " +
                            (integers.is_unsigned ? std::to_string(std::uint64_t(value)) : std::to_string(value)) +
                            ", which is no index");
    result[i] = std::uint32_t(value);
  }
  return result;
}

}  // namespace

py::array frozen(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array to_array(const Vec3& v) { return py::array_t<double>(3, v.data()); }
py::array to_array(std::span<const std::uint32_t> values) {
  return py::array_t<std::uint32_t>(py::ssize_t(values.size()), values.data());
}

std::vector<Vec3> to_points(py::handle points, const char* name) {
  constexpr const char* kWanted = "numbers of shape (n, 3)";
  const auto array = converted<double>(points, name, kWanted, is_number);
  if (array.ndim() != 2 || array.shape(1) != 3) refuse(name, kWanted, array);
  std::vector<Vec3> result(std::size_t(array.shape(0)));
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  if (!result.empty()) std::memcpy(static_cast<void*>(result.data()), array.data(), result.size() * sizeof(Vec3));
  return result;
}

Vec3 to_vec3(py::handle point, const char* name) {
  constexpr const char* kWanted = "three numbers";
  const auto array = converted<double>(point, name, kWanted, is_number);
  if (array.ndim() != 1 || array.shape(0) != 3) refuse(name, kWanted, array);
  return {array.data()[0], array.data()[1], array.data()[2]};
}

std::vector<std::uint32_t> to_indices(py::handle indices, const char* name) {
  constexpr const char* kWanted = "integers of shape (n,)";
  const Integers whole = integers(indices, name, kWanted);
  if (whole.array.ndim() != 1) refuse(name, kWanted, whole.array);
  return indices_of(whole, name);
}

std::vector<std::array<std::uint32_t, 3>> to_triangles(py::handle triangles, const char* name) {
  constexpr const char* kWanted = "integers of shape (n, 3)";
  const Integers whole = integers(triangles, name, kWanted);
  if (whole.array.size() > 0 && (whole.array.ndim() != 2 || whole.array.shape(1) != 3)) refuse(name, kWanted, whole.array);
  const std::vector<std::uint32_t> flat = indices_of(whole, name);
  std::vector<std::array<std::uint32_t, 3>> result(flat.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return result;
}

std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> to_faces(py::handle faces, const char* name) {
  constexpr const char* kWanted = "integers of shape (n, 3), or a sequence of loops of three or more vertices";
  if (py::isinstance<py::array>(faces)) {
    const Integers whole = integers(faces, name, kWanted);
    const auto& array = whole.array;
    if (array.size() == 0) return {};
    if (array.ndim() != 2 || array.shape(1) < 3) refuse(name, kWanted, array);
    std::vector<std::uint32_t> sizes;
    if (array.shape(1) > 3) sizes.assign(std::size_t(array.shape(0)), std::uint32_t(array.shape(1)));
    return {indices_of(whole, name), std::move(sizes)};
  }
  if (!py::isinstance<py::sequence>(faces))
    throw py::type_error(std::string(name) + ": expected " + kWanted + ", got " + what_came(faces));
  std::vector<std::uint32_t> corners, sizes;
  for (const py::handle face : faces) {
    const std::vector<std::uint32_t> loop = to_indices(face, name);
    corners.insert(corners.end(), loop.begin(), loop.end());
    sizes.push_back(std::uint32_t(loop.size()));
  }
  return {std::move(corners), std::move(sizes)};
}

std::span<const std::byte> to_bytes(const py::buffer_info& buffer) {
  py::ssize_t stride = buffer.itemsize;
  for (std::size_t k = buffer.shape.size(); k-- > 0; stride *= buffer.shape[k])
    if (buffer.shape[k] > 1 && buffer.strides[k] != stride) throw py::value_error("data: expected contiguous bytes");
  return {static_cast<const std::byte*>(buffer.ptr), std::size_t(buffer.size * buffer.itemsize)};
}

std::string to_path(py::handle path) {
  PyObject* encoded = nullptr;
  if (!PyUnicode_FSConverter(path.ptr(), &encoded)) throw py::error_already_set();
  return std::string(py::reinterpret_steal<py::bytes>(encoded));
}

}  // namespace swiftlet::python
