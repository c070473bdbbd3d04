// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The queries: of one pair, of many, and of one pair in many poses. Two convex bodies are asked by march, all others by bvh.
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

#include <swiftlet/batch.h>
#include <swiftlet/depth.h>
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/query.h>

#include "convert.h"

using namespace swiftlet;
using namespace swiftlet::c;

namespace {

constexpr std::size_t kPairsPerTask = 32;  // as batch.h says
static_assert(SWIFTLET_POSES_PER_CHUNK == kPosesPerChunk);

// ---- Options ---------------------------------------------------------------------------------------------------------------

swiftlet_options default_options() {
  const Options from;
  return {sizeof(swiftlet_options), 0, from.absolute, from.relative, from.beyond, plain(from.budget), plain(from.tuning)};
}
swiftlet_effort default_effort() {
  const Effort from;
  return {sizeof(swiftlet_effort), 0, plain(from.budget), plain(from.tuning)};
}
swiftlet_closest_options default_closest_options() {
  const ClosestOptions from;
  return {sizeof(swiftlet_closest_options), from.steps, from.beyond, plain(from.tuning)};
}

/// Options as C++ has them, and what the caller wants reported.
struct AskedOptions {
  swiftlet_options room;
  const swiftlet_tuning* report = nullptr;
  Options options;
  explicit AskedOptions(const swiftlet_options* given) {
    if (!given) return;
    room = default_options();
    const swiftlet_options& from = read(given, room, "options");
    report = &from.tuning;
    options = {from.absolute, from.relative, from.beyond, budget_of(from.budget), tuning_of(from.tuning)};
  }
};
struct AskedEffort {
  swiftlet_effort room;
  const swiftlet_tuning* report = nullptr;
  Effort options;
  explicit AskedEffort(const swiftlet_effort* given) {
    if (!given) return;
    room = default_effort();
    const swiftlet_effort& from = read(given, room, "effort");
    report = &from.tuning;
    options = {budget_of(from.budget), tuning_of(from.tuning)};
  }
};
struct AskedClosest {
  swiftlet_closest_options room;
  const swiftlet_tuning* report = nullptr;
  ClosestOptions options;
  explicit AskedClosest(const swiftlet_closest_options* given) {
    if (!given) return;
    room = default_closest_options();
    const swiftlet_closest_options& from = read(given, room, "options");
    report = &from.tuning;
    options = {from.beyond, from.steps, tuning_of(from.tuning)};
  }
};

// ---- Queries: `one` pair, of march or bvh, and `many` ----------------------------------------------------------------------

struct Distance : AskedOptions {
  using Result = Answer;
  using AskedOptions::AskedOptions;
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const { return distance(a, b, pose, seed, options); }
  void many(auto pairs, auto answers) const { distance(pairs, answers, options); }
};
struct SignedDistance : AskedOptions {
  using Result = Answer;
  using AskedOptions::AskedOptions;
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const {
    return signed_distance(a, b, pose, seed, options);
  }
  void many(auto pairs, auto answers) const { signed_distance(pairs, answers, options); }
};
struct Intersects : AskedEffort {
  using Result = Answer;
  using AskedEffort::AskedEffort;
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const { return intersects(a, b, pose, seed, options); }
  void many(auto pairs, auto answers) const { intersects(pairs, answers, options); }
};
struct IsWithin : AskedEffort {
  using Result = Within;
  double threshold;
  IsWithin(double t, const swiftlet_effort* effort) : AskedEffort(effort), threshold(t) {}
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const {
    return within(a, b, pose, threshold, seed, options);
  }
  void many(auto pairs, auto answers) const { within(pairs, threshold, answers, options); }
};
struct IsSignedWithin : AskedEffort {
  using Result = Within;
  double threshold;
  IsSignedWithin(double t, const swiftlet_effort* effort) : AskedEffort(effort), threshold(t) {}
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const {
    return signed_within(a, b, pose, threshold, seed, options);
  }
  void many(auto pairs, auto answers) const { signed_within(pairs, threshold, answers, options); }
};
struct Closest : AskedClosest {
  using Result = ClosestFeatures;
  using AskedClosest::AskedClosest;
  auto one(const auto& a, const auto& b, const Pose& pose, auto& seed) const {
    return closest_features(a, b, pose, seed, options);
  }
  void many(auto pairs, auto answers) const { closest_features(pairs, answers, options); }
};

// ---- Where answers go ------------------------------------------------------------------------------------------------------

/// An array of sized structs of the caller's, or null.
template <class T>
class Outputs {
 public:
  Outputs() = default;
  Outputs(T* first, const char* name, std::size_t least) : first_(first), stride_(first ? first->size : 0) {
    check_output(first, name, least);
  }
  void put(std::size_t i, const auto& result) const {
    if (first_) write_bytes(plain(result), stride_, reinterpret_cast<char*>(first_) + i * stride_);
  }

 private:
  T* first_ = nullptr;
  std::size_t stride_ = 0;
};

/// As the header calls them: of one pair `answer`, of many `answers`.
enum class Count : bool { One, Many };

struct AnswersOnly {
  Outputs<swiftlet_answer> answers;
  AnswersOnly(Count count, swiftlet_answer* to) : answers(to, name(count), kLeast) { need(to, name(count)); }
  void put(std::size_t i, const Answer& answer) const { answers.put(i, answer); }

  static const char* name(Count count) { return count == Count::One ? "answer" : "answers"; }
  static constexpr std::size_t kLeast = offsetof(swiftlet_answer, normal);
};

struct Decisions {
  std::int32_t* decisions;
  Outputs<swiftlet_answer> answers;
  Decisions(Count count, std::int32_t* to, swiftlet_answer* answers_or_null)
      : decisions(to), answers(answers_or_null, AnswersOnly::name(count), AnswersOnly::kLeast) {
    need(to, count == Count::One ? "decision" : "decisions");
  }
  void put(std::size_t i, const Within& within) const {
    decisions[i] = std::int32_t(within.decision);
    answers.put(i, within.answer);
  }
};

struct Features {
  AnswersOnly answers;
  Outputs<swiftlet_source> sources_a, sources_b;
  Features(Count count, swiftlet_answer* to, swiftlet_source* a, swiftlet_source* b)
      : answers(count, to),
        sources_a(a, count == Count::One ? "source_a" : "sources_a", sizeof(swiftlet_source)),
        sources_b(b, count == Count::One ? "source_b" : "sources_b", sizeof(swiftlet_source)) {}
  void put(std::size_t i, const ClosestFeatures& found) const {
    answers.put(i, found.answer);
    sources_a.put(i, found.source_a);
    sources_b.put(i, found.source_b);
  }
};

const Answer& answer_in(const Answer& answer) { return answer; }
const Answer& answer_in(const auto& result) { return result.answer; }

// ---- One pair --------------------------------------------------------------------------------------------------------------

template <class Query>
void ask(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, swiftlet_seed* seed, Query&& query,
         const auto& to) {
  const GivenBody body_a(a, "a"), body_b(b, "b");
  const Pose pose = pose_of(b_in_a);
  const Report report(query.report, query.options.tuning);
  const auto ask_of = [&](const auto& one, const auto& other, auto kept) {
    const auto result = query.one(one, other, pose, kept);
    keep(kept, seed);
    report.hand_out(answer_in(result));
    to.put(0, result);
  };
  if (body_a.is_mesh() || body_b.is_mesh()) {
    const MeshBody one = body_a.mesh(), other = body_b.mesh();
    return ask_of(one, other, seed_of<MeshSeed>(seed));
  }
  const Body one = body_a.convex(), other = body_b.convex();
  ask_of(one, other, seed_of<PairSeed>(seed));
}

// ---- Many ------------------------------------------------------------------------------------------------------------------

/// Runs task(0) to task(count - 1) as the caller wants, and puts what stands for no answer where one was not run.
void run_all(std::size_t count, const swiftlet_run* given, const auto& task, const auto& skip) {
  swiftlet_run room{};
  const swiftlet_run& run = given ? read(given, room, "run") : room;
  std::vector<std::atomic<bool>> done(count);
  std::atomic<bool> stopped = false;
  const auto unless_stopped = [&](std::size_t i) {
    if (run.stop && (stopped || run.stop(run.stop_data))) {
      stopped = true;
      return;
    }
    task(i);
    done[i] = true;
  };
  if (run.executor)
    run.executor->execute(count, unless_stopped);
  else
    for (std::size_t i = 0; i < count; ++i) unless_stopped(i);
  bool is_whole = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (done[i]) continue;
    is_whole = false;
    skip(i);
  }
  if (is_whole) return;
  if (stopped) throw Failure{SWIFTLET_CANCELLED, swiftlet_code_text(SWIFTLET_CANCELLED)};
  throw Failure{SWIFTLET_UNEXPECTED, "the executor did not run all tasks"};
}

/// The pairs of the caller's array.
class GivenPairs {
 public:
  explicit GivenPairs(const swiftlet_pair* first) : first_(first), stride_(first->size) {}
  swiftlet_pair operator[](std::size_t i) const {
    swiftlet_pair pair{};
    read_bytes(reinterpret_cast<const char*>(first_) + i * stride_, stride_, sizeof pair, pair, "pairs");
    return pair;
  }

 private:
  const swiftlet_pair* first_;
  std::size_t stride_;
};

bool is_mesh(const swiftlet_pair& pair) { return GivenBody(pair.a, "a").is_mesh() || GivenBody(pair.b, "b").is_mesh(); }

Body body_in(const PairQuery*, const GivenBody& body) { return body.convex(); }
MeshBody body_in(const MeshPairQuery*, const GivenBody& body) { return body.mesh(); }

/// Pairs [first, first + given.size()), all by march or all by bvh.
template <class Pair, class Seed, class Query>
void ask_alike(std::span<const swiftlet_pair> given, std::size_t first, const Query& query, const auto& to) {
  std::vector<Seed> seeds;
  std::vector<Pair> pairs;
  std::vector<typename Query::Result> results(given.size());
  seeds.reserve(given.size());
  pairs.reserve(given.size());
  for (const swiftlet_pair& pair : given) {
    const GivenBody a(pair.a, "a"), b(pair.b, "b");
    seeds.push_back(seed_of<Seed>(pair.seed));
    const Pair* const kind = nullptr;
    pairs.push_back({body_in(kind, a), body_in(kind, b), pose_of(&pair.b_in_a), &seeds.back()});
  }
  query.many(std::span<const Pair>(pairs), std::span(results));
  for (std::size_t i = 0; i < given.size(); ++i) {
    keep(seeds[i], given[i].seed);
    to.put(first + i, results[i]);
  }
}

template <class Query>
void ask_pairs(const swiftlet_pair* pairs, std::size_t count, const swiftlet_run* run, const Query& query, const auto& to) {
  need(pairs, "pairs");
  const GivenPairs given(pairs);
  const auto end_of = [&](std::size_t task) { return std::min((task + 1) * kPairsPerTask, count); };
  const auto ask_some = [&](std::size_t task) {
    std::array<swiftlet_pair, kPairsPerTask> some;
    const std::size_t begin = task * kPairsPerTask, size = end_of(task) - begin;
    std::array<bool, kPairsPerTask> of_mesh;
    for (std::size_t i = 0; i < size; ++i) {
      try {
        some[i] = given[begin + i];
        of_mesh[i] = is_mesh(some[i]);
        (void)GivenBody(some[i].a, "a").mesh(), (void)GivenBody(some[i].b, "b").mesh();
      } catch (Failure& failure) {
        failure.message = "pair " + std::to_string(begin + i) + ": " + failure.message;
        throw;
      }
    }
    for (std::size_t i = 0, next; i < size; i = next) {
      for (next = i + 1; next < size && of_mesh[next] == of_mesh[i]; ++next) {
      }
      const std::span<const swiftlet_pair> alike(&some[i], next - i);
      if (of_mesh[i])
        ask_alike<MeshPairQuery, MeshSeed>(alike, begin + i, query, to);
      else
        ask_alike<PairQuery, PairSeed>(alike, begin + i, query, to);
    }
  };
  run_all((count - 1) / kPairsPerTask + 1, run, ask_some, [&](std::size_t task) {
    for (std::size_t i = task * kPairsPerTask; i < end_of(task); ++i) to.put(i, {});
  });
}

template <class Query>
void ask_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, std::size_t count,
               const swiftlet_run* run, const Query& query, const auto& to) {
  const GivenBody body_a(a, "a"), body_b(b, "b");
  need(b_in_a, "b_in_a");
  const auto end_of = [&](std::size_t task) { return std::min((task + 1) * kPosesPerChunk, count); };
  const auto ask_of = [&](const auto& one, const auto& other, auto cold) {
    const auto ask_chunk = [&](std::size_t chunk) {
      auto seed = cold;
      for (std::size_t i = chunk * kPosesPerChunk; i < end_of(chunk); ++i)
        to.put(i, query.one(one, other, pose_of(b_in_a + i), seed));
    };
    run_all((count - 1) / kPosesPerChunk + 1, run, ask_chunk, [&](std::size_t chunk) {
      for (std::size_t i = chunk * kPosesPerChunk; i < end_of(chunk); ++i) to.put(i, {});
    });
  };
  if (body_a.is_mesh() || body_b.is_mesh()) {
    const MeshBody one = body_a.mesh(), other = body_b.mesh();
    return ask_of(one, other, MeshSeed{});
  }
  const Body one = body_a.convex(), other = body_b.convex();
  ask_of(one, other, PairSeed{});
}

}  // namespace

// ---- Poses -----------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_relative(const swiftlet_pose* a_in_world, const swiftlet_pose* b_in_world, swiftlet_pose* b_in_a,
                                swiftlet_error* error) {
  return guard(error, [&] {
    need(a_in_world, "a_in_world");
    need(b_in_world, "b_in_world");
    need(b_in_a, "b_in_a");
    copy(relative(pose_of(a_in_world), pose_of(b_in_world)), b_in_a);
  });
}

swiftlet_code swiftlet_inverse(const swiftlet_pose* pose, swiftlet_pose* inverted, swiftlet_error* error) {
  return guard(error, [&] {
    need(pose, "pose");
    need(inverted, "inverse");
    copy(inverse(pose_of(pose)), inverted);
  });
}

// ---- Options ---------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_options_init(swiftlet_options* options, size_t size, swiftlet_error* error) {
  return init(default_options(), options, size, error);
}
swiftlet_code swiftlet_effort_init(swiftlet_effort* effort, size_t size, swiftlet_error* error) {
  return init(default_effort(), effort, size, error);
}
swiftlet_code swiftlet_closest_options_init(swiftlet_closest_options* options, size_t size, swiftlet_error* error) {
  return init(default_closest_options(), options, size, error);
}

// ---- One pair --------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                swiftlet_seed* seed, const swiftlet_options* options, swiftlet_answer* answer,
                                swiftlet_error* error) {
  return guard(error, [&] { ask(a, b, b_in_a, seed, Distance(options), AnswersOnly(Count::One, answer)); });
}

swiftlet_code swiftlet_refine(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                              const swiftlet_answer* so_far, swiftlet_seed* seed, const swiftlet_options* options,
                              swiftlet_answer* answer, swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need(!body_a.is_mesh() && !body_b.is_mesh(), "an answer about meshes is not refined");
    AskedOptions asked(options);
    const Report report(asked.report, asked.options.tuning);
    const AnswersOnly to(Count::One, answer);
    auto kept = seed_of<PairSeed>(seed);
    const Answer result =
        refine(body_a.convex(), body_b.convex(), pose_of(b_in_a), answer_of(so_far, "so_far"), kept, asked.options);
    keep(kept, seed);
    report.hand_out(result);
    to.put(0, result);
  });
}

swiftlet_code swiftlet_signed_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                       swiftlet_seed* seed, const swiftlet_options* options, swiftlet_answer* answer,
                                       swiftlet_error* error) {
  return guard(error, [&] { ask(a, b, b_in_a, seed, SignedDistance(options), AnswersOnly(Count::One, answer)); });
}

swiftlet_code swiftlet_intersects(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                  swiftlet_seed* seed, const swiftlet_effort* effort, swiftlet_answer* answer,
                                  swiftlet_error* error) {
  return guard(error, [&] { ask(a, b, b_in_a, seed, Intersects(effort), AnswersOnly(Count::One, answer)); });
}

swiftlet_code swiftlet_within(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, double threshold,
                              swiftlet_seed* seed, const swiftlet_effort* effort, int32_t* decision, swiftlet_answer* answer,
                              swiftlet_error* error) {
  return guard(error, [&] { ask(a, b, b_in_a, seed, IsWithin(threshold, effort), Decisions(Count::One, decision, answer)); });
}

swiftlet_code swiftlet_signed_within(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                     double threshold, swiftlet_seed* seed, const swiftlet_effort* effort, int32_t* decision,
                                     swiftlet_answer* answer, swiftlet_error* error) {
  return guard(error,
               [&] { ask(a, b, b_in_a, seed, IsSignedWithin(threshold, effort), Decisions(Count::One, decision, answer)); });
}

swiftlet_code swiftlet_closest_features(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                        swiftlet_seed* seed, const swiftlet_closest_options* options, swiftlet_answer* answer,
                                        swiftlet_source* source_a, swiftlet_source* source_b, swiftlet_error* error) {
  return guard(error, [&] { ask(a, b, b_in_a, seed, Closest(options), Features(Count::One, answer, source_a, source_b)); });
}

swiftlet_code swiftlet_tolerance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, double* to,
                                 swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need(to, "tolerance");
    const bool of_mesh = body_a.is_mesh() || body_b.is_mesh();
    const Pose pose = pose_of(b_in_a);
    *to = of_mesh ? tolerance(body_a.mesh(), body_b.mesh(), pose) : tolerance(body_a.convex(), body_b.convex(), pose);
  });
}

// ---- Many pairs ------------------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_distance_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_options* options,
                                      const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, Distance(options), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_signed_distance_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_options* options,
                                             const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, SignedDistance(options), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_intersects_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_effort* effort,
                                        const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, Intersects(effort), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_within_pairs(const swiftlet_pair* pairs, size_t count, double threshold, const swiftlet_effort* effort,
                                    const swiftlet_run* run, int32_t* decisions, swiftlet_answer* answers,
                                    swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, IsWithin(threshold, effort), Decisions(Count::Many, decisions, answers));
  });
}

swiftlet_code swiftlet_signed_within_pairs(const swiftlet_pair* pairs, size_t count, double threshold,
                                           const swiftlet_effort* effort, const swiftlet_run* run, int32_t* decisions,
                                           swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, IsSignedWithin(threshold, effort), Decisions(Count::Many, decisions, answers));
  });
}

swiftlet_code swiftlet_closest_features_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_closest_options* options,
                                              const swiftlet_run* run, swiftlet_answer* answers, swiftlet_source* sources_a,
                                              swiftlet_source* sources_b, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_pairs(pairs, count, run, Closest(options), Features(Count::Many, answers, sources_a, sources_b));
  });
}

// ---- One pair in many poses ------------------------------------------------------------------------------------------------

swiftlet_code swiftlet_distance_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, size_t count,
                                      const swiftlet_options* options, const swiftlet_run* run, swiftlet_answer* answers,
                                      swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_poses(a, b, b_in_a, count, run, Distance(options), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_signed_distance_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                             size_t count, const swiftlet_options* options, const swiftlet_run* run,
                                             swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_poses(a, b, b_in_a, count, run, SignedDistance(options), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_intersects_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                        size_t count, const swiftlet_effort* effort, const swiftlet_run* run,
                                        swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_poses(a, b, b_in_a, count, run, Intersects(effort), AnswersOnly(Count::Many, answers));
  });
}

swiftlet_code swiftlet_within_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, size_t count,
                                    double threshold, const swiftlet_effort* effort, const swiftlet_run* run,
                                    int32_t* decisions, swiftlet_answer* answers, swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_poses(a, b, b_in_a, count, run, IsWithin(threshold, effort), Decisions(Count::Many, decisions, answers));
  });
}

swiftlet_code swiftlet_signed_within_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                           size_t count, double threshold, const swiftlet_effort* effort,
                                           const swiftlet_run* run, int32_t* decisions, swiftlet_answer* answers,
                                           swiftlet_error* error) {
  return guard(error, [&] {
    if (count)
      ask_poses(a, b, b_in_a, count, run, IsSignedWithin(threshold, effort), Decisions(Count::Many, decisions, answers));
  });
}

swiftlet_code swiftlet_closest_features_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                              size_t count, const swiftlet_closest_options* options, const swiftlet_run* run,
                                              swiftlet_answer* answers, swiftlet_source* sources_a, swiftlet_source* sources_b,
                                              swiftlet_error* error) {
  return guard(error, [&] {
    if (count) ask_poses(a, b, b_in_a, count, run, Closest(options), Features(Count::Many, answers, sources_a, sources_b));
  });
}
