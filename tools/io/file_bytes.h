// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file, without a copy where that can be.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace pcl
{
namespace floater
{
/// The bytes of a file: mapped into memory, so that they take none of it for long, or read where
/// there is nothing to map, as of a pipe. Copies share them.
///
/// A file that others write to while it is mapped changes under our eyes; hasChanged () tells. If
/// it gets shorter, reading what is gone is a signal, SIGBUS, which handleSignals () makes an
/// orderly end of the program.
class FileBytes
{
public:
  /// No bytes.
  FileBytes () = default;

  /// \throws ReadError if the file does not exist, is a folder, or cannot be read
  explicit FileBytes (const std::filesystem::path& path);

  /// Bytes of the caller's, which must live as long as all copies of this.
  explicit FileBytes (std::string_view bytes) : bytes_ (bytes) {}

  std::string_view view () const { return bytes_; }

  /// The byte at `offset` and, for as long as the pointer lives, all others.
  std::shared_ptr<const char> at (std::size_t offset) const
  {
    return {holder_, bytes_.data () + offset};
  }

  /// Gives the memory of a mapped file back. What is looked at again is fetched again.
  void giveBack () const;

  /// True if a mapped file has been written to since it was opened.
  bool hasChanged () const;

private:
  struct Holder;
  std::shared_ptr<const Holder> holder_;
  std::string_view bytes_;
};

/// The same for all files that are mapped now. Any thread may call it at any time.
void
giveBackMappedFiles ();

/// True if the address is in a file that is mapped now. For signal handlers.
bool
isInMappedFile (const void* address);

} // namespace floater
} // namespace pcl
