# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# The methods of the benchmark as one library, swiftlet_methods: ours, the baselines, and each peer that is installed.
# A peer that is absent is named here and in the results.
find_package(PkgConfig QUIET)

add_library(swiftlet_methods STATIC method.cpp manifolds.cpp nearest.cpp verdict.cpp)
target_compile_options(swiftlet_methods PRIVATE -ffp-contract=off -Wall -Wextra -Wshadow)
target_include_directories(swiftlet_methods PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(swiftlet_methods PUBLIC swiftlet::march swiftlet_vclip swiftlet_plain)

set(absent_peers "")

# swiftlet_peer(NAME module...): peer_NAME.cpp joins if pkg-config knows one of the modules; the first that it knows is linked.
function(swiftlet_peer name)
  if(PkgConfig_FOUND)
    pkg_search_module(peer_${name} QUIET IMPORTED_TARGET ${ARGN})
  endif()
  if(peer_${name}_FOUND)
    string(TOUPPER ${name} macro)
    add_library(swiftlet_peer_${name} STATIC peer_${name}.cpp)  # its own, for its flags
    target_compile_features(swiftlet_peer_${name} PRIVATE cxx_std_20)
    target_compile_options(swiftlet_peer_${name} PRIVATE -Wall -Wextra -Wshadow)
    target_compile_definitions(swiftlet_peer_${name} PRIVATE SWIFTLET_PEER_VERSION="${peer_${name}_VERSION}")
    target_include_directories(swiftlet_peer_${name} PRIVATE ${PROJECT_SOURCE_DIR}/yardstick)
    target_link_libraries(swiftlet_peer_${name} PRIVATE swiftlet::march PkgConfig::peer_${name})
    target_compile_definitions(swiftlet_methods PRIVATE SWIFTLET_PEER_${macro})
    target_link_libraries(swiftlet_methods PRIVATE swiftlet_peer_${name})
    message(STATUS "Benchmark peer ${name}: ${peer_${name}_VERSION}")
  else()
    message(STATUS "Benchmark peer ${name}: absent (pkg-config knows none of: ${ARGN})")
    set(absent_peers "${absent_peers},${name}")
  endif()
  set(absent_peers "${absent_peers}" PARENT_SCOPE)
  set(peer_${name}_FOUND "${peer_${name}_FOUND}" PARENT_SCOPE)
endfunction()

swiftlet_peer(fcl fcl)                          # Debian: libfcl-dev
swiftlet_peer(ccd ccd)                          # libccd-dev
swiftlet_peer(bullet bullet-float64 bullet)     # libbullet-extras-dev in double, libbullet-dev in single precision
swiftlet_peer(ode ode)                          # libode-dev

# FCL once more for this very machine. A shared library that shows one symbol: its instantiations of FCL's templates, of Eigen
# and of std with other instructions can then not replace those of the rest, nor be replaced by libfcl's.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native SWIFTLET_HAS_MARCH_NATIVE)
if(peer_fcl_FOUND AND SWIFTLET_HAS_MARCH_NATIVE AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  add_library(swiftlet_fcl_native SHARED peer_fcl.cpp)
  target_compile_features(swiftlet_fcl_native PRIVATE cxx_std_20)
  target_compile_options(swiftlet_fcl_native PRIVATE -O3 -march=native -fvisibility-inlines-hidden -Wall -Wextra -Wshadow)
  target_compile_definitions(swiftlet_fcl_native PRIVATE SWIFTLET_FCL_NATIVE SWIFTLET_PEER_VERSION="${peer_fcl_VERSION}")
  foreach(headers march lut)  # not linked: it calls nothing of ours
    target_include_directories(swiftlet_fcl_native PRIVATE $<TARGET_PROPERTY:swiftlet::${headers},INTERFACE_INCLUDE_DIRECTORIES>)
  endforeach()
  target_include_directories(swiftlet_fcl_native PRIVATE ${PROJECT_SOURCE_DIR}/yardstick)
  target_link_libraries(swiftlet_fcl_native PRIVATE PkgConfig::peer_fcl Eigen3::Eigen)
  file(CONFIGURE OUTPUT fcl_native.map @ONLY CONTENT
    "{ global: extern \"C++\" { \"swiftlet::bench::add_fcl_native*\"; swiftlet::bench::add_fcl_native*; }; local: *; };\n")
  target_link_options(swiftlet_fcl_native PRIVATE -Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/fcl_native.map)
  set_target_properties(swiftlet_fcl_native PROPERTIES LINK_DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/fcl_native.map)
  target_compile_definitions(swiftlet_methods PRIVATE SWIFTLET_PEER_FCL_NATIVE)
  target_link_libraries(swiftlet_methods PRIVATE swiftlet_fcl_native)
else()
  message(STATUS "Benchmark peer fcl native: absent")
  set(absent_peers "${absent_peers},fcl native")
endif()

string(REGEX REPLACE "^," "" absent_peers "${absent_peers}")
target_compile_definitions(swiftlet_methods PRIVATE SWIFTLET_ABSENT_PEERS="${absent_peers}")

# Their test lives in tests/, but is built here, where the methods are.
if(SWIFTLET_TESTS AND SWIFTLET_LOD)
  find_package(GTest REQUIRED)  # imported targets are seen in their own directory only
  swiftlet_test_program(swiftlet_peers_tests ${PROJECT_SOURCE_DIR}/tests/peers_test.cpp)
  target_include_directories(swiftlet_peers_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(swiftlet_peers_tests PRIVATE swiftlet_methods swiftlet_oracle swiftlet_shapes)
endif()
