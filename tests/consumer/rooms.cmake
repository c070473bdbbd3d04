# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# March compiled a room at a time, and those that make a body as one, in half the time that its files take one by one. Files that
# have names of their own alike stay alone: where a compiler says that something is defined twice, this list is to grow.
get_target_property(sources swiftlet_march SOURCES)
get_target_property(directory swiftlet_march SOURCE_DIR)
list(FILTER sources EXCLUDE REGEX "^depth/|^pair/intersection")
foreach(source ${sources})
  cmake_path(GET source PARENT_PATH room)
  string(REGEX REPLACE "numeric|make" body room ${room})
  set_source_files_properties(${directory}/${source} TARGET_DIRECTORY swiftlet_march PROPERTIES UNITY_GROUP ${room})
endforeach()
set_target_properties(swiftlet_march PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
