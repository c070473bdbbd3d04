// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The one interface behind which every method stands in the benchmark. Knows models and poses; nothing of scenes, clocks or
// truth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>
#include <swiftlet/query.h>

#include "pairs.h"

namespace swiftlet::bench {

/// What one query answered.
struct Outcome {
  double distance = 0;       ///< >= 0; with overlapping 0, or the depth where that was asked for; meaningless with failed
  bool overlapping = false;  ///< the method says that the bodies share a point
  bool failed = false;       ///< the method says itself that it has no answer
  std::uint32_t steps = 0,
                plane_tests = 0;  ///< iterations and support calls where a method has no features; 0 where it hides both
};

using yardstick::BodyPair;
using yardstick::Query;
using yardstick::SceneBody;

/// What a session's bodies cost before the first query. Its states per pair are not counted.
struct Preparation {
  double seconds = 0;
  std::size_t heap_bytes = 0;  ///< live after preparing, less live before, in malloc's own count; 0 where that is not known
};

/// A method with the bodies of one scene prepared and one warm-start state per pair. Not to be shared between threads.
class Session {
 public:
  virtual ~Session() = default;
  virtual Outcome distance(std::uint32_t pair, const Pose& b_in_a) = 0;
  /// As cheap as the method can: read `overlapping` only.
  virtual Outcome intersects(std::uint32_t pair, const Pose& b_in_a) = 0;
  /// Of bodies that overlap the depth, as `distance`; apart as `intersects`.
  virtual Outcome depth(std::uint32_t pair, const Pose& b_in_a) = 0;
  /// Allowed to be off by max(absolute, relative * distance).
  virtual Outcome approximate(std::uint32_t pair, const Pose& b_in_a, double absolute, double relative) = 0;

  /// The same, one after the other in one virtual call: what a timed pass calls, so that dispatch costs a fast method no more
  /// than a slow one. The outputs are as long as the queries.
  virtual void distances(std::span<const Query> queries, std::span<Outcome> outcomes) = 0;
  virtual void intersections(std::span<const Query> queries, std::span<Outcome> outcomes) = 0;
  virtual void depths(std::span<const Query> queries, std::span<Outcome> outcomes) = 0;
  virtual void approximations(std::span<const Query> queries, double absolute, double relative,
                              std::span<Outcome> outcomes) = 0;

  /// Makes every pair cold again.
  virtual void forget() = 0;
  Preparation preparation() const { return preparation_; }

 protected:
  Preparation preparation_;
};

/// The loops for a final class `Self`, which the compiler then calls directly.
template <class Self>
class SessionOf : public Session {
 public:
  Outcome depth(std::uint32_t, const Pose&) override { return {.failed = true}; }
  Outcome approximate(std::uint32_t, const Pose&, double, double) override { return {.failed = true}; }
  void distances(std::span<const Query> queries, std::span<Outcome> outcomes) final {
    for (std::size_t i = 0; i < queries.size(); ++i) outcomes[i] = self().distance(queries[i].pair, queries[i].b_in_a);
  }
  void intersections(std::span<const Query> queries, std::span<Outcome> outcomes) final {
    for (std::size_t i = 0; i < queries.size(); ++i) outcomes[i] = self().intersects(queries[i].pair, queries[i].b_in_a);
  }
  void depths(std::span<const Query> queries, std::span<Outcome> outcomes) final {
    for (std::size_t i = 0; i < queries.size(); ++i) outcomes[i] = self().depth(queries[i].pair, queries[i].b_in_a);
  }
  void approximations(std::span<const Query> queries, double absolute, double relative, std::span<Outcome> outcomes) final {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      outcomes[i] = self().approximate(queries[i].pair, queries[i].b_in_a, absolute, relative);
    }
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

/// What a method can answer at all, and how well by its own account.
struct Capabilities {
  bool distance = false, intersects = false, approximate = false, depth = false;
  bool certified = false;  ///< its answers carry a proof
  double stated_error =
      0;  ///< of `distance`, in units of the larger bounding radius, on bodies not flatter or longer than 10:1
          ///< and at distances up to a few radii. For peers: what was measured, rounded up, as none states one
  double wrong_share =
      0;  ///< of the answers on bodies without parallel faces, so many were measured to be off by more, rounded
          ///< up: a known defect of the method, which does not notice. tests/peers_test.cpp holds it to that
  std::uint32_t max_triangles = std::numeric_limits<std::uint32_t>::max();  ///< beyond, preparing takes more than a minute
};

class Method {
 public:
  virtual ~Method() = default;
  virtual std::string name() const = 0;      ///< as in the results and the legends; unique
  virtual std::string settings() const = 0;  ///< one line: version, precision, tolerance, what is cached
  virtual Capabilities capabilities() const = 0;
  /// The bodies' models outlive the session. Solids only.
  virtual std::unique_ptr<Session> open(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs) const = 0;
};

using Methods = std::vector<std::unique_ptr<Method>>;

/// Ours first, then the baselines, then the peers that the build found.
Methods all_methods();
/// The baselines and the peers, each as its users run it where a timed row leaves something out: for verdicts, not for clocks.
Methods judged_methods();
/// Ours with options, or asked without. The models that a session is opened with decide levels and table.
std::unique_ptr<Method> swiftlet_method(std::string name, std::string settings, const std::optional<Options>& options);
/// Our walk alone, by another rule than `plain` in all_methods.
std::unique_ptr<Method> plain_method(std::string name, std::string settings, PlaneRule rule, bool table = false);
/// The peers that the build did not find.
std::vector<std::string> absent_peers();

// Each in its own source, called where CMake found the library.
void add_fcl(Methods& methods);
void add_fcl_native(Methods& methods);  ///< the same sources and FCL's templates compiled for this very machine
void add_ccd(Methods& methods);
void add_bullet(Methods& methods);
void add_bullet_epa(Methods& methods);
void add_ode(Methods& methods);

}  // namespace swiftlet::bench
