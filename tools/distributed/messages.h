// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What processes tell each other. All calls of MPI are here. Waiting takes no processor time.
#pragma once

#include "job.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace pcl::floater {
/// What a message is about. The first three are to process 0, which answers each.
enum class Topic : std::uint32_t
{
  NEXT, ///< what next? `count` blocks were tried, with the exit code `number` and the message of it
        ///< in the text
  READ, ///< `count` bytes from `number` of the file named in the text. The answer's text has them,
        ///< and its `number` is the size of the file
  PUT,  ///< the text is a file, after its name and a line feed
  WORK, ///< do the block `number` of the step in the text
  END   ///< end with the exit code `number`
};

struct Message
{
  Topic topic = Topic::NEXT;
  std::uint64_t number = 0, count = 0;
  std::string text{};
};

/// Waits longer each time, so that a quick answer comes quickly and a late one costs nothing.
inline void
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

class Processes
{
public:
  /// Calls MPI_Init. Threads that call no function of this may run.
  Processes ()
  {
    int provided = 0;
    MPI_Init_thread (nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank (MPI_COMM_WORLD, &self_);
    MPI_Comm_size (MPI_COMM_WORLD, &count_);
  }
  ~Processes () { MPI_Finalize (); }
  Processes (const Processes&) = delete;
  Processes& operator= (const Processes&) = delete;

  int self () const { return self_; } ///< 0 to count () - 1
  int count () const { return count_; }

  void send (int to, const Message& message)
  {
    std::array<std::uint64_t, 4> head{static_cast<std::uint64_t> (message.topic), message.number,
                                      message.count, message.text.size ()};
    pass (true, to, head.data (), sizeof (head));
    pass (true, to, const_cast<char*> (message.text.data ()), message.text.size ());
  }

  Message receive (int from)
  {
    std::array<std::uint64_t, 4> head{};
    pass (false, from, head.data (), sizeof (head));
    Message message{static_cast<Topic> (head[0]), head[1], head[2], std::string (head[3], '\0')};
    pass (false, from, message.text.data (), message.text.size ());
    return message;
  }

  /// Asks process 0.
  Message ask (const Message& message)
  {
    send (0, message);
    return receive (0);
  }

  /// The process of which a message is there, if there is one.
  std::optional<int> sender () const
  {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe (MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
    return is_there != 0 ? std::optional (status.MPI_SOURCE) : std::nullopt;
  }

  /// Bytes of all messages that this process has sent and received.
  std::uint64_t exchangedBytes () const { return exchanged_; }

private:
  void pass (bool sends, int other, void* bytes, std::size_t size)
  {
    constexpr std::size_t MOST_AT_ONCE = std::size_t{1} << 28U; // MPI counts in 31 bits
    for (std::size_t done = 0; done < size; done += MOST_AT_ONCE) {
      char* const at = static_cast<char*> (bytes) + done;
      const auto count = static_cast<int> (std::min (MOST_AT_ONCE, size - done));
      MPI_Request request = MPI_REQUEST_NULL;
      if (sends)
        MPI_Isend (at, count, MPI_BYTE, other, 0, MPI_COMM_WORLD, &request);
      else
        MPI_Irecv (at, count, MPI_BYTE, other, 0, MPI_COMM_WORLD, &request);
      for (int is_done = 0, waits = 0;; waitAgain (waits)) {
        MPI_Test (&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done != 0)
          break;
      }
    }
    exchanged_ += size;
  }

  int self_ = 0, count_ = 1;
  std::uint64_t exchanged_ = 0;
};

/// The files are with process 0, which has to answer.
class RemoteStore : public Store
{
public:
  explicit RemoteStore (Processes& processes) : processes_ (processes) {}

  std::string describe (const std::string& name) const override { return name + " of process 0"; }

  ByteSource open (const std::string& name) override
  {
    const auto read = [this, name] (std::uint64_t offset, std::size_t count, char* bytes) {
      const std::string text =
          count > 0 ? processes_.ask ({Topic::READ, offset, count, name}).text : "";
      if (text.size () != count)
        throw WorkError ("process 0 cannot read '" + name + "'");
      std::copy (text.begin (), text.end (), bytes);
    };
    return {processes_.ask ({Topic::READ, 0, 0, name}).number, read};
  }

  void put (const std::string& name, const std::function<void (const TakeBytes&)>& emit) override
  {
    Message message{Topic::PUT, 0, 0, name + "\n"};
    emit ([&message] (std::string_view bytes) { message.text += bytes; });
    processes_.ask (message); // then it is on the disk
  }

private:
  Processes& processes_;
};

/// Process 0 of several. It has two threads: one answers the others, one works on blocks.
class Dealer
{
public:
  Dealer (Processes& processes, FolderStore& folder) : processes_ (processes), folder_ (folder) {}

  /// Deals out the blocks of a step, and works on some.
  /// \throws what another process has told as its failure, or a block of its own has thrown
  void run (const StepContext& context, const Step& step, const std::vector<std::size_t>& blocks)
  {
    std::atomic<std::size_t> next{0}, finished{0};
    std::atomic<bool> has_failed{false};
    // Of those that are left, if there are any and nothing has failed.
    const auto take = [&] () -> std::optional<std::size_t> {
      const std::size_t place = has_failed ? blocks.size () : next++;
      return place < blocks.size () ? std::optional (blocks[place]) : std::nullopt;
    };
    // Ends all if it throws.
    const auto guard = [&has_failed] (const auto& work) {
      try {
        work ();
      }
      catch (...) {
        has_failed = true;
        throw;
      }
    };
    std::future<void> own = std::async (std::launch::async, guard, [&] {
      for (auto block = take (); block; block = take (), ++finished)
        step.of_block (context, *block);
    });
    guard ([&] {
      while (finished < blocks.size () && !has_failed) {
        for (std::optional<std::size_t> block; !idle_.empty () && (block = take ());
             idle_.erase (idle_.begin ()))
          processes_.send (*idle_.begin (), {Topic::WORK, *block, 0, step.name});
        finished += serve ();
      }
    });
    own.get ();
  }

  /// Ends all other processes, and answers those that still work on something.
  void end (int code)
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
      catch (const std::exception&) { // the first failure has been told; or a file is not there
      }
    }
  }

private:
  // Answers one message, or waits a little. Returns how many blocks it tells to be done.
  std::size_t serve ()
  {
    const std::optional<int> from = processes_.sender ();
    if (!from) {
      waitAgain (waits_);
      return 0;
    }
    waits_ = 0;
    const Message message = processes_.receive (*from);
    if (message.topic == Topic::NEXT)
      idle_.insert (*from);
    if (message.topic == Topic::NEXT && message.number != EXIT_OK)
      throw ToolError (static_cast<int> (message.number), message.text);
    if (message.topic == Topic::READ)
      processes_.send (*from, answerTo (message));
    else if (message.topic == Topic::PUT) {
      // Also if it fails: the other process waits.
      const std::shared_ptr<void> answering (nullptr, [&] (void*) { processes_.send (*from, {}); });
      const std::size_t end = message.text.find ('\n');
      folder_.put (message.text.substr (0, end), [&] (const TakeBytes& take) {
        take (std::string_view (message.text).substr (end + 1));
      });
    }
    return message.topic == Topic::NEXT ? message.count : 0;
  }

  Message answerTo (const Message& wanted)
  {
    try {
      const ByteSource source = folder_.open (wanted.text);
      Message answer{Topic::READ, source.size, 0, std::string (wanted.count, '\0')};
      source.read (wanted.number, wanted.count, answer.text.data ());
      return answer;
    }
    catch (const WorkError&) { // of size 0 or too short, which the other process refuses
      return {};
    }
  }

  Processes& processes_;
  FolderStore& folder_;
  std::set<int> idle_;
  int waits_ = 0; // since the last message
};

} // namespace pcl::floater
