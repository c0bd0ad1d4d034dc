// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A folder with a cloud in it, for tests of options and reports.
#pragma once

#include "sample.h"
#include "tool_runner.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pcl::floater {
using Json = nlohmann::json;

constexpr int USAGE = 1;
constexpr int INPUT_FAILED = 2;
constexpr int RECONSTRUCTION_FAILED = 3;
constexpr int OUTPUT_FAILED = 4;
constexpr int INTERNAL_ERROR = 5;
constexpr int WARNINGS = 6;

class CommandLineTest : public ToolTest
{
protected:
  CommandLineTest () : sample_ (makeSample (false))
  {
    writeFile ("in.pcd", pcdText (sample_.points));
  }

  Json report (std::vector<std::string> options) const
  {
    options.insert (options.begin (), {"in.pcd", "out.ply", "--report", "out.json"});
    const Outcome outcome = run (options);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return Json::parse (readFile ("out.json"));
  }

  Sample sample_;
};

} // namespace pcl::floater
