// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The sweep with the instructions of registers of four doubles, compiled for AVX2: see width.h.
#include "manifold/clip.h"

#if SWIFTLET_BY_FOUR
#include "manifold/sweep.h"

namespace swiftlet {

void clip_by_four(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound, Candidates& corners) {
  Sweep(projection, a, b, bound, corners).run();
}

}  // namespace swiftlet
#endif
