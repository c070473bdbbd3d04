// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Manifolds, contacts of meshes, and checks.
#include <algorithm>
#include <cstddef>
#include <vector>

#include <swiftlet/check.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh_contacts.h>

#include "convert.h"

using namespace swiftlet;
using namespace swiftlet::c;

namespace {

static_assert(sizeof(swiftlet_manifold_point) == 64 && kMostManifoldPoints == std::size(swiftlet_manifold{}.points));

swiftlet_manifold_options default_options() {
  const ManifoldOptions from;
  return {sizeof(swiftlet_manifold_options), from.most_points, from.margin, from.flatness};
}

ManifoldOptions options_of(const swiftlet_manifold_options* given) {
  if (!given) return {};
  swiftlet_manifold_options room = default_options();
  const swiftlet_manifold_options& from = read(given, room, "options");
  need(from.most_points >= 1 && from.most_points <= kMostManifoldPoints, "options.most_points is not from 1 to 8");
  return {from.margin, from.most_points, from.flatness};
}

Manifold manifold_of(const swiftlet_manifold* given) {
  Manifold to;
  if (!given) return to;
  swiftlet_manifold room{};
  const swiftlet_manifold& from = read(given, room, "previous", sizeof room);
  need(from.count <= kMostManifoldPoints, "previous.count is above 8");
  to.normal = Vec3(from.normal);
  to.face_a = feature_of(from.face_a), to.face_b = feature_of(from.face_b);
  to.count = from.count;
  for (std::uint32_t i = 0; i < from.count; ++i) {
    const swiftlet_manifold_point& p = from.points[i];
    to.points[i] = {Vec3(p.point_a), Vec3(p.point_b), p.separation, feature_of(p.feature_a), feature_of(p.feature_b)};
  }
  return to;
}

swiftlet_manifold plain(const Manifold& from) {
  swiftlet_manifold to{};
  to.count = from.count;
  copy(from.normal, to.normal);
  to.face_a = c::plain(from.face_a), to.face_b = c::plain(from.face_b);
  for (std::uint32_t i = 0; i < from.count; ++i) {
    const ManifoldPoint& p = from.points[i];
    copy(p.point_a, to.points[i].point_a);
    copy(p.point_b, to.points[i].point_b);
    to.points[i].separation = p.separation;
    to.points[i].feature_a = c::plain(p.feature_a), to.points[i].feature_b = c::plain(p.feature_b);
  }
  return to;
}

MeshContact contact_of(const swiftlet_contact* given) {
  swiftlet_contact room{};
  const swiftlet_contact& from = read(given, room, "contact", sizeof room);
  MeshContact to;
  to.lower = from.lower, to.upper = from.upper;
  to.verdict = enumerator(from.verdict, Verdict::Overlapping, "contact.verdict");
  to.feature_a = feature_of(from.feature_a), to.feature_b = feature_of(from.feature_b);
  to.triangle_a = from.triangle_a, to.triangle_b = from.triangle_b;
  to.point_a = Vec3(from.point_a), to.point_b = Vec3(from.point_b), to.normal = Vec3(from.normal);
  to.box_min = Vec3(from.box_min), to.box_max = Vec3(from.box_max);
  return to;
}

swiftlet_contact plain(const MeshContact& from) {
  swiftlet_contact to{};
  to.verdict = std::int32_t(from.verdict);
  to.lower = from.lower, to.upper = from.upper;
  to.feature_a = c::plain(from.feature_a), to.feature_b = c::plain(from.feature_b);
  to.triangle_a = from.triangle_a, to.triangle_b = from.triangle_b;
  copy(from.point_a, to.point_a);
  copy(from.point_b, to.point_b);
  copy(from.normal, to.normal);
  copy(from.box_min, to.box_min);
  copy(from.box_max, to.box_max);
  return to;
}

static_assert(int(Question::Any) == SWIFTLET_QUESTION_ANY && int(Question::Exact) == SWIFTLET_QUESTION_EXACT);

/// A result of a check that can be written.
void need_result(const swiftlet_check_result* result) {
  need(result, "result");
  check_output(result, "result", 16);
}

void hand_out(const Check& check, swiftlet_check_result* to) {
  to->ok = check.ok;
  copy_text(check.message, to->message, to->size - offsetof(swiftlet_check_result, message));
}

}  // namespace

swiftlet_code swiftlet_manifold_options_init(swiftlet_manifold_options* options, size_t size, swiftlet_error* error) {
  return init(default_options(), options, size, error);
}

swiftlet_code swiftlet_contact_points(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                      const swiftlet_answer* answer, const swiftlet_manifold_options* options,
                                      const swiftlet_manifold* previous, struct swiftlet_manifold* to, swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need(!body_a.is_mesh() && !body_b.is_mesh(), "meshes have contacts, and each of these has a manifold");
    need(to, "manifold");
    check_output(to, "manifold");
    write(plain(manifold(body_a.convex(), body_b.convex(), pose_of(b_in_a), answer_of(answer, "answer"), options_of(options),
                         manifold_of(previous))),
          to);
  });
}

swiftlet_code swiftlet_contacts(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, double reach,
                                const swiftlet_budget* budget, swiftlet_contact* into, size_t capacity,
                                swiftlet_contact_list* found, swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need(found, "found");
    check_output(found, "found");
    if (capacity) need(into, "contacts");
    const std::size_t stride = capacity ? into->size : 0;
    if (capacity) check_output(into, "contacts");
    std::vector<MeshContact> room(capacity);
    const MeshContacts all =
        contacts(body_a.mesh(), body_b.mesh(), pose_of(b_in_a), reach, room, budget ? budget_of(*budget) : Budget{});
    for (std::size_t i = 0; i < all.stored; ++i)
      write_bytes(plain(room[i]), stride, reinterpret_cast<char*>(into) + i * stride);
    write(swiftlet_contact_list{0, std::int32_t(all.status), all.is_counted, all.count, all.stored, all.steps, all.plane_tests,
                                0},
          found);
  });
}

swiftlet_code swiftlet_contact_manifold(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                        const swiftlet_contact* contact, const swiftlet_manifold_options* options,
                                        const swiftlet_manifold* previous, struct swiftlet_manifold* to,
                                        swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need(to, "manifold");
    check_output(to, "manifold");
    write(plain(manifold(body_a.mesh(), body_b.mesh(), pose_of(b_in_a), contact_of(contact), options_of(options),
                         manifold_of(previous))),
          to);
  });
}

swiftlet_code swiftlet_check(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                             const swiftlet_answer* answer, int32_t asked, const swiftlet_overlap_proof* proof,
                             swiftlet_check_result* result, swiftlet_error* error) {
  return guard(error, [&] {
    const GivenBody body_a(a, "a"), body_b(b, "b");
    need_result(result);
    need(asked == SWIFTLET_QUESTION_ANY || asked == SWIFTLET_QUESTION_EXACT, "asked is no question");
    const Answer claimed = answer_of(answer, "answer");
    const Pose pose = pose_of(b_in_a);
    if (body_a.is_mesh() || body_b.is_mesh()) {
      need(!proof, "of meshes there is no proof of an overlap");
      return hand_out(check(body_a.mesh(), body_b.mesh(), pose, claimed), result);
    }
    const OverlapProof proved = proof ? proof_of(*proof) : OverlapProof{};
    need(proved.count <= proved.vertex_a.size(), "proof.count is above 4");
    hand_out(check(body_a.convex(), body_b.convex(), pose, claimed, Question(asked), proof ? &proved : nullptr), result);
  });
}

swiftlet_code swiftlet_model_verify(const swiftlet_model* model, swiftlet_check_result* result, swiftlet_error* error) {
  return guard(error, [&] {
    need_result(result);
    hand_out(verify(model_of(model)), result);
  });
}

swiftlet_code swiftlet_mesh_verify(const swiftlet_mesh* mesh, swiftlet_check_result* result, swiftlet_error* error) {
  return guard(error, [&] {
    need_result(result);
    hand_out(verify(mesh_of(mesh)), result);
  });
}
