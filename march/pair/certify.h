// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certificates: proved bounds on the distance of two polytopes, from a direction, both bodies' support vertices along it and
// two points. They hold whichever features they are made from. Knows one level pair, not how a march came there.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/march.h>

#include "body/support.h"
#include "pair/nearest.h"
#include "pair/pair_view.h"
#include "pair/witness.h"

namespace swiftlet {

/// At most four vertex pairs with convex weights, which make one point of each body. Certified GJK starts from an active set.
struct ActiveSet {
  int count = 0;
  std::array<std::uint32_t, 4> a, b;  ///< entries from `count` on have no meaning
  std::array<double, 4> weight;
};

struct Certificate {
  double lower = 0, upper = 0;  ///< proved bounds on the distance of the two polytopes; upper >= lower >= 0
  Vec normal{0, 0, 0};          ///< unit, common frame, from A to B: `lower` is proved along it
  Vec point_a{0, 0, 0}, point_b{0, 0, 0};
  ActiveSet active;                            ///< its weights make `point_a` and `point_b`
  std::uint32_t support_a = 0, support_b = 0;  ///< support vertices of A along `normal`, of B along -`normal`
};

/// Proves bounds from `seen`, the witness of features `a` of A and `b` of B, of which at most one is a face, by climbing to the
/// support vertices: in doubles, and if that is not within law 2's bound, by exact comparisons.
Certificate certify(const PairView& pair, const Witness& seen, std::uint32_t& plane_tests);

/// Proved bounds on the distance of two polytopes that are apart, within law 2's bound, with plane and points that fit. `V` as
/// of NearestOf.
template <class V>
struct ProofOf {
  double lower, upper;
  V normal;  ///< unit, from A to B
};
using Proof = ProofOf<Padded>;
/// True if the bounds agree within law 2's bound, but `point_b` - `point_a` differs from its length times `normal` by more than
/// that. Bounds that agree so leave the plane room to lean by the root of law 2's: by 1e-8, say, between nearly parallel faces.
static inline bool leans(const PairView& pair, const Certificate& c) {
  const Vec apart = c.point_b - c.point_a, aside = apart - c.normal * norm(apart);
  return c.upper - c.lower <= pair.law_two && norm(aside) > pair.law_two;
}

/// The vertex of A farthest along n, climbed from `start` by exact comparisons: no vertex is farther.
static inline std::uint32_t support_a(const PairView& pair, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return support(pair.a, n, start, plane_tests);
}
/// The vertex of B farthest along -n, climbed from `start` by exact comparisons: no vertex is farther.
static inline std::uint32_t support_b(const PairView& pair, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return support(pair.b, pair.b_in_a, -n, start, plane_tests);
}

/// Support vertices, `a` of A along a unit direction and `b` of B against it, as far as doubles can tell, and `lower`, the
/// lower bound that their gap proves. It may be negative.
struct Supports {
  std::uint32_t a, b;
  double lower;
};
Supports supports(const PairView& pair, const Vec& n, std::uint32_t start_a, std::uint32_t start_b, std::uint32_t& plane_tests);

/// A lower bound on n . (q - p), less `slack`, for unit n, a vertex p of A and a vertex q of B, where `c` is q - p rounded. May
/// be negative.
static inline double gap(const PairView& pair, const Vec4& n, const Vec4& c, double slack) {
  const Vec4 products = n * c;
  const Vec2 total = sums(products, abs(products));
  return total[0] - (kGapError * total[1] + pair.motion_error + slack);
}
/// The same between vertices `va` of A and `vb` of B.
double gap(const PairView& pair, const Vec& n, std::uint32_t va, std::uint32_t vb, double slack = 0);

/// An upper bound on the distance of two bodies by the points where a walk ended, which are `length` apart.
template <class V>
static inline double upper_at(const PairView& pair, const NearestOf<V>& seen, double length) {
  return length * (1 + kNormError) + pair.motion_error + kPointSumError * pair.magnitude + seen.blur;
}

/// Proves bounds by the tests of a walk's last state alone, and reads nothing else. Returns why they do not tell, or None.
static inline Doubt certify(const PairView& pair, const NearestOf<Vec4>& seen, ProofOf<Vec4>& proof) {
  Vec4 apart = seen.point_b - seen.point_a;
  const Vec2 squares = dots(seen.normal, seen.normal, apart, apart), lengths = sqrt(squares);
  const double over = seen.over_a + seen.over_b;
  if (!(over <= pair.law_two)) return over < kInfinity ? Doubt::Width : Doubt::Neighbour;
  if (!(squares[0] >= kLeastSquare)) return Doubt::Width;  // squares of legal coordinates are finite
  const double length = lengths[1];
  // Nearer points may lie aside along an edge (kAcrossError), or have a length that underflowed.
  if (!(length > pair.law_two)) return Doubt::Threshold;
  proof.normal = seen.normal * (1 / lengths[0]);
  proof.lower = gap(pair, proof.normal, seen.apart, over);
  proof.upper = max(proof.lower, upper_at(pair, seen, length));
  if (!(proof.lower > pair.law_two)) return Doubt::Threshold;
  if (!(proof.upper - proof.lower <= pair.law_two)) return Doubt::Width;
  Vec4 aside = apart - proof.normal * length;
  return dot(aside, aside) > pair.law_two * pair.law_two ? Doubt::Lean : Doubt::None;
}
static inline Doubt certify(const PairView& pair, const Nearest& seen, Proof& proof) {
  ProofOf<Vec4> found{};
  const Doubt doubt = certify(pair, loaded(seen), found);
  proof.lower = found.lower, proof.upper = found.upper;
  store(found.normal, proof.normal);
  return doubt;
}
/// Looks closer at a walk's last state: at the vertices level with the feature whose `over` is the larger one, once, if that is
/// unknown or a larger share of law 2's bound than `kCloseShare`. Returns true if an `over` became less.
bool tighten(const PairView& pair, Nearest& seen, std::uint32_t& plane_tests);

/// The distance of vertices `va` of A and `vb` of B plus its rounding error: an upper bound on the bodies' distance.
double apart(const PairView& pair, std::uint32_t va, std::uint32_t vb);

}  // namespace swiftlet
