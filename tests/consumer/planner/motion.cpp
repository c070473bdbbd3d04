// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion.h"

#include <algorithm>

namespace planner {

using swiftlet::Answer;
using swiftlet::Body;
using swiftlet::Model;
using swiftlet::Options;
using swiftlet::PairSeed;
using swiftlet::Pose;

/// A lower bound on how far the link is from the obstacle's margin, any that is above `enough`; 0 where that is at most
/// `kLeastRoom`.
double Motions::room(const Model& link, const Obstacle& obstacle, const Pose& link_in_world, double enough, PairSeed& seed) {
  const Body padded(obstacle.model, kMargin);
  const Pose obstacle_in_link = swiftlet::relative(link_in_world, obstacle.in_world);
  Options options{.relative = precision_.tolerance};
  if (precision_.only_nearest) options.beyond = std::max(enough, kLeastRoom);
  Answer answer = swiftlet::distance(link, padded, obstacle_in_link, seed, options);
  count(answer);
  if (answer.lower <= kLeastRoom && answer.upper > kLeastRoom) {
    options.relative = 0;
    answer = swiftlet::refine(link, padded, obstacle_in_link, answer, seed, options);
    ++cost_.refined;
    count(answer);
  }
  return answer.lower > kLeastRoom ? answer.lower : 0;
}

bool Motions::are_free(const Angles& from, const Angles& to) {
  const auto ways = longest_ways(from, to);
  for (double done = 0; done < 1;) {
    Angles angles;
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = from[i] + done * (to[i] - from[i]);
    const auto in_world = links_in_world(angles);
    double safe = 1;  // the share of the way that no link can get into a margin on
    for (std::size_t pair = 0; pair < seeds_.size(); ++pair) {
      const std::size_t k = pair % 2;
      const double free = room(scene_.link[k], scene_.obstacles[pair / 2], in_world[k], safe * ways[k], seeds_[pair]);
      if (free == 0) return false;
      safe = std::min(safe, free / ways[k]);  // infinite where the link rests
    }
    done += safe;
  }
  return true;
}

void Motions::count(const Answer& answer) {
  ++cost_.queries;
  cost_.steps += answer.steps;
  cost_.plane_tests += answer.plane_tests;
}

}  // namespace planner
