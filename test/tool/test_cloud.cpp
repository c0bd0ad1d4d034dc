// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that stay in their file.
#include "atomic_file.h"
#include "cloud_reader.h"
#include "remaining_time.h"
#include "sample.h"
#include "tool_runner.h"

#include <sys/stat.h>

#include <fstream>
#include <random>
#include <thread>

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

using MappedCloud = ToolTest;

const Sample SAMPLE = makeSample (true);

// Points with an intensity and nothing else, so that all fields can stay in the file.
std::string
plainPly (ByteOrder order)
{
  std::string bytes = std::string ("ply\nformat binary_") +
                      (order == ByteOrder::LITTLE ? "little" : "big") +
                      "_endian 1.0\nelement vertex " + std::to_string (SAMPLE.size ()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property float intensity\nend_header\n";
  const auto append = [&] (auto number) {
    std::array<char, sizeof number> raw{};
    copyNumber<decltype (number)> (raw.data (), &number, order);
    bytes.append (raw.data (), raw.size ());
  };
  for (std::size_t i = 0; i < SAMPLE.size (); ++i) {
    for (const double coordinate : SAMPLE.points[i])
      append (coordinate);
    append (SAMPLE.intensities[i]);
  }
  return bytes;
}

TEST_F (MappedCloud, BinaryFieldsStayInTheFile)
{
  for (const ByteOrder order : {ByteOrder::LITTLE, ByteOrder::BIG}) {
    writeFile ("in.ply", plainPly (order));
    const Cloud cloud = readCloud (path ("in.ply"));
    EXPECT_EQ (cloud.positions (), SAMPLE.points);
    cloud.file.giveBack ();
    EXPECT_EQ (cloud.position (7), SAMPLE.points[7]); // is read from the file again
    ASSERT_EQ (cloud.fields.size (), 1U);
    EXPECT_TRUE (isInMappedFile (cloud.fields[0].first.get ()));
    EXPECT_EQ (cloud.fields[0].value<float> (7), SAMPLE.intensities[7]);
  }
}

TEST_F (MappedCloud, FieldsOutliveTheCloud)
{
  for (const PcdKind kind : readPcdKinds ()) {
    writePcd (path ("in.pcd"), SAMPLE, kind);
    const Field x = readCloud (path ("in.pcd")).coordinates[0];
    std::filesystem::remove (path ("in.pcd"));
    for (std::size_t i = 0; i < SAMPLE.size (); ++i)
      EXPECT_EQ (x.asDouble (i), SAMPLE.points[i].x ());
  }
}

TEST_F (MappedCloud, ChangesAreNoticed)
{
  writeFile ("in.ply", plainPly (ByteOrder::LITTLE));
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
  writeFile ("in.ply", plainPly (ByteOrder::LITTLE));
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

TEST_F (MappedCloud, APipeIsRead)
{
  const std::string bytes = plainPly (ByteOrder::LITTLE);
  ASSERT_EQ (::mkfifo (path ("in.ply").c_str (), 0600), 0);
  std::thread writer ([&] { std::ofstream (path ("in.ply"), std::ios::binary) << bytes; });
  const Cloud cloud = readCloud (path ("in.ply"));
  writer.join ();
  EXPECT_EQ (cloud.positions (), SAMPLE.points);
}

TEST (RemainingTime, IsToldOnlyOfLongRuns)
{
  RemainingTime remaining;
  remaining.update (1.0, 0.5);
  EXPECT_EQ (remaining.text (), "");
  remaining.update (4.0, 0.001);
  EXPECT_EQ (remaining.text (), "");
}

TEST (RemainingTime, OfASteadyRunIsExact)
{
  RemainingTime remaining;
  for (double seconds = 0.0; seconds <= 50.0; seconds += 0.05)
    remaining.update (seconds, seconds / 200.0);
  EXPECT_NEAR (remaining.left ().value (), 150.0, 0.1);
  EXPECT_EQ (remaining.text (), "24 %, 3 min left");
  for (double seconds = 50.0; seconds <= 190.5; seconds += 0.05)
    remaining.update (seconds, seconds / 200.0);
  EXPECT_EQ (remaining.text (), "95 %, 10 s left");
}

TEST (RemainingTime, IsSmooth)
{
  // The second half of the run takes four times as long as the first.
  RemainingTime remaining;
  double before = 0.0;
  for (double seconds = 0.05; seconds <= 50.0; seconds += 0.05) {
    remaining.update (seconds, seconds < 10.0 ? seconds / 20.0 : 0.5 + (seconds - 10.0) / 80.0);
    const double left = remaining.left ().value_or (0.0);
    if (seconds > 2.0) {
      EXPECT_LT (std::abs (left - before), 1.0);
    }
    before = left;
  }
  EXPECT_LT (before, 2.0);
}

} // namespace
} // namespace pcl::floater
