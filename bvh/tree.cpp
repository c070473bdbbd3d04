// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Grows the tree from its root. The axes of a node are the principal axes of its surface [Gottschalk, Lin & Manocha 1996]. Its
// triangles are cut in two where both halves' boxes have the least area times triangles [Wald 2007, in bins], again and again,
// until there are eight groups or each is few enough for a node of triangles.
#include "tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "fit.h"

namespace swiftlet {
namespace {

/// Triangles of the soup, by their place in `Grower::order_`.
struct Range {
  std::uint32_t begin, end;
  std::uint32_t count() const { return end - begin; }
};

/// A triangle and its bounds along the axes of a node.
struct Item {
  Bounds box;
  std::uint32_t triangle;
  double middle(int axis) const { return box.least[axis] + box.most[axis]; }  ///< twice the middle
};

/// Some of a node's triangles, by their places in `Grower::order_`, and the box around them.
struct Group {
  std::uint32_t begin, end;
  Bounds box;
  std::uint32_t count() const { return end - begin; }
};

double area(const Bounds& box) {
  const double x = box.side(0), y = box.side(1), z = box.side(2);
  return x * y + y * z + z * x;
}

constexpr int kBins = 16;
/// Each half has at least one in so many of the triangles, so that trees are not deep.
constexpr std::uint32_t kLeastShare = 8;
/// While a group has more than one in so many of a node's triangles, the largest one is cut, and from this depth on each
/// group into equal halves: a tree of `kMostTriangles` is then no deeper than `kMostDepth`. Seven cuts leave the largest group
/// at most (7/8)^7 of a node's triangles, and equal ones an eighth.
constexpr std::uint32_t kLargestShare = 4;
constexpr int kEqualDepth = 8;

class Grower {
 public:
  Grower(const Soup& soup, MeshParts& parts) : soup_(soup), parts_(parts), order_(soup.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    Bounds box;
    for (const Vec& v : soup.vertices) box.add(v);
    parts.box_min = {box.least[0], box.least[1], box.least[2]}, parts.box_max = {box.most[0], box.most[1], box.most[2]};
    parts.unit = unit_of(max(max_abs(parts.box_min), max_abs(parts.box_max)));
    scaled_.reserve(soup.vertices.size());
    for (const Vec& v : soup.vertices) scaled_.push_back(scaled(v, -parts.unit));
  }

  bool grow(const std::function<bool(double)>& go_on) {
    std::vector<Range> level{{0, std::uint32_t(order_.size())}}, next;
    std::size_t done = 0, asked = 0;
    const std::size_t all = order_.size();
    for (parts_.depth = 0; !level.empty(); ++parts_.depth) {
      next.clear();
      const std::size_t below = parts_.nodes.size() + level.size();
      for (const Range& range : level) {
        parts_.nodes.push_back(node(range, std::uint32_t(below + next.size()), next));
        done += range.count();
        if (done - asked < kItemsBetweenCalls) continue;
        asked = done;
        // A level more takes as long again, and there are about as many as eights in the count.
        if (!go_on(1 - 1 / (1 + double(done) / double(all)))) return false;
      }
      level.swap(next);
    }
    reorder();
    return true;
  }

 private:
  static constexpr std::size_t kItemsBetweenCalls = 1 << 13;

  Vec corner(std::uint32_t triangle, std::size_t k) const { return scaled_[soup_.triangles[triangle][k]]; }

  /// The principal axes of the triangles' surfaces, longest first; of triangles without area those of their corners.
  Axes axes(Range range) const {
    const auto moments = [&](bool by_area) {
      Vec mean{0, 0, 0};
      double weight = 0;
      Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
      const Vec origin = corner(order_[range.begin], 0);
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t t = order_[i];
        const Vec p[3] = {corner(t, 0) - origin, corner(t, 1) - origin, corner(t, 2) - origin};
        const double w = by_area ? norm(cross(p[1] - p[0], p[2] - p[0])) : 1;
        const Vec sum = p[0] + p[1] + p[2];
        // The integral of x x^T over a triangle: the sum over its corners and over their sum, a twelfth of twice its area.
        for (const Vec& v : {p[0], p[1], p[2], sum}) square += w / 12 * eigen(v) * eigen(v).transpose();
        mean = mean + sum * (w / 3);
        weight += w;
      }
      if (weight > 0) square -= eigen(mean) * eigen(mean).transpose() / weight;
      return square;
    };
    Eigen::Matrix3d square = moments(true);
    if (!(square.trace() > 0)) square = moments(false);
    return principal_axes(square);
  }

  /// The place of an axis where a group is cut: triangles whose middle is below it go left.
  struct Cut {
    double cost = HUGE_VAL;
    int axis = 0;
    double place = 0;
  };
  Cut cheapest_cut(const Group& group) const {
    Bounds middles;
    for (std::uint32_t i = group.begin; i < group.end; ++i)
      middles.add(Vec{items_[i].middle(0), items_[i].middle(1), items_[i].middle(2)});
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      const double width = middles.side(axis) / kBins;
      if (!(width > 0)) continue;
      Bounds box[kBins];
      std::uint32_t count[kBins] = {};
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const int bin = std::min(kBins - 1, int((items_[i].middle(axis) - middles.least[axis]) / width));
        box[bin].add(items_[i].box), ++count[bin];
      }
      double right[kBins];
      Bounds so_far;
      std::uint32_t counted = 0;
      for (int bin = kBins - 1; bin > 0; --bin) {
        so_far.add(box[bin]), counted += count[bin];
        right[bin] = counted > 0 ? area(so_far) * counted : 0;
      }
      so_far = {}, counted = 0;
      for (int bin = 1; bin < kBins; ++bin) {
        so_far.add(box[bin - 1]), counted += count[bin - 1];
        if (counted * kLeastShare < group.count() || (group.count() - counted) * kLeastShare < group.count()) continue;
        const double cost = area(so_far) * counted + right[bin];
        if (cost < best.cost) best = {cost, axis, middles.least[axis] + bin * width};
      }
    }
    return best;
  }

  /// Cuts a group in two; the first half takes its place.
  Group cut(Group& group, bool equal) {
    const Cut best = equal ? Cut() : cheapest_cut(group);
    std::uint32_t middle = group.begin;
    if (best.cost < HUGE_VAL) {
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        if (items_[i].middle(best.axis) < best.place) std::swap(items_[i], items_[middle++]);
      }
    }
    if ((middle - group.begin) * kLeastShare < group.count() || (group.end - middle) * kLeastShare < group.count()) {
      int axis = 0;
      for (int k = 1; k < 3; ++k) axis = group.box.side(k) > group.box.side(axis) ? k : axis;
      // No two are equal, so that halves are the same in every library, and so is their order.
      std::sort(items_.begin() + group.begin, items_.begin() + group.end, [axis](const Item& x, const Item& y) {
        return x.middle(axis) < y.middle(axis) || (x.middle(axis) == y.middle(axis) && x.triangle < y.triangle);
      });
      middle = group.begin + group.count() / 2;
    }
    Group right{middle, group.end, {}};
    group.end = middle, group.box = {};
    for (Group* half : {&group, &right}) {
      for (std::uint32_t i = half->begin; i < half->end; ++i) half->box.add(items_[i].box);
    }
    return right;
  }

  /// Cuts a node's triangles into groups.
  void cut_all(Range range) {
    while (groups_.size() < kFanOut) {
      const auto larger = [](const Group& x, const Group& y) { return x.count() < y.count(); };
      auto group = std::max_element(groups_.begin(), groups_.end(), larger);
      if (group->count() <= kFanOut) return;
      const bool equal = parts_.depth >= kEqualDepth;
      if (!equal && group->count() * kLargestShare <= range.count()) {
        const auto wider = [](const Group& x, const Group& y) {
          return x.count() > kFanOut ? y.count() > kFanOut && area(x.box) < area(y.box) : y.count() > kFanOut;
        };
        group = std::max_element(groups_.begin(), groups_.end(), wider);
      }
      const Group right = cut(*group, equal);
      groups_.insert(group + 1, right);
    }
  }

  Node node(Range range, std::uint32_t first_child, std::vector<Range>& next) {
    Node n{};
    put_axes(axes(range), n);
    const Axes along = axes_of(n);

    items_.resize(order_.size());
    Bounds all;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      Item item{{}, order_[i]};
      for (std::size_t k = 0; k < 3; ++k) item.box.add(along.along(corner(order_[i], k)));
      all.add(item.box), items_[i] = item;
    }
    groups_.clear();
    const bool lowest = range.count() <= kFanOut;
    if (lowest) {
      for (std::uint32_t i = range.begin; i < range.end; ++i) groups_.push_back({i, i + 1, items_[i].box});
      n.link = Node::link_of(range.begin, range.count(), true);
    } else {
      groups_.push_back({range.begin, range.end, all});
      cut_all(range);
      for (std::uint32_t i = range.begin; i < range.end; ++i) order_[i] = items_[i].triangle;
      for (const Group& group : groups_) next.push_back({group.begin, group.end});
      n.link = Node::link_of(first_child, std::uint32_t(groups_.size()), false);
    }

    Bounds boxes[kFanOut];
    for (std::size_t i = 0; i < groups_.size(); ++i) boxes[i] = groups_[i].box;
    put_boxes({boxes, groups_.size()}, along, n);
    return n;
  }

  /// Puts triangles into the tree's order, and vertices into the order in which these name them.
  void reorder() {
    std::vector<std::uint32_t> place(soup_.vertices.size(), kNone);
    parts_.triangles.reserve(order_.size());
    parts_.vertices.reserve(soup_.vertices.size());
    parts_.source_vertex.reserve(soup_.vertices.size());
    for (const std::uint32_t t : order_) {
      Corners corners = soup_.triangles[t];
      for (std::uint32_t& v : corners) {
        if (place[v] == kNone) {
          place[v] = std::uint32_t(parts_.vertices.size());
          parts_.vertices.push_back(soup_.vertices[v]);
          parts_.source_vertex.push_back(soup_.source[v]);
        }
        v = place[v];
      }
      parts_.triangles.push_back(corners);
    }
    std::vector<std::uint32_t> of(order_.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) of[order_[i]] = i;
    for (const std::uint32_t t : soup_.shells) parts_.shells.push_back(of[t]);
    parts_.source_triangle = std::move(order_);
  }

  const Soup& soup_;
  MeshParts& parts_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec> scaled_;
  std::vector<Item> items_;
  std::vector<Group> groups_;  ///< of the node at hand
};

}  // namespace

bool grow_tree(const Soup& soup, MeshParts& parts, const std::function<bool(double fraction)>& go_on) {
  parts.topology = soup.topology;
  return Grower(soup, parts).grow(go_on);
}

}  // namespace swiftlet
