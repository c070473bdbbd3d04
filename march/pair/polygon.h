// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A face of many sides, and where a point or an edge over it leaves its prism: the space above the face's plane and between the
// planes at right angles to it through its sides. All is in the body's own frame, so that no corner is carried out of it.
//
// The corners are those of an exactly convex body, but in the face's plane rounding may leave a few of them in one line or
// inside of it. So a side counts as passed only where the point is beside it: see `beside`.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "body/half_edge.h"
#include "numeric/tolerance.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {

/// Four sides of a face, or fewer, of which the last is repeated. `uu` are the squared lengths of the sides. `beyond` is how
/// far a point is outside the prism's planes through the sides, and `slope` how much farther outside another one is; both are
/// times the lengths of the side and of the face's normal.
struct Sides {
  Vec4 uu, beyond, slope;
  /// Greatest for the side nearest to the point, of those that it is beyond. Of a triangle that is the one which it is beyond
  /// by most: it is beyond two only across their common corner, and then the foot on the other one is that corner.
  Vec4 nearness() const { return max(beyond, all(0)) / uu * beyond; }  // so, as eighth powers of small lengths underflow
};
/// The same of a face of more sides, where the side that a point is beyond by most may end far from it.
struct SidesOfMany : Sides {
  V3<Vec4> u, to_point;  ///< along each side, and from its beginning to the point
  Vec4 nearness() const {
    const Vec4 along = dot(to_point, u), past = max(max(-along, along - uu), all(0));
    return where_positive(beyond, -(beyond / uu * beyond + past / uu * past), all(-kInfinity));
  }
};

/// Where a point is over a face.
struct Look {
  std::uint32_t side = kNone;     ///< the side nearest to it, of those that it is beyond; kNone if it is inside the prism
  bool at_all = true;             ///< it is not beyond any side that was not looked at
  bool well_inside = true;        ///< false if the point below may be outside a face of many corners by rounding
  std::uint32_t nearest = kNone;  ///< of a face of many sides, the one to look near next time
  std::uint32_t tests = 0;
};

/// Makes `out` the side that is nearest to the point, if it is beyond one and nearer to it than `nearness` tells. By the
/// paper's rule that is the first one.
template <bool first_only, class AnySides>
static inline void go_out(const AnySides& sides, const auto& half_edge, double& nearness, std::uint32_t& out) {
  const unsigned outside = greater(sides.beyond, all(0));
  if (outside == 0 || (first_only && out != kNone)) return;
  if (first_only) {
    out = half_edge(std::countr_zero(outside));
    return;
  }
  const Vec4 near = sides.nearness();
  const double nearest = greatest(near);
  if (!(nearest > nearness)) return;
  out = half_edge(std::countr_zero(equal(near, all(nearest))));
  nearness = nearest;
}

/// Where p + x e leaves a prism: at x = `at`, through `side`; not before x = 1 if that is kNone. Where p is outside, at 0
/// through the side nearest to it.
struct Exit {
  double at = 1;
  std::uint32_t side = kNone;
  std::uint32_t nearest = kNone;  ///< of a face of many sides, the one that p + e is near
  std::uint32_t tests = 0;
  /// If `inside`, p is beyond some sides by rounding only, and leaves by others.
  template <bool first_only, bool inside>
  void pass(const auto& sides, const auto& half_edge, double& nearness) {
    const unsigned outside = greater(sides.beyond, all(0));
    if (!inside && outside != 0) {
      at = 0;
      go_out<first_only>(sides, half_edge, nearness, side);
      return;
    }
    int lane = -1;
    for (unsigned leaving = greater(sides.beyond + sides.slope, all(0)) & ~outside; leaving != 0; leaving &= leaving - 1) {
      const int i = std::countr_zero(leaving);
      const double beyond = sides.beyond[i], slope = sides.slope[i];
      if (-beyond < at * slope) at = -beyond / slope, lane = i;
    }
    if (lane >= 0) side = half_edge(lane);
  }
};

/// A face of more than three sides. Functions that look at many of them are no part of the walk's code, since registers are
/// spilled around their loops.
class Polygon {
 public:
  /// `first` is a half-edge of the face, and `normal` its unit normal. Of a rim (ConvexView::rims) sides are found by halving.
  Polygon(const ConvexView& view, std::uint32_t first, const Vec4& normal, bool is_rim)
      : view_(view), first_(first), is_rim_(is_rim), normal_(vec(normal)) {}

  /// Looks where `p` is: near side `known`, if that is one; else of a rim at the sides where halving leads, of another face at
  /// all. It is well inside if it is so by more than `margin`.
  template <bool first_only>
  [[gnu::noinline, gnu::flatten]] Look look(Vec p, double margin, std::uint32_t known) const {
    Look look;
    if (known == kNone && is_rim_) {
      const OnRim at = on_rim(p, margin);
      if (!at.inside) look = look_nearby(p, at.side);
      look.nearest = at.side;
      look.at_all = true, look.well_inside = at.well_inside;
      look.tests += at.tests;
    } else {
      look = known != kNone ? look_nearby(p, known) : look_around<first_only>(p, margin);
    }
    if (look.side == kNone) return look;
    const std::uint32_t side = beside(look.side, p);
    if (side != look.side) look.side = is_beyond(side, p) ? side : kNone;
    return look;
  }

  /// Looks where p + x e leaves the prism, at the same sides. If p is beyond side `from`, it is so by rounding, and leaves by
  /// that side only if nothing else is left.
  template <bool first_only>
  [[gnu::noinline, gnu::flatten]] Exit exit(Vec p, Vec e, std::uint32_t known, std::uint32_t from) const {
    Exit exit;
    std::uint32_t tests = 0;
    if (known == kNone && is_rim_) {
      const OnRim end = on_rim(p + e, 0);
      exit.nearest = known = end.side, exit.tests = tests = end.tests;
      if (end.inside) return exit;
    }
    exit = known != kNone ? exit_nearby(p, e, known) : exit_by_any<first_only, false>(p, e);
    exit.tests += tests;
    if (exit.side == kNone) return exit;
    const std::uint32_t side = beside(exit.side, p + e * exit.at);
    if (exit.at == 0 && (side == from || (side != exit.side && !is_beyond(side, p)))) {
      Exit inner = exit_by_any<first_only, true>(p, e);
      inner.tests += exit.tests;
      if (from == kNone || !is_beyond(from, p + e * inner.at)) return inner;
    }
    exit.side = side;
    return exit;
  }

  /// Where a point is beside a rim: lines from corner 0 to the other corners cut the face into triangles, one for each side.
  struct OnRim {
    std::uint32_t side = kNone;  ///< that of the triangle that holds the point, or one that the point is not inside of
    bool inside = false, well_inside = false;  ///< inside the face, and by more than the margin
    std::uint32_t tests = 0;
  };
  /// Finds the triangle by halving. A point in it is in the face, whatever the other sides are.
  OnRim on_rim(const Vec& p, double margin) const {
    const std::uint32_t root = origin(view_, first_), last = origin(view_, previous_in_face(view_, first_)) - root;
    const Vertex* corners = &view_.vertices[root];
    const Vec corner_0 = vec(corners[0]), along = cross(p - corner_0, normal_);
    OnRim at;
    // How far to the left of the line from corner 0 to another the point is, and of a side, for both times its length.
    struct Left {
      double of, length2;
      bool by(double least) const { return of > 0 && of * of > least * least * length2; }
      Left reversed() const { return {-of, length2}; }
    };
    const auto left_of_line = [&](std::uint32_t k) {
      const Vec way = vec(corners[k]) - corner_0;
      ++at.tests;
      return Left{dot(way, along), dot(way, way)};
    };
    const auto left_of_side = [&](std::uint32_t k) {
      const Vec tail = vec(corners[k]), way = vec(corners[k == last ? 0 : k + 1]) - tail;
      ++at.tests;
      return Left{dot(p - tail, cross(normal_, way)), dot(way, way)};
    };
    std::uint32_t from = 1, to = last;
    while (to - from > 1) {
      const std::uint32_t middle = (from + to) / 2;
      (left_of_line(middle).of > 0 ? from : to) = middle;
    }
    const Left of_first = left_of_side(0), of_last = left_of_side(last), of_side = left_of_side(from);
    at.side = corners[!(of_first.of > 0) ? 0 : !(of_last.of > 0) ? last : from].ring_begin;
    at.inside = of_first.of > 0 && of_last.of > 0 && of_side.of > 0;
    at.well_inside = at.inside && of_first.by(margin) && of_last.by(margin) && of_side.by(margin);
    // Where the point is nearer to a line than the margin, the side beyond the line counts too.
    for (std::uint32_t k = from; at.well_inside && k > 1 && !left_of_line(k).by(margin); --k)
      at.well_inside = left_of_side(k - 1).by(margin);
    for (std::uint32_t k = from + 1; at.well_inside && k < last && !left_of_line(k).reversed().by(margin); ++k)
      at.well_inside = left_of_side(k).by(margin);
    return at;
  }

 private:
  Vec tail(std::uint32_t side) const { return vec(view_.vertices[origin(view_, side)]); }
  Vec way(std::uint32_t side) const { return vec(view_.vertices[view_.half_edges[side].head]) - tail(side); }

  template <bool first_only>
  Look look_around(const Vec& p, double margin) const {
    Look look;
    std::uint32_t nearest = kNone;
    double nearness = -kInfinity, least2 = kInfinity;
    look.tests = each_side(p, {0, 0, 0}, [&](const SidesOfMany& sides, const auto& half_edge) {
      const Vec4 distance2 = sides.beyond / sides.uu * sides.beyond;
      look.well_inside &= greater(all(0), sides.beyond) == 15 && greater(distance2, all(margin * margin)) == 15;
      if (const double least = -greatest(-distance2); least < least2)
        least2 = least, nearest = half_edge(std::countr_zero(equal(distance2, all(least))));
      go_out<first_only>(sides, half_edge, nearness, look.side);
    });
    if (look.tests > kManySides && !first_only) look.nearest = look.side != kNone ? look.side : nearest;
    return look;
  }
  Look look_nearby(const Vec& p, std::uint32_t side) const {
    Look look;
    look.at_all = false;
    double nearness = -kInfinity;
    look.nearest = climb(p, {0, 0, 0}, side, [&](const Side& seen, std::uint32_t half_edge) {
      ++look.tests;
      return seen.rank(half_edge, nearness, look.side);
    });
    return look;
  }

  /// If `inside`, by those sides that p is not beyond.
  template <bool first_only, bool inside>
  Exit exit_by_any(const Vec& p, const Vec& e) const {
    Exit exit;
    double nearness = -kInfinity;
    exit.tests = each_side(p, e, [&](const SidesOfMany& sides, const auto& half_edge) {
      exit.pass<first_only, inside>(sides, half_edge, nearness);
    });
    return exit;
  }
  Exit exit_nearby(const Vec& p, const Vec& e, std::uint32_t side) const {
    Exit exit;
    double nearness = -kInfinity;
    exit.nearest = climb(p, e, side, [&](const Side& seen, std::uint32_t half_edge) {
      ++exit.tests;
      if (seen.beyond > 0)
        exit.at = 0;
      else if (seen.beyond + seen.slope > 0 && -seen.beyond < exit.at * seen.slope)
        exit.at = -seen.beyond / seen.slope, exit.side = half_edge;
      return seen.rank(half_edge, nearness, exit.side);
    });
    if (exit.side != kNone) exit.nearest = exit.side;
    return exit;
  }

  /// Calls visit(sides, half_edge) for all sides of the face and returns their number: half_edge(i) is the side in lane i.
  /// `beyond` is of p, `slope` of p + e.
  template <class Visit>
  std::uint32_t each_side(const Vec& p, const Vec& e, Visit visit) const {
    const ConvexView& view = view_;
    V3<Vec4> normal = repeated(normal_), from = repeated(p), way = repeated(e);
    std::array<std::uint32_t, 4> sides;
    std::array<const Vertex*, 4> tail, head;
    const Vertex* corner = &view.vertices[origin(view, first_)];
    std::uint32_t h = first_, count = 0;
    do {
      for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0 && h == first_) {
          sides[i] = sides[i - 1], tail[i] = tail[i - 1], head[i] = head[i - 1];
          continue;
        }
        sides[i] = h, tail[i] = corner, head[i] = corner = &view.vertices[view.half_edges[h].head];
        h = next_in_face(view, h);
        ++count;
      }
      V3<Vec4> tails = transposed(*tail[0], *tail[1], *tail[2], *tail[3]),
               u = transposed(*head[0], *head[1], *head[2], *head[3]) - tails, out = cross(u, normal), to_point = from - tails;
      visit(SidesOfMany{{dot(u, u), dot(to_point, out), dot(way, out)}, u, to_point},
            [&](int i) { return sides[std::size_t(i)]; });
    } while (h != first_);
    return count;
  }

  /// One side, as `Sides` has four.
  struct Side {
    double uu, beyond, slope;
    double along;  ///< how far p is from the side's beginning on, times the side's length
    /// Makes `out` this side if p is beyond it and nearer to it than `nearness` tells. The rank is the higher, the nearer that
    /// is; of sides that p is not beyond, which rank lower, it is the higher, the farther p + e is beyond them.
    std::pair<bool, double> rank(std::uint32_t half_edge, double& nearness, std::uint32_t& out) const {
      if (!(beyond > 0)) return {false, (beyond + slope) / uu * std::fabs(beyond + slope)};
      const double past = max(max(-along, along - uu), 0.0), near = -(beyond / uu * beyond + past / uu * past);
      if (near > nearness) nearness = near, out = half_edge;
      return {true, near};
    }
  };
  /// Looks at side `from` and the next ones on either hand, as long as rank(side, half_edge) rises, and returns the last that
  /// did.
  template <class Rank>
  std::uint32_t climb(const Vec& p, const Vec& e, std::uint32_t from, Rank rank) const {
    const auto look = [&](std::uint32_t h) {
      const Vec u = way(h), out = cross(u, normal_), to_point = p - tail(h);
      return rank(Side{dot(u, u), dot(to_point, out), dot(e, out), dot(to_point, u)}, h);
    };
    auto most = look(from);
    const auto follow = [&](auto next) {
      for (std::uint32_t h = next(view_, from);; h = next(view_, from)) {
        const auto at = look(h);
        if (!(at > most)) return;
        most = at, from = h;
      }
    };
    follow(next_in_face), follow(previous_in_face);
    return from;
  }

  /// The side that a point on the line of side `h`, or beyond it, is beside: `h`, or, where it is past a blunt end of that, a
  /// side after that end. Where corners are in one line but for rounding, the line of another side may be passed first.
  std::uint32_t beside(std::uint32_t h, const Vec& p) const {
    Vec u = way(h);
    double along = dot(p - tail(h), u);
    const bool back = along < 0;
    while (back ? along < 0 : along > dot(u, u)) {
      const std::uint32_t other = back ? previous_in_face(view_, h) : next_in_face(view_, h);
      const Vec v = way(other);
      if (dot(u, v) <= 0) break;
      h = other, u = v, along = dot(p - tail(h), u);
    }
    return h;
  }
  bool is_beyond(std::uint32_t h, const Vec& p) const { return dot(p - tail(h), cross(way(h), normal_)) > 0; }

  const ConvexView& view_;
  std::uint32_t first_;
  bool is_rim_;
  Vec normal_;
};

}  // namespace
}  // namespace swiftlet
