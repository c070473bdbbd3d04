// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a peer's bodies take. Knows the clock and malloc's own count.
#pragma once

#include <chrono>

#include "../hull.h"
#include "method.h"

namespace swiftlet::bench::mesh {

/// Runs `prepare` and writes down in the session what it took and left on the heap.
template <class Prepare>
void measure(Session& session, const Prepare& prepare) {
  const Preparation taken = measured(prepare);
  session.build_seconds = taken.seconds;
  session.bytes = taken.heap_bytes;
}

}  // namespace swiftlet::bench::mesh
