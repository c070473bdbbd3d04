// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Poses as Python has them: matrices, rotations with translations, translations with quaternions; read where they lie.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>

#include <swiftlet/pose.h>

namespace swiftlet::python {

/// The order of a quaternion's numbers in rows of (x, y, z of the translation, quaternion).
enum class QuaternionOrder { None, Xyzw, Wxyz };

QuaternionOrder quaternion_order(pybind11::handle name);  ///< None, "xyzw" or "wxyz", else ValueError

/// Reads float64 arrays of shape (4, 4), (n, 4, 4), (7,), (n, 7), or a tuple of (3, 3) or (n, 3, 3) and (3,) or (n, 3),
/// whatever their strides. Holds the arrays; reading rows needs no lock.
class PoseRows {
 public:
  /// Raises TypeError or ValueError for anything else, unless `copy`: then what numpy makes of it as float64 is taken.
  PoseRows(pybind11::handle poses, QuaternionOrder order, bool copy, const char* name = "poses");

  bool is_single() const { return is_single_; }
  std::size_t size() const { return size_; }
  /// A last row that is not (0, 0, 0, 1), and a quaternion that is not unit to 1e-6, give a pose that queries refuse.
  Pose operator[](std::size_t row) const;
  /// Rows from `first` on, as many as `into` holds.
  void copy(std::size_t first, std::span<Pose> into) const;
  /// Asks the memory for a row, which may be none.
  [[gnu::always_inline]] void prefetch(std::size_t row) const {
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(first_.data) + row * std::uintptr_t(first_.row);
    for (const std::uintptr_t line : {begin, begin + 64}) __builtin_prefetch(reinterpret_cast<const void*>(line));
  }

 private:
  struct Block {
    const char* data = nullptr;
    pybind11::ssize_t row = 0, i = 0, j = 0;  ///< strides
    double at(std::size_t n, int a, int b = 0) const {
      double x;
      std::memcpy(&x, data + pybind11::ssize_t(n) * row + a * i + b * j, sizeof x);
      return x;
    }
  };
  Pose of_quaternion(std::size_t row) const;
  bool read(pybind11::handle poses);
  enum class Form { Matrix, Parts, Quaternion } form_ = Form::Matrix;
  QuaternionOrder order_;
  Block first_;   ///< matrices, rotations, or translations and quaternions
  Block second_;  ///< translations, but for quaternions
  pybind11::object held_;
  std::size_t size_ = 0;
  bool is_single_ = false;
};

/// A (4, 4) matrix, or (n, 4, 4) ones.
pybind11::array_t<double> matrices(const PoseRows& shape_like, const std::function<Pose(std::size_t)>& pose);

}  // namespace swiftlet::python
