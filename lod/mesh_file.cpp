// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Mesh files, by extension: OFF, STL and PLY by CGAL's readers of polygon soups (its LGPL part), OBJ and SWIFT's two formats by
// our own. Knows nothing of hulls. CGAL's OBJ reader refuses point clouds and names no line. The readers are not trusted: what
// they return is checked for points, finite coordinates and indices in range.
#include <swiftlet/build.h>

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <exception>
#include <fstream>
#include <sstream>
#include <string_view>

namespace swiftlet {
namespace {

using Point3 = CGAL::Simple_cartesian<double>::Point_3;

struct Soup {
  std::vector<Point3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

Error fault(const std::filesystem::path& path, ErrorCode code, const std::string& what) {
  return {code, path.string() + ": " + what};
}

/// Whether all of `word` is one number.
template <class Number>
bool parse(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

/// Words of a text and the line each stands on.
class Words {
 public:
  explicit Words(std::istream& text) : text_(text) {}
  std::size_t line() const { return line_; }

  /// Empty at the end of the text.
  std::string next() {
    std::string word;
    for (int c = text_.get(); c != EOF; c = text_.get()) {
      const bool space = std::isspace(c);
      if (space && !word.empty()) {
        text_.unget();
        break;
      }
      if (c == '\n') ++line_;
      if (!space) word.push_back(char(c));
    }
    return word;
  }

  template <class Number>
  bool read(Number& number) {
    return parse(next(), number);
  }

 private:
  std::istream& text_;
  std::size_t line_ = 1;
};

/// "TRI" or "POLY", the counts of vertices and faces, three coordinates per vertex, and per face its vertices, counted from 0;
/// in POLY after their number. White space is free.
std::string read_swift(std::istream& file, Soup& soup) {
  Words words(file);
  const auto at_line = [&](const std::string& what) { return "line " + std::to_string(words.line()) + ": " + what; };
  const std::string magic = words.next();
  if (magic != "TRI" && magic != "POLY") return at_line("expected TRI or POLY");
  std::size_t vertex_count = 0, face_count = 0;
  if (!words.read(vertex_count) || !words.read(face_count)) return at_line("expected the counts of vertices and faces");
  for (std::size_t v = 0; v < vertex_count; ++v) {
    double x = 0, y = 0, z = 0;
    if (!words.read(x) || !words.read(y) || !words.read(z))
      return at_line("expected three coordinates of vertex " + std::to_string(v) + " of " + std::to_string(vertex_count));
    soup.points.emplace_back(x, y, z);
  }
  for (std::size_t f = 0; f < face_count; ++f) {
    const std::string face = "face " + std::to_string(f) + " of " + std::to_string(face_count);
    std::size_t size = 3;
    if (magic == "POLY" && !words.read(size)) return at_line("expected the number of vertices of " + face);
    std::vector<std::size_t> polygon;
    for (std::size_t k = 0; k < size; ++k) {
      std::size_t corner = 0;
      if (!words.read(corner)) return at_line("expected a vertex of " + face);
      if (corner >= vertex_count)
        return at_line(face + " names vertex " + std::to_string(corner) + " of " + std::to_string(vertex_count));
      polygon.push_back(corner);
    }
    soup.polygons.push_back(std::move(polygon));
  }
  return {};
}

/// A corner of an OBJ face is v, v/t, v//n or v/t/n, counted from 1 or, if negative, back from the last vertex read.
bool obj_corner(const std::string& word, std::size_t vertex_count, std::size_t& corner) {
  long long index = 0;
  if (!parse(std::string_view(word).substr(0, word.find('/')), index)) return false;
  const long long from_zero = index > 0 ? index - 1 : index + static_cast<long long>(vertex_count);
  corner = std::size_t(from_zero);
  return index != 0 && from_zero >= 0;
}

/// Vertices and faces; all else in the file is not for us.
std::string read_obj(std::istream& file, Soup& soup) {
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::istringstream text(line);
    Words words(text);
    const std::string keyword = words.next(), at_line = "line " + std::to_string(number) + ": ";
    if (keyword == "v") {
      double x = 0, y = 0, z = 0;
      if (!words.read(x) || !words.read(y) || !words.read(z)) return at_line + "expected three coordinates";
      soup.points.emplace_back(x, y, z);
    } else if (keyword == "f") {
      soup.polygons.emplace_back();
      for (std::string word = words.next(); !word.empty(); word = words.next()) {
        std::size_t corner = 0;
        if (!obj_corner(word, soup.points.size(), corner)) return at_line + "\"" + word + "\" is no vertex";
        soup.polygons.back().push_back(corner);
      }
    }
  }
  return {};
}

/// CGAL's reader dereferences the element that a property belongs to without asking whether there is one.
bool has_sound_ply_header(std::istream& file) {
  bool element = false;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    element = element || keyword == "element";
    if (keyword == "property" && !element) return false;
    if (keyword == "end_header") {
      file.clear();
      file.seekg(0);
      return true;
    }
  }
  return false;
}

/// An empty string, or what is wrong.
std::string read_soup(const std::string& extension, std::istream& file, Soup& soup) try {
  const auto outcome = [&](bool read) {
    return read ? std::string() : "is no " + extension.substr(1) + " file, or is damaged";
  };
  const auto quietly = CGAL::parameters::verbose(false);
  if (extension == ".obj") return read_obj(file, soup);
  if (extension == ".off") return outcome(CGAL::IO::read_OFF(file, soup.points, soup.polygons, quietly));
  if (extension == ".stl") return outcome(CGAL::IO::read_STL(file, soup.points, soup.polygons, quietly));
  if (extension == ".ply")
    return outcome(has_sound_ply_header(file) && CGAL::IO::read_PLY(file, soup.points, soup.polygons, quietly));
  return read_swift(file, soup);
} catch (const std::exception& exception) {
  return std::string("is damaged: ") + exception.what();
}

bool is_known(const std::string& extension) {
  constexpr std::array kKnown{".obj", ".off", ".stl", ".ply", ".tri", ".poly"};
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

Result<Mesh> checked(const Soup& soup, const std::filesystem::path& path) {
  Mesh mesh;
  if (soup.points.empty()) return fault(path, ErrorCode::Empty, "has no points");
  for (const Point3& p : soup.points) {
    mesh.points.emplace_back(p.x(), p.y(), p.z());
    if (!mesh.points.back().allFinite())
      return fault(path, ErrorCode::BadValue, "vertex " + std::to_string(mesh.points.size() - 1) + " is not finite");
  }
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::vector<std::size_t>& polygon = soup.polygons[f];
    const auto face = [&] { return "face " + std::to_string(f) + " of " + std::to_string(soup.polygons.size()); };
    if (polygon.size() < 3) return fault(path, ErrorCode::BadFormat, face() + " has fewer than three vertices");
    for (std::size_t corner : polygon)
      if (corner >= mesh.points.size())
        return fault(path, ErrorCode::BadFormat,
                     face() + " names vertex " + std::to_string(corner) + " of " + std::to_string(mesh.points.size()));
    for (std::size_t k = 2; k < polygon.size(); ++k)
      mesh.triangles.push_back({std::uint32_t(polygon[0]), std::uint32_t(polygon[k - 1]), std::uint32_t(polygon[k])});
  }
  return mesh;
}

}  // namespace

Result<Mesh> read_mesh(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (!is_known(extension))
    return fault(path, ErrorCode::BadFormat,
                 "unknown extension \"" + extension + "\"; known are .obj .off .stl .ply .tri .poly");
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) return fault(path, ErrorCode::CannotRead, "cannot be opened");
  Soup soup;
  if (const std::string what = read_soup(extension, file, soup); !what.empty()) return fault(path, ErrorCode::BadFormat, what);
  return checked(soup, path);
}

}  // namespace swiftlet
