// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target on every file of a folder, without libFuzzer.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size);

int
main (int argc, char** argv)
{
  if (argc != 2) {
    std::fprintf (stderr, "usage: %s FOLDER\n", argv[0]);
    return EXIT_FAILURE;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator (argv[1]))
    files.push_back (entry.path ());
  std::sort (files.begin (), files.end ());
  for (const std::filesystem::path& path : files) {
    std::ifstream file (path, std::ios::binary);
    const std::vector<char> bytes ((std::istreambuf_iterator<char> (file)), {});
    // Told before it runs: a fault ends the program.
    std::fprintf (stderr, "%s, %zu bytes\n", path.c_str (), bytes.size ());
    LLVMFuzzerTestOneInput (reinterpret_cast<const std::uint8_t*> (bytes.data ()), bytes.size ());
  }
  return files.empty () ? EXIT_FAILURE : EXIT_SUCCESS;
}
