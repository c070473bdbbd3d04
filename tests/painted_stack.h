// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How much stack a call takes: it runs on a painted stack of its own, and the paint that is left tells.
#pragma once

#include <ucontext.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>

namespace swiftlet {

#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
inline constexpr bool kIsMeasured = true;
#else
inline constexpr bool kIsMeasured = false;
#endif

/// A stack that knows how far it was used. Its beginning is `aside` bytes below an address that is a multiple of 64: frames
/// that hold vectors are aligned, so that what a call takes depends on where it begins.
class PaintedStack {
 public:
  explicit PaintedStack(std::size_t aside = 0) : top_(kBytes - aside) {}

  /// The bytes that `work` needed, with less than 256 of its call.
  std::size_t use(const std::function<void()>& work) {
    std::fill(stack_->begin(), stack_->end(), kPaint);
    ucontext_t here, there;
    getcontext(&there);
    there.uc_stack.ss_sp = stack_->data();
    there.uc_stack.ss_size = top_;
    there.uc_link = &here;
    work_ = &work;
    makecontext(&there, &PaintedStack::run, 0);
    swapcontext(&here, &there);
    const auto lowest = std::find_if(stack_->begin(), stack_->end(), [](unsigned char c) { return c != kPaint; });
    return top_ - std::size_t(lowest - stack_->begin());
  }

 private:
  static void run() { (*work_)(); }
  static constexpr unsigned char kPaint = 0xa5;
  static inline const std::function<void()>* work_ = nullptr;
  static constexpr std::size_t kBytes = kIsMeasured ? 256 << 10 : 1 << 20;  ///< frames of sanitizers are large
  struct alignas(64) Bytes : std::array<unsigned char, kBytes> {};
  std::unique_ptr<Bytes> stack_ = std::make_unique<Bytes>();
  std::size_t top_;
};

}  // namespace swiftlet
