// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The scenes of pile.h as a table or JSON.
#include <cstdio>
#include <exception>
#include <string>

#include <LinearMath/btScalar.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "pile.h"

namespace {

using swiftlet::pile::Measures;

constexpr const char* kNames[] = {"swiftlet", "Bullet"};

void print(const swiftlet::pile::Scene& scene, const std::array<Measures, 2>& both) {
  for (int i = 0; i < 2; ++i) {
    const Measures& m = both[i];
    std::printf("| %s | %s | %.0f | %.0f | %.0f | %.0f | %.1f | %.1f | %d | %.2f | %.1e | %.3f |\n", scene.name.c_str(),
                kNames[i], m.step_us, m.narrowphase_us, m.pairs, m.contacts, 1000 * m.penetration, 1000 * m.worst_penetration,
                m.overlaps, 1000 * m.jitter, 100 * m.energy_gained, m.height);
  }
  std::fflush(stdout);
}

nlohmann::json json(const Measures& m) {
  return {{"step_us", m.step_us},
          {"narrowphase_us", m.narrowphase_us},
          {"pairs", m.pairs},
          {"contacts", m.contacts},
          {"penetration_m", m.penetration},
          {"worst_penetration_m", m.worst_penetration},
          {"overlaps", m.overlaps},
          {"jitter_m_per_s", m.jitter},
          {"energy_gained", m.energy_gained},
          {"height_m", m.height},
          {"hash", m.hash}};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Piles and rolling hulls in Bullet, with swiftlet's hull pairs and with Bullet's own narrowphase");
  int steps = 3000;
  std::uint64_t seed = 2026;
  bool as_json = false;
  std::string only;
  app.add_option("--steps", steps, "of 1/60 s each")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--seed", seed, "of shapes, places and rotations")->capture_default_str();
  app.add_option("--only", only, "scenes whose name holds this");
  app.add_flag("--json", as_json, "JSON instead of the table");
  CLI11_PARSE(app, argc, argv);

  const char* const precision = sizeof(btScalar) == 4 ? "single" : "double";
  nlohmann::json results = {{"steps", steps}, {"seed", seed}, {"precision", precision}, {"scenes", nlohmann::json::array()}};
  if (!as_json) {
    std::printf("%d steps, seed %llu, Bullet in %s precision\n\n", steps, static_cast<unsigned long long>(seed), precision);
    std::puts(
        "| scene | narrowphase | us/step | of it pairs | pairs | contacts | overlap mm | worst mm | hulls overlap | jitter "
        "mm/s | energy gained % | height m |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|");
  }
  for (const swiftlet::pile::Scene& scene : swiftlet::pile::scenes()) {
    if (scene.name.find(only) == std::string::npos) continue;
    const auto both = swiftlet::pile::run(scene, steps, seed);
    if (as_json) {
      results["scenes"].push_back({{"name", scene.name}, {kNames[0], json(both[0])}, {kNames[1], json(both[1])}});
    } else {
      print(scene, both);
    }
  }
  if (as_json) std::puts(results.dump(2).c_str());
} catch (const std::exception& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
