// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay star of the origin among points in the plane.
#pragma once

#include "core/types.h"

namespace pcl::floater {
/// A neighbour in the tangent plane, relative to the centre of the star.
struct PlanarNeighbor
{
  Vector2d offset;
  Index point;
  double angle = 0.0; ///< set by PlanarStar: monotonic in the angle of the offset, from 0 to 4
};

/// Turns neighbours into the Delaunay star of the origin, anti-clockwise. O(k log k).
///
/// The neighbours of the origin in the Delaunay triangulation are the vertices of the convex hull
/// of the inverted points q / |q|^2 and the origin: inversion turns an empty circle through the
/// origin into a line with all points on the origin's side. A neighbour behind another in the same
/// direction, or on the segment between two hull vertices (four points on a circle), is dropped.
class PlanarStar
{
public:
  /// \param neighbors in: any order, none on the origin; out: the star, in order
  /// \return true if the star is open: half a turn or more from the last neighbour to the first, or
  ///     fewer than three neighbours
  bool make (std::vector<PlanarNeighbor>& neighbors);

  /// Sorts all neighbours anti-clockwise; an open star begins after its gap. O(k log k).
  /// \return true if the star is open, as for make ()
  bool order (std::vector<PlanarNeighbor>& neighbors);

  /// Widest sector, in radians, without neighbours, in the last call of make () or order ().
  double openingAngle () const;

private:
  // Sorts neighbours by their angles, and sets hull_ to the nearest in each direction, anti-clockwise,
  // from the gap on, or from the nearest of all if there is none. Returns true if the star is open.
  bool takeNearest (std::vector<PlanarNeighbor>& neighbors);

  std::vector<PlanarNeighbor> hull_;
  std::vector<Vector2d> inverted_;
  bool is_open_ = true;
};

} // namespace pcl::floater
