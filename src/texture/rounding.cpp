// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/rounding.h"

#include "core/csr_lists.h"
#include "core/exact.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl::floater {
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

std::size_t
repairRounding (const std::vector<Triangle>& triangles, std::vector<Eigen::Vector2f>& uv)
{
  std::vector<Index> flipped;
  for (Index t = 0; t < triangles.size (); ++t)
    if (isFlipped (triangles[t], uv))
      flipped.push_back (t);
  if (flipped.empty ())
    return 0;
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
  return flipped.size ();
}

} // namespace pcl::floater
