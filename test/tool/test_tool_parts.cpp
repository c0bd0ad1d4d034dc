// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the tool: the replaced operators new and delete, scratch files, and the memory limit,
// whose state is that of the process: once a scratch folder is set, it stays set. With a sanitizer,
// which has operators of its own, there is nothing to test of them but sizes. And clouds whose fields
// stay in the file, and the time that a run still takes.
#include "cloud_reader.h"
#include "scratch_arrays.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <new>
#include <numeric>
#include <thread>

namespace pcl::floater {
namespace {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool IS_SANITIZED = true;
#else
constexpr bool IS_SANITIZED = false;
#endif

constexpr std::size_t MEGABYTE = std::size_t{1} << 20U;

constexpr std::size_t LIMIT = 240 * MEGABYTE;

/// From its first test on, large arrays are in a scratch folder.
struct ScratchArrays : testing::Test
{
  static std::string folder ()
  {
    static const std::string once = [] {
      std::string path =
          (std::filesystem::temp_directory_path () / "pcl_floater_test.XXXXXX").string ();
      if (!::mkdtemp (path.data ()))
        throw std::runtime_error ("cannot make a temporary folder");
      keepLargeArraysIn (path, LIMIT);
      return path;
    }();
    return once;
  }
  static void TearDownTestSuite () { std::filesystem::remove (folder ()); }
  void SetUp () override
  {
    if (IS_SANITIZED)
      GTEST_SKIP () << "the operators are those of the sanitizer";
    folder ();
  }
};

/// Sizes of small and large arrays, none of them a multiple of the page size. All bytes are written.
void
useAllForms ()
{
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{100}, LARGE_ARRAY - 1, LARGE_ARRAY + 1, 9 * LARGE_ARRAY + 7}) {
    SCOPED_TRACE (size);
    const auto use = [size] (void* pointer, std::size_t alignment) {
      EXPECT_EQ (reinterpret_cast<std::uintptr_t> (pointer) % alignment, 0U);
      auto* bytes = static_cast<std::uint8_t*> (pointer);
      std::iota (bytes, bytes + size, std::uint8_t{1});
      EXPECT_EQ (bytes[size - 1], static_cast<std::uint8_t> (size));
      return pointer;
    };
    const std::size_t usual = alignof (std::max_align_t), wide = 4096;
    ::operator delete (use (::operator new (size), usual));
    ::operator delete[] (use (::operator new[] (size), usual), size);
    ::operator delete (use (::operator new (size, std::nothrow), usual), size);
    ::operator delete (use (::operator new (size, std::align_val_t{wide}), wide),
                       std::align_val_t{wide});
  }
  ::operator delete (nullptr);
  ::operator delete (::operator new (0));
}

TEST (Operators, AllFormsWithoutAFolder)
{
  useAllForms ();
}

TEST_F (ScratchArrays, AllForms)
{
  useAllForms ();
  EXPECT_EQ (scratchUse ().bytes, 0U);
}

TEST_F (ScratchArrays, SizesBeyondAllMemoryAreRefused)
{
  const volatile std::size_t most = PTRDIFF_MAX;
  EXPECT_THROW (::operator delete (::operator new (most)), std::bad_alloc);
  EXPECT_EQ (::operator new (most - 100, std::nothrow), nullptr);
  EXPECT_EQ (scratchUse ().bytes, 0U);
}

/// In every round each thread adds one to all its numbers, while pages are dropped continuously and
/// other arrays are made and freed.
TEST_F (ScratchArrays, NothingIsLostWhileThreadsWrite)
{
  constexpr std::size_t COUNT = 12 * MEGABYTE / sizeof (std::uint32_t);
  constexpr std::uint32_t THREADS = 3, ROUNDS = 6;
  std::atomic<std::uint32_t> at_work{THREADS};
  std::vector<std::vector<std::uint32_t>> arrays (THREADS, std::vector<std::uint32_t> (COUNT, 0));
  std::vector<std::thread> threads;
  for (std::vector<std::uint32_t>& array : arrays)
    threads.emplace_back ([&array, &at_work] {
      for (std::uint32_t round = 0; round < ROUNDS; ++round) {
        std::vector<std::uint32_t> copy (array);
        for (std::uint32_t& number : copy)
          ++number;
        array.swap (copy);
      }
      --at_work;
    });
  while (at_work > 0)
    dropPages ();
  for (std::thread& thread : threads)
    thread.join ();
  for (const std::vector<std::uint32_t>& array : arrays)
    EXPECT_EQ (std::count (array.begin (), array.end (), ROUNDS), std::ptrdiff_t{COUNT});
}

TEST (MemoryLimit, Sizes)
{
  const std::vector<std::pair<std::string, std::size_t>> good{
      {"0", 0},       {"123456789", 123456789},  {"500M", 500'000'000}, {"2g", 2'000'000'000},
      {"1.5k", 1500}, {"2T", 2'000'000'000'000}, {"1e9", 1'000'000'000}};
  for (const auto& [word, expected] : good) {
    std::size_t bytes = 1;
    EXPECT_TRUE (parseSize (word, bytes)) << word;
    EXPECT_EQ (bytes, expected) << word;
  }
  std::size_t unchanged = 1;
  for (const std::string word :
       {"", "G", "-1", "-1G", "1GG", "1 G", "2GB", "many", "nan", "inf", "1e30", "9999999999T"})
    EXPECT_FALSE (parseSize (word, unchanged)) << word;
  EXPECT_EQ (unchanged, 1U);
  EXPECT_EQ (formatSize (500'000'000), "500M");
  EXPECT_EQ (formatSize (500'000'001), "501M");
  EXPECT_GT (leastMemory (0), 10 * MEGABYTE);
  EXPECT_GT (leastMemory (10'000'000), leastMemory (1'000'000));
  EXPECT_GT (leastMemory (10'000'000), leastMemory (10'000'000, KEPT_PER_POINT / 2.0));
  EXPECT_EQ (leastMemory (0, 1.0), leastMemory (0));
}

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
  EXPECT_EQ (cloud.fields[0].first.get (),
             cloud.file.view ().data () + cloud.file.view ().size () - 14);
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
