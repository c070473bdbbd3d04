// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the tool's words say about models and meshes: text for people, JSON for programs. Knows nothing of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>
#include <swiftlet/result.h>
#include <nlohmann/json_fwd.hpp>

namespace swiftlet::tool {

/// What a word says when it went well; one of the two is printed.
struct Output {
  std::string text, json;
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

/// What a mesh holds and what it is made of: members to follow others, lines to follow a heading.
nlohmann::ordered_json mesh_json(const MeshModel& mesh);
std::string mesh_text(const MeshModel& mesh);

Output info(const LoadedModel& body);
Output info(const LoadedMesh& body);
Result<Output> verify(const LoadedModel& body);
Result<Output> verify(const LoadedMesh& body);

/// The distance, and with `show_levels` one line per level pair on the way, of two models only. Its nanoseconds are those of a
/// cold query that asks for no narrower an interval than that pair gave: the median of many repeats, from a warm cache.
Output distance(const LoadedBody& a, const LoadedBody& b, const Pose& b_in_a, const Options& options, bool show_levels);

/// Writes one level, which exists, as OFF.
Result<Output> export_level(const LoadedModel& body, int level, const std::filesystem::path& path);
/// Writes the levels of a file that `detail` asks for; what is left of it where it ends early, if `salvaging`.
Result<Output> cut(const std::string& path, const std::string& to, const Detail& detail, bool salvaging);

/// Writes all levels, or the mesh, as SVG.
Result<Output> draw_file(const LoadedModel& body, const std::filesystem::path& path);
Result<Output> draw_file(const LoadedMesh& body, const std::filesystem::path& path);

}  // namespace swiftlet::tool
