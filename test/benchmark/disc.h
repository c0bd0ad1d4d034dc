// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud taken through the stages up to the linear system, with all that lies on the way kept.
#pragma once

#include "floater/boundary/boundary.h"
#include "cloud.h"
#include "core/types.h"
#include "floater/solvers/linear_system.h"

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Working set, neighbours, stars, loop and system of a cloud, with the options' defaults.
struct Disc
{
  std::string name; ///< of the file, without its extension
  Points set;
  CsrLists near;
  std::vector<Eigen::Vector3f> normals;
  Boundary boundary;
  std::vector<Eigen::Vector2d> loop_uv; ///< parallel to boundary.loop
  LinearSystem system;                  ///< unknowns along the space-filling curve
  std::size_t left_out = 0;             ///< points without a way to the loop, not in the system
  Statistics statistics;                ///< seconds of the stages up to WEIGHTS
};

/// \throw std::runtime_error with the cause if a stage fails
Disc
makeDisc (const std::string& name, const Cloud& cloud, const Options& options);

/// Parameters of all points; NaN for points that the system leaves out.
/// \param solution per unknown
std::vector<Eigen::Vector2d>
parametersOf (const Disc& disc, const std::vector<Eigen::Vector2d>& solution);

/// The unknowns in the order of the cloud's file, the one that comes i-th, for every i.
std::vector<int>
fileOrder (const Disc& disc);

} // namespace floater
} // namespace pcl
