// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Judges so many degenerate arrays and counts what became of them, sentence by sentence.
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "degenerate.h"

namespace {

/// A sentence without its numbers.
std::string kind_of(const std::string& sentence) {
  std::string kind;
  for (const char c : sentence) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c));
    if (!digit) kind += c;
    if (digit && !kind.ends_with('#')) kind += '#';
  }
  return kind;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet::degenerate;
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0,
                      first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  if (count == 0) return std::fputs("usage: swiftlet_degenerate COUNT [FIRST]\n", stderr), 2;
  std::uint64_t accepted = 0, failed = 0;
  std::map<std::string, std::uint64_t> refusals;
  for (std::uint64_t number = first; number < first + count; ++number) {
    const Outcome outcome = judge(make(number));
    accepted += outcome.accepted;
    if (!outcome.accepted) ++refusals[kind_of(outcome.refusal)];
    if (outcome.fault.empty()) continue;
    if (++failed > 20) continue;
    std::printf("case %llu: %s\n", static_cast<unsigned long long>(number), outcome.fault.c_str());
    std::fflush(stdout);
  }
  for (const auto& [kind, times] : refusals) std::printf("%10llu %s\n", static_cast<unsigned long long>(times), kind.c_str());
  std::printf("%llu arrays, %llu accepted, %llu failed\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(accepted), static_cast<unsigned long long>(failed));
  return failed == 0 ? 0 : 1;
}
