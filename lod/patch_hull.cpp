// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Beneath and beyond: the faces that see a new vertex give way to a cone from it. No point of a patch is ever lost, since a
// triangle of the patch would be with it: so a triangle tried is judged by the faces around one end of its edge alone.
#include "patch_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

#include <swiftlet/model.h>

#include "numeric/exact.h"

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double coordinate(const Vec& p, int k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }
Kernel::Point_3 exact_point(const Vec& p) { return {p.x, p.y, p.z}; }

}  // namespace

PatchHull::PatchHull(std::span<const Vec> vertices)
    : vertices_(vertices), patch_of_(vertices.size() + 1), face_at_(vertices.size() + 1), start_(vertices.size() + 1) {}

void PatchHull::begin(const Corners& triangle) {
  ++patch_;
  vertex_count_ = 3;
  is_flat_ = true;
  faces_.clear(), free_.clear();
  const Vec &p = at(triangle[0]), &q = at(triangle[1]), &r = at(triangle[2]);
  for (const auto& [u, v] : {std::array{0, 1}, std::array{1, 2}, std::array{2, 0}}) {
    const auto onto = [u = u, v = v](const Vec& x) { return Kernel::Point_2(coordinate(x, u), coordinate(x, v)); };
    const int sign = CGAL::orientation(onto(p), onto(q), onto(r));
    if (sign == 0) continue;
    u_ = sign > 0 ? u : v, v_ = sign > 0 ? v : u;
    break;
  }
  add_face(triangle, true);
  for (std::uint32_t k = 0; k < 3; ++k) add_face({triangle[(k + 1) % 3], triangle[k], beyond()}, false);
  for (std::uint32_t k = 0; k < 3; ++k) {
    faces_[0].next[k] = k + 1;
    // From the edge's end to its start, to the point beyond, and back.
    faces_[k + 1].next = {0, (k + 2) % 3 + 1, (k + 1) % 3 + 1};
  }
  for (const std::uint32_t vertex : triangle) patch_of_[vertex] = patch_;
}

std::size_t PatchHull::corner_of(std::uint32_t face, std::uint32_t vertex) const {
  const Corners& c = faces_[face].corner;
  return c[0] == vertex ? 0 : c[1] == vertex ? 1 : 2;
}

bool PatchHull::is_closing(const Face& face) const {
  return is_flat_ && (face.corner[0] == beyond() || face.corner[1] == beyond() || face.corner[2] == beyond());
}

int PatchHull::orientation(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) const {
  if (s == p || s == q || s == r) return 0;
  return exact::orientation(at(p), at(q), at(r), at(s));
}

int PatchHull::orientation_in_plane(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
  const auto onto = [&](std::uint32_t x) { return Kernel::Point_2(coordinate(at(x), u_), coordinate(at(x), v_)); };
  return CGAL::orientation(onto(p), onto(q), onto(r));
}

/// Positive if the face sees the vertex; of a flat hull the vertex lies in its plane.
int PatchHull::side(std::uint32_t face, std::uint32_t vertex) const {
  const Corners& c = faces_[face].corner;
  if (!is_flat_) return orientation(c[0], c[1], c[2], vertex);
  for (std::size_t k = 0; k < 3; ++k) {
    if (c[k] == beyond()) return orientation_in_plane(c[(k + 1) % 3], c[(k + 2) % 3], vertex);
  }
  return 0;
}

/// Whether a vertex in the plane of a face lies on the other side of an edge of it.
bool PatchHull::is_past(std::uint32_t face, std::size_t edge, std::uint32_t vertex) const {
  const Corners& c = faces_[face].corner;
  const std::uint32_t p = c[edge], q = c[(edge + 1) % 3], r = c[(edge + 2) % 3];
  if (is_flat_) return orientation_in_plane(p, q, vertex) < 0;
  return CGAL::coplanar_orientation(exact_point(at(p)), exact_point(at(q)), exact_point(at(r)), exact_point(at(vertex))) ==
         CGAL::NEGATIVE;
}

/// Sets `pivot_` to the end with fewer faces around it, and `ring_` to these, counter-clockwise.
void PatchHull::gather_ring(std::uint32_t a, std::uint32_t b) {
  ring_.assign(1, face_at_[a]), other_ring_.assign(1, face_at_[b]);
  const auto step = [&](std::uint32_t vertex, std::vector<std::uint32_t>& ring) {
    const std::uint32_t next = faces_[ring.back()].next[(corner_of(ring.back(), vertex) + 2) % 3];
    if (next == ring.front()) return false;
    ring.push_back(next);
    return true;
  };
  for (;;) {
    if (!step(a, ring_)) {
      pivot_ = a;
      return;
    }
    if (!step(b, other_ring_)) {
      pivot_ = b;
      ring_.swap(other_ring_);
      return;
    }
  }
}

/// Whether the hull lies on the inner side of the triangle tried: around one point of it, a convex body does so all over.
bool PatchHull::is_supported() const {
  const auto& [a, b, v] = tried_;
  return std::all_of(ring_.begin(), ring_.end(), [&, a = a, b = b, v = v](std::uint32_t face) {
    const std::uint32_t vertex = faces_[face].corner[(corner_of(face, pivot_) + 1) % 3];
    return (is_flat_ && vertex == beyond()) || orientation(a, b, v, vertex) <= 0;
  });
}

PatchHull::Fit PatchHull::fits(std::uint32_t a, std::uint32_t b, std::uint32_t v) {
  tried_ = {a, b, v};
  is_new_ = !holds(v);
  gather_ring(a, b);
  const bool stays_flat = is_flat_ && [&] {
    const Corners& c =
        faces_[*std::find_if(ring_.begin(), ring_.end(), [&](std::uint32_t f) { return !is_closing(faces_[f]); })].corner;
    return orientation(c[0], c[1], c[2], v) == 0;
  }();
  if (!stays_flat && !is_supported()) return fit_ = Fit::Not;
  if (!is_new_) return fit_ = Fit::Within;
  if (is_flat_ && !stays_flat) {
    set_base_wedges();
    return fit_ = Fit::Solid;
  }
  return fit_ = locate();
}

/// Finds a face that sees the vertex, or that it lies in: among those around the pivot, or past edges of faces in one plane
/// with the vertex.
PatchHull::Fit PatchHull::locate() {
  const std::uint32_t v = tried_[2];
  walk_.clear();
  for (const std::uint32_t face : ring_) {
    const int at = side(face, v);
    if (at > 0) return look(face);
    if (at == 0 && !is_closing(faces_[face])) walk_.push_back(face);
  }
  walked_.resize(faces_.size());
  std::vector<std::uint32_t> marked = walk_;
  for (const std::uint32_t face : walk_) walked_[face] = 1;
  Fit found = Fit::Not;
  bool is_found = false;
  while (!walk_.empty() && !is_found) {
    const std::uint32_t face = walk_.back();
    walk_.pop_back();
    bool is_inside = true;
    for (std::size_t k = 0; k < 3 && !is_found; ++k) {
      if (!is_past(face, k, v)) continue;
      is_inside = false;
      const std::uint32_t next = faces_[face].next[k];
      if (walked_[next]) continue;
      const int at = side(next, v);
      if (at > 0) {
        found = look(next);
        is_found = true;
      } else if (at == 0 && !is_closing(faces_[next])) {
        walked_[next] = 1;
        marked.push_back(next), walk_.push_back(next);
      }
    }
    if (is_inside) {
      host_ = face;
      found = Fit::Within;
      is_found = true;
    }
  }
  for (const std::uint32_t face : marked) walked_[face] = 0;
  return found;
}

/// Finds all faces that see the vertex, of which `first` is one.
PatchHull::Fit PatchHull::look(std::uint32_t first) {
  seen_.assign(1, first);
  faces_[first].seen = true;
  bool is_covered = false;
  for (std::size_t i = 0; i < seen_.size() && !is_covered; ++i) {
    is_covered = faces_[seen_[i]].covered;
    for (const std::uint32_t next : faces_[seen_[i]].next) {
      if (faces_[next].seen || side(next, tried_[2]) <= 0) continue;
      faces_[next].seen = true;
      seen_.push_back(next);
    }
  }
  if (!is_covered) is_flat_ ? set_flat_wedges() : set_wedges();
  for (const std::uint32_t face : seen_) faces_[face].seen = false;
  return is_covered ? Fit::Not : is_flat_ ? Fit::Flat : Fit::Solid;
}

void PatchHull::set_wedges() {
  wedges_.clear();
  for (const std::uint32_t face : seen_) {
    const Face& f = faces_[face];
    Wedge wedge;
    for (std::size_t k = 0; k < 3; ++k) wedge.corner[k] = at(f.corner[k]), wedge.outer[k] = !faces_[f.next[k]].seen;
    wedge.corner[3] = at(tried_[2]);
    wedges_.push_back(wedge);
  }
}

void PatchHull::set_flat_wedges() {
  flat_wedges_.clear();
  for (const std::uint32_t face : seen_) {
    const Face& f = faces_[face];
    const std::size_t k = corner_of(face, beyond());
    FlatWedge wedge;
    // The polygon lies to the left of its edges, a closing face runs the other way.
    wedge.corner = {at(f.corner[(k + 1) % 3]), at(f.corner[(k + 2) % 3]), at(tried_[2])};
    wedge.outer = {!faces_[f.next[k]].seen, !faces_[f.next[(k + 2) % 3]].seen};
    wedge.u = u_, wedge.v = v_;
    flat_wedges_.push_back(wedge);
  }
}

/// A flat hull becomes the base of a pyramid, seen from its inner side.
void PatchHull::set_base_wedges() {
  std::vector<std::uint32_t> polygon;
  const std::uint32_t first = face_at_[beyond()];
  std::uint32_t face = first;
  do {  // around the point beyond counter-clockwise is clockwise around the polygon seen from outside
    const std::size_t k = corner_of(face, beyond());
    polygon.push_back(faces_[face].corner[(k + 1) % 3]);
    face = faces_[face].next[(k + 2) % 3];
  } while (face != first);
  const std::size_t size = polygon.size();
  std::vector<std::uint32_t> sharp;
  for (std::size_t i = 0; i < size; ++i) {
    if (orientation_in_plane(polygon[(i + size - 1) % size], polygon[i], polygon[(i + 1) % size]) != 0)
      sharp.push_back(polygon[i]);
  }
  wedges_.clear();
  for (std::size_t i = 1; i + 1 < sharp.size(); ++i) {
    Wedge wedge;
    wedge.corner = {at(sharp[0]), at(sharp[i]), at(sharp[i + 1]), at(tried_[2])};
    wedge.outer = {i == 1, true, i + 2 == sharp.size()};
    wedge.base_outer = true;
    wedges_.push_back(wedge);
  }
}

std::uint32_t PatchHull::add_face(const Corners& corners, bool covered) {
  std::uint32_t face = std::uint32_t(faces_.size());
  if (free_.empty()) {
    faces_.emplace_back();
  } else {
    face = free_.back();
    free_.pop_back();
  }
  faces_[face] = {corners, {kNone, kNone, kNone}, covered, false};
  for (const std::uint32_t vertex : corners) face_at_[vertex] = face;
  return face;
}

/// Sets the neighbour of a face across the edge that runs from this vertex.
void PatchHull::relink(std::uint32_t face, std::uint32_t from, std::uint32_t to) {
  faces_[face].next[corner_of(face, from)] = to;
}

void PatchHull::join() {
  if (is_new_) {
    const std::uint32_t v = tried_[2];
    if (fit_ == Fit::Within) {
      put_within();
    } else if (is_flat_ && fit_ == Fit::Solid) {
      put_on_plane();
    } else {
      put_cone();
    }
    patch_of_[v] = patch_;
    ++vertex_count_;
  }
  if (!is_flat_) cover();
}

/// The point beyond becomes the vertex.
void PatchHull::put_on_plane() {
  const std::uint32_t first = face_at_[beyond()];
  std::uint32_t face = first;
  do {
    const std::size_t k = corner_of(face, beyond());
    faces_[face].corner[k] = tried_[2];
    face = faces_[face].next[(k + 2) % 3];
  } while (face != first);
  face_at_[tried_[2]] = first;
  is_flat_ = false;
}

void PatchHull::put_cone() {
  const std::uint32_t v = tried_[2];
  struct Border {
    std::uint32_t from, to, outside;
  };
  std::vector<Border> border;
  for (const std::uint32_t face : seen_) faces_[face].seen = true;
  for (const std::uint32_t face : seen_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Face& f = faces_[face];
      if (!faces_[f.next[k]].seen) border.push_back({f.corner[k], f.corner[(k + 1) % 3], f.next[k]});
    }
  }
  for (const std::uint32_t face : seen_) {
    faces_[face].seen = false;
    free_.push_back(face);
  }
  std::vector<std::uint32_t> added;
  for (const auto& [from, to, outside] : border) {
    const std::uint32_t face = add_face({from, to, v}, false);
    faces_[face].next[0] = outside;
    relink(outside, to, face);
    start_[from] = face;
    added.push_back(face);
  }
  for (const std::uint32_t face : added) {
    const std::uint32_t after = start_[faces_[face].corner[1]];
    faces_[face].next[1] = after;
    faces_[after].next[2] = face;
  }
}

/// Cuts the face that the vertex lies in into three, or it and its neighbour into two each.
void PatchHull::put_within() {
  const std::uint32_t v = tried_[2];
  const Face host = faces_[host_];
  const auto is_on = [&](std::size_t k) {
    const std::uint32_t p = host.corner[k], q = host.corner[(k + 1) % 3];
    return exact::collinear(&at(p).x, &at(q).x, &at(v).x);
  };
  std::size_t on = 0;
  while (on < 3 && !is_on(on)) ++on;
  if (on == 3) {
    std::array<std::uint32_t, 3> part;
    free_.push_back(host_);
    for (std::size_t k = 0; k < 3; ++k) part[k] = add_face({host.corner[k], host.corner[(k + 1) % 3], v}, host.covered);
    for (std::size_t k = 0; k < 3; ++k) {
      faces_[part[k]].next = {host.next[k], part[(k + 1) % 3], part[(k + 2) % 3]};
      relink(host.next[k], host.corner[(k + 1) % 3], part[k]);
    }
    return;
  }
  const std::uint32_t other = host.next[on];
  const Face across = faces_[other];
  const std::size_t back = corner_of(other, host.corner[(on + 1) % 3]);
  const std::uint32_t p = host.corner[on], q = host.corner[(on + 1) % 3], r = host.corner[(on + 2) % 3];
  const std::uint32_t s = across.corner[(back + 2) % 3];
  free_.push_back(host_), free_.push_back(other);
  // Around v: q r, r p, p s, s q.
  const std::uint32_t qr = add_face({q, r, v}, host.covered), rp = add_face({r, p, v}, host.covered),
                      ps = add_face({p, s, v}, across.covered), sq = add_face({s, q, v}, across.covered);
  faces_[qr].next = {host.next[(on + 1) % 3], rp, sq};
  faces_[rp].next = {host.next[(on + 2) % 3], ps, qr};
  faces_[ps].next = {across.next[(back + 1) % 3], sq, rp};
  faces_[sq].next = {across.next[(back + 2) % 3], qr, ps};
  relink(host.next[(on + 1) % 3], r, qr);
  relink(host.next[(on + 2) % 3], p, rp);
  relink(across.next[(back + 1) % 3], s, ps);
  relink(across.next[(back + 2) % 3], q, sq);
}

/// Marks the faces around the pivot that lie in the plane of the triangle.
void PatchHull::cover() {
  const auto& [a, b, v] = tried_;
  const std::uint32_t first = face_at_[pivot_];
  std::uint32_t face = first;
  do {
    const std::size_t k = corner_of(face, pivot_);
    const Corners& c = faces_[face].corner;
    if (orientation(a, b, v, c[(k + 1) % 3]) == 0 && orientation(a, b, v, c[(k + 2) % 3]) == 0) faces_[face].covered = true;
    face = faces_[face].next[(k + 2) % 3];
  } while (face != first);
}

}  // namespace swiftlet::lod
