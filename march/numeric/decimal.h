// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers in error texts.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdio>
#include <string>

namespace swiftlet {

/// Writes a number with at most `digits` digits, 1 to 17; with a point in any locale, where the library can.
inline std::string decimal(double value, int digits) {
  char text[32];
#ifdef __cpp_lib_to_chars
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
#else  // libc++ before 14 has these for integers alone
  return {text, std::size_t(std::snprintf(text, sizeof text, "%.*g", digits, value))};
#endif
}

}  // namespace swiftlet
