// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Measures the methods of one cell beside each other on the same queries, and says what they answered. Knows scenes, methods,
// verdicts and Google Benchmark; nothing of what the cells are for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "method.h"
#include "scenes.h"
#include "verdict.h"

namespace swiftlet::bench {
using namespace yardstick;

enum class Question : std::uint8_t { Distance, Intersects, Depth, Manifold };
const char* name(Question question);

/// Who is asked in a cell, with what, and how precisely.
struct Entrant {
  std::string series;  ///< as in the results and the legends, without commas; unique in the cell
  const Method* method = nullptr;
  std::vector<SceneBody> bodies;  ///< as many as the scene's, of the same hulls
  double allowed = 0;             ///< in radii; 0: exact
  std::string choice = {};        ///< what stands behind a series that is the best of several
};

/// A scene with what is proved of it. The scene outlives it.
struct Asked {
  /// The truth of distances and verdicts, or of depths: then all of the scene's bodies overlap.
  explicit Asked(const Scene& scene, Question question = Question::Distance);
  const Scene* scene;
  std::vector<SceneBody> bodies;
  Truth truth;
  double radius = 0;         ///< the largest bounding radius
  double triangles = 0;      ///< of all bodies on level 0
  std::vector<Query> floor;  ///< a few poses of the scene, each alternating many times with one that is 1e-9 radii farther
};

/// One line of the results. Names of columns: csv_header. NaN is no value.
struct Row {
  std::string group, scene, shape;
  double step = 0;  ///< degrees; kRandomStep for random poses
  std::uint32_t triangles = 0;
  Question question = Question::Distance;
  std::string series, choice;
  double allowed = 0;       ///< in radii
  std::size_t queries = 0;  ///< timed, per round
  std::size_t rounds = 0;
  double ns = 0, spread = 0;         ///< median over the rounds; the quartiles' distance over the median
  double floor_ns = 0;               ///< what a swiftlet query takes whose features stay, in the same rounds
  double error = 0, mean_error = 0;  ///< beyond the proved interval, in radii
  std::size_t wrong = 0, failed = 0;
  bool flagged = false;  ///< a failure, a wrong verdict, or an error beyond what the method states or was allowed
  std::uint64_t hash = 0;
  bool hash_true = false;             ///< every answer right to 0.5e-9 radii
  double steps = 0, plane_tests = 0;  ///< per query; of manifolds `steps` are the points
  double bytes = 0;                   ///< on the heap, per triangle
  double build_seconds = 0;
  int levels = 1;  ///< of the first body

  double ratio() const { return ns / floor_ns; }
};

/// Where random poses stand on the axis of steps.
inline constexpr double kRandomStep = 400;

/// Every entrant's passes over the scene, in rounds whose order Google Benchmark shuffles. Each timed pass follows an untimed
/// one over the scene's last 5 000 queries. A method that takes longer than 10 us per query gets 500, and two rounds.
std::vector<Row> measure(const Asked& asked, Question question, std::span<const Entrant> entrants, int rounds);

/// A line as `std::printf` writes it, of at most 511 characters.
std::string format(const char* pattern, ...);

std::string csv_header();
std::string csv_line(const Row& row);
/// The cell as a table for people.
std::string table(std::span<const Row> rows);

}  // namespace swiftlet::bench
