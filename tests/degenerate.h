// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Arrays on both sides of the border between convex bodies and all else: vertices in one plane, on one line, in one place or on
// a small lattice; closed spheres of random triangles; hulls with one thing wrong. Truth is integer arithmetic, which shares
// nothing with march. Knows no CGAL.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <swiftlet/model.h>

#include "bodies.h"

namespace swiftlet::degenerate {

/// One level's arrays, and what is known of them.
struct Arrays {
  bodies::Polyhedron body;
  std::vector<std::uint32_t> child_vertex, child_of_face, vertex_source, face_source_begin, face_source;
  std::vector<std::array<int, 3>> lattice;  ///< integers that an affine map took to the body's points; empty: not known

  LevelArrays level() const;
};

/// What is given to Model::from_levels.
struct Case {
  std::vector<Arrays> levels;  ///< finest first
  ModelOptions options;
  bool convex = false;    ///< level 0 is a convex body by construction, and all else is in order
  bool moderate = false;  ///< sizes of level 0 in different directions differ by at most 2^40
};

/// The case of a number, always the same.
Case make(std::uint64_t number);

/// What became of a case.
struct Outcome {
  bool accepted = false;
  std::string refusal;  ///< the library's sentence
  std::string fault;    ///< what is wrong with the outcome; empty: nothing
};

/// Builds the model; verifies it, loads it again and with forged vertices, and asks for distances and signed ones to other
/// bodies and itself.
Outcome judge(const Case& given);

}  // namespace swiftlet::degenerate
