// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Model, MeshModel, Level, Topology and Body.
#include "py_body.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <swiftlet/check.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/model_file.h>

#include "arguments.h"
#include "arrays.h"
#include "crew.h"
#include "draw.h"
#include "failure.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

using ModelPointer = std::shared_ptr<HeldModel>;
using MeshPointer = std::shared_ptr<HeldMesh>;

// Runs without the interpreter's lock.
template <class Work>
auto unlocked(Work work) {
  const py::gil_scoped_release release;
  return work();
}

ModelPointer held(Model&& model, std::string mapped = {}) {
  return std::make_shared<HeldModel>(HeldModel{std::move(model), std::move(mapped)});
}
MeshPointer held(MeshModel&& mesh, std::string mapped = {}) {
  return std::make_shared<HeldMesh>(HeldMesh{std::move(mesh), std::move(mapped)});
}

Detail to_detail(const Real& deviation, const Whole& bytes) {
  Detail d;
  d.deviation = to_double(deviation, "deviation");
  if (!(d.deviation >= 0))
    throw py::value_error("deviation: expected a number from 0 on, got " + py::cast<std::string>(py::repr(deviation)));
  if (const auto kept = to_bytes_kept(bytes)) d.bytes = *kept;
  return d;
}

TableSpec to_table_spec(const Whole& resolution, const Real& radius_factor, const Whole& map_cells) {
  return {lut::Resolution(to_whole(resolution, "resolution", 0, 3)), to_double(radius_factor, "radius_factor"),
          to_count(map_cells, "map_cells")};
}

std::string scalar(double x) { return py::cast<std::string>(py::str("{:.6g}").format(x)); }

// ---- Levels ----------------------------------------------------------------------------------------------------------------

struct HeldLevel {
  ModelPointer model;
  int index;
  const Level& level() const { return model->value.level(index); }
  const ConvexView& view() const { return level().view; }
};

/// A column or several of an array of structures.
template <class Record, class T>
py::array column(std::span<const Record> records, const T Record::*first, int count, py::handle owner) {
  const T* data = records.empty() ? nullptr : &(records.data()->*first);
  if (count == 1) return view(data, {py::ssize_t(records.size())}, {sizeof(Record)}, owner);
  return view(data, {py::ssize_t(records.size()), count}, {sizeof(Record), sizeof(T)}, owner);
}

py::array feature_ids(std::span<const FeatureId> ids, py::handle owner) {
  static_assert(sizeof(FeatureId) == sizeof(std::uint32_t));
  return view(reinterpret_cast<const std::uint32_t*>(ids.data()), {py::ssize_t(ids.size())}, {sizeof(FeatureId)}, owner);
}

py::array triangles_of(const ConvexView& view) {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t v : FaceLoop(view, f)) loop.push_back(v);
    for (std::size_t k = 2; k < loop.size(); ++k) corners.insert(corners.end(), {loop[0], loop[k - 1], loop[k]});
  }
  return frozen(py::array_t<std::uint32_t>({py::ssize_t(corners.size() / 3), py::ssize_t(3)}, corners.data()));
}

py::list faces_of(const ConvexView& view) {
  py::list faces;
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t v : FaceLoop(view, f)) loop.push_back(v);
    faces.append(frozen(to_array(std::span<const std::uint32_t>(loop))));
  }
  return faces;
}

template <class Class>
void add_levels(Class& c) {
  c.def_property_readonly(
      "index", [](const HeldLevel& l) { return l.index; }, "Number of the level: 0 is the exact hull.");
  c.def_property_readonly(
      "vertices", [](const HeldLevel& l) { return column(l.view().vertices, &Vertex::x, 3, py::cast(l.model)); },
      "Vertices, (V, 3) float64, a read-only view of the model's memory; body frame, the caller's unit.");
  c.def_property_readonly(
      "rings", [](const HeldLevel& l) { return column(l.view().vertices, &Vertex::ring_begin, 2, py::cast(l.model)); },
      "Per vertex the first half-edge that starts there and their number, (V, 2) uint32; counter-clockwise from outside.");
  c.def_property_readonly(
      "half_edges", [](const HeldLevel& l) { return column(l.view().half_edges, &HalfEdge::head, 3, py::cast(l.model)); },
      "Half-edges sorted by origin, (H, 3) uint32: head, twin, and the face on the left, 2**32 - 1 for a segment's.");
  c.def_property_readonly(
      "face_first", [](const HeldLevel& l) { return view(l.view().face_first, py::cast(l.model)); },
      "Per face a half-edge of its loop, (F,) uint32.");
  c.def_property_readonly(
      "planes", [](const HeldLevel& l) { return column(l.view().planes, &FacePlane::x, 5, py::cast(l.model)); },
      "Planes of the first P faces, those of more than three vertices, (P, 5) float64: unit outward normal, thickness, over.");
  c.def_property_readonly(
      "triangles", [](const HeldLevel& l) { return triangles_of(l.view()); },
      "Faces as fans of triangles over `vertices`, (T, 3) uint32, counter-clockwise from outside. A copy.");
  c.def_property_readonly(
      "faces", [](const HeldLevel& l) { return faces_of(l.view()); },
      "Faces as loops of vertices, a list of F arrays of uint32, counter-clockwise from outside. A copy.");
  c.def_property_readonly(
      "child_vertex", [](const HeldLevel& l) { return view(l.level().child_vertex, py::cast(l.model)); },
      "Per vertex the vertex one level finer, (V,) uint32; empty on level 0.");
  c.def_property_readonly(
      "child_face", [](const HeldLevel& l) { return feature_ids(l.level().child_face, py::cast(l.model)); },
      "Per face the id of the face or vertex one level finer, (F,) uint32; empty on level 0.");
  c.def_property_readonly(
      "parent_face", [](const HeldLevel& l) { return view(l.level().parent_face, py::cast(l.model)); },
      "Per face the vertex one level coarser, (F,) uint32; empty on the coarsest level.");
  c.def_property_readonly(
      "support_map", [](const HeldLevel& l) { return view(l.level().support_map, py::cast(l.model)); },
      "Per cell of an octahedron the vertex extreme there and a bound on its error; empty without a map.");
  c.def_property_readonly(
      "map_side", [](const HeldLevel& l) { return l.level().map_side; }, "The support map has 2 * map_side**2 cells.");
  c.def_property_readonly(
      "is_round", [](const HeldLevel& l) { return l.level().is_round; }, "`map_frame` is about a multiple of the identity.");
  c.def_property_readonly(
      "map_frame", [](const HeldLevel& l) { return py::array_t<double>(6, l.level().map_frame.data()); },
      "Rows of an upper triangular matrix M, from the diagonal on: the map is looked up along M n.");
#define SWIFTLET_NUMBER(name, expression, text) \
  c.def_property_readonly(                      \
      name, [](const HeldLevel& l) { return expression; }, text);
  SWIFTLET_NUMBER(
      "deviation", l.level().deviation,
      "Bound on the distance of this level's points from level 0, above the truth by at most 1 % of it and rounding.")
  SWIFTLET_NUMBER("volume", l.level().volume, "In cubic units; 0 for a body that is not solid.")
  SWIFTLET_NUMBER("map_doubt", l.level().map_doubt, "About the mean error of a look-up in `support_map`, a length.")
  SWIFTLET_NUMBER(
      "scale_around", l.level().scale_around,
      "With M of `map_frame`: the body lies in the ellipsoid `centre` + scale_around M^T y, |y| <= 1; inf: not known.")
  SWIFTLET_NUMBER("scale_inside", l.level().scale_inside, "The body holds the ellipsoid of this scale; 0: not known.")
  c.def_property_readonly(
      "feature_count",
      [](const HeldLevel& l) {
        const auto& counts = l.level().feature_count;
        return py::make_tuple(counts[1], counts[2], counts[3]);
      },
      "Numbers of vertices, half-edges and faces; 0 on absent levels.");
  SWIFTLET_NUMBER("edge_length", l.level().edge_length, "Mean length of the level's edges.")
  SWIFTLET_NUMBER("same_cos2", l.level().same_cos2,
                  "Squared cosine of the turn after which a seed's features are stored again; 0: never.")
  SWIFTLET_NUMBER("near_cos2", l.level().near_cos2,
                  "Squared cosine of the turn after which they are worse than a cold start; 0: never.")
  SWIFTLET_NUMBER("bytes", l.level().bytes, "Size of this level in the block of a whole model.")
  SWIFTLET_NUMBER("prefix", l.level().prefix,
                  "Bytes from the beginning of the block to this level's end, of level 0 all; 0 if the block lacks it.")
  SWIFTLET_NUMBER("edge_count", l.level().edge_count, "Number of edges; known of absent levels too.")
  SWIFTLET_NUMBER("triangle_count", l.level().triangle_count,
                  "Number of triangles, 2 V - 4 for a solid; known of absent levels too.")
  SWIFTLET_NUMBER("extent", l.view().extent, "Largest absolute coordinate.")
  SWIFTLET_NUMBER("inner_radius", l.view().inner_radius,
                  "Radius of a ball around `centre` that lies in the body; 0: none is known.")
  SWIFTLET_NUMBER("reach", l.view().reach, "Upper bound on the distance of two points of the body; 0: not known.")
#undef SWIFTLET_NUMBER
  c.def_property_readonly(
      "centre", [](const HeldLevel& l) { return to_array(l.view().centre); },
      "A point of the body, where the line of centres ends.");
  c.def("__repr__", [](const HeldLevel& l) {
    return "<swiftlet.Level " + std::to_string(l.index) + ": " + std::to_string(l.level().triangle_count) +
           " triangles, deviation " + scalar(l.level().deviation) + ">";
  });
}

// ---- Models ----------------------------------------------------------------------------------------------------------------

/// One level's arrays, owned, as LevelArrays sees them.
struct OwnedArrays {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> face_vertices, face_sizes, vertex_source, face_source_begin, face_source, child_vertex,
      child_of_face;

  explicit OwnedArrays(py::handle level) {
    vertices = to_points(level.attr("vertices"), "vertices");
    std::tie(face_vertices, face_sizes) = to_faces(level.attr("faces"), "faces");
    const auto optional = [&](const char* name, std::vector<std::uint32_t>& into) {
      const py::object value = level.attr(name);
      if (!value.is_none()) into = to_indices(value, name);
    };
    optional("vertex_source", vertex_source), optional("face_source_begin", face_source_begin);
    optional("face_source", face_source), optional("child_vertex", child_vertex), optional("child_of_face", child_of_face);
  }
  LevelArrays arrays() const {
    return {vertices, face_vertices, face_sizes, vertex_source, face_source_begin, face_source, child_vertex, child_of_face};
  }
};

ModelPointer from_levels(py::iterable levels, Flag repair, const Whole& resolution, const Real& radius_factor,
                         const Whole& map_cells, const Whole& threads) {
  const py::object as_level = py::module_::import("swiftlet._arrays").attr("as_level");
  std::vector<OwnedArrays> owned;
  for (const py::handle level : levels) owned.emplace_back(as_level(level));
  std::vector<LevelArrays> arrays;
  for (const OwnedArrays& level : owned) arrays.push_back(level.arrays());
  ModelOptions options;
  options.repair = repair;
  options.table = to_table_spec(resolution, radius_factor, map_cells);
  Unlocked crew(to_threads(threads));
  options.executor = crew.executor();
  std::optional<Result<Model>> model;
  model = Model::from_levels(arrays, options);
  crew.finish();
  return held(take(std::move(*model)));
}

ModelPointer with_table(const HeldModel& m, const Whole& resolution, const Real& radius_factor, const Whole& map_cells) {
  const TableSpec spec = to_table_spec(resolution, radius_factor, map_cells);
  return held(take(unlocked([&] { return m.value.with_table(spec); })));
}

template <class T>
py::array bytes_of(const std::shared_ptr<T>& m) {
  const std::span<const std::byte> bytes = m->value.bytes();
  return view(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), py::cast(m));
}

py::tuple reduce(const MeshPointer& m) {
  if (m->mapped.empty()) return made_again("MeshModel", "from_bytes", py::make_tuple(bytes_of(m)));
  return made_again("MeshModel", "_map_same", py::make_tuple(py::bytes(m->mapped), unlocked([&] { return m->value.hash(); })));
}
/// A mapped model is mapped again to the level that it had: finer ones would give other answers.
py::tuple reduce(const ModelPointer& m) {
  if (m->mapped.empty()) return made_again("Model", "from_bytes", py::make_tuple(bytes_of(m)));
  const int finest = m->value.finest_level();
  const std::optional<std::uint64_t> bytes = finest > 0 ? std::optional(m->value.level(finest).prefix) : std::nullopt;
  return made_again("Model", "_map_same",
                    py::make_tuple(py::bytes(m->mapped), unlocked([&] { return m->value.hash(); }), bytes));
}

template <class Pointer>
Pointer same(Pointer m, std::uint64_t hash) {
  if (unlocked([&] { return m->value.hash(); }) != hash)
    raise({ErrorCode::BadFormat, "'" + m->mapped + "' is not the file that was mapped when this was pickled", m->mapped});
  return m;
}

/// What a mapped model is pickled by.
std::string absolute(const std::string& path) {
  std::error_code failure;
  const std::filesystem::path found = std::filesystem::absolute(path, failure);
  if (failure) raise({ErrorCode::CannotRead, (path.empty() ? "''" : path) + ": " + failure.message(), path});
  return found.string();
}

void define_model(py::class_<HeldModel, ModelPointer>& c) {
  c.def_static(
      "load",
      [](py::handle path, const Real& deviation, const Whole& bytes) {
        const std::string name = to_path(path);
        const Detail detail = to_detail(deviation, bytes);
        return held(take(unlocked([&] { return load(name, detail); })));
      },
      py::arg("path"), py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      R"(Reads a model file.

Parameters
----------
path : str or os.PathLike
    A file that :meth:`save` or the tool wrote.
deviation : float, optional
    Read no level finer than the coarsest one with a smaller deviation, in the body's unit. 0 reads all.
bytes : int, optional
    Read only levels that lie wholly in this many first bytes.

Returns
-------
Model

Raises
------
FileError
    The file cannot be read.
DataError
    It is damaged or of another version; the message names what and where.

Notes
-----
One pass over the bytes read, which checks sizes, hashes and topology; geometry is for :func:`verify`.)");
  c.def_static(
      "map",
      [](py::handle path, const Real& deviation, const Whole& bytes) {
        const std::string name = absolute(to_path(path));
        const Detail detail = to_detail(deviation, bytes);
        return held(take(unlocked([&] { return map(name, detail); })), name);
      },
      py::arg("path"), py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      R"(Loads a model without a copy: its memory is the mapped file, whose pages processes share.

The file's content must not change while the model or a copy of it lives. Parameters and errors are those of :meth:`load`; of
levels finer than asked no page is touched until :meth:`ensure`. Pickled, it is its path and hash.)");
  c.def_static(
      "salvage",
      [](py::handle path) {
        const std::string name = to_path(path);
        Salvaged found = take(unlocked([&] { return salvage(name); }));
        return py::make_tuple(held(std::move(found.model)), decoded(found.note));
      },
      py::arg("path"),
      "Reads the complete levels of a file that was cut short, up to `Level.prefix`.\n\nReturns\n-------\nmodel : Model\nnote "
      ": str\n"
      "    What is missing; empty for a whole file.");
  c.def_static(
      "from_bytes",
      [](py::buffer data, const Real& deviation, const Whole& bytes) {
        const py::buffer_info info = data.request();
        return held(take(load(to_bytes(info), to_detail(deviation, bytes))));
      },
      py::arg("data"), py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      "Loads a model from the bytes of a file, any contiguous buffer, which are copied. Parameters and errors: :meth:`load`.");
  c.def_static("_map_same", [](py::handle name, std::uint64_t hash, std::optional<std::uint64_t> bytes) {
    const std::string path = to_path(name);
    Detail detail;
    if (bytes) detail.bytes = *bytes;
    return same(held(take(unlocked([&] { return map(path, detail); })), path), hash);
  });
  c.def_static(
      "from_arrays",
      [](py::object vertices, py::object faces, py::object vertex_source, py::object face_source, Flag repair,
         const Whole& resolution, const Real& radius_factor, const Whole& map_cells, const Whole& threads) {
        const py::object level = py::module_::import("swiftlet._arrays")
                                     .attr("LevelArrays")(vertices, faces, py::arg("vertex_source") = vertex_source,
                                                          py::arg("face_source") = face_source);
        return from_levels(py::make_tuple(level), repair, resolution, radius_factor, map_cells, threads);
      },
      py::arg("vertices"), py::arg("faces"), py::kw_only(), py::arg("vertex_source") = py::none(),
      py::arg("face_source") = py::none(), py::arg("repair") = false, py::arg("resolution") = 0, py::arg("radius_factor") = 2.0,
      py::arg("map_cells") = 4u, py::arg("threads") = 1,
      R"(Makes a model of one level from a convex polytope as it is, without the builder.

Parameters
----------
vertices : array_like, shape (V, 3)
    Each coordinate 0 or from 1e-70 to 1e45 in magnitude, in the caller's unit.
faces : array_like of int, shape (F, 3), or sequence of loops
    Counter-clockwise from outside. A two-sided polygon is two opposite faces; no faces: a segment or a point.
vertex_source, face_source : array_like of int, optional
    The user's ids of vertices and faces, as :func:`closest_features` gives them.
repair : bool, optional
    Flip reflex edges that rounding left, instead of refusing them.
resolution, radius_factor, map_cells : optional
    The start table and support maps: see :meth:`with_table`.
threads : int, optional
    Same bytes on any number.

Returns
-------
Model

Raises
------
DataError
    The arrays are no closed convex surface, decided exactly; the message names the edge and its height.)");
  c.def_static(
      "from_levels", &from_levels, py::arg("levels"), py::kw_only(), py::arg("repair") = false, py::arg("resolution") = 0,
      py::arg("radius_factor") = 2.0, py::arg("map_cells") = 4u, py::arg("threads") = 1,
      "Makes a model of several levels, finest first: :class:`LevelArrays`, or pairs of vertices and faces. Each level must\n"
      "enclose the first, decided exactly. Options and errors: :meth:`from_arrays`.");
  c.def_static(
      "build",
      [](const py::args& args, const py::kwargs& options) {
        return py::module_::import("swiftlet.build").attr("build")(*args, **options).attr("model").cast<py::object>();
      },
      "Builds the convex hull of points, of a mesh file, or of anything with `vertices` and `faces`, with its levels of "
      "detail.\n\n"
      "The short form of :func:`swiftlet.build.build`, which says what it takes; that module comes under CGAL's GPL.");
  c.def(
      "save",
      [](const HeldModel& m, py::handle path) {
        const std::string name = to_path(path);
        return take(unlocked([&] { return save(m.value, name); }));
      },
      py::arg("path"),
      "Writes a file beside `path`, then renames it, so that a failure leaves the old file intact.\n\n"
      "Returns\n-------\nint\n    Bytes written.\n\nRaises\n------\nFileError");
  c.def(
      "cut",
      [](const HeldModel& m, const Real& deviation, const Whole& bytes) {
        const Detail detail = to_detail(deviation, bytes);
        return held(unlocked([&] { return m.value.cut(detail); }));
      },
      py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      "Returns the model without the levels that are finer than `deviation` (the body's unit) needs, or beyond the first "
      "`bytes`.\n\n"
      "Two bodies cut for deviations d each answer any distance with an error of at most 2 d.");
  c.def(
      "ensure",
      [](const HeldModel& m, const Whole& level) {
        Model more = m.value;
        const int wanted = to_int(level, "level");
        take(unlocked([&] { return more.ensure(wanted); }));
        return held(std::move(more), m.mapped);
      },
      py::arg("level"),
      "Returns the model with `level` and all coarser ones ready for queries, if its block holds them, as that of a\n"
      "mapped model does. Raises DataError if the block lacks the level or it is damaged.");
  c.def("with_table", &with_table, py::kw_only(), py::arg("resolution") = 0, py::arg("radius_factor") = 2.0,
        py::arg("map_cells") = 4u,
        "Returns the model with new support maps of about `map_cells` entries per vertex (0 to 64; 0: none) and a start table "
        "of a\n"
        ":class:`Resolution`, on a sphere of `radius_factor` bounding radii (1 to 1e6).");
  c.def(
      "support", [](const HeldModel& m, py::handle direction) { return m.value.support(to_vec3(direction, "direction")); },
      py::arg("direction"),
      "Index of a vertex of the finest level than which no other is farther along `direction` (3,). Exact.");
  c.def(
      "level",
      [](const ModelPointer& m, const Whole& number) {
        const int index = to_int(number, "index");
        if (index < 0 || index >= m->value.level_count())
          throw py::index_error("level " + std::to_string(index) + " of " + std::to_string(m->value.level_count()));
        return HeldLevel{m, index};
      },
      py::arg("index"), "Level `index`, 0 to level_count - 1; 0 is the exact hull.");
  c.def_property_readonly(
      "levels",
      [](const ModelPointer& m) {
        py::list levels;
        for (int k = 0; k < m->value.level_count(); ++k) levels.append(HeldLevel{m, k});
        return py::tuple(levels);
      },
      "All levels, the exact hull first; of those finer than `finest_level` only the numbers are known.");
  c.def_property_readonly(
      "vertices",
      [](const ModelPointer& m) {
        return column(m->value.level(m->value.finest_level()).view.vertices, &Vertex::x, 3, py::cast(m));
      },
      "Vertices of the finest level present, (V, 3) float64, a read-only view that keeps the model alive.");
  c.def_property_readonly(
      "faces", [](const HeldModel& m) { return triangles_of(m.value.level(m.value.finest_level()).view); },
      "Triangles of the finest level present over `vertices`, (F, 3) uint32, counter-clockwise from outside.");
#define SWIFTLET_NUMBER(name, expression, text) \
  c.def_property_readonly(                      \
      name, [](const HeldModel& m) { return expression; }, text);
  SWIFTLET_NUMBER("level_count", m.value.level_count(), "Number of levels, at least 1.")
  SWIFTLET_NUMBER("finest_level", m.value.finest_level(), "The finest level present; 0 in a whole model.")
  SWIFTLET_NUMBER("map_level", m.value.map_level(), "The finest level with a support map; level_count if there is none.")
  SWIFTLET_NUMBER("centre", to_array(m.value.centre()), "Area centroid of level 0, (3,), body frame.")
  SWIFTLET_NUMBER("radius", m.value.radius(), "Largest distance of a vertex of level 0 from `centre`, rounded up.")
  SWIFTLET_NUMBER("extent", m.value.extent(), "Largest absolute coordinate over all levels.")
  SWIFTLET_NUMBER("box_min", to_array(m.value.box_min()), "Smallest coordinates of level 0, (3,), body frame.")
  SWIFTLET_NUMBER("box_max", to_array(m.value.box_max()), "Largest coordinates of level 0, (3,), body frame.")
  SWIFTLET_NUMBER("volume", m.value.volume(), "Volume of level 0, in cubic units.")
  SWIFTLET_NUMBER("dimension", m.value.dimension(), "3 solid, 2 flat, 1 segment, 0 point.")
  SWIFTLET_NUMBER("is_mapped", !m.mapped.empty(), "True of a model whose memory is a mapped file.")
#undef SWIFTLET_NUMBER
  c.def_property_readonly(
      "source_vertex", [](const ModelPointer& m) { return view(m->value.source().vertex, py::cast(m)); },
      "Per vertex of level 0 the user's vertex, (V,) uint32; empty if level 0 is absent.");
  c.def_property_readonly(
      "source_face_begin", [](const ModelPointer& m) { return view(m->value.source().face_begin, py::cast(m)); },
      "Per face of level 0 the begin of its list in `source_face`, then the last's end, (F + 1,) uint32.");
  c.def_property_readonly(
      "source_face", [](const ModelPointer& m) { return view(m->value.source().face, py::cast(m)); },
      "Lists of the user's triangles, none or several per face.");
  c.def_property_readonly(
      "table", [](const ModelPointer& m) { return view(m->value.table(), py::cast(m)); },
      "The start table: a vertex of level 0 per sample; may be empty.");
  c.def_property_readonly(
      "table_spec",
      [](const HeldModel& m) {
        const TableSpec s = m.value.table_spec();
        return py::make_tuple(int(s.resolution), s.radius_factor, s.map_cells);
      },
      "What the table and the support maps were filled from: resolution, radius_factor, map_cells.");
}

template <class T>
void define_block(py::class_<Held<T>, std::shared_ptr<Held<T>>>& c) {
  using Pointer = std::shared_ptr<Held<T>>;
  c.def_property_readonly(
      "bytes", &bytes_of<Held<T>>,
      "The block, which is what `save` writes: (n,) uint8, a read-only view; of what is mapped the whole file.");
  c.def(
      "hash", [](const Held<T>& m) { return unlocked([&] { return m.value.hash(); }); },
      "Hash over all of `bytes`, which it reads; equal blocks have equal hashes. 64 bits.");
  c.def("__reduce__", [](const Pointer& m) { return reduce(m); });
  c.def("__copy__", [](const Pointer& m) { return m; });
  c.def(
      "__deepcopy__", [](const Pointer& m, const py::dict&) { return m; }, py::arg("memo"));
  c.def(
      "_repr_svg_", [](const Held<T>& m) { return tool::draw(m.value, "swiftlet"); },
      "The picture that a notebook shows: of a model all levels side by side.");
}

// ---- Meshes ----------------------------------------------------------------------------------------------------------------

MeshPointer mesh_from_arrays(py::handle vertices, py::handle faces, const py::object& progress) {
  const std::vector<Vec3> points = to_points(vertices, "vertices");
  const std::vector<std::array<std::uint32_t, 3>> triangles = to_triangles(faces, "faces");
  std::exception_ptr raised;
  MeshOptions options;
  options.progress = [&](double fraction) {
    const py::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return progress.is_none() || goes_on(progress(fraction));
    } catch (...) {
      raised = std::current_exception();
      return false;
    }
  };
  Result<MeshModel> mesh = unlocked([&] { return MeshModel::from_triangles(points, triangles, options); });
  if (raised) std::rethrow_exception(raised);
  return held(take(std::move(mesh)));
}

py::array mesh_vertices(const MeshModel& mesh) {
  py::array_t<double> result({py::ssize_t(mesh.vertex_count()), py::ssize_t(3)});
  double* out = result.mutable_data();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 v = mesh.vertex(i);
    out = std::copy_n(v.data(), 3, out);
  }
  return frozen(std::move(result));
}

py::array mesh_faces(const MeshModel& mesh) {
  py::array_t<std::uint32_t> result({py::ssize_t(mesh.triangle_count()), py::ssize_t(3)});
  std::uint32_t* out = result.mutable_data();
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const std::array<std::uint32_t, 3> t = mesh.triangle(i);
    out = std::copy_n(t.data(), 3, out);
  }
  return frozen(std::move(result));
}

void define_mesh(py::class_<HeldMesh, MeshPointer>& c) {
  c.def_static(
      "load",
      [](py::handle path, const Real& deviation, const Whole& bytes) {
        const std::string name = to_path(path);
        const Detail detail = to_detail(deviation, bytes);
        return held(take(unlocked([&] { return load_mesh(name, detail); })));
      },
      py::arg("path"), py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      "Reads a mesh from its file (not an STL or OBJ: :meth:`build` reads these); of one that `deviation` or `bytes` cut only "
      "what\n"
      "is kept.\n\nRaises\n------\nFileError, DataError");
  c.def_static(
      "map",
      [](py::handle path) {
        const std::string name = absolute(to_path(path));
        return held(take(unlocked([&] { return map_mesh(name); })), name);
      },
      py::arg("path"),
      "Loads a mesh without a copy: its memory is the mapped file, whose pages processes share. The file's content must not "
      "change\n"
      "while the mesh lives. Pickled, it is its path and hash.");
  c.def_static(
      "salvage",
      [](py::handle path) {
        const std::string name = to_path(path);
        SalvagedMesh found = take(unlocked([&] { return salvage_mesh(name); }));
        return py::make_tuple(held(std::move(found.mesh)), decoded(found.note));
      },
      py::arg("path"),
      "Reads the complete levels of nodes of a file that was cut short.\n\nReturns\n-------\nmesh : MeshModel\n"
      "note : str\n    What is missing; empty for a whole file.");
  c.def_static(
      "from_bytes",
      [](py::buffer data) {
        const py::buffer_info info = data.request();
        return held(take(load_mesh(to_bytes(info))));
      },
      py::arg("data"), "Loads a mesh from the bytes of a file, any contiguous buffer, which are copied.");
  c.def_static("_map_same", [](py::handle name, std::uint64_t hash) {
    const std::string path = to_path(name);
    return same(held(take(unlocked([&] { return map_mesh(path); })), path), hash);
  });
  c.def_static("from_arrays", &mesh_from_arrays, py::arg("vertices"), py::arg("faces"), py::kw_only(),
               py::arg("progress") = py::none(),
               R"(Makes a mesh of triangles of any topology, without hulls, which takes no builder.

Parameters
----------
vertices : array_like, shape (V, 3)
    Each coordinate 0 or from 1e-45 to 1e45 in magnitude, in the caller's unit. Points that no triangle has are dropped.
faces : array_like of int, shape (F, 3)
    At least one triangle; any winding.
progress : callable, optional
    Gets the fraction done; returning False cancels.

Returns
-------
MeshModel

Raises
------
DataError
    Names the point or triangle.
Cancelled

Notes
-----
About 2 microseconds and 90 bytes a triangle.)");
  c.def_static(
      "build",
      [](const py::args& args, const py::kwargs& options) {
        return py::module_::import("swiftlet.build").attr("build_mesh")(*args, **options);
      },
      "Makes a mesh with hulls of a mesh file, or of anything with `vertices` and `faces`.\n\n"
      "The same as :func:`swiftlet.build.build_mesh`, which says what it takes; that module comes under CGAL's GPL.");
  c.def(
      "save",
      [](const HeldMesh& m, py::handle path) {
        const std::string name = to_path(path);
        return take(unlocked([&] { return save(m.value, name); }));
      },
      py::arg("path"),
      "Writes a file beside `path`, then renames it.\n\nReturns\n-------\nint\n    Bytes "
      "written.\n\nRaises\n------\nFileError");
  c.def(
      "cut",
      [](const HeldMesh& m, const Real& deviation, const Whole& bytes) {
        const Detail detail = to_detail(deviation, bytes);
        return held(unlocked([&] { return m.value.cut(detail); }));
      },
      py::kw_only(), py::arg("deviation") = 0.0, py::arg("bytes") = py::none(),
      "Returns boxes around the surface, none farther from it than `deviation` (the body's unit), instead of triangles. "
      "Distances\n"
      "have the status LEVEL_LIMIT then, and an error of at most the sum of both deviations.");
  c.def(
      "refit",
      [](const HeldMesh& m, py::handle vertices) {
        const std::vector<Vec3> points = to_points(vertices, "vertices");
        return held(take(unlocked([&] { return refit(m.value, points); })));
      },
      py::arg("vertices"),
      "Returns the mesh with its points moved: `vertices` (V, 3) are the user's, in the order in which it was made from them. "
      "The\n"
      "tree stays, hulls go (:func:`swiftlet.build.rebuild_hulls`). A quarter of the time of :meth:`from_arrays`.");
  c.def(
      "deviation_at",
      [](const HeldMesh& m, const Whole& number) {
        const int levels = to_int(number, "levels");
        if (levels < 1 || levels >= m.value.depth())
          throw py::index_error("levels: expected 1 to depth - 1, got " + std::to_string(levels));
        return m.value.deviation(levels);
      },
      py::arg("levels"), "How far a point of the mesh cut after so many levels, 1 to depth - 1, may be from the surface.");
  c.def_property_readonly(
      "vertices", [](const HeldMesh& m) { return mesh_vertices(m.value); },
      "Vertices in the order of the tree, (V, 3) float64. A read-only copy.");
  c.def_property_readonly(
      "faces", [](const HeldMesh& m) { return mesh_faces(m.value); },
      "Triangles in the order of the tree, (F, 3) uint32. A read-only copy.");
  c.def_property_readonly(
      "source_vertex", [](const MeshPointer& m) { return view(m->value.source_vertex(), py::cast(m)); },
      "Per vertex the user's point there that a triangle names first, (V,) uint32.");
  c.def_property_readonly(
      "source_triangle", [](const MeshPointer& m) { return view(m->value.source_triangle(), py::cast(m)); },
      "Per triangle the user's triangle, (F,) uint32.");
#define SWIFTLET_NUMBER(name, expression, text) \
  c.def_property_readonly(                      \
      name, [](const HeldMesh& m) { return expression; }, text);
  SWIFTLET_NUMBER("topology", m.value.topology(), "What the mesh is made of.")
  SWIFTLET_NUMBER("box_min", to_array(m.value.box_min()), "Smallest coordinates, (3,), body frame.")
  SWIFTLET_NUMBER("box_max", to_array(m.value.box_max()), "Largest coordinates, (3,), body frame.")
  SWIFTLET_NUMBER("extent", m.value.extent(), "Largest absolute coordinate.")
  SWIFTLET_NUMBER("node_count", m.value.node_count(), "Nodes of the tree, each with up to eight children.")
  SWIFTLET_NUMBER("hull_count", m.value.hull_count(), "Nodes that have a convex hull.")
  SWIFTLET_NUMBER("is_whole", m.value.is_whole(), "True unless the mesh was cut.")
  SWIFTLET_NUMBER("level_count", m.value.level_count(), "Levels of nodes that the mesh has.")
  SWIFTLET_NUMBER("depth", m.value.depth(), "Levels of nodes of the whole tree.")
  SWIFTLET_NUMBER("deviation", m.value.deviation(), "How far a point of this mesh may be from the surface; 0 of a whole one.")
  SWIFTLET_NUMBER("is_mapped", !m.mapped.empty(), "True of a mesh whose memory is a mapped file.")
#undef SWIFTLET_NUMBER
}

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

constexpr const char* kKinds[] = {"model", "point", "segment", "triangle", "box", "mesh", "solid"};

int kind_of(const OwnedBody& b) { return b.is_mesh() ? 5 + b.body().is_solid() : int(b.convex().kind()); }

double to_radius(const Real& radius) { return to_double(radius, "radius"); }

void define_body(py::class_<OwnedBody>& c) {
  const auto radius = py::arg("radius") = 0.0;
  c.def(py::init([](const ModelPointer& model, const Real& r) { return OwnedBody(model, to_radius(r)); }),
        py::arg("model").none(false), radius);
  c.def(py::init([](const MeshPointer& mesh, const Real& r) { return OwnedBody(mesh, to_radius(r), false); }),
        py::arg("mesh").none(false), radius);
  c.def_static(
      "solid", [](const MeshPointer& mesh, const Real& r) { return OwnedBody(mesh, to_radius(r), true); },
      py::arg("mesh").none(false), radius,
      "A closed mesh and the volume that it encloses. Of a mesh that is not closed queries answer INVALID_BODY.");
  c.def_static(
      "point", [](py::handle p, const Real& r) { return OwnedBody(Body::point(to_vec3(p, "p"), to_radius(r))); }, py::arg("p"),
      radius, "The point p (3,); with a radius a sphere.");
  c.def_static(
      "segment",
      [](py::handle p, py::handle q, const Real& r) {
        return OwnedBody(Body::segment(to_vec3(p, "p"), to_vec3(q, "q"), to_radius(r)));
      },
      py::arg("p"), py::arg("q"), radius, "The segment from p to q; with a radius a capsule.");
  c.def_static(
      "triangle",
      [](py::handle p, py::handle q, py::handle r, const Real& rounded) {
        return OwnedBody(Body::triangle(to_vec3(p, "p"), to_vec3(q, "q"), to_vec3(r, "r"), to_radius(rounded)));
      },
      py::arg("p"), py::arg("q"), py::arg("r"), radius, "A flat triangle with two sides, its vertices in any order.");
  c.def_static(
      "box",
      [](py::handle smallest, py::handle largest, const Real& r) {
        return OwnedBody(Body::box(to_vec3(smallest, "smallest"), to_vec3(largest, "largest"), to_radius(r)));
      },
      py::arg("smallest"), py::arg("largest"), radius, "A box along the frame's axes, by two opposite corners.");
  c.def_property_readonly(
      "kind", [](const OwnedBody& b) { return py::module_::import("swiftlet._errors").attr("BodyKind")(kind_of(b)); },
      "What the body is made of: a :class:`BodyKind`.");
  c.def_property_readonly(
      "radius", [](const OwnedBody& b) { return b.body().radius(); }, "All that lies within it belongs to the body.");
  c.def_property_readonly(
      "model",
      [](const OwnedBody& b) -> py::object {
        return b.model() ? py::cast(std::const_pointer_cast<HeldModel>(b.model())) : py::object(py::none());
      },
      "The Model, or None.");
  c.def_property_readonly(
      "mesh",
      [](const OwnedBody& b) -> py::object {
        return b.mesh() ? py::cast(std::const_pointer_cast<HeldMesh>(b.mesh())) : py::object(py::none());
      },
      "The MeshModel, or None.");
  c.def_property_readonly(
      "corners",
      [](const OwnedBody& b) {
        constexpr int kCounts[] = {0, 1, 2, 3, 2, 0, 0};
        const int count = kCounts[kind_of(b)];
        py::array_t<double> corners({count, 3});
        for (int k = 0; k < count; ++k) {
          const Vec3 p = b.convex().corner(k);
          std::copy_n(p.data(), 3, corners.mutable_data(k, 0));
        }
        return corners;
      },
      "The points of a primitive, (k, 3): p, q, r, or a box's smallest and largest corner; empty otherwise.");
  c.def("__repr__", [](const OwnedBody& b) {
    return std::string("<swiftlet.Body: ") + kKinds[kind_of(b)] + ", radius " + scalar(b.body().radius()) + ">";
  });
  c.def("__reduce__", [](const py::object& self) {
    const auto& b = self.cast<const OwnedBody&>();
    const double radius_of = b.body().radius();
    if (b.is_mesh())
      return made_again("Body", b.body().is_solid() ? "solid" : "", py::make_tuple(self.attr("mesh"), radius_of));
    if (b.model()) return made_again("Body", "", py::make_tuple(self.attr("model"), radius_of));
    py::list arguments(self.attr("corners"));
    arguments.append(radius_of);
    return made_again("Body", kKinds[kind_of(b)], py::tuple(arguments));
  });
}

}  // namespace

OwnedBody to_body(py::handle object, const char* name) {
  if (py::isinstance<OwnedBody>(object)) return object.cast<const OwnedBody&>();
  if (py::isinstance<HeldModel>(object)) return {object.cast<ModelPointer>(), 0};
  if (py::isinstance<HeldMesh>(object)) return {object.cast<MeshPointer>(), 0, false};
  throw py::type_error(std::string(name) + ": expected a Model, MeshModel or Body, got " + what_came(object));
}

void define_bodies(py::module_& module) {
  py::class_<HeldLevel> level(module, "Level", "A level of a model: arrays that are views of its memory, and numbers.");
  add_levels(level);
  refuse_pickles(level);

  py::class_<HeldModel, ModelPointer> model(
      module, "Model", R"(A convex body at several levels of detail, immutable, in one block of memory that is also its file.

Made by :meth:`build`, :meth:`from_arrays`, :meth:`load`, :meth:`map` or :meth:`from_bytes`. Level 0 is the exact hull, larger is
coarser. Any number of threads may query it. Lengths are in the caller's unit.)");
  define_model(model);
  define_block<Model>(model);
  model.def("__repr__", [](const HeldModel& m) {
    const Level& fine = m.value.level(m.value.finest_level());
    return "<swiftlet.Model: " + std::to_string(fine.view.vertices.size()) + " vertices, " +
           std::to_string(fine.triangle_count) + " triangles, " +
           std::to_string(m.value.level_count() - m.value.finest_level()) + " of " + std::to_string(m.value.level_count()) +
           " levels, radius " + scalar(m.value.radius()) + ", " + std::to_string(m.value.bytes().size()) + " bytes" +
           (m.mapped.empty() ? "" : ", mapped") + ">";
  });

  py::class_<MeshTopology> topology(module, "Topology",
                                    "What a mesh is made of, counted after equal points became one vertex.");
  refuse_pickles(topology);
  topology.def_readonly("components", &MeshTopology::components, "Sets of triangles joined by common edges.");
  topology.def_readonly("open_edges", &MeshTopology::open_edges, "Edges of a single triangle.");
  topology.def_readonly("non_manifold_edges", &MeshTopology::non_manifold_edges, "Edges of more than two triangles.");
  topology.def_readonly("flipped_edges", &MeshTopology::flipped_edges, "Edges that both triangles run along in one direction.");
  topology.def_readonly("flat_triangles", &MeshTopology::flat_triangles, "Triangles whose corners lie on one line, exactly.");
  topology.def_readonly("duplicates", &MeshTopology::duplicates, "Triangles with the corners of an earlier one.");
  topology.def_readonly("volume", &MeshTopology::volume,
                        "Enclosed, in cubic units, negative if inside out; 0 unless `closed`.");
  topology.def_property_readonly("closed", &MeshTopology::closed, "True if the triangles bound a volume.");
  topology.def(
      "__eq__", [](const MeshTopology& a, const MeshTopology& b) { return a == b; }, py::is_operator());
  topology.def("__repr__", [](const MeshTopology& t) {
    return "<swiftlet.Topology: " + std::to_string(t.components) + " components, " + (t.closed() ? "closed" : "not closed") +
           ">";
  });

  py::class_<HeldMesh, MeshPointer> mesh(
      module, "MeshModel",
      R"(Triangles of any topology and a tree of boxes over them, immutable, in one block of memory that is also its file.

The surface alone is the body; ``Body.solid(mesh)`` is what a closed one bounds. Vertices and faces are in the order of the tree,
and answers name them so; `source_vertex` and `source_triangle` are the user's ids.)");
  define_mesh(mesh);
  define_block<MeshModel>(mesh);
  mesh.def("__repr__", [](const HeldMesh& m) {
    return "<swiftlet.MeshModel: " + std::to_string(m.value.triangle_count()) + " triangles, " +
           (m.value.is_whole() ? (m.value.topology().closed() ? "closed" : "open") : "cut") + ", " +
           std::to_string(m.value.hull_count()) + " hulls, " + std::to_string(m.value.bytes().size()) + " bytes" +
           (m.mapped.empty() ? "" : ", mapped") + ">";
  });

  py::class_<OwnedBody> body(module, "Body",
                             R"(A body of queries: a model, a mesh or a primitive, and all that lies within a radius of it.

``Body(model, radius=0)``, ``Body(mesh, radius=0)``, or one of the static methods. Coordinates are in the body's own frame. A
radius is from 0 to 1e45, else queries answer INVALID_RADIUS. Queries take a Model or MeshModel as it is, too.)");
  define_body(body);

  module.def(
      "is_mesh_file", [](py::handle path) { return is_mesh_file(to_path(path)); }, py::arg("path"),
      "True if a file begins as a mesh's does.");
  module.def(
      "verify",
      [](py::handle of) {
        Check check;
        if (py::isinstance<HeldModel>(of)) {
          const auto m = of.cast<ModelPointer>();
          check = unlocked([&] { return verify(m->value); });
        } else if (py::isinstance<HeldMesh>(of)) {
          const auto m = of.cast<MeshPointer>();
          check = unlocked([&] { return verify(m->value); });
        } else {
          throw py::type_error("model: expected a Model or MeshModel, got " + what_came(of));
        }
        return check.message;
      },
      py::arg("model"),
      R"(Proves exactly all that a model or mesh claims: convexity, enclosure, deviations, boxes, hulls.

Returns
-------
str
    What failed first, with numbers; empty if all holds.)");
}

}  // namespace swiftlet::python
