// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "traversal.h"

#include <algorithm>
#include <queue>

namespace hull_tree {
namespace {

using swiftlet::FeatureId;
using swiftlet::FeatureKind;
using swiftlet::kNone;
using swiftlet::MarchResult;
using swiftlet::MarchRule;
using swiftlet::MarchStart;
using swiftlet::MarchStatus;

/// A corner of the parent's feature that the child has; no feature where it has none.
FeatureId from_parent(const Node& parent, FeatureId feature, std::size_t side) {
  for (const std::uint32_t v : corners(parent.view, feature)) {
    if (const std::uint32_t there = parent.vertex_in_child[side][v]; there != kNone) return {FeatureKind::Vertex, there};
  }
  return {};
}

Witness witness(std::uint32_t a, std::uint32_t b, const MarchResult& r) {
  return {a, b, r.a, r.b, r.point_a, r.point_b, r.lower, r.upper, r.status == MarchStatus::Overlapping};
}

}  // namespace

double Pair::rounding() const { return tolerance(a_, b_, pose_); }

bool Pair::within(const Pose& b_in_a, double tolerance) {
  MarchRule rule;
  rule.beyond = tolerance;
  bool found = false;
  const auto judge = [&](const Item& item, const MarchResult& r) {
    if (r.status == MarchStatus::Beyond) return Next::Prune;
    found = answers(item, r);
    return found ? Next::Stop : Next::Split;
  };
  traverse(b_in_a, rule, judge, [](double) { return true; });
  return found;
}

Witness Pair::distance(const Pose& b_in_a, double absolute, double relative) {
  MarchRule rule;
  rule.absolute = absolute;
  rule.relative = relative;
  Witness best;
  double lower = std::numeric_limits<double>::infinity();
  const auto judge = [&](const Item& item, const MarchResult& r) {
    if (r.status == MarchStatus::Beyond) return Next::Prune;
    if (!answers(item, r)) return Next::Split;
    lower = std::min(lower, r.lower);
    if (r.upper < best.upper) best = witness(item.a, item.b, r);
    rule.beyond = best.upper;
    return Next::Answered;
  };
  const auto worth = [&](double least) {
    if (best.upper - least > std::max({rounding(), absolute, relative * least})) return true;
    lower = std::min(lower, least);
    return false;
  };
  traverse(b_in_a, rule, judge, worth);
  best.lower = std::min(lower, best.upper);
  return best;
}

std::vector<Witness> Pair::contacts(const Pose& b_in_a, double tolerance) {
  MarchRule rule;
  rule.beyond = tolerance;
  std::vector<Witness> found;
  const auto judge = [&](const Item& item, const MarchResult& r) {
    if (r.status == MarchStatus::Beyond) return Next::Prune;
    if (!is_leaf_pair(item)) return Next::Split;
    answers(item, r);
    if (r.status == MarchStatus::Overlapping) found.clear();
    found.push_back(witness(item.a, item.b, r));
    return r.status == MarchStatus::Overlapping ? Next::Stop : Next::Answered;
  };
  traverse(b_in_a, rule, judge, [](double) { return true; });
  return found;
}

/// From the front down, the least lower bound first. `worth` says whether a bound is low enough to go on.
template <class Judge, class Worth>
void Pair::traverse(const Pose& b_in_a, MarchRule& rule, Judge judge, Worth worth) {
  struct Open {
    double lower;
    std::uint32_t item;
    bool split_a;
    bool operator<(const Open& other) const { return lower > other.lower; }
  };
  std::priority_queue<Open> open;
  pose_ = b_in_a;
  if (!settings_.front) items_.clear(), spare_.clear();
  if (items_.empty()) items_.push_back({a_.root(), b_.root(), fresh_start(a_.root(), b_.root())});

  const auto take = [&](std::uint32_t item, double floor) {
    rule.floor = floor;
    const MarchResult r = visit(items_[item], rule);
    const Next next = judge(items_[item], r);
    items_[item].close = next == Next::Answered || next == Next::Stop;
    if (next == Next::Split) open.push({r.lower, item, splits_a(items_[item], r)});
    return next != Next::Stop;
  };
  bool going = true;
  for (const std::uint32_t item : front()) {
    going = take(item, 0);
    if (!going) break;
  }
  while (going && !open.empty() && worth(open.top().lower)) {
    const Open next = open.top();
    open.pop();
    const std::uint32_t child = split(next.item, next.split_a);
    going = take(child, next.lower) && take(child + 1, next.lower);
  }
  if (settings_.front) raise_front();
}

MarchResult Pair::visit(Item& item, MarchRule rule) {
  rule.step_budget = settings_.step_budget;
  MarchResult r;
  do {
    r = march(a_.nodes[item.a].view, b_.nodes[item.b].view, pose_, item.start, rule);
    item.start = {r.a, r.b};
    item.lower = rule.floor = r.lower;
    work_.steps += r.steps;
    rule.step_budget *= 2;  // a circle is known by its length: by as few steps again it would not be
  } while (r.status == MarchStatus::Budget);
  ++work_.pairs;
  return r;
}

/// Whether no pair of nodes below is nearer: the features in which the bodies are nearest, or meet, are in the bodies. A node
/// inside another has met nothing, and names no feature.
bool Pair::answers(const Item& item, const MarchResult& r) {
  switch (r.status) {
    case MarchStatus::Overlapping:
    case MarchStatus::Disjoint:
    case MarchStatus::Touching:
    case MarchStatus::Near:
      return is_leaf_pair(item) || (tag_of(a_.nodes[item.a], r.a) != Free && tag_of(b_.nodes[item.b], r.b) != Free);
    default: unanswered_ += is_leaf_pair(item); return is_leaf_pair(item);
  }
}

/// The node with the free feature is opened; where that does not decide, the larger one.
bool Pair::splits_a(const Item& item, const MarchResult& r) const {
  const Node &a = a_.nodes[item.a], &b = b_.nodes[item.b];
  if (a.is_leaf() || b.is_leaf()) return b.is_leaf();
  const bool free_a = tag_of(a, r.a) == Free, free_b = tag_of(b, r.b) == Free;
  return free_a != free_b ? free_a : a.model.radius() > b.model.radius();
}

/// Returns the first child.
std::uint32_t Pair::split(std::uint32_t item, bool split_a) {
  items_[item].close = true;
  const Item parent = items_[item];
  const Node& opened = split_a ? a_.nodes[parent.a] : b_.nodes[parent.b];

  std::uint32_t child = std::uint32_t(items_.size());
  if (spare_.empty()) {
    items_.resize(items_.size() + 2);
  } else {
    child = spare_.back();
    spare_.pop_back();
  }
  items_[item].child = child;
  for (std::size_t side = 0; side < 2; ++side) {
    Item& below = items_[child + side];
    below = parent;
    below.child = kNone;
    (split_a ? below.a : below.b) = opened.child[side];
    if (settings_.start == Start::Parent) {
      FeatureId& feature = split_a ? below.start.a : below.start.b;
      feature = from_parent(opened, feature, side);
    } else {
      below.start = fresh_start(below.a, below.b);
    }
  }
  return child;
}

MarchStart Pair::fresh_start(std::uint32_t a, std::uint32_t b) const {
  if (settings_.start != Start::Table) return {};
  const swiftlet::Model &model_a = a_.nodes[a].model, &model_b = b_.nodes[b].model;
  const Vec3 line = pose_.rotation * model_b.centre() + pose_.translation - model_a.centre();
  return {table_start(model_a, line), table_start(model_b, pose_.rotation.transpose() * -line)};
}

/// The pairs without children, nearest first as of the last query.
std::vector<std::uint32_t> Pair::front() const {
  std::vector<std::uint32_t> leaves, stack{0};
  while (!stack.empty()) {
    const std::uint32_t item = stack.back(), child = items_[item].child;
    stack.pop_back();
    if (child == kNone) {
      leaves.push_back(item);
    } else {
      stack.insert(stack.end(), {child, child + 1});
    }
  }
  std::ranges::sort(leaves, {}, [&](std::uint32_t item) { return items_[item].lower; });
  return leaves;
}

/// By one level where neither of two siblings was close.
void Pair::raise_front() {
  std::vector<std::uint32_t> stack{0}, raised;
  while (!stack.empty()) {
    const std::uint32_t item = stack.back(), child = items_[item].child;
    stack.pop_back();
    if (child == kNone) continue;
    const Item &left = items_[child], &right = items_[child + 1];
    if (left.child == kNone && right.child == kNone && !left.close && !right.close) raised.push_back(item);
    stack.insert(stack.end(), {child, child + 1});
  }
  for (const std::uint32_t item : raised) {
    spare_.push_back(items_[item].child);
    items_[item].child = kNone;
  }
}

}  // namespace hull_tree
