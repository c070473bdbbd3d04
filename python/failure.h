// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The library's errors as Python exceptions.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include <swiftlet/result.h>

#include "arguments.h"

namespace swiftlet::python {

/// Raises the class of swiftlet._errors that stands for the error's code, with its attributes `code` and `file`.
[[noreturn]] void raise(const Error& error);

/// The value, or the error raised.
template <class T>
T take(Result<T>&& result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}

/// Text that may hold a path's bytes, as os.fsdecode has them.
pybind11::str decoded(const std::string& text);

/// What a progress callback returned: whether it lets the work go on. None does.
inline bool goes_on(pybind11::handle returned) { return returned.is_none() || is_true(returned); }

/// "float32 array of shape (10, 4, 4)", "list" and the like: what came, for the message of an error.
std::string what_came(pybind11::handle object);

/// What __reduce__ returns: a static method of a class of ours, or for an empty name the class, and its arguments.
pybind11::tuple made_again(const char* type, const char* method, pybind11::tuple arguments);

/// Pickling objects of the type is TypeError. By protocols 0 and 1 Python would make an object of a base class without a value,
/// at which pybind11 aborts.
void refuse_pickles(pybind11::handle type);

}  // namespace swiftlet::python
