// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How far the builder is, on a terminal.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

namespace swiftlet::tool {

/// A bar on stderr, where that is a terminal. It clears its line when it ends.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted) : shown_(wanted && isatty(STDERR_FILENO)) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  bool operator()(double fraction, std::string_view stage) const {
    if (!shown_) return true;
    constexpr int kWidth = 40;
    const int done = std::clamp(int(fraction * kWidth), 0, kWidth);
    std::fprintf(stderr, "\r\033[K[%s%s] %3.0f %%  %.*s", std::string(std::size_t(done), '#').c_str(),
                 std::string(std::size_t(kWidth - done), '.').c_str(), 100 * fraction, int(stage.size()), stage.data());
    return true;
  }

 private:
  const bool shown_;
};

}  // namespace swiftlet::tool
