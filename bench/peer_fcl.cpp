// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// FCL 0.7 as a method: its own solver, and its distance on libccd. Knows FCL's headers and Method; all of FCL's templates are
// here.
//
// Compiled twice. Plainly it calls the templates that Debian instantiated in libfcl (-O2, SSE2). With SWIFTLET_FCL_NATIVE it is
// a shared library of its own, -O3 -march=native, that instantiates them again and shows one symbol, so that the two never mix.
//
// Settings, and why they are the best honest ones:
// - "fcl indep": GJK itself rather than GJKSolver_indep::shapeDistance, which does just this and then repeats every support, a
// scan
//   over all vertices, for the witness points. The ray of the pair's last query is the guess. Tolerance: 1e-6, the default, is
//   also what the *squared* distance of two supports must exceed, which ends some queries on small triangles early, and bodies
//   nearer than that count as overlapping; 1e-12 costs no more. Some 0.5 % of the answers stay wrong at any tolerance, by up to
//   0.06 r: where Project finds a tetrahedron degenerate the loop ends with the last ray and the status Valid. Shallow overlaps
//   are missed so too.
// - "fcl libccd": GJKSolver_libccd, FCL's default, on fcl::Convex. It has no cache, allocates two objects per query, and
//   every support climbs from vertex 0 with an array of marks as long as the body. distance_tolerance is the least progress per
//   iteration, not an error: with the default 1e-6 queries on 2 000 triangles end up to 1e-4 r early; 1e-12 lets them run on,
//   at the same cost. Between parallel faces it stops early at any tolerance (0.4 r too long): there it makes no progress at
//   first [fcl#508].
// - "fcl libccd climb": the same GJK of FCL (libccd_extension::ccdGJKDist2) with a support that climbs from the last vertex,
// and the
//   last direction as the first: what FCL's own source asks for in a TODO, and its fastest setting.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "hull.h"
#include "method.h"

#ifdef SWIFTLET_FCL_NATIVE
template struct fcl::detail::GJK<double>;
template struct fcl::detail::MinkowskiDiff<double>;
template class fcl::Convex<double>;
template class fcl::detail::GJKInitializer<double, fcl::Convex<double>>;
template bool fcl::detail::GJKDistance(void*, ccd_support_fn, void*, ccd_support_fn, unsigned int, double, double*,
                                       fcl::Vector3d*, fcl::Vector3d*);
template bool fcl::detail::GJKCollide(void*, ccd_support_fn, ccd_center_fn, void*, ccd_support_fn, ccd_center_fn, unsigned int,
                                      double, fcl::Vector3d*, double*, fcl::Vector3d*);
#endif

namespace swiftlet::bench {
namespace {

using Convex = fcl::Convex<double>;
using Gjk = fcl::detail::GJK<double>;

#ifdef SWIFTLET_FCL_NATIVE
constexpr const char* kSuffix = " native";
constexpr const char* kBuild = "FCL " SWIFTLET_PEER_VERSION ", double, -O3 -march=native, ";
#else
constexpr const char* kSuffix = "";
constexpr const char* kBuild = "FCL " SWIFTLET_PEER_VERSION ", double, as installed, ";
#endif

constexpr double kIndepTolerance = 1e-12;
constexpr double kCcdTolerance = 1e-12;
constexpr int kMaxIterations = 1000;  // FCL's default for libccd; 128 for indep. Never met

std::unique_ptr<Convex> convex_of(const ConvexView& view) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  points->reserve(view.vertices.size());
  for (const Vertex& v : view.vertices) points->emplace_back(v.x, v.y, v.z);
  auto loops = std::make_shared<std::vector<int>>(face_loops<int>(view));
  loops->shrink_to_fit();
  return std::make_unique<Convex>(points, int(view.face_first.size()), loops, true);
}

fcl::Transform3d transform_of(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation;
  t.translation() = pose.translation;
  return t;
}

/// The bodies as FCL's shapes.
struct Shapes {
  std::vector<std::unique_ptr<Convex>> all;
  Preparation prepare(std::span<const SceneBody> bodies) {
    return measured([&] {
      for (const SceneBody& body : bodies) all.push_back(convex_of(body.view));
    });
  }
};

// ---- FCL's own GJK ---------------------------------------------------------------------------------------------------------

class IndepSession final : public SessionOf<IndepSession> {
 public:
  IndepSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) {
    preparation_ = shapes_.prepare(bodies);
    for (const BodyPair& p : pairs) pairs_.push_back({shapes_.all[p.a].get(), shapes_.all[p.b].get(), kCold});
    solver_.epa_tolerance = kIndepTolerance;
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override { return run(pair, b_in_a, kIndepTolerance); }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    // FCL has no cheaper boolean: GJK runs to its end, and only then is asked which side it ended on.
    return distance(pair, b_in_a);
  }
  Outcome approximate(std::uint32_t pair, const Pose& b_in_a, double absolute, double relative) override {
    // Its test C ends when upper - lower <= tolerance * upper; there is no absolute one. Its test B squares, hence the product.
    (void)absolute;
    return run(pair, b_in_a, std::max(kIndepTolerance, relative * relative));
  }
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    const State& s = pairs_[pair];
    std::vector<fcl::ContactPoint<double>> contacts;
    if (!solver_.shapeIntersect(*s.a, fcl::Transform3d::Identity(), *s.b, transform_of(b_in_a), &contacts)) return {};
    return {.distance = contacts.empty() ? 0 : std::fabs(contacts[0].penetration_depth),
            .overlapping = true,
            .failed = contacts.empty()};
  }
  void forget() override {
    for (State& s : pairs_) s.ray = kCold;
  }

 private:
  inline static const fcl::Vector3d kCold{1, 0, 0};
  struct State {
    const Convex *a, *b;
    fcl::Vector3d ray;
  };

  Outcome run(std::uint32_t pair, const Pose& b_in_a, double tolerance) {
    State& s = pairs_[pair];
    fcl::detail::MinkowskiDiff<double> difference;
    difference.shapes[0] = s.a;
    difference.shapes[1] = s.b;
    difference.toshape1 = b_in_a.rotation.transpose();
    difference.toshape0 = transform_of(b_in_a);
    Gjk gjk(kMaxIterations, tolerance);
    const Gjk::Status status = gjk.evaluate(difference, -s.ray);
    s.ray = status == Gjk::Valid ? gjk.getGuessFromSimplex() : kCold;
    if (status == Gjk::Inside) return {.overlapping = true};
    if (status == Gjk::Failed || !std::isfinite(gjk.distance)) return {.failed = true};
    return {.distance = gjk.distance};
  }

  Shapes shapes_;
  std::vector<State> pairs_;
  fcl::detail::GJKSolver_indep<double> solver_;  // of depths only
};

// ---- GJK on libccd, as FCL calls it ----------------------------------------------------------------------------------------

class LibccdSession final : public SessionOf<LibccdSession> {
 public:
  LibccdSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) : pairs_(pairs.begin(), pairs.end()) {
    preparation_ = shapes_.prepare(bodies);
    solver_.max_distance_iterations = kMaxIterations;
    solver_.max_collision_iterations = kMaxIterations;
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override { return run(pair, b_in_a, kCcdTolerance); }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    const Convex &a = *shapes_.all[pairs_[pair].a], &b = *shapes_.all[pairs_[pair].b];
    return {.overlapping =
                solver_.shapeIntersect(a, fcl::Transform3d::Identity(), b, transform_of(b_in_a), nullptr)};  // MPR, to 1e-6
  }
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    const Convex &a = *shapes_.all[pairs_[pair].a], &b = *shapes_.all[pairs_[pair].b];
    solver_.collision_tolerance = kCcdTolerance;
    std::vector<fcl::ContactPoint<double>> contacts;
    if (!solver_.shapeIntersect(a, fcl::Transform3d::Identity(), b, transform_of(b_in_a), &contacts)) return {};
    return {.distance = contacts.empty() ? 0 : std::fabs(contacts[0].penetration_depth),
            .overlapping = true,
            .failed = contacts.empty()};
  }
  Outcome approximate(std::uint32_t pair, const Pose& b_in_a, double absolute, double) override {
    return run(pair, b_in_a, std::max(kCcdTolerance, absolute));
  }
  void forget() override {}

 private:
  Outcome run(std::uint32_t pair, const Pose& b_in_a, double tolerance) {
    const Convex &a = *shapes_.all[pairs_[pair].a], &b = *shapes_.all[pairs_[pair].b];
    solver_.distance_tolerance = tolerance;
    double distance = 0;
    // -1 stands for an overlap and for the iteration limit alike.
    if (!solver_.shapeDistance(a, fcl::Transform3d::Identity(), b, transform_of(b_in_a), &distance))
      return {.overlapping = true};
    if (!std::isfinite(distance)) return {.failed = true};
    return {.distance = distance};
  }

  Shapes shapes_;
  std::vector<BodyPair> pairs_;
  fcl::detail::GJKSolver_libccd<double> solver_;
};

// ---- The same with the caller's support ------------------------------------------------------------------------------------

class ClimbSession final : public SessionOf<ClimbSession> {
 public:
  ClimbSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) {
    preparation_ = measured([&] {
      graphs_.reserve(bodies.size());
      for (const SceneBody& body : bodies) graphs_.emplace_back(body.view);
    });
    for (const BodyPair& p : pairs) pairs_.emplace_back(graphs_[p.a], graphs_[p.b]);
    CCD_INIT(&ccd_);
    ccd_.first_dir = [](const void* a, const void*, ccd_vec3_t* dir) { *dir = static_cast<const First*>(a)->direction; };
    ccd_.support1 = [](const void* a, const ccd_vec3_t* dir, ccd_vec3_t* point) {
      First& first = *static_cast<First*>(const_cast<void*>(a));
      first.direction = *dir;
      ++first.calls;
      const Graph::Node& n = first.climber.support(dir->v[0], dir->v[1], dir->v[2]);
      *point = {{n.x, n.y, n.z}};
    };
    ccd_.support2 = [](const void* b, const ccd_vec3_t* dir, ccd_vec3_t* point) {
      Second& second = *static_cast<Second*>(const_cast<void*>(b));
      const Vec3 d = second.pose->rotation.transpose() * Vec3(dir->v[0], dir->v[1], dir->v[2]);
      const Graph::Node& n = second.climber.support(d[0], d[1], d[2]);
      const Vec3 p = second.pose->rotation * Vec3(n.x, n.y, n.z) + second.pose->translation;
      *point = {{p[0], p[1], p[2]}};
    };
    ccd_.max_iterations = kMaxIterations;
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override { return run(pair, b_in_a, kCcdTolerance); }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    s.b.pose = &b_in_a;
    ccd_simplex_t simplex;
    return {.overlapping = fcl::detail::libccd_extension::__ccdGJK(&s.a, &s.b, &ccd_, &simplex) == 0};
  }
  Outcome approximate(std::uint32_t pair, const Pose& b_in_a, double absolute, double) override {
    return run(pair, b_in_a, std::max(kCcdTolerance, absolute));
  }
  void forget() override {
    for (State& s : pairs_) s.forget();
  }

 private:
  struct First {
    Climber climber;
    ccd_vec3_t direction{{1, 0, 0}};
    std::uint32_t calls = 0;
  };
  struct Second {
    Climber climber;
    const Pose* pose = nullptr;
  };
  struct State {
    First a;
    Second b;
    State(const Graph& of_a, const Graph& of_b) : a{Climber(of_a)}, b{Climber(of_b)} {}
    void forget() { a.climber.forget(), b.climber.forget(), a.direction = {{1, 0, 0}}; }
  };

  Outcome run(std::uint32_t pair, const Pose& b_in_a, double tolerance) {
    State& s = pairs_[pair];
    s.b.pose = &b_in_a;
    s.a.calls = 0;
    ccd_.dist_tolerance = tolerance;
    const double distance = fcl::detail::libccd_extension::ccdGJKDist2(&s.a, &s.b, &ccd_, nullptr, nullptr);
    if (!std::isfinite(distance)) {
      s.forget();
      return {.failed = true};
    }
    Outcome outcome{.steps = s.a.calls, .plane_tests = 2 * s.a.calls};
    if (distance < 0) {
      outcome.overlapping = s.a.calls < kMaxIterations;
      outcome.failed = !outcome.overlapping;
    } else {
      outcome.distance = distance;
    }
    return outcome;
  }

  std::vector<Graph> graphs_;
  std::vector<State> pairs_;
  ccd_t ccd_;
};

template <class SessionType>
class FclMethod final : public Method {
 public:
  FclMethod(const char* name, const char* settings, Capabilities capabilities)
      : name_(std::string(name) + kSuffix), settings_(std::string(kBuild) + settings), capabilities_(capabilities) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  Capabilities capabilities() const override { return capabilities_; }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<SessionType>(bodies, pairs);
  }

 private:
  std::string name_, settings_;
  Capabilities capabilities_;
};

}  // namespace

#ifdef SWIFTLET_FCL_NATIVE
void add_fcl_native(Methods& methods) {
#else
void add_fcl(Methods& methods) {
#endif
  const auto capabilities = [](double wrong_share, bool depth = true) {
    return Capabilities{.distance = true,
                        .intersects = true,
                        .approximate = true,
                        .depth = depth,
                        .stated_error = 1e-9,
                        .wrong_share = wrong_share};
  };
  methods.push_back(std::make_unique<FclMethod<IndepSession>>("fcl indep", "GST_INDEP, tolerance 1e-12, last ray as guess",
                                                              capabilities(0.02)));
  methods.push_back(
      std::make_unique<FclMethod<LibccdSession>>("fcl libccd", "GST_LIBCCD, tolerance 1e-12, no cache", capabilities(0)));
  methods.push_back(std::make_unique<FclMethod<ClimbSession>>(
      "fcl libccd climb", "its GJK on libccd with our support from the last vertex, tolerance 1e-12, last direction first",
      capabilities(0, false)));
}

}  // namespace swiftlet::bench
