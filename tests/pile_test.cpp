// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Five seconds of small piles: what swiftlet's hull pairs must never do, whatever Bullet does beside them.
#include <gtest/gtest.h>

#include "pile.h"

namespace swiftlet {
namespace {

const pile::Scene kPile{"pile", pile::Motion::Pile, {20, 60, 200}, 18}, kRoll{"roll", pile::Motion::Roll, {200}, 8};

TEST(Pile, ComesToRestAndGainsNoEnergy) {
  const auto [ours, bullets] = pile::run(kPile, 300, 1);
  EXPECT_GT(ours.contacts, 20);
  EXPECT_LE(ours.worst_penetration, 1.5 * bullets.worst_penetration + 0.01);
  EXPECT_LE(ours.jitter, 2 * bullets.jitter + 0.01);
  EXPECT_LE(ours.energy_gained, 2 * bullets.energy_gained + 0.001);
  EXPECT_NEAR(ours.height, bullets.height, 0.1);
}

TEST(Pile, RollsWithoutGainingEnergy) {
  const auto [ours, bullets] = pile::run(kRoll, 300, 1);
  EXPECT_GT(ours.contacts, 4);
  EXPECT_EQ(ours.overlaps, 0);
  EXPECT_LE(ours.energy_gained, 2 * bullets.energy_gained + 0.001);
}

TEST(Pile, RepeatsItselfBitForBit) {
  const auto once = pile::run(kPile, 100, 2), again = pile::run(kPile, 100, 2);
  EXPECT_EQ(once[0].hash, again[0].hash);
  EXPECT_NE(once[0].hash, pile::run(kPile, 100, 3)[0].hash);
}

}  // namespace
}  // namespace swiftlet
