// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh as the page of --html draws it.
#pragma once

#include "cloud.h"
#include "command_line.h"

#include <pcl/surface/floater/reconstruct.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl::floater {
/// Triangles of one kind of flaw.
struct Flaw
{
  const char* name;
  std::vector<Index> triangles; // ascending
};

/// The mesh as it is drawn: only its vertices, around the origin, in a unit that float can square.
struct Drawing
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero (); // of the cloud, where the origin is
  double unit = 1.0;                                 // in units of the cloud; a power of two
  std::vector<Eigen::Vector3d> positions;
  Triangles triangles;
  std::vector<float> spacing; // of each vertex; empty if there is no mesh
  std::vector<float> height;  // of each vertex above those around, in spacings
  std::vector<Flaw> flaws;
  double median_spacing = 0.0;
  bool has_all_flaws = true;
};

/// The box around positions; empty if there are none.
Eigen::AlignedBox3d
boxAround (const std::vector<Eigen::Vector3d>& positions);

/// The mesh of a run, thinned if it has more triangles than the page shows; without triangles after
/// a failure. Spacing, heights and flaws are those of the whole mesh. O(n log n).
Drawing
makeDrawing (const CommandLine& line, const Cloud& cloud, const Result& result);

} // namespace pcl::floater
