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
  done_ += units;
  if (done_ >= due_) report(begin_ + (end_ - begin_) * std::min(1.0, done_ / units_));
}

void Watch::end() { report(1); }

/// What is due next is known in units, so that most work costs a comparison.
void Watch::report(double fraction) {
  due_ = done_ + kStride * units_ / std::max(end_ - begin_, kStride);
  reported_ = std::max(reported_, fraction);
  if (progress_ && !progress_(reported_, stage_)) throw Cancelled{};
}

}  // namespace swiftlet::lod
