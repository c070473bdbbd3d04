// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The search with registers of eight floats, compiled for AVX2: see numeric/width.h.
#include "search.h"

#if SWIFTLET_BY_FOUR
#include "descent.h"
#include "roots.h"

namespace swiftlet {

double gap_of_roots_by_four(const Top& a, const Top& b, const Pose& b_in_a, double enough, QueryPose& placed) {
  return gap_between(a, b, b_in_a, enough, placed);
}

void search_by_four(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
                    MeshFinding& finding) {
  descend(a, b, b_in_a, question, seed, finding);
}

}  // namespace swiftlet
#endif
