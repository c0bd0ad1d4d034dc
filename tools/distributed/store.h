// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the files of a run are: in its work folder, or at another process that has it.
#pragma once

#include "array_file.h"
#include "plan.h"

#include <future>
#include <memory>
#include <mutex>
#include <string>

namespace pcl::floater {
/// The files of a run.
class Store
{
public:
  virtual ~Store () = default;

  /// What messages call a file.
  virtual std::string describe (const std::string& name) const = 0;

  /// \throws WorkError if it is not there
  virtual std::unique_ptr<ByteSource> open (const std::string& name) = 0;

  /// Writes a file that is visible when it is complete.
  /// \throws WriteError
  virtual void put (const std::string& name, const ArrayWriter& arrays, std::uint64_t plan) = 0;
};

/// The files are in a folder. They are visible when they are complete, and brought to the disk
/// while the next one is made: a machine that stops without warning leaves files of which the
/// checksums tell that they are damaged.
class FolderStore : public Store
{
public:
  explicit FolderStore (std::filesystem::path folder) : folder_ (std::move (folder)) {}

  std::filesystem::path path (const std::string& name) const { return folder_ / name; }
  bool has (const std::string& name) const { return std::filesystem::exists (path (name)); }

  std::string describe (const std::string& name) const override { return path (name).string (); }
  std::unique_ptr<ByteSource> open (const std::string& name) override
  {
    return openFile (path (name));
  }
  void put (const std::string& name, const ArrayWriter& arrays, std::uint64_t plan) override;

  /// The same for bytes that an ArrayWriter has made. Two threads may put files at the same time.
  void putBytes (const std::string& name, const char* bytes, std::size_t count);

  /// Removes a file, if it is there. Others that are open go on to read it.
  void remove (const std::string& name) const;

  /// Waits until all files are on the disk.
  /// \throws WriteError if one is not; it is removed
  void finish ();

  /// A text file.
  /// \throws WorkError
  std::string readText (const std::string& name) const;

  /// \throws WriteError
  void putText (const std::string& name, const std::string& text) const;

private:
  // Begins to bring a file to the disk, when the one before it is there.
  void syncBehind (const std::string& name);

  std::filesystem::path folder_;
  std::mutex mutex_; // guards the next one
  std::future<void> syncing_;
};

constexpr const char* MANIFEST = "manifest.json";
constexpr const char* POINTS = "points.bin";
constexpr const char* OUTLIERS = "outliers.bin";
constexpr const char* POINTS_LEFT = "points_left.bin"; ///< without outliers, if there are any
constexpr const char* TRIANGLES = "mesh.bin";

/// The file of a step for a block, "stars.7.bin".
std::string
blockFile (const char* step, std::size_t block);

/// Opens a file of a plan.
ArrayFile
openArrays (Store& store, const std::string& name, const Plan& plan);

/// Which points a block owns; from a table of the first point of each block, and their number.
class BlockRanges
{
public:
  explicit BlockRanges (std::vector<std::size_t> firsts) : firsts_ (std::move (firsts)) {}

  std::size_t blocks () const { return firsts_.size () - 1; }
  std::size_t points () const { return firsts_.back (); }
  std::uint32_t first (std::size_t block) const
  {
    return static_cast<std::uint32_t> (firsts_[block]);
  }
  std::uint32_t last (std::size_t block) const { return first (block + 1); }
  std::size_t blockOf (std::uint32_t point) const;

private:
  std::vector<std::size_t> firsts_;
};

} // namespace pcl::floater
