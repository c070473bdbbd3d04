// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints hashes of many answers, for ./run determinism to compare between compilers and flags, and fails if walks by another
// width of registers give others; --record renews the recorded answers.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "answers.h"
#include "numeric/width.h"

int main(int argc, char** argv) {
  using namespace swiftlet;
  const bool record = argc > 1 && std::string_view(argv[1]) == "--record";
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
  if (argc > 2 || (rounds <= 0 && !record))
    return std::fputs("usage: swiftlet_determinism [poses per pair = 200 | --record]\n", stderr), 2;
  const std::vector<Model> models = answers::models(SWIFTLET_TEST_DIR "/data/models");
  if (record) {
    std::ofstream file(SWIFTLET_TEST_DIR "/data/answers.txt");
    answers::write(answers::records(models, answers::kRecordedRounds), file);
    return file.flush() ? 0 : (std::fputs("cannot write answers.txt\n", stderr), 1);
  }
  const auto hashes = [&] {
    std::string lines;
    for (const answers::Print& print : answers::prints(models, rounds)) lines += answers::text(print) + "\n";
    return lines;
  };
  const std::string widest = hashes();
  std::fputs(widest.c_str(), stdout);
  if (by_four() && set_width(Width::Two))
    if (const std::string narrow = hashes(); narrow != widest)
      return std::fprintf(stderr, "by registers of two doubles:\n%s", narrow.c_str()), 1;
}
