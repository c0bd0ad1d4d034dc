// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/region_recursion.h"

#include "core/run_context.h"
#include "floater/floater_method.h"
#include "floater/planar_delaunay.h"
#include "local/stars.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
// A collapsed region as a cloud of its own. Its points are numbered from 0.
struct Subproblem
{
  std::vector<Index> points; // their indices in the whole cloud, ascending
  std::vector<Index> loop;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;
  std::size_t level = 0; // of the recursion, from 1
};

// True if the boundary of the mesh is the loop.
bool
fillsLoop (const TriangleMesh& mesh, const std::vector<Index>& loop)
{
  std::vector<Index> successor (mesh.triangle_of.size (), NONE);
  for (std::size_t i = 0; i < loop.size (); ++i)
    successor[loop[i]] = loop[(i + 1) % loop.size ()];
  std::size_t edges = 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE) {
        if (successor[mesh.from ({t, side})] != mesh.to ({t, side}))
          return false;
        ++edges;
      }
  return edges == loop.size ();
}

// Parameterizes regions one by one, and collects final triangles.
class Recursion
{
public:
  Recursion (const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest,
             const std::vector<Eigen::Vector3f>& normals, const StarSettings& star_settings,
             const ParameterizationSettings& settings, const RunContext& run,
             const DiscLimits& limits)
      : positions_ (positions), nearest_ (nearest), normals_ (normals),
        star_settings_ (star_settings), settings_ (settings), run_ (run.withinStage ()),
        limits_ (limits), number_ (positions.size (), NONE)
  {
    settings_.domain.curve = Domain::CIRCLE;
  }

  // Cuts the regions out of a mesh, and keeps its other triangles. A region that cannot be
  // parameterized stays in the mesh.
  // \param points of the whole cloud for the numbers of the mesh; nullptr: the same
  // \param level  of the mesh
  void cut (std::vector<Triangle> triangles, const std::vector<Index>* points,
            const std::vector<CollapsedRegion>& regions, std::size_t level)
  {
    for (const CollapsedRegion& region : regions) {
      Subproblem subproblem = makeSubproblem (region, points);
      subproblem.level = level + 1;
      if (!solveSubproblem (subproblem))
        continue;
      waiting_.push_back (std::move (subproblem));
      for (const Index t : region.triangles)
        triangles[t][0] = NONE;
    }
    for (Triangle t : triangles) {
      if (t[0] == NONE)
        continue;
      if (points != nullptr)
        for (Index& p : t)
          p = (*points)[p];
      triangles_.push_back (t);
    }
  }

  // Also cuts the regions out of the subproblems, until none is left.
  // \return levels
  std::size_t solveAll ()
  {
    std::size_t levels = 0;
    while (!waiting_.empty ()) {
      Subproblem subproblem = std::move (waiting_.back ());
      waiting_.pop_back ();
      levels = std::max (levels, subproblem.level);
      const std::vector<CollapsedRegion> regions = findCollapsedRegions (
          subproblem.mesh, subproblem.uv, subproblem.positions, subproblem.loop, run_, limits_);
      cut (std::move (subproblem.mesh.triangles), &subproblem.points, regions, subproblem.level);
    }
    return levels;
  }

  std::vector<Triangle> takeTriangles () { return std::move (triangles_); }

private:
  static Subproblem makeSubproblem (const CollapsedRegion& region, const std::vector<Index>* points)
  {
    Subproblem subproblem;
    const auto inCloud = [points] (Index p) { return points == nullptr ? p : (*points)[p]; };
    for (const std::vector<Index>* part : {&region.loop, &region.interior})
      for (const Index p : *part)
        subproblem.points.push_back (inCloud (p));
    std::sort (subproblem.points.begin (), subproblem.points.end ());
    for (const Index p : region.loop)
      subproblem.loop.push_back (static_cast<Index> (
          std::lower_bound (subproblem.points.begin (), subproblem.points.end (), inCloud (p)) -
          subproblem.points.begin ()));
    return subproblem;
  }

  // The nearest neighbours among the subproblem's own points, without points beyond its loop.
  CsrLists neighborsWithin (const Subproblem& subproblem)
  {
    for (std::size_t i = 0; i < subproblem.points.size (); ++i)
      number_[subproblem.points[i]] = static_cast<Index> (i);
    CsrLists nearest;
    nearest.offsets.push_back (0);
    for (const Index p : subproblem.points) {
      for (const Index q : nearest_.row (p))
        if (number_[q] != NONE)
          nearest.ids.push_back (number_[q]);
      nearest.offsets.push_back (static_cast<Index> (nearest.ids.size ()));
    }
    for (const Index p : subproblem.points)
      number_[p] = NONE;
    return nearest;
  }

  // \return false if the subproblem has no solution that fills its loop
  bool solveSubproblem (Subproblem& subproblem)
  {
    const CsrLists nearest = neighborsWithin (subproblem);
    std::vector<Eigen::Vector3f> normals;
    for (const Index p : subproblem.points) {
      subproblem.positions.push_back (positions_[p]);
      normals.push_back (normals_[p]);
    }
    Parameterization parameterization =
        parameterize (subproblem.positions, nearest,
                      makeStars (subproblem.positions, nearest, normals, star_settings_, run_),
                      subproblem.loop, settings_, run_, limits_);
    if (parameterization.problem)
      return false;
    subproblem.uv = std::move (parameterization.uv);
    subproblem.mesh = triangulatePlane (subproblem.uv, subproblem.loop);
    return fillsLoop (subproblem.mesh, subproblem.loop);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& nearest_;
  const std::vector<Eigen::Vector3f>& normals_;
  StarSettings star_settings_;
  ParameterizationSettings settings_;
  RunContext run_;
  DiscLimits limits_;
  std::vector<Index> number_; // of each point in the current subproblem; NONE: not in it
  std::vector<Subproblem> waiting_;
  std::vector<Triangle> triangles_;
};

} // namespace

std::size_t
layOutCollapsedRegions (TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                        const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest,
                        const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& loop,
                        const StarSettings& star_settings, const ParameterizationSettings& settings,
                        const RunContext& run, const DiscLimits& limits)
{
  const std::vector<CollapsedRegion> regions =
      findCollapsedRegions (mesh, uv, positions, loop, run, limits);
  if (regions.empty ())
    return 0;
  Recursion recursion (positions, nearest, normals, star_settings, settings, run, limits);
  recursion.cut (mesh.triangles, nullptr, regions, 0);
  const std::size_t levels = recursion.solveAll ();
  TriangleMesh whole;
  whole.triangles = recursion.takeTriangles ();
  if (levels == 0 || !whole.connect (positions.size (), run))
    return 0;
  mesh = std::move (whole);
  return levels;
}

} // namespace pcl::floater
