// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <vector>

#include <swiftlet/build.h>

#include "bodies.h"
#include "judge.h"
#include "shapes.h"

namespace swiftlet::fuzz {
namespace {

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    using namespace shapes;
    BuildOptions options;
    options.cutoff = 12;
    std::vector<Model> made{bodies::nested(3)};
    for (const Mesh& mesh : {ellipsoid({1, 1, 1}, 120, 1), ellipsoid({1, 1, .01}, 60, 2), cube(), prism(6, 1, 1), needle(),
                             sliver(), polygon(5), segment(2), point()})
      made.push_back(bodies::must(build(mesh, options)).model);
    return made;
  }();
  return all;
}

/// What is asked besides poses. A bit of `which` per part that is not the default.
struct Question {
  Options options;
  ManifoldOptions manifold_options;
  Manifold before;
  double threshold = 0;
  PairSeed seed;
};
Question take_question(Bytes& bytes) {
  Question q;
  q.options.tuning.start = StartPolicy(bytes.take<std::uint8_t>());
  q.options.tuning.refinement = Refinement(bytes.take<std::uint8_t>());
  q.options.tuning.plane_rule = PlaneRule(bytes.take<std::uint8_t>());
  const auto which = bytes.take<std::uint8_t>();
  if (which & 1) q.options.absolute = bytes.take<double>();
  if (which & 2) q.options.relative = bytes.take<double>();
  if (which & 4) q.options.beyond = bytes.take<double>();
  if (which & 8) q.options.budget.finest_level = bytes.take<std::int32_t>();
  if (which & 16) q.options.budget.steps = bytes.take<std::uint16_t>();
  q.threshold = std::fabs(bytes.take<float>());
  q.seed = take_seed(bytes);
  if (which & 32) q.manifold_options = take_manifold_options(bytes), q.before = take_manifold(bytes);
  return q;
}

bool is_exact(const Options& o) {
  const bool whole = o.budget.finest_level <= 0 && o.budget.steps == ~0u,
             open = !(o.beyond < std::numeric_limits<double>::infinity());
  return whole && open && !(o.absolute > 0) && !(o.relative > 0);
}

}  // namespace

std::string query(Input input) {
  Bytes bytes(input);
  const Model &a = models()[bytes.take<std::uint8_t>() % models().size()],
              &b = models()[bytes.take<std::uint8_t>() % models().size()];
  auto [options, manifold_options, before, threshold, seed] = take_question(bytes);
  OverlapProof proof;
  options.tuning.proof = &proof;
  for (int i = 0; i < 4 && !(i > 0 && bytes.empty()); ++i) {
    const Pose pose = take_pose(bytes);
    if (!is_legal(pose)) {
      const Answer answer = distance(a, b, pose, seed, options);
      if (answer.status != Status::InvalidPose || answer.lower != 0 || !(answer.upper > 1e300))
        return "an invalid pose is answered";
      continue;
    }
    const Judge judge(a, b, pose, proof);
    const bool exact = is_exact(options);
    const Effort effort{options.budget, options.tuning};
    LevelRecord records[16];
    Options traced = options;
    traced.tuning.trace = records;
    PairSeed other = seed;
    if (const auto fault = judge.fault(distance(a, b, pose, other, traced), exact); !fault.empty()) return "traced: " + fault;
    if (const auto fault = judge.fault(distance(a, b, pose, options), exact); !fault.empty()) return "cold: " + fault;
    if (const auto fault = judge.fault(intersects(a, b, pose, other, effort), false); !fault.empty())
      return "intersects: " + fault;
    if (!std::isnan(threshold))
      if (const auto fault = judge.fault(within(a, b, pose, threshold, other, effort), threshold); !fault.empty()) return fault;
    const ClosestOptions closest{options.beyond, options.budget.steps, options.tuning};
    if (const auto fault = judge.fault(closest_features(a, b, pose, other, closest).answer, false); !fault.empty())
      return "closest features: " + fault;
    if (const auto fault = judge.fault(distance(a, b, pose, seed, options), exact); !fault.empty()) return "distance: " + fault;
    const Answer deep = signed_distance(a, b, pose, other, {.tuning = {.proof = &proof}});
    if (const auto fault = judge.fault(deep, true); !fault.empty()) return "signed distance: " + fault;
    before = manifold(a, b, pose, deep, manifold_options, before);
    if (const auto fault = judge.fault(before, deep, manifold_options); !fault.empty()) return "manifold: " + fault;
  }
  return {};
}

}  // namespace swiftlet::fuzz
