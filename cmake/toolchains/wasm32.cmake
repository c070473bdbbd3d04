# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# WebAssembly with SIMD by Debian's emscripten, without threads; programs run in node, on the machine's own files. Both may throw.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fexceptions")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-fexceptions -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=8MB -sEXIT_RUNTIME=1")
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)  # its loader takes a path for an URL where there is a fetch
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)  # also what is not built for it: packages of headers alone
