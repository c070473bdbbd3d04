// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts what a program allocates. One file of a program may include this.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
std::atomic<std::size_t> allocated_bytes{0};  // in all, whether or not they were freed
}  // namespace
// Not inline: GCC would see malloc meet delete. The nothrow form too: sanitizers insist that new and delete come in pairs.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations, allocated_bytes += size;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* p = operator new(size, std::nothrow)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
// Types of wider alignment, as nodes and registers are, have operators of their own.
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  ++allocations, allocated_bytes += size;
  const auto unit = std::size_t(alignment);
  return std::aligned_alloc(unit, (std::max<std::size_t>(size, 1) + unit - 1) / unit * unit);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  if (void* p = operator new(size, alignment, std::nothrow)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace {
/// True if allocations of either alignment are counted. The calls are no expressions, which compilers may leave out.
[[maybe_unused]] bool allocations_are_counted() {
  const long before = allocations;
  ::operator delete(::operator new(1));
  constexpr std::align_val_t kWide{64};
  ::operator delete(::operator new(1, kWide), kWide);
  return allocations - before == 2;
}
}  // namespace
