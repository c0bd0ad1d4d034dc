// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the program's resident set below a limit.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace pcl
{
namespace floater
{
/// Parses a size: a number, and K, M, G or T for thousands, millions, ... of bytes, in either case.
/// \return false if it is none, or beyond the range
bool
parseSize (std::string_view word, std::size_t& bytes);

/// The same the other way round, in whole millions of bytes, rounded up.
std::string
formatSize (std::size_t bytes);

/// Bytes that a cloud of so many points needs in memory, however much lies in the scratch folder.
std::size_t
leastMemory (std::size_t points);

/// The pages of the program that are in memory, and how many there may be.
class ResidentSet
{
public:
  /// \param limit bytes
  explicit ResidentSet (std::size_t limit);
  ~ResidentSet ();
  ResidentSet (const ResidentSet&) = delete;
  ResidentSet& operator= (const ResidentSet&) = delete;
  ResidentSet (ResidentSet&&) = delete;
  ResidentSet& operator= (ResidentSet&&) = delete;

  /// Drops pages of mapped files and large arrays if with `bytes` more the limit would be near. Any
  /// thread may call it at any time.
  void makeRoom (std::size_t bytes) const;

  /// Time in which the limit cannot come near.
  std::chrono::duration<double> timeToSleep () const;

private:
  double resident () const; // bytes; 0 if unknown

  double limit_; // bytes, as the others
  double high_;  // above it pages are dropped
  double low_;   // until it is reached
  int statm_;    // descriptor of /proc/self/statm
};

/// As long as it exists, a thread watches the resident set and drops pages of large arrays from it
/// before it reaches the limit. Arrays stay in their scratch files after it has ended.
class MemoryLimit
{
public:
  /// \param bytes at least leastMemory (0)
  /// \throws WriteError if the folder cannot be used
  MemoryLimit (std::size_t bytes, const std::filesystem::path& scratch_folder);
  ~MemoryLimit ();
  MemoryLimit (const MemoryLimit&) = delete;
  MemoryLimit& operator= (const MemoryLimit&) = delete;
  MemoryLimit (MemoryLimit&&) = delete;
  MemoryLimit& operator= (MemoryLimit&&) = delete;

private:
  void watch ();

  std::shared_ptr<ResidentSet> resident_set_; // shared with arrays that outlive this
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ending_ = false;
  std::thread watcher_;
};

} // namespace floater
} // namespace pcl
