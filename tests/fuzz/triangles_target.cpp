// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include <CGAL/Exact_rational.h>

#include "fuzz.h"
#include "judge.h"
#include "mesh_blocks.h"
#include "mesh_regions.h"
#include "soups.h"

namespace swiftlet::fuzz {
namespace {

using namespace soups;

constexpr std::size_t kMostTriangles = 12;

/// Few triangles over few points: on a lattice, or of any doubles.
Soup take_soup(Bytes& bytes) {
  Soup soup;
  const auto kind = bytes.take<std::uint8_t>();
  const std::size_t points = 1 + bytes.take<std::uint8_t>() % (3 * kMostTriangles),
                    count = 1 + bytes.take<std::uint8_t>() % kMostTriangles;
  for (std::size_t i = 0; i < points; ++i) {
    Vec3 p;
    for (double& x : p)
      x = kind % 3 == 0 ? bytes.take<std::int8_t>() / 4.0 : kind % 3 == 1 ? bytes.take<float>() : bytes.take<double>();
    soup.points.push_back(p);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Corners c;
    for (std::uint32_t& v : c) v = std::uint32_t(bytes.take<std::uint8_t>() % points);
    soup.triangles.push_back(c);
  }
  return soup;
}
MeshSeed take_mesh_seed(Bytes& bytes) {
  MeshSeed seed;
  seed.triangle_a = bytes.take<std::uint8_t>(), seed.triangle_b = bytes.take<std::uint8_t>();
  for (float& x : seed.direction) x = bytes.take<float>();
  seed.pair = take_seed(bytes);
  return seed;
}

/// By rationals, which take long: where long doubles find fault.
double exact_distance(const Soup& a, const Soup& b, const Pose& pose) {
  using Number = CGAL::Exact_rational;
  const auto of_a = soups::triangles<Number>(a), of_b = soups::triangles<Number>(b, pose);
  Number least(-1);
  for (const auto& s : of_a) {
    for (const auto& t : of_b) {
      const Number squared = nearest(s, t).squared;
      if (least < 0 || squared < least) least = squared;
    }
  }
  return std::sqrt(CGAL::to_double(least));
}

/// What is wrong with an answer to any question, where `truth` is known to `slack`.
std::string fault(const Answer& answer, double truth, double slack, double law_two) {
  if (!(answer.lower >= 0 && answer.lower <= answer.upper)) return "no interval";
  if (!(answer.lower <= truth + slack)) return "lower is above the truth";
  if (!(answer.upper >= truth - slack)) return "upper is below the truth";
  if ((answer.verdict == Verdict::Disjoint) != (answer.lower > 0)) return "Disjoint is said where lower is above 0";
  if (answer.verdict == Verdict::Overlapping && truth > slack) return "Overlapping, but they are apart";
  if (answer.verdict == Verdict::Touching && truth > law_two) return "Touching, but they are apart";
  return {};
}

/// What is wrong with the regions within a reach, and with their points.
std::string fault_of_contacts(const Soup& soup_a, const Soup& soup_b, const MeshModel& a, const MeshModel& b, const Pose& pose,
                              double reach, const Answer& exact, double law_two) {
  std::vector<MeshContact> found(kMostTriangles * kMostTriangles);
  const MeshContacts about = contacts(a, b, pose, reach, found);
  if (!(reach >= 0)) return about.count == 0 ? "" : "a region within no reach";
  if (about.status != Status::Converged || !about.is_counted || about.count != about.stored) return "not all regions";
  found.resize(about.stored);
  if (found.empty()) return exact.upper <= reach ? "no region, but they are within reach" : "";
  if (!(exact.lower <= reach)) return "a region, but they are beyond the reach";
  if (!(found[0].upper >= exact.lower && found[0].lower <= exact.upper)) return "the nearest region is at another distance";
  int told = 0;
  const auto alone = [](const Soup& soup, std::size_t t) {  // points that no triangle has may be anything
    Soup one;
    one.add(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2));
    return one;
  };
  const BrutePairs pairs(soup_a, soup_b, pose, law_two / 16, reach + law_two, [&](std::size_t i, std::size_t k) {
    return Real(exact_distance(alone(soup_a, i), alone(soup_b, k), pose));
  });
  if (const std::string f = soups::fault_of(found, pairs, reach, law_two, a, b, told); !f.empty()) return f;
  for (const MeshContact& region : found) {
    const Manifold m = manifold(a, b, pose, region, {.margin = reach, .most_points = 8});
    for (std::uint32_t i = 0; i < m.count; ++i) {
      const ManifoldPoint& p = m.points[i];
      if (!p.point_a.allFinite() || !p.point_b.allFinite() || !(p.separation >= m.points[0].separation)) return "no such point";
    }
  }
  return {};
}

}  // namespace

std::string triangles(Input input) {
  Bytes bytes(input);
  const Pose pose = take_pose(bytes);
  MeshSeed seed = take_mesh_seed(bytes);
  const double threshold = std::fabs(bytes.take<float>());
  Options options;
  const auto which = bytes.take<std::uint8_t>();
  if (which & 1) options.absolute = bytes.take<double>();
  if (which & 2) options.relative = bytes.take<double>();
  if (which & 4) options.beyond = bytes.take<double>();
  if (which & 8) options.budget.steps = bytes.take<std::uint8_t>();
  const Soup soup_a = take_soup(bytes), soup_b = which & 16 ? soup_a : take_soup(bytes);
  const Result<MeshModel> a = MeshModel::from_triangles(soup_a.points, soup_a.triangles),
                          b = MeshModel::from_triangles(soup_b.points, soup_b.triangles);
  for (const Result<MeshModel>* made : {&a, &b}) {
    if (!*made) return made->error().message.empty() ? "refused without a reason" : "";
    if (const Check verified = verify(made->value()); !verified) return verified.message;
  }
  const MeshModel &x = a.value(), &y = b.value();
  MeshSeed other = seed;
  const Answer loose = distance(x, y, pose, seed, options), exact = distance(x, y, pose, other),
               met = intersects(x, y, pose, other);
  const Within w = within(x, y, pose, threshold, seed);
  const ClosestFeatures closest = closest_features(x, y, pose, seed);
  const double bound = tolerance(x, y, pose);
  if (!is_legal(pose)) return loose.status == Status::InvalidPose && std::isnan(bound) ? "" : "a pose that is not refused";
  const auto fault_beside = [&](double truth) -> std::string {
    const double slack = bound / 16;
    for (const Answer* answer : {&loose, &exact, &met, &w.answer, &closest.answer})
      if (const std::string f = fault(*answer, truth, slack, bound); !f.empty()) return f;
    if (w.decision == Decision::Yes && truth > threshold + slack) return "Yes wrongly";
    if (w.decision == Decision::No && truth < threshold - slack) return "No wrongly";
    return {};
  };
  if (!fault_beside(brute_force(soup_a, soup_b, pose)).empty()) {
    if (const std::string f = fault_beside(exact_distance(soup_a, soup_b, pose)); !f.empty()) return f;
  }
  for (const Answer* answer : {&exact, &closest.answer}) {
    if (answer->status != Status::Converged || !(answer->upper - answer->lower <= bound)) return "wider than law 2's bound";
    if (const Check checked = check(x, y, pose, *answer); !checked) return checked.message;
  }
  if (met.verdict == Verdict::Undecided) return "intersects is undecided";
  return fault_of_contacts(soup_a, soup_b, x, y, pose, threshold, exact, bound);
}

std::string block(Input input) {
  soups::Block bytes(input.size());
  if (!input.empty()) std::memcpy(bytes.data(), input.data(), input.size());
  (void)load_mesh(bytes);  // as it is
  if (bytes.size() >= sizeof(MeshHeader)) {
    const std::uint64_t size = bytes.size();
    std::memcpy(bytes.data() + offsetof(MeshHeader, total_bytes), &size, sizeof size);
    rehash(bytes);
  }
  const Result<MeshModel> loaded = load_mesh(bytes);
  if (!loaded) return loaded.error().message.empty() ? "refused without a reason" : "";
  const MeshModel &hostile = loaded.value(), honest = box({-1, -1, -1}, {1, 1, 1}).mesh();
  (void)verify(hostile);
  const Pose poses[] = {{}, {Mat3::Identity(), Vec3(2, 0, 0)}, {Mat3::Identity(), Vec3(0.5, 0.25, 1e-9)}};
  for (const auto& [a, b] : {std::pair{&hostile, &honest}, {&honest, &hostile}, {&hostile, &hostile}}) {
    for (const Pose& pose : poses) {
      MeshSeed seed;
      const ClosestFeatures closest = closest_features(*a, *b, pose, seed);
      MeshContact contact;
      if (contacts(*a, *b, pose, 0.5, {&contact, 1}).stored == 1) (void)manifold(*a, *b, pose, contact);
      for (const Answer& answer : {distance(*a, *b, pose, seed), intersects(*a, *b, pose, seed), closest.answer}) {
        if (!(answer.lower >= 0 && answer.lower <= answer.upper)) return "no interval";
        const std::uint64_t pairs = std::uint64_t{a->triangle_count()} * b->triangle_count();
        if (answer.steps + std::uint64_t{answer.plane_tests} > 20 * pairs + 100) return "more steps than pairs of triangles";
      }
      for (const std::span<const std::uint32_t> ids : {closest.source_a.triangles, closest.source_b.triangles})
        if (std::find(ids.begin(), ids.end(), kNone) != ids.end()) break;  // read every one
    }
  }
  return {};
}

}  // namespace swiftlet::fuzz
