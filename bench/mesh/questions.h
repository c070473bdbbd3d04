// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is asked about the poses of a scene. Knows the true distance of a pose, Scene and Question.
#pragma once

#include <array>
#include <cstring>

#include "method.h"
#include "scenes.h"

namespace swiftlet::bench::mesh {

struct Asked {
  const char* name;
  Kind kind;
  double factor = 0;    ///< of Within: the threshold as a multiple of the true distance
  double relative = 0;  ///< of Distance

  static constexpr double kReach = 0.01;  ///< of contacts near each other, in radii
  bool is_apart() const { return kind <= Kind::Distance; }
  /// Contacts are those of bodies that are pressed into each other, or near.
  bool concerns(const Scene& scene) const {
    if (scene.stance == Stance::Deep) return kind == Kind::SignedDistance;
    if (scene.stance == Stance::Pressed) return !is_apart();
    return is_apart() || (kind != Kind::SignedDistance && scene.stance == Stance::Near);
  }
  Question question(const Scene& scene, double truth) const {
    return {kind, is_apart() ? factor * truth : scene.stance == Stance::Near ? kReach * scene.radius : 0, relative};
  }
  /// Thresholds are those of bodies that are apart.
  bool concerns(double truth) const { return kind != Kind::Within || truth > 0; }
};

inline constexpr std::array kAsked{Asked{"intersects", Kind::Intersects},
                                   Asked{"within0.8", Kind::Within, 0.8},
                                   Asked{"within1.25", Kind::Within, 1.25},
                                   Asked{"distance10%", Kind::Distance, 0, 0.1},
                                   Asked{"distance1%", Kind::Distance, 0, 0.01},
                                   Asked{"distance", Kind::Distance},
                                   Asked{"contacts", Kind::Contacts},
                                   Asked{"manifolds", Kind::Manifolds},
                                   Asked{"signed", Kind::SignedDistance}};

inline const Asked* asked_by_name(const char* name) {
  for (const Asked& asked : kAsked)
    if (std::strcmp(asked.name, name) == 0) return &asked;
  return nullptr;
}

}  // namespace swiftlet::bench::mesh
