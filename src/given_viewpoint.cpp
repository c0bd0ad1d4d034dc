// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "given_viewpoint.h"

#include "cloud_geometry.h"
#include "input/check_input.h"
#include "view/area_evidence.h"
#include "view/view_method.h"
#include "view/viewpoint_search.h"

#include <utility>

namespace pcl::floater {
std::optional<Viewpoint>
contradictingViewpoint (const Points& points, const Viewpoint& given, const Request& request)
{
  const RunContext& run = request.run;
  const SearchLimits& search = request.limits.view.search;
  const EvidenceLimits& evidence = request.limits.view.evidence;
  const auto isSeen = [&] (const Viewpoint& viewpoint) {
    return isSeenFrom (points, viewpoint, evidence, run);
  };
  if (isSeen (given))
    return {};
  const Eigen::Map<const Eigen::Vector3d> origin (request.sensor_origin.data ());
  const Viewpoint of_file{(origin - points.centre) / points.scale, false};
  if (isSensorKnown (request.sensor_origin) && isSeen (of_file))
    return of_file;
  run.beginStage (Stage::NEIGHBORS);
  std::optional<KdTree> tree;
  CsrLists neighbors =
      findNeighbors (points, neighborSettings (request.options, nullptr), run, &tree);
  run.beginStage (Stage::STARS);
  const StarSettings stars = starSettings (request);
  const LocalPlanes planes = fitLocalPlanes (points, std::move (neighbors), std::move (tree), stars,
                                             run, request.limits.planes);
  const std::vector<AreaSample> samples =
      takeAreaSamples (points, planes, stars, search.samples, run);
  const std::optional<Viewpoint> found =
      findViewpoint (points, planes.neighbors, samples, search, evidence, run);
  return found ? found
               : findViewpointOfEven (points, planes.neighbors, samples, search, evidence, run);
}

} // namespace pcl::floater
