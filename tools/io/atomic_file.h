// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A file that appears only when it is complete.
#pragma once

#include "file_bytes.h"

#include <charconv>
#include <deque>
#include <type_traits>
#include <vector>

namespace pcl::floater {
/// A file cannot be written. The message names the file and the cause.
using WriteError = ErrorOf<EXIT_OUTPUT>;

/// Checks, without changing anything, that a file could be created or replaced.
/// \throws WriteError if its folder does not exist or is not writable, or if the path names
/// something other than a regular file. "-" is the standard output, which must be no terminal
void
requireWritable (const std::filesystem::path& path);

/// Installs signal handlers: the signals by which users, shells and schedulers end a program, and
/// SIGPIPE, do so without leaving temporary files, and a limit on file sizes makes a write fail.
/// \param input_failed exit code if a mapped file (FileBytes) is truncated while it is in use
void
handleSignals (int input_failed = 1);

/// Writes a temporary file in the folder of the final one, and renames it at the end. If the object
/// is destroyed before that, the temporary file is removed and an existing file is unchanged.
/// Symbolic links are followed, and a file that is replaced keeps its permissions. "-" is the
/// standard output: it gets the bytes of the complete file at the end, which until then is in the
/// folder for temporary files.
class AtomicFile : private boost::noncopyable
{
public:
  /// \throws WriteError, as do all other members
  /// \param is_private for this user only, and in the place of a symbolic link, not behind it
  explicit AtomicFile (const std::filesystem::path& path, bool is_private = false);
  ~AtomicFile ();

  void write (std::string_view bytes);

  /// Appends a number in the byte order of the file.
  template <typename T>
  void writeNumber (T number, ByteOrder order = ByteOrder::little)
  {
    copyNumber<T> (room (sizeof (T)), &number, order);
    used_ += sizeof (T);
  }

  /// Appends texts as they are, and numbers as the shortest decimals that read back as the same.
  template <typename... Parts>
  void print (const Parts&... parts)
  {
    (printOne (parts), ...);
  }

  /// Writes all bytes and checks that they arrived on the disk.
  void close ();

  /// Closes the file, if it is open, and gives it its final name, which makes it visible, or copies it
  /// to the standard output.
  void publish ();

private:
  template <typename T>
  void printOne (const T& part)
  {
    constexpr std::size_t LONGEST = 32;
    if constexpr (std::is_arithmetic_v<T>) {
      char* const first = room (LONGEST);
      used_ += static_cast<std::size_t> (std::to_chars (first, first + LONGEST, part).ptr - first);
    }
    else
      write (std::string_view (part));
  }

  /// Makes room in the buffer for `size` more bytes, which must be few.
  char* room (std::size_t size)
  {
    if (used_ + size > buffer_.size ())
      flush ();
    return buffer_.data () + used_;
  }

  /// Writes what is in the buffer, and then these bytes.
  void flush (std::string_view then = {});

  [[noreturn]] void fail (int error) const;

  std::filesystem::path path_; // as given by the user
  std::filesystem::path target_;
  std::string temporary_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t used_ = 0; // bytes in the buffer
};

inline void
writeFile (const std::filesystem::path& path, std::string_view bytes, bool is_private = false)
{
  AtomicFile file (path, is_private);
  file.write (bytes);
  file.publish ();
}

/// Files that become visible together.
using OutputFiles = std::deque<AtomicFile>;

/// Writes one of them under a temporary name.
inline void
stageFile (const std::filesystem::path& path, std::string_view bytes, OutputFiles& files)
{
  AtomicFile& file = files.emplace_back (path);
  file.write (bytes);
  file.close ();
}

inline void
publishAll (OutputFiles& files)
{
  for (AtomicFile& file : files)
    file.publish ();
}

} // namespace pcl::floater
