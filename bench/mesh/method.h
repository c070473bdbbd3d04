// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The one interface behind which every method stands in the benchmark of meshes. Knows triangles and poses; nothing of scenes
// or clocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/pose.h>

namespace swiftlet {
class MeshModel;
}

namespace swiftlet::bench::mesh {

enum class Kind { Intersects, Within, Distance, Contacts, Manifolds, SignedDistance };
inline constexpr std::size_t kKinds = 6;

/// One question about a pair in one pose.
struct Question {
  Kind kind = Kind::Distance;
  double threshold = 0;  ///< in units: of Within, and the reach of Contacts and Manifolds
  double relative = 0;   ///< of Distance: the error that is allowed, as a fraction of the distance
};

struct Reply {
  bool yes = false;                         ///< of Intersects and Within
  double distance = 0;                      ///< of Distance; of SignedDistance the lower bound
  double upper = 0;                         ///< of SignedDistance the upper bound
  std::size_t count = 0;                    ///< of Contacts regions or pairs of triangles, of Manifolds points
  bool failed = false;                      ///< the method says itself that it has no answer
  std::uint32_t opened = 0, looked_at = 0;  ///< pairs of nodes and of triangles, where the method tells
};

/// A method with one pair prepared and its warm start, if it has one. Not to be shared between threads.
class Session {
 public:
  virtual ~Session() = default;
  virtual Reply ask(const Question& question, const Pose& b_in_a) = 0;

  double build_seconds = 0;  ///< to prepare both bodies
  std::size_t bytes = 0;     ///< of both, as malloc counts them or in blocks
};

class Method {
 public:
  virtual ~Method() = default;
  virtual std::string name() const = 0;      ///< as in the results
  virtual std::string settings() const = 0;  ///< one line
  virtual bool can(const Question& question) const = 0;
  virtual std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const = 0;
};

using Methods = std::vector<std::unique_ptr<Method>>;
using MakeModel = MeshModel (*)(const Mesh&);
MeshModel boxes_of(const Mesh& mesh);  ///< ours without hulls
std::unique_ptr<Method> swiftlet_method(std::string name, std::string settings, MakeModel make, bool with_fronts = false);
std::unique_ptr<Session> swiftlet_session(MeshModel a, MeshModel b, bool with_fronts = false);
void add_fcl(Methods& methods);         ///< where it is installed
void add_fcl_native(Methods& methods);  ///< and can be compiled for this machine alone
std::unique_ptr<Method> cgal_method();
void add_hull_trees(Methods& methods);  ///< SWIFT++'s, with all sets of its accelerations

}  // namespace swiftlet::bench::mesh
