// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "answers.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <swiftlet/model_file.h>

#include "bodies.h"

namespace swiftlet::answers {

std::vector<Model> models(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Model> all;
  for (const auto& path : paths) all.push_back(bodies::must(load(path)));
  all.push_back(bodies::nested(3));
  return all;
}

double Poses::uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }

Pose Poses::next() {
  Pose pose;
  const std::uint64_t kind = bits() % 8;
  if (kind == 0) {
    for (double& x : pose.translation) x = double(int(bits() % 17) - 8) / 4;
    return pose;
  }
  double w = 0, x = 0, y = 0, z = 0;
  while (w * w + x * x + y * y + z * z < 1e-4) w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
  if (kind >= 5) {  // a little further, as seen from a world that moves as well
    const Pose step{bodies::rotation(1, 0.01 * x, 0.01 * y, 0.01 * z), Vec3(0.01 * w, 0.01 * x, 0.01 * y)};
    return turning_ = relative(step, turning_);
  }
  const double length = std::sqrt(x * x + y * y + z * z), reach = kind == 1   ? uniform(0, 0.1)
                                                                  : kind == 2 ? uniform(0, 2)
                                                                              : uniform(1.9, 4);
  pose.translation = length > 0 ? Vec3(x * reach / length, y * reach / length, z * reach / length) : Vec3(reach, 0, 0);
  pose.rotation = bodies::rotation(y, z, w, x);
  return turning_ = pose;
}

PairSeed Poses::seed() {
  std::array<std::uint64_t, 4> words{bits(), bits(), bits(), bits()};
  PairSeed seed;
  std::memcpy(static_cast<void*>(&seed), words.data(), sizeof seed);
  return seed;
}

void append(const Answer& answer, std::vector<std::uint64_t>& fields) {
  const auto number = [&fields](double x) { fields.push_back(std::bit_cast<std::uint64_t>(x)); };
  const auto handle = [&fields](Handle h) { fields.push_back(std::uint64_t(h.kind()) << 32 | h.index()); };
  fields.push_back(std::uint64_t(answer.status) << 32 | std::uint64_t(answer.verdict));
  number(answer.lower), number(answer.upper);
  for (const Vec3& v : {answer.normal, answer.point_a, answer.point_b}) number(v.x()), number(v.y()), number(v.z());
  fields.push_back(std::uint64_t(answer.level_a) << 32 | std::uint64_t(answer.level_b));
  handle(answer.feature_a), handle(answer.feature_b);
  fields.push_back(answer.proof.count);
  for (std::size_t k = 0; k < answer.proof.count; ++k)
    fields.push_back(std::uint64_t{answer.proof.vertex_a[k]} << 32 | answer.proof.vertex_b[k]);
  fields.push_back(std::uint64_t{answer.steps} << 32 | answer.plane_tests);
  fields.push_back(std::uint64_t(answer.levels_visited));
}

void Fingerprint::add(std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3u;
  hash ^= hash >> 32;
}

void Fingerprint::add(const Answer& answer) {
  std::vector<std::uint64_t> fields;
  append(answer, fields);
  for (const std::uint64_t field : fields) add(field);
  ++answers;
}

namespace {

/// Words of one answer.
struct Fields {
  Fingerprint& print;
  void number(double x) { print.add(std::bit_cast<std::uint64_t>(x)); }
  void numbers(const Vec3& v) { number(v.x()), number(v.y()), number(v.z()); }
  void handle(Handle h) { print.add(std::uint64_t(h.kind()) << 32 | h.index()); }
  void pair(std::uint64_t high, std::uint64_t low) { print.add(high << 32 | low); }
};

}  // namespace

void Fingerprint::add(const SignedAnswer& s) {
  Fields fields{*this};
  fields.pair(std::uint64_t(s.status), std::uint64_t(s.verdict));
  fields.number(s.lower), fields.number(s.upper);
  for (const Vec3& v : {s.normal, s.point_a, s.point_b}) fields.numbers(v);
  fields.pair(std::uint64_t(s.level_a), std::uint64_t(s.level_b));
  fields.handle(s.feature_a), fields.handle(s.feature_b);
  add(s.proof.count);
  for (std::size_t k = 0; k < s.proof.count; ++k) fields.pair(s.proof.vertex_a[k], s.proof.vertex_b[k]);
  fields.pair(s.steps, s.plane_tests);
  ++answers;
}

void Fingerprint::add(const Patch& patch) {
  Fields fields{*this};
  fields.numbers(patch.normal);
  fields.handle(patch.face_a), fields.handle(patch.face_b);
  add(patch.count);
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    const PatchPoint& p = patch.points[i];
    fields.numbers(p.point_a), fields.numbers(p.point_b), fields.number(p.separation);
    fields.handle(p.feature_a), fields.handle(p.feature_b);
  }
  ++answers;
}

namespace {

constexpr StartPolicy kPolicies[] = {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest,
                                     StartPolicy::Table};
constexpr Refinement kRefinements[] = {Refinement::Single, Refinement::SingleSingle, Refinement::DoubleDouble};
constexpr PlaneRule kRules[] = {PlaneRule::MostViolated, PlaneRule::FirstViolated};

struct Chain {
  QueryOptions options;
  PairSeed seed;
};

void ask_pair(const Model& a, const Model& b, Poses& poses, int rounds, Fingerprint& print) {
  std::vector<Chain> chains;
  for (const StartPolicy start : kPolicies) {
    for (const Refinement refinement : kRefinements) {
      for (const PlaneRule rule : kRules) {
        QueryOptions options;
        options.start = start;
        options.refinement = refinement;
        options.plane_rule = rule;
        chains.push_back({options, {}});
      }
    }
  }
  Chain loose, tested, near, met;
  loose.options.relative_error = 0.01;
  for (int i = 0; i < rounds; ++i) {
    const Pose pose = poses.next();
    for (Chain& chain : chains) print.add(distance(a, b, pose, chain.seed, chain.options));
    PairSeed cold, random = poses.seed();
    print.add(distance(a, b, pose, cold));
    print.add(distance(a, b, pose, random));
    print.add(distance(b, a, inverse(pose), cold = {}));
    print.add(distance(a, b, pose, loose.seed, loose.options));
    print.add(intersects(a, b, pose, tested.seed));
    print.add(within(a, b, pose, 0.5, near.seed).answer);
    print.add(contact(a, b, pose, met.seed).answer);
    QueryOptions limited;
    limited.step_budget = std::uint32_t(i % 7);
    limited.finest_level = i % 2;
    print.add(distance(a, b, pose, cold = {}, limited));
  }
}

}  // namespace

Fingerprint fingerprint(const std::vector<Model>& models, int rounds) {
  Fingerprint print;
  for (const Model& model : models) {
    print.add(model.hash());
    print.add(model.with_table({lut::Resolution::Degrees5, 1.5}).value().hash());
  }
  Poses poses(1);
  for (const Model& a : models)
    for (const Model& b : models) ask_pair(a, b, poses, rounds, print);
  return print;
}

namespace {

/// Calls ask(a, b, pose) for so many poses of each pair.
template <class Ask>
void each(const std::vector<Model>& models, int rounds, Poses& poses, Ask ask) {
  for (const Model& a : models) {
    for (const Model& b : models) {
      for (int i = 0; i < rounds; ++i) ask(a, b, poses.next(), i);
    }
  }
}

}  // namespace

Fingerprint signed_fingerprint(const std::vector<Model>& models, int rounds) {
  Fingerprint print;
  Poses poses(2);
  PairSeed warm, met;
  QueryOptions loose, limited;
  loose.relative_error = 0.01;
  each(models, rounds, poses, [&](const Model& a, const Model& b, Pose pose, int i) {
    if (i % 4) pose.translation *= 0.25;  // mostly inside one another
    PairSeed cold, random = poses.seed();
    print.add(signed_distance(a, b, pose, warm));
    print.add(signed_distance(a, b, pose, cold));
    print.add(signed_distance(a, b, pose, random));
    print.add(signed_distance(b, a, inverse(pose), cold = {}));
    print.add(signed_distance(a, b, pose, cold = {}, loose));
    limited.step_budget = std::uint32_t(i % 7);
    limited.finest_level = i % 2;
    print.add(signed_distance(a, b, pose, cold = {}, limited));
    print.add(signed_within(a, b, pose, -0.25, met).answer);
  });
  return print;
}

Fingerprint patch_fingerprint(const std::vector<Model>& models, int rounds) {
  Fingerprint print;
  Poses poses(3);
  PairSeed seed, near;
  Patch before;
  each(models, rounds, poses, [&](const Model& a, const Model& b, const Pose& pose, int i) {
    PatchOptions options;
    options.margin = i % 3 ? 4 : 0;
    options.most_points = 1 + std::uint32_t(poses.bits() % kMostPatchPoints);
    if (i % 4 == 0) options.flatness = 0;
    if (i % 5 == 0) options.radius_a = 0.25, options.radius_b = 0.125;
    QueryOptions query;
    query.radius_a = options.radius_a, query.radius_b = options.radius_b;
    const SignedAnswer deep = signed_distance(a, b, pose, seed, query);
    print.add(patch(a, b, pose, deep, options));
    print.add(before = patch(a, b, pose, deep, options, before));
    print.add(patch(a, b, pose, contact(a, b, pose, near, query).answer, options));
  });
  return print;
}

std::vector<Print> prints(const std::vector<Model>& models, int rounds) {
  return {{"answers", fingerprint(models, rounds)},
          {"signed", signed_fingerprint(models, rounds)},
          {"patches", patch_fingerprint(models, rounds)}};
}

std::string text(const Print& print) {
  char line[80];
  std::snprintf(line, sizeof line, "%016" PRIx64 " %" PRIu64 " %s", print.print.hash, print.print.answers, print.name);
  return line;
}

}  // namespace swiftlet::answers
