// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

#include <algorithm>

namespace swiftlet::fcl {
namespace {

Vec3 centre_in_world(const Placed& body) { return body.in_world.rotation * body.model->centre() + body.in_world.translation; }

}  // namespace

std::vector<int> face_loops(const Model& model) {
  const ConvexView& view = model.level(model.finest_level()).view;
  std::vector<int> loops;
  for (std::uint32_t face = 0; face < view.face_first.size(); ++face) {
    const std::size_t size_at = loops.size();
    loops.push_back(0);
    for (const std::uint32_t v : FaceLoop(view, face)) loops.push_back(int(v));
    loops[size_at] = int(loops.size() - size_at - 1);
  }
  return loops;
}

std::vector<Touch> touches(const Placed& a, const Placed& b, PairSeed& seed) {
  const Vec3 line = centre_in_world(b) - centre_in_world(a);
  const double touching = 64 * 0x1p-53 * (a.model->extent() + b.model->extent() + line.norm());  // law 2's bound, at least
  Patch patch;
  contacts(a, b, touching, 4, seed, patch);
  std::vector<Touch> result;
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    const PatchPoint& p = patch.points[i];
    result.push_back({patch.normal, (p.point_a + p.point_b) / 2, std::max(-p.separation, touching)});
  }
  if (result.empty()) result.push_back({line.isZero() ? Vec3::UnitX() : line.normalized(), centre_in_world(a), touching});
  return result;
}

}  // namespace swiftlet::fcl

template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<double>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<double>>;
