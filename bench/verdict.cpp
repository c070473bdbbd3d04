// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "verdict.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/query.h>

namespace swiftlet::bench {
namespace {

constexpr double kHashCell = 1e-9;

class Fnv {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) state_ = (state_ ^ (word >> 8 * i & 0xff)) * 0x100000001b3u;
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

enum class Kind : std::uint64_t { Disjoint, Overlapping, Failed, Undecidable };

/// Both hashes of a scene, query by query.
struct Hashes {
  Fnv given, proved;
  /// Where the truth is open, every answer counts as that.
  void add(Kind kind, double distance, const Certified& truth, double cell) {
    const Kind true_kind = truth.overlapping ? Kind::Overlapping : truth.disjoint ? Kind::Disjoint : Kind::Undecidable;
    const double middle = true_kind == Kind::Disjoint && cell > 0 ? (truth.lower + truth.upper) / 2 : 0;
    const auto cells = [&](double x) { return cell > 0 && std::abs(x) < 1e18 * cell ? std::llround(x / cell) : 0; };
    proved.add(std::uint64_t(true_kind));
    proved.add(std::uint64_t(cells(middle)));
    if (true_kind == Kind::Undecidable && kind != Kind::Failed) kind = true_kind;
    given.add(std::uint64_t(kind));
    given.add(kind == Kind::Disjoint ? std::uint64_t(cells(middle) + cells(distance - middle)) : 0);
  }
};

Kind kind_of(const Outcome& o) {
  if (o.failed) return Kind::Failed;
  if (o.overlapping) return Kind::Overlapping;
  return std::isfinite(o.distance) && o.distance >= 0 ? Kind::Disjoint : Kind::Failed;
}

/// Counts the verdict; true when it is right and a distance was given.
bool count_verdict(Kind kind, double distance, const Certified& truth, Comparison& c) {
  if (kind == Kind::Failed) {
    ++c.failures;
  } else if (kind == Kind::Overlapping && truth.disjoint) {
    ++c.false_overlaps;
    c.widest_false_overlap = std::max(c.widest_false_overlap, truth.lower);
  } else if (kind == Kind::Disjoint && truth.overlapping) {
    ++c.missed_overlaps;
    c.largest_missed = std::max(c.largest_missed, distance);
  } else {
    return kind == Kind::Disjoint;
  }
  return false;
}

}  // namespace

Truth certify(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs, std::span<const Query> queries) {
  Truth truth;
  std::size_t overlapping = 0;
  for (const Query& query : queries) {
    const Model &a = *bodies[pairs[query.pair].a].model, &b = *bodies[pairs[query.pair].b].model;
    OverlapProof proof;
    const Answer answer = distance(a, b, query.b_in_a, {.tuning = {.proof = &proof}});
    const Check checked = check(a, b, query.b_in_a, answer, Question::Exact, &proof);
    Certified certified;
    if (checked && answer.status == Status::Converged) {
      certified = {answer.lower, answer.upper, answer.verdict == Verdict::Disjoint, answer.verdict == Verdict::Overlapping};
      truth.widest = std::max(truth.widest, answer.upper - answer.lower);
      overlapping += certified.overlapping;
    } else if (truth.unproved++ == 0) {
      truth.first_failure =
          "query " + std::to_string(truth.queries.size()) + ": " + (checked ? "not converged" : checked.message);
    }
    truth.queries.push_back(certified);
  }
  if (!queries.empty()) truth.overlapping_share = double(overlapping) / double(queries.size());
  return truth;
}

Truth certify_depths(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs, std::span<const Query> queries) {
  constexpr std::size_t kCheckEvery = 100;
  Truth truth;
  truth.overlapping_share = 1;
  for (const Query& query : queries) {
    const Model &a = *bodies[pairs[query.pair].a].model, &b = *bodies[pairs[query.pair].b].model;
    const Answer answer = signed_distance(a, b, query.b_in_a);
    Certified certified;
    const bool checked = truth.queries.size() % kCheckEvery != 0 || check(a, b, query.b_in_a, answer, Question::Exact);
    if (checked && answer.status == Status::Converged && answer.upper < 0) {
      certified = {-answer.upper, -answer.lower, true, false};
      truth.widest = std::max(truth.widest, answer.upper - answer.lower);
    } else if (truth.unproved++ == 0) {
      truth.first_failure = "query " + std::to_string(truth.queries.size());
    }
    truth.queries.push_back(certified);
  }
  return truth;
}

Comparison compare(std::span<const Outcome> outcomes, std::span<const Certified> truth, double radius) {
  assert(outcomes.size() == truth.size() && radius > 0);
  Comparison c{.count = outcomes.size()};
  Hashes hashes;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    const Kind kind = kind_of(o);
    hashes.add(kind, o.distance, truth[i], kHashCell * radius);
    if (!count_verdict(kind, o.distance, truth[i], c)) continue;
    const double error = std::max({0., truth[i].lower - o.distance, o.distance - truth[i].upper});
    c.mean_error += error;
    ++measured;
    if (error > c.max_error) c.max_error = error, c.worst = i;
  }
  if (measured > 0) c.mean_error /= double(measured);
  c.hash = hashes.given.value();
  c.true_hash = hashes.proved.value();
  return c;
}

Comparison compare_verdicts(std::span<const Outcome> outcomes, std::span<const Certified> truth) {
  assert(outcomes.size() == truth.size());
  Comparison c{.count = outcomes.size()};
  Hashes hashes;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    const Kind kind = o.failed ? Kind::Failed : o.overlapping ? Kind::Overlapping : Kind::Disjoint;
    hashes.add(kind, 0, truth[i], 0);
    count_verdict(kind, 0, truth[i], c);
  }
  c.hash = hashes.given.value();
  c.true_hash = hashes.proved.value();
  return c;
}

std::string text(const Comparison& c, double radius) {
  char line[320];
  std::snprintf(line, sizeof line,
                "%zu queries, %zu failed, %zu false overlaps (widest %.2g r), %zu missed overlaps (%.2g r), error max %.2g r "
                "mean %.2g r, "
                "hash %016llx%s",
                c.count, c.failures, c.false_overlaps, c.widest_false_overlap / radius, c.missed_overlaps,
                c.largest_missed / radius, c.max_error / radius, c.mean_error / radius, static_cast<unsigned long long>(c.hash),
                c.hash == c.true_hash ? " (true)" : "");
  return line;
}

}  // namespace swiftlet::bench
