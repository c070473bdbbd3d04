// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the regions of contact of two meshes are, by brute force over all pairs of their triangles: places of pairs within reach
// are joined until none meet. What is within rounding of a region's border is decided twice, with boxes and a reach a little
// larger and with a little smaller ones: a region of the query holds those of the smaller ones, and lies in one of the larger
// ones. Shares no code with bvh.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <swiftlet/mesh_contacts.h>

#include "soups.h"

namespace swiftlet::soups {

using Real = long double;

/// The distance of a pair of triangles, by their indices, exact but for one rounding.
using ExactDistance = std::function<Real(std::size_t, std::size_t)>;

/// A box along the axes, by its smallest and largest coordinates.
struct Place {
  std::array<Real, 3> least, most;
};
inline bool meet(const Place& p, const Place& q) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p.least[k] > q.most[k] || q.least[k] > p.most[k]) return false;
  return true;
}
inline bool holds(const Place& p, const Place& in, Real slack) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p.least[k] > in.least[k] + slack || p.most[k] < in.most[k] - slack) return false;
  return true;
}
inline Place place_of(const Triangle<Real>& a, const Triangle<Real>& b, Real growth) {
  const auto of = [](const Point<Real>& p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low_a, high_a] = std::minmax({of(a[0], k), of(a[1], k), of(a[2], k)});
    const auto [low_b, high_b] = std::minmax({of(b[0], k), of(b[1], k), of(b[2], k)});
    place.least[k] = std::max(low_a, low_b) - growth, place.most[k] = std::min(high_a, high_b) + growth;
  }
  return place;
}
inline Place place_of(const MeshContact& region) {
  Place place;
  for (std::size_t k = 0; k < 3; ++k)
    place.least[k] = region.box_min[std::ptrdiff_t(k)], place.most[k] = region.box_max[std::ptrdiff_t(k)];
  return place;
}

/// A pair of triangles: bounds on its distance.
struct BrutePair {
  std::size_t i, k;
  Real lower, upper;
};
struct BruteRegion {
  Place box;
  Real lower, upper;  ///< bounds on the least distance
  std::vector<BrutePair> pairs;
};

/// Of a triangle so thin long doubles may take another direction for its normal.
inline bool is_thin(const Triangle<Real>& t) {
  const Point<Real> u = t[1] - t[0], v = t[2] - t[0], w = t[2] - t[1], normal = cross(u, v);
  const Real longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
  return dot(normal, normal) < 1e-6L * longest * longest;
}

/// All pairs of two soups, the second one moved.
class BrutePairs {
 public:
  /// Pairs whose distance long doubles know to `slack`, others as `exact` says, if it can, where they are no farther than
  /// `most`.
  BrutePairs(const Soup& a, const Soup& b, const Pose& pose, Real slack, Real most, const ExactDistance& exact)
      : of_a(triangles<Real>(a)), of_b(triangles<Real>(b, pose)) {
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t k = 0; k < of_b.size(); ++k) {
        const Nearest<Real> near = nearest(of_a[i], of_b[k]);
        const Real length = std::sqrt(near.squared);
        Real lower = 0, upper = length > 0 ? length + slack / 4 : 0;
        if (length > 0) lower = std::max<Real>(gap(of_a[i], of_b[k], near.way * (1 / length)) - slack / 4, 0);
        const bool is_sure = upper - lower <= slack && !is_thin(of_a[i]) && !is_thin(of_b[k]);
        if (!is_sure && lower <= most && exact) lower = upper = exact(i, k);
        all.push_back({i, k, lower, upper});
      }
    }
  }
  const BrutePair& of(std::size_t i, std::size_t k) const { return all[i * of_b.size() + k]; }

  /// The regions of all pairs that are `within`, whose boxes are grown by `growth`.
  template <class Within>
  std::vector<BruteRegion> regions(Real growth, const Within& within) const {
    std::vector<BruteRegion> regions;
    for (const BrutePair& pair : all) {
      if (!within(pair)) continue;
      BruteRegion joined{place_of(of_a[pair.i], of_b[pair.k], growth), pair.lower, pair.upper, {pair}};
      if (!meet(joined.box, joined.box)) continue;  // long doubles took triangles for near that are not: a box inside out
      for (std::size_t r = 0; r < regions.size();) {
        BruteRegion& other = regions[r];
        if (!meet(other.box, joined.box)) {
          ++r;
          continue;
        }
        for (std::size_t x = 0; x < 3; ++x) {
          joined.box.least[x] = std::min(joined.box.least[x], other.box.least[x]);
          joined.box.most[x] = std::max(joined.box.most[x], other.box.most[x]);
        }
        joined.lower = std::min(joined.lower, other.lower), joined.upper = std::min(joined.upper, other.upper);
        joined.pairs.insert(joined.pairs.end(), other.pairs.begin(), other.pairs.end());
        std::swap(other, regions.back());
        regions.pop_back();
        r = 0;
      }
      regions.push_back(std::move(joined));
    }
    return regions;
  }

  std::vector<Triangle<Real>> of_a, of_b;
  std::vector<BrutePair> all;
};

/// What is wrong with the regions that a query found, all of them; empty if nothing is. `told` counts the cases that rounding
/// does not leave open.
inline std::string fault_of(const std::vector<MeshContact>& found, const BrutePairs& pairs, double reach, double law_two,
                            const MeshModel& x, const MeshModel& y, int& told) {
  const Real slack = law_two, little = slack / 8, rounding = reach * 0x1p-51L;  // a box grown by far more than its size
  const auto narrow = pairs.regions(reach, [&](const BrutePair&p) { return p.upper <= reach; }),
             wide = pairs.regions(reach + 2 * slack, [&](const BrutePair&p) { return p.lower <= reach + slack; });
  for (std::size_t i = 0; i < found.size(); ++i) {
    const MeshContact& region = found[i];
    if (!(region.lower >= 0 && region.lower <= region.upper)) return "no interval";
    if (region.upper - region.lower > law_two) return "wider than law 2's bound";
    if (region.lower > reach) return "beyond the reach";
    for (std::size_t k = i + 1; k < found.size(); ++k)
      if (meet(place_of(region), place_of(found[k]))) return "regions that meet";
    // Its nearest pair is a pair of triangles at that distance, whose place it holds.
    const std::size_t s = x.source_triangle()[region.triangle_a], t = y.source_triangle()[region.triangle_b];
    const BrutePair& pair = pairs.of(s, t);
    if (pair.upper < region.lower - little || pair.lower > region.upper + little) return "not the distance of its pair";
    if (!holds(place_of(region), place_of(pairs.of_a[s], pairs.of_b[t], reach), rounding)) return "does not hold its pair";
    if ((region.verdict == Verdict::Disjoint) != (region.lower > 0)) return "Disjoint is said where lower is above 0";
    if (region.verdict == Verdict::Overlapping && pair.lower > little) return "Overlapping, but its pair is apart";
    if (region.verdict == Verdict::Undecided) return "undecided";
    const Vec3 way = region.point_b - region.point_a;
    if (region.verdict != Verdict::Overlapping && std::fabs(way.norm() - region.upper) > 2 * law_two)
      return "points at another distance";
  }
  // What is surely a region is in one of those found, and these are in what may be one.
  for (const BruteRegion& region : narrow) {
    long held = 0;
    for (const MeshContact& f : found) {
      if (!holds(place_of(f), region.box, rounding)) continue;
      ++held;
      if (f.lower > region.upper + little) return "lower is above a region's least distance";
    }
    if (held != 1) return "a region is not held by one";
  }
  for (const MeshContact& f : found) {
    const auto holder = [&](const BruteRegion& w) { return holds(w.box, place_of(f), rounding); };
    const auto same = std::find_if(wide.begin(), wide.end(), holder);
    if (same == wide.end()) return "a box larger than its pairs";
    if (f.upper < same->lower - little) return "upper is below the truth";
  }
  // A pair that rounding leaves open may count or not, and each in its own way. They cannot change the number of regions if
  // each joins one that is there without it, and no two of those are ever joined.
  const auto joins = [&](const BrutePair& pair) {
    const Place place = place_of(pairs.of_a[pair.i], pairs.of_b[pair.k], reach);
    return std::any_of(narrow.begin(), narrow.end(), [&](const BruteRegion& region) { return meet(region.box, place); });
  };
  const auto all_join = [&](const BruteRegion& region) { return std::all_of(region.pairs.begin(), region.pairs.end(), joins); };
  if (wide.size() != narrow.size() || !std::all_of(wide.begin(), wide.end(), all_join)) return {};
  ++told;
  return found.size() == wide.size() ? "" : "another count";
}

}  // namespace swiftlet::soups
