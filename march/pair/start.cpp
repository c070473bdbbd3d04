// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/start.h"

#include "pair/certify.h"

namespace swiftlet {

MarchStart made_legal(const PairView& pair, const MarchStart& start, std::uint32_t& plane_tests) {
  MarchStart s = start;
  const bool known_a = names_feature(pair.a, s.a), known_b = names_feature(pair.b, s.b);
  if (!known_a || !known_b) {
    const Vec d = rescaled(apply(pair.b_in_a, vec(pair.b.centre)) - vec(pair.a.centre));
    if (!known_a) s.a = {FeatureKind::Vertex, support_a(pair, d, 0, plane_tests)};
    if (!known_b) s.b = {FeatureKind::Vertex, support_b(pair, d, 0, plane_tests)};
  }
  if (s.a.kind() == FeatureKind::Face && s.b.kind() == FeatureKind::Face) s.b = {FeatureKind::Vertex, any_vertex(pair.b, s.b)};
  return s;
}

}  // namespace swiftlet
