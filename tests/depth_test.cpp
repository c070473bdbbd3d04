// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The laws, for the signed distance: how deep bodies overlap, judged by rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>

#include "bodies.h"
#include "case.h"
#include "numeric/tolerance.h"
#include "oracle.h"
#include "shapes.h"
#include "suite.h"

namespace swiftlet {
namespace {

using Points = std::vector<Vec3>;

struct Polyhedron {
  Points points;
  Model model;
  operator Body() const { return model; }
};
Polyhedron body(const Points& points, const BuildOptions& options = {}) {
  Result<Built> built = build(points, options);
  if (!built) throw std::runtime_error(built.error().message);
  return {points, built.value().model};
}
Polyhedron body(const Mesh& mesh) { return body(mesh.points); }

std::string describe(const Answer& s) {
  char text[400];
  std::snprintf(text, sizeof text, "[%.17g, %.17g] width %.3g status %d verdict %d normal (%.9g, %.9g, %.9g) steps %u", s.lower,
                s.upper, s.upper - s.lower, int(s.status), int(s.verdict), s.normal[0], s.normal[1], s.normal[2], s.steps);
  return text;
}

oracle::SignedTruth truth_of(const Polyhedron& a, const Polyhedron& b, const Pose& pose) {
  return oracle::signed_distance(a.points, Pose{}, b.points, pose);
}

/// What is wrong with an exact answer; empty if nothing.
std::string fault(const Polyhedron& a, const Polyhedron& b, const Pose& pose, const Answer& s,
                  const oracle::SignedTruth& truth) {
  const double bound = tolerance(a, b, pose);
  std::string wrong;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) wrong += std::string(what) + "; ";
  };
  require(s.status == Status::Converged, "not converged");
  require(oracle::compare(truth, s.lower) >= 0, "lower is above the truth");
  require(oracle::compare(truth, s.upper) <= 0, "upper is below the truth");
  require(s.upper - s.lower <= bound, "wider than law 2");
  require(s.verdict != Verdict::Disjoint || truth.sign > 0, "disjoint");
  require(s.verdict != Verdict::Overlapping || truth.sign <= 0, "overlapping");
  require(s.verdict != Verdict::Touching || std::abs(truth.distance) <= bound, "touching");
  require(s.verdict != Verdict::Undecided, "undecided");
  require(std::abs(s.normal.norm() - 1) <= 1e-15, "normal is no unit");
  require(oracle::is_apart_along(a.points, b.points, pose, s.normal, s.lower), "the normal does not prove lower");
  require((s.point_b - s.point_a - s.normal * (s.lower + s.upper) / 2).norm() <= 2 * bound, "points");
  require(oracle::is_within(a.points, Points{s.point_a}, Pose{}, bound), "point_a off A");
  require(oracle::is_within(Points{s.point_b}, b.points, pose, bound), "point_b off B");
  if (!wrong.empty()) {
    char text[100];
    std::snprintf(text, sizeof text, " truth %.17g bound %.3g", truth.distance, bound);
    wrong += describe(s) + text;
  }
  return wrong;
}

std::string fault(const Polyhedron& a, const Polyhedron& b, const Pose& pose, const Answer& s) {
  return fault(a, b, pose, s, truth_of(a, b, pose));
}

TEST(SignedDistance, KnowsTwoCubes) {
  const Polyhedron cube = body(shapes::cube());
  for (const double x : {5., 2.5, 2., 1.5, .25, 0., -1.5}) {
    const Pose pose{Mat3::Identity(), {x, .125, -.125}};
    PairSeed seed;
    const oracle::SignedTruth truth = truth_of(cube, cube, pose);
    for (int round = 0; round < 3; ++round) {
      const Answer s = signed_distance(cube, cube, pose, seed);
      EXPECT_EQ(fault(cube, cube, pose, s, truth), "") << x << " " << round;
    }
  }
}

/// 300 pairs, or as many as SWIFTLET_PAIRS says: 1 000 take about 5 s.
TEST(SignedDistance, HoldsTheTruthOfRandomOverlaps) {
  const char* const asked = std::getenv("SWIFTLET_PAIRS");
  const int pairs = asked ? std::max(300, std::atoi(asked)) : 300;
  shapes::Random random(41);
  int overlapping = 0;
  std::uint32_t most = 0;
  for (int i = 0; i < pairs; ++i) {
    Points p, q;
    const int n = 4 + int(random.bits() % 12);
    for (int k = 0; k < n; ++k) p.push_back(random.in_ball()), q.push_back(random.in_ball());
    const Polyhedron a = body(p), b = body(q);
    const Pose pose{random.rotation(), random.in_ball() * .7};
    PairSeed seed;
    const oracle::SignedTruth truth = truth_of(a, b, pose);
    for (int round = 0; round < 2; ++round) {
      const Answer s = signed_distance(a, b, pose, seed);
      EXPECT_EQ(fault(a, b, pose, s, truth), "") << i << " round " << round;
      overlapping += s.verdict == Verdict::Overlapping;
      most = std::max(most, s.steps);
    }
  }
  std::printf("%d answers of overlapping bodies, at most %u steps\n", overlapping, most);
  EXPECT_GE(overlapping, pairs / 2);
}

TEST(SignedDistance, HoldsTheTruthOfTheSuite) {
  int overlapping = 0;
  for (const auto& file : stability::suite_files()) {
    for (const stability::Case& c : stability::read_cases(file)) {
      const Polyhedron a = body(c.a), b = body(c.b);
      const Pose pose = c.b_in_a();
      PairSeed seed;
      const oracle::SignedTruth truth = truth_of(a, b, pose);
      for (int round = 0; round < 2; ++round) {
        const Answer s = signed_distance(a, b, pose, seed);
        EXPECT_EQ(fault(a, b, pose, s, truth), "") << c.name << " round " << round;
        overlapping += s.verdict == Verdict::Overlapping;
      }
    }
  }
  std::printf("%d overlapping\n", overlapping);
}

/// Bodies of several levels, and poses at which they overlap by any part of themselves.
struct Scenery {
  Polyhedron a, b;
  std::vector<Pose> poses;
};
Scenery scenery(shapes::Family family, std::uint32_t triangles, int poses, std::uint64_t seed) {
  const shapes::Pair pair = shapes::pair(family, triangles);
  Scenery scene{body(pair.a), body(pair.b), {}};
  shapes::Random random(seed);
  while (int(scene.poses.size()) < poses) {
    const Pose pose{random.rotation(), random.in_ball() * 1.2};
    if (intersects(scene.a, scene.b, pose).verdict == Verdict::Overlapping) scene.poses.push_back(pose);
  }
  return scene;
}

TEST(SignedDistance, IsTheLeastTranslationThatSeparates) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 300, 30, 5);
    for (const Pose& pose : scene.poses) {
      const Answer s = signed_distance(scene.a, scene.b, pose);
      ASSERT_EQ(s.verdict, Verdict::Overlapping);
      ASSERT_EQ(s.status, Status::Converged);
      const double bound = tolerance(scene.a, scene.b, pose);
      for (const double out : {-bound, bound}) {
        Pose moved = pose;
        moved.translation += (out - (s.lower + s.upper) / 2) * s.normal;
        // Translations are rounded once more, which the bound covers.
        EXPECT_EQ(oracle::distance(scene.a.points, scene.b.points, moved).overlapping, out < 0) << describe(s);
      }
    }
  }
}

TEST(SignedDistance, IsSymmetricUnderSwap) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 300, 40, 6);
    for (const Pose& pose : scene.poses) {
      const Answer s = signed_distance(scene.a, scene.b, pose), t = signed_distance(scene.b, scene.a, inverse(pose));
      const double bound = tolerance(scene.a, scene.b, pose) + tolerance(scene.b, scene.a, inverse(pose));
      EXPECT_LE(std::abs(s.lower - t.lower), bound);
      EXPECT_LE(std::abs(s.upper - t.upper), bound);
      EXPECT_LE((s.normal + pose.rotation * t.normal).norm(), 1e-9) << describe(s) << describe(t);
    }
  }
}

TEST(SignedDistance, ScalesBitForBit) {
  for (const int exponent : {-40, -1, 3, 60}) {
    const double scale = std::ldexp(1.0, exponent);
    for (const shapes::Family family : shapes::kFamilies) {
      const Scenery scene = scenery(family, 100, 10, 7);
      const auto scaled = [&](Points points) {
        for (Vec3& p : points) p *= scale;
        return body(points);
      };
      const Polyhedron a = scaled(scene.a.points), b = scaled(scene.b.points);
      for (const Pose& pose : scene.poses) {
        const Answer s = signed_distance(scene.a, scene.b, pose),
                     t = signed_distance(a, b, {pose.rotation, pose.translation * scale});
        EXPECT_EQ(s.lower * scale, t.lower);
        EXPECT_EQ(s.upper * scale, t.upper);
        EXPECT_EQ(s.normal, t.normal);
        EXPECT_EQ(s.point_a * scale, t.point_a);
        EXPECT_EQ(s.steps, t.steps);
      }
    }
  }
}

TEST(SignedDistance, TakesAnySeed) {
  shapes::Random random(8);
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 300, 20, 9);
    PairSeed chain;
    for (const Pose& pose : scene.poses) {
      const double bound = tolerance(scene.a, scene.b, pose);
      const Answer s = signed_distance(scene.a, scene.b, pose);
      const auto agree = [&](PairSeed& seed, const char* what) {
        const Answer t = signed_distance(scene.a, scene.b, pose, seed);
        EXPECT_EQ(s.verdict, t.verdict) << what;
        EXPECT_EQ(t.status, Status::Converged) << what;
        EXPECT_LE(std::abs(s.lower - t.lower), bound) << what << describe(s) << describe(t);
        EXPECT_LE(std::abs(s.upper - t.upper), bound) << what << describe(s) << describe(t);
      };
      agree(chain, "of another pose");
      agree(chain, "of this pose");
      for (int k = 0; k < 10; ++k) {
        PairSeed garbage;
        std::array<std::uint64_t, sizeof(PairSeed) / 8> bits;
        for (std::uint64_t& word : bits) word = random.bits();
        std::memcpy(static_cast<void*>(&garbage), bits.data(), sizeof garbage);
        garbage.met = k % 2;
        agree(garbage, "garbage");
      }
    }
  }
}

/// Where another last bit of a bound decides, a seed that a deeper pose left gives what a cold start does.
TEST(SignedDistance, NoSeedDecidesWithinRoundingOfAThreshold) {
  shapes::Random random(15);
  const auto within_bounds = [&](double bound) { return random.uniform(-1.5, 1.5) * bound; };
  int decisions = 0, touching = 0;
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 60, 40, 16);
    for (const Pose& pose : scene.poses) {
      const Answer deep = signed_distance(scene.a, scene.b, pose);
      for (int k = 0; k < 10; ++k) {
        const auto left_by = [&](Pose p) {
          PairSeed seed;
          p.translation -= std::pow(10, random.uniform(-14, -2)) * (deep.normal + .1 * random.in_ball());
          signed_distance(scene.a, scene.b, p, seed);
          return seed;
        };
        const double bound = tolerance(scene.a, scene.b, pose), threshold = deep.value() + within_bounds(bound);
        PairSeed seed = left_by(pose);
        const Decision cold = signed_within(scene.a, scene.b, pose, threshold).decision;
        EXPECT_EQ(signed_within(scene.a, scene.b, pose, threshold, seed).decision, cold);
        decisions += cold == Decision::Undecided;

        const Body a{scene.a.model, random.uniform(0, .1) * bound}, b{scene.b.model, random.uniform(0, .1) * bound};
        Pose contact = pose;
        contact.translation += (within_bounds(bound) - deep.value()) * deep.normal;
        seed = left_by(contact);
        const Verdict verdict = signed_distance(a, b, contact).verdict;
        EXPECT_EQ(signed_distance(a, b, contact, seed).verdict, verdict);
        touching += verdict == Verdict::Touching;
      }
    }
  }
  EXPECT_GE(decisions, 100);
  EXPECT_GE(touching, 100);
}

TEST(SignedDistance, IsContinuousThroughContact) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 300, 4, 10);
    for (const Pose& pose : scene.poses) {
      const Answer start = signed_distance(scene.a, scene.b, pose);
      PairSeed seed;
      const double step = -start.lower / 100;
      double before = 0;
      for (int k = 0; k <= 200; ++k) {  // from that deep to as far apart
        Pose moved = pose;
        moved.translation += k * step * start.normal;
        const Answer s = signed_distance(scene.a, scene.b, moved, seed);
        ASSERT_EQ(s.status, Status::Converged);
        const double bound = tolerance(scene.a, scene.b, moved);
        if (k > 0) {
          ASSERT_LE(std::abs(s.lower - before), step + 2 * bound) << k;  // no faster than B moves
        }
        if (k == 100) {
          ASSERT_LE(std::abs(s.lower), 2 * bound);
        }
        ASSERT_EQ(s.verdict, k < 100 ? Verdict::Overlapping : k > 100 ? Verdict::Disjoint : s.verdict) << k;
        before = s.lower;
      }
    }
  }
}

TEST(SignedDistance, IsCheckedByAnyone) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 300, 5, 11);
    for (const Pose& pose : scene.poses) {
      const double bound = tolerance(scene.a, scene.b, pose);
      const Answer s = signed_distance(scene.a, scene.b, pose);
      const auto checked = [&](auto change) {
        Answer wrong = s;
        change(wrong);
        return check(scene.a, scene.b, pose, wrong);
      };
      EXPECT_EQ(checked([](Answer&) {}).message, "");
      EXPECT_FALSE(checked([&](Answer& w) {
        w.lower += bound;
        w.upper += bound;
      })) << describe(s);
      EXPECT_FALSE(checked([&](Answer& w) {
        w.lower -= bound;
        w.upper -= bound;
      })) << describe(s);
      EXPECT_FALSE(checked([&](Answer& w) { w.normal = -w.normal; }));
      EXPECT_FALSE(checked([&](Answer& w) { w.point_a += w.normal * .01; }));
      EXPECT_FALSE(checked([&](Answer& w) { w.verdict = Verdict::Disjoint; }));
    }
    const Pose far{Mat3::Identity(), {3, 1, 0}};
    EXPECT_TRUE(check(scene.a, scene.b, far, signed_distance(scene.a, scene.b, far)));
  }
}

TEST(SignedDistance, LooserNeverCostsMore) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 2000, 25, 12);
    std::array<double, 6> work{};
    for (const Pose& pose : scene.poses) {
      const Answer exact = signed_distance(scene.a, scene.b, pose);
      for (std::size_t k = 0; k < work.size(); ++k) {
        const double relative = k == 0 ? 0 : std::pow(10, -double(work.size() - k));
        const Answer s = signed_distance(scene.a, scene.b, pose, {.relative = relative});
        EXPECT_EQ(s.status, Status::Converged);
        EXPECT_LE(s.lower, exact.upper);
        EXPECT_GE(s.upper, exact.lower);
        EXPECT_LE(s.upper - s.lower, std::max(relative * -s.upper, tolerance(scene.a, scene.b, pose)) * (1 + 1e-12));
        if (k + 1 == work.size() && pose.translation == scene.poses[0].translation) {
          EXPECT_EQ(check(scene.a, scene.b, pose, s).message, "");
        }
        work[k] += s.steps + s.plane_tests;
      }
    }
    std::printf("%s: steps plus tests at relative error 0, 1e-5, ... 1e-1:", shapes::name(family));
    for (const double w : work) std::printf(" %.0f", w / double(scene.poses.size()));
    std::printf("\n");
    for (std::size_t k = 1; k < work.size(); ++k) EXPECT_LE(work[k], work[k - 1]);
  }
}

TEST(SignedDistance, StopsAtABudgetAndAtALevel) {
  const Scenery scene = scenery(shapes::Family::Fat, 2000, 10, 13);
  for (const Pose& pose : scene.poses) {
    const Answer exact = signed_distance(scene.a, scene.b, pose);
    for (const std::uint32_t budget : {0u, 1u, 5u, 12u}) {
      const Answer s = signed_distance(scene.a, scene.b, pose, {.budget = {.steps = budget}});
      EXPECT_TRUE(s.status == Status::Budget || s.status == Status::Converged) << int(s.status);
      EXPECT_LE(s.lower, exact.upper);
      EXPECT_GE(s.upper, exact.lower);
      EXPECT_TRUE(std::isfinite(s.lower)) << budget;
      EXPECT_LE(s.steps, budget + 26);
    }
    for (int level = 1; level < scene.a.model.level_count(); ++level) {
      const Answer s = signed_distance(scene.a, scene.b, pose, {.budget = {.finest_level = level}});
      EXPECT_EQ(s.status, Status::LevelLimit);
      EXPECT_LE(s.lower, exact.upper);
      EXPECT_GE(s.upper, exact.lower);
    }
  }
  Pose illegal;
  illegal.rotation(0, 0) = 2;
  EXPECT_EQ(signed_distance(scene.a, scene.b, illegal).status, Status::InvalidPose);
}

/// A distance and then a depth each took the whole budget. The distances walk from the coarsest levels here, for many steps.
TEST(SignedDistance, SpendsItsBudgetOnce) {
  const Scenery scene = scenery(shapes::Family::Long, 2000, 40, 13);
  int both = 0;
  for (const Pose& pose : scene.poses) {
    const Tuning tuning{.start = StartPolicy::Coarsest};
    const std::uint32_t of_distance = distance(scene.a, scene.b, pose, {.tuning = tuning}).steps,
                        of_depth = signed_distance(scene.a, scene.b, pose, {.tuning = tuning}).steps - of_distance;
    const std::uint32_t budget = std::max(of_distance, of_depth);
    both += of_distance + of_depth > budget + 26;
    const Answer s = signed_distance(scene.a, scene.b, pose, {.budget = {.steps = budget}, .tuning = tuning});
    EXPECT_LE(s.steps, budget + 26);
  }
  EXPECT_GE(both, 10);
}

/// Where more facets are as deep than a polytope has points, a loose search had none beside its plane but far points that
/// bounded a cone: the answer had no points, or one point for both.
TEST(SignedDistance, HasPointsWhereManyFacetsAreAsDeepAndAnErrorIsAllowed) {
  const Polyhedron prism = body(shapes::prism(128, 0.3, 2));
  const Body ball = Body::point(Vec3::Zero(), 0.2);
  PairSeed seed;
  for (int round = 0; round < 2; ++round) {
    const Answer s = signed_distance(prism, ball, Pose{}, seed, {.absolute = 1e-4});
    EXPECT_EQ(s.status, Status::Converged);
    EXPECT_LE(s.normal.dot(s.point_b - s.point_a), -0.499);
    EXPECT_EQ(check(prism, ball, Pose{}, s).message, "");
    EXPECT_GE(manifold(prism, ball, Pose{}, s).count, 1u);
  }
}

/// Points on the unit sphere, spread evenly around its pole up to an angle.
Points cap(int count, double angle) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - std::cos(angle)) * (i + 0.5) / count, turn = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}
Points ball(int count) { return cap(count, std::numbers::pi); }

/// About one centre nearly every facet of the difference of round bodies is as deep as any other, more than a polytope has room
/// for: all directions are covered cone by cone. Each cone's polytope reached far beyond its directions: of 1 000 vertices a
/// depth took 4.7 million steps and ended NotConverged.
TEST(SignedDistance, OfRoundBodiesAboutOneCentreTakesAFewStepsAVertex) {
  for (const int count : {400, 2000}) {
    Points points = cap(count / 2, std::numbers::pi / 2);
    for (Vec3& p : points) p = p.cast<float>().cast<double>();  // so that three times such a point is a double
    for (int i = 0; i < count / 2; ++i) points.push_back(-points[std::size_t(i)]);
    const Polyhedron round = body(points), centre{{Vec3::Zero()}, bodies::model(bodies::point(Vec3::Zero()))};
    Points thrice = points;
    for (Vec3& p : thrice) p *= 3;
    const Polyhedron large = body(thrice);
    // A ball that is its own mirror image less one `times` as large is 1 + times such balls.
    const oracle::SignedTruth truth = truth_of(round, centre, Pose{});
    const auto expect = [&](const Body& inner, double times, std::uint32_t vertices) {
      const Answer s = signed_distance(round, inner, Pose{});
      EXPECT_EQ(s.status, Status::Converged) << count << ' ' << times << ' ' << describe(s);
      EXPECT_GE(oracle::compare(truth, s.lower / (1 + times)), 0) << describe(s);
      EXPECT_LE(oracle::compare(truth, s.upper / (1 + times)), 0) << describe(s);
      EXPECT_EQ(check(round, inner, Pose{}, s, Question::Exact).message, "");
      EXPECT_LE(s.steps, 4 * vertices) << count << ' ' << times;
      std::printf("%u vertices: %.1f supports for each\n", vertices, double(s.steps) / vertices);
      for (const double off : {0.999, 1.001}) {
        const Within w = signed_within(round, inner, Pose{}, off * s.lower);
        EXPECT_EQ(w.decision, off > 1 ? Decision::No : Decision::Yes);
        EXPECT_LE(w.answer.steps, 4 * vertices);
      }
    };
    expect(centre, 0, std::uint32_t(count));
    expect(round, 1, std::uint32_t(2 * count));
    expect(large, 3, std::uint32_t(2 * count));
    // Turned, it has more facets than both.
    const Pose turned{shapes::rotation(Vec3(1, 2, 3).normalized(), 0.3), Vec3(0.001, 0, 0)};
    const Answer s = signed_distance(round, round, turned);
    EXPECT_EQ(s.status, Status::Converged) << describe(s);
    if (count < 1000) {
      EXPECT_EQ(check(round, round, turned, s, Question::Exact).message, "");
    }
    EXPECT_LE(s.steps, 8 * std::uint32_t(count));
  }
}

/// Hundreds of facets within a degree are as deep. Cones were divided down to 1.4 degrees, and points sought in one of 0.9:
/// where it had more facets than a polytope, Converged answers had points up to 6e-4 aside, or the depth was 4 % off and
/// NotConverged.
TEST(SignedDistance, OfADomeHasItsPoints) {
  const Body centre = Body::point(Vec3::Zero());
  for (const double degrees : {0.1, 0.5, 1.0, 2.0}) {
    for (const int count : {320, 1000}) {
      const double angle = degrees * std::numbers::pi / 180;
      Points points = cap(count, angle);
      const double rim = (1 - 5 * std::sin(0.9 * angle)) / std::cos(0.9 * angle);
      for (const double x : {-5., 5.})
        for (const double y : {-5., 5.}) points.emplace_back(x, y, rim), points.emplace_back(x, y, -5);
      const Polyhedron dome = body(points);
      const Answer s = signed_distance(dome, centre, Pose{});
      EXPECT_EQ(fault(dome, {{Vec3::Zero()}, bodies::model(bodies::point(Vec3::Zero()))}, Pose{}, s), "") << degrees;
      EXPECT_EQ(check(dome, centre, Pose{}, s, Question::Exact).message, "") << degrees << ' ' << count;
    }
  }
}

/// A budget that ended while directions were covered took back the lower bound that one polytope had proved; one that ended
/// while points were sought left Converged answers whose points were one.
TEST(SignedDistance, KeepsWhatABudgetFoundOfManyFacetsAsDeep) {
  const Polyhedron round = body(ball(300));
  const Body centre = Body::point(Vec3::Zero());
  const std::uint32_t all = signed_distance(round, centre, Pose{}).steps;
  int ended = 0;
  for (std::uint32_t budget = 130; budget <= all + 5; budget += budget + 30 < all ? 37 : 1) {
    const Answer s = signed_distance(round, centre, Pose{}, {.budget = {.steps = budget}});
    EXPECT_LE(s.upper, -0.96) << budget;
    EXPECT_EQ(check(round, centre, Pose{}, s, Question::Exact).message, "") << budget << ' ' << describe(s);
    ended += s.status == Status::Budget;
    EXPECT_TRUE(s.status == Status::Budget || s.status == Status::Converged) << int(s.status);
    EXPECT_LE(s.steps, budget + 26);
  }
  EXPECT_GE(ended, 20);
  EXPECT_EQ(signed_distance(round, centre, Pose{}, {.budget = {.steps = all}}).status, Status::Converged);
}

/// Far from the origin law 2's bound is larger than the heights of facets differ, and points were sought among ideal ones
/// alone.
TEST(SignedDistance, OfABallFarFromTheOriginHasItsPoints) {
  for (const int count : {900, 1100}) {
    const Polyhedron round = body(ball(count));
    for (const double far : {0x1p37, 0x1p38, 0x1p39, 0x1p40}) {
      const Vec3 offset(0.5 * far, -0.7 * far, 0.9 * far);
      Pose pose;
      pose.translation = offset;
      const Body centre = Body::point(-offset);
      EXPECT_EQ(check(round, centre, pose, signed_distance(round, centre, pose), Question::Exact).message, "") << far;
    }
  }
}

/// A loose search may end with an exact interval: its points were of a neighbouring facet, 2e-3 aside of the normal.
TEST(SignedDistance, OfALooseSearchHasItsPointsOnTheNormal) {
  int narrow = 0;
  for (int count = 150; count < 300; count += 26) {
    const Polyhedron round = body(ball(count));
    for (const double relative : {1e-2, 1e-4, 1e-6}) {
      for (const double turn : {0., 0.3, 0.6}) {
        const Pose pose{shapes::rotation(Vec3(1, 2, 3).normalized(), turn), Vec3::Zero()};
        const Answer s = signed_distance(round, round, pose, {.relative = relative});
        EXPECT_EQ(check(round, round, pose, s).message, "") << count << ' ' << relative << ' ' << turn;
        const Vec3 between = s.point_b - s.point_a;
        EXPECT_LE((between - s.normal * between.dot(s.normal)).norm(), 2 * tolerance(round, round, pose)) << count;
        narrow += s.upper - s.lower <= tolerance(round, round, pose);
      }
    }
  }
  EXPECT_GE(narrow, 1);
}

/// Of models whose finest level is a box around the body, the bounds, normal and points are those of the boxes. Polytopes were
/// given up there, as they are where a finer level follows: the points were corners far aside of each other.
TEST(SignedDistance, OfACoarseLevelIsThatOfItsOwnPolytope) {
  shapes::Random random(51);
  int deep = 0, shallow = 0;
  for (int i = 0; i < 150; ++i) {
    const auto boxed = [&] {
      const Vec3 side{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
      bodies::Polyhedron inner = bodies::octahedron();
      const bodies::Polyhedron box = bodies::box(side.x(), side.y(), side.z());
      for (Vec3& p : inner.points) p = p.normalized().cwiseProduct(0.9 * side);
      const LevelArrays levels[] = {inner.level(), box.level()};
      return Polyhedron{box.points, bodies::must(Model::from_levels(levels))};
    };
    const Polyhedron whole_a = boxed(), whole_b = boxed();
    const auto coarse = [](const Polyhedron& of) {
      return Polyhedron{of.points, of.model.cut({1.01 * of.model.level(1).deviation})};
    };
    const Polyhedron a = coarse(whole_a), b = coarse(whole_b);
    ASSERT_EQ(a.model.finest_level(), 1);
    // Stacked, a little askew and hardly in each other, or anywhere.
    const double up = a.points[0].cwiseAbs().z() + b.points[0].cwiseAbs().z();
    const Pose pose = i % 2 ? Pose{shapes::rotation(random.on_sphere(), 1e-7), Vec3(0.1, -0.1, up - 1e-6)}
                            : Pose{random.rotation(), 0.5 * random.in_ball()};
    const oracle::SignedTruth truth = truth_of(a, b, pose);
    const double bound = tolerance(a, b, pose), error = a.model.level(1).deviation + b.model.level(1).deviation;
    if (truth.sign > 0) continue;
    ++(truth.distance > -1e-5 ? shallow : deep);
    PairSeed seed;
    for (int round = 0; round < 3; ++round) {
      for (const Answer& s :
           {signed_distance(a, b, pose, seed), signed_distance(whole_a, whole_b, pose, {.budget = {.finest_level = 1}})}) {
        EXPECT_EQ(s.status, Status::LevelLimit) << i;
        EXPECT_NEAR(s.lower, truth.distance, bound) << i;
        EXPECT_LE(s.upper, std::max(truth.distance + error, 0.0) + error * 1e-6 + bound) << i;
        EXPECT_LE((s.point_b - s.point_a - s.normal * s.lower).norm(), 2 * bound) << i;
        EXPECT_TRUE(oracle::is_within(a.points, Points{s.point_a}, Pose{}, bound)) << i;
        EXPECT_TRUE(oracle::is_within(Points{s.point_b}, b.points, pose, bound)) << i;
        EXPECT_TRUE(oracle::is_apart_along(a.points, b.points, pose, s.normal, s.lower)) << i;
      }
      EXPECT_TRUE(check(a, b, pose, signed_distance(a, b, pose, seed))) << i;
    }
    // Of an error that is met the status is Converged, from any seed; every threshold outside of the interval is decided.
    const Answer exact = signed_distance(a, b, pose);
    for (const double relative : {0.01, 0.1, 0.5, 2.}) {
      PairSeed cold;
      for (int round = 0; round < 2; ++round) {
        const Answer s = signed_distance(a, b, pose, cold, {.relative = relative});
        const bool is_met = s.upper - s.lower <= std::max(-relative * s.upper, 0.0);
        EXPECT_EQ(s.status, is_met ? Status::Converged : Status::LevelLimit) << i << ' ' << relative;
      }
    }
    for (const double t : {exact.lower - 0.01, exact.upper, exact.upper + 1e-9, 0.0, 0.01}) {
      const Decision decision = signed_within(a, b, pose, t).decision;
      if (t < exact.lower - bound) {
        EXPECT_EQ(decision, Decision::No) << i << ' ' << t;
      }
      if (t > exact.upper + bound) {
        EXPECT_EQ(decision, Decision::Yes) << i << ' ' << t;
      }
    }
  }
  EXPECT_GE(deep, 40);
  EXPECT_GE(shallow, 70);
}

/// The threshold is minus the sum of the radii, and the hulls overlap. The bound of 0 on the hulls' distance, less the radii,
/// was rounded up past the threshold.
TEST(SignedWithin, DecidesWhereTheRadiiMakeTheThreshold) {
  const Body plate = Body::box({-0.5, -0.5, -0.1}, {0.5, 0.5, 0.1}, 0.05), rod = Body::segment({-0.5, 0, 0}, {0.5, 0, 0}, 0.2);
  for (const double t : {-0.24, -0.25, -0.26, -0.34})
    EXPECT_EQ(signed_within(plate, rod, Pose{}, t).decision, Decision::Yes) << t;
  EXPECT_EQ(signed_within(plate, rod, Pose{}, -0.36).decision, Decision::No);
}

/// Within law 2's bound of contact no depth can tell more than the distance does.
TEST(SignedWithin, OfTouchingCubesTakesWhatADistanceDoes) {
  const Polyhedron cube = body(shapes::cube());
  shapes::Random random(61);
  for (int i = 0; i < 50; ++i) {
    const Pose pose{Mat3::Identity(), {2, 2 * random.uniform(-1, 1), 2 * random.uniform(-1, 1)}};
    for (const double t : {0.0, tolerance(cube, cube, pose) / 2}) {
      const Within w = signed_within(cube, cube, pose, t);
      EXPECT_EQ(w.answer.status, Status::Converged);
      EXPECT_LE(w.answer.steps, within(cube, cube, pose, t).answer.steps);
    }
  }
}

TEST(SignedWithin, DecidesOnBothSidesOfTheThreshold) {
  for (const shapes::Family family : shapes::kFamilies) {
    const Scenery scene = scenery(family, 2000, 20, 14);
    double decided = 0, exact_work = 0;
    for (const Pose& pose : scene.poses) {
      const Answer exact = signed_distance(scene.a, scene.b, pose);
      exact_work += exact.steps + exact.plane_tests;
      for (const double part : {.5, .9, .999, 1.001, 1.1, 2.}) {
        const Within w = signed_within(scene.a, scene.b, pose, part * exact.lower);
        EXPECT_EQ(w.decision, part < 1 ? Decision::Yes : Decision::No) << part << describe(w.answer);
        EXPECT_LE(w.answer.lower, exact.upper);
        EXPECT_GE(w.answer.upper, exact.lower);
        if (part == .5) decided += w.answer.steps + w.answer.plane_tests;
      }
      EXPECT_EQ(signed_within(scene.a, scene.b, pose, .25).decision, Decision::Yes);
    }
    EXPECT_LT(decided, exact_work);
  }
}

/// Thousands of planes about as near: of 2 000 triangles more points than there is room for.
TEST(SignedDistance, IsExactWhereManyFacetsAreAsDeep) {
  for (const auto& [triangles, shift] : {std::pair(400, 0.), {400, 1e-9}, {400, 1e-3}, {2000, 0.}, {2000, 1e-2}}) {
    const shapes::Pair pair = shapes::pair(shapes::Family::Fat, std::uint32_t(triangles));
    const Polyhedron a = body(pair.a), b = body(pair.b);
    const Pose pose{bodies::rotation(.3, .2, .5, .1), {shift, 0, 0}};
    const Answer s = signed_distance(a, b, pose);
    EXPECT_EQ(s.status, Status::Converged);
    EXPECT_EQ(check(a, b, pose, s, Question::Exact).message, "");
    EXPECT_LE(s.upper - s.lower, tolerance(a, b, pose));
    EXPECT_LE((s.point_b - s.point_a - s.normal * s.lower).norm(), 2 * tolerance(a, b, pose));
    if (triangles > 400) {
      EXPECT_GT(s.steps, std::uint32_t(kDepthPoints));
    }
    std::printf("%u steps\n", s.steps);
  }
  // A prism of many sides about its own axis: all of them tie.
  const Polyhedron prism = body(shapes::prism(600, 1, 4)), turned = body(shapes::prism(500, .5, 6));
  const Answer s = signed_distance(prism, turned, Pose{});
  EXPECT_EQ(s.status, Status::Converged);
  EXPECT_NEAR(s.lower, -1.5, 1e-4);
  std::printf("%u steps\n", s.steps);
}

/// Corners that lie in a facet's plane but for rounding: seen by some facets around them and not by others.
TEST(SignedDistance, ConvergesForTouchingCubesTiltedByRounding) {
  const Polyhedron cube = body(shapes::cube());
  const ConvexView& view = cube.model.level(0).view;
  shapes::Random random(15);
  const auto feature = [&] {
    switch (random.bits() % 3) {
      case 0: return FeatureId(FeatureKind::Vertex, std::uint32_t(random.bits() % view.vertices.size()));
      case 1: return FeatureId(FeatureKind::Edge, std::uint32_t(random.bits() % view.half_edges.size()));
      default: return FeatureId(FeatureKind::Face, std::uint32_t(random.bits() % view.face_first.size()));
    }
  };
  int overlapping = 0;
  for (int i = 0; i < 800; ++i) {
    const double size = std::pow(10, random.uniform(-16, -10));
    Pose pose{shapes::rotation(random.on_sphere(), size), {0, 2, 0}};
    for (const int axis : {0, 2}) pose.translation[axis] = (double(random.bits() % 7) - 3) / 2;
    for (double& x : pose.translation) x += size * random.uniform(-1, 1);
    PairSeed seed;
    const oracle::SignedTruth truth = truth_of(cube, cube, pose);
    for (int round = 0; round < 3; ++round) {
      const Answer s = signed_distance(cube, cube, pose, seed);
      EXPECT_EQ(fault(cube, cube, pose, s, truth), "") << i << " round " << round;
      overlapping += s.verdict == Verdict::Overlapping;
      seed = PairSeed{};
      seed.a = feature(), seed.b = feature();
      seed.met = random.bits() % 2;
    }
  }
  EXPECT_GE(overlapping, 700);
}

/// A corner in the plane of two facets was seen by one of them alone, a sliver: the cone to it folded back over the other.
TEST(Regress, TouchingCubesFoldedTheirPolytope) {
  const Polyhedron cube = body(shapes::cube());
  Pose pose;
  pose.rotation << -0x1p+0, 0x1.96608eee85bc1p-46, -0x1.0b5bec5f93cadp-48,  //
      -0x1.96608eee85be1p-46, -0x1p+0, 0x1.f90be0b91664bp-46,               //
      -0x1.0b5bec5f9398bp-48, 0x1.f90be0b916665p-46, 0x1p+0;
  pose.translation = {0x1.7fffffffffffp+0, 0x1.0000000000034p+1, -0x1.000000000010ap-1};
  EXPECT_EQ(fault(cube, cube, pose, signed_distance(cube, cube, pose)), "");
}

TEST(SignedDistance, OfBodiesWithoutThicknessIsNone) {
  const Polyhedron square = body(Points{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}), cube = body(shapes::cube());
  const Polyhedron segment = body(Points{{-3, 0, 0}, {3, 0, 0}}), point = body(Points{{0, 0, 0}});
  const auto expect = [](const Polyhedron& a, const Polyhedron& b, const Pose& pose, double distance) {
    const Answer s = signed_distance(a, b, pose);
    EXPECT_EQ(fault(a, b, pose, s), "");
    EXPECT_NEAR(s.lower, distance, 1e-13);
  };
  const auto at = [](double x, double y, double z) { return Pose{Mat3::Identity(), {x, y, z}}; };
  expect(square, square, at(.5, .5, 0), 0);
  expect(square, segment, Pose{}, 0);
  expect(segment, segment, at(1, 0, 0), 0);
  expect(point, point, Pose{}, 0);
  expect(point, cube, at(.5, 0, 0), -.5);
  expect(cube, point, at(.5, 0, 0), -.5);
  expect(segment, cube, at(0, .25, 0), -.75);
  expect(square, cube, at(0, 0, .25), -.75);
}

/// A length rounded to less than 0 made the rate of a fall negative, less than that of a body that has no way at all.
TEST(Regress, SliversLedAWalkToAFaceThatIsNone) {
  const Polyhedron sliver = body({{0x1.b1044a6e5ec28p-1, -0x1.ffee1d95d0cccp-33, -0x1.88bb92d68ceccp-30},
                                  {-0x1.918e263f21cc8p-1, 0x1.afbcc5b1ddcebp-30, -0x1.2fe917504d4bcp-31},
                                  {0x1.f25ccd5000df8p-2, 0x1.908b780e21839p-29, 0x1.ffa2fafcf5f4ep-35}}),
                   point = body({{0x1.a935cf044d884p-1, -0x1.2257253ab299fp-29, -0x1.456427399b7fap-28}});
  Pose pose;
  pose.rotation << -0x1.105ccffde83cep-1, -0x1.ab5abd6bec293p-1, -0x1.240cb83b152d6p-3,  //
      0x1.6e96fd4f2998cp-3, 0x1.b860a8a51552p-5, -0x1.f6fa7390db2f8p-1,                  //
      0x1.a7bfcbc0b6e2ap-1, -0x1.18a1ee38037bep-1, 0x1.eed631ea602cp-4;
  pose.translation = {0x1.4b66df0d5eafdp-1, 0x1.d7a8114d53c8p-3, 0x1.b53baf0d71854p-3};
  EXPECT_EQ(fault(sliver, point, pose, signed_distance(sliver, point, pose)), "");

  shapes::Random random(5);
  const Pose turn{shapes::rotation(Vec3(0.3, 0.2, 0.1).normalized(), 0.7), Vec3(0.1, 0.2, 0.3)};
  const Polyhedron meshed = body(shapes::moved(shapes::meshed_cube(4), turn).points), cube = body(shapes::cube().points);
  for (int i = 0; i < 300; ++i) {
    const Pose somewhere{random.rotation(), random.in_ball() * 4};
    EXPECT_EQ(fault(meshed, cube, somewhere, signed_distance(meshed, cube, somewhere)), "") << i;
  }
}

/// Where a budget ended both distance and depth, the levels of an answer were the depth's, the points those of a coarser level.
TEST(Regress, APlatesPointLayOnAnotherLevelThanTold) {
  const double thick = 0x1p-51;
  BuildOptions two_levels;
  two_levels.cutoff = 4, two_levels.max_levels = 2;
  const Polyhedron plate =
      body({{0, 0, thick / 2}, {1, 0, thick}, {1, 0, 0}, {0, 2, thick / 2}, {0, 2, thick}, {2, 1, thick}}, two_levels);
  ASSERT_EQ(plate.model.level_count(), 2);
  shapes::Random random(8);
  int coarse = 0;
  for (int i = 0; i < 500; ++i) {
    const Body point = Body::point(random.in_ball());
    for (std::uint32_t steps = 0; steps < 6; ++steps) {
      const Answer s = signed_distance(plate, point, Pose(), {.budget = {.steps = steps}});
      ASSERT_EQ(check(plate, point, Pose(), s).message, "") << i << ' ' << steps << ' ' << describe(s);
      coarse += s.level_a == 1;
    }
  }
  EXPECT_GE(coarse, 100);
}

/// A segment across a body of a millionth of its length.
TEST(Regress, DoublesSawNoFacetOfANeedlesDifferences) {
  const Vec3 end{-0x1.3dc666fbddb4ep-2, 0x1.76f8120aa2b8fp-3, -0x1.62fb87835852dp-2};
  Points small;
  const double x = 0x1.ebe6f5e72aa4ap-21, y = 0x1.8df50d17a22c9p-20;
  for (const double i : {-1.0, 1.0}) {
    for (const double j : {-1.0, 1.0}) small.insert(small.end(), {{i * x, j * y, 0}, {i * y, 0, j * x}, {0, i * x, j * y}});
  }
  const Polyhedron segment = body({end, -end}), ball = body(small);
  Pose pose;
  pose.translation = {0x1.0e9ba6f19346ap-23, 0x1.5e253f95a7bb5p-20, 0x1.354c70fc0466fp-21};
  const Answer answer = distance(segment, ball, pose);
  EXPECT_EQ(answer.status, Status::Converged);
  EXPECT_EQ(answer.verdict, Verdict::Touching);
  EXPECT_EQ(fault(segment, ball, pose, signed_distance(segment, ball, pose)), "");
}

/// Twelve and six points of a robot's wrist, deep in each other: a facet without a neighbour was followed out of the polytope's
/// array, from a cold seed, in one of 160 000 random overlaps of real links.
TEST(Regress, DeepOverlapOfALinkWithItselfCrashed) {
  const Polyhedron a = body(Points{{-0x1.eaac824d013c7p-4, -0x1.4332256a7ab83p-2, 0x1.32ab56a53bbf1p-2},
                                   {-0x1.aa746f71a7b1p-5, -0x1.6b69fd0aa0676p-2, 0x1.1e778568bc2b8p-2},
                                   {-0x1.013eb99c1dc54p-3, -0x1.d4d85e0b9cd3cp-4, 0x1.4589c81df31d1p-2},
                                   {-0x1.9ebeab36ef0e4p-4, -0x1.13d06f66b8c34p-3, 0x1.4f7904c3b9e05p-2},
                                   {-0x1.c40129a83311cp-5, -0x1.aef284172a8c3p-4, 0x1.5cf0e596b9981p-2},
                                   {0x1.f767e0da362abp-3, -0x1.88c3a1c8bffacp-2, 0x1.954c7dd13593fp-9},
                                   {-0x1.f39b76db81e23p-3, 0x1.715c3093ff452p-2, 0x1.ae1de0cf9c479p-3},
                                   {-0x1.89a5e13a810fap-3, 0x1.7151f2d33e623p-2, 0x1.1310c5d1ff939p-2},
                                   {-0x1.75979d161a112p-3, 0x1.70f77c01ebe35p-2, 0x1.1b665c59a2e32p-2},
                                   {-0x1.124612722c5e5p-3, 0x1.78a781880b897p-2, 0x1.39ab8d6916d91p-2},
                                   {-0x1.d734f311dc7d2p-5, 0x1.715c3093ff452p-2, 0x1.569b5eb4c2991p-2},
                                   {-0x1.d4c3d56e3af35p-7, 0x1.6e51db5abbe96p-2, 0x1.5c1300f1110eep-2}}),
                   b = body(Points{{-0x1.1bae57367a263p-2, 0x1.775221c44353cp-2, 0x1.24e67c373c4d3p-3},
                                   {-0x1.11146aaecf484p-2, 0x1.775221c44353cp-2, 0x1.59d70946fbd3ap-3},
                                   {-0x1.02d9f48d7eb99p-2, 0x1.78a781880b897p-2, 0x1.8b2de092eb961p-3},
                                   {-0x1.9e846258e4be3p-3, 0x1.775221c44353cp-2, 0x1.0954bdeffd3fp-2},
                                   {-0x1.124612722c5e5p-3, 0x1.78a781880b897p-2, 0x1.39ab8d6916d91p-2},
                                   {0x1.2a2cd36db5fddp-2, 0x1.715a7b9e89c9fp-2, 0x1.3719e8e35d67fp-4}});
  Pose pose;
  pose.rotation << 0x1.e5d5a0a8d1d3cp-2, 0x1.18d8ccdd1100fp-1, 0x1.60817378817bfp-1,  //
      -0x1.21cea40f5cd74p-2, -0x1.4a8502ea2281p-1, 0x1.6b2f818043f7dp-1,              //
      0x1.aac6c73d6393bp-1, -0x1.1013b00e7f34dp-1, -0x1.35525ce7f05p-3;
  pose.translation = {-0x1.dfa3f0ac8a33p-3, 0x1.1e3ce8a03eef4p-2, 0x1.72089b9528524p-1};
  EXPECT_EQ(fault(a, b, pose, signed_distance(a, b, pose)), "");
}

/// A box about its own centre, turned by 2^-49 beyond a half turn: most facets of the difference coincide to rounding. From the
/// seed of another pose the same array was overrun.
TEST(Regress, NearlyCoincidingBoxesCrashedFromASeed) {
  bodies::Polyhedron corners;
  for (int i = 0; i < 8; ++i) corners.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 0.1 : -0.1);
  corners.add({0, 2, 3, 1}), corners.add({4, 5, 7, 6}), corners.add({0, 1, 5, 4}), corners.add({2, 6, 7, 3});
  corners.add({0, 4, 6, 2}), corners.add({1, 3, 7, 5});
  const Polyhedron box{corners.points, bodies::model(corners)};
  Pose pose;
  pose.rotation << -0x1p+0, 0x1.125f866e5e733p-51, -0x1.2d84d45571783p-49,  //
      0x1.125f866e5e735p-51, 0x1p+0, 0x1.b06a075c0b845p-50,                 //
      0x1.2d84d45571783p-49, 0x1.b06a075c0b845p-50, -0x1p+0;
  PairSeed seed;
  seed.a = {FeatureKind::Edge, 14};
  seed.b = {FeatureKind::Edge, 15};
  seed.line_in_a = {-30201, 12430, 2654};
  seed.line_in_b = {-1339, -29634, 13917};
  seed.normal = {-32752, 0, 960};
  seed.met = 1;
  EXPECT_EQ(fault(box, box, pose, signed_distance(box, box, pose, seed)), "");
}

/// The same of cubes, cold: the polytope ended without the facet that bounds the depth, NotConverged with [-2, -1.41].
TEST(Regress, NearlyCoincidingCubesEndedNotConverged) {
  const Polyhedron cube{bodies::cube().points, bodies::model(bodies::cube())};
  Pose pose;
  pose.rotation << 1, 0, 0x1.dee48b454e708p-48,  //
      -0.0, -1, 0x1.8cb3bbd819eap-49,            //
      0x1.62fb6aa8d0748p-48, 0, -1;
  EXPECT_EQ(fault(cube, cube, pose, signed_distance(cube, cube, pose)), "");
}

/// What a tolerance leaves open between apart and overlapping is one interval, and no wider than that. On level 0 a depth is
/// known exactly; without that level intervals stay open around 0.
TEST(SignedDistance, IsAsNarrowAsAskedAroundZero) {
  const shapes::Pair meshes = shapes::pair(shapes::Family::Fat, 200);
  const Polyhedron fat = body(meshes.a.points), other = body(meshes.b.points), cube = body(shapes::cube().points);
  shapes::Random random(1);
  int open = 0;
  for (int i = 0; i < 600; ++i) {
    const bool round = i % 2;
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(1.8, round ? 2.6 : 3)};
    const Polyhedron &a = round ? fat : cube, &b = round ? other : cube;
    const Answer exact = signed_distance(a, b, pose);
    for (const double error : {0.1, 0.3, 0.5, 1.0, 2.0, 5.0}) {
      for (const int level : {0, 1}) {
        const Answer s = signed_distance(a, b, pose, {.absolute = error, .budget = {.finest_level = level}});
        ASSERT_TRUE(s.status == Status::Converged || (level > 0 && s.status == Status::LevelLimit)) << i << ' ' << error;
        if (s.status == Status::Converged) {
          ASSERT_LE(s.upper - s.lower, error * (1 + 1e-12)) << i;
          open += s.lower < 0 && s.upper > 0;
        }
        ASSERT_LE(s.lower, exact.upper) << i;
        ASSERT_GE(s.upper, exact.lower) << i;
      }
    }
  }
  EXPECT_GT(open, 100);
}

/// Tetrahedra with coordinates over many decades: their differences are needles that a grid takes for a line, a distance and a
/// depth near 0 that law 2 allows each and not together.
TEST(SignedDistance, ConvergesOverManyDecadesOfCoordinates) {
  shapes::Random random(4);
  const std::vector<std::uint32_t> faces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  for (int i = 0; i < 1200; ++i) {
    const double decades = 5 + 15 * (i % 4);
    const auto small = [&] { return std::pow(10, -decades * random.uniform(0, 1)); };
    const auto tetrahedron = [&] {
      const Points corners{-small() * random.on_sphere().cwiseAbs(), small() * Vec3::UnitX(), small() * Vec3::UnitY(),
                           Vec3::UnitZ()};
      LevelArrays arrays;
      arrays.vertices = corners;
      arrays.face_vertices = faces;
      return Polyhedron{corners, bodies::must(Model::from_level(arrays))};
    };
    const Polyhedron a = tetrahedron(), b = tetrahedron();
    const Pose pose{Mat3::Identity(), small() * random.on_sphere()};
    EXPECT_EQ(fault(a, b, pose, signed_distance(a, b, pose)), "") << i;
  }
}

/// A speck at the centre of a regular tetrahedron is as deep below all four faces: whatever the search begins from, the points
/// belong to the face whose plane is answered.
TEST(SignedDistance, PointsAndPlaneBelongToOneOfEquallyDeepFaces) {
  const auto tetrahedron = [](double s) {
    const Points corners{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
    LevelArrays arrays;
    const std::vector<std::uint32_t> faces{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    arrays.vertices = corners;
    arrays.face_vertices = faces;
    return Polyhedron{corners, bodies::must(Model::from_level(arrays))};
  };
  const Polyhedron speck = tetrahedron(0x1.cd2b297d889bcp-54), whole = tetrahedron(1);
  Mat3 found;  // by the soak: nearly a quarter turn
  found << -0x1.f6a78aa5c2291p-18, -0x1.fffffffe6f12bp-1, 0x1.26b244193dd18p-16, -0x1.8d2dab38bd781p-16, 0x1.26b3070ede0e4p-16,
      0x1.fffffffc4489ap-1, -0x1.fffffffd5a1ap-1, 0x1.f6a065c5fff55p-18, -0x1.8d2e3be082035p-16;
  shapes::Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Pose pose{i == 0 ? found : random.rotation(), {0, 0, 0}};
    for (std::uint32_t f = 0; f < 4; ++f) {
      for (std::uint32_t v = 0; v < 4; ++v) {
        PairSeed seed;
        seed.met = 1;
        seed.a = {FeatureKind::Face, f}, seed.b = {FeatureKind::Vertex, v};
        const Answer s = signed_distance(speck, whole, pose, seed);
        EXPECT_EQ(fault(speck, whole, pose, s), "") << i;
        EXPECT_LE((s.point_b - s.point_a - s.lower * s.normal).norm(), 1e-14) << i;
      }
    }
  }
}

/// A corner of A just beyond the edge of B's face at its deepest: the point of the facet is the corner, not one beyond it. The
/// pose makes B 1e-10 smaller than A, about law 2's bound for such a pose.
TEST(SignedDistance, PointsBesideAFacetAreOnTheirBodies) {
  const Polyhedron coin = body(shapes::prism(12, 1, 0.5));
  shapes::Random random(12);
  for (int i = 0; i < 30; ++i) {
    Pose pose{Mat3::Identity(), {0, 0, 0}};
    for (double& entry : pose.rotation.reshaped()) entry += random.uniform(-1e-11, 1e-11);
    pose.rotation.diagonal() -= Vec3(random.uniform(0, 1e-10), random.uniform(0, 1e-10), random.uniform(0, 1e-10));
    const oracle::SignedTruth truth = truth_of(coin, coin, pose);
    for (std::uint32_t f = 0; f < coin.model.level(0).view.face_first.size(); ++f) {
      for (std::uint32_t v = 0; v < 24; ++v) {
        PairSeed seed;
        seed.met = 1;
        seed.a = {FeatureKind::Vertex, v}, seed.b = {FeatureKind::Face, f};
        seed.normal = {0, 0, -32767};
        EXPECT_EQ(fault(coin, coin, pose, signed_distance(coin, coin, pose, seed), truth), "") << i << ' ' << f << ' ' << v;
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet
