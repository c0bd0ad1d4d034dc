// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random points in a square of parameters.
#pragma once

#include "random_fields.h"

#include <string>

namespace pcl
{
namespace floater
{
/// How points are spread. Mean spacings are about 1 but for those that vary.
enum class Sampling
{
  GRID,      ///< jittered, square
  HEXAGONAL, ///< jittered
  DARTS,     ///< Poisson disk, more or less complete
  RANDOM,    ///< Poisson process
  GRADED,    ///< Poisson disk, finer at one side
  THINNED,   ///< a grid of which random points are missing
  LINES,     ///< rows of points, several times as far apart as the points in a row
  QUANTIZED, ///< Poisson process, one coordinate rounded
  SPACE,     ///< Poisson disk by distances in space, also on slopes
  CLOUDS,    ///< Poisson disk whose radius varies from place to place
  SPOTS,     ///< Poisson disk whose radius is several times as large in some places
  QUADRIC,   ///< vertices of a decimated mesh, vtkQuadricDecimation
  REMOVAL,   ///< the same, vtkDecimatePro: its vertices are points of the mesh
  COUNT
};

std::string
nameOf (Sampling sampling);

/// Places in a square around the origin. \param side of it \param map for samplings that depend on
/// the surface; those of decimated meshes and of distances in space are for height fields only
std::vector<Place>
samplePlaces (Sampling sampling, double side, const Map& map, RandomStream& random);

} // namespace floater
} // namespace pcl
