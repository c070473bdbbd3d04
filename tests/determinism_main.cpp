// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints one hash of many answers, for ./run determinism to compare between compilers and flags.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "answers.h"

int main(int argc, char** argv) {
  using namespace swiftlet;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
  if (rounds <= 0) return std::fputs("usage: swiftlet_determinism [poses per pair = 200]\n", stderr), 2;
  const answers::Fingerprint print = answers::fingerprint(answers::models(SWIFTLET_TEST_DIR "/data/models"), rounds);
  std::printf("%016" PRIx64 " %" PRIu64 " answers\n", print.hash, print.answers);
}
