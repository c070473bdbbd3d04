// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the tool's words say about models and meshes: text for people, JSON for programs. Knows nothing of the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>
#include <swiftlet/result.h>
#include <nlohmann/json_fwd.hpp>

namespace swiftlet::tool {

/// What a word says when it went well: `text`, and what is to be noted beside it, if anything; or `json`.
struct Output {
  std::string text, json, note{};
};

/// As it is printed.
std::string dump(const nlohmann::ordered_json& json);

/// {"error": {"code", "message", "file"}}: ErrorCode's name, one sentence, and a path or null.
std::string error_json(const Error& error);

/// A model and where it came from.
struct LoadedModel {
  std::string path;
  Model model;
};

/// Likewise a mesh.
struct LoadedMesh {
  std::string path;
  MeshModel mesh;
};

using LoadedBody = std::variant<LoadedModel, LoadedMesh>;
const std::string& path_of_body(const LoadedBody& body);

/// A row per level, finest first: vertices, faces (0 where the level is absent), triangles, deviation, volume_ratio (over level
/// 0's; 1 where that is 0), bytes, prefix (of the file, to the level's end; 0 where it is absent).
nlohmann::ordered_json levels_json(const Model& model);
std::string levels_text(const Model& model);

/// What a mesh holds and what it is made of: members to follow others, lines to follow a heading. `levels` has a row per level
/// of nodes, the root first: nodes, deviation (of the mesh cut there), prefix (of the file, to the level's end).
nlohmann::ordered_json mesh_json(const MeshModel& mesh);
std::string mesh_text(const MeshModel& mesh);

Output info(const LoadedModel& body);
Output info(const LoadedMesh& body);
Result<Output> verify(const LoadedModel& body);
Result<Output> verify(const LoadedMesh& body);

/// What is asked about a pair.
struct Asked {
  Options query;
  bool levels = false;          ///< of two models
  bool solid = false;           ///< meshes are the volumes that they bound
  bool is_signed = false;       ///< depths, too
  std::optional<double> reach;  ///< of contacts
  bool manifolds = false;       ///< of each of them
};

/// The body that queries take. Errors: BadValue and NotSolid, of a mesh that is no solid where one is asked for.
Result<MeshBody> shape_of(const LoadedBody& body, bool solid);

/// The distance, and with `levels` one line per level pair on the way. Its nanoseconds are those of a cold query that asks for
/// no narrower an interval than that pair gave: the median of many repeats, from a warm cache.
Result<Output> distance(const LoadedBody& a, const LoadedBody& b, const Pose& b_in_a, const Asked& asked);
/// All regions within `reach`, which is asked for.
Result<Output> contacts(const LoadedBody& a, const LoadedBody& b, const Pose& b_in_a, const Asked& asked);

/// Writes one level, which exists, as OFF.
Result<Output> export_level(const LoadedModel& body, int level, const std::filesystem::path& path);
/// Writes all triangles as OFF.
Result<Output> export_mesh(const LoadedMesh& body, const std::filesystem::path& path);
/// Writes the levels of a file that `detail` asks for; what is left of it where it ends early, if `salvaging`.
Result<Output> cut(const std::string& path, const std::string& to, const Detail& detail, bool salvaging);
/// The same of a mesh's file, whose levels are those of nodes.
Result<Output> cut_mesh(const std::string& path, const std::string& to, const Detail& detail, bool salvaging);

/// Writes all levels, or the mesh, as SVG.
Result<Output> draw_file(const LoadedModel& body, const std::filesystem::path& path);
Result<Output> draw_file(const LoadedMesh& body, const std::filesystem::path& path);

}  // namespace swiftlet::tool
