// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A dynamic tree of boxes [Catto 2019, Dynamic Bounding Volume Hierarchies]: leaves are the boxes of items and a little more,
// so that small moves change nothing; inserted where the surface grows least, kept good by rotations. Both give way where the
// tree would become too high, as where boxes coincide or nest. Knows boxes and items by number, not bodies.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <swiftlet/batch.h>

namespace swiftlet {

/// Along the axes of the world.
struct WorldBox {
  std::array<double, 3> min, max;
};

/// The square of the distance of two boxes, to rounding.
inline double squared_gap(const WorldBox& a, const WorldBox& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = std::max(0.0, std::max(a.min[i] - b.max[i], b.min[i] - a.max[i]));
    sum += gap * gap;
  }
  return sum;
}

class BoxTree {
 public:
  /// An item of each tree; of one tree with itself a < b.
  struct Pair {
    std::uint32_t a, b;
  };

  /// Adds the item, or moves it. Items are small numbers.
  void put(std::uint32_t item, const WorldBox& box);
  /// Removes the item, which must be there.
  void remove(std::uint32_t item);
  const WorldBox& box(std::uint32_t item) const { return boxes_[item]; }
  /// The box of its leaf.
  const WorldBox& leaf_box(std::uint32_t item) const { return nodes_[leaf_[item]].box; }
  /// How deep the deepest leaf is; the root is 0 deep. Counts.
  std::uint32_t height() const;
  /// No leaf is deeper: three times what a balanced tree needs for as many items as there have been at once, and so many
  /// levels more that trees of ordinary scenes, large boxes above small ones, keep the shape that surfaces want.
  std::uint32_t most_height() const { return 3 * std::uint32_t(std::bit_width(leaf_.size())) + 16; }

  /// Pairs of items whose boxes have a squared gap that is not above `most`, sorted; each once.
  std::vector<Pair> near(const BoxTree& other, double most, const Executor& executor = {}) const;
  /// A pair with the least gap of boxes of those that are wanted.
  std::optional<Pair> nearest(const BoxTree& other, const std::function<bool(Pair)>& wanted) const;

 private:
  static constexpr std::uint32_t kNothing = ~0u;
  struct alignas(64) Node {
    WorldBox box;
    std::uint32_t parent;
    std::array<std::uint32_t, 2> child;  ///< of a leaf: its item, and nothing
    std::uint16_t height, shortest;      ///< how far down the farthest and the nearest leaf are
    bool is_leaf() const { return child[1] == kNothing; }
  };
  void insert(std::uint32_t leaf);
  void take_out(std::uint32_t leaf);
  /// Of the node, which is that deep, and all above it.
  void refit(std::uint32_t node, std::uint32_t depth);
  void fit(std::uint32_t node);
  void rotate(std::uint32_t node, std::uint32_t depth);
  std::uint32_t new_node();
  /// Calls split(a, b) for the node pairs below one that is not of two leaves.
  template <class Split>
  void below(const BoxTree& other, std::uint32_t a, std::uint32_t b, Split split) const;
  /// One step of a search from a pair of nodes: what is left to do below it, or the pair of items found.
  void step(const BoxTree& other, double most, Pair nodes, std::vector<Pair>& to_do, std::vector<Pair>& found) const;
  void sort(std::vector<Pair>& pairs) const;
  Pair items(const BoxTree& other, std::uint32_t a, std::uint32_t b) const;

  std::vector<Node> nodes_;
  std::vector<WorldBox> boxes_;      ///< per item, as it was put
  std::vector<std::uint32_t> leaf_;  ///< per item
  std::vector<std::uint32_t> free_;
  std::uint32_t root_ = kNothing;
};

}  // namespace swiftlet
