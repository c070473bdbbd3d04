// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the words say of meshes.
#include "words.h"

#include <vector>

#include <swiftlet/check.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include "answer_text.h"
#include "body/file.h"
#include "draw.h"
#include "mesh_block.h"
#include "mesh_boxes.h"
#include "mesh_setting.h"
#include "off_text.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

/// What one more level of nodes adds, from the root on.
struct NodeLevel {
  std::size_t nodes;
  double deviation;      ///< of the mesh cut after this level
  std::uint64_t prefix;  ///< bytes of the file, to the level's end; of the last level of a whole mesh to the file's
};

std::vector<NodeLevel> levels_of(const MeshModel& mesh) {
  const MeshHeader& header = MeshReader::content(mesh).header;
  std::vector<NodeLevel> levels;
  for (int k = 0; k < mesh.level_count(); ++k) {
    const Section& section = header.level[k];
    const bool is_all = mesh.is_whole() && k + 1 == mesh.level_count();
    levels.push_back({std::size_t(section.bytes / sizeof(Node)), mesh.deviation(k + 1),
                      is_all ? header.total_bytes : section.offset + section.bytes});
  }
  return levels;
}

std::size_t triangles_of_whole(const MeshModel& mesh) { return MeshReader::content(mesh).header.triangle_count; }
std::size_t hull_bytes(const MeshModel& mesh) {
  const MeshHeader& header = MeshReader::content(mesh).header;
  return std::size_t(header.hulls.bytes + header.hull_models.bytes);
}

Error was_cut(const std::string& path, const char* therefore) {
  return in_file(path, {ErrorCode::BadValue, std::string("was cut: it has no triangles, ") + therefore});
}

}  // namespace

Json mesh_json(const MeshModel& mesh) {
  const MeshTopology& t = mesh.topology();
  const std::size_t bytes = mesh.bytes().size();
  Json levels = Json::array();
  for (const NodeLevel& level : levels_of(mesh))
    levels.push_back({{"nodes", level.nodes}, {"deviation", level.deviation}, {"prefix", level.prefix}});
  return {{"bytes", bytes},
          {"bytes_per_triangle", mesh.is_whole() ? Json(double(bytes) / double(mesh.triangle_count())) : Json()},
          {"hash", hash_text(mesh.hash())},
          {"whole", mesh.is_whole()},
          {"vertices", mesh.vertex_count()},
          {"triangles", mesh.triangle_count()},
          {"topology",
           {{"components", t.components},
            {"open_edges", t.open_edges},
            {"non_manifold_edges", t.non_manifold_edges},
            {"flipped_edges", t.flipped_edges},
            {"flat_triangles", t.flat_triangles},
            {"duplicates", t.duplicates},
            {"closed", t.closed()},
            {"volume", t.closed() ? Json(t.volume) : Json()}}},
          {"box_min", json_of(mesh.box_min())},
          {"box_max", json_of(mesh.box_max())},
          {"nodes", mesh.node_count()},
          {"depth", mesh.depth()},
          {"deviation", mesh.deviation()},
          {"levels", levels},
          {"hulls", mesh.hull_count()},
          {"hull_bytes", hull_bytes(mesh)}};
}

std::string mesh_text(const MeshModel& mesh) {
  const MeshTopology& t = mesh.topology();
  std::string text = format(" bytes      %zu", mesh.bytes().size());
  if (mesh.is_whole()) text += format(", %.1f per triangle", double(mesh.bytes().size()) / double(mesh.triangle_count()));
  text += "\n hash       " + hash_text(mesh.hash()) + "\n";
  if (mesh.is_whole()) {
    text += format(" vertices   %zu\n triangles  %zu, ", mesh.vertex_count(), mesh.triangle_count());
  } else {
    text += format(" cut        after %d of %d levels of nodes: boxes, none farther than %.6g from the surface\n",
                   mesh.level_count(), mesh.depth(), mesh.deviation());
    text += format(" triangles  none left of %zu, ", triangles_of_whole(mesh));
  }
  text += format("%u of them flat, ", t.flat_triangles) + counted(t.duplicates, "duplicate") + "\n";
  text += format(" components %u\n edges      %u open, %u non-manifold, %u flipped\n", t.components, t.open_edges,
                 t.non_manifold_edges, t.flipped_edges);
  text += " volume     " + (t.closed() ? number(t.volume) + (t.volume < 0 ? ", inside out" : "") : "none: not closed") + "\n";
  text += " box        " + numbers(mesh.box_min()) + "  to  " + numbers(mesh.box_max()) + "\n";
  text += format(" nodes      %zu, in a tree of depth %d\n", mesh.node_count(), mesh.depth());
  text += format(" hulls      %zu, of %zu bytes\n", mesh.hull_count(), hull_bytes(mesh));
  text += " levels     nodes     deviation     prefix\n";
  int count = 0;
  for (const NodeLevel& level : levels_of(mesh))
    text += format("%7d %9zu %13.6g %10llu\n", ++count, level.nodes, level.deviation,
                   static_cast<unsigned long long>(level.prefix));
  return text;
}

Output info(const LoadedMesh& body) {
  Json json{{"path", body.path}};
  json.update(mesh_json(body.mesh));
  return {body.path + "\n" + mesh_text(body.mesh), dump(json)};
}

Result<Output> verify(const LoadedMesh& body) {
  const Check outcome = swiftlet::verify(body.mesh);
  if (!outcome) return in_file(body.path, {ErrorCode::BadValue, outcome.message});
  const std::size_t nodes = body.mesh.node_count(), hulls = body.mesh.hull_count(), triangles = body.mesh.triangle_count();
  return Output{body.path + ": verified: the boxes of " + counted(nodes, "node") + " and " + counted(hulls, "convex hull") +
                    format(" hold their triangles, each of %zu once\n", triangles),
                dump({{"path", body.path}, {"verified", true}, {"nodes", nodes}, {"hulls", hulls}, {"triangles", triangles}})};
}

Result<MeshBody> shape_of(const LoadedBody& body, bool solid) {
  const auto* const loaded = std::get_if<LoadedMesh>(&body);
  if (!loaded) return MeshBody(Body(std::get<LoadedModel>(body).model));
  if (!solid) return MeshBody(loaded->mesh);
  if (!loaded->mesh.is_whole()) return was_cut(loaded->path, "which tell what is inside of a solid");
  const MeshTopology& t = loaded->mesh.topology();
  if (!t.closed())
    return in_file(loaded->path,
                   {ErrorCode::NotSolid, format("is not closed, so it is no solid: %u open edges, %u of more than "
                                                "two triangles, %u flipped",
                                                t.open_edges, t.non_manifold_edges, t.flipped_edges)});
  return MeshBody::solid(loaded->mesh);
}

namespace {

/// One body of a pair whose contacts are asked for.
struct Side {
  MeshBody body;
  int level;

  Side(const LoadedBody& loaded, const MeshBody& shape) : body(shape), level(0) {
    if (const auto* const model = std::get_if<LoadedModel>(&loaded)) level = model->model.finest_level();
  }
  Witness witness(FeatureId feature) const {
    return {feature, level, source_feature(body, feature, level), body.mesh() != nullptr};
  }
  /// The user's triangle; null of a convex body.
  Json triangle(std::uint32_t index) const {
    return body.mesh() && index != kNone ? Json(body.mesh()->source_triangle()[index]) : Json();
  }
};

/// Both in the order of the contacts.
struct Regions {
  MeshContacts found;
  std::vector<MeshContact> contacts;
};

/// All of them: asked again with more room, as long as there are too many to tell apart in what there is.
Regions all_regions(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double reach) {
  constexpr std::size_t kLeastRoom = 256, kMostRoom = 1 << 16;
  Regions all;
  for (std::size_t room = kLeastRoom; room <= kMostRoom; room *= 4) {
    all.contacts.resize(room);
    all.found = contacts(a, b, b_in_a, reach, all.contacts);
    if (all.found.status != Status::Budget) break;
  }
  all.contacts.resize(all.found.stored);
  return all;
}

Json json_of(const Manifold& manifold, const Side& a, const Side& b) {
  Json points = Json::array();
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    points.push_back({{"separation", p.separation},
                      {"point_a", tool::json_of(p.point_a)},
                      {"point_b", tool::json_of(p.point_b)},
                      {"feature_a", tool::json_of(a.witness(p.feature_a))},
                      {"feature_b", tool::json_of(b.witness(p.feature_b))}});
  }
  return {{"normal", manifold.count > 0 ? tool::json_of(manifold.normal) : Json()}, {"points", points}};
}

std::string text_of(const Manifold& manifold) {
  if (manifold.count == 0) return "manifold   none\n";
  std::string text = "manifold   " + counted(manifold.count, "point") + " along the normal " + numbers(manifold.normal) + "\n";
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    text += "           " + number(p.separation) + " from " + numbers(p.point_a) + "  to  " + numbers(p.point_b) + "\n";
  }
  return text;
}

Json json_of(const MeshContact& region, const Side& a, const Side& b) {
  return {{"lower", region.lower},
          {"upper", region.upper},
          {"verdict", name(region.verdict)},
          {"point_a", tool::json_of(region.point_a)},
          {"point_b", tool::json_of(region.point_b)},
          {"normal", tool::json_of(region.normal)},
          {"triangle_a", a.triangle(region.triangle_a)},
          {"triangle_b", b.triangle(region.triangle_b)},
          {"feature_a", tool::json_of(a.witness(region.feature_a))},
          {"feature_b", tool::json_of(b.witness(region.feature_b))},
          {"box_min", tool::json_of(region.box_min)},
          {"box_max", tool::json_of(region.box_max)}};
}

std::string text_of(const MeshContact& region, const Side& a, const Side& b) {
  const auto triangle = [](const Json& id, const char* of) {
    return (id.is_null() ? "none" : id.dump()) + std::string(" of ") + of;
  };
  return std::string("[") + number(region.lower) + ", " + number(region.upper) + "] " + name(region.verdict) + "\npoint_a    " +
         numbers(region.point_a) + "\npoint_b    " + numbers(region.point_b) + "\nnormal     " + numbers(region.normal) +
         "\nfeature_a  " + tool::text_of(a.witness(region.feature_a)) + "\nfeature_b  " +
         tool::text_of(b.witness(region.feature_b)) + "\ntriangles  " + triangle(a.triangle(region.triangle_a), "A") + ", " +
         triangle(b.triangle(region.triangle_b), "B") + "\nbox        " + numbers(region.box_min) + "  to  " +
         numbers(region.box_max) + "\n";
}

}  // namespace

Result<Output> contacts(const LoadedBody& a, const LoadedBody& b, const Pose& b_in_a, const Asked& asked) {
  for (const LoadedBody* body : {&a, &b}) {
    const auto* const loaded = std::get_if<LoadedMesh>(body);
    if (loaded && !loaded->mesh.is_whole()) return was_cut(loaded->path, "and its contacts are not known");
  }
  const Result<MeshBody> shape_a = shape_of(a, asked.solid), shape_b = shape_of(b, asked.solid);
  if (!shape_a) return shape_a.error();
  if (!shape_b) return shape_b.error();
  const Side side_a(a, shape_a.value()), side_b(b, shape_b.value());
  const double reach = *asked.reach;
  const auto [found, regions] = all_regions(side_a.body, side_b.body, b_in_a, reach);

  Json rows = Json::array();
  std::string text = std::string("contacts   ") + (found.is_counted ? "" : "at least ") + counted(found.count, "region") +
                     " within " + number(reach) + "; points are in A's frame, normals from A to B\n";
  for (std::size_t i = 0; i < regions.size(); ++i) {
    rows.push_back(json_of(regions[i], side_a, side_b));
    text += format("region %-4zu", i) + text_of(regions[i], side_a, side_b);
    if (!asked.manifolds) continue;
    const Manifold points = manifold(side_a.body, side_b.body, b_in_a, regions[i], {.margin = reach});
    rows.back()["manifold"] = json_of(points, side_a, side_b);
    text += text_of(points);
  }
  text += "status     " + in_words(found.status) + ", " + counted(found.steps, "step") + ", " +
          counted(found.plane_tests, "pair") + " of triangles\n";
  return Output{text, dump({{"a", path_of_body(a)},
                            {"b", path_of_body(b)},
                            {"b_in_a", tool::json_of(b_in_a)},
                            {"reach", reach},
                            {"count", found.count},
                            {"counted", found.is_counted},
                            {"contacts", rows},
                            {"status", name(found.status)},
                            {"steps", found.steps},
                            {"plane_tests", found.plane_tests}})};
}

Result<Output> export_mesh(const LoadedMesh& body, const std::filesystem::path& path) {
  if (!body.mesh.is_whole()) return was_cut(body.path, "which an OFF file is made of");
  const Result<std::size_t> bytes = write_file(path, off_text(body.mesh));
  if (!bytes) return bytes.error();
  const std::size_t triangles = body.mesh.triangle_count(), vertices = body.mesh.vertex_count();
  return Output{utf8(path) + ": " + counted(vertices, "vertex", "vertices") + ", " + counted(triangles, "triangle") +
                    format(", %zu bytes\n", bytes.value()),
                dump({{"path", utf8(path)}, {"vertices", vertices}, {"triangles", triangles}, {"bytes", bytes.value()}})};
}

Result<Output> cut_mesh(const std::string& path, const std::string& to, const Detail& detail, bool salvaging) {
  std::string note;
  const Result<MeshModel> cut = [&]() -> Result<MeshModel> {
    if (!salvaging) return load_mesh(path_of(path), detail);
    Result<SalvagedMesh> left = salvage_mesh(path_of(path));
    if (!left) return left.error();
    note = left.value().note;
    return left.value().mesh.cut(detail);
  }();
  if (!cut) return cut.error();
  const MeshModel& mesh = cut.value();
  if (mesh.depth() == 1 && (detail.deviation > 0 || detail.bytes < mesh.bytes().size()))
    return in_file(path, {ErrorCode::BadValue, "has one level of nodes: there is nothing to cut"});
  const Result<std::size_t> bytes = write_file(path_of(to), mesh.bytes());
  if (!bytes) return bytes.error();
  return Output{to +
                    format(": %d of %d levels of nodes, deviation %.6g, ", mesh.level_count(), mesh.depth(), mesh.deviation()) +
                    counted(mesh.hull_count(), "hull") + format(", %zu bytes\n", bytes.value()),
                dump({{"path", to},
                      {"levels", mesh.level_count()},
                      {"depth", mesh.depth()},
                      {"deviation", mesh.deviation()},
                      {"hulls", mesh.hull_count()},
                      {"bytes", bytes.value()},
                      {"note", note}}),
                note};
}

Result<Output> draw_file(const LoadedMesh& body, const std::filesystem::path& path) {
  const Result<std::size_t> bytes = write_file(path, draw(body.mesh, stem(body.path)));
  if (!bytes) return bytes.error();
  const bool whole = body.mesh.is_whole();
  const std::size_t count = whole ? body.mesh.triangle_count() : lowest_boxes(body.mesh).size();
  const std::string what = whole ? counted(count, "triangle") : counted(count, "box", "boxes");
  return Output{utf8(path) + ": " + what + format(", %zu bytes\n", bytes.value()),
                dump({{"path", utf8(path)}, {whole ? "triangles" : "boxes", count}, {"bytes", bytes.value()}})};
}

}  // namespace swiftlet::tool
