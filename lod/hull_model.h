// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A model of one level without an account of it: half of what a small hull would take to build. See build.cpp.
#pragma once

#include <swiftlet/build.h>

namespace swiftlet::lod {

/// The hull of a mesh that is known to be legal. Of the options those of tables and threads are in force.
Result<Model> hull_model(const Mesh& mesh, const BuildOptions& options);

}  // namespace swiftlet::lod
