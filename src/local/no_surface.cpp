// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/no_surface.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "local/star_reach.h"

#include <map>

namespace pcl::floater {
namespace {
// Share of the points that lie on a line with their neighbours, or in turns.
constexpr double ON_LINES = 0.9;

// Number of points of a turn whose step to the next point is about as large as most steps.
std::size_t
evenSteps (std::vector<double> angles)
{
  // How far a step may be from the median; 7 % of the steps of strewn points are within it, 62 % of
  // a golden spiral's.
  constexpr double EVEN_STEP = 0.1;
  std::sort (angles.begin (), angles.end ());
  std::vector<double> steps{angles.front () + 2.0 * PI - angles.back ()};
  for (std::size_t i = 1; i < angles.size (); ++i)
    steps.push_back (angles[i] - angles[i - 1]);
  const double usual = median (steps);
  const auto isEven = [&] (double s) { return std::abs (s - usual) < EVEN_STEP * usual; };
  return static_cast<std::size_t> (std::count_if (steps.begin (), steps.end (), isEven));
}

// The axis of a sensor that turns about it, if nearly all points lie in turns.
std::optional<int>
findTurnAxis (const Positions& positions, const Vector3d& origin, const CsrLists& neighbors,
              std::size_t nearest, std::size_t stride)
{
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t looked_at = 0, alone = 0;
    for (std::size_t p = 0; p < positions.size (); p += stride, ++looked_at) {
      const Row row = neighbors.first (static_cast<Index> (p), nearest);
      alone += std::all_of (row.begin (), row.end (),
                            [&] (Index q) { return positions[q][axis] == positions[p][axis]; });
    }
    if (2 * alone < looked_at)
      continue;
    std::map<double, std::vector<double>> turns;
    for (const Vector3d& position : positions) {
      const Vector3d ray = position - origin;
      turns[position[axis]].push_back (std::atan2 (ray[(axis + 2) % 3], ray[(axis + 1) % 3]));
    }
    std::size_t even = 0;
    for (auto& [height, angles] : turns)
      even += evenSteps (std::move (angles));
    if (static_cast<double> (even) >= ON_LINES * static_cast<double> (positions.size ()))
      return axis;
  }
  return {};
}

// Thresholds of scatter. Measures of a point: its unevenness and its dimension (see Noise), and the
// share of the triangles of the stars around it that are in the stars of all their corners.
// Measured on 24 generated families of 1.4 million points. Points strewn into volumes and lattices
// have an unevenness of 0.49 or more and a share of 0.49 or less, leaves 0.25 to 0.6 and 0.2 to
// 0.85. Sheets with noise of one spacing have 0.37 or less; thin walls, edges and contacts 0.5 or
// less, with a share of 0.4 or more. Neither measure tells these apart, nor both of them at single
// points. Regions of thin, noisy things, such as legs, ears and heads with eyes inside, look the
// same by both, but only a volume has more than two dimensions.
constexpr double STRONG_SHARE = 0.6;    // of agreeing triangles; at most so many at a strong point
constexpr double WEAK_UNEVENNESS = 0.2; // a point may be scatter from here on, ...
constexpr double WEAK_SHARE = 0.9;      // ... and with at most this share
constexpr std::size_t LEAST_STRONG = 250; // strong points of a region
// Mean of the strong points of a region that certainly is scatter: of their dimension, or of the
// one to expect at the next scale, by what it has grown since the scale before. Half way between
// surface and volume. Volumes, lattices, leaves and trees of more than 800 points have 2.57 or
// more; smaller trees 1.5 to 2.5, since the outside of a small volume counts. 16 models of 800 to
// 37,000 points with noise of up to 0.5 spacings have 2.48 or less, sheets with noise of up to 3,
// and two near ones, 2.52.
constexpr double DIMENSION = 2.55;
// Less is enough for a region whose strong points mostly are not noisy, a tree for instance. The
// noise of a sheet or body falls with the scale: these models have 0.72 or less.
constexpr double DIMENSION_IF_NOT_NOISY = 2.31, NOT_NOISY = 0.75;
// Spacing, in medians of the cloud, from which on a point is far: such triangles have 64 times the
// area, so that 2 % of them are more than half of a mesh. And that of points that may belong to a
// region of far ones.
constexpr double FAR_SPACING = 8.0, AROUND_FAR = 2.0;
// Share at far points on no surface. Points strewn into a cone have 0.28 to 0.35 on average, coarse
// walls, terrain and balls with noise of up to 0.3 of their spacings 0.54 or more. Points that are far and
// have so little must have half of the area of a region: a noisy surface that grows coarser has less.
constexpr double FAR_SHARE = 0.45;
constexpr std::size_t LEAST_FAR = 10; // points of a region, so that the half is certain

// Share of the triangles of a star that are in the stars of all their corners.
float
agreeingShare (const Stars& stars, Index p)
{
  std::size_t triangles = 0, agreeing = 0;
  anyTriangle (stars, p, [&] (Index q, Index r) {
    ++triangles;
    agreeing += hasTriangle (stars, q, r, p) && hasTriangle (stars, r, p, q) ? 1 : 0;
    return false;
  });
  return triangles == 0 ? 0.0F : static_cast<float> (agreeing) / static_cast<float> (triangles);
}

} // namespace

std::optional<double>
findCurves (const Positions& positions, const Vector3d& origin, const LocalGeometry& geometry,
            std::size_t neighbors, const RunContext& run)
{
  // At most this share of the points is joined to another curve. Parallel lines on a wavy sheet, up
  // to 30 times as far apart as their points, have 0.91 or more of their points joined, 40 times
  // 0.67, 60 times 0.42; single curves 0.02 or less, profiles with corners 20 to 40 times as far
  // apart up to 0.28.
  constexpr double JOINED = 0.35;
  constexpr std::size_t SAMPLES = 1000;     // points looked at
  constexpr std::size_t LEAST_POINTS = 100; // fewer lie along lines by chance
  const std::size_t n = positions.size (), stride = n / SAMPLES + 1;
  if (n < LEAST_POINTS)
    return {};
  const std::size_t looked_at = (n + stride - 1) / stride;
  const std::optional<int> axis =
      findTurnAxis (positions, origin, geometry.neighbors, neighbors, stride);
  std::vector<std::pair<Index, Line>> on_line;
  for (std::size_t i = 0; i < n; i += stride) {
    const auto p = static_cast<Index> (i);
    const Row row = geometry.neighbors.first (p, neighbors);
    if (const auto line = axis ? Line{} : lineThrough (positions, p, row))
      on_line.emplace_back (p, *line);
  }
  const auto points = static_cast<double> (on_line.size ());
  if (points < ON_LINES * static_cast<double> (looked_at))
    return {};
  const auto isBeside = [&] (const std::pair<Index, Line>& at, const Vector3d& position) {
    const Vector3d offset = position - positions[at.first];
    return axis ? offset[*axis] != 0.0 : liesBeside (at.second, offset);
  };
  const auto isJoined = [&] (const std::pair<Index, Line>& at) {
    return anyTriangle (geometry.stars, at.first, [&] (Index q, Index r) {
      return (isBeside (at, positions[q]) || isBeside (at, positions[r])) &&
             hasTriangle (geometry.stars, q, r, at.first) &&
             hasTriangle (geometry.stars, r, at.first, q);
    });
  };
  const auto joined = std::count_if (on_line.begin (), on_line.end (), isJoined);
  if (static_cast<double> (joined) > JOINED * points)
    return {};
  constexpr std::size_t NEAREST = 6; // three on either side: two steps away on average
  const KdTree tree (positions, run);
  std::vector<Neighbor> found;
  std::vector<double> apart;
  for (const auto& at : on_line) {
    const Vector3d& here = positions[at.first];
    const auto isOff = [&] (const Neighbor&, const Vector3d& q) { return isBeside (at, q); };
    tree.nearestIf (here, Vector3d::Zero (), KdTree::EVERYWHERE, 1, isOff, found);
    double step = 0.0;
    const Row nearest = geometry.neighbors.first (at.first, NEAREST);
    for (const Index q : nearest)
      step += 0.5 * (positions[q] - here).norm () / static_cast<double> (nearest.size ());
    if (!found.empty () && step > 0.0)
      apart.push_back (std::sqrt (found.front ().sqr_distance) / step);
  }
  return 2 * apart.size () > on_line.size () ? median (apart) : 0.0;
}

std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, bool is_certain,
             const RunContext& run)
{
  constexpr std::size_t NEAREST = 20;
  const bool may_be_uneven = !noise.unevenness.empty ();
  std::vector<float> spacings = geometry.spacing;
  const auto middle = static_cast<double> (median (spacings));
  const double far_away = FAR_SPACING * middle, around_far = AROUND_FAR * middle;
  const auto far_points = std::count_if (spacings.begin (), spacings.end (), [&] (float x) {
    return static_cast<double> (x) >= far_away;
  });
  const bool may_be_far = static_cast<std::size_t> (far_points) >= LEAST_FAR;
  if (!may_be_uneven && !may_be_far)
    return {};
  const std::size_t n = geometry.spacing.size ();
  std::vector<float> share (n);
  parallelPoints (run, n, [&] (Index p) { share[p] = agreeingShare (geometry.stars, p); });
  RegionPoints strewn{Flags (n), Flags (n), std::vector<float> (n)};
  RegionPoints distant = strewn;
  parallelPoints (run, n, [&] (Index p) {
    const double unevenness = may_be_uneven ? static_cast<double> (noise.unevenness[p]) : 0.0;
    const auto spacing = static_cast<double> (geometry.spacing[p]);
    const bool is_distant = may_be_far && spacing >= around_far;
    if (unevenness < WEAK_UNEVENNESS && !is_distant)
      return;
    const Row row = geometry.neighbors.first (p, NEAREST);
    auto around = static_cast<double> (share[p]);
    for (const Index q : row)
      around += static_cast<double> (share[q]);
    around /= static_cast<double> (row.size () + 1);
    if (unevenness >= WEAK_UNEVENNESS) {
      strewn.is_inside[p] = around <= WEAK_SHARE ? 1 : 0;
      strewn.is_counted[p] = around <= STRONG_SHARE && unevenness >= UNEVEN ? 1 : 0;
      strewn.value[p] = noise.dimension[p];
    }
    distant.is_inside[p] = distant.is_counted[p] = is_distant && around <= STRONG_SHARE ? 1 : 0;
    const auto area = static_cast<float> (spacing * spacing / (middle * middle));
    distant.value[p] = spacing >= far_away && around <= FAR_SHARE ? area : -area;
  });
  Flags is_scatter (n), is_not_noise (n);
  const auto take = [&] (double least_mean, Flags& taken) {
    takeRegions (geometry.neighbors, strewn, LEAST_STRONG, is_certain ? least_mean : 0.0, taken);
  };
  take (DIMENSION_IF_NOT_NOISY, is_scatter);
  if (is_certain) {
    for (std::size_t p = 0; p < n; ++p)
      strewn.value[p] = noise.at_point[p] > 0.0F ? 0.0F : 1.0F;
    take (NOT_NOISY, is_not_noise);
    for (std::size_t p = 0; p < n; ++p) {
      is_scatter[p] &= is_not_noise[p];
      strewn.value[p] = may_be_uneven ? noise.dimension[p] : 0.0F;
    }
    take (DIMENSION, is_scatter);
    for (std::size_t p = 0; p < n && may_be_uneven; ++p)
      strewn.value[p] += noise.dimension[p] - noise.smaller_dimension[p]; // at the next scale
    take (DIMENSION, is_scatter);
  }
  takeRegions (geometry.neighbors, distant, LEAST_FAR, 0.0, is_scatter);
  return indicesWhere (n, [&] (Index p) { return is_scatter[p] != 0; });
}

} // namespace pcl::floater
