// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A trial in a process of its own, so that a method that hangs, aborts or crashes costs one case. POSIX.
#pragma once

#include <functional>

#include "trial.h"

namespace swiftlet::stability {

/// What `trial` found; `not_terminated` after so many seconds of wall clock, `no_number` when it threw or was killed. What the
/// trial writes to standard output or standard error is dropped. Not to be called while other threads run.
Findings isolated(int seconds, const std::function<Findings()>& trial);

}  // namespace swiftlet::stability
