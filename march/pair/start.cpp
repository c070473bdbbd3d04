// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/start.h"

#include "body/half_edge.h"
#include "pair/certify.h"

namespace swiftlet {

MarchStart settled(const Scene& scene, const MarchStart& start, std::uint32_t& plane_tests) {
  MarchStart s = start;
  const bool known_a = names_feature(scene.a, s.a), known_b = names_feature(scene.b, s.b);
  if (!known_a || !known_b) {
    const Vec d = rescaled(apply(scene.b_in_a, vec(scene.b.centre)) - vec(scene.a.centre));
    if (!known_a) s.a = {FeatureKind::Vertex, support_a(scene, d, 0, plane_tests)};
    if (!known_b) s.b = {FeatureKind::Vertex, support_b(scene, d, 0, plane_tests)};
  }
  if (s.a.kind() == FeatureKind::Face && s.b.kind() == FeatureKind::Face) s.b = {FeatureKind::Vertex, any_vertex(scene.b, s.b)};
  return s;
}

}  // namespace swiftlet
