// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The incident outline is clipped by the sides of the reference [Sutherland & Hodgman 1974], which decides nothing but what the
// corners of the intersection are. Where they lie follows from what they are, by convex combinations of vertices, so that no
// point leaves its body.
//
//     r3__________r2     r: corners of the reference, i: of the incident outline. Left are the corner i2 over the reference
//      |    i2    |      face and the crossings x of two sides each; a corner of the reference stays where the incident
//      |   /  \   |      face covers it.
//     r0__x____x__r1     The reference is the one that is seen flatter: its sides have clear directions, while the incident
//        /      \        one may be seen as a line.
//      i0--------i1
#include "manifold/clip.h"

#include <limits>

#include "body/half_edge.h"

namespace swiftlet {
namespace {

/// What a corner of the intersection is: corner `incident` where reference is none, corner `reference` where incident is none,
/// else the crossing of the sides that leave both.
struct Mark {
  static constexpr int kNo = -1;
  int incident, reference;
};

/// A corner of what is left, and what the side that leaves it lies on.
struct Left {
  double x, y;
  Mark corner, side;
};

/// What a side lies on.
struct SideLine {
  double px, py, nx, ny;
  double height(const Left& c) const { return nx * (c.x - px) + ny * (c.y - py); }  ///< positive inside
};

/// The sides of an outline that count: corners that stand out by no more than a bound are none.
class Reference {
 public:
  Reference(const ContactFace& outline, double bound) : outline_(outline), bound_(bound), sense_(sense(outline)) {
    for (int k = 0, i = rightmost(outline); k < outline.count; ++k, i = outline.after(i)) {
      while (count_ > 1 && flat(index_[at(count_ - 2)], index_[at(count_ - 1)], i)) --count_;
      index_[at(count_++)] = i;
    }
    while (count_ > 2 && flat(index_[at(count_ - 2)], index_[at(count_ - 1)], index_[0])) --count_;
  }

  int sides() const { return count_ > 1 ? count_ : 0; }
  const FaceCorner& corner(int side) const { return outline_[index_[at(side)]]; }
  const FaceCorner& next_corner(int side) const { return corner(next(side)); }
  /// Of the outline's sides that this one stands for, the one that a place on it belongs to, by the corner it leaves.
  int part(int side, double x, double y) const {
    const FaceCorner &p = corner(side), &q = next_corner(side);
    const auto before = [&](const FaceCorner& c) { return (q.x - p.x) * (c.x - x) + (q.y - p.y) * (c.y - y) < 0; };
    int i = index_[at(side)];
    while (outline_.after(i) != index_[at(next(side))] && before(outline_[outline_.after(i)])) i = outline_.after(i);
    return i;
  }
  int nearest_corner(double x, double y) const {
    const auto distance2 = [&](int i) {
      const double dx = corner(i).x - x, dy = corner(i).y - y;
      return dx * dx + dy * dy;
    };
    int nearest = 0;
    for (int i = 1; i < count_; ++i) {
      if (distance2(i) < distance2(nearest)) nearest = i;
    }
    return nearest;
  }
  SideLine line(int side) const {
    const FaceCorner &p = corner(side), &q = next_corner(side);
    const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy), unit = length > 0 ? sense_ / length : 0;
    return {p.x, p.y, -dy * unit, dx * unit};
  }

 private:
  static std::size_t at(int i) { return std::size_t(i); }
  int next(int side) const { return side + 1 == count_ ? 0 : side + 1; }
  /// A corner that stands out whatever else does.
  static int rightmost(const ContactFace& o) {
    int found = 0;
    for (int i = 1; i < o.count; ++i) {
      if (o[i].x > o[found].x) found = i;
    }
    return found;
  }
  static double sense(const ContactFace& o) {
    double area = 0;
    for (int i = 0; i < o.count; ++i) area += o[i].x * o[o.after(i)].y - o[i].y * o[o.after(i)].x;
    return area < 0 ? -1 : 1;
  }
  bool flat(int i, int j, int k) const {
    const FaceCorner &p = outline_[i], &q = outline_[j], &r = outline_[k];
    const double dx = r.x - p.x, dy = r.y - p.y;
    return sense_ * (dy * (q.x - p.x) - dx * (q.y - p.y)) <= bound_ * std::sqrt(dx * dx + dy * dy);
  }

  const ContactFace& outline_;
  double bound_, sense_;
  int count_ = 0;
  std::array<int, kMostCorners> index_;
};

/// The corners of the intersection of two outlines.
class Clip {
 public:
  Clip(const ContactFace& incident, const Reference& reference, double bound) : reference_(reference), bound_(bound) {
    for (int i = 0; i < incident.count; ++i) keep({incident[i].x, incident[i].y, {i, Mark::kNo}, {i, Mark::kNo}});
    for (int side = 0; side < reference.sides() && count_ > 0; ++side) cut(side);
  }

  int count() const { return count_; }
  const Left& operator[](int i) const { return left_[now_][std::size_t(i)]; }

 private:
  static constexpr int kMost = int(kMostCandidates);

  void keep(const Left& corner) {
    if (count_ < kMost) left_[now_][std::size_t(count_++)] = corner;
  }

  /// Each corner is judged once; what stands out by no more than the bound stays.
  void cut(int side) {
    const std::array<Left, kMost>& whole = left_[now_];
    const int size = count_;
    const SideLine line = reference_.line(side);
    std::array<double, kMost> height;
    bool is_whole = true;
    for (int i = 0; i < size; ++i) {
      height[std::size_t(i)] = line.height(whole[std::size_t(i)]);
      is_whole = is_whole && height[std::size_t(i)] >= -bound_;
    }
    if (is_whole) return;
    now_ = 1 - now_, count_ = 0;
    for (int i = 0; i < size; ++i) {
      const std::size_t k = std::size_t(i), l = std::size_t(i + 1 == size ? 0 : i + 1);
      const Left &p = whole[k], &q = whole[l];
      const bool inside = height[k] >= -bound_, next_inside = height[l] >= -bound_;
      if (inside) keep(p);
      if (inside != next_inside) {
        const double t = min(max(height[k] / (height[k] - height[l]), 0), 1);
        keep({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), cut_off(p.side, side), inside ? Mark{Mark::kNo, side} : p.side});
      }
    }
  }

  /// A side that lies on the reference's outline was cut from there before, and meets this one in a corner.
  Mark cut_off(const Mark& of, int side) const {
    if (of.reference == Mark::kNo) return {of.incident, side};
    return {Mark::kNo, of.reference == 0 && side + 1 == reference_.sides() ? 0 : side};
  }

  const Reference& reference_;
  double bound_;
  int count_ = 0, now_ = 0;
  std::array<Left, kMost> left_[2];  ///< before a cut and after it
};

// ---- Where corners lie ------------------------------------------------------------------------------------------------------

Vec between(const Vec& p, const Vec& q, double t) { return p + (q - p) * t; }

/// How far along a side the place is that is seen nearest to another: 0 at p, 1 at q.
double along(const FaceCorner& p, const FaceCorner& q, double x, double y) {
  const double dx = q.x - p.x, dy = q.y - p.y, length2 = dx * dx + dy * dy, t = (x - p.x) * dx + (y - p.y) * dy;
  return length2 > 0 && t > 0 ? min(t / length2, 1) : 0;
}

/// The point of an outline's sides that is seen nearest to a place.
Vec on_sides(const ContactFace& o, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  Vec nearest{0, 0, 0};
  for (int i = 0; i < o.count; ++i) {
    const FaceCorner &p = o[i], &q = o[o.after(i)];
    const double t = along(p, q, x, y), dx = p.x + t * (q.x - p.x) - x, dy = p.y + t * (q.y - p.y) - y;
    if (dx * dx + dy * dy < least) least = dx * dx + dy * dy, nearest = between(p.p, q.p, t);
  }
  return nearest;
}

/// The point of an outline's face over a place: between the sides to the left and to the right; where the place is not inside,
/// on the nearest side.
Vec over(const ContactFace& o, double x, double y) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  Vec p_low{0, 0, 0}, p_high{0, 0, 0};
  for (int i = 0; i < o.count; ++i) {
    const FaceCorner &p = o[i], &q = o[o.after(i)];
    if ((p.y <= y) == (q.y <= y)) continue;
    const double t = (y - p.y) / (q.y - p.y), place = p.x + t * (q.x - p.x);
    if (place < low) low = place, p_low = between(p.p, q.p, t);
    if (place > high) high = place, p_high = between(p.p, q.p, t);
  }
  return low < x && x < high ? between(p_low, p_high, (x - low) / (high - low)) : on_sides(o, x, y);
}

/// The points of two sides where they cross, as they are seen.
struct PointPair {
  Vec incident, reference;
};
PointPair side_crossing(const FaceCorner& i0, const FaceCorner& i1, const FaceCorner& r0, const FaceCorner& r1) {
  const double ix = i1.x - i0.x, iy = i1.y - i0.y, rx = r1.x - r0.x, ry = r1.y - r0.y;
  const double h0 = rx * (i0.y - r0.y) - ry * (i0.x - r0.x), h1 = rx * (i1.y - r0.y) - ry * (i1.x - r0.x);
  const double t = h0 != h1 ? h0 / (h0 - h1) : 0, s = along(r0, r1, i0.x + t * ix, i0.y + t * iy);
  // Of sides nearly parallel the first t is uncertain, the second one belongs to s.
  return {between(i0.p, i1.p, along(i0, i1, r0.x + s * rx, r0.y + s * ry)), between(r0.p, r1.p, s)};
}

FeatureId side_id(const ConvexView& view, const FaceCorner& corner) {
  if (corner.half_edge == kNone) return {FeatureKind::Vertex, corner.vertex};
  return named(view, {FeatureKind::Edge, corner.half_edge});
}
FeatureId corner_id(const FaceCorner& corner) { return {FeatureKind::Vertex, corner.vertex}; }
FeatureId face_id(const ConvexView& view, const ContactFace& outline) {
  if (outline.face != kNone) return {FeatureKind::Face, outline.face};
  return side_id(view, outline[0]);  // the whole body
}

/// Both outlines, and which of them is clipped.
class Faces {
 public:
  Faces(const PairView& pair, const Projection& projection, const ContactFace& a, const ContactFace& b, double bound)
      : pair_(pair),
        projection_(projection),
        a_(a),
        b_(b),
        a_is_reference_(std::fabs(a.facing) >= std::fabs(b.facing)),
        bound_(bound),
        reference_(a_is_reference_ ? a : b, bound) {}

  /// What stays may reach beyond a tip of the reference, or beyond the end of one that is seen as a line: then the corner there
  /// is meant.
  int corners(std::span<Candidate, kMostCandidates> candidates) const {
    const Clip clip(incident(), reference_, bound_);
    std::size_t count = 0;
    for (int i = 0; i < clip.count(); ++i) {
      Candidate c = placed(clip[i].corner, clip[i].x, clip[i].y);
      if (!fits(c)) c = placed({Mark::kNo, reference_.nearest_corner(c.x, c.y)}, c.x, c.y);
      if (fits(c)) candidates[count++] = c;
    }
    return int(count);
  }

 private:
  const ContactFace& incident() const { return a_is_reference_ ? b_ : a_; }
  const ContactFace& reference() const { return a_is_reference_ ? a_ : b_; }

  /// Whether the points lie one above the other.
  bool fits(const Candidate& c) const { return norm(c.point_b - c.point_a - projection_.n * c.separation) <= 2 * bound_; }

  /// What a mark means, seen about there.
  Candidate placed(const Mark& mark, double x, double y) const {
    const ConvexView &view_i = a_is_reference_ ? pair_.b : pair_.a, &view_r = a_is_reference_ ? pair_.a : pair_.b;
    PointPair p;
    FeatureId feature_i, feature_r;
    if (mark.reference == Mark::kNo) {
      const FaceCorner& c = incident()[mark.incident];
      p = {c.p, over(reference(), c.x, c.y)};
      feature_i = corner_id(c), feature_r = face_id(view_r, reference());
    } else if (mark.incident == Mark::kNo) {
      const FaceCorner& c = reference_.corner(mark.reference);
      p = {over(incident(), c.x, c.y), c.p};
      feature_i = face_id(view_i, incident()), feature_r = corner_id(c);
    } else {
      const int side = reference_.part(mark.reference, x, y);
      const FaceCorner &i = incident()[mark.incident], &r = reference()[side];
      p = side_crossing(i, incident()[incident().after(mark.incident)], r, reference()[reference().after(side)]);
      feature_i = side_id(view_i, i), feature_r = side_id(view_r, r);
    }
    return a_is_reference_ ? candidate(projection_, p.reference, p.incident, feature_r, feature_i)
                           : candidate(projection_, p.incident, p.reference, feature_i, feature_r);
  }

  const PairView& pair_;
  const Projection& projection_;
  const ContactFace &a_, &b_;
  bool a_is_reference_;
  double bound_;
  Reference reference_;
};

}  // namespace

Candidate candidate(const Projection& projection, const Vec& point_a, const Vec& point_b, FeatureId feature_a,
                    FeatureId feature_b) {
  const Vec seen = point_a - projection.middle;
  return {dot(projection.u, seen),
          dot(projection.v, seen),
          dot(projection.n, point_b - point_a),
          point_a,
          point_b,
          feature_a,
          feature_b};
}

int clip(const PairView& pair, const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
         std::span<Candidate, kMostCandidates> candidates) {
  return Faces(pair, projection, a, b, bound).corners(candidates);
}

}  // namespace swiftlet
