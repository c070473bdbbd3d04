// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a function returns where data enters the library: a value, or one sentence that says what is wrong with the data.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace swiftlet {

/// What is wrong with data that enters.
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
  TooLarge,      ///< more features than 30-bit feature ids name
  Cancelled,     ///< the progress callback asked to stop
};

/// Why there is no value.
struct Error {
  ErrorCode code;       ///< for the program
  std::string message;  ///< for people: one sentence; names the file, line, vertex or edge
  std::string file{};   ///< the file at fault, as its path was given; empty: none is
};

/// A value or an Error. Reading the one that is not there is misuse and asserts.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Success.
  Result(T value) : state_(std::move(value)) {}
  /// Failure.
  Result(Error error) : state_(std::move(error)) {}

  /// Whether there is a value.
  explicit operator bool() const { return state_.index() == 0; }
  /// The value. Asserts that there is one.
  T& value() & {
    assert(*this);
    return std::get<0>(state_);
  }
  /// The same, read only.
  const T& value() const& {
    assert(*this);
    return std::get<0>(state_);
  }
  /// The same, to be moved out of a result that goes away.
  T&& value() && {
    assert(*this);
    return std::get<0>(std::move(state_));
  }
  /// The error. Asserts that there is one.
  const Error& error() const {
    assert(!*this);
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace swiftlet
