// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/atlas.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "core/parallel.h"
#include "texture/cell_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// Signed area.
double
planeArea (const ChartLayout& chart)
{
  double area = 0.0;
  for (const Triangle& t : chart.corners)
    area += 0.5 * cross (Eigen::Vector2d (chart.uv[t[1]] - chart.uv[t[0]]),
                         Eigen::Vector2d (chart.uv[t[2]] - chart.uv[t[0]]));
  return area;
}

// Direction of a side of the smallest enclosing rectangle, which is along an edge of the hull
// (Freeman and Shapira 1975).
Eigen::Vector2d
longSideOfBox (const ChartLayout& chart)
{
  std::vector<Eigen::Vector2d> places, hull;
  places.reserve (chart.loop.size ());
  for (const Index p : chart.loop)
    places.push_back (chart.uv[p]);
  for (const std::size_t corner : convexHull (places))
    hull.push_back (places[corner]);
  Eigen::Vector2d best = Eigen::Vector2d::UnitX ();
  double least = std::numeric_limits<double>::infinity ();
  for (std::size_t i = 0; i < hull.size (); ++i) {
    const Eigen::Vector2d along = (hull[(i + 1) % hull.size ()] - hull[i]).normalized ();
    const Eigen::Vector2d across (-along.y (), along.x ());
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : hull)
      box.extend (Eigen::Vector2d (along.dot (p), across.dot (p)));
    if (box.volume () < least) {
      least = box.volume ();
      best = box.sizes ().x () >= box.sizes ().y () ? along : across;
    }
  }
  return best;
}

// Rotates and scales the chart, with the lower left corner of its box at the origin, in cells.
void
turnAndScale (ChartLayout& chart, double area)
{
  const Eigen::Vector2d up = longSideOfBox (chart), right (up.y (), -up.x ());
  const double scale = std::sqrt (area / planeArea (chart));
  Eigen::AlignedBox2d box;
  for (Eigen::Vector2d& p : chart.uv) {
    p = scale * Eigen::Vector2d (right.dot (p), up.dot (p));
    box.extend (p);
  }
  for (Eigen::Vector2d& p : chart.uv)
    p -= box.min ();
}

// Rotates by quarter turns anti-clockwise, in a box that stays at the origin.
void
turnQuarters (std::vector<Eigen::Vector2d>& uv, int quarters)
{
  Eigen::Vector2d size = Eigen::Vector2d::Zero ();
  for (const Eigen::Vector2d& p : uv)
    size = size.cwiseMax (p);
  for (int q = 0; q < quarters; ++q) {
    for (Eigen::Vector2d& p : uv)
      p = Eigen::Vector2d (size.y () - p.y (), p.x ());
    std::swap (size.x (), size.y ());
  }
}

void
fitOne (ChartLayout& chart, double gutter)
{
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : chart.uv)
    box.extend (p);
  const double scale = (1.0 - gutter) / box.sizes ().maxCoeff ();
  for (Eigen::Vector2d& p : chart.uv)
    p = Eigen::Vector2d::Constant (0.5) + scale * (p - box.center ());
}

} // namespace

Atlas
packCharts (std::vector<ChartLayout>& charts, const AtlasLimits& limits, const RunContext& run)
{
  Atlas atlas;
  if (charts.empty ())
    return atlas;
  const double cells = std::max (
      static_cast<double> (limits.cells),
      std::ceil (limits.cells_per_chart * std::sqrt (static_cast<double> (charts.size ()))));
  double total = 0.0;
  for (const ChartLayout& chart : charts)
    total += chart.area * chart.stretch;
  const double cells_per_area = limits.first_fill * cells * cells / total;
  std::vector<std::array<CellMask, 4>> masks (charts.size ());
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    turnAndScale (charts[c], cells_per_area * charts[c].area * charts[c].stretch);
    std::vector<Eigen::Vector2d> uv = charts[c].uv;
    for (CellMask& mask : masks[c]) {
      mask = makeCellMask (charts[c].corners, uv);
      turnQuarters (uv, 1);
    }
  });
  if (charts.size () == 1) {
    atlas.gutter = 2.0 / cells;
    fitOne (charts.front (), atlas.gutter);
    return atlas;
  }
  const CellPacking packing = packCells (masks, limits.attempts, run);
  const double side = static_cast<double> (packing.side);
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    const CellPlace& place = packing.places[c];
    turnQuarters (charts[c].uv, place.quarters);
    const Eigen::Vector2d corner (static_cast<double> (place.x + 1),
                                  static_cast<double> (place.y + 1));
    for (Eigen::Vector2d& p : charts[c].uv)
      p = (p + corner) / side;
  });
  atlas.gutter = 2.0 / side;
  return atlas;
}

} // namespace pcl::floater
