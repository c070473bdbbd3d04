// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "answers.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <istream>
#include <map>
#include <ostream>
#include <sstream>
#include <string_view>

#include <double_bits.h>
#include <swiftlet/model_file.h>

#include "answer_fields.h"
#include "bodies.h"
#if SWIFTLET_MESH_ANSWERS
#include "mesh_answers.h"
#endif

namespace swiftlet::answers {

std::vector<Model> models(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Model> all;
  for (const auto& path : paths) all.push_back(bodies::must(load(path)));
  all.push_back(bodies::nested(3));
  return all;
}

double Poses::uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }

Pose Poses::next() {
  Pose pose;
  const std::uint64_t kind = bits() % 8;
  if (kind == 0) {
    for (double& x : pose.translation) x = double(int(bits() % 17) - 8) / 4;
    return pose;
  }
  double w = 0, x = 0, y = 0, z = 0;
  while (w * w + x * x + y * y + z * z < 1e-4) w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
  if (kind >= 5) {  // a little further, as seen from a world that moves as well
    const Pose step{bodies::rotation(1, 0.01 * x, 0.01 * y, 0.01 * z), Vec3(0.01 * w, 0.01 * x, 0.01 * y)};
    return turning_ = relative(step, turning_);
  }
  const double length = std::sqrt(x * x + y * y + z * z), reach = kind == 1   ? uniform(0, 0.1)
                                                                  : kind == 2 ? uniform(0, 2)
                                                                              : uniform(1.9, 4);
  pose.translation = length > 0 ? Vec3(x * reach / length, y * reach / length, z * reach / length) : Vec3(reach, 0, 0);
  pose.rotation = bodies::rotation(y, z, w, x);
  return turning_ = pose;
}

PairSeed Poses::seed() {
  std::array<std::uint64_t, sizeof(PairSeed) / 8> words;
  for (std::uint64_t& word : words) word = bits();
  PairSeed seed;
  std::memcpy(static_cast<void*>(&seed), words.data(), sizeof seed);
  return seed;
}

// ---- Answers as bits -------------------------------------------------------------------------------------------------------

namespace {

struct Words {
  std::vector<std::uint64_t>& words;
  void number(const char*, double x) { words.push_back(std::isnan(x) ? ~std::uint64_t{0} : bit_cast<std::uint64_t>(x)); }
  void numbers(const char* name, const Vec3& v) { number(name, v.x()), number(name, v.y()), number(name, v.z()); }
  void feature(const char*, FeatureId h) { words.push_back(std::uint64_t(h.kind()) << 32 | h.index()); }
  void count(const char*, std::uint32_t n) { words.push_back(n); }
  void pair(const char*, auto high, const char*, auto low) { words.push_back(std::uint64_t(high) << 32 | std::uint64_t(low)); }
  void element(const char* = nullptr, std::uint32_t = 0) {}
};

void add_fields(const auto& answer, Fingerprint& print) {
  std::vector<std::uint64_t> words;
  visit(answer, Words{words});
  for (const std::uint64_t word : words) print.add(word);
  ++print.answers;
}

}  // namespace

void append(const Answer& answer, std::vector<std::uint64_t>& words) { visit(answer, Words{words}); }
bool same_bits(const Answer& a, const Answer& b) {
  std::vector<std::uint64_t> words_a, words_b;
  append(a, words_a), append(b, words_b);
  return words_a == words_b;
}

void Fingerprint::add(std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3u;
  hash ^= hash >> 32;
}
void Fingerprint::add(const Answer& answer) { add_fields(answer, *this); }
void Fingerprint::add(const Manifold& manifold) { add_fields(manifold, *this); }

// ---- Answers as text -------------------------------------------------------------------------------------------------------

namespace {

std::string text(const char* format, auto... values) {
  std::array<char, 160> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}
std::string text(double x) { return std::isnan(x) ? "nan" : text("%a", x); }  // of which NaN has a sign, nobody says
std::string text(int n) { return text("%d", n); }
std::string text(std::uint32_t n) { return text("%u", n); }
const char* text(bool is) { return is ? "yes" : "no"; }
std::string text(FeatureId h) {
  constexpr const char* kKinds[] = {"none", "vertex", "edge", "face"};
  return text("%s:%u", kKinds[std::size_t(h.kind())], h.index());
}
const char* text(Status status) {
  switch (status) {
    case Status::NotAsked: return "not_asked";
    case Status::Converged: return "converged";
    case Status::Beyond: return "beyond";
    case Status::Budget: return "budget";
    case Status::LevelLimit: return "level_limit";
    case Status::NotConverged: return "not_converged";
    case Status::InvalidPose: return "invalid_pose";
    case Status::InvalidRadius: return "invalid_radius";
    case Status::InvalidBody: return "invalid_body";
  }
  return "";
}
const char* text(Verdict verdict) {
  switch (verdict) {
    case Verdict::Undecided: return "undecided";
    case Verdict::Disjoint: return "disjoint";
    case Verdict::Touching: return "touching";
    case Verdict::Overlapping: return "overlapping";
  }
  return "";
}

struct Texts {
  std::vector<std::pair<std::string, std::string>>& fields;
  std::string prefix{};
  void add(const char* name, std::string value) { fields.emplace_back(prefix + name, std::move(value)); }
  void number(const char* name, double x) { add(name, text(x)); }
  void numbers(const char* name, const Vec3& v) { add(name, text(v.x()) + "," + text(v.y()) + "," + text(v.z())); }
  void feature(const char* name, FeatureId h) { add(name, text(h)); }
  void count(const char* name, std::uint32_t n) { add(name, text(n)); }
  void pair(const char* first, auto x, const char* second, auto y) { add(first, text(x)), add(second, text(y)); }
  void element(const char* array, std::uint32_t i) { prefix = text("%s%u.", array, i); }
  void element() { prefix.clear(); }
};

}  // namespace

// ---- Questions -------------------------------------------------------------------------------------------------------------

std::string Asked::name() const {
  return text("%.*s/%zu-%zu/%d", int(query.size()), query.data(), a, b, round) + "/" + std::string(how);
}

namespace {

/// Calls ask(a, b, its numbers and round, next pose) for so many poses of each pair.
template <class Ask>
void each_pose(const std::vector<Model>& models, int rounds, Poses& poses, Ask ask) {
  for (std::size_t a = 0; a < models.size(); ++a) {
    for (std::size_t b = 0; b < models.size(); ++b) {
      for (int i = 0; i < rounds; ++i) ask(models[a], models[b], Asked{{}, {}, a, b, i}, poses.next());
    }
  }
}

/// Options that keep a seed of their own from pose to pose.
struct Chain {
  std::string how;
  Options options;
  PairSeed seed{};
};

std::vector<Chain> chains() {
  using enum StartPolicy;
  using enum Refinement;
  using enum PlaneRule;
  std::vector<Chain> all;
  for (const auto& [start, start_name] :
       {std::pair{Automatic, "automatic"}, std::pair{Paper, "paper"}, std::pair{Finest, "finest"},
        std::pair{Coarsest, "coarsest"}, std::pair{Table, "table"}}) {
    for (const auto& [refinement, refinement_name] :
         {std::pair{Single, "single"}, std::pair{SingleSingle, "single_single"}, std::pair{DoubleDouble, "double_double"}}) {
      for (const auto& [rule, rule_name] : {std::pair{MostViolated, "most"}, std::pair{FirstViolated, "first"}}) {
        Options options;
        options.tuning.start = start;
        options.tuning.refinement = refinement;
        options.tuning.plane_rule = rule;
        all.push_back({text("%s.%s.%s", start_name, refinement_name, rule_name), options});
      }
    }
  }
  return all;
}

/// A function of a query's name, of how it was asked and of its answer: calls take(asked, answer).
template <class Take>
auto taker(Asked& asked, Take& take) {
  return [&](std::string_view query, std::string_view how, const Answer& answer) {
    asked.query = query, asked.how = how;
    take(asked, answer);
  };
}

/// Calls take(asked, answer) for each answer; so do those below.
template <class Take>
void each_answer(const std::vector<Model>& models, int rounds, Take take) {
  Poses poses(1);
  std::vector<Chain> policies;
  Options loosely, limited;
  loosely.relative = 0.01;
  PairSeed loose, tested, near, met;
  each_pose(models, rounds, poses, [&](const Model& a, const Model& b, Asked asked, const Pose& pose) {
    if (asked.round == 0) policies = chains(), loose = tested = near = met = {};
    const auto took = taker(asked, take);
    for (Chain& c : policies) took("distance", c.how, distance(a, b, pose, c.seed, c.options));
    PairSeed random = poses.seed();
    took("distance", "cold", distance(a, b, pose));
    took("distance", "random", distance(a, b, pose, random));
    took("distance", "swapped", distance(b, a, inverse(pose)));
    took("distance", "loose", distance(a, b, pose, loose, loosely));
    took("intersects", "warm", intersects(a, b, pose, tested));
    took("within", "warm", within(a, b, pose, 0.5, near).answer);
    took("closest_features", "warm", closest_features(a, b, pose, met).answer);
    limited.budget.steps = std::uint32_t(asked.round % 7);
    limited.budget.finest_level = asked.round % 2;
    took("distance", "limited", distance(a, b, pose, limited));
  });
}

template <class Take>
void each_signed_answer(const std::vector<Model>& models, int rounds, Take take) {
  Poses poses(2);
  PairSeed warm, met;
  Options loose, limited;
  loose.relative = 0.01;
  each_pose(models, rounds, poses, [&](const Model& a, const Model& b, Asked asked, Pose pose) {
    const auto took = taker(asked, take);
    if (asked.round % 4) pose.translation *= 0.25;  // mostly inside one another
    PairSeed random = poses.seed();
    took("signed_distance", "warm", signed_distance(a, b, pose, warm));
    took("signed_distance", "cold", signed_distance(a, b, pose));
    took("signed_distance", "random", signed_distance(a, b, pose, random));
    took("signed_distance", "swapped", signed_distance(b, a, inverse(pose)));
    took("signed_distance", "loose", signed_distance(a, b, pose, loose));
    limited.budget.steps = std::uint32_t(asked.round % 7);
    limited.budget.finest_level = asked.round % 2;
    took("signed_distance", "limited", signed_distance(a, b, pose, limited));
    took("signed_within", "warm", signed_within(a, b, pose, -0.25, met).answer);
  });
}

/// Bodies about nearly one centre, among them a ball, of which more facets are about as deep than a polytope has corners.
template <class Take>
void each_nested_answer(std::vector<Model> models, int rounds, Take take) {
  models.push_back(bodies::model(bodies::ball(3)));
  Poses poses(4);
  PairSeed warm;
  Options loose, limited;
  loose.relative = 0.001;
  each_pose(models, rounds, poses, [&](const Model& a, const Model& b, Asked asked, Pose pose) {
    const auto took = taker(asked, take);
    pose.translation *= asked.round % 2 ? 0 : 0x1p-20;
    if (asked.round < 2) pose.rotation.setIdentity();
    const Answer deep = signed_distance(a, b, pose, warm);
    took("nested", "warm", deep);
    took("nested", "swapped", signed_distance(b, a, inverse(pose)));
    took("nested", "loose", signed_distance(a, b, pose, loose));
    limited.budget.steps = 100 * std::uint32_t(asked.round % 7);
    took("nested", "limited", signed_distance(a, b, pose, limited));
    took("nested", "within", signed_within(a, b, pose, deep.lower * 1.001).answer);
  });
}

template <class Take>
void each_manifold(const std::vector<Model>& models, int rounds, Take take) {
  Poses poses(3);
  PairSeed seed, near;
  Manifold before;
  each_pose(models, rounds, poses, [&](const Model& a, const Model& b, Asked asked, const Pose& pose) {
    const auto took = [&](const char* how, const Manifold& manifold) {
      asked.query = "manifold", asked.how = how;
      take(asked, manifold);
    };
    ManifoldOptions options;
    options.margin = asked.round % 3 ? 4 : 0;
    options.most_points = 1 + std::uint32_t(poses.bits() % kMostManifoldPoints);
    if (asked.round % 4 == 0) options.flatness = 0;
    const bool rounded = asked.round % 5 == 0;
    const Body of_a(a, rounded ? 0.25 : 0), of_b(b, rounded ? 0.125 : 0);
    const Answer deep = signed_distance(of_a, of_b, pose, seed);
    took("alone", manifold(of_a, of_b, pose, deep, options));
    took("after", before = manifold(of_a, of_b, pose, deep, options, before));
    took("closest_features", manifold(of_a, of_b, pose, closest_features(of_a, of_b, pose, near).answer, options));
  });
}

/// Calls collect(name, each) for each kind of answer, which passes every answer of the kind to what it is called with.
template <class Collect>
void each_kind(const std::vector<Model>& models, int rounds, Collect collect) {
  collect("answers", [&](auto take) { each_answer(models, rounds, take); });
  collect("signed", [&](auto take) { each_signed_answer(models, rounds, take); });
  collect("nested", [&](auto take) { each_nested_answer(models, rounds, take); });
  collect("manifolds", [&](auto take) { each_manifold(models, rounds, take); });
#if SWIFTLET_MESH_ANSWERS
  collect("meshes", [&](auto take) { each_mesh_answer(models, rounds, take); });
  collect("mesh_contacts", [&](auto take) { each_mesh_contact(rounds, take); });
  collect("mesh_manifolds", [&](auto take) { each_mesh_manifold(rounds, take); });
#endif
}

/// Empty, but for the first kind of models and of meshes: what of these is made at run time.
Fingerprint first_print(const std::vector<Model>& models, std::string_view kind) {
  Fingerprint print;
#if SWIFTLET_MESH_ANSWERS
  if (kind == "meshes")
    for (const MeshModel& mesh : meshes()) print.add(mesh.hash());
#endif
  if (kind != "answers") return print;
  for (const Model& model : models) {
    print.add(model.hash());
    print.add(model.with_table({lut::Resolution::Degrees5, 1.5}).value().hash());
  }
  return print;
}

}  // namespace

std::vector<Print> prints(const std::vector<Model>& models, int rounds) {
  std::vector<Print> all;
  each_kind(models, rounds, [&](const char* kind, auto each) {
    all.push_back({kind, first_print(models, kind)});
    each([&](const Asked&, const auto& answer) { add_fields(answer, all.back().print); });
  });
  return all;
}

std::string text(const Print& print) {
  char line[80];
  std::snprintf(line, sizeof line, "%016" PRIx64 " %" PRIu64 " %s", print.print.hash, print.print.answers, print.name);
  return line;
}

// ---- Records ---------------------------------------------------------------------------------------------------------------

namespace {

/// Of one kind of answers: prime to the numbers of ways in which a pose is asked, so that each way is in the sample.
constexpr std::uint64_t kSampled[] = {13, 5, 21, 5, 37, 31, 37};

std::string hex(std::uint64_t hash) { return text("%016" PRIx64, hash); }

}  // namespace

std::vector<Record> records(const std::vector<Model>& models, int rounds) {
  std::vector<Record> heads, sample;
  each_kind(models, rounds, [&](const char* kind, auto each) {
    const std::uint64_t every = kSampled[heads.size() / 2];
    Fingerprint all = first_print(models, kind);
    std::map<std::string, Fingerprint> by_field;
    each([&](const Asked& asked, const auto& answer) {
      Record record{asked.name(), {}};
      visit(answer, Texts{record.fields});
      for (const auto& [name, value] : record.fields) {
        Fingerprint& print = by_field[name];
        print.add(all.answers);
        for (const char c : value) print.add(std::uint8_t(c));
      }
      if (all.answers % every == 0) sample.push_back(std::move(record));
      add_fields(answer, all);
    });
    heads.push_back({text("all/%s", kind), {{"hash", hex(all.hash)}, {"count", std::to_string(all.answers)}}});
    heads.push_back({text("fields/%s", kind), {}});
    for (const auto& [name, print] : by_field) heads.back().fields.emplace_back(name, hex(print.hash));
  });
  heads.insert(heads.end(), sample.begin(), sample.end());
  return heads;
}

void write(const std::vector<Record>& records, std::ostream& out) {
  for (const Record& record : records) {
    out << record.name;
    for (const auto& [name, value] : record.fields) out << ' ' << name << '=' << value;
    out << '\n';
  }
}

std::vector<Record> read(std::istream& in) {
  std::vector<Record> records;
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream words(line);
    Record record;
    words >> record.name;
    while (words >> word) {
      const std::size_t at = word.find('=');
      record.fields.emplace_back(word.substr(0, at), at == word.npos ? "" : word.substr(at + 1));
    }
    records.push_back(std::move(record));
  }
  return records;
}

Changes compare(const std::vector<Record>& recorded, const std::vector<Record>& today) {
  std::map<std::string, std::map<std::string, std::string>> is;  // by record and field
  for (const Record& record : today) is[record.name] = {record.fields.begin(), record.fields.end()};
  Changes changes;
  for (const Record& record : recorded) {
    std::map<std::string, std::string>& left = is[record.name];
    for (const auto& [name, value] : record.fields) {
      const auto now = left.extract(name);
      if (!now)
        ++changes.gone[name];
      else if (now.mapped() != value && (record.name.starts_with("all/") || record.name.starts_with("fields/")))
        changes.hashes.push_back(record.name + " " + name);
      else if (now.mapped() != value)
        changes.values.push_back(record.name + " " + name + "=" + now.mapped() + ", recorded " + value);
    }
  }
  for (const auto& [record, left] : is)
    for (const auto& [name, value] : left) ++changes.added[name];
  return changes;
}

}  // namespace swiftlet::answers
