// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The answers of today are those that were recorded, bit for bit. `./run determinism` compares more of them between compilers.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "answers.h"

namespace swiftlet {
namespace {

TEST(Determinism, AnswersAreTheRecordedOnes) {
  std::ifstream file(SWIFTLET_TEST_DIR "/data/answers.txt");
  for (const answers::Print& print : answers::prints(answers::models(SWIFTLET_TEST_DIR "/data/models"), 10)) {
    std::string recorded;
    std::getline(file, recorded);
    EXPECT_EQ(answers::text(print), recorded)
        << "Answers, steps or models changed. If that is meant, the first text is the new line of tests/data/answers.txt";
    EXPECT_GE(print.print.answers, 700u);
  }
}

}  // namespace
}  // namespace swiftlet
