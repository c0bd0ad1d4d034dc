// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/stitching.h"

#include "part_samples.h"
#include "parts/local_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
using samples::prepare;
using samples::Prepared;
using samples::surface;

TEST (Parts, CoverAllPointsInOrder)
{
  for (const std::size_t points : {0U, 1U, 1000U, 1001U, 99999U, 100000U, 100001U}) {
    PartLimits limits;
    limits.points = 1000;
    const Parts parts (points, limits);
    EXPECT_EQ (parts.first (0), 0U);
    EXPECT_EQ (parts.last (parts.count () - 1), points);
    for (std::size_t part = 0; part < parts.count (); ++part) {
      EXPECT_LE (parts.first (part), parts.last (part));
      for (Index p = parts.first (part); p < parts.last (part); p += 97)
        EXPECT_EQ (parts.partOf (p), part);
    }
  }
}

TEST (Parts, AFewPointsAreOnePart)
{
  const PartLimits limits;
  EXPECT_EQ (Parts (limits.points, limits).count (), 1U);
  EXPECT_EQ (Parts (limits.points + 1, limits).count (), 2U);
}

TEST (PartMesh, DoubtfulCandidatesBesideOtherPartsAreLeft)
{
  CandidateLists all;
  all.sure = {{{10, 11, 12}, 0, 1, false}, {{10, 11, 20}, 0, 0, false}};
  all.doubtful = {{{10, 12, 13}, 2, 0, 1.0F, 0.5F}, {{11, 12, 13}, 2, 0, 1.0F, 0.5F}};
  std::vector<std::uint8_t> reaches_out (10, 0);
  reaches_out[0] = 1;
  const PartCandidates divided = divideCandidates (all, 10, 20, reaches_out);
  ASSERT_EQ (divided.inside.sure.size (), 1U);
  EXPECT_EQ (divided.inside.sure[0].corners, (Triangle{0, 1, 2}));
  ASSERT_EQ (divided.inside.doubtful.size (), 1U);
  EXPECT_EQ (divided.inside.doubtful[0].corners, (Triangle{1, 2, 3}));
  ASSERT_EQ (divided.left.size (), 2U);
  EXPECT_EQ (divided.left[0].corners, (Triangle{10, 11, 20}));
  EXPECT_EQ (divided.left[0].votes, 3);
  EXPECT_EQ (divided.left[1].corners, (Triangle{10, 12, 13}));
}

TEST (PartMesh, ReachesOut)
{
  PartLimits limits;
  limits.points = 64;
  const Parts parts (128, limits); // two of 64
  CsrLists stars;
  stars.offsets = {0, 2, 4, 6};
  stars.ids = {60, 62, 61, 64, 63, 65}; // of the points 62 to 64
  EXPECT_EQ (reachesOut (stars, 62, parts), (std::vector<std::uint8_t>{0, 1, 1}));
}

// What is decided where parts meet does not depend on how much of them is seen, but for the side of
// a whole component, which nothing decides here.
void
expectSame (const Stitching& a, const Stitching& b)
{
  ASSERT_EQ (a.parts.size (), b.parts.size ());
  const auto sorted = [] (std::vector<Triangle> triangles) {
    for (Triangle& corners : triangles)
      std::sort (corners.begin (), corners.end ());
    std::sort (triangles.begin (), triangles.end ());
    return triangles;
  };
  for (std::size_t part = 0; part < a.parts.size (); ++part) {
    EXPECT_EQ (a.parts[part].dropped, b.parts[part].dropped);
    EXPECT_EQ (a.parts[part].beside, b.parts[part].beside);
    EXPECT_EQ (sorted (a.parts[part].added), sorted (b.parts[part].added));
    EXPECT_EQ (sorted (a.parts[part].seam), sorted (b.parts[part].seam));
  }
  EXPECT_EQ (sorted (a.seam), sorted (b.seam));
  EXPECT_EQ (a.holes.filled, b.holes.filled);
  EXPECT_EQ (a.holes.doubtful.size (), b.holes.doubtful.size ());
}

std::optional<Stitching>
stitchWith (std::size_t rings, LocalParts& work, const Parts& parts,
            const SurfaceSettings& settings)
{
  RimJoiner joiner;
  for (std::size_t part = 0; part < parts.count (); ++part)
    joiner.add (work.rim (part, rings));
  return stitch (std::move (joiner).join (1), parts, 1.0, settings, 1);
}

class StitchedSurface : public testing::TestWithParam<SurfaceKind>
{
};

TEST_P (StitchedSurface, DoesNotDependOnWhatIsSeen)
{
  constexpr std::size_t EVERYTHING = 1000;
  PartLimits limits;
  limits.points = 700;
  for (const double noise : {0.0, 0.25}) {
    Prepared prepared = prepare (surface (GetParam (), 4000, noise));
    const Parts parts (prepared.points.size (), limits);
    PartsSettings parts_settings;
    parts_settings.parts = limits;
    const SurfaceSettings& settings = parts_settings.surface;
    LocalParts work (prepared.points, parts, prepared.geometry, parts_settings, 1);
    const std::optional<Stitching> all = stitchWith (EVERYTHING, work, parts, settings);
    ASSERT_TRUE (all);
    EXPECT_FALSE (all->seam.empty ());
    std::size_t rings = limits.rings;
    std::optional<Stitching> some = stitchWith (rings, work, parts, settings);
    for (; !some && rings < EVERYTHING; rings *= 2)
      some = stitchWith (rings, work, parts, settings);
    ASSERT_TRUE (some);
    expectSame (*some, *all);
  }
}

INSTANTIATE_TEST_SUITE_P (Surfaces, StitchedSurface,
                          testing::Values (SurfaceKind::HEIGHT_FIELD, SurfaceKind::CUT_OUT,
                                           SurfaceKind::SPHERE, SurfaceKind::TORUS,
                                           SurfaceKind::FOLDED_SHEET, SurfaceKind::FINGER),
                          [] (const testing::TestParamInfo<SurfaceKind>& one) {
                            std::string name = surfaceName (one.param);
                            name.erase (std::remove (name.begin (), name.end (), '-'), name.end ());
                            return name;
                          });

// A boundary loop is judged by what lies four rings behind it.
TEST (Stitching, TellsThatTooLittleIsSeen)
{
  PartLimits limits;
  limits.points = 700;
  Prepared prepared = prepare (surface (SurfaceKind::HEIGHT_FIELD, 3000));
  const Parts parts (prepared.points.size (), limits);
  PartsSettings parts_settings;
  parts_settings.parts = limits;
  const SurfaceSettings& settings = parts_settings.surface;
  LocalParts work (prepared.points, parts, prepared.geometry, parts_settings, 1);
  EXPECT_FALSE (stitchWith (2, work, parts, settings));
  EXPECT_TRUE (stitchWith (8, work, parts, settings));
}

} // namespace
} // namespace pcl::floater
