// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays larger than memory: operator new and delete, replaced in a program that links this. All
// goes to malloc; but after keepLargeArraysIn each large array lies in a scratch file of its own,
// and what is not in use may leave memory. What C libraries allocate, such as the solvers, is not
// seen here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace pcl
{
namespace floater
{
/// Bytes from which an array is large: some hundred pages, so that what it costs to map it is small
/// beside what it costs to fill it.
constexpr std::size_t LARGE_ARRAY = std::size_t{1} << 20U;

/// Bytes that dropNextPiece takes at a time: a fraction of a millisecond.
constexpr std::size_t DROPPED_PIECE = std::size_t{8} << 20U;

/// From now on, for the rest of the run, every new large array is a shared mapping of a file in
/// this folder. The files have no name, so that nothing is left of them however the program ends.
/// Their room is reserved first: on a full disk operator new throws std::bad_alloc.
/// Not to be called while other threads run.
/// \param make_room called before each of these arrays, in its thread, with its bytes; it must not
/// throw
/// \throws WriteError if no file can be made there
void
keepLargeArraysIn (const std::filesystem::path& scratch_folder,
                   std::function<void (std::size_t)> make_room = {});

/// Whether files in this folder lie in memory themselves (tmpfs); false if that cannot be told.
bool
liesInMemory (const std::filesystem::path& folder);

/// Takes the next component of the arrays in scratch files out of the resident set, going round them in
/// the order of their addresses. What it holds stays in the file, or on its way there, and comes
/// back when it is dirty; other threads may read and write it meanwhile.
/// \return its bytes; 0 if there are no such arrays
std::size_t
dropNextPiece ();

/// Bytes.
struct ScratchUse
{
  std::size_t bytes = 0;   ///< of the scratch files that exist now
  std::size_t peak = 0;    ///< the most that there were at a time
  std::size_t dropped = 0; ///< that dropNextPiece has gone over
};

ScratchUse
scratchUse ();

/// Why there was no room for the last large array that found none; empty if all did.
std::string
largeArrayFailure ();

} // namespace floater
} // namespace pcl
