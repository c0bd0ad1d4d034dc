// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation.h"

#include "solvers/solver.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// What the two methods take, and what a policy for holes needs.
Problem
checkTopology (const Options& options)
{
  const auto refused = [] (const char* why) { return Problem{Status::INVALID_OPTION, why}; };
  if (options.kept_loops < 0)
    return refused ("the number of kept loops must be 0 or more");
  if (!(options.largest_hole >= 0.0 && std::isfinite (options.largest_hole)))
    return refused ("the largest hole must be 0 or more local spacings");
  if (!(options.largest_hole_length >= 0.0 && std::isfinite (options.largest_hole_length)))
    return refused ("the length of the largest hole must be 0 or more");
  if (options.holes == HolePolicy::BY_SIZE && options.largest_hole == 0.0 &&
      options.largest_hole_length == 0.0)
    return refused ("holes chosen by their size need the largest hole to close, or its length");
  if (options.topology == Topology::DISC && options.holes != HolePolicy::AUTO &&
      options.holes != HolePolicy::KEEP_LARGEST)
    return refused ("a disc has one boundary loop and no holes: of the policies for holes it takes "
                    "AUTO and KEEP_LARGEST only; choose another topology");
  if (options.topology == Topology::SURFACE && !options.loop.empty ())
    return refused ("a boundary loop can be given for a disc only; choose another topology");
  return {};
}

} // namespace

Problem
checkOptions (const Options& options)
{
  if (Problem problem = checkTopology (options))
    return problem;
  const auto out_of_range = [] (const char* name, const char* range) {
    return Problem{Status::INVALID_OPTION, std::string (name) + " must be " + range};
  };
  if (options.k < 6 || options.k > 200)
    return out_of_range ("k", "from 6 to 200");
  if (!(options.ball_radius >= 1.0 && options.ball_radius <= 10.0))
    return out_of_range ("the ball radius", "from 1 to 10 local spacings");
  if (!(options.opening_angle > 0.0 && options.opening_angle < 360.0))
    return out_of_range ("the opening angle", "above 0 and below 360 degrees");
  if (!(options.cluster_tolerance > 0.0 && options.cluster_tolerance <= 1.0))
    return out_of_range ("the cluster tolerance", "above 0 and at most 1");
  if (options.cluster_k < 1)
    return out_of_range ("cluster k", "1 or more");
  if (options.polygon_sides < 3)
    return out_of_range ("the number of polygon sides", "3 or more");
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0))
    return out_of_range ("the tolerance", "above 0 and below 1");
  if (options.max_iterations < 1)
    return out_of_range ("the number of iterations", "1 or more");
  if (options.ilut_fill < 1 || options.ilut_fill > 10000)
    return out_of_range ("the fill of ILUT", "from 1 to 10000");
  if (!(options.ilut_drop >= 0.0 && options.ilut_drop <= 1.0))
    return out_of_range ("the drop tolerance of ILUT", "from 0 to 1");
  if (Problem problem = checkSolver (options.solver, options.ordering))
    return problem;
  if (options.threads < 0)
    return out_of_range ("the number of threads", "0 (all cores) or more");
  if (options.blocks < 0)
    return out_of_range ("the number of blocks", "0 (chosen by the points) or more");
  if (!options.loop.empty () && options.loop.size () < 3)
    return {Status::INVALID_LOOP, "the given boundary loop has fewer than 3 points"};
  return {};
}

Problem
checkWorkingSet (const WorkingSet& set)
{
  constexpr std::size_t FEWEST = 4;
  const std::size_t n = set.positions.size ();
  if (n < FEWEST)
    return {Status::TOO_FEW_POINTS, "only " + std::to_string (n) +
                                        " distinct finite points; at least " +
                                        std::to_string (FEWEST) + " are needed"};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : set.positions)
    mean += p;
  mean /= static_cast<double> (n);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero ();
  for (const Eigen::Vector3d& p : set.positions)
    covariance += (p - mean) * (p - mean).transpose ();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver (covariance);
  const Eigen::Vector3d spread = solver.eigenvalues ().cwiseMax (0.0).cwiseSqrt ();
  // Coordinates come in single precision: a line is straight only to 1e-7 of its length.
  if (spread[1] < 1e-6 * spread[2])
    return {Status::DEGENERATE,
            "all points lie on one line; a surface needs points in two directions"};
  return {};
}

namespace
{
// Number of triangles that hang together with one by edges.
std::size_t
reachedFrom (const SurfaceMesh& mesh, Index start)
{
  std::vector<std::uint8_t> seen (mesh.triangles.size (), 0);
  std::vector<Index> reached{start};
  seen[start] = 1;
  for (std::size_t i = 0; i < reached.size (); ++i)
    for (const Index t : mesh.neighbors[reached[i]])
      if (t != NONE && seen[t] == 0) {
        seen[t] = 1;
        reached.push_back (t);
      }
  return reached.size ();
}

} // namespace

Problem
checkDisc (const std::vector<Triangle>& triangles, std::size_t points,
           const std::vector<Index>& loop)
{
  const Problem broken{Status::INTERNAL_ERROR,
                       "the result is not one manifold disc within the boundary loop; "
                       "please report this with the cloud"};
  SurfaceMesh mesh;
  mesh.triangles = triangles;
  if (triangles.empty () || !mesh.connect (points))
    return broken;
  const std::vector<std::vector<Index>> loops = boundaryLoops (mesh);
  if (loops.size () != 1 || loops.front ().size () != loop.size ())
    return broken;
  std::vector<Index> turned = loop;
  std::rotate (turned.begin (), std::min_element (turned.begin (), turned.end ()), turned.end ());
  if (turned != loops.front ()) {
    std::reverse (turned.begin () + 1, turned.end ());
    if (turned != loops.front ())
      return broken;
  }
  if (reachedFrom (mesh, 0) != triangles.size ())
    return broken; // more than one component
  const auto vertices = static_cast<std::int64_t> (
      points - static_cast<std::size_t> (
                   std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE)));
  const auto faces = static_cast<std::int64_t> (triangles.size ());
  const std::int64_t edges = (3 * faces + static_cast<std::int64_t> (loop.size ())) / 2;
  return vertices - edges + faces == 1 ? Problem{} : broken;
}

} // namespace floater
} // namespace pcl
