// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds a manifold: contact faces at the answer's features, the corners of their intersection, and a choice of few of these.
#include <swiftlet/manifold.h>

#include <algorithm>

#include "body/half_edge.h"
#include "manifold/candidates.h"
#include "manifold/choice.h"
#include "manifold/clip.h"
#include "manifold/contact_face.h"
#include "pair/intersection.h"
#include "pair/pair_view.h"
#include "query/radii.h"

namespace swiftlet {
namespace {

/// The witness points of two hulls that a manifold grows from, in A's frame.
struct Anchor {
  Vec normal, point_a;
  double separation;               ///< of B's point along the normal
  FeatureId feature_a, feature_b;  ///< that hold them
};

/// Puts the contact points of a candidate where they belong. If one of its features is a vertex, that body's point is the
/// vertex; the other body's point lies on the line through it along the normal. No points are nearer than `nearest`, but a
/// corner that lies beside a steep face and counts as inside seems to be.
void put(ManifoldPoint& point, const PairView& pair, const Projection& projection, const Radii& radii, const Candidate& c,
         double nearest) {
  const double separation = max(c.separation, nearest);
  const Vec across = projection.a.n * separation;
  const FeatureId a = c.names.a(), b = c.names.b();
  const Vec point_a = a.kind() == FeatureKind::Vertex   ? body_a(pair).point(a.index())
                      : b.kind() == FeatureKind::Vertex ? body_b(pair).point(b.index()) - across
                                                        : projection.point(c.on_a);
  point.point_a = eigen(point_a + projection.a.n * radii.a());
  point.point_b = eigen(point_a + across - projection.a.n * radii.b());
  point.separation = separation - radii.sum(), point.feature_a = a, point.feature_b = b;
}

/// What is asked for, in the range that is allowed.
double flatness(const ManifoldOptions& options) { return max(0, min(options.flatness, kMostFlatness)); }

/// Fills the manifold of two bodies with these hulls; points farther apart than the margin are left out.
void grow(const PairView& pair, const Radii& radii, const Anchor& w, double bound, const ManifoldOptions& options,
          const Manifold& previous, Manifold& manifold) {
  const ContactFace a(pair.a, w.normal, w.feature_a, previous.face_a, flatness(options), bound),
      b(pair.b, body_b(pair).into(-w.normal), w.feature_b, previous.face_b, flatness(options), bound);
  manifold.normal = eigen(w.normal);
  if (a.name().kind() == FeatureKind::Face) manifold.face_a = a.name();
  if (b.name().kind() == FeatureKind::Face) manifold.face_b = b.name();

  const Projection projection(pair, w.normal, w.point_a, any_side(pair, a, b));
  const bool rests = norm(w.normal - vec(previous.normal)) <= kRestingTurn * flatness(options);
  const double slack = rests ? flatness(options) * max(pair.a.extent, pair.b.extent) : 0;
  const std::uint32_t most = std::min(options.most_points, kMostManifoldPoints);
  // A corner counts as inside of a face that it misses by no more than `beside`: by rounding, or, where a pair at rest has lost
  // points of the manifold before, by the noise of its poses, if that finds more of them.
  int kept = -1;
  for (const double beside : {bound / 2, kRestingSlide * slack}) {
    if (kept >= int(std::min(previous.count, most)) || beside < bound / 2) break;
    Candidates candidates(options.margin + radii.sum() + bound, previous);
    clip(projection, a, b, beside, candidates);
    if (candidates.count() == 0 || w.separation < candidates.least() - bound / 2)
      candidates.add_deepest({{0, 0, 0}, w.separation, {named(pair.a, w.feature_a), named(pair.b, w.feature_b)}});
    const Chosen chosen = choose(candidates, most, previous, bound, slack);
    const auto known =
        int(std::count_if(chosen.begin(), chosen.end(), [&](int i) { return candidates.knows(candidates[i].names); }));
    if (known <= kept) break;
    kept = known, manifold.count = 0;
    for (const int i : chosen)
      put(manifold.points[manifold.count++], pair, projection, radii, candidates[i], w.separation - bound / 2);
  }
}

/// `bound` is law 2's for the bodies.
Anchor anchor(const PairView& pair, const Radii& radii, const Answer& answer, double bound) {
  const Vec n = vec(answer.normal), point_a = vec(answer.point_a) - n * radii.a(),
            point_b = vec(answer.point_b) + n * radii.b();
  // The points of a touching pair may be one, and those of a depth that a budget ended need not be as far apart as it is. The
  // distance of bodies that overlap by their radii is 0, and only its points tell how deep they do.
  const double seen = dot(n, point_b - point_a),
               proved = min(max(seen, answer.lower + radii.sum()), answer.upper + radii.sum());
  std::uint32_t tests = 0;
  return {n, point_a, answer.is_signed || std::fabs(seen - proved) <= bound ? proved : seen,
          held_at_a(pair, answer.feature_a, point_a, tests).feature, held_at_b(pair, answer.feature_b, point_b, tests).feature};
}

bool exists(const Shape& body, int level, FeatureId feature) {
  return level >= body.finest_level() && level < body.level_count() && names_feature(body.level(level).view, feature);
}

}  // namespace

Manifold manifold(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const ManifoldOptions& options,
                  const Manifold& previous) {
  Manifold manifold;
  const Setting at(a, b, b_in_a);
  const Shape &body_a = at.a, &body_b = at.b;
  if (at.fault() != Status::Converged || Radii(answer) != at.radii || answer.normal.hasNaN() || answer.point_a.hasNaN() ||
      !exists(body_a, answer.level_a, answer.feature_a) || !exists(body_b, answer.level_b, answer.feature_b))
    return manifold;
  const PairView hulls =
      pair_view(body_a.level(answer.level_a).view, body_b.level(answer.level_b).view, at.motion, at.quality.error);
  const double bound = hulls.law_two + kLawTwo * at.radii.sum();
  grow(hulls, at.radii, anchor(hulls, at.radii, answer, bound), bound, options, previous, manifold);
  return manifold;
}

}  // namespace swiftlet
