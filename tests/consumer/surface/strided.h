// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One pair in many poses, as arrays of another language hold them: positions and quaternions with any number of bytes from one
// to the next, answers likewise.
#pragma once

#include <cstddef>

#include <swiftlet/batch.h>

namespace surface {

/// Doubles in rows that lie so many bytes apart, aligned or not, forwards or backwards.
template <class Byte>
struct Strided {
  Byte* first = nullptr;
  std::ptrdiff_t bytes_apart = 0;
  Byte* operator[](std::size_t i) const { return first + std::ptrdiff_t(i) * bytes_apart; }
};
using Input = Strided<const std::byte>;
using Output = Strided<std::byte>;

/// `lower` has a double in each row, `normal` three, `position` three, and `quaternion` w, x, y, z, of unit length within 1e-7.
/// The answers are those of a batch over the same poses, bit for bit; memory is taken for a chunk of poses on each thread.
void distances(const swiftlet::Body& a, const swiftlet::Body& b, std::size_t count, Input position, Input quaternion,
               Output lower, Output normal, const swiftlet::Options& options, const swiftlet::Executor& executor);

/// How many claims about it are wrong.
int strided_batches();

}  // namespace surface
