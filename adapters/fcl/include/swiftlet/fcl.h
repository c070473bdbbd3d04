// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in FCL 0.7: a convex shape that holds a model, and a solver for fcl::distance and fcl::collide. The templates only
// hand on; what they call is compiled in swiftlet::fcl.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/contact_point.h>
#include <fcl/narrowphase/detail/collision_func_matrix.h>
#include <fcl/narrowphase/detail/distance_func_matrix.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include <swiftlet/model.h>
#include <swiftlet/world.h>

namespace swiftlet::fcl {

/// Per face of level 0 its number of vertices and then these, counter-clockwise seen from outside: fcl::Convex's layout.
std::vector<int> face_loops(const Model& model);

/// An fcl::Convex of a model's level 0; to every other solver it is just that. The model must be a solid.
template <class S>
class Convex final : public ::fcl::Convex<S> {
 public:
  /// Shares the model's block. Throws std::invalid_argument where the model lacks level 0 (Detail).
  explicit Convex(const Model& model)
      : ::fcl::Convex<S>(points(whole(model)), int(model.level(0).view.face_first.size()),
                         std::make_shared<const std::vector<int>>(face_loops(model))),
        model_(model) {}
  const Model& model() const { return model_; }  ///< in double precision, as given

 private:
  static std::shared_ptr<const std::vector<::fcl::Vector3<S>>> points(const Model& model) {
    auto result = std::make_shared<std::vector<::fcl::Vector3<S>>>();
    for (const Vertex& v : model.level(0).view.vertices) result->emplace_back(S(v.x), S(v.y), S(v.z));
    return result;
  }
  Model model_;
};

/// A contact in the world's frame.
struct Touch {
  Vec3 normal, point;  ///< from 1 to 2; between the bodies
  double depth = 0;    ///< above 0, as FCL wants it: `tolerance` where they only touch
};
/// One to four of two solids that touch or overlap; none of bodies that are apart, or that no direction leads out of.
std::vector<Touch> touches(const Placed& a, const Placed& b, PairSeed& seed);

/// A NarrowPhaseSolver. Pairs of two swiftlet::fcl::Convex are swiftlet's: distances, signed ones too, nearest points,
/// contacts, and whether they collide, which touching bodies do. All other pairs go to `Others`. Keep one solver per pair and
/// its seed makes the next query of that pair cheap; one for all is as right. Not to be shared by threads.
template <class S_, class Others = ::fcl::detail::GJKSolver_libccd<S_>>
struct Solver {
  using S = S_;                                          ///< FCL's scalar; queries of ours are in double
  using Point = ::fcl::Vector3<S>;                       ///< in the world's frame
  using Transform = ::fcl::Transform3<S>;                ///< maps a shape's frame into the world's
  using Contacts = std::vector<::fcl::ContactPoint<S>>;  ///< normals from 1 to 2

  Others others;          ///< answers all other pairs
  mutable PairSeed seed;  ///< of the last query; FCL hands solvers on as const

  // What FCL calls, by its names and as it describes them.
  /// @cond

  template <class Shape1, class Shape2>
  bool shapeIntersect(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2,
                      Contacts* contacts = nullptr) const {
    return others.shapeIntersect(s1, tf1, s2, tf2, contacts);
  }
  bool shapeIntersect(const ::fcl::Convex<S>& s1, const Transform& tf1, const ::fcl::Convex<S>& s2, const Transform& tf2,
                      Contacts* contacts = nullptr) const {
    const auto a = placed(s1, tf1), b = placed(s2, tf2);
    const Verdict verdict = a && b ? meeting(*a, *b, seed) : Verdict::Undecided;
    if (verdict == Verdict::Undecided) return others.shapeIntersect(s1, tf1, s2, tf2, contacts);
    if (verdict == Verdict::Disjoint) return false;
    if (!contacts) return true;
    for (const Touch& t : touches(*a, *b, seed)) {
      contacts->emplace_back(t.normal.template cast<S>(), t.point.template cast<S>(), S(t.depth));
    }
    return true;
  }

  template <class Shape1, class Shape2>
  bool shapeDistance(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2, S* distance = nullptr,
                     Point* p1 = nullptr, Point* p2 = nullptr) const {
    return others.shapeDistance(s1, tf1, s2, tf2, distance, p1, p2);
  }
  bool shapeDistance(const ::fcl::Convex<S>& s1, const Transform& tf1, const ::fcl::Convex<S>& s2, const Transform& tf2,
                     S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    const Nearest near = between(s1, tf1, s2, tf2);
    if (near.found == Found::Nothing) return others.shapeDistance(s1, tf1, s2, tf2, distance, p1, p2);
    hand_out(near, distance, p1, p2);
    if (near.verdict != Verdict::Overlapping) return true;
    if (distance) *distance = -1;  // FCL's word for a collision
    return false;
  }

  template <class Shape1, class Shape2>
  bool shapeSignedDistance(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2,
                           S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    return others.shapeSignedDistance(s1, tf1, s2, tf2, distance, p1, p2);
  }
  bool shapeSignedDistance(const ::fcl::Convex<S>& s1, const Transform& tf1, const ::fcl::Convex<S>& s2, const Transform& tf2,
                           S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    const Nearest near = between(s1, tf1, s2, tf2);
    if (near.found == Found::Nothing) return others.shapeSignedDistance(s1, tf1, s2, tf2, distance, p1, p2);
    hand_out(near, distance, p1, p2);
    return near.verdict != Verdict::Overlapping;
  }

  template <class... Arguments>
  bool shapeTriangleIntersect(Arguments&&... arguments) const {
    return others.shapeTriangleIntersect(std::forward<Arguments>(arguments)...);
  }
  template <class... Arguments>
  bool shapeTriangleDistance(Arguments&&... arguments) const {
    return others.shapeTriangleDistance(std::forward<Arguments>(arguments)...);
  }
  void enableCachedGuess(bool enable) const { others.enableCachedGuess(enable); }
  void setCachedGuess(const Point& guess) const { others.setCachedGuess(guess); }
  Point getCachedGuess() const { return others.getCachedGuess(); }
  /// @endcond

 private:
  /// Nothing where the shape holds no model.
  static std::optional<Placed> placed(const ::fcl::Convex<S>& shape, const Transform& tf) {
    const auto* const with_model = dynamic_cast<const Convex<S>*>(&shape);
    if (!with_model) return {};
    return Placed{with_model->model(), {tf.linear().template cast<double>(), tf.translation().template cast<double>()}};
  }
  Nearest between(const ::fcl::Convex<S>& s1, const Transform& tf1, const ::fcl::Convex<S>& s2, const Transform& tf2) const {
    const auto a = placed(s1, tf1), b = placed(s2, tf2);
    return a && b ? nearest(*a, *b, std::numeric_limits<double>::infinity(), seed) : Nearest{};
  }
  static void hand_out(const Nearest& near, S* distance, Point* p1, Point* p2) {
    if (distance) *distance = S(near.distance);
    if (p1) *p1 = near.point_a.template cast<S>();
    if (p2) *p2 = near.point_b.template cast<S>();
  }
};

}  // namespace swiftlet::fcl

/// FCL's tables of functions by shape, compiled once; they are half a minute of a translation unit otherwise.
extern template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<double>>;
extern template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<double>>;
