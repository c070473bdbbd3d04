// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How a call fails: thrown where something is wrong, caught where C begins.
#pragma once

#include <string>
#include <utility>

#include <swiftlet/result.h>
#include <swiftlet/swiftlet.h>

namespace swiftlet::c {

struct Failure {
  swiftlet_code code;
  std::string message;
};

/// Writes what is being caught, and returns its code.
swiftlet_code tell(swiftlet_error* error) noexcept;

/// As much of a sentence as `size` bytes hold, cut between characters, and a 0.
void copy_text(const std::string& text, char* to, std::size_t size);

/// Runs what a C function does. Nothing that it throws leaves it.
template <class Work>
swiftlet_code guard(swiftlet_error* error, Work&& work) noexcept {
  try {
    work();
    return SWIFTLET_OK;
  } catch (...) {
    return tell(error);
  }
}

inline void need(const void* pointer, const char* name) {
  if (!pointer) throw Failure{SWIFTLET_NULL_POINTER, std::string(name) + " is null"};
}

inline void need(bool holds, const char* what) {
  if (!holds) throw Failure{SWIFTLET_BAD_VALUE, what};
}

/// The value of a result.
template <class T>
T must(Result<T> result) {
  if (!result) throw Failure{swiftlet_code(result.error().code) + 1, result.error().message};
  return std::move(result).value();
}

}  // namespace swiftlet::c
