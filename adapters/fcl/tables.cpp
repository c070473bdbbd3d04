// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<double>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<double>>;
template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::Solver<float>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::Solver<float>>;
