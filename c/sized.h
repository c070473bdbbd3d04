// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The rule of structs that say their size: older and newer callers than the library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "failure.h"

namespace swiftlet::c {

inline constexpr std::size_t kLargestSize = 4096;  // no struct comes near: a larger size was never set

template <class T>
[[noreturn]] void refuse_size(const char* name, std::size_t size, std::size_t least) {
  throw Failure{SWIFTLET_BAD_SIZE, std::string(name) + ".size is " + std::to_string(size) + ": it may be a multiple of " +
                                       std::to_string(alignof(T)) + " from " + std::to_string(least) +
                                       " up, and what exceeds the " + std::to_string(sizeof(T)) +
                                       " bytes of this library must be 0"};
}

/// Every sizeof is a multiple of the alignment, and what ends at one cuts no pointer, whatever members T gets. (A double it can
/// cut where 8 bytes are aligned to 4, as on 32-bit x86.)
template <class T>
bool is_size(std::size_t size, std::size_t least) {
  return size >= least && size <= kLargestSize && size % alignof(T) == 0;
}

/// The bytes of an input of `size` bytes, over the defaults that are in `into`.
template <class T>
void read_bytes(const void* from, std::size_t size, std::size_t least, T& into, const char* name) {
  if (!is_size<T>(size, least)) refuse_size<T>(name, size, least);
  std::memcpy(&into, from, std::min(size, sizeof(T)));
  const auto* bytes = static_cast<const unsigned char*>(from);
  for (std::size_t i = sizeof(T); i < size; ++i)
    if (bytes[i]) refuse_size<T>(name, size, least);
}

/// An input: the caller's, or `room`, which holds the defaults, with what the caller says.
template <class T>
const T& read(const T* from, T& room, const char* name, std::size_t least = 8) {
  need(from, name);
  if (from->size == sizeof(T)) return *from;
  read_bytes(from, from->size, least, room, name);
  return room;
}

/// An output that can be written. Null where it may be.
template <class T>
void check_output(const T* to, const char* name, std::size_t least = sizeof(T)) {
  if (to && !is_size<T>(to->size, least)) refuse_size<T>(name, to->size, least);
}

/// Writes what `size` says of `value`, whose own size is set to that.
template <class T>
void write_bytes(T value, std::size_t size, void* to) {
  value.size = std::uint32_t(size);
  std::memcpy(to, &value, std::min(size, sizeof(T)));
  if (size > sizeof(T)) std::memset(static_cast<unsigned char*>(to) + sizeof(T), 0, size - sizeof(T));
}

template <class T>
void write(const T& value, T* to) {
  write_bytes(value, to->size, to);
}

/// Sets a caller's struct of options to their defaults.
template <class T>
swiftlet_code init(const T& defaults, T* to, std::size_t size, swiftlet_error* error) {
  return guard(error, [&] {
    need(to, "options");
    if (!is_size<T>(size, 8)) refuse_size<T>("options", size, 8);
    write_bytes(defaults, size, to);
  });
}

/// An enumerator of a C++ enumeration whose last one is given.
template <class Enum>
Enum enumerator(std::int32_t value, Enum last, const std::string& name) {
  if (value < 0 || value > std::int32_t(last))
    throw Failure{SWIFTLET_BAD_VALUE,
                  name + " is " + std::to_string(value) + ", not from 0 to " + std::to_string(std::int32_t(last))};
  return Enum(value);
}

/// A number of a narrower type.
template <class To>
To narrow(std::int64_t value, const std::string& name) {
  using Limits = std::numeric_limits<To>;
  if (value < Limits::min() || value > Limits::max())
    throw Failure{SWIFTLET_BAD_VALUE, name + " is " + std::to_string(value) + ", not from " + std::to_string(Limits::min()) +
                                          " to " + std::to_string(Limits::max())};
  return To(value);
}

}  // namespace swiftlet::c
