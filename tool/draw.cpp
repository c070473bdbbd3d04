// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Front faces of one convex body never hide each other, so only a mesh's triangles, or its boxes' sides, are sorted by depth.
#include "draw.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "body/half_edge.h"
#include "mesh_boxes.h"
#include "off_text.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

// Pixels.
constexpr double kMargin = 28, kGap = 26, kCell = 230, kTallest = 300, kHeading = 78, kCaption = 66;
constexpr std::size_t kPerRow = 6;
constexpr int kShades = 40;
constexpr std::array<double, 3> kDark{38, 60, 92}, kPale{236, 243, 250};  // red, green, blue

struct Point2 {
  double x, y;  // y downwards
};

/// Where the eye is, and the axes of the paper. Unit vectors.
struct Eye {
  Vec3 towards = Vec3(0.55, -1, 0.5).normalized();
  Vec3 right = Vec3::UnitZ().cross(towards).normalized();
  Vec3 up = towards.cross(right);
  Vec3 light = (towards + 1.1 * up - 0.9 * right).normalized();

  Point2 project(const Vec3& p) const { return {right.dot(p), -up.dot(p)}; }
  Point2 project(const Vertex& v) const { return project(Vec3(v.x, v.y, v.z)); }
  /// Of a surface with this unit normal.
  int shade(const Vec3& normal) const {
    return std::clamp(int((0.16 + 0.84 * std::max(0.0, normal.dot(light))) * kShades), 0, kShades - 1);
  }
};

struct Frame {
  double left = INFINITY, top = INFINITY, right = -INFINITY, bottom = -INFINITY;

  void hold(const Point2& p) {
    left = std::min(left, p.x), right = std::max(right, p.x);
    top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

Frame frame_of(const Model& model, const Eye& eye) {
  Frame frame;
  for (int k = 0; k < model.level_count(); ++k)
    for (const Vertex& v : model.level(k).view.vertices) frame.hold(eye.project(v));
  return frame;
}

/// A flat polygon of a mesh's picture, and how near to the eye its middle is.
struct Polygon {
  double nearness;
  Vec3 normal;  // unit, towards the eye
  std::vector<Point2> corners;
  std::array<double, 3> pale = kPale;  // its colour in full light

  Polygon(const std::vector<Vec3>& points, const Vec3& across, const Eye& eye)
      : nearness(0), normal(across.dot(eye.towards) < 0 ? -across : across) {
    for (const Vec3& p : points) {
      nearness += eye.towards.dot(p) / double(points.size());
      corners.push_back(eye.project(p));
    }
  }
};

/// The triangles of a mesh; the sides of its lowest boxes that face the eye, if it was cut.
std::vector<Polygon> polygons_of(const MeshModel& mesh, const Eye& eye) {
  std::vector<Polygon> polygons;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::vector<Vec3> p;
    for (const std::uint32_t v : mesh.triangle(t)) p.push_back(mesh.vertex(v));
    polygons.emplace_back(p, (p[1] - p[0]).cross(p[2] - p[0]).stableNormalized(), eye);
  }
  if (mesh.is_whole()) return polygons;
  for (const auto& [middle, half] : lowest_boxes(mesh)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &u = half[(k + 1) % 3], &v = half[(k + 2) % 3],
                 at = middle + (half[k].dot(eye.towards) < 0 ? -1 : 1) * half[k];
      polygons.emplace_back(std::vector<Vec3>{at + u + v, at - u + v, at - u - v, at + u - v}, u.cross(v).stableNormalized(),
                            eye);
    }
  }
  return polygons;
}

Frame frame_of(const std::vector<Polygon>& polygons) {
  Frame frame;
  for (const Polygon& polygon : polygons)
    for (const Point2& p : polygon.corners) frame.hold(p);
  return frame;
}

/// From the paper's units to pixels of a cell whose corner is the origin.
struct Placement {
  Frame frame;
  double scale = 1;

  explicit Placement(const Frame& f) : frame(f) {
    const double fits = std::min(kCell / f.width(), kTallest / f.height());
    if (std::isfinite(fits)) scale = fits;
  }
  double height() const { return std::max(frame.height() * scale, 40.0); }
  Point2 operator()(const Point2& p) const {
    return {kCell / 2 + (p.x - (frame.left + frame.right) / 2) * scale,
            height() / 2 + (p.y - (frame.top + frame.bottom) / 2) * scale};
  }
};

std::string at(const Point2& p) { return format("%.2f %.2f", p.x, p.y); }

/// As XML has it. Bytes that are no UTF-8 become U+FFFD, as in JSON, and so do U+FFFE and U+FFFF.
std::string escaped(const std::string& text) {
  using nlohmann::json;
  const std::string valid = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::string result;
  for (char c : valid) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (result.ends_with("\xef\xbf") && (c == '\xbe' || c == '\xbf'))
      result += '\xbd';  // the last byte of U+FFFE and U+FFFF
    else if (static_cast<unsigned char>(c) >= ' ')
      result += c;
  }
  return result;
}

Vec3 facet_normal(const ConvexView& view, const std::vector<std::uint32_t>& loop) {
  const auto corner = [&](std::size_t k) {
    const Vertex& v = view.vertices[origin(view, loop[k])];
    return Vec3(v.x, v.y, v.z);
  };
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 2; k < loop.size(); ++k) normal += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
  return normal.stableNormalized();
}

std::string colour(int shade, const std::array<double, 3>& pale = kPale) {
  const double t = double(shade) / (kShades - 1);
  const auto mix = [&](std::size_t k) { return int(std::lround(kDark[k] + (pale[k] - kDark[k]) * t)); };
  return format("#%02x%02x%02x", mix(0), mix(1), mix(2));
}

/// Colours of numbers that follow one another are far apart on the wheel.
std::array<double, 3> colour_of_patch(std::uint32_t number) {
  constexpr double kGolden = 0.6180339887498949;
  const double turn = number * kGolden, hue = 6 * (turn - std::floor(turn));
  std::array<double, 3> rgb;
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::fabs(std::fmod(hue + 6 - 2 * double(k), 6) - 3);  // 3 at the colour's own hue, 0 across the wheel
    rgb[k] = 255 - 150 * (1 - std::clamp(off - 1, 0.0, 1.0));
  }
  return rgb;
}

double edge_width(std::size_t faces) { return std::clamp(14 / std::sqrt(double(faces + 1)), 0.15, 0.9); }

/// The front faces, one path per shade, and over them the edges.
std::string draw_faces(const ConvexView& view, const Eye& eye, const Placement& place) {
  const auto loops = facets(view);
  std::map<int, std::string> paths;
  std::vector<bool> front(view.half_edges.size(), false);
  for (const auto& loop : loops) {
    const Vec3 normal = facet_normal(view, loop);
    if (!(normal.dot(eye.towards) > 0)) continue;
    std::string& path = paths[eye.shade(normal)];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      path.append(k == 0 ? "M" : "L").append(at(place(eye.project(view.vertices[origin(view, loop[k])]))));
      front[loop[k]] = true;
    }
    path += "Z";
  }
  std::string edges;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    const std::uint32_t twin = view.half_edges[h].twin;
    const bool visible = view.half_edges[h].face == kNone || front[h] || front[twin];
    if (h > twin || !visible || is_diagonal(view, h)) continue;
    edges.append("M").append(at(place(eye.project(view.vertices[origin(view, h)]))));
    edges.append("L").append(at(place(eye.project(view.vertices[view.half_edges[h].head]))));
  }
  std::string svg;
  for (const auto& [shade, path] : paths) {
    const std::string fill = colour(shade);
    svg += "<path fill=\"" + fill + "\" stroke=\"" + fill + "\" stroke-width=\".5\" d=\"" + path + "\"/>\n";
  }
  if (!edges.empty())
    svg += format("<path fill=\"none\" stroke=\"#16263c\" stroke-opacity=\".45\" stroke-width=\"%.2f\" d=\"",
                  edge_width(loops.size())) +
           edges + "\"/>\n";
  if (view.vertices.size() == 1) {
    const Point2 p = place(eye.project(view.vertices[0]));
    svg += format("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3\" fill=\"#16263c\"/>\n", p.x, p.y);
  }
  return svg;
}

/// Farthest first.
std::string draw_polygons(std::vector<Polygon> polygons, const Eye& eye, const Placement& place) {
  std::stable_sort(polygons.begin(), polygons.end(),
                   [](const Polygon& a, const Polygon& b) { return a.nearness < b.nearness; });
  std::string svg =
      format("<g stroke=\"#16263c\" stroke-opacity=\".45\" stroke-width=\"%.2f\">\n", edge_width(polygons.size()));
  for (const Polygon& polygon : polygons) {
    svg += "<path fill=\"" + colour(eye.shade(polygon.normal), polygon.pale) + "\" d=\"";
    for (const Point2& p : polygon.corners) svg.append(&p == polygon.corners.data() ? "M" : "L").append(at(place(p)));
    svg += "Z\"/>\n";
  }
  return svg + "</g>\n";
}

/// The convex hull of the projected vertices, by Andrew's monotone chain.
std::string draw_outline(const ConvexView& view, const Eye& eye, const Placement& place) {
  std::vector<Point2> points, chain;
  for (const Vertex& v : view.vertices) points.push_back(place(eye.project(v)));
  std::sort(points.begin(), points.end(),
            [](const Point2& p, const Point2& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); });
  const auto turn = [](const Point2& o, const Point2& p, const Point2& q) {
    return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  };
  for (int side = 0; side < 2; ++side, std::reverse(points.begin(), points.end())) {
    const std::size_t begin = chain.size();
    for (const Point2& p : points) {
      while (chain.size() >= begin + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();  // the other side begins with it
  }
  std::string path;
  for (const Point2& p : chain) path.append(path.empty() ? "M" : "L").append(at(p));
  return "<path fill=\"none\" stroke=\"#e4572e\" stroke-width=\"1.3\" stroke-dasharray=\"4 3\" d=\"" + path + "Z\"/>\n";
}

std::string caption(const Model& model, int k, double top) {
  const Level& level = model.level(k);
  const auto line = [&](int index, const char* look, const std::string& text) {
    return format("<text x=\"%.0f\" y=\"%.1f\" text-anchor=\"middle\" %s>", kCell / 2, top + 20 + 17 * index, look) + text +
           "</text>\n";
  };
  std::string deviation = "deviation 0: the exact hull";
  if (k > 0) {
    deviation = format("deviation %.3g", level.deviation);
    if (model.radius() > 0) deviation += format(" (%.2g %%)", 100 * level.deviation / model.radius());
  }
  return line(0, "font-weight=\"bold\" fill=\"#16263c\"", "level " + std::to_string(k)) +
         line(1, "fill=\"#3d4c60\"", counted(level.triangle_count, "triangle")) + line(2, "fill=\"#3d4c60\"", deviation);
}

std::string summary(const Model& model) {
  const int finest = model.finest_level(), last = model.level_count() - 1;
  std::string what = counted(model.level(finest).triangle_count, "triangle") + format(", %zu bytes", model.bytes().size());
  if (last > finest) {
    what = format("%d levels, %zu to %s, %zu bytes. Dashed: %s outline. Percent: of the bounding radius", last + 1 - finest,
                  model.level(finest).triangle_count, counted(model.level(last).triangle_count, "triangle").c_str(),
                  model.bytes().size(), finest == 0 ? "the exact hull's" : "the finest level's");
  }
  return what;
}

std::string summary(const MeshModel& mesh) {
  if (!mesh.is_whole())
    return format("boxes of %d of %d levels, no point of them farther than %.3g from the surface, %zu bytes",
                  mesh.level_count(), mesh.depth(), mesh.deviation(), mesh.bytes().size());
  return counted(mesh.triangle_count(), "triangle") + format(", %zu bytes, ", mesh.bytes().size()) +
         (mesh.topology().closed() ? "closed" : "not closed");
}

/// A picture's beginning, as far as what it shows.
std::string heading(double width, double height, const std::string& title, const std::string& what) {
  return format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" ", width,
                height, width, height) +
         "font-family=\"sans-serif\" font-size=\"13\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>" +
         escaped(title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fbfaf7\"/>\n" +
         format("<text x=\"%.0f\" y=\"40\" font-size=\"22\" font-weight=\"bold\" fill=\"#16263c\">", kMargin) + escaped(title) +
         "</text>\n" + format("<text x=\"%.0f\" y=\"62\" fill=\"#3d4c60\">", kMargin) + what + "</text>\n";
}

/// `width`: what the heading needs at least.
std::string picture(const std::vector<Polygon>& polygons, const Eye& eye, double width, const std::string& title,
                    const std::string& what) {
  const Placement place(frame_of(polygons));
  const double y = kHeading + kGap / 2;
  return heading(width, y + place.height() + kGap, title, what) +
         format("<g transform=\"translate(%.1f %.1f)\">\n", kMargin, y) + draw_polygons(polygons, eye, place) +
         "</g>\n</svg>\n";
}

}  // namespace

std::string draw(const Model& model, const std::string& title) {
  const Eye eye;
  const Placement place(frame_of(model, eye));
  const int finest = model.finest_level();
  const std::size_t count = std::size_t(model.level_count() - finest), rows = (count + kPerRow - 1) / kPerRow,
                    columns = (count + rows - 1) / rows;
  const double row_height = place.height() + kCaption + kGap;
  // As wide as its heading, also with few levels.
  const double width = std::max(2 * kMargin + double(columns) * kCell + double(columns - 1) * kGap, count > 1 ? 860.0 : 420.0);
  const double height = kHeading + kGap / 2 + double(rows) * row_height;

  std::string svg = heading(width, height, title, summary(model));
  for (std::size_t i = 0; i < count; ++i) {
    const int k = finest + int(i);
    const std::size_t row = i / columns, column = i % columns;
    const double x = kMargin + double(column) * (kCell + kGap), y = kHeading + kGap / 2 + double(row) * row_height;
    svg += format("<g transform=\"translate(%.1f %.1f)\">\n", x, y) + draw_faces(model.level(k).view, eye, place);
    if (k > finest) svg += draw_outline(model.level(finest).view, eye, place);
    svg += caption(model, k, place.height()) + "</g>\n";
  }
  return svg + "</svg>\n";
}

std::string draw(const MeshModel& mesh, const std::string& title) {
  const Eye eye;
  return picture(polygons_of(mesh, eye), eye, mesh.is_whole() ? 420 : 620, title, summary(mesh));
}

std::string draw(const MeshModel& mesh, const std::string& title, std::span<const std::uint32_t> patch_of) {
  const Eye eye;
  std::vector<Polygon> polygons = polygons_of(mesh, eye);
  std::uint32_t count = 0;
  for (std::size_t t = 0; t < polygons.size(); ++t) {
    polygons[t].pale = colour_of_patch(patch_of[t]);
    count = std::max(count, patch_of[t] + 1);
  }
  return picture(polygons, eye, 420, title,
                 counted(polygons.size(), "triangle") + " in " + counted(count, "convex patch", "convex patches"));
}

}  // namespace swiftlet::tool
