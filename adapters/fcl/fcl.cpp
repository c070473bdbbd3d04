// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

#include <algorithm>

namespace swiftlet::fcl {

std::vector<int> face_loops(const Model& model) {
  const ConvexView& view = model.level(0).view;
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
  const double touching = tolerance(a, b);
  Manifold manifold;
  contacts(a, b, touching, 4, seed, manifold);
  std::vector<Touch> result;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    result.push_back({manifold.normal, (p.point_a + p.point_b) / 2, std::max(-p.separation, touching)});
  }
  return result;
}

}  // namespace swiftlet::fcl

template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<double>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<double>>;
