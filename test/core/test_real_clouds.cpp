// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on real clouds with a ground truth: vertex k of <name>.gt.ply is point k of
// <name>.pcd. They are looked for in the folder PCL_FLOATER_DATA of the environment.
#include <pcl/surface/floater/reconstruct.h>

#include "samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace pcl::floater {
namespace {
using samples::Positions;

std::string
dataFolder ()
{
  const char* folder = std::getenv ("PCL_FLOATER_DATA");
  return folder != nullptr && *folder != '\0' ? folder : PCL_FLOATER_DEFAULT_DATA;
}

// Why a test is skipped.
std::string
missing (const std::string& name)
{
  return std::ifstream (dataFolder ()) ? "there is no " + name + ".pcd in " + dataFolder ()
                                       : "PCL_FLOATER_DATA names no folder with real clouds";
}

// Reads the header up to its last line; true if it has the lines wanted.
bool
readHeader (std::istream& file, const std::string& last, const std::vector<std::string>& wanted,
            std::map<std::string, std::size_t>& counts)
{
  std::set<std::string> lines;
  for (std::string line; std::getline (file, line);) {
    lines.insert (line);
    std::istringstream words (line);
    std::string key, value;
    std::size_t count = 0;
    words >> key;
    if (key == "element")
      words >> key;
    if (words >> count)
      counts[key] = count;
    if (line == last)
      return std::all_of (wanted.begin (), wanted.end (),
                          [&lines] (const std::string& w) { return lines.count (w) == 1; });
  }
  return false;
}

// Points of a binary PCD file of x, y and z in single precision.
Positions
readPcd (const std::string& path)
{
  std::ifstream file (path, std::ios::binary);
  std::map<std::string, std::size_t> counts;
  if (!readHeader (file, "DATA binary", {"FIELDS x y z", "SIZE 4 4 4", "TYPE F F F"}, counts))
    return {};
  Positions points (counts["POINTS"]);
  for (Eigen::Vector3d& p : points) {
    std::array<float, 3> xyz{};
    file.read (reinterpret_cast<char*> (xyz.data ()), sizeof xyz);
    p = {xyz[0], xyz[1], xyz[2]};
  }
  return file ? points : Positions{};
}

// Triangles of a binary PLY file whose vertices are x, y and z in single precision.
std::vector<Triangle>
readPly (const std::string& path)
{
  std::ifstream file (path, std::ios::binary);
  std::map<std::string, std::size_t> counts;
  if (!readHeader (file, "end_header", {"format binary_little_endian 1.0", "property float z"},
                   counts))
    return {};
  file.ignore (static_cast<std::streamsize> (counts["vertex"] * 3 * sizeof (float)));
  std::vector<Triangle> triangles (counts["face"]);
  for (Triangle& t : triangles) {
    if (file.get () != 3)
      return {};
    file.read (reinterpret_cast<char*> (t.data ()), sizeof t);
  }
  return file ? triangles : std::vector<Triangle>{};
}

std::set<std::pair<Index, Index>>
edgesOf (const std::vector<Triangle>& triangles)
{
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert (std::minmax (t[i], t[(i + 1) % 3]));
  return edges;
}

template <typename Set>
double
shareOf (const Set& wanted, const Set& found)
{
  std::size_t both = 0;
  for (const auto& member : wanted)
    both += found.count (member);
  return static_cast<double> (both) / static_cast<double> (wanted.size ());
}

/// The bounds are a little below what was reached. A boundary cut by a plane is jagged, and where
/// the points lie on a grid there are two equal diagonals: neither is met in full.
struct Case
{
  const char* name;
  double loop_recall; ///< least share of the true boundary points that are on the loop
  double edge_recall; ///< least share of the true edges that are in the mesh
};

void
PrintTo (const Case& cloud, std::ostream* out)
{
  *out << cloud.name;
}

class RealCloud : public testing::TestWithParam<Case>
{
};

TEST_P (RealCloud, IsOneDiscOfAllPoints)
{
  const Case& expected = GetParam ();
  const std::string base = dataFolder () + "/" + expected.name;
  if (!std::ifstream (base + ".pcd"))
    GTEST_SKIP () << missing (expected.name);
  const Positions cloud = readPcd (base + ".pcd");
  const std::vector<Triangle> truth = readPly (base + ".gt.ply");
  ASSERT_FALSE (cloud.empty ()) << base << ".pcd is not what this test can read";
  ASSERT_FALSE (truth.empty ()) << base << ".gt.ply is not what this test can read";

  const Result result = reconstruct (samples::asInput (cloud), samples::discOptions ());
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, cloud.size ());
  EXPECT_EQ (topology.components, 1U);
  EXPECT_EQ (topology.euler, 1);
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (samples::canonicalCycle (topology.loops.front ()),
             samples::canonicalCycle (result.report.loop));

  const std::vector<Index> true_loop = samples::topologyOf (truth).loops.at (0);
  const double loop_recall =
      shareOf (std::set<Index> (true_loop.begin (), true_loop.end ()),
               std::set<Index> (result.report.loop.begin (), result.report.loop.end ()));
  const double edge_recall = shareOf (edgesOf (truth), edgesOf (result.triangles));
  EXPECT_GE (loop_recall, expected.loop_recall);
  EXPECT_GE (edge_recall, expected.edge_recall);
  RecordProperty ("loop_recall", std::to_string (loop_recall));
  RecordProperty ("edge_recall", std::to_string (edge_recall));
  RecordProperty ("folds", std::to_string (result.report.statistics.folds));
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

class AnyRealCloud : public testing::TestWithParam<Known>
{
};

TEST_P (AnyRealCloud, IsWhatItIs)
{
  const Known& known = GetParam ();
  const std::string base = dataFolder () + "/" + known.name;
  if (!std::ifstream (base + ".pcd"))
    GTEST_SKIP () << missing (known.name);
  const Positions cloud = readPcd (base + ".pcd");
  ASSERT_FALSE (cloud.empty ()) << base << ".pcd is not what this test can read";
  Options options;
  options.holes.policy = known.holes;
  options.holes.kept_loops = known.kept_loops;
  const Result result = reconstruct (samples::asInput (cloud), options);
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  const samples::Topology topology = samples::topologyOf (result.triangles);
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

INSTANTIATE_TEST_SUITE_P (Discs, RealCloud,
                          testing::Values (Case{"snail", 0.99, 0.985}, Case{"lilium", 0.99, 0.99},
                                           Case{"tum_rabbit", 0.98, 0.95},
                                           Case{"man_bust", 0.99, 0.81},
                                           Case{"bunny", 0.72, 0.965}),
                          [] (const testing::TestParamInfo<Case>& cloud) {
                            return std::string (cloud.param.name);
                          });

} // namespace
} // namespace pcl::floater
