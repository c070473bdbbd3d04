// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// ODE 0.16 as a method: a boolean, as it has no distance. Knows ODE's headers and Method.
//
// Settings: double precision, as Debian builds it; dCollide on two convex geoms of one pair, one contact asked for. It keeps
// nothing between queries, and there is nothing to set. Bodies whose boxes miss each other cost it next to nothing. Preparing a
// geom is quadratic in its edges: 3 ms for 2 000 triangles, 0.3 s for 20 000.
#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include <ode/ode.h>

#include "hull.h"
#include "manifolds.h"
#include "method.h"

namespace swiftlet::bench {
namespace {

#ifndef dDOUBLE
#error "ODE in single precision: its rows would not be comparable"
#endif

/// What dCreateConvex points into.
struct Arrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> loops;
  unsigned face_count = 0;

  explicit Arrays(const ConvexView& view) : loops(face_loops<unsigned>(view)), face_count(unsigned(view.face_first.size())) {
    for (const Vertex& v : view.vertices) points.insert(points.end(), {v.x, v.y, v.z});
    for (std::size_t at = 0; at < loops.size(); at += 1 + loops[at]) {
      const auto point = [&](std::size_t k) {
        const dReal* p = &points[3 * loops[at + 1 + k]];
        return Vec3(p[0], p[1], p[2]);
      };
      Vec3 normal = Vec3::Zero();  // Newell's, about the first vertex
      for (std::size_t k = 1; k + 1 < loops[at]; ++k) {
        const Vec3 u = point(k) - point(0), v = point(k + 1) - point(0);
        normal += Vec3(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
      }
      normal /= normal.norm();
      planes.insert(planes.end(), {normal[0], normal[1], normal[2], normal.dot(point(0))});
    }
  }
  dGeomID geom() const {
    return dCreateConvex(nullptr, planes.data(), face_count, points.data(), unsigned(points.size() / 3), loops.data());
  }
};

void start() {
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
}

int collide(dGeomID a, dGeomID b, const Pose& b_in_a, int most, dContactGeom* contacts) {
  dMatrix3 rotation{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation[4 * i + j] = b_in_a.rotation(i, j);
  }
  dGeomSetRotation(b, rotation);
  dGeomSetPosition(b, b_in_a.translation[0], b_in_a.translation[1], b_in_a.translation[2]);
  return dCollide(a, b, most, contacts, sizeof(dContactGeom));
}

class OdeSession final : public SessionOf<OdeSession> {
 public:
  OdeSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) {
    start();
    preparation_ = measured([&] {
      arrays_.reserve(bodies.size());
      for (const SceneBody& body : bodies) arrays_.emplace_back(body.view);
      for (const BodyPair& p : pairs) pairs_.push_back({arrays_[p.a].geom(), arrays_[p.b].geom()});
    });
  }
  ~OdeSession() override {
    for (const State& s : pairs_) dGeomDestroy(s.a), dGeomDestroy(s.b);
  }
  Outcome distance(std::uint32_t, const Pose&) override { return {.failed = true}; }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    dContactGeom contact;
    return {.overlapping = collide(pair, b_in_a, 1, &contact) > 0};
  }
  /// The deepest of its contacts.
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    std::array<dContactGeom, 64> contacts;
    Outcome outcome;
    const int count = collide(pair, b_in_a, int(contacts.size()), contacts.data());
    for (int k = 0; k < count; ++k) outcome.distance = std::max(outcome.distance, double(contacts[std::size_t(k)].depth));
    outcome.overlapping = count > 0;
    return outcome;
  }
  void forget() override {}

 private:
  int collide(std::uint32_t pair, const Pose& b_in_a, int most, dContactGeom* contacts) const {
    return bench::collide(pairs_[pair].a, pairs_[pair].b, b_in_a, most, contacts);
  }

  struct State {
    dGeomID a, b;
  };
  std::vector<Arrays> arrays_;
  std::vector<State> pairs_;
};

class OdeMethod final : public Method {
 public:
  std::string name() const override { return "ode"; }
  std::string settings() const override {
    return "ODE " SWIFTLET_PEER_VERSION ", double, dCollide on convex geoms, no cache; depth the deepest of its contacts";
  }
  Capabilities capabilities() const override { return {.intersects = true, .depth = true, .max_triangles = 20'000}; }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<OdeSession>(bodies, pairs);
  }
};

/// The first contacts that fit; a normal points into A, a place lies halfway between the surfaces.
class OdeManifolds final : public ManifoldSession {
 public:
  OdeManifolds(const SceneBody& a, const SceneBody& b) : arrays_a_(a.view), arrays_b_(b.view) {
    start();
    a_ = arrays_a_.geom(), b_ = arrays_b_.geom();
  }
  ~OdeManifolds() override { dGeomDestroy(a_), dGeomDestroy(b_); }
  void ask(std::span<const Pose> poses, std::span<const Answer>, std::span<Contacts> contacts) override {
    std::array<dContactGeom, Contacts::kMost> found;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      Contacts& c = contacts[i];
      c.count = std::uint32_t(collide(a_, b_, poses[i], int(found.size()), found.data()));
      for (std::uint32_t k = 0; k < c.count; ++k) {
        const Vec3 place(found[k].pos[0], found[k].pos[1], found[k].pos[2]),
            normal(found[k].normal[0], found[k].normal[1], found[k].normal[2]);
        c.points[k] = {place - found[k].depth / 2 * normal, place + found[k].depth / 2 * normal};
      }
    }
  }

 private:
  Arrays arrays_a_, arrays_b_;
  dGeomID a_, b_;
};

}  // namespace

void add_ode_manifolds(ManifoldMethods& methods) {
  methods.push_back({"ode", "dCollide on convex geoms, at most eight contacts", false,
                     [](const SceneBody& a, const SceneBody& b, bool) { return std::make_unique<OdeManifolds>(a, b); }});
}

void add_ode(Methods& methods) { methods.push_back(std::make_unique<OdeMethod>()); }

}  // namespace swiftlet::bench
