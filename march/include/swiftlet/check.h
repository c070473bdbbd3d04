// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Checkers that recompute the certificates of answers and models by brute force: slow and plain. Laws by number: LAWS.md.
#pragma once

#include <cstdint>
#include <string>

#include <swiftlet/query.h>

namespace swiftlet {

/// The result of a check.
struct Check {
  bool ok = false;      ///< the certificate holds
  std::string message;  ///< what failed first, with numbers; empty when ok
  /// Returns `ok`.
  explicit operator bool() const { return ok; }
};

/// What an answer is one to, as far as it does not tell itself.
enum class Question : std::uint8_t {
  Any,    ///< any question
  Exact,  ///< `distance`, `signed_distance` or `closest_features` without an allowed error: what these promise is checked too
};

/// Recomputes what `answer` claims by brute force over every vertex. `lower` is compared with the gap of the exact hulls along
/// `normal` (where level 0 is absent, of the levels present and the balls around the bodies), `upper` with the distance of the
/// two points plus the deviations, the verdict with both. An overlap of the hulls is decided exactly: by the vertices of
/// `proof`, which is what `Tuning::proof` received, or without it by those that a march finds, or by all planes that could
/// separate the hulls. For a signed answer, the depth of an overlapping or touching pair is recomputed: the least height of the
/// planes that can bound the Minkowski difference, parallel to a face of A, to a face of B, or to an edge of each; exact signs
/// tell which.
///
/// The status and the verdict must be ones that there are, the normal unit, and both points numbers, or all three NaN where
/// that means nothing; features must be there on the levels named, or both be none. Each point that is known must lie in its
/// body's level, moved back by the radius: within law 2's bound above the plane of any face or, where a body is a point, a
/// segment or a polygon, at most as far away. Which features hold the points is not looked at: a threshold question names those
/// of its last sample.
///
/// The interval of an exact answer that is Converged must be within law 2's bound, and so must its levels be of the bodies
/// where it has points between them; Undecided, it must be within that of contact. Where an interval is, of the hulls, the
/// points of an exact answer must differ by the signed distance along the normal, within that bound, unless the status is
/// Budget or Beyond, the verdict Undecided, or an overlap unsigned, whose points nobody asked to be the nearest. Any other
/// question may end so near by chance, at a threshold or an allowed error, before the nearest features are found: its points
/// may differ aside of the normal too, as far as bounds that near let it lean: about the root of law 2's bound times the
/// distance.
///
/// Cost: linear in vertices and faces; for a signed overlap, and for one within rounding of touching without `proof`, the
/// product of the edges, 0.2 s for 2 000 triangles each.
Check check(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, Question asked,
            const OverlapProof* proof = nullptr);
/// Recomputes what `answer` claims, whatever was asked.
Check check(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const OverlapProof* proof = nullptr);

/// Proves exactly that every level is convex and encloses level 0 and that no vertex is higher above a face's plane than
/// FacePlane::over, and by certified bounds that every reach and support map holds and every deviation within law 2's bound.
/// The dimension, extents, volumes, numbers of edges and triangles and mean lengths of edges are recomputed; a deviation may be
/// larger than need be. (That links and tables name features is checked whenever a model is made or read.) Fails if level 0 is
/// absent. Cost: a support climb per face, a distance query per vertex, all vertices per cell of a map.
Check verify(const Model& model);

}  // namespace swiftlet
