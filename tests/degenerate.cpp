// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "degenerate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

namespace swiftlet::degenerate {
namespace {

using bodies::Polyhedron;
using Index = std::uint32_t;
using Point = std::array<int, 3>;
using Wide = std::array<long long, 3>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// 0 to count - 1.
  int below(int count) { return int(engine_() % std::uint64_t(count)); }
  int between(int least, int most) { return least + below(most - least + 1); }
  bool once_in(int count) { return below(count) == 0; }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

// ---- Integers ---------------------------------------------------------------------------------------------------------------

Wide difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Wide cross(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long long dot(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// Six times the signed volume of a tetrahedron.
long long volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(cross(difference(b, a), difference(c, a)), difference(d, a));
}

/// The corners of a convex polygon that spans these points of a plane, counter-clockwise seen against its normal.
std::vector<Index> wrapped(const std::vector<Point>& points, const std::vector<Index>& coplanar, const Wide& normal) {
  const Index first =
      *std::min_element(coplanar.begin(), coplanar.end(), [&](Index a, Index b) { return points[a] < points[b]; });
  std::vector<Index> loop;
  Index p = first;
  do {
    loop.push_back(p);
    Index best = p;
    for (const Index q : coplanar) {
      if (points[q] == points[p]) continue;
      const Wide to_q = difference(points[q], points[p]), to_best = difference(points[best], points[p]);
      const long long turn = dot(normal, cross(to_best, to_q));
      if (best == p || turn < 0 || (turn == 0 && dot(to_q, to_q) > dot(to_best, to_best))) best = q;
    }
    p = best;
  } while (p != first);
  return loop;
}

/// The facets of the hull, by trying all planes; none where the points have no volume.
std::vector<std::vector<Index>> hull_of(const std::vector<Point>& points) {
  std::vector<std::vector<Index>> facets;
  std::set<std::vector<Index>> known;
  const Index n = Index(points.size());
  for (Index i = 0; i < n; ++i) {
    for (Index j = i + 1; j < n; ++j) {
      for (Index k = j + 1; k < n; ++k) {
        Wide normal = cross(difference(points[j], points[i]), difference(points[k], points[i]));
        if (normal == Wide{0, 0, 0}) continue;
        std::vector<Index> coplanar;
        long long least = 0, most = 0;
        for (Index v = 0; v < n; ++v) {
          const long long height = dot(normal, difference(points[v], points[i]));
          least = std::min(least, height), most = std::max(most, height);
          if (height == 0) coplanar.push_back(v);
        }
        if ((least < 0) == (most > 0) || !known.insert(coplanar).second) continue;
        if (most > 0) normal = {-normal[0], -normal[1], -normal[2]};
        facets.push_back(wrapped(points, coplanar, normal));
      }
    }
  }
  return facets;
}

long long volume_of(const std::vector<Point>& points, const std::vector<std::vector<Index>>& loops) {
  long long six = 0;
  for (const auto& loop : loops)
    for (std::size_t i = 2; i < loop.size(); ++i)
      six += volume(points[0], points[loop[0]], points[loop[i - 1]], points[loop[i]]);
  return six;
}

std::vector<std::vector<Index>> loops_of(const Polyhedron& body) {
  std::vector<std::vector<Index>> loops;
  std::size_t at = 0;
  for (const Index size : body.sizes) {
    loops.emplace_back(body.corners.begin() + std::ptrdiff_t(at), body.corners.begin() + std::ptrdiff_t(at + size));
    at += size;
  }
  return loops;
}

// ---- Topologies -------------------------------------------------------------------------------------------------------------

using Triangles = std::vector<std::array<Index, 3>>;

/// Cuts random ears off a loop.
void triangulate(Random& random, std::vector<Index> loop, Triangles& out) {
  while (loop.size() >= 3) {
    const std::size_t n = loop.size(), i = std::size_t(random.below(int(n)));
    out.push_back({loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]});
    loop.erase(loop.begin() + std::ptrdiff_t(i));
    if (n == 3) return;
  }
}

std::vector<Index> counted(Index count) {
  std::vector<Index> loop(count);
  std::iota(loop.begin(), loop.end(), 0u);
  return loop;
}

bool neighbours(const Triangles& triangles, Index x, Index y) {
  return std::any_of(triangles.begin(), triangles.end(),
                     [&](const auto& t) { return std::count(t.begin(), t.end(), x) + std::count(t.begin(), t.end(), y) == 2; });
}

/// Replaces an edge by the other diagonal of its two triangles, seldom one that is there already.
void flip(Random& random, Triangles& triangles) {
  auto& t = triangles[std::size_t(random.below(int(triangles.size())))];
  const int i = random.below(3);
  const Index u = t[std::size_t(i)], w = t[std::size_t(i + 1) % 3], x = t[std::size_t(i + 2) % 3];
  for (auto& s : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (s[k] != w || s[(k + 1) % 3] != u) continue;
      const Index y = s[(k + 2) % 3];
      if (x == y || (neighbours(triangles, x, y) && !random.once_in(32))) return;
      t = {x, u, y}, s = {y, w, x};
      return;
    }
  }
}

/// A closed sphere: a polygon's two sides, triangles split, edges flipped.
Triangles sphere(Random& random, Index vertices) {
  Triangles triangles;
  Index count = Index(random.between(3, int(vertices)));
  std::vector<Index> loop = counted(count);
  triangulate(random, loop, triangles);
  std::reverse(loop.begin(), loop.end());
  triangulate(random, loop, triangles);
  for (; count < vertices; ++count) {
    const std::size_t at = std::size_t(random.below(int(triangles.size())));
    const auto [a, b, c] = triangles[at];
    triangles[at] = {a, b, count};
    triangles.push_back({b, c, count});
    triangles.push_back({c, a, count});
  }
  for (int flips = random.below(3 * int(vertices)); flips > 0; --flips) flip(random, triangles);
  return triangles;
}

/// A bipyramid over vertices 2, 3, ..., whatever these wind like.
Triangles bipyramid(Index vertices) {
  Triangles triangles;
  const Index n = vertices - 2;
  for (Index i = 0; i < n; ++i) {
    triangles.push_back({2 + i, 2 + (i + 1) % n, 0});
    triangles.push_back({2 + (i + 1) % n, 2 + i, 1});
  }
  return triangles;
}

/// Three by three quads, closed to a ring both ways.
Triangles torus() {
  Triangles triangles;
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) {
      const auto at = [&](Index p, Index q) { return p % 3 * 3 + q % 3; };
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

void put(const Triangles& triangles, Polyhedron& body) {
  for (const auto& [a, b, c] : triangles) body.add({a, b, c});
}

// ---- Points -----------------------------------------------------------------------------------------------------------------

Point lattice_point(Random& random, int reach) {
  return {random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
}

std::vector<Point> points(Random& random, std::size_t count) {
  std::vector<Point> all;
  const int kind = random.below(5), reach = random.between(1, 4);
  const Point o = lattice_point(random, reach), u = lattice_point(random, reach), w = lattice_point(random, reach);
  for (std::size_t i = 0; i < count; ++i) {
    const int s = random.between(-3, 3), t = kind == 2 ? 0 : random.between(-3, 3);  // 1: a plane, 2: a line
    if (kind == 1 || kind == 2)
      all.push_back({o[0] + s * u[0] + t * w[0], o[1] + s * u[1] + t * w[1], o[2] + s * u[2] + t * w[2]});
    else if (kind == 3 && i > 3)  // few places
      all.push_back(all[std::size_t(random.below(int(i)))]);
    else
      all.push_back(lattice_point(random, reach));
  }
  if (kind == 4)  // all but one in a plane
    for (std::size_t i = 1; i < count; ++i) all[i][2] = 0;
  return all;
}

/// Two apexes and a convex polygon, some times around.
std::vector<Point> wound(Random& random) {
  constexpr Point kOctagon[] = {{2, -1, 0}, {2, 1, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 1, 0}, {-2, -1, 0}, {-1, -2, 0}, {1, -2, 0}};
  std::vector<Point> all{lattice_point(random, 1), lattice_point(random, 1)};
  if (random.once_in(2)) all[0][2] = 1, all[1][2] = -1;
  const int step = 1 << random.below(2), turns = random.between(1, 2);
  for (int i = 0; i < 8 * turns; i += step) all.push_back(kOctagon[i % 8]);
  return all;
}

/// The corners of a hull, its facets whole or cut into triangles; nothing where the points have no volume.
Polyhedron hull(Random& random, std::vector<Point>& lattice) {
  Polyhedron body;
  const auto facets = hull_of(lattice);
  std::vector<Index> number(lattice.size(), kNone);
  std::vector<Point> corners;
  for (const auto& facet : facets) {
    std::vector<Index> loop;
    for (const Index v : facet) {
      if (number[v] == kNone) number[v] = Index(corners.size()), corners.push_back(lattice[v]);
      loop.push_back(number[v]);
    }
    if (random.once_in(2)) {
      Triangles cut;
      triangulate(random, loop, cut);
      put(cut, body);
    } else {
      body.corners.insert(body.corners.end(), loop.begin(), loop.end());
      body.sizes.push_back(Index(loop.size()));
    }
  }
  lattice = corners;
  return body;
}

/// The lattice under a map of positive determinant that rounds nothing.
void place(Random& random, Arrays& arrays, int scale, int spread) {
  std::array<int, 3> exponent, shear;
  for (int& e : exponent) e = scale + (spread > 0 ? random.between(-spread, spread) : 0);
  for (int& s : shear) s = random.once_in(2) ? random.between(-3, 3) : 0;
  arrays.body.points.clear();
  for (const Point& p : arrays.lattice) {
    const double x = p[0] + shear[0] * p[1] + shear[1] * p[2], y = p[1] + shear[2] * p[2], z = p[2];
    arrays.body.points.emplace_back(std::ldexp(x, exponent[0]), std::ldexp(y, exponent[1]), std::ldexp(z, exponent[2]));
  }
}

// ---- Cases ------------------------------------------------------------------------------------------------------------------

/// One thing wrong, or nothing that matters.
void damage(Random& random, Arrays& arrays) {
  Polyhedron& body = arrays.body;
  constexpr double kOdd[] = {0.0,
                             -0.0,
                             1e-300,
                             1e-71,
                             1e-70,
                             1e45,
                             1e46,
                             std::numeric_limits<double>::infinity(),
                             -1e300,
                             5e-324,
                             std::numeric_limits<double>::quiet_NaN()};
  constexpr Index kOddIndex[] = {0, 1, 2, 1000, 0x3fffffff, 0x40000000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
  if (body.corners.empty() || body.sizes.empty()) return;
  const auto any = [&](const auto& values) { return std::size_t(random.below(int(values.size()))); };
  const auto vertex = any(body.points), corner = any(body.corners), face = any(body.sizes);
  switch (random.below(12)) {
    case 0:  // a vertex twice, some faces on the one, some on the other
      body.points.push_back(body.points[vertex]);
      if (!arrays.lattice.empty()) arrays.lattice.push_back(arrays.lattice[vertex]);
      for (Index& v : body.corners)
        if (v == vertex && random.once_in(2)) v = Index(body.points.size() - 1);
      return;
    case 1: body.corners[corner] = Index(any(body.points)); return;
    case 2: body.corners[corner] = kOddIndex[random.below(int(std::size(kOddIndex)))]; return;
    case 3: body.sizes[face] = kOddIndex[random.below(int(std::size(kOddIndex)))]; return;
    case 4: body.corners.pop_back(); return;
    case 5: std::reverse(body.corners.begin(), body.corners.end()); return;
    case 6: std::swap(body.corners[corner], body.corners[any(body.corners)]); return;
    case 7: {  // a face twice
      const std::vector<Index> twice(body.corners.begin(),
                                     body.corners.begin() + std::min<std::ptrdiff_t>(std::ssize(body.corners), 3));
      body.corners.insert(body.corners.end(), twice.begin(), twice.end());
      body.sizes.push_back(Index(twice.size()));
      return;
    }
    case 8: body.sizes.clear(); break;
    case 9: body.points[vertex] = body.points[any(body.points)]; break;
    case 10: body.points[vertex][random.below(3)] = kOdd[random.below(int(std::size(kOdd)))]; break;
    default:
      for (Vec3& p : body.points)
        for (double& x : p) x *= 1 + random.between(-2, 2) * 0x1p-52;
  }
  arrays.lattice.clear();
}

/// A level around the one before, or not.
Arrays around(Random& random, const Arrays& finer) {
  Arrays level = finer;
  const double factor = std::ldexp(1.0, random.between(0, 2));
  for (Vec3& p : level.body.points) p *= factor;
  level.lattice.clear();
  return level;
}

void name_relatives(Random& random, Arrays& arrays) {
  const auto fill = [&](std::vector<Index>& list, std::size_t count) {
    if (!random.once_in(3)) return;
    list.resize(count + std::size_t(random.below(2)));
    for (Index& v : list) v = Index(random.below(int(count) + 2));
  };
  fill(arrays.child_vertex, arrays.body.points.size());
  fill(arrays.child_of_face, arrays.body.sizes.size());
  fill(arrays.vertex_source, arrays.body.points.size());
  fill(arrays.face_source, arrays.body.sizes.size());
  fill(arrays.face_source_begin, arrays.body.sizes.size() + 1);
}

/// Whether a triangle's corners lie on one line.
bool has_sliver(const Arrays& arrays) {
  for (const auto& t : loops_of(arrays.body)) {
    const Point& p = arrays.lattice[t[0]];
    if (cross(difference(arrays.lattice[t[1]], p), difference(arrays.lattice[t[2]], p)) == Wide{0, 0, 0}) return true;
  }
  return false;
}

Arrays any_arrays(Random& random, bool& convex) {
  Arrays arrays;
  const int kind = random.below(10);
  convex = kind < 3;
  if (convex) {
    do {
      arrays.lattice = points(random, std::size_t(random.between(4, 9)));
      arrays.body = hull(random, arrays.lattice);
    } while (arrays.body.sizes.empty());
    return arrays;
  }
  const Index count = Index(kind == 6 ? 9 : random.between(3, 10));
  arrays.lattice = points(random, count);
  switch (kind) {
    case 3: arrays.body = bodies::two_sided(std::vector<Vec3>(count)); break;
    case 4:
      arrays.lattice = wound(random);
      put(bipyramid(Index(arrays.lattice.size())), arrays.body);
      break;
    case 6: put(torus(), arrays.body); break;
    case 7:
      for (int faces = random.below(8); faces > 0; --faces) {
        for (Index size = arrays.body.sizes.emplace_back(Index(random.between(2, 5))); size > 0; --size)
          arrays.body.corners.push_back(Index(random.below(int(count))));
      }
      break;
    default:
      for (int tries = 0; tries < 40 && (tries == 0 || has_sliver(arrays)); ++tries) {
        if (tries % 8 == 7) arrays.lattice = points(random, count);
        arrays.body = {};
        put(sphere(random, count), arrays.body);
      }
  }
  return arrays;
}

}  // namespace

LevelArrays Arrays::level() const {
  LevelArrays level = body.level();
  level.child_vertex = child_vertex;
  level.child_of_face = child_of_face;
  level.vertex_source = vertex_source;
  level.face_source_begin = face_source_begin;
  level.face_source = face_source;
  return level;
}

Case make(std::uint64_t number) {
  Random random(number);
  Case given;
  given.levels.push_back(any_arrays(random, given.convex));
  const bool scaled = random.once_in(4), spread = random.once_in(4);
  const int reach = spread ? random.once_in(2) ? 20 : 60 : 0;
  place(random, given.levels[0], scaled ? random.between(-80, 80) : 0, reach);
  given.moderate = reach <= 20;
  given.options.repair = random.once_in(4);
  given.options.table.map_cells = 1 + random.below(8);
  if (random.once_in(16)) {
    const lut::Resolution resolution = lut::Resolution(random.below(6));
    const double factors[] = {-1, 0, 1, 2, 1e6, 1e7, std::numeric_limits<double>::quiet_NaN()};
    given.options.table = {resolution, factors[random.below(7)], std::uint32_t(random.below(10))};
    given.convex = false;
  }
  while (random.once_in(3)) {
    damage(random, given.levels[0]);
    given.convex = given.moderate = false;
  }
  while (given.levels.size() < 34 && random.once_in(given.levels.size() == 1 ? 4 : 2)) {
    bool ignored;
    given.levels.push_back(random.once_in(4) ? any_arrays(random, ignored) : around(random, given.levels.back()));
    if (given.levels.back().body.points.empty()) place(random, given.levels.back(), 2, 0);
    if (random.once_in(4)) {
      damage(random, given.levels.back());
      given.moderate = false;
    }
    given.convex = false;
  }
  if (random.once_in(4)) {
    for (Arrays& level : given.levels) name_relatives(random, level);
    given.convex = false;
  }
  return given;
}

namespace {

/// Whether the triangles given bound the hull of their points, once.
std::string fault_of_lattice(const Arrays& arrays, const Model& model) {
  const auto loops = loops_of(arrays.body);
  const long long hull = volume_of(arrays.lattice, hull_of(arrays.lattice));
  if ((model.dimension() == 3) != (hull > 0)) return "dimension " + std::to_string(model.dimension());
  const bool triangles = std::all_of(arrays.body.sizes.begin(), arrays.body.sizes.end(), [](Index n) { return n == 3; });
  if (triangles && volume_of(arrays.lattice, loops) != hull) return "accepted a surface that is not the hull's";
  return {};
}

/// Queries about two bodies, each answer checked.
std::string ask(const Model& a, const Model& b, bool converges) {
  const double size = a.extent() + b.extent();
  const Pose poses[] = {
      {}, {Mat3::Identity(), Vec3(size, 0, 0)}, {bodies::rotation(1, 2, 3, 4), Vec3(size, size / 3, 2 * size)}};
  PairSeed seed;
  for (const Pose& pose : poses) {
    const Answer answer = distance(a, b, pose, seed);
    if (const Check checked = check(a, b, pose, answer, Question::Exact); !checked) return "distance: " + checked.message;
    if (converges && answer.status != Status::Converged) return "a distance did not converge";
    if (converges && signed_distance(a, b, pose, seed).status != Status::Converged) return "a signed distance did not converge";
  }
  return {};
}

/// A file with right hashes and other vertices: flattened, squeezed to a line, or two in one place.
std::string fault_of_forgery(const Model& model, const Model& other) {
  for (const int kind : {0, 1, 2}) {
    bodies::Bytes block = bodies::bytes_of(model);
    const auto header = bodies::read<LevelHeader>(block, bodies::level_header_at(0));
    const auto at = [&](std::size_t v) { return std::size_t(header.section.offset) + v * sizeof(Vertex); };
    for (std::size_t v = 0; v < header.vertex_count; ++v) {
      if (kind < 2) bodies::write(block, at(v) + 16, 0.0);
      if (kind == 1) bodies::write(block, at(v) + 8, bodies::read<double>(block, at(v)));
    }
    if (kind == 2) std::memcpy(block.data() + at(0), block.data() + at(header.vertex_count - 1), 3 * sizeof(double));
    bodies::rehash(block);
    const Result<Model> forged = load(block);
    if (!forged) return "forgery refused: " + forged.error().message;
    if (model.dimension() == 3 && verify(forged.value())) return "a forgery is verified";
    (void)verify(forged.value());
    PairSeed seed;
    for (const Pose& pose : {Pose{}, Pose{bodies::rotation(1, 2, 3, 4), Vec3(1, 2, 3)}}) {
      const Answer answer = distance(forged.value(), other, pose, seed);
      if (!(answer.lower >= 0 && answer.lower <= answer.upper)) return "no interval of a forgery";
    }
  }
  return {};
}

}  // namespace

Outcome judge(const Case& given) {
  std::vector<LevelArrays> levels;
  for (const Arrays& arrays : given.levels) levels.push_back(arrays.level());
  const Result<Model> made = Model::from_levels(levels, given.options);
  if (!made) {
    const std::string& refusal = made.error().message;
    const bool senseless =
        refusal.empty() || refusal.find(" is -") != refusal.npos || refusal.find("nan above") != refusal.npos;
    return {false, refusal, senseless || given.convex ? "refused: " + refusal : ""};
  }
  const Model& model = made.value();
  Outcome outcome{true, {}, {}};
  const Arrays& exact = given.levels[0];
  if (const Check verified = verify(model); !verified) outcome.fault = "verify: " + verified.message;
  if (outcome.fault.empty() && !exact.lattice.empty() && !given.options.repair) outcome.fault = fault_of_lattice(exact, model);
  const double size = std::ldexp(1.0, model.extent() > 0 ? std::ilogb(model.extent()) : 0);
  const ModelOptions plain{.repair = false, .table = {lut::Resolution::None, 2, 1}};
  const Model cube = bodies::model(bodies::box(size, size, size), plain),
              flat = bodies::model(bodies::two_sided({{0, 0, 0}, {size, 0, 0}, {0, size, 0}}), plain);
  for (const Model* other : {&model, &cube, &flat})
    if (outcome.fault.empty()) outcome.fault = ask(model, *other, given.moderate);
  if (outcome.fault.empty() && model.dimension() >= 2) outcome.fault = fault_of_forgery(model, cube);
  return outcome;
}

}  // namespace swiftlet::degenerate
