// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Convex surface decomposition. The judge shares nothing with it: CGAL's hulls of whole patches, and all triangles of the mesh
// clipped by all their planes in rationals.
#include <swiftlet/decompose.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;
using Rational = CGAL::Exact_rational;
using Exact = CGAL::Simple_cartesian<Rational>;
using Point = Exact::Point_3;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr Growth kGrowths[] = {Growth::DepthFirst, Growth::BreadthFirst, Growth::Cresting};

Point exact(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

CGAL::Orientation side(const std::array<Vec3, 3>& t, const Vec3& p) {
  const auto at = [](const Vec3& q) { return Inexact::Point_3(q.x(), q.y(), q.z()); };
  return CGAL::orientation(at(t[0]), at(t[1]), at(t[2]), at(p));
}

/// The side of a plane from which three points appear clockwise.
struct Half {
  std::array<Vec3, 3> points;
  Exact::Plane_3 plane;  ///< positive outside

  Half(const Vec3& a, const Vec3& b, const Vec3& c) : points{a, b, c}, plane(exact(a), exact(b), exact(c)) {}
  bool holds_none_of(const std::array<Vec3, 3>& t) const {
    return std::ranges::all_of(t, [&](const Vec3& p) { return side(points, p) != CGAL::NEGATIVE; });
  }
  Rational height(const Point& p) const { return plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d(); }
};

std::vector<Point> clipped(const std::vector<Point>& polygon, const Half& half) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational h = half.height(p), g = half.height(q);
    if (h <= 0) kept.push_back(p);
    if ((h < 0 && g > 0) || (h > 0 && g < 0)) kept.push_back(p + (q - p) * Rational(h / (h - g)));
  }
  return kept;
}

/// Whether a convex polygon, given by its corners, has a point strictly inside of all, and not inside or on all of `but`, if
/// there are any.
bool is_inside(std::vector<Point> polygon, const std::vector<Half>& halves, const std::vector<Half>& but = {}) {
  for (const Half& half : halves) {
    polygon = clipped(polygon, half);
    if (polygon.empty()) return false;
  }
  if (!but.empty() && std::ranges::all_of(polygon, [&](const Point& p) {
        return std::ranges::all_of(but, [&](const Half& h) { return h.height(p) <= 0; });
      }))
    return false;
  Rational x = 0, y = 0, z = 0;
  for (const Point& p : polygon) x += p.x(), y += p.y(), z += p.z();
  const Rational n = int(polygon.size());
  return std::ranges::all_of(halves, [&](const Half& h) { return h.height(Point(x / n, y / n, z / n)) < 0; });
}

std::array<Vec3, 3> corners(const MeshModel& mesh, std::size_t t) {
  const auto c = mesh.triangle(t);
  return {mesh.vertex(c[0]), mesh.vertex(c[1]), mesh.vertex(c[2])};
}
bool is_slit(const std::array<Vec3, 3>& t) { return CGAL::collinear(exact(t[0]), exact(t[1]), exact(t[2])); }

/// The planes of a solid hull.
std::vector<Half> halves_of(const std::vector<Vec3>& points) {
  std::vector<Inexact::Point_3> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Inexact::Point_3> hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);
  std::vector<Half> halves;
  for (const auto face : hull.faces()) {
    std::vector<Vec3> loop;
    for (const auto v : hull.vertices_around_face(hull.halfedge(face))) {
      const auto& p = hull.point(v);
      loop.emplace_back(p.x(), p.y(), p.z());
    }
    Half half(loop[0], loop[1], loop[2]);
    const bool inverted = std::ranges::any_of(points, [&](const Vec3& p) { return side(half.points, p) == CGAL::POSITIVE; });
    halves.push_back(inverted ? Half(loop[0], loop[2], loop[1]) : half);
  }
  return halves;
}

/// Planes through the sides of a flat hull and a point off its plane: within the plane, its polygon.
std::vector<Half> sides_of(const std::vector<Vec3>& points, const std::array<Vec3, 3>& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  const Vec3 off = t[0] + Vec3::Unit(axis) * (n[axis] > 0 ? 1 : -1);
  std::vector<Half> halves;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      // All points on the left of i to k, as the plane is seen from outside: their plane with `off` has them below.
      if (i == k || points[i] == points[k]) continue;
      const std::array<Vec3, 3> plane{points[k], points[i], off};
      if (std::ranges::all_of(points, [&](const Vec3& p) { return side(plane, p) != CGAL::POSITIVE; }))
        halves.emplace_back(plane[0], plane[1], plane[2]);
    }
  }
  return halves;
}

std::pair<std::uint32_t, std::uint32_t> edge_of(const MeshModel& mesh, std::size_t t, std::size_t k) {
  const auto c = mesh.triangle(t);
  return std::minmax({c[k], c[(k + 1) % 3]});
}
/// Per edge, the corners that its triangles have beside it.
std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::uint32_t>> thirds(const MeshModel& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::uint32_t>> found;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) found[edge_of(mesh, t, k)].insert(mesh.triangle(t)[(k + 2) % 3]);
  }
  return found;
}

/// What is wrong with a decomposition; "" if nothing.
std::string fault(const MeshModel& mesh, const Decomposition& made) {
  const std::size_t count = mesh.triangle_count();
  std::vector<std::uint32_t> sorted = made.triangles;
  std::ranges::sort(sorted);
  for (std::uint32_t t = 0; t < sorted.size(); ++t) {
    if (sorted[t] != t) return "not each triangle once";
  }
  if (sorted.size() != count) return "not all triangles";
  const auto ends = thirds(mesh);
  std::uint32_t next = 0;
  std::vector<std::array<Vec3, 3>> all;
  for (std::size_t t = 0; t < count; ++t) all.push_back(corners(mesh, t));
  for (std::size_t number = 0; number < made.patches.size(); ++number) {
    const Patch& patch = made.patches[number];
    const std::string where = "patch " + std::to_string(number) + ": ";
    if (patch.first != next || patch.end <= patch.first) return where + "out of order";
    next = patch.end;
    std::set<std::uint32_t> ids, members;
    std::vector<Vec3> points;
    for (std::uint32_t i = patch.first; i < patch.end; ++i) {
      members.insert(made.triangles[i]);
      for (const std::uint32_t v : mesh.triangle(made.triangles[i])) ids.insert(v);
    }
    for (const std::uint32_t v : ids) points.push_back(mesh.vertex(v));
    if (is_slit(all[*members.begin()])) {
      if (members.size() > 1 || !patch.flat) return where + "a triangle without a plane is no patch of its own";
      continue;
    }
    bool flat = true;
    for (const std::uint32_t t : members) {
      for (const Vec3& p : points) {
        const CGAL::Orientation at = side(all[t], p);
        if (at == CGAL::POSITIVE) return where + "triangle " + std::to_string(t) + " is not on the hull";
        flat &= at == CGAL::ZERO;
      }
    }
    if (flat != patch.flat) return where + (flat ? "is flat" : "is not flat");
    const std::array<Vec3, 3>& base = all[made.triangles[patch.first]];
    const std::vector<Half> halves = flat ? sides_of(points, base) : halves_of(points);
    const std::vector<Half> first = flat ? sides_of({base.begin(), base.end()}, base) : std::vector<Half>();
    Vec3 least = points[0], most = points[0];
    for (const Vec3& p : points) least = least.cwiseMin(p), most = most.cwiseMax(p);
    for (std::size_t t = 0; t < count; ++t) {
      const auto& [a, b, c] = all[t];
      const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
      if ((low.array() > most.array()).any() || (high.array() < least.array()).any()) continue;
      if (std::ranges::any_of(halves, [&](const Half& h) { return h.holds_none_of(all[t]); })) continue;
      std::vector<Point> polygon{exact(a), exact(b), exact(c)};
      if (flat) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 &p = all[t][k], &q = all[t][(k + 1) % 3];
          if (ends.at(edge_of(mesh, t, k)).size() == 1 && side(base, p) == CGAL::ZERO && side(base, q) == CGAL::ZERO &&
              is_inside({exact(p), exact(q)}, halves, first))
            return where + "triangle " + std::to_string(t) + " ends within the flat hull";
        }
        if (std::ranges::none_of(all[t], [&](const Vec3& p) { return side(base, p) == CGAL::NEGATIVE; })) continue;
        polygon = clipped(polygon, Half(base[0], base[1], base[2]));
        polygon = clipped(polygon, Half(base[0], base[2], base[1]));
        if (polygon.empty()) continue;
      }
      if (is_inside(polygon, halves, first)) return where + "triangle " + std::to_string(t) + " enters the hull";
    }
  }
  return next == sorted.size() ? "" : "triangles of no patch";
}

Decomposition made(const MeshModel& mesh, Growth growth = Growth::Cresting) {
  DecomposeOptions options;
  options.growth = growth;
  Result<Decomposition> result = decompose(mesh, options);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}
void expect_true(const char* name, const Soup& soup) {
  const MeshModel mesh = soup.mesh();
  for (const Growth growth : kGrowths) EXPECT_EQ(fault(mesh, made(mesh, growth)), "") << name << ", growth " << int(growth);
}
std::vector<std::size_t> sizes(const Decomposition& made) {
  std::vector<std::size_t> found;
  for (const Patch& p : made.patches) found.push_back(p.end - p.first);
  std::ranges::sort(found, std::greater());
  return found;
}

/// Walls over an outline in the plane, counter-clockwise, with a bottom and a top cut into triangles by the caller.
Soup prism(const std::vector<std::array<double, 2>>& outline, const std::vector<Corners>& floor, double height) {
  Soup soup;
  const auto n = std::uint32_t(outline.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : outline) soup.points.emplace_back(x, y, z);
  }
  for (const auto& [p, q, r] : floor) {
    soup.triangles.push_back({p, r, q});
    soup.triangles.push_back({p + n, q + n, r + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    soup.triangles.push_back({i, k, k + n});
    soup.triangles.push_back({i, k + n, i + n});
  }
  return soup;
}
/// 7 6   3 2
/// | 5---4 |
/// 0-------1
Soup letter_u(double height) {
  return prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
               {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}}, height);
}
Soup gear(std::uint32_t teeth) {
  Soup soup;
  const std::uint32_t n = 4 * teeth, up = n + 1;
  for (const double z : {0.0, 0.5}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, radius = i % 4 < 2 ? 1 : 0.7;
      soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    soup.points.emplace_back(0, 0, z);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    soup.triangles.insert(soup.triangles.end(), {{n, k, i}, {n + up, i + up, k + up}, {i, k, k + up}, {i, k + up, i + up}});
  }
  return soup;
}
/// A tube around a trefoil.
Soup knot(std::uint32_t around, std::uint32_t across) {
  Soup soup;
  const auto curve = [](double t) {
    return Vec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t));
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    const double t = 2 * std::numbers::pi * i / around;
    const Vec3 along = (curve(t + 1e-3) - curve(t - 1e-3)).normalized(), u = along.cross(Vec3::UnitZ()).normalized(),
               v = along.cross(u);
    for (std::uint32_t k = 0; k < across; ++k) {
      const double s = 2 * std::numbers::pi * k / across;
      soup.points.push_back(curve(t) + 0.5 * (std::cos(s) * u + std::sin(s) * v));
      const auto at = [&](std::uint32_t x, std::uint32_t y) { return x % around * across + y % across; };
      soup.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      soup.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return soup;
}
/// Unit cubes of a lattice, those that `is_full` says, without the faces between two of them.
template <class Full>
Soup lattice(int side, const Full& is_full) {
  Soup soup;
  const auto id = [&](int x, int y, int z) { return std::uint32_t((x * (side + 1) + y) * (side + 1) + z); };
  for (int x = 0; x <= side; ++x) {
    for (int y = 0; y <= side; ++y) {
      for (int z = 0; z <= side; ++z) soup.points.emplace_back(x, y, z);
    }
  }
  const auto full = [&](std::array<int, 3> at) {
    return std::ranges::all_of(at, [&](int i) { return i >= 0 && i < side; }) && is_full(at[0], at[1], at[2]);
  };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        if (!full({x, y, z})) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const int way : {0, 1}) {
            std::array<int, 3> beside{x, y, z};
            beside[axis] += way ? 1 : -1;
            if (full(beside)) continue;
            const auto corner = [&](int u, int v) {
              std::array<int, 3> at{x, y, z};
              at[axis] += way, at[(axis + 1) % 3] += u, at[(axis + 2) % 3] += v;
              return id(at[0], at[1], at[2]);
            };
            std::array<std::uint32_t, 4> loop{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
            if (!way) std::swap(loop[1], loop[3]);
            soup.triangles.push_back({loop[0], loop[1], loop[2]});
            soup.triangles.push_back({loop[0], loop[2], loop[3]});
          }
        }
      }
    }
  }
  return soup;
}

TEST(Decompose, TakesAConvexBodyAsOnePatch) {
  for (const Soup& soup : {tetrahedron(), box({-1, -2, -3}, {1, 2, 3}), ball(3), scaled(ball(2), 1e-20),
                           lattice(4, [](int, int, int) { return true; })}) {
    for (const Growth growth : kGrowths) {
      const MeshModel mesh = soup.mesh();
      const Decomposition found = made(mesh, growth);
      ASSERT_EQ(found.patches.size(), 1u);
      EXPECT_FALSE(found.patches[0].flat);
      EXPECT_EQ(found.patches[0].virtual_faces, 0u);
      EXPECT_EQ(found.not_convex + found.entered + found.reflex_edges + found.slit_edges, 0u);
      EXPECT_EQ(fault(mesh, found), "");
    }
  }
}

/// A cone over a polygon whose middle is a vertex, too; every other side may be notched, so that the surface has folds.
Soup cone(std::uint32_t sides, double notch) {
  Soup soup;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double u = 2 * EIGEN_PI * i / sides, r = i % 2 ? 1 : 1 - notch;
    soup.points.push_back(r * Vec3(std::cos(u), std::sin(u), 0));
  }
  soup.points.push_back(Vec3(0, 0, 1)), soup.points.push_back(Vec3(0, 0, 0));
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    soup.triangles.push_back({i, next, sides});
    soup.triangles.push_back({next, i, sides + 1});
  }
  return soup;
}

/// Where all triangles around a vertex were tried against each other this took minutes.
TEST(Decompose, IsNotSlowAtAVertexOfThousandsOfTriangles) {
  for (const Growth growth : kGrowths) {
    EXPECT_EQ(made(cone(6000, 0).mesh(), growth).patches.size(), 1u);
    EXPECT_EQ(made(cone(3000, 0.3).mesh(), growth).patches.size(), 1500u);
  }
}

TEST(Decompose, KeepsItsWordAroundAVertexOfMany) {
  expect_true("cone", cone(100, 0));
  expect_true("notched cone", cone(100, 0.3));
  Soup open = cone(90, 0.2);
  open.triangles.erase(open.triangles.begin() + 31), open.triangles.erase(open.triangles.begin() + 100);
  expect_true("open cone", open);
  Soup two = cone(80, 0.25);
  const Soup other = moved(cone(80, 0.1), Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitX()).toRotationMatrix(), Vec3(0.25, 0, 0));
  for (const auto& t : other.triangles) {
    std::array<std::uint32_t, 3> corners = t;
    for (std::uint32_t& v : corners) v += std::uint32_t(two.points.size());
    two.triangles.push_back(corners);
  }
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  expect_true("two cones with bases in one plane", two);
}

TEST(Decompose, KeepsPatchesOnTheirHullsWhichTheSurfaceDoesNotEnter) {
  expect_true("torus", torus(24, 12));
  expect_true("thin torus", torus(40, 6, 0.1));
  expect_true("gear", gear(7));
  expect_true("knot", knot(60, 8));
  expect_true("letter U", letter_u(1));
  expect_true("wave", patch(12, [](double x, double y) { return 0.2 * std::sin(5 * x) * std::cos(4 * y); }));
  expect_true("nested", [] {
    Soup soup = ball(2);
    soup.add(scaled(ball(2), 0.5));
    return soup;
  }());
  Random random(7);
  expect_true("scattered", scattered(random, 60, 0.5));
  Soup crossing = ball(2);
  crossing.add(moved(ball(2), random.rotation(), {0.7, 0.2, 0.1}));
  expect_true("crossing", crossing);
}

TEST(Decompose, DecidesCoplanarFacesExactly) {
  expect_true("steps", lattice(4, [](int x, int, int z) { return z <= x; }));
  expect_true("chequers", lattice(3, [](int x, int y, int z) { return (x + y + z) % 2 == 0; }));
  expect_true("frame", lattice(4, [](int x, int y, int z) { return x % 3 == 0 || y % 3 == 0 || z % 3 == 0; }));
  for (int seed = 0; seed < 20; ++seed) {
    Random random(std::uint64_t(100 + seed));
    std::vector<bool> full;
    for (int i = 0; i < 27; ++i) full.push_back(random.in_ball().x() > -0.1);
    full[0] = true;
    const Soup soup = lattice(3, [&](int x, int y, int z) { return full[std::size_t(9 * x + 3 * y + z)]; });
    expect_true(("lattice " + std::to_string(seed)).c_str(), soup);
    expect_true("turned", moved(soup, random.rotation(), random.in_ball()));
  }
}

TEST(Decompose, KeepsItsWordAboutAnyMesh) {
  for (int seed = 0; seed < 150; ++seed) {
    Random random(std::uint64_t(1000 + seed));
    expect_true(("seed " + std::to_string(seed)).c_str(), any(random));
  }
}

TEST(Decompose, CutsAFlatFaceThatIsNotConvex) {
  // The notch lies in none of the hulls.
  const auto holds_notch = [](const MeshModel& mesh, const Decomposition& found) {
    return std::ranges::any_of(found.patches, [&](const Patch& patch) {
      bool left = false, right = false;
      for (std::uint32_t i = patch.first; i < patch.end; ++i) {
        for (const std::uint32_t v : mesh.triangle(found.triangles[i])) {
          const Vec3 p = mesh.vertex(v);
          left |= p.y() > 1 && p.x()<1.5, right |= p.y()> 1 && p.x() > 1.5;
        }
      }
      return left && right;
    });
  };
  Soup solid = letter_u(1), sheet = letter_u(1);
  sheet.triangles.clear();
  for (const auto& t : solid.triangles) {
    if (std::ranges::all_of(t, [](std::uint32_t p) { return p >= 8; })) sheet.triangles.push_back(t);
  }
  for (const Growth growth : kGrowths) {
    for (const Soup& soup : {solid, sheet}) {
      const MeshModel mesh = soup.mesh();
      const Decomposition found = made(mesh, growth);
      EXPECT_EQ(fault(mesh, found), "");
      EXPECT_FALSE(holds_notch(mesh, found));
      EXPECT_GE(found.patches.size(), 2u);
    }
  }
}

TEST(Decompose, SplitsAtDefectsAndCountsThem) {
  const Soup square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  Decomposition found = made(square.mesh());
  EXPECT_EQ(found.patches.size(), 1u);
  EXPECT_EQ(found.patches[0].virtual_faces, 2u);
  EXPECT_TRUE(found.patches[0].flat);
  EXPECT_EQ(found.open_edges, 4u);

  Soup flipped = square;
  flipped.triangles[1] = {0, 3, 2};
  found = made(flipped.mesh());
  EXPECT_EQ(found.patches.size(), 2u);
  EXPECT_EQ(found.flipped_edges, 1u);

  Soup fin = square;
  fin.triangles.push_back({0, 2, 4});
  found = made(fin.mesh());
  EXPECT_EQ(found.patches.size(), 3u);
  EXPECT_EQ(found.non_manifold_edges, 1u);

  Soup slit = square;
  slit.points.emplace_back(0.5, 0.5, 0);
  slit.triangles = {{0, 1, 2}, {0, 2, 5}, {0, 5, 3}, {5, 2, 3}};
  found = made(slit.mesh());
  EXPECT_EQ(sizes(found), (std::vector<std::size_t>{2, 1, 1}));
  EXPECT_EQ(found.slit_edges, 3u);

  Soup dented = square;
  dented.points[3] = {0, 1, 0.5};
  found = made(dented.mesh());
  EXPECT_EQ(found.patches.size(), 2u);
  EXPECT_EQ(found.reflex_edges, 1u);

  // An open box, whose lid its hull closes with two triangles.
  Soup open = box({0, 0, 0}, {1, 1, 1});
  std::erase_if(open.triangles,
                [](const Corners& t) { return std::ranges::all_of(t, [](std::uint32_t p) { return p >= 4; }); });
  found = made(open.mesh());
  EXPECT_EQ(found.patches.size(), 1u);
  EXPECT_EQ(found.patches[0].virtual_faces, 2u);
  EXPECT_EQ(found.open_edges, 4u);

  Soup moebius;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double u = 2 * std::numbers::pi * i / 12;
    for (const double w : {-0.3, 0.3})
      moebius.points.emplace_back((1 + w * std::cos(u / 2)) * std::cos(u), (1 + w * std::cos(u / 2)) * std::sin(u),
                                  w * std::sin(u / 2));
    const std::uint32_t next = i == 11 ? 1 : 2 * i + 2, after = i == 11 ? 0 : 2 * i + 3;
    moebius.triangles.insert(moebius.triangles.end(), {{2 * i, next, 2 * i + 1}, {next, after, 2 * i + 1}});
  }
  found = made(moebius.mesh());
  EXPECT_EQ(found.flipped_edges, 1u);
  EXPECT_EQ(found.open_edges, 24u);
  for (const Soup& soup : {flipped, fin, slit, dented, open, moebius}) expect_true("defects", soup);
}

TEST(Decompose, DecomposesASurfaceOnceForEachTimeItIsGiven) {
  const Soup once = ball(2);
  Soup twice = once, both = once;
  twice.triangles.insert(twice.triangles.end(), once.triangles.begin(), once.triangles.end());
  for (const auto& [p, q, r] : once.triangles) both.triangles.push_back({p, r, q});
  const std::size_t count = once.triangles.size();
  const Decomposition found = made(twice.mesh());
  EXPECT_EQ(sizes(found), (std::vector<std::size_t>{count, count}));
  EXPECT_EQ(found.non_manifold_edges + found.reflex_edges, 0u);
  // Seen from inside all edges are reflex.
  const Decomposition shell = made(both.mesh());
  EXPECT_EQ(sizes(shell).front(), count);
  EXPECT_EQ(shell.patches.size(), 1 + count);
  EXPECT_EQ(shell.reflex_edges, 3 * count / 2);
  expect_true("twice", twice);
  expect_true("both sides", both);
}

TEST(Decompose, SeesTheFacesOfAScrollThatItHasTaken) {
  // All edges are convex, and after one turn the next one sees the first from outside.
  for (const double widening : {0.1, -0.06}) {
    Soup scroll;
    constexpr std::uint32_t kSteps = 48;
    for (const double z : {0.0, 1.0}) {
      for (std::uint32_t i = 0; i <= kSteps; ++i) {
        const double angle = 4 * std::numbers::pi * i / kSteps, radius = 1 + widening * angle;
        scroll.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    }
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t up = kSteps + 1;
      scroll.triangles.insert(scroll.triangles.end(), {{i, i + 1, i + 1 + up}, {i, i + 1 + up, i + up}});
    }
    const MeshModel mesh = scroll.mesh();
    for (const Growth growth : kGrowths) {
      const Decomposition found = made(mesh, growth);
      EXPECT_EQ(fault(mesh, found), "");
      EXPECT_EQ(found.reflex_edges, 0u);
      EXPECT_GE(found.patches.size(), 2u);
      EXPECT_GE(found.not_convex + found.entered, 1u);
    }
  }
}

TEST(Decompose, GivesTheSamePatchesEveryTime) {
  const MeshModel mesh = torus(40, 20).mesh();
  for (const Growth growth : kGrowths) {
    const Decomposition one = made(mesh, growth), two = made(mesh, growth);
    EXPECT_EQ(one.triangles, two.triangles);
    EXPECT_EQ(sizes(one), sizes(two));
  }
}

TEST(Decompose, RefusesAMeshThatWasCutAndStopsWhereTold) {
  const MeshModel mesh = torus(60, 30).mesh();
  Detail detail;
  detail.deviation = 0.5;
  EXPECT_EQ(decompose(mesh.cut(detail)).error().code, ErrorCode::BadValue);
  std::vector<double> fractions;
  DecomposeOptions options;
  options.progress = [&](double done, std::string_view) { return fractions.push_back(done), true; };
  ASSERT_TRUE(decompose(mesh, options));
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_GE(fractions.size(), 20u);
  EXPECT_EQ(fractions.back(), 1);
  for (const double until : {0.0, 0.02, 0.6}) {
    options.progress = [until](double done, std::string_view) { return done < until; };
    const Result<Decomposition> stopped = decompose(mesh, options);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace swiftlet
