// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A convex body at several levels of detail [Ehmann & Lin 2000, sec. 4]: immutable, shared, one block of memory. Knows nothing
// of poses or queries.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include <swiftlet/executor.h>
#include <swiftlet/lut.h>
#include <swiftlet/pose.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// The kind of feature that a FeatureId names.
enum class FeatureKind : std::uint8_t {
  None,    ///< no feature; the index has no meaning
  Vertex,  ///< the index is one of ConvexView::vertices
  Edge,    ///< the index is one of ConvexView::half_edges
  Face,    ///< the index is one of ConvexView::face_first
};

/// Names a feature of one level in 32 bits: two for the kind, thirty for the index. An edge is named by either of its
/// half-edges. The default names no feature.
class FeatureId {
 public:
  constexpr FeatureId() = default;
  /// Requires `index` < 2^30.
  constexpr FeatureId(FeatureKind kind, std::uint32_t index) : bits_(std::uint32_t(kind) << 30 | index) {}
  constexpr FeatureKind kind() const { return FeatureKind(bits_ >> 30); }  ///< `None` for FeatureId{}
  constexpr std::uint32_t index() const { return bits_ & 0x3fffffffu; }    ///< within its kind, on its level
  /// Compares the bits: the ids of an edge's two half-edges differ.
  constexpr bool operator==(const FeatureId&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

/// Stands for "no index", for example the face beside a segment's edge, or the source of a vertex that the builder invented.
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// A vertex and its ring, the half-edges [ring_begin, ring_begin + ring_count) that start here, counter-clockwise seen from
/// outside.
struct Vertex {
  double x, y, z;                        ///< body frame, the caller's unit
  std::uint32_t ring_begin, ring_count;  ///< first half-edge of the ring, number of half-edges
};

/// The plane of a face with more than three vertices. It passes through the origin of the face's first half-edge.
struct FacePlane {
  double x, y, z;    ///< unit outward normal, body frame
  double thickness;  ///< greatest distance of a vertex of the face from the plane, rounding included; the caller's unit
  /// No vertex of the body is higher than this above the plane, along the normal as it is stored; rounding included; the
  /// caller's unit. It holds where ConvexView::reach is known.
  double over;
};

/// One of the two directed halves of an edge. Its origin is not stored: it is the head of its twin.
struct HalfEdge {
  std::uint32_t head;  ///< the vertex at which it ends
  std::uint32_t twin;  ///< the opposite half-edge of the same edge
  std::uint32_t face;  ///< the face on its left; kNone for a segment

  bool operator==(const HalfEdge&) const = default;  ///< compares all three members
};

/// A view of one convex polytope, as a march reads it: non-owning, trivially copyable. Half-edges are sorted by origin.
///
///       h.head             A half-edge h leads from its origin to h.head. The face h.face is on its left, the face of its
///          /|\             twin on its right. The half-edge after h around h.face precedes h.twin in the ring of h.head.
///         / | \            A half-edge with the same face on both sides is a *diagonal*: a true edge of the exact hull
///        / h|  \           inside a face that is flat only up to rounding. Support climbs use it, face loops skip it.
///   right \ | / left       Faces with more than three vertices come first and have a FacePlane.
///          \|/             A segment has half-edges without faces (kNone), a point has no half-edge.
///        origin
struct ConvexView {
  std::span<const Vertex> vertices;           ///< at least one
  std::span<const HalfEdge> half_edges;       ///< sorted by origin
  std::span<const std::uint32_t> face_first;  ///< per face, a half-edge of its loop
  std::span<const FacePlane> planes;          ///< planes of the faces [0, planes.size())
  std::span<const std::uint8_t> tags;         ///< per face, a tag of the caller's; may be empty
  double extent = 0;                          ///< largest absolute coordinate
  Vec3 centre = Vec3::Zero();                 ///< any point of the body; the line of centres of a cold start ends here
  double inner_radius = 0;  ///< radius of a ball around `centre` that lies in the body; 0: none is known, as on coarser levels
  double reach = 0;         ///< upper bound on the distance of two points of the body; 0: not known, nor are FacePlane::over
  std::uint32_t rims = 0;   ///< the faces [0, rims) are rims, large ones whose vertices are numbered one after the other,
                           ///< counter-clockwise from the origin of the first half-edge, and whose half-edges begin their rings
};

/// Says which levels of a model to keep: the coarsest always, and finer ones as far as both members allow. Two bodies whose
/// finest levels deviate by d each answer any distance with an error of at most 2 d.
struct Detail {
  double deviation = 0;  ///< keep no level finer than the coarsest one with a smaller deviation, in the body's unit; 0: all
  /// Keep only levels that lie wholly in this many first bytes of the block, as Level::prefix counts them.
  std::uint64_t bytes = ~std::uint64_t{0};
};

/// The range of a face's vertices, counter-clockwise seen from outside, diagonals skipped: `for (std::uint32_t v :
/// FaceLoop(view, f))`. The faces of a flat body have loops too. A loop is usable while the view and its arrays live.
class FaceLoop {
 public:
  /// A position in the loop: the vertex at the head of the current half-edge.
  class Iterator {
   public:
    Iterator(const ConvexView& view, std::uint32_t half_edge, bool started)
        : view_(&view), half_edge_(half_edge), started_(started) {}                 ///< for FaceLoop
    std::uint32_t operator*() const { return view_->half_edges[half_edge_].head; }  ///< the vertex
    Iterator& operator++();                                                         ///< moves to the next vertex
    bool operator==(const Iterator& other) const {
      return half_edge_ == other.half_edge_ && started_ == other.started_;
    }  ///< compares positions in the same loop

   private:
    const ConvexView* view_;
    std::uint32_t half_edge_;
    bool started_;  ///< false only at `begin()`, which has the half-edge of `end()`
  };

  /// Requires `face` < view.face_first.size().
  FaceLoop(const ConvexView& view, std::uint32_t face) : view_(view), first_(view.face_first[face]) {}
  Iterator begin() const { return {view_, first_, false}; }  ///< at the head of the face's first half-edge
  Iterator end() const { return {view_, first_, true}; }     ///< after one whole round

 private:
  const ConvexView& view_;
  std::uint32_t first_;
};

/// A level of a model: its polytope, its links to the next finer and coarser levels, and its deviation from the exact hull.
struct Level {
  ConvexView view;  ///< lives as long as the model; has no features on levels finer than finest_level()
  std::span<const std::uint32_t> child_vertex;  ///< per vertex, the vertex one level finer (empty on level 0)
  std::span<const FeatureId> child_face;        ///< per face, the face or vertex one level finer (empty on level 0)
  std::span<const std::uint32_t> parent_face;   ///< per face, the vertex one level coarser (empty on the coarsest)
  std::span<const std::uint32_t> support_map;   ///< per cell of an octahedron around the body, the vertex extreme there and
                                                ///< a bound on its error; cold queries start here. Empty: no map at this level
  std::uint32_t map_side = 0;                   ///< `support_map` has 2 map_side^2 cells
  bool is_round = true;                         ///< `map_frame` is about a multiple of the identity
  /// The rows of an upper triangular matrix M, from the diagonal on: `support_map` is looked up along M n.
  std::array<double, 6> map_frame{1, 0, 0, 1, 0, 1};
  /// With M, an ellipsoid around the body: it lies within the points `view.centre` + `scale_around` M^T y with |y| <= 1.
  /// Infinite where none is known, as on coarser levels.
  double scale_around = std::numeric_limits<double>::infinity();
  double scale_inside = 0;  ///< the scale of an ellipsoid that the body holds; 0 where none is known, as on coarser levels
  double map_doubt = 0;     ///< about the mean error of a look-up in `support_map`, a length
  double edge_length = 0;   ///< mean length of the level's edges, diagonals included
  std::array<std::uint32_t, 4> feature_count{};  ///< by FeatureKind: vertices, half-edges and faces; 0 on absent levels
  double same_cos2 = 0, near_cos2 = 0;  ///< squared cosines of the turns after which a seed's features are stored again, and
                                        ///< after which they are worse than a cold start; 0: never
  double deviation = 0;   ///< bound on the distance of this level's points from level 0, above the truth by at most 1 % of it
                          ///< and law 2's bound
  double volume = 0;      ///< in cubic units; 0 for a body that is not solid
  std::size_t bytes = 0;  ///< size of this level in the block of a whole model
  /// Bytes from the beginning of the model's block to this level's end; of level 0 all bytes: the start table and the source
  /// map, which come last, belong to it. 0 if the block lacks the level.
  std::size_t prefix = 0;
  std::size_t edge_count = 0, triangle_count = 0;  ///< edges without diagonals; triangles: 2 V - 4 for a solid
};

/// Maps the features of level 0 to the user's own ids of vertices and triangles.
struct SourceMap {
  std::span<const std::uint32_t> vertex;      ///< per vertex of level 0, the user's vertex
  std::span<const std::uint32_t> face_begin;  ///< per face of level 0, the begin of its list in `face`; then the last's end
  std::span<const std::uint32_t> face;        ///< lists of the user's triangles, none or several per face
};

/// One level as plain arrays. Faces are counter-clockwise seen from outside. Those of a solid must not all lie in one plane,
/// decided exactly. A two-sided polygon is two opposite faces, a segment two vertices without faces, a point one vertex.
struct LevelArrays {
  /// Each coordinate is 0 or from 1e-70 to 1e45 in magnitude; the largest magnitude is 0 or at least 1e-45. The caller's unit.
  std::span<const Vec3> vertices;
  std::span<const std::uint32_t> face_vertices;  ///< the vertices of each face, one face after the other
  std::span<const std::uint32_t> face_sizes;     ///< vertices per face; empty: all are triangles

  std::span<const std::uint32_t> vertex_source;      ///< level 0 only: the user's vertex ids; empty: 0, 1, 2, ...
  std::span<const std::uint32_t> face_source_begin;  ///< level 0 only: as SourceMap::face_begin; empty: face k has the id k
  std::span<const std::uint32_t> face_source;        ///< level 0 only: the user's triangle ids, as SourceMap::face

  std::span<const std::uint32_t> child_vertex;  ///< per vertex, a vertex of the finer arrays; empty: the nearest [sec. 4.3]
  /// Per face, a vertex of the finer arrays: the child of a face that the finer level lacks; empty: its first vertex's child.
  std::span<const std::uint32_t> child_of_face;
};

/// The tables of vertices from which cold queries on a model start.
struct TableSpec {
  /// Resolution of the start table for StartPolicy::Table [Ehmann & Lin 2000, sec. 4.6]: 0, 114, 482 or 1986 32-bit entries.
  lut::Resolution resolution = lut::Resolution::None;
  double radius_factor = 2;  ///< radius of the start table's sphere of samples, in bounding radii: 1 to 1e6
  /// Entries of 4 bytes that the support map of each level has per vertex, about, up to 64, but at least 512; 0: no maps.
  /// Levels of more than 2^24 vertices have none.
  std::uint32_t map_cells = 4;
};

/// Options of Model::from_levels.
struct ModelOptions {
  bool repair = false;  ///< flip reflex edges that rounding left in the given faces, instead of refusing them
  TableSpec table;      ///< the start table and support maps to fill
  Executor executor{};  ///< runs what can be cut into tasks; empty: the calling thread does. The same bytes on any
};

/// A convex body at one or several levels, in one block of memory that is also the file's content. Copies share the block,
/// which never changes; any number of threads may query it.
///
/// A model may lack its finest levels, if they were cut away or not read from its file. Level ids still count from the exact
/// hull, level 0; of an absent level only the numbers in `Level` are known. Queries answer as precisely as the finest level
/// present allows, and their status says when that was not enough.
class Model {
 public:
  /// Makes a model of one or several levels, given finest first, without the builder. Convexity and enclosure are decided
  /// exactly; the error names the reflex edge and its height. Cost: linear in the features, times the levels.
  static Result<Model> from_levels(std::span<const LevelArrays> levels, const ModelOptions& options = {});
  /// Makes a model of one level.
  static Result<Model> from_level(const LevelArrays& level, const ModelOptions& options = {});

  int level_count() const { return level_count_; }    ///< at least 1; level 0 is the exact hull, larger is coarser
  int finest_level() const { return finest_level_; }  ///< the finest level present; 0 in a whole model
  /// Returns level `index`, 0 <= `index` < level_count(); the reference lives as long as the model.
  const Level& level(int index) const {
    assert(index >= 0 && index < level_count_);
    return levels_[index];
  }
  int map_level() const { return map_level_; }  ///< the finest level with a support map; level_count() if there is none
  SourceMap source() const;  ///< the user's ids of level 0, which live as long as the model; empty if level 0 is absent

  Vec3 centre() const;  ///< body frame: area centroid of level 0, or the mean of its vertices if it has no faces
  double radius() const { return radius_; }  ///< largest distance of a vertex of level 0 from `centre()`, rounded up
  double extent() const;                     ///< largest absolute coordinate over all levels
  Vec3 box_min() const;                      ///< body frame: smallest coordinates of level 0
  Vec3 box_max() const;                      ///< body frame: largest coordinates of level 0
  double volume() const;                     ///< of level 0, in cubic units
  int dimension() const;                     ///< 3 solid, 2 flat, 1 segment, 0 point
  /// Returns the model without the levels that `detail` leaves out, in a block of its own. Cost: a copy of the levels kept.
  Model cut(const Detail& detail) const;
  /// Makes `level` and all coarser levels ready for queries, if the block holds them, as that of a mapped model does.
  /// Checks their hashes and structure; returns finest_level(). Copies made earlier do not change; seeds stay valid. No query
  /// may read this very object meanwhile. Errors: BadValue if the block lacks the level, BadFormat if it is damaged; both leave
  /// the model unchanged.
  Result<int> ensure(int level);

  /// Returns a support vertex of the finest level: no other is farther along `direction` (body frame, any length). Exact if its
  /// coordinates are 0 or at least 1e-300 of the largest one; smaller ones may count as 0. Cost: hill climbing from a look-up.
  std::uint32_t support(const Vec3& direction) const;

  TableSpec table_spec() const;                  ///< what `table()` and the support maps were filled from
  std::span<const std::uint32_t> table() const;  ///< the start table: a vertex of level 0 per sample of lut.h; may be empty
  /// Returns a model of the levels present with new support maps and, if level 0 is present, a new start table. Error: BadValue
  /// if `spec` is out of its ranges.
  Result<Model> with_table(const TableSpec& spec) const;

  std::span<const std::byte> bytes() const;  ///< the block, which is what `save` writes; for a mapped model the whole file
  std::uint64_t hash() const;                ///< hash over all of `bytes()`, which it reads; equal blocks have equal hashes

 private:
  friend class BlockReader;
  struct Content;
  Model(std::shared_ptr<const Content> body, std::span<const Level> levels, double radius, int map_level, int finest_level)
      : content_(std::move(body)),
        levels_(levels.data()),
        radius_(radius),
        level_count_(int(levels.size())),
        map_level_(map_level),
        finest_level_(finest_level) {}
  std::shared_ptr<const Content> content_;
  const Level* levels_;  ///< points into `content_`, or to what a model without a block was given
  double radius_;
  int level_count_, map_level_, finest_level_;
};

}  // namespace swiftlet
