// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From faces to half-edges: fan the faces into triangles, prove that they close to one sphere, prove convexity by exact signs
// [Mehlhorn et al. 1999], merge exactly coplanar triangles to facets, drop vertices that are no corners, group nearly coplanar
// facets to walking faces, order the half-edges along rims and a space-filling curve.
#include "make/surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>

#include "body/block.h"
#include "body/shape.h"
#include "body/support.h"
#include "numeric/chunks.h"
#include "numeric/decimal.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"
#include "numeric/vec.h"
#include "numeric/wide.h"

namespace swiftlet {
namespace {

using Index = std::uint32_t;
using Loop = std::vector<Index>;

Error bad_value(std::string message) { return {ErrorCode::BadValue, std::move(message)}; }
Error not_convex(std::string message) { return {ErrorCode::NotConvex, std::move(message)}; }
std::string edge_text(Index u, Index v) { return "edge (" + std::to_string(u) + ", " + std::to_string(v) + ")"; }

double extent_of(std::span<const Vec3> points) {
  double extent = 0;
  for (const Vec3& p : points) extent = std::max(extent, max_abs(vec(p)));
  return extent;
}

/// The most vertices that a level may have: V vertices make at most 6 V - 12 half-edges, each of which needs a FeatureId.
constexpr std::size_t kMostVertices = kMaxIndex / 6;

constexpr std::size_t kPerTask = 8192;       ///< triangles, facets
constexpr std::size_t kPlanesPerTask = 256;  ///< each takes a climb

/// The input faces as loops of input vertices.
struct Input {
  std::span<const Vec3> points;
  std::vector<std::span<const Index>> faces;

  const double* at(Index v) const { return points[v].data(); }
  Vec point(Index v) const { return vec(points[v]); }
  int orientation(Index a, Index b, Index c, Index d) const { return exact::orientation(at(a), at(b), at(c), at(d)); }
};

Result<Input> read_input(const LevelArrays& level) {
  Input in{level.vertices, {}};
  if (in.points.empty()) return Error{ErrorCode::Empty, "no vertices"};
  if (in.points.size() > kMostVertices || level.face_vertices.size() > kMaxIndex) {
    return Error{ErrorCode::TooLarge, std::to_string(in.points.size()) + " vertices and " +
                                          std::to_string(level.face_vertices.size()) + " corners of faces"};
  }
  for (std::size_t i = 0; i < in.points.size(); ++i) {
    for (const double x : {in.points[i][0], in.points[i][1], in.points[i][2]}) {
      if (!is_legal_coordinate(x)) return bad_value("vertex " + std::to_string(i) + " has the coordinate " + decimal(x, 3));
    }
  }
  if (const double extent = extent_of(in.points); extent > 0 && extent < kLeastExtent)
    return bad_value("the body's extent is " + decimal(extent, 3) + ", below the limit of " + decimal(kLeastExtent, 3));
  std::size_t at = 0;
  const bool triangles = level.face_sizes.empty();
  if (triangles && level.face_vertices.size() % 3 != 0) return bad_value("face_vertices is no list of triangles");
  const std::size_t count = triangles ? level.face_vertices.size() / 3 : level.face_sizes.size();
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t size = triangles ? 3 : level.face_sizes[f];
    if (size < 3 || size > level.face_vertices.size() - at)
      return bad_value("face " + std::to_string(f) + " has " + std::to_string(size) + " vertices");
    const auto loop = level.face_vertices.subspan(at, size);
    for (const Index v : loop) {
      if (v >= in.points.size())
        return bad_value("face " + std::to_string(f) + " names vertex " + std::to_string(v) + " of " +
                         std::to_string(in.points.size()));
    }
    in.faces.push_back(loop);
    at += size;
  }
  if (at != level.face_vertices.size()) return bad_value("face_sizes and face_vertices disagree");
  return in;
}

/// The facets of a body, from which the half-edges are built.
struct Facets {
  std::vector<Loop> loops;         ///< per facet, its input vertices in order; each is a corner of the body
  std::vector<Index> input_facet;  ///< per input face, the facet that contains it
};

// ---- Solids: a mesh of triangles -------------------------------------------------------------------------------------------

struct Triangle {
  Index v[3];
  Index beside[3];  ///< the triangle across the edge v[i], v[i + 1]
  Index input;
};

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

/// Returns 0 to `count` - 1 in the order of the edges that they are the sides of: by the lesser end, then by the greater one.
/// `ends` gives both ends of a side.
template <class Ends>
std::vector<Index> by_edge(std::size_t vertices, Index count, Ends ends) {
  std::vector<Index> begin(vertices + 2, 0), order(count);
  for (Index s = 0; s < count; ++s) ++begin[std::min(ends(s).first, ends(s).second) + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (Index s = 0; s < count; ++s) order[begin[std::min(ends(s).first, ends(s).second) + 1]++] = s;
  const auto place = [&](Index s) { return std::pair(std::max(ends(s).first, ends(s).second), s); };
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(order.begin() + begin[v], order.begin() + begin[v + 1], [&](Index a, Index b) { return place(a) < place(b); });
  }
  return order;
}

/// Appends face `f` to `out` as a fan of triangles around its first corner that makes none of them degenerate; false if every
/// corner makes one.
bool fan(const Input& in, Index f, std::vector<Triangle>& out) {
  const std::span<const Index> loop = in.faces[f];
  const std::size_t n = loop.size();
  for (std::size_t apex = 0; apex < n; ++apex) {
    const std::size_t before = out.size();
    bool flat = false;
    for (std::size_t i = 1; i + 1 < n && !flat; ++i) {
      const Index a = loop[apex], b = loop[(apex + i) % n], c = loop[(apex + i + 1) % n];
      flat = exact::collinear(in.at(a), in.at(b), in.at(c));
      out.push_back({{a, b, c}, {kNone, kNone, kNone}, f});
    }
    if (!flat) return true;
    out.resize(before);
  }
  return false;
}

class Mesh {
 public:
  Mesh(const Input& in, std::vector<Triangle> triangles, const Executor& executor)
      : in_(in), triangles_(std::move(triangles)), executor_(executor) {}

  /// Finds the triangle across each edge, and returns an error unless the surface is one closed sphere.
  Result<bool> close() {
    const auto ends = [&](Index s) { return std::pair(triangles_[s / 3].v[s % 3], triangles_[s / 3].v[next(int(s % 3))]); };
    const std::vector<Index> order = by_edge(in_.points.size(), Index(3 * triangles_.size()), ends);
    for (std::size_t i = 0; i < order.size();) {
      const auto [u, w] = std::minmax({ends(order[i]).first, ends(order[i]).second});
      const auto same_edge = [&](Index s) { return std::minmax({ends(s).first, ends(s).second}) == std::pair(u, w); };
      std::size_t end = i;
      while (end < order.size() && same_edge(order[end])) ++end;
      if (end - i != 2) return not_convex(edge_text(u, w) + " belongs to " + std::to_string(end - i) + " faces, not 2");
      const Index s = order[i], t = order[i + 1];
      if (ends(s) == ends(t)) return not_convex("the faces at " + edge_text(u, w) + " are wound against each other");
      triangles_[s / 3].beside[s % 3] = t / 3;
      triangles_[t / 3].beside[t % 3] = s / 3;
      i = end;
    }
    return one_sphere();
  }

  /// Proves by exact signs that the surface is convex. Flips a reflex edge if it is a diagonal of one input face, or with
  /// `repair`; else a reflex edge is an error.
  Result<bool> make_convex(bool repair) {
    std::vector<std::pair<Index, int>> doubtful = edges_where([](int sign) { return sign > 0; });
    std::size_t flips = 0;
    while (!doubtful.empty()) {
      const auto [t, i] = doubtful.back();
      doubtful.pop_back();
      if (height_sign(t, i) <= 0) continue;
      const Index s = triangles_[t].beside[i];
      const bool own_diagonal = triangles_[t].input == triangles_[s].input;
      if ((!own_diagonal && !repair) || flips++ > 32 * triangles_.size() || !flip(t, i)) return reflex(t, i);
      for (const Index changed : {t, s}) {
        for (int k = 0; k < 3; ++k) doubtful.push_back({changed, k});
      }
    }
    return globally_convex();
  }

  /// Merges coplanar triangles to facets and drops vertices that are no corners.
  Facets facets() const {
    std::vector<Index> group(triangles_.size());
    std::iota(group.begin(), group.end(), 0u);
    const auto root = [&group](Index t) {
      while (group[t] != t) t = group[t] = group[group[t]];
      return t;
    };
    for (const auto& [t, i] : edges_where([](int sign) { return sign == 0; })) {
      const Index a = root(t), b = root(triangles_[t].beside[i]);
      group[std::max(a, b)] = std::min(a, b);
    }
    Facets result;
    std::vector<Index> number(triangles_.size(), kNone);
    for (Index t = 0; t < triangles_.size(); ++t) group[t] = root(t);
    for (Index t = 0; t < triangles_.size(); ++t) {
      if (group[t] == t) number[t] = Index(result.loops.size()), result.loops.emplace_back();
    }
    // A corner belongs to at least three facets. A vertex of two lies inside an edge, a vertex of one inside a facet.
    std::vector<std::array<Index, 3>> around(in_.points.size(), {kNone, kNone, kNone});
    for (Index t = 0; t < triangles_.size(); ++t) {
      for (const Index v : triangles_[t].v) {
        for (Index& slot : around[v]) {
          if (slot == group[t]) break;
          if (slot == kNone) {
            slot = group[t];
            break;
          }
        }
      }
    }
    std::vector<bool> walked(triangles_.size() * 3, false);
    for (Index t = 0; t < triangles_.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        if (walked[3 * t + i] || group[triangles_[t].beside[i]] == group[t]) continue;
        Loop& loop = result.loops[number[group[t]]];
        Index s = t;
        int k = i;
        while (!walked[3 * s + k]) {
          walked[3 * s + k] = true;
          const Index tail = triangles_[s].v[k];
          if (around[tail][2] != kNone) loop.push_back(tail);
          k = next(k);
          while (group[triangles_[s].beside[k]] == group[s]) {
            const Index across = triangles_[s].beside[k];
            k = next(side_towards(across, s, triangles_[s].v[k]));
            s = across;
          }
        }
      }
    }
    result.input_facet.assign(in_.faces.size(), kNone);
    for (const Triangle& t : triangles_) {
      const Index facet = number[group[Index(&t - triangles_.data())]];
      if (result.input_facet[t.input] == kNone) result.input_facet[t.input] = facet;
    }
    return result;
  }

 private:
  /// Returns the side of `t` that borders `s` and ends in `head`.
  int side_towards(Index t, Index s, Index head) const {
    for (int i = 0; i < 3; ++i) {
      if (triangles_[t].beside[i] == s && triangles_[t].v[next(i)] == head) return i;
    }
    return 0;
  }
  int side_towards(Index t, Index s) const {
    for (int i = 0; i < 3; ++i) {
      if (triangles_[t].beside[i] == s) return i;
    }
    return 0;
  }
  /// Returns the vertex that the triangle across side `i` of `t` has and `t` lacks.
  Index opposite(Index t, int i) const {
    const Triangle& s = triangles_[triangles_[t].beside[i]];
    for (const Index v : s.v) {
      if (v != triangles_[t].v[i] && v != triangles_[t].v[next(i)]) return v;
    }
    return triangles_[t].v[next(next(i))];  // both have the same vertices: flat, refused by the global proof
  }
  /// Returns a positive sign if the triangle across side `i` rises above the plane of `t`, which makes the edge reflex.
  int height_sign(Index t, int i) const {
    const Triangle& a = triangles_[t];
    return in_.orientation(a.v[0], a.v[1], a.v[2], opposite(t, i));
  }

  /// Returns the edges whose sign, of the height of one side's triangle above the other's, is as asked: each as the side of the
  /// triangle of greater index, in the order of these.
  template <class IsAsked>
  std::vector<std::pair<Index, int>> edges_where(IsAsked is_asked) const {
    std::vector<std::vector<std::pair<Index, int>>> found((triangles_.size() + kPerTask - 1) / kPerTask);
    over_chunks(executor_, triangles_.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
      for (auto t = Index(begin); t < end; ++t) {
        for (int i = 0; i < 3; ++i) {
          if (t >= triangles_[t].beside[i] && is_asked(height_sign(t, i))) found[begin / kPerTask].push_back({t, i});
        }
      }
    });
    std::vector<std::pair<Index, int>> edges;
    for (const auto& of_task : found) edges.insert(edges.end(), of_task.begin(), of_task.end());
    return edges;
  }

  Result<bool> one_sphere() const {
    std::vector<Index> fans(in_.points.size(), 0), corners(in_.points.size(), 0);
    std::vector<bool> seen(triangles_.size() * 3, false);
    for (Index t = 0; t < triangles_.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        ++corners[triangles_[t].v[i]];
        if (seen[3 * t + i]) continue;
        ++fans[triangles_[t].v[i]];
        Index s = t;
        int k = i;
        while (!seen[3 * s + k]) {  // around the vertex, clockwise
          seen[3 * s + k] = true;
          const Index across = triangles_[s].beside[k];
          k = next(side_towards(across, s, triangles_[s].v[k]));
          s = across;
        }
      }
    }
    for (Index v = 0; v < fans.size(); ++v) {
      if (fans[v] == 0) return bad_value("vertex " + std::to_string(v) + " belongs to no face");
      if (fans[v] > 1)
        return not_convex("the faces at vertex " + std::to_string(v) + " form " + std::to_string(fans[v]) + " fans, not 1");
    }
    if (2 * in_.points.size() != triangles_.size() + 4) {
      return not_convex("the faces do not close to one sphere: " + std::to_string(in_.points.size()) + " vertices and " +
                        std::to_string(triangles_.size()) + " triangles");
    }
    return true;
  }

  /// Replaces the edge of side `i` by the other diagonal of the two triangles; false if that edge exists already.
  bool flip(Index t, int i) {
    const Index s = triangles_[t].beside[i];
    const int j = side_towards(s, t);
    const Index u = triangles_[t].v[i], w = triangles_[t].v[next(i)], x = triangles_[t].v[next(next(i))],
                y = triangles_[s].v[next(next(j))];
    if (x == y || neighbours(x, t, y)) return false;
    const Index a = triangles_[t].beside[next(i)], b = triangles_[t].beside[next(next(i))];
    const Index c = triangles_[s].beside[next(j)], d = triangles_[s].beside[next(next(j))];
    const Index input_t = triangles_[t].input, input_s = triangles_[s].input;
    triangles_[a].beside[side_towards(a, t)] = s;
    triangles_[c].beside[side_towards(c, s)] = t;
    triangles_[t] = {{x, u, y}, {b, c, s}, input_t};
    triangles_[s] = {{y, w, x}, {d, a, t}, input_s};
    return true;
  }
  /// Returns true if `x`, a vertex of `t`, has an edge to `y`.
  bool neighbours(Index x, Index t, Index y) const {
    Index s = t;
    do {
      int k = 0;
      while (triangles_[s].v[k] != x) ++k;
      if (triangles_[s].v[next(k)] == y) return true;
      s = triangles_[s].beside[k];
    } while (s != t);
    return false;
  }

  /// Returns the error for a reflex edge. It states the height if 106-bit arithmetic finds it positive.
  Error reflex(Index t, int i) const {
    const Triangle& a = triangles_[t];
    const Index v = opposite(t, i);
    const auto from_first = [&](Index w) {
      return widened<DoubleDouble>(in_.point(w)) - widened<DoubleDouble>(in_.point(a.v[0]));
    };
    const V3<DoubleDouble> n = cross(from_first(a.v[1]), from_first(a.v[2]));
    const double height = double(dot(n, from_first(v))) / norm(rounded(n));
    return not_convex("reflex " + edge_text(a.v[i], a.v[next(i)]) + ": vertex " + std::to_string(v) + " is " +
                      (height > 0 ? decimal(height, 3) + " " : "") + "above face " + std::to_string(a.input));
  }

  /// Returns `p` with coordinates below kLeastCoordinate set to 0, as exact signs require.
  static Vec admissible(const Vec& p) {
    const auto flushed = [](double x) { return std::fabs(x) < kLeastCoordinate ? 0 : x; };
    return {flushed(p.x), flushed(p.y), flushed(p.z)};
  }

  /// Proves that a surface without reflex edges bounds a convex body: it does unless it winds around the body more than once or
  /// folds. A point below every face, and a ray from it that meets the surface once, rule both out [Mehlhorn et al. 1999,
  /// sec. 4]. If rounding hides such a point or ray, in small or thin bodies, every vertex is tested against every face.
  Result<bool> globally_convex() const {
    Vec middle{0, 0, 0};
    for (Index v = 0; v < in_.points.size(); ++v) middle = middle + in_.point(v) * (1.0 / double(in_.points.size()));
    middle = admissible(middle);
    const double* o = &middle.x;
    std::atomic<bool> inside = true;
    over_chunks(executor_, triangles_.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
      const bool below = std::all_of(
          triangles_.begin() + std::ptrdiff_t(begin), triangles_.begin() + std::ptrdiff_t(end),
          [&](const Triangle& t) { return exact::orientation(in_.at(t.v[0]), in_.at(t.v[1]), in_.at(t.v[2]), o) < 0; });
      if (!below) inside = false;
    });
    if (!inside) return every_vertex_below();
    for (const Triangle& target : triangles_) {
      const Vec c = admissible((in_.point(target.v[0]) + in_.point(target.v[1]) + in_.point(target.v[2])) * (1.0 / 3));
      const int hits = ray_hits(o, &c.x);
      if (hits == 1) return true;
      if (hits > 1) return not_convex("the surface winds about itself " + std::to_string(hits) + " times");
    }
    return every_vertex_below();
  }
  /// Returns how many triangles the ray from `o` through `c` crosses, or 0 if it meets an edge.
  int ray_hits(const double* o, const double* c) const {
    std::atomic<int> hits = 0;
    std::atomic<bool> meets_edge = false;
    over_chunks(executor_, triangles_.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        int positive = 0, zero = 0;
        for (int i = 0; i < 3; ++i) {
          const int sign = exact::orientation(o, in_.at(triangles_[k].v[i]), in_.at(triangles_[k].v[next(i)]), c);
          positive += sign > 0;
          zero += sign == 0;
        }
        if (positive + zero == 3 && zero > 0) meets_edge = true;
        if (positive == 3) ++hits;
      }
    });
    return meets_edge ? 0 : int(hits);
  }
  /// Proves a convex body from three facts: no vertex is above a face, no two vertices coincide, and not all lie in one plane.
  /// Each face then lies in a facet of the hull, beside its neighbours, so that the surface covers the hull d times. Each
  /// corner of the hull is one vertex, so that there is no second component, and the surface winds d times around that vertex.
  /// A solid has at least four such branch points of order d. But where a sphere covers a sphere d times, the orders, each less
  /// one, sum up to 2 d - 2 [Riemann-Hurwitz]: hence d is 1.
  Result<bool> every_vertex_below() const {
    if (auto apart = no_two_coincide(); !apart) return apart;
    const Triangle& base = triangles_.front();
    const auto off_plane = [&](Index v) { return in_.orientation(base.v[0], base.v[1], base.v[2], v) != 0; };
    Index v = 0;
    while (v < in_.points.size() && !off_plane(v)) ++v;
    if (v == in_.points.size()) {
      return Error{ErrorCode::NotSolid,
                   "all vertices lie in one plane: a flat body is one polygon given twice, counter-clockwise from either side"};
    }
    for (const Triangle& t : triangles_) {
      for (v = 0; v < in_.points.size(); ++v) {
        if (in_.orientation(t.v[0], t.v[1], t.v[2], v) > 0) {
          return not_convex("vertex " + std::to_string(v) + " is above face " + std::to_string(t.input));
        }
      }
    }
    return true;
  }
  Result<bool> no_two_coincide() const {
    std::vector<Index> order(in_.points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](Index v) { return std::tuple(in_.at(v)[0], in_.at(v)[1], in_.at(v)[2], v); };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return place(a) < place(b); });
    const auto twin =
        std::adjacent_find(order.begin(), order.end(), [&](Index a, Index b) { return in_.points[a] == in_.points[b]; });
    if (twin == order.end()) return true;
    return not_convex("vertices " + std::to_string(twin[0]) + " and " + std::to_string(twin[1]) + " coincide");
  }

  const Input& in_;
  std::vector<Triangle> triangles_;
  const Executor& executor_;
};

Result<Facets> solid(const Input& in, bool repair, const Executor& executor) {
  std::vector<Triangle> triangles;
  for (Index f = 0; f < in.faces.size(); ++f) {
    if (!fan(in, f, triangles)) return not_convex("face " + std::to_string(f) + " is degenerate: its vertices are collinear");
  }
  Mesh mesh(in, std::move(triangles), executor);
  if (auto closed = mesh.close(); !closed) return closed.error();
  if (auto convex = mesh.make_convex(repair); !convex) return convex.error();
  return mesh.facets();
}

// ---- Flat bodies -----------------------------------------------------------------------------------------------------------

bool is_two_sided(const Input& in) {
  if (in.faces.size() != 2 || in.faces[0].size() != in.points.size() || in.faces[1].size() != in.points.size()) return false;
  const std::span<const Index> front = in.faces[0];
  const auto at = std::find(in.faces[1].begin(), in.faces[1].end(), front[0]);
  if (at == in.faces[1].end()) return false;
  const std::size_t n = front.size(), offset = std::size_t(at - in.faces[1].begin());
  for (std::size_t i = 0; i < n; ++i) {
    if (in.faces[1][(offset + n - i) % n] != front[i]) return false;
  }
  return true;
}

/// Returns the sign of the turn from a over b to c, projected to the coordinates `x` and `y`.
int turn_sign(const Input& in, Index a, Index b, Index c, int x, int y) {
  const double p[4][3] = {{in.at(a)[x], in.at(a)[y], 0},
                          {in.at(b)[x], in.at(b)[y], 0},
                          {in.at(c)[x], in.at(c)[y], 0},
                          {in.at(a)[x], in.at(a)[y], 1}};
  return exact::orientation(p[0], p[1], p[2], p[3]);
}

Result<Facets> two_sided(const Input& in) {
  const std::span<const Index> loop = in.faces[0];
  const std::size_t n = loop.size();
  for (std::size_t i = 3; i < n; ++i) {
    if (in.orientation(loop[0], loop[1], loop[2], loop[i]) != 0)
      return not_convex("the polygon is not flat: vertex " + std::to_string(loop[i]) + " is off the plane of the first three");
  }
  // A projection along an axis that is not parallel to the polygon's plane keeps the signs of all turns. Exact signs find such
  // an axis even for a thin polygon, whose rounded normal would not.
  int drop = 0;
  while (drop < 2 && turn_sign(in, loop[0], loop[1], loop[2], (drop + 1) % 3, (drop + 2) % 3) == 0) ++drop;
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  // A polygon is convex if it turns to one side at all corners, and goes around once: along x its sides then turn back twice.
  const int winding = turn_sign(in, loop[0], loop[1], loop[2], x, y);
  int last = 0, changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Index a = loop[i], b = loop[(i + 1) % n], c = loop[(i + 2) % n];
    const int sign = turn_sign(in, a, b, c, x, y), way = (in.at(b)[x] > in.at(a)[x]) - (in.at(b)[x] < in.at(a)[x]);
    if (sign == 0 || sign != winding) return not_convex("the polygon is not strictly convex at vertex " + std::to_string(b));
    if (way == 0) continue;
    changes += last != 0 && way != last;
    if (changes > 2)
      return not_convex("the polygon is not strictly convex: it goes around more than once at vertex " + std::to_string(a));
    last = way;
  }
  return Facets{{Loop(loop.begin(), loop.end()), Loop(in.faces[1].begin(), in.faces[1].end())}, {0, 1}};
}

// ---- Half-edges ------------------------------------------------------------------------------------------------------------

/// A side of a facet, from corner `tail` to corner `head`.
struct Side {
  Index tail, head, facet;
  Index before;  ///< the preceding side of the same facet
  Index twin = kNone;
};

std::vector<Side> sides_of(const Facets& facets, std::size_t vertices) {
  std::vector<Side> sides;
  for (Index f = 0; f < facets.loops.size(); ++f) {
    const Loop& loop = facets.loops[f];
    const Index begin = Index(sides.size()), n = Index(loop.size());
    for (Index i = 0; i < n; ++i) sides.push_back({loop[i], loop[(i + 1) % n], f, begin + (i + n - 1) % n});
  }
  const std::vector<Index> order =
      by_edge(vertices, Index(sides.size()), [&](Index s) { return std::pair(sides[s].tail, sides[s].head); });
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    sides[order[i]].twin = order[i + 1];
    sides[order[i + 1]].twin = order[i];
  }
  return sides;
}

/// Returns twice the vector area of a loop.
template <class Real>
V3<Real> area_vector(const Input& in, const Loop& loop) {
  const auto from_first = [&](std::size_t i) { return widened<Real>(in.point(loop[i])) - widened<Real>(in.point(loop[0])); };
  V3<Real> sum{Real(0), Real(0), Real(0)};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum = sum + cross(from_first(i), from_first(i + 1));
  return sum;
}

/// The same, of a sliver in 106 bits: in doubles rounding is what makes its direction.
Vec area_of(const Input& in, const Loop& loop) {
  const Vec area = area_vector<double>(in, loop);
  double size = 0;
  for (const Index v : loop) size = std::max(size, max_abs(in.point(v) - in.point(loop[0])));
  return dot(area, area) > kSliverArea * (size * size) * (size * size) ? area : rounded(area_vector<DoubleDouble>(in, loop));
}

bool all_float(const Input& in) {
  return std::all_of(in.points.begin(), in.points.end(), [](const Vec3& p) {
    return double(float(p[0])) == p[0] && double(float(p[1])) == p[1] && double(float(p[2])) == p[2];
  });
}

/// Groups facets to walking faces. The facets of a group lie within kWalkingFaceUlps of one plane, their normals within
/// kWalkingFaceCosine of its normal, and together they form a disc.
class Grouping {
 public:
  Grouping(const Input& in, const Facets& facets, const std::vector<Side>& sides, const Executor& executor)
      : in_(in), facets_(facets), sides_(sides) {
    const std::size_t count = facets.loops.size();
    first_side_.resize(count);
    for (Index s = Index(sides.size()); s-- > 0;) first_side_[sides[s].facet] = s;
    area_.resize(count);
    over_chunks(executor, count, kPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) area_[f] = area_of(in, facets.loops[f]);
    });
    tolerance_ = kWalkingFaceUlps * (all_float(in) ? kFloatUlp : kDoubleUlp) * extent_of(in.points);
    alone_.resize(count);
    over_chunks(executor, count, kPerTask, [&](std::size_t begin, std::size_t end) {
      for (auto f = Index(begin); f < end; ++f) alone_[f] = is_alone(f);
    });
    std::vector<Index> order;
    for (Index f = 0; f < count; ++f) {
      if (!alone_[f]) order.push_back(f);
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return is_before(a, b); });
    group_.assign(count, kNone);
    for (const Index seed : order) {
      if (group_[seed] == kNone) grow(seed);
    }
    for (Index f = 0; f < count; ++f) {
      if (group_[f] == kNone) group_[f] = f;
    }
  }
  const std::vector<Index>& groups() const { return group_; }

 private:
  template <class Visit>
  void each_side(Index facet, Visit visit) const {
    for (Index s = first_side_[facet]; s < sides_.size() && sides_[s].facet == facet; ++s) visit(sides_[s]);
  }

  /// Groups grow from the larger facets first.
  bool is_before(Index a, Index b) const {
    const double area_a = dot(area_[a], area_[a]), area_b = dot(area_[b], area_[b]);
    return area_a > area_b || (area_a == area_b && a < b);
  }
  /// Returns true if the facet would stay a group of its own, were it the first to grow, as nearly all of a round body would.
  bool is_alone(Index facet) const {
    const Vec n = normalised(area_[facet]), p = in_.point(facets_.loops[facet][0]);
    bool alone = true;
    each_side(facet, [&](const Side& side) { alone = alone && !is_near(sides_[side.twin].facet, n, p); });
    return alone;
  }
  /// Returns true if the facet belongs to no group when that of `seed` grows.
  bool is_free(Index facet, Index seed) const { return group_[facet] == kNone && !(alone_[facet] && is_before(facet, seed)); }
  bool is_near(Index facet, const Vec& n, const Vec& p) const {
    if (!(dot(normalised(area_[facet]), n) > kWalkingFaceCosine)) return false;
    return std::all_of(facets_.loops[facet].begin(), facets_.loops[facet].end(),
                       [&](Index v) { return std::fabs(dot(n, in_.point(v) - p)) <= tolerance_; });
  }

  void grow(Index seed) {
    const Vec n = normalised(area_[seed]), p = in_.point(facets_.loops[seed][0]);
    std::vector<Index> members{seed};
    group_[seed] = seed;
    for (std::size_t i = 0; i < members.size(); ++i) {
      each_side(members[i], [&](const Side& side) {
        const Index other = sides_[side.twin].facet;
        if (is_free(other, seed) && is_near(other, n, p)) group_[other] = seed, members.push_back(other);
      });
    }
    if (members.size() > 1 && !is_disc(seed, members)) {
      for (const Index m : members) group_[m] = m;
    }
  }

  /// Returns true if the group has one border, and the border passes no vertex twice.
  bool is_disc(Index seed, const std::vector<Index>& members) const {
    std::size_t borders = 0;
    const Side* start = nullptr;
    for (const Index m : members) {
      each_side(m, [&](const Side& side) {
        if (group_[sides_[side.twin].facet] != seed) ++borders, start = &side;
      });
    }
    if (borders < 3) return false;
    std::vector<Index> passed;
    const Side* side = start;
    do {
      passed.push_back(side->tail);
      side = following(side);
      while (group_[sides_[side->twin].facet] == seed) side = following(&sides_[side->twin]);
    } while (side != start && passed.size() <= borders);
    std::sort(passed.begin(), passed.end());
    return passed.size() == borders && std::adjacent_find(passed.begin(), passed.end()) == passed.end();
  }
  const Side* following(const Side* side) const {
    const Index index = Index(side - sides_.data());
    const Index last = first_side_[side->facet] + Index(facets_.loops[side->facet].size()) - 1;
    return &sides_[index == last ? first_side_[side->facet] : index + 1];
  }

  const Input& in_;
  const Facets& facets_;
  const std::vector<Side>& sides_;
  std::vector<Index> first_side_, group_;
  std::vector<std::uint8_t> alone_;
  std::vector<Vec> area_;
  double tolerance_;
};

/// Returns `corners` in the order of a space-filling curve (Morton order), so that neighbours share cache lines.
std::vector<Index> along_curve(const Input& in, std::vector<Index> corners) {
  const double extent = extent_of(in.points);
  const auto spread = [](std::uint64_t x) {  // puts two zero bits before each of 21 bits
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  };
  const auto code = [&](Index v) {
    const Vec p = extent > 0 ? in.point(v) * (1 / extent) : Vec{0, 0, 0};
    const auto cell = [](double x) { return std::uint64_t((x * 0.5 + 0.5) * 2097151.0); };
    return spread(cell(p.x)) | spread(cell(p.y)) << 1 | spread(cell(p.z)) << 2;
  };
  std::vector<std::pair<std::uint64_t, Index>> keyed;
  for (const Index v : corners) keyed.emplace_back(code(v), v);
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = keyed[i].second;
  return corners;
}

/// Twice the vector area of a loop, its triangles' computed by expansions: of a convex one it is right however thin.
Vec exact_area_vector(const Input& in, const Loop& loop) {
  Wide sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum + exact::edge_normal(in.at(loop[0]), in.at(loop[i]), kAtRest, in.at(loop[i + 1]), in.at(loop[0]));
  return rounded(sum);
}

/// The unit normal of a face, computed in 106 bits, since in doubles the area of a sliver may vanish, or by expansions where it
/// may in 106 bits.
Vec normal_of(const Input& in, const Loop& border) {
  const auto entry = [](double x) { return std::fabs(x) < kLeastNormalEntry ? 0 : x; };
  double size = 0;
  for (const Index v : border) size = std::max(size, max_abs(in.point(v) - in.point(border[0])));
  const Vec twice = rounded(area_vector<DoubleDouble>(in, border));
  const bool is_lost = max_abs(twice) < kLeastWideArea * double(border.size()) * size * size;
  const Vec area = normalised(is_lost ? exact_area_vector(in, border) : twice);
  return {entry(area.x), entry(area.y), entry(area.z)};
}

/// A face whose corners are numbered one after the other: see ConvexView::rims.
struct Rim {
  Index group;
  std::vector<Index> sides;  ///< of facets, counter-clockwise
};

/// The rims of a body, those of most corners first. Of faces that share a corner only one is a rim.
std::vector<Rim> rims_of(const Input& in, const std::vector<Side>& sides, const std::vector<Index>& group) {
  const auto group_of = [&](Index s) { return group[sides[s].facet]; };
  const auto is_diagonal = [&](Index s) { return group_of(s) == group_of(sides[s].twin); };
  const auto previous = [&](Index s) {
    for (s = sides[s].before; is_diagonal(s);) s = sides[sides[s].twin].before;
    return s;
  };
  std::vector<Index> size(group.size(), 0), any_side(group.size(), kNone), large;
  for (Index s = Index(sides.size()); s-- > 0;) {
    if (!is_diagonal(s)) ++size[group_of(s)], any_side[group_of(s)] = s;
  }
  for (Index g = 0; g < group.size(); ++g) {
    if (size[g] >= kLeastRim) large.push_back(g);
  }
  std::stable_sort(large.begin(), large.end(), [&](Index a, Index b) { return size[a] > size[b]; });

  const double drop = 2 * kRimDrop * extent_of(in.points);
  std::vector<bool> taken(in.points.size(), false);
  std::vector<Rim> rims;
  for (const Index g : large) {
    Rim rim{g, {}};
    Index s = any_side[g];
    do {
      rim.sides.push_back(s);
      s = previous(s);
    } while (s != any_side[g]);
    std::reverse(rim.sides.begin(), rim.sides.end());
    Loop corners, beyond;
    for (const Index side : rim.sides) {
      corners.push_back(sides[side].tail), beyond.push_back(sides[previous(sides[side].twin)].tail);
    }
    const Vec n = normal_of(in, corners), p = in.point(corners[0]);
    if (!std::all_of(beyond.begin(), beyond.end(), [&](Index v) { return dot(n, in.point(v) - p) < -drop; }) ||
        std::any_of(corners.begin(), corners.end(), [&](Index v) { return taken[v]; }))
      continue;
    for (const Index v : corners) taken[v] = true;
    rims.push_back(std::move(rim));
  }
  return rims;
}

/// Returns the plane of a face without FacePlane::over.
FacePlane plane_of(const Input& in, double extent, const Loop& border, const Loop& members) {
  const Vec n = normal_of(in, border), p = in.point(border[0]);
  double thickness = 0;
  for (const Index v : members) thickness = std::max(thickness, thickness_at(n, p, in.point(v), extent));
  return {n.x, n.y, n.z, thickness, 0};
}

Surface link(const Input& in, const Facets& facets, const Executor& executor) {
  Surface out;
  const std::vector<Side> sides = sides_of(facets, in.points.size());
  const std::vector<Index> group = Grouping(in, facets, sides, executor).groups();

  const std::vector<Rim> rims = rims_of(in, sides, group);
  out.rims = std::uint32_t(rims.size());

  std::vector<bool> is_other(in.points.size());
  for (const Side& side : sides) is_other[side.tail] = true;
  for (const Rim& rim : rims) {
    for (const Index s : rim.sides) out.vertex_input.push_back(sides[s].tail), is_other[sides[s].tail] = false;
  }
  std::vector<Index> others;
  for (Index v = 0; v < is_other.size(); ++v) {
    if (is_other[v]) others.push_back(v);
  }
  others = along_curve(in, std::move(others));
  out.vertex_input.insert(out.vertex_input.end(), others.begin(), others.end());
  out.input_vertex.assign(in.points.size(), kNone);
  for (Index i = 0; i < out.vertex_input.size(); ++i) out.input_vertex[out.vertex_input[i]] = i;

  // Half-edges ring by ring: counter-clockwise around a tail, the next side is the twin of the preceding side of the facet.
  std::vector<Index> any_side(in.points.size(), kNone), half_edge(sides.size(), kNone);
  for (Index s = Index(sides.size()); s-- > 0;) any_side[sides[s].tail] = s;
  for (const Rim& rim : rims) {
    for (const Index s : rim.sides) any_side[sides[s].tail] = s;
  }
  std::vector<Index> order;
  for (const Index v : out.vertex_input) {
    const Vec p = in.point(v);
    const Index begin = Index(order.size());
    Index s = any_side[v];
    do {
      half_edge[s] = Index(order.size());
      order.push_back(s);
      s = sides[sides[s].before].twin;
    } while (s != any_side[v]);
    out.vertices.push_back({p.x, p.y, p.z, begin, Index(order.size()) - begin});
  }

  // Number the faces: rims first, then others with a plane, then triangles, in the order of their vertices.
  std::vector<Index> members(facets.loops.size(), 0), number(facets.loops.size(), kNone), sequence;
  for (const Index g : group) ++members[g];
  for (const Rim& rim : rims) number[rim.group] = 0, sequence.push_back(rim.group);
  for (const Index s : order) {
    const Index g = group[sides[s].facet];
    if (number[g] == kNone) number[g] = 0, sequence.push_back(g);
  }
  const auto has_plane = [&](Index g) { return members[g] > 1 || facets.loops[g].size() > 3; };
  std::stable_partition(sequence.begin(), sequence.end(), has_plane);
  for (Index i = 0; i < sequence.size(); ++i) number[sequence[i]] = i;

  out.face_first.assign(sequence.size(), kNone);
  for (Index h = 0; h < order.size(); ++h) {
    const Side& side = sides[order[h]];
    out.half_edges.push_back({out.input_vertex[side.head], half_edge[side.twin], number[group[side.facet]]});
    const bool diagonal = group[side.facet] == group[sides[side.twin].facet];
    if (Index& first = out.face_first[out.half_edges.back().face]; first == kNone && !diagonal) first = h;
  }
  std::vector<Loop> held(sequence.size());
  for (Index f = 0; f < facets.loops.size(); ++f) {
    if (has_plane(group[f]))
      held[number[group[f]]].insert(held[number[group[f]]].end(), facets.loops[f].begin(), facets.loops[f].end());
  }
  const ConvexView view = out.view();
  const double extent = extent_of(in.points);
  out.planes.resize(std::size_t(std::find_if_not(sequence.begin(), sequence.end(), has_plane) - sequence.begin()));
  over_chunks(executor, out.planes.size(), kPlanesPerTask, [&](std::size_t begin, std::size_t end) {
    for (auto f = Index(begin); f < end; ++f) {
      Loop border;
      Index h = out.face_first[f];
      do {
        border.push_back(out.vertex_input[origin(view, h)]);
        h = next_in_face(view, h);
      } while (h != out.face_first[f]);
      out.planes[f] = plane_of(in, extent, border, held[f]);
      out.planes[f].over = height_over(view, vec(out.planes[f]), origin(view, out.face_first[f]));
    }
  });
  out.input_face.resize(facets.input_facet.size());
  for (std::size_t f = 0; f < out.input_face.size(); ++f) out.input_face[f] = number[group[facets.input_facet[f]]];
  return out;
}

/// Makes the surface of a segment or a point.
Result<Surface> without_faces(const Input& in) {
  if (in.points.size() > 2)
    return bad_value(std::to_string(in.points.size()) + " vertices without faces: a point has one, a segment two");
  Surface out;
  out.dimension = int(in.points.size()) - 1;
  for (Index v = 0; v < in.points.size(); ++v) {
    const Vec p = in.point(v);
    out.vertices.push_back({p.x, p.y, p.z, v, Index(out.dimension)});
    out.vertex_input.push_back(v);
    out.input_vertex.push_back(v);
  }
  if (out.dimension == 1) {
    if (in.points[0] == in.points[1]) return bad_value("vertices 0 and 1 coincide");
    out.half_edges = {{1, 1, kNone}, {0, 0, kNone}};
  }
  return out;
}

/// Returns the volume inside the facets. It may differ from that inside the given faces, since flips change the volume.
double volume_of(const Input& in, const Facets& facets) {
  double six = 0;
  const Vec o = in.point(0);
  for (const Loop& loop : facets.loops) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      six += dot(cross(in.point(loop[0]) - o, in.point(loop[i]) - o), in.point(loop[i + 1]) - o);
    }
  }
  return std::fabs(six) / 6;
}

}  // namespace

std::uint32_t vertex_outside(const ConvexView& exact_hull, const ConvexView& level) {
  std::uint32_t outside = kNone, highest = 0, plane_tests = 0;
  each_facet(level, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vertex &p = level.vertices[a], &q = level.vertices[b], &r = level.vertices[c];
    const auto is_higher = [&](const Vertex& w, const Vertex& best) {
      return exact::compare_along_normal(&p.x, &q.x, &r.x, &w.x, &best.x) > 0;
    };
    highest = climb(exact_hull, highest, plane_tests, is_higher);
    if (exact::orientation(p, q, r, exact_hull.vertices[highest]) > 0) outside = highest;
  });
  return outside;
}

double height_over(const ConvexView& view, const Vec& n, std::uint32_t v) {
  std::uint32_t plane_tests = 0;
  const std::uint32_t top = support(view, n, v, plane_tests);
  return exact::height_along(&n.x, &view.vertices[top].x, &view.vertices[v].x);
}

double reach_of(const ConvexView& view) {
  const Box box = box_of(view.vertices);
  Vec mean{0, 0, 0};
  for (const Vertex& v : view.vertices) mean = mean + vec(v) * (1.0 / double(view.vertices.size()));
  double least = kInfinity;
  for (const Vec& centre : {box.least * 0.5 + box.most * 0.5, mean}) {
    double radius = 0;
    for (const Vertex& v : view.vertices) radius = max(radius, norm(vec(v) - centre));
    least = min(least, radius);
  }
  return 2 * least * (1 + 8 * kU);
}

double outer_radius_of(const ConvexView& view, const Vec& centre) {
  double radius = 0;
  for (const Vertex& v : view.vertices) radius = max(radius, norm(vec(v) - centre));
  return radius * (1 + kNormError);
}

double inner_radius_of(const ConvexView& view, const Vec& centre) {
  double least = view.face_first.empty() ? 0 : view.extent;
  each_facet(view, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const exact::Plane plane = exact::plane(vec(view.vertices[a]), vec(view.vertices[b]), vec(view.vertices[c]));
    if (dot(plane.normal, plane.normal) > 0) least = min(least, plane.height - dot(plane.normal, centre));
  });
  return max(0, least - kInnerError * view.extent);
}

ConvexView Surface::view() const {
  ConvexView v;
  v.vertices = vertices;
  v.planes = planes;
  v.half_edges = half_edges;
  v.face_first = face_first;
  v.extent = extent;
  v.rims = rims;
  return v;
}

Result<Surface> make_surface(const LevelArrays& level, bool repair, const Executor& executor) {
  const Result<Input> read = read_input(level);
  if (!read) return read.error();
  const Input& in = read.value();
  Result<Surface> surface = [&]() -> Result<Surface> {
    if (in.faces.empty()) return without_faces(in);
    const bool flat = is_two_sided(in);
    const Result<Facets> facets = flat ? two_sided(in) : solid(in, repair, executor);
    if (!facets) return facets.error();
    Surface linked = link(in, facets.value(), executor);
    linked.dimension = flat ? 2 : 3;
    linked.volume = flat ? 0 : volume_of(in, facets.value());
    return linked;
  }();
  if (surface) surface.value().extent = extent_of(in.points);
  return surface;
}

}  // namespace swiftlet
