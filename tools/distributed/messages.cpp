// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

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
Processes::take (int from)
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

Message
Processes::receive (int from)
{
  return take (from);
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
  return std::make_pair (from, take (from));
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
  processes_.send (0, {Topic::OPEN, 0, 0, name});
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

} // namespace pcl::floater
