// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "body/file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <system_error>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace swiftlet {
namespace {

/// Why the system's last call failed.
std::string last_failure() {
#ifdef _WIN32
  return std::system_category().message(int(GetLastError()));
#else
  return std::generic_category().message(errno);
#endif
}

/// A file that is open for reading.
class OpenFile {
 public:
#ifdef _WIN32
  explicit OpenFile(const std::filesystem::path& path)
      : handle_(CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING,
                            FILE_ATTRIBUTE_NORMAL, nullptr)) {}
  ~OpenFile() {
    if (is_open()) CloseHandle(handle_);
  }
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE; }
  /// Its size in bytes, 0 if that is not known.
  std::uint64_t size() const {
    LARGE_INTEGER bytes;
    return GetFileSizeEx(handle_, &bytes) ? std::uint64_t(bytes.QuadPart) : 0;
  }
  /// Its first `size` bytes, which stay when it is closed; null if they cannot be mapped.
  std::shared_ptr<const std::byte[]> pages(std::size_t) const {
    const HANDLE mapping = CreateFileMappingW(handle_, nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (!mapping) return nullptr;
    const void* const view = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
    const DWORD failure = GetLastError();
    CloseHandle(mapping);  // the view keeps it
    SetLastError(failure);
    if (!view) return nullptr;
    return {static_cast<const std::byte*>(view), [](const std::byte* begin) { UnmapViewOfFile(begin); }};
  }

 private:
  HANDLE handle_;
#else
  explicit OpenFile(const std::filesystem::path& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (is_open()) close(descriptor_);
  }
  bool is_open() const { return descriptor_ >= 0; }
  std::uint64_t size() const {
    struct stat about {};
    return fstat(descriptor_, &about) == 0 ? std::uint64_t(about.st_size) : 0;
  }
  std::shared_ptr<const std::byte[]> pages(std::size_t size) const {
    void* const begin = mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor_, 0);
    if (begin == MAP_FAILED) return nullptr;
    return {static_cast<const std::byte*>(begin), [begin, size](const std::byte*) { munmap(begin, size); }};
  }

 private:
  int descriptor_;
#endif
 public:
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

/// A file for writing where nothing was, not even a link; null if there was something.
std::FILE* make_file(const std::filesystem::path& path) {
#ifdef _WIN32  // msvcrt's streams have no mode "x"
  const int made = _wopen(path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
  return made < 0 ? nullptr : _wfdopen(made, L"wb");
#else
  return std::fopen(path.c_str(), "wbx");
#endif
}

/// Writes a file where nothing was. Returns 0, or why nothing is written, as errno; EEXIST: there was something.
int write_new(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const auto cause = [] { return errno ? errno : EIO; };
  errno = 0;
  std::FILE* const file = make_file(path);
  if (!file) return cause();
  errno = 0;
  int failure = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() ? 0 : cause();
  if (std::fclose(file) != 0 && !failure) failure = cause();
  std::error_code ignored;
  if (failure) std::filesystem::remove(path, ignored);
  return failure;
}

/// PATH.XXXX.part, XXXX by the clock: another name for each `attempt`. Of a name that would have more than 255 bytes, which is
/// what file systems take, whole letters of UTF-8 are left out at the end of PATH.
std::filesystem::path part_of(std::filesystem::path path, int attempt) {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  char ending[16];
  const int ending_bytes = std::snprintf(ending, sizeof ending, ".%04x.part", unsigned(now + attempt) & 0xffffu);
  const std::u8string name = path.filename().u8string();
  std::size_t kept = std::min(name.size(), std::size_t(255 - ending_bytes));
  while (kept > 0 && kept < name.size() && (name[kept] & 0xc0) == 0x80) --kept;
  return path.replace_filename(name.substr(0, kept)) += ending;
}

}  // namespace

std::string utf8(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

std::filesystem::path path_of(const std::string& utf8) { return std::u8string(utf8.begin(), utf8.end()); }

Error named(const std::filesystem::path& path, Error error) {
  error.file = utf8(path);
  error.message = error.file + ": " + error.message;
  return error;
}

std::string irregularity(const std::filesystem::path& path) {
  using std::filesystem::file_type;
  std::error_code ignored;
  switch (std::filesystem::status(path, ignored).type()) {
    case file_type::regular:
    case file_type::not_found:
    case file_type::none: return {};
    case file_type::directory: return std::generic_category().message(EISDIR);
    default: return "is no regular file";
  }
}

std::filesystem::path target_of(std::filesystem::path path) {
  constexpr int kMostLinks = 40;
  std::error_code none;
  for (int links = 0; links < kMostLinks && std::filesystem::is_symlink(path, none); ++links)
    path = path.parent_path() / std::filesystem::read_symlink(path, none);
  return path;
}

Result<OwnedBytes> map_file(const std::filesystem::path& path) {
  if (const std::string fault = irregularity(path); !fault.empty()) return named(path, {ErrorCode::CannotRead, fault});
  const OpenFile file(path);
  if (!file.is_open()) return named(path, {ErrorCode::CannotRead, last_failure()});
  const std::uint64_t size = file.size();
  if (size == 0) return named(path, {ErrorCode::BadFormat, "is empty"});
  if (size > std::uint64_t{PTRDIFF_MAX})
    return named(path, {ErrorCode::TooLarge, "is larger than what this machine can address"});
  auto pages = file.pages(std::size_t(size));
  if (!pages) return named(path, {ErrorCode::CannotRead, last_failure()});
  const std::byte* const begin = pages.get();
  return OwnedBytes{std::move(pages), {begin, std::size_t(size)}};
}

Result<std::size_t> replace_file(const std::filesystem::path& name, std::span<const std::byte> bytes) {
  const auto refused = [&name](const std::string& why) { return named(name, {ErrorCode::CannotWrite, why}); };
  const std::filesystem::path path = target_of(name);
  if (std::error_code none; std::filesystem::is_symlink(path, none)) return refused(std::generic_category().message(ELOOP));
  std::error_code failure, ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return refused("exists and is no file");
  std::filesystem::path part;
  int cause = EEXIST;
  for (int attempt = 0; cause == EEXIST && attempt < 1000; ++attempt) cause = write_new(part = part_of(path, attempt), bytes);
  if (cause)
    return refused("cannot write " + std::to_string(bytes.size()) + " bytes: " + std::generic_category().message(cause));
  const std::filesystem::file_status replaced = std::filesystem::symlink_status(path, ignored);
  if (std::filesystem::is_regular_file(replaced)) std::filesystem::permissions(part, replaced.permissions(), ignored);
  std::filesystem::rename(part, path, failure);
  if (!failure) return bytes.size();
  std::filesystem::remove(part, ignored);
  return refused(failure.message());
}

}  // namespace swiftlet
