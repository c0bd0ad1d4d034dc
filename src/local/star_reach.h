// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours beyond the nearest ones, where these do not surround a point.
#pragma once

#include "core/csr_lists.h"
#include "core/tangent_frame.h"
#include "local/planar_star.h"
#include "local/sheet.h"
#include "points/kd_tree.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// How far stars reach beyond the nearest neighbours.
struct ReachLimits
{
  double farthest = 40.0;    ///< spacings. From the task: rows of points up to 30 times as far
                             ///< apart as the points in a row, and a third more for uneven rows
  double most_cosine = 0.26; ///< of the angle, 75 degrees, between the middle of a gap and the
                             ///< points that are looked for in it. Beside a row of points lie
                             ///< those of the same row, by noise
  double line_sine = 0.5;    ///< of the angle, 30 degrees, between a line of points and those
                             ///< that are looked for beside it
  double thicknesses = 4.0;  ///< standard deviations across a line; points nearer to it are its own
  double gap_ratio = 1.8;    ///< a longer edge, in reaches of the end that has the larger one, is
                             ///< a step across a hole. Measured on Delaunay triangulations: 999 of
                             ///< 1000 edges are below 1.7 on jittered grids, Poisson disks, scan
                             ///< lines and steps of density of 5 to 30; below 2.3 on uniformly
                             ///< random points
  /// Of points in circumcircles: normals turn by up to 37 degrees, and on an arc the offset leaves
  /// the plane by half of that, less noise. With the limits of near neighbours, two of 24 clean
  /// clouds took in another sheet; these values mended both, and are not certain.
  SheetLimits circle_sheet{0.25, 0.8};
  std::size_t added = 8; ///< points at a time: about the first ring of an even sampling
  int rounds = 8;        ///< in which points are added to one star. A limit of time
};

/// Of the reach of a star; counts as spacing where that is larger. It is about the circumradius of
/// a triangle between two rows of points; on even samplings it stays below the spacing.
constexpr float REACH_AS_SPACING = 0.5F;

/// What lies beside the points whose nearest neighbours lie all on a line, as in scan lines.
struct BesideLines
{
  CsrLists neighbors;       ///< nearest on either side of the line; none for all other points
  std::vector<float> reach; ///< of each point on a line: the smaller one of the distances to the
                            ///< nearest points on opposite sides; 0 for all others
};

/// Whether the neighbours of any of these points lie all on a line. If not, nothing is beside
/// lines.
bool
isAnyOnLine (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const Rows& rows, double least_aspect, const RunContext& run);

/// Looks for points beside lines. O(n k) and two searches for each point on a line.
/// \param spacing of the points in `rows` (see localSpacing)
/// \param rows    points beside whose lines is looked; neighbours of others are not read
BesideLines
findBesideLines (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                 const std::vector<float>& spacing, const KdTree& tree, const Rows& rows,
                 double least_aspect, const ReachLimits& limits, const RunContext& run);

/// Adds lists to others, row by row. In place: O(entries).
void
appendRows (const CsrLists& added, CsrLists& lists);

/// How far a star reaches in its plane to opposite sides: the largest, over its neighbours, of the
/// smaller one of two lengths: that to the neighbour, and that from the centre backwards to the
/// rim. On an even sampling that is the length of an edge, between scan lines their distance, and
/// beside a hole the length of an edge on the side of the surface. O(m^2) for m neighbours.
/// \param open see PlanarStar::make
/// \return 0 if no neighbour has a part of the star on its opposite side
double
reachOf (const std::vector<PlanarNeighbor>& star, bool open);

/// Makes stars right where the nearest neighbours are too few for it. A star of the nearest
/// neighbours is that of all points (on the same sheet) if no circumcircle of it leaves the ball
/// that was searched. Else the points in that circle are looked for; and if the star is open, those
/// in its gap.
class StarReach
{
public:
  /// All arguments but the limits must outlive this.
  StarReach (const std::vector<Eigen::Vector3d>& positions,
             const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
             const KdTree& tree, const SheetLimits& sheets, const ReachLimits& limits);

  /// \param frame      of the plane in which the star lies
  /// \param row        neighbours of p that were looked at
  /// \param nearest    how many of these, from the first on, are the nearest of all points
  /// \param candidates those of them from which the star was made; far neighbours are added
  /// \param star       in: of the candidates; out: with far neighbours
  /// \return whether the star is open
  bool extend (Index p, const TangentFrame& frame, Row row, std::size_t nearest, bool open,
               std::vector<PlanarNeighbor>& candidates, std::vector<PlanarNeighbor>& star);

  /// Neighbours added by the last call to extend ().
  const std::vector<Index>& added () const { return added_; }

private:
  struct Centre
  {
    Index point;
    const TangentFrame& frame;
    Row row;
    double sqr_searched; // squared distance up to which all points are in the row
    double farthest;
  };

  bool isNew (const Centre& centre, const Neighbor& neighbor, double sqr_distance,
              const SheetLimits& sheets) const;
  void lookAhead (const Centre& centre, const std::vector<PlanarNeighbor>& star);
  void lookIntoCircle (const Centre& centre, const PlanarNeighbor& a, const PlanarNeighbor& b);

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  const std::vector<float>& spacing_;
  const KdTree& tree_;
  SheetLimits sheets_;
  ReachLimits limits_;
  PlanarStar planar_star_;
  std::vector<Index> added_;
  std::vector<std::pair<Index, Index>> empty_circles_; // of two neighbours and the centre
  std::vector<Neighbor> found_;
};

} // namespace pcl::floater
