// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/planar_star.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// Relative to the lengths involved: below it, a cross product of neighbours reads as zero, so that
// rounding on grids does not open a star or turn a straight line into a corner.
constexpr double COLLINEAR = 1e-9;

double
cross (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x () * b.y () - a.y () * b.x ();
}

// Increases with the angle of v, from 0 to 4.
double
pseudoAngle (const Eigen::Vector2d& v)
{
  const double t = v.y () / (std::abs (v.x ()) + std::abs (v.y ()));
  if (v.x () < 0.0)
    return 2.0 - t;
  return v.y () < 0.0 ? 4.0 + t : t;
}

bool
sameDirection (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.dot (b) > 0.0 && std::abs (cross (a, b)) <= COLLINEAR * a.norm () * b.norm ();
}

// Half a turn or more from a to b, anti-clockwise. Neighbours in one direction do not come here.
bool
spansHalfTurn (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return cross (a, b) <= COLLINEAR * a.norm () * b.norm ();
}

// True if b lies strictly outside the segment from a to c, walking anti-clockwise around the
// origin. Where the walk turns back, b is the tip of a spike, however thin: inverted, a very close
// neighbour.
bool
isCorner (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const Eigen::Vector2d ab = b - a;
  const Eigen::Vector2d bc = c - b;
  const double tolerance = ab.dot (bc) > 0.0 ? COLLINEAR * ab.norm () * bc.norm () : 0.0;
  return cross (ab, bc) > tolerance;
}

void
sortByAngle (std::vector<PlanarNeighbor>& neighbors)
{
  std::sort (neighbors.begin (), neighbors.end (),
             [] (const PlanarNeighbor& a, const PlanarNeighbor& b) {
               const double angle_a = pseudoAngle (a.offset);
               const double angle_b = pseudoAngle (b.offset);
               return angle_a != angle_b ? angle_a < angle_b : a.point < b.point;
             });
}

} // namespace

void
PlanarStar::keepNearest (const std::vector<PlanarNeighbor>& sorted)
{
  hull_.clear ();
  for (const PlanarNeighbor& neighbor : sorted) {
    if (hull_.empty () || !sameDirection (hull_.back ().offset, neighbor.offset))
      hull_.push_back (neighbor);
    else if (neighbor.offset.squaredNorm () < hull_.back ().offset.squaredNorm ())
      hull_.back () = neighbor;
  }
  while (hull_.size () > 1 && sameDirection (hull_.back ().offset, hull_.front ().offset)) {
    if (hull_.back ().offset.squaredNorm () < hull_.front ().offset.squaredNorm ())
      hull_.front () = hull_.back ();
    hull_.pop_back ();
  }
}

bool
PlanarStar::beginAfterGap ()
{
  constexpr double TWO_PI = 6.283185307179586;
  const std::size_t count = hull_.size ();
  std::size_t gap = count;
  std::size_t nearest = 0;
  double smallest_cosine = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& a = hull_[i].offset;
    const Eigen::Vector2d& b = hull_[(i + 1) % count].offset;
    const double cosine = a.dot (b) / (a.norm () * b.norm ());
    if (count < 2 || spansHalfTurn (a, b)) {
      gap = i;
      opening_angle_ = count < 2 ? TWO_PI : TWO_PI - std::acos (std::clamp (cosine, -1.0, 1.0));
    }
    smallest_cosine = std::min (smallest_cosine, cosine);
    if (a.squaredNorm () < hull_[nearest].offset.squaredNorm ())
      nearest = i;
  }
  const bool open = gap < count || count < 3;
  if (!open)
    opening_angle_ = std::acos (std::clamp (smallest_cosine, -1.0, 1.0));
  else if (count == 0)
    opening_angle_ = TWO_PI;
  if (count > 0)
    std::rotate (hull_.begin (),
                 hull_.begin () + static_cast<std::ptrdiff_t> (open ? (gap + 1) % count : nearest),
                 hull_.end ());
  return open;
}

bool
PlanarStar::make (std::vector<PlanarNeighbor>& neighbors)
{
  sortByAngle (neighbors);

  // Of several neighbours in one direction only the nearest can be in the star.
  keepNearest (neighbors);
  // A closed star begins at its nearest neighbour, which is farthest when inverted and so a hull
  // vertex.
  const bool open = beginAfterGap ();

  // Graham scan in angular order. A closed star is scanned back to its first neighbour; the ends of
  // an open one are hull vertices.
  inverted_.clear ();
  neighbors.clear ();
  const std::size_t count = hull_.size ();
  const std::size_t steps = open ? count : count + 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const bool closing = i == count;
    const Eigen::Vector2d next =
        closing ? inverted_.front ()
                : Eigen::Vector2d (hull_[i].offset / hull_[i].offset.squaredNorm ());
    while (inverted_.size () >= 2 &&
           !isCorner (inverted_[inverted_.size () - 2], inverted_.back (), next)) {
      inverted_.pop_back ();
      neighbors.pop_back ();
    }
    if (!closing) {
      inverted_.push_back (next);
      neighbors.push_back (hull_[i]);
    }
  }
  return open;
}

bool
PlanarStar::order (std::vector<PlanarNeighbor>& neighbors)
{
  sortByAngle (neighbors);
  keepNearest (neighbors); // gaps are between directions
  const bool open = beginAfterGap ();
  // Those in the first direction may lie at both ends of the list: at angles of 0 and 2 pi.
  const auto is_first = [this] (const PlanarNeighbor& neighbor) {
    return sameDirection (hull_.front ().offset, neighbor.offset);
  };
  auto begin = std::find_if (neighbors.begin (), neighbors.end (), is_first);
  if (begin == neighbors.begin ()) {
    const auto last = std::find_if_not (neighbors.rbegin (), neighbors.rend (), is_first).base ();
    if (last != neighbors.begin ())
      begin = last;
  }
  std::rotate (neighbors.begin (), begin, neighbors.end ());
  return open;
}

} // namespace floater
} // namespace pcl
