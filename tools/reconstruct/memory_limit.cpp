// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory_limit.h"

#include "array_pool.h"
#include "file_bytes.h"
#include "large_arrays.h"
#include "text_scanner.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl::floater {
namespace {
// Room between the limit and the resident set above which pages are dropped. The other threads may
// fill it while the watchers sleep, wait for a processor or work. It is a fraction of the limit,
// and a larger one of a small limit, because threads fill it at the same speed there.
constexpr double ROOM = 0.20;
constexpr double ROOM_OF_SMALL = 0.50;
constexpr double MOST_ROOM_OF_SMALL = 160e6; // bytes
constexpr double STEP = 0.10;                // fraction of the limit that is dropped at a time

// Bytes that stay in memory: the program with its libraries and stacks, arrays that are not large,
// and pages in use, which would come back at once.
constexpr double FIXED = 20e6;

// Largest growth of the resident set, in bytes per second. Dropped pages come back 16 at a time,
// faster than they can be read.
constexpr double FASTEST_GROWTH = 100e9;
constexpr std::chrono::duration<double> SHORTEST_SLEEP{0.00025};
constexpr std::chrono::duration<double> LONGEST_SLEEP{0.005};

// A watcher that gets no processor for some hundredths of a second, because the machine or the host
// of a virtual one is busy, leaves time for some hundred megabytes. With four watchers on four
// processors, at least one of them runs while memory fills.
constexpr std::size_t MOST_WATCHERS = 4;

// Processors on which this program may run, MOST_WATCHERS at most. None if that is unknown.
std::vector<int>
someProcessors ()
{
  std::vector<int> some;
#ifdef __linux__
  cpu_set_t all;
  CPU_ZERO (&all);
  if (::sched_getaffinity (0, sizeof (all), &all) == 0)
    for (int i = 0; i < CPU_SETSIZE && some.size () < MOST_WATCHERS; ++i)
      if (CPU_ISSET (static_cast<std::size_t> (i), &all))
        some.push_back (i);
#endif
  return some;
}

// Keeps the calling thread on one processor. If that fails, it runs on any.
void
stayOn (int processor)
{
#ifdef __linux__
  cpu_set_t one;
  CPU_ZERO (&one);
  CPU_SET (static_cast<std::size_t> (processor), &one);
  ::sched_setaffinity (0, sizeof (one), &one);
#else
  (void)processor;
#endif
}

} // namespace

bool
parseSize (std::string_view word, std::size_t& bytes)
{
  constexpr std::string_view UNITS = "kKmMgGtT";
  double unit = 1.0;
  if (!word.empty () && UNITS.find (word.back ()) != std::string_view::npos) {
    const std::size_t power = UNITS.find (word.back ()) / 2 + 1;
    unit = std::pow (1000.0, static_cast<double> (power));
    word.remove_suffix (1);
  }
  double number = 0.0;
  constexpr double MOST = 9e18;
  if (!parseNumber (word, number) || !(number >= 0.0) || number * unit > MOST)
    return false;
  bytes = static_cast<std::size_t> (std::llround (number * unit));
  return true;
}

std::string
formatSize (std::size_t bytes)
{
  constexpr std::size_t MEGABYTE = 1'000'000;
  return std::to_string ((bytes + MEGABYTE - 1) / MEGABYTE) + "M";
}

std::size_t
leastMemory (std::size_t points, double kept_per_point)
{
  // What stays in memory must fit below room and step, whichever of the two rooms applies.
  const double kept = FIXED + kept_per_point * static_cast<double> (points);
  return static_cast<std::size_t> (
      std::max (kept / (1.0 - ROOM - STEP), std::min (kept / (1.0 - ROOM_OF_SMALL - STEP),
                                                      (kept + MOST_ROOM_OF_SMALL) / (1.0 - STEP))));
}

ResidentSet::ResidentSet (std::size_t limit)
    : limit_ (static_cast<double> (limit)),
      high_ (limit_ -
             std::max (ROOM * limit_, std::min (ROOM_OF_SMALL * limit_, MOST_ROOM_OF_SMALL))),
      low_ (high_ - STEP * limit_), statm_ (::open ("/proc/self/statm", O_RDONLY | O_CLOEXEC))
{
}

ResidentSet::~ResidentSet ()
{
  if (statm_ >= 0)
    ::close (statm_);
}

double
ResidentSet::resident () const
{
  std::array<char, 128> text{};
  const ssize_t size = ::pread (statm_, text.data (), text.size () - 1, 0);
  // The first number is the size of the program, the second its resident set, both in pages.
  const std::string_view words (text.data (), size > 0 ? static_cast<std::size_t> (size) : 0);
  const std::string_view rest = words.substr (std::min (words.find (' '), words.size ()));
  TextScanner scanner (rest);
  std::size_t pages = 0;
  return scanner.nextLine () && parseNumber (scanner.word (), pages)
             ? static_cast<double> (pages) * static_cast<double> (::sysconf (_SC_PAGESIZE))
             : 0.0;
}

void
ResidentSet::makeRoom (std::size_t bytes) const
{
  const auto wanted = static_cast<double> (bytes);
  if (areAllInPool ()) // and bounded
    return;
  if (resident () + wanted <= high_)
    return;
  giveBackMappedFiles ();
  // Stops after all arrays have been dropped once: what is resident then is something else.
  const double enough = std::min (low_, high_ - wanted);
  const std::size_t all = scratchUse ().bytes;
  for (std::size_t dropped = 0; dropped < all && resident () > enough;) {
    const std::size_t chunk = dropNextChunk ();
    if (chunk == 0)
      return;
    dropped += chunk;
  }
}

std::chrono::duration<double>
ResidentSet::timeToSleep () const
{
  if (areAllInPool ())
    return LONGEST_SLEEP;
  const std::chrono::duration<double> safe{(high_ - resident ()) / FASTEST_GROWTH};
  return std::clamp (safe, SHORTEST_SLEEP, LONGEST_SLEEP);
}

std::size_t
ResidentSet::poolInMemory () const
{
  return static_cast<std::size_t> (std::max (0.0, low_ - STEP * limit_ - FIXED));
}

// Arrays of a pool need no room, because they cannot grow beyond it. A step is left for what is in
// no large array: 20 MB beside blocks of half a million points, for which the limit is some
// hundred.
std::size_t
ResidentSet::poolInFile () const
{
  const double all = (1.0 - STEP) * limit_ - FIXED;
  return static_cast<std::size_t> (std::max (0.0, all - static_cast<double> (poolInMemory ())));
}

MemoryLimit::MemoryLimit (std::size_t bytes, const std::filesystem::path& scratch_folder)
    : resident_set_ (std::make_shared<ResidentSet> (bytes))
{
  keepLargeArraysIn (scratch_folder,
                     [all = resident_set_] (std::size_t size) { all->makeRoom (size); });
  const std::vector<int> processors = someProcessors ();
  try {
    for (const int processor : processors)
      watchers_.emplace_back ([this, processor] {
        stayOn (processor);
        watch ();
      });
    if (processors.empty ())
      watchers_.emplace_back ([this] { watch (); });
  }
  catch (const std::exception&) {
    // No more threads could be started: those that run watch, and the threads that work make room.
  }
}

MemoryLimit::~MemoryLimit ()
{
  is_ending_ = true;
  for (std::thread& watcher : watchers_)
    watcher.join ();
}

// Without a lock: a watcher that is kept out must not stop the others.
void
MemoryLimit::watch () const
{
  while (!is_ending_) {
    resident_set_->makeRoom (0);
    std::this_thread::sleep_for (resident_set_->timeToSleep ());
  }
}

} // namespace pcl::floater
