// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What process 0 does for the others.
#pragma once

#include "block_steps.h"
#include "messages.h"

#include <deque>
#include <exception>
#include <map>
#include <set>

namespace pcl::floater {
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
  void run (const StepContext& context, const std::string& step, std::deque<std::size_t> blocks);

  /// Ends all other processes, and answers those that still work on something.
  void end (int code);

private:
  // Answers one message, or waits a little. Calls done () if another process has done a block.
  template <typename Done>
  void serve (Done&& done);

  void answerSize (int process, const std::string& name);
  void answerBytes (int process, const Message& wanted);
  void write (int process, const std::string& file);
  ByteSource& source (const std::string& name);

  Processes& processes_;
  FolderStore& folder_;
  std::set<int> idle_;
  std::map<std::string, std::unique_ptr<ByteSource>> sources_;
  int wait_ = 20; // microseconds
};

} // namespace pcl::floater
