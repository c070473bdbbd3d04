# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# How other programs find an installed swiftlet, and the Debian packages: one for each of the components march, lod and tools.
include(CMakePackageConfigHelpers)
configure_package_config_file(swiftletConfig.cmake.in swiftletConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(swiftletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/swiftletConfig.cmake ${PROJECT_BINARY_DIR}/swiftletConfigVersion.cmake
  DESTINATION ${config_dir} COMPONENT march)
install(EXPORT swiftlet-march-targets NAMESPACE swiftlet:: DESTINATION ${config_dir} COMPONENT march)
if(SWIFTLET_LOD)
  install(EXPORT swiftlet-lod-targets NAMESPACE swiftlet:: DESTINATION ${config_dir} COMPONENT lod)
endif()

# Paths from the file itself, so that a prefix can be moved.
file(RELATIVE_PATH include_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(swiftlet.pc.in swiftlet.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/swiftlet.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT march)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The packages hold static libraries: before 1.0 no minor version is binary compatible with the one before.
if(NOT PROJECT_IS_TOP_LEVEL OR BUILD_SHARED_LIBS)
  return()
endif()
function(swiftlet_package component package section description)
  string(TOUPPER ${component} component_key)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_COMPONENT_${component_key}_DESCRIPTION ${description} PARENT_SCOPE)
  set(CPACK_DEBIAN_${component_key}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${component_key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} RENAME copyright
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

swiftlet_package(march libswiftlet-dev libdevel "The runtime: headers and static libraries.")
set(CPACK_DEBIAN_MARCH_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
if(SWIFTLET_LOD)
  swiftlet_package(lod libswiftlet-lod-dev libdevel
    "The builder: header and static library. What links it comes under CGAL's GPL.")
  set(CPACK_DEBIAN_LOD_PACKAGE_DEPENDS "libcgal-dev (>= 5.5)")
  set(CPACK_COMPONENT_LOD_DEPENDS march)
endif()
if(SWIFTLET_TOOL)
  swiftlet_package(tools swiftlet-tools science "The command line tool. With `build` in it, it comes under CGAL's GPL.")
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_PACKAGE_CONTACT "the swiftlet authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
include(CPack)
