// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file, without a copy where possible, and numbers in its byte order.
#pragma once

#include <boost/endian/conversion.hpp>
#include <boost/noncopyable.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pcl::floater {
/// Exit codes, as documented in --help.
enum ExitCode
{
  EXIT_OK = 0,
  EXIT_USAGE = 1,
  EXIT_INPUT = 2,
  EXIT_RECONSTRUCTION = 3,
  EXIT_OUTPUT = 4,
  EXIT_INTERNAL = 5,
  EXIT_WARNINGS = 6,
  EXIT_WORK = 7 ///< a file of the work folder of pcl_floater_distributed cannot be used
};

/// A failure, and the exit code for it.
struct ToolError : std::runtime_error
{
  ToolError (int exit_code, const std::string& message)
      : std::runtime_error (message), code (exit_code)
  {
  }

  int code;
};

template <ExitCode CODE>
struct ErrorOf : ToolError
{
  explicit ErrorOf (const std::string& message) : ToolError (CODE, message) {}
};

/// A file cannot be used as input. The message names the cause, not the file.
using ReadError = ErrorOf<EXIT_INPUT>;

using ByteOrder = boost::endian::order; ///< little, big, or native: that of this machine

/// Copies a number from the byte order of a file to that of this machine, or the other way.
template <typename T>
inline void
copyNumber (void* to, const void* from, ByteOrder order = ByteOrder::little)
{
  std::array<char, sizeof (T)> bytes{};
  std::memcpy (bytes.data (), from, sizeof (T));
  if (order != ByteOrder::native)
    std::reverse (bytes.begin (), bytes.end ());
  std::memcpy (to, bytes.data (), sizeof (T));
}

template <typename T>
inline T
readNumber (const void* from, ByteOrder order = ByteOrder::little)
{
  T number;
  copyNumber<T> (&number, from, order);
  return number;
}

/// The bytes of a file. A regular file is mapped, so that the system can take its pages out of
/// memory again; a pipe is read. Copies share the bytes.
///
/// If another program writes to a mapped file, the bytes change; hasChanged () tells. If it
/// truncates the file, reading the missing bytes raises SIGBUS, on which handleSignals () ends the
/// program in an orderly way.
class FileBytes
{
public:
  FileBytes () = default;

  /// \param path "-": what comes from the standard input, to its end
  /// \throws ReadError if the file does not exist, is a folder, or cannot be read
  explicit FileBytes (const std::filesystem::path& path);

  /// Bytes of the caller, which must outlive all copies of this object.
  explicit FileBytes (std::string_view bytes) : bytes_ (bytes) {}

  std::string_view view () const { return bytes_; }

  /// The byte at `offset`. The pointer keeps all bytes alive.
  std::shared_ptr<const char> at (std::size_t offset) const
  {
    return {holder_, bytes_.data () + offset};
  }

  /// Whether a mapped file has been written to since it was opened.
  bool hasChanged () const;

private:
  struct Holder;

  std::shared_ptr<const Holder> holder_;
  std::string_view bytes_;
};

/// Gives the memory of all mapped files back. Bytes that are used again are read from the files
/// again. May be called by any thread.
void
giveBackMappedFiles ();

} // namespace pcl::floater
