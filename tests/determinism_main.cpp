// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints hashes of many answers, for ./run determinism to compare between compilers and flags.
#include <cstdio>
#include <cstdlib>

#include "answers.h"

int main(int argc, char** argv) {
  using namespace swiftlet;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
  if (rounds <= 0) return std::fputs("usage: swiftlet_determinism [poses per pair = 200]\n", stderr), 2;
  for (const answers::Print& print : answers::prints(answers::models(SWIFTLET_TEST_DIR "/data/models"), rounds)) {
    std::puts(answers::text(print).c_str());
  }
}
