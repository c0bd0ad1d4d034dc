// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "samplings.h"

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// area of the smallest radius
std::vector<Place>
throwDarts (double side, const Field& radius, double smallest, double largest, double tries,
            std::vector<Place> darts, RandomStream& random)
{
  const double cell = largest;
  std::unordered_map<std::int64_t, std::vector<Place>> cells;
  const auto cellOf = [cell] (double x, double y) {
    return std::make_pair (static_cast<std::int64_t> (std::floor (x / cell)),
                           static_cast<std::int64_t> (std::floor (y / cell)));
  };
  const auto key = [] (std::int64_t x, std::int64_t y) { return (x << 32) ^ (y & 0xffffffff); };
  const auto keep = [&] (const Place& p) {
    const auto at = cellOf (p.x (), p.y ());
    cells[key (at.first, at.second)].push_back (p);
  };
  for (const Place& p : darts)
    keep (p);
  const auto count = static_cast<std::size_t> (tries * side * side / (smallest * smallest));
  for (std::size_t i = 0; i < count; ++i) {
    const Place p ((random.uniform () - 0.5) * side, (random.uniform () - 0.5) * side);
    const double distance = radius (p);
    const auto at = cellOf (p.x (), p.y ());
    bool is_free = true;
    for (std::int64_t x = at.first - 1; x <= at.first + 1 && is_free; ++x)
      for (std::int64_t y = at.second - 1; y <= at.second + 1 && is_free; ++y) {
        const auto found = cells.find (key (x, y));
        if (found != cells.end ())
          for (const Place& q : found->second)
            is_free = is_free && (p - q).squaredNorm () >= distance * distance;
      }
    if (is_free) {
      darts.push_back (p);
      keep (p);
    }
  }
  return darts;
}

std::vector<Place>
evenDarts (double side, double radius, double tries, std::vector<Place> rims, RandomStream& random)
{
  return throwDarts (
      side, [radius] (const Place&) { return radius; }, radius, radius, tries, std::move (rims),
      random);
}

std::vector<Place>
lattice (double side, bool hexagonal, RandomStream& random)
{
  const double jitter = between (random, 0.0, 0.5), turn = random.uniform () * PI;
  const double row = hexagonal ? std::sqrt (0.75) : 1.0;
  const Eigen::Rotation2Dd rotation (turn);
  std::vector<Place> places;
  const auto half = static_cast<int> (side);
  for (int i = -half; i <= half; ++i)
    for (int j = -half; j <= half; ++j) {
      const double shift = hexagonal && i % 2 != 0 ? 0.5 : 0.0;
      const Place p = rotation * Place (j + shift + jitter * (random.uniform () - 0.5),
                                        row * i + jitter * (random.uniform () - 0.5));
      if (p.cwiseAbs ().maxCoeff () <= 0.5 * side)
        places.push_back (p);
    }
  return places;
}

std::vector<Place>
randomPlaces (double side, RandomStream& random)
{
  std::vector<Place> places (static_cast<std::size_t> (side * side));
  for (Place& p : places)
    p = Place ((random.uniform () - 0.5) * side, (random.uniform () - 0.5) * side);
  return places;
}

// Rows in one direction; points in a row about one step apart.
std::vector<Place>
rows (double side, RandomStream& random)
{
  const double apart = logBetween (random, 1.2, 5.0), noise = between (random, 0.0, 0.3);
  std::vector<Place> places;
  for (double y = -0.5 * side; y <= 0.5 * side; y += apart)
    for (double x = random.uniform () - 0.5 * side; x <= 0.5 * side; x += 1.0)
      places.emplace_back (x + noise * (random.uniform () - 0.5),
                           y + noise * apart * (random.uniform () - 0.5));
  return places;
}

std::vector<Place>
quantized (double side, RandomStream& random)
{
  std::vector<Place> places = randomPlaces (side, random);
  const double step = logBetween (random, 0.1, 0.6);
  for (Place& p : places)
    p.y () = step * std::round (p.y () / step);
  return places;
}

// Places whose points are at least a distance apart in space, evenly spread by area.
std::vector<Place>
dartsInSpace (double side, const Map& map, RandomStream& random)
{
  constexpr double DISTANCE = 0.8, STEP = 1e-3, MOST_STRETCH = 8.0;
  const double tries = logBetween (random, 3.0, 10.0);
  std::unordered_map<std::int64_t, std::vector<Eigen::Vector3d>> cells;
  const auto key = [] (double x, double y) {
    return (static_cast<std::int64_t> (std::floor (x)) << 32) ^
           (static_cast<std::int64_t> (std::floor (y)) & 0xffffffff);
  };
  std::vector<Place> darts;
  const auto count = static_cast<std::size_t> (tries * MOST_STRETCH * side * side);
  for (std::size_t i = 0; i < count; ++i) {
    const Place p ((random.uniform () - 0.5) * side, (random.uniform () - 0.5) * side);
    const Eigen::Vector3d at = map (p);
    const Eigen::Vector3d along_x = map (p + Place (STEP, 0.0)) - at;
    const Eigen::Vector3d along_y = map (p + Place (0.0, STEP)) - at;
    if (random.uniform () * MOST_STRETCH > along_x.cross (along_y).norm () / (STEP * STEP))
      continue;
    bool is_free = true;
    // Of height fields: what is near in space is near in the plane.
    for (int x = -1; x <= 1 && is_free; ++x)
      for (int y = -1; y <= 1 && is_free; ++y) {
        const auto found = cells.find (key (at.x () + x, at.y () + y));
        if (found != cells.end ())
          for (const Eigen::Vector3d& q : found->second)
            is_free = is_free && (at - q).squaredNorm () >= DISTANCE * DISTANCE;
      }
    if (is_free) {
      darts.push_back (p);
      cells[key (at.x (), at.y ())].push_back (at);
    }
  }
  return darts;
}

std::vector<Place>
spots (double side, RandomStream& random)
{
  struct Spot
  {
    Place centre;
    double radius, strength;
  };
  std::vector<Spot> all;
  const int count = 1 + static_cast<int> (random.below (4));
  double largest = 1.0;
  for (int i = 0; i < count; ++i) {
    Spot spot;
    spot.centre = Place (random.uniform () - 0.5, random.uniform () - 0.5) * 0.7 * side;
    spot.strength = std::log (logBetween (random, 2.0, 12.0));
    spot.radius = std::exp (spot.strength) * logBetween (random, 0.7, 4.0);
    largest = std::max (largest, std::exp (spot.strength));
    all.push_back (spot);
  }
  const Field radius = [all] (const Place& p) {
    double most = 0.0;
    for (const Spot& spot : all) {
      const double x = (p - spot.centre).norm () / spot.radius;
      if (x < 1.0)
        most = std::max (most, spot.strength * 0.5 * (1.0 + std::cos (PI * x)));
    }
    return 0.8 * std::exp (most);
  };
  return throwDarts (side, radius, 0.8, 0.8 * largest, logBetween (random, 3.0, 20.0), {}, random);
}

std::vector<Place>
clouds (double side, RandomStream& random)
{
  const double strength = std::log (logBetween (random, 1.2, 2.2));
  const Field field = waves (random, 10.0, 80.0);
  static constexpr double MOST = 2.0;
  const Field radius = [strength, field] (const Place& p) {
    return 0.8 * std::exp (strength * std::clamp (field (p), -1.0, +MOST));
  };
  return throwDarts (side, radius, 0.8 * std::exp (-strength), 0.8 * std::exp (MOST * strength),
                     logBetween (random, 3.0, 20.0), {}, random);
}

std::vector<Place>
graded (double side, RandomStream& random)
{
  const double ratio = logBetween (random, 1.5, 5.0);
  const Field radius = [side, ratio] (const Place& p) {
    return 0.8 * std::pow (ratio, p.x () / side + 0.5);
  };
  return throwDarts (side, radius, 0.8, 0.8 * ratio, logBetween (random, 3.0, 20.0), {}, random);
}

// Vertices of a decimated triangulation of a jittered grid.
std::vector<Place>
decimated (double side, bool quadric, const Map& map, RandomStream& random)
{
  constexpr double MOST_POINTS = 60'000.0; // of the mesh; it is a matter of time
  const double share =
      std::max (logBetween (random, 0.03, 0.4), side * side / MOST_POINTS); // of points that stay
  const auto steps = static_cast<int> (side / std::sqrt (share));
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  std::vector<Place> places;
  std::unordered_map<std::int64_t, std::size_t> index;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const auto at = [&] (int k) {
        return side *
               ((k + (k % steps == 0 ? 0.0 : 0.6 * (random.uniform () - 0.5))) / steps - 0.5);
      };
      const Place p (at (j), at (i));
      places.push_back (p);
      const Eigen::Vector3d x = map (p);
      points->InsertNextPoint (x.x (), x.y (), x.z ());
    }
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const vtkIdType a = i * (steps + 1) + j, b = a + 1, c = a + steps + 1, d = c + 1;
      cells->InsertNextCell ({a, b, d});
      cells->InsertNextCell ({a, d, c});
    }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints (points);
  mesh->SetPolys (cells);
  vtkSmartPointer<vtkPolyDataAlgorithm> filter;
  if (quadric) {
    vtkNew<vtkQuadricDecimation> decimation;
    decimation->SetTargetReduction (1.0 - share);
    filter = decimation.Get ();
  }
  else {
    vtkNew<vtkDecimatePro> decimation;
    decimation->SetTargetReduction (1.0 - share);
    decimation->SplittingOff ();
    filter = decimation.Get ();
  }
  filter->SetInputData (mesh);
  filter->Update ();
  // Shapes that are decimated are height fields.
  std::vector<Place> left;
  vtkPolyData* const output = filter->GetOutput ();
  std::vector<bool> used (static_cast<std::size_t> (output->GetNumberOfPoints ()), false);
  for (vtkIdType c = 0; c < output->GetNumberOfCells (); ++c) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    output->GetCellPoints (c, count, corners);
    for (vtkIdType k = 0; k < count; ++k)
      used[static_cast<std::size_t> (corners[k])] = true;
  }
  for (vtkIdType i = 0; i < output->GetNumberOfPoints (); ++i)
    if (used[static_cast<std::size_t> (i)]) {
      const double* x = output->GetPoint (i);
      left.emplace_back (x[0], x[1]);
    }
  return left;
}

} // namespace

std::string
nameOf (Sampling sampling)
{
  const char* const names[] = {"grid",    "hexagonal", "darts",     "random", "graded",
                               "thinned", "lines",     "quantized", "space",  "clouds",
                               "spots",   "quadric",   "removal"};
  return names[static_cast<std::size_t> (sampling)];
}

std::vector<Place>
samplePlaces (Sampling sampling, double side, const Map& map, RandomStream& random)
{
  switch (sampling) {
  case Sampling::GRID:
    return lattice (side, false, random);
  case Sampling::HEXAGONAL:
    return lattice (side, true, random);
  case Sampling::DARTS:
    return evenDarts (side, 0.8, logBetween (random, 2.0, 30.0), {}, random);
  case Sampling::GRADED:
    return graded (side, random);
  case Sampling::THINNED: {
    std::vector<Place> places = lattice (side, false, random);
    const double share = between (random, 0.4, 0.9);
    places.erase (std::remove_if (places.begin (), places.end (),
                                  [&] (const Place&) { return random.uniform () > share; }),
                  places.end ());
    return places;
  }
  case Sampling::LINES:
    return rows (side, random);
  case Sampling::QUANTIZED:
    return quantized (side, random);
  case Sampling::SPACE:
    return dartsInSpace (side, map, random);
  case Sampling::CLOUDS:
    return clouds (side, random);
  case Sampling::SPOTS:
    return spots (side, random);
  case Sampling::QUADRIC:
  case Sampling::REMOVAL:
    return decimated (side, sampling == Sampling::QUADRIC, map, random);
  default:
    return randomPlaces (side, random);
  }
}

} // namespace floater
} // namespace pcl
