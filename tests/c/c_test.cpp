// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The C interface against the C++ one, bit for bit, on the bodies and poses of the recorded answers; sizes and layouts, errors,
// handles, batches.
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <swiftlet/batch.h>
#include <swiftlet/check.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include "answers.h"
#include "c_questions.h"
#include "folder.h"
#include "mesh_answers.h"

namespace swiftlet {
namespace {

struct Release {
  void operator()(swiftlet_model* model) const { swiftlet_model_release(model); }
  void operator()(swiftlet_mesh* mesh) const { swiftlet_mesh_release(mesh); }
  void operator()(swiftlet_executor* executor) const { swiftlet_executor_release(executor); }
};
using ModelHandle = std::unique_ptr<swiftlet_model, Release>;
using MeshHandle = std::unique_ptr<swiftlet_mesh, Release>;
using ExecutorHandle = std::unique_ptr<swiftlet_executor, Release>;

/// A caller's error that fails the test where there is one.
struct Sound {
  swiftlet_error error{sizeof(swiftlet_error), 0, ""};
  operator swiftlet_error*() { return &error; }
  ~Sound() { EXPECT_EQ(error.code, SWIFTLET_OK) << error.message; }
};

ModelHandle handle_of(const Model& model) {
  swiftlet_model* made = nullptr;
  swiftlet_model_from_bytes(model.bytes().data(), model.bytes().size(), nullptr, &made, Sound());
  return ModelHandle(made);
}
MeshHandle handle_of(const MeshModel& mesh) {
  swiftlet_mesh* made = nullptr;
  swiftlet_mesh_from_bytes(mesh.bytes().data(), mesh.bytes().size(), &made, Sound());
  return MeshHandle(made);
}

swiftlet_body body_of(const swiftlet_model* model, double radius = 0) {
  return {sizeof(swiftlet_body), SWIFTLET_BODY_MODEL, radius, {}, model, nullptr};
}
swiftlet_body body_of(const swiftlet_mesh* mesh, int kind = SWIFTLET_BODY_MESH, double radius = 0) {
  return {sizeof(swiftlet_body), kind, radius, {}, nullptr, mesh};
}
swiftlet_body ball(double x, double y, double z, double radius) {
  return {sizeof(swiftlet_body), SWIFTLET_BODY_POINT, radius, {{x, y, z}}, nullptr, nullptr};
}

swiftlet_pose plain(const Pose& pose) {
  swiftlet_pose to;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) to.rotation[3 * i + k] = pose.rotation(i, k);
    to.translation[i] = pose.translation[i];
  }
  return to;
}

std::uint32_t bits(FeatureId f) { return std::uint32_t(f.kind()) << 30 | f.index(); }

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }
bool same(const Vec3& a, const double* b) { return same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]); }

bool same(const Answer& a, const swiftlet_answer& b) {
  return int(a.status) == b.status && int(a.verdict) == b.verdict && a.is_signed == (b.is_signed == 1) &&
         same(a.lower, b.lower) && same(a.upper, b.upper) && same(a.normal, b.normal) && same(a.point_a, b.point_a) &&
         same(a.point_b, b.point_b) && bits(a.feature_a) == b.feature_a && bits(a.feature_b) == b.feature_b &&
         a.level_a == b.level_a && a.level_b == b.level_b && a.steps == b.steps && a.plane_tests == b.plane_tests &&
         same(a.radius_a, b.radius_a) && same(a.radius_b, b.radius_b) && a.levels_visited == b.levels_visited &&
         b.size == sizeof b;
}
bool same(const SourceFeature& a, const swiftlet_source& b) {
  return int(a.kind) == b.kind && a.vertices[0] == b.vertices[0] && a.vertices[1] == b.vertices[1] &&
         a.triangles.size() == b.triangle_count && std::equal(a.triangles.begin(), a.triangles.end(), b.triangles);
}
bool same(const Manifold& a, const swiftlet_manifold& b) {
  bool all = a.count == b.count && same(a.normal, b.normal) && bits(a.face_a) == b.face_a && bits(a.face_b) == b.face_b;
  for (std::uint32_t i = 0; i < a.count && all; ++i) {
    const ManifoldPoint& p = a.points[i];
    const swiftlet_manifold_point& q = b.points[i];
    all = same(p.point_a, q.point_a) && same(p.point_b, q.point_b) && same(p.separation, q.separation) &&
          bits(p.feature_a) == q.feature_a && bits(p.feature_b) == q.feature_b;
  }
  return all;
}

/// Asks C++ what c_questions.c asks C, with seeds of its own, and compares.
template <class AnyBody, class Seed>
struct Beside {
  Seed distance, signed_distance, intersects, within, signed_within, closest;
  questions_seeds seeds{};
  int asked = 0, met = 0;

  void ask(const AnyBody& a, const AnyBody& b, const Pose& pose, const swiftlet_body& plain_a, const swiftlet_body& plain_b) {
    constexpr bool kConvex = std::is_same_v<AnyBody, Body>;
    questions_answers c;
    const swiftlet_pose b_in_a = plain(pose);
    ASSERT_EQ(questions_ask(&plain_a, &plain_b, &b_in_a, kConvex, &seeds, &c, Sound()), SWIFTLET_OK);
    EXPECT_TRUE(same(swiftlet::distance(a, b, pose, distance), c.distance));
    EXPECT_TRUE(same(swiftlet::distance(a, b, pose), c.cold));
    const Answer rough = swiftlet::distance(a, b, pose, {.relative = 0.1});
    EXPECT_TRUE(same(rough, c.rough));
    const Answer depth = swiftlet::signed_distance(a, b, pose, signed_distance);
    EXPECT_TRUE(same(depth, c.signed_distance));
    EXPECT_TRUE(same(swiftlet::intersects(a, b, pose, intersects), c.intersects));
    const Within near = swiftlet::within(a, b, pose, 0.5, within),
                 deep = swiftlet::signed_within(a, b, pose, -0.1, signed_within);
    EXPECT_TRUE(same(near.answer, c.within) && int(near.decision) == c.is_within);
    EXPECT_TRUE(same(deep.answer, c.signed_within) && int(deep.decision) == c.is_signed_within);
    const ClosestFeatures found = swiftlet::closest_features(a, b, pose, closest);
    EXPECT_TRUE(same(found.answer, c.closest) && same(found.source_a, c.source_a) && same(found.source_b, c.source_b));
    EXPECT_TRUE(same(tolerance(a, b, pose), c.tolerance));
    if constexpr (kConvex) {
      EXPECT_TRUE(same(refine(a, b, pose, rough), c.refined));
      EXPECT_TRUE(same(manifold(a, b, pose, depth), c.manifold));
      swiftlet_check_result checked{sizeof checked, 7, "?"};
      EXPECT_EQ(
          swiftlet_check(&plain_a, &plain_b, &b_in_a, &c.signed_distance, SWIFTLET_QUESTION_EXACT, nullptr, &checked, Sound()),
          SWIFTLET_OK);
      EXPECT_TRUE(checked.ok == 1 && checked.message[0] == 0) << checked.message;
    }
    if constexpr (kConvex) {
      EXPECT_EQ(0, std::memcmp(&distance, &seeds.distance, sizeof distance));
    }
    ++asked, met += depth.verdict == Verdict::Overlapping;
  }
};

const std::vector<Model>& models() {
  static const std::vector<Model> all = answers::models(std::string(SWIFTLET_TEST_DIR) + "/../data/models");
  return all;
}

TEST(C, AnswersAreThoseOfCpp) {
  std::vector<ModelHandle> handles;
  for (const Model& model : models()) handles.push_back(handle_of(model));
  answers::Poses poses(1);
  int asked = 0, met = 0;
  for (std::size_t a = 0; a < models().size(); ++a)
    for (std::size_t b = 0; b < models().size(); ++b) {
      Beside<Body, PairSeed> beside;
      for (int i = 0; i < 12; ++i) {
        const double r = i % 3 == 0 ? 0.125 : 0;
        beside.ask(Body(models()[a], r), Body(models()[b]), poses.next(), body_of(handles[a].get(), r),
                   body_of(handles[b].get()));
      }
      asked += beside.asked, met += beside.met;
    }
  EXPECT_GE(asked, 300);
  EXPECT_GE(met, 30);
}

TEST(C, PrimitivesAreThoseOfCpp) {
  const ModelHandle handle = handle_of(models()[0]);
  answers::Poses poses(2);
  const double p[3][3] = {{-0.5, -0.25, -0.125}, {0.5, 0.25, 0.75}, {0, 1, 0}};
  const Vec3 q[3] = {Vec3(p[0]), Vec3(p[1]), Vec3(p[2])};
  const Body bodies[] = {Body::point(q[0], 0.25), Body::segment(q[0], q[1], 0.5), Body::triangle(q[0], q[1], q[2]),
                         Body::box(q[0], q[1], 0.125)};
  for (const Body& body : bodies) {
    swiftlet_body given{sizeof given, int(body.kind()), body.radius(), {}, nullptr, nullptr};
    std::memcpy(given.points, p, sizeof p);
    Beside<Body, PairSeed> beside;
    for (int i = 0; i < 20; ++i) beside.ask(Body(models()[0]), body, poses.next(), body_of(handle.get()), given);
  }
}

TEST(C, MeshesAnswerAsInCpp) {
  const std::vector<MeshModel> all = answers::meshes();
  std::vector<MeshHandle> handles;
  for (const MeshModel& mesh : all) handles.push_back(handle_of(mesh));
  const ModelHandle model = handle_of(models()[0]);
  answers::Poses poses(3);
  int regions = 0, points = 0;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      Beside<MeshBody, MeshSeed> beside;
      for (int i = 0; i < 8; ++i) {
        const Pose pose = poses.next();
        const bool solid = i % 4 == 1 && a < answers::kClosed && b < answers::kClosed, convex = i % 4 == 2;
        const MeshBody body_a = solid ? MeshBody::solid(all[a]) : MeshBody(all[a], 0.0625);
        const MeshBody body_b = convex ? MeshBody(Body(models()[0])) : solid ? MeshBody::solid(all[b]) : MeshBody(all[b]);
        const int kind = solid ? SWIFTLET_BODY_SOLID : SWIFTLET_BODY_MESH;
        const swiftlet_body plain_a = body_of(handles[a].get(), kind, solid ? 0 : 0.0625);
        const swiftlet_body plain_b = convex ? body_of(model.get()) : body_of(handles[b].get(), kind);
        beside.ask(body_a, body_b, pose, plain_a, plain_b);

        const swiftlet_pose b_in_a = plain(pose);
        std::vector<MeshContact> in_cpp(8);
        std::vector<swiftlet_contact> in_c(8);
        in_c[0].size = sizeof in_c[0];
        swiftlet_contact_list list{};
        list.size = sizeof list;
        const MeshContacts found = contacts(body_a, body_b, pose, 0.25, in_cpp);
        ASSERT_EQ(swiftlet_contacts(&plain_a, &plain_b, &b_in_a, 0.25, nullptr, in_c.data(), 8, &list, Sound()), SWIFTLET_OK);
        EXPECT_TRUE(int(found.status) == list.status && found.is_counted == (list.is_counted == 1) &&
                    found.count == list.count && found.stored == list.stored && found.steps == list.steps &&
                    found.plane_tests == list.plane_tests);
        for (std::uint32_t k = 0; k < found.stored; ++k, ++regions) {
          const MeshContact& x = in_cpp[k];
          const swiftlet_contact& y = in_c[k];
          EXPECT_TRUE(same(x.lower, y.lower) && same(x.upper, y.upper) && int(x.verdict) == y.verdict &&
                      bits(x.feature_a) == y.feature_a && bits(x.feature_b) == y.feature_b && x.triangle_a == y.triangle_a &&
                      x.triangle_b == y.triangle_b && same(x.point_a, y.point_a) && same(x.point_b, y.point_b) &&
                      same(x.normal, y.normal) && same(x.box_min, y.box_min) && same(x.box_max, y.box_max));
          swiftlet_manifold given{};
          given.size = sizeof given;
          ASSERT_EQ(swiftlet_contact_manifold(&plain_a, &plain_b, &b_in_a, &y, nullptr, nullptr, &given, Sound()), SWIFTLET_OK);
          EXPECT_TRUE(same(manifold(body_a, body_b, pose, x), given));
          points += int(given.count);
        }
      }
    }
  EXPECT_GE(regions, 100);
  EXPECT_GE(points, 100);
}

TEST(C, MarchesAsCpp) {
  const Model& a = models()[0];
  const Model& b = models()[1];
  const ModelHandle handle_a = handle_of(a), handle_b = handle_of(b);
  answers::Poses poses(4);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = poses.next();
    const swiftlet_pose b_in_a = plain(pose);
    const int level = i % a.level_count();
    swiftlet_march_result c{};
    c.size = sizeof c;
    ASSERT_EQ(swiftlet_march(handle_a.get(), level, handle_b.get(), 0, &b_in_a, 0, 0, nullptr, &c, Sound()), SWIFTLET_OK);
    const MarchResult r = march(a.level(level).view, b.level(0).view, pose);
    EXPECT_TRUE(int(r.status) == c.status && int(r.doubt) == c.doubt && bits(r.a) == c.a && bits(r.b) == c.b &&
                same(r.lower, c.lower) && same(r.upper, c.upper) && same(r.normal, c.normal) && same(r.point_a, c.point_a) &&
                same(r.point_b, c.point_b) && r.steps == c.steps && r.plane_tests == c.plane_tests &&
                r.proof.count == c.proof.count);
  }
  swiftlet_march_result c{};
  c.size = sizeof c;
  const swiftlet_pose pose = plain(Pose{});
  EXPECT_EQ(swiftlet_march(handle_a.get(), 99, handle_b.get(), 0, &pose, 0, 0, nullptr, &c, nullptr), SWIFTLET_BAD_VALUE);
}

// ---- Batches ---------------------------------------------------------------------------------------------------------------

int32_t stop_after(void* left) { return static_cast<std::atomic<int>*>(left)->fetch_sub(1) <= 0; }
int32_t stop_once(void* left) { return static_cast<std::atomic<int>*>(left)->fetch_sub(1) == 1; }

void run_backwards(std::size_t count, swiftlet_task task, void* context, void* data) {
  for (std::size_t i = count; i > 0; --i) task(context, i - 1);
  ++*static_cast<int*>(data);
}
void run_nothing(std::size_t, swiftlet_task, void*, void*) {}

TEST(C, BatchesAnswerAsInCppOnAnyExecutor) {
  const ModelHandle a = handle_of(models()[0]), b = handle_of(models()[1]);
  const std::vector<MeshModel> meshes = answers::meshes();
  const MeshHandle mesh = handle_of(meshes[0]);
  const swiftlet_body bodies[] = {body_of(a.get()), body_of(b.get(), 0.25), body_of(mesh.get()), ball(1, 2, 3, 0.5)};
  swiftlet_executor *threads = nullptr, *backwards = nullptr;
  int times = 0;
  ASSERT_EQ(swiftlet_executor_on_threads(3, &threads, Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_executor_create(run_backwards, &times, &backwards, Sound()), SWIFTLET_OK);
  const ExecutorHandle one(threads), other(backwards);

  answers::Poses poses(5);
  const std::size_t count = 2500;
  std::vector<Pose> cpp_poses;
  std::vector<swiftlet_pose> c_poses;
  std::vector<swiftlet_pair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    cpp_poses.push_back(poses.next());
    c_poses.push_back(plain(cpp_poses.back()));
    pairs.push_back({sizeof(swiftlet_pair), 0, &bodies[i / 3 % 4], &bodies[i % 2], c_poses.back(), nullptr});
  }
  std::vector<Answer> wanted(count);
  distance(Body(models()[0]), Body(models()[1], 0.25), cpp_poses, wanted);
  for (const swiftlet_executor* executor : std::initializer_list<const swiftlet_executor*>{nullptr, one.get(), other.get()}) {
    const swiftlet_run run{sizeof run, 0, executor, nullptr, nullptr};
    std::vector<swiftlet_answer> answers(count);
    answers[0].size = sizeof answers[0];
    ASSERT_EQ(swiftlet_distance_poses(&bodies[0], &bodies[1], c_poses.data(), count, nullptr, &run, answers.data(), Sound()),
              0);
    for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same(wanted[i], answers[i])) << i;

    std::vector<swiftlet_seed> seeds(count);
    for (std::size_t i = 0; i < count; ++i) pairs[i].seed = &seeds[i];
    std::vector<std::int32_t> decisions(count, 7);
    ASSERT_EQ(swiftlet_signed_within_pairs(pairs.data(), count, -0.1, nullptr, &run, decisions.data(), answers.data(), Sound()),
              0);
    for (std::size_t i = 0; i < count; i += 7) {
      swiftlet_answer single{};
      single.size = sizeof single;
      std::int32_t decision = 7;
      swiftlet_seed seed{};
      ASSERT_EQ(
          swiftlet_signed_within(pairs[i].a, pairs[i].b, &pairs[i].b_in_a, -0.1, &seed, nullptr, &decision, &single, Sound()),
          0);
      EXPECT_TRUE(decision == decisions[i] && std::memcmp(&single, &answers[i], sizeof single) == 0) << i;
      EXPECT_EQ(std::memcmp(&seed, &seeds[i], sizeof seed), 0) << i;
    }
  }
  EXPECT_EQ(times, 2);
}

TEST(C, EveryBatchAsksItsQuery) {
  const ModelHandle a = handle_of(models()[0]), b = handle_of(models()[2]);
  const swiftlet_body body_a = body_of(a.get()), body_b = body_of(b.get());
  answers::Poses poses(6);
  for (int i = 0; i < 20; ++i) {
    const swiftlet_pose pose = plain(poses.next());
    const swiftlet_pair pair{sizeof pair, 0, &body_a, &body_b, pose, nullptr};
    questions_seeds seeds{};
    questions_answers wanted;
    ASSERT_EQ(questions_ask(&body_a, &body_b, &pose, 1, &seeds, &wanted, Sound()), SWIFTLET_OK);
    swiftlet_answer answer{};
    answer.size = sizeof answer;
    std::int32_t decision = 7;
    swiftlet_source x{}, y{};
    x.size = y.size = sizeof x;
    const auto is = [&](swiftlet_code code, const swiftlet_answer& one) {
      EXPECT_TRUE(code == SWIFTLET_OK && std::memcmp(&answer, &one, sizeof one) == 0);
    };
    is(swiftlet_distance_pairs(&pair, 1, nullptr, nullptr, &answer, Sound()), wanted.distance);
    is(swiftlet_signed_distance_pairs(&pair, 1, nullptr, nullptr, &answer, Sound()), wanted.signed_distance);
    is(swiftlet_signed_distance_poses(&body_a, &body_b, &pose, 1, nullptr, nullptr, &answer, Sound()), wanted.signed_distance);
    is(swiftlet_intersects_pairs(&pair, 1, nullptr, nullptr, &answer, Sound()), wanted.intersects);
    is(swiftlet_intersects_poses(&body_a, &body_b, &pose, 1, nullptr, nullptr, &answer, Sound()), wanted.intersects);
    is(swiftlet_within_pairs(&pair, 1, 0.5, nullptr, nullptr, &decision, &answer, Sound()), wanted.within);
    EXPECT_EQ(decision, wanted.is_within);
    is(swiftlet_within_poses(&body_a, &body_b, &pose, 1, 0.5, nullptr, nullptr, &decision, &answer, Sound()), wanted.within);
    EXPECT_EQ(decision, wanted.is_within);
    is(swiftlet_signed_within_poses(&body_a, &body_b, &pose, 1, -0.1, nullptr, nullptr, &decision, &answer, Sound()),
       wanted.signed_within);
    EXPECT_EQ(decision, wanted.is_signed_within);
    is(swiftlet_closest_features_pairs(&pair, 1, nullptr, nullptr, &answer, &x, &y, Sound()), wanted.closest);
    EXPECT_TRUE(std::memcmp(&x, &wanted.source_a, sizeof x) == 0 && std::memcmp(&y, &wanted.source_b, sizeof y) == 0);
    is(swiftlet_closest_features_poses(&body_a, &body_b, &pose, 1, nullptr, nullptr, &answer, &x, nullptr, Sound()),
       wanted.closest);
  }
}

TEST(C, BatchesStopAndSayWhatIsWrong) {
  const swiftlet_body point = ball(0, 0, 0, 1), none{};
  std::vector<swiftlet_pose> poses(3000, plain(Pose{}));
  std::vector<swiftlet_answer> answers(poses.size());
  answers[0].size = sizeof answers[0];
  std::atomic<int> left = 1;
  swiftlet_run run{sizeof run, 0, nullptr, stop_after, &left};
  EXPECT_EQ(swiftlet_distance_poses(&point, &point, poses.data(), poses.size(), nullptr, &run, answers.data(), nullptr),
            SWIFTLET_CANCELLED);
  EXPECT_EQ(answers[1023].status, SWIFTLET_STATUS_CONVERGED);
  EXPECT_EQ(answers[1024].status, SWIFTLET_STATUS_NOT_ASKED);
  EXPECT_EQ(answers[2999].status, SWIFTLET_STATUS_NOT_ASKED);
  left = 2;
  run.stop = stop_once;
  EXPECT_EQ(swiftlet_distance_poses(&point, &point, poses.data(), poses.size(), nullptr, &run, answers.data(), nullptr),
            SWIFTLET_CANCELLED);
  EXPECT_EQ(left, 0);
  EXPECT_EQ(answers[1023].status, SWIFTLET_STATUS_CONVERGED);
  EXPECT_EQ(answers[1024].status, SWIFTLET_STATUS_NOT_ASKED);
  EXPECT_EQ(answers[2999].status, SWIFTLET_STATUS_NOT_ASKED) << "it stays stopped";

  swiftlet_executor* lazy = nullptr;
  ASSERT_EQ(swiftlet_executor_create(run_nothing, nullptr, &lazy, Sound()), SWIFTLET_OK);
  const ExecutorHandle handle(lazy);
  run = {sizeof run, 0, lazy, nullptr, nullptr};
  swiftlet_error error{sizeof error, 0, ""};
  EXPECT_EQ(swiftlet_distance_poses(&point, &point, poses.data(), 1, nullptr, &run, answers.data(), &error),
            SWIFTLET_UNEXPECTED);
  EXPECT_STREQ(error.message, "the executor did not run all tasks");

  std::vector<swiftlet_pair> pairs(50, {sizeof(swiftlet_pair), 0, &point, &point, poses[0], nullptr});
  pairs[40].b = &none;
  swiftlet_executor* threads = nullptr;
  ASSERT_EQ(swiftlet_executor_on_threads(2, &threads, Sound()), SWIFTLET_OK);
  const ExecutorHandle workers(threads);
  int times = 0;
  swiftlet_executor* backwards = nullptr;
  ASSERT_EQ(swiftlet_executor_create(run_backwards, &times, &backwards, Sound()), SWIFTLET_OK);
  const ExecutorHandle reversed(backwards);
  for (const swiftlet_executor* executor : {workers.get(), reversed.get()}) {
    run.executor = executor;
    error.message[0] = 0;
    EXPECT_EQ(swiftlet_distance_pairs(pairs.data(), 50, nullptr, &run, answers.data(), &error), SWIFTLET_BAD_SIZE);
    EXPECT_EQ(std::string(error.message).rfind("pair 40: b.size is 0", 0), 0u) << error.message;
  }
}

// ---- Sizes and layouts -----------------------------------------------------------------------------------------------------

TEST(C, OlderAndNewerCallersWork) {
  const swiftlet_body a = ball(0, 0, 0, 1), b = ball(0, 0, 5, 1);
  const swiftlet_pose pose = plain(Pose{});
  struct Newer {
    swiftlet_answer answer;
    double more[2];
  } newer{};
  std::memset(&newer, 0x55, sizeof newer);
  newer.answer.size = sizeof newer;
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, &newer.answer, Sound()), SWIFTLET_OK);
  EXPECT_TRUE(newer.answer.size == sizeof newer && std::fabs(newer.answer.lower - 3) < 1e-12 && newer.more[0] == 0 &&
              newer.more[1] == 0);
  struct {
    unsigned char bytes[sizeof(swiftlet_answer)];
  } older;
  std::memset(&older, 0x55, sizeof older);
  auto* shorter = reinterpret_cast<swiftlet_answer*>(&older);
  const std::uint32_t size = offsetof(swiftlet_answer, normal);
  std::memcpy(&older, &size, sizeof size);
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, shorter, Sound()), SWIFTLET_OK);
  swiftlet_answer read{};
  std::memcpy(&read, &older, size);
  EXPECT_TRUE(std::fabs(read.lower - 3) < 1e-12 && read.upper >= 3 && read.verdict == SWIFTLET_VERDICT_DISJOINT &&
              read.size == size);
  for (std::size_t i = size; i < sizeof older; ++i) EXPECT_EQ(older.bytes[i], 0x55) << i;

  // Inputs: an older one leaves the rest at the defaults, a newer one is refused if it asks for what nobody knows here.
  swiftlet_answer answer{};
  answer.size = sizeof answer;
  swiftlet_options options;
  ASSERT_EQ(swiftlet_options_init(&options, sizeof options, Sound()), SWIFTLET_OK);
  EXPECT_TRUE(std::isinf(options.beyond) && options.budget.steps == ~0u &&
              options.tuning.refinement == SWIFTLET_REFINEMENT_SINGLE_SINGLE && options.size == sizeof options);
  options.beyond = 1;
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, &options, &answer, Sound()), SWIFTLET_OK);
  EXPECT_EQ(answer.status, SWIFTLET_STATUS_BEYOND);
  options.size = offsetof(swiftlet_options, beyond);
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, &options, &answer, Sound()), SWIFTLET_OK);
  EXPECT_EQ(answer.status, SWIFTLET_STATUS_CONVERGED) << "what it does not have is the default";
  struct {
    swiftlet_options known;
    std::uint64_t more;
  } unknown{};
  ASSERT_EQ(swiftlet_options_init(&unknown.known, sizeof unknown, Sound()), SWIFTLET_OK);
  EXPECT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, &unknown.known, &answer, Sound()), SWIFTLET_OK);
  unknown.more = 1;
  EXPECT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, &unknown.known, &answer, nullptr), SWIFTLET_BAD_SIZE);
  swiftlet_body odd = a;
  for (const std::uint32_t wrong : {0u, 4u, 10u, 1u << 20}) {
    odd.size = wrong;
    EXPECT_EQ(swiftlet_distance(&odd, &b, &pose, nullptr, nullptr, &answer, nullptr), SWIFTLET_BAD_SIZE) << wrong;
    answer.size = wrong;
    EXPECT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, &answer, nullptr), SWIFTLET_BAD_SIZE) << wrong;
    answer.size = sizeof answer;
  }
  answer.size = size;
  EXPECT_EQ(swiftlet_refine(&a, &b, &pose, &answer, nullptr, nullptr, &answer, nullptr), SWIFTLET_BAD_SIZE) << "it is read";
}

/// Calls `ask` with a struct of every size, followed by zeros: those that no struct of its alignment has are refused.
template <class T>
void only_whole_sizes(const char* type, const T& whole, std::size_t least, const std::function<swiftlet_code(T*)>& ask) {
  struct {
    T known;
    std::uint64_t more[2];
  } given{};
  for (std::uint32_t size = 0; size <= sizeof(T) + 8; ++size) {
    given.known = whole, given.known.size = size;
    EXPECT_EQ(ask(&given.known) != SWIFTLET_BAD_SIZE, size >= least && size % alignof(T) == 0) << type << " of " << size;
  }
}

TEST(C, NoSizeEndsInsideAPointer) {
  const ModelHandle handle = handle_of(models()[0]);
  const MeshHandle mesh = handle_of(answers::meshes()[0]);
  const swiftlet_model* const m = handle.get();
  const swiftlet_body a = body_of(m), b = ball(0, 0, 9, 1), touching = body_of(mesh.get());
  const swiftlet_pose pose = plain(Pose{});
  swiftlet_answer answer{};
  answer.size = sizeof answer;
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, &answer, Sound()), SWIFTLET_OK);
  const swiftlet_answer exact = answer;
  const auto points = [&](const swiftlet_answer* of, const swiftlet_manifold_options* options,
                          const swiftlet_manifold* previous) {
    swiftlet_manifold manifold{};
    manifold.size = sizeof manifold;
    return swiftlet_contact_points(&a, &b, &pose, of, options, previous, &manifold, nullptr);
  };

  // Inputs.
  only_whole_sizes<swiftlet_body>(
      "body", b, 8, [&](auto* is) { return swiftlet_distance(&a, is, &pose, nullptr, nullptr, &answer, nullptr); });
  only_whole_sizes<swiftlet_options>("options", {}, 8,
                                     [&](auto* is) { return swiftlet_distance(&a, &b, &pose, nullptr, is, &answer, nullptr); });
  only_whole_sizes<swiftlet_effort>(
      "effort", {}, 8, [&](auto* is) { return swiftlet_intersects(&a, &b, &pose, nullptr, is, &answer, nullptr); });
  only_whole_sizes<swiftlet_closest_options>("closest_options", {}, 8, [&](auto* is) {
    return swiftlet_closest_features(&a, &b, &pose, nullptr, is, &answer, nullptr, nullptr, nullptr);
  });
  only_whole_sizes<swiftlet_run>(
      "run", {}, 8, [&](auto* is) { return swiftlet_distance_poses(&a, &b, &pose, 1, nullptr, is, &answer, nullptr); });
  only_whole_sizes<swiftlet_pair>("pair", {0, 0, &a, &b, pose, nullptr}, sizeof(swiftlet_pair),
                                  [&](auto* is) { return swiftlet_distance_pairs(is, 1, nullptr, nullptr, &answer, nullptr); });
  only_whole_sizes<swiftlet_manifold_options>("manifold_options", {0, 4, 0, 0}, 8,
                                              [&](auto* is) { return points(&exact, is, nullptr); });
  only_whole_sizes<swiftlet_manifold>("previous", {}, sizeof(swiftlet_manifold),
                                      [&](auto* is) { return points(&exact, nullptr, is); });
  only_whole_sizes<swiftlet_answer>("answer read", exact, sizeof(swiftlet_answer),
                                    [&](auto* is) { return points(is, nullptr, nullptr); });
  only_whole_sizes<swiftlet_contact>("contact read", {}, sizeof(swiftlet_contact), [&](auto* is) {
    swiftlet_manifold manifold{};
    manifold.size = sizeof manifold;
    return swiftlet_contact_manifold(&touching, &b, &pose, is, nullptr, nullptr, &manifold, nullptr);
  });
  const double corners[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  const std::uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  swiftlet_level_arrays level{};
  level.size = sizeof level, level.vertices = corners, level.vertex_count = 4;
  level.face_vertices = faces, level.face_vertex_count = 12;
  const auto model_of = [](const swiftlet_level_arrays* levels, const swiftlet_model_options* options) {
    swiftlet_model* made = nullptr;
    const swiftlet_code code = swiftlet_model_from_levels(levels, 1, options, &made, nullptr);
    swiftlet_model_release(made);
    return code;
  };
  only_whole_sizes<swiftlet_level_arrays>("level_arrays", level, offsetof(swiftlet_level_arrays, face_count),
                                          [&](auto* is) { return model_of(is, nullptr); });
  only_whole_sizes<swiftlet_model_options>("model_options", {}, 8, [&](auto* is) { return model_of(&level, is); });
  only_whole_sizes<swiftlet_march_rule>("march_rule", {}, 8, [&](auto* is) {
    swiftlet_march_result result{};
    result.size = sizeof result;
    return swiftlet_march(m, 0, m, 0, &pose, 0, 0, is, &result, nullptr);
  });

  // Outputs.
  only_whole_sizes<swiftlet_answer>("answer", {}, offsetof(swiftlet_answer, normal),
                                    [&](auto* is) { return swiftlet_distance(&a, &b, &pose, nullptr, nullptr, is, nullptr); });
  only_whole_sizes<swiftlet_source>("source", {}, sizeof(swiftlet_source), [&](auto* is) {
    return swiftlet_closest_features(&a, &b, &pose, nullptr, nullptr, &answer, is, nullptr, nullptr);
  });
  only_whole_sizes<swiftlet_manifold>("manifold", {}, sizeof(swiftlet_manifold), [&](auto* is) {
    return swiftlet_contact_points(&a, &b, &pose, &exact, nullptr, nullptr, is, nullptr);
  });
  only_whole_sizes<swiftlet_contact_list>("contact_list", {}, sizeof(swiftlet_contact_list), [&](auto* is) {
    return swiftlet_contacts(&touching, &b, &pose, 1, nullptr, nullptr, 0, is, nullptr);
  });
  only_whole_sizes<swiftlet_contact>("contact", {}, sizeof(swiftlet_contact), [&](auto* is) {
    swiftlet_contact_list found{};
    found.size = sizeof found;
    return swiftlet_contacts(&touching, &b, &pose, 1, nullptr, is, 1, &found, nullptr);
  });
  only_whole_sizes<swiftlet_model_info>("model_info", {}, offsetof(swiftlet_model_info, centre),
                                        [&](auto* is) { return swiftlet_model_get_info(m, is, nullptr); });
  only_whole_sizes<swiftlet_mesh_info>("mesh_info", {}, offsetof(swiftlet_mesh_info, volume),
                                       [&](auto* is) { return swiftlet_mesh_get_info(mesh.get(), is, nullptr); });
  only_whole_sizes<swiftlet_level>("level", {}, offsetof(swiftlet_level, vertices),
                                   [&](auto* is) { return swiftlet_model_get_level(m, 0, is, nullptr); });
  only_whole_sizes<swiftlet_source_map>("source_map", {}, sizeof(swiftlet_source_map),
                                        [&](auto* is) { return swiftlet_model_get_source(m, is, nullptr); });
  only_whole_sizes<swiftlet_check_result>("check_result", {}, 16,
                                          [&](auto* is) { return swiftlet_model_verify(m, is, nullptr); });
  only_whole_sizes<swiftlet_march_result>("march_result", {}, offsetof(swiftlet_march_result, normal), [&](auto* is) {
    return swiftlet_march(m, 0, m, 0, &pose, 0, 0, nullptr, is, nullptr);
  });

  // Options, by a size of their own. (swiftlet_error has no size that ends inside another member than its text.)
  for (std::size_t size = 0; size <= sizeof(swiftlet_options) + 8; ++size) {
    std::uint64_t room[16];
    EXPECT_EQ(swiftlet_options_init(reinterpret_cast<swiftlet_options*>(room), size, nullptr) == SWIFTLET_OK,
              size >= 8 && size % alignof(swiftlet_options) == 0)
        << size;
  }
}

/// What old callers were compiled with. A change here breaks them: SOVERSION and the version node count it.
TEST(C, LayoutsAreAsRecorded) {
  if (sizeof(void*) != 8) GTEST_SKIP() << "recorded for pointers of 8 bytes";
  const auto recorded = [](const char* what, std::size_t is, std::size_t was) { EXPECT_EQ(is, was) << what; };
#define IS(type, member, offset) recorded(#type "." #member, offsetof(swiftlet_##type, member), offset)
#define SIZE(type, size) recorded(#type, sizeof(swiftlet_##type), size)
  SIZE(error, 512), IS(error, message, 8);
  SIZE(pose, 96), IS(pose, translation, 72);
  SIZE(seed, 128);
  SIZE(run, 32), IS(run, executor, 8), IS(run, stop, 16), IS(run, stop_data, 24);
  SIZE(detail, 16), SIZE(table_spec, 16);
  SIZE(level_arrays, 96), IS(level_arrays, face_sizes, 40), IS(level_arrays, child_of_face, 88);
  SIZE(model_options, 32), IS(model_options, table, 8), IS(model_options, executor, 24);
  SIZE(model_info, 136), IS(model_info, centre, 16), IS(model_info, volume, 104), IS(model_info, map_level, 128);
  SIZE(level, 264), IS(level, vertices, 24), IS(level, map_frame, 128), IS(level, triangle_count, 256);
  SIZE(source_map, 56), IS(source_map, face_source_count, 48);
  SIZE(vertex, 32), SIZE(half_edge, 12), SIZE(face_plane, 40);
  SIZE(mesh_info, 168), IS(mesh_info, volume, 24), IS(mesh_info, deviation, 88), IS(mesh_info, source_triangle, 160);
  SIZE(body, 104), IS(body, radius, 8), IS(body, points, 16), IS(body, model, 88), IS(body, mesh, 96);
  SIZE(budget, 8), SIZE(level_record, 40), SIZE(overlap_proof, 36), SIZE(tuning, 40), IS(tuning, trace, 16),
      IS(tuning, proof, 32);
  SIZE(options, 80), IS(options, beyond, 24), IS(options, budget, 32), IS(options, tuning, 40);
  SIZE(effort, 56), IS(effort, tuning, 16);
  SIZE(closest_options, 56), IS(closest_options, beyond, 8), IS(closest_options, tuning, 16);
  SIZE(manifold_options, 24), IS(manifold_options, flatness, 16);
  SIZE(answer, 152), IS(answer, lower, 16), IS(answer, normal, 32), IS(answer, point_b, 80), IS(answer, feature_a, 104);
  IS(answer, level_a, 112), IS(answer, radius_a, 128), IS(answer, levels_visited, 144);
  SIZE(source, 32), IS(source, triangles, 16);
  SIZE(pair, 128), IS(pair, a, 8), IS(pair, b_in_a, 24), IS(pair, seed, 120);
  SIZE(manifold_point, 64), IS(manifold_point, separation, 48);
  SIZE(manifold, 552), IS(manifold, normal, 8), IS(manifold, points, 40);
  SIZE(contact, 160), IS(contact, lower, 8), IS(contact, triangle_a, 32), IS(contact, box_max, 136);
  SIZE(contact_list, 32), SIZE(check_result, 512);
  SIZE(march_rule, 48), IS(march_rule, plane_rule, 40);
  SIZE(march_result, 152), IS(march_result, normal, 32), IS(march_result, doubt, 112), IS(march_result, proof, 116);
#undef IS
#undef SIZE
}

// ---- Handles and errors ----------------------------------------------------------------------------------------------------

TEST(C, NullPointersAreErrors) {
  const ModelHandle model = handle_of(models()[0]);
  const MeshHandle mesh = handle_of(answers::meshes()[0]);
  EXPECT_EQ(questions_of_nothing(model.get(), mesh.get()), 0);
}

TEST(C, ErrorsSayWhatIsWrong) {
  struct {
    std::uint32_t size;
    swiftlet_code code;
    char message[24];
  } small{32, 0, {}};
  swiftlet_model* model = nullptr;
  EXPECT_EQ(swiftlet_model_load("nowhere/ä", nullptr, &model, reinterpret_cast<swiftlet_error*>(&small)), SWIFTLET_CANNOT_READ);
  EXPECT_EQ(small.code, SWIFTLET_CANNOT_READ);
  EXPECT_EQ(std::strlen(small.message), 23u) << "cut to what fits";
  swiftlet_error error{sizeof error, 0, ""};
  EXPECT_EQ(swiftlet_model_load("nowhere/ä", nullptr, &model, &error), SWIFTLET_CANNOT_READ);
  EXPECT_NE(std::string(error.message).find("nowhere/ä"), std::string::npos) << error.message;
  const double corners[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  const std::uint32_t dented[] = {0, 1, 2, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  swiftlet_level_arrays level{};
  level.size = sizeof level, level.vertices = corners, level.vertex_count = 4;
  level.face_vertices = dented, level.face_vertex_count = 12;
  EXPECT_EQ(swiftlet_model_from_levels(&level, 1, nullptr, &model, &error), SWIFTLET_NOT_CONVEX) << error.message;
  EXPECT_EQ(model, nullptr);
  swiftlet_body body = ball(0, 0, 0, 1);
  const swiftlet_pose pose = plain(Pose{});
  swiftlet_answer answer{};
  answer.size = sizeof answer;
  body.kind = 77;
  EXPECT_EQ(swiftlet_distance(&body, &body, &pose, nullptr, nullptr, &answer, &error), SWIFTLET_BAD_VALUE);
  EXPECT_STREQ(error.message, "a.kind is 77, no kind of body");
  body.kind = SWIFTLET_BODY_POINT;
  swiftlet_body without = body;  // no handle
  for (const auto& [kind, text] : {std::pair(SWIFTLET_BODY_MODEL, "a.model is null"),
                                   {SWIFTLET_BODY_MESH, "a.mesh is null"},
                                   {SWIFTLET_BODY_SOLID, "a.mesh is null"}}) {
    without.kind = kind;
    EXPECT_EQ(swiftlet_distance(&without, &body, &pose, nullptr, nullptr, &answer, &error), SWIFTLET_NULL_POINTER);
    EXPECT_STREQ(error.message, text);
  }
  without.kind = SWIFTLET_BODY_MODEL;
  std::vector<swiftlet_pair> pairs(80, {sizeof(swiftlet_pair), 0, &body, &body, pose, nullptr});
  std::vector<swiftlet_answer> answers(pairs.size(), answer);
  pairs[70].b = &without;
  EXPECT_EQ(swiftlet_distance_pairs(pairs.data(), pairs.size(), nullptr, nullptr, answers.data(), &error),
            SWIFTLET_NULL_POINTER);
  EXPECT_STREQ(error.message, "pair 70: b.model is null");
  EXPECT_EQ(swiftlet_distance(&body, &body, &pose, nullptr, nullptr, nullptr, &error), SWIFTLET_NULL_POINTER);
  EXPECT_STREQ(error.message, "answer is null");
  EXPECT_EQ(swiftlet_within(&body, &body, &pose, 1, nullptr, nullptr, nullptr, &answer, &error), SWIFTLET_NULL_POINTER);
  EXPECT_STREQ(error.message, "decision is null");
  EXPECT_EQ(swiftlet_distance_poses(&body, &body, &pose, 1, nullptr, nullptr, nullptr, &error), SWIFTLET_NULL_POINTER);
  EXPECT_STREQ(error.message, "answers is null");
  swiftlet_source source{};
  EXPECT_EQ(swiftlet_closest_features(&body, &body, &pose, nullptr, nullptr, &answer, nullptr, &source, &error),
            SWIFTLET_BAD_SIZE);
  EXPECT_EQ(std::string(error.message).rfind("source_b.size is 0", 0), 0u) << error.message;
  for (swiftlet_code code : {0, 1, 5, 11, 100, 101, 102, 103}) EXPECT_STRNE(swiftlet_code_text(code), swiftlet_code_text(-1));
}

/// A number of an answer that C++ has no room for is not taken for another one.
TEST(C, AnswersOfNoLevelAreRefused) {
  const swiftlet_body a = ball(0, 0, 0, 1), b = ball(0, 0, 5, 1);
  const swiftlet_pose pose = plain(Pose{});
  swiftlet_answer good{};
  good.size = sizeof good;
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, &good, Sound()), SWIFTLET_OK);
  const auto says = [&](const swiftlet_answer& answer, const char* text) {
    swiftlet_error error{sizeof error, 0, ""};
    swiftlet_check_result result{sizeof result, 7, "?"};
    swiftlet_manifold manifold{};
    manifold.size = sizeof manifold;
    swiftlet_answer refined = good;
    EXPECT_EQ(swiftlet_check(&a, &b, &pose, &answer, SWIFTLET_QUESTION_ANY, nullptr, &result, &error), SWIFTLET_BAD_VALUE);
    EXPECT_STREQ(error.message, text);
    EXPECT_EQ(result.ok, 7);
    EXPECT_EQ(swiftlet_contact_points(&a, &b, &pose, &answer, nullptr, nullptr, &manifold, nullptr), SWIFTLET_BAD_VALUE);
    EXPECT_EQ(swiftlet_refine(&a, &b, &pose, &answer, nullptr, nullptr, &refined, &error), SWIFTLET_BAD_VALUE);
    EXPECT_EQ(std::string(error.message), "so_far" + std::string(text).substr(std::strlen("answer")));
  };
  swiftlet_answer bad = good;
  bad.level_a = 65536;
  says(bad, "answer.level_a is 65536, not from -32768 to 32767");
  bad = good, bad.level_b = -65536;
  says(bad, "answer.level_b is -65536, not from -32768 to 32767");
  bad = good, bad.levels_visited = 256;
  says(bad, "answer.levels_visited is 256, not from 0 to 255");
  bad = good, bad.level_b = 7;
  swiftlet_check_result result{sizeof result, 7, "?"};
  EXPECT_EQ(swiftlet_check(&a, &b, &pose, &bad, SWIFTLET_QUESTION_ANY, nullptr, &result, Sound()), SWIFTLET_OK);
  EXPECT_EQ(result.ok, 0) << "a level that is not there is the answer's fault";
}

/// A true interval that is wider than law 2 allows is an answer to some question, not to an exact one.
TEST(C, ChecksWhatWasAsked) {
  const swiftlet_body a = ball(0, 0, 0, 1), b = ball(0, 0, 5, 1);
  const swiftlet_pose pose = plain(Pose{});
  swiftlet_answer answer{};
  answer.size = sizeof answer;
  ASSERT_EQ(swiftlet_distance(&a, &b, &pose, nullptr, nullptr, &answer, Sound()), SWIFTLET_OK);
  const auto holds = [&](std::int32_t asked) {
    swiftlet_check_result result{sizeof result, 7, "?"};
    EXPECT_EQ(swiftlet_check(&a, &b, &pose, &answer, asked, nullptr, &result, Sound()), SWIFTLET_OK);
    return result.ok;
  };
  EXPECT_EQ(holds(SWIFTLET_QUESTION_ANY), 1);
  EXPECT_EQ(holds(SWIFTLET_QUESTION_EXACT), 1);
  answer.lower -= 0.01;
  EXPECT_EQ(holds(SWIFTLET_QUESTION_ANY), 1);
  EXPECT_EQ(holds(SWIFTLET_QUESTION_EXACT), 0);
  swiftlet_check_result result{sizeof result, 7, "?"};
  swiftlet_error error{sizeof error, 0, ""};
  EXPECT_EQ(swiftlet_check(&a, &b, &pose, &answer, 2, nullptr, &result, &error), SWIFTLET_BAD_VALUE);
  EXPECT_STREQ(error.message, "asked is no question");
}

TEST(C, ModelsShowWhatTheyHold) {
  const Model& model = models()[0];
  const ModelHandle handle = handle_of(model);
  swiftlet_model_info info{};
  info.size = sizeof info;
  ASSERT_EQ(swiftlet_model_get_info(handle.get(), &info, Sound()), SWIFTLET_OK);
  EXPECT_TRUE(info.level_count == model.level_count() && info.dimension == model.dimension() &&
              same(info.radius, model.radius()) && same(model.box_max(), info.box_max) && info.map_level == model.map_level());
  for (int i = 0; i < info.level_count; ++i) {
    swiftlet_level level{};
    level.size = sizeof level;
    ASSERT_EQ(swiftlet_model_get_level(handle.get(), i, &level, Sound()), SWIFTLET_OK);
    const Level& wanted = model.level(i);
    ASSERT_EQ(level.vertex_count, wanted.view.vertices.size());
    ASSERT_EQ(level.face_count, wanted.view.face_first.size());
    EXPECT_EQ(std::memcmp(level.vertices, wanted.view.vertices.data(), wanted.view.vertices.size_bytes()), 0);
    EXPECT_EQ(std::memcmp(level.half_edges, wanted.view.half_edges.data(), wanted.view.half_edges.size_bytes()), 0);
    std::uint32_t loop[2];
    std::size_t count = 0;
    ASSERT_EQ(swiftlet_model_face(handle.get(), i, 0, loop, 2, &count, Sound()), SWIFTLET_OK);
    std::vector<std::uint32_t> all;
    for (const std::uint32_t v : FaceLoop(wanted.view, 0)) all.push_back(v);
    EXPECT_TRUE(count == all.size() && loop[0] == all[0] && loop[1] == all[1]);
  }
  const double up[] = {0, 0, 1};
  std::uint32_t top = 0;
  ASSERT_EQ(swiftlet_model_support(handle.get(), up, &top, Sound()), SWIFTLET_OK);
  EXPECT_EQ(top, model.support(Vec3::UnitZ()));
  swiftlet_model* cut = nullptr;
  const swiftlet_detail coarse{1e30, UINT64_MAX};
  ASSERT_EQ(swiftlet_model_cut(handle.get(), &coarse, &cut, Sound()), SWIFTLET_OK);
  const ModelHandle kept(cut);
  ASSERT_EQ(swiftlet_model_get_info(cut, &info, Sound()), SWIFTLET_OK);
  EXPECT_EQ(info.finest_level, info.level_count - 1);
  std::uint64_t hash = 0;
  ASSERT_EQ(swiftlet_model_get_hash(handle.get(), &hash, Sound()), SWIFTLET_OK);
  EXPECT_EQ(hash, model.hash());
  swiftlet_check_result result{sizeof result, 7, "?"};
  ASSERT_EQ(swiftlet_model_verify(handle.get(), &result, Sound()), SWIFTLET_OK);
  EXPECT_EQ(result.ok, 1);
}

TEST(C, FilesOfModelsAndMeshes) {
  const Folder folder;
  const std::string path = folder.path().string(), model_path = path + "/c_ä.swl", mesh_path = path + "/c_ä.swm";
  const ModelHandle model = handle_of(models()[0]);
  const MeshModel made = answers::meshes()[0];
  const MeshHandle mesh = handle_of(made);
  std::uint64_t written = 0;
  ASSERT_EQ(swiftlet_model_save(model.get(), model_path.c_str(), &written, Sound()), SWIFTLET_OK);
  EXPECT_EQ(written, models()[0].bytes().size());
  ASSERT_EQ(swiftlet_mesh_save(mesh.get(), mesh_path.c_str(), nullptr, Sound()), SWIFTLET_OK);
  swiftlet_model* m[4] = {};
  const swiftlet_detail coarse{1e30, UINT64_MAX};
  char note[40] = "?";
  ASSERT_EQ(swiftlet_model_load(model_path.c_str(), nullptr, &m[0], Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_model_map(model_path.c_str(), &coarse, &m[1], Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_model_ensure(m[1], 0, &m[2], Sound()), SWIFTLET_OK);
  for (const int level : {-1, models()[0].level_count()})
    EXPECT_EQ(swiftlet_model_ensure(m[2], level, &m[3], nullptr), SWIFTLET_BAD_VALUE) << level;
  ASSERT_EQ(swiftlet_model_salvage(model_path.c_str(), note, sizeof note, &m[3], Sound()), SWIFTLET_OK);
  EXPECT_STREQ(note, "");
  for (int i = 0; i < 4; ++i) {
    const ModelHandle handle(m[i]);
    swiftlet_model_info info{};
    info.size = sizeof info;
    ASSERT_EQ(swiftlet_model_get_info(m[i], &info, Sound()), SWIFTLET_OK);
    EXPECT_EQ(info.finest_level, i == 1 ? info.level_count - 1 : 0) << i;
  }
  swiftlet_mesh* n[3] = {};
  ASSERT_EQ(swiftlet_mesh_load(mesh_path.c_str(), nullptr, &n[0], Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_mesh_map(mesh_path.c_str(), &n[1], Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_mesh_salvage(mesh_path.c_str(), nullptr, 0, &n[2], Sound()), SWIFTLET_OK);
  for (swiftlet_mesh* one : n) {
    const MeshHandle handle(one);
    std::uint64_t hash = 0;
    ASSERT_EQ(swiftlet_mesh_get_hash(one, &hash, Sound()), SWIFTLET_OK);
    EXPECT_EQ(hash, made.hash());
  }
  std::int32_t is_mesh = 7;
  EXPECT_TRUE(swiftlet_is_mesh_file(mesh_path.c_str(), &is_mesh, Sound()) == SWIFTLET_OK && is_mesh == 1);
  EXPECT_TRUE(swiftlet_is_mesh_file(model_path.c_str(), &is_mesh, Sound()) == SWIFTLET_OK && is_mesh == 0);
}

int32_t cancel(double, void* calls) { return ++*static_cast<int*>(calls) < 2; }

TEST(C, MeshesFromTrianglesMoveAndCancel) {
  std::vector<double> points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  swiftlet_mesh *made = nullptr, *moved = nullptr;
  ASSERT_EQ(swiftlet_mesh_from_triangles(points.data(), 4, triangles, 4, nullptr, nullptr, &made, Sound()), SWIFTLET_OK);
  const MeshHandle mesh(made);
  swiftlet_mesh_info info{};
  info.size = sizeof info;
  ASSERT_EQ(swiftlet_mesh_get_info(made, &info, Sound()), SWIFTLET_OK);
  EXPECT_TRUE(info.triangle_count == 4 && info.is_closed == 1 && std::fabs(info.volume - 4.0 / 3) < 1e-15);
  double at[12];
  std::uint32_t corners[12];
  ASSERT_EQ(swiftlet_mesh_vertices(made, 0, 4, at, Sound()), SWIFTLET_OK);
  ASSERT_EQ(swiftlet_mesh_triangles(made, 0, 4, corners, Sound()), SWIFTLET_OK);
  for (int k = 0; k < 12; ++k) {
    const std::uint32_t user = info.source_vertex[corners[k]], triangle = info.source_triangle[k / 3];
    EXPECT_EQ(user, triangles[3 * triangle + std::uint32_t(k % 3)]);
    EXPECT_EQ(std::memcmp(at + 3 * corners[k], &points[3 * user], 24), 0);
  }
  EXPECT_EQ(swiftlet_mesh_vertices(made, 2, 3, at, nullptr), SWIFTLET_BAD_VALUE);
  for (double& x : points) x *= 2;
  ASSERT_EQ(swiftlet_mesh_refit(made, points.data(), 4, &moved, Sound()), SWIFTLET_OK);
  const MeshHandle larger(moved);
  ASSERT_EQ(swiftlet_mesh_get_info(moved, &info, Sound()), SWIFTLET_OK);
  EXPECT_EQ(info.box_max[2], 4);
  int calls = 0;
  EXPECT_EQ(swiftlet_mesh_from_triangles(points.data(), 4, triangles, 4, cancel, &calls, &moved, nullptr), SWIFTLET_CANCELLED);
}

TEST(C, HandlesAreSharedByThreads) {
  ModelHandle owner = handle_of(models()[0]);
  const swiftlet_model* model = owner.get();
  const Pose pose{Mat3::Identity(), Vec3(3, 0, 0)};
  const swiftlet_pose b_in_a = plain(pose);
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  const Answer wanted = distance(Body(models()[0]), Body(models()[0]), pose);
  for (int t = 0; t < 4; ++t) {
    swiftlet_model_retain(model);
    threads.emplace_back([&, model] {
      const swiftlet_body body = body_of(model);
      for (int i = 0; i < 500; ++i) {
        swiftlet_answer answer{};
        answer.size = sizeof answer;
        wrong += swiftlet_distance(&body, &body, &b_in_a, nullptr, nullptr, &answer, nullptr) || !same(wanted, answer);
        swiftlet_model_retain(model);
        swiftlet_model_release(model);
      }
      swiftlet_model_release(model);
    });
  }
  owner.reset();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace swiftlet
