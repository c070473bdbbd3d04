// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scaling, relaxation and tightening in plain doubles, and the exact proof that ends them. Supports are climbs from nearby
// starts.
#include "enclose.h"

#include <Eigen/LU>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "hull.h"

namespace swiftlet::lod {
namespace {

using Point3 = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Point3 exact(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Where on the body to begin a climb: per vertex of the level, the support last found for a face there.
class Starts {
 public:
  explicit Starts(std::size_t vertex_count) : start_(vertex_count, kNone) {}
  std::uint32_t climb(const Climber& body, const Vec3& direction, const Triangle& face) {
    for (std::uint32_t corner : face)
      if (start_[corner] != kNone) last_ = start_[corner];
    last_ = body.climb(direction, last_);
    for (std::uint32_t corner : face) start_[corner] = last_;
    return last_;
  }

 private:
  std::vector<std::uint32_t> start_;
  std::uint32_t last_ = 0;
};

/// Past rounding: the vertex that no neighbour exceeds by exact comparison, from one that is nearly so.
std::uint32_t exact_climb(const Climber& body, const Point3& a, const Point3& b, const Point3& c, std::uint32_t start) {
  std::uint32_t best = start;
  while (true) {
    const std::uint32_t from = best;
    for (std::uint32_t to : body.neighbours(from))
      if (CGAL::has_larger_signed_distance_to_plane(a, b, c, exact(body.body().points[to]), exact(body.body().points[best])))
        best = to;
    if (best == from) return best;
  }
}

constexpr double kSliver =
    0x1p-40;  ///< altitude over base; below, a triangle's normal is noise and its edges' other triangles count

/// The least factor about `centre` by which every face of the level clears the body; infinite where the centre is not inside.
double least_scale(const Polytope& level, const Climber& body, const Vec3& centre) {
  Starts starts(level.points.size());
  double scale = 0;
  for (const Triangle& face : level.triangles) {
    const Vec3 &a = level.points[face[0]], &b = level.points[face[1]], &c = level.points[face[2]];
    const Vec3 normal = area_normal(a, b, c);
    if (normal.norm() <= kSliver * std::max((b - a).squaredNorm(), (c - a).squaredNorm())) continue;
    const double offset = normal.dot(a - centre);
    if (!(offset > 0)) return std::numeric_limits<double>::infinity();
    scale = std::max(scale, normal.dot(body.body().points[starts.climb(body, normal, face)] - centre) / offset);
  }
  return scale;
}

void scale_about(std::vector<Vec3>& points, const Vec3& centre, double factor) {
  for (Vec3& p : points) p = centre + factor * (p - centre);
}

/// A vertex may move by d while `normal . d >= offset`; `normal` is a unit vector, `offset` at most 0.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// One vertex and all that bounds its moves while its ring stays.
///
///            b ----- across    Each triangle (vertex, a, b) asks that the vertex stay outside the plane that turns about
///          / |     /           ab and touches the body, so that the body stays below the triangle, and inside the plane
///   vertex   |   /             of the face across ab, so that the edge ab stays convex. Nor may it come too near ab.
///          \ | /
///            a
class Mover {
 public:
  Mover(const Polytope& level, const Climber& body)
      : level_(level), body_(body), edges_(half_edges(level)), starts_(level.points.size()) {}

  void look_around(std::uint32_t vertex) {
    clearance_.clear(), bounds_.clear(), altitudes_.clear(), ring_.clear();
    gradient_ = Vec3::Zero();
    convex_ = true;
    const std::uint32_t first = edges_.outgoing[vertex];
    std::uint32_t h = first;
    do {
      look_at(vertex, HalfEdges::next(h));
      h = edges_.rotate(h);
    } while (h != first);
  }

  /// The move within all limits that lowers the volume most, none where the ring is long or was left reflex. The optimum of a
  /// linear programme in space is where three limits meet; every three are tried.
  Vec3 least_volume_move() const {
    Vec3 best = Vec3::Zero();
    if (!convex_ || ring_.size() > kLongRing) return best;
    std::vector<HalfSpace> limits = clearance_;
    limits.insert(limits.end(), bounds_.begin(), bounds_.end());
    for (std::size_t i = 0; i < limits.size(); ++i)
      for (std::size_t j = i + 1; j < limits.size(); ++j) {
        const Vec3 line = limits[i].normal.cross(limits[j].normal);
        for (std::size_t k = j + 1; k < limits.size(); ++k) {
          const double det = line.dot(limits[k].normal);
          if (std::abs(det) < kParallel) continue;
          const Vec3 move = (limits[i].offset * limits[j].normal.cross(limits[k].normal) +
                             limits[j].offset * limits[k].normal.cross(limits[i].normal) + limits[k].offset * line) /
                            det;
          if (gradient_.dot(move) < gradient_.dot(best) && allows(limits, move)) best = move;
        }
      }
    return best * part_within(altitudes_, best);
  }

  /// The longest move along `direction`, no longer than it, that clears the body and leaves every edge around convex.
  Vec3 move_along(const Vec3& direction) const {
    std::vector<HalfSpace> limits = clearance_;
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      const Vec3 &a = ring_[k], &b = ring_[(k + 1) % ring_.size()], &c = ring_[(k + 2) % ring_.size()];
      add(limits, area_normal(a, b, c), a);
    }
    return direction * part_within(limits, direction);
  }

 private:
  static constexpr double kParallel = 1e-9;     ///< triple product of unit normals whose planes meet nowhere useful
  static constexpr double kTouching = 1e-15;    ///< height over the distance of two points, a few ulp
  static constexpr double kBeside = 1e-9;       ///< over the edge's length: nearer to its line, a support turns no plane
  static constexpr double kSlack = 1e-13;       ///< of the limits, in units of the level, whose size is about 1
  static constexpr double kAltitudeLeft = 0.1;  ///< of a triangle's altitude after one move
  static constexpr double kFlattest = 0.05;     ///< altitude over base that no move goes below
  static constexpr std::size_t kLongRing = 24;  ///< 17296 triples
  static constexpr double kFirstTilt = 0x1p-6;  ///< tangent of the angle; a small one keeps the climb short
  static constexpr int kTurns = 30;

  void look_at(std::uint32_t vertex, std::uint32_t side) {
    const Triangle face{vertex, origin(level_, side), origin(level_, HalfEdges::next(side))};
    const std::uint32_t across = origin(level_, HalfEdges::previous(edges_.twin[side]));
    const Vec3 &a = level_.points[face[1]], &b = level_.points[face[2]];
    x_ = level_.points[vertex];
    const Vec3 normal = area_normal(x_, a, b), outside = area_normal(b, a, level_.points[across]);
    const Vec3 inward = normal.cross(b - a).normalized();
    const double altitude = inward.dot(x_ - a);
    convex_ = convex_ && outside.dot(x_ - a) <= kSlack * outside.norm();
    gradient_ += normal;
    ring_.push_back(a);
    add(clearance_, tangent(face, a, b, normal, inward), a);
    add(bounds_, -outside, a);
    altitudes_.push_back(
        {inward, std::min(0.0, std::max((kAltitudeLeft - 1) * altitude, kFlattest * (b - a).norm() - altitude))});
  }

  /// The normal of the plane through ab that touches the body on the vertex's side. The plane is tilted until its support lies
  /// on that side; then, by Newton's method on the angle, each support turns it on to itself, from past the tangent back to it.
  Vec3 tangent(const Triangle& face, const Vec3& a, const Vec3& b, const Vec3& face_normal, const Vec3& inward) {
    const Vec3 unit = face_normal.normalized();
    Vec3 normal = unit;
    double tilt = kFirstTilt;
    bool turned = false;
    for (int turn = 0; turn < kTurns; ++turn) {
      const Vec3 arm = body_.body().points[starts_.climb(body_, normal, face)] - a;
      const bool beside = inward.dot(arm) > kBeside * (b - a).norm();
      if (turned && (!beside || normal.dot(arm) <= kTouching * normal.norm())) break;
      turned = beside;
      normal = beside ? Vec3((b - a).cross(arm)) : Vec3(unit + tilt * inward);
      if (!beside) tilt *= 4;
    }
    return normal;
  }

  /// The vertex is to stay on the outer side of the plane through `point`.
  void add(std::vector<HalfSpace>& limits, const Vec3& normal, const Vec3& point) const {
    const double length = normal.norm();
    if (length > 0) limits.push_back({normal / length, std::min(0.0, normal.dot(point - x_) / length)});
  }

  static bool allows(const std::vector<HalfSpace>& limits, const Vec3& move) {
    return std::all_of(limits.begin(), limits.end(),
                       [&](const HalfSpace& s) { return s.normal.dot(move) >= s.offset - kSlack; });
  }

  /// The greatest part of `move`, from 0 to 1, within the limits.
  static double part_within(const std::vector<HalfSpace>& limits, const Vec3& move) {
    double part = 1;
    for (const HalfSpace& limit : limits)
      if (limit.normal.dot(move) * part < limit.offset) part = limit.offset / limit.normal.dot(move);
    return part;
  }

  const Polytope& level_;
  const Climber& body_;
  HalfEdges edges_;
  Starts starts_;
  Vec3 x_ = Vec3::Zero();
  std::vector<HalfSpace> clearance_, bounds_, altitudes_;
  std::vector<Vec3> ring_;        ///< counter-clockwise
  Vec3 gradient_ = Vec3::Zero();  ///< of six times the volume
  bool convex_ = true;
};

/// A surface under two forces, on the way to the least greatest height: every vertex is drawn to the body, the highest the
/// most, and every triangle that cuts the body is pushed off it, its corners by their share in the place of contact. Keeps the
/// triangles; the level ends near holding the body, not holding it.
class Balance {
 public:
  Balance(Polytope& level, const Climber& body, const Mat3& metric)
      : level_(level), body_(body), to_normal_(metric.inverse().transpose()), starts_(level.points.size()) {}

  void run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      draw(kPull * (1 - 0.9 * round / rounds));
      for (int pass = 0; pass < kPasses; ++pass)
        for (const Triangle& face : level_.triangles) push(face);
    }
  }

 private:
  static constexpr double kPull = 0.2;     ///< of the highest vertex's height, at first
  static constexpr double kSharpness = 6;  ///< the pull falls with this power of the height over the greatest
  static constexpr double kMetric = 0.25;  ///< power of the metric's say in heights: all of it starves the flat sides of plates
  static constexpr int kPasses = 4;

  void draw(double pull) {
    std::vector<Vec3> normals(level_.points.size(), Vec3::Zero());
    for (const Triangle& face : level_.triangles)
      for (std::uint32_t corner : face) normals[corner] += normal_of(face);
    std::vector<double> heights(normals.size()), felt(normals.size());
    for (std::uint32_t v = 0; v < normals.size(); ++v) {
      normals[v].normalize();
      heights[v] = std::max(0.0, normals[v].dot(level_.points[v] - support(normals[v], {v, v, v})));
      felt[v] = heights[v] * std::pow((to_normal_ * normals[v]).norm(), -kMetric);
    }
    const double most = *std::max_element(felt.begin(), felt.end());
    for (std::uint32_t v = 0; v < normals.size() && most > 0; ++v)
      level_.points[v] -= pull * heights[v] * std::pow(felt[v] / most, kSharpness) * normals[v];
  }

  void push(const Triangle& face) {
    Vec3 &a = level_.points[face[0]], &b = level_.points[face[1]], &c = level_.points[face[2]];
    const Vec3 normal = normal_of(face);
    const Vec3& contact = support(normal, face);
    const double depth2 = normal.dot(contact - a), length2 = normal.squaredNorm();
    if (!(depth2 > 0) || !(length2 > 0)) return;
    Vec3 share{area_normal(contact, b, c).dot(normal), area_normal(a, contact, c).dot(normal),
               area_normal(a, b, contact).dot(normal)};
    share = share.cwiseMax(0);
    const Vec3 push = normal * (depth2 / length2 * share.sum() / share.squaredNorm());
    a += share[0] * push, b += share[1] * push, c += share[2] * push;
  }

  Vec3 normal_of(const Triangle& face) const {
    return area_normal(level_.points[face[0]], level_.points[face[1]], level_.points[face[2]]);
  }
  const Vec3& support(const Vec3& direction, const Triangle& near) {
    return body_.body().points[starts_.climb(body_, direction, near)];
  }

  Polytope& level_;
  const Climber& body_;
  Mat3 to_normal_;
  Starts starts_;
};

constexpr double kRelaxed = 0.999;    ///< of a move: short of the limit, edges stay strictly convex
constexpr double kEarlyPart = 0.3;    ///< of a move in the first half of the sweeps, so that neighbours share the gain
constexpr double kStillWhole = 0.95;  ///< of the triangles; fewer, and the balance has folded the surface
constexpr int kRepeats = 3;
constexpr double kMoveWork = 25;
constexpr std::size_t kFewestRounds = 8;  ///< fewer change nothing: fine levels are not balanced

int sweeps_over(std::size_t points) { return int(std::clamp<std::size_t>(20000 / points, 2, 20)); }

/// The level balanced and scaled to hold the body, where that keeps its triangles and lessens its volume.
std::optional<Polytope> balanced(Polytope level, const Climber& body, const Mat3& metric) {
  const std::size_t rounds = std::min<std::size_t>(40000 / level.points.size(), 100);
  if (rounds < kFewestRounds) return std::nullopt;
  const double enough = kStillWhole * double(level.triangles.size()), most = volume(level);
  Balance(level, body, metric).run(int(rounds));
  // Squares of a needle's coordinates may leave the range of doubles.
  if (!std::ranges::all_of(level.points, [](const Vec3& p) { return p.allFinite(); })) return std::nullopt;
  const Hull shape = hull(level.points);
  if (double(shape.triangles.size()) < enough) return std::nullopt;
  Result<Polytope> scaled = scale_to_hold(solid(level.points, shape), body, area_centroid(body.body()));
  if (!scaled || volume(scaled.value()) > most) return std::nullopt;
  return std::move(scaled).value();
}

}  // namespace

bool holds(const Polytope& level, const Climber& body) {
  Starts starts(level.points.size());
  return std::all_of(level.triangles.begin(), level.triangles.end(), [&](const Triangle& face) {
    const Vec3 &p = level.points[face[0]], &q = level.points[face[1]], &r = level.points[face[2]];
    const Point3 a = exact(p), b = exact(q), c = exact(r);
    const std::uint32_t top = exact_climb(body, a, b, c, starts.climb(body, area_normal(p, q, r), face));
    return CGAL::orientation(a, b, c, exact(body.body().points[top])) != CGAL::POSITIVE;
  });
}

Result<Proved> prove(std::vector<Vec3> points, const Climber& body, const Vec3& centre) {
  for (double growth = 0x1p-52; growth < 0x1p-20; growth *= 4) {
    const Hull shape = hull(points);
    if (shape.dimension < 3) break;
    Polytope level = solid(points, shape);
    if (holds(level, body)) return Proved{std::move(level), shape.vertices};
    const double scale = least_scale(level, body, centre);
    if (!(scale < 1 + 0x1p-16)) break;
    scale_about(points, centre, std::max(scale, 1.0) + growth);
  }
  return Error{ErrorCode::NotEnclosing, "the next level could not be made to hold level 0"};
}

Result<Polytope> scale_to_hold(Polytope level, const Climber& body, const Vec3& centre) {
  const double scale = least_scale(level, body, centre);
  if (!std::isfinite(scale)) return Error{ErrorCode::NotEnclosing, "the centre of mass is outside the next level"};
  scale_about(level.points, centre, scale);
  return level;
}

Polytope relax(Polytope level, const Climber& body, const Vec3& centre, Watch& watch) {
  constexpr int kSweeps = 3;
  Mover mover(level, body);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::uint32_t v = 0; v < level.points.size(); ++v) {
      mover.look_around(v);
      level.points[v] += kRelaxed * mover.move_along(centre - level.points[v]);
      watch.work(kMoveWork);
    }
  return level;
}

Polytope tighten(Polytope level, const Climber& body, const Mat3& metric, Watch& watch) {
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::optional<Polytope> better = balanced(level, body, metric);
    if (!better) break;
    level = std::move(*better);
  }
  const int sweeps = sweeps_over(level.points.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Mover mover(level, body);
    for (std::uint32_t v = 0; v < level.points.size(); ++v) {
      mover.look_around(v);
      if (const Vec3 move = mover.least_volume_move(); move.allFinite())
        level.points[v] += (2 * sweep < sweeps ? kEarlyPart : 1) * move;
      watch.work(kMoveWork);
    }
    const Hull shape = hull(level.points);
    if (shape.dimension < 3) break;
    level = solid(level.points, shape);
  }
  return level;
}

double move_work(double triangles) {
  const double points = triangles / 2 + 2;
  return kMoveWork * points * sweeps_over(std::size_t(points));
}

}  // namespace swiftlet::lod
