// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One of libFuzzer's programs. SWIFTLET_FUZZ_TARGET says which.
#include <cstdio>
#include <cstdlib>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault = swiftlet::fuzz::SWIFTLET_FUZZ_TARGET({data, size});
  if (fault.empty()) return 0;
  std::fprintf(stderr, "wrong: %s\n", fault.c_str());
  std::abort();
}
