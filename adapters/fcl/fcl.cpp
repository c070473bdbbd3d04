// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

#include <algorithm>
#include <limits>

namespace swiftlet::fcl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A pair as the queries of world.h take it. Borrows the operands.
struct Pair {
  const Placed* a = nullptr;  ///< null: the kernel does not answer; a model, or `b` is one
  const Placed* b = nullptr;  ///< null: the half-space
  HalfSpace half_space;
  bool is_swapped = false;  ///< `a` is 2
};

bool is_model(const Placed* placed) { return placed && placed->body.model(); }

/// The side of a plane that the model is farther out of: a plane is what two half-spaces have in common.
HalfSpace facing(const Placed& model, const Plane& plane) {
  const HalfSpace below{plane.normal, plane.offset}, above{-plane.normal, -plane.offset};
  return nearest(model, below, kInfinity).distance >= nearest(model, above, kInfinity).distance ? below : above;
}

Pair pair_of(const Operand& first, const Operand& second) {
  Pair pair{std::get_if<Placed>(&first), std::get_if<Placed>(&second), {}, false};
  if (pair.a && pair.b) return is_model(pair.a) || is_model(pair.b) ? pair : Pair{};
  pair.is_swapped = !pair.a;
  const Operand& flat = pair.is_swapped ? first : second;
  if (pair.is_swapped) std::swap(pair.a, pair.b);
  if (!is_model(pair.a) || std::holds_alternative<std::monostate>(flat)) return {};
  if (const auto* const plane = std::get_if<Plane>(&flat))
    pair.half_space = facing(*pair.a, *plane);
  else
    pair.half_space = std::get<HalfSpace>(flat);
  return pair;
}

double tolerance(const Pair& p) { return p.b ? tolerance(*p.a, *p.b) : tolerance(*p.a, p.half_space); }

Nearest nearest(const Pair& p, PairSeed& seed) {
  if (!p.a) return {};
  if (p.b) return nearest(*p.a, *p.b, kInfinity, seed);
  Nearest near = nearest(*p.a, p.half_space, kInfinity);
  if (p.is_swapped) {
    near.normal = -near.normal;
    std::swap(near.point_a, near.point_b);
  }
  return near;
}

}  // namespace

bool is_model(const Operand& operand) { return is_model(std::get_if<Placed>(&operand)); }

std::vector<int> face_loops(const Model& model) {
  const ConvexView& view = model.level(0).view;
  std::vector<int> loops;
  for (std::uint32_t face = 0; face < view.face_first.size(); ++face) {
    const std::size_t size_at = loops.size();
    loops.push_back(0);
    for (const std::uint32_t v : FaceLoop(view, face)) loops.push_back(int(v));
    loops[size_at] = int(loops.size() - size_at - 1);
  }
  return loops;
}

template <class S>
Result<Model> model_of(const ::fcl::Convex<S>& shape) {
  std::vector<Vec3> vertices;
  for (const auto& v : shape.getVertices()) vertices.push_back(v.template cast<double>());
  std::vector<std::uint32_t> corners, sizes;
  const std::vector<int>& faces = shape.getFaces();
  for (std::size_t at = 0; at < faces.size(); at += 1 + sizes.back()) {
    sizes.push_back(std::uint32_t(faces[at]));
    if (sizes.back() >= faces.size() - at) return Error{ErrorCode::BadValue, "the last face is shorter than it says"};
    for (std::size_t i = 1; i <= sizes.back(); ++i) corners.push_back(std::uint32_t(faces[at + i]));
  }
  LevelArrays arrays;
  arrays.vertices = vertices;
  arrays.face_vertices = corners;
  arrays.face_sizes = sizes;
  ModelOptions options;
  options.repair = true;  // a polygon's rounded corners lie in no plane
  return Model::from_level(arrays, options);
}
template Result<Model> model_of(const ::fcl::Convex<double>&);
template Result<Model> model_of(const ::fcl::Convex<float>&);

Verdict meeting(const Operand& a, const Operand& b, PairSeed& seed) {
  const Pair p = pair_of(a, b);
  if (p.a && p.b) return meeting(*p.a, *p.b, seed);
  const Nearest near = nearest(p, seed);
  if (near.found == Found::Nothing) return Verdict::Undecided;
  if (near.distance > tolerance(p)) return Verdict::Disjoint;
  return near.distance < -tolerance(p) ? Verdict::Overlapping : Verdict::Touching;
}

Nearest nearest(const Operand& a, const Operand& b, PairSeed& seed) { return nearest(pair_of(a, b), seed); }

std::vector<Touch> touches(const Operand& a, const Operand& b, PairSeed& seed) {
  const Pair p = pair_of(a, b);
  if (!p.a) return {};
  const double touching = tolerance(p);
  Manifold manifold;
  if (p.b)
    contacts(*p.a, *p.b, touching, 4, seed, manifold);
  else
    contacts(*p.a, p.half_space, touching, 4, manifold);
  const Vec3 normal = p.is_swapped ? Vec3(-manifold.normal) : manifold.normal;
  std::vector<Touch> result;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.points[i];
    result.push_back({normal, (point.point_a + point.point_b) / 2, std::max(-point.separation, touching)});
  }
  return result;
}

std::optional<Touch> deepest_touch(const Operand& a, const Operand& b, PairSeed& seed) {
  const Pair p = pair_of(a, b);
  const Nearest near = nearest(p, seed);
  if (near.found == Found::Nothing) return {};
  return Touch{near.normal, (near.point_a + near.point_b) / 2, std::max(-near.distance, tolerance(p))};
}

}  // namespace swiftlet::fcl
