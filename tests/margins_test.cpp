// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A sample of `./run margins`.
#include "margins.h"

#include <gtest/gtest.h>

namespace swiftlet::margins {
namespace {

TEST(Margins, HoldWhatRoundingDoes) {
  for (const Kind& kind : kinds()) {
    const Attack found = attack(kind, 10'000);
    EXPECT_LE(found.largest, kind.margin * (1 + 0x1p-40)) << kind.name;  // a quotient of exact numbers, each rounded
    EXPECT_LE(kind.needed, kind.margin) << kind.name;
    // So many scenes err by a quarter of what is needed; ./run margins with more by half, where that can be reached.
    if (kind.bites) {
      EXPECT_GT(found.largest, kind.needed / 4) << kind.name;
    }
  }
}

TEST(Margins, KeepWalksRightBesideNeighboursAtTheBorder) {
  for (const State& state : states()) {
    const Walks walks = attack(state, 10'000);
    EXPECT_EQ(walks.wrong, 0) << state.name << '\n' << walks.worst;
    EXPECT_GT(walks.near_accepted, 50) << state.name;
    EXPECT_GT(walks.near, 100) << state.name;
  }
}

/// The bodies are hard enough to find out a walk that trusts its roundings.
TEST(Margins, AreWhatKeepsThem) {
  std::uint64_t wrong = 0;
  for (const State& state : states()) wrong += attack(state, 10'000, true).wrong;
  EXPECT_GT(wrong, 0);
}

}  // namespace
}  // namespace swiftlet::margins
