// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Collapsed regions are laid out again, each on a circle of its own.
#pragma once

#include "floater/floater_method.h"

#include <vector>

namespace pcl::floater {
/// On a tube of length L and radius R parameters shrink like exp (-L / R). From an L / R of about
/// 35 on, points coincide in the plane. Here the loop of every collapsed region is laid on a circle
/// of its own, the region is parameterized and triangulated alone, and its triangles are replaced.
/// Regions that collapse within these follow recursively. One level covers an L / R of about 14. A
/// region that cannot be parameterized stays. This goes beyond TW 385.
///
/// The mesh stays a disc with the same boundary. One pass over it if nothing has collapsed;
/// otherwise each level costs as much as a reconstruction of its points.
/// \param mesh          triangulation of the parameters (see triangulatePlane ())
/// \param uv            per point
/// \param positions     per point
/// \param nearest       nearest neighbours of each point
/// \param normals       per point, unit length, of any sign
/// \param loop          boundary points of the mesh in order
/// \param star_settings of the stars of the points in a region
/// \param settings      of the regions' parameterizations, always on the circle
/// \return levels of the recursion; 0: no region was laid out again
std::size_t
layOutCollapsedRegions (TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                        const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest,
                        const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& loop,
                        const StarSettings& star_settings, const ParameterizationSettings& settings,
                        const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater
