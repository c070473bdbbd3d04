// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The command line tool about meshes: what it says of them is what the library says, or what a hand computes.
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include <csignal>

#include "soups.h"
#include "tool_runs.h"

namespace swiftlet {
namespace {

using namespace soups;

std::string off_of(const Soup& soup) {
  std::string off = "OFF\n" + std::to_string(soup.points.size()) + " " + std::to_string(soup.triangles.size()) + " 0\n";
  for (const Vec3& p : soup.points) {
    for (int k = 0; k < 3; ++k) {
      char number[40];
      std::snprintf(number, sizeof number, "%.17g ", p[k]);
      off += number;
    }
    off += "\n";
  }
  for (const auto& [p, q, r] : soup.triangles)
    off += "3 " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
  return off;
}

std::string bytes_of(const MeshModel& mesh) {
  return {reinterpret_cast<const char*>(mesh.bytes().data()), mesh.bytes().size()};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// A decimal that reads back as the double.
std::string decimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
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
  EXPECT_EQ(text.find("at levels"), std::string::npos) << text;
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

TEST_F(Tool, OneTriangleIsNotCalledTriangles) {
  ASSERT_TRUE(save(Soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}.mesh(), folder_ / "one.swm"));
  EXPECT_TRUE(has(says("draw one.swm -o one.svg"), ": 1 triangle, "));
  EXPECT_TRUE(has(content(folder_ / "one.svg"), ">1 triangle, "));
  EXPECT_TRUE(has(says("export one.swm -o one.off"), ": 3 vertices, 1 triangle, "));
  EXPECT_TRUE(has(says("verify one.swm"), "the boxes of 1 node and 0 convex hulls"));
  EXPECT_TRUE(has(says("distance one.swm a.swl --pose 0,0,5 --contacts 9"), "contacts   1 region within"));
}

/// SIGINT comes while a file of the name *.part is there.
TEST_F(Tool, InterruptedItLeavesNothingHalfWritten) {
  Soup soup;
  for (int i = 0; i < 5000; ++i) soup.add(box({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}));
  const MeshModel mesh = soup.mesh();
  ASSERT_TRUE(save(mesh, folder_ / "large.swm"));
  const auto part = [this] {
    for (const std::string& name : names())
      if (name.ends_with(".part")) return true;
    return false;
  };
  const std::string in = folder_ / "large.swm", out = folder_ / "cut.swm";
  bool interrupted = false;
  for (int attempt = 0; attempt < 100 && !interrupted; ++attempt) {
    std::filesystem::remove(out);
    const pid_t tool = fork();
    if (tool == 0) {
      [[maybe_unused]] const auto silent = std::freopen("/dev/null", "w", stdout);
      std::signal(SIGINT, SIG_DFL);
      execl(kTool.c_str(), kTool.c_str(), "cut", in.c_str(), "-o", out.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    bool ended = false;
    while (!part() && !(ended = waitpid(tool, &status, WNOHANG) != 0)) {
    }
    if (ended) continue;  // unseen
    kill(tool, SIGINT);
    waitpid(tool, &status, 0);
    interrupted = WIFSIGNALED(status) && WTERMSIG(status) == SIGINT;
    EXPECT_FALSE(part());
    EXPECT_TRUE(content(out) == bytes_of(mesh)) << "the signal waits until the file is whole";
  }
  EXPECT_TRUE(interrupted);
}

TEST_F(Tool, DecomposeCountsPatchesAndDrawsThem) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  Soup stairs = box({0, 0, 0}, {1, 1, 1});
  stairs.add(box({3, 0, 0}, {4, 1, 1}));
  stairs.add(Soup{{{6, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}});
  write(folder_ / "stairs.off", off_of(stairs));
  says("build --mesh stairs.off -o stairs.swm");
  for (const char* growth : {"", " --growth depth", " --growth breadth", " --growth cresting"}) {
    for (const char* file : {"stairs.off", "stairs.swm"}) {
      const json made = says_json("decompose " + std::string(file) + growth + " --draw stairs.svg");
      EXPECT_EQ(made["path"], file);
      EXPECT_EQ(made["growth"], *growth ? std::string(growth + 10) : "cresting");
      EXPECT_EQ(made["triangles"], 26);
      EXPECT_EQ(made["patches"], 4) << "two boxes and two triangles";
      EXPECT_EQ(made["triangles_per_patch"]["mean"], 6.5);
      EXPECT_EQ(made["triangles_per_patch"]["median"], 12);
      EXPECT_EQ(made["triangles_per_patch"]["largest"], 12);
      EXPECT_EQ(made["virtual_faces"], 2) << "the backs of the triangles";
      EXPECT_EQ(made["flat_patches"], 2);
      EXPECT_EQ(made["edges"], json({{"reflex", 1}, {"open", 4}, {"non_manifold", 0}, {"flipped", 0}, {"slit", 0}}));
      EXPECT_EQ(made["not_taken"], json({{"not_convex", 0}, {"entered", 0}}));
      EXPECT_GE(made["seconds"].get<double>(), 0);
      EXPECT_EQ(made["picture"], "stairs.svg");
      const std::string svg = content(folder_ / "stairs.svg");
      EXPECT_EQ(times(svg, "<path"), 26u);
      EXPECT_TRUE(has(svg, "26 triangles in 4 convex patches"));
      EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
  }
  const std::string report = says("decompose stairs.off --draw stairs.svg");
  for (const char* line : {"triangles  26", "patches    4, 2 of them flat", "6.50 triangles each, median 12, largest 12",
                           "virtual    2", "1 reflex, 4 open, 0 non-manifold", "wrote      stairs.svg"})
    EXPECT_TRUE(has(report, line)) << line << "\n" << report;
  EXPECT_FALSE(says_json("decompose stairs.off").contains("picture"));

  write(folder_ / "cloud.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n");
  says("build --mesh --no-hulls stairs.off -o uncut.swm");
  says("cut uncut.swm -o cut.swm --deviation 5");
  before_ = names();
  refuses("decompose none.off", "none.off");
  refuses("decompose cloud.off", "without triangles");
  refuses("decompose cut.swm", "cut.swm: the mesh was cut");
  refuses("decompose a.swl", "a.swl");
  refuses("decompose stairs.off --growth sideways", "sideways is none of depth|breadth|cresting", 2);
  refuses("decompose stairs.off --draw stairs.off", "stairs.off");
  refuses("decompose stairs.off --draw nowhere/stairs.svg", "nowhere");
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
  for (const char* option : {"--method peel", "--cutoff 8", "--map 1", "--bytes 9", "--require-solid"})
    refuses(std::string("build --mesh cube.off -o c.swm ") + option, "is not for --mesh", 2);
  for (const char* name : {"changed.swm", "short.swm", "alien.swm", "nowhere.swm"}) {
    for (const std::string word : {"info ", "verify ", "distance --pose 1,2,3 a.swl "}) refuses(word + name, name, 1);
  }
  refuses("distance cube.swm a.swl --pose 1,2,3 --levels", "cube.swm: is a mesh, which has no levels", 2);
  refuses("distance a.swl cube.swm --pose 1,2,3 --levels", "cube.swm: is a mesh, which has no levels", 2);
  refuses("export cube.swm --level 0 -o c.off", "cube.swm: is a mesh, which has no levels", 2);
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
  EXPECT_LE(built["bytes_per_triangle"], 120);
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

TEST_F(Tool, BuildMeshGivesHullsAsAsked) {
  if (!kBuilds) GTEST_SKIP() << "this tool has no builder";
  const Soup soup = ball(4);  // 2048 triangles
  write(folder_ / "ball.off", off_of(soup));
  const json built = says_json("build --mesh ball.off -o ball.swm");
  EXPECT_GT(built["hulls"], 0);
  EXPECT_GT(built["hull_bytes"], 0);
  EXPECT_LE(built["bytes_per_triangle"].get<double>(), 120);
  EXPECT_EQ(built["depth"], built["levels"].size());
  EXPECT_EQ(built["levels"].back()["deviation"], 0);
  const std::string report = says("build --mesh ball.off -o again.swm --threads 1");
  for (const char* line :
       {" hulls      ", "in a tree of depth ", " levels     nodes     deviation     prefix", " per triangle"})
    EXPECT_TRUE(has(report, line)) << line << "\n" << report;
  says("build --mesh ball.off -o three.swm --threads 3");
  EXPECT_EQ(content(folder_ / "ball.swm"), content(folder_ / "again.swm"));
  EXPECT_EQ(content(folder_ / "ball.swm"), content(folder_ / "three.swm"));

  const json none = says_json("build --mesh ball.off -o none.swm --no-hulls");
  EXPECT_EQ(none["hulls"], 0);
  EXPECT_EQ(content(folder_ / "none.swm"), bytes_of(soup.mesh()));
  EXPECT_EQ(says_json("build --mesh ball.off -o other.swm --hull-bytes 0")["hulls"], 0);
  EXPECT_EQ(content(folder_ / "other.swm"), bytes_of(soup.mesh()));
  EXPECT_EQ(says_json("build --mesh ball.off -o other.swm --hull-levels 1 --hull-bytes 1000")["hulls"], 1);
  EXPECT_EQ(says_json("build --mesh ball.off -o other.swm --hull-triangles 9999 --hull-bytes 1000")["hulls"], 1);
  EXPECT_EQ(says_json("build --mesh ball.off -o other.swm --hull-patches 40 --hull-bytes 1000")["hulls"], 1) << "one patch";
  const json many = says_json("build --mesh ball.off -o other.swm --hull-levels 3 --hull-triangles 1 --hull-bytes 1000");
  EXPECT_EQ(many["hulls"].get<std::size_t>(),
            many["levels"][0]["nodes"].get<std::size_t>() + many["levels"][1]["nodes"].get<std::size_t>() +
                (many["levels"].size() > 2 ? many["levels"][2]["nodes"].get<std::size_t>() : 0));
  EXPECT_EQ(says_json("verify other.swm")["hulls"], many["hulls"]);
  EXPECT_TRUE(has(says("verify other.swm"), many["hulls"].dump() + " convex hulls"));
  const Vec3 away(3, 1, -2);
  const json with = says_json("distance other.swm other.swm --pose 3,1,-2"),
             without = says_json("distance none.swm none.swm --pose 3,1,-2");
  EXPECT_NEAR(with["lower"].get<double>(), without["lower"].get<double>(), 1e-13);
  EXPECT_NEAR(with["lower"].get<double>(), away.norm() - 2, 0.05);

  before_ = names();
  for (const char* option :
       {"--hull-levels 0", "--hull-levels 17", "--hull-bytes -1", "--hull-bytes nan", "--hull-triangles -1"})
    refuses(std::string("build --mesh ball.off -o c.swm ") + option, std::string(option, std::strchr(option, ' ')), 2);
  refuses("build --mesh ball.off -o c.swm --no-hulls --hull-levels 2", "excludes", 2);
  for (const char* option : {"--hull-levels 2", "--hull-bytes 9", "--hull-triangles 9", "--no-hulls"})
    refuses(std::string("build ball.off -o c.swl ") + option, "is for --mesh alone", 2);
}

TEST_F(Tool, InfoTellsALevelOfNodesByItsPrefix) {
  const MeshModel mesh = torus(40, 20).mesh();
  ASSERT_TRUE(save(mesh, folder_ / "ring.swm"));
  const json info = says_json("info ring.swm");
  EXPECT_EQ(info["whole"], true);
  EXPECT_EQ(info["deviation"], 0);
  ASSERT_EQ(info["levels"].size(), std::size_t(mesh.depth()));
  ASSERT_GE(mesh.depth(), 3);
  std::size_t nodes = 0;
  for (int k = 1; k <= mesh.depth(); ++k) {
    const json& row = info["levels"][std::size_t(k - 1)];
    nodes += row["nodes"].get<std::size_t>();
    EXPECT_EQ(row["deviation"].get<double>(), mesh.deviation(k));
    const auto prefix = row["prefix"].get<std::uint64_t>();
    EXPECT_EQ(mesh.cut({0, prefix}).level_count(), k);
    EXPECT_EQ(mesh.cut({0, prefix - 1}).level_count(), std::max(1, k - 1));
  }
  EXPECT_EQ(nodes, mesh.node_count());
  EXPECT_EQ(info["levels"][0]["nodes"], 1);
  EXPECT_EQ(info["levels"].back()["prefix"], std::filesystem::file_size(folder_ / "ring.swm"));
}

TEST_F(Tool, CutLeavesBoxesOfAMesh) {
  const Soup soup = torus(40, 20);
  const MeshModel mesh = soup.mesh();
  ASSERT_TRUE(save(mesh, folder_ / "ring.swm"));
  // Along the axis of the ring: circles of equal size, 2 apart.
  const double truth = 3 - 0.8;
  for (int levels = 1; levels < mesh.depth(); ++levels) {
    const double deviation = mesh.deviation(levels), more = std::nextafter(deviation, 1e9);
    const json cut = says_json("cut ring.swm -o cut.swm --deviation " + decimal(more));
    EXPECT_EQ(cut["levels"], levels);
    EXPECT_EQ(cut["depth"], mesh.depth());
    EXPECT_EQ(cut["deviation"].get<double>(), deviation);
    EXPECT_EQ(cut["note"], "");
    EXPECT_EQ(content(folder_ / "cut.swm"), bytes_of(mesh.cut({more})));
    EXPECT_EQ(cut["bytes"], std::filesystem::file_size(folder_ / "cut.swm"));
    const json info = says_json("info cut.swm");
    EXPECT_EQ(info["whole"], false);
    EXPECT_EQ(info["triangles"], 0);
    EXPECT_TRUE(info["bytes_per_triangle"].is_null());
    EXPECT_EQ(info["levels"].size(), std::size_t(levels));
    EXPECT_EQ(info["deviation"].get<double>(), deviation);
    const std::string text = says("info cut.swm");
    EXPECT_TRUE(has(text, " cut        after " + std::to_string(levels) + " of " + std::to_string(mesh.depth()))) << text;
    EXPECT_TRUE(has(text, "none left of 1600")) << text;

    const json answer = says_json("distance cut.swm ring.swm --pose 0,0,3");
    EXPECT_LE(answer["lower"].get<double>(), truth);
    EXPECT_GE(answer["upper"].get<double>(), truth);
    EXPECT_LE(answer["upper"].get<double>() - answer["lower"].get<double>(), deviation + 1e-12);
    EXPECT_EQ(answer["status"], "LevelLimit");
    EXPECT_EQ(answer["deviation_a"].get<double>(), deviation);
    EXPECT_EQ(answer["deviation_b"], 0);
    EXPECT_EQ(answer["feature_a"]["kind"], "none");
    const std::string said = says("distance cut.swm ring.swm --pose 0,0,3");
    EXPECT_TRUE(has(said, "status     LevelLimit: finer levels")) << said;
    EXPECT_TRUE(has(said, " of A, 0 of B")) << said;

    const json drawn = says_json("draw cut.swm -o cut.svg");
    EXPECT_GE(drawn["boxes"].get<std::size_t>(), std::size_t(levels));
    EXPECT_EQ(times(content(folder_ / "cut.svg"), "<path"), 3 * drawn["boxes"].get<std::size_t>());
    EXPECT_FALSE(has(content(folder_ / "cut.svg"), "nan"));
  }
  EXPECT_EQ(says_json("draw cut.swm -o cut.svg")["boxes"].get<std::size_t>() > 8, true);
  says("cut cut.swm -o twice.swm --deviation 1e9");
  EXPECT_EQ(content(folder_ / "twice.swm"), bytes_of(mesh.cut({1e9})));
  EXPECT_EQ(says_json("cut ring.swm -o whole.swm")["deviation"], 0);
  EXPECT_EQ(content(folder_ / "whole.swm"), bytes_of(mesh));
  EXPECT_EQ(says_json("cut ring.swm -o b.swm --bytes " + std::to_string(mesh.cut({1e9}).bytes().size()))["levels"], 1);

  ASSERT_TRUE(save(tetrahedron().mesh(), folder_ / "small.swm"));
  before_ = names();
  refuses("cut small.swm -o c.swm --deviation 1", "small.swm: has one level of nodes: there is nothing to cut", 1);
  refuses("cut small.swm -o c.swm --bytes 9", "nothing to cut", 1);
  refuses("cut ring.swm -o c.swm --deviation -1", "--deviation", 2);
  refuses("cut ring.swm -o ring.swm --deviation 1", "is the input itself", 1);
  refuses("verify cut.swm", "cut.swm: the mesh was cut", 1);
  refuses("export cut.swm -o c.off", "cut.swm: was cut: it has no triangles", 1);
  refuses("distance ring.swm cut.swm --pose 0,0,3 --contacts 1", "cut.swm: was cut: it has no triangles", 1);
  refuses("distance cut.swm ring.swm --pose 0,0,3 --solid", "cut.swm: was cut: it has no triangles", 1);
}

TEST_F(Tool, CutSalvagesWhatIsCompleteOfAMesh) {
  const MeshModel mesh = torus(40, 20).mesh();
  const std::string whole = bytes_of(mesh);
  const auto prefix = [&](int level) {  // of the file, to the level's end
    std::size_t size = whole.size() - 1;
    while (mesh.cut({0, size}).level_count() >= level)
      size = mesh.cut({0, size}).level_count() > level ? size * 9 / 10 : size - 1;
    return size + 1;
  };
  write(folder_ / "short.swm", whole.substr(0, whole.size() - 1));
  write(folder_ / "root.swm", whole.substr(0, prefix(2) - 1));
  write(folder_ / "stump.swm", whole.substr(0, 830));
  std::string changed = whole;
  changed[900] ^= 1;  // in the root
  write(folder_ / "changed.swm", changed);
  std::filesystem::create_directory(folder_ / "folder.swm");
  before_ = names();
  refuses("cut short.swm -o c.swm", "short.swm: ", 1);
  refuses("cut stump.swm -o c.swm --salvage", "stump.swm: nodes of level 0 are missing", 1);
  refuses("cut changed.swm -o c.swm --salvage", "changed.swm: ", 1);
  refuses("cut folder.swm -o c.swm --salvage", "folder.swm: ", 1);
  refuses("cut nowhere.swm -o c.swm --salvage", "nowhere.swm: ", 1);

  const Ran ran = run("cut short.swm -o left.swm --salvage");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(ran.err.starts_with("swiftlet: short.swm: it has ")) << ran.err;
  EXPECT_TRUE(has(ran.err, "levels of nodes are complete\n")) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("left.swm: " + std::to_string(mesh.depth() - 1) + " of ")) << ran.out;
  EXPECT_EQ(content(folder_ / "left.swm"), bytes_of(mesh.cut({0, whole.size() - 1})));
  const json root = says_json("cut root.swm -o left.swm --salvage");
  EXPECT_EQ(root["levels"], 1);
  EXPECT_TRUE(has(root["note"].get<std::string>(), "1 of " + std::to_string(mesh.depth()))) << root;
  EXPECT_EQ(says_json("cut short.swm -o left.swm --salvage --deviation 1e9")["levels"], 1);
  EXPECT_EQ(says_json("cut short.swm -o left.swm --deviation 1e9")["levels"], 1) << "what is kept is complete";
}

TEST_F(Tool, SolidsAreVolumes) {
  const Soup outer = box({-2, -2, -2}, {2, 2, 2});
  Soup open = outer;
  open.triangles.pop_back();
  ASSERT_TRUE(save(outer.mesh(), folder_ / "outer.swm"));
  ASSERT_TRUE(save(box({-1, -1, -1}, {1, 1, 1}).mesh(), folder_ / "inner.swm"));
  ASSERT_TRUE(save(open.mesh(), folder_ / "open.swm"));
  EXPECT_NEAR(says_json("distance outer.swm inner.swm --pose 0,0,0.5")["lower"].get<double>(), 0.5, 1e-12);
  const json solid = says_json("distance outer.swm inner.swm --pose 0,0,0.5 --solid");
  EXPECT_EQ(solid["verdict"], "Overlapping");
  EXPECT_EQ(solid["upper"], 0);
  EXPECT_EQ(says_json("distance outer.swm a.swl --pose 0,0,0.5 --solid")["verdict"], "Overlapping");
  EXPECT_NEAR(says_json("distance outer.swm inner.swm --pose 5,0,0 --solid")["lower"].get<double>(), 2, 1e-12);

  before_ = names();
  const std::string why = "open.swm: is not closed, so it is no solid: 3 open edges, 0 of more than two triangles, 0 flipped";
  refuses("distance outer.swm open.swm --pose 5,0,0 --solid", why, 1);
  refuses("distance open.swm outer.swm --pose 5,0,0 --solid --contacts 1", why, 1);
  const json error = json::parse(run("distance open.swm a.swl --pose 5,0,0 --solid --json").out, nullptr, false);
  EXPECT_EQ(error["error"]["code"], "NotSolid");
  EXPECT_EQ(error["error"]["file"], "open.swm");
}

TEST_F(Tool, SignedDistancesTellDepths) {
  const MeshModel cube = box({0, 0, 0}, {1, 1, 1}).mesh();
  ASSERT_TRUE(save(cube, folder_ / "cube.swm"));
  const json deep = says_json("distance cube.swm cube.swm --pose 0.75,0.125,0.25 --solid --signed");
  EXPECT_EQ(deep["signed"], true);
  EXPECT_LE(deep["lower"].get<double>(), -0.25);
  EXPECT_GE(deep["upper"].get<double>(), -0.25);
  EXPECT_LT(deep["upper"].get<double>(), 0);
  EXPECT_EQ(deep["verdict"], "Overlapping");
  const Answer same = signed_distance(MeshBody::solid(cube), MeshBody::solid(cube), {Mat3::Identity(), {0.75, 0.125, 0.25}});
  EXPECT_EQ(deep["lower"].get<double>(), same.lower);
  EXPECT_EQ(deep["upper"].get<double>(), same.upper);
  EXPECT_TRUE(has(says("distance cube.swm cube.swm --pose 0.75,0.125,0.25 --solid --signed"), "], signed\n"));

  const json apart = says_json("distance cube.swm cube.swm --pose 3,0,0 --signed");
  EXPECT_NEAR(apart["lower"].get<double>(), 2, 1e-12);
  EXPECT_EQ(apart["feature_a"], says_json("distance cube.swm cube.swm --pose 3,0,0")["feature_a"]);
  EXPECT_EQ(says_json("distance cube.swm cube.swm --pose 3,0,0")["signed"], false);

  // Of models: the octahedra's points along x overlap by what the poses lack of two thirds.
  const json models = says_json("distance a.swl a.swl --pose 0.66,0,0 --signed");
  EXPECT_LT(models["lower"].get<double>(), 0);
  EXPECT_GE(models["lower"].get<double>(), 0.66 - 2.0 / 3 - 1e-12);
  EXPECT_EQ(models["status"], "Converged");
  EXPECT_FALSE(models["normal"].is_null());
  before_ = names();
  refuses("distance a.swl a.swl --pose 0.1,0,0 --signed --levels", "excludes", 2);
}

TEST_F(Tool, ContactsListEveryRegionByTheUsersTriangles) {
  // Four legs, a hundredth above a floor of two triangles.
  Soup table;
  for (int i = 0; i < 4; ++i) {
    const Vec3 at(i & 1 ? 1 : -1, i & 2 ? 1 : -1, 0);
    table.add(box(at - Vec3(0.125, 0.125, 0), at + Vec3(0.125, 0.125, 2)));
  }
  Soup floor{{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const MeshModel table_mesh = table.mesh(), floor_mesh = floor.mesh();
  ASSERT_TRUE(save(table_mesh, folder_ / "table.swm"));
  ASSERT_TRUE(save(floor_mesh, folder_ / "floor.swm"));
  const json found = says_json("distance floor.swm table.swm --pose 0,0,0.015625 --contacts 0.0625 --manifold");
  EXPECT_EQ(found["count"], 4);
  EXPECT_EQ(found["counted"], true);
  EXPECT_EQ(found["status"], "Converged");
  ASSERT_EQ(found["contacts"].size(), 4u);
  std::array<MeshContact, 8> regions;
  const MeshContacts same = contacts(floor_mesh, table_mesh, {Mat3::Identity(), {0, 0, 0.015625}}, 0.0625, regions);
  ASSERT_EQ(same.count, 4u);
  std::vector<int> legs;
  for (std::size_t i = 0; i < 4; ++i) {
    const json& region = found["contacts"][i];
    EXPECT_EQ(region["lower"].get<double>(), regions[i].lower);
    EXPECT_EQ(region["upper"].get<double>(), regions[i].upper);
    EXPECT_NEAR(region["lower"].get<double>(), 0.015625, 1e-12);
    EXPECT_EQ(region["verdict"], "Disjoint");
    EXPECT_NEAR(region["normal"][2].get<double>(), 1, 1e-12);
    EXPECT_NEAR(region["point_b"][2].get<double>() - region["point_a"][2].get<double>(), 0.015625, 1e-12);
    EXPECT_LT(region["triangle_a"], 2);
    const int triangle = region["triangle_b"].get<int>();
    EXPECT_LT(triangle % 12, 2) << "those of a leg's lower end";
    legs.push_back(triangle / 12);
    const double x = region["point_b"][0].get<double>(), y = region["point_b"][1].get<double>();
    EXPECT_EQ(triangle / 12, (x > 0 ? 1 : 0) + (y > 0 ? 2 : 0));
    ASSERT_EQ(region["manifold"]["points"].size(), 4u);
    for (const json& p : region["manifold"]["points"]) {
      EXPECT_NEAR(p["separation"].get<double>(), 0.015625, 1e-12);
      EXPECT_NEAR(std::fabs(std::fabs(p["point_b"][0].get<double>()) - 1), 0.125, 1e-9) << "a corner of the leg";
      EXPECT_NEAR(std::fabs(std::fabs(p["point_b"][1].get<double>()) - 1), 0.125, 1e-9);
    }
  }
  std::sort(legs.begin(), legs.end());
  EXPECT_EQ(legs, (std::vector<int>{0, 1, 2, 3}));
  const std::string text = says("distance floor.swm table.swm --pose 0,0,0.015625 --contacts 0.0625 --manifold");
  for (const char* line :
       {"contacts   4 regions within 0.0625", "region 3 ", "manifold   4 points", "triangles  ", "status     Converged"})
    EXPECT_TRUE(has(text, line)) << line << "\n" << text;
  EXPECT_EQ(times(text, "\npoint_a"), 4u);

  EXPECT_EQ(says_json("distance floor.swm table.swm --pose 0,0,1 --contacts 0.5")["contacts"], json::array());
  EXPECT_FALSE(says_json("distance floor.swm table.swm --pose 0,0,0.0625 --contacts 0.5")["contacts"][0].contains("manifold"));
  EXPECT_TRUE(has(says("distance floor.swm table.swm --pose 0,0,1 --contacts 0.5"), "contacts   0 regions within 0.5"));
  const json crossing = says_json("distance floor.swm table.swm --pose 0,0,-0.5 --contacts 0");
  EXPECT_EQ(crossing["count"], 4);
  for (const json& region : crossing["contacts"]) {
    EXPECT_EQ(region["verdict"], "Overlapping");
    EXPECT_TRUE(region["normal"].is_null());
    EXPECT_GE(region["triangle_b"].get<int>() % 12, 4) << "those of a leg's sides";
  }
  const json convex = says_json("distance a.swl floor.swm --pose 0,0,-0.375 --contacts 0.125");
  ASSERT_EQ(convex["count"], 1);
  EXPECT_NEAR(convex["contacts"][0]["lower"].get<double>(), 0.375 - std::sqrt(0.1), 1e-12);
  EXPECT_TRUE(convex["contacts"][0]["triangle_a"].is_null());
  EXPECT_EQ(convex["contacts"][0]["feature_a"]["vertices"], json::array({5}));
  EXPECT_TRUE(has(says("distance a.swl floor.swm --pose 0,0,-0.375 --contacts 0.125"), "triangles  none of A, "));

  before_ = names();
  const std::string pair = "distance floor.swm table.swm --pose 0,0,1 ";
  refuses(pair + "--contacts -1", "no number from 0 up", 2);
  refuses(pair + "--contacts inf", "no number from 0 up", 2);
  refuses(pair + "--manifold", "--contacts", 2);
  for (const char* other : {"--beyond 1", "--max-error 1", "--relative-error 1", "--signed", "--levels"})
    refuses(pair + "--contacts 1 " + other, "excludes", 2);
}

/// More regions than the tool first has room for.
TEST_F(Tool, ContactsOfManyRegionsAreAllListed) {
  Soup pins;
  for (int i = 0; i < 400; ++i) {
    const Vec3 at(i % 20, i / 20, 0);
    pins.add(at, at + Vec3(0.25, 0, 1), at + Vec3(0, 0.25, 1));
  }
  Soup floor{{{-4, -4, 0}, {44, -4, 0}, {-4, 44, 0}}, {{0, 1, 2}}};
  ASSERT_TRUE(save(pins.mesh(), folder_ / "pins.swm"));
  ASSERT_TRUE(save(floor.mesh(), folder_ / "floor.swm"));
  const json found = says_json("distance floor.swm pins.swm --pose 0,0,0.125 --contacts 0.25");
  EXPECT_EQ(found["count"], 400);
  EXPECT_EQ(found["status"], "Converged");
  std::vector<bool> seen(400);
  for (const json& region : found["contacts"]) seen[region["triangle_b"].get<std::size_t>()] = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 400);
}

std::vector<Corners> off_triangles(const std::string& text) {
  std::istringstream words(text);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0, sides = 0;
  words >> word >> vertices >> faces >> edges;
  for (std::size_t i = 0; i < 3 * vertices; ++i) words >> word;
  std::vector<Corners> triangles(faces);
  for (auto& [p, q, r] : triangles) {
    words >> sides >> p >> q >> r;
    EXPECT_EQ(sides, 3u);
  }
  return triangles;
}

TEST_F(Tool, ExportGivesAMeshAsItWasGiven) {
  const Soup soup = scaled(torus(20, 10), 1.0 / 3);
  ASSERT_TRUE(save(soup.mesh(), folder_ / "ring.swm"));
  const json written = says_json("export ring.swm -o ring.off");
  EXPECT_EQ(written["vertices"], 200);
  EXPECT_EQ(written["triangles"], 400);
  const std::string off = content(folder_ / "ring.off");
  const std::vector<Vec3> points = off_vertices(off);
  ASSERT_EQ(points.size(), soup.points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    EXPECT_EQ(std::memcmp(points[v].data(), soup.points[v].data(), 3 * sizeof(double)), 0) << v;
  EXPECT_EQ(off_triangles(off), soup.triangles);
  // Point 4 is point 0 again, point 5 is of no triangle.
  const Soup odd{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {5, 5, 5}, {6, 5, 5}},
                 {{0, 1, 2}, {3, 4, 2}, {6, 0, 6}, {2, 0, 1}}};
  ASSERT_TRUE(save(odd.mesh(), folder_ / "odd.swm"));
  says("export odd.swm -o odd.off");
  EXPECT_EQ(off_triangles(content(folder_ / "odd.off")), (std::vector<Corners>{{0, 1, 2}, {3, 0, 2}, {4, 0, 4}, {2, 0, 1}}));
  EXPECT_EQ(off_vertices(content(folder_ / "odd.off"))[4], Vec3(6, 5, 5));
}

}  // namespace
}  // namespace swiftlet
