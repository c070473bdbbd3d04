// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What an exact answer may claim falsely, member by member: a check must refuse each.
#pragma once

#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include <swiftlet/query.h>

namespace swiftlet::forgeries {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

/// Changes an answer by `off`, several times law 2's bound and less than the distance or the depth, or by far more.
struct Forgery {
  const char* what;
  void (*forge)(Answer& of, double off);
};

inline constexpr Forgery kForgeries[] = {
    {"never asked", [](Answer& s, double) { s.status = Status::NotAsked; }},
    {"refused", [](Answer& s, double) { s.status = Status::InvalidPose; }},
    {"touching", [](Answer& s, double) { s.verdict = Verdict::Touching; }},
    {"the other verdict", [](Answer& s, double) { s.verdict = s.lower > 0 ? Verdict::Overlapping : Verdict::Disjoint; }},
    {"undecided", [](Answer& s, double) { s.verdict = Verdict::Undecided; }},
    {"a level of A", [](Answer& s, double) { s.level_a = 77; }},
    {"a level of B", [](Answer& s, double) { s.level_b = -1; }},
    {"no such vertex of A",
     [](Answer& s, double) {
       s.feature_a = {FeatureKind::Vertex, 1u << 29};
     }},
    {"no such edge of A",
     [](Answer& s, double) {
       s.feature_a = {FeatureKind::Edge, 1u << 29};
     }},
    {"no such face of B",
     [](Answer& s, double) {
       s.feature_b = {FeatureKind::Face, 1u << 29};
     }},
    {"no feature of A", [](Answer& s, double) { s.feature_a = {}; }},
    {"no feature of B", [](Answer& s, double) { s.feature_b = {}; }},
    {"lower", [](Answer& s, double off) { s.lower += off, s.upper += off; }},
    {"upper", [](Answer& s, double off) { s.lower -= off, s.upper -= off; }},
    {"no lower bound", [](Answer& s, double) { s.lower = kNaN; }},
    {"no upper bound", [](Answer& s, double) { s.upper = kNaN; }},
    {"no interval", [](Answer& s, double off) { s.upper = s.lower - off; }},
    {"a normal of length 7", [](Answer& s, double) { s.normal *= 7; }},
    {"a normal a little long", [](Answer& s, double) { s.normal *= 1 + 1e-10; }},
    {"a normal turned round", [](Answer& s, double) { s.normal = -s.normal; }},
    {"a normal of length 0", [](Answer& s, double) { s.normal.setZero(); }},
    {"a normal that is no number", [](Answer& s, double) { s.normal[2] = kNaN; }},
    {"an infinite normal", [](Answer& s, double) { s.normal[0] = kInfinity; }},
    {"no normal", [](Answer& s, double) { s.normal.setConstant(kNaN); }},
    {"point_a along the normal", [](Answer& s, double off) { s.point_a += off * s.normal; }},
    {"point_a against the normal", [](Answer& s, double off) { s.point_a -= off * s.normal; }},
    {"point_a aside", [](Answer& s, double off) { s.point_a += off * s.normal.unitOrthogonal(); }},
    {"point_a far aside", [](Answer& s, double) { s.point_a += 0.037 * s.normal.unitOrthogonal(); }},
    {"point_a is no number", [](Answer& s, double) { s.point_a[0] = kNaN; }},
    {"point_a is infinite", [](Answer& s, double) { s.point_a[1] = kInfinity; }},
    {"no point_a", [](Answer& s, double) { s.point_a.setConstant(kNaN); }},
    {"point_b along the normal", [](Answer& s, double off) { s.point_b += off * s.normal; }},
    {"point_b against the normal", [](Answer& s, double off) { s.point_b -= off * s.normal; }},
    {"point_b aside", [](Answer& s, double off) { s.point_b -= off * s.normal.unitOrthogonal(); }},
    {"point_b far aside", [](Answer& s, double) { s.point_b -= 0.037 * s.normal.unitOrthogonal(); }},
    {"point_b is no number", [](Answer& s, double) { s.point_b[2] = kNaN; }},
    {"point_b is infinite", [](Answer& s, double) { s.point_b[1] = -kInfinity; }},
    {"no point_b", [](Answer& s, double) { s.point_b.setConstant(kNaN); }},
    {"no points", [](Answer& s, double) { s.point_a.setConstant(kNaN), s.point_b.setConstant(kNaN); }},
    {"point_b is point_a", [](Answer& s, double) { s.point_b = s.point_a; }},
    {"point_a is point_b", [](Answer& s, double) { s.point_a = s.point_b; }},
    {"points swapped", [](Answer& s, double) { std::swap(s.point_a, s.point_b); }},
    {"points elsewhere", [](Answer& s, double) { s.point_a += Vec3(1, 50, 0), s.point_b += Vec3(1, 50, 0); }},
    {"one point elsewhere", [](Answer& s, double) { s.point_a = s.point_b = Vec3(1, 50, 0); }},
    {"radius of A", [](Answer& s, double) { s.radius_a += 0.125; }},
    {"radius of B", [](Answer& s, double) { s.radius_b = kNaN; }},
};

}  // namespace swiftlet::forgeries
