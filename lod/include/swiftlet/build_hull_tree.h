// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds the trees of hull_tree.h [Ehmann & Lin 2001, sec. 5]. A program that links the builder comes under CGAL's GPL; the
// trees it makes are the user's.
#pragma once

#include <cstdint>

#include <swiftlet/build.h>
#include <swiftlet/decompose.h>
#include <swiftlet/hull_tree.h>

namespace swiftlet {

/// Where the pieces of a node, sorted along the axis in which their centres vary most, are split in two [sec. 5.1].
enum class HullSplit : std::uint8_t {
  Median,    ///< as many on either side
  Midpoint,  ///< halfway between the first and the last centre: the paper's default
  Mean,      ///< at the mean of the centres
  Gap,       ///< where two centres that follow each other are farthest apart
};

/// Options of build_hull_tree.
struct HullTreeOptions {
  HullSplit split = HullSplit::Midpoint;  ///< how nodes are split
  Progress progress;                      ///< empty: no calls
  Executor executor{};                    ///< runs what can be cut into tasks; empty: the calling thread does
};

/// Makes the tree of hulls over a mesh's patches, which `decompose` found about the same mesh. A face is Original where
/// triangles of the surface below cover it wholly, decided by their edges. A face that a node has in common with a child is in
/// both hulls; arrays that hulls have alike are stored once. Cost: some 100 microseconds a triangle, 0.2 to 1.1 kB, and twice
/// that while it is built. Errors: BadValue for a decomposition of another mesh, TooLarge, Cancelled, and those of `build`.
Result<HullTree> build_hull_tree(const MeshModel& mesh, const Decomposition& patches, const HullTreeOptions& options = {});

}  // namespace swiftlet
