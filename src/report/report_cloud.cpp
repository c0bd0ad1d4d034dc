// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_cloud.h"

#include "core/order_statistics.h"
#include "report/findings.h"
#include "report/report_mesh.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Share of coinciding points above which a warning is given. Used for the warning only.
constexpr std::size_t MANY_COINCIDE = 100;

// Viewpoint in the frame of the cloud, or the direction to a far sensor.
Eigen::Vector3d
inCloud (const Points& points, const Viewpoint& viewpoint)
{
  constexpr double ROUNDING = 1e-14; // relative to the scale: error of moving a position to the box
                                     // and back
  const Eigen::Vector3d place =
      viewpoint.is_far ? viewpoint.place
                       : Eigen::Vector3d (points.centre + points.scale * viewpoint.place);
  return (place.array ().abs () < ROUNDING * points.scale).select (0.0, place);
}

} // namespace

void
reportPoints (const Points& points, Report& report)
{
  report.non_finite = points.non_finite;
  report.duplicates = points.duplicates;
  report.statistics.non_finite_points = points.non_finite.size ();
  report.statistics.duplicate_points = points.duplicates.size ();
  report.statistics.working_points = points.positions.size ();
  const std::size_t coincident = points.duplicates.size ();
  if (coincident > 0 && MANY_COINCIDE * coincident >= coincident + points.positions.size ())
    addFinding (report, FindingId::COINCIDENT_POINTS, points, {}, coincident,
                points.duplicates.front ()[0], points.duplicates.front ()[1]);
}

Problem
tooFarAway (Index cloud_index, const Eigen::Vector3d& position)
{
  return {RunStatus::DEGENERATE,
          placeText (cloud_index, position) +
              " is so far away that double precision cannot hold it together with the others: take "
              "such points out of the cloud, or have outliers left out"};
}

void
reportOutliers (const std::vector<Index>& outliers, FindingId what, Report& report)
{
  if (outliers.empty ())
    return;
  addFinding (report, what, {}, {}, outliers.size (),
              *std::min_element (outliers.begin (), outliers.end ()));
  report.outliers.insert (report.outliers.end (), outliers.begin (), outliers.end ());
  std::sort (report.outliers.begin (), report.outliers.end ());
  report.statistics.outlier_points = report.outliers.size ();
}

void
reportScatter (const Points& points, const std::vector<Index>& scatter, bool is_unasked,
               Report& report)
{
  report.scatter = valuesAt (points.cloud_index, scatter);
  for (std::size_t i = 0; i < points.stacked.of.size (); ++i)
    if (std::binary_search (scatter.begin (), scatter.end (), points.stacked.of[i]))
      report.scatter.push_back (points.stacked.cloud_index[i]);
  std::sort (report.scatter.begin (), report.scatter.end ());
  report.statistics.scatter_points = report.scatter.size ();
  if (is_unasked && !scatter.empty ())
    addFinding (report, FindingId::SCATTER, points, {scatter.front ()}, report.scatter.size (),
                100.0 * static_cast<double> (report.scatter.size ()) /
                    static_cast<double> (points.total ()));
}

void
reportStacks (const Points& points, const Stacks& stacks, Report& report)
{
  report.statistics.stacked_points = stacks.points;
  report.statistics.stack_height = stacks.median;
  report.statistics.largest_stack_height = stacks.largest;
  if (stacks.points > 0)
    addFinding (report, FindingId::STACKED_POINTS, points, {stacks.at}, stacks.points,
                100.0 * static_cast<double> (stacks.points) / static_cast<double> (points.total ()),
                stacks.median, stacks.largest);
}

void
reportNoise (const Noise& noise, bool denoised, Report& report)
{
  report.statistics.noise = noise.median;
  report.statistics.noise_quantile_90 = noise.quantile_90;
  report.statistics.largest_noise = noise.largest;
  report.statistics.projected_points = denoised ? noise.noisy_points : 0;
  report.denoised = denoised;
  if (denoised)
    addFinding (report, FindingId::NOISE, {}, {}, noise.noisy_points, noise.largest, noise.median,
                noise.quantile_90,
                100.0 * static_cast<double> (noise.noisy_points) /
                    static_cast<double> (noise.at_point.size ()));
}

void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report)
{
  report.statistics.coordinate_step = grid.spacings;
  if (grid.spacings > 0.0)
    addFinding (report,
                grid.is_single_precision ? FindingId::COORDINATES_IN_FLOAT
                                         : FindingId::COORDINATES_ROUNDED,
                points, {}, grid.axis, grid.step, grid.spacings, points.duplicates.size ());
}

void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report)
{
  report.is_view = true;
  report.is_far_view = viewpoint.is_far;
  Eigen::Map<Eigen::Vector3d> (report.viewpoint.data ()) = inCloud (points, viewpoint);
  report.statistics.holes_filled = surface.holes_filled;
  report.statistics.view_steps = surface.steps;
  report.statistics.view_gaps = surface.gaps;
}

void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report)
{
  const Eigen::Vector3d place = inCloud (points, other);
  addFinding (report, other.is_far ? FindingId::OTHER_DIRECTION : FindingId::OTHER_VIEWPOINT,
              points, {}, place[0], place[1], place[2]);
}

// Reports which rule decided the front of each part of the mesh, and with what confidence.

namespace {
// Thresholds for the report. They do not change the mesh.
constexpr std::size_t TINY_OBJECT = 20; // a part is tiny if the mesh has this many times its
                                        // triangles
constexpr double SURE_FACING = 0.9;     // confidence; lower ones are reported
constexpr double GUESSED_FACING = 0.6;  // confidence; a warning below

// Some parts of the mesh.
struct Pieces
{
  std::size_t count = 0, triangles = 0;
  const FacingObject* largest = nullptr;

  void add (const FacingObject& object)
  {
    ++count;
    triangles += object.triangles;
    if (largest == nullptr || object.triangles > largest->triangles)
      largest = &object;
  }
};

FindingId
guessOf (Facing wanted)
{
  if (wanted == Facing::OUTWARDS || wanted == Facing::INWARDS)
    return FindingId::GUESSED_OUTSIDE;
  if (wanted == Facing::UP)
    return FindingId::GUESSED_UP;
  return wanted == Facing::VIEWPOINT ? FindingId::GUESSED_TOWARDS_VIEW : FindingId::GUESSED_FRONT;
}

FindingId
findingOf (FacingMiss miss, Facing wanted)
{
  if (miss == FacingMiss::CONTRADICTION)
    return FindingId::NORMALS_CONTRADICT;
  if (miss == FacingMiss::NO_NORMALS)
    return FindingId::NORMALS_MISSING;
  return wanted == Facing::UP ? FindingId::CLOSED_HAS_NO_UP : FindingId::VIEWPOINT_OUTSIDE;
}

} // namespace

void
reportFacing (const Points& points, const MeshFacing& facing, Facing wanted, Report& report)
{
  std::size_t triangles = 0;
  for (const FacingObject& object : facing.objects)
    triangles += object.triangles;
  Pieces guessed;
  std::array<Pieces, static_cast<std::size_t> (FacingMiss::COUNT)> missed;
  for (const FacingObject& object : facing.objects) {
    ++report.facing_parts[static_cast<std::size_t> (object.rule)];
    report.facing_certainty = std::min (report.facing_certainty, object.certainty);
    if (object.miss != FacingMiss::NOTHING)
      missed[static_cast<std::size_t> (object.miss)].add (object);
    if (object.certainty >= SURE_FACING)
      continue;
    report.facing_decisions.push_back (
        {object.triangles, points.cloud_index[object.at], object.rule, object.certainty});
    if (object.certainty < GUESSED_FACING && TINY_OBJECT * object.triangles >= triangles)
      guessed.add (object);
  }
  std::stable_sort (
      report.facing_decisions.begin (), report.facing_decisions.end (),
      [] (const FacingDecision& a, const FacingDecision& b) { return a.certainty < b.certainty; });
  if (facing.lacks_viewpoint)
    addFinding (report, FindingId::NO_VIEWPOINT, points, {});
  const auto add = [&] (FindingId id, const Pieces& pieces) {
    if (pieces.count > 0 && TINY_OBJECT * pieces.triangles >= triangles)
      addFinding (report, id, points, {pieces.largest->at}, pieces.count);
  };
  for (std::size_t miss = 0; miss < missed.size (); ++miss)
    add (findingOf (static_cast<FacingMiss> (miss), wanted), missed[miss]);
  add (guessOf (wanted), guessed);
}

} // namespace pcl::floater
