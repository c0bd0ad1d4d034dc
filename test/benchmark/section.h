// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A part of the benchmark's report.
#pragma once

#include "disc_stages.h"
#include "report_folder.h"

#include <filesystem>
#include <memory>

namespace pcl
{
namespace floater
{
/// A cloud that all sections measure.
struct Sample
{
  std::filesystem::path path;
  Cloud cloud;
  DiscStages disc;
  std::vector<Eigen::Vector2d> direct; ///< parameters by UMFPACK; per point
};

/// How measurements are taken.
struct Settings
{
  int threads = 1; ///< of our stages; GMM++ and SuperLU have one
  int repeats = 3; ///< the shortest time of so many runs is taken
};

/// One table or figure: measures one cloud after the other, then writes its part of the report.
class Section
{
public:
  virtual ~Section () = default;

  virtual void measure (const Sample& sample) = 0;

  virtual void write (ReportFolder& report) const = 0;
};

std::unique_ptr<Section>
makeMemoryTable ();

std::unique_ptr<Section>
makeFillTable ();

/// Table 3, and Figure 5 of the same figures.
std::unique_ptr<Section>
makeTimesTable (const Settings& settings);

std::unique_ptr<Section>
makeSparsityFigure ();

std::unique_ptr<Section>
makeMeshFigure ();

std::unique_ptr<Section>
makeResidualTable ();

std::unique_ptr<Section>
makeQualityTable (const Settings& settings);

} // namespace floater
} // namespace pcl
