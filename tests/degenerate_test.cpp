// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A sample of degenerate arrays; swiftlet_degenerate judges as many as one likes.
#include "degenerate.h"

#include <gtest/gtest.h>

namespace swiftlet::degenerate {
namespace {

TEST(Degenerate, ArraysAreABodyOrRefusedWithASentence) {
  int accepted = 0, refused = 0;
  for (std::uint64_t number = 0; number < 3000; ++number) {
    const Outcome outcome = judge(make(number));
    EXPECT_EQ(outcome.fault, "") << "case " << number;
    (outcome.accepted ? accepted : refused) += 1;
  }
  EXPECT_GT(accepted, 400);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace swiftlet::degenerate
