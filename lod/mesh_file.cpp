// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Mesh files, by extension, each format by a reader of our own. Knows nothing of hulls. CGAL's readers were tried: they
// allocate what a count claims, take a file cut short for a whole one, refuse point clouds, and name no line. A count here is
// believed only as far as the file goes on.
#include "mesh_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "triangulate.h"

namespace swiftlet {
namespace {

/// Thrown by the readers, caught in mesh_of_bytes.
struct Damage {
  std::string what;
  ErrorCode code = ErrorCode::BadFormat;
};

struct Soup {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint64_t>> polygons;
};

// Letters and blanks are ASCII's, whatever the program's locale.

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return result;
}

/// As a message shows what was found.
std::string shown(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kMost)) text += c >= ' ' && c <= '~' ? c : '?';
  return text += word.size() > kMost ? "...\"" : "\"";
}

std::string numbered(const char* what, std::uint64_t index, std::uint64_t count) {
  return what + std::to_string(index) + " of " + std::to_string(count);
}

// ---- Text -------------------------------------------------------------------------------------------------------------------

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Text without the mark of UTF-8.
std::string_view text_of(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) throw Damage{"line 1: is UTF-16, expected UTF-8"};
  return bytes;
}

/// Words of a text and the line each stands on; lines end in LF, CR LF or CR. `comment` begins what is no word, up to the end
/// of its line; a line goes on after an `escape` at its end.
class Words {
 public:
  explicit Words(std::string_view text, char comment = '\0', std::size_t first_line = 1, char escape = '\0')
      : rest_(text), comment_(comment), escape_(escape), line_(first_line) {}

  /// Goes to the next line that holds a word, or stays on the one that is begun.
  void begin_line() { skip_blanks(true); }
  bool at_end() { return begin_line(), rest_.empty(); }
  /// Empty at the end of the text.
  std::string_view next() {
    skip_blanks(true);
    return word();
  }
  /// Empty at the end of the line.
  std::string_view next_on_line() {
    skip_blanks(false);
    return rest_.empty() || is_line_end(rest_.front()) ? std::string_view() : word();
  }
  void skip_line() { take(std::size_t(std::find_if(rest_.begin(), rest_.end(), is_line_end) - rest_.begin())); }
  /// Passes over what is left on the line: so many numbers at most, since what else stands there may belong to a point.
  void skip_numbers(int most) {
    for (std::string_view word = next_on_line(); !word.empty(); word = next_on_line()) {
      parse<double>(word, word, "a number");
      if (most-- == 0) fail("more numbers than belong on the line, from " + shown(word) + " on");
    }
  }
  void expect_end(const char* last) {
    if (!at_end()) fail(std::string("more after the last ") + last + ": " + shown(next()));
  }

  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::BadFormat) const {
    throw Damage{"line " + std::to_string(line_) + ": " + what, code};
  }

  template <class Number>
  Number number(const std::string& what) {
    const std::string_view word = next();
    return parse<Number>(word, word, what);
  }
  template <class Number>
  Number number_on_line(const std::string& what) {
    const std::string_view word = next_on_line();
    return parse<Number>(word, word, what);
  }
  double coordinate(std::string_view word, const std::string& what) const {
    const double value = parse<double>(word, word, what);
    if (!std::isfinite(value)) fail(shown(word) + " is not finite, expected " + what, ErrorCode::BadValue);
    return value;
  }
  /// Of a part of a word.
  template <class Number>
  Number parse(std::string_view digits, std::string_view word, const std::string& what) const {
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (!digits.empty() && error == std::errc() && end == digits.data() + digits.size()) return value;
    if (word.empty()) fail("expected " + what + ", and the " + (rest_.empty() ? "file ends" : "line ends"));
    if (error == std::errc::result_out_of_range) fail(shown(word) + " is beyond the range of numbers");
    fail("expected " + what + ", not " + shown(word));
  }
  Vec3 point(const std::string& what) {
    const double x = coordinate(next(), what), y = coordinate(next(), what), z = coordinate(next(), what);
    return {x, y, z};
  }
  Vec3 point_on_line(const std::string& what) {
    const double x = coordinate(next_on_line(), what), y = coordinate(next_on_line(), what),
                 z = coordinate(next_on_line(), what);
    return {x, y, z};
  }

 private:
  std::string_view take(std::size_t length) {
    const std::string_view part = rest_.substr(0, length);
    rest_.remove_prefix(part.size());
    return part;
  }
  /// Whether the line goes on after this place.
  bool escaped(std::size_t at) const {
    return escape_ != '\0' && rest_[at] == escape_ && at + 1 < rest_.size() && is_line_end(rest_[at + 1]);
  }
  std::string_view word() {
    std::size_t length = 0;
    while (length < rest_.size() && !is_space(rest_[length]) && !escaped(length)) ++length;
    return take(length);
  }
  void pass_line_end() {
    take(rest_.starts_with("\r\n") ? 2 : 1);
    ++line_;
  }
  void skip_blanks(bool past_lines) {
    while (!rest_.empty()) {
      if (rest_.front() == comment_ && comment_ != '\0') {
        skip_line();
      } else if (escaped(0)) {
        take(1);
        pass_line_end();
      } else if (is_line_end(rest_.front())) {
        if (!past_lines) return;
        pass_line_end();
      } else if (is_space(rest_.front())) {
        take(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  char comment_, escape_;
  std::size_t line_;
};

/// How the index of a corner is read: by `number`, or by `number_on_line` where every face has a line of its own.
using ReadIndex = long long (Words::*)(const std::string& what);

std::uint64_t face_size(Words& words, const std::string& face) {
  return words.number<std::uint64_t>("the number of vertices of " + face);
}

/// Corners, counted from 0.
std::vector<std::uint64_t> polygon(Words& words, ReadIndex read, const std::string& face, std::uint64_t size,
                                   std::uint64_t vertex_count) {
  std::vector<std::uint64_t> corners;
  for (std::uint64_t k = 0; k < size; ++k) {
    const long long index = (words.*read)("a vertex of " + face);
    if (index < 0 || std::uint64_t(index) >= vertex_count)
      words.fail(face + " names vertex " + std::to_string(index) + " of " + std::to_string(vertex_count));
    corners.push_back(std::uint64_t(index));
  }
  return corners;
}

/// "TRI" or "POLY", the counts of vertices and faces, three coordinates per vertex, and per face its vertices, in POLY after
/// their number. White space is free.
Soup read_swift(std::string_view bytes) {
  Words words(text_of(bytes));
  const std::string_view magic = words.next();
  if (magic != "TRI" && magic != "POLY") words.fail("expected TRI or POLY");
  Soup soup;
  const auto vertex_count = words.number<std::uint64_t>("the count of vertices"),
             face_count = words.number<std::uint64_t>("the count of faces");
  for (std::uint64_t v = 0; v < vertex_count; ++v)
    soup.points.push_back(words.point("three coordinates of " + numbered("vertex ", v, vertex_count)));
  for (std::uint64_t f = 0; f < face_count; ++f) {
    const std::string face = numbered("face ", f, face_count);
    const std::uint64_t size = magic == "POLY" ? face_size(words, face) : 3;
    soup.polygons.push_back(polygon(words, &Words::number<long long>, face, size, vertex_count));
  }
  words.expect_end("face");
  return soup;
}

constexpr int kOffColumns = 9;  // a normal, a colour, a place in a texture
constexpr int kObjColumns = 4;  // a weight, a colour

/// As read_swift's POLY, but every vertex and every face has a line of its own, where more numbers (normals, colours) may
/// follow.
Soup read_off(std::string_view bytes) {
  Words words(text_of(bytes), '#');
  std::string_view magic = words.next();
  const std::string_view found = magic;
  for (const char* prefix : {"ST", "C", "N"})  // what the skipped rest of a vertex's line holds
    if (magic.starts_with(prefix)) magic.remove_prefix(std::strlen(prefix));
  if (magic != "OFF") words.fail("expected OFF, not " + shown(found));
  Soup soup;
  const auto vertex_count = words.number<std::uint64_t>("the count of vertices, in text"),
             face_count = words.number<std::uint64_t>("the count of faces");
  words.skip_numbers(1);
  for (std::uint64_t v = 0; v < vertex_count; ++v) {
    words.begin_line();
    soup.points.push_back(words.point_on_line("three coordinates of " + numbered("vertex ", v, vertex_count)));
    words.skip_numbers(kOffColumns);
  }
  for (std::uint64_t f = 0; f < face_count; ++f) {
    const std::string face = numbered("face ", f, face_count);
    const std::uint64_t size = face_size(words, face);
    soup.polygons.push_back(polygon(words, &Words::number_on_line<long long>, face, size, vertex_count));
    words.skip_numbers(kOffColumns);
  }
  words.expect_end("face");
  return soup;
}

constexpr const char* kNoObjVertex = " is no vertex: they count from 1, or back from -1, and ";

/// A corner of an OBJ face is v, v/t, v//n or v/t/n, counted from 1 or, if negative, back from the last vertex read.
std::uint64_t obj_corner(const Words& words, std::string_view word, std::size_t vertex_count) {
  const auto index = words.parse<long long>(word.substr(0, word.find('/')), word, "a vertex");
  const long long count = static_cast<long long>(vertex_count);
  if (index == 0 || index < -count) words.fail(shown(word) + kNoObjVertex + std::to_string(count) + " are read");
  return std::uint64_t(index > 0 ? index - 1 : index + count);
}

/// The words of OBJ that tell of no vertex or face.
bool is_other_obj_word(std::string_view word) {
  constexpr const char* kOthers[] = {"vt",       "vn",         "vp",        "p",      "l",      "g",     "o",    "s",
                                     "mg",       "usemtl",     "mtllib",    "usemap", "maplib", "bevel", "lod",  "c_interp",
                                     "d_interp", "shadow_obj", "trace_obj", "cstype", "deg",    "bmat",  "step", "curv",
                                     "curv2",    "surf",       "parm",      "trim",   "hole",   "scrv",  "sp",   "end",
                                     "con",      "ctech",      "stech",     "call",   "csh"};
  return std::any_of(std::begin(kOthers), std::end(kOthers), [word](const char* other) { return word == other; });
}

/// Vertices and faces. A line goes on where it ends in a backslash; one of other words may not swallow a vertex or face so.
Soup read_obj(std::string_view bytes) {
  Words words(text_of(bytes), '#', 1, '\\');
  Soup soup;
  struct {
    std::uint64_t vertex = 0;
    std::string_view word;
    std::size_t line = 0;
  } last;  // the vertex that most must come before
  while (!words.at_end()) {
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      soup.points.push_back(words.point_on_line("three coordinates"));
      words.skip_numbers(kObjColumns);
    } else if (keyword == "f") {
      soup.polygons.emplace_back();
      for (std::string_view word = words.next_on_line(); !word.empty(); word = words.next_on_line()) {
        const std::uint64_t vertex = obj_corner(words, word, soup.points.size());
        if (vertex > last.vertex) last = {vertex, word, words.line()};
        soup.polygons.back().push_back(vertex);
      }
    } else if (is_other_obj_word(keyword)) {
      for (std::size_t line = words.line();; line = words.line()) {
        const std::string_view word = words.next_on_line();
        if (word.empty()) break;
        if (words.line() != line && (word == "v" || word == "f"))
          words.fail("begins with " + shown(word) + ", but the line before it ends in a backslash and so goes on here");
      }
    } else {
      words.fail("OBJ has no word " + shown(keyword));
    }
  }
  if (last.line > 0 && last.vertex >= soup.points.size())
    throw Damage{"line " + std::to_string(last.line) + ": " + shown(last.word) + kNoObjVertex +
                 std::to_string(soup.points.size()) + " are there"};
  return soup;
}

// ---- Bytes ------------------------------------------------------------------------------------------------------------------

/// Numbers one after the other.
class Numbers {
 public:
  Numbers(std::string_view bytes, bool big_endian) : rest_(bytes), big_endian_(big_endian) {}
  template <class Number>
  Number next() {
    if (rest_.size() < sizeof(Number)) throw Damage{"ends early"};
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), rest_.data(), bytes.size());
    rest_.remove_prefix(bytes.size());
    if (big_endian_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }
  void skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool big_endian_;
};

/// Points that are equal are one.
class Welder {
 public:
  explicit Welder(std::vector<Vec3>& points) : points_(points) {}
  std::uint64_t index(const Vec3& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // -0 is 0; a NaN equals itself
    const auto [at, added] = known_.try_emplace({bits(p.x()), bits(p.y()), bits(p.z())}, points_.size());
    if (added) points_.push_back(p);
    return at->second;
  }

 private:
  std::vector<Vec3>& points_;
  std::map<std::array<std::uint64_t, 3>, std::uint64_t> known_;
};

constexpr std::size_t kStlHeader = 80, kStlFacet = 50;

/// Header, count, and per facet a normal, three corners and two bytes.
Soup read_binary_stl(std::string_view bytes) {
  if (bytes.size() < kStlHeader + 4) throw Damage{"is no STL file: too short, and no text that begins with \"solid\""};
  Numbers numbers(bytes.substr(kStlHeader), false);
  const auto count = numbers.next<std::uint32_t>();
  if ((bytes.size() - kStlHeader - 4) / kStlFacet < count)
    throw Damage{"ends early: " + std::to_string(bytes.size()) + " bytes for " + std::to_string(count) + " facets"};
  if (bytes.size() != kStlHeader + 4 + kStlFacet * std::uint64_t{count})
    throw Damage{"goes on after its last facet: " + std::to_string(bytes.size()) + " bytes for " + std::to_string(count) +
                 " facets"};
  Soup soup;
  Welder welder(soup.points);
  for (std::uint32_t f = 0; f < count; ++f) {
    numbers.skip(12);
    soup.polygons.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto x = numbers.next<float>(), y = numbers.next<float>(), z = numbers.next<float>();
      const Vec3 corner(x, y, z);
      if (!corner.allFinite())
        throw Damage{numbered("facet ", f, count) + " has a corner that is not finite", ErrorCode::BadValue};
      soup.polygons.back().push_back(welder.index(corner));
    }
    numbers.skip(2);
  }
  return soup;
}

/// One or several of: solid NAME, facets, endsolid NAME.
Soup read_text_stl(std::string_view text) {
  Words words(text);
  const auto expect = [&words](const char* wanted) {
    const std::string_view word = words.next();
    if (lower(word) != wanted)
      words.fail(std::string("expected ") + wanted + (word.empty() ? ", and the file ends" : ", not " + shown(word)));
  };
  Soup soup;
  Welder welder(soup.points);
  while (!words.at_end()) {
    expect("solid");
    words.skip_line();
    std::string_view word = words.next();
    for (; lower(word) == "facet"; word = words.next()) {
      expect("normal");
      for (int k = 0; k < 3; ++k)
        if (words.next_on_line().empty()) words.fail("expected three numbers of a normal, and the line ends");
      expect("outer"), expect("loop");
      soup.polygons.emplace_back();
      for (int k = 0; k < 3; ++k) {
        expect("vertex");
        soup.polygons.back().push_back(welder.index(words.point("three coordinates")));
      }
      expect("endloop"), expect("endfacet");
    }
    if (word.empty()) words.fail("the file ends before endsolid");
    if (lower(word) != "endsolid") words.fail("expected facet or endsolid, not " + shown(word));
    words.skip_line();
  }
  return soup;
}

/// A binary header may say "solid" too: what fits its count of facets is binary, and so is what has a NUL there. Of fewer than
/// 2^24 facets the count has one.
Soup read_stl(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHeader + 4) std::memcpy(&count, bytes.data() + kStlHeader, sizeof count);
  const bool fits = bytes.size() == kStlHeader + 4 + kStlFacet * std::uint64_t{count};
  if (fits) return read_binary_stl(bytes);
  const std::string_view text = text_of(bytes);
  const bool has_nul = bytes.substr(0, kStlHeader + 4).find('\0') != std::string_view::npos;
  return !has_nul && lower(Words(text).next()) == "solid" ? read_text_stl(text) : read_binary_stl(bytes);
}

// ---- PLY --------------------------------------------------------------------------------------------------------------------

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

std::optional<PlyType> ply_type(std::string_view name) {
  constexpr std::array<const char*, 8> kOld{"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
      kNew{"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < kOld.size(); ++i)
    if (name == kOld[i] || name == kNew[i]) return PlyType(i);
  return std::nullopt;
}

/// Whether a number is one of a type; any is of floats.
bool is_of(PlyType type, double value) {
  constexpr std::pair<double, double> kRanges[] = {{-0x1p7, 0x1p7 - 1}, {0, 0x1p8 - 1},        {-0x1p15, 0x1p15 - 1},
                                                   {0, 0x1p16 - 1},     {-0x1p31, 0x1p31 - 1}, {0, 0x1p32 - 1}};
  if (type == PlyType::Float || type == PlyType::Double) return true;
  const auto& [least, most] = kRanges[std::size_t(type)];
  return value >= least && value <= most && value == std::floor(value);
}

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> size_type;  ///< of a list
};
struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};
struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
  std::size_t size = 0, lines = 0;
};

/// Lines end as the first one does: of those that end in CR, LF may be the first byte of the body.
PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  const auto fail = [&header](const std::string& what) { throw Damage{"line " + std::to_string(header.lines) + ": " + what}; };
  const std::string_view first = bytes.substr(std::min(bytes.find_first_of("\r\n"), bytes.size()));
  const std::string_view line_end = first.starts_with("\r\n") ? "\r\n" : first.starts_with('\r') ? "\r" : "\n";
  constexpr const char* kKeywords[] = {"ply", "format", "comment", "obj_info", "element", "property", "end_header", ""};
  for (std::string_view keyword; keyword != "end_header";) {
    ++header.lines;
    const std::string_view line = bytes.substr(header.size, bytes.find(line_end, header.size) - header.size);
    if (header.size + line.size() >= bytes.size()) fail("the header has no end");
    header.size += line.size() + line_end.size();
    Words words(line);
    keyword = words.next();
    if (header.lines == 1 && keyword != "ply") fail("expected ply");
    if (std::find(std::begin(kKeywords), std::end(kKeywords), keyword) == std::end(kKeywords))
      fail("unknown keyword " + shown(keyword));
    if (keyword == "format") {
      header.format = words.next();
      const std::string_view version = words.next();
      if (!version.empty() && version != "1.0") fail("version " + shown(version) + " of PLY, expected 1.0");
    }
    if (keyword == "element") {
      const std::string name(words.next());
      std::uint64_t count = 0;
      const std::string_view digits = words.next();
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
      if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) fail("expected an element's count");
      header.elements.push_back({name, count, {}});
    }
    if (keyword != "property") continue;
    if (header.elements.empty()) fail("a property of no element");
    PlyProperty property{};
    std::string_view type = words.next();
    if (type == "list") {
      property.size_type = ply_type(words.next());
      if (!property.size_type) fail("unknown type of a list's size");
      type = words.next();
    }
    const std::optional<PlyType> known = ply_type(type);
    if (!known) fail("unknown type " + shown(type));
    property.type = *known;
    property.name = words.next();
    header.elements.back().properties.push_back(property);
  }
  return header;
}

/// The body of a PLY file. Every number of its types is a double exactly.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header)
      : text_(header.format == "ascii"),
        words_(bytes, '\0', header.lines + 1),
        numbers_(bytes, header.format == "binary_big_endian") {
    if (!text_ && header.format != "binary_little_endian" && header.format != "binary_big_endian")
      throw Damage{"unknown format " + shown(header.format)};
  }
  double next(PlyType type) {
    if (text_) {
      const std::string_view word = words_.next_on_line();
      const double value = words_.parse<double>(word, word, "a number");
      if (!is_of(type, value)) words_.fail(shown(word) + " is no number of its property's type");
      return value;
    }
    switch (type) {
      case PlyType::Int8: return numbers_.next<std::int8_t>();
      case PlyType::UInt8: return numbers_.next<std::uint8_t>();
      case PlyType::Int16: return numbers_.next<std::int16_t>();
      case PlyType::UInt16: return numbers_.next<std::uint16_t>();
      case PlyType::Int32: return numbers_.next<std::int32_t>();
      case PlyType::UInt32: return numbers_.next<std::uint32_t>();
      case PlyType::Float: return numbers_.next<float>();
      case PlyType::Double: break;
    }
    return numbers_.next<double>();
  }
  /// In text an element has a line of its own, which holds its properties and no more.
  void begin_element() {
    if (text_) words_.begin_line();
  }
  void end_element(const std::string& what) {
    if (!text_) return;
    if (const std::string_view more = words_.next_on_line(); !more.empty())
      words_.fail(what + " has more than its properties: " + shown(more));
  }
  /// A line end may follow.
  void expect_end() {
    if (text_) return words_.expect_end("element");
    const std::string_view rest = numbers_.rest();
    if (!std::all_of(rest.begin(), rest.end(), is_space))
      throw Damage{"goes on after its last element, with " + std::to_string(rest.size()) + " bytes"};
  }
  /// A number that must be finite, of `what`.
  void expect_finite(double value, const std::string& what) const {
    if (std::isfinite(value)) return;
    if (text_) words_.fail(what + " is not finite", ErrorCode::BadValue);
    throw Damage{what + " is not finite", ErrorCode::BadValue};
  }
  /// A size or an index.
  std::uint64_t count(PlyType type, const std::string& what) {
    const double value = next(type);
    constexpr double kMost = 0x1p32;  // what no type of PLY exceeds that counts
    if (value >= 0 && value < kMost && value == std::floor(value)) return std::uint64_t(value);
    std::array<char, 32> digits;
    const std::string fault =
        what + std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    if (text_) words_.fail(fault);
    throw Damage{fault};
  }

 private:
  bool text_;
  Words words_;
  Numbers numbers_;
};

/// Which coordinate a property is: 0, 1, 2, or 3 for none.
int coordinate_of(const PlyProperty& property) {
  const bool named = !property.size_type && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
  return named ? property.name[0] - 'x' : 3;
}

/// Whether a property is the list of a face's corners.
bool lists_corners(const PlyProperty& property) {
  return property.size_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Refuses elements that have not just one such property.
template <class Is>
void expect_one(const PlyElement& element, const char* elements, const std::string& name, const Is& is) {
  const auto count = std::count_if(element.properties.begin(), element.properties.end(), is);
  if (count != 1)
    throw Damage{std::string("its ") + elements + " have " + (count == 0 ? "no" : "more than one") + " property " + name};
}

Soup read_ply(std::string_view file) {
  const std::string_view bytes = text_of(file);
  const PlyHeader header = read_ply_header(bytes);
  PlyBody body(bytes.substr(header.size), header);
  Soup soup;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no room
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    for (int k = 0; vertices && k < 3; ++k)
      expect_one(element, "vertices", {char('x' + k)}, [k](const PlyProperty& p) { return coordinate_of(p) == k; });
    if (faces && element.count > 0) expect_one(element, "faces", "vertex_indices or vertex_index", lists_corners);
    const std::string what = element.name + " ";
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vec3 point = Vec3::Zero();
      std::vector<std::uint64_t> polygon;
      body.begin_element();
      for (const PlyProperty& property : element.properties) {
        if (!property.size_type) {
          const double value = body.next(property.type);
          const int k = coordinate_of(property);
          if (k < 3) point[k] = value;
          if (k < 3 && vertices) body.expect_finite(value, numbered("vertex ", i, element.count));
          continue;
        }
        const bool corners = faces && lists_corners(property);
        const std::string where = numbered(what.c_str(), i, element.count);
        const std::uint64_t size = body.count(*property.size_type, where + " has a list of size ");
        for (std::uint64_t k = 0; k < size; ++k) {
          if (corners)
            polygon.push_back(body.count(property.type, where + " names vertex "));
          else
            body.next(property.type);
        }
      }
      body.end_element(numbered(what.c_str(), i, element.count));
      if (vertices) soup.points.push_back(point);
      if (faces) soup.polygons.push_back(std::move(polygon));
    }
  }
  body.expect_end();
  return soup;
}

// ---- All --------------------------------------------------------------------------------------------------------------------

using Reader = Soup (*)(std::string_view);

Reader reader_of(const std::string& extension) {
  constexpr std::pair<const char*, Reader> kReaders[] = {{".obj", read_obj}, {".off", read_off},   {".stl", read_stl},
                                                         {".ply", read_ply}, {".tri", read_swift}, {".poly", read_swift}};
  for (const auto& [known, reader] : kReaders)
    if (extension == known) return reader;
  return nullptr;
}

Result<Mesh> checked(Soup soup) {
  Mesh mesh{std::move(soup.points), {}};
  if (mesh.points.empty()) return Error{ErrorCode::Empty, "has no points"};
  if (mesh.points.size() > std::uint32_t(-1)) return Error{ErrorCode::TooLarge, "has more points than 32 bits number"};
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::vector<std::uint64_t>& polygon = soup.polygons[f];
    const auto face = [&] { return numbered("face ", f, soup.polygons.size()); };
    if (polygon.size() < 3) return Error{ErrorCode::BadFormat, face() + " has fewer than three vertices"};
    for (const std::uint64_t corner : polygon)
      if (corner >= mesh.points.size())
        return Error{ErrorCode::BadFormat,
                     face() + " names vertex " + std::to_string(corner) + " of " + std::to_string(mesh.points.size())};
    lod::triangulate(mesh.points, polygon, mesh.triangles);
  }
  return mesh;
}

}  // namespace

Result<Mesh> lod::mesh_of_bytes(std::string_view bytes, const std::string& extension) try {
  if (const Reader read = reader_of(extension)) return checked(read(bytes));
  return Error{ErrorCode::BadFormat, "unknown extension \"" + extension + "\"; mesh files are .obj .off .stl .ply .tri .poly"};
} catch (const Damage& damage) {
  return Error{damage.code, damage.what};
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::TooLarge, "is too large for this machine's memory"};
}

Result<Mesh> read_mesh(const std::filesystem::path& path) try {
  const auto named = [&path](Error error) {
    error.message = path.string() + ": " + error.message;
    error.file = path.string();
    return error;
  };
  std::error_code failure;  // a fifo waits to be opened, a device need not end
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) return named({ErrorCode::CannotRead, failure.message()});
  if (!std::filesystem::is_regular_file(status))
    return named({ErrorCode::CannotRead, std::filesystem::is_directory(status) ? "is a folder" : "is no regular file"});
  const std::string extension = lower(path.extension().string());
  std::string bytes;
  if (reader_of(extension)) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    const int cause = errno;
    if (!file) return named({ErrorCode::CannotRead, cause ? std::generic_category().message(cause) : "cannot be opened"});
    const std::uintmax_t size = std::filesystem::file_size(path, failure);
    if (failure) return named({ErrorCode::CannotRead, failure.message()});
    if (size > bytes.max_size()) throw std::bad_alloc();
    bytes.resize(std::size_t(size));
    if (!file.read(bytes.data(), std::streamsize(size))) return named({ErrorCode::CannotRead, "cannot be read to its end"});
  }
  Result<Mesh> mesh = lod::mesh_of_bytes(bytes, extension);
  if (!mesh) return named(mesh.error());
  return mesh;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::TooLarge, path.string() + ": is too large for this machine's memory", path.string()};
}

}  // namespace swiftlet
