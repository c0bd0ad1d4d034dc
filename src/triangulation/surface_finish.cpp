// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/surface_finish.h"

#include "common/stage_clock.h"
#include "neighborhoods/stars.h"
#include "triangulation/flips.h"
#include "triangulation/fold_repair.h"
#include "triangulation/insertion.h"

namespace pcl
{
namespace floater
{
namespace
{
constexpr double TOO_MANY_FOLDS =
    0.03; // of all edges; discs have up to 1 %, closed surfaces from 4 %
// Shares of time of the stage that are then behind, on clean clouds.
constexpr double AFTER_SPACING = 0.1, AFTER_INSERTION = 0.15, AFTER_FLIPS = 0.7;

// Insertion and flips; true if there are folds to be repaired.
bool
flipSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const FlatLists& near, std::vector<Eigen::Vector3f>& normals, const Options& options,
             SurfaceFinish& finish)
{
  StageClock::step (AFTER_SPACING);
  orientNormals (mesh, positions, normals);
  const std::vector<float> spacing = localSpacing (positions, near, options.threads);
  const TriangleCost cost (positions, normals, &spacing);
  StageClock::step (AFTER_INSERTION);
  insertMissingPoints (mesh, near, cost, options.flip_edges);
  StageClock::step (AFTER_FLIPS);
  if (options.flip_edges)
    finish.flips = flipEdges (mesh, cost);
  finish.folds = findFolds (mesh, positions);
  return options.flip_edges && !finish.folds.empty ();
}

// Flips have turned triangles round, so that some normals may have the wrong sign.
void
repair (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
        std::vector<Eigen::Vector3f>& normals, const Options& options, SurfaceFinish& finish)
{
  const std::vector<float> spacing = localSpacing (positions, near, options.threads);
  orientNormals (mesh, positions, normals);
  finish.moves = moveVertices (mesh, near, TriangleCost (positions, normals, &spacing), positions);
  finish.folds = findFolds (mesh, positions);
}

} // namespace

SurfaceFinish
finishSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const FlatLists& near, std::vector<Eigen::Vector3f>& normals, const Options& options)
{
  SurfaceFinish finish;
  if (flipSurface (mesh, positions, near, normals, options, finish))
    repair (mesh, positions, near, normals, options, finish);
  return finish;
}

SurfaceFinish
finishDisc (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
            std::vector<Eigen::Vector3f>& normals, const Options& options)
{
  SurfaceFinish finish;
  if (!flipSurface (mesh, positions, near, normals, options, finish))
    return finish;
  const double edges = 1.5 * static_cast<double> (mesh.triangles.size ());
  if (static_cast<double> (finish.folds.size ()) > TOO_MANY_FOLDS * edges)
    finish.problem = {
        Status::NOT_A_DISC,
        std::to_string (finish.folds.size ()) + " of " +
            std::to_string (static_cast<std::size_t> (edges)) +
            " edges are folded: the surface is not one disc with one boundary (it may be closed, "
            "have handles, several parts, or be too thinly sampled); let the topology be chosen "
            "automatically, or reconstruct a part of it"};
  else
    repair (mesh, positions, near, normals, options, finish);
  return finish;
}

} // namespace floater
} // namespace pcl
