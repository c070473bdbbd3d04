// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// read_mesh on every format it knows, and on files cut short or otherwise damaged.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <swiftlet/build.h>

namespace swiftlet {
namespace {

/// A file that lives as long as this.
class File {
 public:
  File(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() / ("swiftlet_" + std::string(test_name()) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~File() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  static const char* test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
  std::filesystem::path path_;
};

Result<Mesh> read(const std::string& name, const std::string& bytes) { return read_mesh(File(name, bytes).path()); }

// A tetrahedron: the origin and the three unit axes.
const std::string kOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kTri = "TRI\n4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 1\n0 1 3\n1 2 3\n0 3 2\n";
const std::string kPoly = "POLY\n4 4\n0 0 0  1 0 0  0 1 0  0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string stl_facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
}
const std::string o = "0 0 0", x = "1 0 0", y = "0 1 0", z = "0 0 1";
const std::string kStl =
    "solid t\n" + stl_facet(o, y, x) + stl_facet(o, x, z) + stl_facet(x, y, z) + stl_facet(o, z, y) + "endsolid t\n";

std::string binary_stl() {
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::string bytes(80, ' ');
  const std::uint32_t count = 4;
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (int corner : face) bytes.append(reinterpret_cast<const char*>(corners[corner]), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

void expect_tetrahedron(const Result<Mesh>& mesh) {
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().points.size(), 4u);
  EXPECT_EQ(mesh.value().triangles.size(), 4u);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : mesh.value().points) sum += p;
  EXPECT_EQ(sum, Vec3(1, 1, 1));
}

void expect_error(const Result<Mesh>& mesh, ErrorCode code, const std::string& words) {
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, code) << mesh.error().message;
  EXPECT_NE(mesh.error().message.find(words), std::string::npos) << mesh.error().message;
}

TEST(MeshFile, ReadsEveryFormat) {
  expect_tetrahedron(read("t.off", kOff));
  expect_tetrahedron(read("t.obj", kObj));
  expect_tetrahedron(read("t.ply", kPly));
  expect_tetrahedron(read("t.stl", kStl));
  expect_tetrahedron(read("b.stl", binary_stl()));
  expect_tetrahedron(read("t.tri", kTri));
  expect_tetrahedron(read("t.poly", kPoly));
}

TEST(MeshFile, ExtensionIsCaseInsensitive) { expect_tetrahedron(read("T.OFF", kOff)); }

TEST(MeshFile, PointCloudIsLegal) {
  const auto mesh = read("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().points.size(), 3u);
  EXPECT_TRUE(mesh.value().triangles.empty());
}

TEST(MeshFile, PolygonsAreFanned) {
  const auto mesh = read("q.poly", "POLY 4 1  0 0 0  1 0 0  1 1 0  0 1 0  4 0 1 2 3");
  ASSERT_TRUE(mesh) << mesh.error().message;
  ASSERT_EQ(mesh.value().triangles.size(), 2u);
  EXPECT_EQ(mesh.value().triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(MeshFile, KeepsDoublesBitForBit) {
  const auto mesh = read("d.tri", "TRI 1 0  0.1 1e-300 +123456789.123456789");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().points[0], Vec3(0.1, 1e-300, 123456789.123456789));
}

TEST(MeshFile, MissingFileIsNamed) {
  expect_error(read_mesh("/nowhere/at_all.off"), ErrorCode::CannotRead, "/nowhere/at_all.off");
}

TEST(MeshFile, DirectoryIsNoFile) {
  const auto path = std::filesystem::temp_directory_path() / "swiftlet_directory.off";
  std::filesystem::create_directory(path);
  expect_error(read_mesh(path), ErrorCode::CannotRead, "cannot be opened");
  std::filesystem::remove(path);
}

TEST(MeshFile, UnknownExtensionIsNamed) { expect_error(read("t.step", kOff), ErrorCode::BadFormat, ".step"); }

TEST(MeshFile, NoPointsIsAnError) {
  expect_error(read("e.obj", "# nothing\n"), ErrorCode::Empty, "no points");
  expect_error(read("e.tri", "TRI 0 0"), ErrorCode::Empty, "no points");
}

TEST(MeshFile, NonFiniteVertexIsNamed) {
  expect_error(read("n.tri", "TRI 2 0  0 0 0  0 nan 0"), ErrorCode::BadValue, "vertex 1");
}

TEST(MeshFile, TextFaultsNameTheLine) {
  expect_error(read("l.tri", "TRI\n2 0\n0 0 0\n0 zero 0\n"), ErrorCode::BadFormat, "line 4");
  expect_error(read("m.tri", "TROI\n"), ErrorCode::BadFormat, "line 1");
  expect_error(read("i.tri", "TRI\n1 1\n0 0 0\n0 0 7\n"), ErrorCode::BadFormat, "names vertex 7 of 1");
}

TEST(MeshFile, IndexOutOfRangeIsAnError) {
  EXPECT_FALSE(read("i.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n"));
  EXPECT_FALSE(read("i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
  EXPECT_FALSE(read("i.ply", std::string(kPly).replace(kPly.rfind("3 0 3 2"), 7, "3 0 3 8")));
  EXPECT_FALSE(read("p.poly", "POLY 1 1  0 0 0  2 0 0"));
}

TEST(MeshFile, BinaryStlCutShortIsAnError) {
  const std::string whole = binary_stl();
  for (std::size_t size : {10, 83, 100, 150, 283}) EXPECT_FALSE(read("cut.stl", whole.substr(0, size))) << size << " bytes";
}

TEST(MeshFile, DamagedFilesNeverCrash) {
  const std::pair<const char*, std::string> files[] = {{"c.off", kOff},        {"c.obj", kObj}, {"c.ply", kPly},
                                                       {"c.stl", kStl},        {"c.tri", kTri}, {"c.poly", kPoly},
                                                       {"c.stl", binary_stl()}};
  for (const auto& [name, bytes] : files)
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
      (void)read(name, bytes.substr(0, at));
      std::string flipped = bytes;
      flipped[at] = char(flipped[at] ^ 0x11);
      (void)read(name, flipped);
    }
}

}  // namespace
}  // namespace swiftlet
