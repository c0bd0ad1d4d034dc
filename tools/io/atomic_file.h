// SPDX-License-Identifier: GPL-3.0-or-later
// A file that appears only when it is whole.
#pragma once

#include "byte_order.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pcl
{
namespace floater
{
/// A file cannot be written. The text names the file and the cause.
class WriteError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Checks, without touching anything, that a file could be created or replaced here.
/// \throws WriteError if its folder is missing or closed to us, or something else than a file is
/// there
void
requireWritable (const std::filesystem::path& path);

/// Sees to it that interrupting the program (SIGINT, SIGTERM, SIGHUP) leaves no temporary file, and
/// that running into a limit on file sizes is an error of the write, not the end of the program.
/// \param input_failed exit code if a file that is mapped (FileBytes) gets shorter under our eyes
void
handleSignals (int input_failed = 1);

/// Writes a temporary file in the folder of the final one, whose name it takes at the very end. If
/// it is destroyed before that, the temporary file is removed and what was there before stays. A
/// symbolic link is followed; permissions of a file that is replaced are kept.
class AtomicFile
{
public:
  /// \throws WriteError like all other members
  explicit AtomicFile (const std::filesystem::path& path);
  ~AtomicFile ();
  AtomicFile (const AtomicFile&) = delete;
  AtomicFile& operator= (const AtomicFile&) = delete;
  AtomicFile (AtomicFile&&) = delete;
  AtomicFile& operator= (AtomicFile&&) = delete;

  /// Appends bytes.
  void write (const void* bytes, std::size_t size);

  void write (std::string_view text) { write (text.data (), text.size ()); }

  /// Appends a number in the byte order of the file.
  template <typename T>
  void writeNumber (T number, ByteOrder order)
  {
    copyNumber<T> (room (sizeof (T)), &number, order);
    used_ += sizeof (T);
  }

  /// Appends the shortest decimal that reads back as the same number.
  template <typename T>
  void writeDecimal (T number);

  /// Hands all bytes to the disk and makes sure that they arrived.
  void close ();

  /// Gives the closed file its name. Nothing but this makes the file visible.
  void publish ();

private:
  /// Makes room for `size` more bytes, which must be few.
  char* room (std::size_t size)
  {
    if (used_ + size > buffer_.size ())
      flush ();
    return buffer_.data () + used_;
  }

  void flush ();

  void writeThrough (const char* bytes, std::size_t size);

  [[noreturn]] void fail (int error) const;

  std::filesystem::path path_; // as the user gave it
  std::filesystem::path target_;
  std::string temporary_;
  std::size_t slot_ = 0; // in the list for the signal handler
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t used_ = 0;    // bytes in the buffer
  std::size_t written_ = 0; // bytes handed to the system
};

} // namespace floater
} // namespace pcl
