// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Grows the tree from its root. The axes of a node are the principal axes of its surface [Gottschalk, Lin & Manocha 1996]. Its
// triangles are cut in two where both halves' boxes have the least area times triangles [Wald 2007, in bins], again and again,
// until there are eight groups or each is few enough for a node of triangles, of which few and full ones are made. A patch,
// where there are any, is cut off as if it were one large triangle [Ehmann & Lin 2001, sec. 5], and cut in its own node alone.
#include "tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "fit.h"

namespace swiftlet {
namespace {

/// Triangles of the soup, by their place in `Grower::order_`.
struct Range {
  enum class Place : std::uint8_t { Above, At, Below };  ///< where patches are, if any are below: At: all are of one patch

  std::uint32_t begin, end;
  Place place = Place::Above;
  std::uint32_t count() const { return end - begin; }
};

/// A triangle and its bounds along the axes of a node.
struct Item {
  Bounds box;
  std::uint32_t triangle;
  std::uint32_t patch;  ///< that is not to be cut, or kNone
  double place[3];      ///< twice the middle of the box of the triangle, or of the patch
  double middle(int axis) const { return place[axis]; }
};

/// Some of a node's triangles, by their places in `Grower::order_`, and the box around them.
struct Group {
  std::uint32_t begin, end;
  Bounds box;
  bool is_patch = false;   ///< all of them are the triangles of one patch
  bool has_patch = false;  ///< some of them are
  std::uint32_t count() const { return end - begin; }
  bool may_be_cut() const { return count() > kFanOut && !is_patch; }
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
/// Where eight nodes of triangles may hold all, each counts as so many triangles, and the largest group is cut: bench/TRIED.md.
constexpr std::uint32_t kTrianglesOfNode = 4;
/// Down to this depth patches are not cut. They may keep nodes from shrinking: then there are this many levels, two of cheapest
/// cuts and, of 2^22 triangles, seven of equal ones.
constexpr int kPatchDepth = 6;
constexpr std::size_t kMostWithPatches = 1 << 22;

class Grower {
 public:
  Grower(const Soup& soup, std::span<const std::uint32_t> patch_of, MeshParts& parts)
      : soup_(soup), patch_of_(patch_of), parts_(parts), order_(soup.triangles.size()) {
    if (order_.size() > kMostWithPatches) patch_of_ = {};
    std::iota(order_.begin(), order_.end(), 0u);
    Bounds box;
    for (const Vec& v : soup.vertices) box.add(v);
    parts.box_min = {box.least[0], box.least[1], box.least[2]}, parts.box_max = {box.most[0], box.most[1], box.most[2]};
    parts.unit = unit_of(max(max_abs(parts.box_min), max_abs(parts.box_max)));
    scaled_.reserve(soup.vertices.size());
    for (const Vec& v : soup.vertices) scaled_.push_back(scaled(v, -parts.unit));
  }

  bool grow(const std::function<bool(double)>& go_on) {
    const bool is_patch = !patch_of_.empty() && patch_of_[0] != kNone &&
                          std::ranges::all_of(patch_of_, [&](auto p) { return p == patch_of_[0]; });
    std::vector<Range> level{{0, std::uint32_t(order_.size()), is_patch ? Range::Place::At : Range::Place::Above}}, next;
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
        right[bin] = counted > 0 ? area(so_far) * weight(counted) : 0;
      }
      so_far = {}, counted = 0;
      for (int bin = 1; bin < kBins; ++bin) {
        so_far.add(box[bin - 1]), counted += count[bin - 1];
        if (counted == 0 || counted == group.count() || (!group.has_patch && !is_balanced(counted, group.count()))) continue;
        const double cost = area(so_far) * weight(counted) + right[bin];
        if (cost < best.cost) best = {cost, axis, middles.least[axis] + bin * width};
      }
    }
    return best;
  }

  std::uint32_t weight(std::uint32_t count) const {
    return of_few_ ? count + kTrianglesOfNode * ((count + kFanOut - 1) / kFanOut) : count;
  }
  static bool is_balanced(std::uint32_t part, std::uint32_t all) {
    return part * kLeastShare >= all && (all - part) * kLeastShare >= all;
  }

  /// Sets what is known of a group from its triangles.
  void survey(Group& group) const {
    group.box = {}, group.has_patch = false;
    const std::uint32_t first = items_[group.begin].patch;
    group.is_patch = first != kNone;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const Item& item = items_[i];
      group.box.add(item.box);
      group.has_patch = group.has_patch || item.patch != kNone, group.is_patch = group.is_patch && item.patch == first;
    }
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
    const bool is_cut =
        group.has_patch ? middle > group.begin && middle < group.end : is_balanced(middle - group.begin, group.count());
    if (!is_cut) {
      int axis = 0;
      for (int k = 1; k < 3; ++k) axis = group.box.side(k) > group.box.side(axis) ? k : axis;
      // No two are equal, so that halves are the same in every library, and so is their order.
      std::sort(items_.begin() + group.begin, items_.begin() + group.end, [axis](const Item& x, const Item& y) {
        return std::tuple(x.middle(axis), x.patch, x.triangle) < std::tuple(y.middle(axis), y.patch, y.triangle);
      });
      middle = group.begin + group.count() / 2;
      // Not within a patch: where that ends, or begins.
      const auto within = [&] { return items_[middle].patch != kNone && items_[middle].patch == items_[middle - 1].patch; };
      while (middle < group.end && within()) ++middle;
      if (middle == group.end) {
        middle = group.begin + group.count() / 2;
        while (within()) --middle;
      }
    }
    Group right{middle, group.end, {}};
    group.end = middle;
    survey(group), survey(right);
    return right;
  }

  /// Cuts a node's triangles into groups.
  void cut_all(Range range) {
    of_few_ = range.count() <= kFanOut * kFanOut;
    while (groups_.size() < kFanOut) {
      const auto size = [](const Group& x) { return x.may_be_cut() ? x.count() : 0; };
      const auto larger = [&](const Group& x, const Group& y) { return size(x) < size(y); };
      auto group = std::max_element(groups_.begin(), groups_.end(), larger);
      if (!group->may_be_cut()) return;
      const bool equal = parts_.depth >= kEqualDepth;
      if (!equal && !of_few_ && group->count() * kLargestShare <= range.count()) {
        const auto wider = [](const Group& x, const Group& y) {
          return x.may_be_cut() ? y.may_be_cut() && area(x.box) < area(y.box) : y.may_be_cut();
        };
        group = std::max_element(groups_.begin(), groups_.end(), wider);
      }
      const Group right = cut(*group, equal);
      groups_.insert(group + 1, right);
    }
  }

  /// Puts the triangles of each patch in a node's range where the patch is.
  void place_patches(Range range) {
    box_of_patch_.clear();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      Item& item = items_[i];
      item.patch = patch_of_[item.triangle];
      if (item.patch != kNone) box_of_patch_[item.patch].add(item.box);
    }
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      Item& item = items_[i];
      if (item.patch == kNone) continue;
      const Bounds& box = box_of_patch_[item.patch];
      for (int axis = 0; axis < 3; ++axis) item.place[axis] = box.least[axis] + box.most[axis];
    }
  }

  Node node(Range range, std::uint32_t first_child, std::vector<Range>& next) {
    Node n{};
    put_axes(axes(range), n);
    const Axes along = axes_of(n);

    items_.resize(order_.size());
    Bounds all;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      Item item{{}, order_[i], kNone, {}};
      for (std::size_t k = 0; k < 3; ++k) item.box.add(along.along(corner(order_[i], k)));
      for (int axis = 0; axis < 3; ++axis) item.place[axis] = item.box.least[axis] + item.box.most[axis];
      all.add(item.box), items_[i] = item;
    }
    if (!patch_of_.empty() && range.place == Range::Place::Above && parts_.depth < kPatchDepth) place_patches(range);
    groups_.clear();
    const bool lowest = range.count() <= kFanOut;
    if (lowest) {
      for (std::uint32_t i = range.begin; i < range.end; ++i) groups_.push_back({i, i + 1, items_[i].box});
      n.link = Node::link_of(range.begin, range.count(), true);
    } else {
      groups_.push_back({range.begin, range.end, all});
      survey(groups_[0]);
      cut_all(range);
      for (std::uint32_t i = range.begin; i < range.end; ++i) order_[i] = items_[i].triangle;
      for (const Group& group : groups_) {
        const auto place = range.place != Range::Place::Above ? Range::Place::Below
                           : group.is_patch                   ? Range::Place::At
                                                              : Range::Place::Above;
        next.push_back({group.begin, group.end, place});
      }
      n.link = Node::link_of(first_child, std::uint32_t(groups_.size()), false);
    }

    if (range.place == Range::Place::At) n.mark_patch();

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
  std::span<const std::uint32_t> patch_of_;  ///< per triangle; empty: there are none
  MeshParts& parts_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec> scaled_;
  std::vector<Item> items_;
  std::vector<Group> groups_;  ///< of the node at hand
  bool of_few_ = false;        ///< nodes of triangles may be all its children
  std::map<std::uint32_t, Bounds> box_of_patch_;
};

}  // namespace

bool grow_tree(const Soup& soup, std::span<const std::uint32_t> patch_of, MeshParts& parts,
               const std::function<bool(double fraction)>& go_on) {
  parts.topology = soup.topology;
  return Grower(soup, patch_of, parts).grow(go_on);
}

}  // namespace swiftlet
