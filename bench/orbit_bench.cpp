// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Which methods meet on which scenes, and in which file of results. The paper's figures 5 to 12 [Ehmann & Lin 2000, sec. 6],
// and what came after: error, size, other motions, other pairs. Knows scenes and the rig; no clock and no truth of its own.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "goals.h"
#include "manifold_cell.h"
#include "rig.h"

namespace swiftlet::bench {
namespace {

using shapes::Family;
using shapes::kFamilies;

struct Arguments {
  enum class Size { Quick, Full, All } size = Size::Full;
  std::filesystem::path cache = "build/bench-cache", meshes = "models/cache", results = "bench/results";
  std::set<std::string> only;  ///< groups; empty: all
  bool wrong = false;          ///< with the test double
  std::uint32_t largest = 0;   ///< triangles, in the group of that name; 0: by the size of the run

  bool quick() const { return size == Size::Quick; }
  bool all() const { return size == Size::All; }
  int rounds() const { return all() ? 5 : 3; }
  /// Queries a round: 7 000, of 14 orbits; all 20 000, of 40; quick 1 000, of 4.
  Extent extent() const { return quick() ? Extent{4, 250} : all() ? Extent{40, 500} : Extent{14, 500}; }
  std::vector<double> steps() const {
    if (quick()) return {1.04, 10.4, 45.4};
    return {kSteps.begin(), kSteps.end()};
  }
  /// Of `steps` and kRandomStep, those at which peers run and the figures are measured.
  bool peers_at(double step) const {
    return quick() || all() || step == 1.04 || step == 10.4 || step == 45.4 || step == kRandomStep;
  }
  bool figures_at(double step) const { return all() || (step != 0.52 && step != 2.2 && step != 178.3); }
  bool wants(const std::string& group) const { return only.empty() || only.contains(group); }
  template <class... Groups>
  bool wants_any(const Groups&... groups) const {
    return (wants(groups) || ...);
  }
};

// ---- Who -------------------------------------------------------------------------------------------------------------------

/// Ours, off by a millionth of a unit: the table must say so.
class WrongMethod final : public Method {
  class WrongSession final : public SessionOf<WrongSession> {
   public:
    explicit WrongSession(std::unique_ptr<Session> right) : right_(std::move(right)) {}
    Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
      Outcome outcome = right_->distance(pair, b_in_a);
      outcome.distance += 1e-6;
      return outcome;
    }
    Outcome intersects(std::uint32_t, const Pose&) override { return {}; }
    void forget() override { right_->forget(); }

   private:
    std::unique_ptr<Session> right_;
  };

 public:
  std::string name() const override { return "test double"; }
  std::string settings() const override { return "swiftlet's distance plus 1e-6; never an intersection"; }
  Capabilities capabilities() const override { return {.distance = true, .intersects = true, .stated_error = 1e-12}; }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<WrongSession>(swiftlet_method("right", "", {})->open(bodies, pairs));
  }
};

/// All methods by name, those of the figures among them.
class Field {
 public:
  explicit Field(const Arguments& arguments) : everyone_(all_methods()) {
    if (arguments.wrong) everyone_.push_back(std::make_unique<WrongMethod>());
    const auto figure = [&](const char* name, StartPolicy start, Refinement refinement, PlaneRule rule = {}) {
      const Tuning tuning{.start = start, .refinement = refinement, .plane_rule = rule};
      figures_.push_back(swiftlet_method(name, "of the paper's figures", Options{.tuning = tuning}));
    };
    figure("finest first", StartPolicy::Finest, Refinement::SingleSingle, PlaneRule::FirstViolated);
    for (const auto& [start, policy] : kStarts) {
      for (const auto& [refinement, kind] : kRefinements) figure((start + refinement).c_str(), policy, kind);
    }
    figures_.push_back(plain_method("plain first", "our walk alone, first violated plane", PlaneRule::FirstViolated));
  }
  const Methods& everyone() const { return everyone_; }
  const Method& named(const std::string& name) const {
    for (const Methods* methods : {&everyone_, &figures_}) {
      for (const auto& m : *methods) {
        if (m->name() == name) return *m;
      }
    }
    std::fprintf(stderr, "no method %s\n", name.c_str());
    std::exit(1);
  }

  inline static const std::vector<std::pair<std::string, StartPolicy>> kStarts{{"paper ", StartPolicy::Paper},
                                                                               {"ours ", StartPolicy::Automatic}};
  inline static const std::vector<std::pair<std::string, Refinement>> kRefinements{
      {"Single", Refinement::Single}, {"Single-Single", Refinement::SingleSingle}, {"Double-Double", Refinement::DoubleDouble}};

 private:
  Methods everyone_, figures_;
};

bool of_this_house(const Method& method) {
  const std::string name = method.name();
  return name.starts_with("swiftlet") || name == "vclip" || name.starts_with("plain") || name == "test double";
}

bool can(const Method& method, Question question) {
  return question == Question::Distance ? method.capabilities().distance : method.capabilities().intersects;
}

/// Everyone who can, on the scene's own bodies; without peers if so asked, and without the variants of ours that the figures
/// compare.
enum class Variants { All, Main };
std::vector<Entrant> everyone(const Field& field, const Asked& asked, Question question, bool peers,
                              Variants variants = Variants::All) {
  std::uint32_t largest = 0;
  for (const SceneBody& body : asked.bodies) {
    largest = std::max(largest, std::uint32_t(body.model->level(0).triangle_count));
  }
  std::vector<Entrant> result;
  for (const auto& m : field.everyone()) {
    if (!can(*m, question) || !(peers || of_this_house(*m)) || largest > m->capabilities().max_triangles) continue;
    const std::string name = m->name();
    const bool main =
        name == "swiftlet" || name.ends_with(" table") || name.ends_with(" finest") || name.ends_with(" coarsest");
    if (variants == Variants::Main && name.starts_with("swiftlet") && !main) continue;
    result.push_back({m->name(), m.get(), asked.bodies});
  }
  return result;
}

// ---- Where the results go --------------------------------------------------------------------------------------------------

class Results {
 public:
  explicit Results(const Arguments& arguments) : directory_(arguments.results) {
    std::filesystem::create_directories(directory_);
  }

  void add(const std::string& group, const std::string& shape, double step, std::uint32_t triangles, std::vector<Row> rows) {
    for (Row& row : rows) {
      row.group = group;
      row.shape = shape;
      row.step = step;
      row.triangles = triangles;
      flagged_ += row.flagged;
      ours_flagged_ += row.flagged && row.series.starts_with("swiftlet");
    }
    std::fputs(table(rows).c_str(), stdout);
    std::fflush(stdout);
    std::vector<Row>& all = rows_[group];
    all.insert(all.end(), rows.begin(), rows.end());
    write(group);  // after every cell: an interrupted run leaves what it measured
  }
  const std::vector<Row>& rows(const std::string& group) { return rows_[group]; }
  std::size_t flagged() const { return flagged_; }
  std::size_t ours_flagged() const { return ours_flagged_; }

 private:
  void write(const std::string& group) const {
    std::FILE* file = std::fopen((directory_ / (group + ".csv")).c_str(), "w");
    if (!file) {
      std::fprintf(stderr, "cannot write %s\n", (directory_ / (group + ".csv")).c_str());
      std::exit(1);
    }
    std::fputs(csv_header().c_str(), file);
    for (const Row& row : rows_.at(group)) std::fputs(csv_line(row).c_str(), file);
    std::fclose(file);
  }
  std::filesystem::path directory_;
  std::map<std::string, std::vector<Row>> rows_;
  std::size_t flagged_ = 0, ours_flagged_ = 0;
};

// ---- The paper's models ----------------------------------------------------------------------------------------------------

/// Bodies 1 and 2 of a family, built otherwise than shipped.
struct Variant {
  std::string name;
  std::vector<Model> models;
  std::vector<SceneBody> bodies;
};

Variant variant(const Arguments& arguments, const std::string& name, Family family, std::uint32_t triangles,
                const std::function<void(BuildOptions&)>& change) {
  BuildOptions build;
  change(build);
  const Shelf shelf(arguments.cache, build);
  Variant result{name, {}, {}};
  for (const std::uint64_t body : {1, 2}) {
    Shelf::Entry entry = shelf.ellipsoid(family, triangles, body);
    result.models.push_back(std::move(entry.model));
    result.bodies.push_back({nullptr, {}, entry.build_seconds});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    result.bodies[i].model = &result.models[i];
    result.bodies[i].view = result.models[i].level(0).view;
  }
  return result;
}

constexpr std::uint32_t kPaperTriangles = 2'000;
constexpr std::uint32_t kCutoffs[] = {50, 100, 250, 500};
constexpr double kRates[] = {0.5, 0.25, 0.125, 0.0625, 0.03125};

/// What the figures compare, of one family.
struct PaperModels {
  std::deque<Variant> peeled, collapsed, tables;
  Variant nothing;
};

PaperModels paper_models(const Arguments& arguments, Family family) {
  const auto make = [&](const std::string& name, const auto& change) {
    return variant(arguments, name, family, kPaperTriangles, change);
  };
  const auto brief = [](double x) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", x);
    return std::string(buffer);
  };
  PaperModels models;
  for (const std::uint32_t cutoff : kCutoffs) {
    models.peeled.push_back(make("DK " + std::to_string(cutoff), [&](BuildOptions& b) {
      b.method = swiftlet::Method::Peel, b.enclosing = Enclosing::Scale, b.cutoff = cutoff;
    }));
  }
  for (const double rate : kRates) {
    models.collapsed.push_back(
        make("rate " + brief(rate), [&](BuildOptions& b) { b.enclosing = Enclosing::Scale, b.cutoff = 50, b.rate = rate; }));
  }
  const std::pair<const char*, lut::Resolution> resolutions[] = {
      {"22.5", lut::Resolution::Degrees22}, {"11.25", lut::Resolution::Degrees11}, {"5.625", lut::Resolution::Degrees5}};
  for (const double factor : {1., 2., 4.}) {
    for (const auto& [degrees, resolution] : resolutions) {
      models.tables.push_back(make(brief(factor) + " r " + degrees + " deg", [&, resolution = resolution](BuildOptions& b) {
        b.max_levels = 1, b.table = {resolution, factor};
      }));
    }
  }
  models.nothing = make("nothing", [](BuildOptions& b) { b.max_levels = 1, b.table.resolution = lut::Resolution::None; });
  return models;
}

// ---- The cells -------------------------------------------------------------------------------------------------------------

/// Everything that is asked of one pair on one motion at the paper's size.
void paper_cells(const Arguments& arguments, const Field& field, const PaperModels& models, const Asked& asked,
                 const std::string& shape, double step, Results& results) {
  const auto run = [&](const char* group, Question question, const std::vector<Entrant>& entrants) {
    results.add(group, shape, step, kPaperTriangles, measure(asked, question, entrants, arguments.rounds()));
  };
  const auto entrant = [&](const std::string& series, const std::string& method, const Variant& v) -> Entrant {
    return {series, &field.named(method), v.bodies};
  };
  const Entrant shipped{"swiftlet", &field.named("swiftlet"), asked.bodies}, clip{"vclip", &field.named("vclip"), asked.bodies};
  if (arguments.wants("fig5")) {
    run("fig5", Question::Distance,
        {clip,
         {"walk alone most violated", &field.named("plain"), asked.bodies},
         {"walk alone first violated", &field.named("plain first"), asked.bodies},
         entrant("certified most violated", "swiftlet finest", models.nothing),
         entrant("certified first violated", "finest first", models.nothing)});
  }
  if (arguments.wants("fig6")) {
    std::vector<Entrant> entrants;
    for (const Variant& v : models.tables) entrants.push_back(entrant(v.name, "swiftlet table", v));
    run("fig6", Question::Distance, entrants);
  }
  const auto hierarchy = [&](const char* group, Question question, const std::deque<Variant>& variants, bool every_refinement) {
    if (!arguments.wants(group)) return;
    std::vector<Entrant> entrants;
    for (const Variant& v : variants) {
      for (const auto& start : Field::kStarts) {
        for (const auto& refinement : Field::kRefinements) {
          if (!every_refinement && refinement.second != Refinement::SingleSingle) continue;
          const std::string method = start.first + refinement.first;
          entrants.push_back(entrant(v.name + " " + method, method, v));
        }
      }
    }
    entrants.push_back(shipped);
    entrants.push_back(clip);
    run(group, question, entrants);
  };
  hierarchy("fig7", Question::Intersects, models.peeled, true);
  hierarchy("fig8", Question::Distance, models.peeled, true);
  hierarchy("fig9", Question::Intersects, models.collapsed, false);
  hierarchy("fig10", Question::Distance, models.collapsed, false);
}

/// Figures 11 and 12: of each kind the series with the least geometric mean over the motions, as measured above, once more
/// beside each other.
void overall_cells(const Arguments& arguments, const Field& field, const PaperModels& models, const std::deque<Asked>& motions,
                   const std::vector<double>& steps, const std::string& shape, Results& results) {
  const auto best = [&](const std::string& group, const std::string& start) -> std::string {
    std::map<std::string, double> logs;
    for (const Row& row : results.rows(group)) {
      if (row.shape == shape && row.series.find(start) != std::string::npos) logs[row.series] += std::log(row.ns);
    }
    const auto least =
        std::min_element(logs.begin(), logs.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
    return least == logs.end() ? std::string() : least->first;
  };
  const auto entrant_of = [&](const std::string& label, const std::string& series) -> std::optional<Entrant> {
    for (const auto* variants : {&models.peeled, &models.collapsed, &models.tables}) {
      for (const Variant& v : *variants) {
        if (!series.starts_with(v.name + " ") && series != v.name) continue;
        const std::string method = series == v.name ? "swiftlet table" : series.substr(v.name.size() + 1);
        return Entrant{label, &field.named(method), v.bodies, 0, series};
      }
    }
    return std::nullopt;
  };
  for (const bool exact : {false, true}) {
    const char* group = exact ? "fig12" : "fig11";
    if (!arguments.wants(group)) continue;
    const Question question = exact ? Question::Distance : Question::Intersects;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      if (!arguments.figures_at(steps[i])) continue;
      std::vector<Entrant> entrants;
      const auto add = [&](const std::string& label, const std::string& series) {
        if (auto e = series.empty() ? std::nullopt : entrant_of(label, series)) entrants.push_back(std::move(*e));
      };
      add("best DK", best(exact ? "fig8" : "fig7", "paper"));
      add("best quadric", best(exact ? "fig10" : "fig9", "paper"));
      add("best table", best("fig6", " deg"));
      entrants.push_back({"nothing", &field.named("swiftlet finest"), models.nothing.bodies});
      entrants.push_back({"vclip", &field.named("vclip"), motions[i].bodies});
      entrants.push_back({"swiftlet", &field.named("swiftlet"), motions[i].bodies});
      results.add(group, shape, steps[i], kPaperTriangles, measure(motions[i], question, entrants, arguments.rounds()));
    }
  }
}

/// Does the approximate distance cost less than the exact one and more than the boolean [sec. 6.5]? Ours, allowed so many
/// radii.
void add_approximate(std::vector<Entrant>& entrants, const Field& field, const Asked& asked) {
  entrants.push_back({"swiftlet ~0.1", &field.named("swiftlet"), asked.bodies, 0.1});
  entrants.push_back({"swiftlet ~0.01", &field.named("swiftlet"), asked.bodies, 0.01});
}

/// Everyone on the orbit, in random poses, and the paper's figures.
void orbits(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants_any("orbit", "fig5", "fig6", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12")) return;
  const bool figures = arguments.wants_any("fig5", "fig6", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12");
  for (const Family family : kFamilies) {
    const std::string shape = shapes::name(family);
    const PaperModels models = figures ? paper_models(arguments, family) : PaperModels{};
    std::deque<Scene> scenes;
    std::deque<Asked> motions;
    std::vector<double> steps = arguments.steps();
    for (const double step : steps) scenes.push_back(orbit(shelf, family, kPaperTriangles, 2, step, arguments.extent()));
    scenes.push_back(random_poses(shelf, family, kPaperTriangles, arguments.extent()));
    steps.push_back(kRandomStep);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const Asked& asked = motions.emplace_back(scenes[i]);
      const double step = steps[i];
      for (const Question question : {Question::Distance, Question::Intersects}) {
        if (!arguments.wants("orbit")) continue;
        std::vector<Entrant> entrants = everyone(field, asked, question, arguments.peers_at(step));
        if (question == Question::Distance) add_approximate(entrants, field, asked);
        results.add("orbit", shape, step, kPaperTriangles, measure(asked, question, entrants, arguments.rounds()));
      }
      if (figures && arguments.figures_at(step)) paper_cells(arguments, field, models, asked, shape, step, results);
    }
    if (figures) overall_cells(arguments, field, models, motions, steps, shape, results);
  }
}

/// The paper's wider orbit.
void wide_orbits(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants("wide")) return;
  for (const Family family : kFamilies) {
    for (const double step : arguments.all() ? arguments.steps() : std::vector<double>{10.4}) {
      const Scene scene = orbit(shelf, family, kPaperTriangles, 3, step, arguments.extent());
      const Asked asked(scene);
      for (const Question question : {Question::Distance, Question::Intersects}) {
        results.add(
            "wide", shapes::name(family), step, kPaperTriangles,
            measure(asked, question, everyone(field, asked, question, arguments.all(), Variants::Main), arguments.rounds()));
      }
    }
  }
}

/// Error against time: what a query costs that may be off, and where the peers stand.
void errors(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants("error")) return;
  constexpr double kAllowed[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-9};
  constexpr double kPeersAllowed[] = {1e-1, 1e-3, 1e-6};
  for (const Family family : kFamilies) {
    for (const bool random : {false, true}) {
      if (random && !arguments.all()) continue;
      const Scene scene = random ? random_poses(shelf, family, kPaperTriangles, arguments.extent())
                                 : orbit(shelf, family, kPaperTriangles, 2, 10.4, arguments.extent());
      const Asked asked(scene);
      std::vector<Entrant> entrants = everyone(field, asked, Question::Distance, true);
      std::erase_if(entrants,
                    [](const Entrant& e) { return e.series.starts_with("swiftlet ") && e.series != "swiftlet coarsest"; });
      for (Entrant exact : std::vector<Entrant>(entrants)) {
        const Capabilities can = exact.method->capabilities();
        if (!can.approximate) continue;
        const auto sweep = [&](std::span<const double> decades) {
          for (const double allowed : decades) {
            Entrant loose = exact;
            char buffer[32];
            std::snprintf(buffer, sizeof buffer, " ~%g", allowed);
            loose.series += buffer;
            loose.allowed = allowed;
            entrants.push_back(std::move(loose));
          }
        };
        can.certified ? sweep(kAllowed) : sweep(kPeersAllowed);
      }
      results.add("error", shapes::name(family), random ? kRandomStep : 10.4, kPaperTriangles,
                  measure(asked, Question::Distance, entrants, arguments.rounds()));
    }
  }
}

/// Cost against size.
void sizes(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants("triangles")) return;
  const std::uint32_t usual = arguments.quick() ? 2'000 : arguments.all() ? 200'000 : 20'000;
  const std::uint32_t most = arguments.largest > 0 ? arguments.largest : usual;
  for (const Family family : kFamilies) {
    for (const std::uint32_t triangles : kTriangles) {
      if (triangles > most) continue;
      for (const double step : {1.04, 10.4, kRandomStep}) {
        if (step == 1.04 && !arguments.all()) continue;
        const Scene scene = step == kRandomStep ? random_poses(shelf, family, triangles, arguments.extent())
                                                : orbit(shelf, family, triangles, 2, step, arguments.extent());
        const Asked asked(scene);
        for (const Question question : {Question::Distance, Question::Intersects}) {
          const bool peers = arguments.all() || question == Question::Distance;
          results.add("triangles", shapes::name(family), step, triangles,
                      measure(asked, question, everyone(field, asked, question, peers, Variants::Main), arguments.rounds()));
        }
      }
    }
  }
}

/// Poses and pairs other than the paper's.
void others_at(double step, const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  const auto run = [&](const Scene& scene, const std::string& shape, bool peers) {
    const Asked asked(scene);
    const std::uint32_t triangles = std::uint32_t(scene.models.front().level(0).triangle_count);
    for (const Question question : {Question::Distance, Question::Intersects}) {
      results.add("scenes", shape, step, triangles,
                  measure(asked, question, everyone(field, asked, question, peers, Variants::Main), arguments.rounds()));
    }
  };
  const Extent extent = arguments.extent();
  for (const Family family : kFamilies) {
    const bool peers = arguments.all() || family == Family::Fat;
    run(mixed(shelf, family, kPaperTriangles, step, extent), "mixed", peers);
    if (arguments.quick()) break;
    run(at_distance(shelf, family, kPaperTriangles, kClose, step, extent), "close", peers);
    run(at_distance(shelf, family, kPaperTriangles, kSliding, step, extent), "sliding", peers);
    run(shallow(shelf, family, kPaperTriangles, step, 1e-3, extent), "shallow", peers);
  }
  if (arguments.quick()) return;
  run(ten_to_one(shelf, kPaperTriangles, step, extent), "10:1", arguments.all());
  run(plate_and_long(shelf, kPaperTriangles, step, extent), "plate and long", arguments.all());
  run(crowd(shelf, kPaperTriangles, step, arguments.all() ? 200 : 100), "crowd", true);
  const auto links = robot_links(arguments.meshes);
  if (links.empty()) std::puts("\nno robot links: models/fetch brings them");
  for (std::size_t i = 0; i + 1 < links.size(); i += arguments.all() ? 1 : 2) {
    run(link_pair(shelf, links[i], links[i + 1], step, extent), "links", arguments.all());
  }
  if (!links.empty()) run(link_and_fat(shelf, links.front(), kPaperTriangles, step, extent), "link and fat", arguments.all());
}

void others(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants("scenes")) return;
  for (const double step : arguments.all() ? std::vector{1.04, 10.4, 45.4} : std::vector{10.4}) {
    others_at(step, arguments, field, shelf, results);
  }
}

/// How deep, shallow and deep, beside all who answer that; 45.4 degrees are as good as cold.
void depths(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.only.contains("depth")) return;  // minutes, for ODE and Bullet
  const Methods judged = judged_methods();
  for (const Family family : kFamilies) {
    for (const double depth : {0.01, 0.3}) {
      for (const double step : {0.1, 1.04, 10.4, 45.4}) {
        const Scene scene =
            shallow(shelf, family, kPaperTriangles, step, depth * shapes::semi_axes(family).minCoeff(), arguments.extent());
        const Asked asked(scene, Question::Depth);
        std::vector<Entrant> list{{"swiftlet", &field.named("swiftlet"), asked.bodies}};
        for (const auto& m : judged) {
          if (m->capabilities().depth) list.push_back({m->name(), m.get(), asked.bodies});
        }
        results.add("depth", depth < 0.1 ? "shallow" : "deep", step, kPaperTriangles,
                    measure(asked, Question::Depth, list, arguments.rounds()));
      }
    }
  }
}

/// Contact points, where boxes, prisms and ellipsoids lie on each other.
void manifolds(const Arguments& arguments, const Shelf& shelf, Results& results) {
  if (!arguments.only.contains("manifold")) return;
  for (const ManifoldCell& cell : manifold_cells(shelf, arguments.quick() ? 1'000 : 4'000)) {
    results.add("manifold", cell.name, 0.1, std::uint32_t(cell.a.level(0).triangle_count), measure(cell, arguments.rounds()));
  }
}

Scene scene_of(const Goal& goal, const Shelf& shelf, Family family, Extent extent) {
  const bool rounded = goal.poses == Goal::Poses::Rounded, held = rounded && goal.step == 0;
  Scene scene = goal.step == kRandomStep ? random_poses(shelf, family, goal.triangles, extent)
                                         : orbit(shelf, family, goal.triangles, 2, held ? 10.4 : goal.step, extent);
  if (held) {  // a step of 0 turns nothing, and what is not turned is not rounded: each orbit's first turned pose instead
    for (std::size_t i = 0; i < scene.queries.size(); ++i)
      scene.queries[i] = scene.queries[i / extent.queries * extent.queries];
  }
  if (rounded) scene = rounded_to_float(std::move(scene));
  if (goal.poses == Goal::Poses::Overlapping) scene = overlapping(std::move(scene));
  return scene;
}

/// Ours beside the frozen baselines alone, each motion beside what it may take.
void goals(const Arguments& arguments, const Field& field, const Shelf& shelf, Results& results) {
  if (!arguments.wants("goals")) return;
  constexpr std::uint32_t kLargest = 200'000;  // judging one answer takes 40 ms: quick's extent whatever the run's
  const std::uint32_t most = arguments.largest > 0 ? arguments.largest : arguments.quick() ? 20'000 : kLargest;
  GoalTable table;
  for (const Goal& goal : kGoals) {
    table.begin(goal);
    if (goal.triangles > most) continue;
    const Extent extent = goal.triangles == kLargest ? Extent{4, 250} : arguments.extent();
    for (const Family family : kFamilies) {
      const Scene scene = scene_of(goal, shelf, family, extent);
      const Asked asked(scene);
      std::vector<Entrant> entrants;
      for (const char* series : kGoalMethods) entrants.push_back({series, &field.named(series), asked.bodies});
      const std::vector<Row> rows = measure(asked, goal.question(), entrants, kGoalRounds);
      results.add("goals", shapes::name(family), goal.step, goal.triangles, rows);
      table.add(asked, entrants, rows);
    }
  }
  std::fputs(table.text().c_str(), stdout);
  if (most < kLargest) {
    std::puts(
        "not measured: 200000 triangles, which take 40 s to build, once, and 6 minutes to judge; --largest 200000 adds them");
  }
}

constexpr const char* kGroups[] = {"goals", "depth", "manifold", "orbit", "wide", "error", "triangles", "scenes",
                                   "fig5",  "fig6",  "fig7",     "fig8",  "fig9", "fig10", "fig11",     "fig12"};

void usage(std::FILE* out) {
  std::fputs(
      "swiftlet_bench [--quick | --all] [--only GROUP]... [--largest TRIANGLES] [--wrong] [--cache DIR] [--meshes DIR]\n"
      "               [--results DIR]\n",
      out);
  std::fputs("groups:", out);
  for (const char* group : kGroups) std::fprintf(out, " %s", group);
  std::fputs(
      "\n        (fig11 and fig12 need fig6 to fig10 beside them; ./run bench has mesh and layer, too)\n"
      "--quick  1000 queries a round, three steps; --all adds 200000 triangles and peers in every cell\n"
      "--largest 200000  of the groups triangles and goals: beyond 20000 without --all, with --quick\n"
      "--wrong  adds a method that is 1e-6 off: the table must flag it\n",
      out);
}

std::optional<Arguments> parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto next = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (word == "--quick") {
      arguments.size = Arguments::Size::Quick;
    } else if (word == "--all") {
      arguments.size = Arguments::Size::All;
    } else if (word == "--only") {
      const std::string group = next();
      if (std::find(std::begin(kGroups), std::end(kGroups), group) == std::end(kGroups)) {
        std::fprintf(stderr, "--only: there is no group \"%s\"\n", group.c_str());
        return std::nullopt;
      }
      arguments.only.insert(group);
    } else if (word == "--wrong") {
      arguments.wrong = true;
    } else if (word == "--largest") {
      const std::string count = next();
      const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), arguments.largest);
      if (error != std::errc() || end != count.data() + count.size()) {
        std::fprintf(stderr, "--largest: \"%s\" is no number of triangles\n", count.c_str());
        return std::nullopt;
      }
    } else if (word == "--cache") {
      arguments.cache = next();
    } else if (word == "--meshes") {
      arguments.meshes = next();
    } else if (word == "--results") {
      arguments.results = next();
    } else {
      return std::nullopt;
    }
  }
  return arguments;
}

int run(const Arguments& arguments) {
  const Field field(arguments);
  for (const auto& m : field.everyone()) std::printf("%-20s %s\n", m->name().c_str(), m->settings().c_str());
  for (const std::string& peer : absent_peers()) std::printf("%-20s absent\n", peer.c_str());
  if (arguments.quick()) std::puts("quick: 1000 queries a round, too few to compare closely");
  const Shelf shelf(arguments.cache);
  Results results(arguments);
  orbits(arguments, field, shelf, results);
  wide_orbits(arguments, field, shelf, results);
  errors(arguments, field, shelf, results);
  sizes(arguments, field, shelf, results);
  others(arguments, field, shelf, results);
  goals(arguments, field, shelf, results);
  depths(arguments, field, shelf, results);
  manifolds(arguments, shelf, results);
  std::printf("\n%zu rows flagged as wrong, %zu of ours; results in %s\n", results.flagged(), results.ours_flagged(),
              arguments.results.c_str());
  return 0;
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) {
  using namespace swiftlet::bench;
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0) return usage(stdout), 0;
  const std::optional<Arguments> arguments = parse(argc, argv);
  return arguments ? run(*arguments) : (usage(stderr), 2);
}
