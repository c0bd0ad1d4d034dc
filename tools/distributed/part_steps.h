// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a large cloud, as they are meshed and finished by whichever process has time. Parts
// depend on the number of points only, not on the blocks.
#pragma once

#include "block_steps.h"
#include "heap_reuse.h"
#include "part_files.h"
#include "parts/parts_method.h"

#include <deque>
#include <functional>
#include <vector>

namespace pcl::floater {
/// The step after those of the blocks: it is done for each part, if there are several.
constexpr const char* MESH = "mesh";

/// What is done of each part when `join` has stitched them together, within it or as a step.
constexpr const char* FINISH = "finish";

/// The parts of the points without outliers.
Parts
partsOf (const StepContext& context);

/// Meshes a part, and writes the mesh and its rim.
void
meshStep (const StepContext& context, std::size_t part);

/// Finishes a part, with what `join` has decided.
void
finishStep (const StepContext& context, std::size_t part);

/// Whether the part is finished, with what was decided last.
bool
isPartFinished (const StepContext& context, const FolderStore& folder, std::size_t part);

/// Of what `join` makes use.
struct JoinHelp
{
  /// Has a step done for these numbers.
  using Deal = std::function<void (const std::string& step, std::deque<std::size_t> numbers)>;

  Deal finish; ///< has parts finished by all processes; empty: by the threads of the run
  const MemoryLimit* limit = nullptr; ///< of the memory of this process; nullptr: there is none
};

/// The parts, for makeSurfaceOfParts. As long as this lives, memory is used again: what is known of
/// all parts together is small.
class StoredParts : public PartWork
{
public:
  /// \param context, folder must outlive this
  /// \param help     see JoinHelp
  StoredParts (const StepContext& context, FolderStore& folder, const PartsSettings& settings,
               const JoinHelp& help)
      : context_ (context), folder_ (folder), settings_ (settings), deal_ (help.finish),
        reuse_ (help.limit), parts_ (partsOf (context))
  {
  }

  PartRim rim (std::size_t part, std::size_t rings) override;
  void finish (std::vector<PartChange> changes, const RunContext& run) override;
  FinishedPart finished (std::size_t part) override;
  std::vector<Eigen::AlignedBox3d> buckets (std::size_t part) override;
  std::vector<Triangle> triangles (std::size_t part, const Ranges& ranges) override;
  PointValues valuesOf (const std::vector<Index>& points) override;

private:
  PartOfPoints pointsOf (std::size_t part) const
  {
    return {parts_.first (part), parts_.last (part), parts_.last (parts_.count () - 1)};
  }

  const StepContext& context_;
  FolderStore& folder_;
  PartsSettings settings_;
  JoinHelp::Deal deal_;
  HeapReuse reuse_;
  Parts parts_;
};

/// Removes what parts have left in the work folder when the mesh is known.
/// \param with_triangles whether the mesh is not made of what the parts have
void
removeFinished (const FolderStore& folder, const Plan& plan, bool with_triangles);

} // namespace pcl::floater
