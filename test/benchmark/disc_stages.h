// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud taken through the stages of a disc up to the linear system, with all results kept.
#pragma once

#include "cloud.h"
#include "floater/boundary/boundary.h"
#include "floater/solvers/linear_system.h"
#include "local/local_geometry.h"
#include "points/points.h"

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// What the stages make of a cloud.
struct DiscStages
{
  std::string name; ///< of the file, without its extension
  Points points;
  LocalGeometry geometry; ///< of its stars the normals only
  Boundary boundary;
  std::vector<Eigen::Vector2d> loop_uv; ///< parallel to boundary.loop
  LinearSystem system;                  ///< unknowns along the space-filling curve
  std::size_t left_out = 0;             ///< points without a way to the loop, not in the system
  Statistics statistics;                ///< seconds of the stages up to WEIGHTS
};

/// Runs the stages, without removal of outliers and noise.
/// \param options neighbours, boundary method and domain; neighbours are the k nearest
/// \throw std::runtime_error with the cause if no boundary loop is found
DiscStages
runStages (const std::string& name, const Cloud& cloud, const Options& options);

/// Parameters of all points; NaN for points that the system leaves out.
/// \param solution per unknown
std::vector<Eigen::Vector2d>
parametersOf (const DiscStages& disc, const std::vector<Eigen::Vector2d>& solution);

/// The unknowns in the order of the cloud's file, the one that comes i-th, for every i.
std::vector<int>
fileOrder (const DiscStages& disc);

} // namespace floater
} // namespace pcl
