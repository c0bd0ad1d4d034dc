// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What processes tell each other. All calls of MPI are here. Waiting takes no processor time.
#pragma once

#include "block_steps.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
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

class Processes
{
public:
  /// Calls MPI_Init. Threads that call no function of this may run.
  Processes ();
  ~Processes (); ///< calls MPI_Finalize
  Processes (const Processes&) = delete;
  Processes& operator= (const Processes&) = delete;

  int self () const { return self_; } ///< 0 to count () - 1
  int count () const { return count_; }

  void send (int to, const Message& message);

  Message receive (int from);

  /// The process of which a message is there, if there is one.
  std::optional<int> sender () const;

  /// Bytes of all messages that this process has sent and received.
  std::uint64_t exchangedBytes () const { return exchanged_; }

private:
  void pass (bool sends, int other, void* bytes, std::size_t size);

  int self_ = 0, count_ = 1;
  std::uint64_t exchanged_ = 0;
};

/// The files are with process 0, which has to answer.
class RemoteStore : public Store
{
public:
  explicit RemoteStore (Processes& processes) : processes_ (processes) {}

  std::string describe (const std::string& name) const override { return name + " of process 0"; }
  ByteSource open (const std::string& name) override;
  void put (const std::string& name, const std::function<void (const TakeBytes&)>& emit) override;

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
  void run (const StepContext& context, const Step& step, const std::vector<std::size_t>& blocks);

  /// Ends all other processes, and answers those that still work on something.
  void end (int code);

private:
  // Answers one message, or waits a little. Returns whether another process has done a block.
  bool serve ();

  Message answerTo (const Message& wanted);

  Processes& processes_;
  FolderStore& folder_;
  std::set<int> idle_;
  std::map<std::string, ByteSource> sources_;
  int waits_ = 0; // since the last message
};

} // namespace pcl::floater
