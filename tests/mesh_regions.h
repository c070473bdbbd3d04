// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the regions of contact of two meshes are, by brute force over all pairs of their triangles: places of pairs within reach
// are joined until none meet. Shares no code with bvh.
#pragma once

#include <string>
#include <vector>

#include <swiftlet/mesh_contacts.h>

#include "soups.h"

namespace swiftlet::soups {

/// A box along the axes, by its smallest and largest coordinates.
struct Place {
  std::array<long double, 3> least, most;
};
inline bool meet(const Place& p, const Place& q) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p.least[k] > q.most[k] || q.least[k] > p.most[k]) return false;
  return true;
}
inline bool holds(const Place& p, const Place& in, long double slack) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p.least[k] > in.least[k] + slack || p.most[k] < in.most[k] - slack) return false;
  return true;
}
inline Place place_of(const Triangle<long double>& a, const Triangle<long double>& b, long double growth) {
  const auto of = [](const Point<long double>& p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low_a, high_a] = std::minmax({of(a[0], k), of(a[1], k), of(a[2], k)});
    const auto [low_b, high_b] = std::minmax({of(b[0], k), of(b[1], k), of(b[2], k)});
    place.least[k] = std::max(low_a, low_b) - growth, place.most[k] = std::min(high_a, high_b) + growth;
  }
  return place;
}

struct BruteRegion {
  Place box;
  long double least;  ///< distance
  long pairs;
};
/// The regions of all pairs within `reach`, whose boxes are grown by `growth`.
inline std::vector<BruteRegion> brute_regions(const Soup& a, const Soup& b, const Pose& pose, long double reach,
                                              long double growth) {
  std::vector<BruteRegion> regions;
  const auto of_a = triangles<long double>(a), of_b = triangles<long double>(b, pose);
  for (const auto& s : of_a) {
    for (const auto& t : of_b) {
      const long double distance = std::sqrt(nearest(s, t).squared);
      if (distance <= reach) regions.push_back({place_of(s, t, growth), distance, 1});
    }
  }
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      for (std::size_t k = i + 1; k < regions.size();) {
        if (!meet(regions[i].box, regions[k].box)) {
          ++k;
          continue;
        }
        for (std::size_t x = 0; x < 3; ++x) {
          regions[i].box.least[x] = std::min(regions[i].box.least[x], regions[k].box.least[x]);
          regions[i].box.most[x] = std::max(regions[i].box.most[x], regions[k].box.most[x]);
        }
        regions[i].least = std::min(regions[i].least, regions[k].least);
        regions[i].pairs += regions[k].pairs;
        regions.erase(regions.begin() + std::ptrdiff_t(k));
        joined = true;
      }
    }
  }
  return regions;
}

/// What is wrong with the regions that a query found, all of them; empty if nothing is. `told` counts the cases that rounding
/// does not leave open.
inline std::string fault_of(const std::vector<MeshContact>& found, const Soup& a, const Soup& b, const Pose& pose, double reach,
                            double law_two, const MeshModel& x, const MeshModel& y, int& told) {
  const long double slack = law_two;
  const auto wide = brute_regions(a, b, pose, reach + slack, reach + 2 * slack),
             narrow = brute_regions(a, b, pose, std::max(reach - slack / 16, 0.0L), reach);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const MeshContact& region = found[i];
    Place box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.least[k] = region.box_min[std::ptrdiff_t(k)], box.most[k] = region.box_max[std::ptrdiff_t(k)];
    }
    if (!(region.lower >= 0 && region.lower <= region.upper)) return "no interval";
    if (region.upper - region.lower > law_two) return "wider than law 2's bound";
    if (region.lower > reach) return "beyond the reach";
    for (std::size_t k = i + 1; k < found.size(); ++k) {
      const Place other{{found[k].box_min.x(), found[k].box_min.y(), found[k].box_min.z()},
                        {found[k].box_max.x(), found[k].box_max.y(), found[k].box_max.z()}};
      if (meet(box, other)) return "regions that meet";
    }
    // Its nearest pair is a pair of triangles at that distance, whose place it holds.
    const auto corners = [](const MeshModel& mesh, std::uint32_t t, const Pose& in_a) {
      Triangle<long double> triangle;
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = apply<long double>(in_a, mesh.vertex(mesh.triangle(t)[k]));
      return triangle;
    };
    const auto s = corners(x, region.triangle_a, {}), t = corners(y, region.triangle_b, pose);
    const long double distance = std::sqrt(nearest(s, t).squared);
    if (distance < region.lower - slack / 16 || distance > region.upper + slack / 16) return "not the distance of its pair";
    if (!holds(box, place_of(s, t, reach), slack)) return "does not hold its pair";
    if ((region.verdict == Verdict::Disjoint) != (region.lower > 0)) return "Disjoint is said where lower is above 0";
    if (region.verdict == Verdict::Overlapping && distance > slack / 16) return "Overlapping, but its pair is apart";
    if (region.verdict == Verdict::Undecided) return "undecided";
    const Vec3 way = region.point_b - region.point_a;
    if (region.verdict != Verdict::Overlapping && std::fabs(way.norm() - region.upper) > 2 * law_two)
      return "points at another distance";
  }
  // The regions of fewer pairs are inside of these, and these inside of those of more pairs.
  for (const BruteRegion& region : narrow) {
    long held = 0;
    for (const MeshContact& f : found) {
      const Place box{{f.box_min.x(), f.box_min.y(), f.box_min.z()}, {f.box_max.x(), f.box_max.y(), f.box_max.z()}};
      if (!holds(box, region.box, slack)) continue;
      ++held;
      if (f.lower > region.least + slack / 16) return "lower is above a region's least distance";
    }
    if (held != 1) return "a region is not held by one";
  }
  if (wide.size() != narrow.size()) return {};
  ++told;
  if (found.size() != wide.size()) return "another count";
  for (const MeshContact& f : found) {
    const Place box{{f.box_min.x(), f.box_min.y(), f.box_min.z()}, {f.box_max.x(), f.box_max.y(), f.box_max.z()}};
    const auto same = std::find_if(wide.begin(), wide.end(), [&](const BruteRegion& w) { return holds(w.box, box, slack); });
    if (same == wide.end()) return "a box larger than its pairs";
    if (f.lower > same->least + slack / 16) return "lower is above the truth";
    if (f.upper < same->least - slack / 16) return "upper is below the truth";
  }
  return {};
}

}  // namespace swiftlet::soups
