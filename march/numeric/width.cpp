// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The choice of the width of registers, made when the program starts.
#include "numeric/width.h"

namespace swiftlet {
namespace {

bool has_four() {
#if SWIFTLET_BY_FOUR
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

}  // namespace

bool detail::by_four = has_four();  // before that, it is false

bool set_width(Width width) {
  detail::by_four = width == Width::Four && has_four();
  return by_four() == (width == Width::Four);
}

}  // namespace swiftlet
