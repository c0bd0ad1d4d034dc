// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/report.h>

namespace pcl::floater {
namespace {
// The name of a value of an enumeration that counts from 0.
template <typename Enum, std::size_t N>
const char*
nameOf (const char* const (&names)[N], Enum value)
{
  const auto i = static_cast<std::size_t> (value);
  return i < N ? names[i] : "unknown";
}

} // namespace

const char*
stageName (Stage stage)
{
  static constexpr const char* NAMES[] = {"working set", "neighbors", "stars", "consensus",
                                          "boundary",    "weights",   "solve", "delaunay",
                                          "holes",       "flips",     "check"};
  static_assert (sizeof NAMES / sizeof *NAMES == static_cast<std::size_t> (Stage::COUNT));
  return nameOf (NAMES, stage);
}

const char*
statusName (RunStatus status)
{
  static constexpr const char* NAMES[] = {
      "NOT_RUN",         "SUCCESS",        "NO_INPUT",      "INVALID_OPTION",
      "INVALID_INDICES", "TOO_FEW_POINTS", "DEGENERATE",    "NO_BOUNDARY",
      "INVALID_LOOP",    "UNREACHABLE",    "NOT_A_DISC",    "SINGULAR",
      "NOT_CONVERGED",   "CANCELLED",      "OUT_OF_MEMORY", "INTERNAL_ERROR"};
  static_assert (sizeof NAMES / sizeof *NAMES ==
                 static_cast<std::size_t> (RunStatus::INTERNAL_ERROR) + 1);
  return nameOf (NAMES, status);
}

const char*
facingRuleName (FacingRule rule)
{
  static constexpr const char* NAMES[] = {"closed",  "hollow", "sensor", "body", "sheet",
                                          "normals", "up",     "bulge",  "room"};
  static_assert (sizeof NAMES / sizeof *NAMES == static_cast<std::size_t> (FacingRule::COUNT));
  return nameOf (NAMES, rule);
}

const char*
severityName (Severity severity)
{
  static constexpr const char* NAMES[] = {"note", "doubt", "flaw"};
  return nameOf (NAMES, severity);
}

const char*
qualityName (Quality quality)
{
  static constexpr const char* NAMES[] = {"none", "good", "usable", "poor"};
  return nameOf (NAMES, quality);
}

} // namespace pcl::floater
