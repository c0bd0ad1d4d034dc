// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/coordinate_grid.h"

#include "core/order_statistics.h"

namespace pcl::floater {
namespace {
constexpr std::size_t SAMPLED = 4096;      // points; of coordinates that are not rounded, the two
                                           // nearest differ by less than a coarse step
constexpr std::size_t FEWEST_SAMPLED = 21; // fewest points for a result
constexpr double COARSE = 0.1;             // spacings
constexpr double FINER_THAN_RASTER = 0.4;  // spacings; the step of a raster is 0.5 and more
constexpr double COINCIDENT_SHARE = 0.1;   // share of the points
constexpr double ALIKE = 0.01;             // relative difference of steps that count as equal

// Coordinates along one axis, in units of the cloud.
struct AxisGrid
{
  double step = std::numeric_limits<double>::infinity (); // smallest difference
  double finest = 0.0, coarsest = 0.0;                    // distances of 32-bit floats of this size
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

// Of points at equal distances along the curve, which do not depend on the order of the cloud.
AxisGrid
lookAlong (const Points& points, int axis)
{
  std::vector<double> values;
  for (std::size_t p = 0; p < points.size (); p += (points.size () - 1) / SAMPLED + 1)
    values.push_back (points.inCloud (static_cast<Index> (p))[axis]);
  std::sort (values.begin (), values.end ());
  const double first = values.front (), last = values.back ();
  AxisGrid grid;
  grid.finest = floatStep (std::max ({first, -last, 0.0}));
  grid.coarsest = floatStep (std::max (-first, last));
  // Even n points on a line are an n-th of its length apart. Differences of less than ALIKE of a coarse
  // step there are rounding.
  const double rounding = ALIKE * COARSE * (last - first) / static_cast<double> (points.size ());
  for (std::size_t i = 1; i < values.size (); ++i)
    if (const double step = values[i] - values[i - 1]; step > rounding)
      grid.step = std::min (grid.step, step);
  return grid;
}

bool
areAlike (double a, double b)
{
  return std::abs (a - b) <= ALIKE * b;
}

// Whether the step comes from 32-bit floats, not from a raster that happens to have it.
bool
isFloatStep (const std::array<AxisGrid, 3>& grids, const AxisGrid& grid)
{
  const double nearest = std::ldexp (1.0, static_cast<int> (std::lround (std::log2 (grid.step))));
  return areAlike (grid.step, nearest) && grid.step > (1.0 - ALIKE) * grid.finest &&
         grid.step < (1.0 + ALIKE) * grid.coarsest &&
         std::none_of (grids.begin (), grids.end (), [&] (const AxisGrid& other) {
           return areAlike (other.step, grid.step) && grid.step > 1.5 * other.coarsest;
         });
}

} // namespace

CoordinateGrid
findCoordinateGrid (const Points& points, const std::vector<float>& spacing)
{
  CoordinateGrid found;
  if (points.size () < FEWEST_SAMPLED)
    return found;
  std::vector<float> spacings = spacing;
  const double usual = points.scale * static_cast<double> (median (spacings));
  const std::array<AxisGrid, 3> grids{lookAlong (points, 0), lookAlong (points, 1),
                                      lookAlong (points, 2)};
  const bool are_alike =
      std::all_of (grids.begin (), grids.end (),
                   [&grids] (const AxisGrid& grid) { return areAlike (grid.step, grids[0].step); });
  const auto coincident = static_cast<double> (points.duplicates.size ());
  const bool many_coincide =
      coincident > COINCIDENT_SHARE * (coincident + static_cast<double> (points.size ()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = grids[axis].step, ratio = usual > 0.0 ? step / usual : 0.0;
    if (!std::isfinite (ratio) || ratio < COARSE || ratio <= found.spacings)
      continue;
    const bool is_float = isFloatStep (grids, grids[axis]);
    if (is_float || (are_alike && (ratio < FINER_THAN_RASTER || many_coincide)))
      found = {static_cast<int> (axis), step, ratio, is_float};
  }
  return found;
}

} // namespace pcl::floater
