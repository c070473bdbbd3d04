// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The module swiftlet._build: the builder, which comes under CGAL's GPL. It hands out the bytes of model files, and shares no
// type with the runtime's module.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <optional>

#include <swiftlet/build.h>
#include <swiftlet/build_mesh.h>

#include "arguments.h"
#include "arrays.h"
#include "crew.h"
#include "failure.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

py::bytes bytes_of(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Calls the user's function, and looks for signals, while a build goes on.
class Watch {
 public:
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}
  Progress function() {
    return [this](double fraction, std::string_view stage) {
      const py::gil_scoped_acquire acquire;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return progress_.is_none() || goes_on(progress_(fraction, std::string(stage)));
      } catch (...) {
        raised_ = std::current_exception();
        return false;
      }
    };
  }
  void finish() {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  py::object progress_;
  std::exception_ptr raised_;
};

Mesh to_mesh(py::handle points, py::handle triangles) {
  Mesh mesh;
  mesh.points = to_points(points, "vertices");
  if (!triangles.is_none()) mesh.triangles = to_triangles(triangles, "faces");
  return mesh;
}

py::tuple run_read(py::handle path) {
  const std::string name = to_path(path);
  std::optional<Result<Mesh>> read;
  {
    const py::gil_scoped_release release;
    read = read_mesh(name);
  }
  const Mesh mesh = take(std::move(*read));
  py::array_t<double> points({py::ssize_t(mesh.points.size()), py::ssize_t(3)});
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    std::copy_n(mesh.points[i].data(), 3, points.mutable_data(py::ssize_t(i), 0));
  py::array_t<std::uint32_t> triangles({py::ssize_t(mesh.triangles.size()), py::ssize_t(3)});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    std::copy_n(mesh.triangles[i].data(), 3, triangles.mutable_data(py::ssize_t(i), 0));
  return py::make_tuple(points, triangles);
}

py::dict report_of(const BuildReport& r) {
  py::list levels;
  for (const LevelReport& l : r.levels) {
    py::dict level;
    level["vertices"] = l.vertices, level["faces"] = l.faces, level["triangles"] = l.triangles, level["bytes"] = l.bytes;
    level["deviation"] = l.deviation, level["volume_ratio"] = l.volume_ratio;
    levels.append(level);
  }
  py::dict d;
  d["points_read"] = r.points_read, d["triangles_read"] = r.triangles_read, d["duplicates_dropped"] = r.duplicates_dropped;
  d["interior_dropped"] = r.interior_dropped, d["hull_triangles"] = r.hull_triangles, d["faces_grouped"] = r.faces_grouped;
  d["closed"] = r.closed, d["volume_ratio"] = r.volume_ratio, d["deepest_dent"] = r.deepest_dent, d["levels"] = levels,
  d["end"] = r.end;
  return d;
}

py::tuple run_build(py::handle points, py::handle triangles, const Whole& method, const Whole& enclosing, const Real& rate,
                    const Whole& cutoff, const Whole& max_levels, const Real& max_deviation, const Real& deviation,
                    const Whole& bytes, Flag require_convex, Flag require_solid, const Whole& resolution,
                    const Real& radius_factor, const Whole& map_cells, py::object progress, const Whole& threads) {
  const Mesh mesh = to_mesh(points, triangles);
  BuildOptions options;
  options.method = Method(to_whole(method, "method", 0, 1));
  options.enclosing = Enclosing(to_whole(enclosing, "enclosing", 0, 1));
  if (!rate.is_none()) options.rate = to_double(rate, "rate");
  options.cutoff = to_count(cutoff, "cutoff");
  options.max_levels = to_int(max_levels, "max_levels");
  options.max_deviation = to_double(max_deviation, "max_deviation");
  options.detail.deviation = to_double(deviation, "deviation");
  if (const auto kept = to_bytes_kept(bytes)) options.detail.bytes = *kept;
  options.require_convex = require_convex, options.require_solid = require_solid;
  options.table = {lut::Resolution(to_whole(resolution, "resolution", 0, 3)), to_double(radius_factor, "radius_factor"),
                   to_count(map_cells, "map_cells")};
  Watch watch(std::move(progress));
  options.progress = watch.function();
  const unsigned count = to_threads(threads);
  if (count > 1) options.executor = on_threads(count);
  std::optional<Result<Built>> built;
  {
    const py::gil_scoped_release release;
    built = build(mesh, options);
  }
  watch.finish();
  const Built result = take(std::move(*built));
  return py::make_tuple(bytes_of(result.model.bytes()), report_of(result.report));
}

HullOptions hull_options(const Whole& levels, const Whole& least_triangles, const Real& bytes_per_triangle, Watch& watch,
                         const Whole& threads) {
  HullOptions options;
  options.levels = to_count(levels, "levels");
  options.least_triangles = to_count(least_triangles, "least_triangles");
  options.bytes_per_triangle = to_double(bytes_per_triangle, "bytes_per_triangle");
  options.progress = watch.function();
  const unsigned count = to_threads(threads);
  if (count > 1) options.executor = on_threads(count);
  return options;
}

py::bytes run_build_mesh(py::handle points, py::handle triangles, const Whole& levels, const Whole& least_triangles,
                         const Real& bytes_per_triangle, const Whole& least_patch, py::object progress, const Whole& threads) {
  const Mesh mesh = to_mesh(points, triangles);
  Watch watch(std::move(progress));
  HullOptions options = hull_options(levels, least_triangles, bytes_per_triangle, watch, threads);
  options.least_patch = to_count(least_patch, "least_patch");
  std::optional<Result<MeshModel>> built;
  {
    const py::gil_scoped_release release;
    built = build_mesh(mesh, options);
  }
  watch.finish();
  return bytes_of(take(std::move(*built)).bytes());
}

py::bytes run_rebuild_hulls(py::buffer data, const Whole& levels, const Whole& least_triangles, const Real& bytes_per_triangle,
                            py::object progress, const Whole& threads) {
  const py::buffer_info info = data.request();
  const MeshModel mesh = take(load_mesh(to_bytes(info)));
  Watch watch(std::move(progress));
  const HullOptions options = hull_options(levels, least_triangles, bytes_per_triangle, watch, threads);
  std::optional<Result<MeshModel>> built;
  {
    const py::gil_scoped_release release;
    built = rebuild_hulls(mesh, options);
  }
  watch.finish();
  return bytes_of(take(std::move(*built)).bytes());
}

}  // namespace
}  // namespace swiftlet::python

PYBIND11_MODULE(_build, module) {
  using namespace swiftlet::python;
  namespace py = pybind11;
  module.doc() = "The builder behind swiftlet.build. What loads this module comes under CGAL's GPL.";
  module.def("run_read", &run_read, py::arg("path"), "Points and triangles of a mesh file.");
  module.def("run_build", &run_build, py::arg("points"), py::arg("triangles"), py::arg("method"), py::arg("enclosing"),
             py::arg("rate"), py::arg("cutoff"), py::arg("max_levels"), py::arg("max_deviation"), py::arg("deviation"),
             py::arg("bytes"), py::arg("require_convex"), py::arg("require_solid"), py::arg("resolution"),
             py::arg("radius_factor"), py::arg("map_cells"), py::arg("progress"), py::arg("threads"),
             "The bytes of a model, and the report as a dict.");
  module.def("run_build_mesh", &run_build_mesh, py::arg("points"), py::arg("triangles"), py::arg("levels"),
             py::arg("least_triangles"), py::arg("bytes_per_triangle"), py::arg("least_patch"), py::arg("progress"),
             py::arg("threads"), "The bytes of a mesh with hulls.");
  module.def("run_rebuild_hulls", &run_rebuild_hulls, py::arg("data"), py::arg("levels"), py::arg("least_triangles"),
             py::arg("bytes_per_triangle"), py::arg("progress"), py::arg("threads"), "The bytes of the mesh with new hulls.");
}
