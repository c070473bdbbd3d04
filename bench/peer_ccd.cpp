// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// libccd 2.1 as a method: two booleans, as its public header has no distance (its GJK distance lives in FCL: peer_fcl.cpp).
// Knows libccd and Method.
//
// Settings: double precision, as Debian builds it. Supports climb over the vertex graph from the pair's last vertex, its best
// case. GJK starts from the direction that its last query of the pair ended with (which libccd does not tell, so the support
// function notes it); it says "apart" also when its iterations end, hence a cap that is never met. MPR starts from the centres,
// always, and has no warm start; its mpr_tolerance 1e-4 would be an error of that size, 1e-12 ends where rounding does.
#include <cmath>
#include <memory>
#include <vector>

#include <ccd/ccd.h>
#include <ccd/quat.h>

#include "hull.h"
#include "method.h"

namespace swiftlet::bench {
namespace {

#ifndef CCD_DOUBLE
#error "libccd in single precision: its rows would not be comparable"
#endif

struct First {
  Climber climber;
  Vec3 centre_a;
  ccd_vec3_t direction{{1, 0, 0}};
};
struct Second {
  Climber climber;
  Vec3 centre_b;
  const Pose* pose = nullptr;
};

ccd_vec3_t vec_of(const Vec3& p) { return {{p[0], p[1], p[2]}}; }

void first_direction(const void* a, const void*, ccd_vec3_t* direction) {
  *direction = static_cast<const First*>(a)->direction;
}
void support_a(const void* a, const ccd_vec3_t* direction, ccd_vec3_t* point_a) {
  First& first = *static_cast<First*>(const_cast<void*>(a));
  first.direction = *direction;
  const Graph::Node& n = first.climber.support(direction->v[0], direction->v[1], direction->v[2]);
  *point_a = {{n.x, n.y, n.z}};
}
void support_b(const void* b, const ccd_vec3_t* direction, ccd_vec3_t* point_a) {
  Second& second = *static_cast<Second*>(const_cast<void*>(b));
  const Pose& pose = *second.pose;
  const Vec3 d_b = pose.rotation.transpose() * Vec3(direction->v[0], direction->v[1], direction->v[2]);
  const Graph::Node& n = second.climber.support(d_b[0], d_b[1], d_b[2]);
  *point_a = vec_of(pose.rotation * Vec3(n.x, n.y, n.z) + pose.translation);
}
void centre_a(const void* a, ccd_vec3_t* point_a) { *point_a = vec_of(static_cast<const First*>(a)->centre_a); }
void centre_b(const void* b, ccd_vec3_t* point_a) {
  const Second& second = *static_cast<const Second*>(b);
  *point_a = vec_of(second.pose->rotation * second.centre_b + second.pose->translation);
}

using Decide = int (*)(const void*, const void*, const ccd_t*);
using Deepen = int (*)(const void*, const void*, const ccd_t*, ccd_real_t* depth, ccd_vec3_t* direction, ccd_vec3_t* point);

class CcdSession final : public SessionOf<CcdSession> {
 public:
  CcdSession(Decide decide, Deepen deepen, std::span<const SceneBody> bodies, std::span<const BodyPair> pairs)
      : decide_(decide), deepen_(deepen) {
    preparation_ = measured([&] {
      graphs_.reserve(bodies.size());
      for (const SceneBody& body : bodies) graphs_.emplace_back(body.view);
    });
    for (const BodyPair& p : pairs) {
      pairs_.push_back(
          {First{Climber(graphs_[p.a]), bodies[p.a].view.centre}, Second{Climber(graphs_[p.b]), bodies[p.b].view.centre}});
    }
    CCD_INIT(&ccd_);
    ccd_.first_dir = first_direction;
    ccd_.support1 = support_a;
    ccd_.support2 = support_b;
    ccd_.center1 = centre_a;
    ccd_.center2 = centre_b;
    ccd_.max_iterations = 1000;
    ccd_.mpr_tolerance = ccd_.epa_tolerance = 1e-12;
  }
  Outcome distance(std::uint32_t, const Pose&) override { return {.failed = true}; }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    s.b.pose = &b_in_a;
    return {.overlapping = decide_(&s.a, &s.b, &ccd_) == 1};
  }
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    s.b.pose = &b_in_a;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, point;
    const int result = deepen_(&s.a, &s.b, &ccd_, &depth, &direction, &point);
    return {.distance = depth, .overlapping = result == 0, .failed = result < -1};
  }
  void forget() override {
    for (State& s : pairs_) s.a.climber.forget(), s.b.climber.forget(), s.a.direction = {{1, 0, 0}};
  }

 private:
  struct State {
    First a;
    Second b;
  };
  Decide decide_;
  Deepen deepen_;
  std::vector<Graph> graphs_;
  std::vector<State> pairs_;
  ccd_t ccd_;
};

class CcdMethod final : public Method {
 public:
  CcdMethod(const char* name, const char* settings, Decide decide, Deepen deepen)
      : name_(name), settings_(settings), decide_(decide), deepen_(deepen) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  Capabilities capabilities() const override { return {.intersects = true, .depth = true}; }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<CcdSession>(decide_, deepen_, bodies, pairs);
  }

 private:
  std::string name_, settings_;
  Decide decide_;
  Deepen deepen_;
};

}  // namespace

void add_ccd(Methods& methods) {
  methods.push_back(std::make_unique<CcdMethod>(
      "libccd gjk", "libccd 2, double, last vertices and last direction cached; depth by its EPA to 1e-12", ccdGJKIntersect,
      ccdGJKPenetration));
  methods.push_back(std::make_unique<CcdMethod>(
      "libccd mpr", "libccd 2, double, last vertices cached, tolerance 1e-12; depth along its portal", ccdMPRIntersect,
      ccdMPRPenetration));
}

}  // namespace swiftlet::bench
