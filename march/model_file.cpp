// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/model_file.h>

#include <array>
#include <fstream>
#include <system_error>

#include "block.h"

namespace swiftlet {
namespace {

Error named(const std::filesystem::path& path, Error error) {
  error.message = path.string() + ": " + error.message;
  return error;
}

}  // namespace

Result<std::size_t> save(const Model& model, const std::filesystem::path& path) {
  const std::span<const std::byte> bytes = model.bytes();
  std::filesystem::path part = path;
  part += ".part";
  std::error_code failure;
  if (std::filesystem::exists(path, failure) && !std::filesystem::is_regular_file(path, failure)) {
    return Error{ErrorCode::CannotWrite, path.string() + ": exists and is no file"};
  }
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    file.close();
    if (!file) {
      std::filesystem::remove(part, failure);
      return Error{ErrorCode::CannotWrite, path.string() + ": cannot write " + std::to_string(bytes.size()) + " bytes"};
    }
  }
  std::filesystem::rename(part, path, failure);
  if (failure) {
    const std::string why = failure.message();
    std::filesystem::remove(part, failure);
    return Error{ErrorCode::CannotWrite, path.string() + ": " + why};
  }
  return bytes.size();
}

Result<Model> load(const std::filesystem::path& path) {
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(path, failure);
  if (failure) return Error{ErrorCode::CannotRead, path.string() + ": " + failure.message()};
  std::ifstream file(path, std::ios::binary);
  std::array<std::byte, sizeof(BlockHeader)> start;
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  const auto got = std::size_t(file.gcount());
  if (const auto header = BlockReader::read_header(std::span(start).first(got), size); !header)
    return named(path, header.error());
  AlignedBytes block(size);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(block.data()), std::streamsize(size));
  if (!file) return Error{ErrorCode::CannotRead, path.string() + ": ends early"};
  Result<Model> model = BlockReader::read(std::move(block));
  if (!model) return named(path, model.error());
  return model;
}

Result<Model> load(std::span<const std::byte> bytes) {
  if (const auto header = BlockReader::read_header(bytes, bytes.size()); !header) return header.error();
  AlignedBytes block(bytes.size());
  std::memcpy(block.data(), bytes.data(), bytes.size());
  return BlockReader::read(std::move(block));
}

}  // namespace swiftlet
