// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of a growing patch, point after point [Ehmann & Lin 2001, sec. 4], by exact signs. Knows what the patch
// covers of its boundary; knows nothing of the surface beyond.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wedge.h"

namespace swiftlet::lod {

/// A closed surface of triangles over all points of the patch, each a corner of some, also where it lies in a face or an edge
/// of the hull. As long as all points lie in one plane, triangles of the polygon are closed by others between its sides and a
/// point that is none, far on the inner side of the plane.
class PatchHull {
 public:
  using Corners = std::array<std::uint32_t, 3>;
  explicit PatchHull(std::span<const Vec> vertices);

  /// Begins anew with a triangle, whose corners do not lie on one line.
  void begin(const Corners& triangle);

  /// What becomes of the hull with one triangle more.
  enum class Fit : std::uint8_t {
    Not,     ///< the triangle, or one of the patch, would not lie on the boundary of the hull
    Within,  ///< the hull stays as it is
    Flat,    ///< it grows and stays flat: see `flat_wedges`
    Solid,   ///< it grows: see `wedges`
  };
  /// Tries a triangle with the edge from `a` to `b`, the way in which it runs along it, and the corner `v`; a triangle of the
  /// patch runs along it from `b` to `a`, and either it is in one plane with it or both see the edge as convex.
  Fit fits(std::uint32_t a, std::uint32_t b, std::uint32_t v);
  /// What the hull gains by the triangle tried.
  std::span<const Wedge> wedges() const { return wedges_; }
  std::span<const FlatWedge> flat_wedges() const { return flat_wedges_; }
  /// Takes in the triangle that was tried last and fits.
  void join();

  bool flat() const { return is_flat_; }
  bool holds(std::uint32_t vertex) const { return patch_of_[vertex] == patch_; }
  std::uint32_t vertex_count() const { return vertex_count_; }

 private:
  /// A triangle of the hull; neighbour k is across the edge from corner k to the next.
  struct Face {
    Corners corner;
    std::array<std::uint32_t, 3> next;
    bool covered;  ///< in its plane lies a triangle of the patch; true of at least one face in each such plane
    bool seen;     ///< from the vertex tried
  };

  const Vec& at(std::uint32_t vertex) const { return vertices_[vertex]; }
  std::uint32_t beyond() const { return std::uint32_t(vertices_.size()); }
  std::size_t corner_of(std::uint32_t face, std::uint32_t vertex) const;
  bool is_closing(const Face& face) const;
  int orientation(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) const;
  int orientation_in_plane(std::uint32_t p, std::uint32_t q, std::uint32_t r) const;
  int side(std::uint32_t face, std::uint32_t vertex) const;
  bool is_past(std::uint32_t face, std::size_t edge, std::uint32_t vertex) const;
  void gather_ring(std::uint32_t a, std::uint32_t b);
  bool is_supported() const;
  Fit locate();
  Fit look(std::uint32_t first);
  void set_wedges();
  void set_flat_wedges();
  void set_base_wedges();
  std::uint32_t add_face(const Corners& corners, bool covered);
  void relink(std::uint32_t face, std::uint32_t from, std::uint32_t to);
  void put_on_plane();
  void put_cone();
  void put_within();
  void cover();

  std::span<const Vec> vertices_;
  std::vector<std::uint32_t> patch_of_, face_at_, start_;  ///< per vertex
  std::vector<Face> faces_;
  std::vector<std::uint32_t> free_;
  std::uint32_t patch_ = 0, vertex_count_ = 0;
  bool is_flat_ = true;
  int u_ = 0, v_ = 1;  ///< coordinates that the plane projects to

  // Of the triangle tried.
  std::array<std::uint32_t, 3> tried_{};
  std::uint32_t pivot_ = 0;  ///< the end of the edge with fewer faces around it
  Fit fit_ = Fit::Not;
  bool is_new_ = false;  ///< its third corner is no point of the patch
  std::vector<std::uint32_t> ring_, other_ring_, seen_, walk_;
  std::uint32_t host_ = 0;  ///< the face that the corner lies in, if no face sees it
  std::vector<std::uint8_t> walked_;
  std::vector<Wedge> wedges_;
  std::vector<FlatWedge> flat_wedges_;
};

}  // namespace swiftlet::lod
