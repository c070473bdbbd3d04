// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in FCL 0.7: a convex shape that holds a model, a solver for fcl::distance and fcl::collide, and what keeps a solver
// per pair for broadphase managers; meshes are fcl_mesh.h's. The templates only hand on; what they call is compiled in
// swiftlet::fcl.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/contact_point.h>
#include <fcl/narrowphase/detail/collision_func_matrix.h>
#include <fcl/narrowphase/detail/distance_func_matrix.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/distance.h>

#include <swiftlet/fcl_mesh.h>
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

/// A model of an fcl::Convex, once and for all: `Convex(model_of(theirs).value())`. Errors: as Model::from_level, of faces that
/// are no convex solid.
template <class S>
Result<Model> model_of(const ::fcl::Convex<S>& shape);

/// A plane, which has no inside: all points p of the world with `normal` . p = `offset`.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;            ///< from the origin, along the normal
};

/// What a shape of FCL's is to the kernel, where it is in the world; nothing where the kernel knows no such shape. It borrows
/// the model of a Convex.
using Operand = std::variant<std::monostate, Placed, HalfSpace, Plane>;

template <class S>
Pose pose_of(const ::fcl::Transform3<S>& tf) {
  return {tf.linear().template cast<double>(), tf.translation().template cast<double>()};
}

template <class S>
Operand operand(const ::fcl::ShapeBase<S>&, const ::fcl::Transform3<S>&) {
  return {};
}
template <class S>
Operand operand(const ::fcl::Convex<S>& shape, const ::fcl::Transform3<S>& tf) {
  const auto* const with_model = dynamic_cast<const Convex<S>*>(&shape);
  return with_model ? Operand(Placed{with_model->model(), pose_of(tf)}) : Operand();
}
template <class S>
Operand operand(const ::fcl::Sphere<S>& shape, const ::fcl::Transform3<S>& tf) {
  return Placed{Body::point(Vec3::Zero(), shape.radius), pose_of(tf)};
}
template <class S>
Operand operand(const ::fcl::Capsule<S>& shape, const ::fcl::Transform3<S>& tf) {
  const Vec3 top = Vec3::UnitZ() * (double(shape.lz) / 2);
  return Placed{Body::segment(-top, top, shape.radius), pose_of(tf)};
}
template <class S>
Operand operand(const ::fcl::Box<S>& shape, const ::fcl::Transform3<S>& tf) {
  const Vec3 half = shape.side.template cast<double>() / 2;
  return Placed{Body::box(-half, half), pose_of(tf)};
}
template <class S>
Placed triangle(const ::fcl::Vector3<S>& p, const ::fcl::Vector3<S>& q, const ::fcl::Vector3<S>& r, const Pose& in_world) {
  return {Body::triangle(p.template cast<double>(), q.template cast<double>(), r.template cast<double>()), in_world};
}
template <class S>
Operand operand(const ::fcl::TriangleP<S>& shape, const ::fcl::Transform3<S>& tf) {
  return triangle<S>(shape.a, shape.b, shape.c, pose_of(tf));
}
/// Of a shape with a normal `n` and an offset `d`, whose length single precision leaves wrong by an ulp.
template <class Flat, class Shape, class S>
Operand flat(const Shape& shape, const ::fcl::Transform3<S>& tf) {
  const Pose pose = pose_of(tf);
  if (!is_rigid(pose)) return {};
  const Vec3 n = shape.n.template cast<double>(), up = (pose.rotation * n).normalized();
  return Flat{up, up.dot(pose.translation) + double(shape.d) / n.norm()};
}
template <class S>
Operand operand(const ::fcl::Halfspace<S>& shape, const ::fcl::Transform3<S>& tf) {
  return flat<HalfSpace>(shape, tf);
}
template <class S>
Operand operand(const ::fcl::Plane<S>& shape, const ::fcl::Transform3<S>& tf) {
  return flat<Plane>(shape, tf);
}

// The kernel answers where one of both holds a model and the other one is anything it knows.

/// Whether it holds a model, in whichever pose.
bool is_model(const Operand& operand);
/// Whether they share a point; Undecided: the kernel does not answer.
Verdict meeting(const Operand& a, const Operand& b, PairSeed& seed);
/// How far apart or how deep; Found::Nothing: the kernel does not answer.
Nearest nearest(const Operand& a, const Operand& b, PairSeed& seed);

/// A contact in the world's frame.
struct Touch {
  Vec3 normal = Vec3::Zero();  ///< unit, from 1 to 2
  Vec3 point = Vec3::Zero();   ///< between the bodies
  double depth = 0;            ///< above 0, as FCL wants it: `tolerance` where they only touch
};
/// A depth in FCL's scalar: above 0 also where single precision has none so small.
template <class S>
S depth_of(double depth) {
  return std::max(S(depth), std::numeric_limits<S>::min());
}
/// One to four of two solids that touch or overlap; none of bodies that are apart, or that no direction leads out of.
std::vector<Touch> touches(const Operand& a, const Operand& b, PairSeed& seed);
/// The deepest, where `nearest` finds one.
std::optional<Touch> deepest_touch(const Operand& a, const Operand& b, PairSeed& seed);

/// Whether all poses are finite: libccd ends the program where one is not.
template <class... Transforms>
bool are_finite(const Transforms&... tf) {
  return (tf.matrix().allFinite() && ...);
}

/// What a Solver is but for meshes of ours, which FCL's functions of shapes do not bring to a solver as a whole.
template <class S_, class Others = ::fcl::detail::GJKSolver_libccd<S_>>
struct ShapeSolver {
  using S = S_;                                          ///< FCL's scalar; queries of ours are in double
  using Point = ::fcl::Vector3<S>;                       ///< in the world's frame
  using Transform = ::fcl::Transform3<S>;                ///< maps a shape's frame into the world's
  using Contacts = std::vector<::fcl::ContactPoint<S>>;  ///< normals from 1 to 2

  Others others;               ///< answers all other pairs
  mutable PairSeed seed;       ///< of the last query; FCL hands solvers on as const
  mutable MeshSeed mesh_seed;  ///< of the last query of a pair with a swiftlet::fcl::Mesh

  // What FCL calls, by its names and as it describes them.
  /// @cond

  template <class Shape1, class Shape2>
  bool shapeIntersect(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2,
                      Contacts* contacts = nullptr) const {
    if constexpr (may_be_ours<Shape1, Shape2>) {
      const Operand a = operand(s1, tf1), b = operand(s2, tf2);
      const Verdict verdict = meeting(a, b, seed);
      if (verdict == Verdict::Disjoint) return false;
      if (verdict != Verdict::Undecided) {
        if (!contacts) return true;
        for (const Touch& t : touches(a, b, seed)) {
          contacts->emplace_back(t.normal.template cast<S>(), t.point.template cast<S>(), depth_of<S>(t.depth));
        }
        return true;
      }
      if (is_plane<Shape1, Shape2> && (is_model(a) || is_model(b))) return false;
      if (!are_finite(tf1, tf2)) return false;
    }
    return others.shapeIntersect(s1, tf1, s2, tf2, contacts);
  }

  template <class Shape1, class Shape2>
  bool shapeDistance(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2, S* distance = nullptr,
                     Point* p1 = nullptr, Point* p2 = nullptr) const {
    if constexpr (may_be_ours<Shape1, Shape2>) {
      const Nearest near = nearest(operand(s1, tf1), operand(s2, tf2), seed);
      if (near.found != Found::Nothing) return is_apart(near, distance, p1, p2);
      if (is_flat<Shape1, Shape2> || !are_finite(tf1, tf2)) return nothing(distance, p1, p2);
    }
    return others.shapeDistance(s1, tf1, s2, tf2, distance, p1, p2);
  }

  template <class Shape1, class Shape2>
  bool shapeSignedDistance(const Shape1& s1, const Transform& tf1, const Shape2& s2, const Transform& tf2,
                           S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    if constexpr (may_be_ours<Shape1, Shape2>) {
      const Nearest near = nearest(operand(s1, tf1), operand(s2, tf2), seed);
      if (near.found != Found::Nothing) return hand_out(near, distance, p1, p2), near.verdict != Verdict::Overlapping;
      if (is_flat<Shape1, Shape2> || !are_finite(tf1, tf2)) return nothing(distance, p1, p2);
    }
    return others.shapeSignedDistance(s1, tf1, s2, tf2, distance, p1, p2);
  }

  template <class Shape>
  bool shapeTriangleIntersect(const Shape& s, const Transform& tf, const Point& p, const Point& q, const Point& r,
                              Point* contact = nullptr, S* depth = nullptr, Point* normal = nullptr) const {
    if constexpr (may_be_ours<Shape>) {
      const std::optional<bool> found = meets(operand(s, tf), triangle<S>(p, q, r, {}), contact, depth, normal);
      if (found) return *found;
      if (!are_finite(tf)) return false;
    }
    return others.shapeTriangleIntersect(s, tf, p, q, r, contact, depth, normal);
  }
  template <class Shape>
  bool shapeTriangleIntersect(const Shape& s, const Transform& tf1, const Point& p, const Point& q, const Point& r,
                              const Transform& tf2, Point* contact = nullptr, S* depth = nullptr,
                              Point* normal = nullptr) const {
    if constexpr (may_be_ours<Shape>) {
      const std::optional<bool> found = meets(operand(s, tf1), triangle<S>(p, q, r, pose_of(tf2)), contact, depth, normal);
      if (found) return *found;
      if (!are_finite(tf1, tf2)) return false;
    }
    return others.shapeTriangleIntersect(s, tf1, p, q, r, tf2, contact, depth, normal);
  }

  template <class Shape>
  bool shapeTriangleDistance(const Shape& s, const Transform& tf, const Point& p, const Point& q, const Point& r,
                             S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    if constexpr (may_be_ours<Shape>) {
      const Nearest near = nearest(operand(s, tf), triangle<S>(p, q, r, {}), seed);
      if (near.found != Found::Nothing) return is_apart(near, distance, p1, p2);
      if (!are_finite(tf)) return nothing(distance, p1, p2);
    }
    return others.shapeTriangleDistance(s, tf, p, q, r, distance, p1, p2);
  }
  template <class Shape>
  bool shapeTriangleDistance(const Shape& s, const Transform& tf1, const Point& p, const Point& q, const Point& r,
                             const Transform& tf2, S* distance = nullptr, Point* p1 = nullptr, Point* p2 = nullptr) const {
    if constexpr (may_be_ours<Shape>) {
      const Nearest near = nearest(operand(s, tf1), triangle<S>(p, q, r, pose_of(tf2)), seed);
      if (near.found != Found::Nothing) return is_apart(near, distance, p1, p2);
      if (!are_finite(tf1, tf2)) return nothing(distance, p1, p2);
    }
    return others.shapeTriangleDistance(s, tf1, p, q, r, tf2, distance, p1, p2);
  }

  void enableCachedGuess(bool enable) const { others.enableCachedGuess(enable); }
  void setCachedGuess(const Point& guess) const { others.setCachedGuess(guess); }
  Point getCachedGuess() const { return others.getCachedGuess(); }
  /// @endcond

 private:
  /// Whether one of them can hold a model.
  template <class... Shapes>
  static constexpr bool may_be_ours = (std::is_same_v<Shapes, ::fcl::Convex<S>> || ...);
  /// Whether one of them is flat: FCL's solvers have no distance to it, and end the program where they are asked.
  template <class... Shapes>
  static constexpr bool is_flat = ((std::is_same_v<Shapes, ::fcl::Halfspace<S>> || std::is_same_v<Shapes, ::fcl::Plane<S>>) ||
                                   ...);
  /// Whether one of them is a plane, of which FCL's solvers know no collision either.
  template <class... Shapes>
  static constexpr bool is_plane = (std::is_same_v<Shapes, ::fcl::Plane<S>> || ...);

  /// Whether they share a point, and where; nothing where the kernel does not answer.
  std::optional<bool> meets(const Operand& a, const Operand& b, Point* contact, S* depth, Point* normal) const {
    const Verdict verdict = meeting(a, b, seed);
    if (verdict == Verdict::Undecided) return {};
    if (verdict == Verdict::Disjoint) return false;
    if (!contact && !depth && !normal) return true;
    const std::optional<Touch> touch = deepest_touch(a, b, seed);
    if (!touch) return {};
    if (contact) *contact = touch->point.template cast<S>();
    if (depth) *depth = depth_of<S>(touch->depth);
    if (normal) *normal = touch->normal.template cast<S>();
    return true;
  }
  static void hand_out(const Nearest& near, S* distance, Point* p1, Point* p2) {
    if (distance) *distance = S(near.distance);
    if (p1) *p1 = near.point_a.template cast<S>();
    if (p2) *p2 = near.point_b.template cast<S>();
  }
  /// A distance that nobody knows: NaN, which FCL's results do not take.
  static bool nothing(S* distance, Point* p1, Point* p2) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const Vec3 nowhere = Vec3::Constant(kUnknown);
    hand_out({.distance = kUnknown, .point_a = nowhere, .point_b = nowhere}, distance, p1, p2);
    return false;
  }
  static bool is_apart(const Nearest& near, S* distance, Point* p1, Point* p2) {
    hand_out(near, distance, p1, p2);
    if (distance) *distance = S(std::max(near.distance, 0.0));  // bodies that touch overlap up to rounding
    if (near.verdict != Verdict::Overlapping) return true;
    if (distance) *distance = -1;  // FCL's word for a collision
    return false;
  }
};

/// A NarrowPhaseSolver. Pairs of a swiftlet::fcl::Convex and a shape that is an `operand` are swiftlet's: distances, signed
/// ones too, nearest points, contacts, and whether they collide, which touching bodies do; so are a Convex and the triangles of
/// a mesh or the boxes of an octree, and a swiftlet::fcl::Mesh with another, or with what a `mesh_operand` is. All other pairs
/// go to `Others`. Keep one solver per pair and its seeds make the next query of that pair cheap; one for all is as right. Not
/// to be shared by threads.
template <class S_, class Others = ::fcl::detail::GJKSolver_libccd<S_>>
struct Solver : ShapeSolver<S_, Others> {};

/// What a geometry of FCL's is to a mesh of ours: a Mesh, or what `operand` places; nothing where it is neither.
template <class S>
std::optional<PlacedMesh> mesh_operand(const ::fcl::CollisionGeometry<S>& geometry, const ::fcl::Transform3<S>& tf) {
  const auto placed = [&tf](const auto& shape) -> std::optional<PlacedMesh> {
    const Operand convex = operand(shape, tf);
    const auto* const found = std::get_if<Placed>(&convex);
    return found ? std::optional(PlacedMesh{found->body, found->in_world}) : std::nullopt;
  };
  switch (geometry.getNodeType()) {
    case ::fcl::GEOM_CONVEX: return placed(static_cast<const ::fcl::Convex<S>&>(geometry));
    case ::fcl::GEOM_SPHERE: return placed(static_cast<const ::fcl::Sphere<S>&>(geometry));
    case ::fcl::GEOM_CAPSULE: return placed(static_cast<const ::fcl::Capsule<S>&>(geometry));
    case ::fcl::GEOM_BOX: return placed(static_cast<const ::fcl::Box<S>&>(geometry));
    default: break;
  }
  if (geometry.getObjectType() != ::fcl::OT_BVH) return {};
  const auto* const mesh = dynamic_cast<const MeshHolder*>(&geometry);
  return mesh ? std::optional(PlacedMesh{mesh->mesh(), pose_of(tf)}) : std::nullopt;
}

/// FCL's functions of pairs of geometries, which stand in its tables, with what they are when both are a `mesh_operand`.
template <class S, class Others>
struct MeshFunctions {
  // What FCL calls, by its names and as it describes them. The first geometry is a BVHModel.
  /// @cond
  using Geometry = ::fcl::CollisionGeometry<S>;
  using Transform = ::fcl::Transform3<S>;
  using Asked = ShapeSolver<S, Others>;

  static std::size_t collide(const Geometry* o1, const Transform& tf1, const Geometry* o2, const Transform& tf2,
                             const Asked* solver, const ::fcl::CollisionRequest<S>& request,
                             ::fcl::CollisionResult<S>& result) {
    const auto a = mesh_operand(*o1, tf1), b = mesh_operand(*o2, tf2);
    if (a && b && !request.enable_cost) {
      if (request.isSatisfied(result)) return result.numContacts();
      const MeshMeeting found = meeting_of(*a, *b, solver->mesh_seed);
      if (found.is_known()) {
        if (found.verdict != Verdict::Disjoint) add_contacts(*a, *b, found, *o1, *o2, request, result);
        return result.numContacts();
      }
      if (!are_finite(tf1, tf2)) return result.numContacts();
    }
    const auto& fcls = ::fcl::getCollisionFunctionLookTable<Asked>().collision_matrix;
    return fcls[o1->getNodeType()][o2->getNodeType()](o1, tf1, o2, tf2, solver, request, result);
  }

  static S distance(const Geometry* o1, const Transform& tf1, const Geometry* o2, const Transform& tf2, const Asked* solver,
                    const ::fcl::DistanceRequest<S>& request, ::fcl::DistanceResult<S>& result) {
    const auto a = mesh_operand(*o1, tf1), b = mesh_operand(*o2, tf2);
    if (a && b) {
      if (request.isSatisfied(result)) return result.min_distance;
      const Options options{.absolute = request.abs_err, .relative = request.rel_err, .beyond = result.min_distance};
      const MeshMeeting found = distance_of(*a, *b, options, solver->mesh_seed);
      if (found.is_known()) {
        hand_out(found, *o1, *o2, request, result);
        return result.min_distance;
      }
      if (!are_finite(tf1, tf2)) return result.min_distance;
    }
    const auto& fcls = ::fcl::getDistanceFunctionLookTable<Asked>().distance_matrix;
    return fcls[o1->getNodeType()][o2->getNodeType()](o1, tf1, o2, tf2, solver, request, result);
  }
  /// @endcond

 private:
  static void add_contacts(const PlacedMesh& a, const PlacedMesh& b, const MeshMeeting& found, const Geometry& o1,
                           const Geometry& o2, const ::fcl::CollisionRequest<S>& request, ::fcl::CollisionResult<S>& result) {
    std::vector<MeshTouch> touches;
    if (request.enable_contact) touches = touches_of(a, b);
    for (const MeshTouch& t : touches) {
      if (result.numContacts() >= request.num_max_contacts) return;
      result.addContact({&o1, &o2, t.triangle_a, t.triangle_b, t.point.template cast<S>(), t.normal.template cast<S>(),
                         depth_of<S>(t.depth)});
    }
    if (!touches.empty()) return;
    const Vec3 between = (found.point_a + found.point_b) / 2;
    const ::fcl::Vector3<S> unknown = ::fcl::Vector3<S>::Zero();
    result.addContact({&o1, &o2, found.triangle_a, found.triangle_b, between.template cast<S>(), unknown, S(0)});
  }
  static void hand_out(const MeshMeeting& found, const Geometry& o1, const Geometry& o2,
                       const ::fcl::DistanceRequest<S>& request, ::fcl::DistanceResult<S>& result) {
    if (found.status == Status::Beyond) return;
    // FCL's word for a collision with a shape is -1; of two meshes it is 0.
    const bool is_collision = found.verdict == Verdict::Overlapping && o2.getObjectType() == ::fcl::OT_GEOM;
    const S distance = is_collision ? S(-1) : S(found.distance);
    if (request.enable_nearest_points)
      result.update(distance, &o1, &o2, found.triangle_a, found.triangle_b, found.point_a.template cast<S>(),
                    found.point_b.template cast<S>());
    else
      result.update(distance, &o1, &o2, found.triangle_a, found.triangle_b);
  }
};

/// A solver for each pair of objects that a broadphase manager brings, so that each pair has a seed of its own. Those of pairs
/// that did not come in a step are forgotten at the start of the next one. Not to be shared by threads.
template <class S, class Others>
class PairSolvers {
 public:
  using Object = ::fcl::CollisionObject<S>;  ///< what a manager holds

  /// `first`: what the solver of a new pair is a copy of.
  explicit PairSolvers(const Solver<S, Others>& first) : first_(first) {}
  std::size_t pair_count() const { return kept_.size(); }  ///< pairs remembered

 protected:
  /// Forgets the pairs that did not come in the step that ends.
  void start_step() {
    std::erase_if(kept_, [this](const auto& entry) { return entry.second.step != step_; });
    ++step_;
  }
  /// The pair's solver: the order of the objects counts.
  const Solver<S, Others>& of(const Object* a, const Object* b) {
    Kept& kept = kept_.try_emplace({a, b}, first_).first->second;
    kept.step = step_;
    return kept.solver;
  }

 private:
  struct Kept {
    explicit Kept(const Solver<S, Others>& first) : solver(first) {}
    Solver<S, Others> solver;
    std::uint64_t step = 0;  ///< in which the pair last came
  };
  using Key = std::pair<const Object*, const Object*>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return std::hash<const Object*>()(key.first) * 31 + std::hash<const Object*>()(key.second);
    }
  };
  Solver<S, Others> first_;
  std::unordered_map<Key, Kept, Hash> kept_;
  std::uint64_t step_ = 0;
};

/// For a manager's `collide`: contacts of all pairs in one result, until there are as many as the request wants.
template <class S, class Others = ::fcl::detail::GJKSolver_libccd<S>>
class CollisionPairs : public PairSolvers<S, Others> {
 public:
  ::fcl::CollisionRequest<S> request;  ///< of every pair
  ::fcl::CollisionResult<S> result;    ///< of the step

  /// `first`: what the solver of a new pair is a copy of.
  explicit CollisionPairs(const Solver<S, Others>& first = {}) : PairSolvers<S, Others>(first) {}
  /// Before each `collide` of the manager.
  void start_step() {
    PairSolvers<S, Others>::start_step();
    result.clear();
  }
  /// An fcl::CollisionCallBack; `pairs` is a CollisionPairs.
  static bool callback(::fcl::CollisionObject<S>* a, ::fcl::CollisionObject<S>* b, void* pairs) {
    auto& self = *static_cast<CollisionPairs*>(pairs);
    if (!self.request.isSatisfied(self.result)) ::fcl::collide(a, b, &self.of(a, b), self.request, self.result);
    return self.request.isSatisfied(self.result);
  }
};

/// For a manager's `distance`: the least of all pairs.
template <class S, class Others = ::fcl::detail::GJKSolver_libccd<S>>
class DistancePairs : public PairSolvers<S, Others> {
 public:
  ::fcl::DistanceRequest<S> request;  ///< of every pair
  ::fcl::DistanceResult<S> result;    ///< of the step

  /// `first`: what the solver of a new pair is a copy of.
  explicit DistancePairs(const Solver<S, Others>& first = {}) : PairSolvers<S, Others>(first) {}
  /// Before each `distance` of the manager.
  void start_step() {
    PairSolvers<S, Others>::start_step();
    result.clear();
  }
  /// An fcl::DistanceCallBack; `pairs` is a DistancePairs. Ends the search at the first pair that touches or overlaps.
  static bool callback(::fcl::CollisionObject<S>* a, ::fcl::CollisionObject<S>* b, void* pairs, S& least) {
    auto& self = *static_cast<DistancePairs*>(pairs);
    if (!(self.result.min_distance <= 0)) ::fcl::distance(a, b, &self.of(a, b), self.request, self.result);
    least = self.result.min_distance;
    return least <= 0;
  }
};

}  // namespace swiftlet::fcl

namespace fcl::detail {

/// FCL's table of collisions, in which functions of BVHModels ask for meshes of ours first.
template <class S_, class Others>
struct CollisionFunctionMatrix<swiftlet::fcl::Solver<S_, Others>>
    : CollisionFunctionMatrix<swiftlet::fcl::ShapeSolver<S_, Others>> {
  /// Takes the place of all functions of a BVHModel that FCL has.
  CollisionFunctionMatrix() {
    for (int i = BV_AABB; i < GEOM_BOX; ++i) {
      for (auto& function : this->collision_matrix[i])
        if (function) function = &swiftlet::fcl::MeshFunctions<S_, Others>::collide;
    }
  }
};

/// FCL's table of distances, likewise.
template <class S_, class Others>
struct DistanceFunctionMatrix<swiftlet::fcl::Solver<S_, Others>>
    : DistanceFunctionMatrix<swiftlet::fcl::ShapeSolver<S_, Others>> {
  /// Takes the place of all functions of a BVHModel that FCL has.
  DistanceFunctionMatrix() {
    for (int i = BV_AABB; i < GEOM_BOX; ++i) {
      for (auto& function : this->distance_matrix[i])
        if (function) function = &swiftlet::fcl::MeshFunctions<S_, Others>::distance;
    }
  }
};

}  // namespace fcl::detail

/// FCL's tables of functions by shape, compiled once; they are half a minute of a translation unit otherwise.
extern template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::ShapeSolver<double>>;
extern template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::ShapeSolver<double>>;
extern template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::ShapeSolver<float>>;
extern template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::ShapeSolver<float>>;
