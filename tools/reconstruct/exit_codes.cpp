// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exit_codes.h"

#include "atomic_file.h"
#include "large_arrays.h"
#include "read_error.h"

#include <cstdio>
#include <new>

namespace pcl::floater {
int
fail (const char* program, int code, const std::string& message)
{
  std::fprintf (stderr, "%s: %s\n", program, message.c_str ());
  return code;
}

int
failByException (const char* program, const char* if_no_memory)
{
  try {
    throw;
  }
  catch (const UsageError& error) {
    return fail (program, EXIT_USAGE, std::string (error.what ()) + "\nTry --help.");
  }
  catch (const ReadError& error) {
    return fail (program, EXIT_INPUT, error.what ());
  }
  catch (const WriteError& error) {
    return fail (program, EXIT_OUTPUT, error.what ());
  }
  catch (const std::bad_alloc&) {
    const std::string failure = largeArrayFailure ();
    if (!failure.empty ())
      return fail (program, EXIT_INTERNAL, failure);
    std::fprintf (stderr, "%s: not enough memory; %s\n", program, if_no_memory);
    return EXIT_INTERNAL;
  }
  catch (const std::exception& error) {
    return fail (program, EXIT_INTERNAL, std::string ("unexpected error: ") + error.what ());
  }
}

} // namespace pcl::floater
