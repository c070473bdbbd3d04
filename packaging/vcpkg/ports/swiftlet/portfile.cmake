# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# The archive is the one that `./run archive` makes, and SHA512 is what it prints. Both OWNER and 0 wait for a release: vcpkg
# refuses the 0 and says the right one.
vcpkg_download_distfile(archive
  URLS "https://github.com/OWNER/swiftlet/releases/download/v${VERSION}/swiftlet-${VERSION}.tar.gz"
  FILENAME "swiftlet-${VERSION}.tar.gz"
  SHA512 0
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")

vcpkg_check_features(OUT_FEATURE_OPTIONS features
  FEATURES
    builder SWIFTLET_LOD
    tool SWIFTLET_TOOL
)
# The adapters are built for what is installed, which a port must not depend on.
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${features}
    -DSWIFTLET_ADAPTERS=OFF
    -DSWIFTLET_BENCH=OFF
    -DSWIFTLET_C=OFF
    -DSWIFTLET_TESTS=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/swiftlet)
vcpkg_fixup_pkgconfig()
if(SWIFTLET_TOOL)
  vcpkg_copy_tools(TOOL_NAMES swiftlet AUTO_CLEAN)
endif()

# One copy of headers and of the licence.
file(REMOVE_RECURSE
  "${CURRENT_PACKAGES_DIR}/debug/include"
  "${CURRENT_PACKAGES_DIR}/debug/share"
  "${CURRENT_PACKAGES_DIR}/share/doc"
)
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
