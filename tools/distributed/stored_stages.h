// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the blocks have found out, as reconstruct () takes it.
#pragma once

#include "block_steps.h"
#include "known_stages.h"
#include "part_steps.h"

#include <optional>
#include <utility>

namespace pcl::floater {
/// Reads the files of all blocks, each when it is needed.
class StoredStages : public KnownStages
{
public:
  /// \param context must outlive this
  /// \param freed   where the files of a step are removed when all of it that is needed has been
  ///                read; nullptr: they stay, as they do of a cloud that has several parts
  /// \param folder  for what the parts write
  StoredStages (const StepContext& context, FolderStore& folder,
                const FolderStore* freed = nullptr);

  Points points (Report& report) override;
  std::vector<Index> outliers () override { return outliers_; }
  CsrLists neighborsOf (const std::vector<Index>& points) override;
  LocalPlanes planes () override;
  std::vector<AreaSample> areaSamples () override;
  NoiseProbes noiseProbes () override;
  LocalGeometry geometry (LocalPlanes planes, bool with_stars) override;
  std::vector<float> spacing () override;
  std::unique_ptr<PartWork> parts (const PartsSettings& settings) override;
  ProposedTriangles triangles () override;
  void keepMesh (MeshOfParts mesh) override { mesh_ = std::move (mesh); }

  /// The mesh, if it is in parts.
  std::optional<MeshOfParts> takeMesh () { return std::move (mesh_); }

  /// For the parts.
  void setHelp (JoinHelp help) { help_ = std::move (help); }

private:
  // Calls visit (file of a step, block) for all blocks.
  template <typename Visit>
  void forEachBlock (const char* step, Visit&& visit);

  void remove (const char* step) const;

  const StepContext& context_;
  FolderStore& folder_;
  const FolderStore* freed_;
  JoinHelp help_;
  std::optional<MeshOfParts> mesh_;
  std::vector<Index> outliers_;
  BlockRanges ranges_;  // without outliers
  std::size_t own_ = 0; // points of the block that is visited
};

} // namespace pcl::floater
