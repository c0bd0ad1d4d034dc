// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parts_method.h"

#include "core/parallel.h"
#include "parts/seam_finish.h"
#include "parts/stitching.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
// Computes one rim per thread at a time.
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

// Increases the rings until the stitching succeeds.
Stitching
stitchParts (const Parts& parts, PartWork& work, double unit, const SurfaceSettings& settings,
             std::size_t rings, const RunContext& run)
{
  constexpr std::size_t MOST_RINGS = std::size_t{1} << 20U; // exceeds any part
  for (; rings < MOST_RINGS; rings *= 2) {
    if (std::optional<Stitching> stitching =
            stitch (joinRims (parts, work, rings, run), parts, unit, settings, run))
      return std::move (*stitching);
  }
  throw std::logic_error ("parts of a mesh cannot be stitched");
}

// Joins the finished parts one by one.
FinishedSeam
joinFinished (const Parts& parts, PartWork& work, const std::vector<Triangle>& seam,
              const PartsSettings& settings, const RunContext& run, std::vector<InnerCheck>& checks,
              MeshFinish& finish)
{
  const auto count = [&finish] (const auto& of_some) {
    finish.flips += of_some.flips;
    finish.folds_after_flips += of_some.folds_after_flips;
    finish.folds += of_some.folds;
  };
  JoinedZones zones;
  std::vector<double> corners;
  for (std::size_t part = 0; part < parts.count (); ++part) {
    run.poll ();
    FinishedPart finished = work.finished (part);
    count (finished);
    corners.insert (corners.end (), finished.corners.begin (), finished.corners.end ());
    zones.add (finished.zone);
    checks.push_back (std::move (finished.check));
  }
  FinishedSeam joined = finishSeam (std::move (zones), seam, std::move (corners),
                                    settings.surface.finishSettings (), settings.parts.rings, run);
  count (joined.finish);
  return joined;
}

} // namespace

PartFinishSettings
PartsSettings::ofPart (const Parts& all) const
{
  return {surface.flip_edges,
          remove_self_intersections,
          surface.limits.finish,
          uncrossing,
          {check, diagonal, surface.facing.sensor},
          parts,
          all.count ()};
}

SurfaceOfParts
makeSurfaceOfParts (const Points& points, const Parts& parts, PartWork& work,
                    const PartsSettings& settings, const RunContext& run)
{
  SurfaceOfParts made;
  Surface& surface = made.surface;
  run.beginStage (Stage::CONSENSUS);
  Stitching stitching =
      stitchParts (parts, work, 1.0 / points.scale, settings.surface, settings.parts.rim, run);
  surface.holes_filled = stitching.holes.filled;
  surface.doubtful_loops = std::move (stitching.holes.doubtful);
  surface.orientation_seam = std::move (stitching.orientation_seam);

  run.beginStage (Stage::FLIPS);
  work.finish (std::move (stitching.parts), settings.ofPart (parts),
               settings.surface.facing.normals, run);
  FinishedSeam seam =
      joinFinished (parts, work, stitching.seam, settings, run, made.checks, surface.finish);

  run.beginStage (Stage::CHECK);
  const FinishLimits& limits = settings.surface.limits.finish;
  const PartsCheckSettings check{settings.remove_self_intersections,
                                 limits.cost,
                                 settings.uncrossing,
                                 settings.check,
                                 settings.surface.facing,
                                 limits.facing};
  made.checked = checkParts (std::move (seam), made.checks, parts, work, points, check, run);
  surface.finish.facing = made.checked.facing;
  return made;
}

} // namespace pcl::floater
