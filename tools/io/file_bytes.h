// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file, without a copy where possible.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace pcl::floater {
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

  /// \throws ReadError if the file does not exist, is a folder, or cannot be read
  explicit FileBytes (const std::filesystem::path& path);

  /// What comes from the standard input, to its end.
  /// \throws ReadError if it cannot be read
  static FileBytes standardInput ();

  /// Bytes of the caller, which must outlive all copies of this object.
  explicit FileBytes (std::string_view bytes) : bytes_ (bytes) {}

  std::string_view view () const { return bytes_; }

  /// The byte at `offset`. The pointer keeps all bytes alive.
  std::shared_ptr<const char> at (std::size_t offset) const
  {
    return {holder_, bytes_.data () + offset};
  }

  /// Gives the memory of a mapped file back. Bytes that are used again are read from the file
  /// again.
  void giveBack () const;

  /// Whether a mapped file has been written to since it was opened.
  bool hasChanged () const;

private:
  struct Holder;

  /// \param descriptor of an open file, which is closed with the bytes; negative if that failed
  void take (int descriptor);

  std::shared_ptr<const Holder> holder_;
  std::string_view bytes_;
};

/// Calls giveBack () for all mapped files. May be called by any thread.
void
giveBackMappedFiles ();

/// Whether the address is in a mapped file. May be called by signal handlers.
bool
isInMappedFile (const void* address);

} // namespace pcl::floater
