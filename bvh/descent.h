// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way down two trees, nearest boxes first [Quinlan 1994]: pairs of nodes whose boxes are no nearer than the limit are left
// out, and pairs of triangles that are not are measured. The limit follows the least distance so far and the question, and all
// that was left out is no nearer than the last limit: so bounds in floats cost an exact answer nothing but time.
#pragma once

#include "node_pair.h"
#include "triangle_names.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

class Descent {
 public:
  Descent(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
          MeshFinding& finding)
      : a_(a),
        b_(b),
        pose_(b_in_a),
        motion_(motion(b_in_a)),
        question_(question),
        seed_(seed),
        finding_(finding),
        unit_(unit_of_pair(a.root->unit, b.root->unit, motion_.t)),
        has_hulls_(a.has_hull(0) && b.has_hull(0)),
        by_patches_(a.has_patches() && b.has_patches() && !(a.convex && b.convex)) {}

  void run() {
    set_limit();
    look_ahead();
    top_ = 0;
    if (seed_.triangle_a < a_.triangle_count && seed_.triangle_b < b_.triangle_count) {
      const Vec before = ahead_;
      const bool is_near = measure(seed_.triangle_a, seed_.triangle_b);
      if (done_) {
        lower_ = 0;  // of all else nothing is known
        return conclude();
      }
      // The seed's direction is of another pose if it no longer parts even its own triangles; so is that of the hulls.
      if (is_near && !(finding_.upper < HUGE_VAL)) {
        look(between_middles());
        hulls_wait_ = has_hulls_;
      }
      // Near contact the hulls of bodies that are nearly convex answer though their boxes meet, and from where they were cost
      // less than a pair of nodes or two. Those that met are not asked again.
      serves_ = dot(before, ahead_) > kSameAhead;
      // A distance without a bound takes far more than that from any start.
      const bool pays = question_.stop.above == HUGE_VAL || (!hulls_wait_ && serves_);
      if (has_hulls_ && pays && seed_.pair.met == 0) {
        roots_asked_ = true;
        if (part_by_hulls({0, 0, 0})) return conclude();
      }
    }
    if (by_patches_) start_at_patches();
    frame_.emplace(motion_, a_.root->unit, b_.root->unit, unit_, ahead_);
    stack_[top_++] = {0, 0, 0};
    while (top_ > 0 && !done_) {
      if (hulls_wait_ && finding_.nodes >= kHullsWait) {
        hulls_wait_ = false;
        if (root_boxes_apart_ && part_by_hulls({0, 0, 0})) top_ = 0;  // nothing below matters
        continue;
      }
      const PairEntry entry = stack_[--top_];
      if (double(entry.lower) >= limit_over_unit_) continue;
      if (spent()) {
        ++top_;  // it is still to do
        break;
      }
      open(entry);
    }
    conclude();
  }

 private:
  /// Hulls without a start of use cost as much as so many pairs of nodes, which answer many a threshold question.
  static constexpr std::uint32_t kHullsWait = 24;
  /// So many pairs of hulls are asked though those of the roots are not known to be apart: bench/COST.md.
  static constexpr int kHullsUnlessApart = 4;
  /// The cosine of the angle by which a seed's direction may turn and its hulls still begin where they were.
  static constexpr double kSameAhead = 0.95;

  /// The seed's pair is that of the hulls, or else of a triangle and a convex body.
  PairSeed& kernel_seed() { return has_hulls_ ? cold_ : seed_.pair; }

  /// Sets the bound from which on nothing matters. Bodies that touch may still overlap elsewhere: what is not apart is never
  /// left out.
  void set_limit() {
    const StopRule& stop = question_.stop;
    const double upper = finding_.upper;
    double limit = HUGE_VAL;
    if (upper < HUGE_VAL) {
      const double width = max(stop.absolute - stop.rounding, kLeftOutShare * question_.law_two);
      double by_width = upper - width;
      if (upper - by_width > width) by_width = next_above(by_width);  // it was rounded down
      double by_ratio = (upper - stop.zero) / (1 + stop.relative) * (1 + 8 * kU) + stop.zero + stop.rounding;
      if (stop.zero > 0) by_ratio = next_above(next_above(by_ratio));  // both sums were rounded
      limit = min(by_width, by_ratio);
    }
    if (stop.above < HUGE_VAL) limit = min(limit, next_above(stop.above));
    limit_ = max(limit, std::numeric_limits<double>::denorm_min());
    // Above 0, so that what is not apart is below it also where the quotient underflows.
    limit_over_unit_ =
        limit_ < HUGE_VAL ? max(times_power_of_two(limit_, -unit_), std::numeric_limits<double>::denorm_min()) : HUGE_VAL;
    limit_ahead_ = limit_ * (1 + kAheadOfItself) + kAheadError * question_.size;
    limit_of_boxes_ = limit_over_unit_ < 1e30 ? float(limit_over_unit_ * (1 + kFloatUp)) : HUGE_VALF;
  }

  /// The seventh axis before any pair is measured: the seed's, or else from the middle of A to that of B.
  void look_ahead() {
    Vec n{double(seed_.direction[0]), double(seed_.direction[1]), double(seed_.direction[2])};
    look(has_range(dot(n, n)) ? normalised(n) : between_middles());
  }
  Vec between_middles() const { return normalised(apply(motion_, b_.root->middle) - a_.root->middle); }
  void look(const Vec& n) {
    ahead_ = n, ahead_in_b_ = rotate_back(motion_, n), ahead_of_origin_ = dot(n, motion_.t);
    if (frame_) frame_->look(n);
  }

  bool spent() const { return finding_.nodes + finding_.triangles >= question_.steps; }

  void open(const PairEntry& entry) {
    ++finding_.nodes;
    const Node &a = a_.nodes[entry.a], &b = b_.nodes[entry.b];
    NodePair pair(*frame_, a, b);
    const float most = pair.square_of(limit_of_boxes_), square = pair.square();
    if (!(square <= most)) return;
    const bool boxes_apart = pair.lower(square) > 0;
    const bool of_roots = entry.a == 0 && entry.b == 0;
    if (of_roots) root_boxes_apart_ = boxes_apart, roots_apart_ = boxes_apart && hulls_apart_;
    const Patches patches = by_patches_ ? patches_at(entry) : Patches::Elsewhere;
    if (patches == Patches::Parted) return;
    const bool at_patches = patches == Patches::Both;
    const bool asks = (boxes_apart || (at_patches && question_.stop.above > 0)) && !hulls_wait_ && !(of_roots && roots_asked_);
    if (asks && a_.has_hull(entry.a) && b_.has_hull(entry.b) && part_by_hulls(entry, at_patches)) return;
    // A patch is kept whole until the other node is one.
    const std::array<bool, 2> ends{patches == Patches::KeepA || (a_.ends(a) && patches != Patches::KeepB),
                                   patches == Patches::KeepB || (b_.ends(b) && patches != Patches::KeepA)};
    const int bottom = top_;
    top_ += open_pair(pair, most, HUGE_VAL, {entry.a, entry.b}, ends, stack_ + top_);
    if (!(ends[0] && ends[1])) return;
    const bool whole = a_.triangle_count > 0 && b_.triangle_count > 0;
    while (top_ > bottom && !done_ && !spent()) {
      const PairEntry next = stack_[--top_];
      if (double(next.lower) >= limit_over_unit_) continue;
      whole ? void(measure(next.a, next.b)) : bound(entry, next);
    }
  }

  /// What nodes are as to patches: both are of one, and unasked; asked, and nothing below matters; or one alone is of one.
  enum class Patches : std::uint8_t { Elsewhere, Both, Parted, KeepA, KeepB };
  [[gnu::noinline]] Patches patches_at(const PairEntry& entry) const {
    const PatchPlace of_a = a_.patch_place(entry.a), of_b = b_.patch_place(entry.b);
    if (of_a == PatchPlace::At && of_b == PatchPlace::At) {
      if (entry.a != patch_a_ || entry.b != patch_b_) return Patches::Both;
      return patches_parted_ ? Patches::Parted : Patches::Elsewhere;
    }
    if (of_a == PatchPlace::At && of_b == PatchPlace::Above) return Patches::KeepA;
    return of_a == PatchPlace::Above && of_b == PatchPlace::At ? Patches::KeepB : Patches::Elsewhere;
  }

  /// Where a tree ends: a triangle or a convex body or, of a mesh that was cut, a ball around a box.
  struct End {
    Body body;
    double radius;
  };
  End end_of(const MeshView& of, std::uint32_t node, std::uint32_t child) const {
    if (of.triangle_count > 0) return {body_of(of, child), 0};
    const Node& n = of.nodes[node];
    const std::uint32_t k = child - n.first();
    float third[3];
    third_axis(n.axis, third);
    const float* const rows[3] = {n.axis[0], n.axis[1], third};
    const auto axis = [&](int l) { return Vec{rows[l][0], rows[l][1], rows[l][2]}; };
    Vec off{0, 0, 0};  // from the origin; what the axes lack of right angles is mended once
    for (int times = 0; times < 2; ++times) {
      const Vec before = off;
      for (int l = 0; l < 3; ++l) off = off + axis(l) * (double(n.centre[l][k]) - dot(axis(l), before));
    }
    Vec centre = Vec{n.origin[0], n.origin[1], n.origin[2]} + off;
    // So little is no legal coordinate of a point, and within the error.
    for (double* x : {&centre.x, &centre.y, &centre.z}) *x = std::fabs(*x) < kMiddleError / 8 ? 0 : *x;
    const double radius = norm(Vec{n.half[0][k], n.half[1][k], n.half[2][k]}) * (1 + 4 * kAxisError) + kMiddleError;
    return {Body::point(eigen(scaled(centre, of.root->unit))), times_power_of_two(radius, of.root->unit)};
  }

  /// Bounds the distance of what two boxes of a mesh that was cut hold: each holds a point of its surface.
  [[gnu::noinline]] void bound(const PairEntry& nodes, const PairEntry& children) {
    ++finding_.triangles;
    const End a = end_of(a_, nodes.a, children.a), b = end_of(b_, nodes.b, children.b);
    const Answer answer = distance(a.body, b.body, pose_, kernel_seed());
    if (answer.status >= Status::InvalidPose) {
      finding_.refused = done_ = true;
      return;
    }
    const double slack = a.radius + b.radius;
    const double nearer_boxes = times_power_of_two(double(children.lower), unit_);
    lower_ = min(lower_, max(nearer_boxes, answer.lower - slack - kEndError * (answer.lower + slack)));
    const double upper = answer.upper + slack + kEndError * (answer.upper + slack);
    if (!(upper < finding_.upper)) return;
    finding_.point_a = vec(answer.point_a), finding_.point_b = vec(answer.point_b);
    finding_.feature_a = finding_.feature_b = FeatureId();
    nearer(kNone, kNone, answer.verdict == Verdict::Disjoint ? vec(answer.normal) : Vec{0, 0, 0}, upper);
  }

  /// Asks for the distance of the hulls of two nodes, whose boxes are apart, and tries the triangles at their nearest points.
  /// True if nothing else in the nodes matters. Where the roots' hulls were not found apart few of those below are asked:
  /// of bodies that interlock they part little that boxes do not part as soon.
  [[gnu::noinline]] bool part_by_hulls(const PairEntry& entry, bool at_patches = false) {
    const bool of_roots = entry.a == 0 && entry.b == 0;
    if (!of_roots && !at_patches && !roots_apart_ && hulls_left_-- <= 0) return false;
    PairSeed own = warm_;
    warm_ = {};
    PairSeed& seed = of_roots ? seed_.pair : own;
    Options options;
    options.beyond = limit_;
    const Answer answer = distance(a_.hull(entry.a), b_.hull(entry.b), pose_, seed, options);
    if (!(answer.lower > 0)) return false;
    hulls_apart_ = hulls_apart_ || of_roots, roots_apart_ = roots_apart_ || (of_roots && root_boxes_apart_);
    if (answer.lower >= limit_) return true;
    const bool on_hulls = answer.feature_a.kind() != FeatureKind::None && answer.feature_b.kind() != FeatureKind::None;
    if (on_hulls && answer.level_a == 0 && answer.level_b == 0) {
      const Vec p_b = rotate_back(motion_, vec(answer.point_b) - motion_.t);
      const std::uint32_t of_a = a_.triangle_at(entry.a, answer.feature_a, vec(answer.point_a)),
                          of_b = b_.triangle_at(entry.b, answer.feature_b, p_b);
      if (of_a < a_.triangle_count && of_b < b_.triangle_count) measure(of_a, of_b);
      const bool nearest = finding_.triangle_a == of_a && finding_.triangle_b == of_b;
      if (at_patches && nearest) seed_.patches = {own.a, own.b, own.line_in_a, own.line_in_b, own.normal};
    }
    if (done_ || answer.lower >= limit_) return true;
    if (!(finding_.upper - answer.lower <= question_.law_two)) return false;
    // As near as rounding tells, the nearest points of the hulls are of the surfaces.
    lower_ = min(lower_, answer.lower);
    return true;
  }

  /// Asks first about the patches that hold the seed's triangles.
  void start_at_patches() {
    if (done_ || !serves_) return;
    patch_a_ = a_.patch_with(seed_.triangle_a), patch_b_ = b_.patch_with(seed_.triangle_b);
    if (patch_a_ == kNone || patch_b_ == kNone || (patch_a_ == 0 && patch_b_ == 0)) {
      patch_a_ = kNone;
      return;
    }
    const MeshSeed::Patches& last = seed_.patches;
    warm_.a = last.a, warm_.b = last.b;
    warm_.line_in_a = last.line_in_a, warm_.line_in_b = last.line_in_b, warm_.normal = last.normal;
    patches_parted_ = part_by_hulls({patch_a_, patch_b_, 0}, true);
  }

  /// The gap of two triangles along the seventh axis, not yet less its error.
  double gap_ahead(std::uint32_t of_a, std::uint32_t of_b) const {
    const auto along = [](const MeshView& of, std::uint32_t triangle, const Vec& n, int k) {
      return dot(n, of.vertices[of.triangles[triangle].data()[k]]);
    };
    const double top = max(max(along(a_, of_a, ahead_, 0), along(a_, of_a, ahead_, 1)), along(a_, of_a, ahead_, 2));
    const double bottom =
        min(min(along(b_, of_b, ahead_in_b_, 0), along(b_, of_b, ahead_in_b_, 1)), along(b_, of_b, ahead_in_b_, 2));
    return bottom + (ahead_of_origin_ - top);
  }

  /// Bounds the distance of two triangles, or of a triangle and a convex body. True if the seventh axis did not part triangles.
  bool measure(std::uint32_t of_a, std::uint32_t of_b) {
    ++finding_.triangles;
    if (!a_.triangles || !b_.triangles) {
      ask_kernel(of_a, of_b);
      return false;
    }
    const bool is_near = gap_ahead(of_a, of_b) < limit_ahead_;
    if (is_near) measure_near(of_a, of_b);
    return is_near;
  }
  [[gnu::noinline]] void measure_near(std::uint32_t of_a, std::uint32_t of_b) {
    Vec a[3], b[3];
    corners(a_, of_a, a), corners(b_, of_b, b);
    const TrianglePair pair(a, b, motion_, question_.size);
    const double ahead = pair.gap(ahead_);
    if (ahead >= limit_) return;
    // Where the bodies touch already, a pair that a direction parts up to law 2's bound touches at most.
    if (finding_.upper <= question_.law_two && (ahead >= -question_.law_two || pair.faces_part(question_.law_two))) {
      lower_ = 0;
      return;
    }
    const StopRule& stop = question_.stop;
    if (const double corners_apart = pair.upper(pair.way()); corners_apart < stop.below) {
      const PartId corner{Part::Corner, 0};
      lower_ = min(lower_, ahead);
      return nearer(of_a, of_b, a[0], {{0, 0, 0}, pair.way(), {0, 0, 0}, corner, corner}, normalised(pair.way()),
                    corners_apart);
    }
    // What asks for contact alone is mostly answered by triangles that cross, and else by nearest points.
    Vec met;
    const auto crossing = [&] {
      if (!pair.cross_deeper(question_.law_two, met)) return false;
      finding_.sure = true;
      overlapping(of_a, of_b, met + a[0], met + a[0]);
      return true;
    };
    if (stop.above <= 0 && crossing()) return;
    if (pair.gap(normalised(pair.between_middles())) >= (stop.is_threshold() ? limit_ : finding_.upper)) return;
    const auto [points, lower, upper, n] = pair.measured(question_.law_two);
    if (lower > 0 && (upper - lower <= question_.law_two || lower >= limit_)) {
      lower_ = min(lower_, lower);
      if (upper < finding_.upper) nearer(of_a, of_b, a[0], points, n, upper);
      return;
    }
    if (stop.above <= 0 || !crossing()) ask_kernel(of_a, of_b);
  }

  /// Leaves it to the atomic kernel, which decides signs exactly.
  [[gnu::noinline]] void ask_kernel(std::uint32_t of_a, std::uint32_t of_b) {
    const Body a = body_of(a_, of_a), b = body_of(b_, of_b);
    const StopRule& stop = question_.stop;
    const bool loose = stop.zero == 0 && max(stop.absolute, stop.relative) > 0;
    ClosestFeatures closest;
    if (loose) {
      closest.answer = distance(a, b, pose_, kernel_seed(), {stop.absolute, stop.relative, limit_, {}, {}});
    } else {
      ClosestOptions options;
      options.beyond = limit_;
      closest = closest_features(a, b, pose_, kernel_seed(), options);
    }
    const Answer& answer = closest.answer;
    if (answer.status >= Status::InvalidPose) {
      finding_.refused = done_ = true;
      return;
    }
    if (answer.verdict == Verdict::Overlapping) return overlapping(of_a, of_b, vec(answer.point_a), vec(answer.point_b));
    lower_ = min(lower_, answer.lower);
    if (!(answer.upper < finding_.upper) || answer.status == Status::Beyond) return;
    finding_.point_a = vec(answer.point_a), finding_.point_b = vec(answer.point_b);
    name(a_, of_a, closest.source_a, answer.feature_a, finding_.feature_a);
    name(b_, of_b, closest.source_b, answer.feature_b, finding_.feature_b);
    finding_.level_a = a_.triangles ? 0 : answer.level_a, finding_.level_b = b_.triangles ? 0 : answer.level_b;
    const Vec n = vec(answer.normal);
    nearer(of_a, of_b, dot(n, n) > 0 ? n : Vec{0, 0, 0}, answer.upper);
  }

  /// The pair is nearer than any before: its points and features are stored.
  void nearer(std::uint32_t of_a, std::uint32_t of_b, const Vec& origin, const NearestPoints& points, const Vec& n,
              double upper) {
    finding_.point_a = points.a + origin, finding_.point_b = finding_.point_a + points.way;
    name(a_, of_a, points.on_a, finding_.feature_a), name(b_, of_b, points.on_b, finding_.feature_b);
    finding_.level_a = finding_.level_b = 0;
    nearer(of_a, of_b, n, upper);
  }
  void nearer(std::uint32_t of_a, std::uint32_t of_b, const Vec& n, double upper) {
    finding_.upper = upper, finding_.normal = n;
    finding_.triangle_a = of_a, finding_.triangle_b = of_b;
    done_ = upper < question_.stop.below;
    if (!done_) set_limit();
    if (dot(n, n) > 0) look(n);
  }
  void overlapping(std::uint32_t of_a, std::uint32_t of_b, const Vec& point_a, const Vec& point_b) {
    finding_.verdict = Verdict::Overlapping;
    finding_.upper = lower_ = 0;
    finding_.point_a = point_a, finding_.point_b = point_b, finding_.normal = {0, 0, 0};
    finding_.feature_a = whole(a_, of_a), finding_.feature_b = whole(b_, of_b);
    finding_.triangle_a = of_a, finding_.triangle_b = of_b;
    done_ = true;
  }

  void conclude() {
    double lower = min(limit_, lower_);
    for (int i = 0; i < top_; ++i) lower = min(lower, times_power_of_two(double(stack_[i].lower), unit_));
    finding_.lower = finding_.verdict == Verdict::Overlapping ? 0 : max(0, min(lower, finding_.upper));
    finding_.cut_short = top_ > 0 && !done_;
    if (finding_.triangle_a != kNone) seed_.triangle_a = finding_.triangle_a, seed_.triangle_b = finding_.triangle_b;
    float* const direction = seed_.direction.data();
    direction[0] = float(ahead_.x), direction[1] = float(ahead_.y), direction[2] = float(ahead_.z);
  }

  const MeshView &a_, &b_;
  const Pose& pose_;
  const Motion motion_;
  const MeshQuestion& question_;
  MeshSeed& seed_;
  MeshFinding& finding_;
  const int unit_;                                ///< exponent of the pair's unit
  std::optional<PairFrame> frame_;                ///< from the first pair of nodes on
  Vec ahead_{}, ahead_in_b_{};                    ///< a unit direction from A to B, and R^T times it
  double ahead_of_origin_ = 0;                    ///< how far B's origin is along it
  double limit_ = 0, lower_ = HUGE_VAL;           ///< `lower_` is the least bound of a measured pair
  double limit_over_unit_ = 0, limit_ahead_ = 0;  ///< for `gap_ahead`
  float limit_of_boxes_ = 0;                      ///< the same, rounded up
  bool done_ = false;
  int hulls_left_ = kHullsUnlessApart;
  bool hulls_wait_ = false;  ///< until `kHullsWait` pairs of nodes were opened
  bool root_boxes_apart_ = false;
  bool roots_apart_ = false;                         ///< their hulls are
  bool hulls_apart_ = false;                         ///< the roots' hulls, whether their boxes are or not
  bool roots_asked_ = false;                         ///< about their hulls
  const bool has_hulls_;                             ///< the roots
  const bool by_patches_;                            ///< both bodies have some; of a convex body it is the body
  bool serves_ = false;                              ///< the seed's direction has hardly turned
  bool patches_parted_ = false;                      ///< nothing else in the seed's patches matters
  std::uint32_t patch_a_ = kNone, patch_b_ = kNone;  ///< the seed's patches, if they were asked about
  PairSeed warm_{}, cold_{};                         ///< for the next pair of hulls; for the kernel's pairs beside hulls
  int top_ = 0;
  PairEntry stack_[kMostEntries];
};

}  // namespace
}  // namespace swiftlet
