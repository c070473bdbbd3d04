// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "answer_text.h"

#include <algorithm>

#include "text.h"

namespace swiftlet::tool {
namespace {

const char* name(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::Vertex: return "vertex";
    case FeatureKind::Edge: return "edge";
    case FeatureKind::Face: return "face";
    case FeatureKind::None: break;
  }
  return "none";
}

}  // namespace

Json json_of(const Vec3& v) { return v.hasNaN() ? Json() : Json{v.x(), v.y(), v.z()}; }

Json json_of(const Pose& pose) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back({pose.rotation(row, 0), pose.rotation(row, 1), pose.rotation(row, 2), pose.translation[row]});
  return rows;
}

const char* name(Status status) {
  switch (status) {
    case Status::NotAsked: return "NotAsked";
    case Status::Converged: return "Converged";
    case Status::Beyond: return "Beyond";
    case Status::Budget: return "Budget";
    case Status::LevelLimit: return "LevelLimit";
    case Status::NotConverged: return "NotConverged";
    case Status::InvalidPose: return "InvalidPose";
    case Status::InvalidRadius: return "InvalidRadius";
    case Status::InvalidBody: break;
  }
  return "InvalidBody";
}

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Disjoint: return "Disjoint";
    case Verdict::Touching: return "Touching";
    case Verdict::Overlapping: return "Overlapping";
    case Verdict::Undecided: break;
  }
  return "Undecided";
}

std::string in_words(Status status) {
  if (status == Status::LevelLimit) return "LevelLimit: finer levels, which it would take, were cut";
  if (status == Status::NotConverged) return "NotConverged: no narrower interval is proved";
  return name(status);
}

std::string text_of(const Witness& w) {
  if (w.feature.kind() == FeatureKind::None) return "none";
  std::string text = name(w.feature.kind());
  if (w.source.kind == FeatureKind::None)
    return text + format(" %u of ", w.feature.index()) + (w.of_mesh ? "the tree" : format("level %d", w.level));
  if (w.source.kind == FeatureKind::Vertex) return text + format(" %u", w.source.vertices[0]);
  if (w.source.kind == FeatureKind::Edge)
    return text + format(" between vertices %u and %u", w.source.vertices[0], w.source.vertices[1]);
  constexpr std::size_t kShown = 8;
  if (w.source.triangles.empty()) return text + " of the hull, on no triangle of the input";
  text += w.source.triangles.size() == 1 ? ", triangle" : ", triangles";
  for (std::size_t k = 0; k < std::min(kShown, w.source.triangles.size()); ++k) text += format(" %u", w.source.triangles[k]);
  if (w.source.triangles.size() > kShown) text += format(" and %zu more", w.source.triangles.size() - kShown);
  return text;
}

Json json_of(const Witness& w) {
  Json json{{"kind", name(w.feature.kind())}, {"level", w.level}, {"index", w.feature.index()}};
  if (w.source.kind == FeatureKind::Vertex) json["vertices"] = Json::array({w.source.vertices[0]});
  if (w.source.kind == FeatureKind::Edge) json["vertices"] = w.source.vertices;
  if (w.source.kind == FeatureKind::Face)
    json["triangles"] = std::vector<std::uint32_t>(w.source.triangles.begin(), w.source.triangles.end());
  return json;
}

std::string hash_text(std::uint64_t hash) { return format("%016llx", static_cast<unsigned long long>(hash)); }

}  // namespace swiftlet::tool
