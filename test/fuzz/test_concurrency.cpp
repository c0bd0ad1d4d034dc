// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Objects of the class in several threads, cancellation from another thread, and one object used
// again and again.
#include "surfaces.h"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include <malloc.h>

namespace pcl::floater {
namespace {
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Floater = pcl::FloaterReconstruction<pcl::PointXYZ>;

Cloud::Ptr
makeCloud (SurfaceKind kind, std::size_t points)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  const Cloud::Ptr cloud (new Cloud);
  for (const Eigen::Vector3d& position : generateSurface (spec)) {
    pcl::PointXYZ point;
    point.getVector3fMap () = position.cast<float> ();
    cloud->push_back (point);
  }
  return cloud;
}

std::vector<pcl::Indices>
polygonsOf (Floater& floater, const Cloud::Ptr& cloud)
{
  floater.setInputCloud (cloud);
  Cloud points;
  std::vector<pcl::Vertices> polygons;
  floater.reconstruct (points, polygons);
  std::vector<pcl::Indices> all;
  for (const pcl::Vertices& polygon : polygons)
    all.push_back (polygon.vertices);
  return all;
}

TEST (Concurrency, EightObjectsInEightThreads)
{
  std::vector<std::function<std::vector<pcl::Indices> ()>> runs;
  for (const unsigned int threads : {1U, 2U})
    for (const auto& [kind, topology] : {std::pair{SurfaceKind::HEIGHT_FIELD, Topology::DISC},
                                         std::pair{SurfaceKind::FINGER, Topology::DISC},
                                         std::pair{SurfaceKind::TORUS, Topology::SURFACE},
                                         std::pair{SurfaceKind::CUT_OUT, Topology::AUTO}})
      runs.emplace_back ([threads, kind = kind, topology = topology] {
        Floater floater;
        floater.setTopology (topology);
        floater.setNumberOfThreads (threads);
        return polygonsOf (floater, makeCloud (kind, 1500));
      });
  std::vector<std::vector<pcl::Indices>> expected;
  for (const auto& run : runs)
    expected.push_back (run ());
  std::vector<std::size_t> wrong (runs.size (), 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < runs.size (); ++t)
    threads.emplace_back ([&, t] {
      for (int round = 0; round < 3; ++round)
        wrong[t] += expected[t].empty () || runs[t]() != expected[t] ? 1 : 0;
    });
  for (std::thread& thread : threads)
    thread.join ();
  EXPECT_EQ (wrong, std::vector<std::size_t> (runs.size (), 0));
}

// Another thread waits until a fraction of the run is done, and cancels it then: at 2 moments or more,
// as many as PCL_FLOATER_MOMENTS asks for.
TEST (Concurrency, CancelledFromAnotherThread)
{
  pcl::console::setVerbosityLevel (pcl::console::L_ALWAYS); // a failure is expected
  const Cloud::Ptr cloud = makeCloud (SurfaceKind::CUT_OUT, 3000);
  Floater plain;
  const std::vector<pcl::Indices> expected = polygonsOf (plain, cloud);
  std::size_t cancelled = 0;
  const char* const wanted = std::getenv ("PCL_FLOATER_MOMENTS");
  const int moments = wanted == nullptr ? 40 : std::max (2, std::atoi (wanted));
  for (int moment = 0; moment < moments; ++moment) {
    const double wanted_fraction = moment / (moments - 1.0);
    const auto rest = [] { std::this_thread::sleep_for (std::chrono::microseconds (50)); };
    std::atomic<double> done{-1.0};
    std::atomic<bool> is_cancelled{false};
    Floater floater;
    floater.setProgressCallback ([&] (double fraction) {
      done = fraction;
      while (fraction >= wanted_fraction && !is_cancelled) // is set before the run goes on
        rest ();
    });
    floater.setCancelledCallback ([&] { return is_cancelled.load (); });
    std::thread canceller ([&] {
      while (done < wanted_fraction)
        rest ();
      is_cancelled = true;
    });
    const std::vector<pcl::Indices> polygons = polygonsOf (floater, cloud);
    canceller.join ();
    const RunStatus status = floater.getReport ().status;
    if (status == RunStatus::CANCELLED) {
      ++cancelled;
      EXPECT_TRUE (polygons.empty ());
    }
    else {
      EXPECT_EQ (status, RunStatus::SUCCESS);
      EXPECT_EQ (polygons, expected);
    }
    // The object is as good as new.
    floater.setProgressCallback ({});
    floater.setCancelledCallback ({});
    EXPECT_EQ (polygonsOf (floater, cloud), expected);
  }
  EXPECT_GE (2 * cancelled, static_cast<std::size_t> (moments));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST (Memory, DoesNotGrowWithTheNumberOfRuns)
{
  const auto inUse = [] {
    const struct mallinfo2 info = ::mallinfo2 ();
    return info.uordblks + info.hblkhd;
  };
  for (const Topology topology : {Topology::DISC, Topology::SURFACE}) {
    const Cloud::Ptr cloud = makeCloud (SurfaceKind::HEIGHT_FIELD, 300);
    Floater floater;
    floater.setTopology (topology);
    floater.setNumberOfThreads (1); // the memory of other threads is not in these figures
    // The allocator keeps freed chunks, some more at one time than at another. A leak in each run would be of
    // 32 bytes at least.
    constexpr std::size_t RUNS = 200;
    std::size_t after_ten = 0;
    for (std::size_t run = 0; run < RUNS; ++run) {
      EXPECT_FALSE (polygonsOf (floater, cloud).empty ());
      if (run == 10)
        after_ten = inUse ();
    }
    EXPECT_LT (inUse (), after_ten + 16 * (RUNS - 10));
  }
}
#endif

} // namespace
} // namespace pcl::floater
