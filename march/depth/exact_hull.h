// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of few points, grown point by point [Preparata & Shamos 1985, sec. 3.4.3]. The exact sign of a determinant of
// the given points tells on which side of a facet a point lies, so that nearly coplanar points are no special case. A new point
// replaces the facets that it is strictly above by a cone over their border; these facets are connected and have one border.
// Some corners may be ideal points, which are infinitely far along a direction: the hull is then unbounded along these. Knows
// points, nothing of bodies.
#pragma once

#include <array>
#include <cstdint>

#include "numeric/exact.h"
#include "numeric/tolerance.h"
#include "numeric/vec.h"
#include "numeric/wide.h"

namespace swiftlet {

/// A triangle of the hull, counter-clockwise seen from outside. Coplanar triangles are not merged.
struct HullFacet {
  Vec normal;  ///< unit, outward; accurate to 3 u if `is_sharp`
  /// Of its plane above the origin: exact::Plane's if `is_sharp`, else a lower bound. Infinite: the facet is gone, or all of
  /// its corners are ideal.
  double height;
  double above;   ///< a value of the caller (`set_above`); infinite in a new facet
  bool is_sharp;  ///< `normal` and `height` are rounded from the exact plane, not computed in doubles
  std::array<std::uint8_t, 3> corner;
  std::array<std::uint8_t, 3> beside;  ///< entry k: the facet across the edge from corner k to the next corner
};

class ExactHull {
 public:
  static constexpr int kMostPoints = kDepthPoints, kMostFacets = 2 * kMostPoints - 4;

  /// Starts with the tetrahedron of four points that do not lie in one plane: they become corners 0 to 3.
  void begin(const std::array<Vec, 4>& points);
  /// Starts with the cone of all that lies from `point` along positive combinations of three directions: these become corners 0
  /// to 2, which are ideal, and `point` corner 3. The hull's height along n is finite only if no n . direction is above 0.
  void begin(const std::array<Vec, 3>& directions, const Vec& point);

  /// A facet that `p` is strictly above, or -1 if there is none.
  int seen_from(const Vec& p) const;
  /// True if `p` is strictly above `facet`.
  bool sees(int facet, const Vec& p) const;

  /// Adds `p`, which must be strictly above `facet`, as a corner and returns its index. corner_count() must be < kMostPoints.
  int add(const Vec& p, int facet);

  /// Returns the facet whose plane is lowest above the origin, made sharp.
  int lowest();
  /// Makes a facet sharp and returns it.
  const HullFacet& sharpened(int facet);

  int corner_count() const { return corner_count_; }
  const Vec& corner(int k) const { return corner_[std::size_t(k)]; }
  /// Facets have indices below this; some of them may be gone.
  int facet_count() const { return facet_count_; }
  bool is_gone(int k) const { return facet_[std::size_t(k)].height == kInfinity; }
  /// True if a corner is ideal: it has a direction in place of a point.
  bool is_ideal(std::uint8_t corner) const { return corner < ideal_count_; }
  bool has_ideal(const HullFacet& f) const { return is_ideal(f.corner[0]) || is_ideal(f.corner[1]) || is_ideal(f.corner[2]); }
  void set_above(int k, double above) { facet_[std::size_t(k)].above = above; }
  const HullFacet& facet(int k) const { return facet_[std::size_t(k)]; }

 private:
  using Index = std::uint8_t;
  void begin_tetrahedron(bool turned);
  std::array<Index, 3> ideal_last(const HullFacet& f) const;
  void stand(HullFacet& f) const;
  void sharpen(HullFacet& f) const;

  int corner_count_ = 0, facet_count_ = 0, free_count_ = 0;
  int ideal_count_ = 0;                  ///< the first corners are ideal: three or none
  std::array<Vec, kMostPoints> corner_;  ///< points; of ideal corners, directions
  std::array<HullFacet, kMostFacets> facet_;
  std::array<Index, kMostFacets> free_;  ///< indices of facets that are gone, to be used again
};

}  // namespace swiftlet
