// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

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

Touch touch(const Placed& a, const Placed& b, PairSeed& seed) {
  const Nearest near = nearest(a, b, 0, seed);
  const Vec3 line = centre_in_world(b) - centre_in_world(a);
  Touch result;
  result.normal = !near.normal.isZero() ? near.normal : line.isZero() ? Vec3::UnitX() : line.normalized();
  result.point = (near.point_a + near.point_b) / 2;
  result.depth = 64 * 0x1p-53 * (a.model->extent() + b.model->extent() + line.norm());  // law 2's bound on touching
  return result;
}

}  // namespace swiftlet::fcl

template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<double>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<double>>;
