// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rims of all parts in one mesh.
#pragma once

#include "parts/joined_points.h"
#include "parts/part_rim.h"

#include <array>
#include <vector>

namespace pcl::floater {
/// A triangle of a part, by its corners, which are places in the joined points.
struct RimTriangle
{
  Triangle ascending; ///< its corners
  Triangle corners;   ///< as they are in the part
  Index part, number, component;
};

/// What is seen of all parts. Points are places in `points`.
struct JoinedRims
{
  JoinedPoints points;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals, smoothed; ///< see PartRim
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial, has_room;
  CsrLists neighbors;
  TriangleMesh mesh;
  std::vector<RimTriangle> origins;            ///< by their corners
  std::vector<Candidate> open;                 ///< with room at all corners
  std::vector<std::array<Index, 2>> same_side; ///< two points of one component of a part

  Triangle toPoints (Triangle places) const
  {
    for (Index& p : places)
      p = points.pointAt (p);
    return places;
  }

  /// The triangle of a part with these corners, in whatever order; nullptr if there is none.
  const RimTriangle* find (Triangle corners) const;
};

/// Joins rims one by one, so that not all of them have to be in memory.
class RimJoiner
{
public:
  /// In the order of the parts.
  void add (const PartRim& rim);

  /// O(n log n).
  JoinedRims join (const RunContext& run) &&;

private:
  // A point that is a neighbour in another part.
  struct Other
  {
    Index point;
    Eigen::Vector3d position;
    Eigen::Vector3f normal;
  };

  void addTriangles (const PartRim& rim);
  std::vector<Other> othersWithoutRim () const;

  // Of all rims, one behind the other: in the order of the points. Triangles by places in these.
  std::vector<Index> points_;
  JoinedRims joined_;
  std::vector<Other> others_;
  Index parts_ = 0;
};

} // namespace pcl::floater
