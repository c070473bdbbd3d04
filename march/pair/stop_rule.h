// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// When bounds are good enough. One rule serves certified GJK, the descent through levels and the depth: it knows two numbers,
// and not what they are bounds of.
#pragma once

#include "numeric/vec.h"

namespace swiftlet {

/// An error that a caller allows: one that is NaN or negative asks for none.
static inline double allowed_error(double asked) { return asked > 0 ? asked : 0; }

/// Bounds suffice when they are narrow, or on one side of a threshold. Lengths are in the bodies' unit.
struct StopRule {
  double absolute = 0, relative = 0;  ///< allowed width: a length, or a fraction of `lower` - `zero` if that is larger
  double above = kInfinity;           ///< enough when `lower` exceeds this
  double below = -kInfinity;          ///< enough when `upper` is less than this
  double zero = 0;                    ///< the relative width counts from here: where rounded bodies touch
  double rounding = 0;                ///< the allowed width is reduced by this
  double least = 0;                   ///< a width that is always allowed

  bool is_threshold() const { return above < kInfinity; }
  bool is_loose() const { return absolute > 0 || relative > 0; }
  bool is_exact() const { return !(is_loose() || is_threshold()); }
  /// The most that bounds may be apart at this `lower`. If it is not above 0, no bounds are narrow.
  double allowed(double lower) const { return max(max(absolute, relative * (lower - zero)) - rounding, least); }
  bool allows(double lower, double width) const { return allowed(lower) > 0 && width <= allowed(lower); }
  bool narrow(double lower, double upper) const { return allows(lower, upper - lower); }
  bool passed(double lower, double upper) const { return lower > above || upper < below; }
  [[gnu::always_inline]] bool met(double lower, double upper) const { return narrow(lower, upper) || passed(lower, upper); }

  /// The same with thresholds that are passed only by more than `margin`.
  StopRule beyond_by(double margin) const {
    StopRule stricter = *this;
    stricter.above += margin, stricter.below -= margin;
    return stricter;
  }
  /// The same, but `width` is always allowed.
  StopRule at_least(double width) const {
    StopRule looser = *this;
    looser.least = max(least, width);
    return looser;
  }
};

/// Allows no width and knows no threshold.
constexpr StopRule kExact{};

}  // namespace swiftlet
