// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way down two trees, nearest boxes first [Quinlan 1994]: pairs of nodes whose boxes are no nearer than the limit are left
// out, and pairs of triangles that are not are measured. The limit follows the least distance so far and the question, and all
// that was left out is no nearer than the last limit: so bounds in floats cost an exact answer nothing but time.
//
// With a front the way begins where the last search's ended. All pairs of triangles are below the front's own, always: a pair
// leaves it only when those that it was opened into are there, and one that was never looked at has no bound.
#pragma once

#include "pair_bounds.h"
#include "triangle_names.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

/// A search; `kFront`: from a front, which it writes.
template <bool kFront>
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
    if constexpr (kFront)
      start_at_front();
    else
      start_at(0, 0, 0, kNoPlace);
    conclude();
  }

 private:
  /// Hulls without a start of use cost as much as so many pairs of nodes, which answer many a threshold question.
  static constexpr std::uint32_t kHullsWait = 24;
  /// So many pairs of hulls are asked though those of the roots are not known to be apart: bench/TRIED.md.
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

  // ---- The front ----

  using Front = FrontReader::State;
  FrontPlace place_of(int entry) const { return kFront ? places_[std::size_t(entry)] : kNoPlace; }

  /// Looks at the pairs of the front that may be near, those nearer than half the limit first; or begins it, or does without.
  void start_at_front() {
    Front& front = *question_.front;
    const Root& root_b = *b_.root;
    const Vec middle = scaled(root_b.middle, -unit_);
    middle_b_ = float4(float(middle.x), float(middle.y), float(middle.z));
    const double half = times_power_of_two(norm(root_b.half), -unit_);
    const bool uses = front.moves_to(motion_, unit_, scaled(apply(motion_, root_b.middle), -unit_), half);
    gone_ = float(front.gone), turned_ = float(front.turned);
    if (!uses || front.begins) {
      start_at(0, 0, 0, uses ? begin(float(half)) : kNoPlace);
    } else {
      look_again(find_near());
    }
    front.settle(uses, done_, finding_.nodes, finding_.triangles, asked_);
  }
  /// Puts the roots into an empty front.
  FrontPlace begin(float half_of_b) {
    Front& front = *question_.front;
    const std::uint32_t group = front.take({0, 0, FrontKind::NodesOfB, 1}, kArmOfNode * half_of_b * (1 + kBoundShare));
    FrontBounds& bounds = front.bounds[group] = {};
    for (float& h : bounds.h) h = -HUGE_VALF;
    bounds.h[0] = HUGE_VALF, front.end_of(group) = -HUGE_VALF;
    return kFanOut * group;
  }

  /// Finds the pairs whose bounds are no farther than the limit. Returns how many there are.
  std::uint32_t find_near() {
    Front& front = *question_.front;
    const Columns rotation = frame_->rotation;
    const Float4 translation = float4(frame_->translation);
    Float8 x[3], y[3], z[3], t[3];
    for (int k = 0; k < 3; ++k) {
      x[k] = all8(rotation.x[k]), y[k] = all8(rotation.y[k]), z[k] = all8(rotation.z[k]), t[k] = all8(translation[k]);
    }
    const Float8 turned = all8(turned_), limit = all8(limit_of_boxes_), past = all8(limit_of_boxes_ + gone_ + kFrontSlack);
    std::uint32_t count = 0;
    for (std::uint32_t first = 0; first < front.groups; first += kFanOut) {
      const Float8 left = load8(front.ends[first / kFanOut].of) - turned * load8(front.arms[first / kFanOut].of);
      for (unsigned ended = at_most(left, past); ended != 0; ended &= ended - 1) {
        const std::uint32_t group = first + std::uint32_t(__builtin_ctz(ended));
        if (group >= front.groups || front.ids[group].live == 0) continue;
        ++asked_;
        const FrontBounds& of = front.bounds[group];
        const Float8 c[3] = {load8(of.c[0]), load8(of.c[1]), load8(of.c[2])};
        Float8 bound = all8(0) - load8(of.h) - turned * load8(of.r);
        for (int k = 0; k < 3; ++k) bound = bound + load8(of.n[k]) * (x[k] * c[0] + y[k] * c[1] + z[k] * c[2] + t[k]);
        unsigned near = at_most(bound, limit) & front.ids[group].live;
        if (near == 0) {
          front.end_of(group) = least(bound) + gone_ + front.arm_of(group) * turned_;
          continue;
        }
        alignas(32) float bounds[kFanOut];
        store(bound, bounds);
        for (; near != 0; near &= near - 1) {
          const std::uint32_t i = std::uint32_t(__builtin_ctz(near));
          front.near[count++] = {bounds[i], group * kFanOut + i};
        }
      }
    }
    return count;
  }
  void look_again(std::uint32_t count) {
    const float soon = limit_of_boxes_ / 2;
    float left = HUGE_VALF;
    for (const bool soonest : {true, false}) {
      for (std::uint32_t k = 0; k < count; ++k) {
        const Front::Near near = question_.front->near[k];
        if ((near.bound <= soon) != soonest || double(near.bound) >= limit_over_unit_ || parted_) continue;
        if (done_ || spent())
          left = near.bound < left ? near.bound : left;
        else
          look_again(near);
      }
    }
    if (parted_ || !(left < HUGE_VALF)) return;
    lower_ = min(lower_, max(0, times_power_of_two(double(left), unit_)));
    cut_ = true;
  }
  void look_again(const Front::Near& near) {
    Front& front = *question_.front;
    const std::uint32_t group = near.place / kFanOut, i = near.place % kFanOut;
    const FrontIds ids = front.ids[group];
    const float lower = near.bound > 0 ? near.bound : 0;
    front.end_of(group) = -HUGE_VALF;  // next time it is asked whatever becomes of this pair
    switch (ids.kind) {
      case FrontKind::NodesOfB: return start_at(ids.a, ids.b + i, lower, near.place);
      case FrontKind::NodesOfA: return start_at(ids.a + i, ids.b, lower, near.place);
      case FrontKind::Rows: return open({ids.a, ids.b, lower}, near.place, 1u << i);
      case FrontKind::Triangles:
        measure(ids.a, ids.b + i);
        if (times_power_of_two(apart_, -unit_) > double(near.bound) + 2 * kFrontSlack) put_triangles(near.place, ids.b + i);
    }
  }

  /// Writes what was found of two nodes that were opened, and says where the pairs on the stack from `bottom` on belong. Where
  /// there is no room, the nodes stay, and what is below them is not written.
  void write(const PairEntry& entry, FrontPlace place, const NodePair& pair, const Opened& opened, bool lowest, unsigned rows,
             int bottom) {
    Front& front = *question_.front;
    const auto say = [&](auto place_of_pair) {
      for (int i = bottom; i < top_; ++i) places_[i] = place_of_pair(stack_[i]);
    };
    const bool both = !opened.only_a && !opened.only_b;
    const unsigned all_a = (1u << pair.a().count()) - 1, all_b = (1u << pair.b().count()) - 1;
    const unsigned parted = both ? all_a & rows & ~opened.rows : 0;
    const std::uint32_t groups = both ? std::uint32_t(parted != 0) + std::uint32_t(__builtin_popcount(opened.rows)) : 1;
    if (place == kNoPlace || front.room() < groups) return say([](const PairEntry&) { return kNoPlace; });
    const PairBounds bounds(*frame_, pair);
    const float arm = bounds.arm(middle_b_);
    const std::uint32_t first_a = pair.a().first(), first_b = pair.b().first();
    if (opened.only_a || parted != 0) {
      const FrontIds ids = lowest ? FrontIds{entry.a, entry.b, FrontKind::Rows, parted}
                                  : FrontIds{first_a, entry.b, FrontKind::NodesOfA, opened.only_a ? all_a : parted};
      const PairBounds::Balls balls = bounds.balls_of_all();
      const std::uint32_t group = put(ids, arm, bounds.of_a(balls), balls);
      if (opened.only_a) say([&](const PairEntry& child) { return kFanOut * group + (child.a - first_a); });
    }
    if (opened.only_b) {
      const PairBounds::Balls balls = bounds.balls_of_children();
      const std::uint32_t group = put({entry.a, first_b, FrontKind::NodesOfB, all_b}, arm, bounds.of_b(balls), balls);
      say([&](const PairEntry& child) { return kFanOut * group + (child.b - first_b); });
    } else if (both && opened.rows != 0) {
      const PairBounds::Balls balls = bounds.balls_of_children();
      std::uint32_t group_of[kFanOut];
      for (unsigned left = opened.rows; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const FrontKind kind = lowest ? FrontKind::Triangles : FrontKind::NodesOfB;
        group_of[i] = put({first_a + std::uint32_t(i), first_b, kind, all_b}, arm, bounds.of_b(balls, i), balls);
      }
      say([&](const PairEntry& child) { return kFanOut * group_of[child.a - first_a] + (child.b - first_b); });
    }
    front.drop(place);
  }
  /// Puts eight pairs into a new group, which it returns.
  std::uint32_t put(const FrontIds& ids, float arm, const PairBounds::Bounds& made, const PairBounds::Balls& balls) {
    Front& front = *question_.front;
    const std::uint32_t group = front.take(ids, arm);
    FrontBounds& to = front.bounds[group];
    for (int k = 0; k < 3; ++k) store(made.n[k], to.n[k]), store(balls.c[k], to.c[k]);
    store(balls.r, to.r);
    store(made.h - all8(turned_) * balls.r + all8(kFrontSlack), to.h);
    alignas(32) float gaps[kFanOut];
    store(made.gap, gaps);
    float nearest = HUGE_VALF;
    for (unsigned i = 0; i < kFanOut; ++i) {
      if ((ids.live >> i & 1) == 0) {
        to.h[i] = -HUGE_VALF;
      } else if (gaps[i] > 0) {
        nearest = gaps[i] < nearest ? gaps[i] : nearest;
      } else {
        to.h[i] = HUGE_VALF, nearest = -HUGE_VALF;
      }
    }
    front.end_of(group) = nearest - kFrontSlack + gone_ + arm * turned_;
    return group;
  }
  /// Puts a new bound to a pair, whose group is then asked next time.
  void put(FrontPlace place, const PairBound& made) {
    Front& front = *question_.front;
    FrontBounds& to = front.bounds[place / kFanOut];
    const std::uint32_t i = place % kFanOut;
    for (int k = 0; k < 3; ++k) to.n[k][i] = made.n[k], to.c[k][i] = made.c[k];
    to.r[i] = made.r, to.h[i] = made.h - turned_ * made.r + kFrontSlack;
    front.end_of(place / kFanOut) = -HUGE_VALF;
  }
  /// Puts what parted the triangles that were measured last.
  void put_triangles(FrontPlace place, std::uint32_t of_b) {
    Vec b[3];
    corners(b_, of_b, b);
    const Vec c = (b[0] + b[1] + b[2]) * (1.0 / 3);
    const double square = max(dot(b[0] - c, b[0] - c), max(dot(b[1] - c, b[1] - c), dot(b[2] - c, b[2] - c)));
    const double share = power_of_two(-unit_);
    const auto rounded = [](const Vec& v) { return float4(float(v.x), float(v.y), float(v.z)); };
    put(place, {rounded(across_), rounded(c * share), float((dot(across_, apply(motion_, c)) - apart_) * share),
                float(std::sqrt(square) * share) * (1 + kBoundShare)});
  }

  bool spent() const { return finding_.nodes + finding_.triangles >= question_.steps; }

  /// Goes down from a pair of nodes. It is that of a place in the front, or of kNoPlace.
  void start_at(std::uint32_t a, std::uint32_t b, float lower, FrontPlace place) {
    stack_[top_] = {a, b, lower};
    if constexpr (kFront) places_[top_] = place;
    ++top_;
    go_down();
  }
  void go_down() {
    while (top_ > 0 && !done_) {
      if (hulls_wait_ && finding_.nodes >= kHullsWait) {
        hulls_wait_ = false;
        if (root_boxes_apart_ && part_by_hulls({0, 0, 0})) top_ = 0, parted_ = true;  // nothing else matters
        continue;
      }
      const PairEntry entry = stack_[--top_];
      if (double(entry.lower) >= limit_over_unit_) continue;
      if (spent()) {
        ++top_;  // it is still to do
        break;
      }
      open(entry, place_of(top_));
    }
  }

  /// Opens two nodes; of the lowest ones only so many `rows` of pairs of triangles.
  void open(const PairEntry& entry, FrontPlace place, unsigned rows = ~0u) {
    ++finding_.nodes;
    const Node &a = a_.nodes[entry.a], &b = b_.nodes[entry.b];
    NodePair pair(*frame_, a, b);
    const float most = pair.square_of(limit_of_boxes_), square = pair.square();
    if (!(square <= most)) {
      if (kFront && place != kNoPlace) put(place, PairBounds(*frame_, pair).whole(square));
      return;
    }
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
    Opened opened;
    top_ += open_pair(pair, most, HUGE_VAL, {entry.a, entry.b}, ends, stack_ + top_, rows, kFront ? &opened : nullptr);
    const bool lowest = ends[0] && ends[1];
    if constexpr (kFront) write(entry, place, pair, opened, lowest, rows, bottom);
    if (!lowest) return;
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
    const Axes axes = axes_of(n);
    Vec off{0, 0, 0};  // from the origin; what the axes lack of right angles is mended once
    for (int times = 0; times < 2; ++times) {
      const Vec before = off;
      for (int l = 0; l < 3; ++l) off = off + axes.row[l] * (double(n.centre[l][k]) - dot(axes.row[l], before));
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
    const double ahead = gap_ahead(of_a, of_b);
    const bool is_near = ahead < limit_ahead_;
    if constexpr (kFront) across_ = ahead_, apart_ = ahead;
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
    if constexpr (kFront) across_ = n, apart_ = lower;
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
    finding_.cut_short = (top_ > 0 || cut_) && !done_;
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
  bool parted_ = false;                              ///< the roots' hulls are far enough from each other
  int top_ = 0;
  PairEntry stack_[kMostEntries];

  bool cut_ = false;                              ///< pairs of the front are still to do
  std::uint32_t asked_ = 0;                       ///< groups of the front
  float gone_ = 0, turned_ = 0;                   ///< as the front's
  Float4 middle_b_{};                             ///< of B's root, in B's frame, over the unit
  Vec across_{};                                  ///< a direction that parted the triangles that were measured last
  double apart_ = 0;                              ///< and how far; not above 0 if none did
  FrontPlace places_[kFront ? kMostEntries : 1];  ///< of the stack's entries in the front
};

/// Searches, with a front if the question has one that does not rest. Each search has a frame of its own on the stack: one with
/// a front needs more.
template <bool kFront>
[[gnu::noinline]] void search_from(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question,
                                   MeshSeed& seed, MeshFinding& finding) {
  Descent<kFront>(a, b, b_in_a, question, seed, finding).run();
}
void descend(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshSeed& seed,
             MeshFinding& finding) {
  const bool from_front = question.front && !question.front->rests();
  (from_front ? search_from<true> : search_from<false>)(a, b, b_in_a, question, seed, finding);
}

}  // namespace
}  // namespace swiftlet
