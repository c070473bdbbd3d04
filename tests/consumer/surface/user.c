/* SPDX-FileCopyrightText: 2026 the swiftlet authors */
/* SPDX-License-Identifier: BSD-3-Clause */
#include "user.h"

#include <math.h>
#include <stdio.h>

#include "swiftlet_c.h"

static int wrong = 0;

static void expect(int holds, const char* claim) {
  if (!holds) ++wrong, printf("WRONG, from C: %s\n", claim);
}

static int is_near(double value, double truth) { return fabs(value - truth) < 1e-12; }

static swiftlet_pose at(double x, double y, double z) {
  const swiftlet_pose pose = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {x, y, z}};
  return pose;
}

/* A tetrahedron, its faces counter-clockwise seen from outside. */
static const double corners[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
static const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

int surface_c_user(void) {
  char message[200] = "";
  swiftlet_model* const model = swiftlet_model_create(corners, 4, faces, 4, message, sizeof message);
  expect(model != NULL, message);
  const swiftlet_body solid = {SWIFTLET_MODEL, model, {{0}}, 0};
  const swiftlet_body ball = {SWIFTLET_POINT, NULL, {{0, 0, 0}}, 0.25};
  const swiftlet_body box = {SWIFTLET_BOX, NULL, {{-1, -1, -1}, {1, 1, 1}}, 0};
  const swiftlet_body capsule = {SWIFTLET_SEGMENT, NULL, {{0, 0, -1}, {0, 0, 1}}, 0.5};
  const swiftlet_body triangle = {SWIFTLET_TRIANGLE, NULL, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0};

  swiftlet_seed seed = {{0}};
  swiftlet_pose pose = at(2, 2, 2);
  const swiftlet_answer apart = swiftlet_distance(&solid, &ball, &pose, &seed, NULL);
  expect(is_near(apart.lower, 4 / sqrt(3) - 0.25) && apart.verdict == SWIFTLET_DISJOINT, "a ball before the large face");
  expect(is_near(apart.normal[0], 1 / sqrt(3)), "the normal points to the ball");
  expect(swiftlet_distance(&solid, &ball, &pose, &seed, NULL).lower == apart.lower, "a seed changes no bit of a distance here");

  pose = at(-0.1, 0.5, 0.5);
  const swiftlet_answer deep = swiftlet_signed_distance(&solid, &ball, &pose, &seed, NULL);
  expect(is_near(deep.upper, -0.15) && deep.verdict == SWIFTLET_OVERLAPPING, "the ball is 0.15 deep in the small face");
  expect(is_near(deep.normal[0], -1) && is_near(deep.point_b[0], 0.15), "and leaves through it");
  pose = at(0.25, 0.25, 0.25);
  expect(isnan(swiftlet_distance(&solid, &ball, &pose, NULL, NULL).normal[0]), "a distance knows no way out of an overlap");

  pose = at(0, 0, 2.5);
  expect(is_near(swiftlet_distance(&box, &capsule, &pose, NULL, NULL).lower, 0), "a capsule stands on a box");
  expect(is_near(swiftlet_distance(&box, &triangle, &pose, NULL, NULL).lower, 1.5), "a triangle hovers over it");
  const swiftlet_options near = {.beyond = 1};
  expect(swiftlet_distance(&box, &triangle, &pose, NULL, &near).status == SWIFTLET_BEYOND, "farther than 1 is beyond");
  pose.rotation[0][0] = 2;
  expect(swiftlet_distance(&box, &triangle, &pose, NULL, NULL).status == SWIFTLET_INVALID_POSE, "a stretched pose is refused");

  const uint32_t dented[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  expect(!swiftlet_model_create(corners, 4, dented, 4, message, sizeof message) && message[0], "a turned face is refused");
  swiftlet_model_destroy(model);
  return wrong;
}
