// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "exact_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <stdexcept>

#include <CGAL/Gmpzf.h>

#include "bodies.h"
#include "depth_check.h"

namespace swiftlet::stability {
namespace {

using Dyadic = CGAL::Gmpzf;  // nothing is divided
using Point = std::array<Dyadic, 3>;

constexpr double kEpsilon = 0x1p-53;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

Dyadic determinant(const Point& p, const Point& q, const Point& r) {
  return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

/// a - (R b + t).
Point difference(const Vec3& a, const Vec3& b, const Pose& b_in_a) {
  Point d;
  for (int i = 0; i < 3; ++i) {
    d[std::size_t(i)] = Dyadic(a[i]) - Dyadic(b_in_a.translation[i]);
    for (int j = 0; j < 3; ++j) d[std::size_t(i)] -= Dyadic(b_in_a.rotation(i, j)) * Dyadic(b[j]);
  }
  return d;
}

/// The largest entry of |R^T R - I|, rounded once.
double orthonormality_error(const Mat3& r) {
  Dyadic worst(0);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      Dyadic entry(i == j ? -1 : 0);
      for (int k = 0; k < 3; ++k) entry += Dyadic(r(k, i)) * Dyadic(r(k, j));
      worst = std::max(worst, CGAL::abs(entry));
    }
  }
  return CGAL::to_double(worst);
}

/// Whether the tetrahedron of the four points has volume and holds the origin.
bool holds_origin(const std::array<Point, 4>& p) {
  // The volumes that the origin spans with each face, turned alike: positive weights of the four points, or all negative.
  const Dyadic weights[] = {determinant(p[1], p[3], p[2]), determinant(p[0], p[2], p[3]), determinant(p[0], p[3], p[1]),
                            determinant(p[0], p[1], p[2])};
  int above = 0, below = 0;
  for (const Dyadic& w : weights) {
    above += CGAL::sign(w) == CGAL::POSITIVE;
    below += CGAL::sign(w) == CGAL::NEGATIVE;
  }
  return (above > 0) != (below > 0);
}

/// Steps that law 7 allows a march: 2 * (12 |A| |B| + 1).
double step_limit(const Level& a, const Level& b) {
  const auto features = [](const Level& level) {
    return double(level.view.vertices.size() + level.view.half_edges.size() + level.view.face_first.size());
  };
  return 2 * (12 * features(a) * features(b) + 1);
}

/// What an exact answer, signed or not, must not be.
std::string unsettled(const Answer& answer) {
  if (answer.status != Status::Converged) return text("the status is %d", int(answer.status));
  if (answer.verdict == Verdict::Undecided) return "exact without a verdict";
  if (answer.level_a != 0 || answer.level_b != 0) return text("exact on levels (%d, %d)", answer.level_a, answer.level_b);
  return "";
}

}  // namespace

Subject make_subject(std::vector<Vec3> points, Model model) {
  const auto less = [](const Vec3& p, const Vec3& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::vector<Vec3> sorted = points;
  std::sort(sorted.begin(), sorted.end(), less);
  for (const Vertex& v : model.level(0).view.vertices) {
    if (!std::binary_search(sorted.begin(), sorted.end(), Vec3(v.x, v.y, v.z), less))
      throw std::logic_error(text("level 0 has the vertex (%a, %a, %a), which was not given", v.x, v.y, v.z));
  }
  double extent = 0;
  for (const Vec3& p : points) extent = std::max(extent, p.lpNorm<Eigen::Infinity>());
  return {std::move(points), std::move(model), extent};
}

std::vector<Vec3> vertices_of(const ConvexView& view, FeatureId feature) {
  std::vector<Vec3> points;
  const auto add = [&](std::uint32_t v) { points.emplace_back(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z); };
  const std::uint32_t i = feature.index();
  if (feature.kind() == FeatureKind::Vertex && i < view.vertices.size()) {
    add(i);
  } else if (feature.kind() == FeatureKind::Edge && i < view.half_edges.size()) {
    add(view.half_edges[i].head), add(view.half_edges[view.half_edges[i].twin].head);
  } else if (feature.kind() == FeatureKind::Face && i < view.face_first.size()) {
    for (std::size_t h = 0; h < view.half_edges.size(); ++h)
      if (view.half_edges[h].face == i) add(view.half_edges[h].head);
  }
  return points;
}

Judge::Judge(const Subject& a, const Subject& b, const Pose& b_in_a) : a_(a), b_(b), b_in_a_(b_in_a) {
  size_ = std::max(a.extent, b.extent) + b_in_a.translation.norm();
  // The factor covers the rounding of this product.
  law_two_ = (64 * kEpsilon + 2 * orthonormality_error(b_in_a.rotation)) * size_ * (1 + 8 * kEpsilon);
}

const oracle::Truth& Judge::truth() {
  if (!has_truth_) truth_ = oracle::distance(a_.points, b_.points, b_in_a_);
  has_truth_ = true;
  return truth_;
}

std::string Judge::too_high(const Answer& answer) const {
  if (oracle::is_apart_along(a_.points, b_.points, b_in_a_, answer.normal, answer.lower)) return "";
  const oracle::Interval gap = oracle::gap(a_.points, b_.points, b_in_a_, answer.normal);
  return text("lower is %a, the gap along the normal %a", answer.lower, gap.lower);
}

std::string Judge::interval(const Answer& answer, const OverlapProof& proof) {
  if (answer.status == Status::InvalidPose || answer.status == Status::NotConverged)
    return text("the status is %d", int(answer.status));
  if (answer.is_signed) return signed_interval(answer, proof);
  if (!(answer.lower >= 0 && answer.upper >= answer.lower && std::isfinite(answer.lower)))
    return text("[%a, %a] is no interval", answer.lower, answer.upper);
  if (answer.level_a < 0 || answer.level_a >= a_.model.level_count() || answer.level_b < 0 ||
      answer.level_b >= b_.model.level_count())
    return text("levels (%d, %d) do not exist", answer.level_a, answer.level_b);
  if (answer.lower > 0) {
    const double square = answer.normal.squaredNorm();
    if (!(std::fabs(square - 1) <= 8 * kEpsilon)) return text("|normal|^2 - 1 is %g", square - 1);
    if (std::string wrong = too_high(answer); !wrong.empty()) return wrong;
  }
  if (a_.model.level_count() == 1 && b_.model.level_count() == 1 &&
      answer.steps > step_limit(a_.model.level(0), b_.model.level(0)))
    return text("%u steps", answer.steps);
  std::string wrong = proved_verdict(answer, proof);
  return wrong.empty() ? upper_bound(answer) : wrong;
}

std::string Judge::upper_bound(const Answer& answer) {
  if (std::isinf(answer.upper) || (answer.verdict == Verdict::Overlapping && !has_truth_)) return "";
  if (!has_truth_ && answer.level_a == 0 && answer.level_b == 0) {
    const std::vector<Vec3> feature_a = vertices_of(a_.model.level(0).view, answer.feature_a);
    const std::vector<Vec3> feature_b = vertices_of(b_.model.level(0).view, answer.feature_b);
    if (!feature_a.empty() && !feature_b.empty() && oracle::is_within(feature_a, feature_b, b_in_a_, answer.upper)) return "";
  }
  if (oracle::holds(truth(), answer.lower, answer.upper)) return "";
  return text("[%a, %a] does not hold the distance %a", answer.lower, answer.upper, truth().distance);
}

std::string Judge::proved_overlap(const Answer& answer, const OverlapProof& proof) const {
  const auto &a = a_.model.level(0).view.vertices, &b = b_.model.level(0).view.vertices;
  if (answer.level_a != 0 || answer.level_b != 0 || proof.count != 4) return "overlap without a proof on level 0";
  std::array<Point, 4> differences;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t i = proof.vertex_a[k], j = proof.vertex_b[k];
    if (i >= a.size() || j >= b.size()) return "the proof of overlap names no vertex";
    differences[k] = difference({a[i].x, a[i].y, a[i].z}, {b[j].x, b[j].y, b[j].z}, b_in_a_);
  }
  return holds_origin(differences) ? "" : "the proof of overlap does not hold the origin";
}

std::string Judge::proved_verdict(const Answer& answer, const OverlapProof& proof) {
  switch (answer.verdict) {
    case Verdict::Undecided: break;
    case Verdict::Disjoint:
      if (!(answer.lower > 0)) return "disjoint without a lower bound";
      if (has_truth_ && truth_.overlapping) return "disjoint, but they overlap";
      break;
    case Verdict::Touching: {
      if (!(answer.upper <= law_two_)) return text("touching with an upper bound of %g, law 2's is %g", answer.upper, law_two_);
      if (!(std::fabs(answer.normal.squaredNorm() - 1) <= 8 * kEpsilon)) return "touching without a unit normal";
      if (!oracle::is_apart_along(a_.points, b_.points, b_in_a_, answer.normal, -law_two_))
        return text("touching, but %g deep along the normal, law 2's bound is %g",
                    -oracle::gap(a_.points, b_.points, b_in_a_, answer.normal).upper, law_two_);
      break;
    }
    case Verdict::Overlapping:
      if (answer.lower != 0 || answer.upper != 0) return text("overlapping, but [%g, %g]", answer.lower, answer.upper);
      return proved_overlap(answer, proof);
  }
  return "";
}

std::string Judge::exact(const Answer& answer, const OverlapProof& proof) {
  if (std::string wrong = interval(answer, proof); !wrong.empty()) return wrong;
  if (std::string wrong = unsettled(answer); !wrong.empty()) return wrong;
  if (answer.is_signed) return signed_exact(answer);
  if (!(answer.upper - answer.lower <= law_two_))
    return text("%g wide, law 2 allows %g", answer.upper - answer.lower, law_two_);
  return answer.verdict == Verdict::Overlapping ? "" : witnesses(answer);
}

std::string Judge::witnesses(const Answer& answer) {
  const Vec3 &p = answer.point_a, &q = answer.point_b;
  if (!p.allFinite() || !q.allFinite()) return "a witness point is not finite";
  if (const double apart = (q - p).norm(); !(apart >= answer.lower - 2 * law_two_ && apart <= answer.upper + law_two_))
    return text("the points are %a apart, the interval is [%a, %a]", apart, answer.lower, answer.upper);
  // Those of a touching pair may lie against the normal, as deep as it overlaps: their distance is then 0.
  const bool against = answer.verdict == Verdict::Touching && (q - p).dot(answer.normal) < 0;
  const double distance = against ? 0 : (q - p).norm();
  // Their rounding in doubles is a few eps of the points.
  const double aside = ((q - p) - distance * answer.normal).norm();
  if (!(aside <= law_two_ + 16 * kEpsilon * size_))
    return text("the points differ by their distance times the normal only within %g, law 2's bound is %g", aside, law_two_);
  if (!within_law_two(p, vertices_of(a_.model.level(0).view, answer.feature_a), {}))
    return "point_a is not on its feature of A";
  if (!within_law_two(q, vertices_of(b_.model.level(0).view, answer.feature_b), b_in_a_))
    return "point_b is not on its feature of B";
  return "";
}

bool Judge::within_law_two(const Vec3& p_a, std::span<const Vec3> points, const Pose& pose) const {
  return !points.empty() && oracle::is_within({&p_a, 1}, points, pose, law_two_);
}

std::string Judge::coarse(const Answer& answer, const OverlapProof& proof) {
  if (std::string wrong = interval(answer, proof); !wrong.empty()) return wrong;
  if (answer.status != Status::Converged && answer.status != Status::LevelLimit)
    return text("the status is %d", int(answer.status));
  const Level &a = a_.model.level(answer.level_a), &b = b_.model.level(answer.level_b);
  const Vec3 &p = answer.point_a, &q = answer.point_b;
  if (!p.allFinite() || !q.allFinite()) return "a witness point is not finite";
  if (!within_law_two(p, bodies::points_of(a.view), {})) return "point_a is not on its level of A";
  if (!within_law_two(q, bodies::points_of(b.view), b_in_a_)) return "point_b is not on its level of B";
  const double error = a.deviation + b.deviation + 2 * law_two_;
  const double apart = (q - p).norm(), least = std::max(answer.lower - error, -answer.upper - 2 * law_two_),
               most = std::max(answer.upper, -answer.lower) + error;
  return least <= apart && apart <= most ? "" : text("the points are %a apart, not %a to %a", apart, least, most);
}

std::string Judge::verdict(const Answer& answer, const OverlapProof& proof) {
  if (std::string wrong = interval(answer, proof); !wrong.empty()) return wrong;
  if (answer.status != Status::Converged) return text("the status is %d", int(answer.status));
  return answer.verdict == Verdict::Undecided ? "no verdict" : "";
}

std::string Judge::signed_interval(const Answer& answer, const OverlapProof& proof) {
  if (!(answer.upper >= answer.lower)) return text("[%a, %a] is no interval", answer.lower, answer.upper);
  if (std::isfinite(answer.lower)) {
    const double square = answer.normal.squaredNorm();
    if (!(std::fabs(square - 1) <= 8 * kEpsilon)) return text("|normal|^2 - 1 is %g", square - 1);
    if (std::string wrong = too_high(answer); !wrong.empty()) return wrong;
  }
  return signed_upper_bound(answer, proof);
}

std::string Judge::signed_upper_bound(const Answer& answer, const OverlapProof& proof) {
  if (answer.verdict == Verdict::Touching && !(answer.lower <= law_two_ && answer.upper >= -law_two_))
    return text("touching with [%g, %g], law 2's bound is %g", answer.lower, answer.upper, law_two_);
  if (answer.upper >= 0) {
    if (answer.verdict == Verdict::Overlapping && proof.count == 4) return proved_overlap(answer, proof);
    if (answer.verdict == Verdict::Disjoint && !(answer.lower > 0)) return "disjoint without a lower bound";
    if (!has_truth_ && answer.level_a == 0 && answer.level_b == 0) {
      const std::vector<Vec3> feature_a = vertices_of(a_.model.level(0).view, answer.feature_a);
      const std::vector<Vec3> feature_b = vertices_of(b_.model.level(0).view, answer.feature_b);
      if (!feature_a.empty() && !feature_b.empty() && oracle::is_within(feature_a, feature_b, b_in_a_, answer.upper)) return "";
    }
    if (oracle::holds(truth(), 0, answer.upper)) return "";
    return text("upper is %a, the distance %a", answer.upper, truth().distance);
  }
  if (answer.verdict == Verdict::Disjoint) return "disjoint, but below 0";
  if (-answer.upper <= least_depth_) return "";
  if (const auto n = shallower(a_, b_, b_in_a_, -answer.upper)) {
    const oracle::Interval gap = oracle::gap(a_.points, b_.points, b_in_a_, n->isZero() ? Vec3(1, 0, 0) : *n);
    return text("upper is %a, but along (%a, %a, %a) the gap is %a", answer.upper, (*n)[0], (*n)[1], (*n)[2], gap.lower);
  }
  least_depth_ = -answer.upper;
  return "";
}

std::string Judge::signed_exact(const Answer& answer) {
  const double width = answer.verdict == Verdict::Touching ? 2 * law_two_ : law_two_;  // a depth and a distance
  if (!(answer.upper - answer.lower <= width)) return text("%g wide, law 2 allows %g", answer.upper - answer.lower, width);
  const Vec3 &p = answer.point_a, &q = answer.point_b;
  if (!p.allFinite() || !q.allFinite()) return "a witness point is not finite";
  const bool apart = answer.verdict != Verdict::Overlapping;  // deep inside, points may be of vertices that no feature holds
  const double aside = ((q - p) - (answer.lower + answer.upper) / 2 * answer.normal).norm();
  if (!(aside <= 2 * law_two_ + 16 * kEpsilon * size_))
    return text("the points differ by the signed distance times the normal only within %g, law 2's bound is %g", aside,
                law_two_);
  const auto features =
      std::pair(vertices_of(a_.model.level(0).view, answer.feature_a), vertices_of(b_.model.level(0).view, answer.feature_b));
  if (!within_law_two(p, features.first, {}) && (apart || !within_law_two(p, a_.points, {}))) return "point_a is not on A";
  if (!within_law_two(q, features.second, b_in_a_) && (apart || !within_law_two(q, b_.points, b_in_a_)))
    return "point_b is not on B";
  return "";
}

std::string Judge::decision(const Within& within, double threshold, const OverlapProof& proof) {
  const Answer& answer = within.answer;
  if (std::string wrong = interval(answer, proof); !wrong.empty()) return wrong;
  if (answer.status != Status::Converged) return text("the status is %d", int(answer.status));
  switch (within.decision) {
    case Decision::Yes:
      // The bound is carried by the answer; where it is too wide for that, the truth decides.
      if (answer.upper <= threshold || oracle::holds(truth(), 0, threshold)) return "";
      return text("the distance %a is not within %a", truth().distance, threshold);
    case Decision::No:
      if (answer.lower > threshold || !oracle::holds(truth(), 0, threshold)) return "";
      return text("the distance %a is within %a", truth().distance, threshold);
    case Decision::Undecided: break;
  }
  // Both bounds within law 2's of the threshold say that the distance is.
  if ((threshold >= answer.upper - law_two_ && threshold <= answer.lower + law_two_) ||
      oracle::holds(truth(), std::max(0.0, threshold - law_two_), threshold + law_two_))
    return "";
  return text("undecided whether [%a, %a] is within %a", answer.lower, answer.upper, threshold);
}

}  // namespace swiftlet::stability
