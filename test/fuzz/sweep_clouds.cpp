// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs clouds that are decoded from random bytes, one for each seed, and says which results
// are wrong or slow.
#include "attack.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  using Clock = std::chrono::steady_clock;
  constexpr double LONGEST = 2.0; // seconds of processor time of one run
  if (argc != 4) {
    std::fprintf (stderr, "usage: %s FIRST_SEED SECONDS MOST_POINTS\n", argv[0]);
    return EXIT_FAILURE;
  }
  const std::uint64_t first = std::strtoull (argv[1], nullptr, 10);
  const std::chrono::duration<double> seconds (std::strtod (argv[2], nullptr));
  const std::size_t most = std::strtoull (argv[3], nullptr, 10);
  std::map<std::string, std::size_t> statuses;
  std::size_t faults = 0;
  double slowest = 0.0;
  std::uint64_t seed = first;
  for (const Clock::time_point start = Clock::now (); Clock::now () - start < seconds; ++seed) {
    const fuzz::Attack attack = fuzz::randomAttack (seed, most);
    const std::clock_t begin = std::clock ();
    const Result result = reconstruct (attack.input, attack.options);
    const double taken = static_cast<double> (std::clock () - begin) / CLOCKS_PER_SEC;
    slowest = std::max (slowest, taken);
    ++statuses[statusName (result.report.status)];
    std::string fault = fuzz::findFault (attack.input, result);
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
