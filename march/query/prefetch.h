// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks memory for what a query will read, while the queries before it run. Of bodies that no cache holds one line names the
// next: the model its levels, the level the record of the seed's feature, this its half-edges, these the neighbours. A query
// waits for one after the other. Here each is a step, which reads what the step before has asked for:
//
//     step   a seed's features    no features                     a question of yes or no
//      0     the models and the seed
//      1     their levels         their levels                    what the balls are compared by
//      2     the features         cells of the support maps       if these do not tell: levels with maps
//      3     a half-edge          the vertices that these name    cells of their maps
//      4     its twin             the rings                       the vertices that these name
//      5     its origin           the neighbours
//      6     the ring             the ring of the highest one
//      7     the neighbours       its neighbours
//
// That is where nearly every cold query begins and most warm ones end. What else a query reads it waits for, as ever. No answer
// depends on any of this. Knows the order in which queries read, nothing of what they compute.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <swiftlet/batch.h>

#include "body/half_edge.h"
#include "body/support_map.h"
#include "pair/support_gjk.h"
#include "query/seed.h"

namespace swiftlet {

// All is inlined: GCC 12 takes a function that only prefetches for one without effect, and drops calls of it.

/// Asks for the cache lines of `record`.
template <class T>
[[gnu::always_inline]] static inline void prefetch(const T& record) {
  constexpr std::size_t kLine = 64;
  const char* begin = reinterpret_cast<const char*>(&record);
  for (std::size_t i = 0; i < sizeof(T); i += kLine) __builtin_prefetch(begin + i);
  __builtin_prefetch(begin + sizeof(T) - 1);
}
/// A vertex never lies across lines.
[[gnu::always_inline]] static inline void prefetch(const Vertex& vertex) { __builtin_prefetch(&vertex); }

/// One of two bodies on its way into the cache.
class Arrival {
 public:
  [[gnu::always_inline]] void model(const Model* model) {
    level_ = nullptr;
    model_ = model;
    if (model) prefetch(*model);
  }
  /// The level of a seed's feature, and level 0, which says how large the body is.
  [[gnu::always_inline]] void level_of(FeatureId feature, int level) {
    if (!model_) return;
    feature_ = feature;
    if (feature.kind() == FeatureKind::None || level < model_->finest_level() || level >= model_->level_count())
      return mapped_level(), balls();
    level_ = &model_->level(level);
    prefetch(*level_);
    if (level != 0) balls();
  }
  /// The finest level with a map.
  [[gnu::always_inline]] void mapped_level() {
    if (!model_ || model_->map_level() == model_->level_count()) return;
    level_ = &model_->level(model_->map_level());
    prefetch(*level_);
  }
  /// The centre, the inner ball, and how far the finest level is from the exact hull.
  [[gnu::always_inline]] void balls() const {
    if (!model_) return;
    const ConvexView& view = model_->level(0).view;
    prefetch(view.extent), prefetch(view.inner_radius);
    prefetch(model_->level(model_->finest_level()).deviation);
  }
  const Model* model() const { return model_; }
  bool has_map() const { return level_ && level_->map_side > 0; }
  const Level& level() const { return *level_; }

  [[gnu::always_inline]] void feature() {
    if (!level_ || !names_feature(view(), feature_) || view().half_edges.empty()) return void(level_ = nullptr);
    const std::uint32_t i = feature_.index();
    if (feature_.kind() == FeatureKind::Vertex) return prefetch(view().vertices[i]);
    if (feature_.kind() == FeatureKind::Edge) return prefetch(view().half_edges[i]);
    prefetch(view().face_first[i]);
  }
  /// A half-edge of the feature.
  [[gnu::always_inline]] void half_edge() {
    if (!level_) return;
    const std::uint32_t own = feature_.index();
    const std::uint32_t* named = &own;  // chosen without branches, as processors cannot guess kinds
    if (feature_.kind() == FeatureKind::Vertex) named = &view().vertices[own].ring_begin;
    if (feature_.kind() == FeatureKind::Face) named = &view().face_first[own];
    at_ = *named;
    prefetch(view().half_edges[at_]);
  }
  [[gnu::always_inline]] void twin() {
    if (level_) prefetch(view().half_edges[at_ = view().half_edges[at_].twin]);
  }
  [[gnu::always_inline]] void head() {
    if (level_) prefetch(view().vertices[at_ = view().half_edges[at_].head]);
  }
  [[gnu::always_inline]] void cell(const Vec& direction) {
    const Vec m = into_map(*level_, direction);
    prefetch(level_->support_map[at_ = lut::octahedron_cell(level_->map_side, m.x, m.y, m.z)]);
  }
  [[gnu::always_inline]] void vertex() { prefetch(view().vertices[at_ = map_vertex(level_->support_map[at_])]); }
  [[gnu::always_inline]] void ring() const {
    if (!level_ || here().ring_count == 0) return;
    prefetch(view().half_edges[here().ring_begin]);
    prefetch(view().half_edges[here().ring_begin + here().ring_count - 1]);
  }
  [[gnu::always_inline]] void neighbours() const {
    if (!level_ || here().ring_count == 0) return;
    for (std::uint32_t k = 0; k < 8; ++k) prefetch(view().vertices[neighbour(k)]);
  }
  /// Goes on to the highest neighbour along `d`, if one is higher.
  [[gnu::always_inline]] void climb(const Vec& d) {
    if (here().ring_count == 0) return;
    double most = dot(d, point());
    std::uint32_t highest = at_;
    for (std::uint32_t k = 0; k < 6; ++k) {
      const std::uint32_t to = neighbour(k);
      const double height = dot(d, vec(view().vertices[to]));
      highest = height > most ? to : highest;
      most = max(most, height);
    }
    at_ = highest;
  }
  Vec point() const { return vec(here()); }

 private:
  const ConvexView& view() const { return level_->view; }
  const Vertex& here() const { return view().vertices[at_]; }
  /// The `k`-th neighbour, or the last: a loop over so many as most rings have ends where a processor expects it.
  std::uint32_t neighbour(std::uint32_t k) const {
    return view().half_edges[here().ring_begin + std::min(k, here().ring_count - 1)].head;
  }

  const Model* model_ = nullptr;  ///< null for a primitive
  const Level* level_ = nullptr;  ///< null if nothing more is known
  FeatureId feature_;
  std::uint32_t at_ = 0;  ///< the index of what was asked for last
};

/// What a query begins with.
enum class Begin {
  Features,  ///< the seed's, or without these the supports along one direction
  Verdict,   ///< balls, then the supports along one direction
};

/// A pair on its way into the cache, step by step.
template <Begin kBegin>
class Prefetch {
 public:
  static constexpr std::size_t kSteps = kBegin == Begin::Verdict ? 5 : 8;

  template <std::size_t kStep>
  [[gnu::always_inline]] void step(const PairQuery& q) {
    if constexpr (kStep == 0) {
      a_.model(q.a.model()), b_.model(q.b.model());
      if (q.seed) prefetch(*q.seed);
    } else if constexpr (kBegin == Begin::Verdict) {
      verdict<kStep>(q);
    } else if constexpr (kStep == 1) {
      const PairSeed seed = q.seed ? *q.seed : PairSeed{};
      is_warm_ = seed.a.kind() != FeatureKind::None && seed.b.kind() != FeatureKind::None;
      a_.level_of(seed.a, seed.level_a), b_.level_of(seed.b, seed.level_b);
    } else {
      is_warm_ ? warm<kStep>() : cold<kStep>(q);
    }
  }

 private:
  template <std::size_t kStep>
  [[gnu::always_inline]] void warm() {
    if constexpr (kStep == 2) a_.feature(), b_.feature();
    if constexpr (kStep == 3) a_.half_edge(), b_.half_edge();
    if constexpr (kStep == 4) a_.twin(), b_.twin();
    if constexpr (kStep == 5) a_.head(), b_.head();
    if constexpr (kStep == 6) a_.ring(), b_.ring();
    if constexpr (kStep == 7) a_.neighbours(), b_.neighbours();
  }

  template <std::size_t kStep>
  [[gnu::always_inline]] void cold(const PairQuery& q) {
    if constexpr (kStep == 2) {
      has_maps_ = a_.has_map() && b_.has_map();
      if (!has_maps_) return;
      const Motion m = motion(q.b_in_a);
      const Vec4 in_a = vec4(between(m));
      Line line;
      store(in_a, line.in_a), store(turned_line(in_a, m), line.in_b);
      const PairSeed seed = q.seed ? *q.seed : PairSeed{};
      look(m, vec(first_direction(seed, SinceStored(seed, line.in_a), Turn::Some, a_.level(), b_.level(), m, line)));
    }
    if (!has_maps_) return;
    if constexpr (kStep == 3) a_.vertex(), b_.vertex();
    if constexpr (kStep == 6) {
      const Motion m = motion(q.b_in_a);
      const Vec apart = apply(m, b_.point()) - a_.point();
      a_.climb(apart), b_.climb(-rotate_back(m, apart));
    }
    if constexpr (kStep == 4 || kStep == 6) a_.ring(), b_.ring();
    if constexpr (kStep == 5 || kStep == 7) a_.neighbours(), b_.neighbours();
  }

  template <std::size_t kStep>
  [[gnu::always_inline]] void verdict(const PairQuery& q) {
    if constexpr (kStep == 1) {
      a_.balls(), b_.balls();
      has_maps_ = a_.model() && b_.model();
    }
    if (!has_maps_) return;
    const Motion m = motion(q.b_in_a);
    if constexpr (kStep == 2) {
      const ConvexView &a = a_.model()->level(0).view, &b = b_.model()->level(0).view;
      const double outer = a_.model()->radius() + b_.model()->radius(), inner = a.inner_radius + b.inner_radius;
      const Vec line = between(m);
      const double apart2 = dot(line, line);
      has_maps_ = apart2 <= outer * outer && apart2 >= inner * inner;
      if (has_maps_) a_.mapped_level(), b_.mapped_level();
    }
    if constexpr (kStep == 3) {
      has_maps_ = a_.has_map() && b_.has_map();
      if (!has_maps_) return;
      const Vec line = between(m);
      look(m, q.seed && SinceStored(*q.seed, line).serves() ? direction(*q.seed) : line);
    }
    if constexpr (kStep == 4) a_.vertex(), b_.vertex();
  }

  Vec between(const Motion& m) const {
    return apply(m, vec(b_.model()->level(0).view.centre)) - vec(a_.model()->level(0).view.centre);
  }
  [[gnu::always_inline]] void look(const Motion& m, const Vec& direction) {
    a_.cell(direction), b_.cell(-rotate_back(m, direction));
  }

  Arrival a_, b_;
  bool is_warm_ = false, has_maps_ = false;  ///< `has_maps_`: of both bodies, and the query will look into them
};

}  // namespace swiftlet
