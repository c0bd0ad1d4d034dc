// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary loops of the consensus mesh of a holey surface, each with what it is.
#pragma once

#include "holey_surfaces.h"
#include "mesh/loop_evidence.h"
#include "points/points.h"
#include "solid_surface.h"

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
enum class LoopKind
{
  BORDER, ///< of the whole surface
  WINDOW,
  GAP
};

struct LabelledLoop
{
  LoopKind kind = LoopKind::GAP;
  BoundaryLoop loop; ///< its points are those of the working set
  LoopEvidence evidence;
  std::size_t component_points = 0;
  bool largest_component = true;
  std::string source;    ///< name of the sampling, or "bodies"
  bool even_rim = false; ///< of a window
  std::uint64_t seed = 0;
};

struct LabelledLoops
{
  std::vector<LabelledLoop> loops;
  std::size_t lost_windows = 0; ///< without a loop of their own
};

/// Boundary loops of the consensus mesh of the points, made as the surface method does, without
/// labels.
std::vector<LabelledLoop>
findLoops (const Points& points);

/// Makes the consensus mesh of the points as the surface method does, and tells its loops by the
/// places of their points. Only those of the largest component.
LabelledLoops
labelLoops (const HoleySurface& surface, std::uint64_t seed);

/// Makes the consensus mesh of the vertices of a surface, and tells its loops by those of the
/// surface: a loop is a window, or a border, if it shares at least half of its points with a
/// boundary loop of the surface, and has at least half of that loop's; it is a gap if less than a
/// fifth of its points lie on any. Others are left out.
LabelledLoops
labelLoops (const SolidSurface& surface, std::uint64_t seed);

} // namespace floater
} // namespace pcl
