// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rims of all parts in one mesh.
#pragma once

#include "core/types.h"
#include "parts/part_mesh.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Numbers some points of a cloud, in the order of the cloud.
class JoinedPoints
{
public:
  JoinedPoints () = default;

  /// \param points ascending, each once
  explicit JoinedPoints (std::vector<Index> points) : points_ (std::move (points)) {}

  std::size_t size () const { return points_.size (); }

  Index pointAt (Index place) const { return points_[place]; }

  /// Index of a point, NONE if it is not included. O(log n).
  Index placeOf (Index point) const
  {
    const auto at = std::lower_bound (points_.begin (), points_.end (), point);
    return at != points_.end () && *at == point ? static_cast<Index> (at - points_.begin ()) : NONE;
  }

private:
  std::vector<Index> points_;
};

/// A triangle of a part; its corners are indices of joined points.
struct RimTriangle
{
  Triangle ascending; ///< its corners
  Triangle corners;   ///< in their order in the part
  Index part, number, component;
};

/// The rims of all parts. Points are indices of `points`.
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
  std::vector<Candidate> open;                 ///< free candidates
  std::vector<std::array<Index, 2>> same_side; ///< two points of one component of a part

  Triangle toPoints (Triangle places) const
  {
    for (Index& p : places)
      p = points.pointAt (p);
    return places;
  }

  /// The triangle of a part with these corners, in any order; nullptr if there is none.
  const RimTriangle* find (Triangle corners) const;
};

/// Joins rims one by one, so that they need not all be in memory.
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

  // All rims in sequence, by the order of the points. Triangles have indices of these points.
  std::vector<Index> points_;
  JoinedRims joined_;
  std::vector<Other> others_;
  Index parts_ = 0;
};

} // namespace pcl::floater
