// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The bodies and poses at which the baselines are recorded: the same bits on every machine, without the builder, without libm.
#pragma once

#include <string>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::yardstick {

/// Two different bodies, and the poses at which they are asked about, one after the other.
struct Cell {
  std::string name;  ///< fat/1.04
  const Model& a;
  const Model& b;
  std::vector<Pose> poses;
};

/// Fat, plate and long ellipsoids of 2 000 triangles with the paper's table of 5.625 degrees.
class Cells {
 public:
  Cells();
  /// Of each family: the same pose, the paper's orbit at 1.04 and 10.4 degrees a query [Ehmann & Lin 2000, sec. 5.3], random
  /// poses; 4 seeds of 125 queries, centres 2 and more apart.
  std::vector<Cell> all() const;

 private:
  std::vector<Model> models_;
};

}  // namespace swiftlet::yardstick
