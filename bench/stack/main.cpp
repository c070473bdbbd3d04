// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The scenes of stack.h from many starts, and whether swiftlet's stacks fall sooner than Bullet's.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "alone.h"
#include "rank_sum.h"
#include "stack.h"

namespace {

using namespace swiftlet::stack;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/// All starts of one scene with one kind of shapes.
struct Series {
  Shapes shapes;
  std::vector<Outcome> outcomes;

  template <class Member>
  std::vector<double> all(Member member) const {
    std::vector<double> values;
    for (const Outcome& o : outcomes) values.push_back(double(o.*member));
    return values;
  }
  std::vector<double> drifts() const {
    std::vector<double> values;
    for (const Outcome& o : outcomes)
      if (!o.fell) values.push_back(o.drift);
    return values;
  }
  int falls() const {
    return int(std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.fell; }));
  }
};

struct Cell {
  std::string name;
  int iterations;
  std::vector<Series> series;
  double p = 1;  ///< that swiftlet's bodies fall sooner than Bullet's hulls, by chance
};

void print(const Cell& cell) {
  for (const Series& s : cell.series) {
    const auto stood = s.all(&Outcome::stood);
    std::printf("| %s | %d | %s | %d of %zu | %.0f | %.0f | %.3f | %.1e | %.2f | %.3f | %.1f | %.0f | %016llx |\n",
                cell.name.c_str(), cell.iterations, name(s.shapes), s.falls(), s.outcomes.size(),
                *std::min_element(stood.begin(), stood.end()), median(stood), median(s.drifts()),
                median(s.all(&Outcome::energy)), median(s.all(&Outcome::asleep)), median(s.all(&Outcome::kept)),
                median(s.all(&Outcome::points)), median(s.all(&Outcome::step_us)), static_cast<unsigned long long>([&] {
                  std::uint64_t hash = 0;
                  for (const Outcome& o : s.outcomes) hash = hash * 31 + o.hash;
                  return hash;
                }()));
  }
  std::fflush(stdout);
}

nlohmann::json json(const Cell& cell) {
  nlohmann::json all = {{"scene", cell.name}, {"iterations", cell.iterations}, {"p_sooner", cell.p}};
  for (const Series& s : cell.series) {
    nlohmann::json& list = all[name(s.shapes)] = nlohmann::json::array();
    for (const Outcome& o : s.outcomes)
      list.push_back({{"stood", o.stood},
                      {"fell", o.fell},
                      {"drift_m", o.drift},
                      {"energy_j", o.energy},
                      {"asleep", o.asleep},
                      {"step_us", o.step_us},
                      {"kept", o.kept},
                      {"points", o.points},
                      {"hash", o.hash}});
  }
  return all;
}

/// One prism in motions whose outcome is known.
void print_alone() {
  std::puts(
      "\nOne prism alone: down a slope of 0.5 for 2 s, where Coulomb's law says its speed; spinning at 10 / s; on a floor that "
      "rocks.\n");
  std::puts(
      "| sides | shapes | speed m/s | of | hop mm | turns at | spin: stops after s | moved mm | hop mm | rock: slides mm | "
      "leans |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
  for (const std::uint32_t sides : {4u, 12u, 40u, 200u}) {
    for (const Shapes shapes : {Shapes::Swiftlet, Shapes::Hulls}) {
      const Alone slid = slide(sides, shapes, 0.5), spun = spin(sides, shapes), rocked = rock(sides, shapes);
      std::printf("| %u | %s | %.4f | %.4f | %.2f | %.4f | %.2f | %.1f | %.2f | %.1f | %.4f |\n", sides, name(shapes),
                  slid.moved, slid.ideal, 1000 * slid.hop, slid.wobble, spun.stopped, 1000 * spun.moved, 1000 * spun.hop,
                  1000 * rocked.moved, rocked.wobble);
    }
  }
}

/// Throws std::runtime_error where the file cannot be written.
void write(const std::string& path, const std::vector<Cell>& cells, int steps) {
  std::ofstream file(path);
  file << "scene,iterations,shapes,steps,stood,fell,drift,energy,kept,step_us\n";
  for (const Cell& cell : cells)
    for (const Series& s : cell.series)
      for (const Outcome& o : s.outcomes)
        file << cell.name << ',' << cell.iterations << ',' << name(s.shapes) << ',' << steps << ',' << o.stood << ',' << o.fell
             << ',' << o.drift << ',' << o.energy << ',' << o.kept << ',' << o.step_us << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Towers, walls and piles in Bullet, with swiftlet's hull pairs and with Bullet's own shapes, until they fall");
  int starts = 30, steps = 1200;
  std::uint64_t seed = 2026;
  bool as_json = false;
  std::string only, csv, meshes = "models/cache";
  std::vector<int> iterations{10, 50};
  app.add_option("--starts", starts, "of every scene")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--steps", steps, "of 1/60 s each")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--seed", seed, "of the first start; the others follow it")->capture_default_str();
  app.add_option("--iterations", iterations, "of Bullet's solver")->capture_default_str();
  app.add_option("--only", only, "scenes whose name holds this");
  app.add_option("--meshes", meshes, "the folder of the real links; without it that scene is left out")->capture_default_str();
  app.add_option("--csv", csv, "writes every start to this file, for the chart");
  app.add_flag("--json", as_json, "JSON instead of the table");
  CLI11_PARSE(app, argc, argv);

  std::vector<Scene> scenes;
  for (const std::uint32_t sides : {4u, 12u, 40u, 200u})
    for (const double twist : {0., 0.1}) scenes.push_back(tower(sides, twist));
  scenes.push_back(wall());
  scenes.push_back(pyramid());
  scenes.push_back(pile());
  if (std::filesystem::exists(meshes)) scenes.push_back(links(meshes));

  if (!as_json) {
    std::puts(
        "| scene | iterations | shapes | fell | first | median step | drift m | energy J | asleep | kept | points | us/step | "
        "hash |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  }
  std::vector<Cell> cells;
  for (const int count : iterations) {
    for (const Scene& scene : scenes) {
      if (scene.name.find(only) == std::string::npos) continue;
      Cell cell{scene.name, count, {{Shapes::Swiftlet, {}}, {Shapes::Hulls, {}}}};
      if (scene.are_boxes) cell.series.push_back({Shapes::Boxes, {}});
      for (int start = 0; start < starts; ++start) {
        if (!as_json) std::fprintf(stderr, "\r%s, %d iterations: %d of %d starts ", scene.name.c_str(), count, start, starts);
        for (Series& s : cell.series) s.outcomes.push_back(run(scene, {count, steps}, s.shapes, seed + std::uint64_t(start)));
      }
      if (!as_json) std::fprintf(stderr, "\r%60s\r", "");
      cell.p = p_smaller(cell.series[0].all(&Outcome::stood), cell.series[1].all(&Outcome::stood));
      if (!as_json) print(cell);
      cells.push_back(std::move(cell));
    }
  }

  if (!csv.empty()) write(csv, cells, steps);
  std::vector<double> p;
  for (const Cell& cell : cells) p.push_back(cell.p);
  const std::vector<double> adjusted = holm(p);
  if (as_json) {
    nlohmann::json all = {{"starts", starts}, {"steps", steps}, {"seed", seed}, {"cells", nlohmann::json::array()}};
    for (const Cell& cell : cells) all["cells"].push_back(json(cell));
    for (std::size_t i = 0; i < cells.size(); ++i) all["cells"][i]["p_sooner_holm"] = adjusted[i];
    std::puts(all.dump(1).c_str());
    return 0;
  }
  std::printf(
      "\nDoes swiftlet's stack fall sooner than that of Bullet's hulls? One-sided rank sum test, survivors censored.\n\n");
  std::puts("| scene | iterations | p | p, Holm |");
  std::puts("|---|---|---|---|");
  std::vector<double> ours, theirs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::printf("| %s | %d | %.3f | %.3f%s |\n", cells[i].name.c_str(), cells[i].iterations, p[i], adjusted[i],
                adjusted[i] < 0.05 ? ", sooner" : "");
    for (const Outcome& o : cells[i].series[0].outcomes) ours.push_back(o.stood);
    for (const Outcome& o : cells[i].series[1].outcomes) theirs.push_back(o.stood);
  }
  std::printf("| all | | %.3f | |\n", p_smaller(ours, theirs));
  if (only.empty()) print_alone();
} catch (const std::exception& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
