// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Batches of mesh queries over many pairs, or over one pair in many poses. The answers equal those of the same queries asked
// one after the other, bit for bit, however many threads there are.
#pragma once

#include <span>

#include <swiftlet/batch.h>
#include <swiftlet/mesh_query.h>

namespace swiftlet {

/// One pair of a batch.
struct MeshPairQuery {
  MeshBody a, b;             ///< pairs may share meshes
  Pose b_in_a;               ///< maps B's frame into A's
  MeshSeed* seed = nullptr;  ///< no two pairs of a batch may share a seed; null: the query starts cold
};

// Each query over pairs writes the answer of pairs[i] to answers[i]; `answers` must be at least as long as `pairs`. A task is
// 32 pairs.

/// Asks `distance` for each pair.
void distance(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Options& options = {},
              const Run& run = {});
/// Asks `intersects` for each pair.
void intersects(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Effort& effort = {},
                const Run& run = {});
/// Asks `within` for each pair.
void within(std::span<const MeshPairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
            const Run& run = {});
/// Asks `signed_distance` for each pair.
void signed_distance(std::span<const MeshPairQuery> pairs, std::span<Answer> answers, const Options& options = {},
                     const Run& run = {});
/// Asks `signed_within` for each pair.
void signed_within(std::span<const MeshPairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
                   const Run& run = {});
/// Asks `closest_features` for each pair.
void closest_features(std::span<const MeshPairQuery> pairs, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options = {}, const Run& run = {});

// Each query of one pair over poses writes the answer in pose b_in_a[i] to answers[i]; `answers` must be at least as long as
// `b_in_a`. A task is a chunk of `kPosesPerChunk` poses, within which each query starts from the seed of the one before.

/// Asks `distance` in each pose.
void distance(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
              const Options& options = {}, const Run& run = {});
/// Asks `intersects` in each pose.
void intersects(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                const Effort& effort = {}, const Run& run = {});
/// Asks `within` in each pose.
void within(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
            const Effort& effort = {}, const Run& run = {});
/// Asks `signed_distance` in each pose.
void signed_distance(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                     const Options& options = {}, const Run& run = {});
/// Asks `signed_within` in each pose.
void signed_within(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, double threshold,
                   std::span<Within> answers, const Effort& effort = {}, const Run& run = {});
/// Asks `closest_features` in each pose.
void closest_features(const MeshBody& a, const MeshBody& b, std::span<const Pose> b_in_a, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options = {}, const Run& run = {});

}  // namespace swiftlet
