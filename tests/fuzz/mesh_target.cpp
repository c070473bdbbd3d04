// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include <swiftlet/build.h>
#include <swiftlet/check.h>

#include "fuzz.h"
#include "mesh_file.h"

namespace swiftlet::fuzz {
namespace {

constexpr std::array kExtensions{".off", ".obj", ".stl", ".ply", ".tri", ".poly"};
constexpr std::size_t kMostPoints = 64;  // that are built: more would only be slower

}  // namespace

std::string mesh(Input input) {
  Bytes bytes(input);
  const char* extension = kExtensions[bytes.take<std::uint8_t>() % kExtensions.size()];
  const Input file = bytes.rest();
  const Result<Mesh> read = lod::mesh_of_bytes({reinterpret_cast<const char*>(file.data()), file.size()}, extension);
  if (!read) return read.error().message.empty() ? "refused without a reason" : "";
  if (read.value().points.empty() || read.value().points.size() > file.size()) return "points out of nothing";
  if (read.value().points.size() > kMostPoints || read.value().triangles.size() > 4 * kMostPoints) return {};
  BuildOptions options;
  options.cutoff = 4;
  const Result<Built> built = build(read.value(), options);
  if (!built) return built.error().message.empty() ? "not built without a reason" : "";
  return verify(built.value().model).message;
}

}  // namespace swiftlet::fuzz
