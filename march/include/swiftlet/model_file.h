// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models on disk. The file is the model's block; its layout is described in march/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// The version written; files of another version are refused.
inline constexpr std::uint32_t kModelFileVersion = 3;

/// Writes beside `path` and renames, so that a failure leaves the old file. Returns the bytes written.
/// Errors: CannotWrite, with what the system says.
Result<std::size_t> save(const Model& model, const std::filesystem::path& path);

/// Reads a file as far as `detail` asks: coarse levels come first, and what is not needed is neither read nor kept. Sizes,
/// hashes, index ranges and topology are checked before anything large is allocated or believed; geometry is not: see `verify`
/// in check.h. Cost: one pass over the bytes read.
/// Errors: CannotRead, BadFormat (names what is damaged; a file cut short too), BadVersion.
Result<Model> load(const std::filesystem::path& path, const Detail& detail = {});

/// The same from memory, which is copied.
Result<Model> load(std::span<const std::byte> bytes, const Detail& detail = {});

/// The same without a copy: the model's memory is the file's pages, which processes share. Of levels finer than `detail` asks
/// for no page is touched until `Model::ensure` reads them. The file must stay as it is while the model or a copy of it lives;
/// renaming or deleting it, as `save` does with what it replaces, is fine.
Result<Model> map(const std::filesystem::path& path, const Detail& detail = {});

/// What is left of a file cut short.
struct Salvaged {
  Model model;       ///< of the levels that are complete
  std::string note;  ///< one sentence on what is missing; empty for a whole file
};

/// Reads the complete levels of a file that ends early.
/// Errors: as `load`; BadFormat where not even the coarsest level is complete.
Result<Salvaged> salvage(const std::filesystem::path& path);

}  // namespace swiftlet
