// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes: named bodies, convex ones and meshes, in one world, and the questions about all their pairs, or about all pairs with
// another scene's. A tree of boxes leaves out the pairs that are far apart; what is left is asked by the library's queries.
// Knows no algorithm of a query.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <swiftlet/batch.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// Names a body of a scene; the default names none. An id never comes back after its body was removed. Ids are ordered by
/// `index`.
struct BodyId {
  std::uint32_t index = kNone;   ///< the body's place, which later bodies may take
  std::uint32_t generation = 0;  ///< which body in that place
  /// Compares both.
  constexpr auto operator<=>(const BodyId&) const = default;
};

/// A pair of bodies and what was answered of it.
struct ScenePair {
  BodyId a;       ///< of the scene that was asked
  BodyId b;       ///< of the other scene; of pairs within one scene a < b
  Answer answer;  ///< in A's frame, about the pose relative(pose(a), pose(b))
};

/// The nearest pair of bodies, and what is proved of all.
struct NearestPair : ScenePair {
  /// No pair is nearer than this: the least distance is in [lower, answer.upper]. Where no pair is found, there is none up to
  /// `lower`, which is the options' `beyond`.
  double lower = std::numeric_limits<double>::infinity();
};

/// A pair in contact.
struct SceneContact : ScenePair {
  Manifold manifold;  ///< in A's frame
};

/// Bodies in one world, each with a name, and what is kept of pairs from question to question: warm starts, and manifolds.
///
/// A question about all pairs leaves out those whose boxes are proved to be farther apart than asked. It lists, in the order of
/// (a, b), every other pair that its query does not prove to be farther apart; `answer` says what is proved of it. A body or
/// pose that queries refuse may be anywhere: its pairs are all listed, and the status of their answers says why. Of two poses
/// that queries take the relative one may still be refused, as rotations are rigid to barely 1e-6 or it translates by more than
/// 1e45: then the pair is listed if its boxes are near, and otherwise taken to be far apart.
///
/// The same calls in the same order give the same bits, whatever the executor. Seeds change the work, never the truth (LAWS.md,
/// law 3). Questions allocate. One thread at a time may use a scene; several may ask about the same `other`, if that rests
/// meanwhile.
class Scene {
 public:
  Scene();  ///< without bodies
  Scene(const Body& body,
        const Pose& in_world);  ///< one body without a name, to ask about: `scene.overlapping(Scene(a, pose))`
  Scene(const MeshBody& body, const Pose& in_world);  ///< likewise
  Scene(Scene&&) noexcept;                            ///< what is moved from may only be assigned or destroyed
  Scene& operator=(Scene&&) noexcept;                 ///< likewise
  ~Scene();

  /// Adds a body; an empty name names nothing. Keeps a copy of its `Model`, which shares the block: the caller's may go.
  /// Returns BodyId{} where another body has the name. Cost: O(log bodies).
  [[nodiscard]] BodyId add(std::string_view name, const Body& body, const Pose& in_world);
  /// The same of a mesh, or of any convex body: keeps a copy of the `MeshModel` or `Model`, which shares the block.
  [[nodiscard]] BodyId add(std::string_view name, const MeshBody& body, const Pose& in_world);
  /// Moves a body. Returns false if `id` names none. Cost: O(log bodies), less for small moves.
  bool move(BodyId id, const Pose& in_world);
  /// Removes a body. Returns false if `id` names none.
  bool remove(BodyId id);
  /// Pairs within this scene for which `asks` is false are left out of all answers, such as the neighbours of a chain. `asks`
  /// is called with a < b, on the thread that asks; empty: all are asked.
  void ask_only(std::function<bool(BodyId a, BodyId b)> asks);
  /// How questions run from now on: on an executor, as batches do, until they are stopped. Pairs that `Run::stop` kept from
  /// being asked are listed as NotAsked.
  void run_by(Run run);

  BodyId find(std::string_view name) const;  ///< BodyId{} if no body has the name
  bool has(BodyId id) const;                 ///< whether `id` names a body of this scene
  std::size_t size() const;                  ///< number of bodies
  std::vector<BodyId> bodies() const;        ///< in order
  std::string_view name(BodyId id) const;    ///< until the next `add` or `remove`; empty if `id` names none
  Body body(BodyId id) const;                ///< as long as it is in the scene; Body() of a mesh, or if `id` names none
  MeshBody mesh_body(BodyId id) const;       ///< likewise, of a mesh too
  Pose pose(BodyId id) const;                ///< in the world; NaN if `id` names none

  // All questions ignore `trace` and `proof`. The bodies of `other` are B; it may be this scene: the pairs within it.

  /// Lists the pairs that are not proved to be disjoint: the verdict of each is Overlapping or Touching, or its status says why
  /// not.
  std::vector<ScenePair> overlapping(const Scene& other, const Effort& effort = {});
  /// Lists the pairs that are not proved to be farther apart than `threshold`. Those with answer.upper <= threshold are proved
  /// to be no farther; others are within `tolerance` of it, or their status says why not.
  std::vector<ScenePair> within(const Scene& other, double threshold, const Effort& effort = {});
  /// Lists the pairs that are not proved to be farther apart than options.beyond, with their distances.
  std::vector<ScenePair> distances(const Scene& other, const Options& options);
  /// Finds the pair with the least `upper`, or a pair that was refused. Cost: that of distances up to it, with one known pair's
  /// distance as the first bound.
  NearestPair nearest(const Scene& other, const Options& options = {});
  /// Lists the pairs whose signed distance is not proved to be above options.margin, with it and the contact manifold, which
  /// keeps the points of the last call's. A pair with a mesh is listed once for each region in which the bodies are as near
  /// (mesh_contacts.h), with the region's interval; of a body inside a solid, whose surface it does not meet, and of a margin
  /// below 0, once with the depth's interval and no points.
  std::vector<SceneContact> contacts(const Scene& other, const ManifoldOptions& options = {});

  /// As above, of the pairs within this scene.
  std::vector<ScenePair> overlapping(const Effort& effort = {}) { return overlapping(*this, effort); }
  /// As above, of the pairs within this scene.
  std::vector<ScenePair> within(double threshold, const Effort& effort = {}) { return within(*this, threshold, effort); }
  /// As above, of the pairs within this scene.
  std::vector<ScenePair> distances(const Options& options) { return distances(*this, options); }
  /// As above, of the pairs within this scene.
  NearestPair nearest(const Options& options = {}) { return nearest(*this, options); }
  /// As above, of the pairs within this scene.
  std::vector<SceneContact> contacts(const ManifoldOptions& options = {}) { return contacts(*this, options); }

  /// A pair's warm start is kept until one of its bodies goes, or so many questions to the same scene did not come to the pair.
  static constexpr std::uint32_t kQuestionsKept = 16;

 private:
  struct Content;
  std::shared_ptr<Content> content_;  ///< shared with none; what others keep of pairs with this scene ends with it
};

}  // namespace swiftlet
