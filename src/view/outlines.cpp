// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry.h"
#include "core/parallel.h"
#include "view/ray_evidence.h"

namespace pcl::floater {
namespace {
// To either surface; and of a patch at outlines, if it counts.
constexpr std::size_t FEWEST_RAYS = 3;

using Place = Vector2d;

// Whether a line parts the first places from the others. It may go through two of them.
bool
isLineBetween (const std::vector<Place>& places, std::size_t first)
{
  for (std::size_t i = 0; i < places.size (); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Place along = places[i] - places[k];
      bool is_left = true, is_right = true; // the first ones
      for (std::size_t j = 0; j < places.size (); ++j) {
        const double left = cross (along, places[j] - places[k]);
        const double side = j < first ? left : -left;
        is_left = is_left && (j == i || j == k || side > 0.0);
        is_right = is_right && (j == i || j == k || side < 0.0);
      }
      if (is_left || is_right)
        return true;
    }
  return false;
}

// Whether places lie in a row: at a grazing angle, rows look like surfaces behind each other.
bool
areInRow (const Place* first, const Place* last)
{
  const auto count = static_cast<double> (last - first);
  Place middle = Place::Zero ();
  for (const Place* p = first; p != last; ++p)
    middle += *p / count;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero ();
  for (const Place* p = first; p != last; ++p)
    spread += (*p - middle) * (*p - middle).transpose ();
  // Product over squared sum of the squared widths along and across.
  constexpr double NARROW = 0.2; // width over length, for those of generated sheets
  constexpr double MOST = NARROW / (1.0 + NARROW * NARROW);
  return spread.determinant () <= MOST * MOST * spread.trace () * spread.trace ();
}

// Rays of a patch at outlines.
struct Outlines
{
  std::size_t clear = 0, mixed = 0;
};

Outlines
outlinesOf (const Positions& positions, const RayPatch& patch, const Viewpoint& viewpoint,
            std::size_t every)
{
  constexpr std::size_t RAYS = 12; // nearest ones, at which an outline is looked for
  constexpr double APART = 2.0;    // smallest step, in depths of either surface
  Outlines found;
  if (patch.size () < RAYS)
    return found;
  struct PlacedRay
  {
    Place place;
    double depth, square;
  };
  std::vector<PlacedRay> rays;
  const TangentFrame frame (rayTo (positions[patch.front ()], viewpoint).direction);
  for (const Index p : patch) {
    const Ray ray = rayTo (positions[p], viewpoint);
    rays.push_back ({frame.project (ray.direction), ray.depth, 0.0});
  }
  std::vector<Place> places;
  std::vector<PlacedRay> near;
  for (std::size_t i = 0; i < patch.size () / 2; i += every) {
    near = rays;
    for (PlacedRay& ray : near)
      ray.square = (ray.place - rays[i].place).squaredNorm ();
    const auto isNearer = [] (const auto& a, const auto& b) { return a.square < b.square; };
    std::nth_element (near.begin (), near.begin () + (RAYS - 1), near.end (), isNearer);
    near.resize (RAYS);
    std::nth_element (near.begin (), near.begin () + RAYS / 2, near.end (), isNearer);
    const double width = std::sqrt (near[RAYS / 2].square);
    std::sort (near.begin (), near.end (),
               [] (const auto& a, const auto& b) { return a.depth < b.depth; });
    std::size_t behind = FEWEST_RAYS;
    for (std::size_t k = behind; k + FEWEST_RAYS <= near.size (); ++k)
      if (near[k].depth - near[k - 1].depth > near[behind].depth - near[behind - 1].depth)
        behind = k;
    const double front = near[behind - 1].depth, step = near[behind].depth - front;
    if (step < STEEP * width * front ||
        step <
            APART * std::max (front - near.front ().depth, near.back ().depth - near[behind].depth))
      continue;
    places.clear ();
    for (const PlacedRay& ray : near)
      places.push_back (ray.place);
    const Place* const begin = places.data ();
    const Place *const middle = begin + behind, *const end = begin + places.size ();
    if (!areInRow (begin, middle) && !areInRow (middle, end))
      ++(isLineBetween (places, behind) ? found.clear : found.mixed);
  }
  return found;
}

// Patches with outlines, and those for the viewpoint minus those against it.
struct Votes
{
  double count = 0.0, sum = 0.0;

  bool areClear () const { return count > 0.0 && sum >= 2.0 * std::sqrt (count); }
};

} // namespace

bool
areOutlinesClear (const Positions& positions, const std::vector<RayPatch>& patches,
                  const Viewpoint& viewpoint, const RunContext& run)
{
  constexpr std::size_t EVERY = 3; // ray: 2 % of the time of a cloud of 2,000 points, 10 % with all
  constexpr std::size_t MORE = 4;  // times as many patches, where the first ones do not decide
  const auto takeVotes = [&] (const std::vector<RayPatch>& from, std::size_t every) {
    std::vector<Outlines> of_patch (from.size ());
    parallelTasks (run, from.size (), [&] (std::size_t k) {
      of_patch[k] = outlinesOf (positions, from[k], viewpoint, every);
    });
    Votes votes;
    for (const Outlines& outlines : of_patch)
      if (every * (outlines.clear + outlines.mixed) >= FEWEST_RAYS) {
        votes.count += 1.0;
        votes.sum += outlines.clear > outlines.mixed ? 1.0 : -1.0;
      }
    return votes;
  };
  Votes votes = takeVotes (patches, EVERY);
  if (votes.sum > 0.0 && !votes.areClear ())
    votes = takeVotes (findRayPatches (positions, viewpoint, run, MORE * patches.size ()), 1);
  return votes.areClear ();
}

} // namespace pcl::floater
