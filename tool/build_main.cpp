// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The tool with the builder: adds the words `build` and `decompose`, and reads mesh files wherever a model is expected.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh.h>
#include <swiftlet/model_file.h>

#include "body/file.h"
#include "choices.h"
#include "decompose_word.h"
#include "progress_bar.h"
#include "text.h"
#include "tool.h"

namespace swiftlet::tool {
namespace {

Result<Built> build_file(const std::string& path, const BuildOptions& options) {
  const Result<Mesh> mesh = read_mesh(path_of(path));
  if (!mesh) return in_file(path, mesh.error());
  Result<Built> built = build(mesh.value(), options);
  if (!built) return in_file(path, built.error());
  return built;
}

Result<Model> model_of_mesh(const std::filesystem::path& path) {
  Result<Built> built = build_file(utf8(path), {});
  if (!built) return built.error();
  return std::move(built).value().model;
}

struct Request {
  std::string in, out;
  bool mesh = false;
  HullOptions hulls;
  bool no_hulls = false;
  BuildOptions options;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  bool quiet = false;
  bool bar = true;  ///< of the progress, on a terminal
};

std::string report_text(const Request& request, const Built& built) {
  const BuildReport& r = built.report;
  std::string text = request.in + "\n";
  text += " read       " + counted(r.points_read, "point") + ", " + counted(r.triangles_read, "triangle") + "\n";
  text += " dropped    " + counted(r.duplicates_dropped, "duplicate") + ", " +
          counted(r.interior_dropped, "point that is no corner of the hull", "points that are no corner of the hull") + "\n";
  if (built.model.dimension() == 3) {
    text += format(" grouped    %zu triangles of the hull into %zu faces, %zu of them with more than three vertices\n",
                   r.hull_triangles, r.levels.front().faces, r.faces_grouped);
    text += format(" dents      the vertex deepest inside the hull is %.6g deep\n", r.deepest_dent);
    text += r.closed ? format(" volume     %.6g of the hull's\n", r.volume_ratio) : " volume     not closed: no volume\n";
  }
  text += levels_text(built.model) + " ended      " + r.end + "\n wrote      " + request.out;
  return text + format(", %zu bytes\n", built.model.bytes().size());
}

nlohmann::ordered_json report_json(const Request& request, const Built& built) {
  const BuildReport& r = built.report;
  return {{"path", request.out},
          {"mesh", request.in},
          {"bytes", built.model.bytes().size()},
          {"finest_level", built.model.finest_level()},
          {"points_read", r.points_read},
          {"triangles_read", r.triangles_read},
          {"duplicates_dropped", r.duplicates_dropped},
          {"interior_dropped", r.interior_dropped},
          {"hull_triangles", r.hull_triangles},
          {"faces_grouped", r.faces_grouped},
          {"volume_ratio", r.closed ? nlohmann::ordered_json(r.volume_ratio) : nullptr},
          {"deepest_dent", r.deepest_dent},
          {"levels", levels_json(built.model)},
          {"end", r.end}};
}

/// `build --mesh`: all triangles as they are, with hulls.
Result<Output> build_mesh_file(const Request& request) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
  const auto begin = Clock::now();
  const Result<Mesh> read = read_mesh(path_of(request.in));
  if (!read) return in_file(request.in, read.error());
  const Mesh& given = read.value();
  if (given.triangles.empty())
    return in_file(request.in, {ErrorCode::Empty, "is a cloud of points without triangles; without --mesh they make a hull"});
  const auto middle = Clock::now();
  const auto built = [&] {
    const ProgressBar bar(request.bar);
    if (request.no_hulls)
      return MeshModel::from_triangles(given.points, given.triangles,
                                       {.progress = [&bar](double fraction) { return bar(fraction, "tree"); }});
    HullOptions options = request.hulls;
    options.progress = [&bar](double fraction, std::string_view stage) { return bar(fraction, stage); };
    if (request.threads > 1) options.executor = on_threads(request.threads);
    return build_mesh(given, options);
  }();
  if (!built) return in_file(request.in, built.error());
  const double reading = seconds(middle - begin), building = seconds(Clock::now() - middle);
  const MeshModel& mesh = built.value();
  if (const auto saved = write_file(path_of(request.out), mesh.bytes()); !saved) return saved.error();

  nlohmann::ordered_json json{{"path", request.out},
                              {"mesh", request.in},
                              {"points_read", given.points.size()},
                              {"triangles_read", given.triangles.size()}};
  json.update(mesh_json(mesh));
  json.update({{"seconds_read", reading}, {"seconds_built", building}});
  std::string text = request.in + "\n read       " + counted(given.points.size(), "point") + ", " +
                     counted(given.triangles.size(), "triangle") + "\n";
  text += mesh_text(mesh) + format(" time       %.1f ms to read, %.1f ms to build\n", 1e3 * reading, 1e3 * building);
  text += " wrote      " + request.out + "\n";
  return Output{request.quiet ? "" : text, dump(json)};
}

Result<Output> build_word(const Request& request) {
  if (const auto may = may_write(path_of(request.out), path_of(request.in)); !may) return may.error();
  expect_name(request.out, request.mesh ? ".swm" : ".swl");
  if (request.mesh) return build_mesh_file(request);
  BuildOptions options = request.options;
  if (request.threads > 1) options.executor = on_threads(request.threads);
  const auto built = [&]() -> Result<Built> {
    const ProgressBar bar(request.bar);
    options.progress = [&bar](double fraction, std::string_view stage) { return bar(fraction, stage); };
    return build_file(request.in, options);
  }();
  if (!built) return built.error();
  if (const auto saved = write_file(path_of(request.out), built.value().model.bytes()); !saved) return saved.error();
  return Output{request.quiet ? "" : report_text(request, built.value()), dump(report_json(request, built.value()))};
}

/// The options of `build --mesh` alone.
void declare_hulls(CLI::App& word, Request& request) {
  HullOptions& o = request.hulls;
  const std::vector<CLI::Option*> about_hulls{
      word.add_option("--hull-levels", o.levels, "levels of the tree, from the root on, whose nodes may have hulls, 1 to 16")
          ->capture_default_str()
          ->check(number_in(1, 16, "from 1 to 16")),
      word.add_option("--hull-triangles", o.least_triangles, "no node of fewer triangles has a hull, but the root")
          ->capture_default_str()
          ->check(not_negative()),
      word.add_option("--hull-bytes", o.bytes_per_triangle,
                      "hulls may make the file as large as so many bytes a triangle; those of most triangles come first")
          ->capture_default_str()
          ->check(number_in(0, std::numeric_limits<double>::max(), "from 0 up")),
      word.add_option("--hull-patches", o.least_patch,
                      "where convex patches hold so many triangles in the mean, they have hulls of their own; 0: never")
          ->capture_default_str()
          ->check(not_negative())};
  CLI::Option* const none = word.add_flag("--no-hulls", request.no_hulls, "no hulls: sooner built, slower asked from afar");
  for (CLI::Option* const option : about_hulls) none->excludes(option);
}

Action declare_build(CLI::App& word) {
  const auto request = std::make_shared<Request>();
  BuildOptions& o = request->options;
  const Choices<Method> methods{{"peel", Method::Peel}, {"collapse", Method::Collapse}};
  const Choices<Enclosing> enclosings{{"tight", Enclosing::Tight}, {"scale", Enclosing::Scale}};
  const Choices<lut::Resolution> tables{{"none", lut::Resolution::None},
                                        {"22.5", lut::Resolution::Degrees22},
                                        {"11.25", lut::Resolution::Degrees11},
                                        {"5.625", lut::Resolution::Degrees5}};
  word.add_option("IN", request->in, "a mesh: .obj .off .stl .ply .tri .poly; only its points shape a model")->required();
  word.add_option("-o,--output", request->out, "the .swl model or .swm mesh to write")->required();
  word.add_flag("--mesh", request->mesh, "write a .swm mesh of all triangles as they are, with hulls that answer from afar");
  word.add_flag("--quiet", request->quiet, "no progress bar, no report");
  word.add_option("--threads", request->threads, "how many threads build; the file is the same with any")
      ->capture_default_str()
      ->check(number_in(1, 1024, "from 1 to 1024"));
  const std::size_t common = word.get_options().size();
  declare_hulls(word, *request);
  const std::size_t of_meshes = word.get_options().size();
  add_choice(word, "--method", methods, o.method, "collapse", "quadric error edge collapse, or peeling of independent sets");
  add_choice(word, "--enclosing", enclosings, o.enclosing, "tight",
             "how a level is made to hold level 0: vertex by vertex, or by scaling");
  word.add_option("--rate", o.rate,
                  "triangles of a level over those of the one before, between 0 and 1; none: as queries like it")
      ->check(number_in(std::nextafter(0.0, 1.0), std::nextafter(1.0, 0.0), "between 0 and 1"));
  word.add_option("--cutoff", o.cutoff, "no level is simplified to fewer triangles, 4 or more")
      ->capture_default_str()
      ->check(not_negative())
      ->check(number_in(4, std::numeric_limits<std::uint32_t>::max(), "from 4 up"));
  word.add_option("--levels", o.max_levels, "at most so many, level 0 included, 1 to 32")
      ->capture_default_str()
      ->check(number_in(1, 32, "from 1 to 32"));
  word.add_option("--max-deviation", o.max_deviation, "no level deviates more, in the mesh's unit; 0: no limit")
      ->capture_default_str()
      ->check(number_in(0, std::numeric_limits<double>::max(), "from 0 up"));
  add_detail(word, o.detail);
  word.add_option("--map", o.table.map_cells, "entries of the support maps per vertex, 0 to 64; 0: no maps")
      ->capture_default_str()
      ->check(number_in(0, 64, "from 0 to 64"));
  add_choice(word, "--table", tables, o.table.resolution, "none", "degrees between the samples of the paper's start table");
  word.add_option("--radius-factor", o.table.radius_factor, "its samples lie on a sphere of so many bounding radii, 1 to 1e6")
      ->capture_default_str()
      ->check(number_in(1, 1e6, "from 1 to 1e6"));
  word.add_flag("--require-convex", o.require_convex, "refuse a mesh with dents");
  word.add_flag("--require-solid", o.require_solid, "refuse flat, collinear and single-point input");
  const std::vector<CLI::Option*> options = word.get_options();
  for (std::size_t i = common; i < options.size(); ++i) options[i]->group(i < of_meshes ? "With --mesh" : "Without --mesh");
  return [request, options, common, of_meshes, &word] {
    for (std::size_t i = common; i < options.size(); ++i) {
      if (options[i]->count() > 0 && request->mesh != (i < of_meshes))
        throw CLI::ValidationError(options[i]->get_name(), request->mesh ? "is not for --mesh" : "is for --mesh alone");
    }
    request->bar = !request->quiet && !asks_for_json(word);
    return build_word(*request);
  };
}

}  // namespace
}  // namespace swiftlet::tool

int main(int argc, char** argv) {
  using namespace swiftlet::tool;
  const Word build{"build",
                   "makes a model of a mesh: its hull and coarser levels that enclose it; or, with --mesh, the mesh itself",
                   declare_build};
  const Word words[] = {build, decompose_word()};
  return run_tool(argc, argv, model_of_mesh, words);
}
