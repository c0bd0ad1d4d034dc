// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "store.h"

#include "atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace pcl::floater {
// A head, a table of the arrays, the checksums of all pieces of each array, and the arrays, each
// aligned to 8 bytes. Numbers are as in memory: the magic tells if the byte order is another one.

namespace {
constexpr std::uint64_t MAGIC = 0x0a42464c54434c50ULL; // "PLCTLFB\n" on a little-endian machine
constexpr std::size_t PIECE = 16384; // bytes; what is read at least, to compare its checksum
constexpr std::uint64_t AT_ONCE = 8 * PIECE; // bytes that are read at most
constexpr std::size_t LONGEST_NAME = 24;
constexpr std::uint32_t MOST_ARRAYS = 64;

struct Head
{
  std::uint64_t magic;
  std::uint32_t version, arrays;
  std::uint64_t plan, size;
  std::uint64_t table_checksum; // of the table and the checksums behind it
  std::uint64_t head_checksum;  // of all before
};

struct Entry
{
  char name[LONGEST_NAME]; // NOLINT(modernize-avoid-c-arrays): as it is in the file
  std::uint64_t element, count, offset;
};

// \param before checksum of the bytes before these
std::uint64_t
checksumOf (const void* bytes, std::size_t count, std::uint64_t before = 0)
{
  return XXH3_64bits_withSeed (bytes, count, before);
}

std::size_t
pieces (std::uint64_t bytes)
{
  return static_cast<std::size_t> ((bytes + PIECE - 1) / PIECE);
}

std::uint64_t
aligned (std::uint64_t offset)
{
  constexpr std::uint64_t ALIGNMENT = 8;
  return (offset + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

class OpenFile : public ByteSource
{
public:
  OpenFile (const std::filesystem::path& path, bool is_work)
      : path_ (path), descriptor_ (::open (path.c_str (), O_RDONLY | O_CLOEXEC | O_NONBLOCK |
                                                              (is_work ? O_NOFOLLOW : 0)))
  {
    struct stat status = {};
    if (descriptor_ < 0 || ::fstat (descriptor_, &status) != 0)
      fail (errno);
    if (is_work && !isOwn (status)) {
      ::close (descriptor_);
      throw WorkError ("'" + path_.string () +
                       "' is not a file that only this user can write: it may be somebody else's; "
                       "name a work folder of your own");
    }
    size_ = static_cast<std::uint64_t> (status.st_size);
  }
  ~OpenFile () override
  {
    if (descriptor_ >= 0)
      ::close (descriptor_);
  }
  OpenFile (const OpenFile&) = delete;
  OpenFile& operator= (const OpenFile&) = delete;
  OpenFile (OpenFile&&) = delete;
  OpenFile& operator= (OpenFile&&) = delete;

  std::uint64_t size () const override { return size_; }

  void read (std::uint64_t offset, std::size_t count, char* bytes) override
  {
    while (count > 0) {
      const ssize_t got = ::pread (descriptor_, bytes, count, static_cast<off_t> (offset));
      if (got < 0 && errno == EINTR)
        continue;
      if (got < 0)
        fail (errno);
      if (got == 0)
        throw WorkError ("'" + path_.string () +
                         "' became shorter while it was read; delete it and run again");
      bytes += got;
      offset += static_cast<std::uint64_t> (got);
      count -= static_cast<std::size_t> (got);
    }
  }

private:
  // Some file systems have files of root as those of nobody.
  static bool isOwn (const struct stat& status)
  {
    constexpr uid_t NOBODY = 65534;
    const uid_t user = ::geteuid ();
    return S_ISREG (status.st_mode) && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0 &&
           (status.st_uid == user || (user == 0 && status.st_uid == NOBODY));
  }

  [[noreturn]] void fail (int error) const
  {
    if (descriptor_ >= 0)
      ::close (descriptor_);
    if (error == ELOOP)
      throw WorkError ("'" + path_.string () + "' is a symbolic link, which no work folder has");
    throw WorkError ("cannot read '" + path_.string () + "': " + std::strerror (error) +
                     (error == ENOENT ? "; run the step that makes it (see --print-steps)" : ""));
  }

  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

} // namespace

std::unique_ptr<ByteSource>
openFile (const std::filesystem::path& path, bool is_work)
{
  return std::make_unique<OpenFile> (path, is_work);
}

void
ArrayWriter::addBytes (const std::string& name, const char* bytes, std::size_t element,
                       std::size_t count)
{
  if (name.size () >= LONGEST_NAME || arrays_.size () >= MOST_ARRAYS)
    throw std::logic_error ("an array with such a name, or so many of them");
  arrays_.push_back ({name, bytes, element, count});
}

void
ArrayWriter::emit (std::uint64_t plan,
                   const std::function<void (const char* bytes, std::size_t count)>& write) const
{
  std::vector<Entry> table (arrays_.size ());
  std::vector<std::uint64_t> checksums;
  for (const Array& array : arrays_) {
    const std::size_t bytes = array.element * array.count;
    for (std::size_t first = 0; first < bytes; first += PIECE)
      checksums.push_back (checksumOf (array.bytes + first, std::min (PIECE, bytes - first)));
  }
  std::uint64_t end =
      sizeof (Head) + table.size () * sizeof (Entry) + checksums.size () * sizeof (std::uint64_t);
  for (std::size_t i = 0; i < table.size (); ++i) {
    table[i] = {};
    std::memcpy (table[i].name, arrays_[i].name.data (), arrays_[i].name.size ());
    table[i].element = arrays_[i].element;
    table[i].count = arrays_[i].count;
    table[i].offset = aligned (end);
    end = table[i].offset + arrays_[i].element * arrays_[i].count;
  }
  const auto* table_bytes = reinterpret_cast<const char*> (table.data ());
  const auto* sums_bytes = reinterpret_cast<const char*> (checksums.data ());
  const std::size_t table_size = table.size () * sizeof (Entry);
  const std::size_t sums_size = checksums.size () * sizeof (std::uint64_t);
  Head head{MAGIC, WORK_FORMAT, static_cast<std::uint32_t> (table.size ()), plan, end, 0, 0};
  head.table_checksum = checksumOf (sums_bytes, sums_size, checksumOf (table_bytes, table_size));
  head.head_checksum = checksumOf (&head, offsetof (Head, head_checksum));
  write (reinterpret_cast<const char*> (&head), sizeof (head));
  write (table_bytes, table_size);
  write (sums_bytes, sums_size);
  std::uint64_t at = sizeof (head) + table_size + sums_size;
  for (std::size_t i = 0; i < table.size (); ++i) {
    constexpr char ZEROS[8] = {}; // NOLINT(modernize-avoid-c-arrays)
    write (ZEROS, table[i].offset - at);
    write (arrays_[i].bytes, arrays_[i].element * arrays_[i].count);
    at = table[i].offset + arrays_[i].element * arrays_[i].count;
  }
}

void
ArrayWriter::write (const std::filesystem::path& path, std::uint64_t plan) const
{
  AtomicFile file (path, true);
  emit (plan, [&file] (const char* bytes, std::size_t count) { file.write (bytes, count); });
  file.close (false);
  file.publish ();
}

void
ArrayFile::refuse (const std::string& cause) const
{
  throw WorkError ("'" + name_ + "' " + cause);
}

ArrayFile::ArrayFile (std::unique_ptr<ByteSource> source, std::string name, std::uint64_t plan)
    : source_ (std::move (source)), name_ (std::move (name))
{
  Head head{};
  if (source_->size () < sizeof (head))
    refuse ("is truncated; delete it and run again");
  source_->read (0, sizeof (head), reinterpret_cast<char*> (&head));
  if (head.magic != MAGIC)
    refuse ("is no file of this program, or from a machine of another byte order; name another "
            "work folder");
  if (head.version != WORK_FORMAT)
    refuse ("has the format version " + std::to_string (head.version) + ", and this program " +
            std::to_string (WORK_FORMAT) +
            "; use the version that made it, or an empty work folder");
  if (head.head_checksum != checksumOf (&head, offsetof (Head, head_checksum)) ||
      head.arrays > MOST_ARRAYS)
    refuse ("is damaged; delete it and run again");
  if (head.plan != plan)
    refuse ("belongs to another plan; delete it and run again, or name another work folder");
  if (head.size != source_->size ())
    refuse ("is truncated or has grown: " + std::to_string (source_->size ()) +
            " bytes instead of " + std::to_string (head.size) + "; delete it and run again");
  std::vector<Entry> table (head.arrays);
  const std::size_t table_size = table.size () * sizeof (Entry);
  if (sizeof (head) + table_size > head.size)
    refuse ("is damaged; delete it and run again");
  source_->read (sizeof (head), table_size, reinterpret_cast<char*> (table.data ()));
  std::size_t sums = 0;
  for (const Entry& entry : table) {
    if (entry.element == 0 || entry.count > head.size / entry.element || entry.offset > head.size ||
        entry.element * entry.count > head.size - entry.offset)
      refuse ("is damaged; delete it and run again");
    sums += pieces (entry.element * entry.count);
  }
  std::vector<std::uint64_t> checksums (sums);
  const std::size_t sums_size = sums * sizeof (std::uint64_t);
  if (sizeof (head) + table_size + sums_size > head.size)
    refuse ("is damaged; delete it and run again");
  source_->read (sizeof (head) + table_size, sums_size,
                 reinterpret_cast<char*> (checksums.data ()));
  if (head.table_checksum !=
      checksumOf (checksums.data (), sums_size, checksumOf (table.data (), table_size)))
    refuse ("is damaged; delete it and run again");
  auto next = checksums.begin ();
  for (const Entry& entry : table) {
    const auto count = static_cast<std::ptrdiff_t> (pieces (entry.element * entry.count));
    const std::size_t length = ::strnlen (entry.name, LONGEST_NAME);
    arrays_.push_back ({std::string (entry.name, length),
                        entry.element,
                        entry.count,
                        entry.offset,
                        {next, next + count}});
    next += count;
  }
}

const ArrayFile::Array&
ArrayFile::find (const std::string& array) const
{
  for (const Array& known : arrays_)
    if (known.name == array)
      return known;
  refuse ("has no array '" + array + "'; delete it and run again");
}

void
ArrayFile::readBytes (const Array& array, std::size_t element, std::size_t first, std::size_t last,
                      char* bytes)
{
  require (element == array.element && first <= last && last <= array.count);
  const std::uint64_t size = array.element * array.count, end = last * element;
  for (std::uint64_t at = first * element; at < end;) {
    const std::uint64_t place = array.offset + at;
    if (place < buffer_at_ || place - buffer_at_ >= buffer_.size ()) {
      const std::uint64_t begin = at / PIECE * PIECE;
      const std::uint64_t wanted = pieces (std::min (end - begin, AT_ONCE)) * PIECE;
      const auto count = static_cast<std::size_t> (std::min (wanted, size - begin));
      buffer_.clear (); // as long as nothing is known of its bytes
      std::vector<char> read (count);
      source_->read (array.offset + begin, count, read.data ());
      for (std::size_t p = 0; p < count; p += PIECE)
        if (checksumOf (read.data () + p, std::min (PIECE, count - p)) !=
            array.checksums[static_cast<std::size_t> (begin + p) / PIECE])
          refuse ("is damaged; delete it and run again");
      buffer_ = std::move (read);
      buffer_at_ = array.offset + begin;
    }
    const auto skipped = static_cast<std::size_t> (place - buffer_at_);
    const auto count =
        static_cast<std::size_t> (std::min<std::uint64_t> (end - at, buffer_.size () - skipped));
    std::memcpy (bytes, buffer_.data () + skipped, count);
    bytes += count;
    at += count;
  }
}

void
ArrayFile::verify ()
{
  std::vector<char> bytes;
  for (const Array& array : arrays_) {
    const auto step = std::max<std::size_t> (1, AT_ONCE / array.element);
    bytes.resize (step * array.element);
    for (std::size_t first = 0; first < array.count; first += step)
      readBytes (array, array.element, first, std::min<std::size_t> (first + step, array.count),
                 bytes.data ());
  }
}

std::string
FolderStore::readText (const std::string& name) const
{
  const std::unique_ptr<ByteSource> source = openFile (path (name), true);
  std::string text (source->size (), '\0');
  source->read (0, text.size (), text.data ());
  return text;
}

void
FolderStore::putText (const std::string& name, const std::string& text) const
{
  AtomicFile file (path (name), true);
  file.write (text);
  file.close ();
  file.publish ();
}

void
FolderStore::put (const std::string& name, const ArrayWriter& arrays, std::uint64_t plan)
{
  arrays.write (path (name), plan);
  syncBehind (name);
}

void
FolderStore::putBytes (const std::string& name, const char* bytes, std::size_t count)
{
  AtomicFile file (path (name), true);
  file.write (bytes, count);
  file.close (false);
  file.publish ();
  syncBehind (name);
}

void
FolderStore::remove (const std::string& name) const
{
  std::error_code error; // a file that stays costs room only
  std::filesystem::remove (path (name), error);
}

void
FolderStore::syncBehind (const std::string& name)
{
  const std::lock_guard<std::mutex> lock (mutex_);
  if (syncing_.valid ())
    syncing_.get ();
  syncing_ = std::async (std::launch::async, [path = path (name)] {
    try {
      syncFile (path);
    }
    catch (const WriteError&) {
      std::error_code error;
      std::filesystem::remove (path, error);
      throw;
    }
  });
}

void
FolderStore::finish ()
{
  const std::lock_guard<std::mutex> lock (mutex_);
  if (syncing_.valid ())
    syncing_.get ();
}

std::string
blockFile (const char* step, std::size_t block)
{
  return std::string (step) + "." + std::to_string (block) + ".bin";
}

ArrayFile
openArrays (Store& store, const std::string& name, const Plan& plan)
{
  return {store.open (name), store.describe (name), plan.id};
}

std::size_t
BlockRanges::blockOf (std::uint32_t point) const
{
  return static_cast<std::size_t> (std::upper_bound (firsts_.begin (), firsts_.end (), point) -
                                   firsts_.begin ()) -
         1;
}

} // namespace pcl::floater
