// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The manifold of a region: its normal, the pairs of triangles that face each other along it, and few of the points where they
// do.
#include <swiftlet/mesh_contacts.h>

#include <algorithm>

#include <swiftlet/depth.h>

#include "body/half_edge.h"
#include "body/support.h"
#include "facet.h"
#include "manifold/choice.h"
#include "manifold/contact_face.h"
#include "near_pairs.h"
#include "pair_axes.h"

namespace swiftlet {
namespace {

/// So many pairs that meet are kept while a normal is chosen, and so many directions are tried.
constexpr int kMostMet = 64, kMostTried = 40;
/// So often pairs that were not kept are looked for.
constexpr int kMostRounds = 8;
/// A contact face that leans more from the direction along which its body ends tells little of where that is.
constexpr double kLeastCosine = 0.5;

struct Ids {
  std::uint32_t a, b;
};

/// The region, as every step reads it.
struct RegionOf {
  const MeshSetting& at;
  const Pose& b_in_a;
  Box box;
  double slack = 0;  ///< what the noise of poses may move: by so much radii count as larger, and pairs meet that are apart

  double radii() const { return at.radii.sum() + slack; }
  /// Pairs that are no farther apart meet.
  double near() const { return at.law_two + slack; }
};

/// A convex body's vertices; a mesh has none.
class ConvexFace {
 public:
  /// `in_a` moves the body into A's frame, where directions and points are.
  ConvexFace(const MeshView& of, const Motion& in_a) : in_a_(in_a) {
    if (of.triangles) return;
    shape_.emplace(of.convex->body);
    level_ = &(**shape_).level((**shape_).finest_level()).view;
  }
  explicit operator bool() const { return level_ != nullptr; }
  std::size_t vertex_count() const { return level_->vertices.size(); }
  const ConvexView& view() const { return *level_; }
  Vec point(std::uint32_t vertex) const { return apply(in_a_, vec(level_->vertices[vertex])); }
  /// The vertex farthest along `n`.
  std::uint32_t support(const Vec& n) const {
    std::uint32_t tests = 0;
    return swiftlet::support(*level_, rotate_back(in_a_, n), 0, tests);
  }
  /// The contact face at that vertex.
  ContactFace contact_face(const Vec& n, FeatureId before = {}, double flatness = 0) const {
    return {*level_, rotate_back(in_a_, n), FeatureId(FeatureKind::Vertex, support(n)), before, flatness, 0};
  }
  Vec direction(const Vec& own) const { return rotate(in_a_, own); }

 private:
  const Motion& in_a_;
  std::optional<ShapeOf> shape_;
  const ConvexView* level_ = nullptr;
};

// ---- The normal of surfaces that meet --------------------------------------------------------------------------------------

/// A pair of triangles, or of a triangle and a convex body, that meets. The shortest way of B to be apart; known of a convex
/// body at once, and of two triangles by their axes.
struct Met {
  Ids ids;
  Vec least;
  double depth;  ///< negative if they are apart
};

/// How far B must go along a direction until pairs are apart, and so are all points within the radii of them: by the sum of the
/// radii, along the axis that parts them.
class Way {
 public:
  Way(const RegionOf& in, const ConvexFace& body_a, const ConvexFace& body_b) : in_(in), body_a_(body_a), body_b_(body_b) {}

  /// Looks along `n`, a unit direction, from now on.
  void turn(const Vec& n) {
    n_ = n;
    if (both_) return;
    const ConvexFace& body = body_a_ ? body_a_ : body_b_;
    const auto end = [&](const Vec& out) { return dot(out, body.point(body.support(out))); };
    out_ = body_a_ ? n : -n, face_ = body.direction(body.contact_face(out_).normal());
    const double cosine = dot(face_, out_);
    face_ = cosine > kLeastCosine ? face_ * (1 / cosine) : out_;
    body_end_ = end(out_), face_end_ = end(face_), norm_of_face_ = norm(face_);
  }
  /// How far both overlap along the direction, with their radii.
  double overlap(Ids ids) {
    read(ids);
    if (both_) return radii_ - TrianglePair(a_, b_, in_.at.motion, in_.at.size).gap(n_);
    return body_end_ - least_of_triangle(out_) + in_.at.law_two + radii_;
  }
  /// B need not go farther: their overlap; a triangle and a convex body are apart, too, where the triangle is above the plane
  /// of the body's contact face.
  double most_way(Ids ids) {
    const double most = overlap(ids);
    return both_ ? most : min(most, face_end_ - least_of_triangle(face_) + (in_.at.law_two + radii_) * norm_of_face_);
  }
  /// Fills all of `met` but its ids. Returns false if the pair, without radii, is farther apart than what meets.
  bool meets(Met& met) {
    read(met.ids);
    if (both_) {
      if (TrianglePair pair(a_, b_, in_.at.motion, in_.at.size); pair.gap(normalised(pair.between_middles())) > in_.near())
        return false;
      met.depth = axes_of(met.ids).least(met.least);
      return met.depth >= -in_.near();
    }
    const MeshView &a = in_.at.a, &b = in_.at.b;
    const Answer answer = signed_distance(body_of(a, met.ids.a), body_of(b, met.ids.b), in_.b_in_a, seed_);
    if (answer.status >= Status::InvalidPose || answer.normal.hasNaN() || answer.lower > in_.near()) return false;
    met.least = vec(answer.normal), met.depth = -answer.lower;
    return true;
  }
  /// How far B must go along the direction until the pair is apart.
  double way(const Met& met) {
    const double most = max(0, most_way(met.ids));
    if (both_) return min(most, axes_of(met.ids).travel(n_, radii_));
    const double slope = dot(met.least, n_);
    return slope > kLeastSlope ? min(most, (met.depth + radii_) / (slope - kSlopeError)) : most;
  }
  /// Unit normals of both triangles, of the pair that `meets` was last asked about; of a convex body the way's.
  Vec normal_a(const Met& met) const { return in_.at.a.triangles ? normal(a_, kAtRest) : met.least; }
  Vec normal_b(const Met& met) const { return in_.at.b.triangles ? normal(b_, in_.at.motion) : -met.least; }

 private:
  /// How far the triangle of a pair with a convex body reaches against a direction.
  double least_of_triangle(const Vec& along) const {
    if (body_b_) return min(min(dot(along, a_[0]), dot(along, a_[1])), dot(along, a_[2]));
    const auto at = [&](int k) { return dot(along, apply(in_.at.motion, b_[k])); };
    return min(min(at(0), at(1)), at(2));
  }
  /// Of the pair that was read last.
  const PairAxes& axes_of(Ids ids) {
    if (!axes_ || ids.a != of_axes_.a || ids.b != of_axes_.b) axes_.emplace(a_, b_, in_.at.motion, in_.at.size);
    of_axes_ = ids;
    return *axes_;
  }
  void read(Ids ids) {
    if (in_.at.a.triangles) corners(in_.at.a, ids.a, a_);
    if (in_.at.b.triangles) corners(in_.at.b, ids.b, b_);
  }
  static Vec normal(const Vec (&corner)[3], const Motion& in_a) {
    return normalised(cross(rotate(in_a, corner[1] - corner[0]), rotate(in_a, corner[2] - corner[0])));
  }

  const RegionOf& in_;
  const ConvexFace &body_a_, &body_b_;
  const bool both_ = in_.at.a.triangles && in_.at.b.triangles;
  const double radii_ = in_.radii();
  Vec n_{0, 0, 0};
  // Of a convex body: the way out of it along the direction, and across its contact face, as long as gives 1 along the
  // direction; and the body's ends along both.
  Vec out_{0, 0, 0}, face_{0, 0, 0};
  double body_end_ = 0, face_end_ = 0, norm_of_face_ = 1;
  Vec a_[3], b_[3];
  std::optional<PairAxes> axes_;
  Ids of_axes_{kNone, kNone};
  PairSeed seed_{};
};

/// The way that is none but for the radii: twice law 2's bound more than their sum.
double nothing(const RegionOf& in) { return 2 * in.at.law_two + in.radii(); }

/// The longest way along one direction of the pairs that were looked at. A pair whose bound, `Way::most_way`, exceeds the ways
/// of those that were asked by no more than twice law 2's bound counts with its bound and is not asked. Faces that are flush
/// have many pairs, of which few are asked.
class LongestWay {
 public:
  bool settles(const RegionOf& in, double most_way) {
    if (most_way > asked_ + 2 * in.at.law_two) return false;
    most_ = max(most_, most_way);
    return true;
  }
  /// Returns whether it is the longest of those that were asked.
  bool add(double way) {
    const bool is_longest = way > asked_;
    asked_ = max(asked_, way), most_ = max(most_, way);
    return is_longest;
  }
  double asked() const { return asked_; }
  double most() const { return most_; }

 private:
  double asked_ = 0, most_ = 0;
};

/// Visits the pairs of triangles whose boxes both meet the region's and are wanted.
template <class OnPair, class IsWanted>
struct InRegion {
  const NearPairs& pairs;
  const Box& box;
  OnPair on_pair;  ///< returns false to end the search
  IsWanted is_wanted;
  bool going = true;

  bool goes_on() const { return going; }
  bool skips(const NearPairs::Boxes& boxes, double) const {
    return !meet(boxes.a, box) || !meet(boxes.b, box) || !is_wanted(boxes);
  }
  void visit(std::uint32_t a, std::uint32_t b, double) {
    const NearPairs::Boxes boxes = pairs.boxes(a, b);
    if (meet(boxes.a, boxes.b) && !skips(boxes, 0)) going = on_pair(Ids{a, b});
  }
};
/// Boxes are grown by `reach`.
template <class OnPair, class IsWanted>
[[gnu::noinline]] void for_pairs(const RegionOf& in, double reach, const OnPair& on_pair, const IsWanted& is_wanted) {
  NearPairs pairs(in.at, reach);
  InRegion<const OnPair&, const IsWanted&> visitor{pairs, in.box, on_pair, is_wanted};
  pairs.run(visitor);
}
template <class OnPair>
void for_pairs(const RegionOf& in, double reach, const OnPair& on_pair) {
  for_pairs(in, reach, on_pair, [](const NearPairs::Boxes&) { return true; });
}

/// What may face each other along a normal: places of B that lie over places of A, or aside of these by `beside` at most, and
/// from `least` to `most` farther along the normal.
struct Facing {
  const NormalView& view;
  double beside, least, most;

  /// False if two boxes, grown by `reach`, hold no such places.
  bool may_be_in(const NearPairs::Boxes& boxes, double reach) const {
    const Vec way = (boxes.b.least + boxes.b.most - boxes.a.least - boxes.a.most) * 0.5;
    const double grown = 2 * reach * (1 - kGrownError);
    const Vec half = (boxes.a.most - boxes.a.least + boxes.b.most - boxes.b.least) * 0.5 - Vec{grown, grown, grown};
    const auto half_along = [&](const Vec& n) { return dot(Vec{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}, half); };
    const auto apart = [&](const Vec& n) { return std::fabs(dot(way, n)) > half_along(n) + beside; };
    const double along = dot(way, view.n), half_way = half_along(view.n);
    return !(apart(view.x) || apart(view.y) || along - half_way > most || along + half_way < least);
  }
};

/// Directions to try, each once.
class Tried {
 public:
  void add(const Vec& n, bool is_face = false) {
    if (!(dot(n, n) > 0)) return;
    int i = 0;
    while (i < count_ && dot(n, at_[i]) <= 1 - kSameDirection) ++i;
    if (i == kMostTried || (i < count_ && (is_face_[i] || !is_face))) return;
    at_[i] = n, is_face_[i] = is_face;
    count_ = std::max(count_, i + 1);
  }
  void add_both(const Vec& n, bool is_face = false) { add(n, is_face), add(-n, is_face); }
  int size() const { return count_; }
  const Vec& operator[](int i) const { return at_[i]; }
  /// Whether it is a triangle's normal.
  bool is_face(int i) const { return is_face_[i]; }

 private:
  int count_ = 0;
  Vec at_[kMostTried];
  bool is_face_[kMostTried];
};

/// True if along `n` each pair of the region that meets overlaps by `nothing` at most.
bool parts_all(const RegionOf& in, Way& way, const Vec& n) {
  if (!(dot(n, n) > 0)) return false;
  way.turn(n);
  bool parts = true;
  for_pairs(in, in.near(), [&](Ids ids) {
    Met met{ids, {}, 0};
    return parts = !(way.overlap(ids) > nothing(in) && way.meets(met));
  });
  return parts;
}

/// Makes `normal` the direction along which B has the least way to go until all pairs that meet are apart with their radii; it
/// stays if the way along it is nothing. A triangle's normal is preferred if the way along it is longer by no more than the
/// slack: along the border of faces that are flush a few pairs are parted aslant by that much less. Returns false if no pair
/// meets. Of more than `kMostMet` pairs some are looked at; of all others the one that has the longest way along the normal
/// found joins these, until that is no longer than theirs.
[[gnu::noinline]] bool choose_normal(const RegionOf& in, const ConvexFace& body_a, const ConvexFace& body_b, Vec& normal) {
  Way way(in, body_a, body_b);
  const Vec first = normal;
  if (parts_all(in, way, first)) return true;

  Met met[kMostMet];
  int count = 0;
  bool is_all = true;
  Tried tried;
  tried.add(first);
  Vec sum_a{0, 0, 0}, sum_b{0, 0, 0};
  for_pairs(in, in.near(), [&](Ids ids) {
    if (count == kMostMet) return is_all = false;
    Met& last = met[count];
    last.ids = ids;
    if (!way.meets(last)) return true;
    ++count;
    const Vec a = way.normal_a(last), b = way.normal_b(last);
    sum_a = sum_a + a, sum_b = sum_b + b;
    if (tried.size() + 11 + kMostRounds <= kMostTried)
      tried.add_both(a, in.at.a.triangles), tried.add_both(b, in.at.b.triangles), tried.add(last.least);
    return true;
  });
  tried.add_both(normalised(sum_a - sum_b)), tried.add_both(normalised(sum_a)), tried.add_both(normalised(sum_b));

  const double none = nothing(in);
  double least = HUGE_VAL;
  LongestWay known[kMostTried];  // along each direction tried
  for (int round = 0; round < kMostRounds && count > 0; ++round) {
    double of_met = HUGE_VAL;
    Vec best = first;
    for (int k = 0; k < tried.size(); ++k) {
      const double price = tried.is_face(k) ? 0 : in.slack;
      LongestWay& longest = known[k];
      way.turn(tried[k]);
      for (int i = 0; i < count && longest.most() + price < of_met; ++i) {
        const double most = way.most_way(met[i].ids);
        if (!longest.settles(in, most)) longest.add(most <= none ? most : way.way(met[i]));
        if (longest.most() + price >= of_met) std::swap(met[i], met[0]);  // it may rule out the next one too
      }
      if (longest.most() + price < of_met) of_met = longest.most() + price, best = tried[k];
    }
    if (of_met >= least) break;
    if (is_all) return normal = best, true;
    LongestWay longest;
    Met worst{};
    way.turn(best);
    for_pairs(in, in.near(), [&](Ids ids) {
      Met other{ids, {}, 0};
      const double most = way.most_way(ids);
      if (longest.settles(in, most) || (most > none && !way.meets(other))) return true;
      if (longest.add(most <= none ? most : way.way(other))) worst = other;
      return true;
    });
    if (longest.most() < least) least = longest.most(), normal = best;
    if (longest.asked() <= max(of_met, none)) break;
    met[kMostMet - 1 - round] = worst;
    tried.add(worst.least);
  }
  return least < HUGE_VAL;
}

/// How far B must go along `n` until all pairs that meet are apart with their radii; infinite if no pair meets.
[[gnu::noinline]] double way_along(const RegionOf& in, const ConvexFace& body_a, const ConvexFace& body_b, const Vec& n) {
  Way way(in, body_a, body_b);
  way.turn(n);
  LongestWay longest;
  bool meets = false;
  for_pairs(in, in.near(), [&](Ids ids) {
    Met met{ids, {}, 0};
    const double most = way.most_way(ids);
    if ((meets && longest.settles(in, most)) || !way.meets(met)) return true;
    meets = true, longest.add(most <= nothing(in) ? most : way.way(met));
    return true;
  });
  return meets ? longest.most() : HUGE_VAL;
}

/// What is asked for, in the range that is allowed.
double flatness(const ManifoldOptions& options) { return max(0, min(options.flatness, kMostFlatness)); }

// ---- The points ------------------------------------------------------------------------------------------------------------

/// One of both surfaces as the projection shows it: a triangle of a mesh at a time, or the contact face of a convex body, which
/// is a fan of triangles.
class Seen {
 public:
  /// `n`: outwards, in A's frame, as is what `in_a` makes of the body. The rest as of ContactFace.
  Seen(const MeshView& of, const Motion& in_a, const ConvexFace& body, const NormalView& view, const Vec& n, FeatureId before,
       double flatness)
      : of_(of), in_a_(in_a), body_(body), view_(view) {
    if (!body) return;
    face_.emplace(body.contact_face(n, before, flatness));
    fan_.is_fan = true;
    const Vec normal = body.direction(face_->normal()), out = {dot(view.x, normal), dot(view.y, normal), dot(view.n, normal)};
    if (std::fabs(out.z) > kLeastCosine) rise_ = {-out.x / out.z, -out.y / out.z};
    each_of_fan([&](const Facet& facet) {
      fan_.box = fan_.names == 0 ? facet.box : around(fan_.box, facet.box), fan_.names |= facet.names;
      for (const Vec& corner : facet.at)
        least_off_ = min(least_off_, corner.z - of_plane(corner)), most_off_ = max(most_off_, corner.z - of_plane(corner));
    });
  }
  bool is_fan() const { return face_.has_value(); }
  /// A box around what of the fan may be over a triangle, and the names of all.
  Facet fan_over(const Facet& triangle) const {
    Facet over = fan_;
    const double z[3] = {of_plane(triangle.at[0]), of_plane(triangle.at[1]), of_plane(triangle.at[2])};
    over.box.least.z = max(over.box.least.z, min(min(z[0], z[1]), z[2]) + least_off_);
    over.box.most.z = min(over.box.most.z, max(max(z[0], z[1]), z[2]) + most_off_);
    return over;
  }
  template <class OnFacet>
  void each_of_fan(const OnFacet& on_facet) const;
  Facet triangle(std::uint32_t triangle) const;

 private:
  Vec at(const Vec& point) const { return view_.at(apply(in_a_, point)); }
  double of_plane(const Vec& seen) const { return rise_.x * seen.x + rise_.y * seen.y; }

  const MeshView& of_;
  const Motion& in_a_;
  const ConvexFace& body_;
  const NormalView& view_;
  std::optional<ContactFace> face_;
  Facet fan_;
  PlanePoint rise_{0, 0};                                 ///< of the fan's plane, per unit of x and y
  double least_off_ = HUGE_VAL, most_off_ = -least_off_;  ///< how far above it through the middle corners are
};

Facet Seen::triangle(std::uint32_t triangle) const {
  Facet facet;
  Vec corner[3];
  corners(of_, triangle, corner);
  for (int k = 0; k < 3; ++k) {
    facet.at[k] = at(corner[k]);
    facet.vertex[k] = {FeatureKind::Vertex, of_.triangles[triangle][std::size_t(k)]};
    facet.side[k] = side(triangle, k);
  }
  facet.face = whole(of_, triangle);
  facet.measure();
  return facet;
}

template <class OnFacet>
void Seen::each_of_fan(const OnFacet& on_facet) const {
  const ConvexView& view = body_.view();
  const ContactFace& face = *face_;
  Facet facet;
  facet.face = face.name();
  const auto put = [&](int k, std::uint32_t v) {
    facet.at[k] = view_.at(body_.point(v)), facet.vertex[k] = {FeatureKind::Vertex, v};
  };
  const std::uint32_t first = face.side();
  if (first == kNone) {
    for (int k = 0; k < 3; ++k) put(k, 0);
    facet.measure();
    return on_facet(facet);
  }
  const auto edge = [&](std::uint32_t h) { return named(view, {FeatureKind::Edge, h}); };
  const std::uint32_t top = origin(view, first);
  put(0, top), put(1, view.half_edges[first].head);
  facet.side[0] = edge(first);
  for (std::uint32_t h = face.onward<true>(first);; h = face.onward<true>(h)) {
    const bool is_last = view.half_edges[h].head == top;
    if (is_last && facet.side[0].kind() == FeatureKind::None) break;  // the fan's last triangle has had this side
    put(2, view.half_edges[h].head);
    facet.side[1] = edge(h);
    const std::uint32_t next = is_last ? h : face.onward<true>(h);
    facet.side[2] = !is_last && view.half_edges[next].head == top ? edge(next) : FeatureId();
    facet.measure();
    on_facet(facet);
    if (is_last) break;
    facet.side[0] = {};
    put(1, view.half_edges[h].head);
  }
}

/// The contact points of a candidate. If one of its features is a vertex, that body's point is the vertex.
ManifoldPoint placed(const RegionOf& in, const ConvexFace& face_a, const ConvexFace& face_b, const NormalView& seen,
                     const Candidate& c) {
  const Vec across = seen.n * c.separation;
  const auto vertex = [](const MeshView& of, const ConvexFace& face, const Motion& in_a, FeatureId name) {
    return of.triangles ? apply(in_a, of.vertices[name.index()]) : face.point(name.index());
  };
  const FeatureId a = c.names.a(), b = c.names.b();
  const Vec point_a = a.kind() == FeatureKind::Vertex   ? vertex(in.at.a, face_a, kAtRest, a)
                      : b.kind() == FeatureKind::Vertex ? vertex(in.at.b, face_b, in.at.motion, b) - across
                                                        : seen.point(c.on_a);
  return {eigen(point_a), eigen(point_a + across), c.separation, a, b};
}

/// Fills the manifold of two surfaces from the region's nearest or deepest points.
void grow(const RegionOf& in, const ConvexFace& body_a, const ConvexFace& body_b, const Candidate& witness, const Vec& normal,
          const Vec& middle, double margin, const ManifoldOptions& options, const Manifold& previous, Manifold& manifold) {
  const double bound = in.at.law_two, flatness = swiftlet::flatness(options), least = witness.separation;
  const NormalView seen(normal, middle);
  const Seen of_a(in.at.a, kAtRest, body_a, seen, normal, previous.face_a, flatness),
      of_b(in.at.b, in.at.motion, body_b, seen, -normal, previous.face_b, flatness);

  const bool rests = norm(normal - vec(previous.normal)) <= kRestingTurn * flatness;
  const double slack = rests ? flatness * max(in.at.a.root->extent, in.at.b.root->extent) : 0;
  const std::uint32_t most = std::min(options.most_points, kMostManifoldPoints);
  // As of two convex bodies: where a pair at rest has lost points of the manifold before, what misses a facet by no more than
  // the noise of poses counts as over it, if that finds more of them.
  int kept = -1;
  for (const double beside : {bound / 2, kRestingSlide * slack}) {
    if (kept >= int(std::min(previous.count, most)) || beside < bound / 2) break;
    Farthest farthest(previous, 2 * beside);
    const auto is_wanted = [&](const Facet& a, const Facet& b) {
      return b.box.least.z - a.box.most.z <= margin + bound && b.box.most.z - a.box.least.z >= least - 2 * beside &&
             farthest.may_take(a, b);
    };
    const auto look = [&](const Facet& a, const Facet& b) {
      if (!is_wanted(a, b)) return;
      face_each_other(a, b, beside, [&](const Candidate& c) {
        if (c.separation >= least - 2 * beside && c.separation <= margin + bound) farthest.add(c);
      });
    };
    const auto look_at = [&](Ids ids) {
      if (of_a.is_fan()) {
        const Facet b = of_b.triangle(ids.b);
        if (is_wanted(of_a.fan_over(b), b)) of_a.each_of_fan([&](const Facet& a) { look(a, b); });
      } else if (const Facet a = of_a.triangle(ids.a); !of_b.is_fan()) {
        look(a, of_b.triangle(ids.b));
      } else if (is_wanted(a, of_b.fan_over(a))) {
        of_b.each_of_fan([&](const Facet& b) { look(a, b); });
      }
      return true;
    };
    const Facing facing{seen, 2 * beside, least - 2 * beside, margin + bound};
    const double reach = max(max(margin, std::fabs(least)), 2 * beside) + bound;
    for_pairs(in, reach, look_at, [&](const NearPairs::Boxes& boxes) { return facing.may_be_in(boxes, reach); });
    Candidates candidates(margin + bound, previous);
    const bool has_least = farthest.least() <= least + bound + kNarrowest * in.at.size;
    farthest.give(candidates);
    if (!has_least) candidates.add_deepest(witness);
    const Chosen chosen = choose(candidates, most, previous, bound, slack);
    const auto known =
        int(std::count_if(chosen.begin(), chosen.end(), [&](int i) { return candidates.knows(candidates[i].names); }));
    if (known <= kept) break;
    kept = known, manifold.count = 0;
    for (const int i : chosen) manifold.points[manifold.count++] = placed(in, body_a, body_b, seen, candidates[i]);
  }
}

bool names_a_region(const MeshContact& contact, const MeshView& a, const MeshView& b) {
  return contact.triangle_a < a.triangle_count && contact.triangle_b < b.triangle_count && !contact.box_min.hasNaN() &&
         !contact.box_max.hasNaN() && !contact.point_a.hasNaN() && !contact.point_b.hasNaN();
}

bool names_a_vertex(const MeshView& of, const ConvexFace& body, FeatureId feature) {
  return feature.kind() != FeatureKind::Vertex || feature.index() < (body ? body.vertex_count() : of.content->vertices.size());
}

}  // namespace

Manifold manifold(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const MeshContact& contact,
                  const ManifoldOptions& options, const Manifold& previous) {
  if (!a.mesh() && !b.mesh()) {
    const Answer answer = signed_distance(a.convex(), b.convex(), b_in_a);
    return manifold(a.convex(), b.convex(), b_in_a, answer, options, previous);
  }
  Manifold manifold;
  const MeshSetting at(a, b, b_in_a);
  if (at.fault() != Status::Converged || !names_a_region(contact, at.a, at.b)) return manifold;
  const RegionOf in{at, b_in_a, {vec(contact.box_min), vec(contact.box_max)}};
  const ConvexFace body_a(at.a, kAtRest), body_b(at.b, at.motion);
  if (!names_a_vertex(at.a, body_a, contact.feature_a) || !names_a_vertex(at.b, body_b, contact.feature_b)) return manifold;
  const double margin = options.margin + at.radii.sum();

  // The points of the surfaces.
  const bool has_normal = !contact.normal.hasNaN();
  Vec normal = has_normal ? vec(contact.normal) : Vec{0, 0, 0};
  const Vec point_a = vec(contact.point_a) - normal * at.radii.a(), point_b = vec(contact.point_b) + normal * at.radii.b();
  double separation = dot(normal, point_b - point_a);
  Vec middle = point_a;
  if (!has_normal || separation <= at.law_two) {
    // Faces that are flush with each other cross, touch or are apart as the noise of the poses has it, and would need a way of
    // no more than that along their own plane: chosen with slack, the normal parts them where they face each other.
    RegionOf with_slack = in;
    with_slack.slack = kRestingSlide * flatness(options) * max(at.a.root->extent, at.b.root->extent);
    if (!choose_normal(with_slack, body_a, body_b, normal) && !has_normal) return manifold;
    if (const double way = way_along(in, body_a, body_b, normal); way < HUGE_VAL) separation = -(way - at.radii.sum());
  }
  manifold.normal = eigen(normal);
  manifold.face_a = whole(at.a, contact.triangle_a), manifold.face_b = whole(at.b, contact.triangle_b);
  if (separation > margin + at.law_two) return manifold;
  // A crossing's own point, half the depth off each surface.
  const Names names(contact.feature_a, contact.feature_b);
  const Candidate witness{{0, 0, separation < 0 ? -separation / 2 : 0}, separation, names};
  grow(in, body_a, body_b, witness, normal, middle, margin, options, previous, manifold);
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& p = manifold.points[i];
    // No point is nearer than what is proved, and the nearest one is as near as that, whatever rounding made of them.
    const bool is_least = i == 0 && std::fabs(p.separation - separation) <= at.law_two + kNarrowest * at.size;
    if (is_least || p.separation < separation) {
      p.separation = separation;
      p.point_b = p.point_a + manifold.normal * separation;
    }
    p.point_a += manifold.normal * at.radii.a();
    p.point_b -= manifold.normal * at.radii.b();
    p.separation -= at.radii.sum();
  }
  return manifold;
}

}  // namespace swiftlet
