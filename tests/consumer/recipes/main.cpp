// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The program of RECIPES.md, and of what README.md asks: a function per block. Ends with 1 where a block does not do what the
// page says of it.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/batch.h>
#include <swiftlet/build.h>
#include <swiftlet/build_mesh.h>
#include <swiftlet/check.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "arm.h"

namespace {

using swiftlet::Body;
using swiftlet::Model;
using swiftlet::Pose;
using swiftlet::Result;
using swiftlet::Vec3;

int failed = 0;

void expect(bool holds, const char* claim) {
  if (!holds) ++failed, std::printf("WRONG: %s\n", claim);
}

bool same(const swiftlet::Answer& left, const swiftlet::Answer& right) {
  return left.lower == right.lower && left.upper == right.upper && left.normal == right.normal && left.steps == right.steps;
}

Result<Model> raw_arrays() {
  const Vec3 corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 2}};  // a pyramid
  const std::uint32_t loops[] = {3, 2, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};      // counter-clockwise seen from outside
  const std::uint32_t sizes[] = {4, 3, 3, 3, 3};                                       // left out where all are triangles
  swiftlet::LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = loops;
  arrays.face_sizes = sizes;
  return Model::from_level(arrays);  // copies; a dent is an error that names the edge
}

Result<Model> mesh(const std::filesystem::path& input, const std::filesystem::path& output) {
  const auto mesh = swiftlet::read_mesh(input);  // OBJ, OFF, STL, PLY, TRI, POLY
  if (!mesh) return mesh.error();
  swiftlet::BuildOptions options;
  options.cutoff = 30;  // go on to coarser levels than by default
  const auto built = swiftlet::build(mesh.value(), options);
  if (!built) return built.error();
  for (const auto& level : built.value().report.levels)
    std::printf("%zu triangles, at most %.3f off the hull\n", level.triangles, level.deviation);
  const auto bytes = swiftlet::save(built.value().model, output);
  if (!bytes) return bytes.error();
  return swiftlet::load(output);
}

void one_pair(const Model& a, const Model& b, const Pose& a_in_world, const Pose& b_in_world) {
  const swiftlet::Answer answer = swiftlet::distance(a, b, swiftlet::relative(a_in_world, b_in_world));
  if (answer.verdict == swiftlet::Verdict::Disjoint) {
    const Vec3 normal = a_in_world.rotation * answer.normal;  // from A to B, in the world
    const Vec3 point_a = a_in_world.rotation * answer.point_a + a_in_world.translation;
    const Vec3 point_b = a_in_world.rotation * answer.point_b + a_in_world.translation;
    std::printf("%.6f apart, (%.3f, %.3f, %.3f) to (%.3f, %.3f, %.3f), normal (%.3f, %.3f, %.3f)\n", answer.lower, point_a[0],
                point_a[1], point_a[2], point_b[0], point_b[1], point_b[2], normal[0], normal[1], normal[2]);
  }
  expect(answer.verdict == swiftlet::Verdict::Disjoint, "the pair is apart");
  expect(bool(swiftlet::check(a, b, swiftlet::relative(a_in_world, b_in_world), answer)), "the answer's certificate holds");
}

Result<Model> no_more_than_needed(const std::filesystem::path& file, const Pose& b_in_a) {
  Result<Model> model = swiftlet::map(file, {.deviation = 0.05});  // finer levels are neither read nor checked
  if (!model) return model.error();
  const Model& part = model.value();
  swiftlet::PairSeed seed;
  const auto coarse = swiftlet::distance(part, part, b_in_a, seed, {.absolute = 0.1});  // Converged
  const auto limited = swiftlet::distance(part, part, b_in_a, seed);                    // LevelLimit, the interval true
  if (const auto finer = model.value().ensure(0); !finer) return finer.error();         // where the scene needs more
  const auto exact = swiftlet::distance(part, part, b_in_a, seed);                      // the seed still fits
  expect(coarse.status == swiftlet::Status::Converged, "a coarse model answers what it was loaded for");
  expect(limited.status == swiftlet::Status::LevelLimit && exact.status == swiftlet::Status::Converged, "levels are added");
  expect(limited.lower <= exact.upper && exact.lower <= limited.upper, "the coarse interval is true");
  return model;
}

std::vector<swiftlet::Answer> many_pairs(const Model& a, const Model& b, const std::vector<Pose>& poses,
                                         std::vector<swiftlet::PairSeed>& seeds) {
  std::vector<swiftlet::PairQuery> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i) pairs.push_back({a, b, poses[i], &seeds[i]});
  std::vector<swiftlet::Answer> answers(pairs.size());
  swiftlet::distance(pairs, answers);
  return answers;
}

std::vector<swiftlet::Answer> many_poses(const Model& a, const Model& b, const std::vector<Pose>& poses) {
  std::vector<swiftlet::Answer> answers(poses.size());
  swiftlet::distance(a, b, poses, answers, {.relative = 0.01});
  return answers;
}

void threads(const std::vector<swiftlet::PairQuery>& pairs, const std::vector<swiftlet::Answer>& alone) {
  std::vector<swiftlet::Answer> answers(pairs.size());
  const swiftlet::Executor threads = swiftlet::on_threads(4);  // kept: they wait for the next batch
  // Set from any thread this ends a long batch: what is done is done.
  std::atomic<bool> stop = false;
  swiftlet::distance(pairs, answers, {}, {.executor = threads, .stop = [&stop] { return stop.load(); }});

  const swiftlet::Executor ours = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    std::vector<std::future<void>> running;  // here your own job system
    for (std::size_t i = 0; i < count; ++i) running.push_back(std::async(std::launch::async, std::cref(task), i));
    for (std::future<void>& one : running) one.wait();
  };
  std::vector<swiftlet::Answer> again(pairs.size());
  swiftlet::distance(pairs, again, {}, {.executor = ours});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    expect(same(answers[i], alone[i]) && same(again[i], alone[i]),
           "on threads the answers are those of one query after the other");
  stop = true;
  again.assign(pairs.size(), {});
  swiftlet::distance(pairs, again, {}, {.executor = threads, .stop = [&stop] { return stop.load(); }});
  expect(again.front().steps == 0 && again.front().lower == 0, "a batch that is stopped leaves answers as they were");
}

swiftlet::Manifold contacts(const Model& a, const Model& b, const Pose& a_in_world, const Pose& b_in_world,
                            swiftlet::PairSeed& seed, const swiftlet::Manifold& before) {
  const double margin = 0.02;  // points farther apart are none
  const Pose b_in_a = swiftlet::relative(a_in_world, b_in_world);
  const swiftlet::Answer answer = swiftlet::signed_distance(a, b, b_in_a, seed, {.beyond = margin});  // below 0: so deep
  const swiftlet::Manifold manifold = swiftlet::manifold(a, b, b_in_a, answer, {.margin = margin}, before);
  const Vec3 normal = a_in_world.rotation * manifold.normal;  // from A to B, one for all points
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const swiftlet::ManifoldPoint& p = manifold.points[i];
    const Vec3 middle = a_in_world.rotation * (p.point_a + p.point_b) / 2 + a_in_world.translation;
    std::printf("(%.3f, %.3f, %.3f), %.3f apart along (%.0f, %.0f, %.0f)\n", middle[0], middle[1], middle[2], p.separation,
                normal[0], normal[1], normal[2]);
  }
  return manifold;
}

void two_steps_of_contact(const Model& pyramid) {
  Pose below;  // base to base
  below.rotation = Vec3(1, -1, -1).asDiagonal();
  below.translation = {0.5, 0, -0.01};
  swiftlet::PairSeed seed;
  const swiftlet::Manifold first = contacts(pyramid, pyramid, Pose{}, below, seed, {});
  below.translation[2] = 0.01;
  const swiftlet::Manifold second = contacts(pyramid, pyramid, Pose{}, below, seed, first);
  expect(first.count == 4 && second.count == 4, "two bases have four corners in common");
  for (std::uint32_t i = 0; i < 4; ++i) {
    expect(std::abs(first.points[i].separation - 0.01) < 1e-12, "the pyramids are 0.01 apart");
    expect(std::abs(second.points[i].separation + 0.01) < 1e-12, "the pyramids are 0.01 deep in one another");
    expect(first.points[i].feature_a == second.points[i].feature_a, "points keep their names");
  }
}

Pose pose_of(const Eigen::Isometry3d& motion) { return {motion.linear(), motion.translation()}; }
Pose pose_of(const Eigen::Quaterniond& turn, const Vec3& shift) { return {turn.normalized().toRotationMatrix(), shift}; }

void poses_of_eigen() {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Vec3(0.6, 0, 0.8)));
  const Vec3 shift(1, 2, 3);
  const Pose left = pose_of(Eigen::Isometry3d(Eigen::Translation3d(shift) * turn)), right = pose_of(turn, shift);
  expect((left.rotation - right.rotation).norm() < 1e-15 && left.translation == right.translation, "both are one motion");
}

void seeds(const Model& a, const Model& b) {
  swiftlet::PairSeed seed;  // cold; lives as long as the pair
  std::uint32_t warm = 0, cold = 0;
  for (int degree = 0; degree < 90; ++degree) {
    Pose b_in_a;
    b_in_a.rotation = Eigen::AngleAxisd(degree * EIGEN_PI / 180, Vec3(0.6, 0, 0.8)).toRotationMatrix();
    b_in_a.translation = {3, 0, 0};
    warm += swiftlet::distance(a, b, b_in_a, seed).steps;
    cold += swiftlet::distance(a, b, b_in_a).steps;
  }
  std::printf("90 queries: %u steps with one seed, %u without\n", warm, cold);
  expect(warm < cold, "a seed saves steps");
}

void asked_of_one_pair(const Model& a, const Model& b, const Pose& b_in_a) {
  swiftlet::PairSeed seed;
  const auto rough = swiftlet::distance(a, b, b_in_a, seed, {.relative = 0.01});  // until upper - lower <= 1 % of lower
  const auto exact = swiftlet::refine(a, b, b_in_a, rough, seed);                 // on from there, for the difference
  const auto near = swiftlet::within(a, b, b_in_a, 0.05, seed).decision;          // Yes, No, Undecided within rounding
  const auto verdict = swiftlet::intersects(a, b, b_in_a, seed).verdict;          // Disjoint, Touching, Overlapping: proved
  const auto ids = swiftlet::closest_features(a, b, b_in_a, seed).source_a;       // the user's own vertices and triangles
  const auto depth = swiftlet::signed_distance(a, b, b_in_a, seed);               // depth.h: below 0, so deep, along its normal
  const auto deep = swiftlet::signed_within(a, b, b_in_a, -0.01, seed).decision;  // depth.h: Yes, at least so deep
  const auto contact = swiftlet::manifold(a, b, b_in_a, depth);                   // manifold.h: where they touch: four points
  const auto holds = swiftlet::check(a, b, b_in_a, exact);                        // check.h: recomputes what an answer claims
  expect(rough.upper - rough.lower <= 0.01 * rough.lower, "rough is within 1 %");
  expect(exact.upper - exact.lower <= swiftlet::tolerance(a, b, b_in_a) && bool(holds), "exact is exact, and holds");
  expect(near == swiftlet::Decision::No && deep == near && verdict == swiftlet::Verdict::Disjoint, "they are apart");
  expect(ids.kind != swiftlet::FeatureKind::None, "the nearest feature has the user's ids");
  expect(std::fabs(depth.value() - exact.value()) <= swiftlet::tolerance(a, b, b_in_a), "apart both distances are one");
  expect(contact.count == 0, "bodies that are apart have no contact");
}

void tolerance(const Model& a, const Model& b, const Pose& b_in_a, swiftlet::PairSeed& seed) {
  // done when upper - lower <= 1 % of lower
  const swiftlet::Answer percent = swiftlet::distance(a, b, b_in_a, seed, {.relative = 0.01});
  // exact up to here; status Beyond as soon as lower > 0.5 is proved
  const swiftlet::Answer far = swiftlet::distance(a, b, b_in_a, seed, {.beyond = 0.5});

  const swiftlet::Decision close = swiftlet::within(a, b, b_in_a, 0.5, seed).decision;  // Yes, No, Undecided
  const swiftlet::Verdict verdict = swiftlet::intersects(a, b, b_in_a, seed).verdict;   // Disjoint, Touching, Overlapping
  expect(percent.upper - percent.lower <= 0.01 * percent.lower, "the interval is as narrow as asked");
  expect(far.status == swiftlet::Status::Beyond && far.lower > 0.5, "farther than 0.5 is Beyond");
  expect(close == swiftlet::Decision::No, "farther than 0.5 is not within");
  expect(verdict == swiftlet::Verdict::Disjoint, "apart is disjoint");
}

void radii(const Model& a, const Model& b, const Pose& b_in_a) {
  const Body padded(a, 0.9), capsule = Body::segment({-1, 0, 0}, {-1, 0, 2}, 0.2);  // a model's margin, a segment's radius
  const swiftlet::Verdict verdict = swiftlet::intersects(padded, capsule, b_in_a).verdict;
  const double depth = -swiftlet::signed_distance(padded, Body(b, 0.2), b_in_a).value();
  std::printf("the margins overlap by %.6f\n", depth);
  const double apart = swiftlet::distance(a, b, b_in_a).lower;
  expect(verdict == swiftlet::Verdict::Overlapping, "the capsule is in the margin");
  expect(std::fabs(depth + apart - 1.1) < 1e-12, "by what the hulls lack of the radii");
}

void refinement(const Model& a, const Model& b, const Pose& b_in_a, double needed) {
  swiftlet::PairSeed seed;
  swiftlet::Answer answer;  // nothing is known yet
  for (const double relative : {0.1, 0.01, 0.0}) {
    answer = swiftlet::refine(a, b, b_in_a, answer, seed, {.relative = relative});
    if (answer.lower > needed || answer.upper <= needed) break;  // the next precision is not needed
  }
  expect(answer.lower > needed || answer.upper <= needed, "exact decides");
}

/// A mesh of its own: all triangles as they are.
Result<swiftlet::MeshModel> triangles(const std::filesystem::path& file) {
  const auto given = swiftlet::read_mesh(file);  // or arrays of your own: points, and three indices a triangle
  if (!given) return given.error();
  auto mesh = swiftlet::MeshModel::from_triangles(given.value().points, given.value().triangles);
  if (!mesh) return mesh.error();
  const swiftlet::MeshTopology& made_of = mesh.value().topology();
  std::printf("%zu triangles, components %u, open edges %u, %s\n", mesh.value().triangle_count(), made_of.components,
              made_of.open_edges, made_of.closed() ? "closed" : "not closed");
  return mesh;
}

/// The user's ids.
std::string text(const swiftlet::SourceFeature& feature) {
  const auto id = [](std::uint32_t i) { return std::to_string(i); };
  if (feature.kind == swiftlet::FeatureKind::Vertex) return "vertex " + id(feature.vertices[0]);
  if (feature.kind == swiftlet::FeatureKind::Edge) return "edge " + id(feature.vertices[0]) + " " + id(feature.vertices[1]);
  return "triangle " + id(feature.triangles[0]);
}

/// How many poses the link takes until it meets the room.
std::size_t walk(const swiftlet::MeshModel& room, const swiftlet::MeshModel& link, const std::vector<Pose>& path) {
  swiftlet::MeshSeed seed;  // one per ordered pair
  for (std::size_t step = 0; step < path.size(); ++step) {
    if (swiftlet::within(room, link, path[step], 0.15, seed).decision == swiftlet::Decision::No) continue;
    const swiftlet::ClosestFeatures found = swiftlet::closest_features(room, link, path[step], seed);
    std::printf("step %zu: %.3f apart, %s of the room, %s of the link\n", step, found.answer.value(),
                text(found.source_a).c_str(), text(found.source_b).c_str());
    if (found.answer.verdict == swiftlet::Verdict::Overlapping) return step;  // these two triangles cross
  }
  return path.size();
}

void mesh_and_convex(const swiftlet::MeshModel& room, const Model& a) {
  Pose above;
  above.translation = {0, 0, 3};
  const double hull = swiftlet::distance(room, Body(a), above, {.relative = 0.01}).lower;  // a model takes either place
  const double ball = swiftlet::distance(Body::point({0, 0, 3}, 0.5), {room, 0.01}, Pose{}).lower;  // radii as of bodies
  expect(hull > 2 && hull < 3 && ball > 2 && ball < 2.8, "the floor is below");
}

/// Points of an ellipsoid on a spiral, as an OFF file without faces.
void write_points(const std::filesystem::path& path) {
  std::ofstream file(path);
  file.precision(17);
  const int count = 500;
  file << "OFF\n" << count << " 0 0\n";
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    file << r * std::cos(turn) << ' ' << 0.8 * r * std::sin(turn) << ' ' << 0.6 * z << '\n';
  }
}

/// Returns in how many poses the arm meets the plant.
std::size_t move_arm(const swiftlet::MeshModel& room, const std::vector<swiftlet::MeshModel>& links) {
  std::vector<swiftlet::MeshSeed> seeds(links.size());  // one per link, along the whole trajectory
  double lower = HUGE_VAL, upper = HUGE_VAL;            // bounds on the least distance of all poses that are free
  std::size_t met = 0, nearest = 0;
  for (std::size_t step = 0; step < 1000; ++step) {
    const std::array<Pose, 3> poses = plant::arm_at(double(step) / 1000);
    bool free = true;
    for (std::size_t k = 0; free && k < links.size(); ++k)
      free = swiftlet::intersects(room, links[k], poses[k], seeds[k]).verdict == swiftlet::Verdict::Disjoint;
    met += !free;
    for (std::size_t k = 0; free && k < links.size(); ++k) {  // to 10 %, and if farther than the nearest so far not how far
      const auto found = swiftlet::distance(room, links[k], poses[k], seeds[k], {.relative = 0.1, .beyond = upper});
      lower = std::min(lower, found.lower);
      if (found.upper < upper) upper = found.upper, nearest = step;
    }
  }
  std::printf("the arm meets the plant in %zu poses; of the others the nearest, %zu, is %.5f to %.5f away\n", met, nearest,
              lower, upper);
  return met;
}

/// Whether as many poses are in collision as by queries without seeds.
bool arm() {
  const auto room = swiftlet::build_mesh(plant::environment());  // with hulls, which answer links that are far away
  std::vector<swiftlet::MeshModel> links;
  for (const swiftlet::Mesh& link : plant::links()) links.push_back(swiftlet::build_mesh(link).value());
  expect(room.value().triangle_count() == 38200 && room.value().hull_count() > 0, "a plant of 38 200 triangles with hulls");
  std::size_t met = move_arm(room.value(), links);
  for (std::size_t step = 0; step < 1000; ++step) {
    const std::array<Pose, 3> poses = plant::arm_at(double(step) / 1000);
    bool meets = false;
    for (std::size_t k = 0; k < links.size(); ++k)
      meets = meets || swiftlet::distance(room.value(), links[k], poses[k]).verdict != swiftlet::Verdict::Disjoint;
    met -= meets;
  }
  return met == 0;
}

/// A bumpy floor with a hole, and a ring.
void write_meshes(const std::filesystem::path& room, const std::filesystem::path& link) {
  std::ofstream floor(room), ring(link);
  const int side = 31, around = 24, across = 12;
  for (int i = 0; i < side * side; ++i) {
    const double x = 0.1 * (i % side) - 1.5, y = 0.1 * (i / side) - 1.5;
    floor << "v " << x << ' ' << y << ' ' << 0.1 * std::sin(4 * x) * std::cos(3 * y) << '\n';
  }
  for (int i = 1; i <= side * (side - 1); ++i) {
    if (i % side == 0 || i == 480) continue;
    floor << "f " << i << ' ' << i + 1 << ' ' << i + side + 1 << ' ' << i + side << '\n';
  }
  for (int i = 0; i < around * across; ++i) {
    const double turn = 2 * EIGEN_PI * (i / across) / around, roll = 2 * EIGEN_PI * (i % across) / across;
    const double r = 0.3 + 0.08 * std::cos(roll);
    ring << "v " << r * std::cos(turn) << ' ' << r * std::sin(turn) << ' ' << 0.08 * std::sin(roll) << '\n';
  }
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const int next = (i + 1) % around, up = (k + 1) % across;
      ring << "f " << i * across + k + 1 << ' ' << next * across + k + 1 << ' ' << next * across + up + 1 << ' '
           << i * across + up + 1 << '\n';
    }
  }
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path here = std::filesystem::path(arguments[0]).parent_path();
  write_points(here / "link.off");
  const auto pyramid = raw_arrays(), link = mesh(here / "link.off", here / "link.swl");
  if (!pyramid || !link) return std::puts((pyramid ? link : pyramid).error().message.c_str()), 1;
  const Model &a = link.value(), &b = pyramid.value();
  expect(a.level_count() > 1 && bool(swiftlet::verify(a)), "the mesh's model has coarse levels, and they hold");
  expect(bool(swiftlet::verify(b)), "the arrays' model holds");

  Pose a_in_world, b_in_world;
  a_in_world.translation = {10, 0, 0};
  b_in_world.translation = {13, 0, 0};
  one_pair(a, b, a_in_world, b_in_world);
  two_steps_of_contact(b);

  std::vector<Pose> poses(100);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].translation = {3, 0.01 * double(i), 0};
  std::vector<swiftlet::PairSeed> kept(poses.size());
  const auto alone = many_pairs(a, b, poses, kept);
  std::vector<swiftlet::PairQuery> pairs;
  std::vector<swiftlet::Answer> cold;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    pairs.push_back({a, b, poses[i]});
    cold.push_back(swiftlet::distance(a, b, poses[i]));
    expect(same(alone[i], cold[i]), "a batch answers as one query after the other");
  }
  threads(pairs, cold);
  const auto rough = many_poses(a, b, poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    expect(rough[i].lower <= cold[i].upper && cold[i].lower <= rough[i].upper, "at every pose the interval is true");
  poses_of_eigen();
  seeds(a, a);
  asked_of_one_pair(a, b, poses[0]);
  swiftlet::PairSeed seed;
  tolerance(a, b, poses[0], seed);
  radii(a, b, poses[0]);
  refinement(a, b, poses[0], 0.99);
  expect(bool(no_more_than_needed(here / "link.swl", poses[0])), "a part of a file is a model");

  write_meshes(here / "room.obj", here / "ring.obj");
  const auto room = triangles(here / "room.obj"), ring = triangles(here / "ring.obj");
  if (!room || !ring) return std::puts((room ? ring : room).error().message.c_str()), 1;
  expect(!room.value().topology().closed() && ring.value().topology().volume > 0, "a floor has a border, a ring an inside");
  expect(bool(swiftlet::verify(room.value())) && bool(swiftlet::verify(ring.value())), "the trees hold");
  std::vector<Pose> path(100);
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].rotation = Eigen::AngleAxisd(0.02 * double(i), Vec3::UnitX()).toRotationMatrix();
    path[i].translation = {0.05 * double(i) - 1.5, 0.1, 1.2 - 0.03 * double(i)};
  }
  const std::size_t met = walk(room.value(), ring.value(), path);
  expect(met < path.size(), "the link meets the floor on its way");
  for (std::size_t i = 0; i <= met && met < path.size(); ++i) {
    const bool meet = swiftlet::intersects(room.value(), ring.value(), path[i]).verdict == swiftlet::Verdict::Overlapping;
    expect(meet == (i == met), "not earlier, and a seed changes nothing");
  }
  mesh_and_convex(room.value(), a);

  expect(arm(), "cold and exact the same poses are in collision");
  return failed ? 1 : 0;
}
