// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What tools without options of a reconstruction do alike.
#pragma once

#include "atomic_file.h"
#include "cloud.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <new>

namespace pcl::floater {
/// Parses the command line, does the work, and prints what that throws: std::invalid_argument if
/// the command line asks for something impossible, ReadError, WriteError or std::bad_alloc.
/// \return the exit code
template <typename Work>
int
runSmallTool (CLI::App& app, int argc, char** argv, const Work& work)
{
  const auto fail = [&app] (int code, const std::string& message) {
    std::cerr << app.get_name () << ": " << message << "\n";
    return code;
  };
  try {
    app.parse (argc, argv);
    handleSignals ();
    work ();
    return 0;
  }
  catch (const CLI::ParseError& error) {
    return app.exit (error) == 0 ? 0 : 1;
  }
  catch (const std::invalid_argument& error) {
    return fail (1, error.what ());
  }
  catch (const ToolError& error) {
    return fail (error.code, error.what ());
  }
  catch (const std::bad_alloc&) {
    return fail (3, "there is not enough memory");
  }
}

} // namespace pcl::floater
