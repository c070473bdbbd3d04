// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the leaves of a mesh's tree ask: two triangles, again and again.
#pragma once

namespace surface {

/// Every triangle of one mesh against every one of another, a million pairs, each against the distance by formulas; prints ns
/// per query and a hash of the answers. How many are wrong.
int mesh_leaves();

}  // namespace surface
