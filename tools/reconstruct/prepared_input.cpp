// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include "points/outliers.h"

#include <Eigen/Geometry>

namespace pcl::floater {
namespace {
void
takeNormals (const CommandLine& line, Cloud& cloud, Input& input)
{
  const bool for_facing = line.options.facing == Facing::NORMALS ||
                          (line.options.facing == Facing::AUTO && line.use_input_normals);
  if (line.options.facing == Facing::AUTO && !for_facing)
    input.facing_normals = std::move (cloud.towards_sensors);
  if (!line.use_input_normals && !for_facing)
    return;
  const FieldTriple fields = cloud.normals ();
  if (!fields[0])
    throw UsageError (
        std::string (line.use_input_normals ? "--use-input-normals on" : "--facing normals") +
        ": the points of " + inputName (line.input) +
        " have no normals (float fields normal_x, normal_y, normal_z, or nx, ny, nz); leave the "
        "option out, or add them");
  std::vector<Eigen::Vector3f> normals (cloud.size ());
  for (std::size_t p = 0; p < normals.size (); ++p)
    normals[p] = vectorOf (fields, cloud.row (p)).cast<float> ();
  giveBackMappedFiles ();
  if (std::none_of (normals.begin (), normals.end (), [] (const Eigen::Vector3f& normal) {
        return normal.allFinite () && !normal.isZero (0.0F);
      }))
    cloud.warnings.emplace_back (
        "all normals of the input file are zero or not finite: none is used");
  if (line.use_input_normals)
    input.normals = normals;
  if (for_facing)
    input.facing_normals = std::move (normals);
}

// Warns if x and y seem to be degrees of longitude and latitude beside heights in metres, with the
// command that projects them. They are in their range, and names or scales say so; or they are a
// small area away from the origin, and their extents far below that of z. O(n).
void
warnOfDegrees (const std::vector<Eigen::Vector3d>& positions, Cloud& cloud)
{
  constexpr double LONGITUDES = 180.0, LATITUDES = 90.0, ZONE = 6.0; // degrees
  constexpr double SMALL = 5.0;   // degrees; larger areas are not reconstructed as they are
  constexpr double STEEP = 200.0; // metres for each degree: hardly a hill, but a high wall
  constexpr double OFF = 10.0;    // extents from (0, 0), which is in the sea
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions)
    if (position.allFinite ())
      box.extend (position);
  if (box.isEmpty ())
    return;
  const Eigen::Vector3d size = box.sizes (), centre = box.center ();
  const double extent = std::max (size.x (), size.y ());
  const bool are_in_range = std::max (-box.min ().x (), box.max ().x ()) <= LONGITUDES &&
                            std::max (-box.min ().y (), box.max ().y ()) <= LATITUDES;
  const bool seem = extent > 0.0 && extent < SMALL && size.z () > STEEP * extent &&
                    centre.head<2> ().norm () > OFF * extent;
  if (!are_in_range || !(seem || (cloud.may_be_degrees && size.z () > extent)))
    return;
  const int zone = static_cast<int> (std::floor ((centre.x () + LONGITUDES) / ZONE)) % 60 + 1;
  const bool is_south = centre.y () < 0.0;
  const std::string number = (zone < 10 ? "0" : "") + std::to_string (zone);
  cloud.projection =
      "project them first, such as by cs2cs -f %.3f +proj=longlat +to +proj=utm +zone=" +
      std::to_string (zone) + (is_south ? " +south" : "") +
      " (of lines x y z), or pdal translate a.las b.las reprojection "
      "--filters.reprojection.in_srs=EPSG:4326 --filters.reprojection.out_srs=EPSG:32" +
      (is_south ? "7" : "6") + number;
  cloud.warnings.push_back (std::string (DEGREES) + "; " + cloud.projection);
}

// Where to move the origin so that 32-bit floats hold the coordinates well: the centre of the
// bounding box of all finite points that are no gross outliers, rounded to the power of ten below
// its diagonal. (0, 0, 0) if floats hold them well as they are: if the distance of two floats of
// the size of the coordinates is below a hundredth of the spacing that the points would have on a
// flat sheet as large as the box. O(n).
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads)
{
  constexpr double FINE = 0.01; // spacings
  const GrossOutliers outliers = findGrossOutliers (positions, threads);
  std::vector<bool> is_outlier (positions.size (), false);
  for (const std::vector<Index>* rows : {&outliers.isolated, &outliers.unbearable})
    for (const Index row : *rows)
      is_outlier[row] = true;
  Eigen::AlignedBox3d box;
  std::size_t count = 0;
  for (std::size_t row = 0; row < positions.size (); ++row)
    if (positions[row].allFinite () && !is_outlier[row]) {
      box.extend (positions[row]);
      ++count;
    }
  const double diagonal = box.isEmpty () ? 0.0 : box.diagonal ().stableNorm ();
  if (!(diagonal > 0.0 && std::isfinite (diagonal)))
    return Eigen::Vector3d::Zero ();
  const double largest =
      std::max (box.min ().cwiseAbs ().maxCoeff (), box.max ().cwiseAbs ().maxCoeff ());
  const double float_step = largest * static_cast<double> (std::numeric_limits<float>::epsilon ());
  if (float_step < FINE * diagonal / std::sqrt (static_cast<double> (count)))
    return Eigen::Vector3d::Zero ();
  const double unit = std::pow (10.0, std::floor (std::log10 (diagonal)));
  return (unit * (box.center () / unit).array ().round () + 0.0).matrix (); // no -0
}

void
shiftOrigin (CommandLine& line, Cloud& cloud, Input& input)
{
  // Unless doubles are asked for, floats are written: near zero they are fine enough.
  line.auto_shift |= !line.shift && line.precision == Precision::AUTO && !cloud.single_precision;
  if (line.auto_shift)
    cloud.shift = chooseShift (input.positions, line.options.threads);
  else if (line.shift)
    cloud.shift = *line.shift;
  if (cloud.shift.isZero (0.0))
    return;
  Eigen::Map<Eigen::Vector3d> (input.shift.data ()) = cloud.shift;
  for (Eigen::Vector3d& position : input.positions)
    position -= cloud.shift;
  Eigen::Map<Eigen::Vector3d> (line.options.view.viewpoint.data ()) -= cloud.shift;
  Eigen::Map<Eigen::Vector3d> sensor_origin (input.sensor_origin.data ());
  if (!sensor_origin.isZero (0.0)) // else it is one that nobody told
    sensor_origin -= cloud.shift;
}

} // namespace

Input
prepareInput (CommandLine& line, Cloud& cloud, RunFigures& figures, double kept_per_point)
{
  checkMemory (line, cloud.size (), kept_per_point);
  Input input;
  input.positions.reserve (cloud.size ());
  input.cloud_size = cloud.size ();
  input.sensor_origin = cloud.sensor_origin;
  for (std::size_t row = 0; row < cloud.size (); ++row)
    if (!cloud.isLeftOut (row)) {
      input.positions.push_back (cloud.position (row));
      input.cloud_index.push_back (static_cast<std::uint32_t> (row));
    }
  giveBackMappedFiles ();
  takeNormals (line, cloud, input);
  warnOfDegrees (input.positions, cloud);
  shiftOrigin (line, cloud, input);
  Eigen::Map<Eigen::Vector3d> (figures.shift.data ()) = cloud.shift;
  figures.notes = cloud.notes;
  figures.input_points = cloud.size ();
  figures.single_precision = cloud.single_precision;
  for (const Field& field : cloud.fields)
    figures.input_fields.push_back (field.name);
  return input;
}

} // namespace pcl::floater
