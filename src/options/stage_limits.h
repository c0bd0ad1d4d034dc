// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All limits: the parameters of the stages that are no options. Each stage documents its own, with
// their origin.
#pragma once

#include "consensus/consensus_loop.h"
#include "consensus/consensus_method.h"
#include "floater/floater_method.h"
#include "local/stars.h"
#include "local/tangent_planes.h"
#include "mesh/check.h"
#include "mesh/self_intersection_removal.h"
#include "parts/parts.h"
#include "points/gross_outliers.h"
#include "points/noise.h"
#include "points/outliers.h"
#include "view/view_method.h"

namespace pcl::floater {
struct Limits
{
  GrossOutlierLimits gross_outliers;
  OutlierLimits outliers;
  NoiseLimits noise;
  PlaneLimits planes;
  SheetLimits sheets;
  ReachLimits reach;
  SurfaceLimits surface;
  PartLimits parts;
  ViewLimits view;
  LoopLimits loop;
  DiscLimits disc;
  CheckLimits check;
  UncrossingLimits uncrossing;
};

} // namespace pcl::floater
