// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Algorithm 2 of [Ehmann & Lin 2001]: a pair of hulls is asked about, and its nearest features answer for it unless one of them
// is free; else one of the nodes is opened. What is left out is no nearer than the limit, as in descent.h: so the interval of
// an exact answer is that of the pairs that answered.
#include <swiftlet/hull_tree.h>

#include <algorithm>
#include <cmath>

#include "body/block.h"
#include "body/half_edge.h"
#include "mesh_setting.h"
#include "query/ask.h"
#include "solid.h"

namespace swiftlet {
namespace {

FaceClass class_of(const HullTree& tree, const HullNode& node, FeatureId feature) {
  const std::uint8_t* const classes = tree.hulls().classes.data() + node.classes;
  const HalfEdge* const half_edges = tree.hulls().half_edges.data() + node.half_edges.begin;
  const std::uint32_t i = feature.index();
  switch (feature.kind()) {
    case FeatureKind::Vertex: return FaceClass::Original;
    case FeatureKind::Face: return FaceClass(classes[i]);
    case FeatureKind::Edge: {
      const std::uint32_t left = half_edges[i].face, right = half_edges[half_edges[i].twin].face;
      return left == kNone ? FaceClass::Free : FaceClass(std::max(classes[left], classes[right]));
    }
    default: return FaceClass::Free;
  }
}

/// A vertex of a feature that the child has, or no feature.
FeatureId in_child(const HullTree& tree, const HullNode& parent, FeatureId feature, std::size_t side) {
  const HalfEdge* const half_edges = tree.hulls().half_edges.data() + parent.half_edges.begin;
  const std::uint32_t i = feature.index();
  const auto there = [&](std::uint32_t v) { return tree.hulls().in_child[parent.in_child + v][side]; };
  const auto start = [](std::uint32_t v) { return v == kNone ? FeatureId() : FeatureId(FeatureKind::Vertex, v); };
  switch (feature.kind()) {
    case FeatureKind::Vertex: return start(there(i));
    case FeatureKind::Edge: {
      const std::uint32_t head = there(half_edges[i].head);
      return start(head != kNone ? head : there(half_edges[half_edges[i].twin].head));
    }
    case FeatureKind::Face: {
      const ConvexView view = tree.hull(parent);
      for (const std::uint32_t v : FaceLoop(view, i)) {
        if (there(v) != kNone) return start(there(v));
      }
      return {};
    }
    default: return {};
  }
}

template <class T>
std::span<const T> part(const std::vector<T>& all, std::uint32_t begin, std::uint32_t count) {
  return {all.data() + begin, count};
}
template <class T>
std::span<const T> part(const std::vector<T>& all, HullRange range) {
  return part(all, range.begin, range.count);
}

ConvexView view_of(const HullArrays& arrays, const HullNode& node) {
  return {part(arrays.vertices, node.vertices),
          part(arrays.half_edges, node.half_edges),
          part(arrays.face_first, node.face_first),
          part(arrays.planes, node.planes),
          part(arrays.classes, node.classes, node.face_first.count),
          node.extent,
          node.centre,
          node.inner_radius,
          node.reach};
}

/// A node's hull as the atomic kernel reads it, while a query runs.
class Hull {
 public:
  Hull(const HullTree& tree, const HullNode& node)
      : level_(level_of(tree, node)), model_(BlockReader::lent(level_, node.radius)) {}
  Hull(const Hull&) = delete;  ///< `model_` points into this object
  Hull& operator=(const Hull&) = delete;
  Body body() const { return Body(model_); }

 private:
  static Level level_of(const HullTree& tree, const HullNode& node) {
    Level level;
    level.view = view_of(tree.hulls(), node);
    level.feature_count = feature_count(level.view);
    level.edge_length = node.edge_length, level.same_cos2 = node.same_cos2, level.near_cos2 = node.near_cos2;
    return level;
  }

  const Level level_;
  const Model model_;
};

template <class T>
std::size_t bytes_of(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

}  // namespace

HullTree::HullTree(MeshModel mesh, std::vector<std::uint32_t> triangles, HullArrays hulls)
    : mesh_(std::move(mesh)),
      triangles_(std::move(triangles)),
      hulls_(std::move(hulls)),
      is_solid_(mesh_.topology().closed()) {}

ConvexView HullTree::hull(const HullNode& node) const { return view_of(hulls_, node); }

std::size_t HullTree::bytes() const {
  std::size_t bytes = mesh_.bytes().size() + bytes_of(triangles_) + bytes_of(hulls_.nodes) + bytes_of(hulls_.vertices) +
                      bytes_of(hulls_.half_edges) + bytes_of(hulls_.face_first) + bytes_of(hulls_.planes) +
                      bytes_of(hulls_.classes) + bytes_of(hulls_.in_child);
  for (const MeshModel& surface : hulls_.surfaces) bytes += surface.bytes().size();
  return bytes;
}

/// What is asked, and what is known so far.
struct HullPair::Question {
  Question(const HullTree& a, const HullTree& b, const Pose& pose, const StopRule& rule)
      : stop(rule), at(a.body(), b.body(), pose), b_in_a(pose) {
    answer.answer.status = at.fault();
    set_limit();
  }

  /// Sets the bound from which on nothing matters. What rounding takes from it is within law 2's bound.
  void set_limit() {
    limit = kInfinity;
    if (upper < kInfinity)
      limit = max(upper - max(stop.absolute, kLeftOutShare * at.law_two), upper / (1 + stop.relative) * (1 - 4 * kU));
    if (stop.above < kInfinity) limit = min(limit, next_above(stop.above));
    limit = max(limit, std::numeric_limits<double>::denorm_min());
  }
  /// Contacts are all asked for, each at its own distance.
  double beyond() const { return every_contact ? stop.above : next_below(limit); }
  bool decided() const { return overlapping || upper < stop.below; }

  const StopRule stop;
  const MeshSetting at;
  const Pose& b_in_a;
  bool every_contact = false;
  double limit = kInfinity;
  double lower = kInfinity, upper = kInfinity;  ///< `lower` is of all that was left out or has answered
  bool overlapping = false;
  HullAnswer answer;
};

HullPair::HullPair(const HullTree& a, const HullTree& b, const HullSearch& search) : a_(a), b_(b), search_(search) {}

HullAnswer HullPair::intersects(const Pose& b_in_a) {
  Question question(a_, b_, b_in_a, {0, 0, 0, 0});
  search(question);
  HullAnswer result = conclude(question);
  decide(result.answer);
  return result;
}

Decision HullPair::within(const Pose& b_in_a, double threshold) {
  Question question(a_, b_, b_in_a, {0, 0, threshold, threshold});
  search(question);
  Within result{Decision::Undecided, conclude(question).answer};
  decide(result, threshold);
  return result.decision;
}

HullAnswer HullPair::distance(const Pose& b_in_a, double absolute, double relative, double beyond) {
  Question question(a_, b_, b_in_a, {allowed_error(absolute), allowed_error(relative), beyond});
  search(question);
  return conclude(question);
}

const std::vector<HullAnswer>& HullPair::contacts(const Pose& b_in_a, double reach) {
  contacts_.clear();
  if (std::isnan(reach)) return contacts_;
  Question question(a_, b_, b_in_a, {0, 0, reach});
  question.every_contact = true;
  search(question);
  if (question.overlapping) contacts_.assign(1, conclude(question));
  return contacts_;
}

std::size_t HullPair::front_size() const {
  if (!search_.front || items_.empty()) return 1;
  return (items_.size() - 2 * spare_.size() + 1) / 2;  // a binary tree has a leaf more than inner nodes
}

/// From the front down: the nearest pair next, or else depth first.
void HullPair::search(Question& question) {
  if (question.answer.answer.status != Status::Converged) return;
  if (!search_.front) items_.clear(), spare_.clear();
  if (items_.empty()) items_.push_back({0, 0, {}});
  queue_.clear(), stack_.clear();

  bool going = true;
  const bool has_cached = search_.piece_caching && cached_a_ != kNone && !question.every_contact;
  if (has_cached) {
    // Asked beside the tree of pairs, which it is part of or not.
    const std::uint32_t cached = std::uint32_t(items_.size());
    items_.push_back({cached_a_, cached_b_, cached_seed_});
    going = take(cached, 0, question) != Next::Stop;
    items_.pop_back();
  }
  collect_front();
  if (search_.priority) {
    for (const std::uint32_t item : front_) {
      if (!going) break;
      const Next next = take(item, 0, question);
      going = next != Next::Stop;
      if (next == Next::Split) queue_.push_back({items_[item].lower, item});
    }
    std::make_heap(queue_.begin(), queue_.end());
  } else {
    for (auto item = front_.rbegin(); item != front_.rend(); ++item) stack_.push_back({0, *item});
  }
  while (going) {
    if (!stack_.empty()) {
      const Open next = stack_.back();
      stack_.pop_back();
      const Next then = take(next.item, next.lower, question);
      going = then != Next::Stop;
      if (then != Next::Split) continue;
      const double floor = items_[next.item].lower;
      const std::uint32_t child = split(next.item);
      stack_.push_back({floor, child + 1}), stack_.push_back({floor, child});
      continue;
    }
    if (queue_.empty()) break;
    const Open next = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end());
    queue_.pop_back();
    if (!question.every_contact && next.lower >= question.limit) {
      question.lower = min(question.lower, next.lower);  // nor is any other that is queued nearer
      break;
    }
    const std::uint32_t child = split(next.item);
    for (const std::uint32_t item : {child, child + 1}) {
      if (!going) break;
      if (queue_.size() >= search_.most_queued) {
        stack_.push_back({next.lower, item});
        continue;
      }
      const Next then = take(item, next.lower, question);
      going = then != Next::Stop;
      if (then != Next::Split) continue;
      queue_.push_back({items_[item].lower, item});
      std::push_heap(queue_.begin(), queue_.end());
    }
  }
  if (!question.decided()) ask_inside(question);
  if (search_.front) raise_front();
}

/// Asks how far two nodes' hulls are and judges what comes of it.
HullPair::Next HullPair::take(std::uint32_t index, double floor, Question& question) {
  Item& item = items_[index];
  if (!question.every_contact && floor >= question.limit) {
    question.lower = min(question.lower, floor);
    return Next::Done;
  }
  if (!search_.features) item.seed = {};
  Options options;
  options.beyond = question.beyond();
  const Hull a(a_, a_.nodes()[item.a]), b(b_, b_.nodes()[item.b]);
  const Answer result = swiftlet::distance(a.body(), b.body(), question.b_in_a, item.seed, options);
  ++asked_, steps_ += result.steps;
  ++question.answer.answer.steps;
  item.lower = max(result.lower, floor);
  item.met = result.verdict == Verdict::Overlapping;
  return judge(item, result, question);
}

/// Whether no pair below is nearer: the features in which the hulls are nearest, or meet, are in the bodies.
HullPair::Next HullPair::judge(const Item& item, const Answer& r, Question& question) {
  if (r.status == Status::Beyond) {
    question.lower = min(question.lower, r.lower);
    return Next::Done;
  }
  const HullNode &a = a_.nodes()[item.a], &b = b_.nodes()[item.b];
  const bool pieces = a.is_piece() && b.is_piece();
  // Of hulls that overlap the features are where a walk ended.
  const bool has_features = r.verdict != Verdict::Overlapping && class_of(a_, a, r.feature_a) != FaceClass::Free &&
                            class_of(b_, b, r.feature_b) != FaceClass::Free;
  const bool answers = has_features || (pieces && a.is_filled() && b.is_filled());
  if (!pieces && (!answers || question.every_contact)) return Next::Split;
  if (!answers) return by_surfaces(item, question);

  question.lower = min(question.lower, r.lower);
  const bool nearer = r.upper < question.upper || (r.verdict == Verdict::Overlapping && !question.overlapping);
  if (!nearer && !question.every_contact) return Next::Done;
  HullAnswer found = question.answer;
  found.node_a = item.a, found.node_b = item.b;
  Answer& answer = found.answer;
  answer.feature_a = r.feature_a, answer.feature_b = r.feature_b;
  answer.lower = r.lower, answer.upper = r.upper;
  answer.point_a = r.point_a, answer.point_b = r.point_b, answer.normal = r.normal;
  if (r.verdict == Verdict::Overlapping) {
    question.overlapping = true, question.lower = question.upper = 0;
    answer.verdict = Verdict::Overlapping;
  } else {
    answer.verdict = r.lower > 0 ? Verdict::Disjoint : r.upper <= question.at.law_two ? Verdict::Touching : Verdict::Undecided;
  }
  if (question.every_contact) contacts_.push_back(found);
  if (nearer) {
    question.upper = question.overlapping ? 0 : r.upper;
    question.answer = found;
    cached_a_ = item.a, cached_b_ = item.b, cached_seed_ = item.seed;
    question.set_limit();
  }
  return question.decided() ? Next::Stop : Next::Done;
}

/// Of two pieces one of which is not all body, or not known to be: of that its triangles.
HullPair::Next HullPair::by_surfaces(const Item& item, Question& question) {
  const HullNode &a = a_.nodes()[item.a], &b = b_.nodes()[item.b];
  const Hull hull_a(a_, a), hull_b(b_, b);
  const auto body = [](const HullTree& tree, const HullNode& piece, const Hull& hull) {
    return piece.is_filled() ? MeshBody(hull.body()) : MeshBody(tree.hulls().surfaces[piece.surface]);
  };
  Options options;
  options.beyond = question.beyond();
  MeshSeed cold;
  const Answer found = swiftlet::distance(body(a_, a, hull_a), body(b_, b, hull_b), question.b_in_a, cold, options);
  question.answer.answer.plane_tests += found.plane_tests;
  question.lower = min(question.lower, found.lower);
  if (found.status == Status::Beyond || !(found.upper < kInfinity)) return Next::Done;
  HullAnswer here = question.answer;
  here.node_a = item.a, here.node_b = item.b;
  const std::uint32_t asked = question.answer.answer.steps, looked_at = question.answer.answer.plane_tests;
  here.answer = found, here.answer.steps = asked, here.answer.plane_tests = looked_at;
  here.answer.feature_a = here.answer.feature_b = FeatureId();  // they are of the pieces' surfaces
  if (question.every_contact) contacts_.push_back(here);
  if (found.verdict == Verdict::Overlapping) question.overlapping = true, question.lower = 0;
  if (found.upper < question.upper || question.overlapping) {
    question.upper = found.upper, question.answer = here;
    cached_a_ = item.a, cached_b_ = item.b, cached_seed_ = item.seed;
    question.set_limit();
  }
  return question.decided() ? Next::Stop : Next::Done;
}

/// Solids whose pieces are apart may still have one inside the other: pieces do not fill them.
void HullPair::ask_inside(Question& question) {
  const MeshSetting& at = question.at;
  if (!at.a.solid && !at.b.solid) return;
  MeshFinding found;
  found.lower = question.lower, found.upper = question.upper;
  if (!(found.lower > 0)) return;
  look_inside(at.a, at.b, question.b_in_a, {question.stop, at.law_two, at.size, ~std::uint32_t{0}}, found);
  if (found.verdict != Verdict::Overlapping) return;
  question.overlapping = true, question.lower = question.upper = 0;
  question.answer.node_a = question.answer.node_b = kNone;
  Answer& answer = question.answer.answer;
  answer.verdict = Verdict::Overlapping;
  answer.feature_a = answer.feature_b = FeatureId();
  answer.point_a = eigen(found.point_a), answer.point_b = eigen(found.point_b);
  answer.normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// The node with the free feature is opened; where that does not decide, the larger one. Returns the first child.
std::uint32_t HullPair::split(std::uint32_t index) {
  const std::uint32_t child = new_children();
  Item& item = items_[index];
  item.child = child, item.passing = !item.met;
  const HullNode &a = a_.nodes()[item.a], &b = b_.nodes()[item.b];
  bool of_a = b.is_piece();
  if (!a.is_piece() && !b.is_piece()) {
    const bool free_a = class_of(a_, a, item.seed.a) == FaceClass::Free,
               free_b = class_of(b_, b, item.seed.b) == FaceClass::Free;
    of_a = !item.met && free_a != free_b ? free_a : a.radius > b.radius;
  }
  const HullTree& tree = of_a ? a_ : b_;
  const HullNode& opened = of_a ? a : b;
  for (std::uint32_t side = 0; side < 2; ++side) {
    Item below{item.a, item.b, {}};
    (of_a ? below.a : below.b) = opened.child[side];
    if (search_.start == HullStart::Parent) {
      below.seed.a = item.seed.a, below.seed.b = item.seed.b;
      FeatureId& feature = of_a ? below.seed.a : below.seed.b;
      feature = in_child(tree, opened, feature, side);
    }
    items_[child + side] = below;
  }
  return child;
}

std::uint32_t HullPair::new_children() {
  if (spare_.empty()) {
    items_.resize(items_.size() + 2);
    return std::uint32_t(items_.size() - 2);
  }
  const std::uint32_t child = spare_.back();
  spare_.pop_back();
  return child;
}

/// Frees all that is below an item. What is freed is also what is still to be looked at: trees may be deep.
void HullPair::drop(std::uint32_t index) {
  const auto part = [&](Item& item) {
    if (item.child != kNone) spare_.push_back(item.child);
    item.child = kNone, item.passing = false;
  };
  std::size_t next = spare_.size();
  for (part(items_[index]); next < spare_.size(); ++next) {
    const std::uint32_t child = spare_[next];
    part(items_[child]), part(items_[child + 1]);
  }
}

/// The pairs without children, nearest first as of the last query.
void HullPair::collect_front() {
  front_.clear();
  walk_.assign(1, 0);
  while (!walk_.empty()) {
    const std::uint32_t item = walk_.back(), child = items_[item].child;
    walk_.pop_back();
    if (child == kNone) {
      front_.push_back(item);
    } else {
      walk_.push_back(child + 1), walk_.push_back(child);
    }
  }
  if (front_.size() > 1)
    std::sort(front_.begin(), front_.end(),
              [&](std::uint32_t x, std::uint32_t y) { return items_[x].lower < items_[y].lower; });
}

/// Pairs below one that did not meet were of this query alone. Two that have no children and did not meet are left out, unless
/// their parent was one of them: so the front rises by one level.
void HullPair::raise_front() {
  walk_.assign(1, 0);
  front_.clear();
  while (!walk_.empty()) {
    const std::uint32_t item = walk_.back(), child = items_[item].child;
    walk_.pop_back();
    if (child == kNone) continue;
    if (items_[item].passing) {
      drop(item);
      continue;
    }
    const Item &left = items_[child], &right = items_[child + 1];
    const auto idle = [](const Item& below) { return below.child == kNone && !below.met; };
    if (idle(left) && idle(right)) {
      front_.push_back(item);
    } else {
      walk_.push_back(child), walk_.push_back(child + 1);
    }
  }
  for (const std::uint32_t item : front_) items_[item].met = false, drop(item);
}

HullAnswer HullPair::conclude(const Question& question) const {
  HullAnswer result = question.answer;
  Answer& answer = result.answer;
  if (answer.status >= Status::InvalidPose) return result;
  answer.upper = question.upper;
  answer.lower = max(0, min(min(question.lower, question.limit), question.upper));
  if (question.overlapping) {
    answer.status = Status::Converged, answer.lower = answer.upper = 0;
    return result;
  }
  answer.verdict = answer.lower > 0                      ? Verdict::Disjoint
                   : answer.upper <= question.at.law_two ? Verdict::Touching
                                                         : Verdict::Undecided;
  const StopRule stop = question.stop.at_least(question.at.law_two);
  answer.status = stop.narrow(answer.lower, answer.upper) || answer.upper < stop.below ? Status::Converged
                  : answer.lower > stop.above                                          ? Status::Beyond
                                                                                       : Status::NotConverged;
  return result;
}

}  // namespace swiftlet
