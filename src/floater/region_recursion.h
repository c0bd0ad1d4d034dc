// SPDX-License-Identifier: GPL-3.0-or-later
// Depth beyond double precision: collapsed regions are laid out again, each on a circle of its own.
#pragma once

#include "floater/collapsed_regions.h"
#include "floater/parameterize.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// On a tube of length L and radius R parameters shrink like exp (-L / R), and from L / R of about
/// 35 on points coincide in the plane. Here the rim of every collapsed region is laid on a fresh
/// circle, its points are solved for and triangulated alone, and its triangles are replaced; then
/// the regions that have collapsed in these, until there is none. One level is good for an L / R of
/// 14. What cannot be solved for stays as it was.
///
/// The mesh stays a disc with the same boundary. One pass over it where nothing has collapsed; else
/// each level costs as much as a reconstruction of the points that are in it.
/// \param mesh    triangulation of the parameters (see triangulatePlane)
/// \param uv      per point
/// \param normals per point, of arbitrary sign
/// \param loop    points of the boundary in order
/// \return levels of the recursion; 0: no region was laid out again
std::size_t
layOutCollapsedRegions (TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                        const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest,
                        const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& loop,
                        const StarSettings& star_settings, const ParameterizationSettings& settings,
                        const RunContext& run);

} // namespace floater
} // namespace pcl
