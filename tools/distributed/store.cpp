// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "store.h"

#include "atomic_file.h"

#include <algorithm>

namespace pcl::floater {
std::string
FolderStore::readText (const std::string& name) const
{
  const std::unique_ptr<ByteSource> source = openFile (path (name));
  std::string text (source->size (), '\0');
  source->read (0, text.size (), text.data ());
  return text;
}

void
FolderStore::putText (const std::string& name, const std::string& text) const
{
  AtomicFile file (path (name));
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
  AtomicFile file (path (name));
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
