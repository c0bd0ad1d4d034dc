// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the resident set of the program below a limit.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace pcl::floater {
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

/// Least limit, in bytes, below which a cloud of so many points can be kept.
std::size_t
leastMemory (std::size_t points, double kept_per_point = KEPT_PER_POINT);

/// The resident set of the program, and its limit.
class ResidentSet
{
public:
  /// \param limit in bytes
  explicit ResidentSet (std::size_t limit);
  ~ResidentSet ();
  ResidentSet (const ResidentSet&) = delete;
  ResidentSet& operator= (const ResidentSet&) = delete;
  ResidentSet (ResidentSet&&) = delete;
  ResidentSet& operator= (ResidentSet&&) = delete;

  /// Drops pages of mapped files and large arrays if `bytes` more would come near the limit. May be
  /// called by any thread.
  void makeRoom (std::size_t bytes) const;

  /// Time during which the resident set cannot come near the limit.
  std::chrono::duration<double> timeToSleep () const;

  /// Bytes of an ArrayPool: those that stay in memory also if other arrays are in scratch files,
  /// and those that stay there if there are no others.
  std::size_t poolInMemory () const;
  std::size_t poolInFile () const;

private:
  double resident () const; // bytes; 0 if unknown

  double limit_; // bytes, as the others
  double high_;  // pages are dropped above this ...
  double low_;   // ... until this is reached
  int statm_;    // descriptor of /proc/self/statm
};

/// While it exists, some threads watch the resident set and drop pages before the limit is reached.
/// Large arrays stay in their scratch files after its end.
class MemoryLimit
{
public:
  /// \param bytes the limit, at least leastMemory (0)
  /// \throws WriteError if the folder cannot be used
  MemoryLimit (std::size_t bytes, const std::filesystem::path& scratch_folder);
  ~MemoryLimit ();
  MemoryLimit (const MemoryLimit&) = delete;
  MemoryLimit& operator= (const MemoryLimit&) = delete;
  MemoryLimit (MemoryLimit&&) = delete;
  MemoryLimit& operator= (MemoryLimit&&) = delete;

  /// Drops pages if the limit is near. For threads that work: the more of them fill the memory, the
  /// more make room, also where the watcher gets no processor. Microseconds if nothing is to be
  /// dropped.
  void makeRoom () const { resident_set_->makeRoom (0); }

  const ResidentSet& residentSet () const { return *resident_set_; }

private:
  void watch () const;

  std::shared_ptr<ResidentSet> resident_set_; // shared: large arrays may be made after this
  std::atomic<bool> is_ending_{false};
  std::vector<std::thread> watchers_;
};

} // namespace pcl::floater
