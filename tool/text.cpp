// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace swiftlet::tool {

std::string format(const char* pattern, ...) {
  char text[401];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string number(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}

std::string numbers(const Vec3& v) { return v.hasNaN() ? "none" : number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

Error in_file(const std::string& path, Error error) {
  if (!error.message.starts_with(path)) error.message = path + ": " + error.message;
  error.file = path;
  return error;
}

Result<bool> may_write(const std::filesystem::path& path, const std::filesystem::path& input) {
  std::error_code ignored;
  const auto refused = [&](const char* why) { return in_file(path.string(), {ErrorCode::CannotWrite, why}); };
  if (std::filesystem::equivalent(path, input, ignored)) return refused("is the input itself");
  if (std::filesystem::is_directory(path, ignored)) return refused("is a folder");
  // A link too: the rename would replace it, /dev/stdout for one.
  const std::filesystem::file_type kind = std::filesystem::symlink_status(path, ignored).type();
  if (kind == std::filesystem::file_type::symlink) return refused("is a link, which would be replaced");
  if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::regular)
    return refused("is no regular file");
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) return refused("its folder does not exist");
  return true;
}

Result<std::size_t> write_file(const std::filesystem::path& path, const std::string& text) {
  if (const auto may = may_write(path); !may) return may.error();
  std::filesystem::path part = path;
  part += ".part";
  std::error_code failure;
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (file) std::filesystem::rename(part, path, failure);
  if (file && !failure) return text.size();
  const std::string why = file ? failure.message() : "cannot write " + std::to_string(text.size()) + " bytes";
  std::filesystem::remove(part, failure);
  return in_file(path.string(), {ErrorCode::CannotWrite, why});
}

}  // namespace swiftlet::tool
