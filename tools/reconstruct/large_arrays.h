// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays larger than memory. A program that links this gets its operators new and delete replaced:
// they use malloc, but after keepLargeArraysIn () every large array is mapped to a scratch file of
// its own, so that its pages can leave memory. Allocations of C libraries, such as the solvers, are
// not affected.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace pcl::floater {
/// Bytes from which on an array is large. At some hundred pages, mapping it costs little compared
/// with filling it.
constexpr std::size_t LARGE_ARRAY = std::size_t{1} << 20U;

/// Bytes that dropNextChunk () drops at a time, in a fraction of a millisecond.
constexpr std::size_t DROPPED_CHUNK = std::size_t{8} << 20U;

/// Addresses of large arrays in scratch files are multiples of this. Pointers of malloc hardly ever
/// are, so that operator delete frees them without a lookup in the table of large arrays.
constexpr std::size_t LARGE_ARRAY_ALIGNMENT = std::size_t{1} << 21U;

/// Makes every large array from now on a shared mapping of a file in this folder. The files have no
/// names, so that none is left however the program ends. Their space is reserved when they are
/// made: on a full disk, operator new throws std::bad_alloc. Must not be called while other threads
/// run.
/// \param make_room called before each of these arrays is made, in the same thread, with its bytes;
///   must not throw
/// \throws WriteError if no file can be made in the folder
void
keepLargeArraysIn (const std::filesystem::path& scratch_folder,
                   std::function<void (std::size_t)> make_room = {});

/// Whether the files in this folder are kept in memory (tmpfs, ramfs); false if that is unknown.
bool
liesInMemory (const std::filesystem::path& folder);

/// Whether keepLargeArraysIn () has been called.
bool
hasScratchFolder ();

/// Maps a new array of `size` bytes to a scratch file. For operator new.
/// \return nullptr if there is no room; largeArrayFailure () then tells why
void*
mapLargeArray (std::size_t size);

/// Frees an array of mapLargeArray () with its file. For operator delete.
/// \return false if the pointer is not one of these arrays
bool
unmapLargeArray (void* pointer);

/// Drops the next chunk of the arrays in scratch files from the resident set. Chunks follow each
/// other by address, and the first comes again after the last. Their contents stay in the files and
/// return to memory when they are used; other threads may read and write them at the same time.
/// \return bytes of the chunk; 0 if there are no such arrays
std::size_t
dropNextChunk ();

/// Use of the scratch folder, in bytes.
struct ScratchUse
{
  std::size_t bytes = 0;   ///< size of the scratch files that exist now
  std::size_t peak = 0;    ///< largest size so far
  std::size_t dropped = 0; ///< sum of all chunks that were dropped
};

/// The use of the scratch folder so far.
ScratchUse
scratchUse ();

/// Why the last large array that could not be made had no room; empty if all could be made.
std::string
largeArrayFailure ();

} // namespace pcl::floater
