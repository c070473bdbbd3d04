// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models on disk. The file is the model's block; its layout is described in march/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// The version written; files of another version are refused.
inline constexpr std::uint32_t kModelFileVersion = 2;

/// Writes beside `path` and renames, so that a failure leaves the old file. Returns the bytes written.
/// Errors: CannotWrite, with what the system says.
Result<std::size_t> save(const Model& model, const std::filesystem::path& path);

/// Reads a whole file. Sizes, hashes, index ranges and topology are checked before anything large is allocated or believed;
/// geometry is not: see `verify` in check.h. Cost: one pass over the bytes.
/// Errors: CannotRead, BadFormat (names what is damaged), BadVersion.
Result<Model> load(const std::filesystem::path& path);

/// The same from memory, which is copied.
Result<Model> load(std::span<const std::byte> bytes);

}  // namespace swiftlet
