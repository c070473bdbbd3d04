// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// SWIFT++ [Ehmann & Lin 2001]: a binary tree of convex hulls over the convex patches of a surface, and the paper's queries and
// accelerations, each of which can be had alone. MeshModel answers the same questions sooner on most bodies, from a fifth of
// the memory; near contact of bodies of large patches, as robots' links are, this is sooner (bench/RESULTS.md). lod's
// build_hull_tree.h makes the trees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// What lies behind a face of a node's hull, weakest first [sec. 5.2]: an edge counts as the strongest face beside it, a vertex
/// as the surface. Nearest features of two nodes that are not free answer for all that is below the nodes.
enum class FaceClass : std::uint8_t {
  Free,       ///< made by the hull: nothing of the body need be there
  Contained,  ///< a face of a piece that is no patch's, inside the solid that a closed mesh bounds
  Original,   ///< triangles of the surface cover the face
};

/// An array of a node: a part of that of HullArrays.
struct HullRange {
  std::uint32_t begin = 0, count = 0;  ///< its first element, its length
};

/// A node: the convex hull of the surface below it. A piece is a node without children, the hull of one patch.
struct HullNode {
  Vec3 centre = Vec3::Zero();                           ///< the hull's area centroid, or the mean of its vertices
  double radius = 0;                                    ///< the largest distance of a vertex from `centre`, rounded up
  double extent = 0, inner_radius = 0, reach = 0;       ///< ConvexView's
  float edge_length = 0, same_cos2 = 0, near_cos2 = 0;  ///< Level's, rounded
  HullRange vertices, half_edges, face_first, planes;   ///< ConvexView's
  std::uint32_t classes = 0;                            ///< where they begin: per face, its FaceClass
  std::uint32_t in_child = 0;                           ///< where they begin: per vertex, HullArrays::in_child; not of a piece
  std::array<std::uint32_t, 2> child{kNone, kNone};     ///< of HullTree::nodes; kNone of a piece
  std::uint32_t first = 0, end = 0;                     ///< the triangles below it: HullTree::triangles[first .. end)
  std::uint32_t surface = kNone;  ///< of a piece that is not filled, its triangles: of HullArrays::surfaces

  bool is_piece() const { return child[0] == kNone; }  ///< true of a node without children
  /// True of a piece all of which belongs to the body: it lies in the solid, or it is a flat patch that covers its hull.
  bool is_filled() const { return is_piece() && surface == kNone; }
};

/// What the hulls of a tree are made of. An array that several nodes have alike is there once.
struct HullArrays {
  std::vector<HullNode> nodes;       ///< the root first, children after their parent
  std::vector<Vertex> vertices;      ///< of ConvexView::vertices, as the three that follow of theirs; indices are a hull's own
  std::vector<HalfEdge> half_edges;  ///< hull by hull
  std::vector<std::uint32_t> face_first;               ///< hull by hull
  std::vector<FacePlane> planes;                       ///< hull by hull
  std::vector<std::uint8_t> classes;                   ///< per face, its FaceClass
  std::vector<std::array<std::uint32_t, 2>> in_child;  ///< per vertex, that of each child's hull; kNone if it has none
  std::vector<MeshModel> surfaces;                     ///< of pieces that are not filled, their triangles
};

/// A surface and the tree over it. If the mesh is closed the body is the solid that it bounds, else the surface.
class HullTree {
 public:
  HullTree(MeshModel mesh, std::vector<std::uint32_t> triangles, HullArrays hulls);  ///< for the builder

  const MeshModel& mesh() const { return mesh_; }                             ///< the surface
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }  ///< the mesh's, piece after piece
  const std::vector<HullNode>& nodes() const { return hulls_.nodes; }         ///< the root first, children after their parent
  const HullArrays& hulls() const { return hulls_; }                          ///< what the nodes name places in
  /// The hull of a node, with the faces' classes as tags. It lives as long as the tree stays where it is.
  ConvexView hull(const HullNode& node) const;
  MeshBody body() const& { return is_solid_ ? MeshBody::solid(mesh_) : MeshBody(mesh_); }  ///< what queries are about
  MeshBody body() const&& = delete;  ///< a temporary tree would not outlive the expression
  std::size_t bytes() const;         ///< what all of it takes, the mesh's block included

 private:
  MeshModel mesh_;
  std::vector<std::uint32_t> triangles_;
  HullArrays hulls_;
  bool is_solid_;
};

/// Where the atomic query of two nodes begins that no query has stored a seed for.
enum class HullStart : std::uint8_t {
  Parent,   ///< at a corner of the parent pair's features that the child has, else along the line of centres
  Centres,  ///< along the line of centres
};

/// The paper's accelerations [sec. 7]. The answer is true with any of them, and with none, which is Algorithm 2.
struct HullSearch {
  bool piece_caching = false;  ///< the last pair that answered is asked first: for distances and thresholds
  bool priority = false;       ///< the nearest pair of nodes next, from a queue of `most_queued`; else depth first
  bool front = false;          ///< pairs that met are kept, and the next query begins below them; raised by one level a query
  bool features = true;        ///< with `front`: each kept pair begins at the features where its last query ended
  HullStart start = HullStart::Parent;  ///< where other pairs begin
  std::uint32_t most_queued = 1000;     ///< pairs that do not fit in the queue are searched depth first
};

/// An answer, and the nodes whose hulls its features are of.
struct HullAnswer {
  Answer answer;  ///< as those of mesh_query.h; features are those of the nodes' hulls, and `steps` counts pairs of nodes asked
                  ///< about
  std::uint32_t node_a = kNone, node_b = kNone;  ///< kNone where no node answered
};

/// Two bodies and what one query leaves to the next. Both trees must outlive it and not move. Its memory grows to what a query
/// needs and stays. Intervals are true and as narrow as asked (laws 1 and 2 of LAWS.md); within law 2's bound of contact or of
/// a threshold the verdict may depend on the queries before.
class HullPair {
 public:
  HullPair(const HullTree& a, const HullTree& b, const HullSearch& search = {});  ///< asks nothing yet
  /// A temporary tree would not outlive the expression.
  HullPair(const HullTree&&, const HullTree&, const HullSearch& = {}) = delete;
  HullPair(const HullTree&, const HullTree&&, const HullSearch& = {}) = delete;
  HullPair(const HullTree&&, const HullTree&&, const HullSearch& = {}) = delete;

  /// Decides whether the bodies share a point: read `answer.verdict`.
  HullAnswer intersects(const Pose& b_in_a);
  /// Decides whether the distance is at most `threshold` (>= 0). Undecided only within law 2's bound of it, or for a pose that
  /// a query refuses.
  Decision within(const Pose& b_in_a, double threshold);
  /// The distance, exact or as near as `absolute` or `relative` allow. Bodies farther than `beyond` have the status Beyond.
  HullAnswer distance(const Pose& b_in_a, double absolute = 0, double relative = 0,
                      double beyond = std::numeric_limits<double>::infinity());
  /// All pairs of pieces within `reach`, each with its distance, in no order: the local minima and more. Bodies that overlap
  /// give one contact, an overlap. None if `reach` is NaN.
  const std::vector<HullAnswer>& contacts(const Pose& b_in_a, double reach);

  std::uint64_t asked() const { return asked_; }  ///< pairs of nodes asked about, by all queries so far
  std::uint64_t steps() const { return steps_; }  ///< steps of the walks on them
  std::size_t front_size() const;                 ///< pairs at which the next query begins

 private:
  /// A pair of nodes. Has no children or two, `child` and the one after it.
  struct Item {
    std::uint32_t a, b;
    PairSeed seed{};
    double lower = 0;  ///< of the last query
    std::uint32_t child = kNone;
    bool met = false;      ///< the hulls overlapped when they were last asked about
    bool passing = false;  ///< its children are of this query alone
  };
  struct Open {
    double lower;
    std::uint32_t item;
    bool operator<(const Open& other) const { return lower > other.lower; }
  };
  struct Question;
  /// What comes after a pair.
  enum class Next : std::uint8_t {
    Done,   ///< nothing below it matters
    Split,  ///< its children
    Stop,   ///< nothing: the question is decided
  };

  void search(Question& question);
  Next take(std::uint32_t item, double floor, Question& question);
  Next judge(const Item& item, const Answer& result, Question& question);
  Next by_surfaces(const Item& item, Question& question);
  void ask_inside(Question& question);
  std::uint32_t split(std::uint32_t item);
  std::uint32_t new_children();
  void drop(std::uint32_t item);
  void raise_front();
  void collect_front();
  HullAnswer conclude(const Question& question) const;

  const HullTree &a_, &b_;
  const HullSearch search_;
  std::vector<Item> items_;           ///< the root pair first
  std::vector<std::uint32_t> spare_;  ///< first ones of pairs of items that nothing uses
  std::vector<Open> queue_, stack_;
  std::vector<std::uint32_t> front_, walk_;
  std::vector<HullAnswer> contacts_;
  std::uint32_t cached_a_ = kNone, cached_b_ = kNone;  ///< the last pair that answered
  PairSeed cached_seed_;
  std::uint64_t asked_ = 0, steps_ = 0;
};

}  // namespace swiftlet
