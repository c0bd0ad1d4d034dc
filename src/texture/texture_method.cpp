// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates of a mesh: charts, their layout, the atlas.
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "floater/solvers/solver.h"
#include "texture/chart_layout.h"
#include "texture/charts.h"

#include <pcl/surface/floater/texture_coordinates.h>

namespace pcl::floater {
namespace {
// Stretch above which charts of the true surface are cut; the roughness after smoothing has less.
constexpr double TOO_MUCH = 1.5;

// Stretch of the true surface in the layout of the smoothed one, above which it is laid out without
// smoothing, if more than this share of the vertices was moved (otherwise above TOO_MUCH). Generated
// planes, boxes and terrain with noise of up to three spacings stay below 3; thin parts that were
// flattened by smoothing do not.
constexpr double WRONG = 4.0, NOISY = 0.5;

// Steps of the descent on the true surface, after the smoothed one; noise prevents convergence.
constexpr int STEPS_TO_NOISE = 20;

using Layouts = std::vector<ChartLayout>;

// The triangles of each part, ascending.
std::vector<std::vector<Index>>
listsOf (const MeshComponents& parts)
{
  std::vector<std::vector<Index>> lists (parts.count);
  for (std::size_t t = 0; t < parts.of_triangle.size (); ++t)
    lists[parts.of_triangle[t]].push_back (static_cast<Index> (t));
  return lists;
}

// Lays out charts of the mesh for some positions.
struct ChartCutter
{
  const TriangleMesh& mesh;
  const Positions& positions;
  double largest_stretch;
  DescentLimits limits;
  RunContext run;

  ChartLayout layOut (std::vector<Index> chart) const
  {
    return layOutChart (mesh.triangles, std::move (chart), positions, limits, run);
  }

  // Cuts a chart with too much stretch, or without layout, in two, or in more where their union would be
  // no disc. Each piece has fewer triangles, and one has a layout.
  void layOutParts (ChartLayout chart, Layouts& result) const
  {
    constexpr double HALF = 0.6; // share of the triangles in the larger part, at most
    // Facets: one for so many triangles, with a minimum. They decide the time of the search.
    constexpr std::size_t TRIANGLES_PER_FACET = 8, LEAST_FACETS = 1'000;
    const std::size_t size = chart.triangles.size ();
    if (size == 1 || (!chart.uv.empty () && chart.stretch <= largest_stretch)) {
      result.push_back (std::move (chart));
      return;
    }
    ChartLimits limits_of_parts;
    limits_of_parts.halves = true;
    limits_of_parts.facets =
        std::min (limits_of_parts.facets, std::max (LEAST_FACETS, size / TRIANGLES_PER_FACET));
    limits_of_parts.most_triangles =
        std::max<std::size_t> (1, static_cast<std::size_t> (HALF * static_cast<double> (size)));
    std::vector<std::vector<Index>> parts = listsOf (findCharts (
        chart.chart.mesh, valuesAt (positions, chart.chart.points), limits_of_parts, run));
    for (std::vector<Index>& part : parts)
      part = valuesAt (chart.triangles, part);
    chart = {};
    for (std::vector<Index>& part : parts)
      layOutParts (layOut (std::move (part)), result);
  }
};

// Cuts a mesh into charts and lays them out, on all threads of the run.
// \param smooth positions without noise (smoothNoise)
// \return the charts, in the order of their first triangles; each has a layout
Layouts
layOutCharts (const TriangleMesh& mesh, const Positions& positions, const Positions& smooth,
              const TextureOptions& options, const RunContext& run)
{
  const double largest_stretch = options.largest_stretch;
  const SingleBlasThread single; // more are slower on small matrices, and change the last digits
  const RunContext within = run.withThreads (1).withinStage ();
  // Cuts a layout of the smooth surface where needed, and fits it to the true one. Where smoothing
  // has removed more than noise, the chart is laid out without it.
  const auto finish = [&] (ChartLayout first, const ChartCutter& by_smooth,
                           const ChartCutter& by_true) {
    DescentLimits descent;
    descent.steps = STEPS_TO_NOISE;
    descent.newton_steps = 0;
    Layouts parts, finished;
    by_smooth.layOutParts (std::move (first), parts);
    for (ChartLayout& chart : parts) {
      const auto moved = std::count_if (chart.chart.points.begin (), chart.chart.points.end (),
                                        [&] (Index p) { return smooth[p] != positions[p]; });
      const auto share =
          static_cast<double> (moved) / static_cast<double> (chart.chart.points.size ());
      if (moved > 0)
        refineLayout (positions, descent, within, chart);
      const double most = share > NOISY ? WRONG : TOO_MUCH;
      ChartLayout other;
      if (moved > 0 && chart.stretch > std::max (most, largest_stretch))
        other = by_true.layOut (chart.triangles);
      if (!other.uv.empty () && other.stretch < chart.stretch)
        by_true.layOutParts (std::move (other), finished);
      else
        finished.push_back (std::move (chart));
    }
    return finished;
  };
  Layouts result;
  // Adds the layouts of each list of triangles.
  const auto layOutEach = [&] (const std::vector<std::vector<Index>>& lists, const auto& layOut) {
    std::vector<Layouts> found (lists.size ());
    parallelTasks (run, lists.size (), [&] (std::size_t c) { found[c] = layOut (lists[c]); });
    for (Layouts& list : found)
      std::move (list.begin (), list.end (), std::back_inserter (result));
  };
  Flags is_done (mesh.triangles.size (), 0);
  if (options.whole_discs) {
    constexpr double ANY_STRETCH = std::numeric_limits<double>::infinity ();
    DescentLimits whole;
    whole.most_on_circle = std::numeric_limits<std::size_t>::max ();
    const ChartCutter by_smooth{mesh, smooth, ANY_STRETCH, whole, within};
    const ChartCutter by_true{mesh, positions, ANY_STRETCH, whole, within};
    layOutEach (listsOf (findComponents (mesh, run)), [&] (const std::vector<Index>& triangles) {
      ChartLayout disc = by_smooth.layOut (triangles);
      if (disc.chart.loop.empty ())
        return Layouts{}; // no disc
      if (disc.uv.empty ())
        disc = by_true.layOut (triangles);
      for (const Index t : triangles)
        is_done[t] = 1;
      return finish (std::move (disc), by_smooth, by_true);
    });
  }
  run.beginStep (0.1);
  const std::vector<std::vector<Index>> lists = listsOf (findCharts (mesh, smooth, {}, run));
  run.beginStep (0.95);
  const ChartCutter by_smooth{mesh, smooth, largest_stretch, {}, within};
  const ChartCutter by_true{mesh, positions, std::max (largest_stretch, TOO_MUCH), {}, within};
  layOutEach (lists, [&] (const std::vector<Index>& triangles) {
    return is_done[triangles.front ()] != 0
               ? Layouts{}
               : finish (by_smooth.layOut (triangles), by_smooth, by_true);
  });
  std::sort (result.begin (), result.end (), [] (const ChartLayout& a, const ChartLayout& b) {
    return a.triangles.front () < b.triangles.front ();
  });
  return result;
}

// Coordinates by point, then by chart, so that the coordinates of a point are adjacent.
void
takeCoordinates (const std::vector<ChartLayout>& charts, std::size_t points, std::size_t triangles,
                 TextureCoordinates& result)
{
  CsrLists of_point = makeCsrLists (points, [&charts] (const auto& emit) {
    for (const ChartLayout& chart : charts)
      for (const Index p : chart.chart.points)
        emit (p, p);
  });
  result.points = std::move (of_point.ids);
  result.coordinates.resize (result.points.size ());
  result.corners.resize (triangles);
  result.charts.resize (triangles);
  for (std::size_t c = 0; c < charts.size (); ++c) {
    const ChartLayout& chart = charts[c];
    std::vector<Index> numbers;
    numbers.reserve (chart.chart.points.size ());
    for (std::size_t i = 0; i < chart.chart.points.size (); ++i) {
      numbers.push_back (of_point.offsets[chart.chart.points[i]]++);
      result.coordinates[numbers.back ()] =
          chart.uv[i].cast<float> ().cwiseMax (0.0F).cwiseMin (1.0F);
    }
    for (std::size_t i = 0; i < chart.triangles.size (); ++i) {
      const Index t = chart.triangles[i];
      result.charts[t] = static_cast<Index> (c);
      for (std::size_t corner = 0; corner < 3; ++corner)
        result.corners[t][corner] = numbers[chart.chart.mesh.triangles[i][corner]];
    }
  }
}

// All steps. Sets everything except status and message.
Problem
makeTextureCoordinates (const Positions& positions, const std::vector<Triangle>& triangles,
                        const TextureOptions& options, const RunContext& run,
                        TextureCoordinates& result)
{
  if (!(options.largest_stretch >= 1.0))
    return {RunStatus::INVALID_OPTION, "the largest stretch of a chart must be 1 or more"};
  if (options.threads < 0)
    return {RunStatus::INVALID_OPTION, "the number of threads must be 0 or more"};
  double largest = 0.0; // coordinate
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
      largest = std::max (largest, positions[p].cwiseAbs ().maxCoeff ());
    }
  TriangleMesh mesh;
  mesh.triangles = triangles;
  if (!mesh.connect (positions.size (), run))
    return {RunStatus::INVALID_INDICES,
            "the triangles are no oriented manifold: an edge has more than two triangles or two of "
            "opposite orientation, or a point has several fans; repair the mesh first"};

  // Scaled by a power of two to about 1, if there are triangles: squares and cubes of lengths are
  // finite then. Points without a triangle stay as they are.
  const double unit = largest > 0.0 ? std::ldexp (1.0, std::ilogb (largest)) : 1.0;
  Positions places = positions;
  for (Vector3d& place : places)
    place /= unit;

  // Charts (discs) and their layouts, on the surface without its noise.
  std::vector<ChartLayout> charts =
      layOutCharts (mesh, places, smoothNoise (mesh, places, run), options, run);

  // All charts in one square, in single precision. Charts of which that flips triangles, such as of
  // sizes that differ by more than its digits, are taken apart.
  constexpr int ATTEMPTS = 4;
  std::vector<Index> flipped;
  std::vector<Vector2d> uv;
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
    result.gutter = packCharts (charts, run);
    takeCoordinates (charts, positions.size (), triangles.size (), result);
    uv.clear ();
    for (const Eigen::Vector2f& rounded : result.coordinates)
      uv.emplace_back (rounded.cast<double> ());
    flipped = flippedTriangles (result.corners, uv);
  }
  result.chart_count = charts.size ();
  result.flipped = flipped.size ();
  for (Index t = 0; t < triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index other = mesh.neighbors[t][side];
      if (other == NONE || other < t || result.charts[other] == result.charts[t])
        continue;
      const Index from = mesh.from ({t, side}), to = mesh.to ({t, side});
      result.seams.push_back ({from, to});
      result.seam_length += distanceBetween (places, from, to);
    }
  result.seam_length *= unit;
  const StretchSums sums = stretchOf (triangles, places, result.corners, uv);
  result.stretch = sums.mean ();
  result.largest_stretch = sums.largest ();
  result.area_used = sums.planeArea ();
  return {};
}

} // namespace

TextureCoordinates
computeTextureCoordinates (const Positions& positions, const std::vector<Triangle>& triangles,
                           const TextureOptions& options)
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
