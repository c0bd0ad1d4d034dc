// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/planar_star.h"

#include "core/geometry.h"

namespace pcl::floater {
namespace {
// Relative tolerance: smaller cross products of neighbours count as zero, so that rounding on grids
// does not open a star or turn a straight line into a corner.
constexpr double COLLINEAR = 1e-9;

// Number of neighbours up to which counting sort is used.
constexpr std::size_t MOST_COUNTED = 32;

// Increases with the angle of v, from 0 to 4; 0 without a direction.
double
pseudoAngle (const Vector2d& v)
{
  const double sum = std::abs (v.x ()) + std::abs (v.y ());
  const double t = sum > 0.0 ? v.y () / sum : 0.0;
  if (v.x () < 0.0)
    return 2.0 - t;
  return v.y () < 0.0 ? 4.0 + t : t;
}

// True if a cross product, relative to the lengths of its factors, is nearly zero or negative.
// Compares squares: roots would take longer than all the rest.
bool
isAtMostCollinear (double cross_product, const Vector2d& a, const Vector2d& b)
{
  return cross_product <= 0.0 || cross_product * cross_product <=
                                     COLLINEAR * COLLINEAR * a.squaredNorm () * b.squaredNorm ();
}

bool
sameDirection (const Vector2d& a, const Vector2d& b)
{
  return a.dot (b) > 0.0 && isAtMostCollinear (std::abs (cross (a, b)), a, b);
}

// Half a turn or more from a to b, anti-clockwise. The directions must differ.
bool
spansHalfTurn (const Vector2d& a, const Vector2d& b)
{
  return isAtMostCollinear (cross (a, b), a, b);
}

// True if b lies strictly outside the segment from a to c, walking anti-clockwise around the
// origin. Where the walk turns back, b is the tip of a spike: an inverted, very close neighbour.
bool
isCorner (const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
  const Vector2d ab = b - a;
  const Vector2d bc = c - b;
  const double turn = cross (ab, bc);
  return ab.dot (bc) > 0.0 ? !isAtMostCollinear (turn, ab, bc) : turn > 0.0;
}

// Sorts by the number of smaller angles. For few neighbours, comparing all pairs without branches
// is faster than a sort with many mispredicted branches. Uses single precision, four at once.
// \return false if two angles are equal in single precision: neither list is then sorted
bool
sortByCounting (std::vector<PlanarNeighbor>& neighbors, std::vector<PlanarNeighbor>& unsorted)
{
  const std::size_t count = neighbors.size ();
  std::array<float, MOST_COUNTED> angles; // NOLINT(*-member-init): the first `count` are set
  for (std::size_t i = 0; i < count; ++i)
    angles[i] = static_cast<float> (neighbors[i].angle);
  std::array<std::uint8_t, MOST_COUNTED> ranks; // NOLINT(*-member-init)
  std::uint64_t used = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::int32_t smaller = 0; // as wide as an angle
    for (std::size_t j = 0; j < count; ++j)
      smaller += angles[j] < angles[i] ? 1 : 0;
    ranks[i] = static_cast<std::uint8_t> (smaller);
    used |= std::uint64_t{1} << static_cast<unsigned> (smaller);
  }
  if (used + 1 != std::uint64_t{1} << count)
    return false;
  unsorted.assign (neighbors.begin (), neighbors.end ());
  for (std::size_t i = 0; i < count; ++i)
    neighbors[ranks[i]] = unsorted[i];
  return true;
}

void
sortByAngle (std::vector<PlanarNeighbor>& neighbors, std::vector<PlanarNeighbor>& unsorted)
{
  for (PlanarNeighbor& neighbor : neighbors)
    neighbor.angle = pseudoAngle (neighbor.offset);
  if (neighbors.size () > MOST_COUNTED || !sortByCounting (neighbors, unsorted))
    std::sort (neighbors.begin (), neighbors.end (), [] (const auto& a, const auto& b) {
      return a.angle != b.angle ? a.angle < b.angle : a.point < b.point;
    });
}

} // namespace

bool
PlanarStar::takeNearest (std::vector<PlanarNeighbor>& neighbors)
{
  sortByAngle (neighbors, hull_); // hull_ is scratch here
  hull_.clear ();
  for (const PlanarNeighbor& neighbor : neighbors) {
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
  const std::size_t count = hull_.size ();
  std::size_t gap = count;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& a = hull_[i].offset;
    if (count < 2 || spansHalfTurn (a, hull_[i + 1 == count ? 0 : i + 1].offset))
      gap = i;
    if (a.squaredNorm () < hull_[nearest].offset.squaredNorm ())
      nearest = i;
  }
  is_open_ = gap < count || count < 3;
  const std::size_t begin = is_open_ ? (gap + 1 < count ? gap + 1 : (gap + 1) - count) : nearest;
  if (count > 0)
    std::rotate (hull_.begin (), hull_.begin () + static_cast<std::ptrdiff_t> (begin),
                 hull_.end ());
  return is_open_;
}

double
PlanarStar::openingAngle () const
{
  const auto cosine = [] (const Vector2d& a, const Vector2d& b) {
    return std::clamp (a.dot (b) / std::sqrt (a.squaredNorm () * b.squaredNorm ()), -1.0, 1.0);
  };
  if (hull_.size () < 2)
    return 2.0 * PI;
  const Vector2d &first = hull_.front ().offset, &last = hull_.back ().offset;
  double smallest = cosine (last, first);
  if (is_open_ && spansHalfTurn (last, first))
    return 2.0 * PI - std::acos (smallest);
  for (std::size_t i = 1; i < hull_.size (); ++i)
    smallest = std::min (smallest, cosine (hull_[i - 1].offset, hull_[i].offset));
  return std::acos (smallest);
}

bool
PlanarStar::make (std::vector<PlanarNeighbor>& neighbors)
{
  // In each direction, only the nearest neighbour can be in the star. A closed star begins at its
  // nearest neighbour: inverted, it is the farthest and a hull vertex.
  const bool open = takeNearest (neighbors);

  // Graham scan in angular order. A closed star is scanned to its first neighbour again; the ends
  // of an open one are hull vertices.
  inverted_.clear ();
  neighbors.clear ();
  const std::size_t count = hull_.size ();
  const std::size_t steps = open ? count : count + 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const bool closing = i == count;
    const Vector2d next =
        closing ? inverted_.front () : Vector2d (hull_[i].offset / hull_[i].offset.squaredNorm ());
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
  const bool open = takeNearest (neighbors); // gaps are between directions
  // The first direction may be at both ends of the list: at angles of 0 and 2 pi.
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

} // namespace pcl::floater
