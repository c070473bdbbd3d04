// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The command line tool, run as a user runs it: by its path, with its output, its one line of complaint and its exit code.
#include "tool_runs.h"

#include <fcntl.h>
#include <sys/stat.h>

namespace swiftlet {
namespace {

TEST_F(Tool, TellsItsVersionAndWords) {
  EXPECT_TRUE(says("--version").starts_with("swiftlet "));
  const std::string help = says("--help");
  for (const char* word : {"info", "verify", "distance", "export", "cut", "draw"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
  EXPECT_EQ(help.find("\n  build ") != std::string::npos, kBuilds);
}

TEST_F(Tool, OutputThatCannotBeWrittenIsAFailure) {
  for (const std::string arguments : {"--help", "--version", "info --help", "info a.swl"}) {
    EXPECT_EQ(run(arguments + " >/dev/full 2>err; echo $?").out, "1\n") << arguments;
    EXPECT_EQ(content(folder_ / "err"), "swiftlet: cannot write to standard output\n") << arguments;
  }
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
  EXPECT_EQ(info["levels"][0]["prefix"], info["bytes"]) << "the table and the source map belong to level 0";
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
  EXPECT_EQ(says_json("draw b.swl -o b.svg")["levels"], 1) << "those that are there";
  EXPECT_NE(says("draw b.swl -o b.svg").find("b.svg: 1 level, "), std::string::npos);
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
  const Ran salvaged = run("cut short.swl -o left.swl --salvage");
  EXPECT_EQ(salvaged.code, 0);
  EXPECT_TRUE(salvaged.err.starts_with("swiftlet: short.swl: ")) << salvaged.err;
  EXPECT_NE(salvaged.err.find("finer than 1 are missing"), std::string::npos) << salvaged.err;
  EXPECT_NE(says_json("cut short.swl -o again.swl --salvage")["note"].get<std::string>().find("finer than 1"),
            std::string::npos);
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

TEST_F(Tool, DrawWritesXmlOfAnyName) {
  const std::string name = "a\xff&\xc3\xa4\xe2\x82";  // &, an umlaut, and what is no UTF-8
  std::error_code failure;
  std::filesystem::copy_file(folder_ / "a.swl", folder_ / (name + ".swl"), failure);
  if (failure) GTEST_SKIP() << "no file may have such a name here";
  says("draw '" + name + ".swl' -o a.svg");
  EXPECT_NE(content(folder_ / "a.svg").find("a\xef\xbf\xbd&amp;\xc3\xa4\xef\xbf\xbd"), std::string::npos);
}

/// Of Unicode XML has no U+FFFE and U+FFFF.
TEST_F(Tool, DrawWritesNoCharacterThatXmlHasNot) {
  const std::string name = "a\xef\xbf\xbe-\xef\xbf\xbf-\xef\xbf\xbc\xef\xbe\xbe";
  std::filesystem::copy_file(folder_ / "a.swl", folder_ / (name + ".swl"));
  says("draw '" + name + ".swl' -o a.svg");
  EXPECT_NE(content(folder_ / "a.svg").find(">a\xef\xbf\xbd-\xef\xbf\xbd-\xef\xbf\xbc\xef\xbe\xbe<"), std::string::npos);
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
  write(folder_ / "letter", "1 0 0 0\n0 1 O 0\n0 0 1 0\n");
  write(folder_ / "words", "one two three\n");
  write(folder_ / "far", "1 0 0 1e46\n0 1 0 0\n0 0 1 0\n");
  write(folder_ / "tiny", "1 0 0 1e-400\n0 1 0 0\n0 0 1 0\n");
  write(folder_ / "empty", "");
  write(folder_ / "locked", "1 0 0 0\n0 1 0 0\n0 0 1 0\n");
  std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::none);
  std::filesystem::create_directory(folder_ / "folder");
  before_ = names();
  const auto bad = [&](const std::string& pose, const std::string& why) {
    refuses("distance a.swl a.swl --pose " + pose, why, 2);
  };
  const auto bad_file = [&](const std::string& pose, const std::string& why) {
    refuses("distance a.swl a.swl --pose " + pose, why, 1);
  };
  bad("1,2", "2 numbers");
  bad("1,2,3,4", "4 numbers");
  bad("1,nan,3", "not finite");
  bad("1,2,3,inf,0,0,0", "not finite");
  bad("1,2,3,0,0,0,0", "zero quaternion");
  bad("1,2,x", "neither");
  bad_file("sheared", "off by 0.01");
  bad_file("mirror", "mirror image");
  bad_file("short", "8 numbers");
  bad_file("words", "words holds \"one\" in line 1, which is no number");
  bad_file("letter", "letter holds \"O\" in line 2, which is no number");
  bad("nowhere", "neither");
  bad("1e46,0,0", "translates by more than 1e+45");
  bad("0,0,-2e45,1,0,0,0", "translates by more than 1e+45");
  bad_file("far", "translates by more than 1e+45");
  bad("0,1e-400,0", "1e-400, which is beyond the range of doubles");
  bad("0,1e400,0", "1e400, which is beyond the range of doubles");
  bad_file("tiny", "1e-400, which is beyond the range of doubles");
  bad_file("empty", "empty: is empty");
  refuses("distance a.swl a.swl --pose folder", "swiftlet: folder: is no regular file", 1);
  if (geteuid() != 0) refuses("distance a.swl a.swl --pose locked", "swiftlet: locked: Permission denied", 1);
}

TEST_F(Tool, RefusesWhatIsWrongInOneLine) {
  write(folder_ / "damaged.swl", content(folder_ / "a.swl").substr(0, 500));
  std::filesystem::create_symlink("a.swl", folder_ / "link");
  before_ = names();
  refuses("", "say a word");
  refuses("fly", "no word \"fly\"");
  refuses("--fly", "no word");
  refuses("--beyond 3", "options follow the word");
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
        "--max-deviation inf", "--radius-factor 0.5", "--radius-factor 1e7", "--map -1", "--map 65", "--table 3"}) {
    const std::string name(option, std::strchr(option, ' '));
    refuses(std::string("build cube.off -o c.swl ") + option, name, 2);
  }
  refuses("info nowhere.swl", "nowhere.swl", 1);
  for (const char* cutoff : {"0", "3"})
    refuses("build cube.off -o c.swl --cutoff " + std::string(cutoff), std::string(cutoff) + " is no number from 4 up", 2);
  for (const char* option : {"--cutoff", "--bytes", "--mesh --hull-triangles", "--mesh --hull-patches"})
    refuses("build cube.off -o c " + std::string(option) + " -1", "-1 is no number from 0 up", 2);
}

TEST_F(Tool, HelpTellsWhatGoesTogetherAndTheExitCodes) {
  EXPECT_NE(says("--help").find("exit code"), std::string::npos);
  EXPECT_EQ(says("info --help").find("WORD --help"), std::string::npos);
  const std::string help = says("distance --help");
  EXPECT_EQ(help.find("Excludes:"), std::string::npos);
  EXPECT_NE(help.find("at most this; not with --relative-error"), std::string::npos) << help;
  EXPECT_NE(help.find("; needs --contacts"), std::string::npos) << help;
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

TEST_F(Tool, AFileIsCalledWhatItIsOrByNoFormatsName) {
  const auto misnamed = [this](const std::string& word, const std::string& out, const std::string& extension) {
    refuses(word + " -o " + out, "is a " + extension + " file", 2);
  };
  for (const char* out : {"b.off", "b.STL", "b.swm", "b.svg"}) misnamed("cut a.swl", out, ".swl");
  misnamed("export a.swl", "b.swl", ".off");
  misnamed("export a.swl", "b.obj", ".off");
  misnamed("draw a.swl", "b.off", ".svg");
  says("cut a.swl -o b.txt");  // read by its first bytes
  EXPECT_EQ(says_json("info b.txt")["hash"], says_json("info a.swl")["hash"]);
  EXPECT_EQ(says_json("distance b.txt a.swl --pose 3,0,0")["lower"], says_json("distance a.swl a.swl --pose 3,0,0")["lower"]);
  if (!kBuilds) return;
  before_ = names();
  for (const char* out : {"b.off", "b.swm", "b.obj"}) misnamed("build cube.off", out, ".swl");
  for (const char* out : {"b.off", "b.swl"}) misnamed("build --mesh cube.off", out, ".swm");
  refuses("decompose cube.off --draw b.off", "is a .svg file", 2);
  says("build cube.off --quiet -o hull");
  EXPECT_EQ(says_json("info hull")["levels"], says_json("info cube.off")["levels"]);
}

TEST_F(Tool, LeavesAloneWhatLiesBesideItsOutput) {
  const std::string model = content(folder_ / "a.swl");
  write(folder_ / "b.part", model);
  write(folder_ / "target", "kept");
  std::filesystem::create_symlink("target", folder_ / "c.part");
  for (const std::string& word : writing_words()) {
    says(word + "c");
    EXPECT_EQ(content(folder_ / "target"), "kept") << word;
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "c.part") && !std::filesystem::is_symlink(folder_ / "c")) << word;
  }
  std::filesystem::create_symlink("target", folder_ / "link");
  says("cut a.swl -o link");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "target"), model);
  std::filesystem::remove(folder_ / "link");
  std::filesystem::create_symlink("missing/target", folder_ / "link");
  before_ = names();
  refuses("cut a.swl -o link", "its folder does not exist", 1);
  says("cut b.part -o b");
  EXPECT_EQ(content(folder_ / "b.part"), model) << "it was read";
  EXPECT_EQ(content(folder_ / "b"), model);
  EXPECT_EQ(names(), (std::vector<std::string>{"a.swl", "b", "b.part", "c", "c.part", "cube.off", "link", "target"}));
}

TEST_F(Tool, ErrorsAreJsonWhereJsonIsAsked) {
  write(folder_ / "damaged.swl", content(folder_ / "a.swl").substr(0, 500));
  write(folder_ / "bent.off", "OFF\n1 0 0\n0 0\n");
  write(folder_ / "bent.pose", "1 0 0 0\n0 1 0\n");
  write(folder_ / "mirror.pose", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n");
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
  fails("distance a.swl a.swl --pose .", 1, "CannotRead", ".");
  fails("distance a.swl a.swl --pose bent.pose", 1, "BadValue", "bent.pose");
  fails("distance a.swl a.swl --pose mirror.pose", 1, "BadValue", "mirror.pose");
  fails("export a.swl --level 7 -o b.off", 2, "BadValue", nullptr);
  if (!kBuilds) {
    fails("build cube.off -o b.swl", 2, "BadValue", nullptr);
    return fails("info cube.off", 1, "BadFormat", "cube.off");
  }
  fails("build -o b.swl bent.off", 1, "BadFormat", "bent.off");
  fails("build -o b.swl bent.off --map x", 2, "BadValue", nullptr);
  fails("build -o b.swl cube.off --map 65", 2, "BadValue", nullptr);
  fails("build -o b.swl nowhere.off", 1, "CannotRead", "nowhere.off");
}

TEST_F(Tool, JsonIsAskedWhereTheOptionIsRead) {
  const auto fails = [this](const std::string& arguments, bool as_json) {
    const Ran ran = run(arguments);
    EXPECT_GT(ran.code, 0) << arguments;
    EXPECT_EQ(ran.out.starts_with("{"), as_json) << arguments << "\n" << ran.out;
    EXPECT_EQ(ran.err.empty(), as_json) << arguments << "\n" << ran.err;
  };
  for (const std::string word : {"info nowhere", "info nowhere --fly", "info"}) {
    for (const char* said : {" --json", " --json=true", " --json=1", " --json=false --json"}) fails(word + said, true);
    for (const char* said : {"", " --json=false", " --json=0", " -- --json"}) fails(word + said, false);
  }
  EXPECT_TRUE(says("info a.swl --json=true").starts_with("{"));
  EXPECT_FALSE(says("info a.swl --json=false").starts_with("{"));
  fails("export nowhere.swl -o --json", false);  // a file's name
  fails("export nowhere.swl -o --json --json", true);
}

/// A terminal, and what is written to it.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    path_ = ptsname(master_);
    slave_ = open(path_.c_str(), O_RDWR | O_NOCTTY);
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() { close(slave_), close(master_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool is_open() const { return slave_ >= 0; }
  const std::string& path() const { return path_; }
  std::string written() const {
    std::string text;
    char part[256];
    for (ssize_t bytes; (bytes = read(master_, part, sizeof part)) > 0;) text.append(part, std::size_t(bytes));
    return text;
  }

 private:
  int master_, slave_ = -1;
  std::string path_;
};

TEST_F(Tool, WithJsonNothingIsDrawnOnATerminal) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  const Terminal terminal;
  if (!terminal.is_open()) GTEST_SKIP() << "there are no terminals here";
  for (const std::string word : {"build cube.off -o c.swl", "build --mesh cube.off -o c.swm", "decompose cube.off"}) {
    EXPECT_EQ(run(word + " >said 2>" + terminal.path() + " && cat said").code, 0) << word;
    EXPECT_NE(terminal.written().find("%"), std::string::npos) << word;
    const Ran ran = run(word + " --json >said 2>" + terminal.path() + " && cat said");
    EXPECT_TRUE(json::accept(ran.out)) << word << "\n" << ran.out;
    EXPECT_EQ(terminal.written(), "") << word;
  }
}

/// A pipe would wait for who writes into it.
TEST_F(Tool, APipeThatIsCalledAModelIsToldSo) {
  for (const char* const name : {"pipe.swm", "pipe.swl"}) ASSERT_EQ(mkfifo((folder_ / name).c_str(), 0600), 0);
  before_ = names();
  for (const std::string name : {"pipe.swm", "pipe.swl"}) {
    for (const std::string word : {"info ", "verify ", "distance --pose 1,2,3 a.swl ", "distance a.swl --pose 1,2,3 ",
                                   "draw -o b.svg ", "export -o b.off ", "cut -o b ", "cut --salvage -o b "})
      refuses(word + name, name + ": is no regular file", 1);
  }
  if (kBuilds) refuses("decompose pipe.swm", "pipe.swm: is no regular file", 1);
}

TEST_F(Tool, ANameThatIsNoFileIsToldSo) {
  refuses("export a.swl -o " + std::string(256, 'x'), "x: File name too long", 1);
  refuses("info nofile", "swiftlet: nofile: No such file or directory", 1);
  refuses("info .", kBuilds ? "swiftlet: .: is a folder" : "swiftlet: .: Is a directory", 1);
  refuses("info \"\"", "the name after \"info\" is empty", 2);
  refuses("export a.swl -o \"\"", "the name after \"-o\" is empty", 2);
  write(folder_ / "cube.mesh", "");
  before_ = names();
  if (!kBuilds) return refuses("info cube.mesh", "without the builder", 1);
  refuses("info cube.mesh", "unknown extension \".mesh\"; mesh files are .obj", 1);
  refuses("decompose a.swl", "a.swl: is a model; decompose takes the mesh, a mesh file or a .swm", 1);
  refuses("decompose b.swl", "b.swl: No such file", 1);
  refuses("decompose nofile", "nofile: No such file", 1);
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

TEST_F(Tool, BuildTellsOfDentsAndVolumeWhatIsMeasured) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  const std::string convex = says("build cube.off -o c.swl");
  EXPECT_NE(convex.find("the vertex deepest inside the hull is 0 deep\n"), std::string::npos) << convex;
  EXPECT_NE(convex.find(" volume     1 of the hull's\n"), std::string::npos) << convex;
  EXPECT_EQ(says_json("build cube.off -o c.swl")["volume_ratio"], 1);
  write(folder_ / "open.off",  // the cube with a triangle to its middle in place of a side
        "OFF\n9 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n0.5 0.5 0.5\n"
        "4 0 4 6 2\n4 1 3 7 5\n4 0 1 5 4\n4 2 6 7 3\n4 0 2 3 1\n3 4 5 8\n");
  const std::string open = says("build open.off -o c.swl");
  EXPECT_NE(open.find("the vertex deepest inside the hull is 0.5 deep\n"), std::string::npos) << open;
  EXPECT_NE(open.find(" volume     not closed: no volume\n"), std::string::npos) << open;
  const json report = says_json("build open.off -o c.swl");
  EXPECT_EQ(report["volume_ratio"], nullptr);
  EXPECT_EQ(report["deepest_dent"], 0.5);
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
  refuses("build none.off -o c.swl", "none.off: No such file or directory", 1);
  refuses("cut cube.off -o c.swl", "cube.off: is a mesh file; cut takes", 1);
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

}  // namespace
}  // namespace swiftlet
