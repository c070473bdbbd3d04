// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whole walks at the margins. Both bodies are built around a point each, above one another along n: a feature at height 0, one
// more vertex at the depth where the walk's tests begin to prove, and all else deeper.
//
//     B   \ | /          n
//          \|/__ near    |     depth of `near` below the feature: 0 to 3 times the border
//      ____________ near
//     A \        /
#include <cmath>
#include <cstdio>
#include <numbers>

#include <Eigen/Geometry>

#include "bodies.h"
#include "margins.h"
#include "oracle.h"
#include "pair/certify.h"
#include "pair/walk.h"

namespace swiftlet {
Walk loose_walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget);
}

namespace swiftlet::margins {
namespace {

using shapes::Random;
using Long3 = Eigen::Matrix<long double, 3, 1>;
using Long33 = Eigen::Matrix<long double, 3, 3>;

const State kStates[] = {{"VV", 1, 1},          {"VE", 1, 2},          {"EV", 2, 1},         {"EE", 2, 2},
                         {"VF triangle", 1, 3}, {"FV triangle", 3, 1}, {"VF polygon", 1, 4}, {"FV polygon", 4, 1}};

/// Two axes across the way to the other body, and that way.
struct Frame {
  Vec3 e, f, out;
  Vec3 at(double x, double y, double depth) const { return x * e + y * f - depth * out; }
};
Frame frame(Random& random, const Vec3& out) {
  const Vec3 e = out.cross(random.on_sphere()).normalized();
  return {e, out.cross(e), out};
}

/// A body around the point 0 of its feature; `near` is the vertex at the margin, if there is one.
struct Built {
  bodies::Polyhedron body;
  int near = -1;
};

/// `border` is a depth, `side` a distance from the side of a polygon.
Built build(Random& random, int corners, const Frame& at, double size, double border, double side) {
  Built built;
  std::vector<Vec3>& points = built.body.points;
  const auto length = [&] { return size * random.uniform(0.1, 1); };
  if (corners == 4) {
    const int sides = 4 + int(random.bits() % 4);
    const double radius = length(), depth = length(), taper = random.uniform(0.5, 1.5),
                 off = side - radius * std::cos(std::numbers::pi / sides);
    for (const double layer : {0., 1.}) {
      for (int i = 0; i < sides; ++i) {
        const double angle = (2 * i + 1) * std::numbers::pi / sides, r = radius * (layer == 0 ? 1 : taper);
        points.push_back(at.at(off + r * std::cos(angle), r * std::sin(angle), layer * depth));
      }
    }
    for (int i = 0; i < sides; ++i) built.body.corners.push_back(std::uint32_t(i));
    for (int i = sides; i-- > 0;) built.body.corners.push_back(std::uint32_t(sides + i));
    built.body.sizes = {std::uint32_t(sides), std::uint32_t(sides)};
    for (int i = 0; i < sides; ++i) {
      const auto k = std::uint32_t(i), next = std::uint32_t((i + 1) % sides), n = std::uint32_t(sides);
      built.body.add({k, n + k, n + next, next});
    }
    return built;
  }
  if (corners == 1) points.push_back(at.at(0, 0, 0));
  if (corners == 2) points = {at.at(length(), 0, 0), at.at(-length(), 0, 0)};
  if (corners == 3)
    points = {at.at(-side, length(), 0), at.at(-side, -length(), 0), at.at(length(), random.uniform(-0.1, 0.1) * size, 0)};
  if (corners != 3) built.near = corners;
  for (int turn = 0; points.size() < 4; ++turn) {
    const double angle =
                     corners == 2 ? (0.5 + turn) * std::numbers::pi + random.uniform(-1, 1) : 2 * turn + random.uniform(0, 1),
                 r = length();
    const double depth = turn == 0 && corners != 3                ? border
                         : corners == 3 && random.bits() % 4 == 0 ? 1e-12 * length()
                                                                  : length();
    points.push_back(at.at(r * std::cos(angle), r * std::sin(angle), depth));
  }
  return built;
}
/// Faces of a tetrahedron, by the side on which its last corner is.
void close(bodies::Polyhedron& body) {
  if (!body.sizes.empty()) return;
  const auto& q = body.points;
  const auto from = [&](std::size_t i) -> Long3 { return (q[i].cast<long double>() - q[0].cast<long double>()).eval(); };
  if (from(1).cross(from(2)).dot(from(3)) < 0)
    body.add({0, 1, 2}), body.add({0, 2, 3}), body.add({0, 3, 1}), body.add({1, 3, 2});
  else
    body.add({0, 2, 1}), body.add({0, 3, 2}), body.add({0, 1, 3}), body.add({1, 2, 3});
}

/// Points x of the common frame as points y of B: R y + t = x, right to the last bits.
Vec3 own(const Pose& pose, const Vec3& x) {
  const Long33 r = pose.rotation.cast<long double>();
  const Long3 offset = x.cast<long double>() - pose.translation.cast<long double>();
  Long3 y = r.transpose() * offset;
  for (int i = 0; i < 3; ++i) y += r.transpose() * (offset - r * y);
  return y.cast<double>();
}

Pose random_pose(Random& random) {
  Mat3 r = Mat3::Identity();
  const std::uint64_t how = random.bits() % 4;
  if (how > 0) r = random.rotation();
  if (how == 3) r = r.cast<float>().cast<double>();
  return {r, Vec3::Zero()};
}

/// How far below the feature the vertex `near` of a moved body is along `n`, over the depth from which the walk proves it.
double depth_over_border(const std::vector<Vec3>& points, int near, const Long33& r, const Vec3& n, double border) {
  const Long3 way = r * (points[std::size_t(near)].cast<long double>() - points[0].cast<long double>());
  return double(-way.dot(n.cast<long double>().normalized())) / border;
}

std::string text(const char* name, const std::vector<Vec3>& points) {
  std::string line = name;
  char number[40];
  for (const Vec3& q : points) {
    for (const double x : q) std::snprintf(number, sizeof number, " %a", x), line += number;
  }
  return line + "\n";
}

bool is_feature(const ConvexView& view, FeatureId feature, int corners) {
  using enum FeatureKind;
  if (feature.kind() == Vertex) return corners == 1;
  if (feature.kind() == Edge) return corners == 2;
  return corners == (feature.index() < view.planes.size() ? 4 : 3);
}

/// The depth below a feature from which a walk's tests prove that the vertex is below, as marcher.h has it, for a unit normal.
double border_of(int corners, bool moved, const Vec3& n, double extent, double reach, double sine) {
  if (corners == 1) return kScanError * extent * n.lpNorm<1>();
  const double way = moved ? kTurnedWayError : kWayError, tilt = sine > 0 ? kFlatError / sine : kAcrossError;
  return (tilt + way + kBesideError) * reach * n.lpNorm<1>();
}

void attack_once(Random& random, const State& state, bool loose, Walks& result) {
  // Sizes of 1e-30 to 1e30, either body up to 2^30 smaller; origins at the features, or as far away as the body is large.
  const double size = std::exp2(random.uniform(-100, 100)),
               size_a = size * (random.bits() & 1 ? 1 : std::exp2(-random.uniform(0, 30))),
               size_b = size * (random.bits() & 1 ? 1 : std::exp2(-random.uniform(0, 30)));
  const Vec3 n = random.bits() % 4 == 0 ? Vec3(Vec3::Unit(int(random.bits() % 3))) : random.on_sphere();
  const Vec3 foot_a =
      random.bits() & 1 ? Vec3(Vec3::Zero()) : Vec3(size_a * random.in_ball() * std::exp2(random.uniform(-3, 3)));
  Pose pose = random_pose(random);
  const Motion turn = motion(pose);
  const double pose_error = pose_quality(turn).error;
  const double span = size_a + foot_a.cwiseAbs().maxCoeff() + size_b,
               gap = (2 * kLawTwo + 4 * pose_error) * span *
                     std::exp2(random.bits() & 1 ? random.uniform(0, 3) : random.uniform(0, 40));
  const Vec3 foot_b = foot_a + gap * n;
  pose.translation = random.bits() & 1 ? foot_b : Vec3(foot_b + size_b * random.in_ball());

  const Frame up = frame(random, n), down = frame(random, -n);
  const auto fraction = [&] { return random.bits() & 1 ? random.uniform(0, 3) : random.uniform(-0.05, 0.05); };
  const double sine = state.corners_a == 2 && state.corners_b == 2 ? std::fabs(up.e.cross(down.e).norm()) : 0,
               foot_margin = (kFootError + kFootTurn * pose_error) * (kSqrt3 * span + pose.translation.norm()),
               side = random.bits() & 1 ? fraction() * foot_margin : 0.05 * random.uniform() * size;
  const double border_a = border_of(state.corners_a, false, n, foot_a.cwiseAbs().maxCoeff() + size_a, 2 * size_a, sine),
               border_b = border_of(state.corners_b, true, n, (foot_b - pose.translation).cwiseAbs().maxCoeff() + size_b,
                                    2 * size_b, sine);
  Built a = build(random, state.corners_a, up, size_a, fraction() * border_a, side),
        b = build(random, state.corners_b, down, size_b, fraction() * border_b, side);
  for (Vec3& q : a.body.points) q += foot_a;
  for (Vec3& q : b.body.points) q = own(pose, q + foot_b);
  close(a.body), close(b.body);
  ModelOptions options;
  options.repair = true;
  options.table.map_cells = 0;
  const Result<Model> model_a = Model::from_level(a.body.level(), options),
                      model_b = Model::from_level(b.body.level(), options);
  if (!model_a || !model_b) return;

  const ConvexView &view_a = model_a.value().level(0).view, &view_b = model_b.value().level(0).view;
  const Motion m = motion(pose);
  const PlaneRule rule = random.bits() & 1 ? PlaneRule::MostViolated : PlaneRule::FirstViolated;
  const PairView pair = pair_view(view_a, view_b, m, pose_error);
  const FeatureId first{FeatureKind::Vertex, 0};
  const Walk end = loose ? loose_walk(pair, first, first, rule, 100) : walk(pair, first, first, rule, 100);
  if (end.end != WalkEnd::Minimum || !is_feature(view_a, end.a, state.corners_a) || !is_feature(view_b, end.b, state.corners_b))
    return;
  ++result.count;
  Proof proof{};
  const bool accepted = certify(pair, end.nearest, proof) == Doubt::None;
  result.accepted += accepted;

  const Vec3 normal = eigen(end.nearest.normal).normalized();
  const auto is_near = [](double over) { return over > -1 && over < 3; };
  bool near = (state.corners_a == 4 || state.corners_b == 4) && is_near(side / foot_margin);
  if (a.near >= 0) {
    const double border = border_of(state.corners_a, false, normal, view_a.extent, pair.reach_a, sine);
    near |= is_near(depth_over_border(a.body.points, a.near, Long33::Identity(), normal, border));
  }
  if (b.near >= 0) {
    const double border = border_of(state.corners_b, true, normal, view_b.extent, pair.reach_b, sine);
    near |= is_near(depth_over_border(b.body.points, b.near, pose.rotation.cast<long double>(), -normal, border));
  }
  result.near += near;
  result.near_accepted += near && accepted;
  if (!accepted) return;
  const Vec3 direction = eigen(proof.normal);
  if (oracle::is_apart_along(a.body.points, b.body.points, pose, direction, proof.lower) &&
      oracle::is_within(a.body.points, b.body.points, pose, proof.upper))
    return;
  if (++result.wrong > 1) return;
  result.worst = text("A", a.body.points) + text("B", b.body.points) +
                 text("pose", {pose.rotation.row(0), pose.rotation.row(1), pose.rotation.row(2), pose.translation}) +
                 text("normal, bounds", {direction, {proof.lower, proof.upper, 0}});
}

}  // namespace

std::span<const State> states() { return kStates; }

Walks attack(const State& state, std::uint64_t count, bool loose) {
  Random random(std::uint64_t(&state - kStates) + 101);
  Walks result;
  for (std::uint64_t i = 0; i < count; ++i) attack_once(random, state, loose, result);
  return result;
}

}  // namespace swiftlet::margins
