// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene of the bench as files that swiftlet_cost_ask reads: CGAL, which builds the models, does not run under
// valgrind.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <swiftlet/model_file.h>

#include "cost.h"
#include "scenes.h"

namespace {

/// Instructions of a cold query for each error that scenes ask for.
void print_expected(const swiftlet::Model& model) {
  std::vector<swiftlet::lod::LevelSize> levels;
  for (int i = 0; i < model.level_count(); ++i) {
    const swiftlet::Level& level = model.level(i);
    if (i >= model.finest_level()) levels.push_back({double(level.view.vertices.size()), level.deviation / model.radius()});
  }
  for (const auto& [error, weight] : swiftlet::lod::kAsked)
    std::printf("expected %g %.0f %.0f\n", error, swiftlet::lod::cold_instructions({}, levels, error),
                swiftlet::lod::prefix_bytes({}, levels, error) / 1024);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet;
  using namespace swiftlet::yardstick;
  if (argc < 6 || argc > 9) {
    return std::fputs(
               "swiftlet_cost_scene CACHE fat|plate|long TRIANGLES STEP PREFIX [DEVIATION [RATE [LEVELS]]]\n"
               "step 400: random; d and a step: overlapping by 0.01 of the shortest semi-axis; o and a step: by far;\n"
               "g and a step: 0.01 apart.\n"
               "0 for the deviation or the rate: none. Prints what the model of lod/cost.h expects.\n",
               stderr),
           2;
  }
  BuildOptions options;
  if (argc > 6) options.detail.deviation = std::atof(argv[6]);
  if (argc > 7 && std::atof(argv[7]) > 0) options.rate = std::atof(argv[7]);
  if (argc > 8) options.max_levels = std::atoi(argv[8]);
  const Shelf shelf(argv[1], options);
  const bool deep = argv[4][0] == 'd', far = argv[4][0] == 'o', near = argv[4][0] == 'g';
  const double step = std::atof(argv[4] + (deep || far || near));
  const auto triangles = std::uint32_t(std::atoi(argv[3]));
  for (const shapes::Family family : shapes::kFamilies) {
    if (std::string(argv[2]) != shapes::name(family)) continue;
    constexpr Extent kExtent{4, 500};
    Scene scene = deep          ? shallow(shelf, family, triangles, step, 0.01 * shapes::semi_axes(family).minCoeff(), kExtent)
                  : near        ? at_distance(shelf, family, triangles, kClose, step, kExtent)
                  : step == 400 ? random_poses(shelf, family, triangles, kExtent)
                                : orbit(shelf, family, triangles, 2, step, kExtent);
    if (far) scene = overlapping(std::move(scene));
    const std::string prefix = argv[5];
    for (const int i : {0, 1}) {
      if (const auto failed = save(scene.models[std::size_t(i)], prefix + (i == 0 ? "-a.swl" : "-b.swl")); !failed)
        return std::fprintf(stderr, "%s\n", failed.error().message.c_str()), 1;
    }
    print_expected(scene.models[0]);
    std::FILE* file = std::fopen((prefix + ".poses").c_str(), "wb");
    if (!file) return std::fprintf(stderr, "cannot write %s.poses\n", prefix.c_str()), 1;
    for (const Query& q : scene.queries) std::fwrite(&q.b_in_a, sizeof(Pose), 1, file);
    return std::fclose(file) == 0 ? 0 : 1;
  }
  return std::fprintf(stderr, "no shape %s\n", argv[2]), 2;
}
