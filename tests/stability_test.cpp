// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every stored hard pair, asked every way; and the judge itself, against answers that are wrong on purpose.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include <swiftlet/build.h>

#include "isolated.h"
#include "judge.h"
#include "shapes.h"
#include "suite.h"
#include "trial.h"

namespace swiftlet::stability {
namespace {

TEST(Stability, SwiftletFailsNoStoredCase) {
  std::uint64_t answers = 0;
  std::uint32_t most_steps = 0;
  for (const auto& path : suite_files()) {
    for (const Case& c : read_cases(path)) {
      const Findings findings = ask_swiftlet(c, problems_of(c));
      EXPECT_FALSE(findings.failed()) << path.filename() << " " << c.name << ": " << findings.first_fault;
      answers += findings.answers;
      most_steps = std::max(most_steps, findings.most_steps);
    }
  }
  std::printf("%llu answers judged, most steps %u\n", static_cast<unsigned long long>(answers), most_steps);
  EXPECT_GE(answers, 187u * 1000u);
}

// ---- The judge --------------------------------------------------------------------------------------------------------------

/// Two cubes `gap` apart, or overlapping by -gap, a right answer, and what the judge says when it is bent.
class CaseJudge : public testing::Test {
 protected:
  static Case cubes(double gap) {
    Case c;
    c.name = "cubes";
    c.category = {"test"};
    c.a = c.b = shapes::cube().points;
    c.b_in_world.translation = {2 + gap, .25, .125};
    return c;
  }

  template <class Bend>
  Fault of_bent(double gap, Bend bend) const {
    const Problem p = problem_of(cubes(gap));
    PairSeed seed;
    Answer answer = distance(model_, model_, p.b_in_a, seed);
    bend(answer);
    return judge_exact(p, model_, model_, answer, {}).fault;
  }
  Fault of_within(double gap, double threshold, Decision decision) const {
    const Problem p = problem_of(cubes(gap));
    PairSeed seed;
    Within answer = within(model_, model_, p.b_in_a, threshold, seed);
    answer.decision = decision;
    return judge_within(p, model_, model_, threshold, answer, {}).fault;
  }

  Model model_ = build(shapes::cube()).value().model;
};

TEST_F(CaseJudge, PassesWhatIsRight) {
  for (const double gap : {1., 1e-6, 1e-14, 0., -1e-14, -1e-6, -1.}) {
    EXPECT_EQ(of_bent(gap, [](Answer&) {}), Fault::None) << gap;
  }
  EXPECT_EQ(of_within(1, 2, Decision::Yes), Fault::None);
  EXPECT_EQ(of_within(1, .5, Decision::No), Fault::None);
  EXPECT_EQ(of_within(1, 1, Decision::Undecided), Fault::None);
}

TEST_F(CaseJudge, CatchesADistanceOffByAMillionth) {
  for (const double off : {1e-6, -1e-6, 1e-12, -1e-12}) {
    const auto shift = [&](Answer& a) {
      a.lower += off;
      a.upper += off;
      a.point_b += off * a.normal;
    };
    EXPECT_EQ(of_bent(1, shift), Fault::WrongDistance) << off;
  }
}

TEST_F(CaseJudge, CatchesALyingInterval) {
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.lower = a.upper = 1 + 0x1p-52; }), Fault::WrongDistance);
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.lower = a.upper = 1 - 0x1p-53; }), Fault::WrongDistance);
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.upper += 1e-12; }), Fault::WrongDistance) << "true but too wide";
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.normal = {0, 1, 0}; }), Fault::WrongDistance) << "no certificate";
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.point_a.y() += 3; }), Fault::WrongDistance) << "beside the body";
}

TEST_F(CaseJudge, CatchesAWrongVerdict) {
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.verdict = Verdict::Touching; }), Fault::WrongDistance) << "against its own interval";
  for (const Verdict v : {Verdict::Touching, Verdict::Undecided, Verdict::Disjoint}) {
    for (const double gap : {-1e-6, -1.}) {
      const auto bend = [&](Answer& a) { a.verdict = v; };
      EXPECT_NE(of_bent(gap, bend), Fault::None) << int(v) << " at " << gap;
    }
  }
  EXPECT_NE(of_bent(1e-6, [](Answer& a) { a.verdict = Verdict::Undecided; }), Fault::None);
  EXPECT_EQ(of_within(1, 2, Decision::No), Fault::WrongVerdict);
  EXPECT_EQ(of_within(1, .5, Decision::Yes), Fault::WrongVerdict);
  EXPECT_EQ(of_within(1, 1 + 1e-12, Decision::Undecided), Fault::WrongVerdict);
}

TEST_F(CaseJudge, CatchesNoAnswer) {
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.status = Status::NotConverged; }), Fault::NotConverged);
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.status = Status::Budget; }), Fault::NotConverged);
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.lower = std::numeric_limits<double>::quiet_NaN(); }), Fault::NoNumber);
  EXPECT_EQ(of_bent(1, [](Answer& a) { a.normal.x() = std::numeric_limits<double>::infinity(); }), Fault::NoNumber);
}

TEST(Isolated, OutlivesWhatHangsCrashesAndThrows) {
  const Findings hung = isolated(1, []() -> Findings {
    for (;;) pause();
  });
  EXPECT_TRUE(hung.not_terminated && hung.failed());
  EXPECT_TRUE(isolated(9, []() -> Findings { std::abort(); }).no_number);
  const Findings thrown = isolated(9, []() -> Findings { throw std::runtime_error("origin outside"); });
  EXPECT_TRUE(thrown.no_number);
  EXPECT_STREQ(thrown.first_fault, "exception: origin outside");
  const Findings fine = isolated(9, [] {
    Findings f;
    f.answers = 3;
    return f;
  });
  EXPECT_FALSE(fine.failed());
  EXPECT_EQ(fine.answers, 3u);
}

}  // namespace
}  // namespace swiftlet::stability
