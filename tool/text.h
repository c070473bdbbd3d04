// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers, names and whole files as the tool writes them. Knows nothing of models.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <swiftlet/pose.h>
#include <swiftlet/result.h>

namespace swiftlet::tool {

/// printf, in a string of at most 400 characters.
#if defined(__MINGW32__)
[[gnu::format(gnu_printf, 1, 2)]]
#elif defined(__GNUC__)
[[gnu::format(printf, 1, 2)]]
#endif
std::string
format(const char* pattern, ...);

/// The shortest decimal that reads back as the same double.
std::string number(double value);
/// The double nearest to the decimal number that a text begins with.
struct ReadNumber {
  std::size_t length = 0;  ///< of the number in the text; 0 if it begins with none
  double value = 0;
  bool is_beyond = false;  ///< no double is near it
};
ReadNumber read_number(std::string_view text);
/// Three numbers, one blank between; "none" where the answer knows none.
std::string numbers(const Vec3& v);

/// "1 triangle", "2 triangles". The plural is the noun with "s" where none is given.
std::string counted(std::size_t count, const std::string& noun, const std::string& plural = {});

/// The file's name without folders and extension.
std::string stem(const std::string& path);

/// An error as one of this file.
Error in_file(const std::string& path, Error error);

/// Whether a file could be written there, as far as can be told before, and is none of `input`, by whatever name.
Result<bool> may_write(const std::filesystem::path& path, const std::filesystem::path& input = {});
/// `replace_file`, where `may_write`. SIGINT and SIGTERM wait until it is done, so that nothing half-written is left. All files
/// of the tool are written by it. Returns the bytes written.
Result<std::size_t> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<std::size_t> write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace swiftlet::tool
