// SPDX-License-Identifier: GPL-3.0-or-later
#include "blocks/block_driver.h"

#include "common/parallel.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t BLOCK = 131072; // points: the halo then adds a tenth to the work

template <typename Value>
void
place (const std::vector<Value>& own, std::size_t first, std::vector<Value>& all)
{
  std::copy (own.begin (), own.end (), all.begin () + static_cast<std::ptrdiff_t> (first));
}

} // namespace

BlockSurface
BlockDriver::surfaceOf (std::size_t block, const Cut& cut, const Step& step)
{
  std::vector<Ball> balls;
  while (true) {
    BlockSurface surface = step (cut (block, balls));
    if (surface.missing.empty ())
      return surface;
    balls.insert (balls.end (), surface.missing.begin (), surface.missing.end ());
  }
}

void
ThreadDriver::run (std::size_t blocks, const Cut& cut, const Step& step, const Join& join)
{
  parallelTasks (blocks, threads_,
                 [&] (std::size_t block) { join (block, surfaceOf (block, cut, step)); });
}

std::size_t
chooseBlocks (std::size_t points, int wanted, int threads)
{
  if (wanted > 0)
    return static_cast<std::size_t> (wanted);
  if (points <= 2 * BLOCK)
    return 1;
  const auto at_once = static_cast<std::size_t> (resolveThreads (threads));
  return (points / BLOCK + at_once) / at_once * at_once;
}

CloudSurface
makeCloudSurface (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks,
                  const Options& options, BlockDriver& driver)
{
  const std::size_t n = positions.size ();
  const std::size_t k =
      std::min (static_cast<std::size_t> (options.k), std::max<std::size_t> (1, n) - 1);
  if (n * k >= NONE)
    throw std::length_error (
        "points times neighbours exceed 32-bit indices: use fewer points or a smaller k");
  CloudSurface cloud;
  cloud.near.offsets.resize (n + 1);
  for (std::size_t p = 0; p <= n; ++p)
    cloud.near.offsets[p] = static_cast<Index> (p * k);
  cloud.near.ids.resize (n * k);
  cloud.spacing.resize (n);
  cloud.normals.resize (n);
  cloud.crease.resize (n);
  const BlockCutter cutter (positions, blocks, options.threads);
  cloud.candidates.resize (cutter.blocks ());
  const int threads_inside = cutter.blocks () == 1 ? options.threads : 1;
  driver.run (
      cutter.blocks (),
      [&] (std::size_t block, const std::vector<Ball>& balls) { return cutter.cut (block, balls); },
      [&] (const PointBlock& block) {
        return makeBlockSurface (block, static_cast<int> (k), options.filter_sheets,
                                 threads_inside);
      },
      [&] (std::size_t block, BlockSurface surface) {
        const std::size_t first = cutter.first (block);
        place (surface.near, first * k, cloud.near.ids);
        place (surface.spacing, first, cloud.spacing);
        place (surface.normals, first, cloud.normals);
        place (surface.crease, first, cloud.crease);
        surface.candidates.sure.shrink_to_fit ();
        surface.candidates.doubtful.shrink_to_fit ();
        cloud.candidates[block] = std::move (surface.candidates);
      });
  return cloud;
}

} // namespace floater
} // namespace pcl
