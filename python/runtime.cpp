// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The module swiftlet._runtime: the runtime without the builder, hence without CGAL.
#include <pybind11/pybind11.h>

#include <swiftlet/batch.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh.h>
#include <swiftlet/model_file.h>
#include <swiftlet/scene.h>

#include "py_body.h"
#include "records.h"

PYBIND11_MODULE(_runtime, module) {
  using namespace swiftlet;
  module.doc() = "What swiftlet's Python modules are made of: bodies, queries over poses, scenes.";
  module.attr("VERSION") = SWIFTLET_VERSION;
  module.attr("NONE") = kNone;
  module.attr("POSES_PER_CHUNK") = kPosesPerChunk;
  module.attr("MODEL_FILE_VERSION") = kModelFileVersion;
  module.attr("MESH_FILE_VERSION") = kMeshFileVersion;
  module.attr("MOST_TRIANGLES") = kMostTriangles;
  module.attr("MOST_MANIFOLD_POINTS") = kMostManifoldPoints;
  module.attr("MOST_FLATNESS") = kMostFlatness;
  python::define_bodies(module);
  python::define_queries(module);
  python::define_single(module);
  python::define_scenes(module);
}
