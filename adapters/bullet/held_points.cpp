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

/// Bullet takes a new point for the old one whose place on A is nearest, within the breaking threshold: none is near this one.
btVector3 far_away() { return {BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT}; }

/// The points' places on B, their normals and distances along these, and how deep the deepest is.
struct Held {
  Places on_b, normal;
  std::array<btScalar, MANIFOLD_CACHE_SIZE> distance;
  btScalar deepest = BT_LARGE_FLOAT;
};

bool is_part(const btCollisionObjectWrapper& body) {
  return body.getCollisionShape() != body.getCollisionObject()->getCollisionShape();
}

/// False if one of the points has left the other body. Of a compound's part before that: Bullet asks after it has dropped what
/// left, with the last point the contact, so new points have to come while the old ones are near.
template <class NormalOf>
bool find(const btManifoldResult& result, const NormalOf& normal_of, Held& held) {
  const btPersistentManifold& points = *result.getPersistentManifold();
  const btTransform &a = points.getBody0()->getWorldTransform(), &b = points.getBody1()->getWorldTransform();
  const btScalar far = points.getContactBreakingThreshold();
  const btScalar aside = is_part(*result.getBody0Wrap()) || is_part(*result.getBody1Wrap()) ? far / 2 : far;
  for (int i = 0; i < points.getNumContacts(); ++i) {
    const btManifoldPoint& p = points.getContactPoint(i);
    const btVector3 normal = normal_of(p), on_b = b(p.m_localPointB), apart = a(p.m_localPointA) - on_b;
    const btScalar distance = apart.dot(normal);
    if (distance > far || (apart - normal * distance).length2() > aside * aside) return false;
    held.on_b[std::size_t(i)] = on_b;
    held.normal[std::size_t(i)] = normal;
    held.distance[std::size_t(i)] = distance;
    held.deepest = std::min(held.deepest, distance);
  }
  return true;
}

/// Of points with the normal of this step: false also if there is no area, or the deepest is not as deep as `least`, to
/// `slack`. The points are places on the bodies: these may have got other margins or, as parts of compounds, other places.
bool find_area(const btManifoldResult& result, const btVector3& normal, double least, btScalar slack, Held& held) {
  const btPersistentManifold& points = *result.getPersistentManifold();
  return points.getNumContacts() >= 3 &&
         find(
             result, [&](const btManifoldPoint&) { return normal; }, held) &&
         std::fabs(double(held.deepest) - least) <= slack * points.getContactBreakingThreshold();
}

/// Which of four places lies across from the first one, seen along `n`, and twice the area of all.
struct Across {
  int place = 0;
  btScalar area = -1;
};
Across across_from_first(const Places& p, const btVector3& n) {
  Across found;
  for (const auto& [k, i, j] : {std::array{1, 2, 3}, {2, 1, 3}, {3, 1, 2}}) {
    const btScalar of_diagonals = btFabs((p[0] - p[std::size_t(k)]).cross(p[std::size_t(i)] - p[std::size_t(j)]).dot(n));
    if (of_diagonals > found.area) found = {k, of_diagonals};
  }
  return found;
}

/// Twice the area of three or four places, in any order, seen along `n`.
btScalar area(const Places& p, int count, const btVector3& n) {
  return count == 3 ? btFabs((p[1] - p[0]).cross(p[2] - p[0]).dot(n)) : across_from_first(p, n).area;
}

/// Hands each point to Bullet again, which gives it the frictions of this step, calls back and keeps its impulses; but as a
/// place on both bodies it stays. The places of all others are far away meanwhile, since points that have slid may be nearer to
/// another's place than to their own.
void keep(const Held& held, btManifoldResult& result) {
  btPersistentManifold& points = *result.getPersistentManifold();
  const btTransform& a = points.getBody0()->getWorldTransform();
  const bool swapped = result.getBody0Internal() != points.getBody0();  // as of a compound's child: Bullet turns the ids again
  const int count = points.getNumContacts();
  Places local_a, local_b;
  for (int i = 0; i < count; ++i) {
    local_a[std::size_t(i)] = std::exchange(points.getContactPoint(i).m_localPointA, far_away());
    local_b[std::size_t(i)] = points.getContactPoint(i).m_localPointB;
  }
  for (int i = 0; i < count; ++i) {
    const btVector3 &normal = held.normal[std::size_t(i)], &on_b = held.on_b[std::size_t(i)];
    const btScalar distance = held.distance[std::size_t(i)];
    btManifoldPoint& p = points.getContactPoint(i);
    p.m_localPointA = a.invXform(on_b + normal * distance);
    result.setShapeIdentifiersA(swapped ? p.m_partId1 : p.m_partId0, swapped ? p.m_index1 : p.m_index0);
    result.setShapeIdentifiersB(swapped ? p.m_partId0 : p.m_partId1, swapped ? p.m_index0 : p.m_index1);
    result.addContactPoint(normal, on_b, distance);
    p.m_localPointA = far_away();
  }
  for (int i = 0; i < count; ++i) {
    points.getContactPoint(i).m_localPointA = local_a[std::size_t(i)];
    points.getContactPoint(i).m_localPointB = local_b[std::size_t(i)];
  }
}

/// Bullet's solver goes through the points one by one, and what it leaves undone is always on the same side of those that it
/// visits in the same order: a tower leans that way more with every step. So the first becomes the last. They are visited along
/// the border of their area: of an order across it, two sides come last more often than the others.
void take_turns(const Held& held, btPersistentManifold& points) {
  const int count = points.getNumContacts();
  if (count == 4)
    std::swap(points.getContactPoint(2), points.getContactPoint(across_from_first(held.on_b, held.normal[0]).place));
  for (int i = 1; i < count; ++i) std::swap(points.getContactPoint(i - 1), points.getContactPoint(i));
}

bool have_one_normal(const btPersistentManifold& points) {
  for (int i = 1; i < points.getNumContacts(); ++i) {
    const btVector3 &p = points.getContactPoint(0).m_normalWorldOnB, &q = points.getContactPoint(i).m_normalWorldOnB;
    if ((p - q).length2() >= kOneNormal * kOneNormal) return false;
  }
  return true;
}

}  // namespace

bool hold_on(const Manifold& now, btManifoldResult& result) {
  const btVector3 normal = vector_of(-now.normal);
  Held held;
  if (!find_area(result, normal, now.points[0].separation, kHeldDepth + 2 * kAtRest, held)) return false;
  keep(held, result);
  take_turns(held, *result.getPersistentManifold());
  return true;
}

bool hold_the_area(const Manifold& now, btManifoldResult& result) {
  btPersistentManifold& points = *result.getPersistentManifold();
  const btVector3 normal = vector_of(-now.normal);
  Held held;
  if (now.count < 3 || !find_area(result, normal, now.points[0].separation, kHeldDepth, held)) return false;
  Places corners;
  for (std::uint32_t i = 0; i < now.count; ++i) corners[i] = vector_of(now.points[i].point_b);
  if (area(held.on_b, points.getNumContacts(), normal) < kHeldArea * area(corners, int(now.count), normal)) return false;
  keep(held, result);
  take_turns(held, points);
  return true;
}

bool hold_turned(const btMatrix3x3& turn, btManifoldResult& result) {
  Held held;
  const auto turned = [&](const btManifoldPoint& p) { return (turn * p.m_normalWorldOnB).normalized(); };
  btPersistentManifold& points = *result.getPersistentManifold();
  if (!find(result, turned, held)) return false;
  keep(held, result);
  if (have_one_normal(points)) take_turns(held, points);
  return true;
}

bool carry_over(btPersistentManifold& points, const Manifold& now, bool swapped) {
  const btTransform &in_a = points.getBody0()->getWorldTransform(), &in_b = points.getBody1()->getWorldTransform();
  const btScalar near = points.getContactBreakingThreshold();
  std::array<bool, MANIFOLD_CACHE_SIZE> goes_on{};
  for (std::uint32_t k = 0; k < now.count; ++k) {
    const ManifoldPoint& p = now.points[k];
    const btVector3 on_a = vector_of(swapped ? p.point_b : p.point_a), on_b = vector_of(swapped ? p.point_a : p.point_b);
    int nearest = -1;
    btScalar least = near * near;
    for (int i = 0; i < points.getNumContacts(); ++i) {
      const btManifoldPoint& old = points.getContactPoint(i);
      const btScalar way = btMax((in_a(old.m_localPointA) - on_a).length2(), (in_b(old.m_localPointB) - on_b).length2());
      if (!goes_on[std::size_t(i)] && way < least) nearest = i, least = way;
    }
    if (nearest < 0) continue;
    goes_on[std::size_t(nearest)] = true;
    points.getContactPoint(nearest).m_localPointA = in_a.invXform(on_a);
  }
  const bool none_does = std::find(goes_on.begin(), goes_on.end(), true) == goes_on.end();
  const int kept = none_does && now.count > 0 ? 1 : 0;
  for (int i = points.getNumContacts(); i-- > kept;) {
    if (!goes_on[std::size_t(i)]) points.removeContactPoint(i);
  }
  const bool one_stays = kept == 1 && points.getNumContacts() == 1;
  // A place of A may touch another one of B: Bullet would take the new point for this one, with which it would go.
  if (one_stays) points.getContactPoint(0).m_localPointA = far_away();
  return one_stays;
}

}  // namespace swiftlet::bullet
