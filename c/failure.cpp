// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Codes and sentences of what went wrong.
#include "failure.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

namespace swiftlet::c {
namespace {

static_assert(int(ErrorCode::CannotRead) + 1 == SWIFTLET_CANNOT_READ);
static_assert(int(ErrorCode::CannotWrite) + 1 == SWIFTLET_CANNOT_WRITE);
static_assert(int(ErrorCode::BadFormat) + 1 == SWIFTLET_BAD_FORMAT);
static_assert(int(ErrorCode::BadVersion) + 1 == SWIFTLET_BAD_VERSION);
static_assert(int(ErrorCode::BadValue) + 1 == SWIFTLET_BAD_VALUE);
static_assert(int(ErrorCode::Empty) + 1 == SWIFTLET_EMPTY);
static_assert(int(ErrorCode::NotConvex) + 1 == SWIFTLET_NOT_CONVEX);
static_assert(int(ErrorCode::NotSolid) + 1 == SWIFTLET_NOT_SOLID);
static_assert(int(ErrorCode::NotEnclosing) + 1 == SWIFTLET_NOT_ENCLOSING);
static_assert(int(ErrorCode::TooLarge) + 1 == SWIFTLET_TOO_LARGE);
static_assert(int(ErrorCode::Cancelled) + 1 == SWIFTLET_CANCELLED);

void copy_text(const char* text, char* to, std::size_t size) {
  std::size_t end = std::min(std::strlen(text), size - 1);
  if (text[end])
    while (end > 0 && (text[end] & 0xc0) == 0x80) --end;  // no character is cut
  std::memcpy(to, text, end);
  to[end] = 0;
}

swiftlet_code tell(swiftlet_error* error, swiftlet_code code, const char* message) {
  if (!error || error->size < 16) return code;
  error->code = code;
  copy_text(message, error->message, error->size - offsetof(swiftlet_error, message));
  return code;
}

}  // namespace

void copy_text(const std::string& text, char* to, std::size_t size) { copy_text(text.c_str(), to, size); }

swiftlet_code tell(swiftlet_error* error) noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    return tell(error, failure.code, failure.message.c_str());
  } catch (const std::bad_alloc&) {
    return tell(error, SWIFTLET_NO_MEMORY, swiftlet_code_text(SWIFTLET_NO_MEMORY));
  } catch (const std::length_error&) {
    return tell(error, SWIFTLET_NO_MEMORY, swiftlet_code_text(SWIFTLET_NO_MEMORY));
  } catch (const std::exception& exception) {
    return tell(error, SWIFTLET_UNEXPECTED, exception.what());
  } catch (...) {
    return tell(error, SWIFTLET_UNEXPECTED, swiftlet_code_text(SWIFTLET_UNEXPECTED));
  }
}

}  // namespace swiftlet::c

const char* swiftlet_code_text(swiftlet_code code) {
  switch (code) {
    case SWIFTLET_OK: return "done";
    case SWIFTLET_CANNOT_READ: return "the file is missing or unreadable";
    case SWIFTLET_CANNOT_WRITE: return "the file cannot be written";
    case SWIFTLET_BAD_FORMAT: return "the data are not in the format expected, or damaged";
    case SWIFTLET_BAD_VERSION: return "a format version that this library does not read";
    case SWIFTLET_BAD_VALUE: return "an argument, option or coordinate is out of its range";
    case SWIFTLET_EMPTY: return "there are no points";
    case SWIFTLET_NOT_CONVEX: return "the faces are no closed convex surface";
    case SWIFTLET_NOT_SOLID: return "not a solid";
    case SWIFTLET_NOT_ENCLOSING: return "a coarser level does not enclose level 0";
    case SWIFTLET_TOO_LARGE: return "too many features or levels";
    case SWIFTLET_CANCELLED: return "stopped by the caller";
    case SWIFTLET_NULL_POINTER: return "a pointer that may not be null is";
    case SWIFTLET_BAD_SIZE: return "the size of a struct is wrong";
    case SWIFTLET_NO_MEMORY: return "there is no memory";
    case SWIFTLET_UNEXPECTED: return "an unexpected error";
    default: return "no code of this library";
  }
}

const char* swiftlet_version(void) { return SWIFTLET_VERSION; }
