// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contacts of meshes: turns the question into one about the surfaces, and the regions that the search finds into contacts.
#include <swiftlet/mesh_contacts.h>

#include <algorithm>
#include <cmath>

#include "region_search.h"

namespace swiftlet {
namespace {

/// Moves the nearest regions into `into`, nearest first.
void choose_nearest(Regions& regions, std::span<MeshContact> into) {
  const std::size_t stored = std::min(regions.size(), into.size());
  const auto first = into.begin(), end = first + std::ptrdiff_t(stored);
  std::sort(first, end, Regions::is_nearer);
  if (stored == 0) return;
  for (std::size_t i = stored; i < regions.size(); ++i) {
    if (!Regions::is_nearer(regions[i], *(end - 1))) continue;
    *(end - 1) = regions[i];
    std::rotate(std::upper_bound(first, end - 1, regions[i], Regions::is_nearer), end - 1, end);
  }
}

/// Turns a region of the surfaces into one of the bodies.
void describe(const MeshSetting& at, MeshContact& region) {
  MeshFinding found;
  found.lower = region.lower, found.upper = region.upper, found.verdict = region.verdict;
  found.point_a = vec(region.point_a), found.point_b = vec(region.point_b), found.normal = vec(region.normal);
  Answer answer;
  describe(at, found, answer);
  region.lower = answer.lower, region.upper = answer.upper, region.verdict = answer.verdict;
  region.point_a = answer.point_a, region.point_b = answer.point_b;
  if (region.normal.isZero(0)) region.normal.setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

MeshContacts contacts(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double reach, std::span<MeshContact> into,
                      const Budget& budget) {
  MeshContacts result;
  const MeshSetting at(a, b, b_in_a);
  if (result.status = at.fault(); result.status != Status::Converged) return result;
  if (at.a.triangle_count == 0 || at.b.triangle_count == 0) {
    result.status = Status::LevelLimit;
    return result;
  }
  if (std::isnan(reach)) {
    result.status = Status::NotConverged;
    return result;
  }
  result.is_counted = true;
  if (reach < 0) return result;

  RegionQuestion question{reach, budget.steps};
  if (!at.radii.none()) question.reach = next_above(reach + at.radii.sum());
  Regions regions(into);
  RegionFinding finding;
  RegionSearch(at, b_in_a, question, regions, finding).run();
  result.steps = finding.nodes, result.plane_tests = finding.triangles;
  if (finding.refused) {
    result.status = Status::InvalidBody;
    result.is_counted = false;
    return result;
  }
  result.count = std::uint32_t(regions.size());
  result.stored = std::uint32_t(std::min(regions.size(), into.size()));
  const bool all_seen = !finding.cut_short && !regions.overflowed(), whole = at.a.is_whole() && at.b.is_whole();
  result.is_counted = all_seen && whole;
  if (!all_seen || result.stored < result.count)
    result.status = Status::Budget;
  else if (!whole)
    result.status = Status::LevelLimit;
  choose_nearest(regions, into);
  for (MeshContact& region : into.first(result.stored)) describe(at, region);
  return result;
}

}  // namespace swiftlet
