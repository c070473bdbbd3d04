// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks for the distance of every two of some models, for callgrind: see cost. Bodies as they are made, with broad faces, fine
// rims and slivers, where scenes of the bench have smooth ones.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "random.h"

namespace {

using namespace swiftlet;

constexpr int kRandomPoses = 3;  ///< of each pair
constexpr int kPath = 16;        ///< poses along a motion, of which the first is asked cold

struct Query {
  std::size_t a, b;
  Pose b_in_a;
};

/// B in a random rotation and direction from A, so far that the bodies are `gap` apart.
Pose random_pose(const Model& a, const Model& b, double gap, shapes::Random& random) {
  Pose pose{random.rotation(), {}};
  const Vec3 way = random.on_sphere();
  double near = 0, far = a.radius() + b.radius() + gap;
  for (int halvings = 0; halvings < 50; ++halvings) {
    const double middle = (near + far) / 2;
    pose.translation = a.centre() + middle * way - pose.rotation * b.centre();
    PairSeed cold;
    (distance(a, b, pose, cold).lower < gap ? near : far) = middle;
  }
  return pose;
}

/// B goes around A's centre by the turn `around`, and turns back by `half` of it.
Pose moved(const Pose& pose, const Model& a, const Model& b, const Mat3& around, const Mat3& half) {
  Pose next;
  next.rotation = half.transpose() * around * pose.rotation;
  next.translation =
      a.centre() + around * (pose.rotation * b.centre() + pose.translation - a.centre()) - next.rotation * b.centre();
  return next;
}

std::vector<Query> queries_of(const std::vector<Model>& models, double gap, double degrees) {
  shapes::Random random(7);
  const double half_turn = degrees * std::numbers::pi / 360, w = 1 / std::sqrt(1 + half_turn * half_turn);
  const double quarter = half_turn / 2, v = 1 / std::sqrt(1 + quarter * quarter);
  std::vector<Query> queries;
  for (std::size_t a = 0; a < models.size(); ++a) {
    for (std::size_t b = 0; b < models.size(); ++b) {
      for (int i = 0; i < kRandomPoses; ++i) {
        Pose pose = random_pose(models[a], models[b], gap * (models[a].radius() + models[b].radius()) / 2, random);
        const Vec3 axis = random.on_sphere();
        const Mat3 around = shapes::from_quaternion(w, w * half_turn * axis),
                   half = shapes::from_quaternion(v, v * quarter * axis);
        for (int k = 0; k < (degrees > 0 ? kPath : 1); ++k, pose = moved(pose, models[a], models[b], around, half))
          queries.push_back({a, b, pose});
      }
    }
  }
  return queries;
}

/// To an error, or exact if that is 0. A function of its own, which callgrind counts.
[[gnu::noinline]] Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, double error) {
  return error > 0 ? distance(a, b, b_in_a, seed, {.absolute = error}) : distance(a, b, b_in_a, seed);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5)
    return std::fputs("swiftlet_cost_links GAP DEGREES ERROR MODEL...: gap in mean radii, error in radii of A\n", stderr), 2;
  std::vector<Model> models;
  for (int i = 4; i < argc; ++i) {
    Result<Model> loaded = load(argv[i]);
    if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().message.c_str()), 1;
    models.push_back(std::move(loaded.value()));
  }
  const double degrees = std::atof(argv[2]), error = std::atof(argv[3]);
  const std::vector<Query> queries = queries_of(models, std::atof(argv[1]), degrees);
  PairSeed seed;
  double steps = 0, sum = 0, widest = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Query& q = queries[i];
    if (degrees == 0 || i % kPath == 0) seed = {};
    const Answer answer = ask(models[q.a], models[q.b], q.b_in_a, seed, error * models[q.a].radius());
    steps += answer.steps, sum += answer.upper;
    widest = std::max(widest, (answer.upper - answer.lower) / models[q.a].radius());
  }
  const double n = double(queries.size());
  std::printf("queries %.0f steps %.2f distance %.9g widest %.2g\n", n, steps / n, sum / n, widest);
}
