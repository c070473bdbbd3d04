// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Boxes along the axes of a frame.
#pragma once

#include "body/shape.h"
#include "numeric/vec.h"

namespace swiftlet {

static inline bool meet(const Box& p, const Box& q) {
  return p.least.x <= q.most.x && q.least.x <= p.most.x && p.least.y <= q.most.y && q.least.y <= p.most.y &&
         p.least.z <= q.most.z && q.least.z <= p.most.z;
}
static inline bool holds(const Box& box, const Box& in) {
  return box.least.x <= in.least.x && in.most.x <= box.most.x && box.least.y <= in.least.y && in.most.y <= box.most.y &&
         box.least.z <= in.least.z && in.most.z <= box.most.z;
}
static inline Vec least_of(const Vec& p, const Vec& q) { return {min(p.x, q.x), min(p.y, q.y), min(p.z, q.z)}; }
static inline Vec most_of(const Vec& p, const Vec& q) { return {max(p.x, q.x), max(p.y, q.y), max(p.z, q.z)}; }
/// What two boxes that meet have in common, and the box around both.
static inline Box common(const Box& p, const Box& q) { return {most_of(p.least, q.least), least_of(p.most, q.most)}; }
static inline Box around(const Box& p, const Box& q) { return {least_of(p.least, q.least), most_of(p.most, q.most)}; }
static inline Box grown(const Box& box, double by) {
  const Vec all{by, by, by};
  return {box.least - all, box.most + all};
}
static inline double sides(const Box& box) {
  const Vec way = box.most - box.least;
  return way.x + way.y + way.z;
}

}  // namespace swiftlet
