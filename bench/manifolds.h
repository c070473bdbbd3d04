// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The interface behind which methods that answer with several contact points stand in the benchmark. Knows models and poses;
// nothing of scenes, clocks or truth.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/query.h>

#include "method.h"

namespace swiftlet::bench {

/// What one query answered, in A's frame.
struct Contacts {
  static constexpr std::uint32_t kMost = 8;
  struct Point {
    Vec3 on_a, on_b;
  };
  std::uint32_t count = 0;
  std::array<Point, kMost> points;
};

/// A method with one pair of bodies.
class ManifoldSession {
 public:
  virtual ~ManifoldSession() = default;
  /// One after the other. The other two are as long as the poses; the answers are our signed distances, for methods that are
  /// given the direction of the contact and find its points alone.
  virtual void ask(std::span<const Pose> poses, std::span<const Answer> answers, std::span<Contacts> contacts) = 0;
};

struct ManifoldMethod {
  std::string name, settings;
  bool keeps_state = false;  ///< from query to query: else coherent and cold are one
  /// The bodies outlive the session. Cold: nothing is kept from query to query.
  std::function<std::unique_ptr<ManifoldSession>(const SceneBody& a, const SceneBody& b, bool cold)> open;
};
using ManifoldMethods = std::vector<ManifoldMethod>;

/// Ours first, then the peers that the build found and that give more than one point of two hulls.
ManifoldMethods manifold_methods();

// Each in its own source.
void add_bullet_manifolds(ManifoldMethods& methods);
void add_ode_manifolds(ManifoldMethods& methods);

}  // namespace swiftlet::bench
