// SPDX-License-Identifier: GPL-3.0-or-later
// Entry of the core, which knows no PCL types.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>
#include <pcl_floater/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl
{
namespace floater
{
/// Nearest neighbours by a search structure of the caller's. Used by one thread at a time.
class NeighborSearch
{
public:
  virtual ~NeighborSearch () = default;

  /// Prepares for queries among these points only (cloud indices, ascending).
  virtual void build (const std::vector<std::uint32_t>& cloud_indices) = 0;

  /// The k points nearest to a given one (the point itself may be among them), as cloud indices.
  /// Any order; fewer than k only if there are no more.
  virtual void nearest (std::uint32_t cloud_index, int k,
                        std::vector<std::uint32_t>& cloud_indices) = 0;

  /// The points within a distance of a given one, in units of the cloud, as cloud indices. Any
  /// order; a few points too many or twice do no harm. Asked for Neighborhood::BALL and
  /// BALL_DELAUNAY only.
  /// \return false if that cannot be answered: then nearest () is asked, for more and more points
  virtual bool within (std::uint32_t /*cloud_index*/, double /*radius*/,
                       std::vector<std::uint32_t>& /*cloud_indices*/)
  {
    return false;
  }
};

/// Points to reconstruct.
struct Input
{
  std::vector<Eigen::Vector3d> positions; ///< may hold non-finite coordinates and duplicates
  std::vector<std::uint32_t> cloud_index; ///< of each position; distinct
  std::size_t cloud_size = 0;             ///< points of the whole cloud; every index is below it
  NeighborSearch* search = nullptr;       ///< nullptr: the core's own kd-tree, in parallel
};

/// A mesh over the cloud and what there is to say about it.
struct Result
{
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< cloud indices, facing outwards
  Report report;
};

/// Triangulates a surface of any topology from the triangles on which neighbouring points agree, or
/// one disc by Floater's meshless parameterization: the whole of TW 385, with edge flips on the
/// surface after it. Every position that can be used is a vertex of the result. ComponentSets of
/// the mesh face outwards: closed ones enclose a positive volume, bowls face away from their
/// inside, and sheets and terrain face up (+z; +y or +x where they stand upright).
///
/// Does not throw: a failure is a status, a message and an empty mesh. The result does not depend
/// on the number of threads nor on the order of the points. Of a disc about 5 microseconds and
/// 1.3 kB per point, most of it the factorization, which grows a little faster than the number of
/// points.
/// \param input consumed: its arrays are freed as soon as the working set is made
PCL_FLOATER_EXPORT Result
reconstruct (Input input, const Options& options);

} // namespace floater
} // namespace pcl
