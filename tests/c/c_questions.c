/* SPDX-FileCopyrightText: 2026 the swiftlet authors */
/* SPDX-License-Identifier: BSD-3-Clause */
#include "c_questions.h"

#include <stdio.h>
#include <string.h>

#define OR_RETURN(call)                   \
  do {                                    \
    const swiftlet_code code = (call);    \
    if (code != SWIFTLET_OK) return code; \
  } while (0)

swiftlet_code questions_ask(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, int are_convex,
                            struct questions_seeds* seeds, struct questions_answers* answers, swiftlet_error* error) {
  swiftlet_options loose;
  OR_RETURN(swiftlet_options_init(&loose, sizeof loose, error));
  loose.relative = 0.1;
  memset(answers, 0, sizeof *answers);
  answers->distance.size = answers->cold.size = answers->rough.size = answers->refined.size = sizeof(swiftlet_answer);
  answers->signed_distance.size = answers->intersects.size = answers->within.size = sizeof(swiftlet_answer);
  answers->signed_within.size = answers->closest.size = sizeof(swiftlet_answer);
  answers->source_a.size = answers->source_b.size = sizeof(swiftlet_source);
  answers->manifold.size = sizeof(swiftlet_manifold);
  OR_RETURN(swiftlet_distance(a, b, b_in_a, &seeds->distance, NULL, &answers->distance, error));
  OR_RETURN(swiftlet_distance(a, b, b_in_a, NULL, NULL, &answers->cold, error));
  OR_RETURN(swiftlet_distance(a, b, b_in_a, NULL, &loose, &answers->rough, error));
  OR_RETURN(swiftlet_signed_distance(a, b, b_in_a, &seeds->signed_distance, NULL, &answers->signed_distance, error));
  OR_RETURN(swiftlet_intersects(a, b, b_in_a, &seeds->intersects, NULL, &answers->intersects, error));
  OR_RETURN(swiftlet_within(a, b, b_in_a, 0.5, &seeds->within, NULL, &answers->is_within, &answers->within, error));
  OR_RETURN(swiftlet_signed_within(a, b, b_in_a, -0.1, &seeds->signed_within, NULL, &answers->is_signed_within,
                                   &answers->signed_within, error));
  OR_RETURN(swiftlet_closest_features(a, b, b_in_a, &seeds->closest, NULL, &answers->closest, &answers->source_a,
                                      &answers->source_b, error));
  OR_RETURN(swiftlet_tolerance(a, b, b_in_a, &answers->tolerance, error));
  if (!are_convex) return SWIFTLET_OK;
  OR_RETURN(swiftlet_refine(a, b, b_in_a, &answers->rough, NULL, NULL, &answers->refined, error));
  return swiftlet_contact_points(a, b, b_in_a, &answers->signed_distance, NULL, NULL, &answers->manifold, error);
}

static int wrong;

static void refused(swiftlet_code code, const swiftlet_error* error, const char* call) {
  if (code == SWIFTLET_NULL_POINTER && error->code == code && strstr(error->message, " is null")) return;
  ++wrong;
  printf("WRONG: %s: code %d, \"%s\"\n", call, (int)code, error->message);
}
#define REFUSED(call) (memset(&e, 0, sizeof e), e.size = sizeof e, refused((call), &e, #call))

int questions_of_nothing(const swiftlet_model* model, const swiftlet_mesh* mesh) {
  static const double numbers[3];
  swiftlet_error e;
  swiftlet_body point;
  swiftlet_pose pose;
  swiftlet_answer answer;
  swiftlet_pair pair;
  swiftlet_model* made = NULL;
  swiftlet_mesh* meshed = NULL;
  swiftlet_check_result result;
  swiftlet_manifold manifold;
  swiftlet_contact_list found;
  const swiftlet_pose zero = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  memset(&point, 0, sizeof point), memset(&answer, 0, sizeof answer), memset(&pair, 0, sizeof pair);
  memset(&manifold, 0, sizeof manifold), memset(&found, 0, sizeof found), memset(&result, 0, sizeof result);
  point.size = sizeof point, point.kind = SWIFTLET_BODY_POINT;
  answer.size = sizeof answer, pair.size = sizeof pair, result.size = sizeof result;
  manifold.size = sizeof manifold, found.size = sizeof found;
  wrong = 0;
  pose = zero;
  REFUSED(swiftlet_relative(NULL, &pose, &pose, &e));
  REFUSED(swiftlet_relative(&pose, NULL, &pose, &e));
  REFUSED(swiftlet_relative(&pose, &pose, NULL, &e));
  REFUSED(swiftlet_inverse(NULL, &pose, &e));
  REFUSED(swiftlet_inverse(&pose, NULL, &e));
  REFUSED(swiftlet_executor_on_threads(2, NULL, &e));
  REFUSED(swiftlet_executor_create(NULL, NULL, NULL, &e));
  REFUSED(swiftlet_model_options_init(NULL, 8, &e));
  REFUSED(swiftlet_options_init(NULL, 8, &e));
  REFUSED(swiftlet_effort_init(NULL, 8, &e));
  REFUSED(swiftlet_closest_options_init(NULL, 8, &e));
  REFUSED(swiftlet_manifold_options_init(NULL, 8, &e));
  REFUSED(swiftlet_march_rule_init(NULL, 8, &e));
  REFUSED(swiftlet_model_load(NULL, NULL, &made, &e));
  REFUSED(swiftlet_model_load("a", NULL, NULL, &e));
  REFUSED(swiftlet_model_map(NULL, NULL, &made, &e));
  REFUSED(swiftlet_model_salvage(NULL, NULL, 0, &made, &e));
  REFUSED(swiftlet_model_from_bytes(NULL, 8, NULL, &made, &e));
  REFUSED(swiftlet_model_from_levels(NULL, 1, NULL, &made, &e));
  REFUSED(swiftlet_model_save(NULL, "a", NULL, &e));
  REFUSED(swiftlet_model_save(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_cut(NULL, NULL, &made, &e));
  REFUSED(swiftlet_model_cut(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_ensure(NULL, 0, &made, &e));
  REFUSED(swiftlet_model_with_table(model, NULL, &made, &e));
  REFUSED(swiftlet_model_get_info(NULL, NULL, &e));
  REFUSED(swiftlet_model_get_info(model, NULL, &e));
  REFUSED(swiftlet_model_get_level(model, 0, NULL, &e));
  REFUSED(swiftlet_model_face(model, 0, 0, NULL, 0, NULL, &e));
  REFUSED(swiftlet_model_get_source(model, NULL, &e));
  REFUSED(swiftlet_model_support(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_get_table(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_table_start(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_get_bytes(model, NULL, NULL, &e));
  REFUSED(swiftlet_model_get_hash(model, NULL, &e));
  REFUSED(swiftlet_model_verify(NULL, &result, &e));
  REFUSED(swiftlet_mesh_from_triangles(NULL, 3, NULL, 1, NULL, NULL, &meshed, &e));
  REFUSED(swiftlet_mesh_from_triangles(numbers, 1, NULL, 0, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_mesh_refit(mesh, NULL, 8, &meshed, &e));
  REFUSED(swiftlet_mesh_load(NULL, NULL, &meshed, &e));
  REFUSED(swiftlet_mesh_map(NULL, &meshed, &e));
  REFUSED(swiftlet_mesh_salvage(NULL, NULL, 0, &meshed, &e));
  REFUSED(swiftlet_mesh_from_bytes(NULL, 8, &meshed, &e));
  REFUSED(swiftlet_mesh_save(mesh, NULL, NULL, &e));
  REFUSED(swiftlet_mesh_cut(mesh, NULL, NULL, &e));
  REFUSED(swiftlet_is_mesh_file(NULL, NULL, &e));
  REFUSED(swiftlet_mesh_get_info(mesh, NULL, &e));
  REFUSED(swiftlet_mesh_deviation(mesh, 1, NULL, &e));
  REFUSED(swiftlet_mesh_vertices(mesh, 0, 1, NULL, &e));
  REFUSED(swiftlet_mesh_triangles(mesh, 0, 1, NULL, &e));
  REFUSED(swiftlet_mesh_get_bytes(mesh, NULL, NULL, &e));
  REFUSED(swiftlet_mesh_get_hash(mesh, NULL, &e));
  REFUSED(swiftlet_mesh_verify(NULL, &result, &e));
  REFUSED(swiftlet_distance(NULL, &point, &pose, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_distance(&point, NULL, &pose, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_distance(&point, &point, NULL, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_distance(&point, &point, &pose, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_refine(&point, &point, &pose, NULL, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_signed_distance(&point, &point, &pose, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_intersects(&point, &point, &pose, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_within(&point, &point, &pose, 1, NULL, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_signed_within(&point, &point, &pose, 1, NULL, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_closest_features(&point, &point, &pose, NULL, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_tolerance(&point, &point, &pose, NULL, &e));
  REFUSED(swiftlet_distance_pairs(NULL, 1, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_distance_pairs(&pair, 1, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_signed_distance_pairs(&pair, 1, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_intersects_pairs(&pair, 1, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_within_pairs(&pair, 1, 1, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_signed_within_pairs(&pair, 1, 1, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_closest_features_pairs(&pair, 1, NULL, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_distance_poses(&point, &point, NULL, 1, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_signed_distance_poses(&point, &point, &pose, 1, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_intersects_poses(NULL, &point, &pose, 1, NULL, NULL, &answer, &e));
  REFUSED(swiftlet_within_poses(&point, &point, &pose, 1, 1, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_signed_within_poses(&point, &point, &pose, 1, 1, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_closest_features_poses(&point, &point, &pose, 1, NULL, NULL, NULL, NULL, NULL, &e));
  REFUSED(swiftlet_contact_points(&point, &point, &pose, NULL, NULL, NULL, &manifold, &e));
  REFUSED(swiftlet_contacts(&point, &point, &pose, 1, NULL, NULL, 3, &found, &e));
  REFUSED(swiftlet_contacts(&point, &point, &pose, 1, NULL, NULL, 0, NULL, &e));
  REFUSED(swiftlet_contact_manifold(&point, &point, &pose, NULL, NULL, NULL, &manifold, &e));
  REFUSED(swiftlet_check(&point, &point, &pose, NULL, 0, NULL, &result, &e));
  REFUSED(swiftlet_march(NULL, 0, model, 0, &pose, 0, 0, NULL, NULL, &e));
  REFUSED(swiftlet_march(model, 0, model, 0, NULL, 0, 0, NULL, NULL, &e));
  point.kind = SWIFTLET_BODY_MODEL;
  REFUSED(swiftlet_distance(&point, &point, &pose, NULL, NULL, &answer, &e));
  point.kind = SWIFTLET_BODY_SOLID;
  REFUSED(swiftlet_distance(&point, &point, &pose, NULL, NULL, &answer, &e));
  if (swiftlet_distance(NULL, NULL, NULL, NULL, NULL, NULL, NULL) != SWIFTLET_NULL_POINTER) ++wrong;  /* no error to write to */
  swiftlet_model_release(swiftlet_model_retain(NULL));
  swiftlet_mesh_release(swiftlet_mesh_retain(NULL));
  swiftlet_executor_release(NULL);
  return wrong;
}
