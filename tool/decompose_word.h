// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The word `decompose`: a mesh's surface as convex patches, in numbers and as a picture.
#pragma once

#include "tool.h"

namespace swiftlet::tool {

Word decompose_word();

}  // namespace swiftlet::tool
