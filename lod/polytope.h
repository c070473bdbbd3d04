// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The value all of lod passes along, a closed convex surface of triangles, and its measures. Knows nothing of CGAL or levels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/model.h>

namespace swiftlet::lod {

using Triangle = std::array<std::uint32_t, 3>;

/// A solid; triangles are counter-clockwise seen from outside, every directed edge has its opposite.
struct Polytope {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// Twice the area of a triangle along its outward normal.
Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c);

double area(const Polytope& body);
double volume(const Polytope& body);
/// Of the surface, which is what SWIFT calls the centre of mass.
Vec3 area_centroid(const Polytope& body);
/// Second moments of the surface about its centroid, over its area.
Mat3 area_covariance(const Polytope& body);

/// The points' indices along Morton's space-filling curve.
std::vector<std::uint32_t> along_curve(std::span<const Vec3> points);

/// Half-edge 3 t + k runs from corner k of triangle t to the next corner; `twin` holds the opposite of each.
struct HalfEdges {
  std::vector<std::uint32_t> twin;
  std::vector<std::uint32_t> outgoing;  ///< per vertex, one half-edge that leaves it

  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// Counter-clockwise around the origin of h.
  std::uint32_t rotate(std::uint32_t h) const { return twin[previous(h)]; }
};
HalfEdges half_edges(const Polytope& body);

inline std::uint32_t origin(const Polytope& body, std::uint32_t h) { return body.triangles[h / 3][h % 3]; }

/// Finds extreme vertices of one solid by walking uphill; cheap when the start is near, or a direction was much like one
/// before. Keeps a reference to the body, its points in an order of its own, in which neighbours in space are neighbours in
/// memory, and what it found last about each direction: not for several threads at once. Copies share all but that.
class Climber {
 public:
  explicit Climber(const Polytope& body);
  const Polytope& body() const { return graph_->body; }
  std::span<const std::uint32_t> neighbours(std::uint32_t vertex) const;
  /// A vertex that no neighbour exceeds in `direction`, up to rounding.
  std::uint32_t climb(const Vec3& direction, std::uint32_t start) const;

 private:
  struct Node {
    Vec3 point;
    std::uint32_t begin, vertex;  ///< of its neighbours; the body's
  };
  struct Graph {
    explicit Graph(const Polytope& solid);
    const Polytope& body;
    std::vector<std::uint32_t> begin, neighbour;  ///< per vertex
    std::vector<Node> nodes;                      ///< along a curve, and one more where neighbours end
    std::vector<std::uint32_t> node, near;        ///< of each vertex; neighbours of the nodes, those of many along the curve
    std::vector<Eigen::AlignedBox3d> boxes;       ///< around each `kBlock` of these
  };
  static constexpr std::uint32_t kBlock = 32, kManyNeighbours = 2 * kBlock;
  std::shared_ptr<const Graph> graph_;
  std::uint32_t side_;                        ///< of a cube of directions
  mutable std::vector<std::uint32_t> found_;  ///< per cell of it, the node last found there; the first one where none was
};

}  // namespace swiftlet::lod
