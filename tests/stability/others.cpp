// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The benchmark's methods as contenders. Each gets the vertices and faces of the exact hull that our builder makes, and the
// relative pose that our `relative` makes: what their own hull builders and world coordinates would add is not measured.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <swiftlet/build.h>

#include "contender.h"
#include "method.h"

namespace swiftlet::stability {
namespace {

class Others {
 public:
  Others(const bench::Method& method, double tolerance, Findings& findings)
      : can_(method.capabilities()), tolerance_(tolerance), findings_(findings) {}

  void ask(bench::Session& session, std::uint32_t pair, const Problem& problem) const {
    for (int round = 0; round < 2; ++round) {
      if (can_.distance) judge(problem, session.distance(pair, problem.b_in_a), true);
      if (can_.intersects) judge(problem, session.intersects(pair, problem.b_in_a), false);
      if (can_.depth) judge_depth(problem, session.depth(pair, problem.b_in_a));
    }
  }

 private:
  void judge(const Problem& p, const bench::Outcome& o, bool has_distance) const {
    ++findings_.answers;
    findings_.most_steps = std::max(findings_.most_steps, o.steps);
    const double slack = tolerance_ * p.size, truth = p.in_world.distance;
    char line[200];
    const auto add = [&](Fault fault, const char* what) {
      std::snprintf(line, sizeof line, "%s: %s %.17g, signed distance %.17g", has_distance ? "distance" : "intersects", what,
                    o.distance, truth);
      findings_.add(fault, line);
    };
    if (o.failed) return add(Fault::NotConverged, "no answer");
    if (has_distance && !(o.distance >= 0 && std::isfinite(o.distance))) return add(Fault::NoNumber, "no number");
    if (o.overlapping && truth > slack) return add(Fault::WrongVerdict, "overlapping");
    if (!o.overlapping && truth < -slack) return add(Fault::WrongVerdict, "apart");
    if (!has_distance) return;
    const double error = std::abs(o.distance - std::max(truth, 0.));
    findings_.worst_error = std::max(findings_.worst_error, error / p.size);
    if (error > slack) add(Fault::WrongDistance, "distance");
  }

  /// Of bodies that overlap by more than the tolerance; whether they do was asked before.
  void judge_depth(const Problem& p, const bench::Outcome& o) const {
    const double slack = tolerance_ * p.size, truth = -p.in_world.distance;
    if (std::isnan(findings_.depth) && !o.failed) findings_.depth = o.overlapping ? o.distance : 0;
    if (truth <= slack) return;
    ++findings_.answers;
    const double error = o.overlapping && !o.failed ? std::abs(o.distance - truth) : truth;
    if (!(error <= slack)) {
      char line[200];
      std::snprintf(line, sizeof line, "depth: %.17g%s, in truth %.17g", o.overlapping ? o.distance : 0,
                    o.failed ? ", says that it failed" : "", truth);
      findings_.add(Fault::WrongDepth, line);
    }
    if (error > findings_.worst_depth_error * p.size) findings_.worst_depth_error = error / p.size;
  }

  bench::Capabilities can_;
  double tolerance_;
  Findings& findings_;
};

/// Whether every vertex has an edge between two faces: peers get faces without their diagonals, and would lack the others.
bool survives_without_diagonals(const ConvexView& view) {
  std::vector<bool> kept(view.vertices.size(), false);
  for (std::size_t h = 0; h < view.half_edges.size(); ++h) {
    if (view.half_edges[h].face != view.half_edges[view.half_edges[h].twin].face) kept[view.half_edges[h].head] = true;
  }
  return std::find(kept.begin(), kept.end(), false) == kept.end();
}

/// Solids only, as Method asks for.
bool is_taken(const Model& model) { return model.dimension() == 3 && survives_without_diagonals(model.level(0).view); }

Findings ask_other(const bench::Method& method, double tolerance, const Case& c, const Problems& problems) {
  Findings findings;
  const Result<Built> a = build(c.a), b = build(c.b);
  if (!a || !b) {
    findings.add(Fault::NoNumber, (a ? b : a).error().message);
    return findings;
  }
  const std::array models{&a.value().model, &b.value().model};
  findings.applicable = is_taken(*models[0]) && is_taken(*models[1]);
  if (!findings.applicable) return findings;
  std::array<bench::SceneBody, 2> bodies;
  for (std::size_t i = 0; i < 2; ++i) bodies[i] = {models[i], models[i]->level(0).view, 0};
  const std::array<bench::BodyPair, 2> pairs{{{0, 1}, {1, 0}}};
  const auto session = method.open(bodies, pairs);
  const Others others(method, tolerance, findings);
  for (std::uint32_t i = 0; i < 2; ++i) others.ask(*session, i, problems[i]);
  return findings;
}

}  // namespace

std::vector<Contender> other_contenders(double tolerance) {
  std::vector<Contender> all;
  for (auto& unique : bench::judged_methods()) {
    const std::shared_ptr<bench::Method> method = std::move(unique);
    all.push_back(
        {method->name(), method->settings(), method->capabilities().distance, method->capabilities().depth,
         [method, tolerance](const Case& c, const Problems& problems) { return ask_other(*method, tolerance, c, problems); }});
  }
  return all;
}

}  // namespace swiftlet::stability
