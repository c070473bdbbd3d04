// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_families.h"

#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh_front.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include <CGAL/Simple_cartesian.h>
#include <Eigen/Geometry>

#include "mesh_regions.h"

namespace swiftlet::mesh_families {

using namespace soups;
using shapes::Random;
using Number = CGAL::Exact_rational;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The truth -------------------------------------------------------------------------------------------------------------

namespace {

/// Whether two triangles share a point, by CGAL's predicates alone. A flat triangle is its longest side.
bool share_a_point(const Triangle<Number>& a, const Triangle<Number>& b) {
  using Kernel = CGAL::Simple_cartesian<Number>;
  using Solid = Kernel::Triangle_3;
  using Line = Kernel::Segment_3;
  const auto at = [](const Point<Number>& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  const auto solid = [&](const Triangle<Number>& t) { return Solid(at(t[0]), at(t[1]), at(t[2])); };
  const auto longest = [&](const Triangle<Number>& t) {
    Line best(at(t[0]), at(t[1]));
    for (const Line& side : {Line(at(t[1]), at(t[2])), Line(at(t[2]), at(t[0]))})
      if (side.squared_length() > best.squared_length()) best = side;
    return best;
  };
  const auto meet = [](const auto& x, const auto& y) { return CGAL::do_intersect(x, y); };
  const auto with = [&](const auto& x, const Triangle<Number>& t) {
    if (!solid(t).is_degenerate()) return meet(x, solid(t));
    const Line side = longest(t);
    return side.is_degenerate() ? meet(x, side.source()) : meet(x, side);
  };
  if (!solid(a).is_degenerate()) return with(solid(a), b);
  const Line side = longest(a);
  return side.is_degenerate() ? with(side.source(), b) : with(side, b);
}

/// The least translation that parts two triangles; 0 if they are apart, or in one plane. Of slivers only that of rationals is
/// right.
template <class Scalar>
double depth(const Triangle<Scalar>& a, const Triangle<Scalar>& b) {
  std::vector<Point<Scalar>> axes;
  const auto side = [](const Triangle<Scalar>& t, std::size_t k) { return t[(k + 1) % 3] - t[k]; };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) axes.push_back(cross(side(a, i), side(b, k)));
  }
  for (const auto* t : {&a, &b}) axes.push_back(cross(side(*t, 0), side(*t, 1)));
  const auto rounded = [](const Scalar& x) {
    if constexpr (std::is_same_v<Scalar, Real>)
      return x;
    else
      return Real(CGAL::to_double(x));
  };
  Real least = HUGE_VALL;
  for (const Point<Scalar>& axis : axes) {
    const Real length = std::sqrt(rounded(dot(axis, axis)));
    if (!(length > 0)) continue;
    least = std::min({least, -rounded(gap(a, b, axis)) / length, -rounded(gap(b, a, axis)) / length});
  }
  return least < HUGE_VALL ? double(std::max<Real>(least, 0)) : 0;
}

}  // namespace

Truth truth(const Soup& a, const Soup& b, const Pose& pose) {
  const auto guess_a = triangles<Real>(a), guess_b = triangles<Real>(b, pose);
  const auto exact_a = triangles<Number>(a), exact_b = triangles<Number>(b, pose);
  Real size = 0;
  for (const auto* all : {&guess_a, &guess_b})
    for (const auto& t : *all)
      for (const auto& p : t) size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  size = std::max<Real>(size, pose.translation.cwiseAbs().maxCoeff());
  const Real slack = size * 0x1p-56L;
  struct Pair {
    Real bound;
    std::size_t i, k;
  };
  std::vector<Pair> pairs;
  Real upper = HUGE_VALL;
  for (std::size_t i = 0; i < guess_a.size(); ++i) {
    for (std::size_t k = 0; k < guess_b.size(); ++k) {
      const Nearest<Real> near = nearest(guess_a[i], guess_b[k]);
      const Real length = std::sqrt(near.squared);
      Real bound = 0;
      if (length > slack) bound = gap(guess_a[i], guess_b[k], near.way * (1 / length)) - slack;
      upper = std::min(upper, length + slack);
      pairs.push_back({bound, i, k});
    }
  }
  std::erase_if(pairs, [&](const Pair& p) { return p.bound > upper; });
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.bound < y.bound; });
  Truth best{Number(-1), 0, 0};
  for (const Pair& pair : pairs) {
    if (best.squared >= 0 && pair.bound > 0 && Number(double(pair.bound)) * Number(double(pair.bound)) > best.squared) continue;
    ++best.decided;
    const Number squared = nearest(exact_a[pair.i], exact_b[pair.k]).squared;
    if ((squared == 0) != share_a_point(exact_a[pair.i], exact_b[pair.k]))
      throw std::logic_error("the oracle and CGAL disagree whether two triangles meet");
    if (best.squared < 0 || squared < best.squared) best.squared = squared;
    if (squared == 0) break;
  }
  if (best.squared > 0) return best;
  for (std::size_t i = 0; i < guess_a.size(); ++i) {
    for (std::size_t k = 0; k < guess_b.size(); ++k)
      if (depth(guess_a[i], guess_b[k]) > best.depth) best.depth = std::max(best.depth, depth(exact_a[i], exact_b[k]));
  }
  return best;
}

bool at_most(const Truth& truth, double x) { return x == kInfinity || (x >= 0 && truth.squared <= Number(x) * Number(x)); }
bool at_least(const Truth& truth, double x) { return x <= 0 || (x < kInfinity && truth.squared >= Number(x) * Number(x)); }
double approximate(const Truth& truth) { return std::sqrt(CGAL::to_double(truth.squared)); }

// ---- The families ----------------------------------------------------------------------------------------------------------

namespace {

double pick(Random& random, std::initializer_list<double> from) { return from.begin()[random.bits() % from.size()]; }
double small(Random& random, double most, double least) { return std::pow(10, random.uniform(least, most)); }
double either(Random& random) { return random.bits() % 2 ? 1 : -1; }
Vec3 on_lattice(Random& random, int reach) {
  const auto x = [&] { return double(int(random.bits() % std::uint64_t(2 * reach + 1)) - reach); };
  return {x(), x(), x()};
}
Vec3 snapped(const Vec3& p, double cell) { return (p / cell).array().round() * cell; }
Soup snapped(Soup soup, double cell) {
  for (Vec3& p : soup.points) p = snapped(p, cell);
  return soup;
}
/// A point of a triangle.
Vec3 point_of(Random& random, const Soup& soup, std::size_t triangle) {
  const double u = random.uniform(), v = random.uniform(0, 1 - u);
  return soup.corner(triangle, 0) * (1 - u - v) + soup.corner(triangle, 1) * u + soup.corner(triangle, 2) * v;
}

Case random_meshes(Random& r, int) { return {any(r), any(r), any_pose(r, 3)}; }

/// Slid along the normal by the distance, and by a little more or less.
Case near_contact(Random& r, int) {
  Case c{any(r), any(r), any_pose(r, 5)};
  const MeshModel a = c.a.mesh(), b = c.b.mesh();
  const Answer apart = distance(a, b, c.pose);
  if (apart.lower > 0) {
    const Vec3 n = (apart.point_b - apart.point_a).normalized();
    c.pose.translation -= n * (apart.upper + pick(r, {0, 1, -1}) * small(r, -5, -17));
  }
  return c;
}

/// In the plane z = 0, and turned in it.
Case coplanar(Random& r, int) {
  const auto flat = [&] {
    Soup soup = r.bits() % 2 ? patch(2 + std::uint32_t(r.bits() % 3), [](double, double) { return 0.0; })
                             : scattered(r, 2 + int(r.bits() % 12), 0.5);
    for (Vec3& p : soup.points) p.z() = 0;
    return soup;
  };
  Case c{flat(), flat(), shift(r.uniform(-3, 3), r.uniform(-3, 3), 0)};
  const double turn = r.uniform(0, 7);
  c.pose.rotation << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1;
  return c;
}

/// Small triangles inside large ones of the same plane.
Case nested_triangles(Random& r, int i) {
  Case c;
  for (int k = 0; k < 1 + i % 3; ++k) {
    const Vec3 p[3] = {snapped(r.in_ball(), 0x1p-20), snapped(r.in_ball(), 0x1p-20), snapped(r.in_ball(), 0x1p-20)};
    const Vec3 centre = (p[0] / 4 + p[1] / 4 + p[2] / 2);
    c.a.add(p[0], p[1], p[2]);
    c.b.add((p[0] + centre) / 2, (p[1] + centre) / 2, (p[2] + centre) / 2);
    c.b.add((3 * centre + p[0]) / 4, (3 * centre + p[1]) / 4, (3 * centre + p[2]) / 4);
  }
  if (r.bits() % 2) std::swap(c.a, c.b);
  return c;
}

/// A vertex of each at the same place, and nothing else in common for every second pair.
Case shared_vertices(Random& r, int i) {
  Case c{snapped(any(r), 0x1p-20), snapped(any(r), 0x1p-20), {}};
  if (i % 2) {
    const auto extreme = [](const Soup& soup, double sign) {
      Vec3 most = soup.corner(0, 0);
      for (std::size_t t = 0; t < soup.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) most = sign * soup.corner(t, k).x() > sign * most.x() ? soup.corner(t, k) : most;
      return most;
    };
    c.pose.translation = extreme(c.a, 1) - extreme(c.b, -1);
  } else {
    const auto some = [&](const Soup& soup) { return soup.corner(r.bits() % soup.triangles.size(), r.bits() % 3); };
    c.pose.translation = some(c.a) - some(c.b);
  }
  return c;
}

Soup splinters(Random& r, int count, double least, double most) {
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = r.in_ball(), along = r.on_sphere(), across = along.cross(r.on_sphere()).normalized();
    const double middle = r.bits() % 4 ? r.uniform() : pick(r, {0, 1});
    soup.add(at, at + along, at + middle * along + std::pow(10, -r.uniform(least, most)) * across);
  }
  return soup;
}
Case slivers(Random& r, int) { return {splinters(r, 10, 7, 9), splinters(r, 10, 7, 9), any_pose(r, 2.5)}; }

/// A corner above a splinter so thin that its normal in doubles is another direction.
Case needles(Random& r, int i) {
  Case c{splinters(r, 6, 9, 16), splinters(r, 6, 9, 16), any_pose(r, 2.5)};
  if (i % 2) return c;
  c.pose = {};
  c.a = {};
  c.b.triangles.resize(1);
  const Vec3 p = c.b.corner(0, 0), q = c.b.corner(0, 1), s = c.b.corner(0, 2);
  const Vec3 n = (q - p).cross(s - p).normalized() * either(r);
  const double share = r.uniform();
  const Vec3 at = p * (1 - share) + (r.bits() % 2 ? q : s) * share, tip = at + r.uniform(0.01, 1) * n;
  const Vec3 side = n.cross(r.on_sphere()).normalized();
  c.a.add(tip, tip + r.uniform(0.5, 2) * n + side * 0.1, tip + r.uniform(0.5, 2) * n - side * 0.1);
  return c;
}

/// A corner above the border of a face, or a hair beside it, at any height; triangles fat and thin.
Case feet(Random& r, int i) {
  Case c;
  const Vec3 p = r.in_ball(), along = r.on_sphere(), across = along.cross(r.on_sphere()).normalized();
  const Vec3 q = p + along, s = p + r.uniform() * along + (i % 2 ? small(r, 0, -8) : 1) * across;
  c.b.add(p, q, s);
  const Vec3 n = along.cross(across) * either(r);
  const Vec3 from[3] = {p, q, s}, &u = from[r.bits() % 3], &v = from[r.bits() % 3];
  const Vec3 foot = u + r.uniform() * (v - u) + either(r) * small(r, -6, -18) * across;
  const Vec3 tip = foot + small(r, 0, -17) * n, side = n.cross(r.on_sphere()).normalized();
  c.a.add(tip, tip + r.uniform(0.5, 2) * n + side, tip + r.uniform(0.5, 2) * n - side);
  if (i % 3 == 0) {
    const Pose turn = any_pose(r, 1);
    c.a = moved(c.a, turn.rotation, turn.translation), c.pose = turn;
  }
  if (i % 4 == 0) {
    std::swap(c.a, c.b);
    c.pose = inverse(c.pose);
  }
  return c;
}

/// Corners that lie in the middle of sides and faces.
Case t_junctions(Random& r, int) {
  Soup wall = box({-2, -2, -2}, {2, 2, 2}), bricks;
  for (int i = 0; i < 3; ++i) {
    const Vec3 at = on_lattice(r, 2) / 2;
    bricks.add(box(at, at + Vec3(0.5, 0.5, 0.5)));
  }
  bricks.add({0, 0, 0}, {1, 1, 0}, {0.5, 0, 0.5});
  return {wall, bricks, {lattice_rotation(r), on_lattice(r, 6) / 2}};
}

Case itself_moved(Random& r, int i) {
  Case c;
  c.a = c.b = any(r);
  if (i % 3 == 0) return c;
  const double ulp = std::ldexp(1, -int(r.bits() % 20) - 40);
  c.pose.translation = i % 3 == 1 ? Vec3(ulp * either(r), 0, 0) : Vec3(ulp * r.in_ball());
  return c;
}

/// Two roofs, one upside down, whose ridges cross.
Case grazing_edges(Random& r, int) {
  Soup roof;
  roof.add({-1, 0, 0}, {1, 0, 0}, {0, 1, -0.5});
  roof.add({-1, 0, 0}, {1, 0, 0}, {0, -1, -0.7});
  roof.add({-1, 0, 0}, {0, 1, -0.5}, {-2, 0, -1});
  Case c{roof, roof, {}};
  const double turn = r.uniform(0.05, 3);
  c.pose.rotation << std::cos(turn), std::sin(turn), 0, std::sin(turn), -std::cos(turn), 0, 0, 0, -1;
  c.pose.translation = {r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), pick(r, {0, 1, -1, 1}) * small(r, -6, -16)};
  if (r.bits() % 2) {  // anywhere
    const Mat3 q = r.rotation();
    c.a = moved(c.a, q), c.pose.rotation = q * c.pose.rotation, c.pose.translation = q * c.pose.translation;
  }
  return c;
}

Case nested_bodies(Random& r, int) {
  Soup inner = any(r);
  return {r.bits() % 2 ? ball(1) : box({-1, -1, -1}, {1, 1, 1}), scaled(std::move(inner), 0.1), any_pose(r, 0.3)};
}

Case duplicates(Random& r, int) {
  Case c{any(r), any(r), any_pose(r, 2.5)};
  for (Soup* soup : {&c.a, &c.b}) {
    const std::size_t count = soup->triangles.size();
    for (std::size_t i = 0; i < 2 * count; ++i) {
      auto [p, q, s] = soup->triangles[r.bits() % count];
      soup->triangles.push_back(r.bits() % 2 ? Corners{q, s, p} : Corners{s, q, p});
    }
  }
  return c;
}

Case huge_and_tiny(Random& r, int i) {
  Case c{scaled(any(r), 1e8), any(r), {r.rotation(), {}}};
  c.pose.translation = point_of(r, c.a, r.bits() % c.a.triangles.size()) + r.uniform(0, 5) * r.on_sphere();
  if (i % 2) {
    std::swap(c.a, c.b);
    c.pose = inverse(c.pose);
  }
  return c;
}

Case far_away(Random& r, int) {
  Case c{any(r), any(r), any_pose(r, 2)};
  const Vec3 of_a = 1e6 * r.on_sphere(), of_b = 1e6 * r.on_sphere();
  c.a = moved(c.a, Mat3::Identity(), of_a), c.b = moved(c.b, Mat3::Identity(), of_b);
  c.pose.translation += of_a - c.pose.rotation * of_b;
  return c;
}

Case lattice(Random& r, int) {
  const auto body = [&] {
    Soup soup;
    if (r.bits() % 2) {
      for (int i = 0; i < 12; ++i) soup.add(on_lattice(r, 2), on_lattice(r, 2), on_lattice(r, 2));
    } else {
      for (int i = 0; i < 3; ++i) {
        const Vec3 at = on_lattice(r, 1);
        soup.add(box(at, at + Vec3(1, 1, 1)));
      }
    }
    return soup;
  };
  return {body(), body(), {lattice_rotation(r), on_lattice(r, 5)}};
}

Case parallel_surfaces(Random& r, int i) {
  const double bump = i % 2 ? 0 : r.uniform(0, 0.4);
  const auto height = [=](double x, double y) { return bump * (x * x - y * y); };
  Case c{patch(3, height), patch(3, height), shift(0, 0, small(r, -0.5, -15))};
  if (r.bits() % 2) {
    const Mat3 q = r.rotation();
    c.a = moved(c.a, q), c.b = moved(c.b, q), c.pose.translation = q * c.pose.translation;
  }
  return c;
}

/// Planes that are parallel but for a little.
Case tilted_planes(Random& r, int) {
  const auto flat = [](double, double) { return 0.0; };
  Case c{patch(3, flat), patch(3, flat), shift(r.uniform(-1, 1), r.uniform(-1, 1), small(r, -1, -12))};
  const double angle = small(r, -3, -16);
  c.pose.rotation << 1, 0, angle, 0, 1, 0, -angle, 0, 1;
  return c;
}

/// Segments and points among triangles, which stick out.
Case zero_areas(Random& r, int) {
  const auto body = [&] {
    Soup soup = snapped(any(r), 0x1p-10);
    for (int i = 0; i < 6; ++i) {
      const Vec3 p = snapped(1.5 * r.in_ball(), 0x1p-10), q = snapped(1.5 * r.in_ball(), 0x1p-10);
      switch (r.bits() % 3) {
        case 0: soup.add(p, p, q); break;
        case 1: soup.add(p, p, p); break;
        default: soup.add(p, (p + q) / 2, q);
      }
    }
    return soup;
  };
  Case c{body(), body(), any_pose(r, 3)};
  if (r.bits() % 2) c.pose = {lattice_rotation(r), snapped(3 * r.in_ball(), 0x1p-10)};
  if (r.bits() % 4 == 0) c.pose = {Mat3::Identity(), c.a.points.back() - c.b.points.back()};
  return c;
}

/// Nothing but segments and points.
Case only_zero_areas(Random& r, int) {
  const auto body = [&] {
    Soup soup;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = on_lattice(r, 2), q = on_lattice(r, 2);
      if (r.bits() % 3)
        soup.add(p, q, r.bits() % 2 ? q : p);
      else
        soup.add(p, p, p);
    }
    return soup;
  };
  return {body(), body(), {lattice_rotation(r), on_lattice(r, 3)}};
}

Case powers(Random& r, int i) {
  Case c = i % 3 == 0 ? near_contact(r, i) : i % 3 == 1 ? lattice(r, i) : random_meshes(r, i);
  const double scale = std::ldexp(1, i % 2 ? 133 : -133);
  c.a = scaled(std::move(c.a), scale), c.b = scaled(std::move(c.b), scale);
  c.pose.translation *= scale;
  for (Soup* soup : {&c.a, &c.b})  // what is too small for a mesh is 0
    for (Vec3& p : soup->points)
      for (double& x : p) x = std::fabs(x) < 1e-45 ? 0 : x;
  return c;
}

Case tangles(Random& r, int) { return {tangled(r, 10, 30), tangled(r, 8, 24), any_pose(r, 2)}; }

/// As far from orthonormal as a query takes, near contact.
Case bent_poses(Random& r, int i) {
  Case c = i % 2 ? near_contact(r, i) : random_meshes(r, i);
  Mat3 bent;
  do {
    bent = c.pose.rotation;
    for (int k = 0; k < 3; ++k) bent.col(k) += 4e-7 * r.in_ball();
  } while ((bent.transpose() * bent - Mat3::Identity()).cwiseAbs().maxCoeff() > 9e-7);
  c.pose.rotation = bent;
  return c;
}

const Family kFamilies[] = {{"random", random_meshes, 0.1, 0.2},
                            {"near contact", near_contact, 0.1, 0.2},
                            {"coplanar", coplanar, 0.2, 0.2},
                            {"nested triangles", nested_triangles, 1, 0},
                            {"shared vertices", shared_vertices, 1, 0},
                            {"slivers", slivers, 0, 0.9},
                            {"needles", needles, 0, 0.9},
                            {"feet", feet, 0, 0.5},
                            {"T-junctions", t_junctions, 0.2, 0.1},
                            {"itself moved", itself_moved, 0.5, 0},
                            {"grazing edges", grazing_edges, 0.1, 0.2},
                            {"nested bodies", nested_bodies, 0, 0.9},
                            {"duplicates", duplicates, 0.1, 0.1},
                            {"huge and tiny", huge_and_tiny, 0.05, 0.2},
                            {"far away", far_away, 0.1, 0.1},
                            {"lattice", lattice, 0.2, 0.2},
                            {"parallel surfaces", parallel_surfaces, 0, 0.5},
                            {"tilted planes", tilted_planes, 0.02, 0.2},
                            {"zero areas", zero_areas, 0.2, 0.2},
                            {"only zero areas", only_zero_areas, 0.2, 0.2},
                            {"powers of two", powers, 0.1, 0.2},
                            {"tangles", tangles, 0.1, 0.1},
                            {"bent poses", bent_poses, 0.1, 0.2}};

}  // namespace

std::span<const Family> families() { return kFamilies; }

// ---- The judge -------------------------------------------------------------------------------------------------------------

namespace {

std::string text(const Soup& soup) {
  std::ostringstream out;
  out << std::hexfloat << soup.points.size() << ' ' << soup.triangles.size() << '\n';
  for (const Vec3& p : soup.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& [p, q, r] : soup.triangles) out << p << ' ' << q << ' ' << r << '\n';
  return out.str();
}
struct Judged {
  const Case& c;
  const MeshModel &a, &b;
  const Truth& truth;
  double law_two;

  /// What is wrong with any answer; "" if nothing.
  std::string fault(const Answer& answer) const {
    std::ostringstream out;
    out.precision(17);
    const auto wrong = [&](const char* what) {
      out << what << ": [" << answer.lower << ", " << answer.upper << "], verdict " << int(answer.verdict) << ", status "
          << int(answer.status) << "; the truth is " << approximate(truth) << ", law 2's bound " << law_two;
      return out.str();
    };
    if (!at_least(truth, answer.lower)) return wrong("lower is above the truth");
    if (!at_most(truth, answer.upper)) return wrong("upper is below the truth");
    if (answer.verdict == Verdict::Disjoint && truth.squared == 0) return wrong("Disjoint, but they share a point");
    if (answer.verdict == Verdict::Overlapping && truth.squared > 0) return wrong("Overlapping, but they are apart");
    if (answer.verdict == Verdict::Touching && !at_most(truth, law_two)) return wrong("Touching, but they are apart");
    if ((answer.verdict == Verdict::Disjoint) != (answer.lower > 0)) return wrong("Disjoint is said where lower is above 0");
    if (answer.status != Status::Converged && answer.status != Status::Beyond && answer.status != Status::Budget)
      return wrong("a status that no such query has");
    if (answer.upper == kInfinity || answer.verdict == Verdict::Overlapping) return "";
    for (const bool of_a : {true, false}) {
      const Vec3& p = of_a ? answer.point_a : answer.point_b;
      const FeatureId feature = of_a ? answer.feature_a : answer.feature_b;
      // Long doubles do not know on which side of a triangle's sides a point is if it is thinner than 1e-6.
      if (!(distance_to<Real>(of_a, feature, p) <= law_two) && !(distance_to<Number>(of_a, feature, p) <= law_two))
        return wrong(of_a ? "point_a is off its feature" : "point_b is off its feature");
    }
    return "";
  }
  /// And with whether the distance is at most a threshold.
  std::string within_fault(const Within& w, double threshold) const {
    if (const std::string f = fault(w.answer); !f.empty()) return "within: " + f;
    if (w.decision == Decision::Yes && !at_most(truth, threshold)) return "within says Yes wrongly";
    if (w.decision == Decision::No && at_most(truth, threshold)) return "within says No wrongly";
    const bool is_clear = std::fabs(threshold - approximate(truth)) > law_two;
    return w.decision == Decision::Undecided && is_clear ? "within is undecided" : "";
  }
  /// And with one to an exact question.
  std::string exact_fault(const Answer& answer) const {
    if (const std::string any = fault(answer); !any.empty()) return any;
    if (answer.status != Status::Converged) return "an exact question did not converge";
    if (const std::string bad = verdict_fault(answer); !bad.empty()) return bad;
    if (!(answer.upper - answer.lower <= law_two)) return "the interval is wider than law 2's bound";
    return leans(answer.point_a, answer.point_b, answer.normal, answer.lower) ? "the points lean against the normal" : "";
  }
  /// Whether the points of an exact answer lie on a line that is not along the normal.
  bool leans(const Vec3& p, const Vec3& q, const Vec3& normal, double lower) const {
    const Vec3 way = q - p;
    return lower > law_two && !((way - way.norm() * normal).norm() <= law_two);
  }

  /// Touching is said only where no two triangles cross by more than the bound.
  std::string verdict_fault(const Answer& answer) const {
    if (answer.verdict == Verdict::Undecided) return "undecided";
    if (answer.verdict == Verdict::Touching && truth.depth > 2 * law_two)
      return "Touching, but two triangles cross by " + std::to_string(truth.depth / law_two) + " of law 2's bound";
    return "";
  }

 private:
  /// From a point of A's frame to a feature of one body.
  template <class Scalar>
  double distance_to(bool of_a, FeatureId feature, const Vec3& from) const {
    const MeshModel& mesh = of_a ? a : b;
    const Pose pose = of_a ? Pose{} : c.pose;
    const auto at = [&](std::uint32_t v) { return apply<Scalar>(pose, mesh.vertex(v)); };
    const std::uint32_t i = feature.index();
    const Point<Scalar> p = point<Scalar>(from);
    Triangle<Scalar> t;
    switch (feature.kind()) {
      case FeatureKind::Vertex: t = {at(i), at(i), at(i)}; break;
      case FeatureKind::Edge: {
        const Corners corners = mesh.triangle(i / 3);
        t = {at(corners[i % 3]), at(corners[(i + 1) % 3]), at(corners[i % 3])};
        break;
      }
      case FeatureKind::Face: {
        const Corners corners = mesh.triangle(i);
        t = {at(corners[0]), at(corners[1]), at(corners[2])};
        break;
      }
      default: return kInfinity;
    }
    return std::sqrt(CGAL::to_double(nearest(Triangle<Scalar>{p, p, p}, t).squared));
  }
};

std::string judge(const Judged& j, Random& random) {
  MeshSeed seed;
  const Answer answer = distance(j.a, j.b, j.c.pose, seed);
  if (const std::string f = j.exact_fault(answer); !f.empty()) return "distance: " + f;
  const ClosestFeatures closest = closest_features(j.a, j.b, j.c.pose, seed);
  if (const std::string f = j.exact_fault(closest.answer); !f.empty()) return "closest_features, warm: " + f;
  const Answer met = intersects(j.a, j.b, j.c.pose);
  if (const std::string f = j.fault(met); !f.empty()) return "intersects: " + f;
  if (const std::string f = j.verdict_fault(met); !f.empty()) return "intersects: " + f;
  // Within law 2's bound of contact, verdicts depend on which pair of triangles came first.
  const bool is_clear = j.truth.depth > 2 * j.law_two || !at_most(j.truth, j.law_two);
  if (is_clear && (met.verdict != answer.verdict || met.verdict != closest.answer.verdict)) return "verdicts differ";
  const double d = approximate(j.truth);
  for (const double threshold : {d * 0.5, d + 2 * j.law_two, d - 2 * j.law_two, d, d * random.uniform(0, 2)}) {
    if (!(threshold >= 0)) continue;
    const Within w = within(j.a, j.b, j.c.pose, threshold, seed);
    if (const std::string f = j.within_fault(w, threshold); !f.empty()) return f;
  }
  for (const Options& options :
       {Options{.relative = 0.1}, Options{.absolute = 0.05 * (d + j.law_two)}, Options{.beyond = d * random.uniform(0, 2)},
        Options{.budget = {.steps = std::uint32_t(random.bits() % 30)}}}) {
    const Answer loose = distance(j.a, j.b, j.c.pose, options);
    if (const std::string f = j.fault(loose); !f.empty()) return "distance with options: " + f;
    if (loose.status == Status::Beyond && at_most(j.truth, options.beyond)) return "Beyond wrongly";
    if (loose.status == Status::Converged && loose.verdict != Verdict::Overlapping &&
        loose.upper - loose.lower > std::max({options.absolute, options.relative * loose.lower, j.law_two}))
      return "Converged, but wider than asked";
  }
  return "";
}

/// The same with a front that lay between the meshes at poses nearby before, asked whatever came.
std::string judge_fronts(const Judged& j, Random& random) {
  const double d = approximate(j.truth), size = std::max(j.a.extent(), j.b.extent());
  MeshSeed seed;
  MeshFront front(random.bits() % 2 ? 1024 : 64);
  const double turn = std::pow(10, random.uniform(-7, -1));
  for (int i = 0; i < 4; ++i) {
    const Vec3 half = turn * random.in_ball();
    const Mat3 turned = shapes::from_quaternion(std::sqrt(1 - half.squaredNorm()), half) * j.c.pose.rotation;
    const Pose pose{turned, j.c.pose.translation + turn * size * random.in_ball()};
    switch (random.bits() % 3) {
      case 0: distance(j.a, j.b, pose, seed, front); break;
      case 1: intersects(j.a, j.b, pose, seed, front); break;
      default: within(j.a, j.b, pose, d * random.uniform(0.5, 1.5), seed, front);
    }
  }
  if (random.bits() % 2) {
    const double threshold = d * (random.bits() % 2 ? random.uniform(0, 2) : 1);
    const Within w = within(j.a, j.b, j.c.pose, threshold, seed, front);
    if (const std::string f = j.within_fault(w, threshold); !f.empty()) return f;
  }
  const Answer met = intersects(j.a, j.b, j.c.pose, seed, front);
  if (const std::string f = j.fault(met); !f.empty()) return "intersects: " + f;
  if (const std::string f = j.verdict_fault(met); !f.empty()) return "intersects: " + f;
  if (const std::string f = j.exact_fault(distance(j.a, j.b, j.c.pose, seed, front)); !f.empty()) return "distance: " + f;
  const ClosestFeatures closest = closest_features(j.a, j.b, j.c.pose, seed, front);
  if (const std::string f = j.exact_fault(closest.answer); !f.empty()) return "closest_features: " + f;
  return "";
}

/// The regions of contact and their manifolds, within a reach a little above the distance, or far above it.
std::string judge_contacts(const Judged& j, Random& random, int& told, int& regions) {
  const double d = approximate(j.truth);
  double size = 0;
  for (const MeshModel* mesh : {&j.a, &j.b}) size = std::max(size, mesh->extent());
  const double reach = random.bits() % 4   ? d + size * std::pow(10, random.uniform(-6, -1))
                       : random.bits() % 2 ? d
                                           : d + j.law_two;
  const auto exact_a = triangles<Number>(j.c.a), exact_b = triangles<Number>(j.c.b, j.c.pose);
  const BrutePairs pairs(j.c.a, j.c.b, j.c.pose, j.law_two / 16, reach + j.law_two, [&](std::size_t i, std::size_t k) {
    return Real(std::sqrt(CGAL::to_double(nearest(exact_a[i], exact_b[k]).squared)));
  });
  std::vector<MeshContact> found(300);
  const MeshContacts about = contacts(j.a, j.b, j.c.pose, reach, found);
  if (about.status != Status::Converged || !about.is_counted || about.count != about.stored) return "not all regions";
  found.resize(about.stored);
  regions += int(about.stored);
  if (const std::string f = fault_of(found, pairs, reach, j.law_two, j.a, j.b, told); !f.empty()) return f;
  for (const MeshContact& region : found) {
    if (j.leans(region.point_a, region.point_b, region.normal, region.lower)) return "points lean against the normal";
    const Manifold m = manifold(j.a, j.b, j.c.pose, region, {.margin = reach});
    if (m.count == 0) {
      if (!(region.lower <= j.law_two)) return "no points although the surfaces are apart";
      continue;  // of segments and points no normal may be known
    }
    if (std::fabs(m.normal.norm() - 1) > 1e-14) return "a normal that is no unit";
    for (std::uint32_t i = 0; i < m.count; ++i) {
      const ManifoldPoint& p = m.points[i];
      if (!(p.separation <= reach + j.law_two + 0x1p-20 * size) || p.separation < m.points[0].separation)
        return "no such separation";
      if (!((p.point_b - p.point_a - p.separation * m.normal).norm() <= 4 * j.law_two)) return "points aside of the normal";
    }
    if (region.verdict != Verdict::Overlapping) continue;
    const Point<Real> way = point<Real>(m.normal) * Real(-m.points[0].separation);
    for (const BrutePair& pair : pairs.all) {
      if (pair.upper > j.law_two / 8) continue;
      const Triangle<Real>&s = pairs.of_a[pair.i], &t = pairs.of_b[pair.k];
      if (!holds(place_of(region), place_of(s, t, 0), 0)) continue;
      const Triangle<Real> gone{t[0] + way, t[1] + way, t[2] + way};
      if (depth(s, gone) > 2 * j.law_two && nearest(s, gone).squared == 0) return "the way does not part a pair that crosses";
    }
  }
  return "";
}

/// With the hull of every node.
MeshModel hulled(const MeshModel& mesh) {
  HullOptions options;
  options.levels = 16, options.least_triangles = 1, options.bytes_per_triangle = 1e6;
  Result<MeshModel> made = rebuild_hulls(mesh, options);
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(made).value();
}

}  // namespace

std::string text(const Case& c) {
  std::ostringstream out;
  out << std::hexfloat << "rotation by rows, translation\n";
  for (int i = 0; i < 3; ++i)
    out << c.pose.rotation(i, 0) << ' ' << c.pose.rotation(i, 1) << ' ' << c.pose.rotation(i, 2) << '\n';
  out << c.pose.translation.x() << ' ' << c.pose.translation.y() << ' ' << c.pose.translation.z() << '\n';
  return out.str() + "A: " + text(c.a) + "B: " + text(c.b);
}

Examined examine(const Case& c, Random& random) {
  const MeshModel a = c.a.mesh(), b = c.b.mesh();
  Examined result;
  result.truth = truth(c.a, c.b, c.pose);
  const Judged judged{c, a, b, result.truth, tolerance(a, b, c.pose)};
  result.fault = judge(judged, random);
  if (result.fault.empty()) {
    const MeshModel hulled_a = hulled(a), hulled_b = hulled(b);
    result.fault = judge({c, hulled_a, hulled_b, result.truth, judged.law_two}, random);
    if (!result.fault.empty()) result.fault = "with hulls: " + result.fault;
  }
  if (result.fault.empty()) {
    result.fault = judge_contacts(judged, random, result.told, result.regions);
    if (!result.fault.empty()) result.fault = "contacts: " + result.fault;
  }
  if (result.fault.empty()) {
    result.fault = judge_fronts(judged, random);
    if (!result.fault.empty()) result.fault = "with a front: " + result.fault;
  }
  result.answer = distance(a, b, c.pose);
  result.width = (result.answer.upper - result.answer.lower) / judged.law_two;
  return result;
}

}  // namespace swiftlet::mesh_families
