// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifolds.h"

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>

namespace swiftlet::bench {
namespace {

enum class Part { All, GivenTheAnswer };

/// Of hulls that overlap or are apart, by four points within the margin that Bullet takes.
template <Part part>
class SwiftletManifolds final : public ManifoldSession {
 public:
  SwiftletManifolds(const SceneBody& a, const SceneBody& b, bool cold) : a_(*a.model), b_(*b.model), cold_(cold) {}
  void ask(std::span<const Pose> poses, std::span<const Answer> answers, std::span<Contacts> contacts) override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (cold_) seed_ = {}, before_ = {};
      const Answer& answer = part == Part::All ? signed_distance(a_, b_, poses[i], seed_) : answers[i];
      before_ = manifold(a_, b_, poses[i], answer, {.margin = 0.02}, before_);
      Contacts& c = contacts[i];
      c.count = before_.count;
      for (std::uint32_t k = 0; k < c.count; ++k) c.points[k] = {before_.points[k].point_a, before_.points[k].point_b};
    }
  }

 private:
  const Body a_, b_;
  const bool cold_;
  PairSeed seed_;
  Manifold before_;
};

template <Part part>
std::unique_ptr<ManifoldSession> open(const SceneBody& a, const SceneBody& b, bool cold) {
  return std::make_unique<SwiftletManifolds<part>>(a, b, cold);
}

}  // namespace

ManifoldMethods manifold_methods() {
  ManifoldMethods methods{{"swiftlet", "signed_distance, exact, and a manifold of four points", true, open<Part::All>},
                          {"swiftlet manifold", "the manifold, given the answer", true, open<Part::GivenTheAnswer>}};
#ifdef SWIFTLET_PEER_BULLET
  add_bullet_manifolds(methods);
#endif
#ifdef SWIFTLET_PEER_ODE
  add_ode_manifolds(methods);
#endif
  return methods;
}

}  // namespace swiftlet::bench
