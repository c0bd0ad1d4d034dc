// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/local_geometry.h"

#include "local/planes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace pcl::floater {
namespace {
// The data for stars beyond the neighbours, if they are to reach there.
std::optional<BeyondNeighbors>
beyondNeighbors (const LocalPlanes& planes, const StarSettings& settings)
{
  if (!settings.reach_beyond)
    return {};
  return BeyondNeighbors{*planes.tree, planes.spacing, planes.beside};
}

// Each row of one of two tables: of the first where `is_first` is not 0.
CsrLists
mergeRows (const CsrLists& first, const CsrLists& second, const std::vector<std::uint8_t>& is_first)
{
  return makeCsrLists (second.rows (), [&] (auto&& emit) {
    for (std::size_t p = 0; p < second.rows (); ++p)
      for (const Index q : (is_first[p] != 0 ? first : second).row (p))
        emit (p, q);
  });
}
} // namespace

LocalPlanes
fitLocalPlanes (const Points& points, CsrLists neighbors, std::optional<KdTree> known,
                const StarSettings& settings, const RunContext& run, const PlaneLimits& limits)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const Rows all = Rows::all (positions.size ());
  LocalPlanes planes;
  planes.neighbors = std::move (neighbors);
  planes.spacing = localSpacing (positions, planes.neighbors, all, run);
  if (settings.reach_beyond) {
    if (known)
      planes.tree.emplace (std::move (*known));
    else
      planes.tree.emplace (positions, run, PointOrder::ALONG_CURVE);
    planes.beside = findBesideLines (positions, planes.neighbors, planes.spacing, *planes.tree, all,
                                     limits.least_aspect, settings.reach, run);
    appendRows (planes.beside.neighbors, planes.neighbors);
  }
  planes.normals = fitTangentPlanes (positions, planes.neighbors, all, run, limits);
  for (std::size_t p = 0; p < points.normals.size (); ++p)
    if (!points.normals[p].isZero (0.0F))
      planes.normals[p] = points.normals[p];
  return planes;
}

Stars
makeStarsOf (const std::vector<Index>& centres, const Points& points, const LocalPlanes& planes,
             const StarSettings& settings, const RunContext& run)
{
  const std::optional<BeyondNeighbors> beyond = beyondNeighbors (planes, settings);
  return makeStarsOf (centres, points.workingPositions (), planes.neighbors, planes.normals,
                      settings, run, beyond ? &*beyond : nullptr);
}

LocalGeometry
makeLocalGeometry (const Points& points, LocalPlanes planes, const StarSettings& settings,
                   const RunContext& run, std::optional<Stars> begun)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const Rows all = Rows::all (positions.size ());
  LocalGeometry geometry;
  if (!points.projected.empty ())
    geometry.own_spacing = localSpacing (points.positions, planes.neighbors, all, run);
  if (!begun) {
    const std::optional<BeyondNeighbors> beyond = beyondNeighbors (planes, settings);
    begun = makeStars (positions, planes.neighbors, planes.normals, all, settings, run,
                       beyond ? &*beyond : nullptr);
  }
  geometry.stars = settings.reach_beyond ? finishStars (positions, planes.neighbors, planes.normals,
                                                        std::move (*begun), settings, run)
                                         : std::move (*begun);
  geometry.neighbors = std::move (planes.neighbors);
  geometry.spacing = std::move (planes.spacing);
  if (!settings.reach_beyond)
    return geometry;
  appendRows (geometry.stars.far_neighbors, geometry.neighbors);
  geometry.stars.far_neighbors = {};
  for (std::size_t p = 0; p < geometry.spacing.size (); ++p)
    geometry.spacing[p] =
        std::max (geometry.spacing[p], REACH_AS_SPACING * geometry.stars.reach[p]);
  return geometry;
}

void
copyRows (const LocalGeometry& from, const std::vector<Index>& rows, LocalGeometry& to)
{
  std::vector<std::uint8_t> is_copied (to.spacing.size ());
  for (const Index p : rows) {
    is_copied[p] = 1;
    to.spacing[p] = from.spacing[p];
    to.stars.open[p] = from.stars.open[p];
    to.stars.normals[p] = from.stars.normals[p];
    if (!to.stars.reach.empty ())
      to.stars.reach[p] = from.stars.reach[p];
  }
  std::vector<Eigen::Vector2d> offsets;
  if (!to.stars.offsets_in_plane.empty ())
    for (std::size_t p = 0; p < is_copied.size (); ++p) {
      const Stars& stars = is_copied[p] != 0 ? from.stars : to.stars;
      const auto begin = stars.offsets_in_plane.begin ();
      offsets.insert (offsets.end (), begin + stars.neighbors.offsets[p],
                      begin + stars.neighbors.offsets[p + 1]);
    }
  to.stars.offsets_in_plane = std::move (offsets);
  to.neighbors = mergeRows (from.neighbors, to.neighbors, is_copied);
  to.stars.neighbors = mergeRows (from.stars.neighbors, to.stars.neighbors, is_copied);
}

} // namespace pcl::floater
