// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The command line: words, options, and where output and errors go. Knows nothing of what the words do.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include <swiftlet/model.h>
#include <swiftlet/result.h>

#include "words.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace swiftlet::tool {

using Action = std::function<Result<Output>()>;

/// A word of the tool. `declare` adds its options to the command line and returns what to do once they are read; what the
/// options are read into lives as long as the action does.
struct Word {
  const char* name;
  const char* summary;
  std::function<Action(CLI::App&)> declare;
};

/// How a mesh becomes a model; empty in a tool without the builder.
using ModelOfMesh = std::function<Result<Model>(const std::filesystem::path&)>;

/// Refuses what is no number in [least, most]: "... is no number SAID".
CLI::Validator number_in(double least, double most, const std::string& said);
/// Refuses what is no number from 0 up.
CLI::Validator not_negative();

/// Whether a file is a model, or is called one.
bool is_model(const std::filesystem::path& path);
/// Whether a file is a mesh of `build --mesh`, or is called one.
bool is_mesh(const std::filesystem::path& path);

/// Refuses, as a fault of the command line, to write a file of the format `extension` under the name of another: .swl, .swm,
/// .svg or a mesh file's. Other names may be as they are, since what a file is its first bytes tell.
void expect_name(const std::string& path, const char* extension);

/// Whether --json is said, once the command line is read.
bool asks_for_json(const CLI::App& word);

/// The options --deviation and --bytes.
void add_detail(CLI::App& word, Detail& detail);

/// Does what the command line says and returns the exit code: 0, 1 where a word failed, 2 where the command line is wrong, an
/// option out of its range included. Then stderr holds one line, "swiftlet: ...", and stdout nothing; with --json stdout holds
/// `error_json`, and stderr nothing, no progress bar either. What is to be noted of a success is one line on stderr too, unless
/// with --json.
int run_tool(int argc, char** argv, const ModelOfMesh& model_of_mesh = {}, std::span<const Word> more_words = {});

}  // namespace swiftlet::tool
