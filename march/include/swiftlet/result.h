// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a function returns where data enters the library: a value, or one sentence that says what is wrong with the data.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace swiftlet {

enum class ErrorCode {
  CannotRead,    ///< the file is missing, unreadable, or ends early
  CannotWrite,   ///< the file cannot be created or the disk is full; nothing half-written is left
  BadFormat,     ///< not the format it claims to be, or damaged
  BadVersion,    ///< a format version this library does not read
  BadValue,      ///< an option or a number out of its range; a non-finite coordinate
  Empty,         ///< no points
  NotConvex,     ///< a reflex edge, or faces that do not close to one convex surface
  NotSolid,      ///< flat, collinear or a single point where a solid was required
  NotEnclosing,  ///< a coarser level that does not hold level 0
  TooLarge,      ///< more features than 30-bit handles name
  Cancelled,     ///< the progress callback asked to stop
};

struct Error {
  ErrorCode code;
  std::string message;  ///< one sentence; names the file, line, vertex or edge
};

/// A value or an Error. Reading the one that is not there is misuse and asserts.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& value() & {
    assert(*this);
    return std::get<0>(state_);
  }
  const T& value() const& {
    assert(*this);
    return std::get<0>(state_);
  }
  T&& value() && {
    assert(*this);
    return std::get<0>(std::move(state_));
  }
  const Error& error() const {
    assert(!*this);
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace swiftlet
