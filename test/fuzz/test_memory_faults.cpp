// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a run fails once, and once together with all later ones: the run ends with a
// status, nothing escapes, nothing leaks, and the next run is as before.
//
// Malloc and its kin are replaced, and with them operator new and what C libraries allocate. For
// glibc, and not together with a sanitizer, which replaces them itself.
#include "attack.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <cerrno>

// The functions of glibc under the names that stay when they are replaced.
extern "C" {
void*
__libc_malloc (std::size_t size);
void*
__libc_calloc (std::size_t count, std::size_t size);
void*
__libc_realloc (void* block, std::size_t size);
void*
__libc_memalign (std::size_t alignment, std::size_t size);
void
__libc_free (void* block);
}

namespace pcl::floater {
namespace {
using namespace samples;

/// What fails of the allocations that a thread makes after failAllocations ().
enum class MemoryFault
{
  NONE, ///< none; they are counted
  ONE,  ///< a single one
  ALL   ///< that one and all later ones
};

// No constructor and no allocation: they are used before main ().
thread_local bool is_counting = false;
thread_local MemoryFault kind_of_fault = MemoryFault::NONE;
thread_local std::size_t failing = 0, allocations = 0;
std::atomic<long> live_blocks{0}; // of the whole process

bool
isToFail ()
{
  if (!is_counting)
    return false;
  const std::size_t n = allocations++;
  if (kind_of_fault == MemoryFault::NONE || n < failing ||
      (kind_of_fault == MemoryFault::ONE && n > failing))
    return false;
  errno = ENOMEM;
  return true;
}

void*
counted (void* block)
{
  if (block != nullptr)
    live_blocks.fetch_add (1, std::memory_order_relaxed);
  return block;
}

/// Begins to count the allocations of this thread.
/// \param n the one that fails, from 0
void
failAllocations (MemoryFault fault, std::size_t n)
{
  kind_of_fault = fault;
  failing = n;
  allocations = 0;
  is_counting = true;
}

/// Ends it.
/// \return how many there were, with those that failed
std::size_t
stopFailing ()
{
  is_counting = false;
  return allocations;
}

} // namespace
} // namespace pcl::floater

using pcl::floater::counted;
using pcl::floater::isToFail;

extern "C" {
void*
malloc (std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_malloc (size));
}

void*
calloc (std::size_t count, std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_calloc (count, size));
}

void*
realloc (void* block, std::size_t size)
{
  if (isToFail ())
    return nullptr;
  void* const moved = __libc_realloc (block, size);
  return block == nullptr ? counted (moved) : moved;
}

void*
memalign (std::size_t alignment, std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_memalign (alignment, size));
}

void*
aligned_alloc (std::size_t alignment, std::size_t size)
{
  return memalign (alignment, size);
}

int
posix_memalign (void** block, std::size_t alignment, std::size_t size)
{
  *block = memalign (alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

void
free (void* block)
{
  if (block != nullptr)
    pcl::floater::live_blocks.fetch_sub (1, std::memory_order_relaxed);
  __libc_free (block);
}
}

namespace pcl::floater {
namespace {
struct Way
{
  const char* name;
  Input input;
  Options options;
};

std::vector<Way>
allWays (std::size_t points)
{
  Options disc = discOptions (), iterative = disc, ordered = disc, balls, surface, view;
  iterative.disc.solver.method = Solver::BICGSTAB_ILUT;
  iterative.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS;
  iterative.disc.boundary.cluster_tolerance = 0.3;
  ordered.disc.solver.ordering = Ordering::METIS;
  ordered.disc.boundary.method = BoundaryMethod::CONSENSUS;
  balls.neighbors.kind = Neighborhood::BALL_DELAUNAY;
  balls.trimming.minimum_component_size = 5;
  surface.holes.policy = HolePolicy::CLOSE_ALL;
  view.view.use = ViewUse::GIVEN;
  const auto make = [points] (const char* name, SurfaceKind kind, Options options) {
    options.threads = 1;
    return Way{name, asInput (samples::surface (kind, points)), options};
  };
  std::vector<Way> ways{make ("disc", SurfaceKind::HEIGHT_FIELD, disc),
                        make ("hemisphere", SurfaceKind::HEMISPHERE, disc),
                        make ("iterative", SurfaceKind::HEIGHT_FIELD, iterative),
                        make ("ordered", SurfaceKind::HEIGHT_FIELD, ordered),
                        make ("surface", SurfaceKind::HEMISPHERE, surface),
                        make ("balls", SurfaceKind::TORUS, balls)};
  const auto width = static_cast<std::size_t> (std::sqrt (static_cast<double> (points)));
  view.threads = 1;
  ways.push_back ({"view", asInput (samples::wallInView (width, 1.0)), view});
  return ways;
}

using MemoryFaults = testing::TestWithParam<std::size_t>;

TEST_P (MemoryFaults, EndARunInAnOrderlyWay)
{
  const Way way = allWays (fuzz::wantedBy ("PCL_FLOATER_MEMORY_POINTS", 120))[GetParam ()];
  SCOPED_TRACE (way.name);
  const Result expected = reconstruct (way.input, way.options);
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
  failAllocations (MemoryFault::NONE, 0);
  reconstruct (way.input, way.options);
  const std::size_t all = stopFailing ();
  // About as many failures of each kind, spread over all allocations; 0: at every allocation. The
  // way in balls makes zones anew, and has 18,000 allocations, which would take ten minutes.
  const std::size_t wanted = fuzz::wantedBy ("PCL_FLOATER_MEMORY_FAULTS", 5000);
  const std::size_t step = wanted == 0 ? 1 : std::max<std::size_t> (all / wanted, 1);
  std::size_t ended = 0, survived = 0;
  for (const MemoryFault fault : {MemoryFault::ONE, MemoryFault::ALL})
    for (std::size_t n = 0; n < all; n += step) {
      Input input = way.input; // before memory is short; reconstruct () takes it over
      const long before = live_blocks;
      {
        Result result;
        bool has_thrown = false;
        failAllocations (fault, n);
        try {
          result = reconstruct (std::move (input), way.options);
        }
        catch (...) {
          has_thrown = true;
        }
        stopFailing ();
        EXPECT_FALSE (has_thrown) << "allocation " << n << " of " << all;
        if (result.report.status == RunStatus::SUCCESS) { // a library has done without
          ++survived;
          EXPECT_EQ (result.triangles, expected.triangles) << "allocation " << n;
        }
        else {
          ++ended;
          EXPECT_EQ (result.report.status, RunStatus::OUT_OF_MEMORY)
              << "allocation " << n << " of " << all << ": " << result.report.message;
          EXPECT_FALSE (result.report.message.empty ());
          EXPECT_TRUE (result.triangles.empty ());
        }
      }
      // The input, whose three arrays are freed, was allocated before.
      EXPECT_LE (live_blocks.load (), before) << "leak after allocation " << n << " of " << all;
    }
  EXPECT_GT (ended, survived);
  EXPECT_EQ (reconstruct (way.input, way.options).triangles, expected.triangles);
}

INSTANTIATE_TEST_SUITE_P (Ways, MemoryFaults, testing::Range<std::size_t> (0, 7));

} // namespace
} // namespace pcl::floater
