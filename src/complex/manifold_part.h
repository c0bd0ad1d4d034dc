// SPDX-License-Identifier: GPL-3.0-or-later
// From a complex to a manifold.
#pragma once

#include "complex/surface_complex.h"
#include "triangulation/surface_mesh.h"

namespace pcl
{
namespace floater
{
/// Keeps the largest fan of triangles around every point, and drops islands: pieces of fewer than
/// ISLAND triangles that are open and have points of a larger piece among their nearest
/// neighbours; these lie in its holes. What is left is an oriented manifold whose rims are simple
/// loops. O(n). \throw std::logic_error if it is not
SurfaceMesh
manifoldPart (SurfaceComplex complex, const FlatLists& near, int threads);

/// Smallest piece that may stand alone.
constexpr std::size_t ISLAND = 32;

} // namespace floater
} // namespace pcl
