// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the check of a mesh tells a disc in its loop from anything else.
#include "mesh/check.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
// Two rings of a wheel: vertex 0, ring 1 to 6, ring 7 to 12.
std::vector<Triangle>
wheel (bool with_middle)
{
  std::vector<Triangle> triangles;
  for (Index i = 0; i < 6; ++i) {
    const Index j = (i + 1) % 6;
    if (with_middle)
      triangles.push_back ({0, 1 + i, 1 + j});
    triangles.push_back ({1 + i, 7 + i, 7 + j});
    triangles.push_back ({1 + i, 7 + j, 1 + j});
  }
  return triangles;
}

const std::vector<Index> HEXAGON = {7, 8, 9, 10, 11, 12};

// Whether checkMesh () finds one manifold disc whose boundary is the loop.
bool
isDiscIn (const std::vector<Index>& loop, const std::vector<Triangle>& triangles,
          std::size_t points)
{
  const Points cloud = makePoints (samples::randomPoints (points, 1), samples::indices (points), 1);
  const MeshExamination found = checkMesh (triangles, cloud, std::vector<float> (points, 0.1F), 1);
  return found.isManifold () && found.isDisc () &&
         samples::canonicalCycle (found.loops.front ().points) == samples::canonicalCycle (loop);
}

TEST (DiscCheck, ADiscInItsLoop)
{
  EXPECT_TRUE (isDiscIn (HEXAGON, wheel (true), 13));
  // The loop may begin anywhere and run the other way round; points without triangle are no matter.
  EXPECT_TRUE (isDiscIn ({9, 8, 7, 12, 11, 10}, wheel (true), 20));
}

TEST (DiscCheck, WhatIsNoDiscInItsLoop)
{
  const auto expectBroken = [] (const char* why, const std::vector<Triangle>& triangles,
                                const std::vector<Index>& loop) {
    EXPECT_FALSE (isDiscIn (loop, triangles, 30)) << why;
  };
  expectBroken ("nothing", {}, HEXAGON);
  expectBroken ("a hole", wheel (false), HEXAGON);
  expectBroken ("another loop", wheel (true), {7, 8, 9, 10, 11});
  expectBroken ("a loop inside", wheel (true), {1, 2, 3, 4, 5, 6});
  expectBroken ("another order", wheel (true), {7, 9, 8, 10, 11, 12});
  // Euler characteristic and loops are those of a disc.
  std::vector<Triangle> beside_a_torus = wheel (true);
  const auto onTorus = [] (Index i, Index j) { return 13 + 3 * (i % 3) + j % 3; };
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      beside_a_torus.push_back ({onTorus (i, j), onTorus (i + 1, j), onTorus (i + 1, j + 1)});
      beside_a_torus.push_back ({onTorus (i, j), onTorus (i + 1, j + 1), onTorus (i, j + 1)});
    }
  expectBroken ("a torus beside it", beside_a_torus, HEXAGON);
  std::vector<Triangle> changed = wheel (true);
  changed.push_back ({20, 21, 22});
  expectBroken ("two components", changed, HEXAGON);
  changed = wheel (true);
  for (const Triangle& t :
       {Triangle{20, 22, 21}, Triangle{20, 21, 23}, Triangle{21, 22, 23}, Triangle{22, 20, 23}})
    changed.push_back (t);
  expectBroken ("a closed component", changed, HEXAGON);
  changed = wheel (true);
  std::swap (changed[3][0], changed[3][1]);
  expectBroken ("a triangle wound against the others", changed, HEXAGON);
  changed = wheel (true);
  changed.push_back (changed[4]);
  expectBroken ("a triangle twice", changed, HEXAGON);
  changed = wheel (true);
  changed.push_back ({0, 20, 21});
  expectBroken ("a vertex with two fans", changed, HEXAGON);
  changed = wheel (true);
  changed.pop_back ();
  expectBroken ("a triangle less", changed, HEXAGON);
}

} // namespace
} // namespace pcl::floater
