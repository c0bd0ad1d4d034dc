// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/tangent_planes.h"

#include "core/parallel.h"
#include "core/plane_fit.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
constexpr std::size_t ADDED = 2; // neighbours added at a time, while all are collinear

Eigen::Vector3d
fitNormal (const std::vector<Eigen::Vector3d>& positions, Index p, Row neighbors,
           const PlaneLimits& limits)
{
  PlaneFit core;
  core.add (Eigen::Vector3d::Zero ()); // the point itself
  std::size_t used = 0;
  const auto addUpTo = [&] (std::size_t count) {
    for (; used < std::min (count, neighbors.size ()); ++used)
      core.add (positions[neighbors[used]] - positions[p]);
    return core.plane ();
  };
  Plane plane = addUpTo (limits.core_points);
  while (plane.aspect < limits.least_aspect && used < neighbors.size ())
    plane = addUpTo (used + ADDED);
  const Eigen::Vector3d first = plane.normal;
  PlaneFit sheet;
  sheet.add (Eigen::Vector3d::Zero ());
  for (Index q : neighbors) {
    const Eigen::Vector3d offset = positions[q] - positions[p];
    if (std::abs (first.dot (offset)) <= limits.sheet_sine * offset.norm ())
      sheet.add (offset);
  }
  const bool has_sheet = 2.0 * sheet.weight () > static_cast<double> (limits.core_points);
  return has_sheet ? sheet.plane ().normal : first;
}

} // namespace

std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const Rows& rows, const RunContext& run, const PlaneLimits& limits)
{
  std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::Zero ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      normals[rows[i]] =
          fitNormal (positions, rows[i], neighbors.row (rows[i]), limits).cast<float> ();
  });
  return normals;
}

} // namespace pcl::floater
