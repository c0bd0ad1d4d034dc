// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_builder.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double LONG_STEP = 8.0; // spacings: a longer edge of the loop is worth a warning

std::string
place (const WorkingSet& set, Index p)
{
  const Eigen::Vector3d at = set.centre + set.scale * set.positions[p];
  return "point " + std::to_string (set.cloud_index[p]) + " (" + std::to_string (at.x ()) + ", " +
         std::to_string (at.y ()) + ", " + std::to_string (at.z ()) + ")";
}

} // namespace

void
reportWorkingSet (const WorkingSet& set, Report& report)
{
  report.non_finite = set.non_finite;
  report.duplicates = set.duplicates;
  report.statistics.non_finite_points = set.non_finite.size ();
  report.statistics.duplicate_points = set.duplicates.size ();
  report.statistics.working_points = set.positions.size ();
}

void
reportOutliers (std::vector<Index> outliers, std::size_t working_points, Report& report)
{
  report.outliers = std::move (outliers);
  report.statistics.outlier_points = report.outliers.size ();
  report.statistics.working_points = working_points;
  if (!report.outliers.empty ())
    report.warnings.push_back (
        std::to_string (report.outliers.size ()) + " points lie off any surface, point " +
        std::to_string (report.outliers.front ()) + " among them: they were left out");
}

void
reportNoise (double noise, bool denoised, Report& report)
{
  report.statistics.noise = noise;
  report.denoised = denoised;
  if (denoised)
    report.warnings.push_back ("the points are noisy, by " + std::to_string (noise) +
                               " local spacings: they were connected as they lie in the planes of "
                               "their neighbours; the mesh keeps them where they are");
}

void
reportBoundary (const WorkingSet& set, const Boundary& boundary, Report& report)
{
  for (Index p : boundary.loop)
    report.loop.push_back (set.cloud_index[p]);
  report.statistics.boundary_candidates = boundary.candidates;
  report.statistics.loop_points = boundary.loop.size ();
  if (boundary.largest_step > LONG_STEP)
    report.warnings.push_back ("the boundary loop has a step of " +
                               std::to_string (boundary.largest_step) + " local spacings at " +
                               place (set, boundary.longest_from) +
                               ": it may cut across the surface there");
}

void
reportParameterization (const WorkingSet& set, const Parameterization& parameterization,
                        Report& report)
{
  report.statistics.relinked_points = parameterization.relinked;
  if (parameterization.relinked > 0)
    report.warnings.push_back (
        std::to_string (parameterization.relinked) +
        " points hung together with the boundary in no direction and were linked to their "
        "nearest neighbours");
  if (parameterization.uv.empty ())
    return;
  const Eigen::Vector2d nowhere =
      Eigen::Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ());
  report.parameters.assign (report.statistics.cloud_points, nowhere);
  for (Index p = 0; p < set.cloud_index.size (); ++p)
    report.parameters[set.cloud_index[p]] = parameterization.uv[p];
  for (const std::array<Index, 2>& duplicate : set.duplicates)
    report.parameters[duplicate[0]] = report.parameters[duplicate[1]];
}

std::vector<Triangle>
reportMesh (const WorkingSet& set, const SurfaceMesh& mesh, const SurfaceFinish& finish,
            Report& report)
{
  std::vector<Triangle> triangles = mesh.triangles;
  for (Triangle& triangle : triangles)
    for (Index& p : triangle)
      p = set.cloud_index[p];
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE)
      report.unused.push_back (set.cloud_index[p]);
  std::sort (report.unused.begin (), report.unused.end ());
  if (!report.unused.empty ())
    report.warnings.push_back (std::to_string (report.unused.size ()) +
                               " points are in no triangle, point " +
                               std::to_string (report.unused.front ()) +
                               " among them: they do not connect to the rest of the surface");
  report.statistics.flips = finish.flips;
  report.statistics.folds = finish.folds.size ();
  if (!finish.folds.empty ())
    report.warnings.push_back (
        std::to_string (finish.folds.size ()) +
        " edges are folded by more than 120 degrees, one of them at " +
        place (set, mesh.from (finish.folds.front ())) +
        ": sheets of the surface come close there, or a feature is thinly sampled");
  report.statistics.used_points = set.positions.size () - report.unused.size ();
  report.statistics.triangles = triangles.size ();
  return triangles;
}

} // namespace floater
} // namespace pcl
