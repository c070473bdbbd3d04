// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <swiftlet/build.h>

namespace swiftlet::stability {
namespace {

struct Way {
  const char* models;
  bool swapped, warm;
  Options options;
};

std::string text(const Way& w) {
  char line[80];
  std::snprintf(line, sizeof line, "%s%s%s, start %d, refinement %d, rule %d", w.models, w.swapped ? ", swapped" : "",
                w.warm ? ", warm" : ", cold", int(w.options.tuning.start), int(w.options.tuning.refinement),
                int(w.options.tuning.plane_rule));
  return line;
}

std::vector<Options> all_options() {
  std::vector<Options> all;
  for (const auto start :
       {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest, StartPolicy::Table}) {
    for (const auto refinement : {Refinement::Single, Refinement::SingleSingle, Refinement::DoubleDouble}) {
      for (const auto rule : {PlaneRule::MostViolated, PlaneRule::FirstViolated}) {
        Options options;
        options.tuning.start = start;
        options.tuning.refinement = refinement;
        options.tuning.plane_rule = rule;
        all.push_back(options);
      }
    }
  }
  return all;
}

std::vector<double> thresholds_around(const Problem& p) {
  const double d = std::max(p.asked.distance, 0.);
  std::vector<double> thresholds{0, d / 2, d - 2 * p.bound, d, d + 2 * p.bound, d + 1e-6 * p.size, 2 * d};
  std::erase_if(thresholds, [](double t) { return t < 0; });
  return thresholds;
}

/// One problem on one pair of models.
class Trial {
 public:
  Trial(const Problem& problem, const Model& a, const Model& b, Findings& findings)
      : problem_(problem), a_(a), b_(b), findings_(findings), thresholds_(thresholds_around(problem)) {}

  void ask(Way way) {
    PairSeed seed;
    OverlapProof proof;
    way.options.tuning.proof = &proof;
    const auto next = [&]() -> PairSeed& { return way.warm ? warm_ : (seed = {}); };
    const Pose& pose = problem_.b_in_a;
    {
      const Answer answer = distance(a_, b_, pose, next(), way.options);
      add(way, "distance", judge_exact(problem_, a_, b_, answer, proof), answer);
      findings_.worst_error = std::max(findings_.worst_error, error_of(problem_, answer) / problem_.size);
      add_verdict(way, answer.verdict);
    }
    {
      const Answer answer = closest_features(a_, b_, pose, next(), {.tuning = way.options.tuning}).answer;
      add(way, "closest_features", judge_exact(problem_, a_, b_, answer, proof), answer);
      add_verdict(way, answer.verdict);
    }
    {
      const Answer answer = intersects(a_, b_, pose, next(), {.tuning = way.options.tuning});
      add(way, "intersects", judge_intersects(problem_, a_, b_, answer, proof), answer);
      add_verdict(way, answer.verdict);
    }
    // Overlapping it goes by no option; apart as the distance does.
    if (way.options.tuning.start == StartPolicy::Automatic && way.options.tuning.refinement == Refinement::SingleSingle) {
      const Answer answer = signed_distance(a_, b_, pose, next(), way.options);
      ++findings_.answers;
      if (const Judgement j = judge_signed(problem_, a_, b_, answer, proof); j.fault != Fault::None)
        findings_.add(j.fault, "signed_distance (" + text(way) + "): " + j.message);
      double& worst = answer.lower < 0 ? findings_.worst_depth_error : findings_.worst_error;
      worst = std::max(worst, error_of(problem_, answer) / problem_.size);
      if (std::isnan(findings_.depth)) findings_.depth = -answer.lower;
      add_verdict(way, answer.verdict);
    }
    for (const double threshold : thresholds_) {
      const Within answer = within(a_, b_, pose, threshold, next(), {.tuning = way.options.tuning});
      add(way, "within", judge_within(problem_, a_, b_, threshold, answer, proof), answer.answer);
    }
  }

 private:
  void add(const Way& way, const char* query, const Judgement& judgement, const Answer& answer) {
    ++findings_.answers;
    findings_.most_steps = std::max(findings_.most_steps, answer.steps);
    if (judgement.fault != Fault::None)
      findings_.add(judgement.fault, std::string(query) + " (" + text(way) + "): " + judgement.message);
  }
  void add_verdict(const Way& way, Verdict verdict) {
    findings_.touching |= verdict == Verdict::Touching;
    findings_.undecided |= verdict == Verdict::Undecided;
    if (verdict_ && *verdict_ != verdict)
      findings_.add(Fault::WrongVerdict,
                    text(way) + ": verdict " + std::to_string(int(verdict)) + ", before " + std::to_string(int(*verdict_)));
    verdict_ = verdict;
  }

  const Problem& problem_;
  const Model &a_, &b_;
  Findings& findings_;
  std::vector<double> thresholds_;
  std::optional<Verdict> verdict_;
  PairSeed warm_;
};

void ask_of_models(const char* models, const Model& a, const Model& b, const Problems& problems, Findings& findings) {
  static const std::vector<Options> options = all_options();
  for (const bool swap : {false, true}) {
    Trial trial(problems[swap], swap ? b : a, swap ? a : b, findings);
    for (const Options& o : options) {
      for (const bool warm : {false, true}) trial.ask({models, swap, warm, o});
    }
  }
}

}  // namespace

Problems problems_of(const Case& c) { return {problem_of(c), problem_of(swapped(c))}; }

void Findings::add(Fault fault, std::string_view message) {
  wrong_verdict |= fault == Fault::WrongVerdict;
  wrong_distance |= fault == Fault::WrongDistance;
  wrong_depth |= fault == Fault::WrongDepth;
  no_number |= fault == Fault::NoNumber;
  not_converged |= fault == Fault::NotConverged;
  note(message);
}

void Findings::note(std::string_view message) {
  if (!first_fault[0]) message.copy(first_fault, sizeof first_fault - 1);
}

Findings ask_swiftlet(const Case& c, const Problems& problems) {
  Findings findings;
  for (const Method method : {Method::Collapse, Method::Peel}) {
    BuildOptions options;
    options.method = method;
    options.cutoff = 4;  // levels also of small bodies
    const Result<Built> a = build(c.a, options), b = build(c.b, options);
    if (!a || !b) {
      findings.add(Fault::NoNumber, (a ? b : a).error().message);
      continue;
    }
    ask_of_models(method == Method::Collapse ? "collapse" : "peel", a.value().model, b.value().model, problems, findings);
  }
  return findings;
}

}  // namespace swiftlet::stability
