// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace swiftlet::stability {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%a", x);
  return buffer;
}

/// A JSON number, or a string that strtod reads to its end: hex floats.
double number(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const std::string text = json.get<std::string>();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end) throw std::runtime_error("'" + text + "' is no number");
  return value;
}

std::vector<Vec3> points(const Json& json) {
  std::vector<Vec3> result;
  for (const Json& p : json.at("vertices")) {
    if (p.size() != 3) throw std::runtime_error("a vertex needs three coordinates");
    result.emplace_back(number(p[0]), number(p[1]), number(p[2]));
  }
  if (result.empty()) throw std::runtime_error("no vertices");
  return result;
}

Json points_json(const std::vector<Vec3>& points) {
  Json vertices = Json::array();
  for (const Vec3& p : points) vertices.push_back({hex(p.x()), hex(p.y()), hex(p.z())});
  return {{"vertices", vertices}};
}

/// 4 x 4, row after row.
Pose pose(const Json& json) {
  if (json.size() != 16) throw std::runtime_error("a pose needs 16 numbers");
  Pose result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.rotation(i, j) = number(json[std::size_t(4 * i + j)]);
    result.translation[i] = number(json[std::size_t(4 * i + 3)]);
  }
  return result;
}

Json pose_json(const Pose& pose) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rows.push_back(hex(pose.rotation(i, j)));
    rows.push_back(hex(pose.translation[i]));
  }
  for (const int x : {0, 0, 0, 1}) rows.push_back(x);
  return rows;
}

Case read_case(const Json& json) {
  Case c;
  c.name = json.at("name").get<std::string>();
  c.category = json.at("category").get<std::vector<std::string>>();
  if (c.category.empty()) throw std::runtime_error("no category");
  c.source = json.value("source", "");
  c.license = json.value("license", "");
  c.symptom = json.value("symptom", "");
  c.a = points(json.at("A"));
  c.b = points(json.at("B"));
  c.a_in_world = pose(json.at("poseA"));
  c.b_in_world = pose(json.at("poseB"));
  if (const auto it = json.find("expected"); it != json.end()) {
    c.expected = Expected{it->at("sign").get<int>(), number(it->at("distance"))};
  }
  return c;
}

Json case_json(const Case& c) {
  Json json{{"name", c.name},
            {"category", c.category},
            {"source", c.source},
            {"license", c.license},
            {"A", points_json(c.a)},
            {"B", points_json(c.b)},
            {"poseA", pose_json(c.a_in_world)},
            {"poseB", pose_json(c.b_in_world)},
            {"symptom", c.symptom}};
  if (c.expected) json["expected"] = {{"sign", c.expected->sign}, {"distance", hex(c.expected->distance)}};
  return json;
}

double error_of(const Mat3& r) { return (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff(); }

}  // namespace

double Case::orthonormality_error() const { return std::max(error_of(a_in_world.rotation), error_of(b_in_world.rotation)); }

std::vector<Case> read_cases(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  std::string where = path.string();
  try {
    std::vector<Case> cases;
    for (const Json& json : Json::parse(file)) {
      where = path.string() + ": case " + std::to_string(cases.size()) + " (" + json.value("name", "nameless") + ")";
      cases.push_back(read_case(json));
    }
    return cases;
  } catch (const std::exception& error) {
    throw std::runtime_error(where + ": " + error.what());
  }
}

void write_cases(const std::filesystem::path& path, std::span<const Case> cases) {
  Json all = Json::array();
  for (const Case& c : cases) all.push_back(case_json(c));
  std::filesystem::path partial = path;
  partial += ".partial";
  {
    std::ofstream file(partial);
    file << all.dump(1) << '\n';
    if (!file.flush()) throw std::runtime_error(partial.string() + ": cannot be written");
  }
  std::filesystem::rename(partial, path);
}

}  // namespace swiftlet::stability
