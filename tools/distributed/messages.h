// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What processes tell each other. All calls of MPI are here. Waiting takes no processor time.
#pragma once

#include "store.h"

#include <cstdint>
#include <optional>
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
  OPEN, ///< to process 0: how long is the file named in the text? The answer's `number` tells
  READ, ///< to process 0: `count` bytes of that file from `number`; the answer's text has them
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
  Message take (int from);

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

} // namespace pcl::floater
