// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Few of the corners that two contact faces have in common: the deepest, and those that keep most of the area.
#include <swiftlet/patch.h>

#include <algorithm>
#include <span>

#include "crossing.h"
#include "outline.h"
#include "overlay.h"
#include "ring.h"
#include "scene.h"
#include "seed.h"

namespace swiftlet {
namespace {

/// The corners of a common area and the witness.
class Candidates {
 public:
  Candidates(const Scene& scene, const Across& across, const Outline& a, const Outline& b, const Spot& witness, double bound)
      : bound_(bound) {
    count_ = overlay(scene, across, a, b, bound, std::span(all_).first<kMostSpots>());
    if (count_ == 0 || witness.separation < least() - bound) all_[std::size_t(count_++)] = witness;
  }

  /// Fills the patch's points: one of least separation, the one farthest from it, then whichever adds most to the area, those
  /// of the patch before first; then each but the first is chosen again beside the others, until all stay.
  void choose(std::uint32_t most, double margin, const Patch& previous, Patch& patch) {
    drop_beyond(margin + bound_);
    if (count_ == 0 || most == 0) return;
    recognise(previous);
    loop_[0] = deepest();
    size_ = 1;
    for (const Among those : {Among::Known, Among::All}) {
      while (size_ < int(most) && grow(those)) {
      }
    }
    int stayed = size_ < count_ ? 0 : size_;
    for (int i = 1, rest = kChoices * size_; stayed + 1 < size_ && rest > 0; --rest, i = i + 1 < size_ ? i + 1 : 1) {
      stayed = stays(i) ? stayed + 1 : 0;
    }
    for (int i = 0; i < size_; ++i) {
      const Spot& c = chosen(i);
      patch.points[std::size_t(i)] = {eigen(c.point_a), eigen(c.point_b), c.separation, c.feature_a, c.feature_b};
    }
    patch.count = std::uint32_t(size_);
  }

 private:
  enum class Among { Known, All };

  const Spot& at(int i) const { return all_[std::size_t(i)]; }
  const Spot& chosen(int i) const { return at(loop_[std::size_t(i)]); }

  double least() const {
    double least = all_[0].separation;
    for (int i = 1; i < count_; ++i) least = smaller(least, at(i).separation);
    return least;
  }

  void drop_beyond(double separation) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (at(i).separation <= separation) all_[std::size_t(kept++)] = at(i);
    }
    count_ = kept;
  }

  void recognise(const Patch& previous) {
    for (int i = 0; i < count_; ++i) {
      bool& known = known_[std::size_t(i)] = false;
      for (std::uint32_t k = 0; k < std::min(previous.count, kMostPatchPoints); ++k) {
        const PatchPoint& p = previous.points[k];
        known = known || (p.feature_a == at(i).feature_a && p.feature_b == at(i).feature_b);
      }
    }
  }

  int deepest() const {
    const double enough = least() + bound_;
    int found = -1;
    for (int i = 0; i < count_; ++i) {
      if (at(i).separation > enough) continue;
      if (found < 0 || (known_[std::size_t(i)] && !known_[std::size_t(found)])) found = i;
    }
    return found;
  }

  /// From one of the points chosen to the next.
  struct Side {
    double x, y, dx, dy, least2;  ///< the last: of an area that stands out, squared
  };
  Side side_at(int i) const {
    const Spot &p = chosen(i), &q = chosen(i + 1 == size_ ? 0 : i + 1);
    const double dx = q.x - p.x, dy = q.y - p.y;
    return {p.x, p.y, dx, dy, bound_ * bound_ * (dx * dx + dy * dy)};
  }

  /// How far a candidate lies from the only point, or the area that it adds beyond a side of those chosen; 0 where it hardly
  /// stands out. One of the patch before is worth more.
  double worth(int candidate, const Side& side) const {
    const Spot& c = at(candidate);
    const double cx = c.x - side.x, cy = c.y - side.y, more = known_[std::size_t(candidate)] ? 1 + kKeptWorth : 1;
    if (size_ == 1) {
      const double length2 = cx * cx + cy * cy;
      return length2 > bound_ * bound_ ? std::sqrt(length2) * more : 0;
    }
    const double area = cx * side.dy - cy * side.dx;
    return area > 0 && area * area > side.least2 ? area * more : 0;
  }

  /// Of faces seen from the side, which are no convex loops, one chosen may lie beyond a side.
  bool is_chosen(int i) const { return std::find(loop_.begin(), loop_.begin() + size_, i) != loop_.begin() + size_; }

  /// Adds a point to those chosen, which go around counter-clockwise; false where none adds anything.
  bool grow(Among those) {
    int best = -1, best_side = 0;
    double most = 0;
    for (int side = 0; side < size_; ++side) {
      const Side beyond = side_at(side);
      for (int i = 0; i < count_; ++i) {
        if (is_chosen(i) || (those == Among::Known && !known_[std::size_t(i)])) continue;
        if (const double w = worth(i, beyond); w > most) most = w, best = i, best_side = side;
      }
    }
    if (best < 0) return false;
    std::copy_backward(loop_.begin() + best_side + 1, loop_.begin() + size_, loop_.begin() + size_ + 1);
    loop_[std::size_t(best_side + 1)] = best;
    ++size_;
    return true;
  }

  /// Chooses one again.
  bool stays(int i) {
    const int before = loop_[std::size_t(i)];
    std::copy(loop_.begin() + i + 1, loop_.begin() + size_, loop_.begin() + i);
    --size_;
    return grow(Among::All) && loop_[std::size_t(i)] == before;
  }

  double bound_;
  int count_ = 0, size_ = 0;
  std::array<int, kMostPatchPoints> loop_;
  std::array<bool, kMostSpots + 1> known_;  ///< of the patch before
  std::array<Spot, kMostSpots + 1> all_;
};

/// What a patch grows from, in A's frame; the points are on the hulls.
struct Witness {
  Vec normal, point_a, point_b;
  Handle feature_a, feature_b;
};

/// The patch of two hulls, within a margin of theirs.
Patch grown(const Scene& scene, const Witness& w, double margin, double bound, const PatchOptions& options,
            const Patch& previous) {
  Patch patch;
  const Across across(w.normal, w.point_a);
  std::uint32_t tests = 0;
  const Handle at_a = feature_at_a(scene, w.feature_a, w.point_a, tests),
               at_b = feature_at_b(scene, w.feature_b, w.point_b, tests);
  Outline a, b;
  outline_a(scene, across, at_a, previous.face_a, options.flatness, a);
  outline_b(scene, across, at_b, previous.face_b, options.flatness, b);
  patch.normal = eigen(w.normal);
  if (a.face != kNone) patch.face_a = {FeatureKind::Face, a.face};
  if (b.face != kNone) patch.face_b = {FeatureKind::Face, b.face};

  const Spot witness = spot(across, w.point_a, w.point_b, named(scene.a, at_a), named(scene.b, at_b));
  Candidates candidates(scene, across, a, b, witness, bound);
  candidates.choose(std::min(options.most_points, kMostPatchPoints), margin, previous, patch);
  return patch;
}

bool exists(const Model& model, int level, Handle feature) {
  return level >= 0 && level < model.level_count() && names_feature(model.level(level).view, feature);
}

template <class AnyAnswer>
Patch around(const Model& a, const Model& b, const Pose& b_in_a, const AnyAnswer& answer, const PatchOptions& options,
             const Patch& previous) {
  const Vec n = vec(answer.normal);
  if (max_abs(n) == 0 || !exists(a, answer.level_a, answer.feature_a) || !exists(b, answer.level_b, answer.feature_b))
    return {};
  const Motion m = motion(b_in_a);
  const Scene hulls = scene(a.level(answer.level_a).view, b.level(answer.level_b).view, m, pose_quality(m).error);
  const double radii = options.radius_a + options.radius_b;
  Patch patch = grown(hulls,
                      {n, vec(answer.point_a) - n * options.radius_a, vec(answer.point_b) + n * options.radius_b,
                       answer.feature_a, answer.feature_b},
                      options.margin + radii, hulls.law_two + kLawTwo * radii, options, previous);
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    PatchPoint& p = patch.points[i];
    p.point_a = eigen(vec(p.point_a) + n * options.radius_a);
    p.point_b = eigen(vec(p.point_b) - n * options.radius_b);
    p.separation -= radii;
  }
  return patch;
}

}  // namespace

Patch patch(const Model& a, const Model& b, const Pose& b_in_a, const SignedAnswer& answer, const PatchOptions& options,
            const Patch& previous) {
  return around(a, b, b_in_a, answer, options, previous);
}

Patch patch(const Model& a, const Model& b, const Pose& b_in_a, const Answer& answer, const PatchOptions& options,
            const Patch& previous) {
  return answer.proof.count ? Patch{} : around(a, b, b_in_a, answer, options, previous);
}

}  // namespace swiftlet
