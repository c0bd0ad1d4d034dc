// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A library to be preloaded (LD_PRELOAD): one call of the system goes wrong. In the environment are
//   PCL_FLOATER_FAULT       CALL:N:KIND, such as write:2:ENOSPC: the third write
//   PCL_FLOATER_FAULT_MARK  file that is made when the fault happens
//   PCL_FLOATER_FAULT_FILE  file that KIND shrink truncates
// KIND is EIO, ENOSPC, EINTR or EACCES; short: half of the bytes are written; kill: SIGKILL before
// the call; killed: SIGKILL after it; shrink: the file is truncated before the call.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {
enum class Fault
{
  NONE,
  ERROR, // errno is set
  SHORT,
  KILL_AFTER
};

void
die ()
{
  ::syscall (SYS_kill, ::getpid (), SIGKILL);
}

// What is to happen to this call. Counts the calls of the name that is asked for.
Fault
faultOf (const char* call)
{
  static std::atomic<long> calls{0};
  const char* const wanted = ::getenv ("PCL_FLOATER_FAULT");
  const std::size_t length = std::strlen (call);
  if (wanted == nullptr || std::strncmp (wanted, call, length) != 0 || wanted[length] != ':')
    return Fault::NONE;
  char* rest = nullptr;
  const long n = std::strtol (wanted + length + 1, &rest, 10);
  if (calls++ != n)
    return Fault::NONE;
  if (const char* const mark = ::getenv ("PCL_FLOATER_FAULT_MARK"))
    ::syscall (SYS_close, ::syscall (SYS_openat, AT_FDCWD, mark, O_CREAT | O_WRONLY, 0600));
  const std::string kind = rest + 1;
  if (kind == "kill")
    die ();
  if (kind == "shrink") {
    ::syscall (SYS_truncate, ::getenv ("PCL_FLOATER_FAULT_FILE"), 0L);
    return Fault::NONE;
  }
  if (kind == "killed")
    return Fault::KILL_AFTER;
  if (kind == "short")
    return Fault::SHORT;
  errno = kind == "ENOSPC" ? ENOSPC : kind == "EINTR" ? EINTR : kind == "EACCES" ? EACCES : EIO;
  return Fault::ERROR;
}

// A system call with its fault.
template <typename... Arguments>
long
callWithFault (const char* name, long number, Arguments... arguments)
{
  const Fault fault = faultOf (name);
  if (fault == Fault::ERROR)
    return -1;
  const long result = ::syscall (number, arguments...);
  if (fault == Fault::KILL_AFTER)
    die ();
  return result;
}

} // namespace

extern "C" {
ssize_t
write (int file, const void* bytes, std::size_t size)
{
  const Fault fault = file > STDERR_FILENO ? faultOf ("write") : Fault::NONE;
  if (fault == Fault::ERROR)
    return -1;
  const ssize_t done =
      ::syscall (SYS_write, file, bytes, fault == Fault::SHORT ? (size + 1) / 2 : size);
  if (fault == Fault::KILL_AFTER)
    die ();
  return done;
}

ssize_t
read (int file, void* bytes, std::size_t size)
{
  return callWithFault ("read", SYS_read, file, bytes, size);
}

int
open (const char* path, int flags, ...)
{
  std::va_list more;
  va_start (more, flags);
  const auto mode = (flags & O_CREAT) != 0 ? va_arg (more, mode_t) : 0U;
  va_end (more);
  return static_cast<int> (callWithFault ("open", SYS_openat, AT_FDCWD, path, flags, mode));
}

int
open64 (const char* path, int flags, ...) __attribute__ ((alias ("open")));

int
rename (const char* from, const char* to)
{
  return static_cast<int> (callWithFault ("rename", SYS_rename, from, to));
}

int
fsync (int file)
{
  return static_cast<int> (callWithFault ("fsync", SYS_fsync, file));
}

void*
mmap (void* address, std::size_t size, int protection, int flags, int file, off_t offset)
{
  return reinterpret_cast<void*> (
      callWithFault ("mmap", SYS_mmap, address, size, protection, flags, file, offset));
}

void*
mmap64 (void* address, std::size_t size, int protection, int flags, int file, off64_t offset)
    __attribute__ ((alias ("mmap")));

int
fchmod (int file, mode_t mode)
{
  return static_cast<int> (callWithFault ("fchmod", SYS_fchmod, file, mode));
}
}
