// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Who is asked about, and in which pose. Knows models; nothing of how scenes are made or of methods.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::yardstick {

/// One body as every method gets it: the same vertices and faces for all.
struct SceneBody {
  const Model* model = nullptr;  ///< with its hierarchy and table; outlives the session
  ConvexView view;               ///< its level 0
  double build_seconds = 0;      ///< what the builder took from hull to model, as the scene measured it
};

/// Two bodies that are asked about: indices into the scene's bodies.
struct BodyPair {
  std::uint32_t a = 0, b = 0;
};

struct Query {
  std::uint32_t pair = 0;  ///< index into the pairs of the session
  Pose b_in_a;
};

}  // namespace swiftlet::yardstick
