// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Insertion, rotations and both searches of the tree of boxes.
#include "broad_phase.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "numeric/chunks.h"

namespace swiftlet {
namespace {

/// A leaf's box is larger than its item's by this share of the longest side.
constexpr double kRoom = 0.0625;
/// A leaf's box that is larger than its item's by more than this share is too large. An item that has kept its size moves out
/// of a leaf's box before.
constexpr double kTooMuchRoom = 4 * kRoom;
/// Into so many tasks a search is cut, at least, where the trees are large enough.
constexpr std::size_t kTasks = 256;

WorldBox both(const WorldBox& a, const WorldBox& b) {
  WorldBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = std::min(a.min[i], b.min[i]);
    box.max[i] = std::max(a.max[i], b.max[i]);
  }
  return box;
}

/// Half the surface.
double area(const WorldBox& box) {
  const double x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return x * y + y * z + z * x;
}

bool holds(const WorldBox& outer, const WorldBox& inner) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (inner.min[i] < outer.min[i] || inner.max[i] > outer.max[i]) return false;
  }
  return true;
}

WorldBox larger(WorldBox box, double share) {
  double side = 0;
  for (std::size_t i = 0; i < 3; ++i) side = std::max(side, box.max[i] - box.min[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] -= share * side;
    box.max[i] += share * side;
  }
  return box;
}

}  // namespace

void BoxTree::put(std::uint32_t item, const WorldBox& box) {
  if (item >= leaf_.size()) {
    leaf_.resize(item + 1, kNothing);
    boxes_.resize(item + 1);
  }
  boxes_[item] = box;
  std::uint32_t& leaf = leaf_[item];
  if (leaf == kNothing) {
    leaf = new_node();
    nodes_[leaf].child = {item, kNothing};
    nodes_[leaf].height = nodes_[leaf].shortest = 0;
  } else if (holds(nodes_[leaf].box, box) && holds(larger(box, kTooMuchRoom), nodes_[leaf].box)) {
    return;
  } else {
    take_out(leaf);
  }
  nodes_[leaf].box = larger(box, kRoom);
  insert(leaf);
}

void BoxTree::remove(std::uint32_t item) {
  take_out(leaf_[item]);
  free_.push_back(leaf_[item]);
  leaf_[item] = kNothing;
}

std::uint32_t BoxTree::new_node() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return std::uint32_t(nodes_.size() - 1);
  }
  const std::uint32_t node = free_.back();
  free_.pop_back();
  return node;
}

void BoxTree::insert(std::uint32_t leaf) {
  if (root_ == kNothing) {
    root_ = leaf;
    nodes_[leaf].parent = kNothing;
    return;
  }
  // Downwards as long as a child promises less growth of all surfaces than a new parent here, which puts all below it a level
  // deeper. Where all boxes are equal the lower child; none whose leaves are all as deep as they may be: not both are such, as
  // the root's shortest way is that of a balanced tree at most.
  const WorldBox box = nodes_[leaf].box;
  const std::uint32_t most = most_height();
  std::uint32_t sibling = root_, depth = 0;
  for (; !nodes_[sibling].is_leaf(); ++depth) {
    const Node& node = nodes_[sibling];
    const double here = area(both(node.box, box)), inherited = here - area(node.box);
    std::array<double, 2> cost, surface;
    for (std::size_t i = 0; i < 2; ++i) {
      const Node& child = nodes_[node.child[i]];
      surface[i] = area(child.box);
      cost[i] = inherited + area(both(child.box, box)) - (child.is_leaf() ? 0 : surface[i]);
    }
    const bool are_equal = here == surface[0] && here == surface[1];
    const bool is_right_lower = nodes_[node.child[1]].height < nodes_[node.child[0]].height;
    std::size_t better = are_equal ? is_right_lower : cost[1] < cost[0];
    if (depth + 1 + nodes_[node.child[better]].shortest + 1u > most) better = 1 - better;
    if (here <= cost[better] && !are_equal && depth + 1 + node.height <= most) break;
    sibling = node.child[better];
  }
  const std::uint32_t parent = new_node(), above = nodes_[sibling].parent;
  nodes_[parent].parent = above;
  nodes_[parent].child = {sibling, leaf};
  if (above == kNothing) {
    root_ = parent;
  } else {
    nodes_[above].child[nodes_[above].child[1] == sibling] = parent;
  }
  nodes_[sibling].parent = nodes_[leaf].parent = parent;
  refit(parent, depth);
}

void BoxTree::take_out(std::uint32_t leaf) {
  const std::uint32_t parent = nodes_[leaf].parent;
  if (parent == kNothing) {
    root_ = kNothing;
    return;
  }
  const std::uint32_t sibling = nodes_[parent].child[nodes_[parent].child[0] == leaf], above = nodes_[parent].parent;
  nodes_[sibling].parent = above;
  free_.push_back(parent);
  if (above == kNothing) {
    root_ = sibling;
  } else {
    nodes_[above].child[nodes_[above].child[1] == parent] = sibling;
    std::uint32_t depth = 0;
    for (std::uint32_t node = above; (node = nodes_[node].parent) != kNothing;) ++depth;
    refit(above, depth);
  }
}

void BoxTree::fit(std::uint32_t node) {
  Node& n = nodes_[node];
  const Node &left = nodes_[n.child[0]], &right = nodes_[n.child[1]];
  n.box = both(left.box, right.box);
  n.height = std::uint16_t(1 + std::max(left.height, right.height));
  n.shortest = std::uint16_t(1 + std::min(left.shortest, right.shortest));
}

void BoxTree::refit(std::uint32_t node, std::uint32_t depth) {
  for (; node != kNothing; node = nodes_[node].parent, --depth) {
    fit(node);
    rotate(node, depth);
  }
}

/// Exchanges a child for a child of the other where that makes the other's surface least, unless a leaf would be too deep then.
void BoxTree::rotate(std::uint32_t node, std::uint32_t depth) {
  double best = 0;
  std::size_t side = 0, grandchild = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Node& lower = nodes_[nodes_[node].child[i]];
    if (lower.is_leaf()) continue;
    const WorldBox& other = nodes_[nodes_[node].child[1 - i]].box;
    for (std::size_t k = 0; k < 2; ++k) {
      const double less = area(lower.box) - area(both(other, nodes_[lower.child[1 - k]].box));
      if (less > best) best = less, side = i, grandchild = k;
    }
  }
  if (best <= 0) return;
  const std::uint32_t lower = nodes_[node].child[side];
  std::uint32_t &up = nodes_[lower].child[grandchild], &down = nodes_[node].child[1 - side];
  const std::uint32_t stays = nodes_[lower].child[1 - grandchild];
  const std::uint32_t below_lower = 1u + std::max(nodes_[down].height, nodes_[stays].height);
  const std::uint32_t height = 1 + std::max<std::uint32_t>(nodes_[up].height, below_lower);
  if (height > nodes_[node].height && depth + height > most_height()) return;
  std::swap(up, down);
  nodes_[up].parent = lower;
  nodes_[down].parent = node;
  fit(lower);
  fit(node);
}

std::uint32_t BoxTree::height() const {
  std::uint32_t highest = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> to_do;
  if (root_ != kNothing) to_do.emplace_back(root_, 0);
  while (!to_do.empty()) {
    const auto [node, depth] = to_do.back();
    to_do.pop_back();
    highest = std::max(highest, depth);
    if (nodes_[node].is_leaf()) continue;
    for (const std::uint32_t child : nodes_[node].child) to_do.emplace_back(child, depth + 1);
  }
  return highest;
}

template <class Split>
void BoxTree::below(const BoxTree& other, std::uint32_t a, std::uint32_t b, Split split) const {
  const Node &node_a = nodes_[a], &node_b = other.nodes_[b];
  if (this == &other && a == b) {
    split(node_a.child[0], node_a.child[0]);
    split(node_a.child[1], node_a.child[1]);
    split(node_a.child[0], node_a.child[1]);
  } else if (node_b.is_leaf() || (!node_a.is_leaf() && area(node_a.box) > area(node_b.box))) {
    for (const std::uint32_t child : node_a.child) split(child, b);
  } else {
    for (const std::uint32_t child : node_b.child) split(a, child);
  }
}

BoxTree::Pair BoxTree::items(const BoxTree& other, std::uint32_t a, std::uint32_t b) const {
  const Pair pair{nodes_[a].child[0], other.nodes_[b].child[0]};
  return this == &other && pair.b < pair.a ? Pair{pair.b, pair.a} : pair;
}

void BoxTree::step(const BoxTree& other, double most, Pair nodes, std::vector<Pair>& to_do, std::vector<Pair>& found) const {
  const auto [a, b] = nodes;
  if (!nodes_[a].is_leaf() || !other.nodes_[b].is_leaf()) {
    below(other, a, b, [&](std::uint32_t c, std::uint32_t d) {
      const bool same = this == &other && c == d;
      if (same ? !nodes_[c].is_leaf() : !(squared_gap(nodes_[c].box, other.nodes_[d].box) > most)) to_do.push_back({c, d});
    });
  } else if (this != &other || a != b) {
    const Pair pair = items(other, a, b);
    if (!(squared_gap(boxes_[pair.a], other.boxes_[pair.b]) > most)) found.push_back(pair);
  }
}

std::vector<BoxTree::Pair> BoxTree::near(const BoxTree& other, double most, const Executor& executor) const {
  std::vector<Pair> found, first;
  if (root_ != kNothing && other.root_ != kNothing) first.push_back({root_, other.root_});
  // Level by level until there is enough for tasks, then each of these to its end.
  std::size_t begun = 0;
  while (begun < first.size() && first.size() - begun < kTasks) step(other, most, first[begun++], first, found);
  std::vector<std::vector<Pair>> found_by(first.size() - begun);
  const auto search = [&](std::size_t task) {
    std::vector<Pair> to_do{first[begun + task]};
    while (!to_do.empty()) {
      const Pair nodes = to_do.back();
      to_do.pop_back();
      step(other, most, nodes, to_do, found_by[task]);
    }
  };
  run_tasks(executor, found_by.size(), search);
  for (const std::vector<Pair>& more : found_by) found.insert(found.end(), more.begin(), more.end());
  sort(found);
  return found;
}

/// By counting for the first item, then each item's few; where there are fewer pairs than items, all as one.
void BoxTree::sort(std::vector<Pair>& pairs) const {
  const auto before = [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; };
  if (pairs.size() < leaf_.size()) return std::sort(pairs.begin(), pairs.end(), before);
  std::vector<std::uint32_t> end(leaf_.size() + 1);
  for (const Pair& pair : pairs) ++end[pair.a + 1];
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  std::vector<Pair> sorted(pairs.size());
  for (const Pair& pair : pairs) sorted[end[pair.a]++] = pair;
  // By now `end` of an item is that: where the pairs of the next begin.
  auto from = sorted.begin();
  for (std::size_t i = 0; i < leaf_.size(); ++i) {
    const auto to = sorted.begin() + end[i];
    std::sort(from, to, before);
    from = to;
  }
  pairs.swap(sorted);
}

std::optional<BoxTree::Pair> BoxTree::nearest(const BoxTree& other, const std::function<bool(Pair)>& wanted) const {
  struct Item {
    double gap;
    std::size_t when;
    Pair nodes;
    /// Of equal gaps the one that came last, which is the deepest.
    bool operator<(const Item& x) const { return gap > x.gap || (gap == x.gap && when < x.when); }
  };
  std::priority_queue<Item> to_do;
  std::size_t count = 0;
  if (root_ != kNothing && other.root_ != kNothing) to_do.push({0, count++, {root_, other.root_}});
  while (!to_do.empty()) {
    const auto [a, b] = to_do.top().nodes;
    to_do.pop();
    if (!nodes_[a].is_leaf() || !other.nodes_[b].is_leaf()) {
      below(other, a, b, [&](std::uint32_t c, std::uint32_t d) {
        if (this != &other || c != d || !nodes_[c].is_leaf())
          to_do.push({squared_gap(nodes_[c].box, other.nodes_[d].box), count++, {c, d}});
      });
    } else if (this != &other || a != b) {
      const Pair pair = items(other, a, b);
      if (wanted(pair)) return pair;
    }
  }
  return std::nullopt;
}

}  // namespace swiftlet
