// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "words.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <swiftlet/check.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/model_file.h>

#include "answer_text.h"
#include "body/file.h"
#include "draw.h"
#include "mesh_setting.h"
#include "off_text.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

double volume_ratio(const Model& model, const Level& level) { return model.volume() > 0 ? level.volume / model.volume() : 1; }

double degrees(lut::Resolution resolution) {
  switch (resolution) {
    case lut::Resolution::Degrees22: return 22.5;
    case lut::Resolution::Degrees11: return 11.25;
    case lut::Resolution::Degrees5: return 5.625;
    case lut::Resolution::None: break;
  }
  return 0;
}

double per_triangle(std::size_t bytes, const Model& model) {
  return model.level(0).triangle_count > 0 ? double(bytes) / double(model.level(0).triangle_count) : 0;
}

/// What a line of the levels' table says.
struct Visit {
  LevelRecord record;
  double nanoseconds = 0;
};

/// A cold query, limited to the precision that one level pair gave.
class LimitedQuery {
 public:
  LimitedQuery(const Model& a, const Model& b, const Pose& b_in_a, const Options& asked, const LevelRecord& record)
      : a_(a), b_(b), b_in_a_(b_in_a), options_(asked) {
    options_.tuning = {.start = asked.tuning.start};
    options_.budget.finest_level = std::min(record.level_a, record.level_b);
    options_.absolute = std::max(asked.absolute, record.upper - record.lower);
    constexpr double kLongEnough = 20'000;  // for the clock, in nanoseconds
    constexpr int kMostRepeats = 1 << 20;
    while (repeats_ * nanoseconds() < kLongEnough && repeats_ < kMostRepeats) repeats_ *= 2;
  }

  /// Of one query, averaged over a batch.
  double nanoseconds() const {
    using Clock = std::chrono::steady_clock;
    [[maybe_unused]] volatile double kept = 0;  // lest the query be left out
    const auto begin = Clock::now();
    for (int k = 0; k < repeats_; ++k) kept = distance(a_, b_, b_in_a_, options_).lower;
    return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / repeats_;
  }

 private:
  const Model& a_;
  const Model& b_;
  const Pose& b_in_a_;
  Options options_;
  int repeats_ = 1;
};

/// The median of many batches; the lines take turns, so that a machine that slows down slows all of them.
std::vector<Visit> timed(const Model& a, const Model& b, const Pose& b_in_a, const Options& asked,
                         const std::vector<LevelRecord>& trace) {
  constexpr std::size_t kBatches = 61;
  std::vector<LimitedQuery> queries;
  for (const LevelRecord& record : trace) queries.emplace_back(a, b, b_in_a, asked, record);
  std::vector<std::vector<double>> times(trace.size());
  for (std::size_t batch = 0; batch < kBatches; ++batch)
    for (std::size_t k = 0; k < queries.size(); ++k) times[k].push_back(queries[k].nanoseconds());
  std::vector<Visit> visits;
  for (std::size_t k = 0; k < trace.size(); ++k) {
    std::nth_element(times[k].begin(), times[k].begin() + kBatches / 2, times[k].end());
    visits.push_back({trace[k], times[k][kBatches / 2]});
  }
  return visits;
}

std::string text_of(const std::vector<Visit>& visits) {
  std::string text = "   levels                  lower                  upper  steps  plane tests       ns\n";
  for (const auto& [record, time] : visits) {
    text += format(" %8s %22s %22s %6u %12u %8.0f\n", format("(%d, %d)", record.level_a, record.level_b).c_str(),
                   number(record.lower).c_str(), number(record.upper).c_str(), record.steps, record.plane_tests, time);
  }
  return text;
}

Json json_of(const std::vector<Visit>& visits) {
  Json rows = Json::array();
  for (const auto& [record, time] : visits) {
    rows.push_back({{"level_a", record.level_a},
                    {"level_b", record.level_b},
                    {"lower", record.lower},
                    {"upper", record.upper},
                    {"steps", record.steps},
                    {"plane_tests", record.plane_tests},
                    {"nanoseconds", time}});
  }
  return rows;
}

/// User ids are known of answers without an error only: closest_features() gives them, and the same answer.
ClosestFeatures ask(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Asked& asked, const Tuning& tuning) {
  Options options = asked.query;
  options.tuning = tuning;
  const bool is_exact = options.absolute == 0 && options.relative == 0;
  if (is_exact && !asked.is_signed) return closest_features(a, b, b_in_a, {.beyond = options.beyond, .tuning = tuning});
  if (!asked.is_signed) return {distance(a, b, b_in_a, options), {}, {}};
  const Answer answer = signed_distance(a, b, b_in_a, options);
  if (!is_exact) return {answer, {}, {}};
  return {answer, source_feature(a, answer.feature_a, answer.level_a), source_feature(b, answer.feature_b, answer.level_b)};
}

/// Null of a mesh.
const Model* model_of(const LoadedBody& body) {
  const LoadedModel* const loaded = std::get_if<LoadedModel>(&body);
  return loaded ? &loaded->model : nullptr;
}

/// Of the level that answered, or of the mesh.
double deviation_of(const LoadedBody& body, int level) {
  const Model* const model = model_of(body);
  return model ? model->level(level).deviation : std::get<LoadedMesh>(body).mesh.deviation();
}

/// The user's vertices that prove an overlap, of one body.
std::vector<std::uint32_t> proof_of(const Model& model, const OverlapProof& proof,
                                    const std::array<std::uint32_t, 4>& vertices) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t k = 0; k < proof.count; ++k) ids.push_back(model.source().vertex[vertices[k]]);
  return ids;
}

std::string joined(const std::vector<std::uint32_t>& ids) {
  std::string text;
  for (std::uint32_t id : ids) text.append(" ").append(std::to_string(id));
  return text;
}

const char* name(ErrorCode code) {
  switch (code) {
    case ErrorCode::CannotRead: return "CannotRead";
    case ErrorCode::CannotWrite: return "CannotWrite";
    case ErrorCode::BadFormat: return "BadFormat";
    case ErrorCode::BadVersion: return "BadVersion";
    case ErrorCode::BadValue: return "BadValue";
    case ErrorCode::Empty: return "Empty";
    case ErrorCode::NotConvex: return "NotConvex";
    case ErrorCode::NotSolid: return "NotSolid";
    case ErrorCode::NotEnclosing: return "NotEnclosing";
    case ErrorCode::TooLarge: return "TooLarge";
    case ErrorCode::Cancelled: break;
  }
  return "Cancelled";
}

}  // namespace

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

const std::string& path_of_body(const LoadedBody& body) {
  return std::visit([](const auto& loaded) -> const std::string& { return loaded.path; }, body);
}

std::string error_json(const Error& error) {
  const Json file = error.file.empty() ? Json() : Json(error.file);
  return dump({{"error", {{"code", name(error.code)}, {"message", error.message}, {"file", file}}}});
}

Json levels_json(const Model& model) {
  Json levels = Json::array();
  for (int k = 0; k < model.level_count(); ++k) {
    const Level& level = model.level(k);
    levels.push_back({{"vertices", level.view.vertices.size()},
                      {"faces", level.view.face_first.size()},
                      {"triangles", level.triangle_count},
                      {"deviation", level.deviation},
                      {"volume_ratio", volume_ratio(model, level)},
                      {"bytes", level.bytes},
                      {"prefix", level.prefix}});
  }
  return levels;
}

std::string levels_text(const Model& model) {
  std::string text = " level  vertices     faces  triangles     deviation  volume ratio      bytes     prefix\n";
  for (int k = 0; k < model.level_count(); ++k) {
    const Level& level = model.level(k);
    text += format("%6d %9zu %9zu %10zu %13.6g %13.6g %10zu", k, level.view.vertices.size(), level.view.face_first.size(),
                   level.triangle_count, level.deviation, volume_ratio(model, level), level.bytes);
    text += k < model.finest_level() ? "     absent\n" : format(" %10zu\n", level.prefix);
  }
  return text;
}

std::size_t map_entries(const Model& model) {
  std::size_t entries = 0;
  for (int k = 0; k < model.level_count(); ++k) entries += model.level(k).support_map.size();
  return entries;
}

/// Bytes by what they hold. Levels have their own table.
struct Account {
  explicit Account(const Model& model) {
    const SourceMap source = model.source();
    maps = 4 * map_entries(model);
    table = 4 * model.table().size();
    ids = 4 * (source.vertex.size() + source.face_begin.size() + source.face.size());
    headers = model.bytes().size() - maps - table - ids;
    for (int k = model.finest_level(); k < model.level_count(); ++k) headers -= model.level(k).bytes;
  }
  std::size_t headers, maps, table, ids;
};

Output info(const LoadedModel& body) {
  const Model& model = body.model;
  const std::size_t bytes = model.bytes().size();
  const Account account(model);
  const TableSpec table = model.table_spec();
  const std::string hash = hash_text(model.hash());
  const Json json{
      {"path", body.path},
      {"bytes", bytes},
      {"bytes_per_triangle", per_triangle(bytes, model)},
      {"level_0_bytes_per_triangle", per_triangle(model.level(0).bytes, model)},
      {"header_bytes", account.headers},
      {"map_bytes", account.maps},
      {"table_bytes", account.table},
      {"source_bytes", account.ids},
      {"hash", hash},
      {"dimension", model.dimension()},
      {"centre", json_of(model.centre())},
      {"radius", model.radius()},
      {"box_min", json_of(model.box_min())},
      {"box_max", json_of(model.box_max())},
      {"volume", model.volume()},
      {"table",
       {{"degrees", degrees(table.resolution)}, {"entries", model.table().size()}, {"radius_factor", table.radius_factor}}},
      {"map", {{"cells", table.map_cells}, {"entries", map_entries(model)}}},
      {"levels", levels_json(model)}};
  std::string text = body.path + "\n";
  text += format(" bytes      %zu", bytes);
  if (model.level(0).triangle_count > 0)
    text += format(", %.1f per triangle of level 0; level 0 alone %.1f", per_triangle(bytes, model),
                   per_triangle(model.level(0).bytes, model));
  text += "\n";
  text += format(" made of    the levels below, support maps %zu, the start table %zu, the mesh's ids %zu, headers %zu\n",
                 account.maps, account.table, account.ids, account.headers);
  text += " hash       " + hash + "\n";
  text += format(" dimension  %d\n", model.dimension());
  text += " centre     " + numbers(model.centre()) + "\n radius     " + number(model.radius()) + "\n";
  text += " box        " + numbers(model.box_min()) + "  to  " + numbers(model.box_max()) + "\n";
  text += " volume     " + number(model.volume()) + "\n";
  text += model.table().empty() ? " table      none\n"
                                : format(" table      %zu entries, every %g degrees, on a sphere of %g radii\n",
                                         model.table().size(), degrees(table.resolution), table.radius_factor);
  text += map_entries(model) == 0 ? " maps       none\n"
                                  : format(" maps       %zu entries from level %d on, %u per vertex\n", map_entries(model),
                                           model.map_level(), table.map_cells);
  return {text + levels_text(model), dump(json)};
}

Result<Output> verify(const LoadedModel& body) {
  const Check outcome = swiftlet::verify(body.model);
  if (!outcome) return in_file(body.path, {ErrorCode::BadValue, outcome.message});
  const int levels = body.model.level_count();
  return Output{body.path + ": verified: " + counted(std::size_t(levels), "level") +
                    " convex, enclosing level 0, within the stated deviation\n",
                dump({{"path", body.path}, {"verified", true}, {"levels", levels}})};
}

Result<Output> distance(const LoadedBody& a, const LoadedBody& b, const Pose& b_in_a, const Asked& asked) {
  const Result<MeshBody> shape_a = shape_of(a, asked.solid), shape_b = shape_of(b, asked.solid);
  if (!shape_a) return shape_a.error();
  if (!shape_b) return shape_b.error();
  const Model *const model_a = model_of(a), *const model_b = model_of(b);
  std::vector<LevelRecord> trace;
  OverlapProof proof;
  Options options = asked.query;
  options.tuning.proof = &proof;
  if (asked.levels) {
    trace.resize(std::size_t(model_a->level_count() + model_b->level_count()));
    options.tuning.trace = trace, options.tuning.start = StartPolicy::Coarsest;
  }
  const ClosestFeatures found = ask(shape_a.value(), shape_b.value(), b_in_a, asked, options.tuning);
  const Answer& answer = found.answer;
  std::vector<Visit> visits;
  if (asked.levels) {
    trace.resize(std::min(trace.size(), std::size_t(answer.levels_visited)));
    visits = timed(*model_a, *model_b, b_in_a, options, trace);
  }
  const Witness on_a{answer.feature_a, answer.level_a, found.source_a, !model_a},
      on_b{answer.feature_b, answer.level_b, found.source_b, !model_b};

  Json json{{"a", path_of_body(a)}, {"b", path_of_body(b)}, {"b_in_a", json_of(b_in_a)}};
  if (asked.levels) json["levels"] = json_of(visits);
  json.update({{"lower", answer.lower},
               {"upper", answer.upper},
               {"signed", answer.is_signed},
               {"point_a", json_of(answer.point_a)},
               {"point_b", json_of(answer.point_b)},
               {"normal", json_of(answer.normal)},
               {"level_a", answer.level_a},
               {"level_b", answer.level_b},
               {"deviation_a", deviation_of(a, answer.level_a)},
               {"deviation_b", deviation_of(b, answer.level_b)},
               {"feature_a", json_of(on_a)},
               {"feature_b", json_of(on_b)},
               {"verdict", name(answer.verdict)},
               {"status", name(answer.status)},
               {"steps", answer.steps},
               {"plane_tests", answer.plane_tests}});

  std::string text = asked.levels ? text_of(visits) : "";
  text += "distance   [" + number(answer.lower) + ", " + number(answer.upper) + "]" + (answer.is_signed ? ", signed" : "");
  text += model_a || model_b ? format(" at levels (%d, %d)\n", answer.level_a, answer.level_b) : "\n";
  text += "point_a    " + numbers(answer.point_a) + "\npoint_b    " + numbers(answer.point_b) + "   in A's frame\n";
  text += "normal     " + numbers(answer.normal) + "   from A to B\n";
  text += "feature_a  " + text_of(on_a) + "\nfeature_b  " + text_of(on_b) + "\n";
  if (answer.verdict == Verdict::Overlapping && model_a && model_b && proof.count > 0) {
    const auto proof_a = proof_of(*model_a, proof, proof.vertex_a), proof_b = proof_of(*model_b, proof, proof.vertex_b);
    json["proof"] = {{"vertices_a", proof_a}, {"vertices_b", proof_b}};
    text += "proof      vertices" + joined(proof_a) + " of A minus" + joined(proof_b) + " of B hold the origin\n";
  }
  if (answer.status == Status::LevelLimit)
    text += "deviation  " + number(deviation_of(a, answer.level_a)) + " of A, " + number(deviation_of(b, answer.level_b)) +
            " of B: how far they may be from the whole bodies\n";
  text += std::string("verdict    ") + name(answer.verdict) + "\nstatus     " + in_words(answer.status) + ", " +
          counted(answer.steps, "step") + ", " + counted(answer.plane_tests, "plane test") + "\n";
  return Output{text, dump(json)};
}

Result<Output> export_level(const LoadedModel& body, int level, const std::filesystem::path& path) {
  const Result<std::size_t> bytes = write_file(path, off_text(body.model.level(level).view));
  if (!bytes) return bytes.error();
  return Output{utf8(path) + format(": level %d, %zu bytes\n", level, bytes.value()),
                dump({{"path", utf8(path)}, {"level", level}, {"bytes", bytes.value()}})};
}

Result<Output> cut(const std::string& path, const std::string& to, const Detail& detail, bool salvaging) {
  std::string note;
  Result<Model> model = [&]() -> Result<Model> {
    if (!salvaging) return load(path_of(path), detail);
    Result<Salvaged> left = salvage(path_of(path));
    if (!left) return left.error();
    note = left.value().note;
    return left.value().model.cut(detail);
  }();
  if (!model) return model.error();
  const Result<std::size_t> bytes = write_file(path_of(to), model.value().bytes());
  if (!bytes) return bytes.error();
  const int finest = model.value().finest_level(), coarsest = model.value().level_count() - 1;
  return Output{
      to + format(": levels %d to %d, %zu bytes\n", finest, coarsest, bytes.value()),
      dump({{"path", to}, {"finest_level", finest}, {"levels", coarsest + 1}, {"bytes", bytes.value()}, {"note", note}}), note};
}

Result<Output> draw_file(const LoadedModel& body, const std::filesystem::path& path) {
  const Result<std::size_t> bytes = write_file(path, draw(body.model, stem(body.path)));
  if (!bytes) return bytes.error();
  const int levels = body.model.level_count() - body.model.finest_level();  // that are there
  return Output{utf8(path) + ": " + counted(std::size_t(levels), "level") + format(", %zu bytes\n", bytes.value()),
                dump({{"path", utf8(path)}, {"levels", levels}, {"bytes", bytes.value()}})};
}

}  // namespace swiftlet::tool
