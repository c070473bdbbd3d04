// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How deep trees over triangles are, with whatever patches: the stacks of queries have room for `kMostDepth` nodes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "random.h"
#include "tree.h"
#include "weld.h"

namespace swiftlet {
namespace {

using shapes::Random;
using Patches = std::vector<std::uint32_t>;

/// The most nodes on a way from the root to a triangle, as tree.cpp argues: levels along patches, which may part next to
/// nothing; levels of cheapest cuts, up to the eighth; then equal ones.
int most_levels(std::size_t count, int along_patches) {
  for (int depth = 0;; ++depth) {
    if (count <= std::size_t(kFanOut)) return depth + 1;
    if (depth >= std::max(along_patches, 8)) {
      count = (count + 7) / 8;
    } else if (depth >= along_patches) {
      count = std::size_t(std::pow(7.0 / 8, 7) * double(count));
    } else {
      count -= kFanOut - 1;
    }
  }
}

Soup small_triangles(std::size_t count, const std::function<Vec(std::size_t)>& place) {
  Soup soup;
  for (std::size_t t = 0; t < count; ++t) {
    const Vec p = place(t);
    const auto v = std::uint32_t(soup.vertices.size());
    for (const Vec& side : {Vec{0, 0, 0}, Vec{0x1p-200, 0, 0}, Vec{0, 0x1p-200, 0}}) {
      soup.source.push_back(std::uint32_t(soup.vertices.size()));
      soup.vertices.push_back(p + side);
    }
    soup.triangles.push_back({v, v + 1, v + 2});
  }
  return soup;
}

int depth_of(const Soup& soup, const Patches& patches) {
  MeshParts parts;
  grow_tree(soup, patches, parts, [](double) { return true; });
  return parts.depth;
}

TEST(Tree, IsNoDeeperThanTheStacksOfQueriesWhateverItsPatchesAre) {
  // The largest mesh without patches, and with: 2^22 triangles.
  EXPECT_LE(most_levels(std::size_t(1) << 27, 0), kMostDepth);
  EXPECT_EQ(most_levels(std::size_t(1) << 22, 6), 6 + 2 + 7);
  EXPECT_LE(6 + 2 + 7, kMostDepth);

  Random random(23);
  int deepest = 0, deepest_plain = 0;
  for (const std::size_t count : {9u, 65u, 600u, 5000u, 40000u}) {
    const double n = double(count);
    const std::pair<const char*, std::function<Vec(std::size_t)>> places[] = {
        {"at one place",
         [](std::size_t) {
           return Vec{0, 0, 0};
         }},
        {"in a row",
         [&](std::size_t t) {
           return Vec{double(t) / n, 0, 0};
         }},
        {"ever denser",
         [&](std::size_t t) {
           return Vec{std::ldexp(1.0, -int(t % 50)), double(t / 50) / n * 0x1p-20, 0};
         }},
        {"scattered",
         [&](std::size_t) {
           return Vec{random.uniform(), random.uniform(), random.uniform()};
         }},
        // A cut in bins takes off the farthest one alone.
        {"one by one, the rest near",
         [](std::size_t t) {
           return Vec{t < 60 ? std::pow(17.0, -double(t)) : 0, 0, 0};
         }},
    };
    const std::pair<const char*, std::function<std::uint32_t(std::size_t)>> labels[] = {
        {"each its own", [](std::size_t t) { return std::uint32_t(t); }},
        {"two, of every other triangle", [](std::size_t t) { return std::uint32_t(t % 2); }},
        {"all but eight in one", [](std::size_t t) { return t < 8 ? kNone : 0; }},
        {"a few, then one of the rest", [](std::size_t t) { return std::uint32_t(std::min(t, std::size_t(60))); }},
        {"of nested boxes", [](std::size_t t) { return std::uint32_t(std::log2(double(t + 1))); }},
        {"in any place", [&](std::size_t) { return random.uniform() < 0.3 ? kNone : std::uint32_t(50 * random.uniform()); }},
    };
    for (const auto& [where, place] : places) {
      const Soup soup = small_triangles(count, place);
      const int plain = depth_of(soup, {});
      deepest_plain = std::max(deepest_plain, plain);
      EXPECT_LE(plain, most_levels(count, 0)) << count << " triangles " << where;
      for (const auto& [how, label] : labels) {
        Patches patches(count);
        for (std::size_t t = 0; t < count; ++t) patches[t] = label(t);
        const int depth = depth_of(soup, patches);
        deepest = std::max(deepest, depth);
        EXPECT_LE(depth, most_levels(count, 6)) << count << " triangles " << where << ", patches " << how;
      }
    }
  }
  EXPECT_GT(deepest, deepest_plain + 3) << "patches that do not get in the way test nothing";
}

}  // namespace
}  // namespace swiftlet
