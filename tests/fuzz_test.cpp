// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every input that a fuzzer ever choked on, fuzz/found/TARGET/*, once more.
#include "fuzz.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <vector>

namespace swiftlet::fuzz {

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }  // not its bytes, which are addresses

namespace {

class Fuzz : public testing::TestWithParam<Target> {};

TEST_P(Fuzz, FoundInputsAreHarmless) {
  const std::filesystem::path folder = std::filesystem::path(SWIFTLET_TEST_DIR) / "fuzz/found" / GetParam().name;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "nothing found so far";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(GetParam().run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}), "") << entry.path();
  }
}

TEST_P(Fuzz, NothingAndZerosAreHarmless) {
  const std::vector<std::uint8_t> zeros(300);
  for (std::size_t size = 0; size <= zeros.size(); size += 1 + size / 4)
    EXPECT_EQ(GetParam().run({zeros.data(), size}), "") << size << " bytes";
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, testing::ValuesIn(kTargets), [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace swiftlet::fuzz
