// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models on disk. The file is the model's block; march/README.md describes its layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// The version of the file format that `save` writes. Files of any other version are refused.
inline constexpr std::uint32_t kModelFileVersion = 6;

// Paths are the system's; those in errors are UTF-8.

/// Writes PATH.XXXX.part, then renames it: a failure leaves the old file, of calls at once one wins whole, and what a killed
/// process leaves by such a name may be deleted. Returns the bytes written. Errors: CannotWrite, with the cause.
Result<std::size_t> save(const Model& model, const std::filesystem::path& path);

/// Reads the levels of a file that `detail` asks for. Coarse levels come first in the file; levels beyond `detail` are neither
/// read nor kept. Sizes are checked before memory is allocated, then hashes, index ranges and topology; geometry is not
/// checked, see `verify` in check.h. Cost: one pass over the bytes read. Errors: CannotRead, BadFormat (names what is damaged;
/// also for a file cut short), BadVersion, TooLarge (on machines of 32 bits).
Result<Model> load(const std::filesystem::path& path, const Detail& detail = {});

/// Loads a model from the bytes of a file, which are copied.
Result<Model> load(std::span<const std::byte> bytes, const Detail& detail = {});

/// Loads a model without a copy: the model's memory is the mapped file, whose pages processes share. Pages of levels finer than
/// `detail` asks for are not touched until `Model::ensure` reads them. The file's content must not change while the model or a
/// copy of it lives; the file may be renamed or deleted, and replaced by `save`, unless the system refuses that of mapped
/// files, as Windows may. Errors: as `load`.
Result<Model> map(const std::filesystem::path& path, const Detail& detail = {});

/// The result of `salvage`.
struct Salvaged {
  Model model;       ///< holds the levels that are complete in the file
  std::string note;  ///< one sentence that says what is missing; empty for a whole file
};

/// Reads the complete levels of a file that was cut short. Level 0 is complete with the start table and the source map, which
/// come last: up to Level::prefix.
/// Errors: as `load`, but BadFormat for a short file only if not even the coarsest level is complete.
Result<Salvaged> salvage(const std::filesystem::path& path);

}  // namespace swiftlet
