// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// FCL's trees of OBBRSS as two methods, with the best honest settings:
// - "fcl": its public calls. A threshold is the distance that the result starts with: nothing farther is looked at, as its
//   collision of meshes has no margin. The relative error of a request is set, and never read for two meshes.
// - "fcl node": its traversal node, called directly and completed as one who knows it would: the pair of triangles that was
//   nearest in the last pose is measured first, as PQP does, a threshold ends at the first pair below it, and the node's own
//   relative error is in force, which takes an absolute one without limit.
#include <limits>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>
#include <fcl/narrowphase/distance.h>

#include "heap.h"
#include "method.h"

#ifdef SWIFTLET_FCL_NATIVE
namespace fcl {
template class OBB<double>;
template class RSS<double>;
template class OBBRSS<double>;
template bool obbDisjoint(const Matrix3d&, const Vector3d&, const Vector3d&, const Vector3d&);
template bool obbDisjoint(const Transform3d&, const Vector3d&, const Vector3d&);
template void clipToRange(double&, double, double);
template void segCoords(double&, double&, double, double, double, double, double);
template bool inVoronoi(double, double, double, double, double, double, double);
template double rectDistance(const Matrix3d&, const Vector3d&, const double[2], const double[2], Vector3d*, Vector3d*);
template double rectDistance(const Transform3d&, const double[2], const double[2], Vector3d*, Vector3d*);
namespace detail {
template class Intersect<double>;
template class TriangleDistance<double>;
template class MeshCollisionTraversalNodeOBBRSS<double>;
template class MeshDistanceTraversalNodeOBBRSS<double>;
template void collisionRecurse(CollisionTraversalNodeBase<double>*, int, int, BVHFrontList*);
template void distanceRecurse(DistanceTraversalNodeBase<double>*, int, int, BVHFrontList*);
template void collide(CollisionTraversalNodeBase<double>*, BVHFrontList*);
template void distance(DistanceTraversalNodeBase<double>*, BVHFrontList*, int);
}  // namespace detail
}  // namespace fcl
#endif

namespace swiftlet::bench::mesh {
namespace {

#ifdef SWIFTLET_FCL_NATIVE
constexpr const char* kBuild = "FCL " SWIFTLET_PEER_VERSION ", BVHModel<OBBRSSd>, -O3 -march=native, ";
#else
constexpr const char* kBuild = "FCL " SWIFTLET_PEER_VERSION ", BVHModel<OBBRSSd>, as installed, ";
#endif

using Tree = fcl::BVHModel<fcl::OBBRSSd>;

fcl::Transform3d transform_of(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation;
  t.translation() = pose.translation;
  return t;
}

void build(Tree& tree, const Mesh& mesh) {
  std::vector<fcl::Vector3d> points(mesh.points.begin(), mesh.points.end());
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  tree.beginModel(int(triangles.size()), int(points.size()));
  tree.addSubModel(points, triangles);
  tree.endModel();
}

/// Both bodies, and what the two methods share.
class FclSession : public Session {
 public:
  FclSession(const Mesh& a, const Mesh& b) {
    measure(*this, [&] { build(a_, a), build(b_, b); });
  }
  Reply ask(const Question& question, const Pose& b_in_a) final {
    const fcl::Transform3d pose = transform_of(b_in_a);
    if (question.kind == Kind::Intersects) return {.yes = intersects(pose)};
    if (question.kind == Kind::Contacts) return {.count = contacts(pose)};
    if (question.kind == Kind::Distance) return {.distance = std::max(0., distance(question, pose))};
    return {.yes = distance(question, pose) < question.threshold};
  }

 protected:
  inline static const fcl::Transform3d kIdentity = fcl::Transform3d::Identity();
  virtual bool intersects(const fcl::Transform3d& pose) = 0;
  /// How many contacts it makes of all pairs of triangles that cross.
  virtual std::size_t contacts(const fcl::Transform3d& pose) = 0;
  static fcl::CollisionRequestd all_contacts() { return fcl::CollisionRequestd(std::size_t(1) << 24, true); }
  /// Of Within any distance on the same side of the threshold.
  virtual double distance(const Question& question, const fcl::Transform3d& pose) = 0;

  Tree a_, b_;
};

#ifndef SWIFTLET_FCL_NATIVE
class PublicSession final : public FclSession {
 public:
  using FclSession::FclSession;

 private:
  bool intersects(const fcl::Transform3d& pose) override {
    fcl::CollisionResultd result;
    return fcl::collide<double>(&a_, kIdentity, &b_, pose, fcl::CollisionRequestd(1, false), result) > 0;
  }
  std::size_t contacts(const fcl::Transform3d& pose) override {
    fcl::CollisionResultd result;
    return fcl::collide<double>(&a_, kIdentity, &b_, pose, all_contacts(), result);
  }
  double distance(const Question& question, const fcl::Transform3d& pose) override {
    fcl::DistanceResultd result;
    if (question.kind == Kind::Within) result.min_distance = question.threshold;
    fcl::distance<double>(&a_, kIdentity, &b_, pose, fcl::DistanceRequestd(false, false, question.relative, 0), result);
    return result.min_distance;
  }
};
#endif

class Node final : public fcl::detail::MeshDistanceTraversalNodeOBBRSSd {
 public:
  int first_a = 0, first_b = 0;                              ///< the triangles that are measured first
  double enough = -std::numeric_limits<double>::infinity();  ///< what is nearer ends the search

  void preprocess() override {
    fcl::detail::distancePreprocessOrientedNode(model1, model2, vertices1, vertices2, tri_indices1, tri_indices2, first_a,
                                                first_b, tf, request, *result);
  }
  bool canStop(double bound) const override {
    return result->min_distance < enough || fcl::detail::MeshDistanceTraversalNodeOBBRSSd::canStop(bound);
  }
};

class NodeSession final : public FclSession {
 public:
  using FclSession::FclSession;

 private:
  bool intersects(const fcl::Transform3d& pose) override {
    fcl::CollisionResultd result;
    fcl::detail::MeshCollisionTraversalNodeOBBRSSd node;
    fcl::detail::initialize(node, a_, kIdentity, b_, pose, fcl::CollisionRequestd(1, false), result);
    fcl::detail::collide<double>(&node);
    return result.isCollision();
  }
  std::size_t contacts(const fcl::Transform3d& pose) override {
    fcl::CollisionResultd result;
    fcl::detail::MeshCollisionTraversalNodeOBBRSSd node;
    fcl::detail::initialize(node, a_, kIdentity, b_, pose, all_contacts(), result);
    fcl::detail::collide<double>(&node);
    return result.numContacts();
  }
  double distance(const Question& question, const fcl::Transform3d& pose) override {
    fcl::DistanceResultd result;
    Node node;
    fcl::detail::initialize(node, a_, kIdentity, b_, pose, fcl::DistanceRequestd(false, false), result);
    node.first_a = last_a_, node.first_b = last_b_;
    if (question.kind == Kind::Within) result.min_distance = node.enough = question.threshold;
    if (question.relative > 0) {
      node.rel_err = question.relative;
      node.abs_err = std::numeric_limits<double>::infinity();
    }
    fcl::detail::distance<double>(&node);
    if (result.b1 >= 0) last_a_ = int(result.b1), last_b_ = int(result.b2);
    return result.min_distance;
  }
  int last_a_ = 0, last_b_ = 0;
};

template <class Of>
class FclMethod final : public Method {
 public:
  FclMethod(const char* name, const char* settings) : name_(name), settings_(settings) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return kBuild + settings_; }
  /// Its contacts are those of triangles that cross: it has no reach, no region and no depth of meshes.
  bool can(const Question& question) const override {
    return question.kind <= Kind::Distance || (question.kind == Kind::Contacts && question.threshold == 0);
  }
  std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const override { return std::make_unique<Of>(a, b); }

 private:
  std::string name_, settings_;
};

}  // namespace

#ifdef SWIFTLET_FCL_NATIVE
void add_fcl_native(Methods& methods) {
  methods.push_back(std::make_unique<FclMethod<NodeSession>>("fcl native", "its traversal from the last nearest triangles"));
}
#else
void add_fcl(Methods& methods) {
  methods.push_back(std::make_unique<FclMethod<PublicSession>>("fcl", "its public calls"));
  methods.push_back(std::make_unique<FclMethod<NodeSession>>("fcl node", "its traversal from the last nearest triangles"));
}
#endif

}  // namespace swiftlet::bench::mesh
