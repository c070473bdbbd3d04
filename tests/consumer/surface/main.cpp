// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Layers that are to come, in miniature, on the installed headers: a C interface, batches over strided arrays, and the leaves
// of a mesh's tree. Each says how many of its claims are wrong.
#include <cstdio>

#include "leaf.h"
#include "strided.h"
#include "user.h"

int main() {
  const int wrong = surface_c_user() + surface::strided_batches() + surface::mesh_leaves();
  std::printf("%d wrong\n", wrong);
  return wrong ? 1 : 0;
}
