// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Structs of C as those of C++ and back. Asks nothing.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include <swiftlet/mesh_query.h>
#include <swiftlet/query.h>

#include "handles.h"
#include "sized.h"

namespace swiftlet::c {

static_assert(int(BodyKind::Model) == SWIFTLET_BODY_MODEL && int(BodyKind::Point) == SWIFTLET_BODY_POINT);
static_assert(int(BodyKind::Segment) == SWIFTLET_BODY_SEGMENT && int(BodyKind::Triangle) == SWIFTLET_BODY_TRIANGLE);
static_assert(int(BodyKind::Box) == SWIFTLET_BODY_BOX);
static_assert(int(FeatureKind::None) == SWIFTLET_FEATURE_NONE && int(FeatureKind::Vertex) == SWIFTLET_FEATURE_VERTEX);
static_assert(int(FeatureKind::Edge) == SWIFTLET_FEATURE_EDGE && int(FeatureKind::Face) == SWIFTLET_FEATURE_FACE);
static_assert(kNone == SWIFTLET_NO_INDEX);
static_assert(sizeof(swiftlet_seed) == 128 && sizeof(PairSeed) <= 128 && sizeof(MeshSeed) <= 128);
static_assert(sizeof(swiftlet_pose) == 96 && sizeof(swiftlet_budget) == 8 && sizeof(swiftlet_overlap_proof) == 36);

inline FeatureId feature_of(swiftlet_feature feature) { return {FeatureKind(feature >> 30), feature & 0x3fffffffu}; }
inline swiftlet_feature plain(FeatureId feature) { return std::uint32_t(feature.kind()) << 30 | feature.index(); }

inline Pose pose_of(const swiftlet_pose* from) {
  need(from, "b_in_a");
  Pose to;
  to.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(from->rotation);
  to.translation = Eigen::Map<const Vec3>(from->translation);
  return to;
}

inline void copy(const Pose& from, swiftlet_pose* to) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(to->rotation) = from.rotation;
  copy(from.translation, to->translation);
}

/// A body as the caller says it: all of it, whatever its size was.
class GivenBody {
 public:
  GivenBody(const swiftlet_body* from, const char* name) : body_(whole(from, name)), name_(name) {}
  GivenBody(const GivenBody&) = delete;
  GivenBody& operator=(const GivenBody&) = delete;
  bool is_mesh() const { return body_.kind == SWIFTLET_BODY_MESH || body_.kind == SWIFTLET_BODY_SOLID; }
  Body convex() const;
  MeshBody mesh() const {
    if (!is_mesh()) return convex();
    need_handle(body_.mesh, ".mesh");
    const MeshModel& mesh = mesh_of(body_.mesh);
    return body_.kind == SWIFTLET_BODY_SOLID ? MeshBody::solid(mesh, body_.radius) : MeshBody(mesh, body_.radius);
  }

 private:
  const swiftlet_body& whole(const swiftlet_body* from, const char* name) {
    if (from && from->size == sizeof room_) return *from;
    room_ = {};
    return read(from, room_, name);
  }
  void need_handle(const void* handle, const char* member) const {
    if (!handle) throw Failure{SWIFTLET_NULL_POINTER, std::string(name_) + member + " is null"};
  }
  swiftlet_body room_;  ///< written where the caller's is of another size
  const swiftlet_body& body_;
  const char* name_;
};

inline Body GivenBody::convex() const {
  const auto point = [&](int i) { return Vec3(body_.points[i]); };
  switch (body_.kind) {
    case SWIFTLET_BODY_MODEL: need_handle(body_.model, ".model"); return Body(model_of(body_.model), body_.radius);
    case SWIFTLET_BODY_POINT: return Body::point(point(0), body_.radius);
    case SWIFTLET_BODY_SEGMENT: return Body::segment(point(0), point(1), body_.radius);
    case SWIFTLET_BODY_TRIANGLE: return Body::triangle(point(0), point(1), point(2), body_.radius);
    case SWIFTLET_BODY_BOX: return Body::box(point(0), point(1), body_.radius);
    default:
      throw Failure{SWIFTLET_BAD_VALUE, std::string(name_) + ".kind is " + std::to_string(body_.kind) + ", no kind of body"};
  }
}

// ---- Seeds -----------------------------------------------------------------------------------------------------------------

// 0 bytes are a cold start: of a mesh's seed they stand for no triangles.
inline void flip(PairSeed&) {}
inline void flip(MeshSeed& seed) { seed.triangle_a = ~seed.triangle_a, seed.triangle_b = ~seed.triangle_b; }
static_assert(kNone == ~std::uint32_t{0});

template <class Seed>
Seed seed_of(const swiftlet_seed* from) {
  Seed to;
  if (!from) return to;
  std::memcpy(static_cast<void*>(&to), from, sizeof to);
  flip(to);
  return to;
}

template <class Seed>
void keep(Seed from, swiftlet_seed* to) {
  if (!to) return;
  flip(from);
  std::memcpy(to, &from, sizeof from);
}

// ---- Options ---------------------------------------------------------------------------------------------------------------

static_assert(int(StartPolicy::Automatic) == SWIFTLET_START_AUTOMATIC && int(StartPolicy::Paper) == SWIFTLET_START_PAPER);
static_assert(int(StartPolicy::Finest) == SWIFTLET_START_FINEST && int(StartPolicy::Coarsest) == SWIFTLET_START_COARSEST);
static_assert(int(StartPolicy::Table) == SWIFTLET_START_TABLE && int(Refinement::Single) == SWIFTLET_REFINEMENT_SINGLE);
static_assert(int(Refinement::SingleSingle) == SWIFTLET_REFINEMENT_SINGLE_SINGLE);
static_assert(int(Refinement::DoubleDouble) == SWIFTLET_REFINEMENT_DOUBLE_DOUBLE);
static_assert(int(PlaneRule::MostViolated) == SWIFTLET_PLANE_RULE_MOST_VIOLATED);
static_assert(int(PlaneRule::FirstViolated) == SWIFTLET_PLANE_RULE_FIRST_VIOLATED);
static_assert(int(Doubt::None) == SWIFTLET_DOUBT_NONE && int(Doubt::NoMinimum) == SWIFTLET_DOUBT_NO_MINIMUM);
static_assert(int(Doubt::Neighbour) == SWIFTLET_DOUBT_NEIGHBOUR && int(Doubt::Width) == SWIFTLET_DOUBT_WIDTH);
static_assert(int(Doubt::Lean) == SWIFTLET_DOUBT_LEAN && int(Doubt::Threshold) == SWIFTLET_DOUBT_THRESHOLD);
static_assert(int(Doubt::Asked) == SWIFTLET_DOUBT_ASKED);

inline swiftlet_budget plain(const Budget& budget) { return {budget.steps, budget.finest_level}; }
inline swiftlet_tuning plain(const Tuning& tuning) {
  return {std::int32_t(tuning.start),
          std::int32_t(tuning.refinement),
          std::int32_t(tuning.plane_rule),
          tuning.careful,
          nullptr,
          0,
          nullptr};
}

inline Budget budget_of(const swiftlet_budget& budget) { return {budget.steps, budget.finest_level}; }

/// Without trace and proof.
inline Tuning tuning_of(const swiftlet_tuning& from) {
  Tuning to;
  to.start = enumerator(from.start, StartPolicy::Table, "tuning.start");
  to.refinement = enumerator(from.refinement, Refinement::DoubleDouble, "tuning.refinement");
  to.plane_rule = enumerator(from.plane_rule, PlaneRule::FirstViolated, "tuning.plane_rule");
  to.careful = from.careful != 0;
  return to;
}

inline swiftlet_overlap_proof plain(const OverlapProof& from) {
  swiftlet_overlap_proof to{};
  to.count = from.count;
  std::copy(from.vertex_a.begin(), from.vertex_a.end(), to.vertex_a);
  std::copy(from.vertex_b.begin(), from.vertex_b.end(), to.vertex_b);
  return to;
}

inline OverlapProof proof_of(const swiftlet_overlap_proof& from) {
  OverlapProof to;
  to.count = from.count;
  std::copy(from.vertex_a, from.vertex_a + 4, to.vertex_a.begin());
  std::copy(from.vertex_b, from.vertex_b + 4, to.vertex_b.begin());
  return to;
}

/// What one query reports beside its answer: room for it, and the way to the caller.
class Report {
 public:
  Report(const swiftlet_tuning* to, Tuning& tuning) : to_(to) {
    if (!to) return;
    if (to->trace_count) need(to->trace, "tuning.trace");
    levels_.resize(std::min<std::size_t>(to->trace_count, 255));  // more no query visits
    tuning.trace = levels_;
    if (to->proof) tuning.proof = &proof_;
  }
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;
  void hand_out(const Answer& answer) const {
    if (!to_) return;
    for (std::size_t i = 0; i < std::min<std::size_t>(answer.levels_visited, levels_.size()); ++i) {
      const LevelRecord& from = levels_[i];
      to_->trace[i] = {
          from.level_a, from.level_b, from.lower, from.upper, from.steps, from.plane_tests, std::int32_t(from.doubt), 0};
    }
    if (to_->proof) *to_->proof = plain(proof_);
  }

 private:
  const swiftlet_tuning* to_;
  std::vector<LevelRecord> levels_;
  OverlapProof proof_;
};

// ---- Answers ---------------------------------------------------------------------------------------------------------------

static_assert(int(Status::NotAsked) == SWIFTLET_STATUS_NOT_ASKED && int(Status::Converged) == SWIFTLET_STATUS_CONVERGED);
static_assert(int(Status::Beyond) == SWIFTLET_STATUS_BEYOND && int(Status::Budget) == SWIFTLET_STATUS_BUDGET);
static_assert(int(Status::LevelLimit) == SWIFTLET_STATUS_LEVEL_LIMIT);
static_assert(int(Status::NotConverged) == SWIFTLET_STATUS_NOT_CONVERGED);
static_assert(int(Status::InvalidPose) == SWIFTLET_STATUS_INVALID_POSE);
static_assert(int(Status::InvalidRadius) == SWIFTLET_STATUS_INVALID_RADIUS);
static_assert(int(Status::InvalidBody) == SWIFTLET_STATUS_INVALID_BODY);
static_assert(int(Verdict::Undecided) == SWIFTLET_VERDICT_UNDECIDED && int(Verdict::Disjoint) == SWIFTLET_VERDICT_DISJOINT);
static_assert(int(Verdict::Touching) == SWIFTLET_VERDICT_TOUCHING && int(Verdict::Overlapping) == SWIFTLET_VERDICT_OVERLAPPING);
static_assert(int(Decision::Undecided) == SWIFTLET_DECISION_UNDECIDED && int(Decision::No) == SWIFTLET_DECISION_NO);
static_assert(int(Decision::Yes) == SWIFTLET_DECISION_YES);

inline swiftlet_answer plain(const Answer& from) {
  swiftlet_answer to;
  to.size = sizeof to;
  to.status = std::int32_t(from.status), to.verdict = std::int32_t(from.verdict), to.is_signed = from.is_signed;
  to.lower = from.lower, to.upper = from.upper;
  copy(from.normal, to.normal);
  copy(from.point_a, to.point_a);
  copy(from.point_b, to.point_b);
  to.feature_a = plain(from.feature_a), to.feature_b = plain(from.feature_b);
  to.level_a = from.level_a, to.level_b = from.level_b;
  to.steps = from.steps, to.plane_tests = from.plane_tests;
  to.radius_a = from.radius_a, to.radius_b = from.radius_b;
  to.levels_visited = from.levels_visited, to.reserved = 0;
  return to;
}

inline Answer answer_of(const swiftlet_answer* given, const char* name) {
  swiftlet_answer room{};
  const swiftlet_answer& from = read(given, room, name, sizeof(swiftlet_answer));
  const auto member = [name](const char* of) { return std::string(name) + "." + of; };
  Answer to;
  to.status = enumerator(from.status, Status::InvalidBody, member("status"));
  to.verdict = enumerator(from.verdict, Verdict::Overlapping, member("verdict"));
  to.is_signed = from.is_signed != 0;
  to.lower = from.lower, to.upper = from.upper;
  to.normal = Vec3(from.normal), to.point_a = Vec3(from.point_a), to.point_b = Vec3(from.point_b);
  to.feature_a = feature_of(from.feature_a), to.feature_b = feature_of(from.feature_b);
  to.level_a = narrow<std::int16_t>(from.level_a, member("level_a"));
  to.level_b = narrow<std::int16_t>(from.level_b, member("level_b"));
  to.steps = from.steps, to.plane_tests = from.plane_tests;
  to.radius_a = from.radius_a, to.radius_b = from.radius_b;
  to.levels_visited = narrow<std::uint8_t>(from.levels_visited, member("levels_visited"));
  return to;
}

inline swiftlet_source plain(const SourceFeature& from) {
  swiftlet_source to{};
  to.kind = std::int32_t(from.kind);
  std::copy(from.vertices.begin(), from.vertices.end(), to.vertices);
  to.triangles = from.triangles.data(), to.triangle_count = from.triangles.size();
  return to;
}

}  // namespace swiftlet::c
