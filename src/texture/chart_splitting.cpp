// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/charts.h"
#include "texture/texture_method.h"

#include "core/parallel.h"
#include "core/single_blas_thread.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace pcl::floater {
namespace {
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
  const std::vector<Eigen::Vector3d>& positions;
  double largest_stretch;
  const TextureLimits& limits;
  RunContext run;

  ChartLayout layOut (std::vector<Index> chart) const
  {
    return layOutChart (mesh.triangles, std::move (chart), positions, limits.descent, run);
  }

  // Cuts a chart with too much stretch, or without layout. Each piece has fewer triangles, and one
  // has a layout.
  void layOutParts (ChartLayout chart, Layouts& result) const
  {
    if (chart.triangles.size () == 1 || (!chart.uv.empty () && chart.stretch <= largest_stretch)) {
      result.push_back (std::move (chart));
      return;
    }
    const std::vector<std::vector<Index>> parts = cut (chart.triangles);
    chart = {};
    for (const std::vector<Index>& part : parts)
      layOutParts (layOut (part), result);
  }

  // Cuts a chart of several triangles in two, or in more where their union would be no disc.
  std::vector<std::vector<Index>> cut (const std::vector<Index>& chart) const
  {
    const MeshPiece part = cutOut (mesh.triangles, chart, positions);
    ChartLimits halves = limits.charts;
    halves.facets = std::min (
        halves.facets, std::max (limits.facets_of_cut, chart.size () / limits.triangles_per_facet));
    halves.most_triangles = std::max<std::size_t> (
        1, static_cast<std::size_t> (limits.half * static_cast<double> (chart.size ())));
    std::vector<std::vector<Index>> lists =
        listsOf (findCharts (part.mesh, part.positions, true, halves, run));
    for (std::vector<Index>& list : lists)
      for (Index& t : list)
        t = chart[t];
    return lists;
  }
};

} // namespace

Layouts
layOutCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Eigen::Vector3d>& smooth, const TextureOptions& options,
              const TextureLimits& limits, const RunContext& run)
{
  const double largest_stretch = options.largest_stretch;
  const SingleBlasThread single; // more are slower on small matrices, and change the last digits
  const RunContext within = run.withThreads (1).withinStage ();
  // Cuts a layout of the smooth surface where needed, and fits it to the true one. Where smoothing
  // has removed more than noise, the chart is laid out without it.
  const auto finish = [&] (ChartLayout first, const ChartCutter& by_smooth,
                           const ChartCutter& by_true) {
    DescentLimits descent = limits.descent;
    descent.steps = limits.steps_to_noise;
    descent.newton_steps = 0;
    Layouts parts, finished;
    by_smooth.layOutParts (std::move (first), parts);
    for (ChartLayout& chart : parts) {
      const auto moved = std::count_if (chart.points.begin (), chart.points.end (),
                                        [&] (Index p) { return smooth[p] != positions[p]; });
      const auto share = static_cast<double> (moved) / static_cast<double> (chart.points.size ());
      if (moved > 0)
        refineLayout (mesh.triangles, positions, descent, within, chart);
      const double most = share > limits.noisy ? limits.wrong : limits.too_much;
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
  std::vector<std::uint8_t> is_done (mesh.triangles.size (), 0);
  if (options.whole_discs) {
    constexpr double ANY_STRETCH = std::numeric_limits<double>::infinity ();
    TextureLimits whole = limits;
    whole.descent.most_on_circle = std::numeric_limits<std::size_t>::max ();
    const ChartCutter by_smooth{mesh, smooth, ANY_STRETCH, whole, within};
    const ChartCutter by_true{mesh, positions, ANY_STRETCH, whole, within};
    layOutEach (listsOf (findComponents (mesh, run)), [&] (const std::vector<Index>& triangles) {
      ChartLayout disc = by_smooth.layOut (triangles);
      if (disc.loop.empty ())
        return Layouts{}; // no disc
      if (disc.uv.empty ())
        disc = by_true.layOut (triangles);
      for (const Index t : triangles)
        is_done[t] = 1;
      return finish (std::move (disc), by_smooth, by_true);
    });
  }
  run.beginStep (0.1);
  const std::vector<std::vector<Index>> lists =
      listsOf (findCharts (mesh, smooth, false, limits.charts, run));
  run.beginStep (0.95);
  const ChartCutter by_smooth{mesh, smooth, largest_stretch, limits, within};
  const ChartCutter by_true{mesh, positions, std::max (largest_stretch, limits.too_much), limits,
                            within};
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

} // namespace pcl::floater
