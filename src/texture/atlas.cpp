// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/atlas.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

#include <map>

namespace pcl::floater {
namespace {
// Cells first to last of a row.
struct CellRun
{
  Index first, last;
};

// A shape of cells: for each row its runs, in order, not adjacent.
struct CellMask
{
  Index width = 0;
  std::vector<std::vector<CellRun>> rows; // the lowest first
  std::size_t cells = 0;
};

using TurnedMasks = std::array<CellMask, 4>; // of a shape in four directions

// Position of a shape: the lower left cell of its box.
struct CellPlace
{
  Index x = 0, y = 0;
  std::uint8_t quarters = 0; // which of the four directions of the shape
};

// Shapes up to this many cells wide and high are packed as boxes: the search for one can start
// where the last one of its size was placed.
constexpr std::size_t SMALL = 8;

// Rows of shapes that the search for places may look at, at some 5 nanoseconds.
constexpr std::size_t MOST_WORK = 100'000'000, MOST_WORK_OF_SHAPE = 10'000;

// Sorts runs, and joins adjacent ones.
void
joinRuns (std::vector<CellRun>& runs)
{
  std::sort (runs.begin (), runs.end (),
             [] (const CellRun& a, const CellRun& b) { return a.first < b.first; });
  std::size_t kept = 0;
  for (const CellRun& run : runs) {
    if (kept > 0 && run.first <= runs[kept - 1].last + 1)
      runs[kept - 1].last = std::max (runs[kept - 1].last, run.last);
    else
      runs[kept++] = run;
  }
  runs.resize (kept);
}

// Least and largest x of a triangle between the heights low and high. Empty if it has no point
// there.
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
class Strip
{
public:
  explicit Strip (Index width) : width_ (width) {}

  // The lowest free position of a shape from a row on, then the leftmost one; in row `end` if there
  // is none below. For shapes that are not wider than the strip.
  CellPlace findPlace (const CellMask& shape, CellPlace from, std::size_t end) const
  {
    CellPlace place = from;
    for (; place.y < end; ++place.y, place.x = 0, work_ += shape.rows.size ())
      if (isWideEnough (shape, place.y) && moveToFree (shape, place))
        break;
    return place;
  }

  void occupy (const CellMask& shape, const CellPlace& place)
  {
    rows_.resize (std::max (rows_.size (), place.y + shape.rows.size ()));
    for (std::size_t r = 0; r < shape.rows.size (); ++r) {
      std::vector<CellRun>& row = rows_[place.y + r];
      for (const CellRun& run : shape.rows[r])
        row.push_back ({place.x + run.first, place.x + run.last});
      joinRuns (row);
      widest_.resize (rows_.size (), width_);
      Index free = 0, last = 0; // free cells; end of the occupied ones
      for (const CellRun& run : row) {
        free = std::max (free, run.first - last);
        last = run.last + 1;
      }
      widest_[place.y + r] = std::max (free, width_ - last);
    }
  }

  std::size_t height () const { return rows_.size (); }

  std::size_t work () const { return work_; } // rows of shapes that were looked at

private:
  // Whether every row of the shape is at most as wide as the widest free run in its row.
  bool isWideEnough (const CellMask& shape, Index y) const
  {
    for (std::size_t r = 0; r < shape.rows.size () && y + r < rows_.size (); ++r)
      for (const CellRun& run : shape.rows[r])
        if (widest_[y + r] <= run.last - run.first)
          return false;
    return true;
  }

  // Moves a shape to the right until it is free. Skipped positions are occupied, so earlier rows
  // need no new test.
  // \return false if it leaves the strip
  bool moveToFree (const CellMask& shape, CellPlace& place) const
  {
    const std::size_t rows = std::min (
        shape.rows.size (), rows_.size () - std::min (rows_.size (), std::size_t{place.y}));
    std::size_t free_rows = 0; // the last tested ones
    for (std::size_t r = 0; free_rows < rows && place.x + shape.width <= width_;
         r = r + 1 < rows ? r + 1 : 0, ++work_)
      free_rows = moveInRow (rows_[place.y + r], shape.rows[r], place.x) ? 1 : free_rows + 1;
    return place.x + shape.width <= width_;
  }

  // \return whether the shape was moved
  static bool moveInRow (const std::vector<CellRun>& taken, const std::vector<CellRun>& runs,
                         Index& x)
  {
    const Index before = x;
    for (std::size_t i = 0; i < runs.size ();) {
      const auto in_way =
          std::lower_bound (taken.begin (), taken.end (), x + runs[i].first,
                            [] (const CellRun& t, Index first) { return t.last < first; });
      if (in_way != taken.end () && in_way->first <= x + runs[i].last) {
        x = in_way->last + 1 - runs[i].first;
        i = 0;
      }
      else
        ++i;
    }
    return x != before;
  }

  Index width_;
  std::vector<std::vector<CellRun>> rows_; // occupied cells
  std::vector<Index> widest_;              // of each row: length of the longest free run
  mutable std::size_t work_ = 0;
};

// \param[out] places of the shapes
// \return the height, in cells
Index
packInStrip (const std::vector<TurnedMasks>& shapes, const std::vector<Index>& order, Index width,
             const RunContext& run, std::vector<CellPlace>& places)
{
  places.resize (shapes.size ());
  Strip strip (width);
  std::map<std::pair<Index, std::size_t>, CellPlace> last_places; // of boxes of a size
  // Where there are thousands of long shapes, such as needles, the rest is packed as boxes upwards.
  const std::size_t most_work = MOST_WORK + MOST_WORK_OF_SHAPE * shapes.size ();
  CellPlace last_of_rest;
  ProgressLoop progress (run, shapes.size ());
  for (const Index s : order) {
    progress.reach (static_cast<std::size_t> (&s - order.data ()));
    CellPlace best;
    CellMask box = shapes[s][0];
    const bool is_small = box.width <= SMALL && box.rows.size () <= SMALL;
    if (is_small || strip.work () > most_work) {
      for (std::vector<CellRun>& row : box.rows)
        row = {{0, box.width - 1}};
      CellPlace& last = is_small ? last_places[{box.width, box.rows.size ()}] : last_of_rest;
      last = best = strip.findPlace (box, last, NONE);
      strip.occupy (box, best);
    }
    else {
      std::size_t least_top = NONE;
      for (std::uint8_t quarters = 0; quarters < 4; ++quarters) {
        const CellMask& shape = shapes[s][quarters];
        if (shape.width > width || shape.rows.size () >= least_top)
          continue;
        CellPlace place = strip.findPlace (shape, {}, least_top - shape.rows.size ());
        place.quarters = quarters;
        const std::size_t top = place.y + shape.rows.size ();
        if (top < least_top) {
          least_top = top;
          best = place;
        }
      }
      strip.occupy (shapes[s][best.quarters], best);
    }
    places[s] = best;
  }
  return static_cast<Index> (strip.height ());
}

// The cells that triangles touch, and all adjacent cells; so the shape begins one cell left of and
// below the origin. O(triangles + cells).
// \param uv per vertex, in cells, not negative
CellMask
makeCellMask (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv)
{
  // Cell (x, y) of the plane is cell (x + 1, y + 1) of the mask.
  CellMask mask;
  Vector2d size = Vector2d::Zero ();
  for (const Vector2d& p : uv)
    size = size.cwiseMax (p);
  const auto cellOf = [] (double x) { return static_cast<Index> (std::max (x, 0.0)); };
  std::vector<std::vector<CellRun>> touched (cellOf (size.y ()) + std::size_t{1});
  for (const Triangle& t : triangles) {
    const std::array<Vector2d, 3> corners{uv[t[0]], uv[t[1]], uv[t[2]]};
    const auto [low, high] = std::minmax ({corners[0].y (), corners[1].y (), corners[2].y ()});
    for (Index row = cellOf (low); row <= cellOf (high); ++row) {
      const auto [least, largest] =
          extentBetween (corners, static_cast<double> (row), static_cast<double> (row) + 1.0);
      if (least <= largest) {
        touched[row].push_back ({cellOf (least), cellOf (largest)});
        constexpr std::size_t MANY = 64;
        if (touched[row].size () > MANY)
          joinRuns (touched[row]);
      }
    }
  }
  mask.rows.resize (touched.size () + 2);
  mask.width = cellOf (size.x ()) + 3;
  for (std::size_t row = 0; row < touched.size (); ++row) {
    joinRuns (touched[row]);
    for (const CellRun& run : touched[row])
      for (std::size_t beside = row; beside <= row + 2; ++beside)
        mask.rows[beside].push_back ({run.first, run.last + 2});
  }
  for (std::vector<CellRun>& row : mask.rows) {
    joinRuns (row);
    for (const CellRun& run : row)
      mask.cells += run.last - run.first + 1;
  }
  return mask;
}

// Packs shapes into a small square: largest first, each at the lowest free position in a strip. The
// width is varied until it equals the height.
// \return the positions, and the side of the square in cells
std::pair<std::vector<CellPlace>, Index>
packCells (const std::vector<TurnedMasks>& shapes, int attempts, const RunContext& run)
{
  std::vector<Index> order (shapes.size ());
  std::iota (order.begin (), order.end (), Index{0});
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
  for (int attempt = 0; attempt < attempts; ++attempt) {
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

// Direction of a side of the smallest enclosing rectangle, which is along an edge of the hull
// (Freeman and Shapira 1975).
Vector2d
longSideOfBox (const ChartLayout& chart)
{
  const std::vector<Vector2d> places = valuesAt (chart.uv, chart.loop);
  const std::vector<Vector2d> hull = valuesAt (places, convexHull (places));
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
  constexpr double SHORTEST = 1.0 / 16.0; // rounding leaves triangles of that size as they are
  constexpr double LEAST_AREA = 1e-30;    // above zero, so that it can be scaled
  const Vector2d up = longSideOfBox (chart), right (up.y (), -up.x ());
  double plane_area = 0.0;
  for (const auto& [a, b, c] : chart.corners)
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

// Rotates by quarter turns anti-clockwise, in a box that stays at the origin.
void
turnQuarters (std::vector<Vector2d>& uv, int quarters)
{
  Vector2d size = Vector2d::Zero ();
  for (const Vector2d& p : uv)
    size = size.cwiseMax (p);
  for (int q = 0; q < quarters; ++q) {
    for (Vector2d& p : uv)
      p = Vector2d (size.y () - p.y (), p.x ());
    std::swap (size.x (), size.y ());
  }
}

} // namespace

double
packCharts (std::vector<ChartLayout>& charts, const AtlasLimits& limits, const RunContext& run)
{
  if (charts.empty ())
    return 0.0;
  const double cells = std::max (
      static_cast<double> (limits.cells),
      std::ceil (limits.cells_per_chart * std::sqrt (static_cast<double> (charts.size ()))));
  const auto weightOf = [] (const ChartLayout& chart) {
    constexpr double MOST_STRETCH = 1000.0;
    return chart.area * std::min (chart.stretch, MOST_STRETCH);
  };
  constexpr double LONGEST = 4.0; // squares; longer ones would leave most of the atlas empty
  double total = std::numeric_limits<double>::min ();
  for (const ChartLayout& chart : charts)
    total += weightOf (chart);
  const double cells_per_area = limits.first_fill * cells * cells / total;
  std::vector<TurnedMasks> masks (charts.size ());
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    turnAndScale (charts[c], cells_per_area * weightOf (charts[c]), LONGEST * cells);
    std::vector<Vector2d> uv = charts[c].uv;
    for (CellMask& mask : masks[c]) {
      mask = makeCellMask (charts[c].corners, uv);
      turnQuarters (uv, 1);
    }
  });
  const auto packed = packCells (masks, limits.attempts, run);
  const auto side = static_cast<double> (packed.second);
  parallelTasks (run, charts.size (), [&] (std::size_t c) {
    const auto& [x, y, quarters] = packed.first[c];
    turnQuarters (charts[c].uv, quarters);
    const Vector2d corner (static_cast<double> (x + 1), static_cast<double> (y + 1));
    for (Vector2d& p : charts[c].uv)
      p = (p + corner) / side;
  });
  return 2.0 / side;
}

} // namespace pcl::floater
