// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the core, which uses no types of PCL.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>
#include <pcl_floater/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl::floater {
/// A search structure of the caller. The core uses it in one thread at a time.
class NeighborSearch
{
public:
  virtual ~NeighborSearch () = default;

  /// Prepares for queries among these points only.
  /// \param cloud_indices ascending
  virtual void build (const std::vector<std::uint32_t>& cloud_indices) = 0;

  /// Finds the k points nearest to a given one.
  /// \param[out] cloud_indices in any order; may include the point itself; k, if there are so many
  virtual void nearest (std::uint32_t cloud_index, int k,
                        std::vector<std::uint32_t>& cloud_indices) = 0;

  /// Finds the points within a distance. Called for Neighborhood::BALL and BALL_DELAUNAY only.
  /// \param radius in units of the cloud
  /// \param[out] cloud_indices in any order; points beyond the radius or given twice are ignored
  /// \return false if the structure has no such query; then nearest () is called with increasing k
  virtual bool within (std::uint32_t /*cloud_index*/, double /*radius*/,
                       std::vector<std::uint32_t>& /*cloud_indices*/)
  {
    return false;
  }
};

/// Points to reconstruct. Inconsistent arrays give RunStatus::INVALID_INDICES.
struct Input
{
  std::vector<Eigen::Vector3d> positions; ///< may hold non-finite coordinates and equal points
  std::vector<std::uint32_t> cloud_index; ///< one for each position; distinct
  std::size_t cloud_size = 0;       ///< points of the whole cloud; all cloud indices are below it
  NeighborSearch* search = nullptr; ///< nullptr: a parallel kd-tree of the core
  std::array<double, 3> sensor_origin{}; ///< position of the sensor of a single scan; (0, 0, 0):
                                         ///< unknown. See ViewUse. The mesh faces it where it can

  /// Empty, or one for each point of the whole cloud: normals of the tangent planes, of any length
  /// and sign, used instead of fitted ones, but where they are zero or not finite.
  std::vector<Eigen::Vector3f> normals{};

  /// Empty, or one for each point of the whole cloud: normals of any length towards the front of
  /// the surface; read for Facing::AUTO and NORMALS. Ignored where zero or not finite. May be the
  /// same as `normals`.
  std::vector<Eigen::Vector3f> facing_normals{};

  /// Was subtracted from all coordinates before: points that stand for no measurement, such as
  /// (0, 0, 0), are recognized by what they were. The origin before is a likely place of the sensor.
  std::array<double, 3> shift{};
};

/// A mesh and the report on the run that made it.
struct Result
{
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< cloud indices, facing outwards
  Report report;                                       ///< status, figures and warnings
};

/// Reconstructs a surface by one of three methods (see FloaterReconstruction, Topology and ViewUse):
/// the consensus of the stars of neighbouring points; meshless parameterization (Floater and
/// Reimers 2001) as in TW 385; or the triangulation of the rays of a single scan.
///
/// Every component of the mesh faces as Options::facing asks; by Facing::AUTO, the wall of a hollow in
/// another body faces into the hollow, and components that continue each other across a gap face
/// alike. Report::facing_decisions lists uncertain results.
///
/// Does not throw: a failure is a status, a message and an empty mesh. The result does not depend
/// on the number of threads, or on the order of the points. A surface of 100,000 points takes 4
/// microseconds and 0.5 kB per point, a disc 10 microseconds and 1.5 kB (two cores); the
/// factorization of a disc grows a little faster than the number of points.
/// \param input consumed: its arrays are freed as soon as they have been read
PCL_FLOATER_EXPORT Result
reconstruct (Input input, const Options& options);

/// Reconstructs a whole cloud of points in double precision, such as map coordinates, which have a
/// resolution of only half a metre in PCL's 32-bit point types. The result indexes `positions`.
/// More than 2^32 - 1 points end with RunStatus::OUT_OF_MEMORY, no point with RunStatus::NO_INPUT.
/// \param positions may hold non-finite coordinates and equal points. Moving saves 24 bytes each
PCL_FLOATER_EXPORT Result
reconstruct (std::vector<Eigen::Vector3d> positions, const Options& options = {});

} // namespace pcl::floater
