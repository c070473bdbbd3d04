// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The tool without the builder: it reads .swl models and .swm meshes, and no mesh files. With it: build_main.cpp.
#include "tool.h"

int main(int argc, char** argv) { return swiftlet::tool::run_tool(argc, argv); }
