// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds whose fields stay in the file.
#include "atomic_file.h"
#include "cloud_reader.h"
#include "tool_runner.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <vector>

namespace pcl::floater {
namespace {
TEST (KeptPoints, NumbersAndRowsAreInverse)
{
  std::mt19937 random (5);
  for (const std::size_t rows : {1U, 63U, 64U, 65U, 1000U})
    for (const unsigned kept_in_ten : {0U, 1U, 5U, 9U, 10U}) {
      std::vector<bool> keep (rows);
      for (std::size_t row = 0; row < rows; ++row)
        keep[row] = random () % 10 < kept_in_ten;
      const KeptPoints kept (rows, [&keep] (std::size_t row) { return keep[row]; });
      std::size_t number = 0;
      for (std::size_t row = 0; row < rows; ++row)
        if (keep[row]) {
          EXPECT_EQ (kept.number (static_cast<std::uint32_t> (row)), number);
          EXPECT_EQ (kept.row (number), row);
          ++number;
        }
      EXPECT_EQ (kept.areAll (), number == rows);
      EXPECT_EQ (kept.size (), number);
    }
}

// Points with an intensity and nothing else, so that all fields can stay in the file.
class MappedCloud : public ToolTest
{
protected:
  MappedCloud () { writeFile ("in.ply", plyText (sample_, PlyKind::LITTLE, true)); }

  const Sample sample_ = makeSample (true);
};

TEST_F (MappedCloud, BinaryFieldsStayInTheFile)
{
  for (const PlyKind kind : {PlyKind::LITTLE, PlyKind::BIG}) {
    writeFile ("in.ply", plyText (sample_, kind, true));
    const Cloud cloud = readCloud (path ("in.ply"));
    EXPECT_EQ (cloud.positions (), sample_.points);
    cloud.file.giveBack ();
    EXPECT_EQ (cloud.position (7), sample_.points[7]); // is read from the file again
    ASSERT_EQ (cloud.fields.size (), 1U);
    EXPECT_TRUE (isInMappedFile (cloud.fields[0].first.get ()));
    EXPECT_EQ (cloud.fields[0].value<float> (7), sample_.intensities[7]);
  }
}

TEST_F (MappedCloud, FieldsOutliveTheCloud)
{
  for (const PcdKind kind : readPcdKinds ()) {
    writePcd (path ("in.pcd"), sample_, kind);
    const Field x = readCloud (path ("in.pcd")).coordinates[0];
    std::filesystem::remove (path ("in.pcd"));
    for (std::size_t i = 0; i < sample_.size (); ++i)
      EXPECT_EQ (x.asDouble (i), sample_.points[i].x ());
  }
}

TEST_F (MappedCloud, ChangesAreNoticed)
{
  const Cloud cloud = readCloud (path ("in.ply"));
  EXPECT_FALSE (cloud.file.hasChanged ());
  std::ofstream (path ("in.ply"), std::ios::app) << "more";
  EXPECT_TRUE (cloud.file.hasChanged ());
  // A new file of the same name is not a change of the old one.
  const Cloud again = readCloud (path ("in.ply"));
  std::filesystem::remove (path ("in.ply"));
  writeFile ("in.ply", "another");
  EXPECT_FALSE (again.file.hasChanged ());
}

TEST_F (MappedCloud, AFileThatShrinksIsAnOrderlyEnd)
{
  const auto read = [this] {
    handleSignals (42);
    const Cloud cloud = readCloud (path ("in.ply"));
    const AtomicFile output (path ("out.ply"));
    std::filesystem::resize_file (path ("in.ply"), 0);
    cloud.file.giveBack ();
    return cloud.positions ();
  };
  EXPECT_EXIT (read (), testing::ExitedWithCode (42), "the input file was truncated");
  EXPECT_EQ (names (), std::set<std::string>{"in.ply"});
}

} // namespace
} // namespace pcl::floater
