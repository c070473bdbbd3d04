// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Pairs of meshes and the poses at which they are asked about. Poses that need a distance take ours and are rounded to where
// its last bits do not show, so that another version of the kernel makes the same ones.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/mesh.h>

namespace swiftlet::bench::mesh {

/// How the bodies of a scene are to each other.
enum class Stance { Any, Near, Pressed, Deep };

struct Scene {
  std::string name;
  Mesh a, b;
  MeshModel model_a, model_b;  ///< ours, of these, without hulls
  double radius = 0;           ///< the larger of their radii, each about the middle of its box
  Stance stance = Stance::Any;
  std::vector<Pose> poses;  ///< of B in A, in the order in which they are asked about
};

std::vector<std::string> scene_names();
/// The scene of that name with so many poses; empty where its mesh file is not in `meshes`.
std::optional<Scene> make_scene(const std::string& name, const std::filesystem::path& meshes, std::size_t poses);

}  // namespace swiftlet::bench::mesh
