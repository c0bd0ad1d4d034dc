// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud with the mesh that it was taken from, and the verdict on a reconstruction of it.
#pragma once

#include "mesh/check.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// A mesh whose vertices are the points of a cloud, in the same order.
struct Truth
{
  std::string name;
  Points points; ///< row and cloud index of each vertex are the same; in units of the cloud
  std::vector<Triangle> triangles;
  MeshExamination found;                     ///< of the true mesh
  std::vector<std::vector<bool>> near_loops; ///< of each loop: the vertices within two edges of it
  std::vector<Eigen::Vector3d> normals;      ///< of each vertex, not of unit length
  double area = 0.0;
};

/// Reads a PLY file. \throws std::runtime_error if it has no triangles
Truth
readTruth (const std::filesystem::path& file);

/// What is wrong with a reconstruction, in a few words; empty if it is clean: at least 99.9 % of
/// the points used, manifold, the boundary loops of the truth and no others, its number of
/// components and Euler characteristic, no more folds, no component inside out, and its area within
/// 1 %. A loop is that of the truth if at least half of its points lie within two edges of it.
std::string
flawsOf (const std::vector<Triangle>& triangles, const Truth& truth);

/// What keeps the reconstruction of a scan from being usable, whose truth is the raster of its
/// sensor; empty if nothing does: at least 99 % of the points used, manifold, at most twice the
/// components and 10 more, at most 1.5 times the boundary edges, no more folds or at most one for
/// 2000 triangles, and the area within 5 %.
std::string
flawsOfScan (const std::vector<Triangle>& triangles, const Truth& truth);

} // namespace floater
} // namespace pcl
