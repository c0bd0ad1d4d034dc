// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/invalid_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using PositionList = std::vector<Eigen::Vector3d>;

// Some points, by their coordinates.
PositionList
samplePositions (const PositionList& positions)
{
  constexpr std::size_t LOOKED_AT = 2000;
  PositionList sample;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / LOOKED_AT);
  for (std::size_t row = 0; row < positions.size (); row += step)
    if (positions[row].allFinite ())
      sample.push_back (positions[row]);
  std::sort (sample.begin (), sample.end (), [] (const auto& a, const auto& b) {
    return std::lexicographical_compare (a.begin (), a.end (), b.begin (), b.end ());
  });
  return sample;
}

// The place that most points of a sample have, and how many have it, and the next.
struct FrequentPlace
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero ();
  std::size_t count = 0, second_count = 0;
};

FrequentPlace
findFrequent (const PositionList& sample)
{
  FrequentPlace found;
  for (std::size_t begin = 0, end = 0; begin < sample.size (); begin = end) {
    while (end < sample.size () && sample[end] == sample[begin])
      ++end;
    const std::size_t count = end - begin;
    found.second_count = std::max (found.second_count, std::min (count, found.count));
    if (count > found.count) {
      found.count = count;
      found.place = sample[begin];
    }
  }
  return found;
}

// A range from a place within which three quarters of the points are.
double
rangeOfMost (const PositionList& sample, const Eigen::Vector3d& place)
{
  std::vector<double> ranges;
  for (const Eigen::Vector3d& position : sample)
    ranges.push_back ((position - place).lpNorm<Eigen::Infinity> ());
  const auto most = ranges.begin () + static_cast<std::ptrdiff_t> (3 * ranges.size () / 4);
  std::nth_element (ranges.begin (), most, ranges.end ());
  return *most;
}

// Points by their range from a place (the largest coordinate difference), up to a limit, and the range of the next one.
struct NearPoints
{
  std::vector<std::pair<double, Index>> points; // ascending
  double next = std::numeric_limits<double>::infinity ();
};

NearPoints
findNearby (const PositionList& positions, const Eigen::Vector3d& place, double limit)
{
  NearPoints nearby;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (!positions[row].allFinite ())
      continue;
    const double range = (positions[row] - place).lpNorm<Eigen::Infinity> ();
    if (range <= limit)
      nearby.points.emplace_back (range, static_cast<Index> (row));
    else if (range < nearby.next)
      nearby.next = range;
  }
  std::sort (nearby.points.begin (), nearby.points.end ());
  return nearby;
}

// How many of the nearest points are pixels without a return.
std::size_t
countPixels (const NearPoints& nearby, std::size_t fewest, double spacing, std::size_t size,
             const InvalidPointLimits& limits)
{
  const auto& points = nearby.points;
  for (std::size_t count = points.size (); count >= fewest; --count) {
    const double range = points[count - 1].first;
    const double next = count < points.size () ? points[count].first : nearby.next;
    // A small object among far ones is larger than their spacing, or most of the cloud.
    if (std::isfinite (next) && range <= limits.near * next && next > limits.apart * spacing &&
        (range == 0.0 || (range <= spacing && 2 * count < size)))
      return count;
  }
  return 0;
}

void
findPixels (const PositionList& positions, const PositionList& sample,
            const Eigen::Vector3d& origin, const InvalidPointLimits& limits, InvalidPoints& found)
{
  const auto size = static_cast<double> (positions.size ());
  const FrequentPlace frequent = findFrequent (sample);
  for (const Eigen::Vector3d& place : {origin, frequent.place}) {
    const bool is_origin = place == origin;
    const std::size_t others =
        place == frequent.place ? frequent.second_count : frequent.count; // of the sample
    double fewest = static_cast<double> (limits.fewest);
    if (others > 1) // a single one tells nothing
      fewest = std::max (fewest, limits.others * static_cast<double> (others) * size /
                                     static_cast<double> (sample.size ()));
    if (!is_origin)
      fewest = std::max (fewest, limits.share * size);
    const double most = rangeOfMost (sample, place);
    const NearPoints nearby = findNearby (positions, place, is_origin ? limits.near * most : 0.0);
    const std::size_t count =
        countPixels (nearby, static_cast<std::size_t> (std::ceil (fewest)),
                     2.0 * most / std::sqrt (size), positions.size (), limits);
    for (std::size_t i = 0; i < count; ++i)
      found.pixels.push_back (nearby.points[i].second);
    found.place = place;
    if (count > 0)
      return;
  }
}

// Cells without data have the lowest or the highest z.
void
findCells (const PositionList& positions, const Eigen::AlignedBox3d& box, double shift,
           const InvalidPointLimits& limits, InvalidPoints& found)
{
  constexpr double FLOAT = std::numeric_limits<float>::max ();
  constexpr double ROUNDING = 1e-9; // relative, of the shift
  constexpr std::array<double, 11> VALUES{-FLOAT, -32768.0, -32767.0, -99999.0, -9999.0, -999.0,
                                          0.0,    9999.0,   99999.0,  32767.0,  FLOAT};
  const auto isAt = [shift] (const Eigen::Vector3d& position, double value) {
    const double z = position.z () + shift;
    return std::abs (z - value) <= ROUNDING * std::max (std::abs (value), std::abs (shift));
  };
  for (const double value : VALUES) {
    if (!isAt (box.min (), value) && !isAt (box.max (), value))
      continue;
    Eigen::AlignedBox3d others;
    std::vector<Index> cells;
    std::vector<double> heights;
    for (std::size_t row = 0; row < positions.size (); ++row)
      if (positions[row].allFinite ()) {
        if (isAt (positions[row], value)) {
          cells.push_back (static_cast<Index> (row));
          continue;
        }
        others.extend (positions[row]);
        if (value == 0.0)
          heights.push_back (positions[row].z ());
      }
    if (others.isEmpty ())
      return;
    const double low = others.min ().z () + shift, high = others.max ().z () + shift;
    const double gap = std::max (low - value, value - high);
    bool are_cells = high > low && gap > limits.gap * (high - low);
    if (value == 0.0 && are_cells) { // it may be a floor with boxes on it
      std::sort (heights.begin (), heights.end ());
      const auto distinct = std::unique (heights.begin (), heights.end ()) - heights.begin ();
      are_cells = gap > limits.zero_gap * (high - low) && gap >= limits.zero_height &&
                  cells.size () >= limits.fewest && cells.size () < heights.size () &&
                  static_cast<std::size_t> (distinct) > limits.fewest;
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
findInvalidPoints (const PositionList& positions, const Eigen::Vector3d& shift,
                   const InvalidPointLimits& limits)
{
  InvalidPoints found;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions)
    if (position.allFinite ())
      box.extend (position);
  const PositionList sample = samplePositions (positions);
  if (sample.empty () || positions.size () <= limits.fewest)
    return found;
  findPixels (positions, sample, Eigen::Vector3d (-shift), limits, found);
  if (found.pixels.empty ())
    findCells (positions, box, shift.z (), limits, found);
  return found;
}

} // namespace pcl::floater
