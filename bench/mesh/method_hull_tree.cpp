// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// SWIFT++'s tree of hulls as a method, once for each set of the paper's accelerations.
#include <chrono>
#include <stdexcept>
#include <string>

#include <swiftlet/build_hull_tree.h>
#include <swiftlet/hull_tree.h>

#include "method.h"

namespace swiftlet::bench::mesh {
namespace {

template <class T>
T needed(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

/// Both bodies' trees, which all methods of a scene share.
struct Trees {
  Trees(const Mesh& mesh_a, const Mesh& mesh_b, HullSplit split) : points_a(mesh_a.points), points_b(mesh_b.points) {
    HullTreeOptions options;
    options.split = split;
    const auto begin = std::chrono::steady_clock::now();
    for (const Mesh* mesh : {&mesh_a, &mesh_b}) {
      const MeshModel model = boxes_of(*mesh);
      trees.push_back(needed(build_hull_tree(model, needed(decompose(model)), options)));
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    build_seconds = taken.count();
  }
  bool are_of(const Mesh& a, const Mesh& b) const { return points_a == a.points && points_b == b.points; }

  std::vector<Vec3> points_a, points_b;
  std::vector<HullTree> trees;
  double build_seconds = 0;
};

class HullSession final : public Session {
 public:
  HullSession(std::shared_ptr<const Trees> trees, const HullSearch& search) : trees_(std::move(trees)) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) pairs_.emplace_back(trees_->trees[0], trees_->trees[1], search);
    for (const HullTree& tree : trees_->trees) bytes += tree.bytes();
    build_seconds = trees_->build_seconds;
  }

  Reply ask(const Question& question, const Pose& b_in_a) override {
    HullPair& pair = pairs_[std::size_t(question.kind)];
    switch (question.kind) {
      case Kind::Intersects: {
        const Answer answer = pair.intersects(b_in_a).answer;
        return {
            .yes = answer.verdict != Verdict::Disjoint, .failed = answer.status != Status::Converged, .opened = answer.steps};
      }
      case Kind::Within: {
        const Decision decision = pair.within(b_in_a, question.threshold);
        return {.yes = decision == Decision::Yes, .failed = decision == Decision::Undecided};
      }
      case Kind::Distance: {
        const Answer answer = pair.distance(b_in_a, 0, question.relative).answer;
        return {.distance = answer.upper, .failed = answer.status != Status::Converged, .opened = answer.steps};
      }
      default: return {.failed = true};
    }
  }

 private:
  std::shared_ptr<const Trees> trees_;
  std::vector<HullPair> pairs_;
};

/// The trees of the last scene.
struct Last {
  HullSplit split;
  std::shared_ptr<const Trees> trees;
};

class HullMethod final : public Method {
 public:
  HullMethod(std::string name, std::string settings, const HullSearch& search, std::shared_ptr<Last> last)
      : name_(std::move(name)), settings_(std::move(settings)), search_(search), last_(std::move(last)) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  bool can(const Question& question) const override { return question.kind <= Kind::Distance; }
  std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const override {
    if (!last_->trees || !last_->trees->are_of(a, b)) last_->trees = std::make_shared<const Trees>(a, b, last_->split);
    return std::make_unique<HullSession>(last_->trees, search_);
  }

 private:
  std::string name_, settings_;
  HullSearch search_;
  std::shared_ptr<Last> last_;
};

}  // namespace

void add_hull_trees(Methods& methods) {
  const auto add = [&](const char* name, const char* settings, const HullSearch& search, const std::shared_ptr<Last>& last) {
    methods.push_back(std::make_unique<HullMethod>(name, settings, search, last));
  };
  const auto midpoint = std::make_shared<Last>(Last{HullSplit::Midpoint, nullptr});
  add("CH", "SWIFT++'s tree of hulls, split at midpoints; Algorithm 2", {}, midpoint);
  add("CH(PC)", "the last answering pair of pieces first", {.piece_caching = true}, midpoint);
  add("CH(PD)", "the nearest pair of nodes next, 1 000 queued", {.priority = true}, midpoint);
  add("CH(PC+PD)", "both", {.piece_caching = true, .priority = true}, midpoint);
  add("CH(FT)", "a generalised front, seeds stored", {.front = true}, midpoint);
  add("CH(FT0)", "the same without stored seeds", {.front = true, .features = false}, midpoint);
  add("CH(PC+FT)", "", {.piece_caching = true, .front = true}, midpoint);
  add("CH(PD+FT)", "", {.priority = true, .front = true}, midpoint);
  add("CH(PC+PD+FT)", "", {.piece_caching = true, .priority = true, .front = true}, midpoint);
  const HullSearch front{.priority = true, .front = true};
  add("median", "CH(PD+FT) of trees split at medians", front, std::make_shared<Last>(Last{HullSplit::Median, nullptr}));
  add("mean", "at means", front, std::make_shared<Last>(Last{HullSplit::Mean, nullptr}));
  add("gap", "at the widest gaps", front, std::make_shared<Last>(Last{HullSplit::Gap, nullptr}));
}

}  // namespace swiftlet::bench::mesh
