// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dealer.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

namespace pcl::floater {
namespace {
// The blocks of a step that are still to be done, for several takers.
class Queue
{
public:
  void fill (std::deque<std::size_t> blocks)
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    blocks_ = std::move (blocks);
    open_ = blocks_.size ();
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
  std::size_t open_ = 0; // those that are not finished
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
  case Topic::OPEN:
    answerSize (from, message.text);
    break;
  case Topic::READ:
    answerBytes (from, message);
    break;
  case Topic::PUT:
    write (from, message.text);
    break;
  case Topic::WORK:
  case Topic::END:
    break; // only this process sends these
  }
}

void
Dealer::answerSize (int process, const std::string& name)
{
  Message answer;
  try {
    answer.number = source (name).size ();
  }
  catch (const WorkError&) { // of size 0, which the other process refuses
  }
  processes_.send (process, answer);
}

void
Dealer::answerBytes (int process, const Message& wanted)
{
  Message answer;
  try {
    answer.text.resize (wanted.count);
    source (wanted.text).read (wanted.number, wanted.count, answer.text.data ());
  }
  catch (const WorkError&) {
    answer.text.clear (); // too short, which the other process refuses
  }
  processes_.send (process, answer);
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
Dealer::run (const StepContext& context, const std::string& step, std::deque<std::size_t> blocks)
{
  Queue queue;
  queue.fill (std::move (blocks));
  std::thread own ([&] {
    try {
      while (const std::optional<std::size_t> block = queue.take ()) {
        blockStep (context, step, *block);
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
          processes_.send (*idle_.begin (), {Topic::WORK, *block, 0, step});
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
