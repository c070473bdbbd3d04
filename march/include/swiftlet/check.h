// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certificates that anyone can recompute: of an answer, and of a model. Slow and plain on purpose.
#pragma once

#include <string>

#include <swiftlet/depth.h>
#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// Whether a certificate holds.
struct Check {
  bool ok = false;      ///< it does
  std::string message;  ///< what failed first, with numbers; empty when ok
  /// `ok`.
  explicit operator bool() const { return ok; }
};

/// Recomputes what `answer` claims, by brute force over every vertex: `lower` by the gap of the exact hulls along `normal` (of
/// the levels present, where these lack), `upper` by the two points and the deviations, overlap by exact arithmetic on the
/// proof's vertices, the verdict by all these. Cost: linear in the vertices and faces. The radii are those of the options that
/// the answer was asked with.
Check check(const Model& a, const Model& b, const Pose& b_in_a, const Answer& answer, double radius_a = 0, double radius_b = 0);

/// Recomputes what `answer` claims in the same way. Of an overlap: `lower` by the gap along `normal`, `upper` by the least
/// height of all planes that can bound the Minkowski difference, parallel to a face of A, to one of B, or to an edge of each
/// whose neighbours are below, by exact signs; a touching pair's depth likewise; that each point lies in its body; and of a
/// verdict with an interval no wider than law 2 allows, that the points differ by the signed distance along the normal within
/// that. Cost: the product of the edges, 0.2 s for two bodies of 2 000 triangles. Radii as above.
Check check(const Model& a, const Model& b, const Pose& b_in_a, const SignedAnswer& answer, double radius_a = 0,
            double radius_b = 0);

/// Proves that every level is convex and encloses level 0, that every deviation holds, and that links and tables name features.
/// Exact. Fails on a model whose level 0 is absent. Cost: a support climb per face and a distance query per vertex.
Check verify(const Model& model);

}  // namespace swiftlet
