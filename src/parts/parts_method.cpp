// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parts_method.h"

#include "core/parallel.h"
#include "parts/seam_finish.h"
#include "parts/stitching.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// As many rims at a time as there are threads.
JoinedRims
joinRims (const Parts& parts, PartWork& work, std::size_t rings, const RunContext& run)
{
  RimJoiner joiner;
  const auto at_once = static_cast<std::size_t> (run.threads ());
  for (std::size_t first = 0; first < parts.count (); first += at_once) {
    std::vector<PartRim> rims (std::min (at_once, parts.count () - first));
    parallelTasks (run, rims.size (),
                   [&] (std::size_t i) { rims[i] = work.rim (first + i, rings); });
    for (const PartRim& rim : rims)
      joiner.add (rim);
  }
  return std::move (joiner).join (run);
}

// Sees more of the parts until that is enough.
Stitching
stitchParts (const Parts& parts, PartWork& work, double unit, const SurfaceSettings& settings,
             std::size_t rings, const RunContext& run)
{
  constexpr std::size_t MOST_RINGS = std::size_t{1} << 20U; // more than any part has
  for (; rings < MOST_RINGS; rings *= 2) {
    if (std::optional<Stitching> stitching =
            stitch (joinRims (parts, work, rings, run), parts, unit, settings, run))
      return std::move (*stitching);
  }
  throw std::logic_error ("parts of a mesh cannot be stitched");
}

} // namespace

Surface
makeSurfaceOfParts (const Points& points, const Parts& parts, PartWork& work,
                    const SurfaceSettings& settings, const PartLimits& limits,
                    const RunContext& run)
{
  Surface surface;
  run.beginStage (Stage::CONSENSUS);
  Stitching stitching = stitchParts (parts, work, 1.0 / points.scale, settings, limits.rings, run);
  surface.holes_filled = stitching.holes.filled;
  surface.doubtful_loops = std::move (stitching.holes.doubtful);
  surface.orientation_seam = std::move (stitching.orientation_seam);

  run.beginStage (Stage::FLIPS);
  work.finish (std::move (stitching.parts), run);
  JoinedZones zones;
  std::vector<double> corners;
  MeshFinish& finish = surface.finish;
  for (std::size_t part = 0; part < parts.count (); ++part) {
    run.poll ();
    FinishedPart finished = work.finished (part);
    finish.flips += finished.flips;
    finish.folds_after_flips += finished.folds_after_flips;
    finish.folds += finished.folds;
    std::vector<Triangle>& all = surface.mesh.triangles;
    all.reserve (2 * points.size ());
    all.insert (all.end (), finished.triangles.begin (), finished.triangles.end ());
    corners.insert (corners.end (), finished.corners.begin (), finished.corners.end ());
    zones.add (finished.zone);
  }
  const FinishedSeam seam = finishSeam (std::move (zones), stitching.seam, std::move (corners),
                                        settings.finishSettings (), limits.rings, run);
  finish.flips += seam.finish.flips;
  finish.folds_after_flips += seam.finish.folds_after_flips;
  finish.folds += seam.finish.folds;
  surface.mesh.triangles.insert (surface.mesh.triangles.end (), seam.triangles.begin (),
                                 seam.triangles.end ());
  if (!surface.mesh.connect (points.size (), run))
    throw std::logic_error ("the finished parts do not fit");
  finish.facing = faceOutwards (surface.mesh, points.positions, settings.facing,
                                settings.limits.finish.facing, run);
  return surface;
}

} // namespace floater
} // namespace pcl
