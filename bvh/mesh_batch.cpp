// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Batches of mesh queries, cut into tasks as those of convex bodies are. Knows no algorithm of a query.
#include <swiftlet/mesh_batch.h>

#include "query/run.h"

namespace swiftlet {
namespace {

template <class AnyAnswer, class Ask>
void over_pairs(std::span<const MeshPairQuery> pairs, std::span<AnyAnswer> answers, const Run& run, Ask ask) {
  assert(answers.size() >= pairs.size());
  const auto ask_some = [&](std::size_t task) {
    const std::size_t first = task * kPairsPerTask, end = std::min(first + kPairsPerTask, pairs.size());
    for (std::size_t i = first; i < end; ++i) {
      MeshSeed cold;
      answers[i] = ask(pairs[i].a, pairs[i].b, pairs[i].b_in_a, pairs[i].seed ? *pairs[i].seed : cold);
    }
  };
  run_all((pairs.size() + kPairsPerTask - 1) / kPairsPerTask, run, ask_some);
}

// Each query of one pair, as a function of what differs within a batch.
auto asking_distance(const Options& options) {
  return [options = alone(options)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return distance(a, b, pose, seed, options);
  };
}
auto asking_intersects(const Effort& effort) {
  return [effort = alone(effort)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return intersects(a, b, pose, seed, effort);
  };
}
auto asking_within(double threshold, const Effort& effort) {
  return [threshold, effort = alone(effort)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return within(a, b, pose, threshold, seed, effort);
  };
}
auto asking_signed_distance(const Options& options) {
  return [options = alone(options)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return signed_distance(a, b, pose, seed, options);
  };
}
auto asking_signed_within(double threshold, const Effort& effort) {
  return [threshold, effort = alone(effort)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return signed_within(a, b, pose, threshold, seed, effort);
  };
}
auto asking_closest(const ClosestOptions& options) {
  return [options = alone(options)](const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed) {
    return closest_features(a, b, pose, seed, options);
  };
}
/// The same of one pair.
template <class Ask>
auto of(const MeshBody& a, const MeshBody& b, Ask ask) {
  return [&a, &b, ask](const Pose& pose, MeshSeed& seed) { return ask(a, b, pose, seed); };
}

}  // namespace

void distance(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Options& options, const Run& run) {
  over_pairs(pairs, answers, run, asking_distance(options));
}
void intersects(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Effort& effort, const Run& run) {
  over_pairs(pairs, answers, run, asking_intersects(effort));
}
void within(std::span<const MeshPairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort,
            const Run& run) {
  over_pairs(pairs, answers, run, asking_within(threshold, effort));
}
void signed_distance(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Options& options, const Run& run) {
  over_pairs(pairs, answers, run, asking_signed_distance(options));
}
void signed_within(std::span<const MeshPairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort,
                   const Run& run) {
  over_pairs(pairs, answers, run, asking_signed_within(threshold, effort));
}
void closest_features(std::span<const MeshPairQuery> pairs, std::span<ClosestFeatures> answers, const ClosestOptions& options,
                      const Run& run) {
  over_pairs(pairs, answers, run, asking_closest(options));
}

void distance(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
              const Options& options, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_distance(options)));
}
void intersects(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                const Effort& effort, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_intersects(effort)));
}
void within(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
            const Effort& effort, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_within(threshold, effort)));
}
void signed_distance(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                     const Options& options, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_signed_distance(options)));
}
void signed_within(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, double threshold,
                   std::span<Within> answers, const Effort& effort, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_signed_within(threshold, effort)));
}
void closest_features(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options, const Run& run) {
  over_poses<MeshSeed>(b_in_a, answers, run, of(a, b, asking_closest(options)));
}

}  // namespace swiftlet
