// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where a march starts: from stored features, from the line of centres, from a table. Knows levels and links, walks nothing.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "scene.h"

namespace swiftlet {

/// A feature pair and the levels it lies on.
struct Place {
  int level_a, level_b;
  MarchStart start;
  std::uint32_t trial_steps = ~0u;  ///< after which the coarsest pair is tried instead
};

/// The start as features of the scene's views: what is no feature of its view, or a face against a face, becomes vertices.
/// `plane_tests` grows by the climbs along the line of centres.
MarchStart settled(const Scene& scene, const MarchStart& start, std::uint32_t& plane_tests);

/// From the centre of A to that of B in A's frame, and back in B's.
struct Line {
  Vec in_a, in_b;
};
Line line_of_centres(const Model& a, const Model& b, const Motion& b_in_a);

/// Where a query begins.
Place first_place(const Model& a, const Model& b, const Line& line, const PairSeed& seed, const QueryOptions& options);

/// Notes the line of centres and the direction of an answer in the seed; and the latter as it was noted.
void remember(const Line& line, const Vec& normal, PairSeed& seed);
Vec direction(const PairSeed& seed);

/// Whether a handle, of any bits, is a feature of the view.
bool names_feature(const ConvexView& view, Handle feature);

/// The finest level of a model that a query may read.
int finest_allowed(const Model& model, const QueryOptions& options);

/// The coarsest pair, from nothing.
Place coarsest_place(const Model& a, const Model& b);

/// The feature one level finer, or coarser.
Handle child(const Model& model, int level, Handle feature);
Handle parent(const Model& model, int level, Handle feature);

/// A vertex of `level` that is about the farthest in a direction. The model has support maps.
std::uint32_t about_farthest(const Model& model, int level, const Vec& direction);

/// The vertex of level `finer` that stands for one of `level`.
std::uint32_t descendant(const Model& model, int level, std::uint32_t vertex, int finer = 0);

}  // namespace swiftlet
