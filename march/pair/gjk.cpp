// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certified GJK. The distance is the least norm over the Minkowski difference {p - q}, whose vertices are differences of
// vertices. The active set method of [Gilbert, Johnson & Keerthi 1988] is used for its certificate: every step ends in a
// supporting plane.
#include "pair/gjk.h"

#include <bitset>

#include "body/half_edge.h"
#include "numeric/exact.h"
#include "pair/difference.h"
#include "pair/overlap.h"
#include "pair/simplex.h"
#include "pair/tetrahedron.h"

namespace swiftlet {
namespace {

std::array<double, 3> coordinates(const Vertex& v) { return {v.x, v.y, v.z}; }

/// True if the differences of the four vertex pairs hold the origin in their hull, decided exactly: the bodies overlap.
bool proves(const PairView& s, const OverlapProof& proof) {
  std::array<std::array<double, 3>, 4> a, b;
  for (int k = 0; k < 4; ++k) {
    a[k] = coordinates(s.a.vertices[proof.vertex_a[k]]);
    b[k] = coordinates(s.b.vertices[proof.vertex_b[k]]);
  }
  return exact::tetrahedron_holds_origin(a, b, s.b_in_a);
}

/// Tells touching from overlapping: is the origin deeper inside the Minkowski difference than law 2's bound? The inner polytope
/// is the hull of some vertex differences, found by brute force over triples, which no degeneracy confuses. A needle needs 106
/// bits: in doubles its facets' normals are unreliable.
template <class Real>
class Contact {
 public:
  Contact(const PairView& pair, std::uint32_t& plane_tests) : pair_(pair), tests_(plane_tests) {}

  void add(std::uint32_t a, std::uint32_t b) {
    if (count_ == kContactPoints || known(a, b)) return;
    points_[count_++] = difference<Real>(pair_, a, b);
  }

  /// Touching if a direction is found along which the bodies overlap by no more than law 2's bound. Overlapping if the inner
  /// polytope reaches farther on all sides, or no more points help, and four points prove it; else NotConverged. `depth`
  /// becomes the radius of a ball about the origin inside the tetrahedron of the first four points, or 0 if more points were
  /// needed. `normal` is tried first, and becomes the direction found or the last one tried.
  MarchStatus decide(Vec& normal, OverlapProof& proof, double& depth) {
    const Vec hint = normal;
    if (count_ == 4 && (depth = inner_radius()) > pair_.law_two && prove(proof)) return MarchStatus::Overlapping;
    depth = 0;
    if (touches(hint, normal)) return MarchStatus::Touching;
    for (const Vec& n : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}) {
      if (touches(n, normal) || touches(-n, normal)) return MarchStatus::Touching;
    }
    // Points on a line span no facet: try directions at right angles to the line.
    const Vec line = longest(), across = normalised(cross(line, least_axis(line)));
    for (const Vec& n : {across, normalised(cross(line, across))}) {
      if (touches(n, normal) || touches(-n, normal)) return MarchStatus::Touching;
    }
    while (count_ < kContactPoints) {
      Vec n{0, 0, 0};
      if (nearest_facet(n) > pair_.law_two) break;
      normal = n;
      const int before = count_;
      if (width(n) <= pair_.law_two) return MarchStatus::Touching;
      if (count_ == before) break;
    }
    return prove(proof) ? MarchStatus::Overlapping : MarchStatus::NotConverged;
  }

 private:
  /// True if the bodies overlap along unit n by no more than law 2's bound. The support along n joins the polytope either way.
  bool touches(const Vec& n, Vec& normal) {
    if (dot(n, n) == 0) return false;
    normal = n;
    return width(n) <= pair_.law_two;
  }

  /// The longest difference from the first point to another.
  Vec longest() const {
    Vec best{0, 0, 0};
    for (int k = 1; k < count_; ++k) {
      const Vec d = rounded(points_[k].p - points_[0].p);
      if (dot(d, d) > dot(best, best)) best = d;
    }
    return best;
  }

  bool known(std::uint32_t a, std::uint32_t b) const {
    for (int k = 0; k < count_; ++k) {
      if (points_[k].a == a && points_[k].b == b) return true;
    }
    return false;
  }

  /// An upper bound on how far the Minkowski difference reaches along n; the support vertices along n join the polytope.
  double width(const Vec& n) {
    const std::uint32_t a = support_a(pair_, n, count_ ? points_[0].a : 0, tests_);
    const std::uint32_t b = support_b(pair_, n, count_ ? points_[0].b : 0, tests_);
    add(a, b);
    const Difference<DoubleDouble> d = difference<DoubleDouble>(pair_, a, b);
    return double(dot(widened<DoubleDouble>(n), d.p)) * (1 + kGapError) + kDoubleDoubleError * pair_.magnitude;
  }

  /// The distance from the origin to the nearest face of the tetrahedron of the first four points; negative if the origin is
  /// outside. Computed in 106 bits: in doubles the depth of a sliver is rounding noise.
  double inner_radius() const {
    std::array<V3<DoubleDouble>, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = difference<DoubleDouble>(pair_, points_[k].a, points_[k].b).p;
    double radius = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
      const V3<DoubleDouble>&a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4], n = cross(b - a, c - a);
      const double length = norm(rounded(n)), offset = rounded(dot(n, a)), apex = rounded(dot(n, p[k] - a));
      if (!(length > 0) || apex == 0) return 0;
      radius = min(radius, (apex < 0 ? offset : -offset) / length);
    }
    return radius;
  }

  /// The distance from the origin to the nearest facet of the inner polytope; `normal` becomes the facet's outward normal.
  double nearest_facet(Vec& normal) {
    double nearest = kInfinity;
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) {
          const auto triple = std::size_t(k * (k - 1) * (k - 2) / 6 + j * (j - 1) / 2 + i);
          if (is_inner_[triple]) continue;
          const V3<Real>& p = points_[std::size_t(i)].p;
          const Vec n = normalised(rounded(cross(points_[std::size_t(j)].p - p, points_[std::size_t(k)].p - p)));
          if (dot(n, n) == 0) continue;
          const double offset = dot(n, rounded(p));
          bool above = false, below = false;
          for (int l = 0; l < count_ && !(above && below); ++l) {
            const double height = dot(n, rounded(points_[std::size_t(l)].p)) - offset;
            above = above || height > pair_.point_error();
            below = below || height < -pair_.point_error();
          }
          is_inner_[triple] = above && below;
          if (above && below) continue;
          const double distance = above ? -offset : offset;
          if (distance < nearest) nearest = distance, normal = above ? -n : n;
        }
      }
    }
    return nearest;
  }

  /// Finds four points that prove the overlap, with the origin well inside their tetrahedron if possible: if it is on a face, a
  /// translation of 1e-300 decides. False if there are none.
  bool prove(OverlapProof& proof) const {
    const auto deep = [&](const OverlapProof& p) { return proves_deep_overlap(pair_, p); };
    const auto any = [&](const OverlapProof& p) { return proves(pair_, p); };
    if (first_that(deep, proof) || first_that(any, proof)) return true;
    proof = {};
    return false;
  }
  template <class Holds>
  bool first_that(Holds holds, OverlapProof& proof) const {
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) {
          for (int l = k + 1; l < count_; ++l) {
            proof = {4,
                     {points_[i].a, points_[j].a, points_[k].a, points_[l].a},
                     {points_[i].b, points_[j].b, points_[k].b, points_[l].b}};
            if (holds(proof)) return true;
          }
        }
      }
    }
    return false;
  }

  const PairView& pair_;
  std::uint32_t& tests_;
  int count_ = 0;
  std::array<Difference<Real>, kContactPoints> points_{};
  /// Triples with points on both sides: no facet of the inner polytope, whatever points join it.
  std::bitset<kContactPoints*(kContactPoints - 1) * (kContactPoints - 2) / 6> is_inner_;
};

/// Which bounds the certificate keeps: the best of all iterates, or plane and points of the last iterate.
enum class Keep { Best, Last };

/// The active set method in one arithmetic, `Real`.
template <class Real>
class GjkDescent {
 public:
  GjkDescent(const PairView& pair, const StopRule& stop, std::uint32_t& plane_tests, Keep keep_bounds = Keep::Best)
      : pair_(pair), stop_(stop), tests_(plane_tests), keep_bounds_(keep_bounds) {}

  /// Improves `m` until `stop` is met, the bodies meet, or this arithmetic makes no more progress.
  void run(GjkResult& m) {
    seed(m.certificate);
    int patience = kProgressPatience;
    for (int iteration = 0; iteration < kGjkLimit && patience > 0; ++iteration) {
      const NearestOrigin<Real> nearest = nearest_to_origin(set_, count_);
      keep(nearest);
      const double distance = std::sqrt(nearest.norm2);
      if (keep_bounds_ == Keep::Last) m.certificate.lower = 0, m.certificate.upper = kInfinity;
      take_points(m.certificate);
      if (nearest.holds_origin || distance <= rounding<Real>(pair_)) {
        met_ = true;
        return;
      }
      const Vec n = normalised(-rounded(nearest.point));
      const std::uint32_t a = support_a(pair_, n, set_[0].a, tests_), b = support_b(pair_, n, set_[0].b, tests_);
      const double lower = bound(n, a, b);
      if (lower > greatest_ || distance < least_)
        patience = kProgressPatience;
      else
        --patience;
      least_ = min(least_, distance);
      greatest_ = max(greatest_, lower);
      if (lower > m.certificate.lower) take_plane(m.certificate, n, a, b, lower);
      // Bounds that begin at 0 may be narrow and still not tell whether the bodies are apart.
      const bool open = m.certificate.lower == 0 && m.certificate.upper <= pair_.law_two;
      if (!open && stop_.met(m.certificate.lower, m.certificate.upper)) {
        m.status = MarchStatus::Disjoint;
        return;
      }
      if (holds(a, b)) return;
      set_[count_++] = difference<Real>(pair_, a, b);
      weight_[count_ - 1] = Real(0);
    }
  }

  bool met() const { return met_; }
  int count() const { return count_; }
  const Difference<Real>& operator[](int k) const { return set_[k]; }

 private:
  void seed(const Certificate& c) {
    for (int k = 0; k < c.active.count; ++k) set_[count_++] = difference<Real>(pair_, c.active.a[k], c.active.b[k]);
    if (count_ < 4 && !holds(c.support_a, c.support_b)) set_[count_++] = difference<Real>(pair_, c.support_a, c.support_b);
  }

  bool holds(std::uint32_t a, std::uint32_t b) const {
    for (int k = 0; k < count_; ++k) {
      if (set_[k].a == a && set_[k].b == b) return true;
    }
    return false;
  }

  void keep(const NearestOrigin<Real>& nearest) {
    std::array<Difference<Real>, 4> kept{};
    for (int k = 0; k < nearest.count; ++k) {
      kept[k] = set_[nearest.index[k]];
      weight_[k] = nearest.weight[k];
    }
    set_ = kept;
    count_ = nearest.count;
  }

  /// Takes the points of the active set into `c` if their distance is a smaller upper bound.
  void take_points(Certificate& c) const {
    V3<Real> a{Real(0), Real(0), Real(0)}, apart = a;
    for (int k = 0; k < count_; ++k) {
      a = a + widened<Real>(vec(pair_.a.vertices[set_[k].a])) * weight_[k];
      apart = apart - set_[k].p * weight_[k];
    }
    const double upper = norm(rounded(apart)) * (1 + kNormError) + rounding<Real>(pair_);
    if (!(upper < c.upper)) return;
    c.upper = upper;
    c.point_a = rounded(a);
    c.point_b = rounded(a + apart);
    c.active.count = count_;
    for (int k = 0; k < count_; ++k) {
      c.active.a[k] = set_[k].a;
      c.active.b[k] = set_[k].b;
      c.active.weight[k] = rounded(weight_[k]);
    }
  }

  static void take_plane(Certificate& c, const Vec& n, std::uint32_t a, std::uint32_t b, double lower) {
    c.normal = n;
    c.support_a = a;
    c.support_b = b;
    c.lower = lower;
  }

  /// The lower bound on the distance that the support vertices `a` and `b` along unit `n` prove.
  double bound(const Vec& n, std::uint32_t a, std::uint32_t b) const {
    if constexpr (std::is_same_v<Real, double>) return gap(pair_, n, a, b);
    const double value = -double(dot(widened<DoubleDouble>(n), difference<DoubleDouble>(pair_, a, b).p));
    return value * (value > 0 ? 1 - kGapError : 1 + kGapError) - kDoubleDoubleError * pair_.magnitude;
  }

  const PairView& pair_;
  const StopRule& stop_;
  std::uint32_t& tests_;
  const Keep keep_bounds_;
  std::array<Difference<Real>, 4> set_{};
  std::array<Real, 4> weight_{};
  int count_ = 0;
  /// The least distance and the greatest lower bound of all iterates so far; the latter may be negative.
  double least_ = kInfinity, greatest_ = -least_;
  bool met_ = false;
};

template <class Real>
bool solve(const PairView& pair, const StopRule& stop, GjkResult& m, std::uint32_t& plane_tests) {
  GjkDescent<Real> descent(pair, stop, plane_tests);
  descent.run(m);
  const bool near_zero = m.certificate.upper <= pair.law_two && m.certificate.lower == 0;
  const bool is_apart = m.certificate.lower > 0 && stop.met(m.certificate.lower, m.certificate.upper);  // however run() ended
  if (is_apart) m.status = MarchStatus::Disjoint;
  if (m.status == MarchStatus::Disjoint && !near_zero) return true;
  m.status = MarchStatus::NotConverged;
  if (!descent.met() && !near_zero) return false;
  Contact<Real> contact(pair, plane_tests);
  for (int k = 0; k < descent.count(); ++k) contact.add(descent[k].a, descent[k].b);
  Vec normal = m.certificate.normal;
  const MarchStatus status = contact.decide(normal, m.proof, m.depth);
  if (status == MarchStatus::NotConverged) return false;
  // Thin bodies overlap by less than law 2's bound along some direction even if they are far apart.
  if (status == MarchStatus::Touching && !near_zero) return false;
  m.status = status;
  m.certificate.lower = 0;
  m.certificate.normal = normal;
  if (status == MarchStatus::Overlapping) m.certificate.upper = 0;
  return true;
}

}  // namespace

GjkResult gjk(const PairView& pair, const Certificate& start, const StopRule& stop, std::uint32_t& plane_tests) {
  GjkResult m;
  m.certificate = start;
  if (!solve<double>(pair, stop, m, plane_tests)) solve<DoubleDouble>(pair, stop, m, plane_tests);
  return m;
}

bool straighten(const PairView& pair, Certificate& c, std::uint32_t& plane_tests) {
  const StopRule at_law_two{.absolute = pair.law_two};
  GjkResult m;
  m.certificate = c;
  GjkDescent<DoubleDouble>(pair, at_law_two, plane_tests, Keep::Last).run(m);
  if (m.status != MarchStatus::Disjoint) return false;
  c = m.certificate;
  return true;
}

void sharpen(const PairView& pair, Certificate& c, std::uint32_t& plane_tests) {
  const StopRule as_far_as_it_goes;
  GjkResult m;
  m.certificate = c;
  GjkDescent<DoubleDouble>(pair, as_far_as_it_goes, plane_tests).run(m);
  c = m.certificate;
}

FeatureId feature_of(const ConvexView& view, const ActiveSet& active, const std::array<std::uint32_t, 4>& vertices) {
  std::array<std::uint32_t, 4> distinct{};
  int count = 0, heaviest = 0;
  for (int k = 0; k < active.count; ++k) {
    if (active.weight[k] > active.weight[heaviest]) heaviest = k;
    bool seen = false;
    for (int i = 0; i < count; ++i) seen = seen || distinct[i] == vertices[k];
    if (!seen) distinct[count++] = vertices[k];
  }
  const Vertex& first = view.vertices[distinct[0]];
  if (count == 1) return {FeatureKind::Vertex, distinct[0]};
  for (std::uint32_t h = first.ring_begin; count == 2 && h < first.ring_begin + first.ring_count; ++h) {
    if (view.half_edges[h].head == distinct[1] && !is_diagonal(view, h)) return {FeatureKind::Edge, h};
  }
  // A vertex may lie inside a face, off the face's loop: the half-edges around the vertex are searched instead.
  const auto holds = [&](std::uint32_t face, std::uint32_t v) {
    const Vertex& ring = view.vertices[v];
    for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
      if (view.half_edges[h].face == face) return true;
    }
    return false;
  };
  for (std::uint32_t h = first.ring_begin; h < first.ring_begin + first.ring_count; ++h) {
    if (view.half_edges[h].face == kNone) continue;
    int held = 1;
    while (held < count && holds(view.half_edges[h].face, distinct[std::size_t(held)])) ++held;
    if (held == count) return {FeatureKind::Face, view.half_edges[h].face};
  }
  return {FeatureKind::Vertex, vertices[heaviest]};
}

}  // namespace swiftlet
