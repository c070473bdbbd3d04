// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hill climbing to the support vertex: each step goes to the highest vertex of a ring, compared in doubles or exactly.
#include "body/support.h"

#include "body/half_edge.h"
#include "numeric/exact.h"
#include "numeric/wide.h"

namespace swiftlet {
namespace {

/// Orders the vertices of one body exactly along a direction of the common frame: in doubles; in 106 bits where doubles cannot
/// tell, as for the corners of a face to which the direction is normal; by expansions where 106 bits cannot tell.
class Ordering {
 public:
  explicit Ordering(const Vec& n) : n_(n), own_(n), error_(kDotError * norm_1(n)) {}
  Ordering(const Vec& n, const Motion& motion)
      : n_(n), motion_(&motion), own_(rotate_back(motion, n)), error_(kTurnedSupportError * norm_1(n)) {}

  /// The sign of n . (w - v), where the pose, if there is one, has moved `w` and `v` into the common frame.
  int compare(const Vertex& w, const Vertex& v) {
    const Vec e = vec(w) - vec(v);
    const double value = dot(own_, e), bound = error_ * norm_1(e);
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return compare_ties(w, v, kWideDotError * norm_1(n_) * norm_1(e));
  }

 private:
  int compare_ties(const Vertex& w, const Vertex& v, double bound) {
    if (!has_wide_) {
      has_wide_ = true;
      wide_own_ = wide(n_);
      if (motion_)
        wide_own_ =
            wide(motion_->row_x) * wide_own_.x + wide(motion_->row_y) * wide_own_.y + wide(motion_->row_z) * wide_own_.z;
    }
    const Wide e{two_sum(w.x, -v.x), two_sum(w.y, -v.y), two_sum(w.z, -v.z)};
    const double value = double(dot(wide_own_, e));
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return motion_ ? exact::compare_along_turned(&n_.x, *motion_, &w.x, &v.x) : exact::compare_along(&n_.x, &w.x, &v.x);
  }

  const Vec n_;
  const Motion* const motion_ = nullptr;
  const Vec own_;  ///< n in the body's own frame, rounded
  const double error_;
  bool has_wide_ = false;
  Wide wide_own_;
};

std::uint32_t climb(const ConvexView& view, std::uint32_t start, Ordering order, std::uint32_t& plane_tests) {
  return climb(view, start, plane_tests, [&](const Vertex& w, const Vertex& best) { return order.compare(w, best) > 0; });
}

}  // namespace

std::uint32_t support(const ConvexView& view, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return climb(view, start, Ordering(n), plane_tests);
}
std::uint32_t support(const ConvexView& view, const Motion& in_common, const Vec& n, std::uint32_t start,
                      std::uint32_t& plane_tests) {
  return climb(view, start, Ordering(n, in_common), plane_tests);
}

std::uint32_t ascend(const ConvexView& view, const Vec& own, std::uint32_t start, std::uint32_t& plane_tests) {
  double most = dot(own, vec(view.vertices[start]));
  return climb(view, start, plane_tests, [&](const Vertex& w, const Vertex&) {
    const double height = dot(own, vec(w));
    return height > most ? most = height, true : false;
  });
}

}  // namespace swiftlet
