// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Knows how scenes are put together. Motion along the orbit is about the bodies' centres, which for links are not their
// origins.
#include "scenes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <span>
#include <stdexcept>

#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

namespace swiftlet::yardstick {
namespace {

constexpr std::uint64_t kFirstOrbit = 100;

/// A benchmark without its bodies has nothing to say: what is missing ends it.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

std::string text(const char* format, auto... values) {
  std::array<char, 256> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// FNV-1a.
std::uint64_t hash_of(const std::string& s) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : s) h = (h ^ std::uint8_t(c)) * 0x100000001b3u;
  return h;
}

std::uint64_t ellipsoid_seed(std::uint64_t body, std::uint32_t triangles) {
  return 1000003 * body + triangles;
}  // as shapes::pair

}  // namespace

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

Shelf::Shelf(std::filesystem::path directory, BuildOptions options)
    : directory_(std::move(directory)), options_(std::move(options)) {
  std::filesystem::create_directories(directory_);
  std::vector<Vec3> probe(200);
  shapes::Random random(1);
  for (Vec3& p : probe) p = random.on_sphere();
  key_ = text("%u %d %d %.17g %u %d %.17g %.17g %d %.17g %llx", kModelFileVersion, int(options_.method),
              int(options_.enclosing), options_.rate.value_or(0), options_.cutoff, options_.max_levels, options_.max_deviation,
              options_.detail.deviation, int(options_.table.resolution), options_.table.radius_factor,
              static_cast<unsigned long long>(must(build(probe, options_)).model.hash()));
}

template <class MakeMesh>
Shelf::Entry Shelf::entry(const std::string& shape, const MakeMesh& make_mesh) const {
  const std::string name = shape + text("-%016llx", static_cast<unsigned long long>(hash_of(shape + " " + key_)));
  const std::filesystem::path model_path = directory_ / (name + ".swl"), seconds_path = directory_ / (name + ".seconds");
  double seconds = 0;
  if (std::ifstream kept(seconds_path); kept >> seconds) {
    if (Result<Model> model = load(model_path)) return {std::move(model).value(), seconds};
  }
  const Mesh mesh = make_mesh();
  const auto begin = std::chrono::steady_clock::now();
  Model model = must(build(mesh, options_)).model;
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  must(save(model, model_path));
  std::ofstream(seconds_path) << seconds << "\n";
  return {std::move(model), seconds};
}

Shelf::Entry Shelf::ellipsoid(shapes::Family family, std::uint32_t triangles, std::uint64_t body, double scale) const {
  const std::string shape =
      text("%s-%u-%llu-%g", shapes::name(family), triangles, static_cast<unsigned long long>(body), scale);
  return entry(shape, [&] {
    Mesh mesh = shapes::ellipsoid(shapes::semi_axes(family), triangles, ellipsoid_seed(body, triangles));
    if (scale != 1) {
      for (Vec3& p : mesh.points) p *= scale;
    }
    return mesh;
  });
}

Shelf::Entry Shelf::file(const std::filesystem::path& path) const {
  return entry(path.stem().string(), [&] { return must(read_mesh(path)); });
}

std::vector<SceneBody> bodies(const Scene& scene) {
  std::vector<SceneBody> result;
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    result.push_back({&scene.models[i], scene.models[i].level(0).view, scene.build_seconds[i]});
  }
  return result;
}

// ---- Motions ---------------------------------------------------------------------------------------------------------------

namespace {

void add(Scene& scene, Shelf::Entry entry) {
  scene.models.push_back(std::move(entry.model));
  scene.build_seconds.push_back(entry.build_seconds);
}

/// Two bodies, one pair, no queries yet.
Scene two(std::string name, Shelf::Entry a, Shelf::Entry b) {
  Scene scene;
  scene.name = std::move(name);
  add(scene, std::move(a));
  add(scene, std::move(b));
  scene.pairs = {{0, 1}};
  return scene;
}

Scene family_pair(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, const std::string& motion) {
  return two(text("%s/%u/%s", shapes::name(family), triangles, motion.c_str()), shelf.ellipsoid(family, triangles, 1),
             shelf.ellipsoid(family, triangles, 2));
}

std::string step_name(double step) { return text("step%g", step); }

/// The pose that puts B's centre at `pose.translation` from A's, turned by its rotation.
Pose about_centres(const Model& a, const Model& b, const Pose& pose) {
  return {pose.rotation, pose.translation + (a.centre() - pose.rotation * b.centre())};
}

/// The vector from A's centre to B's.
Vec3 offset(const Model& a, const Model& b, const Pose& b_in_a) {
  return b_in_a.translation - (a.centre() - b_in_a.rotation * b.centre());
}

void add_orbits(Scene& scene, std::uint32_t pair, double closest, double step, std::uint64_t first_orbit, Extent extent) {
  const Model &a = scene.models[scene.pairs[pair].a], &b = scene.models[scene.pairs[pair].b];
  for (std::uint32_t k = 0; k < extent.orbits; ++k) {
    const shapes::Orbit motion(first_orbit + k, closest, step);
    for (std::uint32_t i = 1; i <= extent.queries; ++i) scene.queries.push_back({pair, about_centres(a, b, motion.pose(i))});
  }
}

/// Moves the centre of B along its direction until the bodies are `distance` apart. The distance along a ray that leads away is
/// convex, so that Newton's method from outside never passes the answer, and ends on its last flat piece. The result is rounded
/// to where the last bits of the distance do not show, so that another version of the kernel makes the same scene.
Pose moved_to(const Model& a, const Model& b, const Pose& pose, double distance, double depth = 0) {
  const Vec3 centre = offset(a, b, pose), direction = centre / centre.norm();
  double along = a.radius() + b.radius() + distance;
  const auto at = [&](double t) -> Pose { return {pose.rotation, pose.translation + direction * (t - centre.norm())}; };
  PairSeed seed;
  constexpr int kNewtonLimit = 100;
  for (int i = 0; i < kNewtonLimit; ++i) {
    const Answer answer = swiftlet::distance(a, b, at(along), seed);
    const double step = (answer.upper - distance) / answer.normal.dot(direction);
    if (!(step > 1e-9 * distance)) break;
    along -= step;
  }
  const double unit = 0x1p-44 * (a.radius() + b.radius());
  return at((std::round(along / unit)) * unit - depth);
}

/// As far apart as contact means here, in radii: far above rounding, far below `depth`.
constexpr double kContact = 1e-9;

}  // namespace

Scene orbit(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double closest, double step, Extent extent) {
  Scene scene = family_pair(shelf, family, triangles, text("orbit%gr/", closest) + step_name(step));
  add_orbits(scene, 0, closest, step, kFirstOrbit, extent);
  return scene;
}

Scene random_poses(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, Extent extent) {
  Scene scene = family_pair(shelf, family, triangles, "random");
  shapes::Random random(kFirstOrbit);
  for (std::uint32_t i = 0; i < extent.orbits * extent.queries;
       ++i) {  // a uniform direction turns A as a uniform rotation would
    const Pose pose{random.rotation(), 2 * random.on_sphere()};
    scene.queries.push_back({0, about_centres(scene.models[0], scene.models[1], pose)});
  }
  return scene;
}

Scene at_distance(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double distance, double step,
                  Extent extent) {
  Scene scene = orbit(shelf, family, triangles, 2, step, extent);
  const std::string motion = distance == kClose ? "close" : distance == kSliding ? "sliding" : text("gap%g", distance);
  scene.name = text("%s/%u/", shapes::name(family), triangles) + motion + "/" + step_name(step);
  for (Query& query : scene.queries) query.b_in_a = moved_to(scene.models[0], scene.models[1], query.b_in_a, distance);
  return scene;
}

Scene shallow(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double step, double depth, Extent extent) {
  Scene scene = orbit(shelf, family, triangles, 2, step, extent);
  scene.name = text("%s/%u/shallow/", shapes::name(family), triangles) + step_name(step);
  for (Query& query : scene.queries) query.b_in_a = moved_to(scene.models[0], scene.models[1], query.b_in_a, kContact, depth);
  return scene;
}

Scene mixed(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double step, Extent extent) {
  for (double nearer = 1.6;; nearer *= 0.9) {
    Scene scene = family_pair(shelf, family, triangles, "mixed/" + step_name(step));
    for (std::uint32_t k = 0; k < extent.orbits; ++k) {
      const double between = extent.orbits > 1 ? double(k) / (extent.orbits - 1) : 0;
      add_orbits(scene, 0, nearer * (0.3 + 1.4 * between), step, kFirstOrbit + k, {1, extent.queries});
    }
    if (nearer < 0.02 || overlapping_share(scene) >= 0.45) return scene;
  }
}

Scene rounded_to_float(Scene scene) {
  scene.name += "/float32";
  for (Query& query : scene.queries) {
    query.b_in_a.rotation = query.b_in_a.rotation.cast<float>().cast<double>();
    query.b_in_a.translation = query.b_in_a.translation.cast<float>().cast<double>();
  }
  return scene;
}

Scene overlapping(Scene scene) {
  constexpr double kShare = 0.8;
  scene.name += "/overlapping";
  for (Query& query : scene.queries) {
    const BodyPair pair = scene.pairs[query.pair];
    const Model &a = scene.models[pair.a], &b = scene.models[pair.b];
    const double radius = std::max(a.radius(), b.radius());
    const Vec3 touching = offset(a, b, moved_to(a, b, query.b_in_a, kContact));
    const double apart = kShare * std::min(radius, touching.norm());
    query.b_in_a.translation += touching.normalized() * apart - offset(a, b, query.b_in_a);
  }
  return scene;
}

Scene ten_to_one(const Shelf& shelf, std::uint32_t triangles, double step, Extent extent) {
  Scene scene = two(text("ten_to_one/%u/", triangles) + step_name(step), shelf.ellipsoid(shapes::Family::Fat, triangles, 1),
                    shelf.ellipsoid(shapes::Family::Fat, triangles, 2, 0.1));
  add_orbits(scene, 0, 1.1, step, kFirstOrbit, extent);
  return scene;
}

Scene plate_and_long(const Shelf& shelf, std::uint32_t triangles, double step, Extent extent) {
  Scene scene = two(text("plate_and_long/%u/", triangles) + step_name(step),
                    shelf.ellipsoid(shapes::Family::Plate, triangles, 1), shelf.ellipsoid(shapes::Family::Long, triangles, 2));
  add_orbits(scene, 0, 2, step, kFirstOrbit, extent);
  return scene;
}

Scene link_and_fat(const Shelf& shelf, const std::filesystem::path& link, std::uint32_t triangles, double step, Extent extent) {
  Shelf::Entry a = shelf.file(link);
  const double radius = a.model.radius();
  Scene scene = two(link.stem().string() + text("_and_fat/%u/", triangles) + step_name(step), std::move(a),
                    shelf.ellipsoid(shapes::Family::Fat, triangles, 2, radius));
  add_orbits(scene, 0, 2 * radius, step, kFirstOrbit, extent);
  return scene;
}

Scene link_pair(const Shelf& shelf, const std::filesystem::path& link_a, const std::filesystem::path& link_b, double step,
                Extent extent) {
  Scene scene = two(link_a.stem().string() + "_and_" + link_b.stem().string() + "/" + step_name(step), shelf.file(link_a),
                    shelf.file(link_b));
  add_orbits(scene, 0, scene.models[0].radius() + scene.models[1].radius(), step, kFirstOrbit, extent);
  return scene;
}

std::vector<std::filesystem::path> robot_links(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> links;
  for (const char* name : {"fetch_base.stl", "fetch_head_pan.stl", "fetch_gripper.stl", "fetch_wheel.stl", "ur10_forearm.obj",
                           "ur10_wrist2.obj"}) {
    if (std::filesystem::exists(directory / name)) links.push_back(directory / name);
  }
  return links;
}

Scene crowd(const Shelf& shelf, std::uint32_t triangles, double step, std::uint32_t rounds) {
  constexpr std::uint32_t kPairs = 100;
  Scene scene;
  scene.name = text("crowd/%u/", triangles) + step_name(step);
  for (std::uint32_t k = 0; k < kPairs; ++k) {
    const shapes::Family family = shapes::kFamilies[k % shapes::kFamilies.size()];
    add(scene, shelf.ellipsoid(family, triangles, 2 * k + 1));
    add(scene, shelf.ellipsoid(family, triangles, 2 * k + 2));
    scene.pairs.push_back({2 * k, 2 * k + 1});
  }
  for (std::uint32_t i = 1; i <= rounds; ++i) {
    for (std::uint32_t k = 0; k < kPairs; ++k) {
      const Pose pose = shapes::Orbit(kFirstOrbit + k, 2, step).pose(i);
      scene.queries.push_back({k, about_centres(scene.models[2 * k], scene.models[2 * k + 1], pose)});
    }
  }
  return scene;
}

// ---- Honesty ---------------------------------------------------------------------------------------------------------------

Coverage coverage(const Scene& scene) {
  Coverage result{HUGE_VAL, 0};
  std::set<std::string> distinct;
  for (const Query& query : scene.queries) {
    const BodyPair pair = scene.pairs[query.pair];
    result.closest = std::min(result.closest, offset(scene.models[pair.a], scene.models[pair.b], query.b_in_a).norm());
    std::string bits(reinterpret_cast<const char*>(&query.b_in_a), sizeof query.b_in_a);
    bits.append(reinterpret_cast<const char*>(&query.pair), sizeof query.pair);
    distinct.insert(std::move(bits));
  }
  result.distinct_share = double(distinct.size()) / double(scene.queries.size());
  return result;
}

double overlapping_share(const Scene& scene) {
  std::vector<PairSeed> seeds(scene.pairs.size());
  std::size_t overlapping = 0;
  for (const Query& query : scene.queries) {
    const BodyPair pair = scene.pairs[query.pair];
    const Answer answer = intersects(scene.models[pair.a], scene.models[pair.b], query.b_in_a, seeds[query.pair]);
    overlapping += answer.verdict == Verdict::Overlapping;
  }
  return double(overlapping) / double(scene.queries.size());
}

}  // namespace swiftlet::yardstick
