// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdio.h>
#include <swiftlet/swiftlet.h>

int main(void) {
  const double corners[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}; /* counter-clockwise seen from outside */
  swiftlet_level_arrays level = {.size = sizeof level};          /* what is not said is 0 */
  level.vertices = corners, level.vertex_count = 4;
  level.face_vertices = faces, level.face_vertex_count = 12;
  swiftlet_error error = {.size = sizeof error};
  swiftlet_model* model = NULL;
  if (swiftlet_model_from_levels(&level, 1, NULL, &model, &error)) return puts(error.message), 1;
  /* or, of a file that the tool wrote: swiftlet_model_load("link.swl", NULL, &model, &error) */

  const swiftlet_body tetrahedron = {.size = sizeof tetrahedron, .kind = SWIFTLET_BODY_MODEL, .model = model};
  const swiftlet_body ball = {.size = sizeof ball, .kind = SWIFTLET_BODY_POINT, .radius = 0.25}; /* around 0, 0, 0 */
  const swiftlet_pose b_in_a = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {2, 2, 2}};
  swiftlet_seed seed = {{0}}; /* cold; then warm from query to query */
  swiftlet_answer answer = {.size = sizeof answer};
  if (swiftlet_distance(&tetrahedron, &ball, &b_in_a, &seed, NULL, &answer, &error)) return puts(error.message), 1;
  printf("distance %.12f, proved to %.0e\n", answer.lower, answer.upper - answer.lower);
  printf("normal (%.6f, %.6f, %.6f)\n", answer.normal[0], answer.normal[1], answer.normal[2]);

  swiftlet_pose poses[3] = {{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {2, 2, 2}}, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 1, 1}}};
  swiftlet_answer answers[3] = {{.size = sizeof answers[0]}}; /* the first one's size is that of all */
  poses[2] = poses[0], poses[2].rotation[0] = 3;              /* no rotation: a status, for this pose alone */
  if (swiftlet_signed_distance_poses(&tetrahedron, &ball, poses, 3, NULL, NULL, answers, &error)) return puts(error.message), 1;
  for (int i = 0; i < 3; ++i) printf("pose %d: status %d, at least %.6f\n", i, (int)answers[i].status, answers[i].lower);
  swiftlet_model_release(model);
  return 0;
}
