// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The contact face of a body as a loop of corners seen along a normal. Knows one body of a pair.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/model.h>

#include "numeric/tolerance.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// What is seen along a unit normal: points of the common frame by two coordinates across it.
struct Projection {
  explicit Projection(const Vec& n, const Vec& middle);
  Vec n, u, v;  ///< right-handed
  Vec middle;   ///< at (0, 0); near what is looked at, so that little is lost
};

struct FaceCorner {
  Vec p;                    ///< common frame
  double x, y;              ///< across the normal
  std::uint32_t vertex;     ///< of the body
  std::uint32_t half_edge;  ///< leaves the corner along the outline; kNone of a point
};

/// Either sense of rotation; not quite convex where faces are flat only nearly.
struct ContactFace {
  std::uint32_t face = kNone;  ///< around which it lies; kNone: the body has no faces
  double facing = 0;           ///< cosine between the face's normal and the direction it was looked for
  int count = 0;
  std::array<FaceCorner, kMostCorners> corners;
  const FaceCorner& operator[](int i) const { return corners[std::size_t(i)]; }
  int after(int i) const { return i + 1 == count ? 0 : i + 1; }
};

/// The outline of the faces within `flatness` times the extent of that face at `feature` which faces along n (A) or against it
/// (B); `before`, a face of the body, is preferred as long as none faces better. A body without faces is its own outline.
void contact_face_a(const PairView& pair, const Projection& projection, FeatureId feature, FeatureId before, double flatness,
                    ContactFace& outline);
void contact_face_b(const PairView& pair, const Projection& projection, FeatureId feature, FeatureId before, double flatness,
                    ContactFace& outline);

}  // namespace swiftlet
