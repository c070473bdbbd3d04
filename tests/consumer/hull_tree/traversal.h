// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Tolerance, distance and contact queries between two trees of hulls [Ehmann & Lin 2001, sec. 6 and 7]. Every node pair is one
// call of swiftlet::march.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tree.h"

namespace hull_tree {

/// Where the march of a new node pair begins.
enum class Start : std::uint8_t {
  Centres,  ///< along the line of the centres: the kernel's own
  Table,    ///< from the nodes' start tables
  Parent,   ///< from what is left of the parent pair's features
};

struct Settings {
  Start start = Start::Parent;
  bool front = false;               ///< node pairs and their features outlive the query; else each begins at the roots
  std::uint32_t step_budget = ~0u;  ///< per march; one that it ends goes on with twice as many
};

struct Work {
  std::uint64_t pairs = 0, steps = 0;
};

/// The nearest features of two nodes, all in the mesh: neither tag is Free.
struct Witness {
  std::uint32_t node_a = 0, node_b = 0;
  swiftlet::FeatureId a, b;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< A's frame
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  bool overlapping = false;
};

/// Two bodies and what one query leaves to the next.
class Pair {
 public:
  Pair(const Tree& a, const Tree& b, const Settings& settings) : a_(a), b_(b), settings_(settings) {}

  /// Is the distance at most `tolerance`? With 0: do they meet?
  bool within(const Pose& b_in_a, double tolerance);
  /// `lower` and `upper` hold the distance and differ by at most max(absolute, relative * lower), or by rounding.
  Witness distance(const Pose& b_in_a, double absolute = 0, double relative = 0);
  /// All pairs of leaves whose distance is at most `tolerance`, or one that overlaps. Goes on to the leaves whatever the tags:
  /// nearest features on the surface answer for the distance of two nodes, not for a second contact between them.
  std::vector<Witness> contacts(const Pose& b_in_a, double tolerance);

  const Work& work() const { return work_; }
  std::uint64_t unanswered() const { return unanswered_; }  ///< leaf pairs that the kernel gave no verdict for

 private:
  /// A node of the tree of node pairs. Has no children or two, `child` and the one after it.
  struct Item {
    std::uint32_t a, b;
    swiftlet::MarchStart start;
    double lower = 0;  ///< of the last query
    std::uint32_t child = swiftlet::kNone;
    bool close = false;  ///< the last query did not prune it
  };
  enum class Next { Prune, Answered, Split, Stop };

  template <class Judge, class Worth>
  void traverse(const Pose& b_in_a, swiftlet::MarchRule& rule, Judge judge, Worth worth);
  swiftlet::MarchResult visit(Item& item, swiftlet::MarchRule rule);
  double rounding() const;
  bool answers(const Item& item, const swiftlet::MarchResult& result);
  bool splits_a(const Item& item, const swiftlet::MarchResult& result) const;
  std::uint32_t split(std::uint32_t item, bool split_a);
  swiftlet::MarchStart fresh_start(std::uint32_t a, std::uint32_t b) const;
  std::vector<std::uint32_t> front() const;
  void raise_front();
  bool is_leaf_pair(const Item& item) const { return a_.nodes[item.a].is_leaf() && b_.nodes[item.b].is_leaf(); }

  const Tree &a_, &b_;
  const Settings settings_;
  Pose pose_;
  std::vector<Item> items_;           ///< the root pair first
  std::vector<std::uint32_t> spare_;  ///< pairs of items that nothing uses
  Work work_;
  std::uint64_t unanswered_ = 0;
};

}  // namespace hull_tree
