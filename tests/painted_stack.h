// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How much stack a call takes: it runs on a painted stack of its own, and the paint that is left tells.
#pragma once

#include <ucontext.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace swiftlet {

#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
inline constexpr bool kIsMeasured = true;
#else
inline constexpr bool kIsMeasured = false;
#endif

/// A stack that knows how far it was used.
class PaintedStack {
 public:
  /// The bytes that `work` needed, with less than 256 of its call.
  std::size_t use(const std::function<void()>& work) {
    std::fill(stack_.begin(), stack_.end(), kPaint);
    ucontext_t here, there;
    getcontext(&there);
    there.uc_stack.ss_sp = stack_.data();
    there.uc_stack.ss_size = stack_.size();
    there.uc_link = &here;
    work_ = &work;
    makecontext(&there, &PaintedStack::run, 0);
    swapcontext(&here, &there);
    return std::size_t(stack_.end() - std::find_if(stack_.begin(), stack_.end(), [](unsigned char c) { return c != kPaint; }));
  }

 private:
  static void run() { (*work_)(); }
  static constexpr unsigned char kPaint = 0xa5;
  static inline const std::function<void()>* work_ = nullptr;
  std::vector<unsigned char> stack_ = std::vector<unsigned char>(256 << 10);
};

}  // namespace swiftlet
