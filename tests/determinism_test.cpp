// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The answers of today are those that were recorded, bit for bit. `./run determinism` compares more of them between compilers.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <string>

#include "answers.h"

namespace swiftlet {
namespace {

TEST(Determinism, AnswersAreTheRecordedOnes) {
  const answers::Fingerprint print = answers::fingerprint(answers::models(SWIFTLET_TEST_DIR "/data/models"), 10);
  char text[60];
  std::snprintf(text, sizeof text, "%016" PRIx64 " %" PRIu64 " answers", print.hash, print.answers);
  std::string recorded;
  std::getline(std::ifstream(SWIFTLET_TEST_DIR "/data/answers.txt"), recorded);
  EXPECT_EQ(text, recorded)
      << "Answers, steps or models changed. If that is meant, the first line is the new tests/data/answers.txt";
  EXPECT_GE(print.answers, 9000u);
}

}  // namespace
}  // namespace swiftlet
