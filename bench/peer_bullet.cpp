// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bullet 3.24 as a method: its two GJKs, on its own hull shape and on one that climbs. Knows Bullet's headers and Method.
//
// Settings: Debian's double-precision libraries (-float64), BT_USE_DOUBLE_PRECISION, margin 0 (else every distance is 0.08
// short and rounded bodies are compared), no depth solver, so that an overlap ends the query; but see "bullet epa".
// - "bullet": btGjkPairDetector on btConvexHullShape, what the engine does for two hulls. Every support scans all vertices.
// Detector and
//   Voronoi simplex solver live with the pair, but Bullet resets both at each query: it has no warm start to offer.
// - "bullet climb": the same detector on a custom btConvexInternalShape whose support climbs from the pair's last vertex.
// - "bullet guess climb": btGjkEpaSolver2::Distance on that shape with the last separating vector as its guess: Bullet's only
//   distance with a warm start. Some 4 % of its answers are wrong, by up to 1 r, with any guess: it ends at a degenerate
//   tetrahedron with the last ray and says nothing. FCL's indep solver descends from this code.
// - "bullet epa": "bullet" with the depth solver, as Bullet's collision worlds run it. GJK alone takes some overlaps for gaps
// of
//   1e-15; its detector then asks EPA. Judged, not timed: the depth is more than a query asks for.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "hull.h"
#include "manifolds.h"
#include "method.h"

namespace swiftlet::bench {
namespace {

#ifdef BT_USE_DOUBLE_PRECISION
constexpr const char* kBuild = "Bullet " SWIFTLET_PEER_VERSION ", double, margin 0, ";
constexpr double kStatedError = 1e-5;  // 3e-6 on long bodies of 2 000 triangles, rounding else
#else
constexpr const char* kBuild = "Bullet " SWIFTLET_PEER_VERSION ", SINGLE precision (no double build found), margin 0, ";
constexpr double kStatedError = 1e-3;
#endif

btTransform transform_of(const Pose& pose) {
  const Mat3& r = pose.rotation;
  const Vec3& t = pose.translation;
  return btTransform(btMatrix3x3(btScalar(r(0, 0)), btScalar(r(0, 1)), btScalar(r(0, 2)), btScalar(r(1, 0)), btScalar(r(1, 1)),
                                 btScalar(r(1, 2)), btScalar(r(2, 0)), btScalar(r(2, 1)), btScalar(r(2, 2))),
                     btVector3(btScalar(t[0]), btScalar(t[1]), btScalar(t[2])));
}

std::unique_ptr<btConvexHullShape> shape_of(const ConvexView& view) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vertex& v : view.vertices) shape->addPoint(btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)), false);
  shape->recalcLocalAabb();
  shape->setMargin(0);
  return shape;
}

/// A convex shape of the user's own, as Bullet lets one write it.
class ClimbShape final : public btConvexInternalShape {
 public:
  explicit ClimbShape(const Graph& graph) : climber_(graph) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    setMargin(0);
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const Graph::Node& n = climber_.support(direction.x(), direction.y(), direction.z());
    return btVector3(btScalar(n.x), btScalar(n.y), btScalar(n.z));
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const override {
    return localGetSupportingVertexWithoutMargin(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points,
                                                         int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "climb"; }
  void forget() { climber_.forget(); }

 private:
  mutable Climber climber_;
};

// ---- What the two kinds of shape give to a pair ----------------------------------------------------------------------------

struct Hulls {
  std::vector<std::unique_ptr<btConvexHullShape>> all;
  void prepare(std::span<const SceneBody> bodies) {
    for (const SceneBody& body : bodies) all.push_back(shape_of(body.view));
  }
  btConvexShape* share(std::uint32_t body) { return all[body].get(); }
  void forget() {}
};

struct Climbs {
  std::vector<Graph> graphs;
  std::vector<std::unique_ptr<ClimbShape>> all;
  void prepare(std::span<const SceneBody> bodies) {
    graphs.reserve(bodies.size());
    for (const SceneBody& body : bodies) graphs.emplace_back(body.view);
  }
  btConvexShape* share(std::uint32_t body) {  // one per pair and side, for its last vertex
    all.push_back(std::make_unique<ClimbShape>(graphs[body]));
    return all.back().get();
  }
  void forget() {
    for (const auto& shape : all) shape->forget();
  }
};

// ---- btGjkPairDetector -----------------------------------------------------------------------------------------------------

enum class Depth { None, Epa };

template <class Shapes, Depth kDepth = Depth::None>
class DetectorSession final : public SessionOf<DetectorSession<Shapes, kDepth>> {
 public:
  DetectorSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) {
    this->preparation_ = measured([&] { shapes_.prepare(bodies); });
    for (const BodyPair& p : pairs) pairs_.push_back(std::make_unique<State>(shapes_.share(p.a), shapes_.share(p.b)));
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = *pairs_[pair];
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA.setIdentity();
    input.m_transformB = transform_of(b_in_a);
    btPointCollector collector;
    s.detector.getClosestPoints(input, collector, nullptr);
    const auto steps = std::uint32_t(std::max(0, s.detector.m_curIter));
    // Without a depth solver nothing is reported for an overlap, nor where the simplex degenerates just above one.
    if (!collector.m_hasResult) return {.overlapping = true, .steps = steps, .plane_tests = 2 * steps};
    if (!std::isfinite(collector.m_distance)) return {.failed = true, .steps = steps, .plane_tests = 2 * steps};
    if (kDepth == Depth::Epa && collector.m_distance < 0)
      return {.overlapping = true, .steps = steps, .plane_tests = 2 * steps};
    return {.distance = std::max(0., double(collector.m_distance)), .steps = steps, .plane_tests = 2 * steps};
  }
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA.setIdentity();
    input.m_transformB = transform_of(b_in_a);
    btPointCollector collector;
    pairs_[pair]->detector.getClosestPoints(input, collector, nullptr);
    if (!collector.m_hasResult || !std::isfinite(collector.m_distance)) return {.failed = true};
    return {.distance = std::fabs(double(collector.m_distance)), .overlapping = collector.m_distance <= 0};
  }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override { return distance(pair, b_in_a); }  // none is cheaper
  void forget() override { shapes_.forget(); }

 private:
  struct State {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btGjkPairDetector detector;
    State(btConvexShape* a, btConvexShape* b) : detector(a, b, &simplex, kDepth == Depth::Epa ? &epa : nullptr) {}
  };
  Shapes shapes_;
  std::vector<std::unique_ptr<State>> pairs_;
};

// ---- btGjkEpaSolver2 -------------------------------------------------------------------------------------------------------

class GuessSession final : public SessionOf<GuessSession> {
 public:
  GuessSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) {
    preparation_ = measured([&] { shapes_.prepare(bodies); });
    for (const BodyPair& p : pairs) pairs_.push_back({shapes_.share(p.a), shapes_.share(p.b), kCold});
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    btGjkEpaSolver2::sResults results;
    if (!btGjkEpaSolver2::Distance(s.a, btTransform::getIdentity(), s.b, transform_of(b_in_a), s.guess, results)) {
      s.guess = kCold;
      const bool inside = results.status == btGjkEpaSolver2::sResults::Penetrating;
      return {.overlapping = inside, .failed = !inside};
    }
    if (!std::isfinite(results.distance)) return {.failed = true};
    s.guess = results.witnesses[0] - results.witnesses[1];
    return {.distance = double(results.distance)};
  }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override { return distance(pair, b_in_a); }
  void forget() override {
    shapes_.forget();
    for (State& s : pairs_) s.guess = kCold;
  }

 private:
  inline static const btVector3 kCold{1, 0, 0};
  struct State {
    const btConvexShape *a, *b;
    btVector3 guess;
  };
  Climbs shapes_;
  std::vector<State> pairs_;
};

// ---- btConvexConvexAlgorithm ------------------------------------------------------------------------------------------------

Vec3 vec3(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }

void append(const btPersistentManifold& manifold, Contacts& contacts) {
  for (int k = 0; k < manifold.getNumContacts() && contacts.count < Contacts::kMost; ++k) {
    const btManifoldPoint& p = manifold.getContactPoint(k);
    contacts.points[contacts.count++] = {vec3(p.getPositionWorldOnA()), vec3(p.getPositionWorldOnB())};
  }
}

/// A world's pair: its algorithm, and the manifold of up to four points that it keeps.
class BulletManifolds final : public ManifoldSession {
 public:
  BulletManifolds(const SceneBody& a, const SceneBody& b, bool polyhedral, bool cold)
      : cold_(cold), shape_a_(shape_of(a.view)), shape_b_(shape_of(b.view)) {
    if (polyhedral) shape_a_->initializePolyhedralFeatures(), shape_b_->initializePolyhedralFeatures();
    object_a_.setCollisionShape(shape_a_.get()), object_b_.setCollisionShape(shape_b_.get());
    object_a_.setWorldTransform(btTransform::getIdentity());
    renew();
  }
  ~BulletManifolds() override { release(); }
  void ask(std::span<const Pose> poses, std::span<const Answer>, std::span<Contacts> contacts) override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (cold_) release(), renew();
      object_b_.setWorldTransform(transform_of(poses[i]));
      const btCollisionObjectWrapper a(nullptr, shape_a_.get(), &object_a_, object_a_.getWorldTransform(), -1, -1),
          b(nullptr, shape_b_.get(), &object_b_, object_b_.getWorldTransform(), -1, -1);
      btManifoldResult result(&a, &b);
      algorithm_->processCollision(&a, &b, info_, &result);
      take(contacts[i]);
    }
  }

 private:
  void renew() {
    const btCollisionObjectWrapper a(nullptr, shape_a_.get(), &object_a_, object_a_.getWorldTransform(), -1, -1),
        b(nullptr, shape_b_.get(), &object_b_, object_b_.getWorldTransform(), -1, -1);
    algorithm_ = dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  void release() {
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }
  void take(Contacts& c) {
    btManifoldArray manifolds;
    algorithm_->getAllContactManifolds(manifolds);
    c.count = 0;
    for (int m = 0; m < manifolds.size(); ++m) append(*manifolds[m], c);
  }

  const bool cold_;
  std::unique_ptr<btConvexHullShape> shape_a_, shape_b_;
  btCollisionObject object_a_, object_b_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo info_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

/// The first points that a clipping reports.
class FirstPoints final : public btDiscreteCollisionDetectorInterface::Result {
 public:
  explicit FirstPoints(Contacts& contacts) : contacts_(contacts) { contacts_.count = 0; }
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal, const btVector3& on_b, btScalar distance) override {
    if (contacts_.count < Contacts::kMost) contacts_.points[contacts_.count++] = {vec3(on_b + normal * distance), vec3(on_b)};
  }

 private:
  Contacts& contacts_;
};

enum class Reports { FirstPoints, FourPoints };

/// The part of btConvexConvexAlgorithm that clips, along the normal of a given answer: alone, or with the manifold that keeps
/// four points of what it reports.
template <Reports reports>
class BulletClipping final : public ManifoldSession {
 public:
  BulletClipping(const SceneBody& a, const SceneBody& b, bool cold)
      : cold_(cold), shape_a_(shape_of(a.view)), shape_b_(shape_of(b.view)) {
    shape_a_->initializePolyhedralFeatures(), shape_b_->initializePolyhedralFeatures();
    object_a_.setCollisionShape(shape_a_.get()), object_b_.setCollisionShape(shape_b_.get());
    object_a_.setWorldTransform(btTransform::getIdentity());
  }
  void ask(std::span<const Pose> poses, std::span<const Answer> answers, std::span<Contacts> contacts) override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      object_b_.setWorldTransform(transform_of(poses[i]));
      if constexpr (reports == Reports::FirstPoints) {
        FirstPoints result(contacts[i]);
        clip(answers[i].normal, result);
      } else {
        if (cold_) manifold_.clearManifold();
        const btCollisionObjectWrapper a(nullptr, shape_a_.get(), &object_a_, object_a_.getWorldTransform(), -1, -1),
            b(nullptr, shape_b_.get(), &object_b_, object_b_.getWorldTransform(), -1, -1);
        btManifoldResult result(&a, &b);
        result.setPersistentManifold(&manifold_);
        clip(answers[i].normal, result);
        result.refreshContactPoints();
        contacts[i].count = 0;
        append(manifold_, contacts[i]);
      }
    }
  }

 private:
  void clip(const Vec3& n, btDiscreteCollisionDetectorInterface::Result& result) {
    const btVector3 from_b_to_a(btScalar(-n[0]), btScalar(-n[1]), btScalar(-n[2]));
    btPolyhedralContactClipping::clipHullAgainstHull(
        from_b_to_a, *shape_a_->getConvexPolyhedron(), *shape_b_->getConvexPolyhedron(), object_a_.getWorldTransform(),
        object_b_.getWorldTransform(), -1, gContactBreakingThreshold, corners_, kept_corners_, result);
  }

  const bool cold_;
  std::unique_ptr<btConvexHullShape> shape_a_, shape_b_;
  btCollisionObject object_a_, object_b_;
  btPersistentManifold manifold_{&object_a_, &object_b_, 0, gContactBreakingThreshold, gContactBreakingThreshold};
  btVertexArray corners_, kept_corners_;  // the room that clipping works in, as the algorithm keeps it
};

template <class SessionType>
class BulletMethod final : public Method {
 public:
  BulletMethod(const char* name, const char* settings, double wrong_share, bool depth = false)
      : name_(name), settings_(std::string(kBuild) + settings), wrong_share_(wrong_share), depth_(depth) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  Capabilities capabilities() const override {
    return {.distance = true, .intersects = true, .depth = depth_, .stated_error = kStatedError, .wrong_share = wrong_share_};
  }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<SessionType>(bodies, pairs);
  }

 private:
  std::string name_, settings_;
  double wrong_share_;
  bool depth_;
};

}  // namespace

void add_bullet_epa(Methods& methods) {
  methods.push_back(std::make_unique<BulletMethod<DetectorSession<Hulls, Depth::Epa>>>(
      "bullet epa", "btGjkPairDetector on btConvexHullShape with btGjkEpaPenetrationDepthSolver", 0, true));
}

void add_bullet_manifolds(ManifoldMethods& methods) {
  for (const bool polyhedral : {true, false}) {
    methods.push_back({polyhedral ? "bullet polyhedral" : "bullet manifold",
                       std::string(kBuild) + "btConvexConvexAlgorithm and its manifold" + (polyhedral ? ", clipped faces" : ""),
                       true, [polyhedral](const SceneBody& a, const SceneBody& b, bool cold) {
                         return std::make_unique<BulletManifolds>(a, b, polyhedral, cold);
                       }});
  }
  methods.push_back({"bullet clip", std::string(kBuild) + "btPolyhedralContactClipping, given the normal", false,
                     [](const SceneBody& a, const SceneBody& b, bool cold) {
                       return std::make_unique<BulletClipping<Reports::FirstPoints>>(a, b, cold);
                     }});
  methods.push_back({"bullet clip four", std::string(kBuild) + "the same, and its manifold of four points", true,
                     [](const SceneBody& a, const SceneBody& b, bool cold) {
                       return std::make_unique<BulletClipping<Reports::FourPoints>>(a, b, cold);
                     }});
}

void add_bullet(Methods& methods) {
  methods.push_back(
      std::make_unique<BulletMethod<DetectorSession<Hulls>>>("bullet", "btGjkPairDetector on btConvexHullShape", 0));
  methods.push_back(std::make_unique<BulletMethod<DetectorSession<Climbs>>>(
      "bullet climb", "btGjkPairDetector with our support from the last vertex", 0));
  methods.push_back(std::make_unique<BulletMethod<GuessSession>>(
      "bullet guess climb", "btGjkEpaSolver2 with our support from the last vertex, last separating vector as guess", 0.08));
}

}  // namespace swiftlet::bench
