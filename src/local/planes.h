// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Local spacing, tangent planes, and smoothed normals.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/neighbors.h"

namespace pcl::floater {
/// Thresholds that separate sheets. Chosen on the clouds of the first benchmark: wide enough for
/// sharp edges of 90 degrees; unreliable for thin sheets.
struct SheetLimits
{
  double plane_sine = 0.75;   ///< of the angle, 49 degrees, between a tangent plane and a neighbour
  double normal_cosine = 0.3; ///< of the angle, 72 degrees, between normals
};

/// True if a neighbour at `offset` lies within the limits of both tangent planes, and the unsigned
/// normals agree.
inline bool
onSameSheet (const Vector3d& normal, const Vector3d& other_normal, const Vector3d& offset,
             const SheetLimits& limits = {})
{
  const double limit = limits.plane_sine * offset.norm ();
  return std::abs (normal.dot (offset)) <= limit && std::abs (other_normal.dot (offset)) <= limit &&
         std::abs (normal.dot (other_normal)) >= limits.normal_cosine;
}

/// Local spacing: the mean distance of each point to its (up to) 6 nearest neighbours; on a regular
/// triangulation that is the length of an edge. O(n).
/// \param neighbors nearest first
std::vector<float>
localSpacing (const Positions& positions, const CsrLists& neighbors, const RunContext& run);

/// Aspect of points (see Plane::aspect) below which they lie on a line: points on one with noise of one
/// step are below, a third of an evenly sampled disc is above.
constexpr double LINE_ASPECT = 0.05;

/// Mean of the normals of a point and its 8 nearest neighbours, unit length, on the side of its
/// own. At a sharp edge the least-squares plane follows one of the faces; the mean lies between
/// them.
Vector3d
meanNormal (const Positions& positions, const CsrLists& neighbors, const Normals& normals, Index p);

} // namespace pcl::floater
