// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_front.h>
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

/// With the hull of every node.
MeshModel hulled(const MeshModel& mesh) {
  HullOptions options;
  options.levels = 16, options.least_triangles = 1, options.bytes_per_triangle = 1e6;
  return rebuild_hulls(mesh, options).value();
}

/// Along the normal of an overlap the bodies come apart by -lower; and moved by less than -upper surfaces still meet.
std::string depth_fault(const Answer& answer, const Soup& a, const Soup& b, const Pose& pose, double bound) {
  if (!(answer.lower <= answer.upper)) return "no interval of a depth";
  if (answer.lower > 0 || answer.normal.hasNaN() || !std::isfinite(answer.lower)) return {};
  const auto of_a = soups::triangles<long double>(a), of_b = soups::triangles<long double>(b, pose);
  const auto n = point<long double>(answer.normal);
  long double most = -HUGE_VALL, least = HUGE_VALL;
  for (const auto& t : of_a)
    for (const auto& p : t) most = std::max(most, dot(p, n));
  for (const auto& t : of_b)
    for (const auto& p : t) least = std::min(least, dot(p, n));
  if (least - most < answer.lower - bound) return "moved by -lower the bodies are not apart";
  for (const Vec3& way : {answer.normal, Vec3(-answer.normal), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    Pose moved = pose;
    moved.translation -= 0.99 * answer.upper * way;
    if (answer.upper < -bound && brute_force(a, b, moved) > bound) return "less than -upper takes the surfaces apart";
  }
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

/// A mesh that was cut: no answer is farther from the truth than boxes are from the surface.
std::string cut_fault(const MeshModel& mesh, const MeshModel& other, const Pose& pose, const Answer& exact) {
  const MeshModel cut = mesh.cut({.deviation = std::numeric_limits<double>::max()});
  const Answer answer = distance(cut, other, pose);
  return answer.lower <= exact.upper && exact.lower <= answer.upper ? "" : "the interval of a mesh that was cut is not true";
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
  const MeshModel x = which & 32 ? hulled(a.value()) : a.value(), y = which & 64 ? hulled(b.value()) : b.value();
  MeshSeed other = seed;
  const Answer loose = distance(x, y, pose, seed, options), exact = distance(x, y, pose, other),
               met = intersects(x, y, pose, other);
  const Within w = within(x, y, pose, threshold, seed);
  const ClosestFeatures closest = closest_features(x, y, pose, seed);
  Pose before = pose;
  for (double& t : before.translation) t += bytes.take<std::int8_t>() / 64.0;
  MeshFront front(std::size_t(1) << bytes.take<std::uint8_t>() % 12);
  MeshSeed kept = other;
  (void)intersects(x, y, before, kept, front), (void)distance(x, y, before, kept, front, options);
  const Answer beside = distance(x, y, pose, kept, front), met_beside = intersects(x, y, pose, kept, front);
  const double bound = tolerance(x, y, pose);
  if (!is_legal(pose)) return loose.status == Status::InvalidPose && std::isnan(bound) ? "" : "a pose that is not refused";
  const auto fault_beside = [&](double truth) -> std::string {
    const double slack = bound / 16;
    for (const Answer* answer : {&loose, &exact, &met, &w.answer, &closest.answer, &beside, &met_beside})
      if (const std::string f = fault(*answer, truth, slack, bound); !f.empty()) return f;
    if (w.decision == Decision::Yes && truth > threshold + slack) return "Yes wrongly";
    if (w.decision == Decision::No && truth < threshold - slack) return "No wrongly";
    return {};
  };
  if (!fault_beside(brute_force(soup_a, soup_b, pose)).empty()) {
    if (const std::string f = fault_beside(exact_distance(soup_a, soup_b, pose)); !f.empty()) return f;
  }
  for (const Answer* answer : {&exact, &closest.answer, &beside}) {
    if (answer->status != Status::Converged || !(answer->upper - answer->lower <= bound)) return "wider than law 2's bound";
    if (const Check checked = check(x, y, pose, *answer); !checked) return checked.message;
  }
  if (met.verdict == Verdict::Undecided || met_beside.verdict == Verdict::Undecided) return "intersects is undecided";
  const Answer deep = signed_distance(x, y, pose, seed);
  if (const std::string f = depth_fault(deep, soup_a, soup_b, pose, bound); !f.empty()) return f;
  if (exact.lower > 2 * bound && !(deep.lower <= exact.upper && exact.lower <= deep.upper))
    return "the signed distance of bodies that are apart is not the distance";
  if (const std::string f = fault_of_contacts(soup_a, soup_b, x, y, pose, threshold, exact, bound); !f.empty()) return f;
  if (const std::string f = cut_fault(x, y, pose, exact); !f.empty()) return f;
  if (x.topology().closed() && y.topology().closed()) {
    const MeshBody full_x = MeshBody::solid(x), full_y = MeshBody::solid(y);
    const Answer inside = distance(full_x, full_y, pose);
    if (const Check checked = check(full_x, full_y, pose, inside); !checked) return "solid: " + checked.message;
    if (const Answer d = signed_distance(full_x, full_y, pose); !(d.lower <= d.upper)) return "no interval of a solid's depth";
  }
  const Result<MeshModel> moved = refit(x, soup_b.points);
  if (!moved) return moved.error().message.empty() ? "not moved without a reason" : "";
  if (const Check verified = verify(moved.value()); !verified) return "refit: " + verified.message;
  const Answer again = distance(moved.value(), y, pose);
  if (const Check checked = check(moved.value(), y, pose, again); !checked) return "refit: " + checked.message;
  return {};
}

namespace {

/// A file of these bytes, salvaged.
Result<SalvagedMesh> salvaged(const soups::Block& bytes) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("swiftlet_fuzz_" + std::to_string(getpid()) + ".swm");
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  Result<SalvagedMesh> result = salvage_mesh(path);
  std::filesystem::remove(path);
  return result;
}

}  // namespace

std::string block(Input input) {
  soups::Block bytes(input.size());
  if (!input.empty()) std::memcpy(bytes.data(), input.data(), input.size());
  (void)load_mesh(bytes);  // as it is
  if (bytes.size() >= sizeof(MeshHeader)) {
    const std::uint64_t size = bytes.size();
    std::memcpy(bytes.data() + offsetof(MeshHeader, total_bytes), &size, sizeof size);
    rehash(bytes);
  }
  if (const Result<SalvagedMesh> part = salvaged(bytes)) {
    const MeshModel good = tetrahedron().mesh();
    const Answer answer = distance(part.value().mesh, good, shift(2, 0, 0));
    if (!(answer.lower <= answer.upper)) return "no interval of a salvaged mesh";
    (void)verify(part.value().mesh);
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
      for (const Answer& answer : {distance(*a, *b, pose, seed), intersects(*a, *b, pose, seed), closest.answer}) {
        if (!(answer.lower >= 0 && answer.lower <= answer.upper)) return "no interval";
        const auto size = [](const MeshModel* m) { return std::uint64_t{m->triangle_count()} + 8 * m->node_count(); };
        const std::uint64_t pairs = size(a) * size(b);  // a mesh that was cut has boxes alone
        if (answer.steps + std::uint64_t{answer.plane_tests} > 20 * pairs + 100) return "more steps than pairs of triangles";
      }
      const Answer deep = signed_distance(*a, *b, pose, seed), solid = distance(MeshBody::solid(*a), MeshBody::solid(*b), pose);
      if (deep.lower > deep.upper || solid.lower > solid.upper) return "no interval of a depth or a solid";
      std::array<MeshContact, 4> regions;
      const MeshContacts met = contacts(*a, *b, pose, 0.25, regions);
      for (std::uint32_t i = 0; i < met.stored; ++i) (void)manifold(*a, *b, pose, regions[i], {.margin = 0.25});
      for (const std::span<const std::uint32_t> ids : {closest.source_a.triangles, closest.source_b.triangles})
        if (std::find(ids.begin(), ids.end(), kNone) != ids.end()) break;  // read every one
    }
  }
  const MeshModel cut = hostile.cut({.deviation = std::numeric_limits<double>::max()});
  (void)distance(cut, honest, {});
  (void)verify(cut);
  if (const Result<MeshModel> moved = refit(hostile, std::vector<Vec3>(64, Vec3(1, 2, 3))))
    (void)distance(moved.value(), honest, {});
  return {};
}

}  // namespace swiftlet::fuzz
