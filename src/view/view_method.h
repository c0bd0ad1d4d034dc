// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The view method: clouds of one scan, connected as the sensor saw them.
#pragma once

#include "consensus/consensus_method.h"
#include "points/points.h"
#include "view/ray_evidence.h"
#include "view/view_flips.h"
#include "view/viewpoint_search.h"

namespace pcl::floater {
/// Limits of the view method.
struct ViewLimits
{
  std::size_t shortest_step = 9; ///< triangles of an isolated depth step; shorter ones are noise.
                                 ///< One edge beyond it marks 2, all edges of a point 6 or 8
  double longest_edge = 16.0; ///< local spacings. Of 25 longer edges in 27 scans, 3 of them real,
                              ///< 22 bridged what is no surface; of edges of 10 to 16 half did
};

/// Whether a cloud was seen from a place.
enum class Sight
{
  NO,
  POSSIBLE, ///< it is told, or outlines are clear, and hardly any point hides others
  CERTAIN   ///< see RayEvidence and explainsDensity
};

/// O(n log n), 0.1 microseconds per point if it was.
/// \param is_told the place is that of a sensor
Sight
sightFrom (const Points& points, const Viewpoint& viewpoint, bool is_told, const RunContext& run);

/// The surface of one scan.
struct ViewSurface
{
  TriangleMesh mesh;
  std::vector<float> spacing; ///< see spacingOfMesh
  MeshFinish finish;
  std::size_t holes_filled = 0;
  std::size_t steps = 0; ///< triangles left out at depth steps
  std::size_t gaps = 0;  ///< triangles left out in gaps
  Flags is_at_step;      ///< of each point: 1 if a triangle around was left out at a depth step
};

/// Triangulates the rays, leaves out triangles in gaps or across depth steps, and chooses
/// diagonals. From the sensor, no part of the mesh hides another. The mesh faces the sensor, but
/// outwards if it is closed, or if the sensor is far away on an unknown side; hints may ask for
/// another facing. Stages DELAUNAY, HOLES and FLIPS. O(n log n).
/// \param hints their sensor is used only if the viewpoint is far away
ViewSurface
makeViewSurface (const Points& points, const Viewpoint& viewpoint, const Options& options,
                 const ViewLimits& limits, FacingHints hints, const RunContext& run);

} // namespace pcl::floater
