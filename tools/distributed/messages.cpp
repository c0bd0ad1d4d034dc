// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <thread>

namespace pcl::floater {
namespace {
/// Waits longer each time, so that a quick answer comes quickly and a late one costs nothing.
void
waitAgain (int& waits)
{
  constexpr int AT_FIRST = 200, MOST = 300;
  constexpr std::chrono::microseconds STEP{20};
  waits = std::min (waits + 1, MOST);
  if (waits <= AT_FIRST)
    std::this_thread::yield ();
  else
    std::this_thread::sleep_for ((waits - AT_FIRST) * STEP);
}

} // namespace

Processes::Processes ()
{
  int provided = 0;
  MPI_Init_thread (nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank (MPI_COMM_WORLD, &self_);
  MPI_Comm_size (MPI_COMM_WORLD, &count_);
}

Processes::~Processes ()
{
  MPI_Finalize ();
}

void
Processes::pass (bool sends, int other, void* bytes, std::size_t size)
{
  constexpr std::size_t MOST_AT_ONCE = std::size_t{1} << 28U; // MPI counts in 31 bits
  for (std::size_t done = 0; done < size; done += MOST_AT_ONCE) {
    const auto count = static_cast<int> (std::min (MOST_AT_ONCE, size - done));
    MPI_Request request = MPI_REQUEST_NULL;
    if (sends)
      MPI_Isend (static_cast<char*> (bytes) + done, count, MPI_BYTE, other, 0, MPI_COMM_WORLD,
                 &request);
    else
      MPI_Irecv (static_cast<char*> (bytes) + done, count, MPI_BYTE, other, 0, MPI_COMM_WORLD,
                 &request);
    for (int is_done = 0, waits = 0;; waitAgain (waits)) {
      MPI_Test (&request, &is_done, MPI_STATUS_IGNORE);
      if (is_done != 0)
        break;
    }
  }
  exchanged_ += size;
}

void
Processes::send (int to, const Message& message)
{
  std::array<std::uint64_t, 4> head{static_cast<std::uint64_t> (message.topic), message.number,
                                    message.count, message.text.size ()};
  pass (true, to, head.data (), sizeof (head));
  pass (true, to, const_cast<char*> (message.text.data ()), message.text.size ());
}

Message
Processes::receive (int from)
{
  std::array<std::uint64_t, 4> head{};
  pass (false, from, head.data (), sizeof (head));
  Message message{static_cast<Topic> (head[0]), head[1], head[2], std::string (head[3], '\0')};
  pass (false, from, message.text.data (), message.text.size ());
  return message;
}

std::optional<int>
Processes::sender () const
{
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe (MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
  return is_there != 0 ? std::optional (status.MPI_SOURCE) : std::nullopt;
}

ByteSource
RemoteStore::open (const std::string& name)
{
  const auto ask = [this, name] (std::uint64_t offset, std::size_t count) {
    processes_.send (0, {Topic::READ, offset, count, name});
    return processes_.receive (0);
  };
  return {ask (0, 0).number, [name, ask] (std::uint64_t offset, std::size_t count, char* bytes) {
            const std::string text = count > 0 ? ask (offset, count).text : "";
            if (text.size () != count)
              throw WorkError ("process 0 cannot read '" + name + "'");
            std::copy (text.begin (), text.end (), bytes);
          }};
}

void
RemoteStore::put (const std::string& name, const std::function<void (const TakeBytes&)>& emit)
{
  Message message{Topic::PUT, 0, 0, name + "\n"};
  emit ([&message] (std::string_view bytes) { message.text += bytes; });
  processes_.send (0, message);
  processes_.receive (0); // it is on the disk
}

bool
Dealer::serve ()
{
  const std::optional<int> from = processes_.sender ();
  if (!from) {
    waitAgain (waits_);
    return false;
  }
  waits_ = 0;
  const Message message = processes_.receive (*from);
  if (message.topic == Topic::FAIL)
    throw ToolError (static_cast<int> (message.number), message.text);
  if (message.topic == Topic::IDLE)
    idle_.insert (*from);
  else if (message.topic == Topic::READ)
    processes_.send (*from, answerTo (message));
  else if (message.topic == Topic::PUT) {
    // Also if it fails: the other process waits.
    const std::shared_ptr<void> answering (nullptr, [&] (void*) { processes_.send (*from, {}); });
    const std::size_t end = message.text.find ('\n');
    folder_.put (message.text.substr (0, end), [&] (const TakeBytes& take) {
      take (std::string_view (message.text).substr (end + 1));
    });
  }
  return message.topic == Topic::DONE;
}

Message
Dealer::answerTo (const Message& wanted)
{
  constexpr std::size_t MOST_OPEN = 256; // a program may have 1024 files open, mostly
  try {
    auto known = sources_.find (wanted.text);
    if (known == sources_.end ()) {
      if (sources_.size () >= MOST_OPEN)
        sources_.clear ();
      known = sources_.emplace (wanted.text, folder_.open (wanted.text)).first;
    }
    Message answer{Topic::IDLE, known->second.size, 0, std::string (wanted.count, '\0')};
    known->second.read (wanted.number, wanted.count, answer.text.data ());
    return answer;
  }
  catch (const WorkError&) { // of size 0 or too short, which the other process refuses
    return {};
  }
}

void
Dealer::run (const StepContext& context, const Step& step, const std::vector<std::size_t>& blocks)
{
  std::atomic<std::size_t> next{0}, finished{0};
  std::atomic<bool> has_failed{false};
  // Of those that are left, if there are any and nothing has failed.
  const auto take = [&] () -> std::optional<std::size_t> {
    const std::size_t place = has_failed ? blocks.size () : next++;
    return place < blocks.size () ? std::optional (blocks[place]) : std::nullopt;
  };
  std::future<void> own = std::async (std::launch::async, [&] {
    try {
      for (auto block = take (); block; block = take (), ++finished)
        step.of_block (context, *block);
    }
    catch (...) {
      has_failed = true;
      throw;
    }
  });
  try {
    while (finished < blocks.size () && !has_failed) {
      for (std::optional<std::size_t> block; !idle_.empty () && (block = take ());
           idle_.erase (idle_.begin ()))
        processes_.send (*idle_.begin (), {Topic::WORK, *block, 0, step.name});
      finished += serve () ? 1 : 0;
    }
  }
  catch (...) {
    has_failed = true; // ends the own thread
    throw;
  }
  sources_.clear (); // a file that is removed takes room until it is closed
  own.get ();
}

void
Dealer::end (int code)
{
  for (int left = processes_.count () - 1; left > 0;) {
    for (const int process : idle_)
      processes_.send (process, {Topic::END, static_cast<std::uint64_t> (code), 0, {}});
    left -= static_cast<int> (idle_.size ());
    idle_.clear ();
    try {
      if (left > 0)
        serve ();
    }
    catch (
        const std::exception&) { // the first failure has been told; or what it wanted is not there
    }
  }
}

} // namespace pcl::floater
