// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/texture_method.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "core/problem.h"
#include "texture/stretch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
Problem
checkMesh (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles)
{
  for (const Triangle& t : triangles)
    for (const Index p : t) {
      if (p >= positions.size ())
        return {RunStatus::INVALID_INDICES, "a triangle names point " + std::to_string (p) +
                                                ", but there are only " +
                                                std::to_string (positions.size ()) + " points"};
      if (!positions[p].allFinite ())
        return {RunStatus::INVALID_INDICES, "point " + std::to_string (p) +
                                                " of a triangle has no finite position; texture "
                                                "coordinates need one for each vertex"};
    }
  return {};
}

// Coordinates by point, then by chart, so that the coordinates of a point are adjacent.
void
takeCoordinates (const std::vector<ChartLayout>& charts, std::size_t points, std::size_t triangles,
                 TextureCoordinates& result)
{
  CsrLists of_point = makeCsrLists (points, [&charts] (const auto& emit) {
    for (const ChartLayout& chart : charts)
      for (const Index p : chart.points)
        emit (p, p);
  });
  result.points = std::move (of_point.ids);
  result.coordinates.resize (result.points.size ());
  result.corners.resize (triangles);
  result.charts.resize (triangles);
  for (std::size_t c = 0; c < charts.size (); ++c) {
    const ChartLayout& chart = charts[c];
    std::vector<Index> numbers;
    numbers.reserve (chart.points.size ());
    for (std::size_t i = 0; i < chart.points.size (); ++i) {
      numbers.push_back (of_point.offsets[chart.points[i]]++);
      result.coordinates[numbers.back ()] =
          chart.uv[i].cast<float> ().cwiseMax (0.0F).cwiseMin (1.0F);
    }
    for (std::size_t i = 0; i < chart.triangles.size (); ++i) {
      const Index t = chart.triangles[i];
      result.charts[t] = static_cast<Index> (c);
      for (std::size_t corner = 0; corner < 3; ++corner)
        result.corners[t][corner] = numbers[chart.corners[i][corner]];
    }
  }
}

void
findSeams (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           TextureCoordinates& result)
{
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index other = mesh.neighbors[t][side];
      if (other == NONE || other < t || result.charts[other] == result.charts[t])
        continue;
      const MeshEdge edge{t, side};
      result.seams.push_back ({mesh.from (edge), mesh.to (edge)});
      result.seam_length += (positions[mesh.to (edge)] - positions[mesh.from (edge)]).norm ();
    }
}

// All steps. Sets everything except status and message.
Problem
makeTextureCoordinates (const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles, const TextureOptions& options,
                        const RunContext& run, TextureCoordinates& result)
{
  if (!(options.largest_stretch >= 1.0))
    return {RunStatus::INVALID_OPTION, "the largest stretch of a chart must be 1 or more"};
  if (options.threads < 0)
    return {RunStatus::INVALID_OPTION, "the number of threads must be 0 or more"};
  if (Problem problem = checkMesh (positions, triangles))
    return problem;
  TriangleMesh mesh;
  mesh.triangles = triangles;
  if (!mesh.connect (positions.size (), run))
    return {RunStatus::INVALID_INDICES,
            "the triangles are no oriented manifold: an edge has more than two triangles or two of "
            "opposite orientation, or a point has several fans; repair the mesh first"};

  // Scaled by a power of two to about 1, if there are triangles: squares and cubes of lengths are
  // finite then. Points without a triangle stay as they are.
  double largest = 0.0;
  for (const Triangle& t : triangles)
    for (const Index p : t)
      largest = std::max (largest, positions[p].cwiseAbs ().maxCoeff ());
  const double unit = largest > 0.0 ? std::ldexp (1.0, std::ilogb (largest)) : 1.0;
  std::vector<Eigen::Vector3d> places = positions;
  for (Eigen::Vector3d& place : places)
    place /= unit;

  const TextureLimits limits;
  // Charts (discs) and their layouts, on the surface without its noise.
  std::vector<ChartLayout> charts = layOutCharts (
      mesh, places, smoothNoise (mesh, places, limits.smoothing, run), options, limits, run);

  // All charts in one square, in single precision. Charts of which that flips triangles, such as of
  // sizes that differ by more than its digits, are taken apart.
  constexpr int ATTEMPTS = 4;
  std::vector<Index> flipped;
  std::vector<Eigen::Vector2d> uv;
  for (int round = 0; round == 0 || (round < ATTEMPTS && !flipped.empty ()); ++round) {
    std::vector<ChartLayout> kept;
    for (ChartLayout& chart : charts)
      if (chart.triangles.size () == 1 ||
          std::none_of (flipped.begin (), flipped.end (), [&] (Index t) {
            return std::binary_search (chart.triangles.begin (), chart.triangles.end (), t);
          }))
        kept.push_back (std::move (chart));
      else
        for (const Index t : chart.triangles)
          kept.push_back (layOutChart (triangles, {t}, places, {}, run));
    charts = std::move (kept);
    result.gutter = packCharts (charts, limits.atlas, run);
    takeCoordinates (charts, positions.size (), triangles.size (), result);
    uv.clear ();
    for (const Eigen::Vector2f& rounded : result.coordinates)
      uv.emplace_back (rounded.cast<double> ());
    flipped = flippedTriangles (result.corners, uv);
  }
  result.chart_count = charts.size ();
  result.flipped = flipped.size ();
  findSeams (mesh, places, result);
  result.seam_length *= unit;
  const StretchSums sums = stretchOf (triangles, places, result.corners, uv);
  result.stretch = sums.mean ();
  result.largest_stretch = sums.largest ();
  result.area_used = sums.planeArea ();
  return {};
}

} // namespace

TextureCoordinates
computeTextureCoordinates (const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Triangle>& triangles, const TextureOptions& options)
{
  TextureCoordinates result;
  Problem problem;
  try {
    Statistics times;
    RunMonitor monitor ({{}, options.progress_callback, options.cancelled_callback}, times);
    const RunContext run (options.threads, &monitor);
    run.beginStage (Stage::CHECK); // the last stage takes the rest of the progress, here all of it
    problem = makeTextureCoordinates (positions, triangles, options, run, result);
    if (!problem)
      monitor.finish ();
  }
  catch (...) {
    problem = problemOfException ();
  }
  if (problem)
    result = {};
  result.status = problem.status;
  result.message = std::move (problem.message);
  return result;
}

} // namespace pcl::floater
