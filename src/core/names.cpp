// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/report.h>

namespace pcl::floater {
const char*
stageName (Stage stage)
{
  switch (stage) {
  case Stage::WORKING_SET:
    return "working set";
  case Stage::NEIGHBORS:
    return "neighbors";
  case Stage::STARS:
    return "stars";
  case Stage::CONSENSUS:
    return "consensus";
  case Stage::BOUNDARY:
    return "boundary";
  case Stage::WEIGHTS:
    return "weights";
  case Stage::SOLVE:
    return "solve";
  case Stage::DELAUNAY:
    return "delaunay";
  case Stage::HOLES:
    return "holes";
  case Stage::FLIPS:
    return "flips";
  case Stage::CHECK:
    return "check";
  case Stage::COUNT:
    break;
  }
  return "unknown";
}

const char*
statusName (RunStatus status)
{
  switch (status) {
  case RunStatus::NOT_RUN:
    return "NOT_RUN";
  case RunStatus::SUCCESS:
    return "SUCCESS";
  case RunStatus::NO_INPUT:
    return "NO_INPUT";
  case RunStatus::INVALID_OPTION:
    return "INVALID_OPTION";
  case RunStatus::INVALID_INDICES:
    return "INVALID_INDICES";
  case RunStatus::TOO_FEW_POINTS:
    return "TOO_FEW_POINTS";
  case RunStatus::DEGENERATE:
    return "DEGENERATE";
  case RunStatus::NO_BOUNDARY:
    return "NO_BOUNDARY";
  case RunStatus::INVALID_LOOP:
    return "INVALID_LOOP";
  case RunStatus::UNREACHABLE:
    return "UNREACHABLE";
  case RunStatus::NOT_A_DISC:
    return "NOT_A_DISC";
  case RunStatus::SINGULAR:
    return "SINGULAR";
  case RunStatus::NOT_CONVERGED:
    return "NOT_CONVERGED";
  case RunStatus::SOLVER_UNAVAILABLE:
    return "SOLVER_UNAVAILABLE";
  case RunStatus::CANCELLED:
    return "CANCELLED";
  case RunStatus::OUT_OF_MEMORY:
    return "OUT_OF_MEMORY";
  case RunStatus::INTERNAL_ERROR:
    return "INTERNAL_ERROR";
  }
  return "UNKNOWN";
}

const char*
facingRuleName (FacingRule rule)
{
  switch (rule) {
  case FacingRule::CLOSED:
    return "closed";
  case FacingRule::HOLLOW:
    return "hollow";
  case FacingRule::SENSOR:
    return "sensor";
  case FacingRule::BODY:
    return "body";
  case FacingRule::SHEET:
    return "sheet";
  case FacingRule::NORMALS:
    return "normals";
  case FacingRule::UP:
    return "up";
  case FacingRule::BULGE:
    return "bulge";
  case FacingRule::COUNT:
    break;
  }
  return "unknown";
}

} // namespace pcl::floater
