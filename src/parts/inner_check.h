// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Check of the triangles of a part that are final.
#pragma once

#include "mesh/examination.h"
#include "mesh/facing.h"
#include "mesh/self_intersection_removal.h"
#include "parts/part_mesh.h"

#include <Eigen/Geometry>

#include <utility>
#include <vector>

namespace pcl::floater {
/// Self-intersections: counts and positions.
struct CrossingSum
{
  static constexpr std::size_t PLACES = 10; ///< as in MeshCheck

  std::size_t found = 0; ///< before any were removed
  std::size_t left = 0;
  std::size_t untested = 0; ///< triangles that may cross others as well, see CrossingPairs
  Uncrossing done;
  std::vector<std::pair<Index, Index>> places; ///< of the first PLACES remaining pairs: the first
                                               ///< corners of both triangles
  Index first_at = NONE;                       ///< smallest one of all remaining pairs

  void add (const CrossingSum& next);

  /// Sets the remaining pairs.
  /// \param point_of converts a corner
  template <typename PointOf>
  void take (const CrossingPairs& pairs, const std::vector<Triangle>& triangles, PointOf&& point_of)
  {
    left = pairs.size ();
    untested = pairs.untested.size ();
    if (untested > 0)
      first_at = point_of (triangles[pairs.untested.front ()][0]);
    for (const CrossingPair& pair : pairs) {
      const Index at = point_of (triangles[pair.first][0]);
      const Index other_at = point_of (triangles[pair.second][0]);
      if (places.size () < PLACES)
        places.emplace_back (at, other_at);
      first_at = std::min ({first_at, at, other_at});
    }
  }
};

/// A component of the inner triangles of a part.
struct InnerComponent
{
  ComponentSum sum;       ///< counts as closed, since the boundary is in zones
  std::size_t points = 0; ///< outside all zones
};

/// Data of the inner triangles of a part (outside its zone) for check and facing of the whole mesh.
/// Points are those of the cloud.
struct InnerCheck
{
  /// Triangles per box. Chosen by hand: boxes take a sixteenth of the memory of the triangles.
  static constexpr std::size_t BUCKET = 64;

  std::size_t triangles = 0;
  Surroundings around; ///< of the points outside the zone; without boundary edges
  std::vector<InnerComponent> components;
  CrossingSum crossing;
  std::vector<Index> rim;           ///< triangles with a corner in the zone, ascending
  std::vector<Index> rim_component; ///< of each of these
  Eigen::AlignedBox3d box;          ///< around all
};

/// Facts about the whole cloud.
struct InnerCheckSettings
{
  CheckLimits limits;
  double diagonal = 1.0;                 ///< see Points
  std::optional<Eigen::Vector3d> sensor; ///< see FacingHints
};

/// Checks the inner triangles of a part, except for self-intersections.
/// \param triangles  in the order of their smallest points; corners are numbered from the first
///     point of the part on
/// \param is_in_zone of each point of the part
InnerCheck
checkInner (const PartPoints& points, const std::vector<Triangle>& triangles,
            std::vector<std::uint8_t> is_in_zone, const InnerCheckSettings& settings,
            const RunContext& run);

/// Bounding boxes of InnerCheck::BUCKET consecutive triangles each.
std::vector<Eigen::AlignedBox3d>
makeTriangleBuckets (const std::vector<Triangle>& triangles,
                     const std::vector<Eigen::Vector3d>& positions);

/// Flips the triangles of some components.
/// \param triangles of a part, as checked
/// \param is_turned of each component
void
turnInner (std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& is_turned,
           Index first, std::size_t points, const RunContext& run);

/// The component of each inner triangle, as InnerCheck numbers them.
/// \param triangles corners are points of the cloud
/// \param first, points of the part
std::vector<Index>
innerComponents (std::vector<Triangle> triangles, Index first, std::size_t points,
                 const RunContext& run);

} // namespace pcl::floater
