// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tool.h"

#include <CLI/CLI.hpp>

#ifdef _WIN32
#include <windows.h>

#include <shellapi.h>
#endif

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <swiftlet/mesh.h>
#include <swiftlet/model_file.h>

#include "body/block.h"
#include "body/file.h"
#include "pose_text.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// Whether the builder reads such files as meshes.
bool is_mesh_format(const std::string& extension) {
  constexpr const char* kFormats[] = {".obj", ".off", ".stl", ".ply", ".tri", ".poly"};
  return std::any_of(std::begin(kFormats), std::end(kFormats), [&](const char* format) { return extension == format; });
}

}  // namespace

bool is_model(const std::filesystem::path& path) {
  if (path.extension() == ".swl") return true;
  if (!irregularity(path).empty()) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<std::byte, 8> start{};
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  return file && is_model_block(start);
}

bool is_mesh(const std::filesystem::path& path) { return path.extension() == ".swm" || is_mesh_file(path); }

void expect_name(const std::string& path, const char* extension) {
  const std::string found = lower(utf8(path_of(path).extension()));
  const bool is_others = is_mesh_format(found) || found == ".swl" || found == ".swm" || found == ".svg";
  if (is_others && found != extension)
    throw CLI::ValidationError(path + ": what is written is a " + extension + " file, and no " + found + " file");
}

namespace {

constexpr const char* kBodyHelp = "a .swl model, a .swm mesh, or any mesh file for its hull where the tool has the builder";

Result<LoadedBody> open(const std::string& path, const ModelOfMesh& model_of_mesh) {
  if (is_mesh(path_of(path))) {
    Result<MeshModel> mesh = load_mesh(path_of(path));
    if (!mesh) return mesh.error();
    return LoadedBody(LoadedMesh{path, std::move(mesh).value()});
  }
  const bool is_ours = is_model(path_of(path));
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(path_of(path), ignored);
  if (!is_ours && !model_of_mesh && is_file)
    return in_file(path,
                   {ErrorCode::BadFormat,
                    "is no .swl model and no .swm mesh, and this tool was made without the builder that reads mesh files"});
  Result<Model> model = is_ours || !model_of_mesh ? load(path_of(path)) : model_of_mesh(path_of(path));
  if (!model) return model.error();
  return LoadedBody(LoadedModel{path, std::move(model).value()});
}

/// Refuses `option`, which is about a model's levels.
[[noreturn]] void no_levels(const char* option, const std::string& path) {
  throw CLI::ValidationError(option, path + ": is a mesh, which has no levels of this kind");
}

/// A word whose one input is a body.
template <class Do>
Action on_body(CLI::App& word, const ModelOfMesh& model_of_mesh, Do act) {
  const auto path = std::make_shared<std::string>();
  word.add_option("X", *path, kBodyHelp)->required();
  return [path, model_of_mesh, act]() -> Result<Output> {
    const Result<LoadedBody> body = open(*path, model_of_mesh);
    if (!body) return body.error();
    return std::visit([&act](const auto& loaded) -> Result<Output> { return act(loaded); }, body.value());
  };
}

/// The same that writes a file called so: act(body, path).
template <class Do>
Action on_body_to_file(CLI::App& word, const ModelOfMesh& model_of_mesh, const char* extension, const char* help, Do act) {
  const auto in = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  word.add_option("X", *in, kBodyHelp)->required();
  word.add_option("-o,--output", *out, help)->required();
  return [in, out, extension, model_of_mesh, act]() -> Result<Output> {
    if (const auto may = may_write(path_of(*out), path_of(*in)); !may) return may.error();
    expect_name(*out, extension);
    const Result<LoadedBody> body = open(*in, model_of_mesh);
    if (!body) return body.error();
    return std::visit([&](const auto& loaded) -> Result<Output> { return act(loaded, path_of(*out)); }, body.value());
  };
}

Action declare_info(CLI::App& word, const ModelOfMesh& model_of_mesh) {
  return on_body(word, model_of_mesh, [](const auto& body) { return info(body); });
}

Action declare_verify(CLI::App& word, const ModelOfMesh& model_of_mesh) {
  return on_body(word, model_of_mesh, [](const auto& body) { return verify(body); });
}

Action declare_export(CLI::App& word, const ModelOfMesh& model_of_mesh) {
  const auto level = std::make_shared<int>(0);
  const CLI::Option* const option =
      word.add_option("--level", *level, "0 is the exact hull, larger is coarser; of models only")->capture_default_str();
  const auto write_level = [level](const LoadedModel& body, const std::filesystem::path& out) {
    const int finest = body.model.finest_level(), coarsest = body.model.level_count() - 1;
    if (*level < finest || *level > coarsest)
      throw CLI::ValidationError(
          "--level", body.path + format(": there is no level %d, the finest is %d, the coarsest %d", *level, finest, coarsest));
    return export_level(body, *level, out);
  };
  const auto write = [write_level, option](const auto& body, const std::filesystem::path& out) -> Result<Output> {
    if constexpr (std::is_same_v<decltype(body), const LoadedModel&>) {
      return write_level(body, out);
    } else {
      if (option->count() > 0) no_levels("--level", body.path);
      return export_mesh(body, out);
    }
  };
  return on_body_to_file(word, model_of_mesh, ".off", "the OFF file to write; its doubles read back bit for bit", write);
}

Action declare_draw(CLI::App& word, const ModelOfMesh& model_of_mesh) {
  return on_body_to_file(word, model_of_mesh, ".svg", "the SVG file to write",
                         [](const auto& body, const std::filesystem::path& out) { return draw_file(body, out); });
}

Action declare_distance(CLI::App& word, const ModelOfMesh& model_of_mesh) {
  struct Request {
    std::string a, b;
    Result<Pose> b_in_a = Pose{};
    Asked asked;
  };
  const auto request = std::make_shared<Request>();
  word.footer(
      "The pose is that of B in A's frame: it maps B's frame into A's, so that a point p of B lies at R p + t. POSE is t "
      "alone\n"
      "as x,y,z, or x,y,z,qw,qx,qy,qz with a quaternion (which is normalised), or a file with the row-major 3x4 matrix [R t]\n"
      "(which is taken as it stands and must be orthonormal to 1e-6). All points and directions of the answer are in A's "
      "frame;\n"
      "the normal points from A to B. Ids of vertices and triangles are the mesh file's, counted from 0, and are given with\n"
      "exact answers, which are those without --max-error and --relative-error. Of a .swm mesh the surface is the\n"
      "body: of two closed meshes, one inside the other, the distance is that of their surfaces, unless --solid is said.\n"
      "A signed distance below 0 is minus the depth of an overlap: the length of the least translation that separates. Of\n"
      "meshes it is an interval that is seldom narrow. Of a mesh that was cut the distance is an interval, too: as wide as\n"
      "the deviations of both meshes together.\n"
      "JSON has no infinite numbers: a lower bound that is null is minus infinity, an upper one infinity. A point or a\n"
      "direction that is null is not known.\n"
      "With --contacts the answer is a list, nearest first, of all regions where the surfaces are within REACH of each\n"
      "other, each with its nearest pair of triangles.");
  word.add_option("A", request->a, kBodyHelp)->required();
  word.add_option("B", request->b, kBodyHelp)->required();
  const auto take_pose = [request](const std::string& text) {
    request->b_in_a = read_pose(text);
    if (!request->b_in_a && request->b_in_a.error().file.empty())  // a file's fault is not the command line's
      throw CLI::ValidationError("--pose", request->b_in_a.error().message);
  };
  word.add_option_function<std::string>("--pose", take_pose, "of B in A's frame, see below")->required();
  const auto absolute =
      word.add_option("--max-error", request->asked.query.absolute, "stop when upper - lower is at most this");
  const auto relative = word.add_option("--relative-error", request->asked.query.relative,
                                        "stop when upper - lower is at most this times the bound nearer to 0");
  absolute->check(not_negative())->excludes(relative);
  relative->check(not_negative());
  const auto beyond =
      word.add_option("--beyond", request->asked.query.beyond, "stop when the distance is proved greater than this");
  beyond->check(not_negative());
  const auto levels = word.add_flag(
      "--levels", request->asked.levels,
      "show what each level pair proved, coarsest first, and how long a query takes that stops there; of models only");
  word.add_flag("--solid", request->asked.solid, "a mesh, which must be closed, is the volume that it bounds, as a model is");
  const auto is_signed = word.add_flag("--signed", request->asked.is_signed, "of an overlap tell the depth")->excludes(levels);
  const auto reach =
      word.add_option("--contacts", request->asked.reach, "list every region where the bodies are within this of each other")
          ->type_name("REACH")
          ->check(number_in(0, std::numeric_limits<double>::max(), "from 0 up"));
  for (CLI::Option* const other : {absolute, relative, beyond, levels, is_signed}) reach->excludes(other);
  word.add_flag("--manifold", request->asked.manifolds, "of each region the few points that stand for it")->needs(reach);
  return [request, model_of_mesh]() -> Result<Output> {
    if (!request->b_in_a) return request->b_in_a.error();
    const Result<LoadedBody> a = open(request->a, model_of_mesh);
    if (!a) return a.error();
    const Result<LoadedBody> b = open(request->b, model_of_mesh);
    if (!b) return b.error();
    for (const LoadedBody& body : {std::cref(a.value()), std::cref(b.value())}) {
      if (request->asked.levels && std::holds_alternative<LoadedMesh>(body)) no_levels("--levels", path_of_body(body));
    }
    const auto answer = request->asked.reach ? contacts : distance;
    return answer(a.value(), b.value(), request->b_in_a.value(), request->asked);
  };
}

Action declare_cut(CLI::App& word, const ModelOfMesh&) {
  struct Request {
    std::string in, out;
    Detail detail;
    bool salvage = false;
  };
  const auto request = std::make_shared<Request>();
  word.footer(
      "The levels of a mesh are those of its tree, the root first, and cutting leaves boxes around the surface instead of\n"
      "triangles: none deviates by more than info says. A file that was cut is asked as a whole one is; its answers are\n"
      "intervals that are true of the whole one.");
  word.add_option("X", request->in, "a .swl model or a .swm mesh")->required();
  word.add_option("-o,--output", request->out, "the .swl model or .swm mesh to write")->required();
  add_detail(word, request->detail);
  word.add_flag("--salvage", request->salvage, "take what is complete of a file that ends early, and say what is missing");
  return [request]() -> Result<Output> {
    const std::filesystem::path in = path_of(request->in);
    const bool of_mesh = is_mesh(in);
    if (!of_mesh && !is_model(in) && is_mesh_format(lower(utf8(in.extension()))))
      return in_file(request->in, {ErrorCode::BadFormat, "is a mesh file; cut takes what build makes of it, .swl or .swm"});
    if (const auto may = may_write(path_of(request->out), path_of(request->in)); !may) return may.error();
    expect_name(request->out, of_mesh ? ".swm" : ".swl");
    const auto write = of_mesh ? cut_mesh : cut;
    return write(request->in, request->out, request->detail, request->salvage);
  };
}

std::vector<Word> all_words(const ModelOfMesh& model_of_mesh, std::span<const Word> more) {
  const auto bind = [&](Action (*declare)(CLI::App&, const ModelOfMesh&)) {
    return [declare, model_of_mesh](CLI::App& word) { return declare(word, model_of_mesh); };
  };
  std::vector<Word> words(more.begin(), more.end());
  words.push_back({"info", "what a model holds, level by level, or a mesh", bind(declare_info)});
  words.push_back(
      {"verify",
       "proves that all levels are convex, enclose level 0, and deviate no more than they say; or that the boxes of a "
       "mesh, and its hulls, hold its triangles",
       bind(declare_verify)});
  words.push_back({"distance", "how near two bodies are, with proved bounds, and where", bind(declare_distance)});
  words.push_back({"export", "writes one level, or a mesh, as an OFF mesh", bind(declare_export)});
  words.push_back({"cut", "writes a model or a mesh without its finest levels", bind(declare_cut)});
  words.push_back({"draw", "draws the levels side by side as an SVG, or a mesh", bind(declare_draw)});
  return words;
}

/// The words of the command line in UTF-8, which Windows' own `argv` is not.
class Utf8Arguments {
 public:
  Utf8Arguments(int argc, char** argv) : words_(argv, argv + argc) {
#ifdef _WIN32
    wchar_t** const wide = CommandLineToArgvW(GetCommandLineW(), &argc);
    for (int i = 0; i < argc; ++i) words_[std::size_t(i)] = utf8(wide[i]);
    LocalFree(wide);
#endif
    for (std::string& word : words_) pointers_.push_back(word.data());
    pointers_.push_back(nullptr);
  }
  char** begin() { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;
};

/// Tells which options go together where an option is described, so that its name stays in its column.
class Help : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string opts = CLI::Formatter::make_option_opts(option);
    return opts.substr(0, std::min(opts.find(" Needs:"), opts.find(" Excludes:")));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return CLI::Formatter::make_option_desc(option) + listed("; needs", option->get_needs()) +
           listed("; not with", option->get_excludes());
  }

 private:
  static std::string listed(const char* what, const std::set<CLI::Option*>& options) {
    std::string text = options.empty() ? "" : what;
    for (const CLI::Option* option : options) text.append(" ").append(option->get_name());
    return text;
  }
};

/// Whether a command line asks for JSON, as far as that shows before CLI11 has read it: by the last --json or --json=VALUE
/// before a "--".
bool asks_for_json(int argc, char** argv) {
  bool asked = false;
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string word = argv[i], said = "--json=";
    if (word == "--json") asked = true;
    if (word.starts_with(said)) CLI::detail::lexical_cast(word.substr(said.size()), asked);
  }
  return asked;
}

/// Tells why there is no output, in one line on stderr or as JSON on stdout, whatever the message holds.
class Failure {
 public:
  explicit Failure(bool as_json) : as_json_(as_json) {}
  void set_json(bool as_json) { as_json_ = as_json; }
  int operator()(Error error, int code) const {
    while (!error.message.empty() && error.message.back() == '\n') error.message.pop_back();
    for (char& c : error.message)
      if (c == '\n' || c == '\r') c = ' ';
    if (as_json_ && write(error_json(error))) return code;
    std::fprintf(stderr, "swiftlet: %s\n", error.message.c_str());
    return code;
  }
  /// Whether all of it went to standard output.
  static bool write(const std::string& text) {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  }

 private:
  bool as_json_;
};

std::string names(const std::vector<Word>& words) {
  std::string all;
  for (const Word& word : words) all += std::string(all.empty() ? "" : ", ") + word.name;
  return all;
}

/// What CLI11 would call an unexpected argument or a missing subcommand, or would take though it is empty: no name and no
/// number is. Nothing where there is no such fault.
std::string word_fault(int argc, char** argv, const std::vector<Word>& words, bool has_builder) {
  if (argc < 2) return "say a word: " + names(words) + "; swiftlet --help tells more";
  const std::string first = argv[1];
  if (first == "-h" || first == "--help" || first == "--version") return {};
  for (int i = 2; i < argc; ++i)
    if (!*argv[i]) return "the name after \"" + std::string(argv[i - 1]) + "\" is empty";
  for (const Word& word : words)
    if (first == word.name) return {};
  if (!has_builder && (first == "build" || first == "decompose"))
    return "this tool was made without the builder (SWIFTLET_LOD=OFF) and has no word " + first;
  if (first.starts_with('-')) return "\"" + first + "\" is no word; options follow the word, which is one of " + names(words);
  return "there is no word \"" + first + "\"; there are " + names(words);
}

int run(int argc, char** argv, const ModelOfMesh& model_of_mesh, std::span<const Word> more_words, Failure& fail) {
  const std::vector<Word> words = all_words(model_of_mesh, more_words);
  if (const std::string fault = word_fault(argc, argv, words, bool(model_of_mesh)); !fault.empty())
    return fail({ErrorCode::BadValue, fault}, 2);

  CLI::App app("Convex bodies at several levels of detail: how near are they, as precisely as asked?", "swiftlet");
  app.set_version_flag("--version", "swiftlet " SWIFTLET_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<Help>());
  bool as_json = false;
  Action chosen;
  for (const Word& word : words) {
    CLI::App* const sub = app.add_subcommand(word.name, word.summary);
    sub->add_flag("--json", as_json, "print JSON");
    sub->final_callback([action = word.declare(*sub), &chosen] { chosen = action; });
  }
  app.footer(
      "swiftlet WORD --help tells a word's options. The exit code is 0 where the word did what was asked, 1 where it failed,\n"
      "2 where the command line is wrong.");
  const auto write = [&fail](const std::string& text) {
    return Failure::write(text) ? 0 : fail({ErrorCode::CannotWrite, "cannot write to standard output"}, 1);
  };
  try {
    app.parse(argc, argv);
    fail.set_json(as_json);
    const Result<Output> output = chosen();
    if (!output) return fail(output.error(), 1);
    if (!as_json && !output.value().note.empty()) std::fprintf(stderr, "swiftlet: %s\n", output.value().note.c_str());
    return write(as_json ? output.value().json : output.value().text);
  } catch (const CLI::Success& help_or_version) {
    std::ostringstream text;
    app.exit(help_or_version, text);
    return write(text.str());
  } catch (const CLI::ParseError& fault) {
    return fail({ErrorCode::BadValue, fault.what()}, 2);
  }
}

}  // namespace

CLI::Validator number_in(double least, double most, const std::string& said) {
  const auto fault = [least, most, said](std::string& text) {
    double value = 0;
    const bool number = CLI::detail::lexical_cast(text, value);
    return number && value >= least && value <= most ? std::string() : text + " is no number " + said;
  };
  return {fault, ""};
}

CLI::Validator not_negative() { return number_in(0, std::numeric_limits<double>::infinity(), "from 0 up"); }

bool asks_for_json(const CLI::App& word) { return word.get_option("--json")->as<bool>(); }

void add_detail(CLI::App& word, Detail& detail) {
  word.add_option("--deviation", detail.deviation, "keep no level finer than the coarsest that deviates less; 0: all")
      ->capture_default_str()
      ->check(not_negative());
  word.add_option("--bytes", detail.bytes,
                  "keep no level that these first bytes of the whole model do not hold, but the coarsest")
      ->check(not_negative());
}

int run_tool(int argc, char** argv, const ModelOfMesh& model_of_mesh, std::span<const Word> more_words) {
  Utf8Arguments arguments(argc, argv);
  argv = arguments.begin();
  Failure fail(asks_for_json(argc, argv));
  try {
    return run(argc, argv, model_of_mesh, more_words, fail);
  } catch (const std::bad_alloc&) {
    return fail({ErrorCode::TooLarge, "out of memory"}, 1);
  } catch (const std::exception& exception) {
    return fail({ErrorCode::BadValue, exception.what()}, 1);
  }
}

}  // namespace swiftlet::tool
