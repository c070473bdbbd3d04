// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace hull_tree {
namespace {

/// Between the inner points of two segments, infinity where an end is as near.
double between_lines(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = c - a, n = u.cross(v);
  const double n2 = n.dot(n), s = w.cross(v).dot(n), t = w.cross(u).dot(n);
  if (!(n2 > 0 && s >= 0 && s <= n2 && t >= 0 && t <= n2)) return kInfinity;
  return std::fabs(w.dot(n)) / std::sqrt(n2);
}

/// Whether n points to the inner side of all three edges as seen from p, where n is t's normal.
bool above(const Vec3& p, const Triangle& t, const Vec3& n) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) < 0) return false;
  }
  return true;
}

double height(const Vec3& p, const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  return above(p, t, n) ? std::fabs(n.dot(p - t[0])) / n.norm() : kInfinity;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return (b - a).cross(c - a).dot(d - a); }

bool crosses(const Vec3& p, const Vec3& q, const Triangle& t) {
  const double at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if ((at_p > 0) == (at_q > 0)) return false;
  const double x = volume(p, q, t[0], t[1]), y = volume(p, q, t[1], t[2]), z = volume(p, q, t[2], t[0]);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

}  // namespace

double distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 u = b - a;
  return (p - a - u * std::clamp((p - a).dot(u) / u.dot(u), 0.0, 1.0)).norm();
}

double distance(const Vec3& p, const Triangle& t) {
  return std::min({height(p, t), distance(p, t[0], t[1]), distance(p, t[1], t[2]), distance(p, t[2], t[0])});
}

double distance(const Triangle& a, const Triangle& b) {
  double least = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = a[i], &q = a[(i + 1) % 3];
    if (crosses(p, q, b) || crosses(b[i], b[(i + 1) % 3], a)) return 0;
    least = std::min({least, distance(p, b), distance(b[i], a)});
    for (std::size_t j = 0; j < 3; ++j) least = std::min(least, between_lines(p, q, b[j], b[(j + 1) % 3]));
  }
  return least;
}

Soup soup(const Mesh& mesh, const Pose& pose) {
  Soup s;
  for (const auto& t : mesh.triangles) {
    Triangle& moved = s.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) moved[k] = pose.rotation * mesh.points[t[k]] + pose.translation;
    s.centre.push_back((moved[0] + moved[1] + moved[2]) / 3);
    const Vec3& c = s.centre.back();
    s.radius.push_back(std::max({(moved[0] - c).norm(), (moved[1] - c).norm(), (moved[2] - c).norm()}));
  }
  return s;
}

double distance(const Soup& a, const Soup& b) {
  double best = kInfinity;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      const double reach = best + a.radius[i] + b.radius[j];
      if ((b.centre[j] - a.centre[i]).squaredNorm() > reach * reach) continue;
      best = std::min(best, distance(a.triangles[i], b.triangles[j]));
    }
  }
  return best;
}

std::vector<double> patch_distances(const Soup& a, const Soup& b, const std::vector<std::uint32_t>& patch_a,
                                    const std::vector<std::uint32_t>& patch_b, std::uint32_t patches_a, std::uint32_t patches_b,
                                    double most) {
  std::vector<double> least(std::size_t(patches_a) * patches_b, kInfinity);
  for (std::uint32_t i = 0; i < a.triangles.size(); ++i) {
    for (std::uint32_t j = 0; j < b.triangles.size(); ++j) {
      const double reach = most + a.radius[i] + b.radius[j];
      if ((b.centre[j] - a.centre[i]).squaredNorm() > reach * reach) continue;
      double& entry = least[std::size_t(patch_a[i]) * patches_b + patch_b[j]];
      const double d = distance(a.triangles[i], b.triangles[j]);
      if (d <= most) entry = std::min(entry, d);
    }
  }
  return least;
}

}  // namespace hull_tree
