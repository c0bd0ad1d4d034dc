// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds whose fields stay in the file, and the time that a run still takes.
#include "cloud_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace pcl::floater {
namespace {
TEST (MappedCloud, BinaryFieldsStayInTheFileWhoseChangesAreNoticed)
{
  const std::filesystem::path path = std::filesystem::temp_directory_path () /
                                     ("pcl_floater_" + std::to_string (::getpid ()) + ".ply");
  std::ofstream (path) << "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty float x\n"
                          "property float y\nproperty float z\nproperty uchar a\nend_header\n"
                       << std::string (26, '\x40');
  const Field x = readCloud (path).coordinates[0]; // outlives the cloud
  EXPECT_EQ (x.asDouble (1), 3.0039215087890625);
  const Cloud cloud = readCloud (path);
  const std::vector<Eigen::Vector3d> positions = cloud.positions ();
  giveBackMappedFiles ();
  EXPECT_EQ (cloud.positions (), positions); // are read from the file again
  EXPECT_TRUE (isInMappedFile (cloud.fields[0].first.get ()));
  EXPECT_FALSE (cloud.file.hasChanged ());
  std::ofstream (path, std::ios::app) << "more";
  EXPECT_TRUE (cloud.file.hasChanged ());
  const Cloud other = readCloud (path);
  std::filesystem::remove (path);
  std::ofstream (path) << "another file is no change of the old one";
  EXPECT_FALSE (other.file.hasChanged ());
  std::filesystem::remove (path);
}

TEST (RemainingTime, IsToldOfLongRuns)
{
  EXPECT_EQ (remainingTime (1.0, 0.5), "");
  EXPECT_EQ (remainingTime (4.0, 0.001), "");
  EXPECT_EQ (remainingTime (48.0, 0.24), "24 %, 3 min left");
  EXPECT_EQ (remainingTime (190.0, 0.95), "95 %, 10 s left");
}

} // namespace
} // namespace pcl::floater
