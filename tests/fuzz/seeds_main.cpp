// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes good inputs for every target into FOLDER/TARGET/, for libFuzzer to start from.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <swiftlet/build.h>

#include "bodies.h"
#include "judge.h"
#include "shapes.h"
#if SWIFTLET_FUZZ_MESHES
#include <cmath>

#include <swiftlet/build_mesh.h>

#include "soups.h"
#endif

namespace swiftlet::fuzz {
namespace {

class Folder {
 public:
  explicit Folder(const std::filesystem::path& path) : path_(path) { std::filesystem::create_directories(path); }
  void add(const std::string& bytes) { std::ofstream(path_ / ("seed" + std::to_string(count_++)), std::ios::binary) << bytes; }

 private:
  std::filesystem::path path_;
  int count_ = 0;
};

template <class... Values>
std::string packed(const Values&... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

void write_models(Folder folder) {
  using namespace bodies;
  BuildOptions options;
  options.cutoff = 4;
  options.table.resolution = lut::Resolution::None;
  const ModelOptions bare{false, {lut::Resolution::None, 2}};
  for (const Model& m :
       {nested(2, bare), nested(3), bodies::model(cube(), bare),
        bodies::model(two_sided({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), bare), bodies::model(segment({0, 0, 0}, {1, 0, 0}), bare),
        bodies::model(point({1, 2, 3}), bare), must(build(shapes::ellipsoid({1, 1, .5}, 40, 1), options)).model,
        must(build(shapes::meshed_cube(2), options)).model}) {
    folder.add({reinterpret_cast<const char*>(m.bytes().data()), m.bytes().size()});
  }
}

void write_meshes(Folder folder) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  folder.add('\0' + ("OFF\n4 4 6\n" + points + faces));
  folder.add('\0' + ("CNOFF # four\n4 1 0\n0 0 0 1 0 0 255 0 0\n" + points.substr(6) + "4 0 1 2 3 0.5 0.5 0.5\n"));
  folder.add("\1v 0 0 0\nv 1 \\\n 0 0\nv 0 1 0\nv 0 0 1\nf 1/1/1 3//2 2\nf -4 -3 -1\nf 2 3 4\n");
  folder.add(
      "\2solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n");
  folder.add("\2" + std::string(80, ' ') + packed(1u, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f) + "ab");
  const std::string vertex = "element vertex 4\nproperty double x\nproperty double y\nproperty float z\n",
                    face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  folder.add("\3ply\nformat ascii 1.0\ncomment t\n" + vertex + face + points + "4 0 1 2 3\n");
  std::string binary = "\3ply\nformat binary_little_endian 1.0\n" + vertex + face;
  for (int v = 0; v < 4; ++v) binary += packed(double(v == 1), double(v == 2), float(v == 3));
  folder.add(binary + packed(std::uint8_t(3), 0, 1, 2));
  folder.add("\3ply\nformat binary_big_endian 1.0\n" + vertex + "element face 0\nend_header\n" + std::string(80, '\0'));
  folder.add("\4TRI\n4 4\n" + points + "0 2 1\n0 1 3\n1 2 3\n0 3 2\n");
  folder.add("\5POLY\n4 4\n" + points + faces);
}

const std::string cold(kSeedBytes, '\0');  // as take_seed reads one

/// As take_pose reads one: a shift by sixteenths, and any double at all.
std::string shifted(int x, int y, int z) { return packed(std::uint8_t(1), std::int8_t(x), std::int8_t(y), std::int8_t(z)); }
std::string raw(const Pose& pose) {
  std::string bytes = packed(std::uint8_t(0));
  for (int i = 0; i < 9; ++i) bytes += packed(pose.rotation(i / 3, i % 3));
  for (const double x : pose.translation) bytes += packed(x);
  return bytes;
}

void write_queries(Folder folder) {
  shapes::Random random(1);
  for (int i = 0; i < 40; ++i) {
    const auto byte = [&](unsigned below) { return std::uint8_t(random.bits() % below); };
    std::string bytes = packed(byte(10), byte(10), byte(6), byte(4), byte(2),
                               std::uint8_t((i % 4 ? 0 : 16 + 2) + (i % 3 ? 0 : 32)), 0.01, std::uint16_t(3));
    if (i % 4) bytes.resize(6);
    bytes += packed(0.5f) + cold;
    if (i % 3 == 0) bytes += packed(i % 2 ? 1.0 : 0.0, 0x1p-21, std::uint32_t(i % 9), 4u) + std::string(2 * 2 * 9, char(1));
    for (int k = 0; k < 2; ++k)
      bytes += i % 2 ? shifted(int(random.bits() % 64), int(random.bits() % 64), 32)
                     : raw({random.rotation(), 2 * random.on_sphere()});
    folder.add(bytes);
  }
}

void write_hulls(Folder folder) {
  shapes::Random random(2);
  for (int i = 0; i < 40; ++i) {
    std::string bytes = (i % 2 ? shifted(i, 20, 3) : raw({random.rotation(), 2 * random.on_sphere()})) + cold;
    for (int body = 0; body < 2; ++body) {
      const int points = 1 + int(random.bits() % 12);
      bytes += packed(std::uint8_t(i % 4), std::uint8_t(points - 1));
      for (int k = 0; k < 3 * points; ++k) {
        if (i % 4 == 3)
          bytes += packed(random.uniform(-1, 1));
        else
          bytes +=
              packed(std::int8_t(random.bits() % 33 - 16)) + (i % 4 == 1 ? packed(std::int8_t(random.bits() % 5 - 2)) : "");
      }
    }
    folder.add(bytes);
  }
}

#if SWIFTLET_FUZZ_MESHES
void write_triangles(Folder folder) {
  shapes::Random random(3);
  for (int i = 0; i < 40; ++i) {
    std::string bytes = i % 2 ? shifted(int(random.bits() % 64), 16, 0) : raw({random.rotation(), 2 * random.on_sphere()});
    bytes += packed(std::uint8_t(i % 4), std::uint8_t(i % 5)) + packed(1.f, 0.f, 0.f) + cold + packed(0.5f);
    bytes += packed(std::uint8_t((i % 8 ? 0 : 8 + 16) + (i % 3 ? 0 : 32 + 64)), std::uint8_t(9));
    if (i % 8) bytes.pop_back();
    for (int body = 0; body < 2; ++body) {
      const int points = 3 + int(random.bits() % 9), count = 1 + int(random.bits() % 8);
      bytes += packed(std::uint8_t(i % 3), std::uint8_t(points - 1), std::uint8_t(count - 1));
      for (int k = 0; k < 3 * points; ++k) {
        const double x = random.uniform(-1, 1);
        bytes += i % 3 == 0 ? packed(std::int8_t(4 * x)) : i % 3 == 1 ? packed(float(x)) : packed(x);
      }
      for (int k = 0; k < 3 * count; ++k) bytes += packed(std::uint8_t(random.bits()));
    }
    bytes += packed(std::int8_t(i % 5 - 2), std::int8_t(0), std::int8_t(1), std::uint8_t(i % 12));
    folder.add(bytes);
  }
}

void write_blocks(Folder folder) {
  shapes::Random random(4);
  HullOptions options;
  options.levels = 16, options.least_triangles = 1, options.bytes_per_triangle = 1e6;
  for (int i = 0; i < 8; ++i) {
    const MeshModel mesh = (i % 2 ? soups::scattered(random, 1 + 4 * i, 0.5) : soups::any(random)).mesh();
    const MeshModel with_hulls = bodies::must(rebuild_hulls(mesh, options));
    for (const MeshModel* m : {&mesh, &with_hulls})
      folder.add({reinterpret_cast<const char*>(m->bytes().data()), m->bytes().size()});
  }
  const MeshModel fine = soups::ball(2).mesh();
  const MeshModel cut = fine.cut({.deviation = std::nextafter(fine.deviation(1), 1e9)});
  folder.add({reinterpret_cast<const char*>(cut.bytes().data()), cut.bytes().size()});
}
#endif

}  // namespace
}  // namespace swiftlet::fuzz

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: swiftlet_fuzz_seeds FOLDER\n", stderr), 2;
  using namespace swiftlet::fuzz;
  const std::filesystem::path folder = argv[1];
  write_models(Folder(folder / "model"));
  write_meshes(Folder(folder / "mesh"));
  write_queries(Folder(folder / "query"));
  write_hulls(Folder(folder / "hulls"));
#if SWIFTLET_FUZZ_MESHES
  write_triangles(Folder(folder / "triangles"));
  write_blocks(Folder(folder / "block"));
#endif
}
