// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/coordinate_grid.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
constexpr std::size_t SAMPLED = 1U << 17;  // points
constexpr std::size_t FIRST_OF = 128;      // one in this many of these is tested first
constexpr std::size_t FEWEST_SAMPLED = 21; // fewest points for a result
constexpr double COARSE = 0.1;             // spacings
constexpr double FINER_THAN_RASTER = 0.4;  // spacings; the step of a raster is 0.5 and more
constexpr double COINCIDENT_SHARE = 0.1;   // share of the points
constexpr double ALIKE = 0.01;             // relative difference of steps that count as equal
constexpr double REGULAR = 0.99;           // of the differences are multiples of the step

// Coordinates of all points along one axis, in the frame of the points.
struct AxisGrid
{
  double step = 0.0;                   // 0: there is no grid
  double finest = 0.0, coarsest = 0.0; // distances of 32-bit floats of this size, in this frame
};

// Distance from a number that is not negative to the next larger 32-bit float.
double
floatStep (double size)
{
  constexpr double LARGEST = std::numeric_limits<float>::max ();
  if (size >= LARGEST)
    return std::numeric_limits<double>::infinity ();
  const auto number = static_cast<float> (size);
  return static_cast<double> (std::nextafter (number, std::numeric_limits<float>::infinity ())) -
         static_cast<double> (number);
}

// Points at equal distances along the curve, which do not depend on the order of the cloud.
// \param one_of takes one in this many
std::vector<double>
sortedCoordinates (const Points& points, int axis, std::size_t one_of)
{
  const std::size_t stride = one_of * ((points.size () + SAMPLED - 1) / SAMPLED);
  std::vector<double> values;
  values.reserve (points.size () / stride + 1);
  for (std::size_t p = 0; p < points.size (); p += stride)
    values.push_back (points.ownPositions ()[p][axis]);
  sortUnique (values);
  return values;
}

double
smallestStep (const std::vector<double>& values)
{
  double step = std::numeric_limits<double>::infinity ();
  for (std::size_t i = 1; i < values.size (); ++i)
    step = std::min (step, values[i] - values[i - 1]);
  return step;
}

AxisGrid
lookAlong (const Points& points, int axis)
{
  const std::vector<double> values = sortedCoordinates (points, axis, 1);
  AxisGrid grid;
  if (values.size () < 2)
    return grid;
  const auto inCloud = [&] (double value) { return points.centre[axis] + points.scale * value; };
  const double first = inCloud (values.front ()), last = inCloud (values.back ());
  const double nearest = std::max ({first, -last, 0.0}); // to zero
  grid.finest = floatStep (nearest) / points.scale;
  grid.coarsest = floatStep (std::max (-first, last)) / points.scale;
  const double step = smallestStep (values);
  std::size_t multiples = 0;
  for (std::size_t i = 1; i < values.size (); ++i) {
    const double ratio = (values[i] - values[i - 1]) / step;
    multiples += std::abs (ratio - std::round (ratio)) <= ALIKE * std::max (1.0, ratio) ? 1 : 0;
  }
  if (static_cast<double> (multiples) >= REGULAR * static_cast<double> (values.size () - 1))
    grid.step = step;
  return grid;
}

bool
areAlike (double a, double b)
{
  return std::abs (a - b) <= ALIKE * b;
}

// Whether the step comes from 32-bit floats, not from a raster that happens to have it.
bool
isFloatStep (const std::array<AxisGrid, 3>& grids, const AxisGrid& grid, double scale)
{
  const double step = scale * grid.step;
  const double nearest = std::ldexp (1.0, static_cast<int> (std::lround (std::log2 (step))));
  return areAlike (step, nearest) && grid.step > (1.0 - ALIKE) * grid.finest &&
         grid.step < (1.0 + ALIKE) * grid.coarsest &&
         std::none_of (grids.begin (), grids.end (), [&] (const AxisGrid& other) {
           return areAlike (other.step, grid.step) && grid.step > 1.5 * other.coarsest;
         });
}

} // namespace

CoordinateGrid
findCoordinateGrid (const Points& points, const std::vector<float>& spacing, const RunContext& run)
{
  CoordinateGrid found;
  if (points.size () < FEWEST_SAMPLED)
    return found;
  std::vector<float> spacings = spacing;
  const auto usual = static_cast<double> (median (spacings));
  // If some points have a smaller step along every axis, no grid is coarse.
  bool may_be_coarse = false;
  for (int axis = 0; axis < 3 && !may_be_coarse; ++axis)
    may_be_coarse = smallestStep (sortedCoordinates (points, axis, FIRST_OF)) >= COARSE * usual;
  if (!may_be_coarse)
    return found;
  std::array<AxisGrid, 3> grids;
  parallelTasks (run, grids.size (), [&] (std::size_t axis) {
    grids[axis] = lookAlong (points, static_cast<int> (axis));
  });
  const bool is_alike_along_all =
      std::all_of (grids.begin (), grids.end (), [&grids] (const AxisGrid& grid) {
        return grid.step > 0.0 && areAlike (grid.step, grids[0].step);
      });
  const auto coincident = static_cast<double> (points.duplicates.size ());
  const bool many_coincide =
      coincident > COINCIDENT_SHARE * (coincident + static_cast<double> (points.size ()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisGrid& grid = grids[axis];
    const double ratio = usual > 0.0 ? grid.step / usual : 0.0;
    if (ratio < COARSE || ratio <= found.spacings)
      continue;
    const bool is_float = isFloatStep (grids, grid, points.scale);
    if (is_float || (is_alike_along_all && (ratio < FINER_THAN_RASTER || many_coincide)))
      found = {static_cast<int> (axis), points.scale * grid.step, ratio, is_float};
  }
  return found;
}

} // namespace pcl::floater
