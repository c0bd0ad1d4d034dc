// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_cloud.h"

#include "report/report_mesh.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace pcl::floater {
std::string
place (const Points& points, Index p)
{
  std::ostringstream text;
  text.precision (9); // distinguishes all numbers in single precision
  const Eigen::Vector3d at = points.inCloud (p);
  text << "point " << points.cloud_index[p] << " (" << at.x () << ", " << at.y () << ", " << at.z ()
       << ")";
  return text.str ();
}

std::string
rounded (double value)
{
  std::ostringstream text;
  text.precision (3);
  text << value;
  return text.str ();
}

std::string
counted (std::size_t count, const char* one, const char* several)
{
  return std::to_string (count) + " " + (count == 1 ? one : several);
}

std::string
oneAt (std::size_t count, const std::string& place)
{
  return (count == 1 ? " at " : ", one of them at ") + place;
}

namespace {
// Share of coinciding points above which a warning is given. Used for the warning only.
constexpr std::size_t MANY_COINCIDE = 100;

// Adds points to the outliers, and a warning.
void
addOutliers (const std::vector<Index>& outliers, const std::string& what, Report& report)
{
  if (outliers.empty ())
    return;
  const bool is_one = outliers.size () == 1;
  report.warnings.push_back (what + ", " + (is_one ? "point " : "among them point ") +
                             std::to_string (outliers.front ()) + ": " +
                             (is_one ? "it was" : "they were") + " left out");
  std::vector<Index> all;
  std::merge (report.outliers.begin (), report.outliers.end (), outliers.begin (), outliers.end (),
              std::back_inserter (all));
  report.outliers = std::move (all);
  report.statistics.outlier_points = report.outliers.size ();
}

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
    report.warnings.push_back (
        counted (coincident, "point coincides", "points coincide") + " with another one, point " +
        std::to_string (points.duplicates.front ()[0]) + " with point " +
        std::to_string (points.duplicates.front ()[1]) + (coincident == 1 ? "" : " among them") +
        ": one point of each place is in the mesh; coordinates "
        "may have been rounded, or "
        "a cloud may be in the file twice");
}

Problem
tooFarAway (Index cloud_index, const Eigen::Vector3d& position)
{
  std::ostringstream text;
  text << "point " << cloud_index << " (" << position.x () << ", " << position.y () << ", "
       << position.z ()
       << ") is so far away that double precision cannot hold it together with the others: take "
          "such points out of the cloud, or have outliers left out";
  return {RunStatus::DEGENERATE, text.str ()};
}

void
reportGrossOutliers (const std::vector<Index>& outliers, Report& report)
{
  addOutliers (outliers,
               counted (outliers.size (), "point is", "points are") +
                   " over a thousand times as far away as all others",
               report);
}

void
reportOutliers (const std::vector<Index>& outliers, std::size_t working_points, Report& report)
{
  report.statistics.working_points = working_points;
  addOutliers (outliers,
               counted (outliers.size (), "point lies", "points lie") + " off any surface", report);
}

void
reportScatter (const Points& points, const std::vector<Index>& scatter, Report& report)
{
  report.scatter.clear ();
  for (const Index p : scatter)
    report.scatter.push_back (points.cloud_index[p]);
  std::sort (report.scatter.begin (), report.scatter.end ());
  report.statistics.scatter_points = scatter.size ();
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
    report.warnings.push_back (
        counted (noise.noisy_points, "point is", "points are") + " noisy, by up to " +
        std::to_string (noise.largest) + " local spacings (median of all points " +
        std::to_string (noise.median) + ", 90 % below " + std::to_string (noise.quantile_90) +
        "): " +
        (noise.noisy_points == 1 ? "it was connected by its place on the plane"
                                 : "they were connected by their places on the planes") +
        " of the points around; the vertices of the mesh are the points themselves");
}

void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report)
{
  report.statistics.coordinate_step = grid.spacings;
  if (grid.spacings == 0.0)
    return;
  const std::size_t coincident = points.duplicates.size ();
  std::ostringstream text;
  text.precision (3);
  text << "the coordinates are coarse: along "
       << "xyz"[grid.axis] << " they are " << grid.step << " apart, " << grid.spacings
       << " of the local spacing"
       << (coincident > 0 ? ", and " + counted (coincident, "point coincides", "points coincide") +
                                " with another"
                          : "")
       << ". "
       << (grid.is_single_precision
               ? "32-bit numbers have this step so far from the origin: subtract an origin before "
                 "coordinates are stored in 32 bits; the tool's --shift does that for files in "
                 "text or in double precision"
               : "They were rounded when they were stored: store them with more digits");
  report.warnings.push_back (text.str ());
}

void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report)
{
  report.is_view = true;
  report.is_far_view = viewpoint.is_far;
  report.is_view_by_pixels = surface.is_by_pixels;
  Eigen::Map<Eigen::Vector3d> (report.viewpoint.data ()) = inCloud (points, viewpoint);
  report.statistics.view_steps = surface.steps;
  report.statistics.view_gaps = surface.gaps;
}

void
reportDoubtfulView (const Points& points, std::size_t unused, Report& report)
{
  report.warnings.push_back (std::to_string (unused) + " of " + std::to_string (points.size ()) +
                             " points are in no triangle of the view: the sensor may not have been "
                             "at the given viewpoint");
}

void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report)
{
  const Eigen::Vector3d place = inCloud (points, other);
  std::ostringstream text;
  text << "the points are spaced as seen from "
       << (other.is_far ? "far away in the direction (" : "the place (") << place[0] << ", "
       << place[1] << ", " << place[2]
       << "), and not as seen from the given viewpoint: that may be wrong; if none is given, the "
          "place is found";
  report.warnings.push_back (text.str ());
}

void
reportOutliersOfView (const Points& points, const std::vector<Index>& unused, Report& report)
{
  std::vector<Index> outliers;
  outliers.reserve (unused.size ());
  for (const Index p : unused)
    outliers.push_back (points.cloud_index[p]);
  std::sort (outliers.begin (), outliers.end ());
  reportOutliers (outliers, points.size () - unused.size (), report);
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

  // "of 2 parts of the mesh, the largest at point 7 (...)"
  std::string text (const Points& points) const
  {
    return counted (count, "part", "parts") + " of the mesh, " +
           (count == 1 ? "at " : "the largest at ") + place (points, largest->at);
  }
};

// Why a part is a guess, by the requested rule.
const char*
whyGuessed (Facing wanted)
{
  switch (wanted) {
  case Facing::OUTWARDS:
    return "no side of it is outside, and it bulges to neither; choose another facing";
  case Facing::UP:
    return "as much of it faces down as up; choose another facing";
  case Facing::VIEWPOINT:
    return "as much of it looks away from the viewpoint as towards it; choose another facing";
  case Facing::AUTO:
  case Facing::NORMALS:
    break;
  }
  return "it may be a body or a sheet; the place of the sensor would tell, if it is one scan";
}

void
warnOfMiss (const Points& points, FacingMiss miss, const Pieces& parts, Facing wanted,
            Report& report)
{
  const std::string where = parts.text (points);
  if (miss == FacingMiss::CONTRADICTION)
    report.warnings.push_back (
        "the normals of the points contradict each other on " + where +
        ": many point to either side, as if they had never been oriented. They do not decide which "
        "side is the front there; orient them, or choose another facing");
  else if (miss == FacingMiss::NO_NORMALS)
    report.warnings.push_back ("no point has a normal on " + where +
                               ": normals do not decide which side is the front there; choose "
                               "another facing");
  else
    report.warnings.push_back (
        where + (parts.count == 1 ? ", is closed: " : ", are closed: ") +
        (wanted == Facing::UP ? "no side is up, " : "the viewpoint is outside, ") +
        (parts.count == 1 ? "and it faces outwards" : "and they face outwards"));
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
    report.warnings.emplace_back (
        "the mesh was to face the viewpoint, but none is known: the cloud has no origin of its "
        "sensor, and the points do not tell it. Other evidence decides which side is the front; "
        "give the place of the sensor, or choose another facing");
  for (std::size_t miss = 0; miss < missed.size (); ++miss)
    if (missed[miss].count > 0 && TINY_OBJECT * missed[miss].triangles >= triangles)
      warnOfMiss (points, static_cast<FacingMiss> (miss), missed[miss], wanted, report);
  if (guessed.count > 0)
    report.warnings.push_back (
        "which side is the front of " + counted (guessed.count, "part", "parts") +
        " of the mesh is a guess, " + (guessed.count == 1 ? "at " : "the largest at ") +
        place (points, guessed.largest->at) + ": " + whyGuessed (wanted));
}

} // namespace pcl::floater
