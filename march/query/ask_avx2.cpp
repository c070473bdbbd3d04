// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about distance with registers of four doubles, compiled for AVX2: see width.h.
#define SWIFTLET_FOR_AVX2
#include "numeric/width.h"

#if SWIFTLET_BY_FOUR
#include "query/ask.cpp"
#endif
