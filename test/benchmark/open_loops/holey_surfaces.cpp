// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "holey_surfaces.h"

#include "core/geometry.h"
#include "random_stream.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
Window
makeWindow (double width, RandomStream& random)
{
  Window window;
  window.mean_radius = 0.5 * width;
  window.even_rim = random.below (2) == 0;
  const double radius = window.mean_radius, turn = 2.0 * PI * random.uniform ();
  switch (random.below (3)) {
  case 0:
    window.radius = [radius] (double) { return radius; };
    break;
  case 1: // a square
    window.radius = [radius, turn] (double angle) {
      const double x = std::abs (std::cos (angle + turn)), y = std::abs (std::sin (angle + turn));
      return radius * 0.9 / std::max (x, y);
    };
    break;
  default: { // an ellipse with dents
    const double aspect = std::sqrt (logBetween (random, 1.0, 8.0));
    const double a = between (random, -0.25, 0.25), b = between (random, -0.2, 0.2);
    window.radius = [radius, turn, aspect, a, b] (double angle) {
      const double ellipse =
          1.0 / std::hypot (std::cos (angle + turn) / aspect, std::sin (angle + turn) * aspect);
      return radius * ellipse *
             (1.0 + a * std::cos (3.0 * angle + 2.0 * turn) + b * std::cos (5.0 * angle));
    };
    window.longest = aspect * (1.0 + std::abs (a) + std::abs (b));
  }
  }
  return window;
}

std::vector<Window>
makeWindows (double side, double width, RandomStream& random)
{
  std::vector<Window> windows;
  const bool alike = random.below (2) == 0;
  const int tries = 40;
  const std::size_t most = 1 + random.below (6);
  for (int i = 0; i < tries && windows.size () < most; ++i) {
    Window window =
        makeWindow (alike || windows.empty () ? width : logBetween (random, 4.0, width), random);
    const double room = std::max (0.0, 0.5 * side - window.longest * window.mean_radius - 6.0);
    window.centre = {between (random, -room, room), between (random, -room, room)};
    bool is_apart = true;
    for (const Window& other : windows)
      is_apart = is_apart &&
                 (window.centre - other.centre).norm () >
                     window.longest * window.mean_radius + other.longest * other.mean_radius + 6.0;
    if (is_apart)
      windows.push_back (window);
  }
  return windows;
}

// Cuts the windows out. Rims in even steps have the local spacing.
void
cutWindows (const std::vector<Window>& windows, std::vector<Place>& places)
{
  for (const Window& window : windows) {
    std::vector<Place> rim;
    if (window.even_rim) {
      // As many points around as there are within one and a half spacings of the rim, by area.
      std::size_t in_strip = 0;
      for (const Place& p : places)
        in_strip += window.covers (p, 3.0) && !window.covers (p, 0.0) ? 1 : 0;
      constexpr int FINE = 720;
      std::vector<Place> fine;
      double length = 0.0;
      for (int i = 0; i < FINE; ++i) {
        const double angle = 2.0 * PI * i / FINE;
        fine.emplace_back (window.centre +
                           window.radius (angle) * Place (std::cos (angle), std::sin (angle)));
        if (i > 0)
          length += (fine[fine.size () - 1] - fine[fine.size () - 2]).norm ();
      }
      const double density = static_cast<double> (in_strip) / (3.0 * (length + 3.0 * PI));
      const double step = 1.0 / std::sqrt (std::max (density, 1e-3));
      double left = 0.0;
      for (int i = 0; i < FINE; ++i) {
        if (left <= 0.0) {
          rim.push_back (fine[static_cast<std::size_t> (i)]);
          left += length / std::max (6.0, std::round (length / step));
        }
        left -=
            (fine[static_cast<std::size_t> ((i + 1) % FINE)] - fine[static_cast<std::size_t> (i)])
                .norm ();
      }
      if (rim.size () > 6 && left > 0.5 * step)
        rim.pop_back ();
      const double margin = 0.6 * step;
      places.erase (std::remove_if (places.begin (), places.end (),
                                    [&] (const Place& p) { return window.covers (p, margin); }),
                    places.end ());
    }
    else
      places.erase (std::remove_if (places.begin (), places.end (),
                                    [&] (const Place& p) { return window.covers (p); }),
                    places.end ());
    places.insert (places.end (), rim.begin (), rim.end ());
  }
}

} // namespace

bool
Window::covers (const Place& place, double margin) const
{
  const Place offset = place - centre;
  return offset.norm () < radius (std::atan2 (offset.y (), offset.x ())) + margin;
}

HoleySurface
makeHoleySurface (bool with_windows, std::uint64_t seed)
{
  RandomStream random (seed);
  HoleySurface made;
  // Even samplings leave few gaps; where there are no windows, most surfaces are uneven.
  const Sampling uneven[] = {Sampling::REMOVAL, Sampling::REMOVAL,   Sampling::REMOVAL,
                             Sampling::QUADRIC, Sampling::SPOTS,     Sampling::SPOTS,
                             Sampling::CLOUDS,  Sampling::QUANTIZED, Sampling::RANDOM};
  const bool is_uneven = !with_windows && random.below (4) != 0;
  made.sampling =
      is_uneven ? uneven[random.below (9)]
                : static_cast<Sampling> (random.below (static_cast<std::size_t> (Sampling::COUNT)));
  const bool is_decimated =
      made.sampling == Sampling::QUADRIC || made.sampling == Sampling::REMOVAL;
  if (is_decimated) { // height fields, most of them not flat
    const Shape shapes[] = {Shape::SADDLE, Shape::BUMPS, Shape::TERRACES, Shape::CLIFFS,
                            Shape::FINS};
    made.shape = shapes[random.below (5)];
  }
  else if (is_uneven)
    made.shape = static_cast<Shape> (random.below (2) == 0
                                         ? random.below (static_cast<std::size_t> (Shape::COUNT))
                                         : static_cast<std::size_t> (Shape::CLIFFS));
  else
    made.shape = static_cast<Shape> (random.below (static_cast<std::size_t> (Shape::COUNT)));
  const double width = logBetween (random, 4.0, 40.0);
  made.side = with_windows ? std::max (40.0, 2.6 * width + 16.0) : between (random, 40.0, 80.0);
  const Map map = makeMap (made.shape, made.side, random);
  made.places = samplePlaces (made.sampling, made.side, map, random);
  if (with_windows) {
    made.windows = makeWindows (made.side, width, random);
    cutWindows (made.windows, made.places);
  }
  const double noise = random.below (4) == 0 ? between (random, 0.0, 0.15) : 0.0;
  for (const Place& p : made.places)
    made.points.emplace_back (
        map (p) + noise * Eigen::Vector3d (random.normal (), random.normal (), random.normal ()));
  return made;
}

} // namespace floater
} // namespace pcl
