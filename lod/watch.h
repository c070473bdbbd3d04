// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How far a build is, and whether it is still wanted. Knows nothing of what is done.
#pragma once

#include <atomic>
#include <exception>
#include <string>
#include <string_view>
#include <thread>

#include <swiftlet/build.h>

namespace swiftlet::lod {

/// Thrown where the progress callback says no, from however deep; `build` catches it.
struct Cancelled {};

/// Turns work, in units that only its stage knows, into calls of the progress callback: one wherever the fraction done grew by
/// `kStride`, and one where a stage begins. Throws Cancelled where that returns false. Work may be told of on any thread, but
/// the callback is called on that which made the watch; once it has thrown, the others throw the same.
class Watch {
 public:
  explicit Watch(const Progress& progress) : progress_(progress) {}

  /// From here to `end`, a fraction of the whole, about so many units of work are to be done. More than estimated changes
  /// nothing but the pace of the fraction, which never passes `end`.
  void begin(std::string_view stage, double end, double units);
  void work(double units = 1);
  /// All is done.
  void end();

 private:
  static constexpr double kStride = 0.0025;  ///< of a build of 60 s, 0.15 s

  void report(double fraction);

  const Progress& progress_;
  const std::thread::id thread_ = std::this_thread::get_id();
  std::string stage_;
  double begin_ = 0, end_ = 0, units_ = 1, due_ = 0, reported_ = 0;
  std::atomic<double> done_ = 0;
  std::exception_ptr stop_;  ///< what the thread that made the watch threw; to be read if `stopped_`
  std::atomic<bool> stopped_ = false;
};

}  // namespace swiftlet::lod
