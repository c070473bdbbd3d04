// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "watch.h"

#include <algorithm>

namespace swiftlet::lod {

void Watch::begin(std::string_view stage, double end, double units) {
  stage_ = stage;
  begin_ = end_;
  end_ = end;
  units_ = units;
  done_ = 0;
  report(begin_);
}

void Watch::work(double units) {
  double done = done_.load(std::memory_order_relaxed);
  while (!done_.compare_exchange_weak(done, done + units, std::memory_order_relaxed)) {
  }
  if (std::this_thread::get_id() != thread_) {
    if (stopped_.load(std::memory_order_acquire)) std::rethrow_exception(stop_);
  } else if (done + units >= due_) {
    report(begin_ + (end_ - begin_) * std::min(1.0, (done + units) / units_));
  }
}

void Watch::end() { report(1); }

/// What is due next is known in units, so that most work costs a comparison.
void Watch::report(double fraction) {
  due_ = done_ + kStride * units_ / std::max(end_ - begin_, kStride);
  reported_ = std::max(reported_, fraction);
  if (!progress_) return;
  try {
    if (!progress_(reported_, stage_)) throw Cancelled{};
  } catch (...) {
    stop_ = std::current_exception();
    stopped_.store(true, std::memory_order_release);
    throw;
  }
}

}  // namespace swiftlet::lod
