// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The view method: clouds of one scan, connected as the sensor saw them.
#pragma once

#include "local/local_geometry.h"
#include "mesh/finish.h"
#include "mesh/hole_filling.h"
#include "mesh/open_loops.h"
#include "points/points.h"
#include "view/depth_steps.h"
#include "view/ray_evidence.h"
#include "view/view_flips.h"
#include "view/view_gaps.h"
#include "view/viewpoint_search.h"

#include <optional>

namespace pcl::floater {
/// The limits of all steps of the view method.
struct ViewLimits
{
  EvidenceLimits evidence;
  SearchLimits search;
  GapLimits gaps;
  StepLimits steps;
  ViewFlipLimits flips;
  std::size_t shortest_step = 9; ///< triangles of a depth step that stands alone; with fewer, it is
                                 ///< noise. One edge beyond the noise marks 2, and all edges of a
                                 ///< point 6 or 8
  std::size_t smallest_part = 12;     ///< points; smaller parts are left out with the outliers. A
                                      ///< point and the rays around it are 7 or 9
  double largest_unused_share = 0.05; ///< of the points; with more in no triangle, it is no scan of
                                      ///< surfaces from there after all
};

struct ViewSettings
{
  HoleOptions holes = {};
  bool flip_edges = true;      ///< choose diagonals by smoothness
  bool remove_outliers = true; ///< leave out small parts that no edge joins to others
  ViewLimits limits = {};
  OpenLoopLimits open_loops = {};      ///< for policies of holes other than AUTO
  HoleFillingLimits hole_filling = {}; ///< the same
  FinishLimits finish = {};            ///< the same, and for closed components
  FacingHints facing = {};             ///< its sensor counts for rays of a sensor far away only
};

/// Whether the cloud was seen from there (see RayEvidence). Ends early where it is clear that it
/// was not. O(n), 0.1 microseconds per point where it was.
bool
isSeenFrom (const Points& points, const Viewpoint& viewpoint, const EvidenceLimits& limits,
            const RunContext& run);

/// A surface as it was seen.
struct ViewSurface
{
  TriangleMesh mesh;
  MeshFinish finish;
  std::size_t holes_filled = 0;
  std::size_t steps = 0;     ///< triangles of the view across depth steps, left out
  std::size_t gaps = 0;      ///< triangles of the view in gaps, left out
  bool is_by_pixels = false; ///< triangulated by the rows and columns of an organized cloud
};

/// Triangulates the rays, leaves out what lies in gaps of the view or across depth steps, and
/// chooses diagonals. From the sensor, no part of the mesh hides another. Its front faces the
/// sensor, but a mesh that is closed faces outwards, and so does everything if the sensor is far
/// away on an unknown side; or as the hints on its facing want. Stages DELAUNAY, HOLES and FLIPS.
/// O(n log n).
ViewSurface
makeViewSurface (const Points& points, const Viewpoint& viewpoint, const ViewSettings& settings,
                 const RunContext& run);

} // namespace pcl::floater
