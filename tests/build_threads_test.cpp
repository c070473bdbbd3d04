// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds on threads: the same bytes on any number of them and in any order, progress on the caller's, cancelled anywhere. Also
// to be run under the thread sanitizer: tests/README.md.
#include <swiftlet/build.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "shapes.h"

namespace swiftlet {
namespace {

struct Body {
  const char* name;
  Mesh mesh;
};

/// A bar between two hubs, as a robot's link is: large flat faces, round ones and long thin triangles.
Mesh link() {
  Mesh both = shapes::moved(shapes::prism(500, 0.3, 0.4), {Mat3::Identity(), Vec3(-1, 0, 0)});
  const Mesh other = shapes::prism(400, 0.2, 0.3);
  for (const Vec3& p : other.points) both.points.push_back(p + Vec3(1, 0, 0.02));
  both.triangles.clear();
  return both;
}

/// Large enough that every stage is cut into several tasks, but for the flat one and the solid without triangles of its own.
std::vector<Body> bodies() {
  return {{"sphere", shapes::ellipsoid(Vec3(1, 1, 1), 20000, 1)},
          {"plate", shapes::ellipsoid(Vec3(1, 1, 0.1), 10000, 2)},
          {"needle", shapes::ellipsoid(Vec3(1, 0.1, 0.1), 10000, 3)},
          {"rounded", shapes::float_rounded(shapes::ellipsoid(Vec3(1, 1, 0.5), 6000, 4))},
          {"cube", shapes::meshed_cube(40)},
          {"link", link()},
          {"polygon", shapes::polygon(300)}};
}

/// Begins with the last task, each on a thread of its own; the calling thread has none.
void backwards(std::size_t count, const std::function<void(std::size_t)>& task) {
  constexpr std::size_t kAtOnce = 4;
  for (std::size_t left = count; left > 0;) {
    std::vector<std::thread> threads;
    for (; left > 0 && threads.size() < kAtOnce; --left) threads.emplace_back(task, left - 1);
    for (std::thread& thread : threads) thread.join();
  }
}

std::vector<std::byte> bytes_of(const Model& model) { return {model.bytes().begin(), model.bytes().end()}; }

void expect_same_everywhere(const Mesh& mesh, BuildOptions options, const std::string& name) {
  options.executor = {};
  const Result<Built> alone = build(mesh, options);
  ASSERT_TRUE(alone) << name;
  const std::vector<std::byte> expected = bytes_of(alone.value().model);
  for (const Executor& executor : {on_threads(1), on_threads(2), on_threads(5), Executor(backwards)}) {
    options.executor = executor;
    const Result<Built> built = build(mesh, options);
    ASSERT_TRUE(built) << name;
    EXPECT_TRUE(bytes_of(built.value().model) == expected) << name;
    EXPECT_EQ(built.value().report.end, alone.value().report.end) << name;
    EXPECT_EQ(built.value().report.closed, alone.value().report.closed) << name;
    EXPECT_EQ(built.value().report.volume_ratio, alone.value().report.volume_ratio) << name;
    EXPECT_EQ(built.value().report.deepest_dent, alone.value().report.deepest_dent) << name;
  }
}

TEST(BuildThreads, SameBytesOnAnyNumber) {
  for (const auto& [name, mesh] : bodies()) expect_same_everywhere(mesh, {}, name);
}

TEST(BuildThreads, SameBytesWhateverIsBuilt) {
  const Mesh mesh = shapes::ellipsoid(Vec3(1, 0.8, 0.5), 6000, 5);
  BuildOptions dense;
  dense.rate = 0.6;
  dense.table.resolution = lut::Resolution::Degrees11;
  expect_same_everywhere(mesh, dense, "rate 0.6");
  BuildOptions aimed;
  aimed.detail.deviation = 0.01;
  expect_same_everywhere(mesh, aimed, "aimed");
  BuildOptions scaled;
  scaled.enclosing = Enclosing::Scale;
  expect_same_everywhere(mesh, scaled, "scale");
  BuildOptions peeled;
  peeled.method = Method::Peel;
  expect_same_everywhere(mesh, peeled, "peel");
}

TEST(BuildThreads, WorkIsHandedOut) {
  std::atomic<std::size_t> tasks = 0;
  BuildOptions options;
  options.executor = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    tasks += count;
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
  ASSERT_TRUE(build(shapes::ellipsoid(Vec3(1, 1, 1), 20000, 1), options));
  EXPECT_GE(tasks, 100u);
}

TEST(BuildThreads, ProgressIsTheCallersAndCancelsAnywhere) {
  const Mesh mesh = shapes::ellipsoid(Vec3(1, 1, 1), 6000, 1);
  for (const Executor& executor : {on_threads(2), on_threads(5), Executor(backwards)}) {
    BuildOptions options;
    options.executor = executor;
    const std::thread::id caller = std::this_thread::get_id();
    double last = 0, wanted = 2;  // up to which fraction
    bool cancelled = false;
    options.progress = [&](double fraction, std::string_view) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_FALSE(cancelled) << "called again";
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      cancelled = fraction >= wanted;
      return !cancelled;
    };
    const Result<Built> whole = build(mesh, options);
    ASSERT_TRUE(whole);
    EXPECT_EQ(last, 1);
    for (const double part : {0.0, 0.1, 0.3, 0.5, 0.7, 0.8}) {
      last = 0, wanted = part, cancelled = false;
      const Result<Built> built = build(mesh, options);
      ASSERT_FALSE(built) << part;
      EXPECT_EQ(built.error().code, ErrorCode::Cancelled);
      EXPECT_TRUE(cancelled);
    }
    last = 0, wanted = 2, cancelled = false;
    EXPECT_EQ(build(mesh, options).value().model.hash(), whole.value().model.hash()) << "nothing is left behind";
  }
}

TEST(BuildThreads, WhatTheCallbackThrowsArrives) {
  BuildOptions options;
  options.executor = on_threads(3);
  const Mesh mesh = shapes::ellipsoid(Vec3(1, 1, 1), 6000, 1);
  for (const double at : {0.0, 0.1, 0.5, 1.0}) {  // a build that ends reports 1 on any number of threads
    options.progress = [&](double fraction, std::string_view) {
      if (fraction >= at) throw std::runtime_error("enough");
      return true;
    };
    EXPECT_THROW(static_cast<void>(build(mesh, options)), std::runtime_error) << at;
  }
}

TEST(BuildThreads, ErrorsAreThoseOfOneThread) {
  Mesh dented = shapes::ellipsoid(Vec3(1, 1, 1), 2000, 1);
  dented.points[7] *= 0.5;
  BuildOptions options;
  options.require_convex = true;
  const Result<Built> alone = build(dented, options);
  options.executor = on_threads(4);
  const Result<Built> built = build(dented, options);
  ASSERT_FALSE(alone);
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().code, alone.error().code);
  EXPECT_EQ(built.error().message, alone.error().message);
}

}  // namespace
}  // namespace swiftlet
