// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes: boxes of bodies, what is kept of pairs, and the questions, cut into tasks for an executor.
#include <swiftlet/scene.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_contacts.h>

#include "broad_phase.h"
#include "numeric/chunks.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPairsPerTask = 64;  // so few that their answers stay in a core's cache

/// Boxes are larger by this share of the body's extent and radius, and reaches by this share of themselves. Of near bodies law
/// 2's bound is at most 64 * 2^-53 + 2e-6 times 2.8 times the sum of their extents, radii and the reach, as neither is farther
/// from its frame's origin than sqrt(3) extents; and a rotation that is rigid to 1e-6 alone stretches distances and balls, of
/// at most 3.5 extents, by 1.5e-6 of them. Both are a fifth of this share together. So a pair that is left out is proved
/// farther apart by the boxes, in the world's frame and in A's, and by more than a query may doubt.
constexpr double kSlack = 0x1p-14;
/// What rounding adds to a box far from the origin, relative to its translation, 8 u; and more than law 2's bound is at least,
/// 2^-450. Of two boxes the gap is smaller by 2^-448: where it is not 0, squares of reaches that could leave it out are normal.
constexpr double kFar = 0x1p-50, kTiny = 0x1p-449;
/// Larger than any body in any pose that queries take.
constexpr double kAnywhere = 1e50;

/// The box of a part of a body, given by centre and half sides in its frame, in the world.
WorldBox box_of(const Vec3& centre, const Vec3& half, double slack, const Pose& in_world) {
  WorldBox box;
  for (int i = 0; i < 3; ++i) {
    const auto row = in_world.rotation.row(i);
    const double t = in_world.translation[i];
    const double middle = row[0] * centre[0] + row[1] * centre[1] + row[2] * centre[2] + t;
    const double reach = std::abs(row[0]) * half[0] + std::abs(row[1]) * half[1] + std::abs(row[2]) * half[2] + slack +
                         kFar * std::abs(t) + kTiny;
    box.min[std::size_t(i)] = middle - reach;
    box.max[std::size_t(i)] = middle + reach;
  }
  return box;
}

/// True if queries refuse the body or its pose.
bool is_refused(const MeshBody& body, const Pose& in_world) {
  const Body& convex = body.convex();
  return std::isnan(body.mesh() ? tolerance(body, body, in_world) : tolerance(convex, convex, in_world));
}

/// A box that holds the body, and all that its queries may take for it.
WorldBox box_of(const MeshBody& body, const Pose& in_world) {
  const Body& convex = body.convex();
  const Model* const model = convex.model();
  const MeshModel* const mesh = body.mesh();
  Vec3 lowest, highest;
  if (mesh) {
    lowest = mesh->box_min(), highest = mesh->box_max();
  } else if (model) {
    lowest = model->box_min(), highest = model->box_max();
  } else {
    constexpr int kCorners[] = {0, 1, 2, 3, 2};
    lowest = highest = convex.corner(0);
    for (int i = 1; i < kCorners[int(convex.kind())]; ++i) {
      lowest = lowest.cwiseMin(convex.corner(i));
      highest = highest.cwiseMax(convex.corner(i));
    }
  }
  const double extent = std::max(lowest.cwiseAbs().maxCoeff(), highest.cwiseAbs().maxCoeff());
  const double slack = body.radius() + kSlack * (extent + body.radius());
  WorldBox box = box_of((lowest + highest) / 2, (highest - lowest) / 2, slack, in_world);
  if (model) {  // of a round body the ball is the smaller one
    const WorldBox ball = box_of(model->centre(), Vec3::Zero(), slack + model->radius(), in_world);
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = std::max(box.min[i], ball.min[i]);
      box.max[i] = std::min(box.max[i], ball.max[i]);
    }
  }
  return box;
}

/// Two boxes with a larger squared gap hold bodies that are farther apart than `reach`. NaN for NaN: no gap is larger.
double squared_reach(double reach) {
  const double more = std::max(reach, 0.0) * (1 + kSlack);
  return std::isnan(reach) ? reach : more * more;
}

/// What is kept of a pair from question to question.
struct KeptPair {
  BodyId a, b;
  std::uint32_t idle = 0;  ///< questions that did not come to it
  MeshSeed seed{};         ///< of two convex bodies its `pair` alone
};

bool before(const BodyId& a, const BodyId& b, const BodyId& c, const BodyId& d) {
  return a.index != c.index ? a.index < c.index : b.index < d.index;
}

/// What is kept of all pairs with one scene.
struct Kept {
  std::vector<KeptPair> pairs, spare;  ///< sorted; and what they were
  std::vector<std::uint32_t> near;     ///< those of `pairs` that the question is about
  std::vector<SceneContact> contacts;  ///< of the last call
  KeptPair nearest;                    ///< likewise
};

}  // namespace

struct Scene::Content {
  struct Place {
    MeshBody body{Body()};
    Pose in_world{};
    std::unique_ptr<const Model> model{};     ///< that `body` borrows
    std::unique_ptr<const MeshModel> mesh{};  ///< likewise
    std::string name{};
    std::uint32_t generation = 0;
    bool taken = false;
    bool refused = false;

    /// Its box in the world; of what is refused, one that holds everything.
    WorldBox box() const {
      if (refused) return {{-kAnywhere, -kAnywhere, -kAnywhere}, {kAnywhere, kAnywhere, kAnywhere}};
      return box_of(body, in_world);
    }
  };
  /// The pose that a query of two places is asked in: where one is refused its own, since the relative one of two poses may be
  /// legal where neither is.
  static Pose b_in_a(const Place& a, const Place& b) {
    return a.refused ? a.in_world : b.refused ? b.in_world : relative(a.in_world, b.in_world);
  }
  /// Puts a place where it is to be.
  void put(BodyId id, const Pose& in_world) {
    Place& place = places[id.index];
    place.in_world = in_world;
    place.refused = is_refused(place.body, in_world);
    tree.put(id.index, place.box());
  }
  static bool are_convex(const Place& a, const Place& b) { return !a.body.mesh() && !b.body.mesh(); }
  std::vector<Place> places;
  std::vector<std::uint32_t> free;
  std::unordered_map<std::string, BodyId> names;
  BoxTree tree;
  std::function<bool(BodyId, BodyId)> asks;
  Run run;
  std::map<std::weak_ptr<const Content>, Kept, std::owner_less<>> kept;

  bool has(BodyId id) const {
    return id.index < places.size() && places[id.index].taken && places[id.index].generation == id.generation;
  }
  BodyId id(std::uint32_t index) const { return {index, places[index].generation}; }

  /// The wanted pairs with `other` that may be within `reach`, as `near` of what is kept.
  Kept& near(const std::shared_ptr<Content>& other, double reach) {
    Kept& k = kept_with(other);
    const bool own = other.get() == this;
    k.spare.clear();
    k.near.clear();
    auto old = k.pairs.begin();
    const auto keep_idle = [&] {  // and go on
      if (++old->idle <= kQuestionsKept && has(old->a) && other->has(old->b)) k.spare.push_back(*old);
      ++old;
    };
    for (const BoxTree::Pair& pair : tree.near(other->tree, squared_reach(reach), run.executor)) {
      const BodyId a = id(pair.a), b = other->id(pair.b);
      if (own && asks && !asks(a, b)) continue;
      while (old != k.pairs.end() && before(old->a, old->b, a, b)) keep_idle();
      k.near.push_back(std::uint32_t(k.spare.size()));
      k.spare.push_back({a, b});
      if (old != k.pairs.end() && old->a.index == a.index && old->b.index == b.index) {
        if (old->a == a && old->b == b) k.spare.back().seed = old->seed;
        ++old;
      }
    }
    while (old != k.pairs.end()) keep_idle();
    k.pairs.swap(k.spare);
    return k;
  }

  Kept& kept_with(const std::shared_ptr<Content>& other) {
    std::erase_if(kept, [](const auto& entry) { return entry.first.expired(); });
    return kept[other];
  }

  /// Asks the pairs of kept.pairs that `near` names, some at a time: ask(queries, answers) as a batch, those of two convex
  /// bodies as PairQuery, those with a mesh as MeshPairQuery; list(pair, query, answer, found) lists what is to be told. What
  /// it lists stands in the order of `near`.
  template <class Found, class AnyAnswer, class Ask, class List>
  std::vector<Found> ask_all(const Content& other, Kept& k, std::span<const std::uint32_t> near, Ask ask, List list) const {
    const std::size_t tasks = (near.size() + kPairsPerTask - 1) / kPairsPerTask;
    std::vector<std::vector<Found>> found(tasks);
    std::vector<char> done(tasks);
    std::atomic<bool> stopped = false;
    const auto some = [&](std::size_t task) {
      return near.subspan(task * kPairsPerTask).first(std::min(kPairsPerTask, near.size() - task * kPairsPerTask));
    };
    const auto run_one = [&](std::size_t task) {
      if (run.stop && (stopped || run.stop())) {
        stopped = true;
        return;
      }
      std::vector<PairQuery> queries;
      std::vector<MeshPairQuery> mesh_queries;
      queries.reserve(kPairsPerTask);
      for (const std::uint32_t i : some(task)) {
        KeptPair& pair = k.pairs[i];
        const Place &a = places[pair.a.index], &b = other.places[pair.b.index];
        if (are_convex(a, b))
          queries.push_back({a.body.convex(), b.body.convex(), b_in_a(a, b), &pair.seed.pair});
        else
          mesh_queries.push_back({a.body, b.body, b_in_a(a, b), &pair.seed});
      }
      std::vector<AnyAnswer> answers(queries.size()), mesh_answers(mesh_queries.size());
      ask(std::span<const PairQuery>(queries), std::span(answers));
      ask(std::span<const MeshPairQuery>(mesh_queries), std::span(mesh_answers));
      std::size_t convex = 0, mesh = 0;
      for (const std::uint32_t i : some(task)) {
        const KeptPair& pair = k.pairs[i];
        if (are_convex(places[pair.a.index], other.places[pair.b.index])) {
          list(pair, queries[convex], answers[convex], found[task]);
          ++convex;
        } else {
          list(pair, mesh_queries[mesh], mesh_answers[mesh], found[task]);
          ++mesh;
        }
      }
      done[task] = true;
    };
    run_tasks(run.executor, tasks, run_one);
    std::vector<Found> all;
    for (std::size_t task = 0; task < tasks; ++task) {
      if (done[task]) {
        all.insert(all.end(), std::make_move_iterator(found[task].begin()), std::make_move_iterator(found[task].end()));
        continue;
      }
      for (const std::uint32_t i : some(task)) {
        Found pair;
        pair.a = k.pairs[i].a, pair.b = k.pairs[i].b;
        all.push_back(pair);
      }
    }
    return all;
  }
};

Scene::Scene() : content_(std::make_shared<Content>()) {}
Scene::Scene(const Body& body, const Pose& in_world) : Scene(MeshBody(body), in_world) {}
Scene::Scene(const MeshBody& body, const Pose& in_world) : Scene() { (void)add({}, body, in_world); }
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

BodyId Scene::add(std::string_view name, const Body& body, const Pose& in_world) { return add(name, MeshBody(body), in_world); }
BodyId Scene::add(std::string_view name, const MeshBody& body, const Pose& in_world) {
  Content& c = *content_;
  if (!name.empty() && c.names.count(std::string(name))) return {};
  if (c.free.empty()) {
    c.free.push_back(std::uint32_t(c.places.size()));
    c.places.emplace_back();
  }
  const BodyId id = c.id(c.free.back());
  c.free.pop_back();
  Content::Place& place = c.places[id.index];
  place.body = body;
  if (body.mesh()) {
    place.mesh = std::make_unique<const MeshModel>(*body.mesh());
    place.body = body.is_solid() ? MeshBody::solid(*place.mesh, body.radius()) : MeshBody(*place.mesh, body.radius());
  } else if (body.convex().model()) {
    place.model = std::make_unique<const Model>(*body.convex().model());
    place.body = Body(*place.model, body.radius());
  }
  place.name = name;
  place.taken = true;
  if (!name.empty()) c.names.emplace(name, id);
  c.put(id, in_world);
  return id;
}

bool Scene::move(BodyId id, const Pose& in_world) {
  if (!has(id)) return false;
  content_->put(id, in_world);
  return true;
}

bool Scene::remove(BodyId id) {
  if (!has(id)) return false;
  Content& c = *content_;
  Content::Place& place = c.places[id.index];
  c.names.erase(place.name);
  c.tree.remove(id.index);
  place = {.generation = id.generation + 1};
  c.free.push_back(id.index);
  return true;
}

void Scene::ask_only(std::function<bool(BodyId, BodyId)> asks) { content_->asks = std::move(asks); }
void Scene::run_by(Run run) { content_->run = std::move(run); }

BodyId Scene::find(std::string_view name) const {
  const auto found = content_->names.find(std::string(name));
  return found == content_->names.end() ? BodyId{} : found->second;
}
bool Scene::has(BodyId id) const { return content_->has(id); }
std::size_t Scene::size() const { return content_->places.size() - content_->free.size(); }
std::vector<BodyId> Scene::bodies() const {
  std::vector<BodyId> all;
  for (std::uint32_t i = 0; i < content_->places.size(); ++i) {
    if (content_->places[i].taken) all.push_back(content_->id(i));
  }
  return all;
}
std::string_view Scene::name(BodyId id) const { return has(id) ? content_->places[id.index].name : std::string_view{}; }
Body Scene::body(BodyId id) const { return mesh_body(id).convex(); }
MeshBody Scene::mesh_body(BodyId id) const { return has(id) ? content_->places[id.index].body : MeshBody(Body()); }
Pose Scene::pose(BodyId id) const {
  return has(id) ? content_->places[id.index].in_world : Pose{Mat3::Constant(kNaN), Vec3::Constant(kNaN)};
}

std::vector<ScenePair> Scene::overlapping(const Scene& other, const Effort& effort) {
  Kept& k = content_->near(other.content_, 0);
  return content_->ask_all<ScenePair, Answer>(
      *other.content_, k, k.near, [&](auto pairs, auto answers) { intersects(pairs, answers, effort); },
      [](const KeptPair& pair, const auto&, const Answer& answer, std::vector<ScenePair>& found) {
        if (answer.verdict != Verdict::Disjoint) found.push_back({pair.a, pair.b, answer});
      });
}

std::vector<ScenePair> Scene::within(const Scene& other, double threshold, const Effort& effort) {
  Kept& k = content_->near(other.content_, threshold);
  return content_->ask_all<ScenePair, Within>(
      *other.content_, k, k.near, [&](auto pairs, auto answers) { swiftlet::within(pairs, threshold, answers, effort); },
      [](const KeptPair& pair, const auto&, const Within& within, std::vector<ScenePair>& found) {
        if (within.decision != Decision::No) found.push_back({pair.a, pair.b, within.answer});
      });
}

namespace {

/// A question about distances, and which of them to list.
auto ask_distance(const Options& options) {
  return [&options](auto pairs, auto answers) { distance(pairs, answers, options); };
}
auto list_up_to(double beyond) {
  return [beyond](const KeptPair& pair, const auto&, const Answer& answer, std::vector<ScenePair>& found) {
    if (!(answer.lower > beyond)) found.push_back({pair.a, pair.b, answer});
  };
}

}  // namespace

std::vector<ScenePair> Scene::distances(const Scene& other, const Options& options) {
  Kept& k = content_->near(other.content_, options.beyond);
  return content_->ask_all<ScenePair, Answer>(*other.content_, k, k.near, ask_distance(options), list_up_to(options.beyond));
}

NearestPair Scene::nearest(const Scene& other, const Options& options) {
  const Content &c = *content_, &o = *other.content_;
  const auto wanted = [&](BodyId a, BodyId b) { return &c != &o || !c.asks || c.asks(a, b); };
  Options so_far = options;
  if (std::isnan(so_far.beyond)) so_far.beyond = kInfinity;
  NearestPair nearest;
  nearest.lower = so_far.beyond;
  // The nearest pair of the last call, or one of near boxes, bounds the search.
  KeptPair first = content_->kept_with(other.content_).nearest;
  if (!c.has(first.a) || !o.has(first.b) || !wanted(first.a, first.b)) {
    const auto pair = c.tree.nearest(o.tree, [&](BoxTree::Pair p) { return wanted(c.id(p.a), o.id(p.b)); });
    if (!pair) return nearest;
    first = {c.id(pair->a), o.id(pair->b)};
  }
  const Content::Place &a = c.places[first.a.index], &b = o.places[first.b.index];
  const Pose b_in_a = Content::b_in_a(a, b);
  Answer answer;
  if (Content::are_convex(a, b)) {
    const PairQuery query{a.body.convex(), b.body.convex(), b_in_a, &first.seed.pair};
    distance(std::span(&query, 1), std::span(&answer, 1), options);
  } else {
    answer = distance(a.body, b.body, b_in_a, first.seed, options);
  }
  // A pair that is beyond has no upper bound either.
  const auto is_unknown = [](const Answer& x) { return x.status != Status::Beyond && !(x.upper < kInfinity); };
  content_->kept_with(other.content_).nearest = first;
  if (!(answer.lower > so_far.beyond) && (is_unknown(answer) || answer.upper <= 0)) return {{first.a, first.b, answer}, 0};

  so_far.beyond = std::min(so_far.beyond, answer.upper);
  Kept& k = content_->near(other.content_, so_far.beyond);
  double lower = kInfinity;
  // Each round asks twice as many pairs, up to the least distance of the rounds before.
  for (std::size_t begin = 0, count = kPairsPerTask; begin < k.near.size() && so_far.beyond >= 0 && nearest.answer.upper > 0;
       begin += count, count *= 2) {
    std::vector<std::uint32_t> round;
    for (const std::uint32_t i : std::span(k.near).subspan(begin, std::min(count, k.near.size() - begin))) {
      const double gap = squared_gap(c.tree.box(k.pairs[i].a.index), o.tree.box(k.pairs[i].b.index));
      if (!(gap > squared_reach(so_far.beyond))) round.push_back(i);
    }
    for (const ScenePair& pair :
         content_->ask_all<ScenePair, Answer>(o, k, round, ask_distance(so_far), list_up_to(so_far.beyond))) {
      if (is_unknown(pair.answer)) return {pair, 0};
      lower = std::min(lower, pair.answer.lower);
      if (pair.answer.upper < nearest.answer.upper) static_cast<ScenePair&>(nearest) = pair;
    }
    so_far.beyond = std::min(so_far.beyond, nearest.answer.upper);
  }
  if (!c.has(nearest.a)) return nearest;
  nearest.lower = lower;
  if (nearest.a != first.a || nearest.b != first.b) k.nearest = {nearest.a, nearest.b};
  return nearest;
}

namespace {

/// A question about contacts: how deep; of meshes whether there are any, unless only deep ones are asked for.
struct AskContact {
  double margin;
  void operator()(std::span<const PairQuery> pairs, std::span<Answer> answers) const {
    signed_distance(pairs, answers, {.beyond = margin});
  }
  void operator()(std::span<const MeshPairQuery> pairs, std::span<Answer> answers) const {
    if (margin < 0)
      signed_distance(pairs, answers, {.beyond = margin});
    else
      distance(pairs, answers, {.beyond = margin});
  }
};

/// The contacts of the last call.
struct LastContacts {
  std::span<const SceneContact> of_pair;
  const Manifold& none;

  const Manifold& first() const { return of_pair.empty() ? none : of_pair.front().manifold; }
  /// The manifold that was nearest to a point.
  const Manifold& at(const Vec3& point) const {
    const Manifold* nearest = &none;
    double least = kInfinity;
    for (const SceneContact& contact : of_pair) {
      const double square = (contact.answer.point_a - point).squaredNorm();
      if (square < least) least = square, nearest = &contact.manifold;
    }
    return *nearest;
  }
};

void list_contacts(const KeptPair& pair, const PairQuery& q, const Answer& answer, const ManifoldOptions& options,
                   LastContacts last, std::vector<SceneContact>& found) {
  found.push_back({{pair.a, pair.b, answer}, manifold(q.a, q.b, q.b_in_a, answer, options, last.first())});
}

/// One for each region; of a body inside a solid, whose surfaces do not meet, how deep it is, however near they are. Below a
/// margin of 0 there are no regions, and the answer is the depth.
void list_contacts(const KeptPair& pair, const MeshPairQuery& q, const Answer& answer, const ManifoldOptions& options,
                   LastContacts last, std::vector<SceneContact>& found) {
  std::vector<MeshContact> regions;
  MeshContacts told;
  do {
    regions.resize(kSpareRegions + std::max<std::size_t>(2 * regions.size(), told.count));
    told = contacts(q.a, q.b, q.b_in_a, options.margin, regions);
  } while (told.status == Status::Budget);  // there are more
  const std::span stored = std::span(regions).first(told.stored);
  const auto meet = [](const MeshContact& region) {
    return region.verdict == Verdict::Overlapping || region.verdict == Verdict::Touching;
  };
  const bool is_inside =
      !(options.margin < 0) && answer.verdict == Verdict::Overlapping && std::none_of(stored.begin(), stored.end(), meet);
  if (is_inside || stored.empty()) {
    found.push_back({{pair.a, pair.b, is_inside ? signed_distance(q.a, q.b, q.b_in_a, *q.seed) : answer}, {}});
    return;
  }
  for (const MeshContact& region : stored) {
    Answer one = answer;
    one.status = told.status, one.verdict = region.verdict, one.lower = region.lower, one.upper = region.upper;
    one.normal = region.normal, one.point_a = region.point_a, one.point_b = region.point_b;
    one.feature_a = region.feature_a, one.feature_b = region.feature_b;
    found.push_back({{pair.a, pair.b, one}, manifold(q.a, q.b, q.b_in_a, region, options, last.at(region.point_a))});
  }
}

}  // namespace

std::vector<SceneContact> Scene::contacts(const Scene& other, const ManifoldOptions& options) {
  Kept& k = content_->near(other.content_, options.margin);
  const Manifold none;
  const auto list = [&](const KeptPair& pair, const auto& query, const Answer& answer, std::vector<SceneContact>& found) {
    if (answer.lower > options.margin) return;
    const auto is_before = [](const auto& x, const auto& y) { return before(x.a, x.b, y.a, y.b); };
    const auto first = std::lower_bound(k.contacts.begin(), k.contacts.end(), pair, is_before);
    const auto end = std::upper_bound(first, k.contacts.end(), pair, is_before);
    const bool is_same = first != end && first->a == pair.a && first->b == pair.b;  // and no body that had its place before
    list_contacts(pair, query, answer, options, {is_same ? std::span(first, end) : std::span<SceneContact>(), none}, found);
  };
  k.contacts = content_->ask_all<SceneContact, Answer>(*other.content_, k, k.near, AskContact{options.margin}, list);
  return k.contacts;
}

}  // namespace swiftlet
