// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "swiftlet_c.h"

#include <bit>
#include <cstdio>
#include <span>
#include <vector>

#include <swiftlet/depth.h>

struct swiftlet_model {
  swiftlet::Model model;
};

namespace {

using swiftlet::Answer;
using swiftlet::Body;
using swiftlet::Options;
using swiftlet::PairSeed;
using swiftlet::Pose;
using swiftlet::Vec3;

static_assert(int(swiftlet::Status::InvalidBody) == SWIFTLET_INVALID_BODY);
static_assert(int(swiftlet::Verdict::Overlapping) == SWIFTLET_OVERLAPPING);

Body body_of(const swiftlet_body& body) {
  const Vec3 p(body.corners[0]), q(body.corners[1]), r(body.corners[2]);
  switch (body.kind) {
    case SWIFTLET_POINT: return Body::point(p, body.radius);
    case SWIFTLET_SEGMENT: return Body::segment(p, q, body.radius);
    case SWIFTLET_TRIANGLE: return Body::triangle(p, q, r, body.radius);
    case SWIFTLET_BOX: return Body::box(p, q, body.radius);
    default: return Body(body.model->model, body.radius);
  }
}

Pose pose_of(const swiftlet_pose& pose) {
  Pose result;
  for (int row = 0; row < 3; ++row) result.rotation.row(row) = Vec3(pose.rotation[row]);
  result.translation = Vec3(pose.translation);
  return result;
}

Options options_of(const swiftlet_options* options) {
  Options result;
  if (!options) return result;
  result.absolute = options->absolute, result.relative = options->relative;
  if (options->beyond > 0) result.beyond = options->beyond;
  return result;
}

swiftlet_answer answer_of(const Answer& answer) {
  swiftlet_answer result{};
  result.status = swiftlet_status(answer.status);
  result.verdict = swiftlet_verdict(answer.verdict);
  result.lower = answer.lower, result.upper = answer.upper;
  Vec3::Map(result.normal) = answer.normal;
  Vec3::Map(result.point_a) = answer.point_a;
  Vec3::Map(result.point_b) = answer.point_b;
  return result;
}

using Query = Answer (*)(const Body&, const Body&, const Pose&, PairSeed&, const Options&);

swiftlet_answer ask(Query query, const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                    swiftlet_seed* seed, const swiftlet_options* options) {
  PairSeed kept = seed ? std::bit_cast<PairSeed>(*seed) : PairSeed{};
  const Answer answer = query(body_of(*a), body_of(*b), pose_of(*b_in_a), kept, options_of(options));
  if (seed) *seed = std::bit_cast<swiftlet_seed>(kept);
  return answer_of(answer);
}

}  // namespace

swiftlet_model* swiftlet_model_create(const double (*vertices)[3], size_t vertex_count, const uint32_t (*triangles)[3],
                                      size_t triangle_count, char* message, size_t size) {
  const std::vector<Vec3> points(vertices, vertices + vertex_count);
  swiftlet::LevelArrays arrays;
  arrays.vertices = points;
  arrays.face_vertices = {triangles[0], 3 * triangle_count};
  const auto model = swiftlet::Model::from_level(arrays);
  if (model) return new swiftlet_model{model.value()};
  std::snprintf(message, size, "%s", model.error().message.c_str());
  return nullptr;
}

void swiftlet_model_destroy(swiftlet_model* model) { delete model; }

swiftlet_answer swiftlet_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                  swiftlet_seed* seed, const swiftlet_options* options) {
  return ask(swiftlet::distance, a, b, b_in_a, seed, options);
}

swiftlet_answer swiftlet_signed_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                         swiftlet_seed* seed, const swiftlet_options* options) {
  return ask(swiftlet::signed_distance, a, b, b_in_a, seed, options);
}
