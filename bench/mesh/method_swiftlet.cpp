// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Ours as a method: a seed, and perhaps a front, for each kind of question, as a user would keep it, from one pose to the next.
#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_front.h>

#include "method.h"

namespace swiftlet::bench::mesh {
namespace {

class OurSession final : public Session {
 public:
  OurSession(MeshModel a, MeshModel b, bool with_fronts) : a_(std::move(a)), b_(std::move(b)) {
    bytes = a_.bytes().size() + b_.bytes().size();
    if (!with_fronts) return;
    for (MeshFront& front : fronts_) front = MeshFront();
  }

  Reply ask(const Question& question, const Pose& b_in_a) override {
    MeshSeed& seed = seeds_[std::size_t(question.kind)];
    MeshFront& front = fronts_[std::size_t(question.kind)];
    const bool fronts = front.capacity() > 0;
    switch (question.kind) {
      case Kind::Intersects: {
        const Answer answer = fronts ? intersects(a_, b_, b_in_a, seed, front) : intersects(a_, b_, b_in_a, seed);
        return {.yes = answer.verdict != Verdict::Disjoint,
                .failed = answer.status != Status::Converged,
                .opened = answer.steps,
                .looked_at = answer.plane_tests};
      }
      case Kind::Within: {
        const double threshold = question.threshold;
        const swiftlet::Within answer =
            fronts ? within(a_, b_, b_in_a, threshold, seed, front) : within(a_, b_, b_in_a, threshold, seed);
        return {.yes = answer.decision == Decision::Yes,
                .failed = answer.decision == Decision::Undecided,
                .opened = answer.answer.steps,
                .looked_at = answer.answer.plane_tests};
      }
      case Kind::Distance: {
        const Options options{.relative = question.relative};
        const Answer answer = fronts ? distance(a_, b_, b_in_a, seed, front, options) : distance(a_, b_, b_in_a, seed, options);
        return {.distance = answer.upper,
                .failed = answer.status != Status::Converged,
                .opened = answer.steps,
                .looked_at = answer.plane_tests};
      }
      case Kind::Contacts: {
        const MeshContacts found = contacts(a_, b_, b_in_a, question.threshold, regions_);
        return {.count = found.count,
                .failed = found.status != Status::Converged,
                .opened = found.steps,
                .looked_at = found.plane_tests};
      }
      case Kind::Manifolds: {
        const MeshContacts found = contacts(a_, b_, b_in_a, question.threshold, regions_);
        std::size_t points = 0;
        for (std::uint32_t i = 0; i < found.stored; ++i) {
          points += std::size_t(manifold(a_, b_, b_in_a, regions_[i], {.margin = question.threshold}).count);
        }
        return {.count = points,
                .failed = found.status != Status::Converged,
                .opened = found.steps,
                .looked_at = found.plane_tests};
      }
      case Kind::SignedDistance: {
        const Answer answer = signed_distance(body(a_), body(b_), b_in_a, seed);
        return {.distance = answer.lower,
                .upper = answer.upper,
                .failed = answer.status != Status::Converged && answer.status != Status::NotConverged,
                .opened = answer.steps,
                .looked_at = answer.plane_tests};
      }
    }
    return {.failed = true};
  }

 private:
  /// A closed mesh is the solid that it bounds: else a depth is one of triangles.
  static MeshBody body(const MeshModel& mesh) { return mesh.topology().closed() ? MeshBody::solid(mesh) : MeshBody(mesh); }

  MeshModel a_, b_;
  std::array<MeshSeed, kKinds> seeds_;
  std::array<MeshFront, kKinds> fronts_{MeshFront(0), MeshFront(0), MeshFront(0), MeshFront(0), MeshFront(0), MeshFront(0)};
  std::vector<MeshContact> regions_ = std::vector<MeshContact>(1024);
};

class OurMethod final : public Method {
 public:
  OurMethod(std::string name, std::string settings, MakeModel make, bool with_fronts)
      : name_(std::move(name)), settings_(std::move(settings)), make_(make), with_fronts_(with_fronts) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  bool can(const Question&) const override { return true; }
  std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const override {
    const auto begin = std::chrono::steady_clock::now();
    MeshModel model_a = make_(a), model_b = make_(b);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    auto session = std::make_unique<OurSession>(std::move(model_a), std::move(model_b), with_fronts_);
    session->build_seconds = taken.count();
    return session;
  }

 private:
  std::string name_, settings_;
  MakeModel make_;
  bool with_fronts_;
};

}  // namespace

MeshModel boxes_of(const Mesh& mesh) {
  Result<MeshModel> model = MeshModel::from_triangles(mesh.points, mesh.triangles);
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

std::unique_ptr<Method> swiftlet_method(std::string name, std::string settings, MakeModel make, bool with_fronts) {
  return std::make_unique<OurMethod>(std::move(name), std::move(settings), make, with_fronts);
}

std::unique_ptr<Session> swiftlet_session(MeshModel a, MeshModel b, bool with_fronts) {
  return std::make_unique<OurSession>(std::move(a), std::move(b), with_fronts);
}

}  // namespace swiftlet::bench::mesh
