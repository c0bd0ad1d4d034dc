// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: a whole reconstruction of a cloud that is decoded from the bytes.
#include "cloud_recipe.h"
#include "fuzz_target.h"
#include "reconstruct.h"
#include "result_oracle.h"

#include <cstdio>
#include <cstdlib>

int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  constexpr std::size_t MOST = 400; // points: so that a run takes little
  pcl::floater::fuzz::ByteSource bytes (data, size);
  const pcl::floater::fuzz::Attack attack = pcl::floater::fuzz::decodeAttack (bytes, MOST);
  // With sanitizers a test of two triangles takes some ten times as long. The usual limit, which
  // lets a small mesh take a second, would leave three runs a minute.
  pcl::floater::Limits limits;
  limits.uncrossing.fewest_tests = 20'000;
  const pcl::floater::Result result =
      pcl::floater::reconstruct (attack.input, attack.options, limits);
  const std::string fault = pcl::floater::fuzz::findFault (attack.input, result);
  if (!fault.empty ()) {
    std::fprintf (stderr, "fault: %s\n", fault.c_str ());
    std::abort ();
  }
  return 0;
}
