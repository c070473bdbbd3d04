// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_pairs.h"

#include <algorithm>

#include "mesh_families.h"

namespace swiftlet::stability {

void mesh_pairs(Examiner& examiner, std::uint64_t index) {
  for (const mesh_families::Family& family : mesh_families::families()) {
    const mesh_families::Case c = family.make(examiner.random, int(index));
    const mesh_families::Examined seen = mesh_families::examine(c, examiner.random);
    Tally& tally = examiner.tally;
    ++tally.pairs, ++tally.judged, ++tally.solved;
    examiner.count(seen.answer);
    examiner.hit(seen.truth.squared == 0);
    tally.widest = std::max(tally.widest, seen.width);
    if (seen.fault.empty()) continue;
    ++tally.failed;
    examiner.faults.push_back(std::string(family.name) + ": " + seen.fault + "\n" + text(c));
  }
}

}  // namespace swiftlet::stability
