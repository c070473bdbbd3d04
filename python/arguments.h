// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers and flags among a function's arguments. Where one is of another type pybind11 lists all types of all arguments; these
// are taken as they come, and what is wrong with one is said by its name. Knows nothing of bodies or queries.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace swiftlet::python {

inline int is_anything(PyObject*) { return 1; }

/// Any object; signatures call it an int, `to_whole` reads it.
class Whole : public pybind11::object {
  PYBIND11_OBJECT_DEFAULT(Whole, object, is_anything)
};
/// Any object; signatures call it a float, `to_double` reads it.
class Real : public pybind11::object {
  PYBIND11_OBJECT_DEFAULT(Real, object, is_anything)
};
/// The truth of any object.
struct Flag {
  bool value = false;
  operator bool() const { return value; }
};

/// What an `if` of Python would do; raises what the object's `__bool__` does.
bool is_true(pybind11::handle object);
/// A number as float64; what is none, or too large, is an error that names `name`.
double to_double(pybind11::handle number, const char* name);
/// A whole number; another type or one beyond these is an error that names `name`.
std::int64_t to_whole(pybind11::handle number, const char* name, std::int64_t least, std::int64_t most);
inline int to_int(pybind11::handle number, const char* name) {
  return int(to_whole(number, name, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}
/// From 0 to 2^32 - 1.
inline std::uint32_t to_count(pybind11::handle number, const char* name) {
  return std::uint32_t(to_whole(number, name, 0, 0xffffffff));
}
/// A budget's.
inline std::uint32_t to_steps(pybind11::handle steps) { return to_count(steps, "steps"); }
/// Of a Detail; none of None.
std::optional<std::uint64_t> to_bytes_kept(pybind11::handle bytes);
/// From 1 to 1 024.
unsigned to_threads(pybind11::handle threads);

}  // namespace swiftlet::python

namespace pybind11::detail {
template <>
struct handle_type_name<swiftlet::python::Whole> {
  static constexpr auto name = const_name("int");
};
template <>
struct handle_type_name<swiftlet::python::Real> {
  static constexpr auto name = const_name("float");
};
template <>
struct type_caster<swiftlet::python::Flag> {
  PYBIND11_TYPE_CASTER(swiftlet::python::Flag, const_name("bool"));
  bool load(handle source, bool) {
    value.value = swiftlet::python::is_true(source);
    return true;
  }
};
}  // namespace pybind11::detail
