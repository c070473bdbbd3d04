// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The command line tool, run as a user runs it, from a folder of each test's own that holds a model and a mesh file.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <swiftlet/model_file.h>

namespace swiftlet {

#ifdef SWIFTLET_TOOL_PATH
inline const std::string kTool = SWIFTLET_TOOL_PATH;
#else
inline const std::string kTool;  // a build without the tool
#endif
#if defined(SWIFTLET_TOOL_BUILDS) && SWIFTLET_TOOL_BUILDS
inline constexpr bool kBuilds = true;
#else
inline constexpr bool kBuilds = false;
#endif

using nlohmann::json;

struct Ran {
  int code = -1;
  std::string out, err;
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// An octahedron whose coordinates no short decimal holds, in a box.
inline Model two_levels() {
  const double x = 1.0 / 3, y = 2.0 / 7, z = std::sqrt(0.1);
  const std::vector<Vec3> inner{{x, 0, 0}, {-x, 0, 0}, {0, y, 0}, {0, -y, 0}, {0, 0, z}, {0, 0, -z}};
  const std::vector<std::uint32_t> inner_faces{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  std::vector<Vec3> outer;
  for (int i = 0; i < 8; ++i) outer.emplace_back(i & 1 ? 0.4 : -0.4, i & 2 ? 0.4 : -0.4, i & 4 ? 0.4 : -0.4);
  const std::vector<std::uint32_t> outer_faces{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  const std::vector<std::uint32_t> outer_sizes(6, 4);
  std::array<LevelArrays, 2> levels;
  levels[0].vertices = inner;
  levels[0].face_vertices = inner_faces;
  levels[1].vertices = outer;
  levels[1].face_vertices = outer_faces;
  levels[1].face_sizes = outer_sizes;
  Result<Model> model = Model::from_levels(levels);
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

class Tool : public testing::Test {
 protected:
  void SetUp() override {
    if (kTool.empty()) GTEST_SKIP() << "this build has no tool";
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("swiftlet_tool_" + std::to_string(getpid()) + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    ASSERT_TRUE(save(two_levels(), folder_ / "a.swl"));
    write(folder_ / "cube.off",
          "OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
          "4 0 4 6 2\n4 1 3 7 5\n4 0 1 5 4\n4 2 6 7 3\n4 0 2 3 1\n4 4 5 7 6\n");
    before_ = names();
  }
  void TearDown() override {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }

  /// In the test's own folder.
  Ran run(const std::string& arguments) const {
    const std::filesystem::path streams = folder_.string() + ".streams";
    std::filesystem::create_directories(streams);
    const std::string command = "cd '" + folder_.string() + "' && '" + kTool + "' " + arguments + " >'" +
                                (streams / "out").string() + "' 2>'" + (streams / "err").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    Ran ran{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(streams / "out"), content(streams / "err")};
    std::filesystem::remove_all(streams);
    return ran;
  }

  /// With the folder "disk" a file system of its own: 64 kB, 20 of them taken by the file "old", and then as `prepare` leaves
  /// it. Nothing where none may be mounted. The output begins with the names there afterwards.
  std::optional<Ran> run_on_disk(const std::string& prepare, const std::string& arguments) const {
    std::filesystem::create_directories(folder_ / "disk");
    const std::filesystem::path beside = folder_.string() + ".disk";
    std::filesystem::create_directories(beside);
    write(beside / "script", "mount -t tmpfs -o size=64k none disk && head -c 20000 /dev/zero >disk/old || exit\n" + prepare +
                                 "\n'" + kTool + "' " + arguments + " >'" + (beside / "said").string() + "' 2>'" +
                                 (beside / "err").string() + "' </dev/null; echo $? >'" + (beside / "code").string() +
                                 "'\n(ls disk; cmp -n 20000 disk/old /dev/zero; cat '" + (beside / "said").string() + "') >'" +
                                 (beside / "out").string() + "'\n");
    const std::string command = "cd '" + folder_.string() + "' && unshare --map-root-user --mount sh '" +
                                (beside / "script").string() + "' >/dev/null 2>&1";
    [[maybe_unused]] const int status = std::system(command.c_str());
    const std::string code = content(beside / "code");
    const Ran ran{code.empty() ? -1 : std::stoi(code), content(beside / "out"), content(beside / "err")};
    std::filesystem::remove_all(beside);
    std::filesystem::remove_all(folder_ / "disk");
    return code.empty() ? std::nullopt : std::optional(ran);
  }

  std::string says(const std::string& arguments) const {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 0) << arguments << "\n" << ran.err;
    EXPECT_EQ(ran.err, "") << arguments;
    return ran.out;
  }

  json says_json(const std::string& arguments) const {
    const json parsed = json::parse(says(arguments + " --json"), nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << arguments;
    return parsed;
  }

  /// Fails with one line that holds `why`, and leaves no file behind.
  void refuses(const std::string& arguments, const std::string& why, int code = 0) const {
    const Ran ran = run(arguments);
    EXPECT_GT(ran.code, 0) << arguments;
    EXPECT_TRUE(code == 0 || ran.code == code) << arguments << ": " << ran.code;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_TRUE(ran.err.starts_with("swiftlet: ")) << arguments << "\n" << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << arguments << "\n" << ran.err;
    EXPECT_TRUE(ran.err.ends_with("\n")) << arguments;
    EXPECT_NE(ran.err.find(why), std::string::npos) << arguments << "\n" << ran.err;
    EXPECT_EQ(names(), before_) << arguments;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) all.push_back(entry.path().filename());
    std::sort(all.begin(), all.end());
    return all;
  }

  std::filesystem::path folder_;
  std::vector<std::string> before_;
};

inline std::vector<Vec3> off_vertices(const std::string& text) {
  std::istringstream words(text);
  std::string magic, number;
  std::size_t vertices = 0, faces = 0, edges = 0;
  words >> magic >> vertices >> faces >> edges;
  std::vector<Vec3> points(vertices);
  for (Vec3& p : points) {
    for (int k = 0; k < 3; ++k) {
      words >> number;
      p[k] = std::strtod(number.c_str(), nullptr);
    }
  }
  return points;
}

}  // namespace swiftlet
