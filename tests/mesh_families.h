// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Families of pairs of small meshes, each made for one difficulty, and rational arithmetic over all pairs of their triangles to
// judge every answer about them. Tests run a sample of them, ./run soak as many as one likes.
#pragma once

#include <span>
#include <string>

#include <CGAL/Exact_rational.h>
#include <swiftlet/mesh_query.h>

#include "soups.h"

namespace swiftlet::mesh_families {

struct Case {
  soups::Soup a, b;
  Pose pose;
};

struct Family {
  const char* name;
  Case (*make)(shapes::Random&, int);
  double touching, apart;  ///< the least share of its pairs that share a point, and that do not: else it misses what it is for
};
std::span<const Family> families();

struct Truth {
  CGAL::Exact_rational squared;  ///< of the distance
  long decided = 0;              ///< pairs of triangles that rationals decided
  double depth = 0;              ///< of the pair of triangles that cross deepest, in long doubles
};

/// Pairs in the order of their distances in long doubles; those that are farther apart along some direction than the least
/// distance so far, by more than long doubles round, are left out.
Truth truth(const soups::Soup& a, const soups::Soup& b, const Pose& pose);

bool at_most(const Truth& truth, double x);   ///< distance <= x
bool at_least(const Truth& truth, double x);  ///< distance >= x
double approximate(const Truth& truth);       ///< the distance in doubles

/// What was found of a pair.
struct Examined {
  std::string fault;  ///< of the first answer that is wrong; "" if none
  Truth truth;
  Answer answer;     ///< its distance
  double width = 0;  ///< of that interval, in units of law 2's bound
  int regions = 0;   ///< of contact
  int told = 0;      ///< 1 if the regions are told apart for sure, and were compared with those of brute force
};
/// Asks all that there is about a pair, of the meshes as they are and with the hull of every node. Thresholds and options come
/// from `random`.
Examined examine(const Case& c, shapes::Random& random);

/// To be read by people and programs: coordinates in hexadecimal.
std::string text(const Case& c);

}  // namespace swiftlet::mesh_families
