// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>

namespace pcl::floater {
// A head, a table of the arrays, and the arrays, in pieces with a checksum behind each. Numbers are
// as in memory: the magic tells if the byte order is another one.

namespace {
constexpr std::uint64_t MAGIC = 0x0a42464c54434c50ULL; // "PLCTLFB\n" on a little-endian machine
constexpr std::uint64_t PIECE = 16384; // bytes; what is read at a time, to compare its checksum
constexpr std::uint32_t MOST_ARRAYS = 64;

struct Head
{
  std::uint64_t magic;
  std::uint32_t version, arrays;
  std::uint64_t plan, size;
  std::uint64_t checksum; // of all before, and of the table
};

std::uint64_t
checksumOf (const Head& head, const std::vector<ArrayEntry>& table)
{
  return XXH3_64bits_withSeed (table.data (), table.size () * sizeof (ArrayEntry),
                               XXH3_64bits (&head, offsetof (Head, checksum)));
}

// Bytes of an array with the checksums of its pieces.
std::uint64_t
withChecksums (std::uint64_t bytes)
{
  return bytes + (bytes + PIECE - 1) / PIECE * sizeof (std::uint64_t);
}

} // namespace

void
Store::put (const std::string& file, const NamedArrays& arrays, std::uint64_t plan) const
{
  Head head{MAGIC, WORK_FORMAT, static_cast<std::uint32_t> (arrays.size ()), plan, 0, 0};
  head.size = sizeof (Head) + arrays.size () * sizeof (ArrayEntry);
  std::vector<ArrayEntry> table;
  for (const NamedArray& array : arrays) {
    ArrayEntry& entry = table.emplace_back (ArrayEntry{{}, array.element, array.count, head.size});
    array.name.copy (entry.name.data (), entry.name.size () - 1);
    head.size += withChecksums (entry.element * entry.count);
  }
  head.checksum = checksumOf (head, table);
  AtomicFile written (path (file), true);
  const auto write = [&written] (const void* bytes, std::size_t count) {
    written.write ({static_cast<const char*> (bytes), count});
  };
  write (&head, sizeof (head));
  write (table.data (), table.size () * sizeof (ArrayEntry));
  for (const NamedArray& array : arrays) {
    const std::uint64_t bytes = array.element * array.count;
    for (std::uint64_t at = 0, count = 0; at < bytes; at += count) {
      count = std::min (PIECE, bytes - at);
      const std::uint64_t checksum = XXH3_64bits (array.first + at, count);
      write (array.first + at, count);
      write (&checksum, sizeof (checksum));
    }
  }
  written.publish ();
}

WorkFile::WorkFile (const std::filesystem::path& path)
    : path_ (path.string ()),
      descriptor_ (::open (path.c_str (), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)),
      closing_ (nullptr, [file = descriptor_] (void*) { ::close (file); })
{
  struct stat status = {};
  if (descriptor_ < 0 && errno == ELOOP)
    refuse ("is a symbolic link, which no work folder has");
  if (descriptor_ < 0 || ::fstat (descriptor_, &status) != 0)
    throw WorkError ("cannot read '" + path_ + "': " + std::strerror (errno) +
                     (errno == ENOENT ? "; run the step that makes it (see --print-steps)" : ""));
  constexpr uid_t NOBODY = 65534; // some file systems have files of root as those of nobody
  const uid_t user = ::geteuid ();
  if (!S_ISREG (status.st_mode) || (status.st_mode & (S_IWGRP | S_IWOTH)) != 0 ||
      (status.st_uid != user && !(user == 0 && status.st_uid == NOBODY)))
    refuse ("is not a file that only this user can write: it may be somebody else's; name a work "
            "folder of your own");
  size_ = static_cast<std::uint64_t> (status.st_size);
}

void
WorkFile::read (std::uint64_t offset, std::size_t count, void* bytes) const
{
  while (count > 0) {
    const ssize_t got = ::pread (descriptor_, bytes, count, static_cast<off_t> (offset));
    if (got < 0 && errno != EINTR)
      throw WorkError ("cannot read '" + path_ + "': " + std::strerror (errno));
    if (got == 0)
      refuse ("became shorter while it was read; delete it and run again");
    const auto done = static_cast<std::size_t> (std::max<ssize_t> (got, 0));
    bytes = static_cast<char*> (bytes) + done;
    offset += done;
    count -= done;
  }
}

ArrayFile::ArrayFile (WorkFile file, std::uint64_t plan) : file_ (std::move (file))
{
  Head head{};
  const std::uint64_t size = file_.size ();
  const auto refuseTruncated = [&] (std::uint64_t wanted) {
    file_.refuse ("is truncated or has grown: " + std::to_string (size) + " bytes instead of " +
                  std::to_string (wanted) + "; delete it and run again");
  };
  if (size < sizeof (head))
    refuseTruncated (sizeof (head));
  file_.read (0, sizeof (head), &head);
  if (head.magic != MAGIC)
    file_.refuse ("is no file of this program, or from a machine of another byte order; name "
                  "another work folder");
  if (head.version != WORK_FORMAT)
    file_.refuse ("has the format version " + std::to_string (head.version) +
                  ", and this program " + std::to_string (WORK_FORMAT) +
                  "; use the version that made it, or an empty work folder");
  table_.resize (std::min (head.arrays, MOST_ARRAYS));
  const std::size_t table_size = table_.size () * sizeof (ArrayEntry);
  if (size - sizeof (head) < table_size)
    refuseTruncated (head.size);
  file_.read (sizeof (head), table_size, table_.data ());
  if (head.checksum != checksumOf (head, table_) || head.arrays > MOST_ARRAYS)
    file_.refuse ("is damaged; delete it and run again");
  if (head.plan != plan)
    file_.refuse ("belongs to another plan; delete it and run again, or name another work folder");
  if (head.size != size)
    refuseTruncated (head.size);
  for (const ArrayEntry& entry : table_)
    require (entry.name.back () == '\0' && entry.element > 0 &&
             entry.count <= head.size / entry.element && entry.offset <= head.size &&
             withChecksums (entry.element * entry.count) <= head.size - entry.offset);
}

void
ArrayFile::readBytes (const ArrayEntry& array, std::size_t first, std::size_t last, char* bytes)
{
  const std::uint64_t end = last * array.element;
  for (std::uint64_t at = first * array.element, count = 0; at < end; at += count) {
    const std::uint64_t begin = at / PIECE * PIECE;
    if (piece_of_ != &array || piece_begin_ != begin) {
      const std::uint64_t length = std::min (PIECE, array.element * array.count - begin);
      piece_of_ = nullptr; // as long as nothing is known of its bytes
      piece_.resize (length + sizeof (std::uint64_t));
      file_.read (array.offset + withChecksums (begin), piece_.size (), piece_.data ());
      if (readNumber<std::uint64_t> (piece_.data () + length, ByteOrder::native) !=
          XXH3_64bits (piece_.data (), length))
        file_.refuse ("is damaged; delete it and run again");
      piece_.resize (length);
      piece_of_ = &array;
      piece_begin_ = begin;
    }
    count = std::min<std::uint64_t> (end, begin + piece_.size ()) - at;
    if (bytes != nullptr)
      bytes = std::copy_n (piece_.data () + (at - begin), count, bytes);
  }
}

} // namespace pcl::floater
