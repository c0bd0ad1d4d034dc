// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the files of a run are: in its work folder, or at another process that has it.
#pragma once

#include "core/types.h"
#include "plan.h"
#include "view/ray_evidence.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pcl::floater {
/// Version of all files in a work folder. To be raised whenever what is in them changes.
constexpr std::uint32_t WORK_FORMAT = 8;

/// A file of a work folder cannot be used. The message names it, the cause, and what to do.
class WorkError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Bytes of a file, wherever it is.
class ByteSource
{
public:
  virtual ~ByteSource () = default;

  virtual std::uint64_t size () const = 0;

  /// Reads `count` bytes from `offset`.
  /// \throws WorkError if they are not there
  virtual void read (std::uint64_t offset, std::size_t count, char* bytes) = 0;
};

/// Calls visit (bytes, count) for all bytes of a file, piece by piece.
template <typename Visit>
std::uint64_t
forAllBytes (ByteSource& file, Visit&& visit)
{
  constexpr std::size_t EACH = std::size_t{1} << 20U;
  std::vector<char> bytes (EACH);
  for (std::uint64_t at = 0; at < file.size (); at += EACH) {
    const auto count = static_cast<std::size_t> (std::min<std::uint64_t> (EACH, file.size () - at));
    file.read (at, count, bytes.data ());
    visit (bytes.data (), count);
  }
  return file.size ();
}

/// \param is_work a file of a work folder: others must not be able to write it. It is a file of this
///     user, writable by nobody else, and no symbolic link
/// \throws WorkError if the file does not exist or cannot be read
std::unique_ptr<ByteSource>
openFile (const std::filesystem::path& path, bool is_work);

// What a file has for a value: of a vector, box, triangle or sample, its plain numbers. Only the types
// of these functions are used.
template <typename T>
T
elementOf (const T*);
template <typename Scalar>
Scalar
elementOf (const Eigen::Matrix<Scalar, 3, 1>*);
double
elementOf (const Eigen::AlignedBox3d*);
double
elementOf (const AreaSample*);
Index
elementOf (const Triangle*);

template <typename T>
using Element = decltype (elementOf (static_cast<const T*> (nullptr)));

/// How many elements a value has.
template <typename T>
constexpr std::size_t
countElements ()
{
  constexpr std::size_t whole = sizeof (T), element = sizeof (Element<T>);
  static_assert (std::is_trivially_copyable_v<Element<T>> && whole % element == 0);
  return whole / element;
}

/// Arrays to write.
class ArrayWriter
{
public:
  /// \param values must outlive this
  template <typename T>
  void add (const std::string& name, const std::vector<T>& values)
  {
    add (name, values.data (), values.size ());
  }

  template <typename T>
  void add (const std::string& name, const T* values, std::size_t count)
  {
    addBytes (name, reinterpret_cast<const char*> (values), sizeof (Element<T>),
              count * countElements<T> ());
  }

  /// Passes the bytes of the file to `write`, one piece after the other.
  /// \param plan of which the arrays are a part; 0: they are the plan
  void emit (std::uint64_t plan,
             const std::function<void (const char* bytes, std::size_t count)>& write) const;

  /// Writes a file that is visible when it is complete. It may still be on its way to the disk
  /// then.
  /// \throws WriteError
  void write (const std::filesystem::path& path, std::uint64_t plan) const;

private:
  struct Array
  {
    std::string name;
    const char* bytes;
    std::size_t element;
    std::size_t count;
  };

  void addBytes (const std::string& name, const char* bytes, std::size_t element,
                 std::size_t count);

  std::vector<Array> arrays_;
};

/// Arrays of a file. What is read is compared with its checksums.
class ArrayFile
{
public:
  /// \param name for messages
  /// \param plan of which the arrays have to be a part
  /// \throws WorkError if it is no such file, has another version, is truncated, or is of another
  ///   plan; as do all members that read, if the file is damaged
  ArrayFile (std::unique_ptr<ByteSource> source, std::string name, std::uint64_t plan);

  const std::string& name () const { return name_; }

  /// Values of an array.
  template <typename T>
  std::size_t count (const std::string& array) const
  {
    return find (array).count / countElements<T> ();
  }

  /// Reads values from `first` to before `last`.
  template <typename T>
  void read (const std::string& array, std::size_t first, std::size_t last, T* values)
  {
    constexpr std::size_t EACH = countElements<T> ();
    readBytes (find (array), sizeof (Element<T>), first * EACH, last * EACH,
               reinterpret_cast<char*> (values));
  }

  /// Appends these, by default all.
  template <typename T>
  void append (const std::string& array, std::size_t first, std::size_t last,
               std::vector<T>& values)
  {
    require (first <= last && last <= count<T> (array));
    const std::size_t before = values.size ();
    values.resize (before + last - first);
    read (array, first, last, values.data () + before);
  }

  template <typename T>
  void append (const std::string& array, std::vector<T>& values)
  {
    append (array, 0, count<T> (array), values);
  }

  template <typename T>
  std::vector<T> read (const std::string& array, std::size_t first, std::size_t last)
  {
    std::vector<T> values;
    append (array, first, last, values);
    return values;
  }

  template <typename T>
  std::vector<T> read (const std::string& array)
  {
    return read<T> (array, 0, count<T> (array));
  }

  /// Reads all of the file.
  /// \throws WorkError if anything is damaged
  void verify ();

  /// \throws WorkError if the arrays of the file do not fit each other, though its checksums are
  ///   right
  void require (bool fits) const
  {
    if (!fits)
      refuse ("has other arrays than this program makes; use an empty work folder");
  }

  /// Whether all indices are below a limit.
  template <typename T>
  void requireBelow (const std::vector<T>& values, std::size_t limit) const
  {
    const auto* const first = reinterpret_cast<const Index*> (values.data ());
    const auto* const last = reinterpret_cast<const Index*> (values.data () + values.size ());
    require (std::all_of (first, last, [limit] (Index index) { return index < limit; }));
  }

private:
  struct Array
  {
    std::string name;
    std::uint64_t element, count, offset;
    std::vector<std::uint64_t> checksums; // of each piece
  };

  const Array& find (const std::string& array) const;
  void readBytes (const Array& array, std::size_t element, std::size_t first, std::size_t last,
                  char* bytes);
  [[noreturn]] void refuse (const std::string& cause) const;

  std::unique_ptr<ByteSource> source_;
  std::string name_;
  std::vector<Array> arrays_;
  std::vector<char> buffer_;    // pieces that were read last
  std::uint64_t buffer_at_ = 0; // where they are in the file
};

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
    return openFile (path (name), true);
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
  bool isEmpty (std::size_t block) const { return first (block) == last (block); }
  std::size_t blockOf (std::uint32_t point) const;

private:
  std::vector<std::size_t> firsts_;
};

} // namespace pcl::floater
