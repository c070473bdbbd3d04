/* SPDX-FileCopyrightText: 2026 the swiftlet authors */
/* SPDX-License-Identifier: BSD-3-Clause */
/* A C interface of plain structs, over the public headers. Points and directions are in A's frame. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct swiftlet_model swiftlet_model;

typedef enum { SWIFTLET_MODEL, SWIFTLET_POINT, SWIFTLET_SEGMENT, SWIFTLET_TRIANGLE, SWIFTLET_BOX } swiftlet_kind;

typedef struct {
  swiftlet_kind kind;
  const swiftlet_model* model; /* borrowed; of a primitive NULL */
  double corners[3][3];        /* of a primitive, as many as it has: of a box the smallest and the largest */
  double radius;
} swiftlet_body;

typedef struct {
  double rotation[3][3]; /* row by row */
  double translation[3];
} swiftlet_pose;

typedef struct {
  uint32_t words[16]; /* zero: cold */
} swiftlet_seed;

typedef enum {
  SWIFTLET_NOT_ASKED,
  SWIFTLET_CONVERGED,
  SWIFTLET_BEYOND,
  SWIFTLET_BUDGET,
  SWIFTLET_LEVEL_LIMIT,
  SWIFTLET_NOT_CONVERGED,
  SWIFTLET_INVALID_POSE,
  SWIFTLET_INVALID_RADIUS,
  SWIFTLET_INVALID_BODY
} swiftlet_status;

typedef enum { SWIFTLET_UNDECIDED, SWIFTLET_DISJOINT, SWIFTLET_TOUCHING, SWIFTLET_OVERLAPPING } swiftlet_verdict;

typedef struct {
  swiftlet_status status;
  swiftlet_verdict verdict;
  double lower, upper;
  double normal[3], point_a[3], point_b[3]; /* NaN where they mean nothing */
} swiftlet_answer;

typedef struct {
  double absolute, relative; /* zero: exact */
  double beyond;             /* zero: no limit */
} swiftlet_options;

/* NULL where the triangles are no convex surface; `message`, of `size` bytes, says why. */
swiftlet_model* swiftlet_model_create(const double (*vertices)[3], size_t vertex_count, const uint32_t (*triangles)[3],
                                      size_t triangle_count, char* message, size_t size);
void swiftlet_model_destroy(swiftlet_model* model);

/* `seed` and `options` may be NULL. */
swiftlet_answer swiftlet_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                  swiftlet_seed* seed, const swiftlet_options* options);
swiftlet_answer swiftlet_signed_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                         swiftlet_seed* seed, const swiftlet_options* options);

#ifdef __cplusplus
}
#endif
