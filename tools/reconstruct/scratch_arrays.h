// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays larger than memory. A program that links this has its operators new and delete replaced:
// they use malloc, but after keepLargeArraysIn () each large array is mapped to a scratch file, so
// that its pages can leave memory. Allocations of C libraries, such as the solvers, are not
// affected. With a sanitizer, which has operators of its own, all arrays stay in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pcl::floater {
/// Bytes from which on an array is large. At some hundred pages, mapping it costs little compared
/// with filling it.
constexpr std::size_t LARGE_ARRAY = std::size_t{1} << 20U;

/// Makes every large array from now on a shared mapping of a file in this folder. The files have no
/// names, so that none is left however the program ends. Their space is reserved when they are
/// made: on a full disk, operator new throws std::bad_alloc. A thread takes their pages out of the
/// resident set when that comes near the limit; their contents stay in the files, and return to
/// memory when they are used. To be called once, before other threads run.
/// \param limit bytes; see leastMemory ()
/// \throws WriteError if no file can be made in the folder
void
keepLargeArraysIn (const std::filesystem::path& folder, std::size_t limit);

/// Takes the pages of all large arrays in files and of mapped input files out of the resident set.
void
dropPages ();

/// Whether the files in this folder are kept in memory (tmpfs, ramfs); false if that is unknown.
bool
liesInMemory (const std::filesystem::path& folder);

/// Use of the scratch folder, in bytes.
struct ScratchUse
{
  std::size_t bytes = 0; ///< size of the scratch files that exist now
  std::size_t peak = 0;  ///< largest size so far
};

ScratchUse
scratchUse ();

/// Why the last large array that could not be made had no room; empty if all could be made.
std::string
scratchFailure ();

/// Parses a size in bytes: a number, with K, M, G or T (or lower case) for powers of 1000.
/// \return false if the word is not a size or out of range
bool
parseSize (std::string_view word, std::size_t& bytes);

/// Formats a size for parseSize (), in millions of bytes, rounded up ("500M").
std::string
formatSize (std::size_t bytes);

/// Bytes of each point that have to stay in memory when a cloud is reconstructed by one process.
/// 250 MB for 10 million points. With less, most of the time goes into reading pages back.
constexpr double KEPT_PER_POINT = 25.0;

/// Least limit, in bytes, near which the memory for a cloud of so many points can be kept.
std::size_t
leastMemory (std::size_t points, double kept_per_point = KEPT_PER_POINT);

} // namespace pcl::floater
