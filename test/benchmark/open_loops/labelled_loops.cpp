// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labelled_loops.h"

#include "cloud_geometry.h"
#include "consensus/consensus_mesh.h"
#include "core/geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl
{
namespace floater
{
namespace
{
// Twice the signed area of a polygon of places.
double
doubleArea (const std::vector<Eigen::Vector2d>& polygon)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size (); ++i)
    sum += cross (polygon[i], polygon[(i + 1) % polygon.size ()]);
  return sum;
}

bool
surrounds (const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& place)
{
  double turned = 0.0;
  for (std::size_t i = 0; i < polygon.size (); ++i) {
    const Eigen::Vector2d a = polygon[i] - place, b = polygon[(i + 1) % polygon.size ()] - place;
    turned += std::atan2 (cross (a, b), a.dot (b));
  }
  return std::abs (turned) > PI;
}

} // namespace

std::vector<LabelledLoop>
findLoops (const Points& points)
{
  const RunContext run (1);
  const Options options;
  const Limits limits;
  const Request request{options, limits, run};
  const StarSettings stars = starSettings (request);
  LocalPlanes planes =
      fitLocalPlanes (points, findNeighbors (points, neighborSettings (options, nullptr), run),
                      std::nullopt, stars, run, limits.planes);
  LocalGeometry geometry = makeLocalGeometry (points, std::move (planes), stars, run);
  const ConsensusMesh consensus =
      makeConsensusMesh (points.positions, geometry.neighbors, std::move (geometry.stars),
                         geometry.spacing, limits.surface.consensus, run);
  const MeshComponents components = findComponents (consensus.mesh, run);
  const std::vector<std::size_t> component_points = countPoints (consensus.mesh, components);
  const std::vector<BoundaryLoop> loops =
      findBoundaryLoops (consensus.mesh, components, points.positions, geometry.spacing, run);
  const std::vector<LoopEvidence> evidence = findEvidence (
      consensus.mesh, loops, points.positions, geometry.neighbors, consensus.normals, {}, run);
  std::vector<LabelledLoop> found;
  for (std::size_t i = 0; i < loops.size (); ++i) {
    LabelledLoop one;
    one.loop = loops[i];
    one.evidence = evidence[i];
    one.component_points = component_points[loops[i].component];
    one.largest_component = std::max_element (component_points.begin (), component_points.end ()) ==
                            component_points.begin () + loops[i].component;
    found.push_back (std::move (one));
  }
  return found;
}

LabelledLoops
labelLoops (const HoleySurface& surface, std::uint64_t seed)
{
  LabelledLoops labelled;
  std::vector<Index> cloud_index (surface.points.size ());
  std::iota (cloud_index.begin (), cloud_index.end (), Index{0});
  const Points points = makePoints (surface.points, cloud_index, 1);
  std::vector<LabelledLoop> loops = findLoops (points);
  loops.erase (std::remove_if (loops.begin (), loops.end (),
                               [] (const LabelledLoop& one) { return !one.largest_component; }),
               loops.end ());
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  std::vector<double> areas;
  for (const LabelledLoop& one : loops) {
    polygons.emplace_back ();
    for (const Index p : one.loop.points)
      polygons.back ().push_back (surface.places[points.cloud_index[p]]);
    areas.push_back (0.5 * std::abs (doubleArea (polygons.back ())));
  }
  // The border surrounds all; where it does not, the surface came in pieces, and nothing is known.
  const auto widest = std::max_element (areas.begin (), areas.end ());
  if (widest == areas.end () || *widest < 0.6 * surface.side * surface.side)
    return labelled;
  std::vector<bool> found (surface.windows.size (), false);
  for (std::size_t i = 0; i < loops.size (); ++i) {
    LabelledLoop& one = loops[i];
    one.source = nameOf (surface.sampling);
    one.seed = seed;
    if (i == static_cast<std::size_t> (widest - areas.begin ()))
      one.kind = LoopKind::BORDER;
    else
      for (std::size_t w = 0; w < surface.windows.size (); ++w) {
        const Window& window = surface.windows[w];
        if (areas[i] > 0.5 * PI * window.mean_radius * window.mean_radius &&
            surrounds (polygons[i], window.centre)) {
          one.kind = LoopKind::WINDOW;
          one.even_rim = window.even_rim;
          found[w] = true;
        }
      }
    // A loop that turns like a border is no hole: the surface is torn there.
    if (one.kind != LoopKind::GAP || one.evidence.turning < 0.0)
      labelled.loops.push_back (std::move (one));
  }
  labelled.lost_windows =
      static_cast<std::size_t> (std::count (found.begin (), found.end (), false));
  return labelled;
}

LabelledLoops
labelLoops (const SolidSurface& surface, std::uint64_t seed)
{
  LabelledLoops labelled;
  std::vector<Index> cloud_index (surface.positions.size ());
  std::iota (cloud_index.begin (), cloud_index.end (), Index{0});
  const Points points = makePoints (surface.positions, cloud_index, 1);
  TriangleMesh truth;
  truth.triangles = surface.triangles;
  if (!truth.connect (surface.positions.size (), 1))
    return labelled;
  const std::vector<BoundaryLoop> true_loops =
      findBoundaryLoops (truth, findComponents (truth, 1), surface.positions,
                         std::vector<float> (surface.positions.size (), 1.0F), 1);
  std::vector<std::size_t> true_loop_of (surface.positions.size (), true_loops.size ());
  for (std::size_t i = 0; i < true_loops.size (); ++i)
    for (const Index p : true_loops[i].points)
      true_loop_of[p] = i;
  std::vector<bool> is_found (true_loops.size (), false);
  for (LabelledLoop& one : findLoops (points)) {
    std::vector<std::size_t> shared (true_loops.size () + 1, 0);
    for (const Index p : one.loop.points)
      ++shared[true_loop_of[points.cloud_index[p]]];
    const std::size_t size = one.loop.points.size (), on_none = shared.back ();
    const auto most = std::max_element (shared.begin (), shared.end () - 1);
    const auto i = static_cast<std::size_t> (most - shared.begin ());
    one.seed = seed;
    one.source = "bodies";
    if (i < true_loops.size () && 2 * *most >= size && 2 * *most >= true_loops[i].points.size ()) {
      one.kind = LoopKind::WINDOW;
      is_found[i] = true;
    }
    else if (5 * (size - on_none) >= size)
      continue;
    labelled.loops.push_back (std::move (one));
  }
  labelled.lost_windows =
      static_cast<std::size_t> (std::count (is_found.begin (), is_found.end (), false));
  return labelled;
}

} // namespace floater
} // namespace pcl
