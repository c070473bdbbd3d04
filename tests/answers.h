// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Many questions on stored models, the same on every machine and compiler, and answers as bits and as text. Needs the runtime
// only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

namespace swiftlet::answers {

/// The models of tests/data/models in the order of their names, and one of three levels made from arrays.
std::vector<Model> models(const std::filesystem::path& folder);

/// Poses by bits, sums, products, quotients and square roots only, so the same everywhere: apart, near, through each other,
/// on a lattice, and the next in a slow turn.
class Poses {
 public:
  explicit Poses(std::uint64_t seed) : engine_(seed) {}
  Pose next();
  std::uint64_t bits() { return engine_(); }
  /// Any bits at all.
  PairSeed seed();

 private:
  double uniform(double low, double high);
  std::mt19937_64 engine_;  // whose bits the standard fixes
  Pose turning_;
};

/// Every field of an answer, bit for bit, steps included.
void append(const Answer& answer, std::vector<std::uint64_t>& words);
bool same_bits(const Answer& a, const Answer& b);

struct Fingerprint {
  std::uint64_t hash = 0xcbf29ce484222325u, answers = 0;
  void add(const Answer& answer);
  void add(const Manifold& manifold);
  void add(std::uint64_t word);
};

/// What was asked: the query and how, the bodies by their numbers, the number of the pose.
struct Asked {
  std::string_view query, how;
  std::size_t a, b;
  int round;
  std::string name() const;
};

/// What was asked, and the hash of all answers to it.
struct Print {
  const char* name;
  Fingerprint print;
};
std::string text(const Print& print);

/// All there is, one after the other: "answers" of all policies, refinements and plane rules, warm over `rounds` poses per pair
/// of models, cold, from random seeds, of all queries, tolerances and budgets, tables and models made at run time; "signed"
/// distances warm, cold, from random seeds, swapped, loose, limited and against thresholds, of overlaps for the most part;
/// "manifolds" of both kinds of exact answers, with and without a margin, radii and flatness, few points and many, after one
/// another and alone. Then, unless the meshes are left out (SWIFTLET_BVH), "meshes", "mesh_contacts" and "mesh_manifolds": see
/// mesh_answers.h.
std::vector<Print> prints(const std::vector<Model>& models, int rounds);

// ---- Records ---------------------------------------------------------------------------------------------------------------

/// Fields by name, as text: doubles in hexadecimal, the same text only for the same bits.
struct Record {
  std::string name;
  std::vector<std::pair<std::string, std::string>> fields;
};

/// Poses per pair of models or meshes that are recorded.
inline constexpr int kRecordedRounds = 10;

/// For each of `prints` its hash, a hash of each field over all its answers, and a sample of about one answer in ten as it is.
/// Names say the query, its place among the models, the number of its pose, and how it was asked.
std::vector<Record> records(const std::vector<Model>& models, int rounds);

void write(const std::vector<Record>& records, std::ostream& out);
std::vector<Record> read(std::istream& in);

/// What changed, for people; empty if nothing did.
struct Changes {
  std::vector<std::string> hashes;         ///< of all answers that changed, and of which of their fields
  std::vector<std::string> values;         ///< that changed in the sample
  std::map<std::string, int> gone, added;  ///< fields that one of them lacks, and in how many records
  bool empty() const { return hashes.empty() && values.empty() && gone.empty() && added.empty(); }
};
Changes compare(const std::vector<Record>& recorded, const std::vector<Record>& today);

}  // namespace swiftlet::answers
