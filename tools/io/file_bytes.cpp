// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include "format.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>

namespace pcl::floater {
namespace {
std::map<char*, std::size_t> mapped_files; // sizes by address
std::mutex mapped_files_mutex;

} // namespace

struct FileBytes::Holder : private boost::noncopyable
{
  /// \param opened a descriptor; negative if that failed
  explicit Holder (int opened) : descriptor (opened)
  {
    if (descriptor < 0 || ::fstat (descriptor, &status) != 0)
      throw ReadError (std::strerror (errno));
    const auto size = static_cast<std::size_t> (status.st_size);
    void* at = MAP_FAILED;
    if (S_ISREG (status.st_mode) && size > 0)
      at = ::mmap (nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    is_mapped = at != MAP_FAILED;
    if (is_mapped) {
      bytes = {static_cast<const char*> (at), size};
      ::madvise (at, size, MADV_SEQUENTIAL);
      const std::lock_guard<std::mutex> lock (mapped_files_mutex);
      mapped_files.emplace (static_cast<char*> (at), size);
      return;
    }
    std::array<char, 1U << 16U> step{};
    for (ssize_t got = -1; got != 0;) {
      got = ::read (descriptor, step.data (), step.size ());
      if (got < 0 && errno != EINTR)
        throw ReadError (std::strerror (errno));
      own.append (step.data (), static_cast<std::size_t> (std::max<ssize_t> (got, 0)));
    }
    bytes = own;
  }

  ~Holder ()
  {
    if (is_mapped) {
      char* const at = const_cast<char*> (bytes.data ());
      const std::lock_guard<std::mutex> lock (mapped_files_mutex);
      mapped_files.erase (at);
      ::munmap (at, bytes.size ());
    }
    ::close (descriptor);
  }

  int descriptor = -1;
  struct stat status = {}; // as it was when the file was opened
  bool is_mapped = false;
  std::string own;        // if it is not mapped
  std::string_view bytes; // either
};

FileBytes::FileBytes (const std::filesystem::path& path)
{
  std::error_code error;
  const bool is_stream = isStandardStream (path);
  const std::filesystem::file_status status = std::filesystem::status (path, error);
  if (!is_stream && status.type () == std::filesystem::file_type::not_found)
    throw ReadError ("there is no such file; check its name");
  if (!is_stream && std::filesystem::is_directory (status))
    throw ReadError ("it is a folder, not a file");
  holder_ = std::make_shared<Holder> (is_stream ? ::fcntl (STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                                : ::open (path.c_str (), O_RDONLY | O_CLOEXEC));
  bytes_ = holder_->bytes;
}

void
giveBackMappedFiles ()
{
  const std::lock_guard<std::mutex> lock (mapped_files_mutex);
  for (const auto& [at, size] : mapped_files)
    ::madvise (at, size, MADV_DONTNEED);
}

bool
FileBytes::hasChanged () const
{
  if (!holder_ || !holder_->is_mapped)
    return false;
  struct stat now = {};
  return ::fstat (holder_->descriptor, &now) != 0 || now.st_size != holder_->status.st_size ||
         now.st_mtim.tv_sec != holder_->status.st_mtim.tv_sec ||
         now.st_mtim.tv_nsec != holder_->status.st_mtim.tv_nsec;
}

} // namespace pcl::floater
