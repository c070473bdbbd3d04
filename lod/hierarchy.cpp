// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Level after level: simplify the one before and make the result hold level 0 [Ehmann & Lin 2000, sec. 4.3]. What cannot be
// built ends the hierarchy.
#include "hierarchy.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>

#include "collapse.h"
#include "deviation.h"
#include "enclose.h"
#include "hull.h"
#include "peel.h"

namespace swiftlet::lod {
namespace {

constexpr double kWorthwhile =
    0.65;  ///< a level with more of the triangles of the one before is not worth its memory, unless asked for

/// Coordinates in which the surface of a solid spreads alike in all directions: a plate or a needle simplifies as a sphere
/// does. Affine, so that it keeps hulls, volume ratios and which body holds which, up to rounding.
class Whitening {
 public:
  explicit Whitening(const Polytope& body) : centre_(area_centroid(body)) {
    const Eigen::LLT<Mat3> factor(area_covariance(body));
    if (factor.info() == Eigen::Success) spread_ = factor.matrixL();
    if (!spread_.allFinite() || !(spread_.diagonal().minCoeff() > 0x1p-30 * spread_.diagonal().maxCoeff()))
      spread_.setIdentity();
  }
  Polytope whitened(Polytope body) const {
    for (Vec3& p : body.points) p = spread_.triangularView<Eigen::Lower>().solve(p - centre_);
    return body;
  }
  const Mat3& spread() const { return spread_; }
  std::vector<Vec3> restored(std::vector<Vec3> points) const {
    for (Vec3& p : points) p = centre_ + spread_.triangularView<Eigen::Lower>() * p;
    return points;
  }

 private:
  Vec3 centre_;
  Mat3 spread_ = Mat3::Identity();
};

/// What a method makes next: a level, or the sentence why there is none.
struct Step {
  std::optional<CoarseLevel> level;
  std::string end;
};

/// Garland & Heckbert levels [sec. 4.5]. Each simplifies the one before as it was before growing, so that growth never adds up.
class Collapser {
 public:
  Collapser(const Polytope& level0, const BuildOptions& options)
      : options_(options),
        level0_(level0),
        plain_(level0),
        whitening_(level0),
        shape_(tight() ? whitening_.whitened(level0) : level0),
        simple_(shape_),
        body_(shape_) {}

  Step next() {
    Simpler coarser = simpler(simple_);
    if (!coarser.shape) return {{}, coarser.end};
    simple_ = std::move(*coarser.shape);
    return enclosed(simple_);
  }

  /// A shape with fewer triangles, before it is grown, or the sentence why there is none.
  struct Simpler {
    std::optional<Polytope> shape;
    std::string end;
  };
  /// `rate` times as many, no fewer than the cutoff.
  Simpler simpler(const Polytope& shape) const {
    const std::size_t before = shape.triangles.size();
    const std::size_t target =
        std::max({std::size_t(options_.rate * double(before)), std::size_t(options_.cutoff), std::size_t(4)});
    const double worthwhile = std::max(kWorthwhile, options_.rate);
    if (double(target) > worthwhile * double(before)) return {{}, "the next level would have fewer triangles than the cutoff"};
    Simpler coarser = simpler(shape, target);
    if (coarser.shape && double(coarser.shape->triangles.size()) > (1 + worthwhile) / 2 * double(before))
      return {{}, "no more edges could be collapsed"};
    return coarser;
  }
  Simpler simpler(const Polytope& shape, std::size_t target) const {
    const std::vector<Vec3> points = collapse(shape, target);
    if (points.empty()) return {{}, "too thin for quadric errors"};
    const Hull coarse = hull(points);
    if (coarse.dimension < 3) return {{}, "the next level would be flat"};
    return {solid(points, coarse), {}};
  }

  const Polytope& shape() const { return shape_; }  ///< level 0 as it is simplified

  Step enclosed(const Polytope& simple) const {
    const Vec3 centre = area_centroid(shape_), drift = centre - area_centroid(simple);
    Polytope moved = simple;
    for (Vec3& p : moved.points) p += drift;
    Result<Polytope> scaled = scale_to_hold(std::move(moved), body_, centre);
    if (!scaled) return {{}, scaled.error().message};
    std::vector<Vec3> points = tight()
                                   ? whitening_.restored(tighten(std::move(scaled).value(), body_, whitening_.spread()).points)
                                   : scaled.value().points;
    Result<Proved> proved = prove(std::move(points), plain_, area_centroid(level0_));
    if (!proved) return {{}, proved.error().message};
    return {CoarseLevel{std::move(proved.value().level), {}, {}}, {}};
  }

 private:
  bool tight() const { return options_.enclosing == Enclosing::Tight; }

  const BuildOptions& options_;
  const Polytope& level0_;
  Climber plain_;  ///< level 0
  Whitening whitening_;
  Polytope shape_;   ///< level 0, whitened for Tight
  Polytope simple_;  ///< the last level before it was grown
  Climber body_;     ///< over shape_
};

/// Dobkin & Kirkpatrick levels [sec. 4.4]: each keeps vertices of the one before, as it was grown: built on the
/// exact hulls of level 0's vertices instead, plates deviate many times more.
class Peeler {
 public:
  Peeler(const Polytope& level0, const BuildOptions& options)
      : options_(options), plain_(level0), centre_(area_centroid(level0)), last_(level0) {}

  Step next() {
    const std::size_t fewest = std::max<std::size_t>(options_.cutoff, 4);
    if (last_.triangles.size() < fewest + 2) return {{}, "the next level would have fewer triangles than the cutoff"};
    const std::vector<std::uint32_t> removed = independent_set(last_, (last_.triangles.size() - fewest) / 2);
    const std::vector<std::uint32_t> kept = complement(removed, last_.points.size());
    std::vector<Vec3> points;
    for (std::uint32_t v : kept) points.push_back(last_.points[v]);
    const Hull shape = hull(points);
    if (shape.dimension < 3) return {{}, "the next level would be flat"};
    const Polytope coarse = solid(points, shape);

    Result<Polytope> scaled = scale_to_hold(coarse, plain_, centre_);
    if (!scaled) return {{}, scaled.error().message};
    const bool tight = options_.enclosing == Enclosing::Tight;
    const Polytope level = tight ? tighten(std::move(scaled).value(), plain_, Mat3::Identity())
                                 : relax(std::move(scaled).value(), plain_, centre_);
    Result<Proved> proved = prove(level.points, plain_, centre_);
    if (!proved) return {{}, proved.error().message};
    Step step{CoarseLevel{proved.value().level, {}, {}}, {}};
    if (!tight) link(proved.value(), kept, removed, *step.level);
    last_ = step.level->body;
    return step;
  }

 private:
  static std::vector<std::uint32_t> complement(const std::vector<std::uint32_t>& removed, std::size_t count) {
    std::vector<bool> gone(count);
    for (std::uint32_t v : removed) gone[v] = true;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t v = 0; v < count; ++v)
      if (!gone[v]) kept.push_back(v);
    return kept;
  }

  /// A vertex's child is its own copy, a new triangle's the vertex whose hole it fills [sec. 4.4.3].
  void link(const Proved& proved, const std::vector<std::uint32_t>& kept, const std::vector<std::uint32_t>& removed,
            CoarseLevel& level) const {
    for (std::uint32_t v : proved.vertices) level.vertex_child.push_back(kept[v]);
    std::vector<Triangle> triangles = proved.level.triangles;
    for (Triangle& triangle : triangles)
      for (std::uint32_t& corner : triangle) corner = level.vertex_child[corner];
    level.triangle_child = removed_above(last_, removed, triangles);
  }

  const BuildOptions& options_;
  Climber plain_;
  Vec3 centre_;
  Polytope last_;
};

template <class Stepper>
Hierarchy stepped(Stepper&& method, const Polytope& level0, const BuildOptions& options,
                  const std::function<bool(double)>& keep_on) {
  Hierarchy result;
  std::size_t left = level0.triangles.size();
  while (int(result.levels.size()) + 1 < options.max_levels) {
    if (!keep_on(1 - double(left) / double(level0.triangles.size()))) {
      result.cancelled = true;
      return result;
    }
    Step step = method.next();
    result.end = step.end;
    if (!step.level) return result;
    left = std::min(left, step.level->body.triangles.size());
    result.levels.push_back(std::move(*step.level));
  }
  result.end = "the greatest number of levels was reached";
  return result;
}

/// Collapsed levels for a model that need be no finer than to deviate less than `options.detail` says. All are simplified,
/// which is cheap, but only those from the coarsest up are made to hold level 0, which is dear, until one deviates less; in its
/// stead one of as few triangles as will do.
class AimedCollapse {
 public:
  AimedCollapse(const Polytope& level0, const BuildOptions& options, const std::function<bool(double)>& keep_on)
      : options_(options),
        keep_on_(keep_on),
        collapser_(level0, options),
        deviation_(level0),
        allowed_(options.detail.deviation / kStated) {}

  Hierarchy run() {
    simplify();
    bool fine = false;
    for (std::size_t k = simple_.size(); k-- > 0 && !fine && keep_on();) {
      Step step = collapser_.enclosed(simple_[k]);
      if (!step.level) {
        result_.end = step.end;
        continue;
      }
      const double deviation = deviation_(step.level->body.points);
      fine = deviation < allowed_;
      if (!fine || !push_leaner(simple_[k], deviation)) push(std::move(*step.level), deviation);
    }
    if (!fine && int(result_.levels.size()) + 1 < options_.max_levels) push_leaner(collapser_.shape(), 0);
    std::reverse(result_.levels.begin(), result_.levels.end());
    return std::move(result_);
  }

 private:
  static constexpr double kStated = 1.01;  ///< the deviations that models state are at most so many times the true ones
  static constexpr double kAim = 0.95;     ///< of the deviation allowed; the estimate is a power law through two levels
  static constexpr int kTries = 3;

  bool keep_on() {
    result_.cancelled = !keep_on_(std::min(1.0, double(++stages_) / double(2 * options_.max_levels)));
    return !result_.cancelled;
  }

  void simplify() {
    while (int(simple_.size()) + 1 < options_.max_levels && keep_on()) {
      Collapser::Simpler coarser = collapser_.simpler(simple_.empty() ? collapser_.shape() : simple_.back());
      result_.end = coarser.end;
      if (!coarser.shape) return;
      simple_.push_back(std::move(*coarser.shape));
    }
  }

  void push(CoarseLevel level, double deviation) {
    result_.levels.push_back(std::move(level));
    last_deviation_ = deviation;
  }

  /// Whether there is a level between the last one, which deviates too much, and `simple`, whose own deviates by `deviation`,
  /// that deviates no more than allowed with fewer triangles than `simple`.
  bool push_leaner(const Polytope& simple, double deviation) {
    if (result_.levels.empty()) return false;
    const double most = double(simple.triangles.size()), fewest = double(result_.levels.back().body.triangles.size());
    const double power = deviation > 0 ? std::log(last_deviation_ / deviation) / std::log(most / fewest) : 1;
    double triangles = fewest * std::pow(last_deviation_ / (kAim * allowed_), 1 / power);
    for (int k = 0; k < kTries && triangles < kWorthwhile * most && keep_on(); ++k) {
      const Collapser::Simpler shape = collapser_.simpler(simple, std::size_t(triangles));
      if (!shape.shape) break;
      Step step = collapser_.enclosed(*shape.shape);
      const double found = step.level ? deviation_(step.level->body.points) : allowed_;
      if (found < allowed_) return push(std::move(*step.level), found), true;
      triangles *= std::pow(found / (kAim * allowed_), 1 / power);
    }
    return false;
  }

  const BuildOptions& options_;
  const std::function<bool(double)>& keep_on_;
  Collapser collapser_;
  Deviation deviation_;
  const double allowed_;
  std::vector<Polytope> simple_;  ///< finest first
  Hierarchy result_;              ///< coarsest first until the end
  double last_deviation_ = 0;     ///< of the last level in it
  int stages_ = 0;
};

}  // namespace

Hierarchy hierarchy(const Polytope& level0, const BuildOptions& options, const std::function<bool(double)>& keep_on) {
  if (options.method == Method::Peel) return stepped(Peeler(level0, options), level0, options, keep_on);
  if (options.detail.deviation > 0) return AimedCollapse(level0, options, keep_on).run();
  return stepped(Collapser(level0, options), level0, options, keep_on);
}

}  // namespace swiftlet::lod
