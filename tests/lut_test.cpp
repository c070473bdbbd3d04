// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The direction tables: every bin, every border between bins, and directions that are none. Knows only lut.
#include <swiftlet/lut.h>

#include <double_bits.h>
#include <octahedron.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace swiftlet::lut {
namespace {

using Direction = std::array<double, 3>;

struct Grid {
  Resolution resolution;
  std::uint32_t rows, columns;
  double step() const { return std::numbers::pi / (rows + 1); }
  std::uint32_t pole_south() const { return rows * columns + 1; }
};

constexpr Grid kGrids[] = {{Resolution::Degrees22, 7, 16}, {Resolution::Degrees11, 15, 32}, {Resolution::Degrees5, 31, 64}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Direction at(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

// The direction and its neighbours one ulp away in each coordinate.
std::set<Direction> ulp_neighbourhood(const Direction& d) {
  std::set<Direction> all;
  for (int code = 0; code < 27; ++code) {
    Direction moved = d;
    for (int i = 0, digits = code; i < 3; ++i, digits /= 3)
      if (digits % 3 != 0) moved[i] = std::nextafter(d[i], digits % 3 == 1 ? -kInfinity : kInfinity);
    all.insert(moved);
  }
  return all;
}

// The definition, with libm: the nearest row of altitudes, then the nearest column.
std::uint32_t nearest_by_angles(const Grid& grid, const Direction& d) {
  const double polar = std::atan2(std::hypot(d[0], d[1]), d[2]), azimuth = std::atan2(d[1], d[0]);
  const auto row = std::uint32_t(std::lround(polar / grid.step()));
  if (row == 0) return 0;
  if (row == grid.rows + 1) return grid.pole_south();
  const auto column = std::uint32_t(std::lround(azimuth / grid.step()) + grid.columns) % grid.columns;
  return 1 + (row - 1) * grid.columns + column;
}

TEST(Lut, CountsAreThePapers) {
  EXPECT_EQ(sample_count(Resolution::None), 0u);
  EXPECT_EQ(sample_count(Resolution::Degrees22), 114u);
  EXPECT_EQ(sample_count(Resolution::Degrees11), 482u);
  EXPECT_EQ(sample_count(Resolution::Degrees5), 1986u);
}

TEST(Lut, SamplesAreUnitAndDistinct) {
  for (const Grid& grid : kGrids) {
    std::set<Direction> seen;
    for (std::uint32_t i = 0; i < sample_count(grid.resolution); ++i) {
      const Direction d = sample(grid.resolution, i);
      EXPECT_NEAR(std::hypot(d[0], d[1], d[2]), 1, 1e-15) << i;
      seen.insert(d);
    }
    EXPECT_EQ(seen.size(), sample_count(grid.resolution));
  }
}

TEST(Lut, EverySampleIsItsOwnNearestAlsoOneUlpAway) {
  for (const Grid& grid : kGrids)
    for (std::uint32_t i = 0; i < sample_count(grid.resolution); ++i)
      for (const Direction& d : ulp_neighbourhood(sample(grid.resolution, i))) ASSERT_EQ(nearest(grid.resolution, d), i);
}

TEST(Lut, BorderDirectionsGoToABinBesideTheBorder) {
  for (const Grid& grid : kGrids)
    for (std::uint32_t row = 0; row <= grid.rows; ++row)
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const double polar = (row + 0.5) * grid.step(), azimuth = (column + 0.5) * grid.step();
        for (const Direction& d : ulp_neighbourhood(at(polar, azimuth))) {
          const Direction s = sample(grid.resolution, nearest(grid.resolution, d));
          const double polar_off = std::abs(std::acos(s[2]) - polar);
          EXPECT_NEAR(polar_off, grid.step() / 2, 1e-7);
          if (std::abs(s[2]) == 1) continue;
          EXPECT_NEAR(std::abs(std::remainder(std::atan2(s[1], s[0]) - azimuth, 2 * std::numbers::pi)), grid.step() / 2, 1e-7);
        }
      }
}

TEST(Lut, NearestIsAltitudeFirstThenAzimuth) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const Grid& grid : kGrids)
    for (int i = 0; i < 20000; ++i) {
      const Direction d{normal(random), normal(random), normal(random)};
      ASSERT_EQ(nearest(grid.resolution, d), nearest_by_angles(grid, d)) << d[0] << ' ' << d[1] << ' ' << d[2];
    }
}

TEST(Lut, LengthDoesNotMatter) {
  for (const Grid& grid : kGrids)
    for (std::uint32_t i = 0; i < sample_count(grid.resolution); ++i)
      for (double length : {std::numeric_limits<double>::min() * 16, 1e-200, 1e-20, 3.0, 1e20, 1e200, 1e308}) {
        const Direction d = sample(grid.resolution, i);
        EXPECT_EQ(nearest(grid.resolution, {d[0] * length, d[1] * length, d[2] * length}), i) << length;
      }
}

TEST(Lut, SmallestSubnormalsStillHaveADirection) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  for (const Grid& grid : kGrids) {
    EXPECT_EQ(nearest(grid.resolution, {0, 0, tiny}), 0u);
    EXPECT_EQ(nearest(grid.resolution, {0, 0, -tiny}), grid.pole_south());
    EXPECT_EQ(nearest(grid.resolution, {tiny, 0, 0}), nearest(grid.resolution, {1, 0, 0}));
    EXPECT_EQ(nearest(grid.resolution, {0, -tiny, 0}), nearest(grid.resolution, {0, -1, 0}));
    EXPECT_EQ(nearest(grid.resolution, {tiny, tiny, -tiny}), nearest(grid.resolution, {1, 1, -1}));
  }
}

TEST(Lut, SignedZerosAreZeros) {
  for (const Grid& grid : kGrids)
    for (double x : {-1.0, 1.0})
      for (double z : {0.0, -0.0}) EXPECT_EQ(nearest(grid.resolution, {x, -0.0, z}), nearest(grid.resolution, {x, 0.0, 0.0}));
}

TEST(Lut, NoDirectionIsTheNorthPole) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Grid& grid : kGrids) {
    EXPECT_EQ(nearest(grid.resolution, {0, 0, 0}), 0u);
    EXPECT_EQ(nearest(grid.resolution, {-0.0, -0.0, -0.0}), 0u);
    EXPECT_EQ(nearest(grid.resolution, {nan, 1, -1}), 0u);
    EXPECT_EQ(nearest(grid.resolution, {0, -kInfinity, -1}), 0u);
  }
}

// ---- The octahedron

/// The coordinates (p, q) of the grid on a half of the octahedron, each from -1 to 1.
std::array<double, 2> on_grid(const Direction& d) {
  const double length = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
  return {(d[0] + d[1]) / length, (d[0] - d[1]) / length};
}

TEST(Octahedron, EveryDirectionLiesInItsCell) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (const std::uint32_t side : {1u, 2u, 3u, 16u, 44u}) {
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 40000; ++i) {
      const Direction d{draw(engine), draw(engine), draw(engine)};
      const std::uint32_t cell = octahedron_cell(side, d[0], d[1], d[2]);
      ASSERT_LT(cell, octahedron_cell_count(side));
      seen.insert(cell);
      const std::uint32_t lower = cell / (side * side), row = cell / side % side, column = cell % side;
      ASSERT_EQ(lower, d[2] < 0);
      const std::array<double, 2> at = on_grid(d);
      ASSERT_NEAR(at[0], (2 * column + 1.0) / side - 1, 1.0 / side + 1e-15);
      ASSERT_NEAR(at[1], (2 * row + 1.0) / side - 1, 1.0 / side + 1e-15);
      ASSERT_EQ(cell, octahedron_cell(side, d[0] * 0x1p-900, d[1] * 0x1p-900, d[2] * 0x1p-900));
    }
    if (side <= 16) {
      EXPECT_EQ(seen.size(), octahedron_cell_count(side));
    }
  }
}

TEST(Octahedron, MiddlesAreInTheirCellsAndNoDirectionIsInSomeCell) {
  for (const std::uint32_t side : {1u, 3u, 4u, 16u}) {
    for (std::uint32_t cell = 0; cell < octahedron_cell_count(side); ++cell) {
      const Direction d = octahedron_point(side, cell / (side * side), 2 * (cell % side) + 1, 2 * (cell / side % side) + 1);
      EXPECT_EQ(octahedron_cell(side, d[0], d[1], d[2]), cell);
      EXPECT_EQ(std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]), side);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_LT(octahedron_cell(side, 0, 0, 0), octahedron_cell_count(side));
    EXPECT_LT(octahedron_cell(side, nan, nan, nan), octahedron_cell_count(side));
    for (const Direction& d : {Direction{kInfinity, 0, 0},
                               {1, 1, 1},
                               {-1, -1, -1},
                               {5e-324, 0, 0},
                               {nan, 1, 0},
                               {0, 1, nan},
                               {-5, nan, 1},
                               {nan, -5, 1},
                               {1, -5, nan},
                               {-kInfinity, 1, nan}})
      EXPECT_LT(octahedron_cell(side, d[0], d[1], d[2]), octahedron_cell_count(side));
  }
}

TEST(DoubleBits, NeighboursAreThoseOfTheStandardLibrary) {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0x1p-1022, -0x1p-1022, least, -least, most, -most, kInfinity, -kInfinity}) {
    EXPECT_EQ(next_above(x), std::nextafter(x, kInfinity)) << x;
    EXPECT_EQ(next_below(x), std::nextafter(x, -kInfinity)) << x;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(next_above(nan)) && std::isnan(next_below(nan)));
}

}  // namespace
}  // namespace swiftlet::lut
