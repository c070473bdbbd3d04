// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Ours as a method: a seed for each kind of question, as a user would keep it, from one pose to the next.
#include <array>
#include <chrono>
#include <stdexcept>

#include <swiftlet/mesh_query.h>

#include "method.h"

namespace swiftlet::bench::mesh {
namespace {

MeshModel model_of(const Mesh& mesh) {
  Result<MeshModel> model = MeshModel::from_triangles(mesh.points, mesh.triangles);
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

class OurSession final : public Session {
 public:
  OurSession(const Mesh& a, const Mesh& b) : OurSession(a, b, std::chrono::steady_clock::now()) {}

  Reply ask(const Question& question, const Pose& b_in_a) override {
    MeshSeed& seed = seeds_[std::size_t(question.kind)];
    switch (question.kind) {
      case Kind::Intersects: {
        const Answer answer = intersects(a_, b_, b_in_a, seed);
        return {.yes = answer.verdict != Verdict::Disjoint,
                .failed = answer.status != Status::Converged,
                .opened = answer.steps,
                .looked_at = answer.plane_tests};
      }
      case Kind::Within: {
        const swiftlet::Within answer = within(a_, b_, b_in_a, question.threshold, seed);
        return {.yes = answer.decision == Decision::Yes,
                .failed = answer.decision == Decision::Undecided,
                .opened = answer.answer.steps,
                .looked_at = answer.answer.plane_tests};
      }
      case Kind::Distance: {
        const Answer answer = distance(a_, b_, b_in_a, seed, {.relative = question.relative});
        return {.distance = answer.upper,
                .failed = answer.status != Status::Converged,
                .opened = answer.steps,
                .looked_at = answer.plane_tests};
      }
    }
    return {.failed = true};
  }

 private:
  OurSession(const Mesh& a, const Mesh& b, std::chrono::steady_clock::time_point begin) : a_(model_of(a)), b_(model_of(b)) {
    build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    bytes = a_.bytes().size() + b_.bytes().size();
  }

  MeshModel a_, b_;
  std::array<MeshSeed, 3> seeds_;
};

class OurMethod final : public Method {
 public:
  std::string name() const override { return "swiftlet"; }
  std::string settings() const override { return "proved, from the last pose's seed"; }
  bool can(const Question&) const override { return true; }
  std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const override { return std::make_unique<OurSession>(a, b); }
};

}  // namespace

std::unique_ptr<Method> swiftlet_method() { return std::make_unique<OurMethod>(); }

}  // namespace swiftlet::bench::mesh
