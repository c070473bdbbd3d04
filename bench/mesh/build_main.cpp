// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes the meshes of a scene, with hulls, to two files. See count.
#include <cstdio>
#include <stdexcept>

#include <swiftlet/build_mesh.h>

#include "scenes.h"

using namespace swiftlet::bench::mesh;

int main(int argc, char** argv) try {
  if (argc != 5) return std::fputs("swiftlet_mesh_build SCENE MESHES FILE FILE\n", stderr), 2;
  const std::optional<Scene> scene = make_scene(argv[1], argv[2], 0);
  if (!scene) return std::fputs("its mesh file is missing: models/fetch\n", stderr), 1;
  const auto write = [](const swiftlet::Mesh& mesh, const char* file) {
    const swiftlet::Result<swiftlet::MeshModel> model = swiftlet::build_mesh(mesh);
    if (!model) throw std::runtime_error(model.error().message);
    if (const auto saved = swiftlet::save(model.value(), file); !saved) throw std::runtime_error(saved.error().message);
  };
  write(scene->a, argv[3]), write(scene->b, argv[4]);
} catch (const std::exception& failure) {
  return std::fprintf(stderr, "%s\n", failure.what()), 1;
}
