// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The part of `join` that is divided: the search for triangles that cross each other.
#pragma once

#include "block_steps.h"
#include "mesh/self_intersections.h"

#include <deque>
#include <exception>
#include <functional>

namespace pcl
{
namespace floater
{
/// What a process is asked to do. Its number counts the blocks of the first search, and then those
/// of the next.
constexpr const char* CROSSING = "crossing";

/// Finds the crossing pairs of the triangles whose smallest points a block owns.
void
crossingStep (const StepContext& context, std::size_t number);

/// Searches in the blocks of a mesh, on all processes. The pairs are those of
/// findSelfIntersections. The mesh is in the work folder while they search. What they find stays
/// there until the run has the last mesh, so that it is not searched again if the run is ended.
class DividedCrossing
{
public:
  /// Has a step done for these numbers.
  using Deal = std::function<void (const std::string& step, std::deque<std::size_t> numbers)>;

  /// \param context, ranges must outlive this \param ranges of the points of the mesh
  DividedCrossing (const StepContext& context, FolderStore& folder, const BlockRanges& ranges,
                   Deal deal)
      : context_ (context), folder_ (folder), ranges_ (ranges), deal_ (std::move (deal))
  {
  }

  /// One search. \param positions of the points
  std::vector<CrossingPair> find (const std::vector<Triangle>& triangles,
                                  const std::vector<Eigen::Vector3d>& positions,
                                  const RunContext& run);

  /// Throws what a search has thrown, whoever caught that.
  void rethrow () const
  {
    if (error_)
      std::rethrow_exception (error_);
  }

private:
  std::vector<CrossingPair> findOnAll (const std::vector<Triangle>& triangles,
                                       const std::vector<Eigen::Vector3d>& positions,
                                       const RunContext& run);
  std::size_t numberOf (std::size_t block) const { return search_ * ranges_.blocks () + block; }
  bool isFinished (std::size_t block, std::uint64_t mesh) const;

  const StepContext& context_;
  FolderStore& folder_;
  const BlockRanges& ranges_;
  Deal deal_;
  std::size_t search_ = 0;
  std::exception_ptr error_;
};

/// Removes what searches have left in the work folder.
void
removeCrossing (const FolderStore& folder, const Plan& plan);

} // namespace floater
} // namespace pcl
