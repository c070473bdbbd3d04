// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What every mesh query computes first: both bodies as a search reads them, the pose, and whether all of these are legal.
#pragma once

#include "numeric/vec4.h"
#include "pair/pair_view.h"
#include "query/radii.h"
#include "search.h"

namespace swiftlet {

struct MeshSetting {
  MeshSetting(const MeshBody& of_a, const MeshBody& of_b, const Pose& b_in_a)
      : MeshSetting(of_a, of_b, swiftlet::motion(b_in_a)) {}
  MeshSetting(const MeshBody& of_a, const MeshBody& of_b, const Motion& b_in_a)
      : MeshSetting(of_a, of_b, b_in_a, pose_quality(b_in_a)) {}
  MeshSetting(const MeshBody& of_a, const MeshBody& of_b, const Motion& b_in_a, const PoseQuality& of_pose)
      : a(of_a), b(of_b), motion(b_in_a), quality(of_pose), radii(of_a.radius(), of_b.radius()) {
    const double extent_a = a.root->extent + of_a.radius(), extent_b = b.root->extent + of_b.radius(), shift = norm(motion.t);
    size = max(extent_a, extent_b) + shift;
    law_two = swiftlet::law_two(extent_a, extent_b, shift, quality.error);
  }
  Status fault() const {
    if (!quality.legal) return Status::InvalidPose;
    if (!radii.legal()) return Status::InvalidRadius;
    return a.is_legal && b.is_legal ? Status::Converged : Status::InvalidBody;
  }

  const MeshView a, b;
  const Motion motion;
  const PoseQuality quality;
  const Radii radii;
  double size, law_two;
};

/// Fills an answer, but for its status, from what was found about the surfaces: bounds, verdict, points, normal, features and
/// levels, with the bodies' radii.
void describe(const MeshSetting& at, const MeshFinding& found, Answer& answer);

/// A feature of an answer by the user's ids; of a convex body none unless the answer is on level 0.
SourceFeature source_feature(const MeshBody& body, FeatureId feature, int level);

}  // namespace swiftlet
