// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The oracle's signed distance against answers known by hand, and against those that another exact program computed for every
// stored case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "case.h"
#include "oracle.h"
#include "shapes.h"
#include "suite.h"

namespace swiftlet {
namespace {

using oracle::SignedTruth;
using Points = std::vector<Vec3>;

Pose at(double x, double y, double z) { return {Mat3::Identity(), {x, y, z}}; }

/// A cube of side 2.
const Points& cube() {
  static const Points points = shapes::cube().points;
  return points;
}

void expect_exactly(const SignedTruth& truth, double distance) {
  EXPECT_EQ(truth.distance, distance);
  EXPECT_EQ(truth.bounds.lower, distance);
  EXPECT_EQ(truth.bounds.upper, distance);
  EXPECT_EQ(truth.sign, distance > 0 ? 1 : distance < 0 ? -1 : 0);
  EXPECT_EQ(oracle::compare(truth, distance), 0);
}

TEST(SignedOracle, KnowsTwoCubes) {
  for (const double x : {5., 2.5, 2., 1.5, .25, -1.5}) {
    const SignedTruth truth = oracle::signed_distance(cube(), at(10, 0, 0), cube(), at(10 + x, .125, -.125));
    expect_exactly(truth, std::abs(x) - 2);
    if (truth.sign != 0) {
      EXPECT_EQ(truth.normal, Vec3(x > 0 ? 1 : -1, 0, 0)) << x;
    }
  }
  expect_exactly(oracle::signed_distance(cube(), Pose{}, cube(), Pose{}), -2);
}

TEST(SignedOracle, TakesBodiesOfEveryDimension) {
  const Points point{{0, 0, 0}}, segment{{-3, 0, 0}, {3, 0, 0}}, square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  expect_exactly(oracle::signed_distance(point, at(.5, 0, 0), cube(), Pose{}), -.5);
  expect_exactly(oracle::signed_distance(segment, at(0, .25, 0), cube(), Pose{}), -.75);
  expect_exactly(oracle::signed_distance(square, at(0, 0, .25), cube(), Pose{}), -.75);
  expect_exactly(oracle::signed_distance(square, Pose{}, square, at(.5, .5, 0)), 0);  // one plane
  expect_exactly(oracle::signed_distance(segment, Pose{}, square, Pose{}), 0);        // in it
  expect_exactly(oracle::signed_distance(segment, Pose{}, segment, at(1, 0, 0)), 0);  // one line
  expect_exactly(oracle::signed_distance(point, Pose{}, point, Pose{}), 0);           // one point
  expect_exactly(oracle::signed_distance(point, Pose{}, point, at(0, 3, 4)), 5);
  const Points upright{{0, 0, -1}, {0, 0, 3}};
  expect_exactly(oracle::signed_distance(square, Pose{}, upright, Pose{}), -1);  // down by 1 is less than out by 1 to any side
}

TEST(SignedOracle, TakesPosesThatAreNoRotations) {
  const Pose twice{2 * Mat3::Identity(), Vec3::Zero()};
  expect_exactly(oracle::signed_distance(cube(), twice, cube(), at(2.5, 0, 0)), -.5);
  expect_exactly(oracle::signed_distance(cube(), twice, cube(), at(4, 0, 0)), 1);
}

TEST(SignedOracle, IsTheLeastTranslationThatSeparates) {
  shapes::Random random(41);
  int overlapping = 0;
  for (int i = 0; i < 60; ++i) {
    Points a, b;
    for (int k = 0; k < 10; ++k) a.push_back(random.in_ball()), b.push_back(random.in_ball());
    const Pose a_in_world{random.rotation(), random.in_ball()};
    Pose b_in_world{random.rotation(), a_in_world.translation + random.in_ball()};
    const SignedTruth truth = oracle::signed_distance(a, a_in_world, b, b_in_world);
    const SignedTruth back = oracle::signed_distance(b, b_in_world, a, a_in_world);
    ASSERT_EQ(oracle::squared_text(truth), oracle::squared_text(back));
    ASSERT_EQ(truth.sign, back.sign);
    ASSERT_EQ(oracle::compare(truth, truth.bounds.lower) >= 0, true);
    ASSERT_EQ(oracle::compare(truth, truth.bounds.upper) <= 0, true);
    if (truth.sign >= 0) continue;
    ++overlapping;
    const Vec3 start = b_in_world.translation;
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {
      b_in_world.translation = start - part * truth.distance * truth.normal;
      ASSERT_EQ(oracle::signed_distance(a, a_in_world, b, b_in_world).sign, part < 1 ? -1 : 1) << i;
    }
    for (int k = 0; k < 20; ++k) {
      b_in_world.translation = start - (1 - 1e-9) * truth.distance * random.on_sphere();
      ASSERT_EQ(oracle::signed_distance(a, a_in_world, b, b_in_world).sign, -1) << i;
    }
  }
  EXPECT_GE(overlapping, 15);
  EXPECT_LE(overlapping, 55);
}

TEST(SignedOracle, ComparesExactly) {
  const SignedTruth apart = oracle::signed_distance(cube(), Pose{}, cube(), at(3, 3, 0));  // the root of 2
  const double root = std::sqrt(2.);
  EXPECT_EQ(oracle::squared_text(apart), "2");
  EXPECT_EQ(oracle::compare(apart, root), -1);  // sqrt rounds up
  EXPECT_EQ(oracle::compare(apart, std::nextafter(root, 0)), 1);
  EXPECT_EQ(oracle::compare(apart, 0), 1);
  EXPECT_EQ(oracle::compare(apart, -5), 1);
  EXPECT_EQ(oracle::compare(apart, std::numeric_limits<double>::infinity()), -1);
  const SignedTruth deep = oracle::signed_distance(cube(), Pose{}, cube(), at(1.5, 0, 0));
  EXPECT_EQ(oracle::compare(deep, -.5), 0);
  EXPECT_EQ(oracle::compare(deep, -.25), -1);
  EXPECT_EQ(oracle::compare(deep, -.75), 1);
  EXPECT_EQ(oracle::compare(deep, 0), -1);
  EXPECT_EQ(oracle::compare(deep, -std::numeric_limits<double>::infinity()), 1);
}

/// The stored answers to 25 digits, and the squares where they are short.
TEST(SignedOracle, ReproducesEveryStoredCase) {
  const auto path = stability::suite_files().front();
  std::ifstream file(path);
  const auto expected = nlohmann::json::parse(file);
  const auto cases = stability::read_cases(path);
  ASSERT_EQ(cases.size(), expected.size());
  ASSERT_GE(cases.size(), 187u);
  int squares = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const stability::Case& c = cases[i];
    SCOPED_TRACE(c.name);
    const auto& stored = expected[i]["expected"];
    const SignedTruth truth = oracle::signed_distance(c.a, c.a_in_world, c.b, c.b_in_world);
    EXPECT_EQ(truth.sign, c.expected->sign);
    const double nearest = std::strtod(stored["distance_25"].get<std::string>().c_str(), nullptr);
    EXPECT_LE(truth.bounds.lower, nearest);
    EXPECT_GE(truth.bounds.upper, nearest);
    if (stored.contains("squared_exact")) {
      ++squares;
      EXPECT_EQ(oracle::squared_text(truth), stored["squared_exact"].get<std::string>());
    }
    std::vector<nlohmann::json> axes;
    if (stored.contains("normal_AtoB")) axes.push_back(stored["normal_AtoB"]);
    if (stored.contains("min_axes")) {
      for (const auto& axis : stored["min_axes"]) axes.push_back(axis["axis_AtoB"]);
    }
    double off = truth.sign == 0 ? 0 : 2;
    for (const auto& n : axes) off = std::min(off, (truth.normal - Vec3(n[0], n[1], n[2])).norm());
    EXPECT_LE(off, 1e-14);
  }
  EXPECT_GE(squares, 69);
}

}  // namespace
}  // namespace swiftlet
