// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
//   B. Mirtich, V-Clip: Fast and Robust Polyhedral Collision Detection. MERL TR-97-05, 1997.
#include "generators.h"

#include <swiftlet/build.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <filesystem>
#include <string>

#include "answers.h"
#include "bodies.h"
#include "mesh_pairs.h"

namespace swiftlet::stability {
namespace {

using shapes::Random;

// ---- Bodies -----------------------------------------------------------------------------------------------------------------

Subject built(const std::vector<Vec3>& points, const BuildOptions& options = {}) {
  return make_subject(points, bodies::must(build(points, options)).model);
}
/// Of pairs that are asked a few times only: no start table.
Subject quickly_built(const std::vector<Vec3>& points) {
  BuildOptions options;
  options.max_levels = 1;
  options.table.resolution = lut::Resolution::None;
  return built(points, options);
}
Subject of_faces(const bodies::Polyhedron& body) { return make_subject(body.points, bodies::model(body)); }

std::vector<Vec3> ball_points(Random& random, std::uint32_t count) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = random.in_ball();
  return points;
}
std::vector<Vec3> mapped(std::vector<Vec3> points, const Mat3& m, const Vec3& shift = Vec3::Zero()) {
  for (Vec3& p : points) p = m * p + shift;
  return points;
}
std::uint32_t below(Random& random, std::uint32_t count) { return std::uint32_t(random.bits() % count); }
/// 10^-uniform(from, to).
double decades(Random& random, double from, double to) { return std::pow(10, -random.uniform(from, to)); }
double sign(Random& random) { return random.bits() % 2 ? 1 : -1; }

Mat3 rows(double a, double b, double c, double d, double e, double f, double g, double h, double i) {
  Mat3 m;
  m << a, b, c, d, e, f, g, h, i;
  return m;
}
/// The 24 turns of a cube onto itself: exact in doubles, as are their products and inverses.
Mat3 cube_turn(Random& random) {
  const Mat3 x = rows(1, 0, 0, 0, 0, -1, 0, 1, 0), z = rows(0, -1, 0, 1, 0, 0, 0, 0, 1);
  Mat3 m = Mat3::Identity();
  for (int i = 0; i < 6; ++i) m = m * (random.bits() % 2 ? x : z);
  return m;
}

FeatureId some_feature(const ConvexView& view, Random& random) {
  const auto vertices = std::uint32_t(view.vertices.size()), edges = std::uint32_t(view.half_edges.size()),
             faces = std::uint32_t(view.face_first.size());
  const std::uint32_t i = below(random, vertices + edges + faces);
  if (i < vertices) return {FeatureKind::Vertex, i};
  return i < vertices + edges ? FeatureId{FeatureKind::Edge, i - vertices} : FeatureId{FeatureKind::Face, i - vertices - edges};
}
/// Features that exist, on levels that exist.
PairSeed some_seed(const Subject& a, const Subject& b, Random& random) {
  PairSeed seed;
  seed.level_a = std::uint8_t(below(random, std::uint32_t(a.model.level_count())));
  seed.level_b = std::uint8_t(below(random, std::uint32_t(b.model.level_count())));
  seed.a = some_feature(a.model.level(seed.level_a).view, random);
  seed.b = some_feature(b.model.level(seed.level_b).view, random);
  return seed;
}
PairSeed random_bytes(Random& random) {
  PairSeed seed;
  std::array<std::uint64_t, sizeof seed / 8 + 1> bytes;
  for (std::uint64_t& word : bytes) word = random.bits();
  std::memcpy(static_cast<void*>(&seed), bytes.data(), sizeof seed);
  return seed;
}

/// The pose of that rotation where B, come from `direction`, stands `gap` off A, or that deep in it, up to rounding.
Pose slid(const Subject& a, const Subject& b, const Mat3& rotation, const Vec3& direction, double gap) {
  Pose pose{rotation, direction * (4 * (a.extent + b.extent))};
  PairSeed seed;
  for (int i = 0; i < 2; ++i) {  // the second time from near, where rounding is that of the bodies
    const Answer answer = signed_distance(a.model, b.model, pose, seed);
    pose.translation -= (answer.lower - gap) * answer.normal;
  }
  return pose;
}

// ---- Lattices ---------------------------------------------------------------------------------------------------------------

/// Two makes of the same cube: its faces as quads, and as triangles.
const std::deque<Subject>& lattice_cubes() {
  static const std::deque<Subject> cubes{of_faces(bodies::cube()), of_faces(bodies::triangulated(bodies::cube()))};
  return cubes;
}
/// These, boxes down to a slab, the other small solids, and prisms of 3 to 12 sides.
const std::deque<Subject>& lattice_solids() {
  static const std::deque<Subject> solids = [] {
    std::deque<Subject> all = lattice_cubes();
    for (const Vec3& half : {Vec3(1, 1, 0.1), Vec3(1, 0.5, 0.25), Vec3(1, 1, 0x1p-7)})
      all.push_back(of_faces(bodies::box(half.x(), half.y(), half.z())));
    for (const bodies::Polyhedron& body : {bodies::tetrahedron(), bodies::octahedron()}) all.push_back(of_faces(body));
    for (std::uint32_t sides = 3; sides <= 12; ++sides) all.push_back(quickly_built(shapes::prism(sides, 1, 0.5).points));
    return all;
  }();
  return solids;
}
const Subject& some(const std::deque<Subject>& subjects, Random& random) {
  return subjects[below(random, std::uint32_t(subjects.size()))];
}
/// Half the sides of the box around a body turned, that is centred.
Vec3 half_box(const Subject& subject, const Mat3& turn = Mat3::Identity()) {
  Vec3 most = Vec3::Zero();
  for (const Vec3& p : subject.points) most = most.cwiseMax((turn * p).cwiseAbs());
  return most;
}

constexpr int kReach = 6, kSide = 2 * kReach + 1, kTurns = 6;

/// A slice of the lattice: one turn, one x, all y and z, in quarters of where the boxes around two of the bodies meet, to one
/// and a half times that: of cubes in halves from -3 to 3. B is shaken by what `shake` makes of the pose. 78 slices are all 13
/// 182 poses.
template <class Shake>
void lattice(Examiner& examiner, std::uint64_t index, const std::deque<Subject>& bodies, const std::array<Mat3, kTurns>& turns,
             Shake shake) {
  const Mat3& turn = turns[index % kTurns];
  const double x = double(index / kTurns % kSide) - kReach;
  const Subject& a = some(bodies, examiner.random);
  const Subject& b = examiner.random.bits() % 4 ? a : some(bodies, examiner.random);
  const Vec3 cell = (half_box(a) + half_box(b, turn)) / 4;
  PairSeed warm;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int z = -kReach; z <= kReach; ++z) {
      Pose pose{turn, Vec3(x, y, z).cwiseProduct(cell)};
      shake(pose);
      Pair pair(examiner, a, b, pose);
      PairSeed any = some_seed(a, b, examiner.random);
      const Answer answer = pair.ask(examiner.random.bits() % 4 ? warm : any);
      examiner.hit(answer.verdict == Verdict::Touching);
    }
  }
}

const std::array<Mat3, kTurns>& quarter_turns() {
  static const Mat3 x = rows(1, 0, 0, 0, 0, -1, 0, 1, 0), z = rows(0, -1, 0, 1, 0, 0, 0, 0, 1);
  static const std::array<Mat3, kTurns> turns{Mat3::Identity(), z, x, z * z, x * x, z * x};
  return turns;
}
const std::array<Mat3, kTurns>& eighth_turns() {
  static const double angle = std::acos(0.0) / 2;
  static const Mat3 x = shapes::rotation(Vec3::UnitX(), angle), y = shapes::rotation(Vec3::UnitY(), angle),
                    z = shapes::rotation(Vec3::UnitZ(), angle);
  static const std::array<Mat3, kTurns> turns{x, y, z, z * x, quarter_turns()[1] * x, y * z};
  return turns;
}

void lattice_quarters(Examiner& examiner, std::uint64_t index) {
  lattice(examiner, index, lattice_cubes(), quarter_turns(), [](Pose&) {});
}
void lattice_eighths(Examiner& examiner, std::uint64_t index) {
  lattice(examiner, index, lattice_cubes(), eighth_turns(), [](Pose&) {});
}
/// 2^-uniform(from, to).
double halvings(Random& random, double from, double to) { return std::exp2(-random.uniform(from, to)); }

/// The rotation as it is, turned a little as a whole, or, as often as both, some of its entries changed one by one.
Mat3 shaken(const Mat3& rotation, Random& random) {
  Mat3 result = rotation;
  switch (below(random, 4)) {
    case 0: break;
    case 1: result = rotation * shapes::rotation(random.on_sphere(), halvings(random, 13, 53)); break;
    default: {
      const double size = halvings(random, 30, 52);
      for (double& x : result.reshaped())
        if (random.bits() % 2) x += size * random.uniform(-1, 1);
    }
  }
  return result;
}
/// Rotation and translation each by a size of its own or not at all; of half the poses the centres are equal, or nearly, so
/// that seeds come to them from bodies apart.
void lattice_shaken(Examiner& examiner, std::uint64_t index) {
  Random& random = examiner.random;
  lattice(examiner, index, lattice_solids(), quarter_turns(), [&](Pose& pose) {
    pose.rotation = shaken(pose.rotation, random);
    switch (below(random, 4)) {
      case 0: break;
      case 1: pose.translation += decades(random, 4, 16) * random.in_ball(); break;
      case 2: pose.translation.setZero(); break;
      default: pose.translation = halvings(random, 30, 60) * random.on_sphere();
    }
  });
}

/// One pose of a lattice, the walk started on level 0 from every pair of features (traps G16 and G18).
void every_start(Examiner& examiner, std::uint64_t index) {
  static const std::array<Subject, 4> subjects{of_faces(bodies::cube()), of_faces(bodies::tetrahedron()),
                                               of_faces(bodies::octahedron()), of_faces(bodies::box(0.25, 0.5, 0.125))};
  Random& random = examiner.random;
  const Subject &a = subjects[index % 4], &b = subjects[index / 4 % 4];
  const Mat3 turns[] = {Mat3::Identity(), quarter_turns()[index % kTurns], eighth_turns()[index % kTurns]};
  Pose pose{turns[below(random, 3)], Vec3::Zero()};
  for (double& x : pose.translation) x = (double(below(random, 13)) - 6) / 4;
  Pair pair(examiner, a, b, pose);
  pair.solve();
  const ConvexView &view_a = a.model.level(0).view, &view_b = b.model.level(0).view;
  const auto features = [](const ConvexView& view) {
    std::vector<FeatureId> all;
    for (std::uint32_t i = 0; i < view.vertices.size(); ++i) all.emplace_back(FeatureKind::Vertex, i);
    for (std::uint32_t i = 0; i < view.half_edges.size(); ++i)
      if (i < view.half_edges[i].twin) all.emplace_back(FeatureKind::Edge, i);
    for (std::uint32_t i = 0; i < view.face_first.size(); ++i) all.emplace_back(FeatureKind::Face, i);
    return all;
  };
  Options options;
  options.tuning.start = StartPolicy::Finest;
  const Answer cold = pair.ask();
  for (const FeatureId feature_a : features(view_a)) {
    for (const FeatureId feature_b : features(view_b)) {
      PairSeed seed;
      seed.a = feature_a;
      seed.b = feature_b;
      pair.agree(cold, pair.exact(seed, options), "another start");
    }
  }
  examiner.hit(cold.verdict != Verdict::Disjoint);
}

// ---- Nearly parallel --------------------------------------------------------------------------------------------------------

/// A pose that a parameter moves from one of Mirtich's poses to another.
struct MirtichPath {
  Vec3 from, to, axis_from, axis_to;
  double angle_from, angle_to;

  explicit MirtichPath(Random& random) {
    for (Vec3* p : {&from, &to}) *p = {random.uniform(-4, 4), random.uniform(-4, 4), 4};
    for (Vec3* axis : {&axis_from, &axis_to}) *axis = random.on_sphere();
    for (double* angle : {&angle_from, &angle_to}) *angle = std::exp(-random.uniform(0, 20));
  }
  Pose pose(double s) const {
    const Vec3 axis = (1 - s) * axis_from + s * axis_to;
    return {shapes::rotation(axis.normalized(), (1 - s) * angle_from + s * angle_to), (1 - s) * from + s * to};
  }
};

/// [Mirtich 1997]: nearly parallel cubes, bisected to neighbouring doubles of the parameter between which the nearest features
/// change (trap G18).
void degeneracy_search(Examiner& examiner, std::uint64_t) {
  const Subject& cube = lattice_cubes().front();
  for (int trial = 0; trial < 100; ++trial) {
    const MirtichPath path(examiner.random);
    PairSeed low_seed, high_seed;
    const auto ask = [&](double s, PairSeed& seed) {
      Pair pair(examiner, cube, cube, path.pose(s));
      const Answer answer = pair.exact(seed);
      pair.require(answer.lower > 4 - 2 * std::sqrt(3) - 1e-12, "cubes of Mirtich's search are never that near");
      return answer;
    };
    double low = 0, high = 1;
    Answer at_low = ask(low, low_seed);
    const Answer at_high = ask(high, high_seed);
    const bool changes = at_low.feature_a != at_high.feature_a || at_low.feature_b != at_high.feature_b;
    while (changes) {
      const double middle = low + (high - low) / 2;
      if (middle <= low || middle >= high) break;
      PairSeed seed = low_seed;
      const Answer answer = ask(middle, seed);
      if (answer.feature_a == at_low.feature_a && answer.feature_b == at_low.feature_b) {
        low = middle;
        low_seed = seed;
      } else {
        high = middle;
        high_seed = seed;
      }
    }
    if (changes) {
      Pair(examiner, cube, cube, path.pose(low)).ask(high_seed);
      Pair(examiner, cube, cube, path.pose(high)).ask(low_seed);
    }
    examiner.hit(changes);
  }
}

/// Faces that are parallel up to an angle e^-k, near contact.
void near_parallel(Examiner& examiner, std::uint64_t) {
  static const std::array<Subject, 4> subjects{of_faces(bodies::cube()), of_faces(bodies::box(2, 0.5, 1)),
                                               built(shapes::prism(6, 1, 2).points), built(shapes::prism(5, 1.5, 2).points)};
  Random& random = examiner.random;
  PairSeed warm;
  for (int i = 0; i < 40; ++i) {
    const Subject &a = subjects[below(random, 4)], &b = subjects[below(random, 4)];
    const double tilt = std::exp(-random.uniform(0, 36)), gap = sign(random) * decades(random, 0, 17);
    const Pose pose{shapes::rotation(random.on_sphere(), tilt), {random.uniform(-2, 2), random.uniform(-2, 2), 2 + gap}};
    Pair pair(examiner, a, b, pose);
    const Answer answer = pair.ask(warm);
    examiner.hit(answer.verdict != Verdict::Overlapping && std::fabs(answer.normal.z()) > 0.999);
  }
}

/// One prism on another, face on face, exactly or up to rounding.
void stacked_prisms(Examiner& examiner, std::uint64_t) {
  static const std::deque<Subject> subjects = [] {
    std::deque<Subject> all;
    for (const std::uint32_t sides : {3u, 4u, 5u, 6u, 8u, 12u, 17u, 30u}) {
      all.push_back(built(shapes::prism(sides, 1, 0.25).points));
      all.push_back(built(shapes::prism(sides, 0.3, 0.25).points));
    }
    return all;
  }();
  Random& random = examiner.random;
  for (int i = 0; i < 30; ++i) {
    const Subject &a = subjects[below(random, std::uint32_t(subjects.size()))],
                  &b = subjects[below(random, std::uint32_t(subjects.size()))];
    Mat3 turn = Mat3::Identity();
    if (random.bits() % 2) turn = shapes::rotation(Vec3::UnitZ(), random.uniform(0, 6));
    Vec3 at(0, 0, 0.25);
    if (random.bits() % 2) at += Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    if (random.bits() % 2) at.z() += sign(random) * decades(random, 12, 18);
    if (random.bits() % 2) turn = turn * shapes::rotation(random.on_sphere(), decades(random, 8, 17));
    PairSeed seed = some_seed(a, b, random);
    Pair pair(examiner, a, b, {turn, at});
    examiner.hit(pair.ask(seed).verdict == Verdict::Touching);
  }
}

/// Two edges that cross at an angle of 1 to 1e-15 (trap G20).
void edge_edge_angles(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  // A roof, its ridge along x in z = 0; the other one upside down, turned about z by the angle.
  const auto roof = [&](double down, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), w = random.uniform(0.2, 2);
    return quickly_built({{c, s, 0}, {-c, -s, 0}, {-s * w, c * w, down}, {s * w, -c * w, down}});
  };
  for (int i = 0; i < 6; ++i) {
    const double angle = decades(random, 0, 15);
    const bool by_pose = random.bits() % 2;
    const Subject a = roof(-random.uniform(0.3, 2), 0), b = roof(random.uniform(0.3, 2), by_pose ? 0 : angle);
    const Mat3 turn = by_pose ? shapes::rotation(Vec3::UnitZ(), angle) : Mat3(Mat3::Identity());
    PairSeed warm;
    for (int k = 0; k < 6; ++k) {
      const double gap = random.bits() % 4 ? decades(random, 0, 16) : 0;
      // Across by less than what the angle opens over half an edge, so that they do cross; now and then beyond.
      const double across = random.uniform(-1, 1) * angle * (k % 3 ? 0.5 : 2);
      Pair pair(examiner, a, b, {turn, {random.uniform(-0.3, 0.3), across, gap}});
      const Answer answer = pair.ask(warm);
      examiner.hit(answer.feature_a.kind() == FeatureKind::Edge && answer.feature_b.kind() == FeatureKind::Edge);
    }
  }
}

// ---- Thin, small, far -------------------------------------------------------------------------------------------------------

/// Aspects to 1e6, slid to within rounding of contact and off it.
void plates_and_needles(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const auto thin = [&]() -> Subject {
    const double aspect = decades(random, 0, 6);
    const Vec3 axes = random.bits() % 2 ? Vec3(1, 1, aspect) : Vec3(1, aspect, aspect);
    switch (random.bits() % 3) {
      case 0: return quickly_built(shapes::box(2 * axes).points);
      case 1: return quickly_built(mapped(shapes::prism(3 + below(random, 10), 1, 2).points, axes.asDiagonal()));
      default: return quickly_built(mapped(ball_points(random, 6 + below(random, 20)), axes.asDiagonal()));
    }
  };
  for (int i = 0; i < 4; ++i) {
    const Subject a = thin(), b = thin();
    for (int k = 0; k < 6; ++k) {
      const double gap = k < 3 ? 0 : sign(random) * decades(random, 0, 16);
      const Pose pose = slid(a, b, random.rotation(), random.on_sphere(), gap);
      Pair pair(examiner, a, b, pose);
      PairSeed seed = some_seed(a, b, random);
      examiner.hit(pair.ask(seed).verdict == Verdict::Touching);
    }
  }
}

/// One body up to 1e9 times the other, near its surface.
void size_ratio(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  for (int i = 0; i < 3; ++i) {
    const double ratio = decades(random, 0, 9);
    const Subject large = quickly_built(ball_points(random, 8 + below(random, 24))),
                  small = quickly_built(mapped(ball_points(random, 4 + below(random, 16)), ratio * Mat3::Identity()));
    for (int k = 0; k < 6; ++k) {
      const bool turned = random.bits() % 2;
      const Subject &a = turned ? small : large, &b = turned ? large : small;
      const double gap = sign(random) * ratio * decades(random, -1, 4);
      Pair pair(examiner, a, b, slid(a, b, random.rotation(), random.on_sphere(), gap));
      PairSeed seed = some_seed(a, b, random);
      const Answer answer = pair.ask(seed);
      examiner.hit(answer.verdict == Verdict::Disjoint && answer.lower < 100 * ratio);
    }
  }
}

/// Bodies up to 2^50 from their own origin, or their poses that far apart, on a grid that doubles hold there (trap G25).
void far_offsets(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const auto grid = [](Vec3 p) { return Vec3(p.array().round()); };
  const auto near_body = [&] {
    std::vector<Vec3> points = ball_points(random, 6 + below(random, 14));
    for (Vec3& p : points) p = grid(64 * p);
    return points;
  };
  for (int i = 0; i < 3; ++i) {
    const double far = std::ldexp(1, int(below(random, 51)));
    const Vec3 offset_a = grid(far * random.on_sphere()), offset_b = grid(far * random.on_sphere());
    const Subject a = quickly_built(mapped(near_body(), Mat3::Identity(), offset_a)),
                  b = quickly_built(mapped(near_body(), Mat3::Identity(), offset_b));
    PairSeed warm;
    for (int k = 0; k < 8; ++k) {
      const Mat3 turn = k % 2 ? random.rotation() : cube_turn(random);
      const Vec3 apart = grid(random.on_sphere() * random.uniform(0, 200));
      Pair pair(examiner, a, b, {turn, offset_a - turn * offset_b + apart});
      const Answer answer = pair.ask(warm);
      examiner.hit(answer.verdict == Verdict::Overlapping);
    }
  }
}

/// Whether `large` is `answer` times s in every bit.
bool is_scaled(Answer answer, const Answer& large, double s) {
  answer.lower *= s, answer.upper *= s, answer.point_a *= s, answer.point_b *= s;
  answer.radius_a *= s, answer.radius_b *= s;
  return answers::same_bits(answer, large);
}
bool is_scaled(const MarchResult& r, const MarchResult& large, double s) {
  return large.status == r.status && large.lower == s * r.lower && large.upper == s * r.upper && large.normal == r.normal &&
         large.point_a == s * r.point_a && large.point_b == s * r.point_b && large.a == r.a && large.b == r.b &&
         large.steps == r.steps && large.plane_tests == r.plane_tests;
}
bool is_scaled(const Manifold& manifold, const Manifold& large, double s) {
  bool same = large.count == manifold.count;
  for (std::uint32_t i = 0; same && i < manifold.count; ++i) {
    const ManifoldPoint &p = manifold.points[i], &q = large.points[i];
    same = q.point_a == s * p.point_a && q.point_b == s * p.point_b && q.separation == s * p.separation;
  }
  return same;
}

/// Bodies and translation times 2^k: the same answer of every query in every bit, times 2^k (trap G25).
void powers_of_two(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const std::vector<Vec3> points_a = ball_points(random, 4 + below(random, 20)),
                          points_b = random.bits() % 2 ? shapes::cube().points : ball_points(random, 4 + below(random, 20));
  const Subject a = quickly_built(points_a), b = quickly_built(points_b);
  for (int i = 0; i < 3; ++i) {
    const int k = int(below(random, 281)) - 140;
    const double s = std::ldexp(1, k);
    const Subject scaled_a = quickly_built(mapped(points_a, s * Mat3::Identity())),
                  scaled_b = quickly_built(mapped(points_b, s * Mat3::Identity()));
    for (int n = 0; n < 6; ++n) {
      const Pose pose{random.bits() % 2 ? random.rotation() : cube_turn(random), random.on_sphere() * random.uniform(0, 4)},
          scaled_pose{pose.rotation, s * pose.translation};
      const PairSeed seed = some_seed(a, b, random);
      PairSeed one = seed, other = seed;
      const Answer plain = Pair(examiner, a, b, pose).exact(one);
      Pair pair(examiner, scaled_a, scaled_b, scaled_pose);
      const Answer scaled = pair.exact(other);
      const auto require = [&](bool same, const std::string& what) {
        pair.require(same, what + " is not that of the pair 2^" + std::to_string(-k) + " times as large");
      };
      require(is_scaled(plain, scaled, s), "distance");
      require(
          is_scaled(intersects(a.model, b.model, pose, one), intersects(scaled_a.model, scaled_b.model, scaled_pose, other), s),
          "verdict");
      const double threshold = random.uniform(0, 2), margin = random.uniform(0, 0.2);
      const Within near = within(a.model, b.model, pose, threshold, one),
                   scaled_near = within(scaled_a.model, scaled_b.model, scaled_pose, s * threshold, other);
      require(near.decision == scaled_near.decision && is_scaled(near.answer, scaled_near.answer, s), "decision");
      one = other = seed;
      const Answer depth = signed_distance(a.model, b.model, pose, one),
                   scaled_depth = signed_distance(scaled_a.model, scaled_b.model, scaled_pose, other);
      require(is_scaled(depth, scaled_depth, s), "signed distance");
      ManifoldOptions options, scaled_options;
      options.margin = margin, scaled_options.margin = s * margin;
      require(is_scaled(manifold(a.model, b.model, pose, depth, options),
                        manifold(scaled_a.model, scaled_b.model, scaled_pose, scaled_depth, scaled_options), s),
              "manifold");
      require(is_scaled(march(a.model.level(0).view, b.model.level(0).view, pose),
                        march(scaled_a.model.level(0).view, scaled_b.model.level(0).view, scaled_pose), s),
              "march");
      examiner.hit(k != 0 && scaled.verdict == Verdict::Disjoint);
    }
  }
}

// ---- Contact ----------------------------------------------------------------------------------------------------------------

/// B moves into A along a line, in exact steps: the distance never grows, and the sign changes once.
void sweeps(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  for (int i = 0; i < 2; ++i) {
    const Subject a = quickly_built(ball_points(random, 6 + below(random, 20))),
                  b = quickly_built(ball_points(random, 6 + below(random, 20)));
    const Mat3 rotation = random.bits() % 2 ? random.rotation() : cube_turn(random);
    Vec3 direction;
    do {
      for (double& x : direction) x = double(below(random, 7)) - 3;
    } while (direction.isZero());
    // Multiples of 2^-46 below 8, times at most 3: every translation is exact, and all lie on one line.
    const auto pose = [&](double s) { return Pose{rotation, (s - 4) * direction}; };
    constexpr double kStep = 0x1p-46;
    double low = 0, high = 4;
    PairSeed warm;
    const auto overlaps = [&](double s) { return distance(a.model, b.model, pose(s), warm).verdict == Verdict::Overlapping; };
    const bool meets = !overlaps(low) && overlaps(high);
    examiner.hit(meets);
    if (!meets) continue;
    while (high - low > kStep) {
      const double middle = std::floor((low + high) / 2 / kStep) * kStep;
      (overlaps(middle) ? high : low) = middle;
    }
    std::vector<double> stops{0, 0.5, 1, 4, high};
    for (double d = kStep; d < 1; d *= 3) {
      for (const double s : {high - std::round(d / kStep) * kStep, high + std::round(d / kStep) * kStep})
        if (s >= 0 && s <= 4) stops.push_back(s);
    }
    std::sort(stops.begin(), stops.end());
    double upper = std::numeric_limits<double>::infinity();
    bool met = false;
    for (const double s : stops) {
      Pair pair(examiner, a, b, pose(s));
      const Answer answer = pair.ask(warm);
      pair.require(answer.lower <= upper, "the distance grew while the bodies approached");
      pair.require(!met || answer.verdict != Verdict::Disjoint, "the sign changed twice");
      upper = answer.upper;
      met = met || answer.verdict == Verdict::Overlapping;
    }
  }
}

/// Slid into contact until rounding alone tells touching from overlap.
void kissing(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  for (int i = 0; i < 3; ++i) {
    const Subject a = quickly_built(ball_points(random, 4 + below(random, 40))),
                  b = quickly_built(ball_points(random, 4 + below(random, 40)));
    for (int k = 0; k < 6; ++k) {
      const double gap = random.bits() % 4 ? sign(random) * decades(random, 13, 18) : 0;
      Pair pair(examiner, a, b, slid(a, b, random.rotation(), random.on_sphere(), gap));
      PairSeed seed = some_seed(a, b, random);
      examiner.hit(pair.ask(seed).verdict == Verdict::Touching);
    }
  }
}

/// A body in its own copy, in copies of itself that are turned, moved or grown by next to nothing, and in one that is larger by
/// a power of ten, 1 to 1e30 by the batch (trap G16). The unit goes as far as coordinates may; seeds go from pose to pose.
void nested(Examiner& examiner, std::uint64_t index) {
  Random& random = examiner.random;
  Options options;
  options.tuning.start = StartPolicy::Finest;
  constexpr int kDecades = 31;
  const int decade = int(index % kDecades);
  const double ratio = std::pow(10, -decade), unit = random.bits() % 2 ? 1 : decades(random, -44, 44 - decade);
  const std::vector<Vec3> points = [&] {
    switch (below(random, 4)) {
      case 0: return ball_points(random, 8 + below(random, 16));
      case 1: return shapes::ellipsoid({1, 1, 1}, 100 + 2 * below(random, 250), random.bits()).points;
      default: return some(lattice_solids(), random).points;
    }
  }();
  const auto sized = [&](double size, const Mat3& turn) { return quickly_built(mapped(points, unit * size * turn)); };
  const Subject body = sized(1, Mat3::Identity()), grown = sized(1 + sign(random) * decades(random, 1, 16), Mat3::Identity()),
                small = sized(ratio, random.bits() % 2 ? Mat3(Mat3::Identity()) : random.rotation());
  PairSeed warm;
  for (int i = 0; i < 32; ++i) {
    const Subject &a = i % 4 == 3 ? small : body, &b = i % 4 == 1 ? grown : i % 4 == 2 ? small : body;
    Pose pose;
    switch (below(random, 4)) {
      case 0: break;
      case 1: pose.rotation = cube_turn(random); break;
      default: pose.rotation = shaken(cube_turn(random), random);
    }
    if (random.bits() % 2) pose.translation = random.on_sphere() * unit * decades(random, 2, 320);
    Pair pair(examiner, a, b, pose);
    const Answer answer = random.bits() % 2 ? pair.ask(warm) : pair.ask();
    pair.march();
    for (int k = 0; k < 3; ++k) {
      PairSeed seed = some_seed(a, b, random);
      pair.agree(answer, pair.exact(seed, options), "another start");
    }
    examiner.hit(answer.verdict == Verdict::Overlapping);
  }
}

/// The hulls of what models/fetch brings; where it has not run, generated ones in their place.
const std::deque<Subject>& links() {
  static const std::deque<Subject> subjects = [] {
    std::deque<Subject> all;
    const auto add = [&](const Mesh& mesh) {
      const Model model = quickly_built(mesh.points).model;
      all.push_back(make_subject(bodies::points_of(model.level(0).view), model));
    };
    std::vector<std::filesystem::path> meshes;
    if (std::filesystem::is_directory(SWIFTLET_MESHES))
      for (const auto& entry : std::filesystem::directory_iterator(SWIFTLET_MESHES)) meshes.push_back(entry.path());
    std::sort(meshes.begin(), meshes.end());
    for (const auto& path : meshes) add(bodies::must(read_mesh(path)));
    if (!meshes.empty()) return all;
    for (const std::uint32_t sides : {3u, 5u, 12u, 100u}) add(shapes::prism(sides, 0.4, 1));
    for (const shapes::Family family : shapes::kFamilies) add(shapes::ellipsoid(shapes::semi_axes(family), 1000, 7));
    return all;
  }();
  return subjects;
}
/// The hull of 6 to 40 of a body's vertices, in clusters of neighbours.
Subject cut(const Subject& subject, Random& random) {
  const ConvexView& view = subject.model.level(0).view;
  const auto count = std::uint32_t(view.vertices.size());
  std::vector<Vec3> points;
  std::uint32_t at = below(random, count);
  for (std::uint32_t left = 6 + below(random, 35); left > 0; --left) {
    const Vertex& v = view.vertices[at];
    points.emplace_back(v.x, v.y, v.z);
    at = random.bits() % 2 && v.ring_count > 0 ? view.half_edges[v.ring_begin + below(random, v.ring_count)].head
                                               : below(random, count);
  }
  return quickly_built(points);
}

/// Real links, or what a few of their points span, deep inside themselves and each other: at random, or moving on by small
/// steps with the seed of the step before. 676 batches are every two of 13, each as often with itself as with another, whole
/// and cut. Whole ones are compared; few are judged, at some seconds each.
void deep_overlaps(Examiner& examiner, std::uint64_t index) {
  constexpr int kPoses = 32, kJudgeWholes = 4096;
  Random& random = examiner.random;
  const auto& all = links();
  const bool whole = index % 2, alone = index / 2 % 2, coherent = random.bits() % 2;
  const Subject &first = all[index / 4 % all.size()], &second = alone ? first : all[index / 4 / all.size() % all.size()];
  const Subject a = whole ? first : cut(first, random), b = whole ? second : cut(second, random);
  const auto centre = [](const Subject& subject) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : subject.points) sum += p;
    return Vec3(sum / double(subject.points.size()));
  };
  const Vec3 centre_a = centre(a), centre_b = centre(b), axis = random.on_sphere(), drift = random.on_sphere();
  const double step = decades(random, 0.5, 5),
               reach = std::min(half_box(a).norm(), half_box(b).norm()) * decades(random, 0.3, 4);
  Mat3 turn = random.rotation();
  Vec3 aside = reach * random.in_ball();
  PairSeed warm;
  for (int k = 0; k < kPoses; ++k) {
    turn = coherent ? shapes::rotation(axis, step) * turn : random.rotation();
    aside = coherent ? Vec3(aside + step * reach * drift) : Vec3(reach * random.in_ball());
    Pair pair(examiner, a, b, {turn, centre_a - turn * centre_b + aside});
    const bool compares = whole && random.bits() % kJudgeWholes > 0;
    examiner.hit((compares ? pair.compare(warm) : pair.ask(warm)).verdict == Verdict::Overlapping);
  }
}

// ---- The same truth ---------------------------------------------------------------------------------------------------------

/// Points repeated, points inside, points in faces and on edges: the hull of the others.
void extra_points(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  // On a grid where midpoints and centroids are exact.
  const auto grid_points = [&] {
    std::vector<Vec3> points = ball_points(random, 5 + below(random, 12));
    for (Vec3& p : points) p = (p.array() * 8).round() * 12;
    return points;
  };
  const auto mean = [](const Vec3& p, const Vec3& q, const Vec3& r) { return Vec3((p + q + r) / 3); };
  for (int i = 0; i < 2; ++i) {
    const std::vector<Vec3> points = grid_points();
    if (bodies::must(build(points)).model.dimension() < 3) continue;
    const Subject plain = quickly_built(points), other = quickly_built(grid_points());
    std::vector<Vec3> more = points;
    const ConvexView& view = plain.model.level(0).view;
    for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
      const std::vector<Vec3> loop = vertices_of(view, {FeatureKind::Face, f});
      more.push_back(mean(loop[0], loop[1], loop[2]));
    }
    for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
      const std::vector<Vec3> ends = vertices_of(view, {FeatureKind::Edge, h});
      if (random.bits() % 2) more.push_back((ends[0] + ends[1]) / 2);
    }
    for (int k = 0; k < 10; ++k) more.push_back(more[below(random, std::uint32_t(more.size()))]);
    for (std::size_t k = more.size(); k-- > 1;) std::swap(more[k], more[below(random, std::uint32_t(k + 1))]);
    const Built full = bodies::must(build(more));
    const Subject extended = make_subject(more, full.model);
    for (int k = 0; k < 6; ++k) {
      const Pose pose{random.bits() % 2 ? cube_turn(random) : random.rotation(),
                      Vec3((random.in_ball() * 200).array().round())};
      Pair pair(examiner, extended, other, pose);
      const Answer answer = pair.ask();
      PairSeed cold;
      pair.agree(Pair(examiner, plain, other, pose).exact(cold), answer, "the body without the extra points");
      examiner.hit(full.report.duplicates_dropped > 0 && full.report.interior_dropped > 0 &&
                   extended.model.level(0).view.vertices.size() == plain.model.level(0).view.vertices.size());
    }
  }
}

/// Swapped, with points in another order, with other triangles over the same corners.
void same_truth(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const std::vector<Vec3> points = ball_points(random, 6 + below(random, 30));
  std::vector<Vec3> shuffled = points;
  for (std::size_t k = shuffled.size(); k-- > 1;) std::swap(shuffled[k], shuffled[below(random, std::uint32_t(k + 1))]);
  const bool prism = random.bits() % 2;
  const std::vector<Vec3> corners = shapes::prism(6, 1, 1).points;
  // Two makes of one prism or of one cloud.
  const Subject one = quickly_built(prism ? corners : points), other = [&] {
    if (!prism) return quickly_built(shuffled);
    bodies::Polyhedron body = bodies::body_of(shapes::prism(6, 1, 1));
    std::rotate(body.corners.begin(), body.corners.begin() + 12, body.corners.end());
    return of_faces(body);
  }();
  const Subject b = quickly_built(ball_points(random, 6 + below(random, 20)));
  for (int i = 0; i < 8; ++i) {
    // The inverse is exact.
    Pose pose{cube_turn(random), random.on_sphere() * random.uniform(0.5, 3)};
    Pair pair(examiner, one, b, pose);
    const Answer answer = pair.ask();
    PairSeed cold;
    pair.agree(answer, Pair(examiner, other, b, pose).exact(cold), "another make of the same body");
    const Pose back{pose.rotation.transpose(), -(pose.rotation.transpose() * pose.translation)};
    Pair swapped(examiner, b, one, back);
    const Answer reverse = swapped.ask();
    swapped.agree(answer, reverse, "the pair swapped");
    examiner.hit(answer.verdict == Verdict::Disjoint);
  }
}

/// Polygons, segments and points, among themselves and against solids, on a lattice and slid into contact.
void flat(Examiner& examiner, std::uint64_t) {
  static const std::deque<Subject> subjects = [] {
    std::deque<Subject> all;
    for (const std::uint32_t sides : {3u, 4u, 5u, 12u}) all.push_back(built(shapes::polygon(sides).points));
    all.push_back(of_faces(bodies::two_sided({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})));
    all.push_back(built(shapes::segment(2).points));
    all.push_back(built({Vec3(-1, -1, -1), Vec3(1, 1, 1)}));
    all.push_back(built(shapes::point().points));
    all.push_back(built(shapes::cube().points));
    all.push_back(built(shapes::octahedron().points));
    all.push_back(built(shapes::sliver().points));
    return all;
  }();
  Random& random = examiner.random;
  PairSeed foreign;
  for (int i = 0; i < 30; ++i) {
    const Subject &a = subjects[below(random, 8)], &b = subjects[below(random, std::uint32_t(subjects.size()))];
    const bool turned = random.bits() % 2;
    const Subject &first = turned ? b : a, &second = turned ? a : b;
    Pose pose{random.bits() % 4 ? cube_turn(random) : random.rotation(), Vec3::Zero()};
    for (double& x : pose.translation) x = (double(below(random, 9)) - 4) / 2;
    if (random.bits() % 4 == 0) pose = slid(first, second, random.rotation(), random.on_sphere(), 0);
    Pair pair(examiner, first, second, pose);
    examiner.hit(pair.ask(foreign).verdict == Verdict::Touching);
  }
}

// ---- Levels, seeds, and anything --------------------------------------------------------------------------------------------

const std::deque<Subject>& with_levels() {
  static const std::deque<Subject> subjects = [] {
    std::deque<Subject> all;
    for (const shapes::Family family : shapes::kFamilies) {
      for (const std::uint32_t triangles : {300u, 800u}) {
        BuildOptions options;
        options.cutoff = triangles == 300 ? 12 : 60;
        options.method = triangles == 300 ? Method::Peel : Method::Collapse;
        all.push_back(built(shapes::ellipsoid(shapes::semi_axes(family), triangles, 7 + triangles).points, options));
      }
    }
    all.push_back(built(shapes::cube().points));
    return all;
  }();
  return subjects;
}

/// Every refinement order, start and plane rule, from features of any level; then looser answers from coarse levels.
void coarse_levels(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const auto& subjects = with_levels();
  for (int i = 0; i < 2; ++i) {
    const Subject &a = subjects[below(random, 6)], &b = subjects[below(random, std::uint32_t(subjects.size()))];
    Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.1, 4)};
    if (random.bits() % 4 == 0) pose = slid(a, b, pose.rotation, random.on_sphere(), sign(random) * decades(random, 2, 17));
    Pair pair(examiner, a, b, pose);
    pair.solve();
    const Answer cold = pair.ask();
    Options options;
    for (const StartPolicy start :
         {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest, StartPolicy::Table}) {
      for (const Refinement refinement : {Refinement::Single, Refinement::SingleSingle, Refinement::DoubleDouble}) {
        for (const PlaneRule rule : {PlaneRule::MostViolated, PlaneRule::FirstViolated}) {
          options.tuning.start = start;
          options.tuning.refinement = refinement;
          options.tuning.plane_rule = rule;
          PairSeed seed = some_seed(a, b, random);
          const Answer answer = pair.exact(seed, options);
          pair.agree(cold, answer, "another order of refinement");
          if (start == StartPolicy::Coarsest) examiner.hit(answer.levels_visited > 1);
        }
      }
    }
    options = {};
    options.tuning.start = StartPolicy::Coarsest;
    PairSeed warm;
    for (const double relative : {0.5, 0.1, 1e-2, 1e-4}) {
      options.relative = relative;
      const Answer answer = pair.loose(warm, options);
      pair.require(answer.upper - answer.lower <= std::max(relative * answer.lower, pair.law_two()), "wider than asked");
    }
    options.relative = 0;
    for (const int finest : {1, 2, 3}) {
      options.budget.finest_level = finest;
      pair.loose(warm, options);
      pair.coarse_depth(warm, options);
    }
    options.budget.finest_level = 0;
    options.budget.steps = below(random, 6);
    pair.loose(warm, options);
  }
}

/// Cold, warm, stale, foreign seeds and random bytes along a motion: the same answer.
void seeds(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const Subject cloud = quickly_built(ball_points(random, 10 + below(random, 40)));
  const auto& subjects = with_levels();
  const Subject &a = subjects[below(random, std::uint32_t(subjects.size()))],
                &b = random.bits() % 2 ? cloud : subjects[below(random, std::uint32_t(subjects.size()))];
  const shapes::Orbit orbit(random.bits(), random.uniform(0.5, 2.5), decades(random, -1.5, 1));
  static const Subject stranger = built(shapes::icosahedron().points);
  PairSeed warm, foreign, stale;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Pose pose = orbit.pose(i);
    Pair pair(examiner, a, b, pose);
    PairSeed cold;
    const Answer answer = pair.exact(cold), kept = pair.ask(warm);
    pair.agree(answer, kept, "a warm seed");
    PairSeed old = stale;
    pair.agree(answer, pair.exact(old), "a stale seed");
    if (i == 3) stale = cold;
    distance(stranger.model, b.model, pose, foreign);
    pair.agree(answer, pair.exact(foreign), "a foreign seed");
    PairSeed bytes = random_bytes(random);
    pair.agree(answer, pair.exact(bytes), "random bytes");
    if (i > 0) examiner.hit(kept.steps + kept.plane_tests < answer.steps + answer.plane_tests);
  }
}

/// Rotations that are orthonormal to 1e-6 only, reflections among them.
void stretched(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  for (int i = 0; i < 3; ++i) {
    const Subject a = quickly_built(ball_points(random, 6 + below(random, 24))),
                  b = quickly_built(ball_points(random, 6 + below(random, 24)));
    for (int k = 0; k < 6; ++k) {
      const double off = decades(random, 6.5, 15);
      Mat3 r = random.rotation();
      for (int column = 0; column < 3; ++column) r.col(column) += off * random.in_ball();
      if (random.bits() % 4 == 0) r.col(0) = -r.col(0);
      Pair pair(examiner, a, b, {r, random.on_sphere() * random.uniform(0.5, 3)});
      const Answer answer = pair.ask();
      examiner.hit(answer.verdict == Verdict::Disjoint);
    }
  }
}

/// Pairs of what `body` makes, so many poses each, the centres within a ball.
template <class Make>
void anywhere(Examiner& examiner, Make body, int poses, double radius) {
  for (int i = 0; i < 3; ++i) {
    const Subject a = body(), b = body();
    PairSeed warm;
    for (int k = 0; k < poses; ++k) {
      Pair pair(examiner, a, b, {examiner.random.rotation(), examiner.random.in_ball() * radius});
      examiner.hit(pair.ask(warm).verdict == Verdict::Disjoint);
    }
  }
}

/// Hulls of 4 to 40 points in a ball, some of float32 coordinates, anywhere from deep inside each other to apart.
void random_hulls(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const auto hull = [&] {
    std::vector<Vec3> points = ball_points(random, 4 + below(random, 37));
    if (random.bits() % 4 == 0)
      for (Vec3& p : points) p = p.cast<float>().cast<double>();
    return quickly_built(points);
  };
  anywhere(examiner, hull, 8, 2);
}

/// Turned cubes of many squares, whose triangles lie in one plane but for rounding, slivers among them; needles and plates to
/// 1e-12.
void slivers(Examiner& examiner, std::uint64_t) {
  Random& random = examiner.random;
  const auto body = [&] {
    std::vector<Vec3> points;
    if (random.bits() % 2) {
      const Mesh turned = shapes::moved(shapes::meshed_cube(2 + below(random, 4)), {random.rotation(), random.in_ball()});
      points = random.bits() % 4 == 0 ? shapes::float_rounded(turned).points : turned.points;
    } else {
      const Vec3 axes(1, random.bits() % 2 ? 1 : decades(random, 0, 12), decades(random, 0, 12));
      for (const Vec3& p : ball_points(random, 3 + below(random, 8))) points.push_back(p.cwiseProduct(axes));
    }
    return quickly_built(points);
  };
  anywhere(examiner, body, 6, 4);
}

constexpr Family kFamilies[] = {
    {"lattice of quarter turns", "G16 G18", "touching", 0.1, 0.3, 78, lattice_quarters},
    {"lattice of eighth turns", "G16 G18", "touching", 0.01, 0.3, 78, lattice_eighths},
    {"shaken lattice", "G18", "touching", 0.001, 0.2, 156, lattice_shaken, 32},
    {"every start", "G16 G18", "not disjoint", 0.3, 0.9, 48, every_start},
    {"degeneracy search", "G18", "a change of features between neighbouring doubles", 0.5, 1, 8, degeneracy_search},
    {"near parallel", "G18", "the parallel faces decide", 0.2, 0.9, 40, near_parallel},
    {"stacked prisms", "", "touching", 0.2, 0.9, 40, stacked_prisms},
    {"edge-edge angles", "G20", "two edges are nearest", 0.3, 1, 40, edge_edge_angles},
    {"plates and needles", "", "touching", 0.2, 0.9, 40, plates_and_needles},
    {"size ratio", "G25", "apart by less than a hundred small bodies", 0.2, 0.8, 40, size_ratio},
    {"far offsets", "G25", "overlapping", 0.15, 0.7, 40, far_offsets},
    {"powers of two", "G25", "scaled and disjoint", 0.3, 1, 40, powers_of_two},
    {"sweeps", "", "meets", 0.7, 1, 40, sweeps},
    {"kissing", "", "touching", 0.3, 1, 40, kissing},
    {"nested and coincident", "G16", "overlapping", 0.9, 1, 40, nested, 4},
    {"deep overlaps", "", "overlapping", 0.7, 1, 40, deep_overlaps},
    {"extra points", "", "all extra points dropped", 0.8, 1, 40, extra_points},
    {"same truth", "", "disjoint", 0.2, 0.9, 40, same_truth},
    {"flat bodies", "", "touching", 0.05, 0.6, 40, flat},
    {"coarse levels", "", "several levels visited", 0.5, 1, 40, coarse_levels},
    {"seeds", "", "warm is less work than cold", 0.2, 1, 40, seeds},
    {"stretched rotations", "", "disjoint", 0.2, 0.95, 40, stretched},
    {"random hulls", "", "disjoint", 0.3, 0.7, 40, random_hulls},
    {"slivers", "", "disjoint", 0.4, 0.97, 40, slivers},
    {"meshes", "", "touching", 0.2, 0.8, 4, mesh_pairs},
};

}  // namespace

std::span<const Family> families() { return kFamilies; }

Examiner run_batch(const Family& family, std::uint64_t seed, std::uint64_t index, std::uint64_t judge_every) {
  std::string label = family.name;
  std::uint64_t state = seed;
  for (char& c : label) {
    state = state * 1099511628211u + static_cast<unsigned char>(c);
    if (c == ' ') c = '_';
  }
  Examiner examiner(family.name, label + "-" + std::to_string(seed) + "-" + std::to_string(index),
                    Random(state).bits() + Random(index).bits(), judge_every);
  family.batch(examiner, index);
  return examiner;
}

Examiner ask_case(const Case& stored, std::uint64_t seed) {
  Examiner examiner(stored.family(), stored.name, seed);
  const Subject a = built(stored.a), b = built(stored.b);
  Pair pair(examiner, a, b, stored.b_in_a());
  const Answer cold = pair.ask();
  for (int i = 0; i < 200; ++i) {
    PairSeed some = some_seed(a, b, examiner.random);
    pair.agree(cold, pair.ask(some), "another start");
  }
  return examiner;
}

}  // namespace swiftlet::stability
