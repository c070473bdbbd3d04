# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# What tests and bench share: the oracle, the shapes, and the scenes with the baselines. Included by both, whichever comes first.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL 5.5 REQUIRED)

function(swiftlet_helper name)
  add_library(${name} STATIC ${ARGN})
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wall -Wextra -Wshadow)
endfunction()

if(NOT TARGET swiftlet_shapes)
  swiftlet_helper(swiftlet_oracle ${CMAKE_CURRENT_LIST_DIR}/oracle.cpp)
  target_include_directories(swiftlet_oracle PUBLIC ${CMAKE_CURRENT_LIST_DIR})
  target_link_libraries(swiftlet_oracle PUBLIC swiftlet::march PRIVATE CGAL::CGAL)

  swiftlet_helper(swiftlet_shapes ${CMAKE_CURRENT_LIST_DIR}/shapes.cpp)
  target_include_directories(swiftlet_shapes PUBLIC ${CMAKE_CURRENT_LIST_DIR})
  target_link_libraries(swiftlet_shapes PUBLIC swiftlet::lod PRIVATE CGAL::CGAL)

  find_package(nlohmann_json 3 REQUIRED)
  swiftlet_helper(swiftlet_cases ${CMAKE_CURRENT_LIST_DIR}/stability/case.cpp)
  target_include_directories(swiftlet_cases PUBLIC ${CMAKE_CURRENT_LIST_DIR}/stability)
  target_link_libraries(swiftlet_cases PUBLIC swiftlet::march PRIVATE nlohmann_json::nlohmann_json)

  set(bench_dir ${PROJECT_SOURCE_DIR}/bench)
  foreach(baseline vclip plain)
    swiftlet_helper(swiftlet_${baseline} ${bench_dir}/${baseline}.cpp)
    target_include_directories(swiftlet_${baseline} PUBLIC ${bench_dir} PRIVATE ${PROJECT_SOURCE_DIR}/march)
    target_link_libraries(swiftlet_${baseline} PUBLIC swiftlet::march)
  endforeach()
  # GCC packs pairs of coordinates into SSE2 registers and waits for the stores that it reads them back from: 4 % slower.
  target_compile_options(swiftlet_vclip PRIVATE -fno-tree-slp-vectorize)
  swiftlet_helper(swiftlet_scenes ${bench_dir}/scenes.cpp)
  target_include_directories(swiftlet_scenes PUBLIC ${bench_dir})
  target_link_libraries(swiftlet_scenes PUBLIC swiftlet_shapes)
endif()
