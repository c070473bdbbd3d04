// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// `Result`: what functions return where data enters the library, either a value or an error with one sentence on what is wrong.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

namespace swiftlet {

/// The kind of an `Error`.
enum class ErrorCode {
  CannotRead,    ///< the file is missing or unreadable
  CannotWrite,   ///< the file cannot be created or the disk is full; nothing half-written is left
  BadFormat,     ///< the data are not in the format expected, or damaged
  BadVersion,    ///< a format version that this library does not read
  BadValue,      ///< an option or a number out of its range; a non-finite coordinate
  Empty,         ///< there are no points
  NotConvex,     ///< a reflex edge, or faces that do not close to one convex surface
  NotSolid,      ///< flat, collinear or a single point where a solid was required
  NotEnclosing,  ///< a coarser level does not enclose level 0
  TooLarge,      ///< more features than 30-bit feature ids can name, too many levels, or more than the format or machine holds
  Cancelled,     ///< the progress callback asked to stop
};

/// Says why there is no value.
struct Error {
  ErrorCode code;       ///< for the program
  std::string message;  ///< for people: one sentence that names the file, line, vertex or edge
  std::string file{};   ///< path of the file at fault, as the caller gave it; empty: no file is at fault
};

/// Holds a value or an `Error`. Reading the one that is absent is misuse, and ends the program in any build: the error's
/// message goes to stderr, then `std::abort` is called.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Success.
  Result(T value) : state_(std::move(value)) {}
  /// Failure.
  Result(Error error) : state_(std::move(error)) {}

  /// Returns true if there is a value.
  explicit operator bool() const { return state_.index() == 0; }
  /// Returns the value. There must be one.
  T& value() & {
    if (!*this) end(std::get<1>(state_).message.c_str());
    return std::get<0>(state_);
  }
  /// Returns the value, read only. There must be one.
  const T& value() const& {
    if (!*this) end(std::get<1>(state_).message.c_str());
    return std::get<0>(state_);
  }
  /// Returns the value, to be moved out of a temporary result. There must be one.
  T&& value() && {
    if (!*this) end(std::get<1>(state_).message.c_str());
    return std::get<0>(std::move(state_));
  }
  /// Returns the error. There must be one.
  const Error& error() const {
    if (*this) end("there is no error, there is a value");
    return std::get<1>(state_);
  }

 private:
  [[noreturn]] static void end(const char* message) {
    std::fprintf(stderr, "swiftlet: %s\n", message);
    std::abort();
  }

  std::variant<T, Error> state_;
};

}  // namespace swiftlet
