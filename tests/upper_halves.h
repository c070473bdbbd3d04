// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the upper halves of registers are left in use, which slows down what others do with the lower ones (x86-64).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#include <cpuid.h>
#endif

namespace swiftlet {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// True if the processor tells whether they are in use, and no sanitizer's own code uses them.
inline bool upper_halves_can_be_seen() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (!__get_cpuid(1, &a, &b, &c, &d) || (c & bit_OSXSAVE) == 0 || (c & bit_AVX) == 0) return false;
  return __get_cpuid_count(0xd, 1, &a, &b, &c, &d) && (a & 4) != 0;  // XGETBV with ECX = 1
}
inline void clear_upper_halves() { asm volatile("vzeroupper" ::: "memory"); }
inline bool upper_halves_are_in_use() {
  unsigned low = 0, high = 0;
  asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));
  return (low & 4) != 0;
}
/// Sets them, so that a test sees that it would notice.
inline void use_upper_halves() { asm volatile("vcmptrueps %%ymm0, %%ymm0, %%ymm0" ::: "xmm0"); }
#else
inline bool upper_halves_can_be_seen() { return false; }
inline void clear_upper_halves() {}
inline bool upper_halves_are_in_use() { return false; }
inline void use_upper_halves() {}
#endif

/// How often `call` leaves them in use.
template <class Call>
int leaves_upper_halves_in_use(Call call) {
  clear_upper_halves();
  call();
  return upper_halves_are_in_use();
}

}  // namespace swiftlet
