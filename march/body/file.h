// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the runtime asks of the system's files, beyond streams: pages of one in memory, and one put in another's place whole or
// not at all. Knows no format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include <swiftlet/result.h>

namespace swiftlet {

/// A path as people read it, in UTF-8 on every system.
std::string utf8(const std::filesystem::path& path);
/// The path of such a text.
std::filesystem::path path_of(const std::string& utf8);
/// The error with its file's name, in `file` and before its message.
Error named(const std::filesystem::path& path, Error error);

/// Why `path` is no regular file, if something else is there, such as a folder, or a pipe, which would wait for who writes into
/// it; empty where nothing is there, too: why that cannot be read, the system tells.
std::string irregularity(const std::filesystem::path& path);

/// What a path names, or where its symbolic links lead, whether or not anything is there; a link of those that end nowhere.
std::filesystem::path target_of(std::filesystem::path path);

/// Bytes and their owner: heap memory, or a mapping of a file that ends with it.
struct OwnedBytes {
  std::shared_ptr<const std::byte[]> owner;
  std::span<const std::byte> bytes;
};

/// The pages of a file, which stay as they are when another file takes its place. Errors: CannotRead, of what is no
/// regular file too, BadFormat of an empty one, and TooLarge.
Result<OwnedBytes> map_file(const std::filesystem::path& path);

/// Writes a new file PATH.XXXX.part, where PATH is the target of `name`, cut where that were too long, with the mode of the
/// file that it replaces, then renames it, so that a failure leaves the old file and nothing beside it. Symbolic links stay,
/// and lead to the new file. Of calls at once, by threads or processes, one wins whole. Returns the bytes written. Errors:
/// CannotWrite.
Result<std::size_t> replace_file(const std::filesystem::path& name, std::span<const std::byte> bytes);

}  // namespace swiftlet
