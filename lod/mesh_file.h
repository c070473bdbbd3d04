// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Mesh files as bytes. Knows nothing of hulls, nor of where the bytes come from.
#pragma once

#include <string>
#include <string_view>

#include <swiftlet/build.h>

namespace swiftlet::lod {

/// What `read_mesh` makes of a file's bytes; `extension` in lower case, with its dot. Errors do not name the file.
/// Memory and time are linear in the bytes, whatever counts they claim.
Result<Mesh> mesh_of_bytes(std::string_view bytes, const std::string& extension);

}  // namespace swiftlet::lod
