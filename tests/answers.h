// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Many questions on stored models, the same on every machine and compiler, and answers as bits. Needs the runtime only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/patch.h>
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
void append(const Answer& answer, std::vector<std::uint64_t>& fields);

struct Fingerprint {
  std::uint64_t hash = 0xcbf29ce484222325u, answers = 0;
  void add(const Answer& answer);
  void add(const SignedAnswer& answer);
  void add(const Patch& patch);
  void add(std::uint64_t word);
};

/// What was asked, and the hash of all answers to it.
struct Print {
  const char* name;
  Fingerprint print;
};
std::string text(const Print& print);

/// All there is, one after the other: distances first.
std::vector<Print> prints(const std::vector<Model>& models, int rounds);

/// All policies, refinements and plane rules, warm over `rounds` poses per pair of models, cold, from random seeds; all
/// queries, tolerances and budgets; tables and models made at run time.
Fingerprint fingerprint(const std::vector<Model>& models, int rounds);

/// Signed distances warm, cold, from random seeds, swapped, loose, limited and against thresholds, of overlaps for the most
/// part.
Fingerprint signed_fingerprint(const std::vector<Model>& models, int rounds);

/// Patches of both kinds of exact answers: with and without a margin, radii and flatness, few points and many, after one
/// another and alone.
Fingerprint patch_fingerprint(const std::vector<Model>& models, int rounds);

}  // namespace swiftlet::answers
