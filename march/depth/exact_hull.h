// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of few points, grown point by point [Preparata & Shamos 1985, sec. 3.4.3]. Every side is decided by the exact
// sign of a determinant of the points as given, so that nearly coplanar points are no special case: a new point replaces the
// facets that it is strictly above, which are connected and have one border, by a cone over that border. Knows points, nothing
// of bodies.
#pragma once

#include <array>
#include <cstdint>

#include "numeric/exact.h"
#include "numeric/tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {

/// A triangle of the hull, counter-clockwise from outside. Coplanar ones stay apart.
struct HullFacet {
  Vec normal;     ///< unit, outward; right to 3 u where `is_sharp`
  double height;  ///< of its plane above the origin, as exact::Plane's, or no more than that; infinite: the facet is gone
  double above;   ///< the caller's, infinite in a new facet
  bool is_sharp;  ///< its plane is known as well as doubles can say it, not only as computed in doubles
  std::array<std::uint8_t, 3> corner;
  std::array<std::uint8_t, 3> beside;  ///< the facet across the edge from each corner to the next
};

class ExactHull {
 public:
  static constexpr int kMostPoints = kDepthPoints, kMostFacets = 2 * kMostPoints - 4;

  /// Four points that lie in no plane: corners 0 to 3.
  void begin(const std::array<Vec, 4>& points);

  /// A facet that a point is strictly above, or -1.
  int seen_from(const Vec& p) const;
  bool sees(int facet, const Vec& p) const;

  /// Makes the point a corner, which `facet` is seen from; returns its index. There must be room: corner_count() < kMostPoints.
  int add(const Vec& p, int facet);

  /// The facet whose plane is lowest above the origin, sharp.
  int lowest();
  /// Makes a facet sharp.
  const HullFacet& sharpened(int facet);

  int corner_count() const { return corner_count_; }
  const Vec& corner(int k) const { return corner_[std::size_t(k)]; }
  /// Of facets, some of which may be gone.
  int facet_count() const { return facet_count_; }
  bool is_gone(int k) const { return facet_[std::size_t(k)].height == std::numeric_limits<double>::infinity(); }
  void set_above(int k, double above) { facet_[std::size_t(k)].above = above; }
  const HullFacet& facet(int k) const { return facet_[std::size_t(k)]; }

 private:
  using Index = std::uint8_t;
  void stand(HullFacet& f) const;
  void sharpen(HullFacet& f) const;

  int corner_count_ = 0, facet_count_ = 0, free_count_ = 0;
  std::array<Vec, kMostPoints> corner_;
  std::array<HullFacet, kMostFacets> facet_;
  std::array<Index, kMostFacets> free_;  ///< places of facets that are gone
};

}  // namespace swiftlet
