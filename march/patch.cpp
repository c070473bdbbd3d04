// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Both contact faces seen along one normal: the incident one is clipped by the sides of the reference one [Sutherland &
// Hodgman 1974], which decides nothing but what the corners of the intersection are. Where they lie follows from what they are,
// by convex combinations of vertices, so that no point leaves its body.
//
//         r3________r2         i: corners of the incident outline, r: of the reference
//          |  i3    |          what is left: i3 over the reference face, the crossings x and y of two edges,
//          |  / \   |          and r1 over the incident face. The reference is the one that is seen flatter:
//          | /   \  |          its sides have clear directions, while the incident one may be seen as a line.
//          |/     \ |
//          x       \|y
//         /|        |\         .
//        / r0_x____r1 i2
#include <swiftlet/patch.h>

#include <algorithm>
#include <limits>

#include "outline.h"
#include "ring.h"
#include "scene.h"

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
struct Line {
  double px, py, nx, ny;
  double height(const Left& c) const { return nx * (c.x - px) + ny * (c.y - py); }  ///< positive inside
};

/// The sides of an outline that count: corners that stand out by no more than a bound are none.
class Reference {
 public:
  Reference(const Outline& outline, double bound) : outline_(outline), bound_(bound), sense_(sense(outline)) {
    for (int i = 0; i < outline.count; ++i) {
      while (count_ > 1 && flat(index_[at(count_ - 2)], index_[at(count_ - 1)], i)) --count_;
      index_[at(count_++)] = i;
    }
    while (count_ > 2 && flat(index_[at(count_ - 2)], index_[at(count_ - 1)], index_[0])) --count_;
    int skipped = 0;
    while (count_ - skipped > 2 && flat(index_[at(count_ - 1)], index_[at(skipped)], index_[at(skipped + 1)])) ++skipped;
    count_ -= skipped;
    for (int i = 0; skipped > 0 && i < count_; ++i) index_[at(i)] = index_[at(i + skipped)];
  }

  int sides() const { return count_ > 1 ? count_ : 0; }
  const Corner& corner(int side) const { return outline_[index_[at(side)]]; }
  const Corner& next_corner(int side) const { return corner(side + 1 == count_ ? 0 : side + 1); }
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
  Line line(int side) const {
    const Corner &p = corner(side), &q = next_corner(side);
    const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy), unit = length > 0 ? sense_ / length : 0;
    return {p.x, p.y, -dy * unit, dx * unit};
  }

 private:
  static std::size_t at(int i) { return std::size_t(i); }
  static double sense(const Outline& o) {
    double area = 0;
    for (int i = 0; i < o.count; ++i) area += o[i].x * o[o.after(i)].y - o[i].y * o[o.after(i)].x;
    return area < 0 ? -1 : 1;
  }
  bool flat(int i, int j, int k) const {
    const Corner &p = outline_[i], &q = outline_[j], &r = outline_[k];
    const double dx = r.x - p.x, dy = r.y - p.y;
    return sense_ * (dy * (q.x - p.x) - dx * (q.y - p.y)) <= bound_ * std::sqrt(dx * dx + dy * dy);
  }

  const Outline& outline_;
  double bound_, sense_;
  int count_ = 0;
  std::array<int, kMostCorners> index_;
};

/// The corners of the intersection of two outlines.
class Clip {
 public:
  Clip(const Outline& incident, const Reference& reference, double bound) : reference_(reference), bound_(bound) {
    for (int i = 0; i < incident.count; ++i) keep({incident[i].x, incident[i].y, {i, Mark::kNo}, {i, Mark::kNo}});
    for (int side = 0; side < reference.sides() && count_ > 0; ++side) cut(side);
  }

  int count() const { return count_; }
  Mark operator[](int i) const { return left_[now_][std::size_t(i)].corner; }

 private:
  static constexpr int kMost = 2 * kMostCorners;

  void keep(const Left& corner) {
    if (count_ < kMost) left_[now_][std::size_t(count_++)] = corner;
  }

  /// Each corner is judged once; what stands out by no more than the bound stays.
  void cut(int side) {
    const std::array<Left, kMost>& whole = left_[now_];
    const int size = count_;
    now_ = 1 - now_, count_ = 0;
    const Line line = reference_.line(side);
    const double first = line.height(whole[0]);
    double height = first;
    for (int i = 0; i < size; ++i) {
      const Left &p = whole[std::size_t(i)], &q = whole[std::size_t(i + 1 == size ? 0 : i + 1)];
      const double next = i + 1 == size ? first : line.height(q);
      const bool inside = height >= -bound_, next_inside = next >= -bound_;
      if (inside) keep(p);
      if (inside != next_inside) {
        const double t = smaller(larger(height / (height - next), 0), 1);
        keep({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), cut_off(p.side, side), inside ? Mark{Mark::kNo, side} : p.side});
      }
      height = next;
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
double along(const Corner& p, const Corner& q, double x, double y) {
  const double dx = q.x - p.x, dy = q.y - p.y, length2 = dx * dx + dy * dy, t = (x - p.x) * dx + (y - p.y) * dy;
  return length2 > 0 && t > 0 ? smaller(t / length2, 1) : 0;
}

/// The point of an outline's side that is seen nearest to a place.
struct Nearest {
  Vec p{0, 0, 0};
  double distance2 = std::numeric_limits<double>::infinity();
};
Nearest on_sides(const Outline& o, double x, double y) {
  Nearest nearest;
  for (int i = 0; i < o.count; ++i) {
    const Corner &p = o[i], &q = o[o.after(i)];
    const double t = along(p, q, x, y), dx = p.x + t * (q.x - p.x) - x, dy = p.y + t * (q.y - p.y) - y,
                 distance2 = dx * dx + dy * dy;
    if (distance2 < nearest.distance2) nearest = {between(p.p, q.p, t), distance2};
  }
  return nearest;
}

/// The point of an outline's face over a place: between the sides to the left and to the right, or where there are none, or the
/// place is hardly inside, on the nearest side.
Vec over(const Outline& o, double x, double y, double bound) {
  const Nearest nearest = on_sides(o, x, y);
  if (nearest.distance2 <= bound * bound) return nearest.p;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  Vec p_low{0, 0, 0}, p_high{0, 0, 0};
  for (int i = 0; i < o.count; ++i) {
    const Corner &p = o[i], &q = o[o.after(i)];
    if ((p.y <= y) == (q.y <= y)) continue;
    const double t = (y - p.y) / (q.y - p.y), place = p.x + t * (q.x - p.x);
    if (place < low) low = place, p_low = between(p.p, q.p, t);
    if (place > high) high = place, p_high = between(p.p, q.p, t);
  }
  return low < x && x < high ? between(p_low, p_high, (x - low) / (high - low)) : nearest.p;
}

/// The points of two sides where they cross, as they are seen.
struct Pair {
  Vec incident, reference;
};
Pair crossing(const Corner& i0, const Corner& i1, const Corner& r0, const Corner& r1) {
  const double ix = i1.x - i0.x, iy = i1.y - i0.y, rx = r1.x - r0.x, ry = r1.y - r0.y;
  const double h0 = rx * (i0.y - r0.y) - ry * (i0.x - r0.x), h1 = rx * (i1.y - r0.y) - ry * (i1.x - r0.x);
  const double t = h0 != h1 ? h0 / (h0 - h1) : 0, s = along(r0, r1, i0.x + t * ix, i0.y + t * iy);
  // Of sides nearly parallel the first t is uncertain, the second one belongs to s.
  return {between(i0.p, i1.p, along(i0, i1, r0.x + s * rx, r0.y + s * ry)), between(r0.p, r1.p, s)};
}

Handle side_handle(const ConvexView& view, const Corner& corner) {
  if (corner.half_edge == kNone) return {FeatureKind::Vertex, corner.vertex};
  const std::uint32_t twin = view.twin[corner.half_edge];
  return {FeatureKind::Edge, twin < corner.half_edge ? twin : corner.half_edge};
}
Handle corner_handle(const Corner& corner) { return {FeatureKind::Vertex, corner.vertex}; }
Handle face_handle(const ConvexView& view, const Outline& outline) {
  if (outline.face != kNone) return {FeatureKind::Face, outline.face};
  return side_handle(view, outline[0]);  // the whole body
}

/// A point of the patch and where it is seen.
struct Candidate {
  double x, y, separation;
  Vec point_a, point_b;
  Handle feature_a, feature_b;
  bool known;  ///< of the patch before
};

/// All that both outlines say of one pair.
class Faces {
 public:
  Faces(const Scene& scene, const Across& across, const Outline& a, const Outline& b, double bound)
      : scene_(scene),
        across_(across),
        a_(a),
        b_(b),
        a_is_reference_(std::fabs(a.facing) >= std::fabs(b.facing)),
        bound_(bound),
        reference_(a_is_reference_ ? a : b, bound) {}

  /// Calls visit(candidate) with each corner of the intersection. What stays may reach beyond a tip of the reference, or beyond
  /// the end of one that is seen as a line: then the corner there is meant.
  template <class Visit>
  void each_corner(Visit visit) const {
    const Clip clip(incident(), reference_, bound_);
    for (int i = 0; i < clip.count(); ++i) {
      Candidate c = placed(clip[i]);
      if (!fits(c)) c = placed({Mark::kNo, reference_.nearest_corner(c.x, c.y)});
      if (fits(c)) visit(c);
    }
  }

  Candidate candidate(const Vec& p_a, const Vec& p_b, Handle feature_a, Handle feature_b) const {
    const Vec seen = p_a - across_.middle;
    return {dot(across_.u, seen), dot(across_.v, seen), dot(across_.n, p_b - p_a), p_a, p_b, feature_a, feature_b, false};
  }

 private:
  const Outline& incident() const { return a_is_reference_ ? b_ : a_; }
  const Outline& reference() const { return a_is_reference_ ? a_ : b_; }

  /// Whether the points lie one above the other.
  bool fits(const Candidate& c) const { return norm(c.point_b - c.point_a - across_.n * c.separation) <= 2 * bound_; }

  Candidate placed(const Mark& mark) const {
    const ConvexView &view_i = a_is_reference_ ? scene_.b : scene_.a, &view_r = a_is_reference_ ? scene_.a : scene_.b;
    Pair p;
    Handle feature_i, feature_r;
    if (mark.reference == Mark::kNo) {
      const Corner& c = incident()[mark.incident];
      p = {c.p, over(reference(), c.x, c.y, bound_)};
      feature_i = corner_handle(c), feature_r = face_handle(view_r, reference());
    } else if (mark.incident == Mark::kNo) {
      const Corner& c = reference_.corner(mark.reference);
      p = {over(incident(), c.x, c.y, bound_), c.p};
      feature_i = face_handle(view_i, incident()), feature_r = corner_handle(c);
    } else {
      const Corner &i = incident()[mark.incident], &r = reference_.corner(mark.reference);
      p = crossing(i, incident()[incident().after(mark.incident)], r, reference_.next_corner(mark.reference));
      feature_i = side_handle(view_i, i), feature_r = side_handle(view_r, r);
    }
    return a_is_reference_ ? candidate(p.reference, p.incident, feature_r, feature_i)
                           : candidate(p.incident, p.reference, feature_i, feature_r);
  }

  const Scene& scene_;
  const Across& across_;
  const Outline &a_, &b_;
  bool a_is_reference_;
  double bound_;
  Reference reference_;
};

// ---- Which corners stay -----------------------------------------------------------------------------------------------------

bool same_place(const PatchPoint& p, const Candidate& q) { return p.feature_a == q.feature_a && p.feature_b == q.feature_b; }

/// The corners of an intersection and one point more.
class Candidates {
 public:
  explicit Candidates(const Patch& previous) : previous_(previous) {}

  void add(Candidate c) {
    for (std::uint32_t i = 0; i < previous_.count; ++i) c.known = c.known || same_place(previous_.points[i], c);
    all_[std::size_t(count_++)] = c;
  }
  bool empty() const { return count_ == 0; }
  double least() const {
    double least = all_[0].separation;
    for (int i = 1; i < count_; ++i) least = smaller(least, all_[std::size_t(i)].separation);
    return least;
  }

  /// Fills the patch's points: one of least separation, the one farthest from it, then whichever adds most to the area; then
  /// each but the first is chosen again beside the others.
  void choose(std::uint32_t most, double margin, double bound, Patch& patch) {
    drop_beyond(margin + bound);
    if (count_ == 0 || most == 0) return;
    loop_[0] = deepest(bound);
    for (size_ = 1; size_ < int(most) && grow(bound);) {
    }
    for (int i = 1; i < size_ && size_ < count_; ++i) {
      std::copy(loop_.begin() + i + 1, loop_.begin() + size_, loop_.begin() + i);
      --size_;
      grow(bound);
    }
    for (int i = 0; i < size_; ++i) {
      const Candidate& c = chosen(i);
      patch.points[std::size_t(i)] = {eigen(c.point_a), eigen(c.point_b), c.separation, c.feature_a, c.feature_b};
    }
    patch.count = std::uint32_t(size_);
  }

 private:
  const Candidate& chosen(int i) const { return all_[std::size_t(loop_[std::size_t(i)])]; }
  static double preferred(const Candidate& c, double worth) { return c.known ? worth * (1 + kKeptWorth) : worth; }

  void drop_beyond(double separation) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (all_[std::size_t(i)].separation <= separation) all_[std::size_t(kept++)] = all_[std::size_t(i)];
    }
    count_ = kept;
  }

  int deepest(double bound) const {
    const double enough = least() + bound;
    int found = -1;
    for (int i = 0; i < count_; ++i) {
      const Candidate& c = all_[std::size_t(i)];
      if (c.separation <= enough && (found < 0 || (c.known && !all_[std::size_t(found)].known))) found = i;
    }
    return found;
  }

  /// How far a candidate lies from the only point, or the area that it adds beyond a side of those chosen; 0 where it hardly
  /// stands out.
  double worth(const Candidate& c, int side, double bound) const {
    const Candidate &p = chosen(side), &q = chosen(side + 1 == size_ ? 0 : side + 1);
    const double cx = c.x - p.x, cy = c.y - p.y, dx = q.x - p.x, dy = q.y - p.y;
    if (size_ == 1) return std::sqrt(cx * cx + cy * cy) - bound;
    const double length = std::sqrt(dx * dx + dy * dy);
    return cx * dy - cy * dx > bound * length ? cx * dy - cy * dx : 0;
  }

  /// Adds a point to those chosen, which go around counter-clockwise; false where none adds anything.
  bool grow(double bound) {
    int best = -1, best_side = 0;
    double most = 0;
    for (int i = 0; i < count_; ++i) {
      for (int side = 0; side < size_; ++side) {
        const Candidate& c = all_[std::size_t(i)];
        if (const double w = preferred(c, worth(c, side, bound)); w > most) most = w, best = i, best_side = side;
      }
    }
    if (best < 0) return false;
    std::copy_backward(loop_.begin() + best_side + 1, loop_.begin() + size_, loop_.begin() + size_ + 1);
    loop_[std::size_t(best_side + 1)] = best;
    ++size_;
    return true;
  }

  const Patch& previous_;
  int count_ = 0, size_ = 0;
  std::array<int, kMostPatchPoints> loop_;
  std::array<Candidate, 2 * kMostCorners + 1> all_;
};

/// What a patch grows from, in A's frame; the points are on the hulls.
struct Witness {
  Vec normal, point_a, point_b;
  Handle feature_a, feature_b;
};

/// The patch of two hulls, within a margin of theirs.
Patch grown(const Scene& scene, const Witness& w, double margin, double bound, const PatchOptions& options,
            const Patch& previous) {
  Patch patch;
  const Across across(w.normal, w.point_a);
  Outline a, b;
  outline_a(scene, across, w.feature_a, previous.face_a, options.flatness, a);
  outline_b(scene, across, w.feature_b, previous.face_b, options.flatness, b);
  patch.normal = eigen(w.normal);
  if (a.face != kNone) patch.face_a = {FeatureKind::Face, a.face};
  if (b.face != kNone) patch.face_b = {FeatureKind::Face, b.face};

  Candidates candidates(previous);
  const Faces faces(scene, across, a, b, bound);
  faces.each_corner([&](const Candidate& c) { candidates.add(c); });
  const Candidate witness = faces.candidate(w.point_a, w.point_b, w.feature_a, w.feature_b);
  if (candidates.empty() || witness.separation < candidates.least() - bound) candidates.add(witness);
  candidates.choose(std::min(options.most_points, kMostPatchPoints), margin, bound, patch);
  return patch;
}

template <class AnyAnswer>
Patch around(const Model& a, const Model& b, const Pose& b_in_a, const AnyAnswer& answer, const PatchOptions& options,
             const Patch& previous) {
  const Vec n = vec(answer.normal);
  if (max_abs(n) == 0 || answer.level_a != 0 || answer.level_b != 0) return {};
  const Motion m = motion(b_in_a);
  const Scene hulls = scene(a.level(0).view, b.level(0).view, m, pose_quality(m).error);
  const double radii = options.radius_a + options.radius_b;
  Patch patch = grown(hulls,
                      {n, vec(answer.point_a) - n * options.radius_a, vec(answer.point_b) + n * options.radius_b,
                       answer.feature_a, answer.feature_b},
                      options.margin + radii, hulls.law_two + kLawTwo * radii, options, previous);
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    PatchPoint& p = patch.points[i];
    p.point_a = eigen(vec(p.point_a) + n * options.radius_a);
    p.point_b = eigen(vec(p.point_b) - n * options.radius_b);
    p.separation -= radii;
  }
  return patch;
}

}  // namespace

Patch patch(const Model& a, const Model& b, const Pose& b_in_a, const SignedAnswer& answer, const PatchOptions& options,
            const Patch& previous) {
  return around(a, b, b_in_a, answer, options, previous);
}

Patch patch(const Model& a, const Model& b, const Pose& b_in_a, const Answer& answer, const PatchOptions& options,
            const Patch& previous) {
  return answer.proof.count ? Patch{} : around(a, b, b_in_a, answer, options, previous);
}

}  // namespace swiftlet
