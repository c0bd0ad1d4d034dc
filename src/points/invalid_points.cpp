// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/order_statistics.h"
#include "points/outliers.h"

namespace pcl::floater {
namespace {
// Thresholds here are chosen by hand, far from what real surfaces have.
constexpr std::size_t FEWEST_PIXELS = 10; // points at one place, or in cells of the height 0
constexpr double NEAR_PLACE = 0.01; // of the range of the next point, and of most: all are within

// The pixels without a return at a place: points within a range of it (the largest coordinate
// difference), nearest first.
// \param fewest of them
// \param most   the range within which most points are
std::vector<std::pair<double, Index>>
pixelsAt (const Positions& positions, const Vector3d& place, double range, double fewest,
          double most)
{
  constexpr double APART = 3.0; // range of the next point, in spacings of a flat sheet of that size
  std::vector<std::pair<double, Index>> points;
  double beyond = std::numeric_limits<double>::infinity ();
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (!positions[row].allFinite ())
      continue;
    const double here = (positions[row] - place).lpNorm<Eigen::Infinity> ();
    if (here <= range)
      points.emplace_back (here, static_cast<Index> (row));
    else
      beyond = std::min (beyond, here);
  }
  std::sort (points.begin (), points.end ());
  const auto size = static_cast<double> (positions.size ());
  const double spacing = 2.0 * most / std::sqrt (size);
  for (; static_cast<double> (points.size ()) >= fewest; points.pop_back ()) {
    const double last = points.back ().first;
    // A small object among far ones is larger than their spacing, or most of the cloud.
    if (std::isfinite (beyond) && last <= NEAR_PLACE * beyond && beyond > APART * spacing &&
        (last == 0.0 || (last <= spacing && 2.0 * static_cast<double> (points.size ()) < size)))
      return points;
    beyond = last;
  }
  return {};
}

void
findPixels (const Positions& positions, const Positions& sample, const Vector3d& origin,
            InvalidPoints& found)
{
  constexpr double OTHERS = 5.0; // times as many as at any other place, at least
  constexpr double SHARE = 5e-3; // of the cloud, away from the origin, at least
  const auto size = static_cast<double> (positions.size ());
  // The place that most points of the sample have, how many have it, and the next.
  Vector3d frequent = Vector3d::Zero ();
  std::size_t most_often = 0, second = 0;
  for (std::size_t begin = 0, end = 0; begin < sample.size (); begin = end) {
    while (end < sample.size () && sample[end] == sample[begin])
      ++end;
    const std::size_t count = end - begin;
    second = std::max (second, std::min (count, most_often));
    if (count > most_often) {
      most_often = count;
      frequent = sample[begin];
    }
  }
  for (const Vector3d& place : {origin, frequent}) {
    const bool is_origin = place == origin;
    const std::size_t others = place == frequent ? second : most_often; // of the sample
    double fewest = static_cast<double> (FEWEST_PIXELS);
    if (others > 1) // a single one tells nothing
      fewest = std::max (fewest, OTHERS * static_cast<double> (others) * size /
                                     static_cast<double> (sample.size ()));
    if (!is_origin)
      fewest = std::max (fewest, SHARE * size);
    std::vector<double> ranges;
    for (const Vector3d& position : sample)
      ranges.push_back ((position - place).lpNorm<Eigen::Infinity> ());
    const double most = quantile (ranges, 0.75); // three quarters of the points are within
    const auto pixels =
        pixelsAt (positions, place, is_origin ? NEAR_PLACE * most : 0.0, fewest, most);
    for (const auto& pixel : pixels)
      found.pixels.push_back (pixel.second);
    found.place = place;
    if (!pixels.empty ())
      return;
  }
}

// Cells without data have the lowest or the highest z.
void
findCells (const Positions& positions, const Eigen::AlignedBox3d& box, double shift,
           InvalidPoints& found)
{
  constexpr double GAP = 1.0; // to the others, in extents of these
  // The same of the height 0, which may be a floor, and the least height of the others then.
  constexpr double ZERO_GAP = 3.0, ZERO_HEIGHT = 100.0;
  constexpr double FLOAT = std::numeric_limits<float>::max ();
  constexpr double ROUNDING = 1e-9; // relative, of the shift
  constexpr std::array<double, 11> VALUES{-FLOAT, -32768.0, -32767.0, -99999.0, -9999.0, -999.0,
                                          0.0,    9999.0,   99999.0,  32767.0,  FLOAT};
  const auto isAt = [shift] (const Vector3d& position, double value) {
    const double z = position.z () + shift;
    return std::abs (z - value) <= ROUNDING * std::max (std::abs (value), std::abs (shift));
  };
  for (const double value : VALUES) {
    if (!isAt (box.min (), value) && !isAt (box.max (), value))
      continue;
    std::vector<Index> cells;
    std::vector<double> heights; // of the others
    for (std::size_t row = 0; row < positions.size (); ++row)
      if (isAt (positions[row], value) && positions[row].allFinite ())
        cells.push_back (static_cast<Index> (row));
      else if (positions[row].allFinite ())
        heights.push_back (positions[row].z ());
    if (heights.empty ())
      return;
    std::sort (heights.begin (), heights.end ());
    const double low = heights.front () + shift, high = heights.back () + shift;
    const double gap = std::max (low - value, value - high);
    bool are_cells = high > low && gap > GAP * (high - low);
    if (value == 0.0 && are_cells) { // it may be a floor with boxes on it
      const auto distinct = std::unique (heights.begin (), heights.end ()) - heights.begin ();
      are_cells = gap > ZERO_GAP * (high - low) && gap >= ZERO_HEIGHT &&
                  cells.size () >= FEWEST_PIXELS && cells.size () < heights.size () &&
                  static_cast<std::size_t> (distinct) > FEWEST_PIXELS;
    }
    if (!are_cells)
      continue;
    found.cells = std::move (cells);
    found.height = value;
    found.gap = gap;
    return;
  }
}

} // namespace

InvalidPoints
findInvalidPoints (const Positions& positions, const Vector3d& shift)
{
  InvalidPoints found;
  Eigen::AlignedBox3d box;
  for (const Vector3d& position : positions)
    if (position.allFinite ())
      box.extend (position);
  constexpr std::size_t LOOKED_AT = 2000;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / LOOKED_AT);
  Positions sample; // by their coordinates
  for (std::size_t row = 0; row < positions.size (); row += step)
    if (positions[row].allFinite ())
      sample.push_back (positions[row]);
  std::sort (sample.begin (), sample.end (), [] (const auto& a, const auto& b) {
    return std::lexicographical_compare (a.begin (), a.end (), b.begin (), b.end ());
  });
  if (sample.empty () || positions.size () <= FEWEST_PIXELS)
    return found;
  findPixels (positions, sample, Vector3d (-shift), found);
  if (found.pixels.empty ())
    findCells (positions, box, shift.z (), found);
  return found;
}

} // namespace pcl::floater
