// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The replaced operators new and delete, scratch files, pools, and the memory limit. Their state is
// that of the process: once a scratch folder is set, it stays set.
#include "array_pool.h"
#include "atomic_file.h"
#include "large_arrays.h"
#include "memory_limit.h"

#include <gmock/gmock.h>

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <functional>
#include <new>
#include <numeric>
#include <thread>
#include <vector>

namespace pcl::floater {
namespace {
using testing::HasSubstr;

// A sanitizer's own memory is resident, too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool IS_SANITIZED = true;
#else
constexpr bool IS_SANITIZED = false;
#endif

constexpr std::size_t MEGABYTE = std::size_t{1} << 20U;

/// Bytes of a field of /proc/self/status, which counts in kB.
std::size_t
memoryStatus (const std::string& field)
{
  std::ifstream file ("/proc/self/status");
  std::string word;
  while (file >> word)
    if (word == field + ":") {
      std::size_t kilobytes = 0;
      file >> kilobytes;
      return kilobytes * 1024;
    }
  return 0;
}

void
dropAll ()
{
  for (std::size_t dropped = 0; dropped < scratchUse ().bytes;)
    dropped += dropNextChunk ();
}

template <typename T>
void
expectAll (const std::vector<T>& array, T value)
{
  EXPECT_EQ (std::count (array.begin (), array.end (), value),
             static_cast<std::ptrdiff_t> (array.size ()));
}

/// The folder of all tests: arrays of one may outlive it.
struct ScratchFolder
{
  std::string path =
      (std::filesystem::temp_directory_path () / "pcl_floater_test.XXXXXX").string ();

  ScratchFolder ()
  {
    if (!::mkdtemp (path.data ()))
      throw std::runtime_error ("cannot make a temporary folder");
  }
  ~ScratchFolder () { std::filesystem::remove (path); }
};

const ScratchFolder SCRATCH;

/// Writes all bytes, to detect an array that is too short or not writable.
void
expectUsable (void* pointer, std::size_t size, std::size_t alignment)
{
  ASSERT_NE (pointer, nullptr);
  EXPECT_EQ (reinterpret_cast<std::uintptr_t> (pointer) % alignment, 0U);
  auto* bytes = static_cast<std::uint8_t*> (pointer);
  std::iota (bytes, bytes + size, std::uint8_t{1});
  EXPECT_EQ (bytes[size - 1], static_cast<std::uint8_t> (size));
}

/// Sizes below and above all limits, none of them a multiple of the page size.
void
useAllForms ()
{
  const std::size_t usual = alignof (std::max_align_t);
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{100}, LARGE_ARRAY - 1, LARGE_ARRAY + 1, 9 * LARGE_ARRAY + 7}) {
    SCOPED_TRACE (size);
    const auto use = [size] (void* pointer, std::size_t alignment) {
      expectUsable (pointer, size, alignment);
      return pointer;
    };
    ::operator delete (use (::operator new (size), usual));
    ::operator delete[] (use (::operator new[] (size), usual));
    ::operator delete (use (::operator new (size, std::nothrow), usual), size);
    ::operator delete[] (use (::operator new[] (size, std::nothrow), usual), size);
    for (const std::size_t alignment : {std::size_t{64}, std::size_t{4096}, 4 * MEGABYTE}) {
      const std::align_val_t aligned{alignment};
      ::operator delete (use (::operator new (size, aligned), alignment), aligned);
      ::operator delete[] (use (::operator new[] (size, aligned), alignment), size, aligned);
      ::operator delete (use (::operator new (size, aligned, std::nothrow), alignment), aligned,
                         std::nothrow);
    }
  }
  ::operator delete (nullptr);
  ::operator delete (::operator new (0));
}

TEST (LargeArrays, AllFormsOfNewAndDelete)
{
  useAllForms ();
  {
    const ArrayPool pool (100 * LARGE_ARRAY);
    useAllForms ();
  }
  keepLargeArraysIn (SCRATCH.path);
  useAllForms ();
  {
    const ArrayPool pool (5 * LARGE_ARRAY); // into which some do not fit
    useAllForms ();
  }
  EXPECT_EQ (scratchUse ().bytes, 0U);
}

TEST (LargeArrays, SizesBeyondAllMemoryAreRefused)
{
  const volatile std::size_t most = PTRDIFF_MAX;
  if (!IS_SANITIZED) { // the malloc of a sanitizer would end the program
    EXPECT_THROW (::operator delete (::operator new (most)), std::bad_alloc);
    EXPECT_EQ (::operator new (most - 100, std::nothrow), nullptr);
  }
  keepLargeArraysIn (SCRATCH.path);
  EXPECT_THROW (::operator delete (::operator new (most)), std::bad_alloc);
  EXPECT_EQ (::operator new (most - 100, std::nothrow), nullptr);
  EXPECT_EQ (scratchUse ().bytes, 0U);
}

TEST (LargeArrays, ScratchFilesHaveNoNamesAndGoWithTheirArrays)
{
  keepLargeArraysIn (SCRATCH.path);
  {
    const std::vector<char> small (LARGE_ARRAY / 2, 'a');
    EXPECT_EQ (scratchUse ().bytes, 0U);
    const std::vector<char> large (3 * LARGE_ARRAY + 1, 'b');
    EXPECT_GT (scratchUse ().bytes, 3 * LARGE_ARRAY);
    std::vector<char> other (5 * LARGE_ARRAY, 'c');
    EXPECT_GT (scratchUse ().bytes, 8 * LARGE_ARRAY);
    std::vector<char> ().swap (other);
    EXPECT_LT (scratchUse ().bytes, 4 * LARGE_ARRAY);
    EXPECT_TRUE (std::filesystem::is_empty (SCRATCH.path));
  }
  EXPECT_EQ (scratchUse ().bytes, 0U);
  EXPECT_EQ (dropNextChunk (), 0U);
}

/// Calls work (t) in several threads, and meanwhile() until all have ended.
void
runThreads (int count, const std::function<void (int)>& work,
            const std::function<void ()>& meanwhile)
{
  std::atomic<int> at_work{count};
  std::vector<std::thread> threads;
  threads.reserve (static_cast<std::size_t> (count));
  for (int t = 0; t < count; ++t)
    threads.emplace_back ([&, t] {
      work (t);
      --at_work;
    });
  while (at_work > 0)
    meanwhile ();
  for (std::thread& thread : threads)
    thread.join ();
}

/// In every round each thread adds one to all its numbers, while pages are dropped continuously and
/// other arrays are made and freed.
TEST (LargeArrays, NothingIsLostWhileThreadsWrite)
{
  constexpr std::size_t COUNT = 12 * MEGABYTE / sizeof (std::uint32_t);
  constexpr int THREADS = 3, ROUNDS = 6;
  // From malloc: dropping its pages would lose them.
  const std::vector<std::uint32_t> before (COUNT, 7);
  keepLargeArraysIn (SCRATCH.path);
  std::vector<std::vector<std::uint32_t>> arrays (THREADS, std::vector<std::uint32_t> (COUNT, 0));
  const auto work = [&arrays] (int t) {
    for (int round = 0; round < ROUNDS; ++round) {
      std::vector<std::uint32_t> copy (arrays[t]);
      for (std::uint32_t& number : copy)
        ++number;
      arrays[t].swap (copy);
    }
  };
  std::size_t chunks = 0;
  runThreads (THREADS, work, [&chunks] { chunks += dropNextChunk () > 0 ? 1 : 0; });
  EXPECT_GT (chunks, 10U);
  EXPECT_GT (scratchUse ().dropped, 10 * MEGABYTE);
  for (const std::vector<std::uint32_t>& array : arrays)
    expectAll (array, std::uint32_t{ROUNDS});
  expectAll (before, std::uint32_t{7});
}

TEST (LargeArrays, PoolIsInMemoryAndThenInOneFile)
{
  keepLargeArraysIn (SCRATCH.path);
  {
    const std::vector<char> before (LARGE_ARRAY, 'a');
    const ArrayPool pool (4 * LARGE_ARRAY);
    EXPECT_FALSE (areAllInPool ());
  }
  {
    const ArrayPool pool (4 * LARGE_ARRAY, 6 * LARGE_ARRAY);
    EXPECT_EQ (scratchUse ().bytes, 6 * LARGE_ARRAY);
    const std::vector<char> first (3 * LARGE_ARRAY, 'b'), second (5 * LARGE_ARRAY, 'c');
    const std::vector<char> third (LARGE_ARRAY, 'd');
    EXPECT_EQ (scratchUse ().bytes, 6 * LARGE_ARRAY);
    EXPECT_TRUE (areAllInPool ());
    dropAll ();                                            // loses nothing
    const std::vector<char> fourth (2 * LARGE_ARRAY, 'e'); // does not fit
    EXPECT_EQ (scratchUse ().bytes, 8 * LARGE_ARRAY);
    EXPECT_FALSE (areAllInPool ());
    expectAll (first, 'b');
    expectAll (second, 'c');
    expectAll (third, 'd');
    expectAll (fourth, 'e');
  }
  EXPECT_EQ (scratchUse ().bytes, 0U);
}

TEST (LargeArrays, PoolUsesMemoryAgainUntilItEnds)
{
  if (IS_SANITIZED)
    GTEST_SKIP () << "a sanitizer's own memory is resident, too";
  constexpr std::size_t SIZE = 40 * MEGABYTE;
  const std::size_t before = memoryStatus ("VmRSS");
  std::vector<char> longest;
  {
    const ArrayPool pool (4 * SIZE);
    longest.assign (SIZE, 'l');
    const auto addressOf = [] (const std::vector<char>& array) {
      return reinterpret_cast<std::uintptr_t> (array.data ());
    };
    const std::uintptr_t address = addressOf (std::vector<char> (SIZE, 'a'));
    for (int i = 0; i < 20; ++i) {
      const std::vector<char> again (SIZE - i, 'b');
      EXPECT_EQ (addressOf (again), address);
    }
    // Of all gaps, the first one into which it fits.
    std::vector<char> one (SIZE, '1');
    const std::vector<char> two (SIZE, '2');
    const std::uintptr_t gap = addressOf (one);
    std::vector<char> ().swap (one);
    const std::vector<char> three (SIZE, '3');
    EXPECT_EQ (addressOf (three), gap);
    EXPECT_GT (memoryStatus ("VmRSS"), before + 3 * SIZE - MEGABYTE);
  }
  EXPECT_LT (memoryStatus ("VmRSS"), before + SIZE + 8 * MEGABYTE);
  expectAll (longest, 'l');
  {
    // The range of the last pool is still in use, and this one has no other.
    const ArrayPool pool (4 * SIZE);
    const std::vector<char> more (SIZE, 'm');
    expectAll (longest, 'l');
    EXPECT_TRUE (areAllInPool ());
  }
  std::vector<char> ().swap (longest);
  EXPECT_LT (memoryStatus ("VmRSS"), before + 8 * MEGABYTE);
  EXPECT_FALSE (areAllInPool ());
}

/// Arrays of several threads must not overlap, in a pool and beside it.
TEST (LargeArrays, PoolOfSeveralThreads)
{
  keepLargeArraysIn (SCRATCH.path);
  constexpr int THREADS = 4, ROUNDS = 200;
  const ArrayPool pool (6 * MEGABYTE, 4 * MEGABYTE);
  const auto work = [] (int t) {
    for (int round = 0; round < ROUNDS; ++round) {
      const std::vector<int> one ((1 + (t + round) % 3) * MEGABYTE / sizeof (int), t);
      const std::vector<int> other (MEGABYTE / sizeof (int), round);
      expectAll (one, t);
      expectAll (other, round);
    }
  };
  runThreads (THREADS, work, [] { std::this_thread::yield (); });
  EXPECT_EQ (scratchUse ().bytes, 4 * MEGABYTE);
}

/// A limit on file sizes stands for a full disk.
TEST (LargeArrays, NoRoomIsBadAllocAndIsDescribed)
{
  keepLargeArraysIn (SCRATCH.path);
  const std::vector<char> first (4 * LARGE_ARRAY, 'a');
  ASSERT_EQ (scratchUse ().bytes, 4 * LARGE_ARRAY);
  const auto before = std::signal (SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ (::getrlimit (RLIMIT_FSIZE, &limit), 0);
  const rlimit lower{8 * LARGE_ARRAY, limit.rlim_max};
  ASSERT_EQ (::setrlimit (RLIMIT_FSIZE, &lower), 0);
  EXPECT_THROW (std::vector<char> (9 * LARGE_ARRAY), std::bad_alloc);
  EXPECT_EQ (::operator new (9 * LARGE_ARRAY, std::nothrow), nullptr);
  EXPECT_NO_THROW (std::vector<char> (7 * LARGE_ARRAY));
  ASSERT_EQ (::setrlimit (RLIMIT_FSIZE, &limit), 0);
  std::signal (SIGXFSZ, before);
  EXPECT_THAT (largeArrayFailure (),
               HasSubstr ("no room in the scratch folder '" + SCRATCH.path + "': File too"));
  EXPECT_THAT (largeArrayFailure (), HasSubstr ("it holds 4 MB, and 9 MB more are needed"));
  EXPECT_NO_THROW (std::vector<char> (9 * LARGE_ARRAY));
}

TEST (LargeArrays, Sizes)
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

/// Two threads fill and read three times as much as the limit. The first arrays are in the pool,
/// which is then found to be too small.
TEST (LargeArrays, ResidentSetStaysBelowTheLimit)
{
  if (IS_SANITIZED)
    GTEST_SKIP () << "a sanitizer's own memory is resident, too";
  constexpr std::size_t LIMIT = 240 * MEGABYTE, COUNT = 16 * MEGABYTE / sizeof (std::uint64_t);
  constexpr int ARRAYS = 50;
  std::ofstream ("/proc/self/clear_refs") << 5; // resets the peak
  if (memoryStatus ("VmHWM") > LIMIT / 2)
    GTEST_SKIP () << "the memory of earlier tests cannot be separated";
  const MemoryLimit limit (LIMIT, SCRATCH.path);
  const std::size_t in_memory = limit.residentSet ().poolInMemory ();
  const std::size_t in_file = limit.residentSet ().poolInFile ();
  EXPECT_GT (in_memory + in_file, LIMIT / 4 * 3);
  const ArrayPool pool (in_memory, in_file);
  {
    const std::vector<char> fits (in_memory - POOL_ALIGNMENT, 'a');
    const std::vector<char> fits_too (in_file - POOL_ALIGNMENT, 'b');
    EXPECT_TRUE (areAllInPool ());
  }
  std::vector<std::vector<std::uint64_t>> arrays (ARRAYS);
  std::atomic<std::size_t> wrong{0};
  const auto work = [&] (int first) {
    for (int a = first; a < ARRAYS; a += 2) {
      arrays[a].resize (COUNT);
      std::iota (arrays[a].begin (), arrays[a].end (), a);
    }
    std::size_t errors = 0;
    for (int a = first; a < ARRAYS; a += 2)
      for (std::size_t i = 0; i < COUNT; ++i)
        errors += arrays[a][i] == a + i ? 0 : 1;
    wrong += errors;
  };
  runThreads (2, work, [] { std::this_thread::yield (); });
  EXPECT_EQ (wrong, 0U);
  EXPECT_GT (scratchUse ().bytes, 2 * LIMIT);
  EXPECT_LT (memoryStatus ("VmHWM"), LIMIT);
}

} // namespace
} // namespace pcl::floater
