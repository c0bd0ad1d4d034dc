// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/stretch.h"

#include "core/csr_lists.h"
#include "core/exact.h"
#include "core/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl::floater {
void
StretchSums::add (const std::array<Eigen::Vector3d, 3>& place,
                  const std::array<Eigen::Vector2d, 3>& uv)
{
  const double area = 0.5 * areaVector (place[0], place[1], place[2]).norm ();
  const Eigen::Vector2d e = uv[1] - uv[0], f = uv[2] - uv[0];
  const double determinant = cross (e, f);
  plane_area_ += 0.5 * determinant;
  if (!(area > 0.0))
    return;
  area_ += area;
  if (!(determinant > 0.0)) {
    squares_ = largest_ = std::numeric_limits<double>::infinity ();
    return;
  }
  // Columns of the Jacobian of the map from the plane.
  const Eigen::Vector3d E = place[1] - place[0], F = place[2] - place[0];
  const Eigen::Vector3d along_u = (E * f.y () - F * e.y ()) / determinant;
  const Eigen::Vector3d along_v = (F * e.x () - E * f.x ()) / determinant;
  const double a = along_u.squaredNorm (), b = along_u.dot (along_v), c = along_v.squaredNorm ();
  squares_ += area * 0.5 * (a + c);
  largest_ = std::max (largest_, std::sqrt (0.5 * (a + c + std::hypot (a - c, 2.0 * b))));
}

double
StretchSums::mean () const
{
  if (std::isinf (squares_)) // also if the area in the plane is negative
    return squares_;
  return area_ > 0.0 ? std::sqrt (squares_ * plane_area_) / area_ : 1.0;
}

double
StretchSums::largest () const
{
  if (std::isinf (largest_))
    return largest_;
  return area_ > 0.0 ? largest_ * std::sqrt (plane_area_ / area_) : 1.0;
}

StretchSums
stretchOf (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<Triangle>& corners, const std::vector<Eigen::Vector2d>& uv)
{
  StretchSums sums;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto& [i, j, k] = corners[t];
    sums.add ({positions[a], positions[b], positions[c]}, {uv[i], uv[j], uv[k]});
  }
  return sums;
}

namespace {
constexpr int ROUNDS = 20;                              // over all flipped triangles
constexpr std::array<float, 5> REACHES{1, 2, 4, 8, 16}; // in steps of single precision below 1

bool
isFlipped (const Triangle& t, const std::vector<Eigen::Vector2f>& uv)
{
  return !isAntiClockwise (uv[t[0]].cast<double> (), uv[t[1]].cast<double> (),
                           uv[t[2]].cast<double> ());
}

// Moves one corner if this reduces the flipped triangles around it.
bool
tryMoves (const std::vector<Triangle>& triangles, const Row& around, Index corner,
          std::vector<Eigen::Vector2f>& uv)
{
  const auto flippedAround = [&] {
    return std::count_if (around.begin (), around.end (),
                          [&] (Index t) { return isFlipped (triangles[t], uv); });
  };
  const Eigen::Vector2f old = uv[corner];
  auto least = flippedAround ();
  Eigen::Vector2f best = old;
  for (const float reach : REACHES)
    for (const float du : {-reach, 0.0F, reach})
      for (const float dv : {-reach, 0.0F, reach}) {
        constexpr float STEP = std::numeric_limits<float>::epsilon () / 2.0F;
        uv[corner] = (old + STEP * Eigen::Vector2f (du, dv)).cwiseMax (0.0F).cwiseMin (1.0F);
        const auto flipped = flippedAround ();
        if (flipped < least) {
          least = flipped;
          best = uv[corner];
        }
      }
  uv[corner] = best;
  return best != old;
}

} // namespace

std::vector<Index>
repairRounding (const std::vector<Triangle>& triangles, std::vector<Eigen::Vector2f>& uv)
{
  std::vector<Index> flipped;
  for (Index t = 0; t < triangles.size (); ++t)
    if (isFlipped (triangles[t], uv))
      flipped.push_back (t);
  if (flipped.empty ())
    return {};
  const CsrLists around = makeCsrLists (uv.size (), [&triangles] (const auto& emit) {
    for (Index t = 0; t < triangles.size (); ++t)
      for (const Index corner : triangles[t])
        emit (corner, t);
  });
  for (int round = 0; round < ROUNDS && !flipped.empty (); ++round) {
    bool has_moved = false;
    for (const Index t : flipped)
      for (const Index corner : triangles[t])
        if (isFlipped (triangles[t], uv))
          has_moved = tryMoves (triangles, around.row (corner), corner, uv) || has_moved;
    flipped.erase (std::remove_if (flipped.begin (), flipped.end (),
                                   [&] (Index t) { return !isFlipped (triangles[t], uv); }),
                   flipped.end ());
    if (!has_moved)
      break;
  }
  return flipped;
}

} // namespace pcl::floater
