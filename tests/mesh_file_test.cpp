// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// read_mesh on every format it knows, and on files cut short or otherwise damaged.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <clocale>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/build.h>

#include "folder.h"

namespace swiftlet {
namespace {

Result<Mesh> read(const std::string& name, const std::string& bytes) {
  const Folder folder;
  std::ofstream(folder.path() / name, std::ios::binary) << bytes;
  return read_mesh(folder.path() / name);
}

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

TEST(MeshFile, LettersAreAsciiInAnyLocale) {  // a Turkish I becomes no i
  std::string upper = kStl;
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  for (const char* name : {"C", "tr_TR.UTF-8", "tr_TR.ISO-8859-9"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    expect_tetrahedron(read("T.STL", upper));
    expect_tetrahedron(read("T.TRI", kTri));
    expect_error(read("l.tri", "TRI\xa0 1 0 0 0 0"), ErrorCode::BadFormat, "line 1: expected TRI or POLY");
    expect_error(read("l.tri", "TRI \xfd 0"), ErrorCode::BadFormat, "not \"?\"");
  }
  std::setlocale(LC_ALL, "C");
}

TEST(MeshFile, PointCloudIsLegal) {
  const auto mesh = read("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().points.size(), 3u);
  EXPECT_TRUE(mesh.value().triangles.empty());
}

/// By its triangles, all wound as the polygon is: the area of a fan that reaches out of a concave one would be larger.
TEST(MeshFile, ConcavePolygonsAreCutInside) {
  const auto area = [](const Mesh& mesh) {
    double sum = 0;
    for (const auto& [p, q, r] : mesh.triangles)
      sum += (mesh.points[q] - mesh.points[p]).cross(mesh.points[r] - mesh.points[p]).norm() / 2;
    return sum;
  };
  // An arrow whose notch no corner but one sees across, at every place in the order, both ways round, tilted.
  const std::vector<Vec3> arrow{{0, 0, 0}, {4, 1, 2}, {0, 4, 0}, {1, 1.5, 0.5}};
  for (const bool back : {false, true}) {
    for (std::size_t first = 0; first < 4; ++first) {
      std::ostringstream obj;
      for (std::size_t k = 0; k < 4; ++k)
        obj << "v " << arrow[back ? (first + 4 - k) % 4 : (first + k) % 4].transpose() << '\n';
      obj << "f 1 2 3 4\n";
      const Result<Mesh> mesh = read("arrow.obj", obj.str());
      ASSERT_TRUE(mesh);
      ASSERT_EQ(mesh.value().triangles.size(), 2u);
      EXPECT_NEAR(area(mesh.value()), std::sqrt(5.0) / 2 * 6, 1e-12) << back << first;
      const auto& [p, q, r] = mesh.value().triangles[0];
      const Vec3& at = mesh.value().points[p];
      EXPECT_EQ((mesh.value().points[q] - at).cross(mesh.value().points[r] - at)[2] < 0, back);
    }
  }
  // A comb of 40 teeth, and an hourglass, which crosses itself and stays a fan.
  std::ostringstream comb;
  comb << "v -1 -1 0\nv 41 -1 0\n";
  for (int k = 40; k >= 0; --k) comb << "v " << k << (k % 2 ? " 5 0\n" : " 0 0\n");
  comb << "f";
  for (int k = 1; k <= 43; ++k) comb << ' ' << k;
  const Result<Mesh> teeth = read("comb.obj", comb.str());
  ASSERT_TRUE(teeth);
  EXPECT_EQ(teeth.value().triangles.size(), 41u);
  EXPECT_NEAR(area(teeth.value()), 41 + 100, 1e-9);
  const Result<Mesh> crossed = read("crossed.obj", "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 3 0\nf 1 2 3 4\n");
  ASSERT_TRUE(crossed);
  EXPECT_EQ(crossed.value().triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

/// CGAL's exact arithmetic takes no infinity, which the length of such a polygon's normal is.
TEST(MeshFile, ConcavePolygonsBeyondAllLimitsAreRead) {
  for (const std::string far : {"1e100", "1e150", "1e153", "1e155", "1e200", "1e308"}) {
    const Result<Mesh> mesh = read(
        "far.off", "OFF\n5 1 0\n0 0 0\n0 1 0\n1 0 0\n" + far + " " + far + " 0\n-" + far + " " + far + " 0\n5 0 1 2 3 4\n");
    ASSERT_TRUE(mesh) << far;
    EXPECT_EQ(mesh.value().triangles.size(), 3u);
  }
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
  expect_error(read_mesh("/nowhere/at_all.off"), ErrorCode::CannotRead, "/nowhere/at_all.off: No such file");
  expect_error(read_mesh("/nowhere/at_all"), ErrorCode::CannotRead, "/nowhere/at_all: No such file");
  expect_error(read_mesh("/"), ErrorCode::CannotRead, "is a folder");
}

TEST(MeshFile, DirectoryIsNoFile) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "t.off");
  expect_error(read_mesh(folder.path() / "t.off"), ErrorCode::CannotRead, "is a folder");
}

TEST(MeshFile, DevicesAndPipesAreNoFiles) {  // the one has no end, the other none yet
  const Folder folder;
  const auto path = folder.path() / "endless.obj";
  std::filesystem::create_symlink("/dev/zero", path);
  expect_error(read_mesh(path), ErrorCode::CannotRead, "is no regular file");
  EXPECT_EQ(read_mesh(path).error().file, path.string());
  std::filesystem::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_error(read_mesh(path), ErrorCode::CannotRead, "is no regular file");
}

TEST(MeshFile, UnknownExtensionIsNamed) { expect_error(read("t.step", kOff), ErrorCode::BadFormat, ".step"); }

TEST(MeshFile, NoPointsIsAnError) {
  expect_error(read("e.obj", "# nothing\n"), ErrorCode::Empty, "no points");
  expect_error(read("e.tri", "TRI 0 0"), ErrorCode::Empty, "no points");
}

TEST(MeshFile, NonFiniteVertexIsNamed) {
  expect_error(read("n.tri", "TRI 2 0  0 0 0  0 nan 0"), ErrorCode::BadValue,
               "line 1: \"nan\" is not finite, expected three coordinates of vertex 1 of 2");
  expect_error(read("n.off", "OFF\n2 0 0\n0 0 0\n0 inf 0\n"), ErrorCode::BadValue, "line 4: \"inf\" is not finite");
  expect_error(read("n.obj", "v 0 0 0\nv 0 0 -inf\n"), ErrorCode::BadValue, "line 2: \"-inf\" is not finite");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  expect_error(read("n.ply", header + "0 0 0\n0 nan 0\n"), ErrorCode::BadValue, "line 9: vertex 1 of 2 is not finite");
}

TEST(MeshFile, NonFiniteCornerOfAFacetIsNamed) {
  std::string stl = binary_stl();
  stl.replace(84 + 50 + 12 + 16, 4, std::string("\0\0\xc0\x7f", 4));  // NaN
  expect_error(read("n.stl", stl), ErrorCode::BadValue, "facet 1 of 4 has a corner that is not finite");
}

TEST(MeshFile, ObjFacesNameVerticesAsTheFileDoes) {
  expect_error(read("f.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\nv 0 1 0\nv 0 0 1\n"), ErrorCode::BadFormat,
               "line 3: \"7\" is no vertex: they count from 1, or back from -1, and 4 are there");
  EXPECT_TRUE(read("f.obj", "v 0 0 0\nv 1 0 0\nf 1 2/1 3\nv 0 1 0\n")) << "a face may come before its vertices";
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

TEST(MeshFile, NegativeIndicesAreNamed) {
  expect_error(read("i.ply", std::string(kPly).replace(kPly.rfind("3 0 3 2"), 7, "3 0 -1 2")), ErrorCode::BadFormat,
               "face 3 of 4 names vertex -1");
  expect_error(read("i.off", std::string(kOff).replace(kOff.rfind("3 0 3 2"), 7, "3 0 -1 2")), ErrorCode::BadFormat,
               "face 3 of 4 names vertex -1 of 4");
  expect_error(read("i.obj", kObj + "f 1 2 -5\n"), ErrorCode::BadFormat, "line 9: \"-5\" is no vertex");
  expect_tetrahedron(read("i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 -1\nf -3 -2 -1\nf 1 4 3\n"));
}

TEST(MeshFile, CountsAreNotBelievedBeforeTheFileHoldsThem) {  // each took all memory, or hours
  expect_error(read("c.off", "OFF\n1 1 0\n0 0 0\n99999999999 0 0"), ErrorCode::BadFormat, "the file ends");
  expect_error(read("c.off", "OFF\n99999999999 1 0\n0 0 0\n"), ErrorCode::BadFormat, "vertex 1 of 99999999999");
  expect_error(read("c.poly", "POLY 1 1  0 0 0  99999999999 0 0"), ErrorCode::BadFormat, "the file ends");
  const std::string binary = "ply\nformat binary_little_endian 1.0\n";
  expect_error(
      read("c.ply",
           binary + "element vertex 99999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n1234"),
      ErrorCode::BadFormat, "ends early");
  expect_error(read("c.ply", binary + "element face 1\nproperty list uint int vertex_index\nend_header\n\xff\xff\xff\xff"),
               ErrorCode::BadFormat, "ends early");
  expect_error(read("c.ply", binary + "element vertex 99999999999\nend_header\n"), ErrorCode::Empty, "no points");
  std::string stl = binary_stl();
  stl.replace(80, 4, "\xff\xff\xff\xff");
  expect_error(read("c.stl", stl), ErrorCode::BadFormat, "ends early");
}

TEST(MeshFile, TextCutShortIsAnError) {
  for (const auto& [name, whole] : {std::pair{"cut.stl", kStl}, {"cut.off", kOff}, {"cut.ply", kPly}, {"cut.poly", kPoly}}) {
    const std::size_t last_word = whole.find_last_of(" \n", whole.find_last_not_of(" \n")) + 1;
    for (std::size_t size = 0; size <= (std::string(name) == "cut.stl" ? whole.rfind("endsolid") : last_word); ++size)
      ASSERT_FALSE(read(name, whole.substr(0, size))) << name << ", " << size << " bytes";
  }
}

TEST(MeshFile, ObjLinesGoOnAfterABackslash) {
  expect_tetrahedron(read("l.obj", "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\r\nv 0 0 1\nf 1 \\\r\n3 \\\n2\nf 1 2 4\nf 2 3 4\nf 1 4 3"));
  expect_error(read("l.obj", "v 0 0 0\nv 1 \\\n0 0\nv 0 x 0\n"), ErrorCode::BadFormat,
               "line 4: expected three coordinates, not \"x\"");
  for (const std::string line : {"mtllib C:\\red\\", "o \\", "vn 0 0 \\", "g a \\\nb\\"}) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const std::size_t lines = 2 + std::size_t(std::count(line.begin(), line.end(), '\n'));
      for (const char* swallowed : {"v 7 7 7", "f 1 2 3"})
        expect_error(read("l.obj", line + end + swallowed + "\n" + kObj), ErrorCode::BadFormat,
                     "line " + std::to_string(lines) + ": begins with \"" + swallowed[0] + "\"");
    }
    expect_tetrahedron(read("l.obj", line + "\n\n" + kObj));
  }
  expect_tetrahedron(read("l.obj", "# C:\\\n" + kObj));
}

TEST(MeshFile, NumbersBeyondDoublesAreNamed) {
  expect_error(read("n.off", "OFF\n1 0 0\n0 1e-400 0\n"), ErrorCode::BadFormat, "line 3: \"1e-400\" is beyond the range");
  expect_error(read("n.obj", "v 0 1e400 0\n"), ErrorCode::BadFormat, "line 1: \"1e400\" is beyond the range");
}

TEST(MeshFile, OffSkipsCommentsNormalsAndColours) {
  expect_tetrahedron(read("c.off",
                          "STCNOFF # all\n# four\n4 4 6 # edges\n0 0 0  0 0 1  255 0 0\n1 0 0\n\n0 1 0 # y\n0 0 1\n"
                          "3 0 2 1  0.5 0.5 0.5\n3 0 1 3 7\n3 1 2 3\n3 0 3 2"));
  expect_error(read("c.off", "4OFF\n1 0 0\n0 0 0 1\n"), ErrorCode::BadFormat, "expected OFF, not \"4OFF\"");
  expect_error(read("c.off", "OFF BINARY\n1 0 0\n"), ErrorCode::BadFormat, "in text, not \"BINARY\"");
}

TEST(MeshFile, PlyInAllThreeFormatsAgrees) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\ncomment t\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty double z\n"
                        "property short y\nelement strip 1\nproperty list uchar float weights\nelement face 4\n"
                        "property list uint8 int32 vertex_index\nend_header\n";
    const auto put = [&](auto value) {
      std::string part(reinterpret_cast<const char*>(&value), sizeof value);
      bytes += big ? std::string(part.rbegin(), part.rend()) : part;
    };
    for (int v = 0; v < 4; ++v) put(float(v == 1)), put(std::uint8_t(9)), put(double(v == 3)), put(std::int16_t(v == 2));
    put(std::uint8_t(2)), put(0.5f), put(0.25f);
    for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
      put(std::uint8_t(3));
      for (const int corner : f) put(std::int32_t(corner));
    }
    expect_tetrahedron(read("b.ply", bytes));
  }
  expect_error(read("u.ply", "ply\nformat binary 1.0\nend_header\n"), ErrorCode::BadFormat, "unknown format \"binary\"");
  expect_error(read("u.ply", "ply\nformat ascii 1.0\nproperty int x\nend_header\n"), ErrorCode::BadFormat,
               "line 3: a property of no");
  expect_error(read("u.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n"), ErrorCode::BadFormat,
               "unknown type \"real\"");
}

TEST(MeshFile, PlyNumbersInTextAreOfTheirTypes) {
  const auto with = [](const std::string& type, const std::string& value) {
    return read("t.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty " + type +
                             " y\nproperty float z\nend_header\n0 " + value + " 0\n");
  };
  constexpr std::pair<const char*, std::pair<const char*, const char*>> kEnds[] = {{"char", {"-128", "127"}},
                                                                                   {"uchar", {"0", "255"}},
                                                                                   {"int16", {"-32768", "32767"}},
                                                                                   {"ushort", {"0", "65535"}},
                                                                                   {"int", {"-2147483648", "2147483647"}},
                                                                                   {"uint32", {"0", "4294967295"}}};
  constexpr const char* kBeyond[][2] = {
      {"-129", "128"},     {"-1", "256"}, {"-32769", "32768"}, {"-1", "65536"}, {"-2147483649", "2147483648"},
      {"-1", "4294967296"}};
  for (std::size_t i = 0; i < std::size(kEnds); ++i) {
    const auto& [type, ends] = kEnds[i];
    for (const char* end : {ends.first, ends.second}) EXPECT_TRUE(with(type, end)) << type << ' ' << end;
    EXPECT_TRUE(with(type, "7.0")) << type;
    for (const char* wrong : {kBeyond[i][0], kBeyond[i][1], "1.5", "inf", "nan"})
      expect_error(with(type, wrong), ErrorCode::BadFormat,
                   "line 8: \"" + std::string(wrong) + "\" is no number of its property's type");
  }
  for (const char* type : {"float", "double"}) EXPECT_TRUE(with(type, "1.5"));
  expect_error(read("t.ply", std::string(kPly).replace(kPly.find("1.0"), 3, "2.0")), ErrorCode::BadFormat,
               "line 2: version \"2.0\" of PLY, expected 1.0");
}

/// Every text format.
const std::pair<const char*, std::string> kTexts[] = {{"t.off", kOff}, {"t.obj", kObj}, {"t.ply", kPly},
                                                      {"t.stl", kStl}, {"t.tri", kTri}, {"t.poly", kPoly}};

/// The lines of a text with ends of so many kinds, in turn.
std::string with_ends(const std::string& text, const std::vector<std::string>& ends) {
  std::string result;
  std::size_t line = 0;
  for (const char c : text) {
    if (c == '\n')
      result += ends[line++ % ends.size()];
    else
      result += c;
  }
  return result;
}

TEST(MeshFile, LinesEndInAnyWay) {
  for (const auto& [name, text] : kTexts) {
    SCOPED_TRACE(name);
    expect_tetrahedron(read(name, with_ends(text, {"\r"})));
    expect_tetrahedron(read(name, with_ends(text, {"\r\n"})));
    expect_tetrahedron(read(name, with_ends(text, {"\n\n", "\n"})));
    if (std::string(name) == "t.ply") continue;  // its header's lines end as the first one does
    expect_tetrahedron(read(name, with_ends(text, {"\n", "\r", "\r\n"})));
    expect_tetrahedron(read(name, with_ends(text, {"\r", "\r", "\n"})));
  }
  expect_error(read("t.ply", with_ends(kPly, {"\n", "\r"})), ErrorCode::BadFormat, "line");
  expect_error(read("l.obj", "v 0 0 0\rv 1 0 0\r\nv 0 x 0\n"), ErrorCode::BadFormat, "line 3");
  expect_error(read("l.tri", "TRI\r2 0\r0 0 0\r\n0 x 0\n"), ErrorCode::BadFormat, "line 4");
}

TEST(MeshFile, CommentsEndWhereTheirLineDoes) {
  expect_tetrahedron(read("c.obj", "# c:\\\r" + with_ends(kObj, {" # c:\\\r"})));
  expect_tetrahedron(read("c.off", with_ends(kOff, {" # c\r"})));
  expect_tetrahedron(read("c.ply", std::string(kPly).replace(4, 0, "comment end_header\nobj_info c\n")));
}

TEST(MeshFile, MarksOfUnicodeLoseNothing) {
  for (const auto& [name, text] : kTexts) {
    SCOPED_TRACE(name);
    expect_tetrahedron(read(name, "\xef\xbb\xbf" + text));
    for (const bool big : {false, true}) {
      std::string wide;
      for (const char c : text) wide += big ? std::string{'\0', c} : std::string{c, '\0'};
      EXPECT_FALSE(read(name, wide));
      expect_error(read(name, (big ? "\xfe\xff" : "\xff\xfe") + wide), ErrorCode::BadFormat, "UTF-16");
    }
  }
  expect_error(read("twice.obj", kObj + "\xef\xbb\xbf" + kObj), ErrorCode::BadFormat, "line 9");
}

TEST(MeshFile, MissingColumnsAreAnError) {
  expect_error(read("m.obj", "v 0 0 0\nv 1 0\nv 0 1 0\n"), ErrorCode::BadFormat,
               "line 2: expected three coordinates, and the line ends");
  expect_error(read("m.off", "OFF\n3 0 0\n0 0 0\n1 0\n0 1 0\n"), ErrorCode::BadFormat,
               "line 4: expected three coordinates of vertex 1 of 3, and the line ends");
  for (const std::string faces : {"3 0 1\n3 0 1 2\n3 0 1 3\n3 1 2 3\n", "3 0 1 # 2\n3\n"})
    expect_error(read("m.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + faces), ErrorCode::BadFormat,
                 "line 7: expected a vertex of face 0 of 3, and the line ends");
  expect_error(read("m.tri", "TRI 2 0  0 0 0  1 0"), ErrorCode::BadFormat, "three coordinates of vertex 1 of 2");
  expect_error(read("m.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\nvertex 0 1 0\n"),
               ErrorCode::BadFormat, "line 5");
  expect_error(read("m.stl", "solid\nfacet normal 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"),
               ErrorCode::BadFormat, "line 2: expected three numbers of a normal, and the line ends");
  expect_error(read("m.ply", std::string(kPly).replace(kPly.find("1 0 0"), 5, "1 0")), ErrorCode::BadFormat,
               "line 11: expected a number, and the line ends");
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string line = "property double " + axis + "\n";
    for (const std::string& other :
         {std::string(), std::string("property double w\n"), "property list uchar double " + axis + "\n"})
      expect_error(read("m.ply", std::string(kPly).replace(kPly.find(line), line.size(), other)), ErrorCode::BadFormat,
                   "no property " + axis);
    expect_error(read("m.ply", std::string(kPly).replace(kPly.find(line), 0, line)), ErrorCode::BadFormat,
                 "more than one property " + axis);
  }
}

TEST(MeshFile, PlyFacesHaveOneListOfCorners) {
  const std::string line = "property list uchar int vertex_indices\n";
  const auto with = [&](const std::string& lines) { return std::string(kPly).replace(kPly.find(line), line.size(), lines); };
  const std::string other = "property list uchar int vertex_index\n";
  expect_tetrahedron(read("f.ply", with(other)));
  for (const std::string& lines : {line + line, line + other, other + "property int flags\n" + line})
    expect_error(read("f.ply", with(lines)), ErrorCode::BadFormat, "its faces have more than one property vertex_indices");
  for (const char* lines : {"property list uchar int vertices\n", "property int vertex_indices\n"})
    expect_error(read("f.ply", with(lines)), ErrorCode::BadFormat, "its faces have no property vertex_indices");
  EXPECT_TRUE(read("f.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
                   "element face 0\nproperty int flags\nend_header\n0 0 0\n"));
}

TEST(MeshFile, MoreColumnsAreNoPoints) {
  expect_tetrahedron(
      read("c.obj", "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0 0 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3"));
  expect_error(read("c.obj", "v 0 0 0 v 1 0 0\n"), ErrorCode::BadFormat, "line 1: expected a number, not \"v\"");
  expect_error(read("c.obj", "v 0 0 0  1 0 0  0 1 0\n"), ErrorCode::BadFormat, "line 1: more numbers");
  expect_error(read("c.off", "OFF\n1 0 0\n0 0 0 red\n"), ErrorCode::BadFormat, "line 3: expected a number, not \"red\"");
  expect_error(read("c.off", "OFF\n1 0 0 0 0 0\n"), ErrorCode::BadFormat, "line 2: more numbers");
  expect_error(read("c.ply", std::string(kPly).replace(kPly.find("1 0 0"), 5, "1 0 0 7")), ErrorCode::BadFormat,
               "line 11: vertex 1 of 4 has more than its properties");
}

TEST(MeshFile, UnknownWordsAreAnError) {  // a point may hide behind them
  expect_error(read("u.obj", "v 0 0 0\nV 1 0 0\n"), ErrorCode::BadFormat, "line 2: OBJ has no word \"V\"");
  expect_error(read("u.ply", std::string(kPly).replace(kPly.find("property double z"), 8, "propertx")), ErrorCode::BadFormat,
               "line 6: unknown keyword");
  expect_tetrahedron(
      read("u.obj", "mtllib a b\no t\ng t \\\nu\nusemtl red\ns off\nvn 0 0 1\nvt 0 0\n" + kObj + "l 1 2\np 1\n"));
}

TEST(MeshFile, NothingFollowsTheLastElement) {
  for (const auto& [name, text] : kTexts) {
    SCOPED_TRACE(name);
    expect_tetrahedron(read(name, text + " \n\r\n"));
    if (std::string(name) != "t.obj") expect_error(read(name, text + "1 2 3\n"), ErrorCode::BadFormat, "line");
  }
  expect_error(read("g.tri", "TRI 1 0  0 0 0  1 0 0"), ErrorCode::BadFormat, "more after the last face");
  expect_error(read("g.stl", binary_stl() + "1"), ErrorCode::BadFormat, "goes on after its last facet");
  std::string fewer = binary_stl();
  fewer[80] = 3;  // of four facets
  expect_error(read("g.stl", fewer), ErrorCode::BadFormat, "goes on after its last facet");
}

TEST(MeshFile, BinaryPlyIsReadToItsLastByte) {
  for (const bool big : {false, true}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string head = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                         "_endian 1.0\nelement vertex 2\nproperty short x\nproperty float y\nproperty double z\nend_header\n";
      std::string bytes = with_ends(head, {end});
      const auto put = [&](auto value) {
        std::string part(reinterpret_cast<const char*>(&value), sizeof value);
        bytes += big ? std::string(part.rbegin(), part.rend()) : part;
      };
      put(std::int16_t(big ? 0x0a0d : 0x0d0a)), put(2.f), put(3.), put(std::int16_t(-4)), put(5.f), put(6.);  // begins with LF
      const Result<Mesh> mesh = read("b.ply", bytes);
      ASSERT_TRUE(mesh) << mesh.error().message;
      EXPECT_EQ(mesh.value().points[0], Vec3(big ? 0x0a0d : 0x0d0a, 2, 3));
      EXPECT_EQ(mesh.value().points[1], Vec3(-4, 5, 6));
      EXPECT_TRUE(read("b.ply", "\xef\xbb\xbf" + bytes));
      EXPECT_TRUE(read("b.ply", bytes + "\n"));
      expect_error(read("b.ply", bytes + "more"), ErrorCode::BadFormat, "goes on after its last element");
      expect_error(read("b.ply", bytes.substr(0, bytes.size() - 1)), ErrorCode::BadFormat, "ends early");
    }
  }
}

TEST(MeshFile, EmptyFilesAreAnError) {
  for (const char* name : {"e.off", "e.obj", "e.ply", "e.stl", "e.tri", "e.poly"})
    for (const char* bytes : {"", "\n", "\r", "\xef\xbb\xbf"}) EXPECT_FALSE(read(name, bytes)) << name;
}

TEST(MeshFile, BinaryStlCutShortIsAnError) {
  const std::string whole = binary_stl();
  for (std::size_t size : {10, 83, 100, 150, 283}) EXPECT_FALSE(read("cut.stl", whole.substr(0, size))) << size << " bytes";
  const std::string solid = std::string(whole).replace(0, 5, "solid");
  expect_tetrahedron(read("cut.stl", solid));
  expect_error(read("cut.stl", solid.substr(0, 283)), ErrorCode::BadFormat, "ends early: 283 bytes for 4 facets");
  expect_error(read("cut.stl", solid + "1"), ErrorCode::BadFormat, "goes on after its last facet");
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
