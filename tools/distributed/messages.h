// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What processes tell each other. All calls of MPI are here. Waiting takes no processor time.
#pragma once

#include "block_steps.h"
#include "store.h"

#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
/// What a message is about.
enum class Topic : std::uint32_t
{
  IDLE, ///< to process 0: what next?
  DONE, ///< to process 0: the block of the step is finished
  FAIL, ///< to process 0: `number` is an exit code, the text a message
  READ, ///< to process 0: `count` bytes from `number` of the file named in the text. The answer's
        ///< text has them, and its `number` is the size of the file
  PUT,  ///< to process 0: the text is a file, after its name and a line feed
  WORK, ///< to another process: do the block `number` of the step in the text
  END   ///< to another process: end with the exit code `number`
};

struct Message
{
  Topic topic = Topic::IDLE;
  std::uint64_t number = 0, count = 0;
  std::string text{};
};

/// The processes of MPI_COMM_WORLD.
class Processes
{
public:
  /// Calls MPI_Init. Threads that call no function of this may run.
  Processes (int& argc, char**& argv);
  ~Processes (); ///< calls MPI_Finalize
  Processes (const Processes&) = delete;
  Processes& operator= (const Processes&) = delete;
  Processes (Processes&&) = delete;
  Processes& operator= (Processes&&) = delete;

  int self () const { return self_; } ///< 0 to count () - 1
  int count () const { return count_; }

  void send (int to, const Message& message);

  /// Waits for a message of a process.
  Message receive (int from);

  /// A message of any process and who has sent it, if there is one.
  std::optional<std::pair<int, Message>> poll ();

  /// Bytes of all messages that this process has sent and received.
  std::uint64_t exchangedBytes () const { return exchanged_; }

private:
  int self_ = 0, count_ = 1;
  std::uint64_t exchanged_ = 0;
};

/// The files are with process 0, which has to answer.
class RemoteStore : public Store
{
public:
  explicit RemoteStore (Processes& processes) : processes_ (processes) {}

  std::string describe (const std::string& name) const override { return name + " of process 0"; }
  std::unique_ptr<ByteSource> open (const std::string& name) override;
  void put (const std::string& name, const ArrayWriter& arrays, std::uint64_t plan) override;

private:
  Processes& processes_;
};

/// Another process has failed, and has told why.
class RemoteFailure : public std::exception
{
public:
  RemoteFailure (int code, std::string message) : code_ (code), message_ (std::move (message)) {}

  int code () const { return code_; }
  const char* what () const noexcept override { return message_.c_str (); }

private:
  int code_;
  std::string message_;
};

/// Process 0 of several. It has two threads: one answers the others, one works on blocks.
class Dealer
{
public:
  Dealer (Processes& processes, FolderStore& folder) : processes_ (processes), folder_ (folder) {}

  int processes () const { return processes_.count (); }

  /// Deals out the blocks of a step, and works on some.
  /// \throws RemoteFailure, and whatever a block of its own throws
  void run (const StepContext& context, const Step& step, std::deque<std::size_t> blocks);

  /// Ends all other processes, and answers those that still work on something.
  void end (int code);

private:
  // Answers one message, or waits a little. Calls done () if another process has done a block.
  template <typename Done>
  void serve (Done&& done);

  Message answerTo (const Message& wanted);
  void write (int process, const std::string& file);
  ByteSource& source (const std::string& name);

  Processes& processes_;
  FolderStore& folder_;
  std::set<int> idle_;
  std::map<std::string, std::unique_ptr<ByteSource>> sources_;
  int wait_ = 20; // microseconds
};

} // namespace pcl::floater
