// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The search with registers that every processor of the target has: see numeric/width.h.
#include "search.h"

#include "descent.h"
#include "roots.h"

namespace swiftlet {

double gap_of_roots_by_two(const Top& a, const Top& b, const Pose& b_in_a, double enough, QueryPose& placed) {
  return gap_between(a, b, b_in_a, enough, placed);
}

void search_by_two(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
                   MeshFinding& finding) {
  descend(a, b, b_in_a, question, seed, finding);
}

}  // namespace swiftlet
