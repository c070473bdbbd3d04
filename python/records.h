// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The library's answers as numpy's structured arrays: the memory is the answers themselves, nothing is copied.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <optional>

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh_query.h>

#include "arguments.h"
#include "pose_rows.h"
#include "py_body.h"

namespace swiftlet::python {

enum class Query { Distance, SignedDistance, Intersects, Within, SignedWithin, ClosestFeatures };

/// What a query is asked with, for every kind.
struct Asked {
  Query query = Query::Distance;
  double threshold = 0;
  Options options;
  Effort effort() const { return {options.budget, options.tuning}; }
  ClosestOptions closest() const { return {options.beyond, options.budget.steps, options.tuning}; }
};

/// A Tuning of swiftlet's, or None.
Tuning to_tuning(pybind11::handle tuning);
ManifoldOptions to_manifold_options(const Real& margin, const Whole& most_points, const Real& flatness);

/// Asks one question about two bodies that are both convex, or of which one is a mesh.
inline void ask(const Asked& q, const auto& a, const auto& b, const Pose& pose, auto& seed, Answer& into) {
  switch (q.query) {
    case Query::Distance: into = distance(a, b, pose, seed, q.options); break;
    case Query::SignedDistance: into = signed_distance(a, b, pose, seed, q.options); break;
    default: into = intersects(a, b, pose, seed, q.effort());
  }
}
inline void ask(const Asked& q, const auto& a, const auto& b, const Pose& pose, auto& seed, Within& into) {
  into = q.query == Query::Within ? within(a, b, pose, q.threshold, seed, q.effort())
                                  : signed_within(a, b, pose, q.threshold, seed, q.effort());
}
inline void ask(const Asked& q, const auto& a, const auto& b, const Pose& pose, auto& seed, ClosestFeatures& into) {
  into = closest_features(a, b, pose, seed, q.closest());
}

/// The dtypes of Answer and of Within.
pybind11::dtype answer_dtype();
pybind11::dtype within_dtype();

/// A new array of answers, of shape () or (n,).
pybind11::array new_records(const pybind11::dtype& dtype, std::size_t count, bool is_single);

/// A manifold's normal, faces and records of points: what `previous` takes again.
pybind11::tuple manifold_parts(const Manifold& manifold);

void define_queries(pybind11::module_& module);
void define_single(pybind11::module_& module);
void define_scenes(pybind11::module_& module);

}  // namespace swiftlet::python
