// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on real clouds, which are looked for in the folder PCL_FLOATER_DATA of the environment.
#include <pcl/surface/floater/reconstruct.h>

#include "cloud_reader.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace pcl::floater {
namespace {
using namespace samples;

std::string
dataFolder ()
{
  const char* folder = std::getenv ("PCL_FLOATER_DATA");
  return folder != nullptr && *folder != '\0' ? folder : PCL_FLOATER_DEFAULT_DATA;
}

/// Topology of a cloud by its ground truth, and the policy for holes where that is ambiguous.
struct Known
{
  const char* name;
  std::size_t components, loops;
  std::int64_t genus;
  std::size_t most_folds; ///< what the ground truth has, but for none
  HolePolicy holes = HolePolicy::AUTO;
  int kept_loops = 1;
};

void
PrintTo (const Known& cloud, std::ostream* out)
{
  *out << cloud.name;
}

using AnyRealCloud = testing::TestWithParam<Known>;

TEST_P (AnyRealCloud, IsWhatItIs)
{
  const Known& known = GetParam ();
  const std::string base = dataFolder () + "/" + known.name;
  if (!std::ifstream (base + ".pcd"))
    GTEST_SKIP () << "PCL_FLOATER_DATA names no folder with this cloud";
  const Positions cloud = readCloud (base + ".pcd").positions ();
  Options options;
  options.holes.policy = known.holes;
  options.holes.kept_loops = known.kept_loops;
  const Result result = meshOf (cloud, options);
  const MeshTopology topology = topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, cloud.size ());
  EXPECT_EQ (topology.components, known.components);
  EXPECT_EQ (topology.loops.size (), known.loops);
  EXPECT_EQ (topology.euler, 2 * static_cast<long> (known.components) -
                                 static_cast<long> (known.loops) -
                                 2 * static_cast<long> (known.genus));
  EXPECT_EQ (result.report.check.components, known.components);
  EXPECT_EQ (result.report.check.loops.size (), known.loops);
  EXPECT_EQ (result.report.check.genus, known.genus);
  EXPECT_LE (result.report.check.folds, known.most_folds);
}

INSTANTIATE_TEST_SUITE_P (
    Clouds, AnyRealCloud,
    testing::Values (Known{"snail", 1, 1, 0, 0}, Known{"lilium", 1, 1, 0, 0},
                     Known{"fandisk", 1, 1, 0, 0}, Known{"lion_head", 1, 1, 0, 5},
                     Known{"tum_rabbit", 1, 1, 0, 0}, Known{"camel_head", 1, 1, 0, 7},
                     Known{"man_bust", 1, 1, 0, 0}, Known{"bunny", 1, 1, 0, 0},
                     Known{"max_planck", 1, 1, 0, 0}, Known{"nefertiti", 1, 1, 0, 197},
                     Known{"st_helens", 1, 1, 0, 0}, Known{"face_strip", 1, 1, 0, 0},
                     Known{"hill_lidar", 1, 1, 0, 30}, Known{"igea", 1, 1, 0, 0},
                     Known{"field_lidar", 1, 1, 0, 0}, Known{"spot_closed", 1, 0, 0, 0},
                     Known{"rocker_arm_closed", 1, 0, 1, 0}, Known{"fertility_closed", 1, 0, 4, 0},
                     Known{"two_objects", 2, 0, 1, 46}, Known{"max_planck_mask", 1, 4, 0, 0},
                     Known{"beetle_windows", 1, 11, 0, 0},
                     Known{"bunny_holes", 1, 5, 0, 0, HolePolicy::KEEP_COUNT, 5}),
    [] (const testing::TestParamInfo<Known>& cloud) { return std::string (cloud.param.name); });

} // namespace
} // namespace pcl::floater
