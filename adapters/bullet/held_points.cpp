// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "held_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "shapes.h"

namespace swiftlet::bullet {
namespace {

using Places = std::array<btVector3, MANIFOLD_CACHE_SIZE>;

/// The points' places on B, their distances, and how deep the deepest is.
struct Held {
  Places on_b;
  std::array<btScalar, MANIFOLD_CACHE_SIZE> distance;
  btScalar deepest = BT_LARGE_FLOAT;
};

/// False if there is no area, one of the points has left the other body, or the deepest is not as deep as `least`, to `slack`.
/// The points are places on the bodies: these may have got other margins or, as parts of compounds, other places.
bool find(const btPersistentManifold& points, const btVector3& normal, double least, btScalar slack, Held& held) {
  const btTransform &a = points.getBody0()->getWorldTransform(), &b = points.getBody1()->getWorldTransform();
  const btScalar far = points.getContactBreakingThreshold();
  for (int i = 0; i < points.getNumContacts(); ++i) {
    const btManifoldPoint& p = points.getContactPoint(i);
    const btVector3 on_b = b(p.m_localPointB), apart = a(p.m_localPointA) - on_b;
    const btScalar distance = apart.dot(normal);
    if (distance > far || (apart - normal * distance).length2() > far * far) return false;
    held.on_b[std::size_t(i)] = on_b;
    held.distance[std::size_t(i)] = distance;
    held.deepest = std::min(held.deepest, distance);
  }
  return points.getNumContacts() >= 3 && std::fabs(double(held.deepest) - least) <= slack * far;
}

/// Twice the area of three or four places, in any order, seen along `n`.
btScalar area(const Places& p, int count, const btVector3& n) {
  const auto across = [&](const btVector3& u, const btVector3& v) { return btFabs(u.cross(v).dot(n)); };
  if (count == 3) return across(p[1] - p[0], p[2] - p[0]);
  const btScalar of_diagonals[] = {across(p[0] - p[1], p[2] - p[3]), across(p[0] - p[2], p[1] - p[3]),
                                   across(p[0] - p[3], p[1] - p[2])};
  return *std::max_element(std::begin(of_diagonals), std::end(of_diagonals));
}

/// Hands each point to Bullet again, which gives it the frictions of this step, calls back and keeps its impulses; but as a
/// place on both bodies it stays. Bullet's solver goes through the points one by one, and what it leaves undone is always on
/// the same side of those that it visits in the same order: a tower leans that way more with every step. So the first becomes
/// the last.
void take_turns(const Held& held, const btVector3& normal, btManifoldResult& result) {
  btPersistentManifold& points = *result.getPersistentManifold();
  const int count = points.getNumContacts();
  Places local_a, local_b;
  for (int i = 0; i < count; ++i) {
    local_a[std::size_t(i)] = points.getContactPoint(i).m_localPointA;
    local_b[std::size_t(i)] = points.getContactPoint(i).m_localPointB;
  }
  for (int i = 0; i < count; ++i) {
    const btManifoldPoint& p = points.getContactPoint(i);
    result.setShapeIdentifiersA(p.m_partId0, p.m_index0);
    result.setShapeIdentifiersB(p.m_partId1, p.m_index1);
    result.addContactPoint(normal, held.on_b[std::size_t(i)], held.distance[std::size_t(i)]);
  }
  for (int i = 0; i < count; ++i) {
    points.getContactPoint(i).m_localPointA = local_a[std::size_t(i)];
    points.getContactPoint(i).m_localPointB = local_b[std::size_t(i)];
  }
  for (int i = 1; i < count; ++i) std::swap(points.getContactPoint(i - 1), points.getContactPoint(i));
}

}  // namespace

bool hold_on(const Manifold& now, btManifoldResult& result) {
  const btVector3 normal = vector_of(-now.normal);
  Held held;
  if (!find(*result.getPersistentManifold(), normal, now.points[0].separation, kHeldDepth + 2 * kAtRest, held)) return false;
  take_turns(held, normal, result);
  return true;
}

bool hold_the_area(const Manifold& now, btManifoldResult& result) {
  const btPersistentManifold& points = *result.getPersistentManifold();
  const btVector3 normal = vector_of(-now.normal);
  Held held;
  if (now.count < 3 || !find(points, normal, now.points[0].separation, kHeldDepth, held)) return false;
  Places corners;
  for (std::uint32_t i = 0; i < now.count; ++i) corners[i] = vector_of(now.points[i].point_b);
  if (area(held.on_b, points.getNumContacts(), normal) < kHeldArea * area(corners, int(now.count), normal)) return false;
  take_turns(held, normal, result);
  return true;
}

void forget_others(btPersistentManifold& points, const Manifold& now, bool swapped) {
  const btTransform& in_world = points.getBody0()->getWorldTransform();
  for (int i = points.getNumContacts(); i-- > 0;) {
    const btVector3 old = in_world(points.getContactPoint(i).m_localPointA);
    bool stays = false;
    for (std::uint32_t k = 0; k < now.count; ++k) {
      const btVector3 p = vector_of(swapped ? now.points[k].point_b : now.points[k].point_a);
      stays = stays || (p - old).length() < points.getContactBreakingThreshold();
    }
    if (!stays) points.removeContactPoint(i);
  }
}

}  // namespace swiftlet::bullet
