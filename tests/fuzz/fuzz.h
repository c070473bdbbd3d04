// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is fuzzed: functions of any bytes. Linked into libFuzzer's programs, and into the tests, which replay found/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace swiftlet::fuzz {

using Input = std::span<const std::uint8_t>;

/// Values one after the other, zeros past the end.
class Bytes {
 public:
  explicit Bytes(Input input) : rest_(input) {}
  bool empty() const { return rest_.empty(); }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    const std::size_t size = std::min(sizeof(T), rest_.size());
    if (size > 0) std::memcpy(static_cast<void*>(&value), rest_.data(), size);
    rest_ = rest_.subspan(size);
    return value;
  }
  Input rest() const { return rest_; }

 private:
  Input rest_;
};

// Each returns what is wrong, or nothing.

/// A model file whose hashes and size are made right. Loaded or refused; a loaded one answers every query with an interval.
std::string model(Input input);
/// A byte for the format, then a mesh file. Read or refused; a small one is built, and what is built is verified.
std::string mesh(Input input);
/// Options, a pose, a seed and a second pose for a pair of good models: checked, and compared with the oracle.
std::string query(Input input);
/// Two small point sets and a pose: built, asked every question, compared with the oracle.
std::string hulls(Input input);
#if SWIFTLET_FUZZ_MESHES
/// A pose, a seed, options and two soups of few triangles: meshes made, with hulls and without, as surfaces and as solids,
/// moved to other points and cut; verified, asked, also with a front that lay at a pose nearby, compared with brute force.
std::string triangles(Input input);
/// The block of a mesh whose hashes and size are made right. Loaded, salvaged or refused; a loaded one answers every query, is
/// cut, moved, and ends.
std::string block(Input input);
#endif

struct Target {
  const char* name;
  std::string (*run)(Input);
};
inline constexpr Target kTargets[] = {
    {"model", model},         {"mesh", mesh},   {"query", query}, {"hulls", hulls},
#if SWIFTLET_FUZZ_MESHES
    {"triangles", triangles}, {"block", block},
#endif
};

}  // namespace swiftlet::fuzz
