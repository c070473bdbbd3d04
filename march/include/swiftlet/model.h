// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A convex body at several levels of detail: immutable, shared, one block of memory. Knows nothing of poses or queries.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <swiftlet/lut.h>
#include <swiftlet/pose.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// What a FeatureId names.
enum class FeatureKind : std::uint8_t {
  None,    ///< nothing; the index means nothing
  Vertex,  ///< indexes ConvexView::vertices
  Edge,    ///< indexes ConvexView::half_edges
  Face,    ///< indexes ConvexView::face_first
};

/// A feature of one level in 32 bits: two for the kind, thirty for the index. An edge is named by either of its half-edges.
/// The default is no feature.
class FeatureId {
 public:
  constexpr FeatureId() = default;
  /// `index` < 2^30.
  constexpr FeatureId(FeatureKind kind, std::uint32_t index) : bits_(std::uint32_t(kind) << 30 | index) {}
  constexpr FeatureKind kind() const { return FeatureKind(bits_ >> 30); }  ///< None for FeatureId{}
  constexpr std::uint32_t index() const { return bits_ & 0x3fffffffu; }    ///< within its kind, on its level
  /// Same bits: an edge's two half-edges differ.
  constexpr bool operator==(const FeatureId&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

/// "No index": the face beside a segment's edge, the source of a vertex the builder invented.
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// A vertex and where its ring lies: half-edges [ring_begin, ring_begin + ring_count), counter-clockwise seen from outside.
struct Vertex {
  double x, y, z;                        ///< body frame, the caller's unit
  std::uint32_t ring_begin, ring_count;  ///< indices of half-edges that start here
};

/// The plane of a face of more than three vertices: unit outward normal, and the greatest distance of its vertices from the
/// plane through the first of them, rounding included.
struct FacePlane {
  double x, y, z;    ///< unit outward normal, body frame
  double thickness;  ///< the greatest distance, the caller's unit
};

/// What a half-edge leads to, side by side, as a walk reads it.
struct HalfEdge {
  std::uint32_t head;  ///< the vertex it ends at
  std::uint32_t twin;  ///< the half-edge the other way
  std::uint32_t face;  ///< on its left; kNone beside a segment

  bool operator==(const HalfEdge&) const = default;  ///< all three
};

/// One convex polytope as the march sees it: non-owning, trivially copyable. Half-edges are sorted by origin.
///
///       h.head             A half-edge h leads from its origin to h.head and has h.face on its left; the one on its right
///          /|\             is its twin's. The half-edge after h around h.face comes before h.twin in the ring of h.head.
///         / | \            A half-edge with the same face on both sides is a *diagonal*: a true edge of the exact hull
///        / h|  \           inside a face that is flat only up to rounding. Support climbs use it, face loops skip it.
///   right \ | / left       Faces with more than three vertices come first and have a FacePlane.
///          \|/             A segment has half-edges without faces (kNone), a point has no half-edge.
///        origin
struct ConvexView {
  std::span<const Vertex> vertices;           ///< at least one
  std::span<const HalfEdge> half_edges;       ///< sorted by origin
  std::span<const std::uint32_t> face_first;  ///< per face, a half-edge of its loop
  std::span<const FacePlane> planes;          ///< of faces [0, planes.size())
  std::span<const std::uint8_t> tags;         ///< per face, the caller's; may be empty
  double extent = 0;                          ///< largest absolute coordinate
  Vec3 centre = Vec3::Zero();                 ///< any point of the body, where a cold start looks from
};

/// How much of a model a scene needs. The coarsest level always comes along, finer ones as far as both members allow. Two
/// bodies that deviate by d each answer any distance to 2 d.
struct Detail {
  double deviation = 0;  ///< none finer than the coarsest level that deviates less, in the body's unit; 0: all
  std::uint64_t bytes = ~std::uint64_t{0};  ///< none that the first so many bytes of the block do not hold
};

/// The vertices of a face, counter-clockwise seen from outside, diagonals passed over: `for (std::uint32_t v : FaceLoop(view,
/// f))`. Of a flat body's face too. As long as the view's arrays live.
class FaceLoop {
 public:
  /// Where a loop is: at the vertex that its half-edge leads to.
  class Iterator {
   public:
    Iterator(const ConvexView& view, std::uint32_t half_edge, bool started)
        : view_(&view), half_edge_(half_edge), started_(started) {}                 ///< of FaceLoop
    std::uint32_t operator*() const { return view_->half_edges[half_edge_].head; }  ///< the vertex
    Iterator& operator++();                                                         ///< the next one
    bool operator==(const Iterator& other) const {
      return half_edge_ == other.half_edge_ && started_ == other.started_;
    }  ///< of one loop

   private:
    const ConvexView* view_;
    std::uint32_t half_edge_;
    bool started_;  ///< tells the end from the beginning
  };

  /// `face` < view.face_first.size().
  FaceLoop(const ConvexView& view, std::uint32_t face) : view_(view), first_(view.face_first[face]) {}
  Iterator begin() const { return {view_, first_, false}; }  ///< the vertex after the first half-edge's origin
  Iterator end() const { return {view_, first_, true}; }     ///< round once

 private:
  const ConvexView& view_;
  std::uint32_t first_;
};

/// A level of a model: its polytope, its links to the levels beside it, and how far it stands off the exact hull.
struct Level {
  ConvexView view;                              ///< its features, as long as the model lives; none finer than finest_level()
  std::span<const std::uint32_t> child_vertex;  ///< per vertex, the vertex one level finer (empty on level 0)
  std::span<const FeatureId> child_face;        ///< per face, the face or vertex one level finer (empty on level 0)
  std::span<const std::uint32_t> parent_face;   ///< per face, the vertex one level coarser (empty on the coarsest)
  std::span<const std::uint32_t> support_map;   ///< per cell of a cube around the body, which vertex is extreme there and by
                                                ///< how much it may not be; a query's cold start. Empty: none at this level
  std::uint32_t map_side = 0;                   ///< its cells on an edge of that cube
  double edge_length = 0;                       ///< mean over the level's edges
  double deviation = 0;    ///< bound on the distance of this level's points from level 0, at most 1 % above the truth
  double volume = 0;       ///< cubic units; 0 where flatter than a solid
  std::size_t bytes = 0;   ///< of this level in a whole model's block
  std::size_t prefix = 0;  ///< of the model's block, from its beginning to this level's end; 0 where the block lacks it
  std::size_t edge_count = 0, triangle_count = 0;  ///< without diagonals; 2 V - 4 for a solid
};

/// Level 0 given as the user knows it: which of the user's vertices and triangles a feature stands for.
struct SourceMap {
  std::span<const std::uint32_t> vertex;      ///< per vertex of level 0, the user's vertex
  std::span<const std::uint32_t> face_begin;  ///< per face of level 0 and one more, where its list begins in `face`
  std::span<const std::uint32_t> face;        ///< the user's triangles, none or several per face
};

/// One level as plain arrays. Faces are counter-clockwise seen from outside. Those of a solid are not all in one plane,
/// exactly. A two-sided polygon is two opposite faces, a segment two vertices without faces, a point one vertex.
struct LevelArrays {
  /// Coordinates 0 or 1e-70 to 1e45 in magnitude, the largest of all 0 or at least 1e-45; the caller's unit.
  std::span<const Vec3> vertices;
  std::span<const std::uint32_t> face_vertices;  ///< the faces' loops one after the other
  std::span<const std::uint32_t> face_sizes;     ///< vertices per face; empty: all are triangles

  std::span<const std::uint32_t> vertex_source;      ///< level 0: the user's vertex ids; empty: 0, 1, 2, ...
  std::span<const std::uint32_t> face_source_begin;  ///< level 0: as SourceMap::face_begin, per face given; empty: face k is k
  std::span<const std::uint32_t> face_source;        ///< level 0: the user's triangle ids, one list after the other

  std::span<const std::uint32_t> child_vertex;  ///< per vertex, a vertex of the finer arrays; empty: the nearest [sec. 4.3]
  /// Per face that the finer level lacks, a vertex of the finer arrays; empty: as the face's first vertex.
  std::span<const std::uint32_t> child_of_face;
};

/// What a model carries to start cold queries from.
struct TableSpec {
  /// The paper's table, for StartPolicy::Table [Ehmann & Lin 2000, sec. 4.6]: 0, 114, 482 or 1986 entries of 4 bytes.
  lut::Resolution resolution = lut::Resolution::None;
  double radius_factor = 2;  ///< its samples lie on the sphere of this many bounding radii, at least 1
  /// Of the finest support map: 6 side^2 entries of 4 bytes. It lies on the finest level of at most 4 096 vertices, else on the
  /// coarsest; each coarser level has one of half the side, at least 1. 16 take about 8 kB. A power of two up to 64; 0: no
  /// maps.
  std::uint32_t map_side = 16;
};

/// What Model::from_levels does beside proving.
struct ModelOptions {
  bool repair = false;  ///< flip the reflex edges that rounding left in the faces given
  TableSpec table;      ///< the tables and maps to fill
};

/// A block of memory that is also the file. Copies share it; it never changes; any number of threads may query it.
///
/// A model may lack its finest levels, cut away or not read from its file: level ids still count from the exact hull, and what
/// is known of an absent level are its numbers. Queries answer as well as the finest level present allows, and their status
/// says when that was not enough.
class Model {
 public:
  /// From one or several levels given finest first, without the builder. Convexity and enclosure are decided exactly; the error
  /// names the reflex edge and its height. Cost: linear in the features, times the levels.
  static Result<Model> from_levels(std::span<const LevelArrays> levels, const ModelOptions& options = {});
  /// One level.
  static Result<Model> from_level(const LevelArrays& level, const ModelOptions& options = {});

  int level_count() const { return level_count_; }    ///< at least 1; level 0 is the exact hull, larger is coarser
  int finest_level() const { return finest_level_; }  ///< of those present; 0 in a whole model
  /// Level `index` < level_count(); lives as long as the model.
  const Level& level(int index) const {
    assert(index >= 0 && index < level_count_);
    return levels_[index];
  }
  int map_level() const { return map_level_; }  ///< the finest with a support map; level_count() where none has
  SourceMap source() const;                     ///< the user's ids of level 0; lives as long as the model; empty without it

  Vec3 centre() const;    ///< body frame: area centroid of level 0 (of its edges or point, where flatter)
  double radius() const;  ///< largest distance of a vertex of level 0 from the centre, rounded up
  double extent() const;  ///< largest absolute coordinate over all levels
  Vec3 box_min() const;   ///< of level 0
  Vec3 box_max() const;   ///< the corner across
  double volume() const;  ///< of level 0
  int dimension() const;  ///< 3 solid, 2 flat, 1 segment, 0 point
  /// The model without the levels that `detail` does not ask for, in a block of its own. Cost: a copy of what is left.
  Model cut(const Detail& detail) const;
  /// Makes the levels from `level` (>= 0) on ready for queries, where the block holds them: a mapped one does. Proves their
  /// hashes and structure; returns finest_level(). Copies made before stay as they are, seeds fit the same levels as before.
  /// Not while a query reads this very object. Errors: BadValue where the block lacks the level, BadFormat where it is damaged;
  /// either leaves the model as it was.
  Result<int> ensure(int level);

  /// A vertex of the finest level that no other exceeds in `direction` (body frame, any length). Exact; a climb from a look-up.
  std::uint32_t support(const Vec3& direction) const;

  TableSpec table_spec() const;                  ///< of the table that follows
  std::span<const std::uint32_t> table() const;  ///< a vertex of level 0 per sample of lut.h, empty without one
  /// The levels present, with other maps, and with level 0 another table. Error: BadValue where `spec` is out of its ranges.
  Result<Model> with_table(const TableSpec& spec) const;

  std::span<const std::byte> bytes() const;  ///< the block: what model_file.h writes; of a mapped model the whole file
  std::uint64_t hash() const;                ///< of the block, which it reads to the end; equal hash, equal model

 private:
  friend class BlockReader;
  struct Content;
  Model(std::shared_ptr<const Content> body, std::span<const Level> levels, int map_level, int finest_level)
      : content_(std::move(body)),
        levels_(levels.data()),
        level_count_(int(levels.size())),
        map_level_(map_level),
        finest_level_(finest_level) {}
  std::shared_ptr<const Content> content_;
  const Level* levels_;  ///< the body's
  int level_count_, map_level_, finest_level_;
};

}  // namespace swiftlet
