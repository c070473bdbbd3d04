// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Ours and the baselines as methods, and the list of all. Knows the public queries; the peers only by name.
#include "method.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <swiftlet/depth.h>
#include <swiftlet/query.h>

#include "hull.h"
#include "plain.h"
#include "vclip.h"

namespace swiftlet::bench {
using namespace yardstick;
namespace {

// ---- swiftlet --------------------------------------------------------------------------------------------------------------

/// The middle of the proved interval: off by at most half of what was asked for.
Outcome outcome_of(const Answer& answer) {
  Outcome o{.steps = answer.steps, .plane_tests = answer.plane_tests};
  o.overlapping = answer.verdict == Verdict::Overlapping;
  o.failed = answer.status != Status::Converged;
  if (!o.overlapping && !o.failed) o.distance = answer.value();
  return o;
}

class SwiftletSession final : public SessionOf<SwiftletSession> {
 public:
  SwiftletSession(const std::optional<Options>& options, std::span<const SceneBody> bodies, std::span<const BodyPair> pairs)
      : has_options_(options), options_(options.value_or(Options{})) {
    for (const SceneBody& body : bodies) {
      preparation_.seconds += body.build_seconds;
      preparation_.heap_bytes += body.model->bytes().size();
    }
    for (const BodyPair& p : pairs) pairs_.push_back({*bodies[p.a].model, *bodies[p.b].model, {}});
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    return outcome_of(has_options_ ? swiftlet::distance(s.a, s.b, b_in_a, s.seed, options_)
                                   : swiftlet::distance(*s.a.model(), *s.b.model(), b_in_a, s.seed));
  }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    return outcome_of(has_options_ ? swiftlet::intersects(s.a, s.b, b_in_a, s.seed, {options_.budget, options_.tuning})
                                   : swiftlet::intersects(*s.a.model(), *s.b.model(), b_in_a, s.seed));
  }
  Outcome depth(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    const Answer a = swiftlet::signed_distance(s.a, s.b, b_in_a, s.seed, options_);
    return {.distance = std::fabs(a.lower),
            .overlapping = a.upper <= 0,
            .failed = a.status != Status::Converged,
            .steps = a.steps,
            .plane_tests = a.plane_tests};
  }
  Outcome approximate(std::uint32_t pair, const Pose& b_in_a, double absolute, double relative) override {
    State& s = pairs_[pair];
    Options options = options_;
    options.absolute = absolute;
    options.relative = relative;
    return outcome_of(swiftlet::distance(s.a, s.b, b_in_a, s.seed, options));
  }
  void forget() override {
    for (State& s : pairs_) s.seed = {};
  }

 private:
  struct State {
    Body a, b;
    PairSeed seed;
  };
  bool has_options_;
  Options options_;
  std::vector<State> pairs_;
};

class SwiftletMethod final : public Method {
 public:
  SwiftletMethod(std::string name, std::string settings, const std::optional<Options>& options)
      : name_(std::move(name)), settings_(std::move(settings)), options_(options) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  Capabilities capabilities() const override {
    return {.distance = true,
            .intersects = true,
            .approximate = true,
            .depth = true,
            .certified = true,
            .stated_error = 1e-12};  // law 2: 64 eps size, with size up to a hundred radii
  }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<SwiftletSession>(options_, bodies, pairs);
  }

 private:
  std::string name_, settings_;
  std::optional<Options> options_;
};

void add_swiftlet(Methods& methods) {
  methods.push_back(
      swiftlet_method("swiftlet", "as shipped: automatic start, both bodies one level at a time, most violated plane", {}));
  const auto add = [&](const char* name, const char* settings, const Tuning& tuning) {
    methods.push_back(swiftlet_method(name, settings, Options{.tuning = tuning}));
  };
  add("swiftlet table", "starts on level 0 from the tables, no hierarchy, no seed", {.start = StartPolicy::Table});
  add("swiftlet finest", "starts on level 0 from the last features, no hierarchy", {.start = StartPolicy::Finest});
  add("swiftlet coarsest", "starts on the coarsest pair, always", {.start = StartPolicy::Coarsest});
  add("swiftlet paper", "start level by the paper's rule [sec. 5.2]", {.start = StartPolicy::Paper});
  add("swiftlet first", "first violated plane [sec. 5.1]", {.plane_rule = PlaneRule::FirstViolated});
  add("swiftlet single", "one level of one body at a time", {.refinement = Refinement::Single});
  add("swiftlet double", "two levels of both bodies at a time", {.refinement = Refinement::DoubleDouble});
}

// ---- The baseline ----------------------------------------------------------------------------------------------------------

class VclipSession final : public SessionOf<VclipSession> {
 public:
  VclipSession(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) : index_(pairs.begin(), pairs.end()) {
    preparation_ = measured([&] {
      bodies_.reserve(bodies.size());
      for (const SceneBody& body : bodies) bodies_.emplace_back(body.view);
    });
    seeds_.resize(pairs.size());
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
    const VclipResult r = vclip(bodies_[index_[pair].a], bodies_[index_[pair].b], b_in_a, seeds_[pair]);
    Outcome o{.steps = r.steps, .plane_tests = r.plane_tests};
    o.overlapping = r.penetrating();
    o.failed = r.end == VclipEnd::Capped;
    if (!o.failed) o.distance = r.distance;
    return o;
  }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override {
    return distance(pair, b_in_a);  // the paper has no cheaper one
  }
  void forget() override { seeds_.assign(seeds_.size(), {}); }

 private:
  std::vector<VclipBody> bodies_;
  std::vector<BodyPair> index_;
  std::vector<VclipSeed> seeds_;
};

class VclipMethod final : public Method {
 public:
  std::string name() const override { return "vclip"; }
  std::string settings() const override { return "V-Clip from the paper, last features cached"; }
  Capabilities capabilities() const override { return {.distance = true, .intersects = true, .stated_error = 1e-12}; }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<VclipSession>(bodies, pairs);
  }
};

// ---- Our walk alone --------------------------------------------------------------------------------------------------------

class PlainSession final : public SessionOf<PlainSession> {
 public:
  PlainSession(PlaneRule rule, bool table, std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) : rule_(rule) {
    // A level of the model as it is: nothing to prepare but the table.
    for (const SceneBody& body : bodies) preparation_.heap_bytes += body.model->level(0).bytes;
    for (const SceneBody& body : bodies) {
      if (table) tabled_.push_back(body.model->with_table({lut::Resolution::Degrees5, 2, 0}).value());
    }
    for (const BodyPair& p : pairs) pairs_.push_back({p, bodies[p.a].view, bodies[p.b].view, {}});
  }
  Outcome distance(std::uint32_t pair, const Pose& b_in_a) override {
    State& s = pairs_[pair];
    if (!tabled_.empty()) s.seed = table_start(tabled_[s.index.a], tabled_[s.index.b], b_in_a);
    const PlainResult r = plain(s.a, s.b, b_in_a, s.seed, rule_);
    Outcome o{.steps = r.steps, .plane_tests = r.plane_tests};
    o.overlapping = r.inside;
    o.failed = r.stalled;
    if (!r.inside && !r.stalled) o.distance = r.distance;
    return o;
  }
  Outcome intersects(std::uint32_t pair, const Pose& b_in_a) override { return distance(pair, b_in_a); }
  void forget() override {
    for (State& s : pairs_) s.seed = {};
  }

 private:
  struct State {
    BodyPair index;
    ConvexView a, b;
    PlainSeed seed;
  };
  PlaneRule rule_;
  std::vector<Model> tabled_;  ///< with the paper's table; empty: starts from the last features
  std::vector<State> pairs_;
};

class PlainMethod final : public Method {
 public:
  PlainMethod(std::string name, std::string settings, PlaneRule rule, bool table)
      : name_(std::move(name)), settings_(std::move(settings)), rule_(rule), table_(table) {}
  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  Capabilities capabilities() const override {
    return {.distance = true, .intersects = true, .stated_error = 1e-12, .wrong_share = 0.05};  // ends inside, or stalls
  }
  std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const override {
    return std::make_unique<PlainSession>(rule_, table_, bodies, pairs);
  }

 private:
  std::string name_, settings_;
  PlaneRule rule_;
  bool table_;
};

}  // namespace

std::unique_ptr<Method> swiftlet_method(std::string name, std::string settings, const std::optional<Options>& options) {
  return std::make_unique<SwiftletMethod>(std::move(name), std::move(settings), options);
}

std::unique_ptr<Method> plain_method(std::string name, std::string settings, PlaneRule rule, bool table) {
  return std::make_unique<PlainMethod>(std::move(name), std::move(settings), rule, table);
}

Methods all_methods() {
  Methods methods;
  add_swiftlet(methods);
  methods.push_back(std::make_unique<VclipMethod>());
  methods.push_back(
      plain_method("plain", "our walk on level 0, last features; no hierarchy, table or certificate", PlaneRule::MostViolated));
  methods.push_back(plain_method("plain table", "the same from the paper's table of 5.625 degrees at every query",
                                 PlaneRule::MostViolated, true));
#ifdef SWIFTLET_PEER_FCL
  add_fcl(methods);
#endif
#ifdef SWIFTLET_PEER_FCL_NATIVE
  add_fcl_native(methods);
#endif
#ifdef SWIFTLET_PEER_CCD
  add_ccd(methods);
#endif
#ifdef SWIFTLET_PEER_BULLET
  add_bullet(methods);
#endif
#ifdef SWIFTLET_PEER_ODE
  add_ode(methods);
#endif
  return methods;
}

Methods judged_methods() {
  Methods methods = all_methods();
  // Ours are judged by the laws; what is compiled otherwise is the same algorithm; Bullet's detector is run with its depth
  // solver.
  std::erase_if(methods, [](const std::unique_ptr<Method>& method) {
    const std::string name = method->name();
    return name.starts_with("swiftlet") || name.ends_with(" native") || name == "bullet" || name == "bullet climb";
  });
#ifdef SWIFTLET_PEER_BULLET
  add_bullet_epa(methods);
#endif
  return methods;
}

std::vector<std::string> absent_peers() {
  std::vector<std::string> names;
  std::string_view rest = SWIFTLET_ABSENT_PEERS;  // separated by commas
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    names.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return names;
}

}  // namespace swiftlet::bench
