// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes beside FCL's manager: the same hulls in the same places, all of them moving a little, asked in turns, step by step,
// and their answers compared. FCL's DynamicAABBTreeCollisionManager has fcl::Convex of the same hulls and asks its own solver,
// on libccd, by its own default callbacks; all within a distance are asked for by a callback that keeps that distance as the
// bound.
#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/geometry/shape/convex.h>

#include <swiftlet/scene.h>

#include "hull.h"
#include "median.h"
#include "random.h"
#include "scenes.h"

namespace swiftlet::bench {
using yardstick::Shelf;
namespace {

constexpr std::uint32_t kTriangles = 200;
constexpr double kNear = 0.05, kApart = 0.1;  ///< asked for within; left free between bodies that are to stay apart
constexpr std::uint32_t kProbes = 100, kFirstProbe = 1'000'000;  ///< bodies asked about one by one; their numbers
constexpr std::array kScales{0.25, 0.5, 1.0, 2.0};
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Bodies around their places: about half a degree and a hundredth to and fro.
struct Crowd {
  std::vector<Model> models;  ///< fat, plate and long in four sizes
  std::vector<std::size_t> model;
  std::vector<Pose> place;
  std::vector<Vec3> way, axis;
  double side;  ///< of the cube that they are in

  /// `room`: the side of the cube that a body has for itself. Of those that are to stay apart none overlap, ever.
  Crowd(const Shelf& shelf, std::size_t count, double room, bool apart) : side(room * std::cbrt(double(count))) {
    for (const shapes::Family family : shapes::kFamilies) {
      for (const double scale : kScales) models.push_back(shelf.ellipsoid(family, kTriangles, 1, scale).model);
    }
    shapes::Random random(5);
    Scene placed;
    while (model.size() < count) {
      const std::size_t m = random.bits() % models.size();
      const Pose pose = anywhere(random);
      if (apart && !placed.within(Scene(models[m], pose), kApart).empty()) continue;
      (void)placed.add("", models[m], pose);
      model.push_back(m);
      place.push_back(pose);
      way.push_back(0.01 * random.on_sphere());
      axis.push_back(random.on_sphere());
    }
  }
  Pose anywhere(shapes::Random& random) const {
    return {random.rotation(), side * Vec3(random.uniform(), random.uniform(), random.uniform())};
  }
  /// probe(number, model, pose) for bodies that come to see who is there.
  void probes(int step, const auto& probe) const {
    shapes::Random random{std::uint64_t(step)};
    for (std::uint32_t i = 0; i < kProbes; ++i) probe(kFirstProbe + i, i % models.size(), anywhere(random));
  }
  Pose pose(std::size_t i, int step) const {
    const double swing = std::sin(0.7 * step + double(i));
    return {shapes::rotation(axis[i], 0.01 * swing) * place[i].rotation, place[i].translation + swing * way[i]};
  }
};

/// What is asked of both: who, or how far the nearest are.
struct Told {
  Pairs pairs;
  double distance = 0;
};

class Theirs {
 public:
  explicit Theirs(const Crowd& crowd) {
    for (const Model& model : crowd.models) {
      auto points = std::make_shared<std::vector<fcl::Vector3d>>();
      for (const Vertex& v : model.level(0).view.vertices) points->emplace_back(v.x, v.y, v.z);
      const auto loops = std::make_shared<std::vector<int>>(face_loops<int>(model.level(0).view));
      shapes_.push_back(std::make_shared<fcl::Convexd>(points, int(model.level(0).view.face_first.size()), loops, true));
    }
    for (std::size_t i = 0; i < crowd.model.size(); ++i) {
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(shapes_[crowd.model[i]]));
      objects_.back()->setUserData(reinterpret_cast<void*>(i));
    }
    move(crowd, 0);
    for (const auto& object : objects_) manager_.registerObject(object.get());
    manager_.setup();
  }
  void move(const Crowd& crowd, int step) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const Pose pose = crowd.pose(i, step);
      objects_[i]->setTransform(pose.rotation, pose.translation);
      objects_[i]->computeAABB();
    }
    if (manager_.size() != 0) manager_.update();
  }
  void overlapping(Told& told) { manager_.collide(&told, collide); }
  void probes(const Crowd& crowd, int step, Told& told) {
    crowd.probes(step, [&](std::uint32_t number, std::size_t model, const Pose& pose) {
      fcl::CollisionObjectd probe(shapes_[model], pose.rotation, pose.translation);
      probe.setUserData(reinterpret_cast<void*>(std::uintptr_t(number)));
      manager_.collide(&probe, &told, collide);
    });
  }
  void within(Told& told) {
    manager_.distance(&told, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& bound) {
      fcl::DistanceResultd result;
      if (fcl::distance(a, b, fcl::DistanceRequestd(), result) <= kNear) add(a, b, data);
      bound = kNear;
      return false;
    });
  }
  void nearest(Told& told) {
    fcl::DefaultDistanceData<double> data;
    manager_.distance(&data, fcl::DefaultDistanceFunction<double>);
    told.distance = std::max(0.0, data.result.min_distance);
  }

 private:
  static bool collide(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* told) {
    fcl::CollisionResultd result;
    if (fcl::collide(a, b, fcl::CollisionRequestd(), result) != 0) add(a, b, told);
    return false;
  }
  static void add(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b, void* told) {
    const auto number = [](const auto* object) {
      return std::uint32_t(reinterpret_cast<std::uintptr_t>(object->getUserData()));
    };
    static_cast<Told*>(told)->pairs.insert(std::minmax({number(a), number(b)}));
  }
  std::vector<std::shared_ptr<fcl::Convexd>> shapes_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

class Ours {
 public:
  explicit Ours(const Crowd& crowd, const Executor& executor = {}) {
    scene_.run_by({.executor = executor});
    for (std::size_t i = 0; i < crowd.model.size(); ++i)
      ids_.push_back(scene_.add("", crowd.models[crowd.model[i]], crowd.pose(i, 0)));
  }
  void move(const Crowd& crowd, int step) {
    for (std::size_t i = 0; i < ids_.size(); ++i) scene_.move(ids_[i], crowd.pose(i, step));
  }
  void overlapping(Told& told) { take(scene_.overlapping(), told); }
  void within(Told& told) { take(scene_.within(kNear), told); }
  void nearest(Told& told) {
    const NearestPair pair = scene_.nearest();
    told.distance = pair.answer.upper;
    hash(pair);
  }
  void probes(const Crowd& crowd, int step, Told& told) {
    crowd.probes(step, [&](std::uint32_t number, std::size_t model, const Pose& pose) {
      for (const ScenePair& pair : scene_.overlapping(Scene(crowd.models[model], pose))) {
        told.pairs.insert({pair.a.index, number});
        hash(pair);
      }
    });
  }
  std::size_t contacts() { return scene_.contacts({.margin = kNear}).size(); }
  std::uint64_t hash() const { return hash_; }

 private:
  void take(const std::vector<ScenePair>& pairs, Told& told) {
    for (const ScenePair& pair : pairs) {
      told.pairs.insert(told.pairs.end(), {pair.a.index, pair.b.index});
      hash(pair);
    }
  }
  void hash(const ScenePair& pair) {
    const double values[] = {double(pair.a.index), double(pair.b.index), pair.answer.lower, pair.answer.upper};
    for (const double value : values) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash_ = (hash_ ^ bits) * 0x100000001b3u;
    }
  }
  Scene scene_;
  std::vector<BodyId> ids_;  // in order of their indices
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// By a clock: the calling thread's processor time, which does not run on while others use the core, or the world's.
double milliseconds(clockid_t clock, const std::function<void()>& work) {
  const auto now = [clock] {
    timespec t;
    clock_gettime(clock, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

struct Row {
  const char* what;
  std::vector<double> ours{}, on_two{}, theirs{};
  std::size_t pairs = 0, differ = 0;  ///< over all steps; of the pairs those that only one side told
};

/// One crowd through so many steps; false where threads give other bits, or FCL other pairs.
bool run(const Shelf& shelf, std::size_t count, bool apart, int steps) {
  const Crowd crowd(shelf, count, apart ? 2.2 : 1.7, apart);
  Ours ours(crowd), on_two(crowd, on_threads(2));
  Theirs theirs(crowd);
  Row rows[] = {{"move all"}, {"overlapping"}, {"within 0.05"}, {"nearest"}, {"100 probes"}, {"contacts"}};
  double worst = 0;
  // The first step is for starts and caches, and is not told.
  for (int step = 0; step <= steps; ++step) {
    const auto time = [&](Row& row, const auto& ask) {
      const double one = milliseconds(CLOCK_THREAD_CPUTIME_ID, [&] { ask(ours); }),
                   two = milliseconds(CLOCK_MONOTONIC, [&] { ask(on_two); });
      if (step > 0) row.ours.push_back(one), row.on_two.push_back(two);
    };
    const auto time_theirs = [&](Row& row, const auto& ask) {
      const double t = milliseconds(CLOCK_THREAD_CPUTIME_ID, [&] { ask(theirs); });
      if (step > 0) row.theirs.push_back(t);
    };
    time(rows[0], [&](auto& side) { side.move(crowd, step); });
    time_theirs(rows[0], [&](auto& side) { side.move(crowd, step); });
    const auto compare = [&](Row& row, const auto& ask) {
      Told told, again, other;
      int turn = 0;
      time(row, [&](auto& side) { ask(side, turn++ ? again : told); });
      time_theirs(row, [&](auto& side) { ask(side, other); });
      row.pairs += told.pairs.size();
      for (const auto& pair : told.pairs) row.differ += !other.pairs.count(pair);
      for (const auto& pair : other.pairs) row.differ += !told.pairs.count(pair);
      worst = std::max(worst, std::abs(told.distance - other.distance));
    };
    compare(rows[1], [](auto& side, Told& told) { side.overlapping(told); });
    compare(rows[2], [](auto& side, Told& told) { side.within(told); });
    compare(rows[3], [](auto& side, Told& told) { side.nearest(told); });
    compare(rows[4], [&](auto& side, Told& told) { side.probes(crowd, step, told); });
    time(rows[5], [&](auto& side) { rows[5].pairs += side.contacts(); });
  }
  rows[5].pairs /= 2;  // both of ours were asked
  std::printf("\n%zu bodies, %s, %d steps; milliseconds a step, medians\n", count, apart ? "apart" : "overlapping", steps);
  std::printf("%-12s %9s %9s %9s %7s %9s %7s\n", "", "swiftlet", "2 threads", "FCL", "ratio", "pairs", "differ");
  bool same = ours.hash() == on_two.hash();
  for (Row& row : rows) {
    const double one = median(row.ours), two = median(row.on_two);
    const std::size_t pairs = row.pairs / std::size_t(steps + 1);
    if (row.theirs.empty()) {
      std::printf("%-12s %9.3f %9.3f %9s %7s %9zu %7s\n", row.what, one, two, "-", "-", pairs, "-");
    } else {
      const double other = median(row.theirs);
      std::printf("%-12s %9.3f %9.3f %9.3f %7.1f %9zu %7zu\n", row.what, one, two, other, other / one, pairs, row.differ);
      same = same && row.differ == 0;
    }
  }
  std::printf("least distances differ by at most %.1e; answers' hash %016" PRIx64 ", on threads %s\n", worst, ours.hash(),
              ours.hash() == on_two.hash() ? "the same" : "ANOTHER");
  return same;
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) {
  using namespace swiftlet::bench;
  if (argc < 2) return std::fputs("swiftlet_manager CACHE [BODIES...]\n", stderr), 2;
  std::vector<std::size_t> counts;
  for (int i = 2; i < argc; ++i) counts.push_back(std::size_t(std::atoll(argv[i])));
  if (counts.empty()) counts = {10, 1'000, 20'000};
  const Shelf shelf(argv[1]);
  bool same = true;
  for (const std::size_t count : counts) {
    for (const bool apart : {false, true}) same = run(shelf, count, apart, count > 5'000 ? 5 : count > 100 ? 20 : 200) && same;
  }
  return same ? 0 : 1;
}
