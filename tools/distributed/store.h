// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run, in its work folder, and their manifest: what is reconstructed, how, and in which
// blocks.
#pragma once

#include "core/types.h"
#include "run_report.h"

namespace pcl::floater {
/// A file of points as it was when the plan was made.
struct InputFile
{
  std::string file;
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0; ///< of all bytes
};

/// All that the steps after the first need to know, but the points.
struct Plan
{
  std::uint64_t id = 0; ///< of inputs, parameters and format; in all files of the folder
  std::vector<InputFile> inputs;
  std::vector<std::string> arguments; ///< options of the command line that made it
  std::string parameters;             ///< those that decide the result, as text
  std::size_t points = 0;             ///< of the working set, with outliers
  std::size_t blocks = 0;
  std::size_t selected_points = 0;
  std::array<double, 3> centre{}, sensor_origin{};
  double scale = 1.0;
  std::vector<std::string> warnings; ///< of the cloud
  RunFigures figures;                ///< what is known of the cloud

  std::size_t cloudSize () const { return figures.input_points; }
  Eigen::Vector3d shift () const { return Eigen::Vector3d (figures.shift.data ()); }
};

/// Reads all files, one after the other; a single one is mapped as it is. Of several, the fields
/// are those that all files have with one type, and coordinates are doubles.
/// \param[out] firsts the first row of each file, and the number of all rows
/// \throws ReadError, which names the file
Cloud
readClouds (const std::vector<std::filesystem::path>& files, const ReadOptions& options,
            std::vector<std::size_t>& firsts);

/// Version of all files in a work folder. To be raised whenever what is in them changes.
constexpr std::uint32_t WORK_FORMAT = 13;

/// A file of a work folder cannot be used. The message names it, the cause, and what to do.
using WorkError = ErrorOf<EXIT_WORK>;

/// A file of the work folder, open to be read. Others must not be able to write it: it is a file of this
/// user, writable by nobody else, and no symbolic link.
class WorkFile
{
public:
  /// \throws WorkError if it is not there, or somebody else's
  explicit WorkFile (const std::filesystem::path& path);

  std::uint64_t size () const { return size_; }

  /// Reads `count` bytes from `offset`.
  /// \throws WorkError if they are not there
  void read (std::uint64_t offset, std::size_t count, void* bytes) const;

  /// All bytes of a small file.
  std::string text () const
  {
    std::string text (size_, '\0');
    read (0, text.size (), text.data ());
    return text;
  }

  /// \throws WorkError which names the file and this cause
  [[noreturn]] void refuse (const std::string& cause) const
  {
    throw WorkError ("'" + path_ + "' " + cause);
  }

private:
  std::string path_;
  int descriptor_;
  std::shared_ptr<void> closing_; // closes it with the last copy
  std::uint64_t size_ = 0;
};

struct ArrayEntry
{
  std::array<char, 24> name; ///< ends with a zero
  std::uint64_t element;     ///< bytes
  std::uint64_t count, offset;
};

/// An array to write: numbers, or structs of numbers without gaps, which must outlive this.
struct NamedArray
{
  template <typename T>
  NamedArray (std::string array, const std::vector<T>& values)
      : name (std::move (array)), first (reinterpret_cast<const char*> (values.data ())),
        element (sizeof (T)), count (values.size ())
  {
  }

  std::string name; ///< shorter than in ArrayEntry
  const char* first;
  std::size_t element, count;
};

using NamedArrays = std::vector<NamedArray>;

/// Arrays of a file. What is read is compared with its checksums.
class ArrayFile
{
public:
  /// \param plan of which the arrays have to be a part
  /// \throws WorkError if it is no such file, has another version, is truncated, or is of another
  ///   plan; as do all members that read, if the file is damaged
  ArrayFile (WorkFile file, std::uint64_t plan);

  std::size_t count (const std::string& array) const { return find (array).count; }

  /// Appends values from `first` to before `last`.
  template <typename T>
  void append (const std::string& array, std::size_t first, std::size_t last,
               std::vector<T>& values)
  {
    const ArrayEntry& entry = find (array);
    require (entry.element == sizeof (T) && first <= last && last <= entry.count);
    const std::size_t before = values.size ();
    values.resize (before + last - first);
    readBytes (entry, first, last, reinterpret_cast<char*> (values.data () + before));
  }

  template <typename T>
  std::vector<T> read (const std::string& array)
  {
    std::vector<T> values;
    append (array, 0, count (array), values);
    return values;
  }

  /// Reads all of the file.
  /// \throws WorkError if anything is damaged
  void verify ()
  {
    for (const ArrayEntry& array : table_)
      readBytes (array, 0, array.count, nullptr);
  }

  /// \throws WorkError if the arrays of the file do not fit each other, though its checksums are
  ///   right
  void require (bool fits) const
  {
    if (!fits)
      file_.refuse ("has other arrays than this program makes; use an empty work folder");
  }

  /// \throws WorkError if indices, or those in arrays of them, are not below a limit
  /// \param from the first value that is looked at
  template <typename T>
  void requireBelow (const std::vector<T>& values, std::size_t limit, std::size_t from = 0) const
  {
    const auto* const first = reinterpret_cast<const Index*> (values.data () + from);
    const auto* const last = reinterpret_cast<const Index*> (values.data () + values.size ());
    require (std::all_of (first, last, [limit] (Index index) { return index < limit; }));
  }

private:
  const ArrayEntry& find (const std::string& array) const
  {
    for (const ArrayEntry& known : table_)
      if (array == known.name.data ())
        return known;
    file_.refuse ("has no array '" + array + "'; delete it and run again");
  }
  /// \param bytes nullptr: the values are only compared with their checksums
  void readBytes (const ArrayEntry& array, std::size_t first, std::size_t last, char* bytes);

  WorkFile file_;
  std::vector<ArrayEntry> table_;
  std::vector<char> piece_; // that was read last
  const ArrayEntry* piece_of_ = nullptr;
  std::uint64_t piece_begin_ = 0; // where it is in the array
};

/// The work folder. Its files are visible when they are complete and on the disk.
struct Store
{
  std::filesystem::path folder;

  std::filesystem::path path (const std::string& name) const { return folder / name; }
  bool has (const std::string& name) const { return std::filesystem::exists (path (name)); }
  WorkFile open (const std::string& name) const { return WorkFile (path (name)); }
  ArrayFile arrays (const std::string& name, const Plan& plan) const
  {
    return {open (name), plan.id};
  }

  /// \param plan of which the arrays are a part
  /// \throws WriteError
  void put (const std::string& file, const NamedArrays& arrays, std::uint64_t plan) const;
};

constexpr const char* MANIFEST = "manifest.json";
constexpr const char* POINTS = "points.bin";
constexpr const char* OUTLIERS = "outliers.bin";
constexpr const char* POINTS_LEFT = "points_left.bin"; ///< the net without outliers, if not all
constexpr const char* TRIANGLES = "mesh.bin";
constexpr const char* TILES = "tiles.json"; ///< the manifest of the tiles, in their folder

/// The file of a step for a block, "stars.7.bin".
inline std::string
blockFile (const char* step, std::size_t block)
{
  return std::string (step) + "." + std::to_string (block) + ".bin";
}

/// \throws WorkError if there is no manifest, it is of another version, or damaged
Plan
readManifest (const Store& store);

} // namespace pcl::floater
