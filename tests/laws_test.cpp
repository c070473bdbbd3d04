// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The ten laws, each in its own words, on random, touching, nested, coplanar, needle, plate and flat pairs, with and without
// levels. Truth is the oracle's; every answer is also recomputed by `check`.
#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "answers.h"
#include "bodies.h"
#include "counted_allocations.h"
#include "make/surface.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The cases -------------------------------------------------------------------------------------------------------------

struct Subject {
  Mesh mesh;
  Model model;
};
Subject subject(const Mesh& mesh) { return {mesh, bodies::must(build(mesh)).model}; }

struct Case {
  const char* kind;
  const Subject* a;
  const Subject* b;
  Pose pose;
  oracle::Truth truth;

  const Model& model_a() const { return a->model; }
  const Model& model_b() const { return b->model; }
  double law_two() const { return bodies::law_two(a->model.level(0).view, b->model.level(0).view, pose); }
};

class Cases {
 public:
  Cases() {
    using namespace shapes;
    shapes::Random random(1);
    const auto keep = [this](const Mesh& mesh) { return &subjects_.emplace_back(subject(mesh)); };
    const Subject *fat = keep(ellipsoid({1, 1, 1}, 800, 1)), *fat2 = keep(ellipsoid({1, 1, 1}, 500, 2)),
                  *plate = keep(ellipsoid({1, 1, .1}, 600, 3));
    const Subject *plate2 = keep(ellipsoid({1, 1, .01}, 600, 4)), *rod = keep(ellipsoid({1, .1, .1}, 600, 5)),
                  *cloud = keep(random_polytope(40, 6));
    const Subject *box_ = keep(cube()), *octa = keep(octahedron()), *tetra = keep(tetrahedron()),
                  *column = keep(prism(6, 1, 1));
    const Subject *slim = keep(needle()), *thin = keep(sliver()), *small = keep(box({0.1, 0.2, 0.3}));
    const Subject* turned = keep(moved(cube(), {rotation(Vec3(1, 2, 3).normalized(), 1), Vec3(0.1, 0.2, 0.3)}));
    const Subject *square = keep(polygon(4)), *pentagon = keep(polygon(5)), *line = keep(segment(2)), *dot = keep(point());

    const auto any = [&](double reach) { return Pose{random.rotation(), random.on_sphere() * random.uniform(0, reach)}; };
    const auto shift = [](double x, double y, double z) { return Pose{Mat3::Identity(), Vec3(x, y, z)}; };
    for (int i = 0; i < 15; ++i) {
      for (const auto& [p, q] :
           {std::pair{fat, fat2}, {fat2, cloud}, {cloud, tetra}, {rod, fat2}, {box_, turned}, {column, octa}})
        add("random", p, q, any(4));
      for (const auto& [p, q] : {std::pair{plate, plate}, {plate, plate2}, {plate2, box_}, {plate2, thin}})
        add("plate", p, q, any(3));
      for (const auto& [p, q] : {std::pair{slim, slim}, {slim, box_}, {slim, rod}, {slim, fat2}}) add("needle", p, q, any(2.5));
      for (const auto& [p, q] :
           {std::pair{square, pentagon}, {pentagon, box_}, {line, line}, {line, fat2}, {dot, cloud}, {square, square}})
        add("flat", p, q, any(2.5));
      for (const auto& [p, q] : {std::pair{fat, small}, {small, fat}, {box_, small}, {plate, small}})
        add("nested", p, q, {random.rotation(), random.in_ball() * 0.1});
    }
    for (const auto& [p, q] : {std::pair{box_, box_},
                               {box_, column},
                               {turned, turned},
                               {octa, octa},
                               {square, square},
                               {square, box_},
                               {line, line}}) {
      for (const double x : {0.0, 0.3, 2.5})
        for (const double y : {0.0, 0.1, 0.5, -2.25}) add("coplanar", p, q, shift(x, y, 0));
    }
    for (const auto& [p, q] : {std::pair{box_, box_},
                               {box_, octa},
                               {octa, box_},
                               {octa, octa},
                               {tetra, tetra},
                               {box_, dot},
                               {square, box_},
                               {column, column}}) {
      for (const Vec3& t : {Vec3(2, 0, 0), Vec3(2, 0.25, -1), Vec3(2, 2, 0), Vec3(2, 2, 2), Vec3(1, 0, 0), Vec3(0, 0, 1),
                            Vec3(1, 1, 1), Vec3(0.5, 0.5, 0), Vec3(2 + 0x1p-51, 0.5, 0), Vec3(2 - 0x1p-51, 0.5, 0)}) {
        add("touching", p, q, shift(t.x(), t.y(), t.z()));
      }
    }
    // Contact between hierarchies: slid along the normal by the distance, which rounding leaves within an ulp of touching.
    for (int i = 0; i < 30; ++i) {
      const Pose p{random.rotation(), random.on_sphere() * 3};
      const oracle::Truth truth = oracle::distance(fat->mesh.points, plate->mesh.points, p);
      add("touching", fat, plate, {p.rotation, p.translation - truth.normal * truth.distance});
    }
  }
  auto begin() const { return cases_.begin(); }
  auto end() const { return cases_.end(); }
  std::size_t size() const { return cases_.size(); }
  const std::deque<Subject>& subjects() const { return subjects_; }

 private:
  void add(const char* kind, const Subject* a, const Subject* b, const Pose& pose) {
    cases_.push_back({kind, a, b, pose, oracle::distance(a->mesh.points, b->mesh.points, pose)});
  }
  std::deque<Subject> subjects_;
  std::vector<Case> cases_;
};
const Cases& cases() {
  static const Cases all;
  return all;
}

/// What the file saw, printed once.
struct Census : testing::Environment {
  long queries = 0, verdicts[4] = {0, 0, 0, 0}, not_converged = 0, undecided = 0;
  std::uint32_t steps = 0, plane_tests = 0;
  double widest = 0;

  void TearDown() override {
    if (queries == 0) return;
    std::printf(
        "laws: %ld queries; %ld undecided, %ld disjoint, %ld touching, %ld overlapping; %ld not converged, %ld thresholds "
        "undecided; "
        "at most %u steps, %u plane tests; widest exact interval %.1f u size\n",
        queries, verdicts[0], verdicts[1], verdicts[2], verdicts[3], not_converged, undecided, steps, plane_tests, widest);
  }
};
Census& census = *static_cast<Census*>(testing::AddGlobalTestEnvironment(new Census));

/// What every answer must be, whatever was asked: law 1, and what `check` recomputes.
void expect_true(const Case& c, const Answer& answer) {
  ++census.queries;
  ++census.verdicts[int(answer.verdict)];
  census.not_converged += answer.status == Status::NotConverged;
  census.steps = std::max(census.steps, answer.steps);
  census.plane_tests = std::max(census.plane_tests, answer.plane_tests);
  ASSERT_TRUE(oracle::holds(c.truth, answer.lower, answer.upper))
      << "[" << answer.lower << ", " << answer.upper << "] does not hold " << c.truth.distance;
  ASSERT_NE(answer.status, Status::NotConverged);
  ASSERT_TRUE(answer.verdict != Verdict::Overlapping || c.truth.overlapping);
  ASSERT_TRUE(answer.verdict != Verdict::Disjoint || !c.truth.overlapping);
  const Check checked = check(c.model_a(), c.model_b(), c.pose, answer);
  ASSERT_TRUE(checked) << checked.message;
}
void expect_law_two(const Case& c, const Answer& answer) {
  expect_true(c, answer);
  ASSERT_EQ(answer.status, Status::Converged);
  ASSERT_NE(answer.verdict, Verdict::Undecided);
  ASSERT_LE(answer.upper - answer.lower, c.law_two());
  ASSERT_EQ(answer.level_a, 0);
  ASSERT_EQ(answer.level_b, 0);
}

void for_each_case(const std::function<void(const Case&)>& test) {
  int number = 0;
  for (const Case& c : cases()) {
    test(c);
    if (testing::Test::HasFatalFailure()) {
      FAIL() << c.kind << ", case " << number << ": " << c.model_a().level(0).view.vertices.size() << " and "
             << c.model_b().level(0).view.vertices.size() << " vertices, distance " << c.truth.distance;
    }
    ++number;
  }
}

Answer exact(const Case& c, const Options& options = {}) {
  PairSeed seed;
  return distance(c.model_a(), c.model_b(), c.pose, seed, options);
}
PairSeed garbage_seed(shapes::Random& random) {
  PairSeed seed;
  const auto fill = [&random](auto& field) {
    const std::uint64_t bits = random.bits();
    std::memcpy(static_cast<void*>(&field), &bits, std::min(sizeof field, sizeof bits));
  };
  fill(seed.a), fill(seed.b), fill(seed.line_in_a), fill(seed.line_in_b), fill(seed.level_a), fill(seed.level_b);
  return seed;
}
FeatureId some_feature(const ConvexView& v, shapes::Random& random) {
  switch (random.bits() % 3) {
    case 0: return {FeatureKind::Vertex, std::uint32_t(random.bits() % v.vertices.size())};
    case 1:
      if (!v.half_edges.empty()) return {FeatureKind::Edge, std::uint32_t(random.bits() % v.half_edges.size())};
      [[fallthrough]];
    default:
      if (!v.face_first.empty()) return {FeatureKind::Face, std::uint32_t(random.bits() % v.face_first.size())};
  }
  return {FeatureKind::Vertex, 0};
}
/// Features that exist, on levels that exist.
PairSeed random_seed(const Model& a, const Model& b, shapes::Random& random) {
  PairSeed seed;
  seed.level_a = std::uint8_t(random.bits() % std::uint64_t(a.level_count()));
  seed.level_b = std::uint8_t(random.bits() % std::uint64_t(b.level_count()));
  seed.a = some_feature(a.level(seed.level_a).view, random);
  seed.b = some_feature(b.level(seed.level_b).view, random);
  return seed;
}
using answers::same_bits;
constexpr StartPolicy kPolicies[] = {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest,
                                     StartPolicy::Table};
constexpr Refinement kRefinements[] = {Refinement::Single, Refinement::SingleSingle, Refinement::DoubleDouble};
constexpr PlaneRule kRules[] = {PlaneRule::MostViolated, PlaneRule::FirstViolated};

TEST(Cases, AreOfEveryKindAndVerdict) {
  std::map<std::string, std::array<int, 2>> seen;
  int levels = 0, barely = 0;
  for (const Case& c : cases()) {
    ++seen[c.kind][c.truth.overlapping];
    levels = std::max(levels, c.model_a().level_count());
    barely += c.truth.distance > 0 && c.truth.distance <= c.law_two();
  }
  EXPECT_EQ(seen.size(), 7u);
  for (const auto& [kind, count] : seen) EXPECT_GE(count[0] + count[1], 50) << kind;
  for (const char* kind : {"random", "plate", "flat", "coplanar", "touching"})
    EXPECT_GE(std::min(seen[kind][0], seen[kind][1]), 5) << kind;
  EXPECT_GE(levels, 3);
  EXPECT_GE(barely, 2);
}

// ---- Law 1: lower <= true distance <= upper, always ------------------------------------------------------------------------

TEST(Law1, IntervalsHoldTheTruthWhenTheQueryConverges) {
  for_each_case([](const Case& c) { expect_true(c, exact(c)); });
}

TEST(Law1, IntervalsHoldTheTruthWhenAStepBudgetEndedTheMarch) {
  int ended = 0;
  for_each_case([&](const Case& c) {
    for (const std::uint32_t budget : {0u, 1u, 2u, 3u, 5u, 8u}) {
      Options options;
      options.budget.steps = budget;
      const Answer answer = exact(c, options);
      expect_true(c, answer);
      ended += answer.status == Status::Budget;
      ASSERT_LE(answer.steps, budget + 1);  // certified GJK counts as one
    }
  });
  EXPECT_GE(ended, 500);
}

TEST(Law1, IntervalsHoldTheTruthAtCoarseLevels) {
  int limited = 0;
  for_each_case([&](const Case& c) {
    for (int finest = 1; finest < 4; ++finest) {
      Options options;
      options.budget.finest_level = finest;
      const Answer answer = exact(c, options);
      expect_true(c, answer);
      limited += answer.status == Status::LevelLimit;
      ASSERT_GE(answer.level_a, std::min(finest, c.model_a().level_count() - 1));
    }
    // And on the way down: every record of the trace (trap G6).
    for (const Refinement refinement : kRefinements) {
      LevelRecord records[64];
      Options options;
      options.tuning.refinement = refinement;
      options.tuning.trace = records;
      const Answer answer = exact(c, options);
      ASSERT_LE(answer.levels_visited, 64);
      for (int i = 0; i < answer.levels_visited; ++i) {
        ASSERT_TRUE(oracle::holds(c.truth, records[i].lower, records[i].upper)) << i;
        if (i > 0) {  // bounds are carried down; a finer plane replaces one that is better by rounding only
          ASSERT_GE(records[i].lower, records[i - 1].lower - c.law_two() * 16);
          ASSERT_LE(records[i].upper, records[i - 1].upper);
        }
      }
    }
  });
  EXPECT_GE(limited, 100);
}

TEST(Law1, ABoundKeepsItsPlaneWhereAFinerPairOfLevelsOverlaps) {
  // Levels enclose the body, not each other: where a pair is hardly apart, a finer one may overlap.
  BuildOptions options;
  options.cutoff = 60;
  options.method = Method::Collapse;
  const Model a = bodies::must(build(shapes::ellipsoid({1, 1, 1}, 800, 1), options)).model,
              b = bodies::must(build(shapes::ellipsoid({1, 0.1, 0.1}, 800, 2), options)).model;
  shapes::Random random(5);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    Options question;
    question.budget.finest_level = 1 + i % 3;
    Pose pose{random.rotation(), 4 * random.on_sphere()};
    for (int k = 0; k < 2; ++k) {
      const Answer apart = distance(a, b, pose, question);
      pose.translation -= (apart.lower - 1e-5) * apart.normal;
    }
    OverlapProof proof;
    question.budget.finest_level = 1;
    question.tuning.start = StartPolicy::Coarsest;
    question.tuning.proof = &proof;
    for (const double radius : {0.0, 1e-7}) {
      const Answer answer = distance({a, radius}, {b, radius}, pose, question);
      const Check checked = check({a, radius}, {b, radius}, pose, answer, &proof);
      ASSERT_TRUE(checked) << checked.message;
      ASSERT_EQ(answer.lower > 0, !answer.normal.hasNaN()) << i;
      met += answer.lower > 0 && proof.count > 0;
    }
  }
  EXPECT_GE(met, 8);
}

TEST(Law1, IntervalsHoldTheTruthUnderEveryTolerance) {
  for_each_case([](const Case& c) {
    for (const auto& [absolute, relative] :
         {std::pair{0.3, 0.0}, {1e-3, 0.0}, {0.0, 0.5}, {0.0, 1e-2}, {0.0, 1e-6}, {0.1, 0.1}}) {
      Options options;
      options.absolute = absolute;
      options.relative = relative;
      const Answer answer = exact(c, options);
      expect_true(c, answer);
      ASSERT_EQ(answer.status, Status::Converged);
      ASSERT_LE(answer.upper - answer.lower, std::max({absolute, relative * answer.lower, c.law_two()}));
    }
  });
}

TEST(Law1, IntervalsHoldTheTruthWhenCutOff) {
  int cut = 0;
  for_each_case([&](const Case& c) {
    for (const double beyond : {0.0, c.truth.distance * 0.5, c.truth.distance, 1.0}) {
      Options options;
      options.beyond = beyond;
      const Answer answer = exact(c, options);
      expect_true(c, answer);
      ASSERT_EQ(answer.status == Status::Beyond, answer.lower > beyond);
      ASSERT_TRUE(answer.status == Status::Beyond || answer.upper - answer.lower <= c.law_two());
      cut += answer.status == Status::Beyond;
    }
    PairSeed seed;
    const Answer answer = intersects(c.model_a(), c.model_b(), c.pose, seed);
    expect_true(c, answer);
    ASSERT_EQ(answer.status, Status::Converged);
  });
  EXPECT_GE(cut, 300);
}

// ---- Law 2: every query converges; exact ones to 64 eps size ---------------------------------------------------------------

TEST(Law2, ExactIntervalsAreNarrowAndWitnessesLieOnBothBodies) {
  for_each_case([](const Case& c) {
    const Answer answer = exact(c);
    expect_law_two(c, answer);
    const double size = std::max(c.model_a().extent(), c.model_b().extent()) + c.pose.translation.norm();
    census.widest = std::max(census.widest, (answer.upper - answer.lower) / (0x1p-53 * size));
    if (answer.verdict == Verdict::Overlapping) return;
    const Vec3 p = answer.point_a, q = answer.point_b;
    ASSERT_LE(oracle::distance({&p, 1}, c.a->mesh.points, {}).distance, c.law_two());
    ASSERT_LE(oracle::distance({&q, 1}, c.b->mesh.points, c.pose).distance, c.law_two());
    ASSERT_LE(((q - p) - (q - p).norm() * answer.normal).norm(), c.law_two())
        << "the points differ by their distance times the normal (trap G13)";
  });
}

TEST(Law2, PointsOfAnOverlapLieInBothBodies) {
  // In doubles the point that four vertex pairs share lies off a small body by much of its size.
  std::deque<Subject> large, small;
  for (const Mesh& mesh : {shapes::cube(), shapes::octahedron(), shapes::random_polytope(30, 2)}) {
    large.push_back(subject(mesh));
    small.push_back(subject(shapes::moved(mesh, {1e-4 * Mat3::Identity(), {0, 0, 0}})));
  }
  shapes::Random random(12);
  int overlapping = 0;
  for (int i = 0; i < 800; ++i) {
    const Subject &a = large[random.bits() % large.size()], &b = small[random.bits() % small.size()];
    Pose pose{i % 3 ? random.rotation() : Mat3(Mat3::Identity()), 3 * random.on_sphere()};
    PairSeed seed;
    const Answer apart = distance(a.model, b.model, pose, seed);
    pose.translation -= apart.point_b - apart.point_a + std::pow(10, -double(4 + i % 10)) * apart.normal;
    const double bound = bodies::law_two(a.model.level(0).view, b.model.level(0).view, pose);
    seed = {};
    for (const Answer& answer :
         {within(a.model, b.model, pose, 0, seed).answer, closest_features(a.model, b.model, pose, seed).answer,
          intersects(a.model, b.model, pose, seed)}) {
      if (answer.verdict != Verdict::Overlapping) continue;
      ++overlapping;
      std::vector<Vec3> points{answer.point_a};
      if (answer.point_b != answer.point_a) points.push_back(answer.point_b);
      for (const Vec3& p : points) {
        ASSERT_FALSE(p.hasNaN()) << "not wrong, but never seen: look";
        ASSERT_TRUE(oracle::holds(oracle::distance({&p, 1}, a.mesh.points, {}), 0, bound)) << i;
        ASSERT_TRUE(oracle::holds(oracle::distance({&p, 1}, b.mesh.points, pose), 0, bound)) << i;
      }
    }
  }
  EXPECT_GE(overlapping, 1000);
}

TEST(Law2, SlightlyStretchedRotationsKeepTheirOwnBound) {
  shapes::Random random(2);
  for (const double off : {1e-15, 1e-12, 1e-9, 4e-7}) {
    for (int i = 0; i < 40; ++i) {
      const Subject &a = cases().subjects()[0], &b = cases().subjects()[2];
      Mat3 r = random.rotation();
      for (int k = 0; k < 3; ++k) r.col(k) += off * random.in_ball();
      if ((r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff() > 0.99e-6) continue;
      const Pose pose{r, random.on_sphere() * random.uniform(0.5, 3)};
      const Case c{"stretched", &a, &b, pose, oracle::distance(a.mesh.points, b.mesh.points, pose)};
      expect_law_two(c, exact(c));
      for (int finest : {1, 2}) {
        Options options;
        options.budget.finest_level = finest;
        expect_true(c, exact(c, options));
      }
      if (HasFatalFailure()) FAIL() << off << ' ' << i;
    }
  }
}

TEST(Law2, EveryKindOfFeaturePairHasItsNormal) {  // trap G13
  shapes::Random random(3);
  std::map<std::pair<FeatureKind, FeatureKind>, int> seen;
  const Model small = bodies::model(bodies::cube()), other = bodies::model(bodies::octahedron());
  for (int i = 0; i < 3000; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(2, 4)};
    PairSeed seed;
    const Answer answer = distance(small, other, pose, seed);
    if (answer.verdict != Verdict::Disjoint || answer.lower < 1e-9) continue;
    ++seen[{answer.feature_a.kind(), answer.feature_b.kind()}];
    const Vec3 d = answer.point_b - answer.point_a;
    ASSERT_LE((d.normalized() - answer.normal).norm(),
              1e-9 + bodies::law_two(small.level(0).view, other.level(0).view, pose) / answer.lower)
        << i;
  }
  using enum FeatureKind;
  for (const auto& kinds :
       {std::pair{Vertex, Vertex}, {Vertex, Edge}, {Edge, Vertex}, {Vertex, Face}, {Face, Vertex}, {Edge, Edge}})
    EXPECT_GE(seen[kinds], 20);
}

TEST(Law2, ClosestFeaturesLieOnTheExactHulls) {  // trap G12
  int coarse_start = 0;
  for_each_case([&](const Case& c) {
    const ClosestOptions options{.tuning = {.start = StartPolicy::Coarsest}};
    const ClosestFeatures nearest = closest_features(c.model_a(), c.model_b(), c.pose, options);
    expect_law_two(c, nearest.answer);
    coarse_start += nearest.answer.levels_visited > 1;
    if (nearest.answer.verdict == Verdict::Overlapping) return;
    const double radius = c.model_a().radius() + c.model_b().radius();
    const Vec3 p = nearest.answer.point_a, q = nearest.answer.point_b;
    ASSERT_LE(oracle::distance({&p, 1}, c.a->mesh.points, {}).distance, 1e-12 * radius);
    ASSERT_LE(oracle::distance({&q, 1}, c.b->mesh.points, c.pose).distance, 1e-12 * radius);
    ASSERT_NEAR((p - q).norm(), c.truth.distance, c.law_two());
    ASSERT_EQ(nearest.source_a.kind, nearest.answer.feature_a.kind());
  });
  EXPECT_GE(coarse_start, 100);
}

// ---- Law 3: a seed changes the work, never the truth -----------------------------------------------------------------------

void expect_agreement(const Case& c, const Answer& one, const Answer& other) {
  expect_law_two(c, other);
  ASSERT_EQ(one.verdict, other.verdict);
  ASSERT_LE(std::fabs(one.lower - other.lower), c.law_two());
  ASSERT_LE(std::fabs(one.upper - other.upper), c.law_two());
}

TEST(Law3, ColdWarmStaleAndGarbageSeedsGiveTheSameAnswer) {
  shapes::Random random(4);
  PairSeed stale;  // of whatever pair came before
  for_each_case([&](const Case& c) {
    PairSeed seed;
    const Answer cold = distance(c.model_a(), c.model_b(), c.pose, seed);
    const Answer warm = distance(c.model_a(), c.model_b(), c.pose, seed);
    expect_agreement(c, cold, warm);
    expect_agreement(c, cold, distance(c.model_a(), c.model_b(), c.pose, stale));
    for (int i = 0; i < 4; ++i) {
      PairSeed any = garbage_seed(random);
      expect_agreement(c, cold, distance(c.model_a(), c.model_b(), c.pose, any));
    }
  });
}

/// Traps G10 and G11: refinement from every state kind, by every order, from features of any level, against cold at the finest.
/// Of every third case, so that each kind has its turn.
TEST(Law3, EveryPolicyOrderAndRuleGivesTheSameAnswer) {
  shapes::Random random(5);
  int number = 0;
  for_each_case([&](const Case& c) {
    if (number++ % 3 > 0) return;
    Options plain;
    plain.tuning.start = StartPolicy::Finest;
    const Answer cold = exact(c, plain);
    expect_law_two(c, cold);
    for (const StartPolicy policy : kPolicies) {
      for (const Refinement refinement : kRefinements) {
        for (const PlaneRule rule : kRules) {
          Options options;
          options.tuning.start = policy;
          options.tuning.refinement = refinement;
          options.tuning.plane_rule = rule;
          PairSeed seed = random_seed(c.model_a(), c.model_b(), random);
          expect_agreement(c, cold, distance(c.model_a(), c.model_b(), c.pose, seed, options));
          expect_agreement(c, cold, distance(c.model_a(), c.model_b(), c.pose, seed, options));  // with what it left
        }
      }
    }
  });
}

TEST(Law3, SameSeedSameBits) {
  shapes::Random random(6);
  for_each_case([&](const Case& c) {
    const PairSeed seed = random_seed(c.model_a(), c.model_b(), random);
    for (const StartPolicy policy : kPolicies) {
      Options options;
      options.tuning.start = policy;
      PairSeed one = seed, two = seed;
      const Answer first = distance(c.model_a(), c.model_b(), c.pose, one, options),
                   second = distance(c.model_a(), c.model_b(), c.pose, two, options);
      ASSERT_TRUE(same_bits(first, second));
      ASSERT_TRUE(one.a == two.a && one.b == two.b && one.level_a == two.level_a && one.level_b == two.level_b);
    }
  });
}

TEST(Law3, SeedsAreSmallAndTrivial) { static_assert(std::is_trivially_copyable_v<PairSeed> && sizeof(PairSeed) <= 64); }

TEST(Law3, TableStartsFromAnyDirection) {  // trap G21
  const Model centred = bodies::must(build(shapes::ellipsoid({1, 1, 1}, 400, 9))).model;
  const Model aside =
      bodies::must(build(shapes::moved(shapes::ellipsoid({1, .5, .2}, 400, 10), {Mat3::Identity(), {50, -7, 3}}))).model;
  Options options;
  options.tuning.start = StartPolicy::Table;
  for (const lut::Resolution resolution :
       {lut::Resolution::None, lut::Resolution::Degrees22, lut::Resolution::Degrees11, lut::Resolution::Degrees5}) {
    const Model a = centred.with_table({resolution, 2}).value(), b = aside.with_table({resolution, 2}).value();
    const auto agree = [&](const Pose& pose) {
      PairSeed seed, plain;
      const Answer by_table = distance(a, b, pose, seed, options), cold = distance(a, b, pose, plain);
      ASSERT_EQ(by_table.verdict, cold.verdict);
      ASSERT_NEAR(by_table.lower, cold.lower, bodies::law_two(a.level(0).view, b.level(0).view, pose));
      ASSERT_EQ(by_table.levels_visited, 1);
    };
    agree({Mat3::Identity(), a.centre() - b.centre()});  // coincident centres
    for (std::uint32_t i = 0; i < lut::sample_count(resolution); i += 3) {
      const auto d = lut::sample(resolution, i);
      for (const double ulp : {-1.0, 0.0, 1.0}) {
        const Vec3 t = 2.5 * (1 + ulp * 0x1p-52) * Vec3(d[0], d[1], d[2]);
        agree({Mat3::Identity(), a.centre() - b.centre() + t});
        if (HasFatalFailure()) FAIL() << i;
      }
    }
  }
}

// ---- Law 4: swapping negates the normal and swaps the points ---------------------------------------------------------------

TEST(Law4, SwappingTheBodiesSwapsTheAnswer) {
  for_each_case([](const Case& c) {
    const Answer there = exact(c);
    const Pose a_in_b = inverse(c.pose);
    PairSeed seed;
    const Answer back = distance(c.model_b(), c.model_a(), a_in_b, seed);
    const double slack = c.law_two();
    ASSERT_NEAR(there.lower, back.lower, slack);
    ASSERT_NEAR(there.upper, back.upper, slack);
    // Within rounding of contact the inverse pose is another pose.
    ASSERT_TRUE(there.verdict == back.verdict || there.verdict == Verdict::Touching || back.verdict == Verdict::Touching);
    if (there.verdict != Verdict::Disjoint || there.lower < 1e3 * slack) return;
    // Unit n with n.w >= d - s, |w| = d, is within sqrt(2 s / d) of w / d: twice, and the inverse's rounding.
    const double angle = 2 * std::sqrt(2 * slack / there.lower);
    ASSERT_LE((there.normal + c.pose.rotation * back.normal).norm(), angle);
    const Vec3 p = c.pose.rotation * back.point_b + c.pose.translation, q = c.pose.rotation * back.point_a + c.pose.translation;
    ASSERT_LE(((there.point_b - there.point_a) - (q - p)).norm(), angle * there.lower + 2 * slack);
    if (std::string(c.kind) != "random" && std::string(c.kind) != "needle")
      return;  // elsewhere the nearest pair need not be unique
    ASSERT_LE((p - there.point_a).norm(), 1e-6);
    ASSERT_LE((q - there.point_b).norm(), 1e-6);
  });
}

// ---- Law 5: only the relative pose enters ----------------------------------------------------------------------------------

TEST(Law5, ExactCommonTranslationsChangeNoBit) {
  shapes::Random random(7);
  for_each_case([&](const Case& c) {
    const auto grid = [](const Vec3& t) { return Vec3((t * 0x1p20).array().round() * 0x1p-20); };
    const Pose a{random.rotation(), grid(random.in_ball())}, b{random.rotation(), grid(random.in_ball() + c.pose.translation)};
    PairSeed seed;
    const Answer here = distance(c.model_a(), c.model_b(), relative(a, b), seed);
    for (const double far : {1.0, 0x1p10, 0x1p30}) {
      const Vec3 shift = grid(random.in_ball()) * far;
      seed = {};
      ASSERT_TRUE(
          same_bits(here, distance(c.model_a(), c.model_b(),
                                   relative({a.rotation, a.translation + shift}, {b.rotation, b.translation + shift}), seed)));
    }
  });
}

TEST(Law5, AfterCommonMotionsTheIntervalHoldsTheTruth) {
  shapes::Random random(8);
  for_each_case([&](const Case& c) {
    const Pose motion{random.rotation(), random.in_ball() * 10};
    const Pose b{motion.rotation * c.pose.rotation, motion.rotation * c.pose.translation + motion.translation};
    const Pose again = relative(motion, b);
    Case moved = c;
    moved.pose = again;
    moved.truth = oracle::distance(c.a->mesh.points, c.b->mesh.points, again);
    expect_law_two(moved, exact(moved));
    // The composition in doubles lost no more than a few ulps of what entered it.
    ASSERT_NEAR(moved.truth.distance, c.truth.distance, 64 * 0x1p-53 * (10 + c.pose.translation.norm() + 2));
  });
}

TEST(Law5, RelativeInvertsTheRotationOfA) {
  shapes::Random random(9);
  for (int i = 0; i < 200; ++i) {
    Mat3 r = random.rotation();
    for (int k = 0; k < 3; ++k) r.col(k) += 2e-7 * random.in_ball();
    const Pose a{r, random.in_ball()}, b{random.rotation(), random.in_ball()}, b_in_a = relative(a, b);
    EXPECT_LE((a.rotation * b_in_a.rotation - b.rotation).norm(), 1e-15);
    EXPECT_LE((a.rotation * b_in_a.translation + a.translation - b.translation).norm(), 2e-15);
    const Pose back = inverse(a);
    EXPECT_LE((back.rotation * a.rotation - Mat3::Identity()).norm(), 2e-15);
    EXPECT_LE((back.rotation * a.translation + back.translation).norm(), 2e-15);
  }
}

TEST(Law5, ScalingByAPowerOfTwoScalesTheAnswerBitForBit) {
  for (const int k : {-60, -1, 1, 55}) {
    const double s = std::ldexp(1, k);
    std::map<const Subject*, Model> scaled;
    for (const Subject& subject : cases().subjects()) {
      Mesh mesh = subject.mesh;
      for (Vec3& p : mesh.points) p *= s;
      scaled.emplace(&subject, bodies::must(build(mesh)).model);
    }
    for_each_case([&](const Case& c) {
      Answer plain = exact(c);
      PairSeed seed;
      const Answer answer = distance(scaled.at(c.a), scaled.at(c.b), {c.pose.rotation, s * c.pose.translation}, seed);
      plain.lower *= s, plain.upper *= s, plain.point_a *= s, plain.point_b *= s;
      ASSERT_TRUE(same_bits(plain, answer))
          << k << ": " << plain.lower << ' ' << answer.lower << ", " << plain.steps << ' ' << answer.steps;
    });
  }
}

// ---- Law 6: every level encloses P0 ----------------------------------------------------------------------------------------

void expect_enclosing(const Model& model, std::span<const Vec3> points) {
  for (int i = 0; i < model.level_count(); ++i) {
    const ConvexView& v = model.level(i).view;
    std::vector<oracle::Triangle> planes;
    each_facet(v, [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) { planes.push_back({p, q, r}); });
    ASSERT_TRUE(oracle::encloses(bodies::points_of(v), planes, points)) << "level " << i;
    ASSERT_TRUE(oracle::encloses(bodies::points_of(v), planes, bodies::points_of(v))) << "level " << i << " is not convex";
  }
}

TEST(Law6, EveryLevelEnclosesTheInputAfterBuildAndAfterLoad) {
  int levels = 0;
  const Mesh round = shapes::ellipsoid({1, .8, .6}, 1000, 21);
  Mesh large = round, small = round;
  for (Vec3& p : large.points) p *= 1e15;
  for (Vec3& p : small.points) p *= 1e-15;
  const Mesh far = shapes::moved(round, {shapes::rotation(Vec3(0, 0.6, 0.8), 2), {1e4, -3e4, 2e4}});
  for (const Mesh& mesh : {round, far, shapes::float_rounded(round), large, small, shapes::ellipsoid({1, 1, .01}, 1000, 22),
                           shapes::ellipsoid({1, .02, .01}, 1000, 23)}) {
    for (const Method method : {Method::Collapse, Method::Peel}) {
      BuildOptions options;
      options.method = method;
      const Model model = bodies::must(build(mesh, options)).model;
      expect_enclosing(model, mesh.points);
      expect_enclosing(bodies::must(load(model.bytes())), mesh.points);
      const Check verified = verify(model);
      ASSERT_TRUE(verified) << verified.message;
      levels += model.level_count();
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GE(levels, 14 * 2);
}

// ---- Law 7: every query ends within a documented function of the feature counts --------------------------------------------

/// Trap G18: all translations by halves, with all rotations by right angles about the axes. The truth has a closed form.
TEST(Law7, TheCubeLatticeEnds) {
  const Model cube = bodies::model(bodies::cube());
  shapes::Random random(10);
  const Mat3 about_z = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(),
             about_x = (Mat3() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished();
  const Mat3 turns[] = {Mat3::Identity(), about_z, about_x, about_z * about_z, about_x * about_x, about_z * about_x};
  std::uint32_t steps = 0, plane_tests = 0;
  int verdicts[4] = {0, 0, 0, 0};
  PairSeed warm;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) {
      for (int z = -6; z <= 6; ++z) {
        for (const Mat3& turn : turns) {
          const Pose pose{turn, Vec3(x, y, z) / 2};
          const Vec3 beyond = (pose.translation.cwiseAbs().array() - 2).max(0);
          const double truth = beyond.norm(), inside = pose.translation.cwiseAbs().maxCoeff();
          const Verdict expected = truth > 0 ? Verdict::Disjoint : inside == 2 ? Verdict::Touching : Verdict::Overlapping;
          PairSeed any = random_seed(cube, cube, random), cold;
          for (PairSeed* seed : {&cold, &warm, &any}) {
            const Answer answer = distance(cube, cube, pose, *seed);
            ASSERT_EQ(answer.verdict, expected) << pose.translation.transpose();
            ASSERT_LE(answer.lower, truth * (1 + 1e-15));
            ASSERT_GE(answer.upper, truth * (1 - 1e-15));
            ASSERT_EQ(answer.status, Status::Converged);
            steps = std::max(steps, answer.steps);
            plane_tests = std::max(plane_tests, answer.plane_tests);
            ++verdicts[int(answer.verdict)];
          }
        }
      }
    }
  }
  EXPECT_LE(steps, 8u + 24u);  // far below the bound of march_test.cpp, which is for the worst imaginable
  EXPECT_LE(plane_tests, 2000u);
  for (int v = 1; v < 4; ++v) EXPECT_GE(verdicts[v], 1000);
  std::printf("cube lattice: at most %u steps, %u plane tests\n", steps, plane_tests);
}

TEST(Law7, NearlyDegenerateLatticesEnd) {
  const Model quads = bodies::model(bodies::cube()),
              folded = bodies::model(bodies::moved(bodies::cube(), bodies::rotation(1, 2, 3, 4)));
  const Mat3 home = bodies::rotation(1, -2, -3, -4);  // turns `folded` back to the axes, nearly
  shapes::Random random(11);
  std::uint32_t steps = 0, plane_tests = 0;
  for (int i = 0; i < 20000; ++i) {
    const double shake = std::pow(10, -random.uniform(4, 17));
    Vec3 t;
    for (double& x : t) x = std::floor(random.uniform(-6, 7)) / 2 + shake * random.uniform(-1, 1);
    const Model& b = i % 2 ? folded : quads;
    const Pose pose{i % 2 ? home : Mat3(shapes::rotation(random.on_sphere(), shake)), t};
    PairSeed seed = random_seed(quads, b, random);
    const Answer answer = distance(quads, b, pose, seed);
    ASSERT_EQ(answer.status, Status::Converged) << i;
    ASSERT_LE(answer.upper - answer.lower, bodies::law_two(quads.level(0).view, b.level(0).view, pose)) << i;
    if (i % 10 == 0) {
      const Check checked = check(quads, b, pose, answer, Question::Exact);
      ASSERT_TRUE(checked) << i << ": " << checked.message;
    }
    steps = std::max(steps, answer.steps);
    plane_tests = std::max(plane_tests, answer.plane_tests);
  }
  EXPECT_LE(steps, 2 * (8u + 24u));  // near contact the cold way is walked as well
  EXPECT_LE(plane_tests, 3000u);
  std::printf("shaken lattice: at most %u steps, %u plane tests\n", steps, plane_tests);
}

TEST(Law7, EveryFiniteTranslationEnds) {
  const Model cube = bodies::model(bodies::cube()), ball = bodies::must(build(shapes::ellipsoid({1, 1, 1}, 200, 30))).model;
  shapes::Random random(12);
  int invalid = 0, coincident = 0;
  for (int exponent = -1074; exponent <= 1023; exponent += 7) {
    for (int i = 0; i < 4; ++i) {
      Vec3 t = random.on_sphere();
      if (i == 0) t = Vec3(1, 1, 0);
      for (double& x : t) x = std::ldexp(x, exponent);
      for (const auto& [a, b] : {std::pair{&cube, &cube}, {&cube, &ball}, {&ball, &ball}}) {
        PairSeed seed;
        const Answer answer = distance(*a, *b, {i < 2 ? Mat3(Mat3::Identity()) : random.rotation(), t}, seed);
        if (answer.status == Status::InvalidPose) {
          ASSERT_EQ(answer.upper, kInfinity);
          ASSERT_GT(t.norm(), 1e44);
          ++invalid;
          continue;
        }
        ASSERT_EQ(answer.status, Status::Converged) << exponent;
        ASSERT_LE(answer.lower, t.norm());
        ASSERT_GE(answer.upper, t.norm() * (1 - 1e-15) - 4);
        coincident += answer.verdict == Verdict::Overlapping;
      }
    }
  }
  EXPECT_GE(invalid, 500);
  EXPECT_GE(coincident, 1500);
}

// ---- Law 8: queries allocate nothing and may run concurrently --------------------------------------------------------------

TEST(Law8, QueriesAllocateNothing) {
  LevelRecord records[8];
  ASSERT_TRUE(allocations_are_counted());
  for (const Case& c : cases()) {
    PairSeed seed;
    Options options;
    options.tuning.trace = records;
    const long before = allocations;
    distance(c.model_a(), c.model_b(), c.pose, seed, options);
    const Answer loose = distance(c.model_a(), c.model_b(), c.pose, seed, {.relative = 0.1});
    refine(c.model_a(), c.model_b(), c.pose, loose, seed);
    intersects(c.model_a(), c.model_b(), c.pose, seed);
    within(c.model_a(), c.model_b(), c.pose, 0.1, seed);
    closest_features(c.model_a(), c.model_b(), c.pose, seed);
    const Answer deep = signed_distance(c.model_a(), c.model_b(), c.pose, seed);
    signed_distance(c.model_a(), c.model_b(), c.pose);
    signed_within(c.model_a(), c.model_b(), c.pose, -0.1, seed);
    manifold(c.model_a(), c.model_b(), c.pose, deep, {.margin = 1});
    march(c.model_a().level(0).view, c.model_b().level(0).view, c.pose);
    const long after = allocations;
    ASSERT_EQ(after, before);
  }
}

TEST(Law8, SharedModelsAnswerAllThreadsAlike) {  // trap G23
  std::vector<Answer> serial;
  std::vector<std::uint64_t> hashes;
  for (const Case& c : cases()) serial.push_back(exact(c));
  for (const Subject& s : cases().subjects()) hashes.push_back(s.model.hash());
  std::atomic<int> different{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < serial.size(); ++i) {
        const std::size_t k = (i * 7 + t * 31) % serial.size();
        if (!same_bits(serial[k], exact(*(cases().begin() + std::ptrdiff_t(k))))) ++different;
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(different, 0);
  for (std::size_t i = 0; i < hashes.size(); ++i) EXPECT_EQ(cases().subjects()[i].model.hash(), hashes[i]);
}

// ---- Law 9: misses are visible ---------------------------------------------------------------------------------------------

TEST(Law9, TouchingIsAnsweredOnlyWithinLawTwoOfContact) {  // trap G17
  int touching = 0, near_contact = 0;
  for_each_case([&](const Case& c) {
    const Answer answer = exact(c);
    near_contact += std::string(c.kind) == "touching";
    if (answer.verdict != Verdict::Touching) return;
    ++touching;
    ASSERT_LE(c.truth.distance, c.law_two());
    ASSERT_NEAR(answer.normal.norm(), 1, 1e-15);
    // Where they overlap, it is by no more than the bound along the normal.
    ASSERT_GE(oracle::gap(c.a->mesh.points, c.b->mesh.points, c.pose, answer.normal).upper, -c.law_two());
  });
  EXPECT_GE(touching, 60);
  std::printf("touching: %d of %zu cases, %d of them made to touch\n", touching, cases().size(), near_contact);
}

TEST(Law9, MovingApartAlongTheNormalFlipsTheVerdict) {
  int flipped = 0;
  for_each_case([&](const Case& c) {
    const Answer answer = exact(c);
    if (answer.verdict != Verdict::Disjoint && answer.verdict != Verdict::Touching) return;
    const double epsilon = 4 * c.law_two();
    Case apart = c, into = c;
    apart.pose.translation += (epsilon - c.truth.distance) * answer.normal;
    into.pose.translation -= (epsilon + c.truth.distance) * answer.normal;
    const Verdict out = exact(apart).verdict, in = exact(into).verdict;
    ASSERT_EQ(out, Verdict::Disjoint);
    ASSERT_NE(in, Verdict::Undecided);
    // Into a face, or crossing edges: a step against the normal leads inside. From a sharp corner it may lead past the other
    // body.
    const FeatureKind kind_a = answer.feature_a.kind(), kind_b = answer.feature_b.kind();
    const bool faces = kind_a == FeatureKind::Face || kind_b == FeatureKind::Face ||
                       (kind_a == FeatureKind::Edge && kind_b == FeatureKind::Edge);
    if (answer.verdict == Verdict::Disjoint && faces && c.model_a().dimension() == 3 && c.model_b().dimension() == 3) {
      ASSERT_EQ(in, Verdict::Overlapping);
      ++flipped;
    }
  });
  EXPECT_GE(flipped, 60);
}

TEST(Law9, ThresholdsAreUndecidedOnlyWithinLawTwo) {
  int yes = 0, no = 0;
  for_each_case([&](const Case& c) {
    const double d = c.truth.distance, bound = c.law_two();
    for (const double threshold :
         {0.0, 0.5 * d, d - 2 * bound, d - bound / 8, d, d + bound / 8, d + 2 * bound, 2 * d, 1.0, kInfinity}) {
      if (threshold < 0) continue;
      PairSeed seed;
      const Within result = within(c.model_a(), c.model_b(), c.pose, threshold, seed);
      expect_true(c, result.answer);
      ASSERT_EQ(result.answer.status, Status::Converged) << threshold;
      const bool truth = oracle::holds(c.truth, 0, threshold);
      if (result.decision == Decision::Undecided) {
        ++census.undecided;
        ASSERT_LE(std::fabs(threshold - d), bound);
      } else {
        ASSERT_EQ(result.decision == Decision::Yes, truth) << threshold << " against " << d;
        ++(truth ? yes : no);
      }
    }
  });
  EXPECT_GE(yes, 1000);
  EXPECT_GE(no, 500);
}

TEST(Law9, ImpossibleDemandsAreSaidSo) {
  const Case& c = *cases().begin();
  Pose pose = c.pose;
  pose.rotation(0, 0) = std::nan("");
  PairSeed seed;
  const Answer invalid = distance(c.model_a(), c.model_b(), pose, seed);
  EXPECT_EQ(invalid.status, Status::InvalidPose);
  EXPECT_EQ(invalid.verdict, Verdict::Undecided);
  EXPECT_EQ(invalid.lower, 0);
  EXPECT_EQ(invalid.upper, kInfinity);
  EXPECT_EQ(within(c.model_a(), c.model_b(), pose, 1, seed).decision, Decision::Undecided);
  Options coarse;
  coarse.budget.finest_level = c.model_a().level_count() - 1;
  const Answer limited = exact(c, coarse);
  EXPECT_EQ(limited.status, Status::LevelLimit);
  EXPECT_GT(limited.upper - limited.lower, c.law_two());
}

// ---- Law 10: a looser tolerance never costs more ---------------------------------------------------------------------------

struct Cost {
  std::uint32_t work;
  int level_a, level_b;
};
/// The work from a copy of `seed`, and the levels that answered.
Cost cost(const Model& a, const Model& b, const Pose& pose, PairSeed seed, double relative) {
  Options options;
  options.relative = relative;
  const Answer answer = distance(a, b, pose, seed, options);
  return {answer.steps + answer.plane_tests, answer.level_a, answer.level_b};
}

class Law10 : public testing::TestWithParam<shapes::Family> {
 protected:
  Law10()
      : meshes_(shapes::pair(GetParam(), 2000)),
        a_(bodies::must(build(meshes_.a)).model),
        b_(bodies::must(build(meshes_.b)).model) {}
  static constexpr double kTolerances[] = {0, 1e-4, 1e-3, 1e-2, 1e-1};
  static constexpr int kPoses = 300;
  shapes::Pair meshes_;
  Model a_, b_;
};

/// Strictly less where something coarser than level 0 can answer: at 2 000 triangles maps and levels are good to some 1e-3.
TEST_P(Law10, EachDecadeLooserCostsStrictlyLessOverAColdOrbit) {
  constexpr std::size_t kFirstServed = 3;  // 1e-2
  const shapes::Orbit orbit(50 + std::uint64_t(GetParam()), 2, 10.377);
  std::uint64_t totals[5] = {0, 0, 0, 0, 0};
  int coarsest[5] = {0, 0, 0, 0, 0};
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    Cost before{~0u, 0, 0};
    for (std::size_t t = 0; t < 5; ++t) {
      const Cost now = cost(a_, b_, orbit.pose(i), {}, kTolerances[t]);
      ASSERT_LE(now.work, before.work) << "pose " << i << ", tolerance " << kTolerances[t];
      ASSERT_GE(now.level_a, before.level_a);
      ASSERT_GE(now.level_b, before.level_b);
      totals[t] += now.work;
      coarsest[t] += now.level_a == a_.level_count() - 1 && now.level_b == b_.level_count() - 1;
      before = now;
    }
  }
  for (std::size_t t = 1; t < 5; ++t) {
    EXPECT_TRUE(totals[t] < totals[t - 1] || coarsest[t - 1] == kPoses || t < kFirstServed)
        << kTolerances[t] << ": " << totals[t - 1] << " then " << totals[t];
  }
  std::printf("%s: work at tolerance 0, 1e-4, 1e-3, 1e-2, 1e-1: %.0f %.0f %.0f %.0f %.0f\n", shapes::name(GetParam()),
              double(totals[0]) / kPoses, double(totals[1]) / kPoses, double(totals[2]) / kPoses, double(totals[3]) / kPoses,
              double(totals[4]) / kPoses);
}

TEST_P(Law10, FromTheSameSeedALooserToleranceNeverCostsMore) {
  for (const double step : {0.5, 5.0, 80.377}) {
    for (const double kept : {0.0, 1e-3, 1e-1}) {  // what the chain of seeds was made for
      const shapes::Orbit orbit(60, 2, step);
      PairSeed seed;
      for (std::uint64_t i = 0; i < kPoses; ++i) {
        Cost before{~0u, 0, 0};
        for (const double tolerance : kTolerances) {
          const Cost now = cost(a_, b_, orbit.pose(i), seed, tolerance);
          ASSERT_LE(now.work, before.work) << "step " << step << ", pose " << i << ", tolerance " << tolerance << " after "
                                           << kept;
          before = now;
        }
        Options options;
        options.relative = kept;
        distance(a_, b_, orbit.pose(i), seed, options);
      }
    }
  }
}

/// Samples of maps choose a level at once; bodies without maps descend.
constexpr std::pair<StartPolicy, Refinement> kDescents[] = {{StartPolicy::Automatic, Refinement::SingleSingle},
                                                            {StartPolicy::Paper, Refinement::Single},
                                                            {StartPolicy::Paper, Refinement::SingleSingle},
                                                            {StartPolicy::Paper, Refinement::DoubleDouble}};
TEST_P(Law10, NoQueryReadsALevelFinerThanItsToleranceNeeds) {
  const shapes::Orbit orbit(70, 4, 10.377);
  int descended = 0, stopped_early = 0;
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    for (const double tolerance : kTolerances) {
      for (const auto& [start, refinement] : kDescents) {
        LevelRecord records[64];
        Options options;
        options.relative = tolerance;
        options.tuning.start = start;
        options.tuning.refinement = refinement;
        options.tuning.trace = records;
        PairSeed seed;
        const Answer answer = distance(a_, b_, orbit.pose(i), seed, options);
        std::uint32_t steps = 0, plane_tests = 0;
        for (int k = 0; k < answer.levels_visited; ++k) {  // trap G14: the work is where the trace says
          steps += records[k].steps;
          plane_tests += records[k].plane_tests;
          const double allowed = std::max(options.absolute, tolerance * records[k].lower);
          const bool enough = records[k].upper - records[k].lower <= allowed;
          ASSERT_EQ(enough && k + 1 < answer.levels_visited, false) << "pose " << i << " went on from record " << k;
        }
        ASSERT_LE(steps, answer.steps);
        ASSERT_LE(plane_tests, answer.plane_tests);
        const LevelRecord& last = records[answer.levels_visited - 1];
        ASSERT_GE(answer.level_a, last.level_a) << "points of a level that was not read";
        ASSERT_GE(answer.level_b, last.level_b);
        descended += answer.levels_visited > 1;
        stopped_early += answer.level_a > 0 && answer.level_b > 0;
      }
    }
  }
  EXPECT_GE(descended, kPoses);
  EXPECT_GE(stopped_early, kPoses / 2);
}

TEST_P(Law10, VerdictsAreCheaperThanDistances) {  // trap G15
  const shapes::Orbit orbit(80, 2, 10.377);
  std::uint64_t verdicts = 0, distances = 0;
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    PairSeed cold, other;
    const Answer verdict = intersects(a_, b_, orbit.pose(i), cold), answer = distance(a_, b_, orbit.pose(i), other);
    ASSERT_EQ(verdict.verdict, Verdict::Disjoint);
    ASSERT_LE(verdict.steps + verdict.plane_tests, answer.steps + answer.plane_tests) << i;
    verdicts += verdict.steps + verdict.plane_tests;
    distances += answer.steps + answer.plane_tests;
  }
  EXPECT_LT(2 * verdicts, distances);
}

/// Bodies that touch, or nearly: their maps are of levels that overlap where the exact hulls may be apart. Whole models, and
/// cut ones that cannot answer exactly.
TEST(Law10, ALooserToleranceNeverCostsMoreHoweverLoose) {
  std::deque<Subject> subjects;
  for (const Mesh& mesh :
       {shapes::ellipsoid({1, 1, 1}, 500, 1), shapes::ellipsoid({1, 1, 0.1}, 400, 2), shapes::ellipsoid({1, 0.1, 0.1}, 400, 3),
        shapes::cube(), shapes::octahedron(), shapes::random_polytope(100, 2), shapes::prism(20, 1, 1), shapes::meshed_cube(6)})
    subjects.push_back(subject(mesh));
  shapes::Random random(1);
  for (int i = 0; i < 40000; ++i) {
    const Model &a = subjects[random.bits() % subjects.size()].model, &b = subjects[random.bits() % subjects.size()].model;
    const auto anywhere = [&] { return Pose{random.rotation(), random.uniform(0.3, 4) * random.on_sphere()}; };
    Pose pose = anywhere();
    PairSeed seed;
    if (i % 3 == 1) distance(a, b, anywhere(), seed);
    if (i % 3 == 2) distance(a, b, pose, seed), pose.translation += 0.1 * random.on_sphere();
    std::uint32_t before = ~0u;
    for (const double relative : {0.0, 1e-3, 1e-2, 0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 4.0, 10.0, 100.0}) {
      Options options;
      options.relative = relative;
      PairSeed start = seed;
      const Answer answer = distance(a, b, pose, start, options);
      ASSERT_LE(answer.steps + answer.plane_tests, before) << i << ", to " << relative;
      before = answer.steps + answer.plane_tests;
    }
  }
}

TEST(Law10NearContact, FromNothingALooserToleranceNeverCostsMore) {
  const shapes::Pair meshes = shapes::pair(shapes::Family::Fat, 20000);
  const Model a = bodies::must(build(meshes.a)).model, b = bodies::must(build(meshes.b)).model;
  const Detail coarser{1.01 * std::max(a.level(1).deviation, b.level(1).deviation)};
  const std::pair<Model, Model> pairs[] = {{a, b}, {a.cut(coarser), b.cut(coarser)}};
  ASSERT_EQ(pairs[1].first.finest_level(), 1);
  shapes::Random random(90);
  int near = 0;
  for (int i = 0; i < 600; ++i) {
    const Pose pose{random.rotation(), 2 * random.on_sphere()};
    for (const auto& [of_a, of_b] : pairs) {
      std::uint32_t before = ~0u;
      for (const double error : {0.0, 0.003, 0.01, 0.0125, 0.015, 0.03, 0.1}) {
        Options options;
        options.absolute = error;
        PairSeed cold;
        const Answer answer = distance(of_a, of_b, pose, cold, options);
        ASSERT_LE(answer.steps + answer.plane_tests, before) << "pose " << i << ", error " << error;
        before = answer.steps + answer.plane_tests;
        near += answer.lower < 0.003;
      }
    }
  }
  EXPECT_GT(near, 600);
}

/// Between boxes with rounded corners, of broad faces and fine ones, no sample's vertices are near the nearest points, but
/// those of a simplex are: cold, a tolerance saves the walk.
TEST(Law10BroadFaces, AreAnsweredByASearchOfTheMaps) {
  Mesh corners;
  for (const double x : {-1., 1.})
    for (const double y : {-0.7, 0.7})
      for (const double z : {-0.4, 0.4})
        for (const Vec3& p : shapes::ellipsoid({1, 1, 1}, 200, 1).points)
          corners.points.push_back(Vec3(x, y, z) + 0.1 * p.normalized());
  const Model box = bodies::must(build(corners)).model;
  shapes::Random random(91);
  std::uint64_t exact = 0, loose = 0;
  int searched = 0;
  for (int i = 0; i < 400; ++i) {
    Pose pose{random.rotation(), 4 * random.on_sphere()};
    PairSeed far, cold, other;
    const Answer before = distance(box, box, pose, far);
    pose.translation -= (before.lower - 0.03) * before.normal;
    const Answer truth = distance(box, box, pose, cold), answer = distance(box, box, pose, other, {.absolute = 0.1});
    ASSERT_EQ(truth.verdict, Verdict::Disjoint);
    ASSERT_EQ(answer.status, Status::Converged);
    ASSERT_LE(answer.lower, truth.upper);
    ASSERT_GE(answer.upper, truth.lower);
    ASSERT_LE(answer.upper - answer.lower, 0.1);
    const Check judged = check(box, box, pose, answer);
    ASSERT_TRUE(judged) << i << ": " << judged.message;
    exact += truth.steps, loose += answer.steps, searched += answer.steps == 0;
  }
  std::printf("steps: exact %d, to 0.1 %d\n", int(exact), int(loose));
  EXPECT_GT(searched, 100);
  EXPECT_LT(4 * loose, exact);
}

/// An error smaller than what the finest maps are likely to prove asks for the exact distance.
TEST(Law10SmallErrors, GetTheExactDistance) {
  shapes::Random random(92);
  for (const shapes::Family family : shapes::kFamilies) {
    const shapes::Pair meshes = shapes::pair(family, 2000);
    const Model a = bodies::must(build(meshes.a)).model, b = bodies::must(build(meshes.b)).model;
    const double doubt = a.level(0).map_doubt + b.level(0).map_doubt;
    PairSeed seed, exact_seed;
    for (int i = 0; i < 100; ++i) {
      const Pose pose{random.rotation(), 2.2 * a.radius() * random.on_sphere()};
      const Answer loose = distance(a, b, pose, seed, {.absolute = 0.99 * doubt}), exact = distance(a, b, pose, exact_seed);
      ASSERT_EQ(loose.lower, exact.lower);
      ASSERT_EQ(loose.upper, exact.upper);
    }
  }
}

/// A sample that answered is taken again, without any step and without writing to the seed, while its direction serves; after a
/// jump, and for a smaller error, there is another answer.
TEST(Law10Samples, AreTakenAgainWhileTheirDirectionServes) {
  shapes::Random random(93);
  for (const shapes::Family family : shapes::kFamilies) {
    const shapes::Pair meshes = shapes::pair(family, 2000);
    const Model a = bodies::must(build(meshes.a)).model, b = bodies::must(build(meshes.b)).model;
    const Vec3 axis = random.on_sphere(), spin = random.on_sphere(), from = axis.unitOrthogonal();
    PairSeed seed;
    int again = 0;
    for (int i = 0; i < 400; ++i) {
      const double degree = std::acos(-1) / 180;
      Pose pose{shapes::rotation(spin, i * degree), 2.3 * a.radius() * (shapes::rotation(axis, i * degree) * from)};
      if (i % 50 == 49) pose = {random.rotation(), 2.3 * a.radius() * random.on_sphere()};
      const double error = (i % 10 == 9 ? 0.002 : 0.04) * a.radius();
      const PairSeed before = seed;
      const Answer loose = distance(a, b, pose, seed, {.absolute = error}), exact = distance(a, b, pose);
      ASSERT_EQ(loose.status, Status::Converged);
      ASSERT_LE(loose.upper - loose.lower, error);
      ASSERT_LE(loose.lower, exact.upper);
      ASSERT_GE(loose.upper, exact.lower);
      const Check passed = check(a, b, pose, loose);
      ASSERT_TRUE(passed) << shapes::name(family) << ", pose " << i << ": " << passed.message;
      if (seed.a.kind() == FeatureKind::None) {
        ASSERT_EQ(loose.steps, 0u);
      }
      again += seed.a.kind() == FeatureKind::None && std::memcmp(&before, &seed, sizeof seed) == 0;
    }
    std::printf("%s: %d of 400 sampled as before\n", shapes::name(family), again);
    EXPECT_GT(again, 100);
  }
}

/// A cold loose distance may end at the first features near enough for a sample's bound, or for 0: edges, a vertex and an edge,
/// or a vertex and a triangle. Errors smaller than these are exact.
TEST(Law10EarlyEnd, LooseColdDistancesEndBeforeTheNearestFeatures) {
  shapes::Random random(91);
  int early = 0, longer = 0, undecided = 0, kinds[3][3] = {};
  double steps = 0, all_steps = 0;
  for (const shapes::Family family : shapes::kFamilies) {
    const shapes::Pair meshes = shapes::pair(family, 2000);
    const Model a = bodies::must(build(meshes.a)).model, b = bodies::must(build(meshes.b)).model;
    for (int i = 0; i < 400; ++i) {
      const Pose pose{random.rotation(), (i % 2 ? 2 : 2.2) * a.radius() * random.on_sphere()};
      const Answer exact = distance(a, b, pose);
      if (exact.verdict != Verdict::Disjoint) continue;
      for (const double error : {0.007, 0.01, 0.02, 0.05}) {
        Options options;
        options.absolute = error * a.radius();
        PairSeed seed;
        const Answer loose = distance(a, b, pose, seed, options);
        ASSERT_EQ(loose.status, Status::Converged);
        ASSERT_LE(loose.upper - loose.lower, options.absolute);
        ASSERT_LE(loose.lower, exact.upper);
        ASSERT_GE(loose.upper, exact.lower);
        const Check passed = check(a, b, pose, loose);
        ASSERT_TRUE(passed) << shapes::name(family) << ", pose " << i << ", error " << error << ": " << passed.message;
        ASSERT_EQ(loose.verdict == Verdict::Undecided, loose.lower == 0);
        undecided += loose.lower == 0 && loose.steps + loose.plane_tests > 0;
        // The next query walks on from there, or, where no features were kept, begins anew.
        const Answer next = distance(a, b, pose, seed);
        ASSERT_NEAR(next.lower, exact.lower, tolerance(a, b, pose));
        steps += loose.steps, all_steps += exact.steps;
        longer += loose.steps + loose.plane_tests > exact.steps + exact.plane_tests;
        const bool walked = loose.steps > 0 || loose.plane_tests > 0;
        if (!walked || loose.level_a != 0 || loose.upper - loose.lower <= tolerance(a, b, pose)) continue;
        ++early, ++kinds[int(loose.feature_a.kind()) - 1][int(loose.feature_b.kind()) - 1];
      }
    }
  }
  EXPECT_EQ(longer, 0);
  EXPECT_GT(early, 1000);
  EXPECT_LT(steps, all_steps / 2);
  EXPECT_GT(kinds[1][1], 100);  // edges
  EXPECT_GT(kinds[0][1], 10);   // a vertex of either body and an edge
  EXPECT_GT(kinds[1][0], 10);
  EXPECT_GT(kinds[0][2], 10);  // a vertex of either body and a triangle
  EXPECT_GT(kinds[2][0], 10);
  EXPECT_GT(undecided, 100);
  std::printf("%d ended early, %.2f of the steps\n", early, steps / all_steps);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Law10, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& shape) { return shapes::name(shape.param); });

}  // namespace
}  // namespace swiftlet
