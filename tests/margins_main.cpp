// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Attacks every margin so many times, and walks a tenth as often, and prints what came of it.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "margins.h"

namespace {

using namespace swiftlet::margins;

void print(const Scene& scene) {
  for (std::size_t i = 0; i < scene.size(); ++i) std::printf("%a%c", scene[i], i % 3 == 2 ? '\n' : ' ');
}

/// An error is a quotient of exact numbers, each rounded.
constexpr double kRounded = 0x1p-40;

bool attack_margins(std::uint64_t count) {
  std::printf(
      "margins in u (foot turn, slender turn: in pose errors; righted turn: in tilts; slender line: in law 2's bounds)\n%-20s "
      "%8s %8s %8s %10s  %s\n",
      "", "margin", "needed", "largest", "judged", "half of needed");
  bool good = true;
  for (const Kind& kind : kinds()) {
    const Attack found = attack(kind, count);
    const bool held = found.largest <= kind.margin * (1 + kRounded), bites = found.largest > kind.needed / 2;
    std::printf("%-20s %8.1f %8.1f %8.3f %10llu  %s%s\n", kind.name, kind.margin, kind.needed, found.largest,
                static_cast<unsigned long long>(found.count), bites ? "broken" : "not reached", held ? "" : "  MARGIN BROKEN");
    if (!held) print(found.worst);
    std::fflush(stdout);
    good &= held && (bites || !kind.bites || count < 1'000'000);
  }
  return good;
}

bool attack_walks(std::uint64_t count) {
  std::printf("\nwalks of %llu pairs a state\n%-12s %10s %10s %10s %10s %8s  %s\n", static_cast<unsigned long long>(count), "",
              "ended so", "near", "proved", "of near", "wrong", "without margins: proved, wrong");
  bool good = true;
  for (const State& state : states()) {
    const Walks walks = attack(state, count), loose = attack(state, count, true);
    const auto number = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
    std::printf("%-12s %10llu %10llu %10llu %10llu %8llu  %llu, %llu\n", state.name, number(walks.count), number(walks.near),
                number(walks.accepted), number(walks.near_accepted), number(walks.wrong), number(loose.accepted),
                number(loose.wrong));
    std::printf("%s", walks.worst.c_str());
    std::fflush(stdout);
    good &= walks.wrong == 0 && walks.near_accepted > 0 && walks.near > walks.near_accepted;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  char* end = nullptr;
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], &end, 10) : 10'000'000;
  if (argc > 2 || count == 0 || (end && *end != 0)) return std::fputs("usage: swiftlet_margins [COUNT]\n", stderr), 2;
  const bool margins = attack_margins(count), walks = attack_walks((count + 9) / 10);
  return margins && walks ? 0 : 1;
}
