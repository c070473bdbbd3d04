// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The contact face of a body: where its border runs. Knows one body in its own frame.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// The face at a feature that faces best along a direction, merged with the faces beside it that lie within some height of its
/// plane. They are one piece without holes, because a face enclosed by them has all its corners there too. The edge of a body
/// without faces is its border.
class ContactFace {
 public:
  /// `n`: unit, own frame, outwards. `before`, a face of the body, is preferred as long as none faces better. `flatness`: the
  /// height over the body's extent.
  ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness);

  /// The face; of a body without faces its edge, or its vertex.
  FeatureId name() const;
  /// The height within which its corners lie in one plane, a length: the border may turn inwards by about as much.
  double flatness() const { return flatness_; }
  /// A half-edge of the border, which leaves the face on its left; kNone of a point.
  std::uint32_t side() const { return side_; }
  /// The side that starts where `side` ends, and the one that ends where it starts.
  std::uint32_t next(std::uint32_t side) const;
  std::uint32_t previous(std::uint32_t side) const;

 private:
  bool holds(std::uint32_t face) const;
  bool is_left_of(std::uint32_t half_edge) const;
  std::uint32_t border() const;

  const ConvexView& view_;
  std::uint32_t top_ = kNone, side_ = kNone;
  double flatness_ = 0, least_height_ = 0;  ///< the least height along the normal
  Vec normal_{0, 0, 0};
};

}  // namespace swiftlet
