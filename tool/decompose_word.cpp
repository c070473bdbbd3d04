// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "decompose_word.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/decompose.h>
#include <nlohmann/json.hpp>

#include "body/file.h"
#include "choices.h"
#include "draw.h"
#include "progress_bar.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  std::string in, picture;
  Growth growth = Growth::Cresting;
  bool bar = true;  ///< of the progress, on a terminal
};

const Choices<Growth> kGrowths{
    {"depth", Growth::DepthFirst}, {"breadth", Growth::BreadthFirst}, {"cresting", Growth::Cresting}};

const char* name(Growth growth) {
  return std::find_if(kGrowths.begin(), kGrowths.end(), [&](const auto& g) { return g.second == growth; })->first.c_str();
}

Result<MeshModel> mesh_at(const std::string& path) {
  if (is_mesh(path_of(path))) return load_mesh(path_of(path));
  std::error_code ignored;
  if (is_model(path_of(path)) && std::filesystem::exists(path_of(path), ignored))
    return in_file(path, {ErrorCode::BadFormat, "is a model; decompose takes the mesh, a mesh file or a .swm"});
  const Result<Mesh> read = read_mesh(path_of(path));
  if (!read) return in_file(path, read.error());
  if (read.value().triangles.empty())
    return in_file(path, {ErrorCode::Empty, "is a cloud of points without triangles, which has no surface"});
  Result<MeshModel> mesh = MeshModel::from_triangles(read.value().points, read.value().triangles);
  if (!mesh) return in_file(path, mesh.error());
  return mesh;
}

/// What the patches are like.
struct Summary {
  explicit Summary(const Decomposition& made) : triangles(made.triangles.size()), patches(made.patches.size()) {
    std::vector<std::size_t> sizes;
    for (const Patch& patch : made.patches) {
      sizes.push_back(patch.end - patch.first);
      virtual_faces += patch.virtual_faces;
      flat += patch.flat;
    }
    std::sort(sizes.begin(), sizes.end());
    mean = double(triangles) / double(patches);
    median = sizes[sizes.size() / 2];
    largest = sizes.back();
  }
  std::size_t triangles, patches, median, largest, virtual_faces = 0, flat = 0;
  double mean;
};

Json json_of(const Request& request, const Decomposition& made, double seconds) {
  const Summary s(made);
  return {{"path", request.in},
          {"growth", name(request.growth)},
          {"triangles", s.triangles},
          {"patches", s.patches},
          {"triangles_per_patch", {{"mean", s.mean}, {"median", s.median}, {"largest", s.largest}}},
          {"virtual_faces", s.virtual_faces},
          {"flat_patches", s.flat},
          {"edges",
           {{"reflex", made.reflex_edges},
            {"open", made.open_edges},
            {"non_manifold", made.non_manifold_edges},
            {"flipped", made.flipped_edges},
            {"slit", made.slit_edges}}},
          {"not_taken", {{"not_convex", made.not_convex}, {"entered", made.entered}}},
          {"seconds", seconds}};
}

std::string text_of(const Request& request, const Decomposition& made, double seconds) {
  const Summary s(made);
  std::string text = request.in + "\n";
  text += format(" triangles  %zu\n", s.triangles);
  text += format(" patches    %zu, %zu of them flat, by %s growth\n", s.patches, s.flat, name(request.growth));
  text += format(" of these   %.2f triangles each, median %zu, largest %zu\n", s.mean, s.median, s.largest);
  text += format(" virtual    %zu faces of their hulls, which no patch covers\n", s.virtual_faces);
  text += format(" edges      that no patch crosses: %u reflex, %u open, %u non-manifold, %u flipped, %u slit\n",
                 made.reflex_edges, made.open_edges, made.non_manifold_edges, made.flipped_edges, made.slit_edges);
  text +=
      format(" not taken  %u triangles that fit no hull, %u that let the surface enter it\n", made.not_convex, made.entered);
  return text + format(" time       %.1f ms\n", 1e3 * seconds);
}

/// Per triangle, its patch.
std::vector<std::uint32_t> patch_of(const Decomposition& made) {
  std::vector<std::uint32_t> patch(made.triangles.size());
  for (std::uint32_t number = 0; number < made.patches.size(); ++number) {
    for (std::uint32_t i = made.patches[number].first; i < made.patches[number].end; ++i) patch[made.triangles[i]] = number;
  }
  return patch;
}

Result<Output> decompose_file(const Request& request) {
  using Clock = std::chrono::steady_clock;
  if (!request.picture.empty()) {
    if (const auto may = may_write(path_of(request.picture), path_of(request.in)); !may) return may.error();
    expect_name(request.picture, ".svg");
  }
  const Result<MeshModel> mesh = mesh_at(request.in);
  if (!mesh) return mesh.error();
  const auto begin = Clock::now();
  const auto made = [&] {
    const ProgressBar bar(request.bar);
    DecomposeOptions options;
    options.growth = request.growth;
    options.progress = [&bar](double fraction, std::string_view stage) { return bar(fraction, stage); };
    return decompose(mesh.value(), options);
  }();
  if (!made) return in_file(request.in, made.error());
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();

  Json json = json_of(request, made.value(), seconds);
  std::string text = text_of(request, made.value(), seconds);
  if (!request.picture.empty()) {
    const auto bytes = write_file(path_of(request.picture), draw(mesh.value(), stem(request.in), patch_of(made.value())));
    if (!bytes) return bytes.error();
    json["picture"] = request.picture;
    text += " wrote      " + request.picture + "\n";
  }
  return Output{text, dump(json)};
}

Action declare_decompose(CLI::App& word) {
  const auto request = std::make_shared<Request>();
  word.add_option("IN", request->in, "a mesh: .obj .off .stl .ply .tri .poly, or a .swm of build --mesh")->required();
  add_choice(word, "--growth", kGrowths, request->growth, "cresting",
             "how patches grow: depth first, breadth first, or breadth first from far off reflex edges");
  word.add_option("--draw", request->picture, "an .svg to write, a colour for each patch");
  return [request, &word] {
    request->bar = !asks_for_json(word);
    return decompose_file(*request);
  };
}

}  // namespace

Word decompose_word() {
  return {"decompose", "cuts a mesh's surface into convex patches, whose hulls the surface does not enter", declare_decompose};
}

}  // namespace swiftlet::tool
