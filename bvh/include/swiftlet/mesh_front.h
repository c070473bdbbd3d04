// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a pair of meshes that moves little from one query to the next may keep beside its seed: a front, the pairs of nodes and
// triangles at which the searches before ended, each with a direction that parts it.
#pragma once

#include <cstddef>
#include <memory>

#include <swiftlet/mesh_query.h>

namespace swiftlet {

/// The front of one pair of meshes. Where it lies, all pairs of their triangles are below it; a query asks first which of its
/// pairs the motion may have brought near, and looks at these alone. It changes the work, never the truth: a direction that
/// parted a pair, and the ball around the part of B, bound the distance in any later pose, and what they do not prove is looked
/// at again. A front that is full keeps pairs farther up, with less use.
///
/// It pays near contact where the bodies turn and move by less than the size of their triangles a query: at turns of 0.1 degree
/// such queries take 0.26 to 1 of the instructions, at 0.01 degree 0.1 to 0.3 (bench/TRIED.md). Where it does not, queries
/// do without for up to 512 of them, unless the motion slows down before, and take 1 to 4 % more. It serves every question,
/// in any order; of questions that have thresholds far from each other, each is better served by a front of its own. Of a pair
/// with a convex body, with a mesh that was cut, or of two meshes with convex patches it stays empty. Other meshes than last
/// time are noticed, also those that `refit` returned, and start a new front. Meshes last used live as long as it does.
///
/// As a seed it is for one query at a time. Queries allocate nothing.
class MeshFront {
 public:
  static constexpr std::size_t kPairs = 16384;  ///< the capacity unless another is asked for
  /// Memory for `pairs` pairs of nodes and triangles, rounded down to a multiple of 8: 44 bytes each. A query near contact of
  /// two meshes of 5 000 triangles keeps some 1 000, one of 70 000 some 5 000. With 0 it is of no use, and does no harm.
  explicit MeshFront(std::size_t pairs = kPairs);
  ~MeshFront();
  MeshFront(MeshFront&&) noexcept;             ///< what was moved from may only be assigned to, or used as one of capacity 0
  MeshFront& operator=(MeshFront&&) noexcept;  ///< as the constructor

  std::size_t capacity() const;  ///< in pairs
  std::size_t size() const;      ///< places that are taken, in pairs
  void clear();                  ///< forgets both meshes and all pairs, and keeps the memory

 private:
  friend class FrontReader;
  struct State;
  std::unique_ptr<State> state_;
};

// The queries of mesh_query.h with a front beside the seed. What they say holds; `steps` and `plane_tests` count what was
// opened and looked at, and `Budget::steps` limits it. It does not limit the look at the front itself: some 15 instructions for
// each pair that may be near, none of them more than once. Answers depend on seed and front as law 3 allows; the same calls in
// the same order give the same bits. They use 7 kB of stack more.

/// `distance` with a front.
Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                const Options& options = {});
/// `intersects` with a front.
Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                  const Effort& effort = {});
/// `within` with a front.
Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed, MeshFront& front,
              const Effort& effort = {});
/// `closest_features` with a front.
ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                                 const ClosestOptions& options = {});

}  // namespace swiftlet
