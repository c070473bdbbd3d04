// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A triangle as a projection along a contact normal shows it, and where two of them face each other.
#pragma once

#include "boxes.h"
#include "manifold/candidates.h"
#include "mesh_tolerance.h"

namespace swiftlet {

/// A projection of A's frame along a unit normal: x and y across it, z along it, `middle` at 0. Turned so that a side along an
/// axis of A's frame is at right angles to none of the directions that `Farthest` looks along.
struct NormalView {
  NormalView(const Vec& along, const Vec& about) : n(along), middle(about) {
    const Vec u = normalised(cross(least_axis(n), n)), v = cross(n, u);
    x = u * kSweepCos + v * kSweepSin, y = v * kSweepCos - u * kSweepSin;
  }
  Vec at(const Vec& p) const {
    const Vec way = p - middle;
    return {dot(x, way), dot(y, way), dot(n, way)};
  }
  Vec point(const Vec& seen) const { return middle + x * seen.x + y * seen.y + n * seen.z; }

  Vec x, y, n, middle;
};

/// A triangle, or one of a fan over a convex body's contact face.
struct Facet {
  Vec at[3];            ///< corners, projected
  FeatureId vertex[3];  ///< their names
  FeatureId side[3];    ///< names of the sides from each to the next; none of a diagonal
  FeatureId face;
  double area = 0;          ///< twice the projected area, positive if counter-clockwise
  bool is_face = false;     ///< it is not seen from the side: what lies over it has a height
  Box box;                  ///< around the corners
  std::uint64_t names = 0;  ///< one bit for each name's index, modulo 64
  bool is_fan = false;      ///< it stands for a whole fan, and has the box and the bits of all of that alone

  /// Sets area, face, box and bits from the corners and names.
  void measure();
  /// Whether the feature may be one of those that it names.
  bool may_name(FeatureId feature) const;
};

/// Calls `add(candidate)` for each place where the facets face each other: corners of one over the other, and sides that cross.
/// What lies aside of a facet by less than `bound` counts as over it.
template <class Add>
void face_each_other(const Facet& a, const Facet& b, double bound, const Add& add);

/// Coordinates of a point beside a facet's first corner, as shares of both sides from there.
struct Shares {
  double first, second;
};
/// Whether a place is over a facet, up to `bound`, and where.
bool is_over(const Facet& facet, const Vec& place, double bound, Shares& shares);
/// Whether two sides cross, up to `bound`, and at which shares of each.
bool cross_at(const Vec& p, const Vec& to_p, const Vec& q, const Vec& to_q, double bound, Shares& shares);

template <class Add>
void face_each_other(const Facet& a, const Facet& b, double bound, const Add& add) {
  const auto height = [](const Facet& f, const Shares& s) {
    return f.at[0].z + ((f.at[1].z - f.at[0].z) * s.first + (f.at[2].z - f.at[0].z) * s.second);
  };
  Shares s;
  for (int k = 0; k < 3; ++k) {
    if (b.is_face && is_over(b, a.at[k], bound, s)) add({a.at[k], height(b, s) - a.at[k].z, {a.vertex[k], b.face}});
    if (a.is_face && is_over(a, b.at[k], bound, s)) {
      const double z = height(a, s);
      add({{b.at[k].x, b.at[k].y, z}, b.at[k].z - z, {a.face, b.vertex[k]}});
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (a.side[i].kind() == FeatureKind::None) continue;
    for (int k = 0; k < 3; ++k) {
      if (b.side[k].kind() == FeatureKind::None) continue;
      const Vec &p = a.at[i], &to_p = a.at[(i + 1) % 3], &q = b.at[k], &to_q = b.at[(k + 1) % 3];
      if (!cross_at(p, to_p, q, to_q, bound, s)) continue;
      const Vec on_a = p + (to_p - p) * s.first;
      add({on_a, q.z + (to_q.z - q.z) * s.second - on_a.z, {a.side[i], b.side[k]}});
    }
  }
}

/// Keeps the few candidates that reach farthest, the deepest, and those that `previous` names.
class Farthest {
 public:
  Farthest(const Manifold& previous, double bound);

  /// Whether a candidate of these facets may change what is kept: their boxes and names tell. Of many triangles of a flat
  /// contact few do.
  bool may_take(const Facet& a, const Facet& b) const;
  void add(const Candidate& candidate);
  /// The least separation of all; infinite if there are none.
  double least() const { return count_ == 0 ? HUGE_VAL : deepest_.separation; }
  /// Hands them on.
  void give(Candidates& candidates) const;

 private:
  static constexpr int kHalf = 8;  ///< directions of half a turn
  bool is_known(const Candidate& candidate) const;
  /// Whether, of two candidates at one place, the first is to stay.
  bool is_better(const Candidate& candidate, const Candidate& than) const;

  const Manifold& previous_;
  const double bound_;
  int count_ = 0, known_count_ = 0;
  Candidate deepest_, at_[2 * kHalf], known_[kMostManifoldPoints];
  double far_[2 * kHalf];
};

}  // namespace swiftlet
