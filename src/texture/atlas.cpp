// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exact.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "texture/chart_layout.h"

#include <boost/icl/interval_set.hpp>

namespace pcl::floater {
namespace {
// Packing cells along the side of the square. Charts are 2 cells apart: 4 pixels of a texture of 2048,
// enough for two levels of a mipmap.
constexpr double LEAST_CELLS = 1024.0;

// The same for many charts, over the root of their number. A chart takes at least 3 x 3.
constexpr double CELLS_PER_CHART = 12.0;

constexpr double FIRST_FILL = 0.75; // share of the square to be covered in the first attempt
constexpr int MOST_WIDTHS = 4;      // tried for the square

// Cells of a row, from a first one up to, and without, an end.
using Cells = boost::icl::right_open_interval<Index>;

// Whether cells are taken, by rows, the lowest first.
using CellArray = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A shape of cells.
struct CellMask
{
  Index width = 0;
  std::vector<std::vector<Cells>> rows; // the lowest first; in order, not adjacent
  std::size_t cells = 0;
};

using TurnedMasks = std::array<CellMask, 4>; // of a shape in four directions

// Position of a shape: the lower left cell of its box.
struct CellPlace
{
  Index x = 0, y = 0;
  std::uint8_t quarters = 0; // which of the four directions of the shape
};

// Rows of shapes that the search for places may look at, at some 20 nanoseconds.
constexpr std::size_t MOST_WORK = 50'000'000, MOST_WORK_OF_SHAPE = 10'000;

// Least and largest x of a triangle between the heights low and high. Empty if it is not there.
std::pair<double, double>
extentBetween (const std::array<Vector2d, 3>& corners, double low, double high)
{
  double least = std::numeric_limits<double>::infinity (), largest = -least;
  const auto extend = [&] (double x) {
    least = std::min (least, x);
    largest = std::max (largest, x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.y () >= low && a.y () <= high)
      extend (a.x ());
    for (const double y : {low, high})
      if ((a.y () < y && b.y () > y) || (a.y () > y && b.y () < y))
        extend (a.x () + (b.x () - a.x ()) * ((y - a.y ()) / (b.y () - a.y ())));
  }
  return {least, largest};
}

// A strip of cells of a given width and any height.
struct Strip
{
  using CellRow = boost::icl::interval_set<Index, std::less, Cells>;

  Index width;
  std::vector<CellRow> rows{}; // occupied cells
  std::size_t work = 0;        // rows of shapes that were looked at

  // The lowest free position of a shape from a row on, then the leftmost one; in row `end` if there
  // is none below. For shapes that are not wider than the strip.
  CellPlace findPlace (const CellMask& shape, CellPlace place, std::size_t end)
  {
    while (place.y < end && !moveToFree (shape, place))
      place = {0, place.y + 1};
    return place;
  }

  void occupy (const CellMask& shape, const CellPlace& place)
  {
    rows.resize (std::max (rows.size (), place.y + shape.rows.size ()));
    for (std::size_t r = 0; r < shape.rows.size (); ++r)
      for (const Cells& run : shape.rows[r])
        rows[place.y + r] += Cells (place.x + run.lower (), place.x + run.upper ());
  }

  // Moves a shape to the right until it is free. All positions that it skips are occupied.
  // \return false if it leaves the strip
  bool moveToFree (const CellMask& shape, CellPlace& place)
  {
    const std::size_t tested =
        std::min (shape.rows.size (), rows.size () - std::min (rows.size (), std::size_t{place.y}));
    std::size_t free_rows = 0; // the last tested ones
    for (std::size_t r = 0; free_rows < tested && place.x + shape.width <= width;
         r = r + 1 < tested ? r + 1 : 0, ++work)
      free_rows = moveInRow (rows[place.y + r], shape.rows[r], place.x) ? 1 : free_rows + 1;
    return place.x + shape.width <= width;
  }

  // \return whether the shape was moved
  static bool moveInRow (const CellRow& taken, const std::vector<Cells>& runs, Index& x)
  {
    const Index before = x;
    for (auto run = runs.begin (); run != runs.end ();) {
      const auto in_way = taken.find (Cells (x + run->lower (), x + run->upper ()));
      if (in_way == taken.end ())
        ++run;
      else {
        x = in_way->upper () - run->lower ();
        run = runs.begin ();
      }
    }
    return x != before;
  }
};

// \param[out] places of the shapes
// \return the height, in cells
Index
packInStrip (const std::vector<TurnedMasks>& shapes, const std::vector<Index>& order, Index width,
             const RunContext& run, std::vector<CellPlace>& places)
{
  places.resize (shapes.size ());
  Strip strip{width};
  // Where there are thousands of long shapes, such as needles, the rest is packed as boxes upwards.
  const std::size_t most_work = MOST_WORK + MOST_WORK_OF_SHAPE * shapes.size ();
  CellPlace last_of_rest;
  ProgressLoop progress (run, shapes.size ());
  for (const Index s : order) {
    progress.reach (static_cast<std::size_t> (&s - order.data ()));
    if (strip.work > most_work) {
      CellMask box = shapes[s][0];
      box.rows.assign (box.rows.size (), {Cells (0, box.width)});
      places[s] = last_of_rest = strip.findPlace (box, last_of_rest, NONE);
      strip.occupy (box, last_of_rest);
      continue;
    }
    std::size_t least_top = NONE;
    for (std::uint8_t quarters = 0; quarters < 4; ++quarters) {
      const CellMask& shape = shapes[s][quarters];
      if (shape.width > width || shape.rows.size () >= least_top)
        continue;
      CellPlace place = strip.findPlace (shape, {}, least_top - shape.rows.size ());
      place.quarters = quarters;
      if (const std::size_t top = place.y + shape.rows.size (); top < least_top) {
        least_top = top;
        places[s] = place;
      }
    }
    strip.occupy (shapes[s][places[s].quarters], places[s]);
  }
  return static_cast<Index> (strip.rows.size ());
}

// The cells that triangles touch, and those beside, from one left of and below the origin on.
// \param uv per vertex, in cells, not negative
CellArray
touchedCells (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv)
{
  Vector2d size = Vector2d::Zero ();
  for (const Vector2d& p : uv)
    size = size.cwiseMax (p);
  const auto cellOf = [] (double x) { return static_cast<Eigen::Index> (std::max (x, 0.0)); };
  // Cell (x, y) of the plane is in row y + 1 and column x + 1.
  CellArray touched = CellArray::Zero (cellOf (size.y ()) + 3, cellOf (size.x ()) + 3);
  for (const Triangle& t : triangles) {
    const std::array<Vector2d, 3> corners{uv[t[0]], uv[t[1]], uv[t[2]]};
    const auto [low, high] = std::minmax ({corners[0].y (), corners[1].y (), corners[2].y ()});
    for (Eigen::Index row = cellOf (low); row <= cellOf (high); ++row) {
      const auto [least, largest] =
          extentBetween (corners, static_cast<double> (row), static_cast<double> (row) + 1.0);
      if (least <= largest)
        touched.block (row, cellOf (least), 3, cellOf (largest) - cellOf (least) + 3) = true;
    }
  }
  return touched;
}

CellMask
makeCellMask (const CellArray& taken)
{
  CellMask mask;
  mask.width = static_cast<Index> (taken.cols ());
  mask.cells = static_cast<std::size_t> (taken.count ());
  mask.rows.resize (static_cast<std::size_t> (taken.rows ()));
  for (std::size_t y = 0; y < mask.rows.size (); ++y) {
    const auto isTaken = [&, row = static_cast<Eigen::Index> (y)] (Index x) {
      return x < mask.width && taken (row, x);
    };
    for (Index x = 0; x < mask.width; ++x) {
      const Index first = x;
      while (isTaken (x))
        ++x;
      if (x > first)
        mask.rows[y].emplace_back (first, x);
    }
  }
  return mask;
}

// Packs shapes into a small square: largest first, each at the lowest free position in a strip. The
// width is varied until it equals the height.
// \return the positions, and the side of the square in cells
std::pair<std::vector<CellPlace>, Index>
packCells (const std::vector<TurnedMasks>& shapes, const RunContext& run)
{
  std::vector<Index> order = indicesBelow (shapes.size ());
  std::stable_sort (order.begin (), order.end (), [&shapes] (Index a, Index b) {
    return shapes[a][0].cells > shapes[b][0].cells;
  });
  std::size_t cells = 0;
  Index least_width = 1;
  for (const auto& shape : shapes) {
    cells += shape[0].cells;
    least_width = std::max (least_width, shape[0].width);
  }
  constexpr double EXPECTED_FILL = 0.85;
  auto width = std::max (
      least_width, static_cast<Index> (std::sqrt (static_cast<double> (cells) / EXPECTED_FILL)));
  std::vector<CellPlace> best, places;
  Index least_side = NONE;
  for (int attempt = 0; attempt < MOST_WIDTHS; ++attempt) {
    const Index height = packInStrip (shapes, order, width, run, places);
    if (std::max (width, height) < least_side) {
      least_side = std::max (width, height);
      best.swap (places);
    }
    // Side of the square of the same area.
    const auto next = std::max (
        least_width, static_cast<Index> (std::sqrt (static_cast<double> (width) * height)));
    if (next == width)
      break;
    width = next;
  }
  return {std::move (best), least_side};
}

// The long side of the smallest box, which is along an edge of the hull (Freeman, Shapira 1975).
Vector2d
longSideOfBox (const ChartLayout& chart)
{
  const std::vector<Vector2d> hull = convexHull (valuesAt (chart.uv, chart.chart.loop));
  Vector2d best = Vector2d::UnitX ();
  double least = std::numeric_limits<double>::infinity ();
  for (std::size_t i = 0; i < hull.size (); ++i) {
    const Vector2d along = (hull[(i + 1) % hull.size ()] - hull[i]).normalized ();
    const Vector2d across (-along.y (), along.x ());
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : hull)
      box.extend (Vector2d (along.dot (p), across.dot (p)));
    if (box.volume () < least) {
      least = box.volume ();
      best = box.sizes ().x () >= box.sizes ().y () ? along : across;
    }
  }
  return best;
}

// Rotates and scales the chart, with the lower left corner of its box at the origin, in cells.
void
turnAndScale (ChartLayout& chart, double area, double longest)
{
  constexpr double SHORTEST = 0.5;     // rounding leaves triangles of that size as they are
  constexpr double LEAST_AREA = 1e-30; // above zero, so that it can be scaled
  const Vector2d up = longSideOfBox (chart), right (up.y (), -up.x ());
  double plane_area = 0.0;
  for (const auto& [a, b, c] : chart.chart.mesh.triangles)
    plane_area += 0.5 * cross (chart.uv[b] - chart.uv[a], chart.uv[c] - chart.uv[a]);
  const double scale = std::sqrt (std::max (area, LEAST_AREA) / plane_area);
  Eigen::AlignedBox2d box;
  for (Vector2d& p : chart.uv) {
    p = scale * Vector2d (right.dot (p), up.dot (p));
    box.extend (p);
  }
  const double length = box.sizes ().maxCoeff ();
  const double factor = std::clamp (length, SHORTEST, longest) / length;
  for (Vector2d& p : chart.uv)
    p = factor * p - factor * box.min ();
}

} // namespace

double
packCharts (std::vector<ChartLayout>& charts, const RunContext& run)
{
  if (charts.empty ())
    return 0.0;
  const double cells = std::max (
      LEAST_CELLS, std::ceil (CELLS_PER_CHART * std::sqrt (static_cast<double> (charts.size ()))));
  const auto weightOf = [] (const ChartLayout& chart) {
    constexpr double MOST_STRETCH = 1000.0;
    return chart.area * std::min (chart.stretch, MOST_STRETCH);
  };
  constexpr double LONGEST = 4.0; // squares; longer ones would leave most of the atlas empty
  double total = std::numeric_limits<double>::min ();
  for (const ChartLayout& chart : charts)
    total += weightOf (chart);
  const double cells_per_area = FIRST_FILL * cells * cells / total;
  std::vector<TurnedMasks> masks (charts.size ());
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    turnAndScale (charts[c], cells_per_area * weightOf (charts[c]), LONGEST * cells);
    CellArray touched = touchedCells (charts[c].chart.mesh.triangles, charts[c].uv);
    for (CellMask& mask : masks[c]) {
      mask = makeCellMask (touched);
      touched = CellArray (touched.transpose ().rowwise ().reverse ());
    }
  });
  const auto packed = packCells (masks, run);
  const auto side = static_cast<double> (packed.second);
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    const auto& [x, y, quarters] = packed.first[c];
    // Rotates by quarter turns anti-clockwise, in a box of whole cells that stays at the origin.
    Vector2d size = Vector2d::Zero ();
    for (const Vector2d& p : charts[c].uv)
      size = size.cwiseMax (p.array ().floor ().matrix () + Vector2d::Ones ());
    for (int q = 0; q < quarters; ++q) {
      for (Vector2d& p : charts[c].uv)
        p = Vector2d (size.y () - p.y (), p.x ());
      std::swap (size.x (), size.y ());
    }
    const Vector2d corner (static_cast<double> (x + 1), static_cast<double> (y + 1));
    for (Vector2d& p : charts[c].uv)
      p = (p + corner) / side;
  });
  return 2.0 / side;
}

} // namespace pcl::floater
