// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is asked about every pose. Knows the true distance of the pose and Question.
#pragma once

#include <array>
#include <cstring>

#include "method.h"

namespace swiftlet::bench::mesh {

struct Asked {
  const char* name;
  Kind kind;
  double factor = 0;    ///< of Within: the threshold as a multiple of the true distance
  double relative = 0;  ///< of Distance

  Question question(double truth) const { return {kind, factor * truth, relative}; }
  /// Thresholds are those of bodies that are apart.
  bool concerns(double truth) const { return kind != Kind::Within || truth > 0; }
};

inline constexpr std::array kAsked{Asked{"intersects", Kind::Intersects},        Asked{"within0.8", Kind::Within, 0.8},
                                   Asked{"within1.25", Kind::Within, 1.25},      Asked{"distance10%", Kind::Distance, 0, 0.1},
                                   Asked{"distance1%", Kind::Distance, 0, 0.01}, Asked{"distance", Kind::Distance}};

inline const Asked* asked_by_name(const char* name) {
  for (const Asked& asked : kAsked)
    if (std::strcmp(asked.name, name) == 0) return &asked;
  return nullptr;
}

}  // namespace swiftlet::bench::mesh
