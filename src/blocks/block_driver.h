// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks worked on one after the other, at the same time, or elsewhere, and put together.
#pragma once

#include "blocks/block_surface.h"

#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
/// Of every point of the cloud; see BlockSurface.
struct CloudSurface
{
  FlatLists near;
  std::vector<float> spacing;
  std::vector<Eigen::Vector3f> normals, crease;
  std::vector<CandidateLists> candidates; ///< of each block, in order
};

/// Who works on the blocks. Ours are threads; others may send a block to a process or a machine,
/// since it holds all that the step needs.
class BlockDriver
{
public:
  using Cut = std::function<PointBlock (std::size_t, const std::vector<Ball>&)>;
  using Step = std::function<BlockSurface (const PointBlock&)>;
  using Join = std::function<void (std::size_t, BlockSurface)>;

  virtual ~BlockDriver () = default;

  /// Hands the surface of every block to `join`, in any order. All three may be called by several
  /// threads at once, `join` once for each block. Where a surface tells of balls that are missing,
  /// the block is to be cut and worked on again with all of them so far: see surfaceOf.
  virtual void run (std::size_t blocks, const Cut& cut, const Step& step, const Join& join) = 0;

protected:
  /// Cuts a block and works on it until nothing is missing.
  static BlockSurface surfaceOf (std::size_t block, const Cut& cut, const Step& step);
};

/// As many blocks at the same time as there are threads.
class ThreadDriver : public BlockDriver
{
public:
  explicit ThreadDriver (int threads) : threads_ (threads) {}
  void run (std::size_t blocks, const Cut& cut, const Step& step, const Join& join) override;

private:
  int threads_;
};

/// How many blocks a cloud is worth: one up to 262144 points, else of at most 131072 points each
/// and the same number for every thread. \param wanted 0: choose
std::size_t
chooseBlocks (std::size_t points, int wanted, int threads);

/// Surface of a cloud out of blocks. Does not depend on how many there are. About 2 kB for each
/// point of the blocks that are worked on at the same time, and 170 bytes for each of the cloud.
CloudSurface
makeCloudSurface (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks,
                  const Options& options, BlockDriver& driver);

} // namespace floater
} // namespace pcl
