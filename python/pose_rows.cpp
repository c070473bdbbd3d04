// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_rows.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "failure.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_doubles(py::handle object) {
  if (!py::detail::npy_api::get().PyArray_Check_(object.ptr())) return false;
  const auto* dtype = py::detail::array_descriptor_proxy(py::detail::array_proxy(object.ptr())->descr);
  return dtype->kind == 'f' && dtype->elsize == 8 && dtype->byteorder != '>';
}

Pose refused() {
  Pose pose;
  pose.translation.setConstant(kNan);
  return pose;
}

}  // namespace

QuaternionOrder quaternion_order(py::handle name) {
  if (name.is_none()) return QuaternionOrder::None;
  const std::string text = py::isinstance<py::str>(name) ? name.cast<std::string>() : "";
  if (text == "xyzw") return QuaternionOrder::Xyzw;
  if (text == "wxyz") return QuaternionOrder::Wxyz;
  throw py::value_error("quaternion: expected \"xyzw\" or \"wxyz\", got " + std::string(py::repr(name)));
}

bool PoseRows::read(py::handle poses) {
  // Of an array of `inner` dimensions for each pose; rows before them if there is one more.
  const auto block = [](py::handle array, int inner, py::ssize_t a, py::ssize_t b, Block& into, py::ssize_t& rows) {
    const auto* p = py::detail::array_proxy(array.ptr());
    if (p->nd != inner && p->nd != inner + 1) return false;
    const int first = p->nd - inner;
    if (p->dimensions[first] != a || (inner == 2 && p->dimensions[first + 1] != b)) return false;
    rows = first ? p->dimensions[0] : -1;
    into = {p->data, first ? p->strides[0] : 0, p->strides[first], inner == 2 ? p->strides[first + 1] : 0};
    return true;
  };
  py::ssize_t rows = 0, more = 0;
  if (PyTuple_Check(poses.ptr())) {
    if (PyTuple_GET_SIZE(poses.ptr()) != 2) return false;
    const py::handle r = PyTuple_GET_ITEM(poses.ptr(), 0), t = PyTuple_GET_ITEM(poses.ptr(), 1);
    if (!is_doubles(r) || !is_doubles(t) || !block(r, 2, 3, 3, first_, rows) || !block(t, 1, 3, 0, second_, more) ||
        rows != more)
      return false;
    form_ = Form::Parts;
  } else {
    if (!is_doubles(poses)) return false;
    if (block(poses, 2, 4, 4, first_, rows)) {
      form_ = Form::Matrix;
      second_ = {first_.data + 3 * first_.j, first_.row, first_.i, 0};
    } else if (block(poses, 1, 7, 0, first_, rows)) {
      form_ = Form::Quaternion;
    } else {
      return false;
    }
  }
  held_ = py::reinterpret_borrow<py::object>(poses);
  is_single_ = rows < 0;
  size_ = is_single_ ? 1 : std::size_t(rows);
  return true;
}

PoseRows::PoseRows(py::handle poses, QuaternionOrder order, bool copy, const char* name) : order_(order) {
  py::object converted;
  if (!read(poses) && copy) {
    const py::object as_array = py::module_::import("numpy").attr("asarray");
    const py::object float64 = py::dtype::of<double>();
    const bool is_pair = PyTuple_Check(poses.ptr()) && PyTuple_GET_SIZE(poses.ptr()) == 2;
    if (is_pair)
      converted = py::make_tuple(as_array(poses[py::int_(0)], float64), as_array(poses[py::int_(1)], float64));
    else
      converted = as_array(poses, float64);
    if (read(converted)) poses = converted;
  }
  if (!held_) {
    std::string came;
    if (PyTuple_Check(poses.ptr())) {
      for (const py::handle part : poses) came += (came.empty() ? "a tuple of " : " and ") + what_came(part);
    } else {
      came = what_came(poses);
    }
    throw py::type_error(
        std::string(name) +
        ": expected float64 of shape (4, 4), (n, 4, 4), (7,) or (n, 7), or a tuple of rotations (3, 3) or "
        "(n, 3, 3) and translations (3,) or (n, 3), got " +
        came +
        (copy ? ""
              : "; numpy.asarray(..., float) converts other dtypes and sequences, as does copy=True of calls that take it"));
  }
  if (form_ == Form::Quaternion && order_ == QuaternionOrder::None)
    throw py::value_error(std::string(name) +
                          ": rows of 7 are a translation and a quaternion, whose order must be named: "
                          "quaternion=\"xyzw\" or quaternion=\"wxyz\"");
}

Pose PoseRows::operator[](std::size_t row) const {
  Pose pose;
  copy(row, {&pose, 1});
  return pose;
}

void PoseRows::copy(std::size_t first, std::span<Pose> into) const {
  if (form_ == Form::Quaternion) {
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = of_quaternion(first + n);
    return;
  }
  const Block r = first_, t = second_;
  for (std::size_t n = 0; n < into.size(); ++n) {
    const std::size_t row = first + n;
    Pose& pose = into[n];
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) pose.rotation(i, j) = r.at(row, i, j);
    for (int i = 0; i < 3; ++i) pose.translation[i] = t.at(row, i);
    if (form_ == Form::Matrix &&
        !(r.at(row, 3, 0) == 0 && r.at(row, 3, 1) == 0 && r.at(row, 3, 2) == 0 && r.at(row, 3, 3) == 1))
      pose = refused();
  }
}

Pose PoseRows::of_quaternion(std::size_t row) const {
  const int first = order_ == QuaternionOrder::Xyzw ? 3 : 4;
  const double x = first_.at(row, first), y = first_.at(row, first + 1), z = first_.at(row, first + 2),
               w = first_.at(row, order_ == QuaternionOrder::Xyzw ? 6 : 3);
  const double length2 = w * w + x * x + y * y + z * z;
  if (!(std::abs(length2 - 1) <= 1e-6)) return refused();
  Pose pose;
  const double s = 2 / length2;
  pose.rotation << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),               //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  pose.translation = {first_.at(row, 0), first_.at(row, 1), first_.at(row, 2)};
  return pose;
}

py::array_t<double> matrices(const PoseRows& like, const std::function<Pose(std::size_t)>& pose) {
  std::vector<py::ssize_t> shape{4, 4};
  if (!like.is_single()) shape.insert(shape.begin(), py::ssize_t(like.size()));
  py::array_t<double> result(shape);
  double* out = result.mutable_data();
  for (std::size_t n = 0; n < like.size(); ++n, out += 16) {
    const Pose p = pose(n);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) out[4 * i + j] = p.rotation(i, j);
      out[4 * i + 3] = p.translation[i];
    }
    out[12] = out[13] = out[14] = 0, out[15] = 1;
  }
  return result;
}

}  // namespace swiftlet::python
