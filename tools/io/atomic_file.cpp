// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "atomic_file.h"

#include "format.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace pcl::floater {
namespace {
constexpr std::size_t BUFFER_BYTES = 1U << 20U;
constexpr std::size_t MOST_FILES = 8;

/// Names of the existing temporary files, for the signal handler, which does not know files beyond
/// MOST_FILES. The strings are those of their AtomicFiles; nullptr is a free place.
std::array<std::atomic<const char*>, MOST_FILES> temporary_names{};

int exit_code_of_shrunk_input = EXIT_FAILURE;

void
removeTemporaryFiles ()
{
  for (const std::atomic<const char*>& place : temporary_names)
    if (const char* const name = place)
      ::unlink (name);
}

extern "C" void
endOnSignal (int signal_number)
{
  removeTemporaryFiles ();
  // SA_RESETHAND has restored the default action, so that this ends the program.
  ::raise (signal_number);
}

// Nothing else raises this signal: the space of scratch files is reserved.
extern "C" void
endOnBusError (int /*signal_number*/)
{
  static constexpr char MESSAGE[] =
      "\nthe input file was truncated while it was in use, or a disk cannot be read\n";
  removeTemporaryFiles ();
  [[maybe_unused]] const ssize_t written = ::write (STDERR_FILENO, MESSAGE, sizeof MESSAGE - 1);
  ::_exit (exit_code_of_shrunk_input);
}

/// Puts a name in the place of another one; either may be nullptr. Leaves errno as it is.
void
replaceName (const char* old, const char* name)
{
  for (std::atomic<const char*>& place : temporary_names)
    if (const char* its = old; place.compare_exchange_strong (its, name))
      return;
}

/// \return 0, or the number of the error
int
writeAll (int descriptor, std::string_view bytes)
{
  while (!bytes.empty ()) {
    const ssize_t done = ::write (descriptor, bytes.data (), bytes.size ());
    if (done > 0)
      bytes.remove_prefix (static_cast<std::size_t> (done));
    else if (done == 0 || errno != EINTR)
      return done == 0 ? EIO : errno;
  }
  return 0;
}

[[noreturn]] void
failOn (const std::filesystem::path& path, const std::string& cause)
{
  throw WriteError (
      "cannot write " +
      (isStandardStream (path) ? "to the standard output" : "'" + path.string () + "'") + ": " +
      cause);
}

std::filesystem::path
resolve (const std::filesystem::path& path)
{
  std::error_code error;
  if (isStandardStream (path))
    return std::filesystem::temp_directory_path (error) / "mesh"; // only its folder is used
  const std::filesystem::path resolved =
      std::filesystem::weakly_canonical (std::filesystem::absolute (path), error);
  return error ? path : resolved;
}

std::filesystem::path
folderOf (const std::filesystem::path& path)
{
  return path.has_parent_path () ? path.parent_path () : std::filesystem::path (".");
}

} // namespace

void
requireWritable (const std::filesystem::path& path)
{
  std::error_code error;
  const std::filesystem::path target = resolve (path);
  const std::filesystem::path folder = folderOf (target);
  const bool is_stream = isStandardStream (path);
  const std::filesystem::file_status its =
      is_stream ? std::filesystem::file_status () : std::filesystem::status (target, error);
  if (is_stream && ::isatty (STDOUT_FILENO) == 1)
    failOn (path, "it is a terminal, which cannot show a mesh; redirect it to a file or a program");
  if (!std::filesystem::exists (folder, error))
    failOn (path, "there is no folder '" + folder.string () + "'; create it first");
  if (!std::filesystem::is_directory (folder, error))
    failOn (path, "'" + folder.string () + "' is not a folder");
  if (std::filesystem::is_directory (its))
    failOn (path, "it is a folder; give the name of a file");
  if (std::filesystem::exists (its) && !std::filesystem::is_regular_file (its))
    failOn (path, "it is a device or a pipe; give the name of a file");
  if (::access (folder.c_str (), W_OK | X_OK) != 0)
    failOn (path,
            "the folder '" + folder.string () + "' is not writable: " + std::strerror (errno));
}

void
handleSignals (int input_failed)
{
  struct sigaction action = {};
  action.sa_handler = SIG_IGN;
  ::sigaction (SIGXFSZ, &action, nullptr);
  action.sa_handler = endOnSignal;
  action.sa_flags = static_cast<int> (SA_RESETHAND);
  // SIGPIPE: who reads what is printed has gone. The last four: limits of time, and schedulers.
  for (const int signal_number :
       {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2}) {
    struct sigaction before = {};
    // Signals that the parent ignores, as nohup does, stay ignored.
    if (::sigaction (signal_number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction (signal_number, &action, nullptr);
  }
  exit_code_of_shrunk_input = input_failed;
  action.sa_handler = endOnBusError;
  ::sigaction (SIGBUS, &action, nullptr);
}

AtomicFile::AtomicFile (const std::filesystem::path& path, bool is_private)
    : path_ (path), target_ (is_private ? path : resolve (path)), buffer_ (BUFFER_BYTES)
{
  requireWritable (path);
  constexpr int MOST_TRIES = 100;
  // Less the umask. What goes to the standard output is nobody else's.
  const mode_t mode = is_private || isStandardStream (path) ? 0600 : 0666;
  for (int i = 0; i < MOST_TRIES && descriptor_ < 0; ++i) {
    const std::string name =
        ".pcl_floater." + std::to_string (::getpid ()) + "." + std::to_string (i) + ".tmp";
    temporary_ = (folderOf (target_) / name).string ();
    replaceName (nullptr, temporary_.c_str ()); // before it exists: a signal may come right after
    descriptor_ = ::open (temporary_.c_str (), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ < 0)
      replaceName (temporary_.c_str (), nullptr);
    if (descriptor_ < 0 && errno != EEXIST)
      break;
  }
  if (descriptor_ < 0)
    fail (errno);
  struct stat status = {};
  constexpr mode_t PERMISSIONS = 07777;
  if (!is_private && !isStandardStream (path_) && ::stat (target_.c_str (), &status) == 0)
    ::fchmod (descriptor_, status.st_mode & PERMISSIONS);
}

AtomicFile::~AtomicFile ()
{
  if (descriptor_ >= 0)
    ::close (descriptor_);
  if (!temporary_.empty ())
    ::unlink (temporary_.c_str ());
  replaceName (temporary_.c_str (), nullptr);
}

void
AtomicFile::write (std::string_view bytes)
{
  if (bytes.size () > buffer_.size ())
    return flush (bytes);
  bytes.copy (room (bytes.size ()), bytes.size ());
  used_ += bytes.size ();
}

void
AtomicFile::flush (std::string_view then)
{
  for (const std::string_view bytes : {std::string_view (buffer_.data (), used_), then})
    if (const int error = writeAll (descriptor_, bytes))
      fail (error);
  used_ = 0;
}

void
AtomicFile::close ()
{
  flush ();
  // Some file systems report a full disk only here.
  while (::fsync (descriptor_) != 0 && errno != EINVAL)
    if (errno != EINTR)
      fail (errno);
  if (::close (std::exchange (descriptor_, -1)) != 0)
    fail (errno);
}

void
AtomicFile::publish ()
{
  if (descriptor_ >= 0)
    close ();
  if (isStandardStream (path_)) { // the destructor removes the file
    try {
      if (const int error =
              writeAll (STDOUT_FILENO, FileBytes (std::filesystem::path (temporary_)).view ()))
        fail (error);
    }
    catch (const ReadError& error) {
      failOn (path_, error.what ());
    }
    return;
  }
  if (::rename (temporary_.c_str (), target_.c_str ()) != 0)
    fail (errno);
  replaceName (temporary_.c_str (), nullptr);
  temporary_.clear ();
}

void
AtomicFile::fail (int error) const
{
  std::string advice;
  if (error == ENOSPC || error == EDQUOT)
    advice = "; free some space or write elsewhere";
  else if (error == EEXIST)
    advice = "; remove the files '.pcl_floater.*.tmp' that runs which were killed have left in '" +
             folderOf (target_).string () + "'";
  else if (error == EFBIG)
    advice = "; raise the limit on file sizes (ulimit -f) or write a smaller format";
  failOn (path_, std::strerror (error) + advice);
}

} // namespace pcl::floater
