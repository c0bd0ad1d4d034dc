// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing.h"

#include "mesh/facing_judge.h"

#include <utility>

namespace pcl::floater {
namespace {
// A mesh in memory.
class WholeMesh : public FacedMesh
{
public:
  WholeMesh (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const MeshComponents& found)
      : mesh_ (mesh), positions_ (positions), found_ (found)
  {
  }

  const std::vector<Triangle>& triangles () override { return mesh_.triangles; }
  const std::vector<Index>& components () override { return found_.of_triangle; }
  const std::vector<Eigen::Vector3d>& positions () override { return positions_; }
  std::vector<BoundarySegment> boundary () override
  {
    return boundarySegments (mesh_, positions_, found_);
  }

private:
  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const MeshComponents& found_;
};

} // namespace

MeshFacing
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const FacingHints& hints, const FacingLimits& limits, const RunContext& run)
{
  MeshFacing facing;
  const FacingHints usable = usableHints (hints, facing);
  const MeshComponents found = findComponents (mesh, run);
  const std::vector<FacingSums> sums = sumComponents (mesh, positions, found, usable, limits, run);
  WholeMesh whole (mesh, positions, found);
  const std::vector<std::uint8_t> is_turned =
      judgeFacing (whole, sums, findTogether (mesh, positions, found, sums, usable, limits, run),
                   usable, limits, run, facing);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[found.of_triangle[t]] != 0) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return facing;
}

} // namespace pcl::floater
