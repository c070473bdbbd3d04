// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks every baseline at the recorded cells and prints the work and a hash of the answers of each: see check, which counts the
// instructions as well.
#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>

#include "cells.h"
#include "plain.h"
#include "vclip.h"

namespace swiftlet::yardstick {
namespace {

/// What a baseline did in a cell.
struct Tally {
  std::uint64_t steps = 0, plane_tests = 0, answers = 0xcbf29ce484222325u;  ///< the last one as FNV-1a hashes words
  void add(const auto& result, unsigned end) {
    steps += result.steps;
    plane_tests += result.plane_tests;
    // A walk that has no answer names no distance worth keeping.
    for (const std::uint64_t word : {std::uint64_t(end), end == 0 ? std::bit_cast<std::uint64_t>(result.distance) : 0}) {
      answers = (answers ^ word) * 0x100000001b3u;
      answers ^= answers >> 32;
    }
  }
};

Tally ask_vclip(const Cell& cell) {
  const VclipBody a(cell.a.level(0).view), b(cell.b.level(0).view);
  VclipSeed seed;
  Tally tally;
  for (const Pose& pose : cell.poses) {
    const VclipResult r = vclip(a, b, pose, seed);
    tally.add(r, unsigned(r.end));
  }
  return tally;
}

Tally ask_plain(const Cell& cell, bool from_table) {
  const ConvexView &a = cell.a.level(0).view, &b = cell.b.level(0).view;
  PlainSeed seed;
  Tally tally;
  for (const Pose& pose : cell.poses) {
    if (from_table) seed = table_start(cell.a, cell.b, pose);
    const PlainResult r = plain(a, b, pose, seed);
    tally.add(r, r.stalled ? 2 : r.inside ? 1 : 0);
  }
  return tally;
}

}  // namespace

/// Where callgrind ends what it counts for a line.
[[gnu::noinline]] void end_of_line(const char* baseline, const Cell& cell, const Tally& tally) {
  std::printf("%-11s %-12s %7zu %7" PRIu64 " %11" PRIu64 " %016" PRIx64 "\n", baseline, cell.name.c_str(), cell.poses.size(),
              tally.steps, tally.plane_tests, tally.answers);
}

}  // namespace swiftlet::yardstick

int main() {
  using namespace swiftlet::yardstick;
  const Cells cells;
  for (const Cell& cell : cells.all()) {
    end_of_line("vclip", cell, ask_vclip(cell));
    end_of_line("plain", cell, ask_plain(cell, false));
    end_of_line("plain_table", cell, ask_plain(cell, true));
  }
}
