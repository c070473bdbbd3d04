// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// OMPL plans ways for an arm, swiftlet says which motions are free. Then the same motions are asked at other tolerances: prints
// what each costs, and on standard error how long it takes; ends with 1 where a motion that was found free is not, or where
// tolerance saves nothing.
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "arm.h"
#include "motion.h"

namespace planner {
namespace {

namespace ob = ompl::base;
using Space = ob::RealVectorStateSpace;
using Way = std::pair<Angles, Angles>;

constexpr Precision kPrecisions[] = {{0, false}, {0.01, false}, {0.1, false}, {1, false}, {0, true}, {0.1, true}, {1, true}};

Angles angles_of(const ob::State* state) {
  const double* const values = state->as<Space::StateType>()->values;
  return {values[0], values[1], values[2]};
}

/// What the planner asks, answered and noted.
class Validator final : public ob::MotionValidator {
 public:
  Validator(const ob::SpaceInformationPtr& space, Motions& motions, std::vector<Way>& asked)
      : ob::MotionValidator(space), motions_(motions), asked_(asked) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    asked_.push_back({angles_of(from), angles_of(to)});
    return motions_.are_free(asked_.back().first, asked_.back().second);
  }
  /// Also how far it is free: not at all.
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    last.second = 0;
    if (last.first) si_->copyState(last.first, from);
    return checkMotion(from, to);
  }

 private:
  Motions& motions_;
  std::vector<Way>& asked_;
};

/// Plans `count` ways between random free angles; returns the motions that were asked for, and how many ways were found.
std::pair<std::vector<Way>, int> plan(const Scene& scene, int count) {
  std::vector<Way> asked;
  Motions motions(scene);
  const auto joints = std::make_shared<Space>(3);
  joints->setBounds(-EIGEN_PI, EIGEN_PI);
  const auto space = std::make_shared<ob::SpaceInformation>(joints);
  space->setStateValidityChecker([&](const ob::State* s) { return motions.are_free(angles_of(s), angles_of(s)); });
  space->setMotionValidator(std::make_shared<Validator>(space, motions, asked));
  space->setup();
  const auto sampler = space->allocValidStateSampler();
  int found = 0;
  for (int i = 0; i < count; ++i) {
    ob::ScopedState<> start(space), goal(space);
    if (!sampler->sample(start.get()) || !sampler->sample(goal.get())) continue;
    const auto problem = std::make_shared<ob::ProblemDefinition>(space);
    problem->setStartAndGoalStates(start, goal);
    ompl::geometric::RRTConnect planner(space);
    planner.setProblemDefinition(problem);
    found += planner.solve(ob::timedPlannerTerminationCondition(10)) == ob::PlannerStatus::EXACT_SOLUTION;
  }
  return {asked, found};
}

/// Whether no link meets an obstacle at any of many places on the way, by itself, exactly.
bool is_free_by_samples(const Scene& scene, const Way& way) {
  constexpr int kSamples = 50;
  for (int i = 0; i <= kSamples; ++i) {
    Angles angles;
    for (std::size_t k = 0; k < 3; ++k) angles[k] = way.first[k] + (way.second[k] - way.first[k]) * i / kSamples;
    const auto in_world = links_in_world(angles);
    for (const Obstacle& obstacle : scene.obstacles) {
      for (std::size_t k = 0; k < 2; ++k) {
        const swiftlet::Body padded(obstacle.model, Motions::kMargin);
        const auto pose = swiftlet::relative(in_world[k], obstacle.in_world);
        if (swiftlet::intersects(scene.link[k], padded, pose).verdict != swiftlet::Verdict::Disjoint) return false;
      }
    }
  }
  return true;
}

struct Replay {
  std::vector<bool> free;
  Cost cost;
  double seconds = 0;
  double work() const { return double(cost.steps + cost.plane_tests); }
};
Replay replay(const Scene& scene, const std::vector<Way>& ways, const Precision& precision) {
  Replay result;
  Motions motions(scene, precision);
  const auto begin = std::chrono::steady_clock::now();
  for (const Way& way : ways) result.free.push_back(motions.are_free(way.first, way.second));
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.cost = motions.cost();
  return result;
}

}  // namespace
}  // namespace planner

int main() {
  using namespace planner;
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
  const Scene scene = make_scene();
  constexpr int kPlans = 50;
  const auto [ways, found] = plan(scene, kPlans);
  std::fprintf(stderr, "%d of %d ways found, %zu motions\n", found, kPlans, ways.size());
  bool right = found >= kPlans / 2;
  const Replay exact = replay(scene, ways, kPrecisions[0]);
  std::printf("tolerance  asked of         queries  refined  steps + plane tests a query\n");
  std::string times;
  for (const Precision& precision : kPrecisions) {
    const Replay run = replay(scene, ways, precision);
    int otherwise = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      otherwise += run.free[i] != exact.free[i];
      right = right && (!run.free[i] || i % 8 != 0 || is_free_by_samples(scene, ways[i]));
    }
    std::printf("%7g %%  %-15s %8" PRIu64 " %8" PRIu64 " %28.1f\n", 100 * precision.tolerance,
                precision.only_nearest ? "what is nearest" : "all pairs", run.cost.queries, run.cost.refined,
                run.work() / double(run.cost.queries));
    times += " " + std::to_string(std::lround(1e9 * run.seconds / double(run.cost.queries)));
    right = right && otherwise == 0;
    right = right && (precision.tolerance < 0.1 || run.work() < 0.9 * exact.work());
    right = right && (precision.tolerance < 1 || precision.only_nearest || run.cost.refined > 0);
    right = right && (!precision.only_nearest || run.work() < 0.5 * exact.work());
  }
  std::fprintf(stderr, "ns a query, row by row:%s\n", times.c_str());
  return right ? 0 : 1;
}
