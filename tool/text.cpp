// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "body/file.h"

namespace swiftlet::tool {
namespace {

volatile std::sig_atomic_t caught = 0;

/// Holds SIGINT and SIGTERM back as long as it lives; then the last one that came does what it would have done.
class HeldSignals {
 public:
  HeldSignals() = default;
  ~HeldSignals() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
    const int signal = caught;
    caught = 0;
    if (signal) std::raise(signal);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  static void hold(int signal) { caught = signal; }
  void (*interrupt_)(int) = std::signal(SIGINT, hold);
  void (*terminate_)(int) = std::signal(SIGTERM, hold);
};

}  // namespace

std::string format(const char* pattern, ...) {
  char text[401];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

#ifdef __cpp_lib_to_chars
std::string number(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}

ReadNumber read_number(std::string_view text) {
  ReadNumber read;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read.value);
  if (error != std::errc::invalid_argument) read.length = std::size_t(end - text.data());
  read.is_beyond = error == std::errc::result_out_of_range;
  return read;
}
#else  // libc++ before 14 has these for integers alone
std::string number(double value) {
  std::string text;
  int digits = 0;
  do text = format("%.*g", ++digits, value);
  while (digits < 17 && std::strtod(text.c_str(), nullptr) != value);
  return text;
}

ReadNumber read_number(std::string_view text) {
  const std::string number(text.substr(0, text.find_first_of(" \t\r\n,+xX", 1)));
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(number.c_str(), &end);
  return {std::size_t(end - number.c_str()), value, errno == ERANGE && (value == 0 || std::isinf(value))};
}
#endif

std::string numbers(const Vec3& v) { return v.hasNaN() ? "none" : number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

std::string counted(std::size_t count, const std::string& noun, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? noun : plural.empty() ? noun + "s" : plural);
}

std::string stem(const std::string& path) { return utf8(path_of(path).stem()); }

Error in_file(const std::string& path, Error error) {
  if (!error.message.starts_with(path)) error.message = path + ": " + error.message;
  error.file = path;
  return error;
}

Result<bool> may_write(const std::filesystem::path& path, const std::filesystem::path& input) {
  std::error_code ignored, failure;
  const auto refused = [&](const std::string& why) { return named(path, {ErrorCode::CannotWrite, why}); };
  if (std::filesystem::equivalent(path, input, ignored)) return refused("is the input itself");
  if (std::filesystem::is_directory(path, ignored)) return refused("is a folder");
  const std::filesystem::file_type kind = std::filesystem::status(path, failure).type();
  if (kind == std::filesystem::file_type::none) return refused(failure.message());
  if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::regular)
    return refused("is no regular file");
  const std::filesystem::path target = target_of(path), folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) return refused("its folder does not exist");
  return true;
}

Result<std::size_t> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  if (const auto may = may_write(path); !may) return may.error();
  const HeldSignals held;
  return replace_file(path, bytes);
}

Result<std::size_t> write_file(const std::filesystem::path& path, const std::string& text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace swiftlet::tool
