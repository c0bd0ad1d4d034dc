// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of one part of a cloud.
#pragma once

#include "consensus/consensus_mesh.h"
#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/point_block.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace pcl::floater {
/// Size of the parts, and of the rims that they share.
struct PartLimits
{
  /// Maximum points of a part. A smaller cloud is one part, and is meshed as a whole. In a surface
  /// in parts of m points, about 4.7 sqrt (m) points of each are beside another part: 0.7 % here.
  /// Processing a part takes some 200 MB.
  std::size_t points = std::size_t{1} << 19U;

  /// Width, in rings of points, of the rim that a part passes to the stitching; doubled if it does
  /// not suffice. Widening a hole and judging it takes 7.
  std::size_t rim = 7;

  /// Width, in rings of triangles, of the zone that is finished again around the seam. Stitching
  /// rarely moves boundaries by more than 2.
  std::size_t rings = 6;
};

/// The parts of a cloud: consecutive points on the space-filling curve. They depend only on the
/// number of points.
class Parts
{
public:
  Parts (std::size_t points, const PartLimits& limits)
      : points_ (points),
        count_ (std::max<std::size_t> (1, (points + limits.points - 1) / limits.points))
  {
  }

  std::size_t points () const { return points_; }
  std::size_t count () const { return count_; }

  /// First point of a part, and one past its last.
  Index first (std::size_t part) const { return BlockCutter::firstOf (part, count_, points_); }
  Index last (std::size_t part) const { return first (part + 1); }

  /// The part of a point.
  std::size_t partOf (Index point) const
  {
    std::size_t low = 0, high = count_;
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (first (middle) <= point ? low : high) = middle;
    }
    return low;
  }

private:
  std::size_t points_, count_;
};

/// The points of a part, numbered from its first point.
struct PartPoints
{
  Index first = 0; ///< point of the cloud that is point 0 here
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< from the stars, of any sign
  std::vector<float> spacing;
  std::vector<Eigen::Vector3f> facing_normals = {}; ///< input normals that decide the front, if
                                                    ///< requested; otherwise empty

  std::size_t size () const { return positions.size (); }
  bool has (Index point) const { return point >= first && point - first < size (); }
};

/// Candidates whose first corner is in a part.
struct PartCandidates
{
  CandidateLists inside; ///< for the mesh of the part; corners are numbered from its first point
  std::vector<Candidate> left; ///< for the stitching: those with corners in several parts, and
                               ///< doubtful ones beside these; corners are points
};

/// Divides candidates. Doubtful ones are left for the stitching if a corner has a neighbour of
/// another part in its star: otherwise they could displace sure ones.
/// \param reaches_out of each point of the part: see reachesOut
PartCandidates
divideCandidates (CandidateLists of_part, Index first, Index last,
                  const std::vector<std::uint8_t>& reaches_out);

/// Of each point of some stars: 1 if its star has a neighbour in another part. O(entries).
/// \param stars of the points from `first` on, with points as neighbours
std::vector<std::uint8_t>
reachesOut (const CsrLists& stars, Index first, const Parts& parts);

/// The consensus mesh of a part.
struct PartMesh
{
  std::vector<Triangle> triangles;       ///< corners are numbered from the first point of the part
  std::vector<Index> component;          ///< of each triangle
  Index components = 0;                  ///< number of them
  std::vector<Eigen::Vector3f> smoothed; ///< smoothed normals, oriented like the triangles
  std::vector<Index> with_room;          ///< free points: without a triangle, or at the boundary;
                                         ///< ascending; numbered like the corners
  std::vector<Candidate> open; ///< candidates for the stitching, and free candidates inside;
                               ///< corners are points of the cloud
};

/// The neighbours of some points of the part (ascending), nearest first: row i belongs to
/// points[i]. All are points of the cloud.
using NeighborRows = std::function<CsrLists (const std::vector<Index>& points)>;

/// The consensus of the candidates inside, and its manifold part (see makeConsensusMesh). O(n).
/// \param smoothed smoothed normals of the points
PartMesh
makePartMesh (const PartPoints& points, std::vector<Eigen::Vector3f> smoothed,
              PartCandidates candidates, const NeighborRows& neighbors,
              const ConsensusLimits& limits, const RunContext& run);

/// The triangles of a part around its boundary, the data of their corners, and the free candidates.
/// Points are those of the cloud.
struct PartRim
{
  std::vector<Index> points; ///< of the part, ascending: corners, points without a triangle, and
                             ///< neighbours of both
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;  ///< from the stars, of any sign
  std::vector<Eigen::Vector3f> smoothed; ///< oriented like the triangles
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial; ///< some triangles of the point in the part are missing
                                        ///< here
  std::vector<std::uint8_t> has_room;   ///< free: it has no triangle, or is at the boundary
  CsrLists neighbors;                   ///< of free points and those beside them, nearest first;
                                        ///< otherwise empty

  std::vector<Triangle> triangles; ///< corners are indices of `points`
  std::vector<Index> numbers;      ///< of each triangle: its number in the part, ascending
  std::vector<Index> component;    ///< of each triangle
  Index components = 0;            ///< of the part

  std::vector<Candidate> open; ///< corners may be in other parts, and not free there

  std::vector<Index> others; ///< points of other parts that are neighbours, ascending
  std::vector<Eigen::Vector3d> other_positions;
  std::vector<Eigen::Vector3f> other_normals;
};

/// Appends positions and normals of points (ascending) to the arrays.
using OtherPoints =
    std::function<void (const std::vector<Index>& points, std::vector<Eigen::Vector3d>& positions,
                        std::vector<Eigen::Vector3f>& normals)>;

/// The rim of a part: all triangles with a corner fewer than `rings` edges away from a free point,
/// and all components of fewer than `smallest` triangles. O(rings n).
PartRim
findRim (const PartPoints& points, const PartMesh& mesh, const NeighborRows& neighbors,
         const OtherPoints& others, std::size_t rings, std::size_t smallest);

} // namespace pcl::floater
