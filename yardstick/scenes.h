// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the benchmark and the tests ask about: bodies, and who is asked about in which pose, one query after the other. Knows
// shapes, the builder and, where a pose is defined by its distance, our own exact distance; nothing of methods or clocks.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/model.h>

#include "pairs.h"
#include "shapes.h"

namespace swiftlet::yardstick {

/// A value: bodies, pairs of them, and poses in the order in which they are asked. A method keeps one warm start per pair;
/// where one orbit ends and the next begins, the pose jumps and the warm start stays.
struct Scene {
  std::string name;  ///< fat/2000/orbit2r/step10.4
  std::vector<Model> models;
  std::vector<double> build_seconds;  ///< per model, when it was built
  std::vector<BodyPair> pairs;
  std::vector<Query> queries;
};

/// The bodies of a scene, which must outlive them.
std::vector<SceneBody> bodies(const Scene& scene);

/// Degrees per query, close to the paper's 0.5 to 180. None divides 360: a pose that comes back trains branch predictors and
/// caches, and flatters marchers up to twofold.
inline constexpr std::array kSteps{0.52, 1.04, 2.2, 5.2, 10.4, 20.8, 45.4, 91.3, 178.3};
inline constexpr std::array<std::uint32_t, 4> kTriangles{200, 2'000, 20'000, 200'000};

/// How much a scene asks: `orbits` seeds, one after the other, of so many queries each.
struct Extent {
  std::uint32_t orbits = 20, queries = 500;
};

/// Models by what they are made of, built once and kept as files. A file's name is a hash of the shape, of the options, of the
/// file format and of a small body built with the same options, so that a changed builder is seen.
class Shelf {
 public:
  /// `directory` is made when missing.
  explicit Shelf(std::filesystem::path directory, BuildOptions options = {});

  struct Entry {
    Model model;
    double build_seconds;
  };
  /// Body 1 or 2 of shapes::pair, or another of the family, times `scale`.
  Entry ellipsoid(shapes::Family family, std::uint32_t triangles, std::uint64_t body, double scale = 1) const;
  /// A mesh file.
  Entry file(const std::filesystem::path& path) const;

 private:
  template <class MakeMesh>
  Entry entry(const std::string& shape, const MakeMesh& make_mesh) const;
  std::filesystem::path directory_;
  BuildOptions options_;
  std::string key_;
};

// The paper's motion [Ehmann & Lin 2000, sec. 5.3]: shapes::Orbit, seeds 100, 101, ..., queries 1, 2, ... Two different bodies
// of the family with bounding radius r = 1; `closest` and distances in r.

Scene orbit(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double closest, double step,
            Extent extent = {});
/// Both rotations uniform, the centres 2 r apart.
Scene random_poses(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, Extent extent = {});
/// Direction and orientation from the orbit, the centre moved along it until the bodies are that far apart.
Scene at_distance(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double distance, double step,
                  Extent extent = {});
inline constexpr double kClose = 1e-2, kSliding = 1e-6;
/// The same until they touch, and `depth` farther.
Scene shallow(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double step, double depth = 1e-3,
              Extent extent = {});
/// Orbits from near to far, about half of whose poses overlap: their closest distances run from 0.3 r to 1.7 r, times what the
/// family needs for that.
Scene mixed(const Shelf& shelf, shapes::Family family, std::uint32_t triangles, double step, Extent extent = {});

/// The same with rotations and translations rounded to float32, as many who ask keep their poses.
Scene rounded_to_float(Scene scene);
/// The same directions and rotations with the centres 0.8 r apart, or nearer: at most 0.8 of where the bodies touch.
Scene overlapping(Scene scene);

// Unequal pairs, the closest centres as far apart as the bounding radii together.

Scene ten_to_one(const Shelf& shelf, std::uint32_t triangles, double step, Extent extent = {});
Scene plate_and_long(const Shelf& shelf, std::uint32_t triangles, double step, Extent extent = {});
/// A fat body as large as the link.
Scene link_and_fat(const Shelf& shelf, const std::filesystem::path& link, std::uint32_t triangles, double step,
                   Extent extent = {});
Scene link_pair(const Shelf& shelf, const std::filesystem::path& link_a, const std::filesystem::path& link_b, double step,
                Extent extent = {});
/// The robot links that models/fetch put into `directory`; empty before it ran.
std::vector<std::filesystem::path> robot_links(const std::filesystem::path& directory);

/// 100 pairs of 200 different bodies, fat, plate and long, asked in turn, each pair on an orbit of its own.
Scene crowd(const Shelf& shelf, std::uint32_t triangles, double step, std::uint32_t rounds = 200);

// What keeps a benchmark honest; asserted by tests.

struct Coverage {
  double closest = 0;         ///< least distance of the bodies' centres
  double distinct_share = 0;  ///< different poses per query
};
Coverage coverage(const Scene& scene);
double overlapping_share(const Scene& scene);  ///< of the queries; costs a query each

}  // namespace swiftlet::yardstick
