// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "body/file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
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

Result<OwnedBytes> map_file(const std::filesystem::path& path) {
  const OpenFile file(path);
  if (!file.is_open()) return named(path, {ErrorCode::CannotRead, last_failure()});
  const std::uint64_t size = file.size();
  if (size == 0) return named(path, {ErrorCode::CannotRead, "is empty, or no file"});
  if (size > std::uint64_t{PTRDIFF_MAX})
    return named(path, {ErrorCode::CannotRead, "is larger than what this machine can address"});
  auto pages = file.pages(std::size_t(size));
  if (!pages) return named(path, {ErrorCode::CannotRead, last_failure()});
  const std::byte* const begin = pages.get();
  return OwnedBytes{std::move(pages), {begin, std::size_t(size)}};
}

Result<std::size_t> replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const auto refused = [&path](const std::string& why) { return named(path, {ErrorCode::CannotWrite, why}); };
  std::filesystem::path part = path;
  part += ".part";
  std::error_code failure, ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return refused("exists and is no file");
  errno = 0;
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  file.close();
  const int cause = errno;  // as the system's calls below the stream left it
  if (file) std::filesystem::rename(part, path, failure);
  if (file && !failure) return bytes.size();
  std::filesystem::remove(part, ignored);
  const std::string because = cause ? ": " + std::generic_category().message(cause) : "";
  return refused(file ? failure.message() : "cannot write " + std::to_string(bytes.size()) + " bytes" + because);
}

}  // namespace swiftlet
