// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Level after level: simplify the one before and make the result hold level 0 [Ehmann & Lin 2000, sec. 4.3]. What cannot be
// built ends the hierarchy.
#include "hierarchy.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "collapse.h"
#include "cost.h"
#include "deviation.h"
#include "enclose.h"
#include "hull.h"
#include "numeric/chunks.h"
#include "peel.h"

namespace swiftlet::lod {
namespace {

constexpr double kRate = 0.25;  ///< BuildOptions::rate where none is asked for
constexpr double kWorthwhile =
    0.65;  ///< a level with more of the triangles of the one before is not worth its memory, unless asked for

/// Coordinates in which the surface of a solid spreads alike in all directions: a plate or a needle simplifies as a sphere
/// does. The map is affine: hulls, ratios of volumes and enclosure are kept, up to rounding. For a body too thin to invert it
/// is the identity.
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

constexpr double kPeelRounds = 6;  ///< the triangles of all levels over those of level 0
constexpr const char* kMostLevels = "the greatest number of levels was reached";

/// What a method makes next: a level, or the sentence why there is none.
struct Step {
  std::optional<CoarseLevel> level;
  std::string end;
};

/// Makes Garland & Heckbert levels [sec. 4.5]. Each level is simplified from the shape that the previous one had before it was
/// grown, so that growth does not add up.
class Collapser {
 public:
  Collapser(const Polytope& level0, const BuildOptions& options, Watch& watch)
      : options_(options),
        watch_(watch),
        whitening_(level0),
        shape_(tight() ? whitening_.whitened(level0) : level0),
        plain_centre_(area_centroid(level0)),
        centre_(area_centroid(shape_)) {
    run_tasks(options.executor, 2, [&](std::size_t task) {
      if (task == 0) plain_.emplace(level0);
      if (task == 1) body_.emplace(shape_);
    });
  }

  /// A shape with fewer triangles, before it is grown, or the sentence why there is none.
  struct Simpler {
    std::optional<Polytope> shape;
    std::string end;
  };
  /// How many the level after one of so many triangles is to have: `rate` times as many, no fewer than the cutoff. Where no
  /// rate is asked for, fine levels are as far apart as queries like them.
  std::size_t target(std::size_t triangles) const {
    const double vertices = double(triangles) / 2 + 2;
    double next = options_.rate.value_or(kRate) * double(triangles);
    if (!options_.rate && kRate * vertices > cost_.mapped_vertices) next = 2 * steps_to_map(cost_, vertices).front() - 4;
    return std::max({std::size_t(next), std::size_t(options_.cutoff), std::size_t(4)});
  }
  bool worthwhile(std::size_t triangles, std::size_t before) const {
    return double(triangles) <= most_of_one() * double(before);
  }
  Simpler simpler(const Polytope& shape) const {
    const std::size_t before = shape.triangles.size(), after = target(before);
    if (!worthwhile(after, before)) return {{}, "the next level would have fewer triangles than the cutoff"};
    Simpler coarser = simpler(shape, after);
    if (coarser.shape && double(coarser.shape->triangles.size()) > (1 + most_of_one()) / 2 * double(before))
      return {{}, "no more edges could be collapsed"};
    return coarser;
  }
  Simpler simpler(const Polytope& shape, std::size_t target) const {
    const std::vector<Vec3> points = collapse(shape, target, options_.executor, watch_);
    const Hull coarse = hull(points, options_.executor);
    if (coarse.dimension < 3) return {{}, "the next level would be flat"};
    return {solid(points, coarse), {}};
  }

  const Polytope& shape() const { return shape_; }  ///< level 0 as it is simplified

  /// May run for several levels at once.
  Step enclosed(const Polytope& simple) const {
    const Climber plain = *plain_, body = *body_;
    const Vec3 drift = centre_ - area_centroid(simple);
    Polytope moved = simple;
    for (Vec3& p : moved.points) p += drift;
    Result<Polytope> scaled = scale_to_hold(std::move(moved), body, centre_);
    if (!scaled) return {{}, scaled.error().message};
    std::vector<Vec3> points =
        tight() ? whitening_.restored(tighten(std::move(scaled).value(), body, whitening_.spread(), watch_).points)
                : scaled.value().points;
    Result<Proved> proved = prove(std::move(points), plain, plain_centre_);
    if (!proved) return {{}, proved.error().message};
    return {CoarseLevel{std::move(proved.value().level), {}, {}}, {}};
  }

 private:
  bool tight() const { return options_.enclosing == Enclosing::Tight; }
  double most_of_one() const { return std::max(kWorthwhile, options_.rate.value_or(0)); }

  const BuildOptions& options_;
  const QueryCost cost_;
  Watch& watch_;
  Whitening whitening_;
  Polytope shape_;                       ///< level 0, whitened for Tight
  std::optional<Climber> plain_, body_;  ///< over level 0, over shape_; copied, never climbed
  Vec3 plain_centre_, centre_;           ///< of these
};

/// Dobkin & Kirkpatrick levels [sec. 4.4]: each keeps vertices of the one before, as it was grown: built on the
/// exact hulls of level 0's vertices instead, plates deviate many times more.
class Peeler {
 public:
  Peeler(const Polytope& level0, const BuildOptions& options, Watch& watch)
      : options_(options), watch_(watch), plain_(level0), centre_(area_centroid(level0)), last_(level0) {}

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
    const Polytope level = tight ? tighten(std::move(scaled).value(), plain_, Mat3::Identity(), watch_)
                                 : relax(std::move(scaled).value(), plain_, centre_, watch_);
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
  Watch& watch_;
  Climber plain_;
  Vec3 centre_;
  Polytope last_;
};

Hierarchy peeled(const Polytope& level0, const BuildOptions& options, Watch& watch) {
  watch.begin("levels", kLevelsDone, kPeelRounds * move_work(double(level0.triangles.size())));
  Peeler method(level0, options, watch);
  Hierarchy result;
  while (int(result.levels.size()) + 1 < options.max_levels) {
    watch.work(0);
    Step step = method.next();
    result.end = step.end;
    if (!step.level) return result;
    result.levels.push_back(std::move(*step.level));
  }
  result.end = kMostLevels;
  return result;
}

/// Collapsed levels. All are simplified, finest first; then they are made to hold level 0, coarsest first, which is dearer: for
/// a model that need be no finer than to deviate less than `options.detail` says, only until one does. Where a level is the
/// first that is fine enough for an error that scenes ask for, one of as few triangles as will do takes its place.
class Collapse {
 public:
  Collapse(const Polytope& level0, const BuildOptions& options, Watch& watch)
      : options_(options), watch_(watch), collapser_(level0, options, watch) {
    if (is_aimed()) {
      wanted_ = {options.detail.deviation / kStated};
    } else if (!options.rate) {
      const Vec3 centre = area_centroid(level0);
      for (const Vec3& p : level0.points) radius_ = std::max(radius_, (p - centre).norm());
      for (const Asked& asked : kAsked)
        if (asked.error > 0) wanted_.push_back(asked.error / 2 * radius_ / kStated);
      std::sort(wanted_.begin(), wanted_.end(), std::greater<>());
    }
    if (!wanted_.empty()) deviation_.emplace(level0);
  }

  Hierarchy run() {
    announce();
    simplify();
    std::vector<Enclosed> enclosed(simple_.size());
    if (!is_aimed())  // else the finer ones may not be needed
      run_tasks(options_.executor, simple_.size(), [&](std::size_t k) { enclosed[k] = made_to_hold(simple_[k], {}); });
    for (std::size_t k = simple_.size(); k-- > 0 && !(is_aimed() && wanted_.empty());) {
      auto [step, deviation] = is_aimed() ? made_to_hold(simple_[k], options_.executor) : std::move(enclosed[k]);
      if (!step.level) {
        result_.end = step.end;
        if (!is_aimed()) result_.levels.clear(), sizes_.clear();
        continue;
      }
      if (wanted_.empty() || deviation >= wanted_.front() || !push_leaner(simple_[k], deviation, k))
        push(std::move(*step.level), deviation);
    }
    if (is_aimed() && !wanted_.empty() && int(result_.levels.size()) + 1 < options_.max_levels)
      push_leaner(collapser_.shape(), 0, 0);
    std::reverse(result_.levels.begin(), result_.levels.end());
    return std::move(result_);
  }

 private:
  static constexpr double kStated = 1.01;  ///< the deviations that models state are at most so many times the true ones
  static constexpr double kAim = 0.95;     ///< of the deviation allowed; the estimate is a power law through two levels
  static constexpr int kTries = 3;

  struct Enclosed {
    Step step;
    double deviation = 0;  ///< of the level, where one is wanted
  };
  Enclosed made_to_hold(const Polytope& simple, const Executor& executor) const {
    Step step = collapser_.enclosed(simple);
    const double deviation = step.level && deviation_ ? (*deviation_)(step.level->body.points, executor) : 0;
    return {std::move(step), deviation};
  }

  bool is_aimed() const { return options_.detail.deviation > 0; }

  /// To the watch: the levels as they are likely to be.
  void announce() {
    double work = 0;
    for (std::size_t n = collapser_.shape().triangles.size(), next; next = collapser_.target(n), collapser_.worthwhile(next, n);
         n = next)
      work += collapse_work(double(n), double(next)) + move_work(double(next));
    watch_.begin("levels", kLevelsDone, std::max(work, 1.0));
  }

  void simplify() {
    while (int(simple_.size()) + 1 < options_.max_levels) {
      Collapser::Simpler coarser = collapser_.simpler(simple_.empty() ? collapser_.shape() : simple_.back());
      result_.end = coarser.end;
      if (!coarser.shape) return;
      simple_.push_back(std::move(*coarser.shape));
    }
    result_.end = kMostLevels;
  }

  void push(CoarseLevel level, double deviation) {
    sizes_.push_back({double(level.body.points.size()), deviation});
    result_.levels.push_back(std::move(level));
    while (!wanted_.empty() && deviation < wanted_.front()) wanted_.erase(wanted_.begin());
  }

  /// Whether there is a level between the last one, which deviates too much, and `simple`, whose own deviates by `deviation`,
  /// that deviates no more than wanted with fewer triangles than `simple`, and queries are none the worse for. `finer` shapes
  /// are left.
  bool push_leaner(const Polytope& simple, double deviation, std::size_t finer) {
    if (result_.levels.empty()) return false;
    const double allowed = wanted_.front(), last_deviation = sizes_.back().deviation;
    const double most = double(simple.triangles.size()), fewest = double(result_.levels.back().body.triangles.size());
    const double power = deviation > 0 ? std::log(last_deviation / deviation) / std::log(most / fewest) : 1;
    double triangles = fewest * std::pow(last_deviation / (kAim * allowed), 1 / power);
    for (int k = 0; k < kTries && triangles < kWorthwhile * most; ++k) {
      if (!is_aimed() && !is_better({triangles / 2 + 2, allowed}, {most / 2 + 2, deviation}, finer)) break;
      const Collapser::Simpler shape = collapser_.simpler(simple, std::size_t(triangles));
      if (!shape.shape) break;
      auto [step, deviates] = made_to_hold(*shape.shape, options_.executor);
      const double found = step.level ? deviates : allowed;
      if (found < allowed) {
        drop_if_near(double(step.level->body.triangles.size()));
        return push(std::move(*step.level), found), true;
      }
      triangles *= std::pow(found / (kAim * allowed), 1 / power);
    }
    return false;
  }

  /// Drops the last level, unless the coarsest, where a finer one of so many triangles makes it not worthwhile.
  void drop_if_near(double triangles) {
    if (result_.levels.size() < 2 || double(result_.levels.back().body.triangles.size()) <= kWorthwhile * triangles) return;
    result_.levels.pop_back();
    sizes_.pop_back();
  }

  /// Whether queries are the better for `lean` in the stead of `plain`. Deviations of levels that are not yet made to hold
  /// level 0 are taken to be as their vertices are fewer.
  bool is_better(const LevelSize& lean, const LevelSize& plain, std::size_t finer) const {
    const auto with = [&](const LevelSize& chosen) {
      std::vector<LevelSize> levels{{double(collapser_.shape().points.size()), 0}};
      for (std::size_t k = 0; k < finer; ++k) {
        const auto vertices = double(simple_[k].points.size());
        levels.push_back({vertices, plain.deviation * plain.vertices / vertices / radius_});
      }
      levels.push_back({chosen.vertices, chosen.deviation / radius_});
      for (std::size_t k = sizes_.size(); k-- > 0;) levels.push_back({sizes_[k].vertices, sizes_[k].deviation / radius_});
      return expected_cost({}, levels);
    };
    return with(lean) < with(plain);
  }

  const BuildOptions& options_;
  Watch& watch_;
  Collapser collapser_;
  std::optional<Deviation> deviation_;  ///< where some are wanted
  double radius_ = 0;
  std::vector<double> wanted_;    ///< deviations no level is fine enough for yet, coarsest first
  std::vector<Polytope> simple_;  ///< finest first
  Hierarchy result_;              ///< coarsest first until the end
  std::vector<LevelSize> sizes_;  ///< of the levels in it
};

}  // namespace

Hierarchy hierarchy(const Polytope& level0, const BuildOptions& options, Watch& watch) {
  if (options.max_levels == 1) return {{}, kMostLevels};
  return options.method == Method::Peel ? peeled(level0, options, watch) : Collapse(level0, options, watch).run();
}

}  // namespace swiftlet::lod
