// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What precision costs: bytes, build time and query time of models that are no finer than asked, of single shapes and of a
// scene of 1 000 robot links, which is also asked of other methods; and what a large body's build takes. Writes precision.csv,
// links.csv and scale.csv: README.md.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hull.h"
#include "scenes.h"

namespace swiftlet::bench {
using namespace yardstick;
namespace {

constexpr std::array kTolerances{0., 1e-3, 3e-3, 1e-2, 3e-2, 1e-1};  ///< of a pair's distance, over the radius; 0: exact
constexpr std::array kSceneTolerances{0., 1e-3, 1e-2, 1e-1};
constexpr int kPasses = 7;
constexpr double kLong = 5;  ///< seconds

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

template <class Do>
double seconds(const Do& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Of several passes the least, as other programs share the machine; of one that takes long, fewer.
template <class Do>
double least_seconds(const Do& act) {
  double least = std::numeric_limits<double>::infinity(), spent = 0;
  for (int pass = 0; pass < kPasses && spent < kLong; ++pass) {
    const double taken = seconds(act);
    least = std::min(least, taken);
    spent += taken;
  }
  return least;
}

/// A mesh about its hull's centre, of radius 1.
Mesh normalised(Mesh mesh) {
  const Model whole = must(build(mesh)).model;
  for (Vec3& p : mesh.points) p = (p - whole.centre()) / whole.radius();
  return mesh;
}

struct Shape {
  std::string name;
  Mesh a, b;
};

std::vector<Shape> ellipsoids() {
  constexpr std::uint32_t kShapeTriangles = 20'000;
  std::vector<Shape> shapes;
  for (const shapes::Family family : shapes::kFamilies) {
    const auto mesh = [&](std::uint64_t seed) {
      return normalised(shapes::ellipsoid(shapes::semi_axes(family), kShapeTriangles, seed));
    };
    shapes.push_back({shapes::name(family), mesh(1), mesh(2)});
  }
  return shapes;
}

std::vector<Shape> links(const std::filesystem::path& directory) {
  std::vector<Shape> shapes;
  for (const std::filesystem::path& path : robot_links(directory)) {
    const Mesh mesh = normalised(must(read_mesh(path)));
    shapes.push_back({path.stem().string(), mesh, mesh});
  }
  return shapes;
}

/// Each body may deviate by half of what the pair may.
Model built(const Mesh& mesh, double tolerance) {
  BuildOptions options;
  options.detail.deviation = tolerance / 2;
  return must(build(mesh, options)).model;
}

// ---- One shape beside another ---------------------------------------------------------------------------------------------

std::vector<Pose> orbit_poses() {
  std::vector<Pose> poses;
  for (std::uint64_t orbit = 0; orbit < 4; ++orbit) {
    const shapes::Orbit motion(100 + orbit, 2, 10.4);
    for (std::uint64_t i = 1; i <= 500; ++i) poses.push_back(motion.pose(i));
  }
  return poses;
}

void measure(const Shape& shape, double tolerance, std::ostream& csv) {
  std::vector<Model> models;
  const double build_seconds = seconds([&] { models = {built(shape.a, tolerance), built(shape.b, tolerance)}; }) / 2;
  const std::vector<Pose> poses = orbit_poses();
  double widest = 0;
  std::size_t short_of = 0;
  const double all = least_seconds([&] {
    PairSeed seed;
    short_of = 0;
    for (const Pose& pose : poses) {
      const Answer answer = distance(models[0], models[1], pose, seed, {.absolute = tolerance});
      widest = std::max(widest, answer.upper - answer.lower);
      short_of += answer.status != Status::Converged;
    }
  });
  const Model& a = models[0];
  csv << shape.name << ',' << tolerance << ',' << a.level(0).triangle_count << ',' << a.level(a.finest_level()).triangle_count
      << ',' << a.bytes().size() << ',' << build_seconds << ',' << 1e9 * all / double(poses.size()) << ',' << widest << ','
      << short_of << '\n'
      << std::flush;
}

// ---- A scene of links -----------------------------------------------------------------------------------------------------

/// So many instances on a grid, each turning about an axis of its own by 2 degrees a frame, and all pairs of neighbours.
struct Crowd {
  std::vector<BodyPair> pairs;
  std::vector<Query> queries;

  Crowd(std::uint32_t side, std::uint32_t kinds) {
    constexpr double kSpacing = 2.2;  ///< of bodies of radius 1, which never overlap
    constexpr int kFrames = 12;
    const std::uint32_t count = side * side * side;
    shapes::Random random(1);
    std::vector<Mat3> turned;
    std::vector<Vec3> axis, centre;
    for (std::uint32_t i = 0; i < count; ++i) {
      turned.push_back(random.rotation());
      axis.push_back(random.on_sphere());
      const std::uint32_t row = i / side % side, layer = i / side / side;
      centre.push_back(kSpacing * Vec3(i % side, row, layer) + 0.1 * random.in_ball());
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i % side + 1 < side) neighbours.emplace_back(i, i + 1);
      if (i / side % side + 1 < side) neighbours.emplace_back(i, i + side);
      if (i / side / side + 1 < side) neighbours.emplace_back(i, i + side * side);
    }
    for (const auto& [i, j] : neighbours) pairs.push_back({i % kinds, j % kinds});
    for (int frame = 0; frame < kFrames; ++frame) {
      const auto in_world = [&](std::uint32_t i) -> Pose {
        return {shapes::rotation(axis[i], frame * (2 * 3.14159265358979 / 180)) * turned[i], centre[i]};
      };
      for (std::uint32_t k = 0; k < pairs.size(); ++k)
        queries.push_back({k, relative(in_world(neighbours[k].first), in_world(neighbours[k].second))});
    }
  }
};

struct Row {
  std::string method;
  double tolerance;
  std::size_t bytes;  ///< of one link of each kind
  double preparing;   ///< seconds, of one of each kind
};

/// One method on the crowd: time per query, and the largest error against the exact distances.
std::vector<Outcome> measure(const Row& row, Session& session, const Crowd& crowd, double kinds,
                             const std::vector<Outcome>& truth, std::ostream& csv) {
  std::vector<Outcome> outcomes(crowd.queries.size());
  session.distances(crowd.queries, outcomes);  // warm
  const double all = least_seconds([&] { session.distances(crowd.queries, outcomes); });
  double worst = 0;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    failed += outcomes[i].failed;
    if (!outcomes[i].failed) worst = std::max(worst, std::fabs(outcomes[i].distance - truth[i].distance));
  }
  csv << row.method << ',' << row.tolerance << ',' << double(row.bytes) / kinds << ',' << row.preparing / kinds << ','
      << 1e9 * all / double(crowd.queries.size()) << ',' << worst << ',' << failed << '\n'
      << std::flush;
  return outcomes;
}

/// Ours, with models no finer than each tolerance needs; then the others on the exact hulls, whose building is not counted.
void measure_scene(const std::vector<Shape>& shapes, std::ostream& csv) {
  const auto kinds = std::uint32_t(shapes.size());
  const Crowd crowd(10, kinds);
  std::vector<Model> whole;
  std::vector<Outcome> truth;
  for (const double tolerance : kSceneTolerances) {
    Row row{"swiftlet", tolerance, 0, 0};
    std::vector<Model> models;
    row.preparing = seconds([&] {
      for (const Shape& shape : shapes) models.push_back(built(shape.a, tolerance));
    });
    std::vector<SceneBody> bodies;
    for (const Model& model : models) bodies.push_back({&model, {}, 0}), row.bytes += model.bytes().size();
    const auto session = swiftlet_method("swiftlet", "", Options{.absolute = tolerance})->open(bodies, crowd.pairs);
    std::vector<Outcome> found = measure(row, *session, crowd, kinds, truth, csv);
    if (tolerance == 0) whole = std::move(models), truth = std::move(found);
  }
  std::vector<SceneBody> bodies;
  for (const Model& model : whole) bodies.push_back({&model, model.level(0).view, 0});
  for (const auto& method : all_methods()) {
    const std::string name = method->name();
    if (name != "vclip" && name != "bullet" && name != "bullet guess climb" && name != "fcl indep" && name != "fcl libccd")
      continue;
    const auto session = method->open(bodies, crowd.pairs);
    const Preparation taken = session->preparation();
    measure({name, 0, taken.heap_bytes, taken.seconds}, *session, crowd, kinds, truth, csv);
  }
}

// ---- A large body ---------------------------------------------------------------------------------------------------------

constexpr double kScaleTolerance = 1e-2;  ///< of a pair's distance; the body's radius is 1

/// Builds it in a process of its own, so that only its memory is counted.
void measure_build(const char* name, const BuildOptions& options, const std::filesystem::path& csv) {
  constexpr std::uint32_t kTriangles = 1'000'000;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process to build in");
  if (child == 0) {
    int code = 1;
    try {
      const Mesh mesh = shapes::ellipsoid(shapes::semi_axes(shapes::Family::Fat), kTriangles, 1);
      std::optional<Model> built;
      const double taken = seconds([&] { built = must(build(mesh, options)).model; });
      const Model& model = *built;
      int level = model.level_count() - 1;
      while (level > model.finest_level() && model.level(level).deviation > kScaleTolerance / 2) --level;
      rusage used{};
      getrusage(RUSAGE_SELF, &used);
      std::ofstream(csv, std::ios::app) << name << ',' << options.detail.deviation << ',' << kTriangles << ','
                                        << model.level_count() << ',' << taken << ',' << double(used.ru_maxrss) / 1024 << ','
                                        << model.bytes().size() << ',' << model.level(level).prefix << '\n';
      code = 0;
    } catch (const std::exception& failure) {
      std::fprintf(stderr, "%s\n", failure.what());
    }
    _exit(code);
  }
  int status = 0;
  if (waitpid(child, &status, 0) < 0 || status != 0) throw std::runtime_error(std::string("no model by ") + name);
}

void measure_scale(const std::filesystem::path& results) {
  std::filesystem::create_directories(results);
  const std::filesystem::path csv = results / "scale.csv";
  std::ofstream(csv) << "method,deviation,triangles,levels,build_seconds,megabytes,bytes,prefix_for_one_percent\n";
  BuildOptions options;
  measure_build("collapse", options, csv);
  options.detail.deviation = kScaleTolerance / 2;
  measure_build("collapse", options, csv);
  options.detail = {};
  options.method = swiftlet::Method::Peel;
  measure_build("peel", options, csv);
}

void run(const std::filesystem::path& results, const std::filesystem::path& cache) {
  std::filesystem::create_directories(results);
  std::vector<Shape> real = links(cache);
  std::ofstream detail(results / "precision.csv");
  detail << "shape,tolerance,triangles,finest_triangles,bytes,build_seconds,ns,widest,short\n";
  std::vector<Shape> shapes = ellipsoids();
  shapes.insert(shapes.end(), real.begin(), real.end());
  for (const Shape& shape : shapes)
    for (const double tolerance : kTolerances) measure(shape, tolerance, detail);
  if (real.empty()) {
    std::fputs("no robot links: models/fetch has not run; the scene is of ellipsoids\n", stderr);
    real = ellipsoids();
  }
  std::ofstream scene(results / "links.csv");
  scene << "method,tolerance,bytes_per_link,seconds_per_link,ns,worst_error,failed\n";
  measure_scene(real, scene);
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) try {
  using namespace swiftlet::bench;
  const bool scale = argc == 4 && std::string(argv[3]) == "scale";
  if (argc != 3 && !scale) return std::fputs("swiftlet_scene_bench RESULTS_DIRECTORY LINKS_DIRECTORY [scale]\n", stderr), 2;
  scale ? measure_scale(argv[1]) : run(argv[1], argv[2]);
} catch (const std::exception& failure) {
  return std::fprintf(stderr, "%s\n", failure.what()), 1;
}
