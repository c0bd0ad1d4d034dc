// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is found out about the triangles of a part that nothing changes any more.
#pragma once

#include "mesh/facing_objects.h"
#include "mesh/self_intersection_removal.h"
#include "mesh/surroundings.h"
#include "parts/part_mesh.h"

#include <Eigen/Geometry>

#include <utility>
#include <vector>

namespace pcl::floater {
/// Pairs of triangles that cross each other.
struct CrossingSum
{
  static constexpr std::size_t PLACES = 10; ///< as in MeshCheck

  std::size_t found = 0; ///< before any were moved apart
  std::size_t left = 0;
  Uncrossing done;
  std::vector<std::pair<Index, Index>> places; ///< of the first PLACES pairs that are left: the
                                               ///< first corners of both triangles
  Index first_at = NONE;                       ///< the smallest one of all pairs that are left

  void add (const CrossingSum& next);

  /// Sets what is left.
  /// \param point_of a corner
  template <typename PointOf>
  void take (const std::vector<CrossingPair>& pairs, const std::vector<Triangle>& triangles,
             PointOf&& point_of)
  {
    left = pairs.size ();
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
  ComponentSum sum;       ///< it counts as closed, since the boundary is in zones
  std::size_t points = 0; ///< that are in no zone
};

/// What is known of the inner triangles of a part, which are not in its zone: what the check of the
/// whole mesh and its facing need of them. Points are those of the cloud.
struct InnerCheck
{
  /// Triangles around which there is one box. Chosen by hand: boxes take a sixteenth of what
  /// triangles do.
  static constexpr std::size_t BUCKET = 64;

  std::size_t triangles = 0;
  Surroundings around; ///< of the points that are not in the zone; without boundary edges
  std::vector<InnerComponent> components;
  CrossingSum crossing;
  std::vector<Index> rim;           ///< triangles with a corner in the zone, ascending
  std::vector<Index> rim_component; ///< of each of these
  Eigen::AlignedBox3d box;          ///< around all
};

/// What checkInner has to know of the whole.
struct InnerCheckSettings
{
  CheckLimits limits;
  double diagonal = 1.0;                 ///< see Points
  std::optional<Eigen::Vector3d> sensor; ///< see FacingHints
};

/// Checks the inner triangles of a part, but for those that cross each other.
/// \param triangles  in the order of their smallest points; corners are counted from the first
///                   point of the part on
/// \param is_in_zone of each point of the part
InnerCheck
checkInner (const PartPoints& points, const std::vector<Triangle>& triangles,
            std::vector<std::uint8_t> is_in_zone, const InnerCheckSettings& settings,
            const RunContext& run);

/// The boxes around consecutive triangles, InnerCheck::BUCKET of them each.
std::vector<Eigen::AlignedBox3d>
makeTriangleBuckets (const std::vector<Triangle>& triangles,
                     const std::vector<Eigen::Vector3d>& positions);

/// Turns the triangles of some components round.
/// \param triangles of a part, as they were checked
/// \param is_turned each component
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
