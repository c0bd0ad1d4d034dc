// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs clouds that are decoded from random bytes, one for each seed, and says which results
// are wrong or slow.
#include "random_attack.h"
#include "result_oracle.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

namespace {
using Clock = std::chrono::steady_clock;

double
secondsSince (Clock::time_point start)
{
  return std::chrono::duration<double> (Clock::now () - start).count ();
}

/// Processor time of this process.
double
processorSeconds ()
{
  return static_cast<double> (std::clock ()) / CLOCKS_PER_SEC;
}

} // namespace

int
main (int argc, char** argv)
{
  constexpr double LONGEST = 2.0; // seconds of processor time of one run
  constexpr int EXPECTED = 4;
  if (argc != EXPECTED) {
    std::fprintf (stderr, "usage: %s FIRST_SEED SECONDS MOST_POINTS\n", argv[0]);
    return EXIT_FAILURE;
  }
  std::uint64_t seed = std::strtoull (argv[1], nullptr, 10);
  const double seconds = std::strtod (argv[2], nullptr);
  const std::size_t most = std::strtoull (argv[3], nullptr, 10);
  std::map<std::string, std::size_t> statuses;
  std::size_t faults = 0;
  double slowest = 0.0;
  const std::uint64_t first = seed;
  for (const Clock::time_point start = Clock::now (); secondsSince (start) < seconds; ++seed) {
    const pcl::floater::fuzz::Attack attack = pcl::floater::fuzz::randomAttack (seed, most);
    const double begin = processorSeconds ();
    const pcl::floater::Result result = pcl::floater::reconstruct (attack.input, attack.options);
    const double taken = processorSeconds () - begin;
    slowest = std::max (slowest, taken);
    ++statuses[pcl::floater::statusName (result.report.status)];
    std::string fault = pcl::floater::fuzz::findFault (attack.input, result);
    if (fault.empty () && taken > LONGEST)
      fault = "took " + std::to_string (taken) + " s";
    if (fault.empty ())
      continue;
    ++faults;
    std::printf ("seed %llu, %zu points: %s\n", static_cast<unsigned long long> (seed),
                 attack.input.positions.size (), fault.c_str ());
    std::fflush (stdout);
  }
  std::printf ("seeds %llu to %llu of up to %zu points: %zu faults; slowest %.2f s;",
               static_cast<unsigned long long> (first), static_cast<unsigned long long> (seed - 1),
               most, faults, slowest);
  for (const auto& [status, count] : statuses)
    std::printf (" %s %zu", status.c_str (), count);
  std::printf ("\n");
  return faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
