// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Law 8 of meshes under many threads: shared meshes, with hulls and without, whole and cut; seeds of one's own; the bits of one
// thread, alone and in batches. Run by ./run threads under the thread sanitizer.
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_contacts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "answers.h"
#include "soups.h"

namespace swiftlet {
namespace {

constexpr std::size_t kThreads = 6;
constexpr std::size_t kPoses = 24;

using Fields = std::vector<std::uint64_t>;

/// The first has hulls of its nodes, which the builder has made: a torus of 16 times 8 quads, `rebuild_hulls` with 8 triangles
/// at least, any level and any number of bytes.
const std::vector<MeshModel>& meshes() {
  static const std::vector<MeshModel> all = [] {
    std::vector<MeshModel> made{map_mesh(SWIFTLET_TEST_DIR "/data/meshes/hulled.swm").value(), soups::ball(2).mesh(),
                                soups::box({-1, -0.75, -0.5}, {1, 0.75, 0.5}).mesh()};
    shapes::Random random(3);
    made.push_back(soups::tangled(random, 12, 30).mesh());
    made.push_back(made[0].cut({.deviation = 1e9}));
    return made;
  }();
  return all;
}

/// What one seed lives through.
struct Motion {
  MeshBody a, b;
  std::vector<Pose> poses;
};
const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = [] {
    std::vector<Motion> made;
    answers::Poses poses(12);
    for (const MeshModel& a : meshes()) {
      for (const MeshModel& b : meshes()) {
        const bool solid = made.size() % 3 == 0 && b.is_whole() && b.topology().closed();
        made.push_back({a, solid ? MeshBody::solid(b, 0.0625) : MeshBody(b), {}});
        for (std::size_t i = 0; i < kPoses; ++i) made.back().poses.push_back(poses.next());
      }
    }
    made.push_back({meshes()[0], Body::box({-1, -0.5, -0.25}, {1, 0.5, 0.25}), made.front().poses});
    return made;
  }();
  return all;
}

Fields fields_of(const Answer& answer) {
  Fields fields;
  answers::append(answer, fields);
  return fields;
}

/// The i-th question of a motion.
Fields ask(const Motion& m, std::size_t i, MeshSeed& seed) {
  const Pose& pose = m.poses[i];
  switch (i % 6) {
    case 0: return fields_of(distance(m.a, m.b, pose, seed));
    case 1: return fields_of(intersects(m.a, m.b, pose, seed));
    case 2: return fields_of(within(m.a, m.b, pose, 0.25, seed).answer);
    case 3: return fields_of(closest_features(m.a, m.b, pose, seed).answer);
    case 4: return fields_of(signed_distance(m.a, m.b, pose, seed));
    default: break;
  }
  std::array<MeshContact, 4> regions;
  const MeshContacts found = contacts(m.a, m.b, pose, 0.25, regions);
  Fields fields{std::uint64_t(found.status), found.count, found.steps, found.plane_tests};
  for (std::uint32_t k = 0; k < found.stored; ++k) {
    const Manifold points = manifold(m.a, m.b, pose, regions[k], {.margin = 0.25});
    fields.insert(fields.end(), {regions[k].triangle_a, regions[k].triangle_b, points.count});
  }
  return fields;
}

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#define SWIFTLET_NEEDS_THREADS() GTEST_SKIP() << "there are no threads here"
#else
#define SWIFTLET_NEEDS_THREADS() static_assert(true)
#endif

class MeshThreads : public testing::Test {
 protected:
  MeshThreads() {
    for (const MeshModel& mesh : meshes()) hashes_.push_back(mesh.hash());
  }
  ~MeshThreads() override {  // a query that writes into a shared mesh
    for (std::size_t i = 0; i < meshes().size(); ++i) EXPECT_EQ(meshes()[i].hash(), hashes_[i]);
  }
  std::vector<std::uint64_t> hashes_;
};

TEST_F(MeshThreads, OneOfThemHasHullsAndOneWasCut) {
  EXPECT_GE(meshes()[0].hull_count(), 10u);
  EXPECT_FALSE(meshes()[4].is_whole());
}

TEST_F(MeshThreads, WarmQueriesOfInterleavedMotionsAnswerAsOneThread) {
  SWIFTLET_NEEDS_THREADS();
  std::vector<std::vector<Fields>> expected;
  for (const Motion& motion : motions()) {
    MeshSeed seed;
    expected.emplace_back();
    for (std::size_t i = 0; i < kPoses; ++i) expected.back().push_back(ask(motion, i, seed));
  }
  std::atomic<int> different{0}, asked{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 engine{std::uint32_t(t)};
      std::vector<MeshSeed> seeds(motions().size());
      std::vector<std::size_t> next(motions().size(), 0), open(motions().size());
      for (std::size_t m = 0; m < open.size(); ++m) open[m] = m;
      while (!open.empty()) {  // any motion's next question
        const std::size_t at = engine() % open.size(), m = open[at], i = next[m]++;
        const MeshModel kept = meshes()[m % meshes().size()];  // counts of owners change while others ask
        different += ask(motions()[m], i, seeds[m]) != expected[m][i] || kept.node_count() == 0;
        ++asked;
        if (next[m] == kPoses) open.erase(open.begin() + std::ptrdiff_t(at));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, 0);
  EXPECT_EQ(asked, int(kThreads * motions().size() * kPoses));
}

void backwards(std::size_t count, const std::function<void(std::size_t)>& task) {
  while (count > 0) task(--count);
}
std::vector<Executor> executors() {
  return {Executor{}, on_threads(1), on_threads(3), on_threads(unsigned(kThreads)), backwards};
}

/// Warm and cold pairs, frame after frame, and all poses of one pair.
TEST_F(MeshThreads, BatchesAnswerAsOneAfterTheOther) {
  for (const Executor& executor : executors()) {
    std::vector<MeshSeed> seeds(motions().size()), own(motions().size());
    for (std::size_t i = 0; i < kPoses; i += 3) {
      std::vector<MeshPairQuery> pairs;
      for (std::size_t m = 0; m < motions().size(); ++m) {
        pairs.push_back({motions()[m].a, motions()[m].b, motions()[m].poses[i], &seeds[m]});
        pairs.push_back({motions()[m].b, motions()[m].a, motions()[m].poses[i], nullptr});
      }
      std::vector<Answer> answers(pairs.size());
      const bool is_signed = i % 2;
      if (is_signed)
        signed_distance(pairs, answers, {.relative = 0.01}, {executor});
      else
        distance(pairs, answers, {}, {executor});
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        MeshSeed cold;
        MeshSeed& seed = k % 2 ? cold : own[k / 2];
        const MeshPairQuery& q = pairs[k];
        const Answer alone =
            is_signed ? signed_distance(q.a, q.b, q.b_in_a, seed, {.relative = 0.01}) : distance(q.a, q.b, q.b_in_a, seed);
        ASSERT_EQ(fields_of(answers[k]), fields_of(alone)) << "pose " << i << ", pair " << k;
      }
    }
    std::vector<Pose> poses;
    answers::Poses more(13);
    for (std::size_t i = 0; i < kPosesPerChunk + 20; ++i) poses.push_back(more.next());
    std::vector<Answer> answers(poses.size());
    const MeshBody a = meshes()[0], b = meshes()[1];
    distance(a, b, poses, answers, {}, {executor});
    MeshSeed seed;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i % kPosesPerChunk == 0) seed = {};
      ASSERT_EQ(fields_of(answers[i]), fields_of(distance(a, b, poses[i], seed))) << i;
    }
  }
}

}  // namespace
}  // namespace swiftlet
