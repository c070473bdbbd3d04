// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of few points by exact signs [Preparata & Shamos 1985, sec. 3.4.3]. Knows points, nothing of bodies.
#include "depth/exact_hull.h"

#include <bitset>
#include <utility>

namespace swiftlet {
namespace {

static_assert(ExactHull::kMostFacets <= 256, "a facet's index is a byte");

constexpr std::size_t after(std::size_t e) { return e == 2 ? 0 : e + 1; }
constexpr Vec kOrigin{0, 0, 0};

}  // namespace

/// The corners of a facet in order, the ideal ones last. Not all are ideal.
std::array<ExactHull::Index, 3> ExactHull::ideal_last(const HullFacet& f) const {
  std::size_t first = 2;
  if (has_ideal(f)) {
    while (is_ideal(f.corner[first]) || !is_ideal(f.corner[after(after(first))])) first = after(first);
  }
  return {f.corner[first], f.corner[after(first)], f.corner[after(after(first))]};
}

/// Computes the plane of a new facet in doubles, its height less the error bound; a sliver is made sharp at once.
void ExactHull::stand(HullFacet& f) const {
  const auto [a, b, c] = ideal_last(f);
  const Vec& p = corner_[a];
  const auto from_p = [&](Index k) { return is_ideal(k) ? corner_[k] : corner_[k] - p; };
  const Vec u = from_p(b), v = from_p(c), n = cross(u, v);
  const double area = norm(n), error = kCrossError * std::sqrt(dot(u, u) * dot(v, v));
  f.above = kInfinity;
  f.is_sharp = !(4 * error < area);
  if (f.is_sharp) return sharpen(f);
  f.normal = n * (1 / area);
  f.height = dot(f.normal, p) - (3 * error / area + kGapError) * norm(p);
}

void ExactHull::sharpen(HullFacet& f) const {
  const auto [a, b, c] = ideal_last(f);
  const Vec& p = corner_[a];
  const auto from_p = [&](Index k) { return is_ideal(k) ? wide(corner_[k]) : wide(corner_[k]) - wide(p); };
  const exact::Plane plane = exact::plane(p, from_p(b), from_p(c));
  f.normal = plane.normal, f.height = plane.height, f.is_sharp = true;
}

const HullFacet& ExactHull::sharpened(int facet) {
  HullFacet& f = facet_[std::size_t(facet)];
  if (!f.is_sharp) sharpen(f);
  return f;
}

int ExactHull::lowest() {
  for (;;) {
    int lowest = 0;
    for (int k = 1; k < facet_count_; ++k) {
      if (facet_[std::size_t(k)].height < facet_[std::size_t(lowest)].height) lowest = k;
    }
    if (facet_[std::size_t(lowest)].is_sharp) return lowest;
    sharpened(lowest);
  }
}

void ExactHull::begin(const std::array<Vec, 4>& points) {
  for (std::size_t k = 0; k < 4; ++k) corner_[k] = points[k];
  ideal_count_ = 0;
  begin_tetrahedron(exact::orientation(points[0], points[1], points[2], points[3]) > 0);
}

void ExactHull::begin(const std::array<Vec, 3>& directions, const Vec& point) {
  for (std::size_t k = 0; k < 3; ++k) corner_[k] = directions[k];
  corner_[3] = point;
  ideal_count_ = 3;
  begin_tetrahedron(exact::orientation(kOrigin, directions[0], directions[1], directions[2]) < 0);
}

/// Makes the facets of the first four corners. `turned`: corner 3 lies where the others are counter-clockwise.
void ExactHull::begin_tetrahedron(bool turned) {
  corner_count_ = 4, facet_count_ = 4, free_count_ = 0;
  // Facet k lies opposite corner k. Across an edge of facet k lies the facet opposite the corner that this edge leaves out.
  for (std::size_t k = 0; k < 4; ++k) {
    HullFacet& f = facet_[k];
    const auto& face = exact::kTetrahedronFace[k];
    f.corner = {face[0], face[1], face[2]};
    if (turned) std::swap(f.corner[1], f.corner[2]);
    for (std::size_t e = 0; e < 3; ++e) f.beside[e] = f.corner[after(after(e))];
    if (k == 3 && ideal_count_ == 3)
      f.height = f.above = kInfinity, f.is_sharp = true;
    else
      stand(f);
  }
}

bool ExactHull::sees(int facet, const Vec& p) const {
  const HullFacet& f = facet_[std::size_t(facet)];
  if (!has_ideal(f)) return exact::orientation(corner_[f.corner[0]], corner_[f.corner[1]], corner_[f.corner[2]], p) > 0;
  if (f.height == kInfinity) return false;  // no point is beyond the plane at infinity
  const auto [first, second, third] = ideal_last(f);
  const Vec &a = corner_[first], &b = corner_[second], &c = corner_[third];
  // The sign of the determinant of the three corners as seen from p, of an ideal one its direction.
  if (is_ideal(second)) return exact::compare_along_normal(&kOrigin.x, &b.x, &c.x, &p.x, &a.x) > 0;
  return exact::compare_along_normal(&p.x, &a.x, &b.x, &kOrigin.x, &c.x) > 0;
}

int ExactHull::seen_from(const Vec& p) const {
  for (int k = 0; k < facet_count_; ++k) {
    if (!is_gone(k) && sees(k, p)) return k;
  }
  return -1;
}

int ExactHull::add(const Vec& p, int facet) {
  const auto top = Index(corner_count_);
  corner_[std::size_t(corner_count_++)] = p;
  std::array<Index, kMostFacets> seen;
  std::bitset<kMostFacets> is_seen, is_known;
  std::size_t seen_count = 0;
  const auto visit = [&](Index k) {
    if (is_known[k]) return;
    is_known[k] = true;
    if (sees(k, p)) is_seen[k] = true, seen[seen_count++] = k;
  };
  visit(Index(facet));
  for (std::size_t i = 0; i < seen_count; ++i) {
    for (const Index beside : facet_[seen[i]].beside) visit(beside);
  }

  // The border of the seen facets: entry k is the border's edge from corner k.
  struct Edge {
    Index to, outer;
  };
  std::array<Edge, kMostPoints> border;
  Index first = 0;
  for (std::size_t i = 0; i < seen_count; ++i) {
    const HullFacet& f = facet_[seen[i]];
    for (std::size_t e = 0; e < 3; ++e) {
      if (!is_seen[f.beside[e]]) border[f.corner[e]] = {f.corner[after(e)], f.beside[e]}, first = f.corner[e];
    }
  }
  for (std::size_t i = 0; i < seen_count; ++i) {
    facet_[seen[i]].height = kInfinity;
    free_[std::size_t(free_count_++)] = seen[i];
  }

  // The cone over the border, facet after facet; the last is beside the first.
  const auto place = [&] { return Index(free_count_ > 0 ? free_[std::size_t(--free_count_)] : facet_count_++); };
  const Index begin = place();
  Index current = begin, from = first;
  do {
    const Edge edge = border[from];
    HullFacet& f = facet_[current];
    const Index next = edge.to == first ? begin : place();
    f.corner = {from, edge.to, top};
    f.beside[0] = edge.outer, f.beside[1] = next;
    facet_[next].beside[2] = current;
    HullFacet& outer = facet_[edge.outer];
    for (std::size_t e = 0; e < 3; ++e) {
      if (outer.corner[e] == edge.to && outer.corner[after(e)] == from) outer.beside[e] = current;
    }
    stand(f);
    current = next, from = edge.to;
  } while (from != first);
  return int(top);
}

}  // namespace swiftlet
