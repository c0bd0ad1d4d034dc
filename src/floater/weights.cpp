// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/weights.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
// tan (alpha / 2) of a sector of half a turn, or nearly: the centre lies on the segment between two
// neighbours, and their weights exceed all others without limit. Any large value reproduces the
// centre up to an error of its reciprocal; a much larger one would decouple these two neighbours
// from the rest.
constexpr double LARGEST_TANGENT = 1e8;

// Sine or half tangent below which directions count as equal or opposite.
constexpr double SAME_DIRECTION = 1e-9;

// One star in contiguous memory, which is reused.
struct LocalStar
{
  std::vector<Vector2d> directions; // unit vectors
  std::vector<double> lengths;      // relative to the longest, at least SMALLEST_WEIGHT
  bool closed = false;

  std::size_t size () const { return directions.size (); }
  // Twice the signed area of the triangle of the centre and two neighbours.
  double area (std::size_t i, std::size_t j) const
  {
    return lengths[i] * lengths[j] * cross (directions[i], directions[j]);
  }

  // \return false if the star has no extent, or an infinite one
  bool assign (const Vector2d* offsets, std::size_t count, bool is_closed)
  {
    closed = is_closed;
    directions.resize (count);
    lengths.resize (count);
    double longest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      lengths[i] = offsets[i].norm ();
      longest = std::max (longest, lengths[i]);
    }
    if (!(longest > 0.0) || !std::isfinite (longest))
      return false;
    for (std::size_t i = 0; i < count; ++i) {
      directions[i] = lengths[i] > 0.0 ? Vector2d (offsets[i] / lengths[i]) : Vector2d::Zero ();
      lengths[i] = std::max (lengths[i] / longest, SMALLEST_WEIGHT);
    }
    return true;
  }
};

// tan (alpha / 2) = sin / (1 + cos) = (1 - cos) / sin. The sine is an absolute value, since rounding may
// give it the wrong sign in sectors next to 0 or pi.
double
halfTangentBetween (const Vector2d& a, const Vector2d& b)
{
  const double sine = std::abs (cross (a, b)), cosine = a.dot (b);
  if (cosine >= 0.0)
    return sine / (1.0 + cosine);
  return 1.0 - cosine < LARGEST_TANGENT * sine ? (1.0 - cosine) / sine : LARGEST_TANGENT;
}

// Gives each of several neighbours in one direction the mean of their weights. Only their sum
// matters to reproduce the centre; rounding would give it to some of them and disconnect the
// others.
void
shareInDirections (const LocalStar& star, double* weights)
{
  const std::size_t count = star.size ();
  const auto same = [&star] (std::size_t i, std::size_t j) {
    return halfTangentBetween (star.directions[i], star.directions[j]) < SAME_DIRECTION;
  };
  std::size_t start = 0; // a neighbour that is the first in its direction
  while (start < count && same (start == 0 ? count - 1 : start - 1, start))
    ++start;
  for (std::size_t step = 0; step < count;) {
    const std::size_t first = start + step;
    std::size_t length = 1;
    double sum = weights[first % count];
    while (step + length < count && same ((first + length - 1) % count, (first + length) % count))
      sum += weights[(first + length++) % count];
    for (std::size_t i = 0; i < length; ++i)
      weights[(first + i) % count] = sum / static_cast<double> (length);
    step += length;
  }
}

// Equation (2). \param[in,out] weights all 0 before
void
meanValue (const LocalStar& star, double* weights)
{
  const std::size_t count = star.size ();
  bool shared_direction = false;
  for (std::size_t i = 0; i < (star.closed ? count : count - 1); ++i) {
    const std::size_t j = i + 1 == count ? 0 : i + 1;
    const double tangent = halfTangentBetween (star.directions[i], star.directions[j]);
    shared_direction = shared_direction || tangent < SAME_DIRECTION;
    weights[i] += tangent;
    weights[j] += tangent;
  }
  if (shared_direction)
    shareInDirections (star, weights);
  for (std::size_t i = 0; i < count; ++i)
    weights[i] /= star.lengths[i];
}

// Floater 1997, section 6: the ray from a neighbour through the centre leaves the star by an edge.
// That edge and the neighbour make a triangle around the centre. The weights are the barycentric
// coordinates of the centre in these triangles, averaged over the neighbours. The edge goes round
// once while the neighbour does, so this takes linear time.
// \param[in,out] weights all 0 before
void
shapePreserving (const LocalStar& star, double* weights)
{
  const std::size_t count = star.size ();
  const auto isBefore = [&] (std::size_t i, std::size_t j) {
    // True if j is still on the near side of the line through i and the centre.
    const double sine = cross (star.directions[i], star.directions[j]);
    return sine > 0.0 ||
           (sine > -SAME_DIRECTION && star.directions[i].dot (star.directions[j]) > 0.0);
  };
  const auto isOpposite = [&] (std::size_t i, std::size_t j) {
    return star.directions[i].dot (star.directions[j]) < 0.0 &&
           std::abs (cross (star.directions[i], star.directions[j])) < SAME_DIRECTION;
  };
  // Offset of the end of the opposite edge from i, never the next neighbour. If that one is exactly
  // opposite, the triangle with the neighbour after it gives the same coordinates and has an area.
  std::size_t steps = 2;
  for (std::size_t i = 0; i < count; ++i) {
    steps = std::max<std::size_t> (steps, 3) - 1;
    while (steps + 1 < count && isBefore (i, (i + steps) % count))
      ++steps;
    const std::size_t last = (i + steps) % count;
    const std::size_t first = last == 0 ? count - 1 : last - 1;
    // If an end of the edge is exactly opposite, both ends may lie in one direction: a triangle
    // without area.
    const std::size_t across = isOpposite (i, last) ? last : first;
    if (across != i && isOpposite (i, across)) {
      const double whole = star.lengths[i] + star.lengths[across];
      weights[i] += star.lengths[across] / whole;
      weights[across] += star.lengths[i] / whole;
      continue;
    }
    const double at_i = std::max (0.0, star.area (first, last));
    const double at_first = std::max (0.0, star.area (last, i));
    const double at_last = std::max (0.0, star.area (i, first));
    const double sum = at_i + at_first + at_last;
    if (!(sum > 0.0))
      continue; // no area: all three are on one line through the centre
    weights[i] += at_i / sum;
    weights[first] += at_first / sum;
    weights[last] += at_last / sum;
  }
}

// Makes the weights of a star positive, with sum 1; equal if they are all 0.
void
normalize (double* weights, std::size_t count)
{
  const double largest = *std::max_element (weights, weights + count);
  if (!(largest > 0.0)) {
    std::fill (weights, weights + count, 1.0 / static_cast<double> (count));
    return;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    weights[i] = std::max (weights[i] / largest, SMALLEST_WEIGHT);
    sum += weights[i];
  }
  for (std::size_t i = 0; i < count; ++i)
    weights[i] /= sum;
}

} // namespace

std::vector<double>
computeWeights (const Stars& stars, Weighting weighting, const RunContext& run)
{
  std::vector<double> weights (stars.neighbors.ids.size ());
  parallelPoints<LocalStar> (run, stars.neighbors.rows (), [&] (Index p, LocalStar& star) {
    const std::size_t first = stars.neighbors.offsets[p], count = stars.neighbors.row (p).size ();
    if (count == 0)
      return;
    double* row = weights.data () + first;
    if (weighting != Weighting::UNIFORM &&
        star.assign (stars.offsets_in_plane.data () + first, count, stars.open[p] == 0)) {
      if (weighting == Weighting::INVERSE_DISTANCE)
        std::transform (star.lengths.begin (), star.lengths.end (), row,
                        [] (double length) { return 1.0 / length; });
      else if (weighting == Weighting::SHAPE_PRESERVING && star.closed && count >= 3)
        shapePreserving (star, row);
      else
        meanValue (star, row);
    }
    normalize (row, count);
  });
  return weights;
}

} // namespace pcl::floater
