// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Saves, loads, maps and salvages model files. Knows the headers of a block; `BlockReader` reads the sections.
#include <swiftlet/model_file.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "body/block.h"
#include "body/file.h"

namespace swiftlet {
namespace {

/// The checked headers of a file, and its size.
struct File {
  Headers headers;
  std::uint64_t bytes;
};

Result<File> open(const std::filesystem::path& path) {
  if (const std::string fault = irregularity(path); !fault.empty()) return named(path, {ErrorCode::CannotRead, fault});
  std::error_code failure;
  const std::uint64_t bytes = std::filesystem::file_size(path, failure);
  if (failure) return named(path, {ErrorCode::CannotRead, failure.message()});
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return named(path, {ErrorCode::CannotRead, std::generic_category().message(errno ? errno : EIO)});
  std::array<std::byte, kMostHeaderBytes> start;
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  Result<Headers> headers = BlockReader::read_headers(std::span(start).first(std::size_t(file.gcount())));
  if (!headers) return named(path, headers.error());
  return File{std::move(headers).value(), bytes};
}

/// Returns a model of level `finest` and all coarser levels of the block. `cut` copies them to a new block where finer levels
/// stood before them.
Result<Model> kept(AlignedBytes block, int finest) {
  const Result<Model> model = BlockReader::read(std::move(block), finest);
  if (!model) return model.error();
  return model.value().cut({});
}

Result<Model> read(const std::filesystem::path& path, const Headers& headers, int finest) {
  const std::uint64_t bytes = headers.prefix(finest);
  if (bytes > std::uint64_t{PTRDIFF_MAX})
    return named(path, {ErrorCode::TooLarge, std::to_string(bytes) + " bytes are more than this machine can address"});
  AlignedBytes block{std::size_t(bytes)};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(block.data()), std::streamsize(block.view().size()));
  if (!file) return named(path, {ErrorCode::CannotRead, "ends early"});
  Result<Model> model = kept(std::move(block), finest);
  if (!model) return named(path, model.error());
  return model;
}

}  // namespace

Result<std::size_t> save(const Model& model, const std::filesystem::path& path) { return replace_file(path, model.bytes()); }

Result<Model> load(const std::filesystem::path& path, const Detail& detail) {
  const Result<File> file = open(path);
  if (!file) return file.error();
  const Headers& headers = file.value().headers;
  if (const std::string f = length_fault(headers, file.value().bytes); !f.empty())
    return named(path, {ErrorCode::BadFormat, f});
  return read(path, headers, headers.finest(detail));
}

Result<Model> load(std::span<const std::byte> bytes, const Detail& detail) {
  const Result<Headers> headers = BlockReader::read_headers(bytes);
  if (!headers) return headers.error();
  if (const std::string f = length_fault(headers.value(), bytes.size()); !f.empty()) return Error{ErrorCode::BadFormat, f};
  const int finest = headers.value().finest(detail);
  AlignedBytes block(headers.value().prefix(finest));
  std::memcpy(block.data(), bytes.data(), block.view().size());
  return kept(std::move(block), finest);
}

Result<Model> map(const std::filesystem::path& path, const Detail& detail) {
  Result<Block> block = map_file(path);
  if (!block) return block.error();
  const auto bytes = block.value().bytes;
  const Result<Headers> headers = BlockReader::read_headers(bytes);
  if (!headers) return named(path, headers.error());
  if (const std::string f = length_fault(headers.value(), bytes.size()); !f.empty())
    return named(path, {ErrorCode::BadFormat, f});
  Result<Model> model = BlockReader::read(std::move(block).value(), headers.value().finest(detail));
  if (!model) return named(path, model.error());
  return model;
}

Result<Salvaged> salvage(const std::filesystem::path& path) {
  const Result<File> file = open(path);
  if (!file) return file.error();
  const Headers& headers = file.value().headers;
  const std::uint64_t bytes = file.value().bytes;
  const std::string cut = length_fault(headers, bytes);
  if (bytes > headers.block.total_bytes) return named(path, {ErrorCode::BadFormat, cut});
  const int finest = headers.finest({0, bytes});
  if (headers.prefix(finest) > bytes) {
    return named(path,
                 {ErrorCode::BadFormat, cut + ", and its coarsest level needs " + std::to_string(headers.prefix(finest))});
  }
  Result<Model> model = read(path, headers, finest);
  if (!model) return model.error();
  const std::string note = utf8(path) + ": " + cut + ": levels finer than " + std::to_string(finest) + " are missing";
  return Salvaged{std::move(model).value(), cut.empty() ? "" : note};
}

}  // namespace swiftlet
