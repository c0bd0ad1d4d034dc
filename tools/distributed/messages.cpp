// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

namespace pcl::floater {
namespace {
constexpr int HEAD_TAG = 1, TEXT_TAG = 2;
constexpr std::size_t MOST_AT_ONCE = std::size_t{1} << 28U; // bytes; MPI counts in 31 bits
constexpr std::size_t HEAD = 4;                             // numbers

// Sleeps longer and longer, so that a quick answer comes quickly and a late one costs nothing.
class Patience
{
public:
  void wait ()
  {
    constexpr int AT_FIRST = 200;
    constexpr std::chrono::microseconds LONGEST{2000};
    if (++waits_ <= AT_FIRST) {
      std::this_thread::yield ();
      return;
    }
    std::this_thread::sleep_for (sleep_);
    sleep_ = std::min (2 * sleep_, LONGEST);
  }

private:
  int waits_ = 0;
  std::chrono::microseconds sleep_{20};
};

void
waitFor (MPI_Request& request)
{
  Patience patience;
  for (int is_done = 0;;) {
    MPI_Test (&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done != 0)
      return;
    patience.wait ();
  }
}

} // namespace

Processes::Processes (int& argc, char**& argv)
{
  int provided = 0;
  MPI_Init_thread (&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank (MPI_COMM_WORLD, &self_);
  MPI_Comm_size (MPI_COMM_WORLD, &count_);
}

Processes::~Processes ()
{
  MPI_Finalize ();
}

void
Processes::send (int to, const Message& message)
{
  std::array<std::uint64_t, HEAD> head{static_cast<std::uint64_t> (message.topic), message.number,
                                       message.count, message.text.size ()};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend (head.data (), HEAD, MPI_UINT64_T, to, HEAD_TAG, MPI_COMM_WORLD, &request);
  waitFor (request);
  for (std::size_t done = 0; done < message.text.size (); done += MOST_AT_ONCE) {
    const std::size_t count = std::min (MOST_AT_ONCE, message.text.size () - done);
    MPI_Isend (message.text.data () + done, static_cast<int> (count), MPI_BYTE, to, TEXT_TAG,
               MPI_COMM_WORLD, &request);
    waitFor (request);
  }
  exchanged_ += sizeof (head) + message.text.size ();
}

Message
Processes::receive (int from)
{
  std::array<std::uint64_t, HEAD> head{};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Irecv (head.data (), HEAD, MPI_UINT64_T, from, HEAD_TAG, MPI_COMM_WORLD, &request);
  waitFor (request);
  Message message{static_cast<Topic> (head[0]), head[1], head[2], std::string (head[3], '\0')};
  for (std::size_t done = 0; done < message.text.size (); done += MOST_AT_ONCE) {
    const std::size_t count = std::min (MOST_AT_ONCE, message.text.size () - done);
    MPI_Irecv (message.text.data () + done, static_cast<int> (count), MPI_BYTE, from, TEXT_TAG,
               MPI_COMM_WORLD, &request);
    waitFor (request);
  }
  exchanged_ += sizeof (head) + message.text.size ();
  return message;
}

std::optional<std::pair<int, Message>>
Processes::poll ()
{
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe (MPI_ANY_SOURCE, HEAD_TAG, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0)
    return {};
  const int from = status.MPI_SOURCE;
  return std::make_pair (from, receive (from));
}

namespace {
class RemoteFile : public ByteSource
{
public:
  RemoteFile (Processes& processes, std::string name, std::uint64_t size)
      : processes_ (processes), name_ (std::move (name)), size_ (size)
  {
  }

  std::uint64_t size () const override { return size_; }

  void read (std::uint64_t offset, std::size_t count, char* bytes) override
  {
    if (count == 0)
      return;
    processes_.send (0, {Topic::READ, offset, count, name_});
    const Message answer = processes_.receive (0);
    if (answer.text.size () != count)
      throw WorkError ("process 0 cannot read '" + name_ + "'");
    std::copy (answer.text.begin (), answer.text.end (), bytes);
  }

private:
  Processes& processes_;
  std::string name_;
  std::uint64_t size_;
};
} // namespace

std::unique_ptr<ByteSource>
RemoteStore::open (const std::string& name)
{
  processes_.send (0, {Topic::READ, 0, 0, name}); // no bytes, only the size
  const Message answer = processes_.receive (0);
  return std::make_unique<RemoteFile> (processes_, name, answer.number);
}

void
RemoteStore::put (const std::string& name, const ArrayWriter& arrays, std::uint64_t plan)
{
  Message message{Topic::PUT, 0, 0, name + "\n"};
  arrays.emit (plan, [&message] (const char* bytes, std::size_t count) {
    message.text.append (bytes, count);
  });
  processes_.send (0, message);
  processes_.receive (0); // it is on the disk
}

namespace {
// The blocks of a step that are still to be done, for several takers.
class Queue
{
public:
  explicit Queue (std::deque<std::size_t> blocks)
      : blocks_ (std::move (blocks)), open_ (blocks_.size ())
  {
  }

  std::optional<std::size_t> take ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    if (blocks_.empty () || error_)
      return {};
    const std::size_t block = blocks_.front ();
    blocks_.pop_front ();
    return block;
  }

  void finish ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    --open_;
  }

  void fail (std::exception_ptr error)
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    if (!error_)
      error_ = std::move (error);
  }

  // Whether all blocks are finished. Throws what a taker has thrown.
  bool isDone ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    if (error_)
      std::rethrow_exception (error_);
    return open_ == 0;
  }

private:
  std::mutex mutex_;
  std::deque<std::size_t> blocks_;
  std::size_t open_; // those that are not finished
  std::exception_ptr error_;
};

} // namespace

template <typename Done>
void
Dealer::serve (Done&& done)
{
  constexpr int SHORTEST = 20, LONGEST = 1000; // microseconds
  const auto received = processes_.poll ();
  if (!received) {
    std::this_thread::sleep_for (std::chrono::microseconds (wait_));
    wait_ = std::min (2 * wait_, LONGEST);
    return;
  }
  wait_ = SHORTEST;
  const auto& [from, message] = *received;
  switch (message.topic) {
  case Topic::IDLE:
    idle_.insert (from);
    break;
  case Topic::DONE:
    done ();
    break;
  case Topic::FAIL:
    throw RemoteFailure (static_cast<int> (message.number), message.text);
  case Topic::READ:
    processes_.send (from, answerTo (message));
    break;
  case Topic::PUT:
    write (from, message.text);
    break;
  case Topic::WORK:
  case Topic::END:
    break; // only this process sends these
  }
}

Message
Dealer::answerTo (const Message& wanted)
{
  Message answer;
  try {
    ByteSource& file = source (wanted.text);
    answer.number = file.size ();
    answer.text.resize (wanted.count);
    file.read (wanted.number, wanted.count, answer.text.data ());
  }
  catch (const WorkError&) { // of size 0 or too short, which the other process refuses
    answer = {};
  }
  return answer;
}

void
Dealer::write (int process, const std::string& file)
{
  std::exception_ptr error;
  try {
    const std::size_t end = file.find ('\n');
    folder_.putBytes (file.substr (0, end), file.data () + end + 1, file.size () - end - 1);
  }
  catch (...) {
    error = std::current_exception ();
  }
  processes_.send (process, {});
  if (error)
    std::rethrow_exception (error);
}

ByteSource&
Dealer::source (const std::string& name)
{
  constexpr std::size_t MOST_OPEN = 256; // a program may have 1024 files open, mostly
  if (sources_.size () >= MOST_OPEN)
    sources_.clear ();
  std::unique_ptr<ByteSource>& known = sources_[name];
  if (!known)
    known = folder_.open (name);
  return *known;
}

void
Dealer::run (const StepContext& context, const Step& step, std::deque<std::size_t> blocks)
{
  Queue queue (std::move (blocks));
  std::thread own ([&] {
    try {
      while (const std::optional<std::size_t> block = queue.take ()) {
        step.of_block (context, *block);
        queue.finish ();
      }
    }
    catch (...) {
      queue.fail (std::current_exception ());
    }
  });
  std::exception_ptr error;
  try {
    while (!queue.isDone ()) {
      while (!idle_.empty ())
        if (const std::optional<std::size_t> block = queue.take ()) {
          processes_.send (*idle_.begin (), {Topic::WORK, *block, 0, step.name});
          idle_.erase (idle_.begin ());
        }
        else
          break;
      serve ([&queue] { queue.finish (); });
    }
  }
  catch (...) {
    error = std::current_exception ();
    queue.fail (error); // ends the own thread
  }
  own.join ();
  sources_.clear (); // a file that is removed takes room until it is closed
  if (error)
    std::rethrow_exception (error);
}

void
Dealer::end (int code)
{
  std::size_t ended = 0;
  while (ended + 1 < static_cast<std::size_t> (processes_.count ())) {
    for (const int process : idle_) {
      processes_.send (process, {Topic::END, static_cast<std::uint64_t> (code), 0, {}});
      ++ended;
    }
    idle_.clear ();
    try {
      serve ([] {});
    }
    catch (const RemoteFailure&) { // the first one has been told
    }
    catch (const std::exception&) { // what it wanted is not there
    }
  }
}

} // namespace pcl::floater
