// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/star_reach.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
constexpr std::size_t ADDED = 8; // points at a time: about the first ring of an even sampling

// Allows for the rounding of a circumcircle: points on it, as on grids, are not inside.
constexpr double INSIDE = 1.0 - 1e-9;

// Unrolled into the plane: the direction of the projection, the length in space, as in the stars.
Vector2d
unrolled (const TangentFrame& frame, const Vector3d& offset)
{
  const Vector2d projected = frame.project (offset);
  const double planar_length = projected.norm ();
  return planar_length > 0.0 ? Vector2d (projected * (offset.norm () / planar_length)) : projected;
}

Vector3d
inSpace (const TangentFrame& frame, const Vector2d& planar)
{
  return frame.x * planar.x () + frame.y * planar.y ();
}

// Middle direction of the gap from the last neighbour of an open star to the first.
Vector2d
middleOfGap (const std::vector<PlanarNeighbor>& star)
{
  const Vector2d first = star.front ().offset.normalized ();
  const Vector2d last = star.back ().offset.normalized ();
  const Vector2d sum = first + last;
  constexpr double STRAIGHT = 1e-6;
  if (star.size () == 1)
    return -first;
  if (sum.norm () < STRAIGHT)
    return {-last.y (), last.x ()};
  const bool is_reflex = cross (last, first) < 0.0;
  return is_reflex ? Vector2d (-sum.normalized ()) : Vector2d (sum.normalized ());
}

// Distance to which far neighbours of a point are searched, by its nearest neighbours. Where points on
// a line are strewn, those nearest may be close to each other by chance, and tell nothing of the
// steps around; the whole row, which goes to either side, does.
double
farthestFrom (const Positions& positions, Index p, Row nearest, double spacing)
{
  // Spacings. Rows of points are to be joined up to 30 times as far apart as the points in a row,
  // and a third more for uneven rows.
  constexpr double FARTHEST = 40.0;
  if (nearest.size () == 0)
    return FARTHEST * spacing;
  // With even steps on a line, the mean distance to the nearest six is two steps; in a plane, the row
  // gives less than this mean.
  const double steps = static_cast<double> (nearest.size ()) / 2.0;
  const double last = (positions[nearest[nearest.size () - 1]] - positions[p]).norm ();
  return FARTHEST * std::max (spacing, 2.0 * last / steps);
}

} // namespace

std::optional<Line>
lineThrough (const Positions& positions, Index p, Row row, double least_aspect)
{
  constexpr double WIDE = 0.3; // sum of squares across over along; 0.05 is a line
  if (row.size () == 0)
    return {};
  // Much faster than a fit: whether neighbours spread to the sides of the direction of the farthest.
  const Vector3d& here = positions[p];
  const Vector3d direction = (positions[row[row.size () - 1]] - here).normalized ();
  double along = 0.0, all = 0.0;
  for (const Index q : row) {
    const Vector3d offset = positions[q] - here;
    const double step = direction.dot (offset);
    along += step * step;
    all += offset.squaredNorm ();
  }
  if (!(all - along <= WIDE * along))
    return {};
  PlaneFit fit;
  fit.add (Vector3d::Zero ());
  for (const Index q : row)
    fit.add (positions[q] - here);
  const Line line = fit.line ();
  return line.aspect < least_aspect ? std::optional (line) : std::nullopt;
}

bool
liesBeside (const Line& line, const Vector3d& offset)
{
  constexpr double LINE_SINE = 0.5;   // of the angle, 30 degrees, to points beside the line
  constexpr double THICKNESSES = 4.0; // standard deviations; nearer points belong to the line
  const double along = line.direction.dot (offset);
  const double sqr_lateral = (offset - line.direction * along).squaredNorm ();
  return sqr_lateral > THICKNESSES * THICKNESSES * line.mean_square &&
         sqr_lateral >= LINE_SINE * LINE_SINE * offset.squaredNorm ();
}

float
BesideSearch::extend (Index p)
{
  constexpr double ROUNDED_UP = 1.0 + 1e-12, LEAST_COSINE = 1e-9;
  constexpr std::size_t FEWEST = 10;
  constexpr double CLOSELY = 0.1; // rows of a raster with rounded coordinates are rougher
  const Vector3d& here = positions[p];
  const Row around = planes.neighbors.row (p);
  row.assign (around.begin (), around.end ());
  std::optional<Line> line = lineThrough (positions, p, around);
  // Or through the nearer half, if these lie on a line much more closely. Where the farther half has a
  // few points of one line beside, but none of the other, these neither surround the point nor fix its
  // plane.
  if (!line && around.size () > FEWEST)
    line = lineThrough (positions, p,
                        planes.neighbors.first (p, std::max (FEWEST, around.size () / 2)),
                        CLOSELY * LINE_ASPECT);
  if (!line)
    return 0.0F;
  // The tree may return points behind the plane of its search, which depends on its nodes: they are
  // rejected, with a tolerance for rounding.
  Vector3d ahead = Vector3d::Zero ();
  const auto is_beside = [&] (const Neighbor&, const Vector3d& position) {
    const Vector3d offset = position - here;
    return liesBeside (*line, offset) &&
           (ahead.isZero (0.0) ||
            ahead.dot (offset) > LEAST_COSINE * ahead.norm () * offset.norm ());
  };
  const double farthest =
      farthestFrom (positions, p, around, static_cast<double> (planes.spacing[p]));
  // First on the side of the nearest one, then on the opposite side.
  double nearest = 0.0;
  for (std::vector<Neighbor>& found : found_on) {
    const bool is_first = &found == found_on.data ();
    // If all that the last point has found are beside this one, the nearest are no farther.
    double bound = 0.0;
    const bool is_bounded = found.size () == ADDED &&
                            std::all_of (found.begin (), found.end (), [&] (const Neighbor& other) {
                              const Vector3d& position = positions[other.point];
                              bound = std::max (bound, ROUNDED_UP * (position - here).norm ());
                              return is_beside (other, position);
                            });
    planes.tree->looked (here, planes.tree->nearestIf (
                                   here, ahead, is_bounded ? std::min (bound, farthest) : farthest,
                                   ADDED, is_beside, found));
    if (found.empty ()) // beside the last line
      return is_first ? 0.0F : static_cast<float> (nearest);
    const double distance = std::sqrt (found.front ().sqr_distance);
    nearest = is_first ? distance : std::min (nearest, distance);
    const Vector3d offset = positions[found.front ().point] - here;
    ahead = line->direction * line->direction.dot (offset) - offset;
    for (const Neighbor& neighbor : found)
      if (std::find (row.begin (), row.end (), neighbor.point) == row.end ())
        row.push_back (neighbor.point);
  }
  return static_cast<float> (nearest);
}

void
appendRows (const CsrLists& added, CsrLists& lists)
{
  if (added.ids.empty ())
    return;
  requireListed (lists.ids.size () + added.ids.size ());
  std::size_t last = lists.ids.size ();         // one past the entries not yet moved
  lists.ids.reserve (last + added.ids.size ()); // growing might double it
  lists.ids.resize (last + added.ids.size ());
  // From the last row to the first: entries move backwards, in runs of rows to which nothing is
  // added.
  for (std::size_t r = lists.rows (); r-- > 0;) {
    const Index end = lists.offsets[r + 1], end_of_more = added.offsets[r + 1];
    lists.offsets[r + 1] = end + end_of_more;
    const Row more = added.row (r);
    if (more.size () == 0)
      continue;
    Index* const ids = lists.ids.data ();
    std::copy_backward (ids + end, ids + last, ids + last + end_of_more);
    std::copy (more.begin (), more.end (), ids + end + added.offsets[r]);
    last = end;
  }
}

bool
StarReach::extend (Index p, const TangentFrame& frame, bool open,
                   std::vector<PlanarNeighbor>& candidates, std::vector<PlanarNeighbor>& star)
{
  constexpr int ROUNDS = 8; // of one star, to limit the time
  // Of the angle, 75 degrees, between the middle of a gap and points accepted in it. Noise puts
  // points of the same row beside it.
  constexpr double MOST_COSINE = 0.26;
  // For points in circumcircles: normals turn by up to 37 degrees, and on an arc the offset leaves
  // the plane by half of that, less noise. With the limits of near neighbours, two of 24 clean
  // clouds included another sheet; these values fixed both, and are not certain.
  constexpr SheetLimits CIRCLE_SHEET{0.25, 0.8};
  added.clear ();
  const Vector3d& here = positions[p];
  const Row row = planes.neighbors.row (p);
  const Row nearest = planes.neighbors.first (p, row.size () - planes.beside.row (p).size ());
  const double farthest =
      farthestFrom (positions, p, nearest, static_cast<double> (planes.spacing[p]));
  const double sqr_searched = // all points within are in the row
      nearest.size () == 0 ? 0.0 : (positions[nearest[nearest.size () - 1]] - here).squaredNorm ();
  const auto isNew = [&] (Index point, double sqr_distance, const SheetLimits& sheets) {
    // The row may contain neighbours beside a line, which are farther than the nearest.
    return sqr_distance >= sqr_searched &&
           std::find (added.begin (), added.end (), point) == added.end () &&
           std::find (row.begin (), row.end (), point) == row.end () &&
           onSameSheet (frame.normal, planes.normals[point].cast<double> (),
                        positions[point] - here, sheets);
  };
  const auto addFound = [&] {
    for (const Neighbor& neighbor : found)
      added.push_back (neighbor.point);
  };
  const auto lookAhead = [&] {
    const Vector3d ahead = inSpace (frame, middleOfGap (star));
    const auto is_ahead = [&] (const Neighbor& neighbor, const Vector3d& position) {
      const double along = ahead.dot (position - here);
      return along > 0.0 && along * along >= MOST_COSINE * MOST_COSINE * neighbor.sqr_distance &&
             isNew (neighbor.point, neighbor.sqr_distance, {});
    };
    planes.tree->looked (here,
                         planes.tree->nearestIf (here, ahead, farthest, ADDED, is_ahead, found));
    addFound ();
  };
  const auto lookIntoCircle = [&] (const Vector2d& a, const Vector2d& b) {
    const double double_area = cross (a, b);
    if (double_area <= 0.0)
      return;
    const Vector2d difference = a.squaredNorm () * b - b.squaredNorm () * a;
    const Vector2d middle = Vector2d (difference.y (), -difference.x ()) / (2.0 * double_area);
    const double sqr_radius = middle.squaredNorm ();
    if (4.0 * sqr_radius <= sqr_searched || sqr_radius > farthest * farthest / 4.0)
      return;
    const auto is_inside = [&] (const Neighbor& neighbor, const Vector3d& position) {
      const Vector3d offset = position - here;
      return (unrolled (frame, offset) - middle).squaredNorm () < INSIDE * sqr_radius &&
             isNew (neighbor.point, offset.squaredNorm (), CIRCLE_SHEET);
    };
    const double radius = std::sqrt (sqr_radius);
    const double covered = planes.tree->nearestIf (
        here + inSpace (frame, middle), Vector3d::Zero (), radius, ADDED, is_inside, found);
    planes.tree->looked (here, radius + covered);
    addFound ();
  };
  bool gap_is_empty = false;
  for (int round = 0; round < ROUNDS && !star.empty (); ++round) {
    const std::size_t known = added.size ();
    if (open && !gap_is_empty) {
      lookAhead ();
      gap_is_empty = added.size () == known;
    }
    for (std::size_t i = open ? 1 : 0; i < star.size (); ++i)
      lookIntoCircle (star[i == 0 ? star.size () - 1 : i - 1].offset, star[i].offset);
    if (added.size () == known)
      break;
    for (std::size_t i = known; i < added.size (); ++i)
      candidates.push_back ({unrolled (frame, positions[added[i]] - here), added[i]});
    star = candidates;
    open = planar_star.make (star);
  }
  return open;
}

} // namespace pcl::floater
