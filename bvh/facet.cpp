// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "facet.h"

#include <algorithm>
#include <iterator>

namespace swiftlet {
namespace {

/// Cosines of 8 directions, 22.5 degrees apart.
constexpr double kCos[] = {1, 0.92387953251128674,  0.70710678118654752,  0.38268343236508977,
                           0, -0.38268343236508977, -0.70710678118654752, -0.92387953251128674};

/// Their sines, of which none is negative.
double sine(int i) { return i < 4 ? kCos[4 - i] : kCos[i - 4]; }

std::uint64_t bit_of(FeatureId feature) { return std::uint64_t(1) << feature.index() % 64; }
PlanePoint flat(const Vec& v) { return {v.x, v.y}; }

}  // namespace

void Facet::measure() {
  const PlanePoint u = flat(at[1]) - flat(at[0]), v = flat(at[2]) - flat(at[0]), w = v - u;
  area = cross(u, v);
  box = {least_of(least_of(at[0], at[1]), at[2]), most_of(most_of(at[0], at[1]), at[2])};
  is_face = std::fabs(area) > kNarrowest * max(max(dot(u, u), dot(v, v)), dot(w, w));
  names = bit_of(face);
  for (int k = 0; k < 3; ++k) names |= bit_of(vertex[k]) | bit_of(side[k]);
}

bool Facet::may_name(FeatureId feature) const {
  if (!(names & bit_of(feature))) return false;
  return is_fan || feature == face || std::find(vertex, vertex + 3, feature) != vertex + 3 ||
         std::find(side, side + 3, feature) != side + 3;
}

bool is_over(const Facet& facet, const Vec& place, double bound, Shares& shares) {
  const PlanePoint p = flat(place), first = flat(facet.at[0]), u = flat(facet.at[1]) - first, v = flat(facet.at[2]) - first;
  const double sign = facet.area < 0 ? -1 : 1;
  for (int k = 0; k < 3; ++k) {
    const PlanePoint from = flat(facet.at[k]), side = flat(facet.at[(k + 1) % 3]) - from;
    const double beside = sign * cross(side, p - from);
    if (beside < 0 && beside * beside > bound * bound * dot(side, side)) return false;
  }
  // Beyond a sharp corner a place may be near the lines of both sides.
  const Box& box = facet.box;
  if (place.x < box.least.x - bound || place.x > box.most.x + bound || place.y < box.least.y - bound ||
      place.y > box.most.y + bound)
    return false;
  shares = {cross(p - first, v) / facet.area, cross(u, p - first) / facet.area};
  return true;
}

bool cross_at(const Vec& p, const Vec& to_p, const Vec& q, const Vec& to_q, double bound, Shares& shares) {
  const PlanePoint d = flat(to_p) - flat(p), e = flat(to_q) - flat(q), way = flat(q) - flat(p);
  const double dd = dot(d, d), ee = dot(e, e), sine = cross(d, e);
  if (!(sine * sine > kNarrowest * kNarrowest * dd * ee)) return false;
  const double s = cross(way, e) / sine, t = cross(way, d) / sine;
  const auto beside = [bound](double share, double square) {
    const double out = share < 0 ? -share : share - 1;
    return out > 0 && out * out * square > bound * bound;
  };
  if (beside(s, dd) || beside(t, ee)) return false;
  shares = {min(max(s, 0), 1), min(max(t, 0), 1)};
  return true;
}

Farthest::Farthest(const Manifold& previous, double bound) : previous_(previous), bound_(bound) {}

bool Farthest::may_take(const Facet& a, const Facet& b) const {
  const Vec least = most_of(a.box.least, b.box.least), most = least_of(a.box.most, b.box.most);
  if (least.x > most.x + bound_ || least.y > most.y + bound_) return false;
  if (count_ == 0 || b.box.least.z - a.box.most.z < deepest_.separation - bound_) return true;
  const double x = (least.x + most.x) / 2, y = (least.y + most.y) / 2, half_x = (most.x - least.x) / 2 + bound_,
               half_y = (most.y - least.y) / 2 + bound_;
  for (int i = 0; i < kHalf; ++i) {
    const double along = x * kCos[i] + y * sine(i), half = half_x * std::fabs(kCos[i]) + half_y * sine(i);
    if (half + along >= far_[i] - bound_ || half - along >= far_[i + kHalf] - bound_) return true;
  }
  const auto first = previous_.points.begin();
  return std::any_of(first, first + std::min(previous_.count, kMostManifoldPoints),
                     [&](const ManifoldPoint& p) { return a.may_name(p.feature_a) && b.may_name(p.feature_b); });
}

bool Farthest::is_known(const Candidate& candidate) const {
  const auto first = previous_.points.begin();
  return std::any_of(first, first + std::min(previous_.count, kMostManifoldPoints),
                     [&](const ManifoldPoint& p) { return Names(p) == candidate.names; });
}

bool Farthest::is_better(const Candidate& candidate, const Candidate& than) const {
  if (std::fabs(candidate.separation - than.separation) > bound_) return candidate.separation < than.separation;
  return !is_known(than) && is_known(candidate);
}

void Farthest::add(const Candidate& candidate) {
  if (count_ == 0 || candidate.separation < deepest_.separation) deepest_ = candidate;
  for (int i = 0; i < kHalf; ++i) {
    const double along = candidate.on_a.x * kCos[i] + candidate.on_a.y * sine(i);
    for (const bool back : {false, true}) {
      const int k = back ? i + kHalf : i;
      const double far = back ? -along : along;
      if (count_ > 0 && far <= far_[k] + bound_ && (far < far_[k] - bound_ || !is_better(candidate, at_[k]))) continue;
      far_[k] = count_ > 0 ? max(far_[k], far) : far, at_[k] = candidate;
    }
  }
  ++count_;
  if (!is_known(candidate)) return;
  const auto same = std::find_if(known_, known_ + known_count_, [&](const Candidate& c) { return c.names == candidate.names; });
  if (same == known_ + known_count_ && known_count_ < int(kMostManifoldPoints)) known_[known_count_++] = candidate;
}

void Farthest::give(Candidates& candidates) const {
  if (count_ > 0) {
    // One that is deepest by rounding alone would take a corner's place.
    const auto is_as_deep = [&](const Candidate& c) { return c.separation <= deepest_.separation + bound_; };
    if (std::none_of(std::begin(at_), std::end(at_), is_as_deep)) candidates.add(Border::Left, deepest_, true);
    for (const Candidate& c : at_) candidates.add(Border::Left, c, true);
    for (int i = 0; i < known_count_; ++i) candidates.add(Border::Left, known_[i], false);
  }
  candidates.close();
}

}  // namespace swiftlet
