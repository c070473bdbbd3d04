// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a front keeps of two nodes: for each pair of their boxes the direction that parts it most, of those that node_pair.h
// tries, and a ball around the box of B. See FrontBounds for what that proves.
#pragma once

#include "front.h"
#include "node_pair.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

/// One bound; `h` is not yet less what B has turned.
struct PairBound {
  Float4 n, c;
  float h, r;
};

class PairBounds {
 public:
  PairBounds(const PairFrame& frame, const NodePair& pair) : frame_(frame), pair_(pair) {
    const Float4 x_a = load4(pair.a_.axis[0]), y_a = load4(pair.a_.axis[1]);
    axes_a_ = {x_a, y_a, cross(x_a, y_a)};
    const double* const b = pair.b_.origin;
    origin_b_ = float4(float(b[0]), float(b[1]), float(b[2])) * same4(pair.unit_b_);
  }

  /// How far balls of what is in the pair reach from a point of B.
  float arm(Float4 from) const {
    const Float4 way = origin_b_ - from;
    const Float4 squares = sums(way * way, pair_.extent_b_ * pair_.extent_b_, way);
    return (std::sqrt(squares[0]) + kArmOfNode * std::sqrt(squares[1])) * (1 + kBoundShare);
  }

  /// The bound of both nodes as a whole, whose gap has this square, above 0.
  PairBound whole(float square) const {
    const Float4 none{0, 0, 0, 0}, way_a = pair_.offset_a_, way_b = pair_.offset_b_;
    const Float4 gap_a = max(abs(way_a) - (pair_.extent_a_ + pair_.extent_b_in_a_), none),
                 gap_b = max(abs(way_b) - (pair_.extent_b_ + pair_.extent_a_in_b_), none);
    const Float4 squares = sums(gap_a * gap_a, gap_b * gap_b, none);
    const float gap = std::sqrt(square);
    PairBound bound;
    if (max(squares[0], squares[1]) < square) {
      bound.n = pair_.direction_;
    } else {
      const Float4 signed_b = with_sign(gap_b, way_b);
      const Float4 along_a = squares[0] >= squares[1] ? with_sign(gap_a, way_a)
                                                      : pair_.m_[0] * lane<0>(signed_b) + pair_.m_[1] * lane<1>(signed_b) +
                                                            pair_.m_[2] * lane<2>(signed_b);
      bound.n = axes_a_ * (along_a * same4(1 / gap));
    }
    bound.c = origin_b_;
    bound.r = std::sqrt(sums(pair_.extent_b_ * pair_.extent_b_, none, none)[0]) * (1 + kBoundShare);
    const Float4 at = frame_.rotation * bound.c + float4(frame_.translation);
    bound.h = sums(bound.n * at, none, none)[0] - (gap * (1 - kBoundShare) - pair_.slack_);
    return bound;
  }

  /// The balls of all children of B, or of B alone in all lanes, and where their centres are in A's frame.
  struct Balls {
    Float8 c[3], r, at[3];
  };
  Balls balls_of_children() const {
    const Float4 x = load4(pair_.b_.axis[0]), y = load4(pair_.b_.axis[1]), z = cross(x, y);
    const Float8(&own)[3] = pair_.own_b_, (&half)[3] = pair_.half_b_;
    Balls balls;
    for (int k = 0; k < 3; ++k)
      balls.c[k] = all8(origin_b_[k]) + (all8(x[k]) * own[0] + all8(y[k]) * own[1] + all8(z[k]) * own[2]);
    balls.r = sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]) * all8(1 + kBoundShare);
    return placed(balls);
  }
  Balls balls_of_all() const {
    Balls balls;
    for (int k = 0; k < 3; ++k) balls.c[k] = all8(origin_b_[k]);
    const Float4 squares = pair_.extent_b_ * pair_.extent_b_;
    balls.r = all8(std::sqrt(sums(squares, squares, squares)[0]) * (1 + kBoundShare));
    return placed(balls);
  }

  /// Eight bounds; of a pair without a gap `gap` is not above 0 and the bound none.
  struct Bounds {
    Float8 n[3], h, gap;
  };
  /// Of the children of A and all of B; of the children of B and all of A; and of these and child `i` of A.
  Bounds of_a(const Balls& balls) const {
    Gaps gaps;
    for (int k = 0; k < 3; ++k) {
      gaps.way_a[k] = all8(pair_.offset_a_[k]) - load8(pair_.own_a_[k]);
      gaps.way_b[k] = all8(0) - load8(pair_.in_b_[k]);
      gaps.along_a[k] = abs(gaps.way_a[k]) - (load8(pair_.half_a_[k]) + all8(pair_.extent_b_in_a_[k]));
      gaps.along_b[k] = abs(gaps.way_b[k]) - (load8(pair_.half_in_b_[k]) + all8(pair_.extent_b_[k]));
    }
    return bounds(balls, gaps, all8(pair_.bottom_of_b_) - load8(pair_.top_a_));
  }
  Bounds of_b(const Balls& balls) const {
    Gaps gaps;
    for (int k = 0; k < 3; ++k) {
      gaps.way_a[k] = pair_.in_a_[k], gaps.way_b[k] = pair_.own_b_[k] + all8(pair_.offset_b_[k]);
      gaps.along_a[k] = abs(gaps.way_a[k]) - (pair_.half_in_a_[k] + all8(pair_.extent_a_[k]));
      gaps.along_b[k] = abs(gaps.way_b[k]) - (pair_.half_b_[k] + all8(pair_.extent_a_in_b_[k]));
    }
    return bounds(balls, gaps, pair_.bottom_b_ - all8(pair_.top_of_a_));
  }
  Bounds of_b(const Balls& balls, int i) const {
    Gaps gaps;
    for (int k = 0; k < 3; ++k) {
      gaps.way_a[k] = pair_.in_a_[k] - all8(pair_.own_a_[k][i]), gaps.way_b[k] = pair_.own_b_[k] - all8(pair_.in_b_[k][i]);
      gaps.along_a[k] = abs(gaps.way_a[k]) - (pair_.half_in_a_[k] + all8(pair_.half_a_[k][i]));
      gaps.along_b[k] = abs(gaps.way_b[k]) - (pair_.half_b_[k] + all8(pair_.half_in_b_[k][i]));
    }
    return bounds(balls, gaps, pair_.bottom_b_ - all8(pair_.top_a_[i]));
  }

 private:
  static Float4 same4(float x) { return Float4{x, x, x, x}; }

  Balls placed(Balls balls) const {
    const Columns& r = frame_.rotation;
    const Float4 t = float4(frame_.translation);
    for (int k = 0; k < 3; ++k)
      balls.at[k] = all8(r.x[k]) * balls.c[0] + all8(r.y[k]) * balls.c[1] + all8(r.z[k]) * balls.c[2] + all8(t[k]);
    return balls;
  }

  /// Ways from boxes of A to boxes of B along the axes of each, and gaps along each axis, below 0 where boxes overlap along it.
  struct Gaps {
    Float8 way_a[3], way_b[3], along_a[3], along_b[3];
  };
  /// The gaps above 0 along the axes of one node are a vector: along it the boxes are apart by its length.
  Bounds bounds(const Balls& balls, const Gaps& gaps, Float8 ahead) const {
    Float8 by_a[3], by_b[3], square_a = all8(0), square_b = all8(0);
    for (int k = 0; k < 3; ++k) {
      const Float8 a = max(gaps.along_a[k], all8(0)), b = max(gaps.along_b[k], all8(0));
      square_a = square_a + a * a, square_b = square_b + b * b;
      by_a[k] = with_sign(a, gaps.way_a[k]), by_b[k] = with_sign(b, gaps.way_b[k]);
    }
    ahead = max(ahead, all8(0));
    const Float8 square = max(square_a, square_b), square_ahead = ahead * ahead, gap = sqrt(max(square, square_ahead));
    const Float8 share = all8(1) / max(gap, all8(kLeastBoxSlack));
    for (int k = 0; k < 3; ++k) {
      const Float8 turned = all8(pair_.m_[0][k]) * by_b[0] + all8(pair_.m_[1][k]) * by_b[1] + all8(pair_.m_[2][k]) * by_b[2];
      by_a[k] = where_at_least(square_a, square_b, by_a[k], turned) * share;
    }
    Bounds made;
    Float8 at = all8(0);
    for (int k = 0; k < 3; ++k) {
      const Float8 by_axes = all8(axes_a_.x[k]) * by_a[0] + all8(axes_a_.y[k]) * by_a[1] + all8(axes_a_.z[k]) * by_a[2];
      made.n[k] = where_at_least(square, square_ahead, by_axes, all8(pair_.direction_[k]));
      at = at + made.n[k] * balls.at[k];
    }
    made.gap = gap * all8(1 - kBoundShare) - all8(pair_.slack_);
    made.h = at - made.gap;
    return made;
  }

  const PairFrame& frame_;
  const NodePair& pair_;
  Columns axes_a_;   ///< of A's node
  Float4 origin_b_;  ///< of B's node, in B's frame
};

}  // namespace
}  // namespace swiftlet
