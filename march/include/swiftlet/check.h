// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certificates that anyone can recompute: of an answer, and of a model. Slow and plain on purpose. Laws by number: LAWS.md.
#pragma once

#include <string>

#include <swiftlet/query.h>

namespace swiftlet {

/// Whether a certificate holds.
struct Check {
  bool ok = false;      ///< it does
  std::string message;  ///< what failed first, with numbers; empty when ok
  /// `ok`.
  explicit operator bool() const { return ok; }
};

/// Recomputes what `answer` claims by brute force over every vertex: `lower` by the gap of the exact hulls along `normal` (of
/// the levels present, where these lack), `upper` by the two points and the deviations, the verdict by all these. An overlap of
/// the hulls is decided by exact arithmetic: on the vertices of `proof`, as Tuning::proof was filled, or else by all planes
/// that could separate the hulls. Of a signed overlap `upper` is held against the least height of all planes that can bound the
/// Minkowski difference, parallel to a face of A, to one of B, or to an edge of each whose neighbours are below, by exact
/// signs; a touching pair's depth likewise; each point must lie in its body, and where the interval is no wider than law 2
/// allows, the points must differ by the signed distance along the normal within that. Cost: linear in the vertices and faces;
/// of an overlap without a proof the product of the edges, 0.2 s for two bodies of 2 000 triangles.
Check check(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const OverlapProof* proof = nullptr);

/// Proves that every level is convex and encloses level 0, that every deviation holds, and that links and tables name features.
/// Exact. Fails on a model whose level 0 is absent. Cost: a support climb per face and a distance query per vertex.
Check verify(const Model& model);

}  // namespace swiftlet
