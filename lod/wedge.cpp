// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Planes with the triangle on one side and the wedge on the other decide most; else the triangle is clipped in rationals. The
// relative interior of what is left lies in the interior of one face of the wedge: only that face's place in the hull counts.
#include "wedge.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "numeric/exact.h"
#include "wedge_tolerance.h"

namespace swiftlet::lod {
namespace {

using Exact = CGAL::Exact_rational;
using Exact3 = V3<Exact>;

constexpr unsigned kSideFace[3] = {0b1011, 0b1110, 0b1101}, kBase = 0b0111;

bool is_same(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Corners in common are the rule, and the exact sign of 0 is dear.
int orientation(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  return is_same(a, d) || is_same(b, d) || is_same(c, d) ? 0 : exact::orientation(a, b, c, d);
}

/// On which side of the wedge's face k a point lies: positive outside. Face 3 is the base.
int outside(const Wedge& w, int k, const Vec& p) {
  const auto& c = w.corner;
  return k == 3 ? -orientation(c[0], c[1], c[2], p) : orientation(c[std::size_t(k)], c[std::size_t((k + 1) % 3)], c[3], p);
}

/// What planes tell; nothing where they do not.
class ByPlanes {
 public:
  ByPlanes(const Corners3& triangle, const Wedge& wedge) : t_(triangle), w_(wedge) {}

  std::optional<bool> answer() {
    if (is_beyond_triangle() || is_beyond_face()) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (sign_[0][i] < 0 && sign_[1][i] < 0 && sign_[2][i] < 0 && sign_[3][i] < 0) return true;
    }
    bool shares = false;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (!is_same(t_[i], w_.corner[k])) continue;
        shares = true;
        if (is_beyond_corner(i, k)) return false;
      }
    }
    // Two convex bodies that share a corner, one of them solid, are parted by a plane through two edges from there or not at
    // all.
    if (shares && !is_parted_ && !is_slit_) return true;
    if (!shares && are_apart()) return false;
    return std::nullopt;
  }

 private:
  /// Notes that a plane parts the two, which meet in no more than this face of the wedge.
  bool parted(unsigned face) {
    is_parted_ = true;
    return w_.is_outer(face);
  }
  bool is_beyond_face() {
    for (int k = 0; k < 4; ++k) {
      int least = 1;
      for (std::size_t i = 0; i < 3; ++i) least = std::min(least, sign_[k][i] = outside(w_, k, t_[i]));
      if (least > 0 || (least == 0 && parted(k == 3 ? kBase : kSideFace[k]))) return true;
    }
    return false;
  }
  bool is_beyond_triangle() {
    int least = 1, most = -1;
    unsigned face = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const int side = orientation(t_[0], t_[1], t_[2], w_.corner[k]);
      least = std::min(least, side), most = std::max(most, side);
      face |= unsigned(side == 0) << k;
    }
    is_slit_ = least == 0 && most == 0;
    return !is_slit_ && (least >= 0 || most <= 0) && parted(face);
  }
  /// By planes through the common corner, an edge of the triangle and one of the wedge.
  bool is_beyond_corner(std::size_t i, std::size_t k) {
    for (const std::size_t edge : {(i + 1) % 3, (i + 2) % 3}) {
      const Vec& rest = t_[3 - i - edge];
      for (std::size_t m = 0; m < 4; ++m) {
        if (m == k) continue;
        int least = 1, most = -1;
        unsigned face = 0;
        for (std::size_t n = 0; n < 4; ++n) {
          const int side = n == k || n == m ? 0 : orientation(w_.corner[k], t_[edge], w_.corner[m], w_.corner[n]);
          least = std::min(least, side), most = std::max(most, side);
          face |= unsigned(side == 0) << n;
        }
        if (face == 0b1111 || (least < 0 && most > 0)) continue;
        const int side = orientation(w_.corner[k], t_[edge], w_.corner[m], rest);
        if (side * (least < 0 ? -1 : 1) <= 0 && parted(face)) return true;
      }
    }
    return false;
  }
  /// By more than rounding, along a direction at right angles to two edges.
  bool are_apart() const {
    double size = 0;
    for (const Vec& p : t_) size = max(size, max_abs(p));
    for (const Vec& p : w_.corner) size = max(size, max_abs(p));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t m = k + 1; m < 4; ++m) {
          const Vec n = cross(t_[(i + 1) % 3] - t_[i], w_.corner[m] - w_.corner[k]);
          const double slack = kHeightsError * norm_1(n) * size;
          double low_t = HUGE_VAL, high_t = -HUGE_VAL, low_w = HUGE_VAL, high_w = -HUGE_VAL;
          for (const Vec& p : t_) low_t = min(low_t, dot(n, p)), high_t = max(high_t, dot(n, p));
          for (const Vec& p : w_.corner) low_w = min(low_w, dot(n, p)), high_w = max(high_w, dot(n, p));
          if (low_t > high_w + slack || low_w > high_t + slack) return true;
        }
      }
    }
    return false;
  }

  const Corners3& t_;
  const Wedge& w_;
  int sign_[4][3] = {};  ///< of each corner of the triangle, which side of each face
  bool is_parted_ = false, is_slit_ = false;
};

Exact3 exact3(const Vec& p) { return {Exact(p.x), Exact(p.y), Exact(p.z)}; }

/// The part of a convex polygon, which may be a segment or a point, where a linear function is not negative.
template <class Point, class Height>
std::vector<Point> clipped(const std::vector<Point>& polygon, const Height& height) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Exact at_p = height(p), at_q = height(q);
    if (at_p >= 0) kept.push_back(p);
    if (CGAL::sign(at_p) * CGAL::sign(at_q) < 0) kept.push_back(p + (q - p) * Exact(at_p / (at_p - at_q)));
  }
  return kept;
}

/// A point of the relative interior, times the number of corners.
Exact3 sum(const std::vector<Exact3>& polygon) {
  Exact3 total = polygon.front();
  for (std::size_t i = 1; i < polygon.size(); ++i) total = total + polygon[i];
  return total;
}

bool enters_exactly(const Corners3& triangle, const Wedge& wedge) {
  std::vector<Exact3> left;
  for (const Vec& p : triangle) left.push_back(exact3(p));
  const Exact3 corner[4] = {exact3(wedge.corner[0]), exact3(wedge.corner[1]), exact3(wedge.corner[2]), exact3(wedge.corner[3])};
  const auto inward = [&](std::size_t k) {
    const Exact3 &a = corner[k == 3 ? 0 : k], &b = corner[k == 3 ? 1 : (k + 1) % 3], &c = corner[k == 3 ? 2 : 3];
    const Exact3 n = cross(b - a, c - a);
    return k == 3 ? n : -n;
  };
  for (std::size_t k = 0; k < 4 && !left.empty(); ++k) {
    const Exact3 n = inward(k), at = corner[k == 3 ? 0 : k];
    left = clipped(left, [&](const Exact3& p) { return dot(n, p - at); });
  }
  if (left.empty()) return false;
  const Exact count = Exact(double(left.size()));
  const Exact3 total = sum(left);
  unsigned face = 0b1111;
  for (std::size_t k = 0; k < 4; ++k) {
    if (dot(inward(k), total - corner[k == 3 ? 0 : k] * count) == 0) face &= k == 3 ? kBase : kSideFace[k];
  }
  return !wedge.is_outer(face);
}

/// Whether the relative interior of a part of the wedge's plane, given by its corners, is inside of the new hull.
bool enters_exactly(std::vector<Exact3> left, const FlatWedge& wedge) {
  const auto coordinate = [](const Exact3& p, int k) -> const Exact& { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  const Exact3 corner[3] = {exact3(wedge.corner[0]), exact3(wedge.corner[1]), exact3(wedge.corner[2])};
  const auto height = [&](std::size_t k, const Exact3& p, const Exact& count) {
    const Exact3 along = corner[(k + 1) % 3] - corner[k], to = p - corner[k] * count;
    return Exact(coordinate(along, wedge.u) * coordinate(to, wedge.v) - coordinate(along, wedge.v) * coordinate(to, wedge.u));
  };
  for (std::size_t k = 0; k < 3 && !left.empty(); ++k)
    left = clipped(left, [&](const Exact3& p) { return height(k, p, Exact(1)); });
  if (left.empty()) return false;
  const Exact count = Exact(double(left.size()));
  const Exact3 total = sum(left);
  unsigned face = 0b111;
  for (std::size_t k = 0; k < 3; ++k) {
    if (height(k, total, count) == 0) face &= unsigned(1u << k | 1u << (k + 1) % 3);
  }
  if (face == 0b100) return false;
  for (const std::size_t k : {std::size_t(0), std::size_t(1)}) {
    if (wedge.outer[k] && (face | 1u << k | 0b100) == (1u << k | 0b100)) return false;
  }
  return true;
}

}  // namespace

bool Wedge::is_outer(unsigned face) const {
  switch (face) {
    case 0b0011: return base_outer || outer[0];
    case 0b0110: return base_outer || outer[1];
    case 0b0101: return base_outer || outer[2];
    case kBase: return base_outer;
    case kSideFace[0]: return outer[0];
    case kSideFace[1]: return outer[1];
    case kSideFace[2]: return outer[2];
    case 0b1111: return false;
    default: return true;
  }
}

Outline::Outline(const Wedge& wedge, double size) : corner_(wedge.corner), is_outer_{true, true, true, true}, corners_(4) {
  const auto& c = wedge.corner;
  for (std::size_t k = 0; k < 3; ++k) add(cross(c[(k + 1) % 3] - c[k], c[3] - c[k]), size);
  add(cross(c[2] - c[0], c[1] - c[0]), size);
}
Outline::Outline(const FlatWedge& wedge, double size)
    : corner_{wedge.corner[0], wedge.corner[1], wedge.corner[2]}, is_outer_{wedge.outer[0], wedge.outer[1], true}, corners_(3) {
  const auto& c = wedge.corner;
  const Vec n = cross(c[1] - c[0], c[2] - c[0]);
  for (std::size_t k = 0; k < 3; ++k) add(cross(c[(k + 1) % 3] - c[k], n), size);
  add(n, size);
}

void Outline::add(const Vec& outward, double size) {
  double most = -HUGE_VAL;
  for (std::size_t k = 0; k < corners_; ++k) most = max(most, dot(outward, corner_[k]));
  outward_[count_] = outward;
  above_[count_] = most + kHeightsError * norm_1(outward) * size;
  if (count_++ > 0) return;
  least_ = most_ = eigen(corner_[0]);
  for (std::size_t k = 1; k < corners_; ++k)
    least_ = least_.cwiseMin(eigen(corner_[k])), most_ = most_.cwiseMax(eigen(corner_[k]));
}

bool Outline::is_apart(const Vec3& least, const Vec3& most) const {
  for (int i = 0; i < 3; ++i) {
    if (least[i] > most_[i] || most[i] < least_[i]) return true;
  }
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec& n = outward_[k];
    const Vec nearest{n.x > 0 ? least[0] : most[0], n.y > 0 ? least[1] : most[1], n.z > 0 ? least[2] : most[2]};
    if (dot(n, nearest) > above_[k]) return true;
  }
  return false;
}

bool Outline::is_apart(const Corners3& t) const {
  for (std::size_t k = 0; k < count_; ++k) {
    if (min(dot(outward_[k], t[0]), min(dot(outward_[k], t[1]), dot(outward_[k], t[2]))) > above_[k]) return true;
  }
  for (std::size_t k = 0; k < corners_; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_outer_[k] && is_same(t[i], corner_[k]) && is_apart_at(k, t, i)) return true;
    }
  }
  return false;
}

/// Whether a plane through a common corner, at right angles to the difference of the two's directions from there, has all other
/// corners on its two sides.
bool Outline::is_apart_at(std::size_t corner, const Corners3& t, std::size_t at) const {
  const Vec& p = corner_[corner];
  Vec wedge{0, 0, 0}, triangle{0, 0, 0};
  for (std::size_t k = 0; k < corners_; ++k) wedge = wedge + (corner_[k] - p);
  for (const Vec& q : t) triangle = triangle + (q - p);
  const Vec n = normalised(triangle) - normalised(wedge);
  const auto height = [&](const Vec& q) {
    const Vec way = q - p, part{n.x * way.x, n.y * way.y, n.z * way.z};
    const double slack = kHeightOverError * norm_1(part), sum = part.x + part.y + part.z;
    return sum > slack ? 1 : sum < -slack ? -1 : 0;
  };
  for (std::size_t k = 0; k < corners_; ++k) {
    if (k != corner && height(corner_[k]) >= 0) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != at && height(t[i]) <= 0) return false;
  }
  return true;
}

bool Outline::is_apart_around(const Vec& hub, const Vec& least, const Vec& most) const {
  std::size_t corner = 0;
  while (corner < corners_ && !(is_outer_[corner] && is_same(corner_[corner], hub))) ++corner;
  if (corner == corners_) return false;
  Vec wedge{0, 0, 0};
  for (std::size_t k = 0; k < corners_; ++k) wedge = wedge + (corner_[k] - hub);
  wedge = normalised(wedge);
  // A plane through the hub parts the two if it has the wedge's other corners on one side and the box on the other, both by
  // more than rounding.
  const auto parts = [&](const Vec& n) {
    for (std::size_t k = 0; k < corners_; ++k) {
      const Vec way = corner_[k] - hub, part{n.x * way.x, n.y * way.y, n.z * way.z};
      const double slack = kHeightOverError * norm_1(part);
      if (k != corner && !(part.x + part.y + part.z < -slack)) return false;
    }
    const Vec low = least - hub, high = most - hub;
    const Vec part{min(n.x * low.x, n.x * high.x), min(n.y * low.y, n.y * high.y), min(n.z * low.z, n.z * high.z)};
    return part.x + part.y + part.z > kHeightOverError * norm_1(part);
  };
  // Planes of the wedge, tilted a little so that they do not meet it elsewhere.
  for (std::size_t k = 0; k < count_; ++k) {
    if (parts(normalised(outward_[k]) - wedge * kTilt)) return true;
  }
  return parts(normalised((least - hub) + (most - hub)) - wedge);
}

bool enters(const Corners3& triangle, const Wedge& wedge) {
  if (const std::optional<bool> known = ByPlanes(triangle, wedge).answer()) return *known;
  return enters_exactly(triangle, wedge);
}

bool enters(const Corners3& triangle, const FlatWedge& wedge, const Outline& outline) {
  const auto& [a, b, c] = wedge.corner;
  int least = 1, most = -1;
  std::array<int, 3> side;
  std::size_t in_plane = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    side[i] = orientation(a, b, c, triangle[i]);
    least = std::min(least, side[i]), most = std::max(most, side[i]);
    if (side[i] == 0) in_plane = i;
  }
  if (least >= 0 || most < 0) return false;
  if (most == 0) {
    // A corner or an edge lies in the plane, and nothing else.
    Corners3 part;
    for (std::size_t i = 0; i < 3; ++i) part[i] = triangle[side[i] == 0 ? i : in_plane];
    if (outline.is_apart(part)) return false;
  }
  const Exact3 at = exact3(a), n = cross(exact3(b) - at, exact3(c) - at);
  std::vector<Exact3> left;
  for (const Vec& p : triangle) left.push_back(exact3(p));
  left = clipped(left, [&](const Exact3& p) { return dot(n, p - at); });
  left = clipped(left, [&](const Exact3& p) { return Exact(-dot(n, p - at)); });
  return enters_exactly(std::move(left), wedge);
}

bool enters(const std::array<Vec, 2>& segment, const FlatWedge& wedge) {
  return enters_exactly({exact3(segment[0]), exact3(segment[1])}, wedge);
}

}  // namespace swiftlet::lod
