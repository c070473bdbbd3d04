// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "failure.h"

#include <pybind11/numpy.h>

#include <string>

namespace swiftlet::python {
namespace py = pybind11;

void raise(const Error& error) {
  const py::module_ errors = py::module_::import("swiftlet._errors");
  const char* name = error.code == ErrorCode::CannotRead || error.code == ErrorCode::CannotWrite ? "FileError"
                     : error.code == ErrorCode::Cancelled                                        ? "Cancelled"
                                                                                                 : "DataError";
  const py::object type = errors.attr(name);
  const py::object exception = type(decoded(error.message), int(error.code), decoded(error.file));
  PyErr_SetObject(type.ptr(), exception.ptr());
  throw py::error_already_set();
}

py::str decoded(const std::string& text) {
  PyObject* const decoded = PyUnicode_DecodeFSDefaultAndSize(text.data(), py::ssize_t(text.size()));
  if (!decoded) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

std::string what_came(py::handle object) {
  if (!py::isinstance<py::array>(object)) return Py_TYPE(object.ptr())->tp_name;
  return py::str("{} array of shape {}").format(object.attr("dtype"), object.attr("shape"));
}

py::tuple made_again(const char* type, const char* method, py::tuple arguments) {
  return py::make_tuple(py::module_::import("swiftlet._unpickle").attr("again"), py::make_tuple(type, method) + arguments);
}

void refuse_pickles(py::handle type) {
  type.attr("__reduce__") = py::cpp_function(
      [](py::handle self) -> py::object { throw py::type_error("cannot pickle '" + what_came(self) + "' object"); },
      py::name("__reduce__"), py::is_method(type));
}

}  // namespace swiftlet::python
