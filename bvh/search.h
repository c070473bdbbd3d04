// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The question that every mesh query is, and its answer: see descent.h for how it is found.
#pragma once

#include <optional>

#include <swiftlet/mesh_query.h>

#include "front.h"
#include "mesh_block.h"
#include "numeric/vec.h"
#include "numeric/width.h"
#include "pair/pair_view.h"
#include "pair/stop_rule.h"

namespace swiftlet {

/// A convex body in place of a mesh: a node with one child, its box.
struct ConvexLeaf {
  explicit ConvexLeaf(const Body& body);

  Body body;  ///< without its radius
  bool is_legal;
  Root root{};
  Vec point;  ///< of the body
  Node node{};
};

/// A body as a search reads it.
struct MeshView {
  explicit MeshView(const MeshBody& body);
  MeshView(const MeshView&) = delete;  ///< `nodes` may point into this object
  MeshView& operator=(const MeshView&) = delete;

  bool has_hull(std::uint32_t node) const { return convex || content->hull_at(node); }
  /// Of a node that has one. The hull of a convex body is the body.
  Body hull(std::uint32_t node) const { return convex ? convex->body : Body(content->hull_at(node)->model); }
  /// A triangle that is likely to hold a point of a feature on level 0 of a node's hull.
  std::uint32_t triangle_at(std::uint32_t node, FeatureId feature, const Vec& point) const;
  static constexpr std::uint32_t kMostInFace = 128;  ///< triangles of a face that are looked at for that

  PatchPlace patch_place(std::uint32_t node) const {
    if (convex) return PatchPlace::At;
    return node < content->patch_place.size() ? content->patch_place[node] : PatchPlace::Elsewhere;
  }
  bool has_patches() const { return convex || !content->patch_place.empty(); }
  /// The node of the patch that holds a triangle, or kNone. A convex body is its own.
  std::uint32_t patch_with(std::uint32_t triangle) const;

  /// False if the finest detail of the body is missing.
  bool is_whole() const {
    return triangle_count > 0 && !(convex && convex->body.model() && convex->body.model()->finest_level() > 0);
  }

  const MeshReader::Content* content;  ///< null for a convex body
  /// True if no node is below the children of a node: these are triangles or, of a mesh that was cut, boxes.
  bool ends(const Node& node) const { return node.lowest() || node.first() >= node_count; }

  const Root* root;
  const Node* nodes;
  std::uint32_t node_count;
  const Corners* triangles;  ///< null for a convex body
  const Vec* vertices;
  std::uint32_t triangle_count;  ///< 0 of a mesh that was cut; of a convex body 1
  bool is_legal;
  bool solid;  ///< the volume that the mesh encloses belongs to it
  std::optional<ConvexLeaf> convex;
};

/// What is asked about the surfaces, without radii.
struct MeshQuestion {
  StopRule stop;
  double law_two;                       ///< law 2's bound for the bodies
  double size;                          ///< law 2's size
  std::uint32_t steps;                  ///< the most pairs of nodes and triangles to look at
  FrontReader::State* front = nullptr;  ///< null, or that of two whole meshes
};

/// What is known of the surfaces.
struct MeshFinding {
  double lower = 0, upper = HUGE_VAL;
  Verdict verdict = Verdict::Undecided;  ///< only Overlapping or Undecided
  bool sure = false;                     ///< two triangles cross by more than law 2's bound
  bool cut_short = false;                ///< the budget ended the search
  bool refused = false;                  ///< the kernel refused a body
  Vec point_a, point_b;                  ///< where `upper` is finite
  Vec normal{};                          ///< 0 if unknown
  FeatureId feature_a, feature_b;
  int level_a = 0, level_b = 0;
  std::uint32_t triangle_a = kNone, triangle_b = kNone;
  std::uint32_t nodes = 0, triangles = 0;  ///< pairs opened, and looked at
};

/// The root of a body's tree: its box and ball, and its node, which holds the boxes below.
struct Top {
  const Root& root;
  const Node& node;
};
/// A pose as queries read it.
struct QueryPose {
  Motion motion;
  PoseQuality quality;
};
double gap_of_roots_by_two(const Top& a, const Top& b, const Pose& b_in_a, double enough, QueryPose& placed);
double gap_of_roots_by_four(const Top& a, const Top& b, const Pose& b_in_a, double enough, QueryPose& placed);
/// A lower bound on the distance, or a number that is not above `enough`: the gap of the balls around both bodies or, if that
/// is no answer, along the line of the balls' centres that of both roots' boxes or, where these meet by little, that of the
/// boxes below along a better direction. `placed` receives the pose; of an illegal one the bound is 0.
static inline double gap_of_roots(const Top& a, const Top& b, const Pose& b_in_a, double enough, QueryPose& placed) {
  return SWIFTLET_BY_WIDTH(gap_of_roots, a, b, b_in_a, enough, placed);
}

void search_by_two(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
                   MeshFinding& finding);
void search_by_four(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
                    MeshFinding& finding);
/// Answers `question`. `finding` must be a default one; `seed` receives the nearest pair.
static inline void search(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question,
                          MeshSeed& seed, MeshFinding& finding) {
  SWIFTLET_BY_WIDTH(search, a, b, b_in_a, question, seed, finding);
}

}  // namespace swiftlet
