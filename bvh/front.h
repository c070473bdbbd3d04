// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a front holds: groups of eight pairs that lie side by side, each pair with a bound on its distance that holds in any
// pose; and when a search is to use it. Knows no tree: descent.h writes and reads it.
#pragma once

#include <optional>
#include <vector>

#include <swiftlet/mesh_front.h>

#include "node.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The pairs that a group holds, by their number i in it.
enum class FrontKind : std::uint32_t {
  NodesOfB,   ///< node a and node b + i
  NodesOfA,   ///< node a + i and node b
  Triangles,  ///< triangle a and triangle b + i
  Rows        ///< the triangle i of the lowest node a, and all of the lowest node b
};

/// Bounds on the distances of eight pairs, over the pair's unit. Of each n is a unit direction in A's frame, and the ball of
/// centre c and radius r in B's frame holds what the pair has of B. Where the pose is R and t, and T what B has turned since
/// the front began, the distance is at least n (R c + t) - h - T r. A pair of no bound has an infinite h, one that is not
/// there minus infinity.
struct alignas(32) FrontBounds {
  float n[3][kFanOut], c[3][kFanOut], h[kFanOut], r[kFanOut];
};
struct FrontIds {
  std::uint32_t a, b;
  FrontKind kind;
  std::uint32_t live;  ///< one bit for each pair that is there
};
/// A pair of a front: eight times its group and its number in it.
using FrontPlace = std::uint32_t;
inline constexpr FrontPlace kNoPlace = ~FrontPlace{0};

struct MeshFront::State {
  explicit State(std::size_t pairs);

  /// Makes it that of two meshes.
  void serve(const MeshModel& a, const MeshModel& b);
  /// Notes a pose; `middle` is that of B's root, in A's frame, and `reach` how far B reaches from it, both over the pair's
  /// unit, of exponent `unit`. True if the search is to use the front, which is then empty if `begins`.
  bool moves_to(const Motion& b_in_a, int unit, const Vec& middle, double reach);
  /// True if a search is not even to note its pose.
  bool rests();
  /// Takes note of what a search has cost, that used it or not, and was `done` before all was looked at or not; `asked` groups
  /// were looked at.
  void settle(bool used, bool done, std::uint32_t nodes, std::uint32_t triangles, std::uint32_t asked);
  void forget() { groups = holes_left = 0, holds = false; }

  std::uint32_t room() const { return holes_left + (capacity - groups); }
  std::uint32_t take(const FrontIds& of, float arm_of_it);
  void drop(FrontPlace place);
  float& end_of(std::uint32_t group) { return ends[group / kFanOut].of[group % kFanOut]; }
  float& arm_of(std::uint32_t group) { return arms[group / kFanOut].of[group % kFanOut]; }

  struct alignas(32) Eight {
    float of[kFanOut];
  };
  struct Near {
    float bound;
    FrontPlace place;
  };
  std::uint32_t capacity;    ///< in groups
  std::uint32_t groups = 0;  ///< that were ever taken since it began
  std::uint32_t holes_left = 0;
  std::vector<FrontBounds> bounds;
  std::vector<FrontIds> ids;
  /// No pair of a group is near as long as W + arm T + limit < end, where W is how far the middle of B has gone and T how far
  /// B has turned. The arm is how far the balls reach from that middle.
  std::vector<Eight> ends, arms;
  std::vector<Near> near;            ///< of one search
  std::vector<std::uint32_t> holes;  ///< groups without pairs

  std::optional<MeshModel> mesh_a, mesh_b;
  bool holds = false;   ///< all pairs of triangles are below its own
  bool begins = false;  ///< this search starts from the roots
  int unit = 0;
  bool has_pose = false;
  Motion pose{};
  Vec middle{};
  double gone = 0, turned = 0;  ///< W and T

 private:
  void give_up();
  double plain = 0, recent = 0, spent = 0, queries = 0;  ///< instructions of a plain search, of the last ones, since it began
  double pace = 0, pace_given_up = 0;                    ///< how far a point of B goes in a query
  int pause = 0, next_pause, rested = 0;                 ///< queries to do without; that noted no pose
  int until_seen = 0;                                    ///< queries until a plain search is seen again
  bool pays = false;                                     ///< the last plain search had something to spare
};

/// Shows a front's memory, or null.
class FrontReader {
 public:
  static MeshFront::State* state(MeshFront& front) { return front.state_.get(); }
  using State = MeshFront::State;
};

}  // namespace swiftlet
