// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/charts.h"
#include "texture/stretch.h"
#include "texture/texture_method.h"

#include "core/parallel.h"
#include "core/single_blas_thread.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace pcl::floater {
namespace {
using Layouts = std::vector<ChartLayout>;

class ChartCutter
{
public:
  ChartCutter (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               double largest_stretch, const TextureLimits& limits, const RunContext& run)
      : mesh_ (mesh), positions_ (positions), largest_stretch_ (largest_stretch), limits_ (limits),
        run_ (run)
  {
  }

  ChartLayout layOut (std::vector<Index> chart) const
  {
    return layOutChart (mesh_.triangles, std::move (chart), positions_, limits_.descent, run_);
  }

  // Lays out a disc of any size.
  ChartLayout layOutWhole (std::vector<Index> disc) const
  {
    DescentLimits descent = limits_.descent;
    descent.most_on_circle = std::numeric_limits<std::size_t>::max ();
    descent.most_newton_triangles = descent.most_on_circle;
    return layOutChart (mesh_.triangles, std::move (disc), positions_, descent, run_);
  }

  // Cuts a chart with too much stretch, or without layout, if that helps. Each piece has fewer
  // triangles, and one has a layout.
  // \param deviation limit for its pieces
  void layOutParts (ChartLayout chart, double deviation, Layouts& result) const
  {
    const bool has_layout = !chart.uv.empty ();
    if (!has_layout && chart.triangles.size () == 1)
      chart = layOutTriangle (mesh_.triangles, chart.triangles.front (), positions_);
    if (!chart.uv.empty () && (chart.stretch <= largest_stretch_ || chart.triangles.size () == 1)) {
      result.push_back (std::move (chart));
      return;
    }
    Layouts parts;
    for (std::vector<Index>& part : cut (chart, deviation))
      parts.push_back (layOut (std::move (part)));
    if (has_layout && (parts.size () == 1 || (isEven (chart) && !isWorthwhile (chart, parts)))) {
      result.push_back (std::move (chart));
      return;
    }
    if (parts.size () == 1) { // as nothing may be joined: by the order of the triangles
      const auto middle =
          chart.triangles.begin () + static_cast<std::ptrdiff_t> (chart.triangles.size () / 2);
      parts = {layOut ({chart.triangles.begin (), middle}),
               layOut ({middle, chart.triangles.end ()})};
    }
    chart = {};
    for (ChartLayout& part : parts)
      layOutParts (std::move (part), deviation, result);
  }

private:
  bool isWorthwhile (const ChartLayout& chart, const Layouts& parts) const
  {
    // Each is scaled by its area times its stretch, so the total stretch is their mean.
    double area = 0.0, sum = 0.0;
    for (const ChartLayout& part : parts) {
      if (part.uv.empty ())
        return true; // unknown
      area += part.area;
      sum += part.area * part.stretch;
    }
    return sum / area - 1.0 < limits_.worthwhile * (chart.stretch - 1.0);
  }

  // Whether its stretch is about uniform, as with noise.
  bool isEven (const ChartLayout& chart) const
  {
    return chart.stretch < limits_.too_much &&
           chart.median_stretch - 1.0 > limits_.even * (chart.stretch - 1.0);
  }

  // Cuts a chart into at least two pieces, if possible: into a few of less deviation; otherwise
  // into halves, as its defect is then local and many cuts do not help.
  // \param[in,out] deviation of the pieces
  std::vector<std::vector<Index>> cut (const ChartLayout& layout, double& deviation) const
  {
    const std::vector<Index>& chart = layout.triangles;
    const ChartMesh part = makeChartMesh (mesh_.triangles, chart, positions_);
    ChartLimits limits = limits_.charts;
    limits.facets =
        std::min (limits.facets,
                  std::max (limits_.facets_of_cut, chart.size () / limits_.triangles_per_facet));
    MeshParts parts;
    for (int halving = 0; !layout.uv.empty () && halving < limits_.halvings && parts.count < 2;
         ++halving) {
      deviation *= 0.5;
      parts = findCharts (part.mesh, part.positions, {deviation, 1}, limits, run_);
    }
    const auto size = static_cast<double> (chart.size ());
    if (parts.count < 2 || parts.count > limits_.most_parts ||
        static_cast<double> (largestOf (parts)) > limits_.largest_part * size) {
      limits.most_triangles =
          std::max<std::size_t> (1, static_cast<std::size_t> (limits_.half * size));
      parts = findCharts (part.mesh, part.positions, {std::numeric_limits<double>::infinity (), 2},
                          limits, run_);
    }
    std::vector<std::vector<Index>> lists (parts.count);
    for (std::size_t t = 0; t < chart.size (); ++t)
      lists[parts.of_triangle[t]].push_back (chart[t]);
    return lists;
  }

  // Number of triangles of the largest piece.
  static std::size_t largestOf (const MeshParts& parts)
  {
    std::vector<std::size_t> sizes (parts.count, 0);
    for (const Index part : parts.of_triangle)
      ++sizes[part];
    return *std::max_element (sizes.begin (), sizes.end ());
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  double largest_stretch_;
  const TextureLimits& limits_;
  RunContext run_;
};

std::vector<std::vector<Index>>
listsOf (const MeshParts& parts)
{
  std::vector<std::vector<Index>> lists (parts.count);
  for (std::size_t t = 0; t < parts.of_triangle.size (); ++t)
    lists[parts.of_triangle[t]].push_back (static_cast<Index> (t));
  return lists;
}

double
stretchOf (const ChartLayout& chart, const std::vector<Eigen::Vector3d>& positions)
{
  StretchSums sums;
  for (const Triangle& t : chart.corners)
    sums.add ({positions[chart.points[t[0]]], positions[chart.points[t[1]]],
               positions[chart.points[t[2]]]},
              {chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]});
  return sums.mean ();
}

} // namespace

Layouts
layOutCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Eigen::Vector3d>& smooth, bool whole_discs, double largest_stretch,
              const TextureLimits& limits, const RunContext& run)
{
  const SingleBlasThread single; // more are slower on small matrices, and change the last digits
  const RunContext within = run.withThreads (1).withinStage ();
  const ChartCutter by_smooth (mesh, smooth, largest_stretch, limits, within);
  const ChartCutter by_true (mesh, positions, std::max (largest_stretch, limits.too_much), limits,
                             within);
  const auto shareMoved = [&] (const ChartLayout& chart) {
    const auto moved = std::count_if (chart.points.begin (), chart.points.end (),
                                      [&] (Index p) { return smooth[p] != positions[p]; });
    return static_cast<double> (moved) / static_cast<double> (chart.points.size ());
  };
  const auto fitToNoise = [&] (ChartLayout& chart) {
    DescentLimits descent = limits.descent;
    descent.steps = limits.steps_to_noise;
    descent.newton_steps = 0;
    if (shareMoved (chart) > 0.0)
      refineLayout (mesh.triangles, positions, descent, within, chart);
  };
  // Where smoothing has removed more than noise, the chart is laid out without it.
  const auto isRight = [&] (const ChartLayout& chart) {
    const double most = shareMoved (chart) > limits.noisy ? limits.wrong : limits.too_much;
    return stretchOf (chart, positions) <= std::max (most, largest_stretch);
  };
  Layouts result;
  std::vector<std::uint8_t> is_done (mesh.triangles.size (), 0);
  if (whole_discs) {
    const MeshComponents components = findComponents (mesh, run);
    const std::vector<std::vector<Index>> lists =
        listsOf ({components.of_triangle, components.count});
    Layouts discs (lists.size ());
    parallelTasks (run, lists.size (), [&] (std::size_t c) {
      ChartLayout& disc = discs[c];
      disc = by_smooth.layOutWhole (lists[c]);
      if (!disc.uv.empty () && (isRight (disc) || shareMoved (disc) == 0.0))
        return;
      ChartLayout other = by_true.layOutWhole (lists[c]);
      if (disc.uv.empty () || (!other.uv.empty () && other.stretch < stretchOf (disc, positions)))
        disc = std::move (other);
    });
    for (ChartLayout& disc : discs)
      if (!disc.uv.empty ()) {
        for (const Index t : disc.triangles)
          is_done[t] = 1;
        result.push_back (std::move (disc));
      }
  }
  run.beginStep (0.1);
  const double deviation = limits.charts.deviation;
  const MeshParts parts = findCharts (mesh, smooth, {deviation, 1}, limits.charts, run);
  run.beginStep (0.95);
  const std::vector<std::vector<Index>> lists = listsOf (parts);
  std::vector<Layouts> layouts (lists.size ());
  parallelTasks (run, lists.size (), [&] (std::size_t c) {
    if (is_done[lists[c].front ()] != 0)
      return;
    Layouts by_parts;
    by_smooth.layOutParts (by_smooth.layOut (lists[c]), deviation, by_parts);
    for (ChartLayout& chart : by_parts) {
      fitToNoise (chart);
      if (isRight (chart)) {
        layouts[c].push_back (std::move (chart));
        continue;
      }
      ChartLayout other = by_true.layOut (chart.triangles);
      if (other.uv.empty () || !(other.stretch < stretchOf (chart, positions)))
        layouts[c].push_back (std::move (chart));
      else
        by_true.layOutParts (std::move (other), deviation, layouts[c]);
    }
  });
  for (Layouts& of_part : layouts)
    std::move (of_part.begin (), of_part.end (), std::back_inserter (result));
  std::sort (result.begin (), result.end (), [] (const ChartLayout& a, const ChartLayout& b) {
    return a.triangles.front () < b.triangles.front ();
  });
  return result;
}

} // namespace pcl::floater
