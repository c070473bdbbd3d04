// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.h"

#include <string>

#include "failure.h"

namespace swiftlet::python {
namespace py = pybind11;

bool is_true(py::handle object) {
  const int truth = PyObject_IsTrue(object.ptr());
  if (truth < 0) throw py::error_already_set();
  return truth != 0;
}

double to_double(py::handle number, const char* name) {
  const double x = PyFloat_AsDouble(number.ptr());
  if (x != -1 || !PyErr_Occurred()) return x;
  const bool is_large = PyErr_ExceptionMatches(PyExc_OverflowError);
  if (!is_large && !PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
  PyErr_Clear();
  if (is_large) throw py::value_error(std::string(name) + ": expected a number, got one that float64 cannot hold");
  throw py::type_error(std::string(name) + ": expected a number, got " + what_came(number));
}

std::int64_t to_whole(py::handle number, const char* name, std::int64_t least, std::int64_t most) {
  const auto wanted = [&] {
    return std::string(name) + ": expected a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
           ", got ";
  };
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(number.ptr()));
  if (!whole) {
    if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
    PyErr_Clear();
    throw py::type_error(wanted() + what_came(number));
  }
  int beyond = 0;
  const std::int64_t value = PyLong_AsLongLongAndOverflow(whole.ptr(), &beyond);
  if (beyond != 0 || value < least || value > most) throw py::value_error(wanted() + std::string(py::str(whole)));
  return value;
}

std::optional<std::uint64_t> to_bytes_kept(py::handle bytes) {
  if (bytes.is_none()) return std::nullopt;
  return std::uint64_t(to_whole(bytes, "bytes", 0, std::numeric_limits<std::int64_t>::max()));
}

unsigned to_threads(py::handle threads) { return unsigned(to_whole(threads, "threads", 1, 1024)); }

}  // namespace swiftlet::python
