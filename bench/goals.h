// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What ours may take over the fastest of the frozen baselines, and the table that says whether it does. Knows rows and ours as
// its users ask it; nothing of how scenes are made or timed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rig.h"

namespace swiftlet::bench {

/// A motion of bodies of one size. Ratios are ours over the fastest baseline, in the worst of fat, plate and long.
struct Goal {
  enum class Poses : std::uint8_t {
    Apart,
    Rounded,     ///< apart, rotation and translation rounded to float32
    Overlapping  ///< deeply: a verdict is asked for, not a distance
  };
  std::uint32_t triangles;
  Poses poses;
  double step;  ///< as in Row
  double must, aim;

  Question question() const { return poses == Poses::Overlapping ? Question::Intersects : Question::Distance; }
};

inline constexpr Goal kGoals[] = {
    {2'000, Goal::Poses::Apart, 0, 1.3, 1},
    {2'000, Goal::Poses::Apart, 1.04, 1.1, 0.9},
    {2'000, Goal::Poses::Apart, 10.4, 0.85, 0.7},
    {2'000, Goal::Poses::Apart, 45.4, 0.75, 0.6},
    {2'000, Goal::Poses::Apart, kRandomStep, 0.75, 0.55},
    {2'000, Goal::Poses::Rounded, 0, 1.3, 1},
    {2'000, Goal::Poses::Rounded, 1.04, 1.1, 0.9},
    {2'000, Goal::Poses::Rounded, 10.4, 0.85, 0.7},
    {2'000, Goal::Poses::Rounded, 45.4, 0.75, 0.6},
    {2'000, Goal::Poses::Rounded, kRandomStep, 0.75, 0.55},
    {2'000, Goal::Poses::Overlapping, 1.04, 1, 0.7},
    {2'000, Goal::Poses::Overlapping, 10.4, 1, 0.7},
    {2'000, Goal::Poses::Overlapping, 45.4, 1, 0.7},
    {2'000, Goal::Poses::Overlapping, kRandomStep, 1, 0.7},
    {20'000, Goal::Poses::Apart, 1.04, 0.9, 0.7},
    {20'000, Goal::Poses::Apart, 10.4, 0.8, 0.6},
    {20'000, Goal::Poses::Apart, kRandomStep, 0.6, 0.4},
    {200'000, Goal::Poses::Apart, 1.04, 0.6, 0.4},
    {200'000, Goal::Poses::Apart, 10.4, 0.4, 0.25},
    {200'000, Goal::Poses::Apart, kRandomStep, 0.25, 0.15},
};

/// Ours first. The baselines prove nothing.
inline constexpr std::array<const char*, 4> kGoalMethods{"swiftlet", "vclip", "plain", "plain table"};

/// More than elsewhere: medians that are divided by each other.
inline constexpr int kGoalRounds = 15;

class GoalTable {
 public:
  /// A goal that nothing is added to stands as not measured.
  void begin(const Goal& goal) { lines_.push_back({goal, {}}); }
  /// One shape of the goal that was begun last: who was asked, as kGoalMethods, and what came out. Asks them once more,
  /// untimed.
  void add(const Asked& asked, std::span<const Entrant> entrants, std::vector<Row> rows);
  std::string text() const;

 private:
  struct Cell {
    std::vector<Row> rows;
    double width, of_bound;      ///< of our widest interval, warm: in radii, and over law 2's bound
    std::vector<double> errors;  ///< of each row the largest, in radii
    const Row& ours() const { return rows.front(); }
    const Row& fastest() const;  ///< of the baselines
    double ratio() const { return ours().ns / fastest().ns; }
  };
  struct Line {
    Goal goal;
    std::vector<Cell> cells;  ///< one per shape
    double worst() const;
    bool right() const;  ///< none of ours is flagged, wider than law 2, or farther off than wide
    bool met(double ratio) const { return right() && worst() <= ratio; }
  };
  static std::string text(const Line& line);
  std::vector<Line> lines_;
};

}  // namespace swiftlet::bench
