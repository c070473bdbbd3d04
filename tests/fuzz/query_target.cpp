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
  QueryOptions options;
  PatchOptions patch_options;
  Patch before;
  double threshold = 0;
  PairSeed seed;
};
Question take_question(Bytes& bytes) {
  Question q;
  q.options.start = StartPolicy(bytes.take<std::uint8_t>());
  q.options.refinement = Refinement(bytes.take<std::uint8_t>());
  q.options.plane_rule = PlaneRule(bytes.take<std::uint8_t>());
  const auto which = bytes.take<std::uint8_t>();
  if (which & 1) q.options.absolute_error = bytes.take<double>();
  if (which & 2) q.options.relative_error = bytes.take<double>();
  if (which & 4) q.options.beyond = bytes.take<double>();
  if (which & 8) q.options.finest_level = bytes.take<std::int32_t>();
  if (which & 16) q.options.step_budget = bytes.take<std::uint16_t>();
  q.threshold = std::fabs(bytes.take<float>());
  q.seed = take_seed(bytes);
  if (which & 32) q.patch_options = take_patch_options(bytes), q.before = take_patch(bytes);
  return q;
}

bool is_exact(const QueryOptions& o) {
  const bool whole = o.finest_level <= 0 && o.step_budget == ~0u, open = !(o.beyond < std::numeric_limits<double>::infinity());
  return whole && open && !(o.absolute_error > 0) && !(o.relative_error > 0);
}

}  // namespace

std::string query(Input input) {
  Bytes bytes(input);
  const Model &a = models()[bytes.take<std::uint8_t>() % models().size()],
              &b = models()[bytes.take<std::uint8_t>() % models().size()];
  auto [options, patch_options, before, threshold, seed] = take_question(bytes);
  for (int i = 0; i < 4 && !(i > 0 && bytes.empty()); ++i) {
    const Pose pose = take_pose(bytes);
    if (!is_legal(pose)) {
      const Answer answer = distance(a, b, pose, seed, options);
      if (answer.status != Status::InvalidPose || answer.lower != 0 || !(answer.upper > 1e300))
        return "an invalid pose is answered";
      continue;
    }
    const Judge judge(a, b, pose);
    const bool exact = is_exact(options);
    LevelRecord records[16];
    QueryOptions traced = options;
    traced.trace = records;
    PairSeed cold, other = seed;
    if (const auto fault = judge.fault(distance(a, b, pose, other, traced), exact); !fault.empty()) return "traced: " + fault;
    if (const auto fault = judge.fault(distance(a, b, pose, cold, options), exact); !fault.empty()) return "cold: " + fault;
    if (const auto fault = judge.fault(intersects(a, b, pose, other, options), false); !fault.empty())
      return "intersects: " + fault;
    if (!std::isnan(threshold))
      if (const auto fault = judge.fault(within(a, b, pose, threshold, other, options), threshold); !fault.empty())
        return fault;
    if (const auto fault = judge.fault(contact(a, b, pose, other, options).answer, false); !fault.empty())
      return "contact: " + fault;
    if (const auto fault = judge.fault(distance(a, b, pose, seed, options), exact); !fault.empty()) return "distance: " + fault;
    const SignedAnswer deep = signed_distance(a, b, pose, other);
    if (const auto fault = judge.fault(deep); !fault.empty()) return "signed distance: " + fault;
    before = patch(a, b, pose, deep, patch_options, before);
    if (const auto fault = judge.fault(before, deep, patch_options); !fault.empty()) return "patch: " + fault;
  }
  return {};
}

}  // namespace swiftlet::fuzz
