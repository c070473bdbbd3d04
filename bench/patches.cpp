// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "patches.h"

#include <swiftlet/depth.h>
#include <swiftlet/patch.h>

namespace swiftlet::bench {
namespace {

/// Of hulls that overlap or are apart, by four points within the margin that Bullet takes.
class SwiftletPatches final : public PatchSession {
 public:
  SwiftletPatches(const Body& a, const Body& b, bool cold) : a_(*a.model), b_(*b.model), cold_(cold) { options_.margin = 0.02; }
  void ask(std::span<const Pose> poses, std::span<Contacts> contacts) override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (cold_) seed_ = {}, before_ = {};
      before_ = patch(a_, b_, poses[i], signed_distance(a_, b_, poses[i], seed_), options_, before_);
      Contacts& c = contacts[i];
      c.count = before_.count;
      for (std::uint32_t k = 0; k < c.count; ++k) c.points[k] = {before_.points[k].point_a, before_.points[k].point_b};
    }
  }

 private:
  const Model &a_, &b_;
  const bool cold_;
  PatchOptions options_;
  PairSeed seed_;
  Patch before_;
};

}  // namespace

PatchMethods patch_methods() {
  PatchMethods methods{{"swiftlet", "signed_distance, exact, and a patch of four points", true,
                        [](const Body& a, const Body& b, bool cold) { return std::make_unique<SwiftletPatches>(a, b, cold); }}};
#ifdef SWIFTLET_PEER_BULLET
  add_bullet_patches(methods);
#endif
#ifdef SWIFTLET_PEER_ODE
  add_ode_patches(methods);
#endif
  return methods;
}

}  // namespace swiftlet::bench
