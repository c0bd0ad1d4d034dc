// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The consensus method: surfaces of any topology, from the triangles that stars agree on.
#pragma once

#include "consensus/consensus.h"
#include "local/local_geometry.h"
#include "mesh/finish.h"
#include "mesh/loops.h"
#include "points/points.h"

namespace pcl::floater {
/// The mesh of a surface and how it was made.
struct Surface
{
  TriangleMesh mesh;
  MeshFinish finish;
  std::size_t holes_filled = 0;
  std::vector<BoundaryLoop>
      doubtful_loops;                     ///< in the order of their smallest points, see isDoubtful
  std::vector<Triangle> orientation_seam; ///< where a one-sided surface was cut open (see
                                          ///< findOrientationSeam); otherwise empty
};

/// Makes the consensus mesh, fills holes, inserts missing points, flips edges and repairs
/// flaws. Stages CONSENSUS, HOLES and FLIPS. Triangles and holes are chosen by the working
/// positions; the mesh is finished by the input positions. O(n log n).
/// \param geometry in: of the points; out: without stars, but with their normals, oriented like the
///     mesh
/// \param finish   what else it does is chosen here; to repair is also to make zones anew where
///     several sheets are near
Surface
makeSurface (const Points& points, LocalGeometry& geometry, const HoleOptions& holes,
             FinishSettings finish, const RunContext& run);

} // namespace pcl::floater
