// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How many doubles the registers of hot functions hold. Such a function is compiled in two files: for the registers that every
// processor of the target has, and, where CMakeLists.txt says so by SWIFTLET_AVX2, for AVX2, without FMA, which would round
// differently. Answers are the same, bit for bit.
//
// A file for AVX2 may define no symbol but the functions whose names end in _by_four: the linker might take a function that it
// shares with other files, as inline ones are, for theirs too, and these run on any processor. Without optimisation, or for
// size, such functions are not inlined, and these files are empty.
#pragma once

#include <cstdint>

#if SWIFTLET_AVX2 && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#define SWIFTLET_BY_FOUR 1
#if defined(__AVX__)
#define SWIFTLET_BY_WIDTH(name, ...) name##_by_four(__VA_ARGS__)
#else
#define SWIFTLET_BY_WIDTH(name, ...) (by_four() ? name##_by_four(__VA_ARGS__) : name##_by_two(__VA_ARGS__))
#endif
#else
#define SWIFTLET_BY_WIDTH(name, ...) name##_by_two(__VA_ARGS__)
#endif
// The name under which a file for either width defines a function, and the declarations of both.
#if defined(SWIFTLET_FOR_AVX2)
#define SWIFTLET_OF_WIDTH(name) name##_by_four
#else
#define SWIFTLET_OF_WIDTH(name) name##_by_two
#endif
#define SWIFTLET_BOTH_WIDTHS(result, name, ...) result name##_by_two(__VA_ARGS__), name##_by_four(__VA_ARGS__)

namespace swiftlet {

enum class Width : std::uint8_t { Two, Four };
/// Chooses a width; until then it is the widest that the processor has. False if there are no registers of this width.
bool set_width(Width width);

namespace detail {
extern bool by_four;
}
/// True if registers of four doubles are chosen.
static inline bool by_four() { return detail::by_four; }

}  // namespace swiftlet
