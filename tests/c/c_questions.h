// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every query as a C program asks it: c_questions.c is C99, what it gets is judged in c_test.cpp.
#ifndef SWIFTLET_TESTS_C_QUESTIONS_H
#define SWIFTLET_TESTS_C_QUESTIONS_H

#include <swiftlet/swiftlet.h>

#ifdef __cplusplus
extern "C" {
#endif

// What a pair is asked with, and all that it answers. Seeds travel from one call to the next.
struct questions_seeds {
  swiftlet_seed distance, signed_distance, intersects, within, signed_within, closest;
};
struct questions_answers {
  swiftlet_answer distance, cold, rough, refined, signed_distance, intersects, within, signed_within, closest;
  int32_t is_within, is_signed_within;
  swiftlet_source source_a, source_b;
  swiftlet_manifold manifold;
  double tolerance;
};

// Asks all queries; refine and the manifold of convex bodies alone. Returns the first code that is not SWIFTLET_OK.
swiftlet_code questions_ask(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a, int are_convex,
                            struct questions_seeds* seeds, struct questions_answers* answers, swiftlet_error* error);

// Calls every function with null pointers, and counts those that do not answer SWIFTLET_NULL_POINTER.
int questions_of_nothing(const swiftlet_model* model, const swiftlet_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif  // SWIFTLET_TESTS_C_QUESTIONS_H
