// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/fcl.h>

template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::ShapeSolver<double>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::ShapeSolver<double>>;
template struct fcl::detail::CollisionFunctionMatrix<swiftlet::fcl::ShapeSolver<float>>;
template struct fcl::detail::DistanceFunctionMatrix<swiftlet::fcl::ShapeSolver<float>>;
