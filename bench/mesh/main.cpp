// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes beside the trees of other libraries: the same poses, the same questions, one process. All passes of a scene and a
// question alternate between the methods; the least of a pose's passes counts, and the median over the poses is shown.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh_query.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "median.h"
#include "method.h"
#include "questions.h"
#include "scenes.h"

namespace {

using namespace swiftlet::bench::mesh;
using swiftlet::Pose;
using swiftlet::bench::median;
using Clock = std::chrono::steady_clock;

constexpr double kClose = 1e-9;  // distances that differ by less, in radii, are taken for the same

/// Times one query: by the clock, without what that adds itself; a longer query, during which another program may have run, by
/// the thread's own time, which is dearer to read.
class Watch {
 public:
  Watch() {
    double least = 1;
    for (int i = 0; i < 10000; ++i) {
      begin();
      least = std::min(least, by_clock());
    }
    overhead_ = least;
  }
  void begin() {
    thread_ = thread_us();
    clock_ = Clock::now();
  }
  double us() const {
    constexpr double kLong = 20;
    const double taken = by_clock();
    return taken < kLong ? taken - overhead_ : thread_us() - thread_;
  }

 private:
  double by_clock() const { return std::chrono::duration<double, std::micro>(Clock::now() - clock_).count(); }
  static double thread_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e6 + double(now.tv_nsec) * 1e-3;
  }
  double thread_ = 0, overhead_ = 0;
  Clock::time_point clock_;
};

/// One method and one question in one scene.
struct Row {
  std::string scene, question, series;
  double allowed = 0;  ///< the relative error asked for
  std::size_t poses = 0;
  double us = NAN;
  double error = 0;  ///< of distances the largest error: exact in radii, else as a fraction of the distance
  std::size_t wrong = 0, failed = 0;
  std::uint64_t hash = 0;
  double bytes = 0, build_us = 0;  ///< a triangle
  double found = NAN;  ///< the median over the poses of contacts or points, or of an interval's width over the greatest depth

  bool flagged() const { return wrong + failed > 0 || error > (allowed > 0 ? allowed * (1 + kClose) : kClose); }
};

/// The interval that ours proves of a pose, and what it says of the surfaces.
struct Truth {
  double lower, upper;
  bool meets() const { return lower == 0 && upper == 0; }
  double value() const { return (lower + upper) / 2; }
};

/// FNV-1a over verdicts and the bits of distances.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325u;
  void add(std::uint64_t word) {
    for (int k = 0; k < 8; ++k) value = (value ^ (word >> 8 * k & 255)) * 0x100000001b3u;
  }
};

void judge(Row& row, const Asked& asked, const Scene& scene, const std::vector<Truth>& truths,
           const std::vector<Reply>& replies) {
  Hash hash;
  std::vector<double> found;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    const Reply& reply = replies[i];
    const Truth& truth = truths[i];
    hash.add(reply.yes);
    hash.add(std::bit_cast<std::uint64_t>(reply.distance));
    if (!asked.is_apart()) {
      hash.add(std::bit_cast<std::uint64_t>(reply.upper));
      hash.add(reply.count);
    }
    row.failed += reply.failed;
    const double apart = truth.value();
    switch (asked.kind) {
      case Kind::Intersects: row.wrong += reply.yes ? truth.lower > kClose * scene.radius : truth.meets(); break;
      case Kind::Within: row.wrong += reply.yes != (asked.factor > 1); break;
      case Kind::Distance: {
        const double off = std::max({0., truth.lower - reply.distance, reply.distance - truth.upper});
        row.error = std::max(row.error, asked.relative == 0 ? off / scene.radius
                                        : apart > 0         ? off / apart
                                        : off > 0           ? HUGE_VAL
                                                            : 0);
        break;
      }
      case Kind::Contacts:
      case Kind::Manifolds: {
        const double reach = asked.question(scene, apart).threshold;
        row.wrong += reply.count > 0 ? truth.lower > reach + kClose * scene.radius : truth.upper <= reach;
        found.push_back(double(reply.count));
        break;
      }
      case Kind::SignedDistance: {
        // The surfaces of bodies one inside the other are apart.
        row.wrong += reply.distance > reply.upper || reply.distance > truth.upper || (truth.meets() && reply.upper > 0);
        if (reply.distance < 0) found.push_back((reply.upper - reply.distance) / -reply.distance);
      }
    }
  }
  row.found = median(found);
  row.hash = hash.value;
}

struct Rig {
  Methods methods;
  std::vector<std::string> only;  ///< questions; empty: all
  int passes = 3;
  Watch watch;

  std::vector<Row> run(const Scene& scene);
  bool is_wanted(const Asked& asked) const {
    return only.empty() || std::find(only.begin(), only.end(), asked.name) != only.end();
  }
};

std::vector<Row> Rig::run(const Scene& scene) {
  std::vector<std::unique_ptr<Session>> sessions;
  for (const auto& method : methods) sessions.push_back(method->open(scene.a, scene.b));
  std::vector<Truth> truths;
  for (const Pose& pose : scene.poses) {
    const swiftlet::Answer answer = distance(scene.model_a, scene.model_b, pose);
    truths.push_back({answer.lower, answer.upper});
  }
  const double triangles = double(scene.a.triangles.size() + scene.b.triangles.size());
  std::vector<Row> rows;
  for (const Asked& asked : kAsked) {
    if (!asked.concerns(scene) || !is_wanted(asked)) continue;
    std::vector<Question> questions;
    std::vector<Pose> poses;
    std::vector<Truth> asked_truths;
    for (std::size_t i = 0; i < scene.poses.size(); ++i) {
      if (!asked.concerns(truths[i].value())) continue;
      poses.push_back(scene.poses[i]);
      questions.push_back(asked.question(scene, truths[i].value()));
      asked_truths.push_back(truths[i]);
    }
    const std::size_t n = poses.size();
    std::vector<std::vector<double>> least(methods.size(), std::vector<double>(n, HUGE_VAL));
    std::vector<std::vector<Reply>> replies(methods.size(), std::vector<Reply>(n));
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t k = 0; k < methods.size(); ++k) {
        // Back and forth, so that none is always first after another one's memory.
        const std::size_t m = pass % 2 == 0 ? k : methods.size() - 1 - k;
        if (!methods[m]->can(asked.question(scene, 1))) continue;
        for (std::size_t i = 0; i < n; ++i) {
          watch.begin();
          replies[m][i] = sessions[m]->ask(questions[i], poses[i]);
          least[m][i] = std::min(least[m][i], watch.us());
        }
      }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (!methods[m]->can(asked.question(scene, 1))) continue;
      Row row{.scene = scene.name, .question = asked.name, .series = methods[m]->name(), .allowed = asked.relative, .poses = n};
      row.us = median(least[m]);
      row.bytes = double(sessions[m]->bytes) / triangles;
      row.build_us = sessions[m]->build_seconds * 1e6 / triangles;
      judge(row, asked, scene, asked_truths, replies[m]);
      rows.push_back(row);
    }
  }
  return rows;
}

const Row* find(const std::vector<Row>& rows, const std::string& question, const std::string& series) {
  for (const Row& row : rows)
    if (row.question == question && row.series == series) return &row;
  return nullptr;
}

bool is_ours(const std::string& series) {
  // Trees of hulls are ours, too.
  return series.starts_with("swiftlet") || series.starts_with("CH") || series == "median" || series == "mean" ||
         series == "gap";
}

/// How many times as long as ours the fastest other takes; NaN where nobody else answers.
double gain(const std::vector<Row>& rows, const std::string& question) {
  double ours = NAN, best = NAN;
  for (const Row& row : rows) {
    if (row.question != question) continue;
    if (row.series == "swiftlet")
      ours = row.us;
    else if (!is_ours(row.series))
      best = std::fmin(best, row.us);
  }
  return best / ours;
}

void print(const Scene& scene, const Methods& methods, const std::vector<Row>& rows) {
  std::printf("\n%s: %zu and %zu triangles, %zu poses", scene.name.c_str(), scene.a.triangles.size(), scene.b.triangles.size(),
              scene.poses.size());
  if (const Row* row = find(rows, "within0.8", "swiftlet")) std::printf(", %zu of them apart", row->poses);
  std::printf("\n  %-12s", "us per query");
  for (const auto& method : methods) std::printf("%15s", method->name().c_str());
  std::printf("%8s  %s\n", "gain", "errors or what was found, and the hashes of ours");
  for (const Asked& asked : kAsked) {
    if (std::none_of(rows.begin(), rows.end(), [&](const Row& row) { return row.question == asked.name; })) continue;
    std::printf("  %-12s", asked.name);
    std::string notes;
    for (const auto& method : methods) {
      const Row* row = find(rows, asked.name, method->name());
      if (!row) {
        std::printf("%15s", "-");
        continue;
      }
      std::printf("%14.3f%c", row->us, row->flagged() ? '!' : ' ');
      char note[160];
      std::snprintf(note, sizeof note, " %s", row->series.c_str());
      std::string said;
      if (asked.kind == Kind::Distance) {
        std::snprintf(note, sizeof note, " %.1e", row->error);
        said += note;
      }
      if (!asked.is_apart()) {
        std::snprintf(note, sizeof note, " %.3g", row->found);
        said += note;
      }
      if (row->wrong > 0) said += " wrong " + std::to_string(row->wrong);
      if (row->failed > 0) said += " failed " + std::to_string(row->failed);
      if (!said.empty()) notes += " " + row->series + said + ";";
    }
    std::printf("%8.2f %s", gain(rows, asked.name), notes.c_str());
    for (const Row& row : rows)
      if (row.question == asked.name && is_ours(row.series)) std::printf(" %016llx", static_cast<unsigned long long>(row.hash));
    std::puts("");
  }
  const auto print_of_bodies = [&](const char* name, double Row::*what, int digits) {
    std::printf("  %-12s", name);
    for (const auto& method : methods) {
      const Row* row = find(rows, rows.front().question, method->name());
      row ? std::printf("%14.*f ", digits, row->*what) : std::printf("%15s", "-");
    }
    std::puts("");
  };
  print_of_bodies("bytes/tri.", &Row::bytes, 0), print_of_bodies("build us/t.", &Row::build_us, 2);
  std::fflush(stdout);
}

void print_medians(const std::vector<std::vector<Row>>& scenes) {
  std::printf("\nover %zu scenes: how many times as long the fastest other takes\n  %-12s%8s%8s%8s  %s\n", scenes.size(), "",
              "median", "least", "most", "slower than another in");
  for (const Asked& asked : kAsked) {
    std::vector<double> gains;
    std::string lost;
    for (const auto& rows : scenes) {
      const double here = gain(rows, asked.name);
      if (std::isnan(here)) continue;  // nobody else answers this
      gains.push_back(here);
      if (here < 1) lost += " " + rows.front().scene;
    }
    if (gains.empty()) continue;
    std::printf("  %-12s%8.2f%8.2f%8.2f %s\n", asked.name, median(gains), *std::min_element(gains.begin(), gains.end()),
                *std::max_element(gains.begin(), gains.end()), lost.c_str());
  }
}

constexpr const char* kHeader = "scene,question,series,allowed,poses,ns,error,wrong,failed,flagged,hash,bytes,build_us,found\n";
std::string csv(const Row& r) {
  char line[400];
  std::snprintf(line, sizeof line, "%s,%s,%s,%g,%zu,%.1f,%.3g,%zu,%zu,%d,%016llx,%.1f,%.3f,%.4g\n", r.scene.c_str(),
                r.question.c_str(), r.series.c_str(), r.allowed, r.poses, 1000 * r.us, r.error, r.wrong, r.failed,
                int(r.flagged()), static_cast<unsigned long long>(r.hash), r.bytes, r.build_us, r.found);
  return line;
}

nlohmann::json json(const Row& r) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(r.hash));
  return {{"scene", r.scene}, {"question", r.question}, {"series", r.series}, {"allowed", r.allowed}, {"poses", r.poses},
          {"us", r.us},       {"error", r.error},       {"wrong", r.wrong},   {"failed", r.failed},   {"hash", hash},
          {"bytes", r.bytes}, {"build_us", r.build_us}, {"found", r.found}};
}

/// The scenes of [Ehmann & Lin 2001, sec. 8.1], and bodies of few and large convex patches.
bool is_of_layer(const std::string& scene) {
  constexpr const char* kScenes[] = {"tori",           "cup-spoon",     "peg-large-ring",  "peg-small-ring",
                                     "teeth-shifting", "teeth-opening", "comb-frame-near", "comb-frame-random",
                                     "fetch-near",     "fetch-random",  "ur10-near",       "ur10-random"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

/// Leaves out the poses in which one of two solids is inside the other: trees of hulls are of solids, all others of surfaces.
void leave_out_nested(Scene& scene) {
  const auto solid = [](const swiftlet::MeshModel& mesh) {
    return mesh.topology().closed() ? swiftlet::MeshBody::solid(mesh) : swiftlet::MeshBody(mesh);
  };
  std::erase_if(scene.poses, [&](const Pose& pose) {
    return distance(scene.model_a, scene.model_b, pose).lower > 0 &&
           distance(solid(scene.model_a), solid(scene.model_b), pose).upper == 0;
  });
}

swiftlet::MeshModel hulls_of(const swiftlet::Mesh& mesh) {
  swiftlet::Result<swiftlet::MeshModel> model = swiftlet::build_mesh(mesh);
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Queries about meshes, beside the trees of other libraries");
  std::size_t poses = 0;
  bool quick = false, as_json = false, layer = false;
  std::vector<std::string> only;
  std::string meshes = "models/cache", file;
  app.add_option("--poses", poses, "of every scene; else 200, with --layer 40")->check(CLI::PositiveNumber);
  app.add_flag("--quick", quick, "24 poses of every scene");
  app.add_option("--only-scene", only, "scenes whose name holds this");
  app.add_flag("--layer", layer, "SWIFT++'s scenes and some more, with its trees of hulls beside the others");
  app.add_option("--meshes", meshes, "the folder of the real meshes; without it their scenes are left out")
      ->capture_default_str();
  app.add_option("--csv", file, "writes every row to this file, for tables and charts");
  app.add_flag("--json", as_json, "JSON instead of the tables");
  CLI11_PARSE(app, argc, argv);
  if (poses == 0) poses = quick ? 24 : layer ? 40 : 200;

  Rig rig;
  rig.methods.push_back(swiftlet_method("swiftlet", "build_mesh, proved, from the last pose's seed", hulls_of));
  if (layer) {
    add_hull_trees(rig.methods);
    rig.only = {"intersects", "distance10%", "distance"};
  }
  rig.methods.push_back(swiftlet_method("swiftlet boxes", "the same without hulls, from_triangles", boxes_of));
  if (!layer)
    rig.methods.push_back(swiftlet_method("swiftlet front", "build_mesh, from the last pose's seed and front", hulls_of, true));
#ifdef SWIFTLET_PEER_FCL
  add_fcl(rig.methods);
#endif
#ifdef SWIFTLET_PEER_FCL_NATIVE
  add_fcl_native(rig.methods);
#endif
  rig.methods.push_back(cgal_method());
  if (!as_json)
    for (const auto& method : rig.methods) std::printf("%-14s %s\n", method->name().c_str(), method->settings().c_str());

  std::ofstream out;
  if (!file.empty()) out = std::ofstream(file), out << kHeader;
  std::vector<std::vector<Row>> all;
  for (const std::string& name : scene_names()) {
    const auto wanted = [&](const std::string& part) { return name.find(part) != std::string::npos; };
    if (!only.empty() && std::none_of(only.begin(), only.end(), wanted)) continue;
    if (layer && !is_of_layer(name)) continue;
    std::optional<Scene> scene = make_scene(name, meshes, poses);
    if (!scene) {
      std::fprintf(stderr, "%s: its mesh file is missing: models/fetch\n", name.c_str());
      continue;
    }
    if (layer) leave_out_nested(*scene);
    all.push_back(rig.run(*scene));
    if (!as_json) print(*scene, rig.methods, all.back());
    for (const Row& row : all.back()) out << csv(row) << std::flush;
  }
  if (all.empty()) throw std::runtime_error("no scene was measured");
  if (!file.empty() && !out) throw std::runtime_error("cannot write " + file);
  if (as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& rows : all)
      for (const Row& row : rows) list.push_back(json(row));
    std::puts(list.dump(1).c_str());
  } else if (!all.empty()) {
    print_medians(all);
  }
  for (const auto& rows : all)
    for (const Row& row : rows)
      if (is_ours(row.series) && row.flagged()) return 1;
} catch (const std::exception& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
