// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: a whole reconstruction of a cloud that is decoded from the bytes.
#include "attack.h"
#include "reconstruct.h"

#include <cstdio>

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  using namespace pcl::floater;
  constexpr std::size_t MOST = 400; // points: so that a run takes little
  fuzz::ByteSource bytes (data, size);
  const fuzz::Attack attack = fuzz::decodeAttack (bytes, MOST);
  // With sanitizers a test of two triangles takes some ten times as long. The usual limit, which
  // lets a small mesh take a second, would leave three runs a minute.
  Limits limits;
  limits.repair.fewest_tests = 20'000;
  const std::string fault =
      fuzz::findFault (attack.input, reconstruct (attack.input, attack.options, limits));
  if (fault.empty ())
    return 0;
  std::fprintf (stderr, "fault: %s\n", fault.c_str ());
  std::abort ();
}
