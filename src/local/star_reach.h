// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Far neighbours, where the nearest ones do not surround a point.
#pragma once

#include "core/csr_lists.h"
#include "core/geometry.h"
#include "local/planar_star.h"
#include "points/kd_tree.h"
#include "points/neighbors.h"

namespace pcl::floater {
/// Weight of a star's reach, used as spacing where larger than the spacing. It is about the
/// circumradius of a triangle between two rows of points; on even samplings it stays below the
/// spacing.
constexpr float REACH_AS_SPACING = 0.5F;

/// Thresholds that separate sheets. Chosen on the clouds of the first benchmark: wide enough for
/// sharp edges of 90 degrees; unreliable for thin sheets.
struct SheetLimits
{
  double plane_sine = 0.75;   ///< of the angle, 49 degrees, between a tangent plane and a neighbour
  double normal_cosine = 0.3; ///< of the angle, 72 degrees, between normals
};

/// True if a neighbour at `offset` lies within the limits of both tangent planes, and the unsigned
/// normals agree.
inline bool
onSameSheet (const Vector3d& normal, const Vector3d& other_normal, const Vector3d& offset,
             const SheetLimits& limits = {})
{
  const double limit = limits.plane_sine * offset.norm ();
  return std::abs (normal.dot (offset)) <= limit && std::abs (other_normal.dot (offset)) <= limit &&
         std::abs (normal.dot (other_normal)) >= limits.normal_cosine;
}

/// Aspect of points (see Plane::aspect) below which they lie on a line: points on one with noise of one
/// step are below, a third of an evenly sampled disc is above.
constexpr double LINE_ASPECT = 0.05;

/// The line through a point and its neighbours, if they lie on one.
std::optional<Line>
lineThrough (const Positions& positions, Index p, Row row, double least_aspect = LINE_ASPECT);

/// Whether a point, at an offset from one on a line, lies beside the line.
bool
liesBeside (const Line& line, const Vector3d& offset);

/// Input of the stars.
struct LocalPlanes
{
  CsrLists neighbors;         ///< nearest first, then the far neighbours beside lines
  std::vector<float> spacing; ///< of the working positions: see localSpacing
  Normals normals;            ///< of the tangent planes: unit length, of arbitrary sign
  std::optional<KdTree> tree; ///< of the working positions, if stars reach beyond the neighbours
  /// Of points on lines, as in scan lines, then also: their nearest on either side of the line, and
  /// the smaller distance to the nearest points on opposite sides; none, and 0, for all others.
  CsrLists beside;
  std::vector<float> beside_reach;
};

/// Finds the neighbours beside the line of a point, if it is on one, by two searches.
struct BesideSearch
{
  const Positions& positions;
  const LocalPlanes& planes;                          ///< with neighbours, spacing and tree
  std::array<std::vector<Neighbor>, 2> found_on = {}; ///< the sides of the last point on a line
  std::vector<Index> row = {}; ///< neighbours of the last point, then those beside its line

  /// \return see LocalPlanes::beside_reach
  float extend (Index p);
};

/// Appends lists to others, row by row, in place. O(entries).
void
appendRows (const CsrLists& added, CsrLists& lists);

/// Completes stars where the nearest neighbours are too few. A star of the nearest neighbours
/// equals the star of all points (on the same sheet) if all of its circumcircles lie in the ball
/// that was searched. Otherwise the points in the circles are searched, and in the gap of an open
/// star.
struct StarReach
{
  const Positions& positions;
  const LocalPlanes& planes;
  std::vector<Index> added = {}; ///< neighbours, by the last call to extend ()
  PlanarStar planar_star = {};   ///< scratch, like the next
  std::vector<Neighbor> found = {};

  /// \param frame      of the plane of the star
  /// \param candidates those in the triangulation; far neighbours are appended
  /// \param star       in: of the candidates; out: with far neighbours
  /// \return whether the star is open
  bool extend (Index p, const TangentFrame& frame, bool open,
               std::vector<PlanarNeighbor>& candidates, std::vector<PlanarNeighbor>& star);
};

} // namespace pcl::floater
