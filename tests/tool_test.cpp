// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The command line tool, run as a user runs it: by its path, with its output, its one line of complaint and its exit code.
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
namespace {

#ifdef SWIFTLET_TOOL_PATH
const std::string kTool = SWIFTLET_TOOL_PATH;
#else
const std::string kTool;  // a build without the tool
#endif
#if defined(SWIFTLET_TOOL_BUILDS) && SWIFTLET_TOOL_BUILDS
constexpr bool kBuilds = true;
#else
constexpr bool kBuilds = false;
#endif

using nlohmann::json;

struct Ran {
  int code = -1;
  std::string out, err;
};

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// An octahedron whose coordinates no short decimal holds, in a box.
Model two_levels() {
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

std::vector<Vec3> off_vertices(const std::string& text) {
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

TEST_F(Tool, TellsItsVersionAndWords) {
  EXPECT_TRUE(says("--version").starts_with("swiftlet "));
  const std::string help = says("--help");
  for (const char* word : {"info", "verify", "distance", "export", "cut", "draw"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
  EXPECT_EQ(help.find("\n  build ") != std::string::npos, kBuilds);
}

TEST_F(Tool, HelpOfDistanceNamesTheFrame) {
  const std::string help = says("distance --help");
  EXPECT_NE(help.find("A's frame"), std::string::npos);
  EXPECT_NE(help.find("R p + t"), std::string::npos);
}

TEST_F(Tool, InfoListsTheLevelsFinestFirst) {
  const Result<Model> model = load(folder_ / "a.swl");
  ASSERT_TRUE(model);
  const json info = says_json("info a.swl");
  ASSERT_EQ(info["levels"].size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const Level& level = model.value().level(k);
    const json& row = info["levels"][std::size_t(k)];
    EXPECT_EQ(row["vertices"], level.view.vertices.size());
    EXPECT_EQ(row["faces"], level.view.face_first.size());
    EXPECT_EQ(row["triangles"], level.triangle_count);
    EXPECT_EQ(row["deviation"], level.deviation);
    EXPECT_EQ(row["bytes"], level.bytes);
    EXPECT_EQ(row["volume_ratio"], level.volume / model.value().volume());
  }
  EXPECT_EQ(info["bytes"], std::filesystem::file_size(folder_ / "a.swl"));
  EXPECT_EQ(info["dimension"], 3);
  EXPECT_EQ(info["radius"], model.value().radius());
  for (const char* key : {"hash", "box_min", "box_max", "table", "bytes_per_triangle"}) EXPECT_TRUE(info.contains(key)) << key;
  EXPECT_NE(says("info a.swl").find("deviation"), std::string::npos);
}

TEST_F(Tool, InfoAccountsForEveryByte) {
  const json info = says_json("info a.swl");
  std::size_t sum = 0;
  for (const char* part : {"header_bytes", "map_bytes", "table_bytes", "source_bytes"}) sum += info[part].get<std::size_t>();
  for (const json& level : info["levels"]) {
    EXPECT_GT(level["prefix"], level["bytes"]);
    sum += level["bytes"].get<std::size_t>();
  }
  EXPECT_EQ(sum, info["bytes"]);
}

TEST_F(Tool, CutLeavesTheFinestLevelsOut) {
  const json cut = says_json("cut a.swl -o b.swl --deviation 1e9");
  EXPECT_EQ(cut["finest_level"], 1);
  EXPECT_EQ(cut["bytes"], std::filesystem::file_size(folder_ / "b.swl"));
  EXPECT_EQ(says_json("cut a.swl -o c.swl --bytes " + says_json("info a.swl")["levels"][1]["prefix"].dump())["finest_level"],
            1);
  const json info = says_json("info b.swl");
  EXPECT_EQ(info["levels"][0]["prefix"], 0);
  EXPECT_NE(says("info b.swl").find("absent"), std::string::npos);
  const json answer = says_json("distance b.swl a.swl --pose 9,0,0");
  EXPECT_EQ(answer["status"], "LevelLimit");
  EXPECT_EQ(answer["level_a"], 1);
  EXPECT_EQ(answer["level_b"], 0);
  EXPECT_EQ(says_json("draw b.swl -o b.svg")["levels"], 2);
  EXPECT_EQ(says_json("cut a.swl -o whole.swl")["finest_level"], 0);
  EXPECT_EQ(content(folder_ / "whole.swl"), content(folder_ / "a.swl"));
  before_ = names();
  refuses("export b.swl --level 0 -o level.off", "finest is 1", 2);
  refuses("verify b.swl", "level 0 is not there", 1);
  refuses("cut a.swl -o d.swl --deviation -1", "--deviation", 2);
}

TEST_F(Tool, CutSalvagesWhatIsComplete) {
  const std::string whole = content(folder_ / "a.swl");
  write(folder_ / "short.swl", whole.substr(0, whole.size() - 1));
  before_ = names();
  refuses("info short.swl", "its header says", 1);
  refuses("cut short.swl -o left.swl", "its header says", 1);
  EXPECT_NE(says("cut short.swl -o left.swl --salvage").find("finer than 1 are missing"), std::string::npos);
  EXPECT_EQ(says_json("cut a.swl -o c.swl --deviation 1e9")["bytes"], std::filesystem::file_size(folder_ / "left.swl"));
  write(folder_ / "stump.swl", whole.substr(0, 500));
  before_ = names();
  refuses("cut stump.swl -o left.swl --salvage", "coarsest level needs", 1);
}

TEST_F(Tool, VerifyProvesAModel) {
  EXPECT_EQ(says_json("verify a.swl")["verified"], true);
  EXPECT_NE(says("verify a.swl").find("verified"), std::string::npos);
}

TEST_F(Tool, ExportReadsBackBitForBit) {
  const Result<Model> model = load(folder_ / "a.swl");
  ASSERT_TRUE(model);
  for (int k = 0; k < 2; ++k) {
    says("export a.swl --level " + std::to_string(k) + " -o level.off");
    const std::vector<Vec3> points = off_vertices(content(folder_ / "level.off"));
    const auto vertices = model.value().level(k).view.vertices;
    ASSERT_EQ(points.size(), vertices.size());
    for (std::size_t v = 0; v < points.size(); ++v)
      EXPECT_EQ(std::memcmp(points[v].data(), &vertices[v].x, 3 * sizeof(double)), 0) << v;
  }
  EXPECT_EQ(says_json("export a.swl --level 1 -o level.off")["level"], 1);
}

TEST_F(Tool, DrawWritesOnePanelPerLevel) {
  says("draw a.swl -o a.svg");
  const std::string svg = content(folder_ / "a.svg");
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("level 0"), std::string::npos);
  EXPECT_NE(svg.find("level 1"), std::string::npos);
  EXPECT_EQ(svg.find("level 2"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(says_json("draw a.swl -o a.svg")["levels"], 2);
}

TEST_F(Tool, DistanceAnswersInTheFrameOfA) {
  const json answer = says_json("distance a.swl a.swl --pose 2,0,0");
  const double truth = 2 - 2.0 / 3;
  EXPECT_LE(answer["lower"].get<double>(), truth);
  EXPECT_GE(answer["upper"].get<double>(), truth);
  EXPECT_NEAR(answer["normal"][0].get<double>(), 1, 1e-12);
  EXPECT_NEAR(answer["point_a"][0].get<double>(), 1.0 / 3, 1e-12);
  EXPECT_NEAR(answer["point_b"][0].get<double>(), 2 - 1.0 / 3, 1e-12);
  EXPECT_EQ(answer["verdict"], "Disjoint");
  EXPECT_EQ(answer["status"], "Converged");
  EXPECT_EQ(answer["feature_a"]["vertices"], json::array({0}));
  EXPECT_EQ(answer["feature_b"]["vertices"], json::array({1}));
  EXPECT_NE(says("distance a.swl a.swl --pose 2,0,0").find("normal"), std::string::npos);
}

TEST_F(Tool, DistanceProvesAnOverlapByVertices) {
  const json answer = says_json("distance a.swl a.swl --pose 0.1,0,0");
  EXPECT_EQ(answer["verdict"], "Overlapping");
  EXPECT_TRUE(answer["normal"].is_null());
  EXPECT_GT(answer["proof"]["vertices_a"].size(), 0u);
  EXPECT_EQ(answer["proof"]["vertices_a"].size(), answer["proof"]["vertices_b"].size());
  const std::string text = says("distance a.swl a.swl --pose 0.1,0,0");
  EXPECT_NE(text.find("normal     none"), std::string::npos);
  EXPECT_NE(text.find("hold the origin"), std::string::npos);
}

TEST_F(Tool, LevelsRefineFromTheCoarsestToTheAnswer) {
  const json answer = says_json("distance a.swl a.swl --pose 2,0.5,0.25 --levels");
  const json& levels = answer["levels"];
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0]["level_a"], 1);
  EXPECT_EQ(levels[1]["level_a"], 0);
  EXPECT_LE(levels[0]["lower"], levels[1]["lower"]);
  EXPECT_GE(levels[0]["upper"], levels[1]["upper"]);
  EXPECT_EQ(levels[1]["lower"], answer["lower"]);
  EXPECT_EQ(levels[1]["upper"], answer["upper"]);
  for (const json& line : levels) EXPECT_GT(line["nanoseconds"].get<double>(), 0);
  EXPECT_EQ(says_json("distance a.swl a.swl --pose 2,0.5,0.25 --levels --max-error 1e3")["levels"].size(), 1u);
  EXPECT_EQ(says_json("distance a.swl a.swl --pose 2,0.5,0.25 --relative-error 1e3")["level_a"], 1);
  EXPECT_EQ(says_json("distance a.swl a.swl --pose 2,0.5,0.25 --beyond 0.1")["status"], "Beyond");
}

TEST_F(Tool, PosesInAllThreeFormsAgree) {
  write(folder_ / "shift", "1 0 0 2\n0 1 0 -0.5\n0 0 1 0.25\n");
  const json shift = says_json("distance a.swl a.swl --pose 2,-0.5,0.25");
  EXPECT_EQ(shift, says_json("distance a.swl a.swl --pose 2,-0.5,0.25,1,0,0,0"));
  EXPECT_EQ(shift, says_json("distance a.swl a.swl --pose 2,-0.5,0.25,-3,0,0,0"));
  EXPECT_EQ(shift, says_json("distance a.swl a.swl --pose shift"));
  EXPECT_EQ(says_json("distance a.swl a.swl --pose -2,0.5,0.25")["b_in_a"][0][3], -2.0);

  write(folder_ / "turn", "0, -1, 0, 2\n1, 0, 0, -0.5\n0, 0, 1, 0.25\n");  // x becomes y
  const json typed = says_json("distance a.swl a.swl --pose 2,-0.5,0.25,7,0,0,7"),
             filed = says_json("distance a.swl a.swl --pose turn");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_NEAR(typed["b_in_a"][row][column].get<double>(), filed["b_in_a"][row][column].get<double>(), 1e-15);
  EXPECT_NEAR(typed["lower"].get<double>(), filed["lower"].get<double>(), 1e-13);
}

TEST_F(Tool, RefusesBadPosesInOneLine) {
  write(folder_ / "sheared", "1 0 0 0\n0 1 0.01 0\n0 0 1 0\n");
  write(folder_ / "mirror", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n");
  write(folder_ / "short", "1 0 0 0\n0 1 0 0\n");
  write(folder_ / "words", "one two three\n");
  write(folder_ / "far", "1 0 0 1e46\n0 1 0 0\n0 0 1 0\n");
  write(folder_ / "tiny", "1 0 0 1e-400\n0 1 0 0\n0 0 1 0\n");
  before_ = names();
  const auto bad = [&](const std::string& pose, const std::string& why) {
    refuses("distance a.swl a.swl --pose " + pose, why, 2);
  };
  bad("1,2", "2 numbers");
  bad("1,2,3,4", "4 numbers");
  bad("1,nan,3", "not finite");
  bad("1,2,3,inf,0,0,0", "not finite");
  bad("1,2,3,0,0,0,0", "zero quaternion");
  bad("1,2,x", "neither");
  bad("sheared", "off by 0.01");
  bad("mirror", "mirror image");
  bad("short", "8 numbers");
  bad("words", "no number");
  bad("nowhere", "neither");
  bad("1e46,0,0", "translates by more than 1e+45");
  bad("0,0,-2e45,1,0,0,0", "translates by more than 1e+45");
  bad("far", "translates by more than 1e+45");
  bad("0,1e-400,0", "1e-400, which is beyond the range of doubles");
  bad("0,1e400,0", "1e400, which is beyond the range of doubles");
  bad("tiny", "1e-400, which is beyond the range of doubles");
}

TEST_F(Tool, RefusesWhatIsWrongInOneLine) {
  write(folder_ / "damaged.swl", content(folder_ / "a.swl").substr(0, 500));
  std::filesystem::create_symlink("a.swl", folder_ / "link");
  before_ = names();
  refuses("", "say a word");
  refuses("fly", "no word \"fly\"");
  refuses("--fly", "no word");
  refuses("info", "required");
  refuses("info a.swl --fly", "--fly");
  refuses("info nowhere.swl", "nowhere.swl");
  refuses("info damaged.swl", "damaged.swl");
  refuses("verify damaged.swl", "damaged.swl");
  refuses("distance a.swl damaged.swl --pose 1,2,3", "damaged.swl");
  refuses("distance a.swl a.swl", "--pose");
  refuses("distance a.swl a.swl --pose 1,2,3 --max-error -1", "-1");
  refuses("distance a.swl a.swl --pose 1,2,3 --max-error nan", "nan");
  refuses("distance a.swl a.swl --pose 1,2,3 --max-error 1 --relative-error 1", "excludes");
  refuses("export a.swl --level 2 -o e.off", "no level 2");
  refuses("export a.swl --level -1 -o e.off", "no level -1");
  refuses("export a.swl --level 0 -o nowhere/e.off", "folder");
  refuses("export a.swl --level 0 -o link", "link");
  refuses("draw a.swl -o .", "folder");
}

TEST_F(Tool, AnOptionOutOfItsRangeIsExitCodeTwo) {
  for (const char* option : {"--max-error -1", "--relative-error -1e-3", "--beyond -1", "--max-error nan"})
    refuses(std::string("distance a.swl a.swl --pose 1,2,3 ") + option, "no number from 0 up", 2);
  refuses("export a.swl --level 2 -o e.off", "no level 2", 2);
  refuses("export a.swl --level -1 -o e.off", "no level -1", 2);
  if (!kBuilds) return;
  for (const char* option :
       {"--rate 0", "--rate 1", "--rate nan", "--levels 0", "--levels 33", "--cutoff -3", "--max-deviation -1",
        "--max-deviation inf", "--radius-factor 0.5", "--radius-factor 1e7", "--table 3"}) {
    const std::string name(option, std::strchr(option, ' '));
    refuses(std::string("build cube.off -o c.swl ") + option, name, 2);
  }
  refuses("info nowhere.swl", "nowhere.swl", 1);
}

TEST_F(Tool, KeepsTheOldFileWhenItFails) {
  write(folder_ / "kept.off", "old");
  before_ = names();
  refuses("export a.swl --level 7 -o kept.off", "no level 7");
  EXPECT_EQ(content(folder_ / "kept.off"), "old");
  says("export a.swl --level 0 -o kept.off");
  EXPECT_TRUE(content(folder_ / "kept.off").starts_with("OFF"));
  EXPECT_EQ(names(), before_);
}

/// The words that write, each to a path that is to follow.
std::vector<std::string> writing_words() {
  std::vector<std::string> words{"cut a.swl -o ", "export a.swl --level 0 -o ", "draw a.swl -o "};
  if (kBuilds) words.insert(words.end(), {"build cube.off --quiet -o ", "build --mesh cube.off --quiet -o "});
  return words;
}

TEST_F(Tool, OnAFullDiskTheFileIsWholeOrAbsent) {
  for (const std::string& word : writing_words()) {
    for (const std::string name : {"new", "old"}) {
      const auto full = run_on_disk("head -c 100000 /dev/zero >disk/filler 2>/dev/null", word + "disk/" + name);
      if (!full) GTEST_SKIP() << "no file system may be mounted here";
      EXPECT_EQ(full->code, 1) << word;
      EXPECT_EQ(full->out, "filler\nold\n") << word;
      EXPECT_TRUE(full->err.starts_with("swiftlet: disk/" + name + ": cannot write ")) << full->err;
      EXPECT_EQ(std::count(full->err.begin(), full->err.end(), '\n'), 1) << full->err;
    }
    const auto roomy = run_on_disk(":", word + "disk/new");
    EXPECT_EQ(roomy->code, 0) << word << roomy->err;
    EXPECT_TRUE(roomy->out.starts_with("new\nold\n")) << roomy->out;
  }
}

TEST_F(Tool, AFolderThatMayNotBeWrittenIsNamed) {
  for (const std::string& word : writing_words()) {
    for (const std::string name : {"new", "old"}) {
      const auto ran = run_on_disk("mount -o remount,ro disk", word + "disk/" + name);
      if (!ran) GTEST_SKIP() << "no file system may be mounted here";
      EXPECT_EQ(ran->code, 1) << word;
      EXPECT_EQ(ran->out, "old\n") << word;
      EXPECT_TRUE(ran->err.starts_with("swiftlet: disk/" + name + ": cannot write ")) << ran->err;
      EXPECT_EQ(std::count(ran->err.begin(), ran->err.end(), '\n'), 1) << ran->err;
    }
  }
}

TEST_F(Tool, TextThatCannotBeWrittenNamesTheCause) {
  const auto full = run_on_disk("head -c 100000 /dev/zero >disk/filler 2>/dev/null", "export a.swl --level 0 -o disk/new");
  const auto readonly = run_on_disk("mount -o remount,ro disk", "export a.swl --level 0 -o disk/new");
  if (!full) GTEST_SKIP() << "no file system may be mounted here";
  EXPECT_TRUE(full->err.ends_with(": No space left on device\n")) << full->err;
  EXPECT_TRUE(readonly->err.ends_with(": Read-only file system\n")) << readonly->err;
}

TEST_F(Tool, ReadsFromAFolderThatMayNotBeWritten) {
  const auto info = run_on_disk("cp a.swl disk/b.swl; mount -o remount,ro disk", "info disk/b.swl");
  if (!info) GTEST_SKIP() << "no file system may be mounted here";
  EXPECT_EQ(info->code, 0) << info->err;
  EXPECT_NE(info->out.find("disk/b.swl"), std::string::npos) << info->out;
}

TEST_F(Tool, TakesPathsWithSpacesAndUmlauts) {
  const std::string odd = "\u00e4 \u00f6/\u00fc \u00df", quoted = "'" + odd;  // "ä ö/ü ß"
  std::filesystem::create_directories(folder_ / std::filesystem::path(odd).parent_path());
  std::filesystem::copy(folder_ / "a.swl", folder_ / (odd + ".swl"));
  EXPECT_EQ(says_json("info " + quoted + ".swl'")["path"], odd + ".swl");
  says("verify " + quoted + ".swl'");
  EXPECT_EQ(says("distance " + quoted + ".swl' a.swl --pose 3,0,0"), says("distance a.swl " + quoted + ".swl' --pose 3,0,0"));
  says("cut " + quoted + ".swl' --deviation 1e9 -o " + quoted + " cut.swl'");
  says("export " + quoted + ".swl' --level 0 -o " + quoted + ".off'");
  EXPECT_EQ(says_json("draw " + quoted + ".swl' -o " + quoted + ".svg'")["path"], odd + ".svg");
  for (const char* made : {" cut.swl", ".off", ".svg"}) EXPECT_TRUE(std::filesystem::exists(folder_ / (odd + made))) << made;
  before_ = names();
  refuses("info " + quoted + ".none'", odd + ".none");
  if (!kBuilds) return;
  EXPECT_EQ(says_json("build " + quoted + ".off' -o " + quoted + " built.swl'")["path"], odd + " built.swl");
  says("verify " + quoted + " built.swl'");
}

TEST_F(Tool, RefusesToWriteOntoItsInput) {
  std::filesystem::create_hard_link(folder_ / "a.swl", folder_ / "hard.swl");
  std::filesystem::create_symlink("a.swl", folder_ / "soft.swl");
  std::filesystem::create_directory_symlink(".", folder_ / "here");
  std::filesystem::create_symlink("a.swl", folder_ / "b.off");
  before_ = names();
  const std::string old = content(folder_ / "a.swl");
  const auto refuses_onto = [&](const std::string& word, const std::string& in, const std::string& out) {
    refuses(word + " " + in + " -o " + out, out + ": is the input itself", 1);
    EXPECT_EQ(content(folder_ / "a.swl"), old);
  };
  for (const char* word : {"cut", "draw", "export --level 0"}) {
    for (const char* out : {"a.swl", "./a.swl", "hard.swl", "soft.swl", "here/a.swl"}) {
      refuses_onto(word, "a.swl", out);
      refuses_onto(word, "soft.swl", out);
    }
  }
  write(folder_ / "damaged.swl", "nothing of the kind");
  before_ = names();
  refuses_onto("cut", "damaged.swl", "damaged.swl");  // before it is opened
  if (!kBuilds) return;
  refuses_onto("build", "cube.off", "here/cube.off");
  refuses_onto("draw", "cube.off", "./cube.off");
}

TEST_F(Tool, ErrorsAreJsonWhereJsonIsAsked) {
  write(folder_ / "damaged.swl", content(folder_ / "a.swl").substr(0, 500));
  write(folder_ / "bent.off", "OFF\n1 0 0\n0 0\n");
  before_ = names();
  const auto fails = [&](const std::string& arguments, int code, const std::string& kind, const json& file) {
    const Ran plain = run(arguments), ran = run(arguments + " --json");
    EXPECT_EQ(plain.code, code) << arguments;
    EXPECT_EQ(ran.code, code) << arguments;
    EXPECT_EQ(ran.err, "") << arguments;
    const json parsed = json::parse(ran.out, nullptr, false);
    ASSERT_TRUE(parsed.is_object() && parsed.size() == 1 && parsed["error"].size() == 3) << arguments << ran.out;
    EXPECT_EQ(parsed["error"]["code"], kind) << arguments;
    EXPECT_EQ(parsed["error"]["file"], file) << arguments;
    EXPECT_EQ(plain.err, "swiftlet: " + parsed["error"]["message"].get<std::string>() + "\n") << arguments;
    EXPECT_EQ(names(), before_) << arguments;
  };
  fails("fly", 2, "BadValue", nullptr);
  for (const char* word :
       {"info", "verify", "distance --pose 1,2,3 a.swl", "cut -o b.swl", "draw -o b.svg", "export --level 0 -o b.off"}) {
    const std::string begin = word;
    fails(begin, 2, "BadValue", nullptr);
    fails(begin + " nowhere.swl --fly", 2, "BadValue", nullptr);
    fails(begin + " nowhere.swl", 1, "CannotRead", "nowhere.swl");
    fails(begin + " damaged.swl", 1, "BadFormat", "damaged.swl");
    if (kBuilds && !begin.starts_with("cut")) fails(begin + " bent.off", 1, "BadFormat", "bent.off");
    if (begin.find("-o") != std::string::npos)
      fails(begin.substr(0, begin.find("-o")) + "a.swl -o nowhere/b", 1, "CannotWrite", "nowhere/b");
  }
  fails("distance a.swl a.swl --pose 1,2", 2, "BadValue", nullptr);
  fails("distance a.swl a.swl --pose 1,2,3 --max-error -1", 2, "BadValue", nullptr);
  fails("export a.swl --level 7 -o b.off", 2, "BadValue", nullptr);
  if (!kBuilds) {
    fails("build cube.off -o b.swl", 2, "BadValue", nullptr);
    return fails("info cube.off", 1, "BadFormat", "cube.off");
  }
  fails("build -o b.swl bent.off", 1, "BadFormat", "bent.off");
  fails("build -o b.swl bent.off --map x", 2, "BadValue", nullptr);
  fails("build -o b.swl cube.off --map 65", 1, "BadValue", "cube.off");
  fails("build -o b.swl nowhere.off", 1, "CannotRead", "nowhere.off");
}

TEST_F(Tool, WithoutTheBuilderAMeshIsAClearError) {
  if (kBuilds) GTEST_SKIP() << "this tool has the builder";
  refuses("build cube.off -o c.swl", "without the builder");
  refuses("info cube.off", "without the builder");
  refuses("distance a.swl cube.off --pose 1,2,3", "without the builder");
}

TEST_F(Tool, BuildsAModelAndTellsWhatItDid) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  const std::string report =
      says("build cube.off -o c.swl --method peel --enclosing scale --table 22.5 --radius-factor 3 --levels 1");
  EXPECT_NE(report.find("8 points, 12 triangles"), std::string::npos) << report;
  EXPECT_NE(report.find("ended"), std::string::npos) << report;
  const json info = says_json("info c.swl");
  EXPECT_EQ(info["table"]["entries"], 114);
  EXPECT_EQ(info["table"]["radius_factor"], 3.0);
  EXPECT_EQ(info["levels"][0]["faces"], 6);
  EXPECT_EQ(says("build cube.off -o c.swl --quiet"), "");
  EXPECT_EQ(says_json("build cube.off -o c.swl --deviation 9 --bytes 100")["finest_level"], 0) << "a cube has one level";
  EXPECT_EQ(says_json("build cube.off -o c.swl")["points_read"], 8);
  EXPECT_EQ(says_json("info c.swl")["levels"], says_json("info cube.off")["levels"]);
}

TEST_F(Tool, TakesMeshesForModels) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  const json answer = says_json("distance cube.off a.swl --pose 3,0.5,0.5");
  EXPECT_NEAR(answer["lower"].get<double>(), 2 - 1.0 / 3, 1e-12);
  EXPECT_EQ(answer["feature_a"]["kind"], "face");
  EXPECT_EQ(answer["feature_a"]["triangles"], json::array({2, 3}));
  says("draw cube.off -o cube.svg");
  says("export cube.off --level 0 -o again.off");
  EXPECT_EQ(says_json("info again.off")["levels"][0]["faces"], 6);
}

TEST_F(Tool, BuildRefusesWhatIsWrongInOneLine) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write(folder_ / "empty.off", "OFF\n0 0 0\n");
  write(folder_ / "damaged.off", "OFF\n3 1 0\n0 0\n");
  before_ = names();
  refuses("build cube.off", "output");
  refuses("build nowhere.off -o c.swl", "nowhere.off");
  refuses("build empty.off -o c.swl", "empty.off");
  refuses("build damaged.off -o c.swl", "damaged.off");
  refuses("build flat.off -o c.swl --require-solid", "plane");
  refuses("build cube.off -o nowhere/c.swl", "folder");
  refuses("build cube.off -o c.swl --method melt", "melt is none of peel|collapse");
  refuses("build cube.off -o c.swl --table 3", "none|22.5|11.25|5.625");
  refuses("build cube.off -o c.swl --rate 2", "rate");
  refuses("build cube.off -o c.swl --levels 99", "--levels");
  refuses("build cube.off -o c.swl --cutoff -3", "--cutoff");
}

/// A square of two triangles in z = 0, where point 4 is point 0 again; half of the square cut the other way and upside down; a
/// flat triangle; and the first one again. Point 7 is no triangle's.
constexpr const char* kSheet =
    "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0\n5 5 5\n6 5 5\n7 7 7\n3 0 1 2\n3 4 2 3\n3 1 0 3\n3 5 6 5\n3 2 0 1\n";

TEST_F(Tool, BuildMeshKeepsAllTrianglesAndTellsWhatTheyAre) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "sheet.off", kSheet);
  const json built = says_json("build --mesh sheet.off -o sheet.swm");
  EXPECT_EQ(built["path"], "sheet.swm");
  EXPECT_EQ(built["mesh"], "sheet.off");
  EXPECT_EQ(built["points_read"], 8);
  EXPECT_EQ(built["triangles_read"], 5);
  EXPECT_EQ(built["vertices"], 6) << "4 is 0, and 7 is of no triangle";
  EXPECT_EQ(built["triangles"], 5);
  EXPECT_EQ(built["topology"]["flat_triangles"], 1);
  EXPECT_EQ(built["topology"]["duplicates"], 1);
  EXPECT_EQ(built["topology"]["components"], 2);
  EXPECT_GT(built["topology"]["open_edges"], 0);
  EXPECT_GT(built["topology"]["non_manifold_edges"], 0);
  EXPECT_EQ(built["topology"]["closed"], false);
  EXPECT_TRUE(built["topology"]["volume"].is_null());
  EXPECT_EQ(built["bytes"], std::filesystem::file_size(folder_ / "sheet.swm"));
  EXPECT_EQ(built["bytes_per_triangle"].get<double>(), built["bytes"].get<double>() / 5);
  for (const char* key : {"seconds_read", "seconds_built"}) EXPECT_GE(built[key].get<double>(), 0) << key;

  const std::string report = says("build --mesh cube.off -o cube.swm");
  for (const char* line : {"8 points, 12 triangles", "components 1", "0 open", "volume     ", "wrote      cube.swm"})
    EXPECT_NE(report.find(line), std::string::npos) << line << "\n" << report;
  EXPECT_EQ(report.find("not closed"), std::string::npos) << report;
  EXPECT_EQ(says("build --mesh cube.off -o cube.swm --quiet"), "");
  EXPECT_EQ(content(folder_ / "cube.swm"), (says("build --mesh cube.off -o again.swm"), content(folder_ / "again.swm")));
}

TEST_F(Tool, InfoAndVerifyTakeMeshes) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "inside_out.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n");
  json built = says_json("build --mesh inside_out.off -o solid.swm"), info = says_json("info solid.swm");
  EXPECT_EQ(info["topology"]["closed"], true);
  EXPECT_NEAR(info["topology"]["volume"].get<double>(), -1.0 / 6, 1e-15);
  EXPECT_NE(says("info solid.swm").find("inside out"), std::string::npos);
  for (const char* key : {"path", "mesh", "points_read", "triangles_read", "seconds_read", "seconds_built"}) built.erase(key);
  EXPECT_EQ(info["path"], "solid.swm");
  info.erase("path");
  EXPECT_EQ(info, built);
  EXPECT_EQ(says_json("verify solid.swm")["verified"], true);
  EXPECT_EQ(says_json("verify solid.swm")["triangles"], 4);
  EXPECT_NE(says("verify solid.swm").find("verified"), std::string::npos);
  std::filesystem::copy(folder_ / "solid.swm", folder_ / "solid");  // by what it is, not by its name
  EXPECT_EQ(says_json("info solid")["hash"], info["hash"]);
}

TEST_F(Tool, DistanceTakesMeshesAndModelsInAnyMix) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "sheet.off", kSheet);
  says("build --mesh sheet.off -o sheet.swm");
  says("build --mesh cube.off -o cube.swm");
  const double truth = 0.5 - std::sqrt(0.1);  // above the middle of the second triangle, by the octahedron's lowest vertex
  const json down = says_json("distance sheet.swm a.swl --pose 0.25,0.6,0.5"),
             up = says_json("distance a.swl sheet.swm --pose -0.25,-0.6,-0.5");
  for (const json& answer : {down, up}) {
    EXPECT_LE(answer["lower"].get<double>(), truth);
    EXPECT_GE(answer["upper"].get<double>(), truth);
    EXPECT_LE(answer["upper"].get<double>() - answer["lower"].get<double>(), 1e-13);
    EXPECT_EQ(answer["verdict"], "Disjoint");
    EXPECT_EQ(answer["status"], "Converged");
    EXPECT_FALSE(answer.contains("proof"));
  }
  EXPECT_EQ(down["feature_a"]["kind"], "face");
  EXPECT_EQ(down["feature_b"]["vertices"], json::array({5}));
  EXPECT_EQ(up["feature_a"]["vertices"], json::array({5}));
  for (const json& face : {down["feature_a"], up["feature_b"]}) {
    EXPECT_EQ(face["triangles"].size(), 1u);
    EXPECT_TRUE(face["triangles"] == json::array({1}) || face["triangles"] == json::array({2})) << face << ": both are there";
  }
  EXPECT_NEAR(down["normal"][2].get<double>(), 1, 1e-12);
  EXPECT_NEAR(down["point_a"][0].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(up["normal"][2].get<double>(), -1, 1e-12);

  const json inside = says_json("distance cube.swm a.swl --pose 0.5,0.5,0.5");
  EXPECT_NEAR(inside["lower"].get<double>(), 0.5 - 1.0 / 3, 1e-12) << "surfaces alone are bodies";
  EXPECT_EQ(says_json("distance cube.off a.swl --pose 0.5,0.5,0.5")["verdict"], "Overlapping") << "a mesh file is its hull";
  const json crossing = says_json("distance cube.swm cube.swm --pose 0.5,0.5,0.5");
  EXPECT_EQ(crossing["verdict"], "Overlapping");
  EXPECT_EQ(crossing["upper"], 0);
  EXPECT_EQ(crossing["feature_a"]["triangles"].size(), 1u);
  EXPECT_TRUE(crossing["normal"].is_null());

  const json apart = says_json("distance cube.swm cube.swm --pose 3,3,0.25");
  EXPECT_NEAR(apart["lower"].get<double>(), std::sqrt(8.0), 1e-12);
  const std::string text = says("distance cube.swm cube.swm --pose 3,3,0.25");
  for (const char* line : {"distance   [2.828", "normal     0.70", "verdict    Disjoint", "status     Converged"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  EXPECT_EQ(text.find("level"), std::string::npos) << text;
  const json far = says_json("distance cube.swm cube.swm --pose 9,0,0 --beyond 1");
  EXPECT_EQ(far["status"], "Beyond");
  EXPECT_GT(far["lower"], 1);
  EXPECT_LE(far["lower"], 8);
  EXPECT_TRUE(says_json("distance cube.swm cube.swm --pose 3,3,0.25 --beyond 9")["feature_a"].contains("vertices"));
  for (const char* error : {" --max-error 0.3", " --relative-error 0.1"}) {
    const json rough = says_json(std::string("distance cube.swm cube.off --pose 3,3,0.25") + error);
    EXPECT_LE(rough["lower"].get<double>(), std::sqrt(8.0)) << error;
    EXPECT_GE(rough["upper"].get<double>(), std::sqrt(8.0)) << error;
    EXPECT_LE(rough["upper"].get<double>() - rough["lower"].get<double>(), 0.3) << error;
  }
}

TEST_F(Tool, DrawShowsEveryTriangleOfAMesh) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "sheet.off", kSheet);
  says("build --mesh sheet.off -o sheet.swm");
  const json drawn = says_json("draw sheet.swm -o sheet.svg");
  const std::string svg = content(folder_ / "sheet.svg");
  EXPECT_EQ(drawn["triangles"], 5);
  EXPECT_EQ(drawn["bytes"], svg.size());
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  std::size_t paths = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++paths;
  EXPECT_EQ(paths, 5u) << "a flat one too";
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("not closed"), std::string::npos);
}

TEST_F(Tool, WhatMeshesHaveNotIsRefusedInOneLine) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  write(folder_ / "cloud.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n");
  write(folder_ / "far.off", "OFF\n3 1 0\n0 0 0\n1e50 0 0\n0 1 0\n3 0 1 2\n");
  write(folder_ / "bent.off", "OFF\n1 0 0\n0 0\n");
  says("build --mesh cube.off -o cube.swm");
  const std::string whole = content(folder_ / "cube.swm");
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  write(folder_ / "changed.swm", changed);
  write(folder_ / "short.swm", whole.substr(0, whole.size() - 1));
  write(folder_ / "alien.swm", content(folder_ / "a.swl"));
  before_ = names();
  refuses("build --mesh cloud.off -o c.swm", "cloud.off: is a cloud of points without triangles", 1);
  refuses("build --mesh far.off -o c.swm", "far.off: point 1 ", 1);
  refuses("build --mesh bent.off -o c.swm", "bent.off: line 3", 1);
  refuses("build --mesh nowhere.off -o c.swm", "nowhere.off", 1);
  refuses("build --mesh cube.off -o nowhere/c.swm", "folder", 1);
  refuses("build --mesh cube.off -o cube.off", "is the input itself", 1);
  for (const char* option : {"--method peel", "--cutoff 8", "--map 1", "--bytes 9", "--require-solid", "--threads 2"})
    refuses(std::string("build --mesh cube.off -o c.swm ") + option, "is not for --mesh", 2);
  for (const char* name : {"changed.swm", "short.swm", "alien.swm", "nowhere.swm"}) {
    for (const std::string word : {"info ", "verify ", "distance --pose 1,2,3 a.swl "}) refuses(word + name, name, 1);
  }
  refuses("distance cube.swm a.swl --pose 1,2,3 --levels", "cube.swm: is a mesh, which has no levels", 2);
  refuses("distance a.swl cube.swm --pose 1,2,3 --levels", "cube.swm: is a mesh, which has no levels", 2);
  for (const char* word : {"cut", "cut --salvage", "export"})
    refuses(std::string(word) + " cube.swm -o c", "cube.swm: is a mesh, which has no levels", 1);
  const json error = json::parse(run("build --mesh cloud.off -o c.swm --json").out, nullptr, false);
  EXPECT_EQ(error["error"]["code"], "Empty");
  EXPECT_EQ(error["error"]["file"], "cloud.off");
}

TEST_F(Tool, MeshesOfScansAndLinksAreBuiltAndAsked) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  std::filesystem::path mesh = folder_ / "bumps.off";
#ifdef SWIFTLET_MESHES
  if (const std::filesystem::path elephant = SWIFTLET_MESHES "/elephant.off"; std::filesystem::exists(elephant))
    mesh = elephant;
#endif
  if (mesh.parent_path() == folder_) {  // a surface over a grid
    constexpr int kSide = 40;
    std::ostringstream off;
    off << "OFF\n" << kSide * kSide << ' ' << 2 * (kSide - 1) * (kSide - 1) << " 0\n";
    for (int i = 0; i < kSide * kSide; ++i)
      off << i % kSide << ' ' << i / kSide << ' ' << std::sin(0.7 * (i % kSide)) * std::sin(0.9 * (i / kSide)) << '\n';
    for (int i = 0; i < kSide * (kSide - 1); ++i) {
      if (i % kSide == kSide - 1) continue;
      off << "3 " << i << ' ' << i + 1 << ' ' << i + kSide << "\n3 " << i + 1 << ' ' << i + kSide + 1 << ' ' << i + kSide
          << '\n';
    }
    write(mesh, off.str());
  }
  const json built = says_json("build --mesh '" + mesh.string() + "' -o mesh.swm");
  EXPECT_EQ(built["triangles"], built["triangles_read"]);
  EXPECT_EQ(built["topology"]["components"], 1);
  EXPECT_LT(built["bytes_per_triangle"], 120);
  says("verify mesh.swm");
  says("build '" + mesh.string() + "' -o hull.swl");
  const json extent = says_json("info hull.swl");
  const double far = 3 * extent["radius"].get<double>();
  const std::string pose = " --pose " + std::to_string(far) + ",0,0";
  const json meshes = says_json("distance mesh.swm mesh.swm" + pose), hulls = says_json("distance hull.swl hull.swl" + pose);
  EXPECT_GE(meshes["upper"].get<double>(), hulls["lower"].get<double>()) << "a mesh lies in its hull";
  const json mixed = says_json("distance mesh.swm hull.swl" + pose);
  EXPECT_GE(mixed["upper"].get<double>(), hulls["lower"].get<double>());
  EXPECT_LE(mixed["lower"].get<double>(), meshes["upper"].get<double>());
}

}  // namespace
}  // namespace swiftlet
