// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_steps.h"

#include "local/planes.h"
#include "points/neighbors.h"
#include "stored_cloud.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Width, see BlockCutter. Every sixteenth point has its 20 nearest of these within 10 spacings.
constexpr double PLANE_HALO = 2.0;

// A point before outliers were removed, by its number after that.
Index
numberBefore (Index point, const std::vector<Index>& removed)
{
  std::size_t first = 0, last = removed.size (); // those removed up to the point are below
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    if (removed[middle] - middle <= point)
      first = middle + 1;
    else
      last = middle;
  }
  return point + static_cast<Index> (first);
}

CsrLists
renewOwn (const OwnBlock& own, BlockSearch& search, const StepContext& context)
{
  const BlockRanges before = blockRanges (context.plan, context.plan.points);
  StoredNeighbors found (context, {}, before);
  const Index first = numberBefore (own.first, own.outliers);
  const CsrLists lists =
      found.nearest (pointsFrom (first, numberBefore (own.last - 1, own.outliers) + 1));
  return renewRows (lists, first, context.plan.points, own.outliers, [&] (const Rows& rows) {
    return findNearestOfBlock (search, rows, own.cloud.points (), context.options.neighbors.k,
                               context.run);
  });
}

NoiseProbes
probeOwn (BlockSearch& search, const CsrLists& neighbors, std::size_t points,
          const StepContext& context)
{
  if (!mayBeNoisy (points))
    return {};
  const PointBlock& block = search.block ();
  std::vector<Index> probed, quarter, sixteenth;
  for (Index place = 0; place < block.points.size (); ++place) {
    if (block.points[place] % STRIDES[1] == 0)
      quarter.push_back (place);
    if (block.points[place] % STRIDES[2] == 0)
      sixteenth.push_back (place);
    if (block.points[place] % NOISE_PROBES == 0 && place >= search.ownFirst () &&
        place < search.ownLast ())
      probed.push_back (place);
  }
  PointSample every_fourth (block.positions, std::move (quarter), context.run);
  PointSample every_sixteenth (block.positions, std::move (sixteenth), context.run);
  every_fourth.setWatch (&search.watch ());
  every_sixteenth.setWatch (&search.watch ());
  return probeNoise (block.positions, neighbors, probed, {nullptr, &every_fourth, &every_sixteenth},
                     context.limits.noise, context.run);
}

} // namespace

void
planesStep (const StepContext& context, std::size_t block)
{
  OwnBlock own (context, block);
  ArrayWriter writer;
  CsrLists renewed, beside_lists;
  std::vector<float> beside_reach, spacing;
  std::vector<Eigen::Vector3f> normals;
  NoiseProbes probes;
  if (!own.isEmpty ()) {
    StoredCloud& cloud = own.cloud;
    BlockSearch search (cloud.cutter (), block, context.run, PLANE_HALO);
    const std::vector<Index> points = own.points ();
    CsrLists nearest;
    if (own.outliers.empty ())
      nearest = StoredNeighbors (context, own.outliers, cloud.ranges ()).nearest (points);
    else
      nearest = renewed = renewOwn (own, search, context);
    takeIn (points, nearest, cloud, search);
    lookUntilInside (search, [&] (const LocalPoints& local,
                                  const std::vector<Eigen::Vector3d>& positions) {
      const Index own_first = search.ownFirst (), own_last = search.ownLast ();
      const Rows rows = Rows::range (own_first, own_last);
      CsrLists neighbors = local.toPlaces (points, nearest);
      spacing = localSpacing (positions, neighbors, rows, context.run);
      BesideLines beside;
      beside.neighbors.offsets.assign (local.size () + 1, 0);
      beside.reach.assign (local.size (), 0.0F);
      if (isAnyOnLine (positions, neighbors, rows, context.limits.planes.least_aspect, context.run))
        beside =
            findBesideLines (positions, neighbors, spacing, search.tree (), rows,
                             context.limits.planes.least_aspect, context.limits.reach, context.run);
      probes = probeOwn (search, neighbors, cloud.points (), context);
      appendRows (beside.neighbors, neighbors);
      normals = fitTangentPlanes (positions, neighbors, rows, context.run, context.limits.planes);
      beside_lists = {};
      for (Index p = own_first; p < own_last; ++p)
        appendRow (beside.neighbors.row (p), beside_lists);
      local.toPoints (beside_lists.ids);
      const auto keepOwn = [&] (auto& values) {
        values.erase (values.begin () + own_last, values.end ());
        values.erase (values.begin (), values.begin () + own_first);
      };
      beside_reach = std::move (beside.reach);
      keepOwn (beside_reach);
      keepOwn (spacing);
      keepOwn (normals);
    });
    if (cloud.file ().count ("normals") > 0) {
      std::vector<Eigen::Vector3f> given;
      readVectors (cloud.file (), "normals", own.first, own.last, given);
      for (std::size_t i = 0; i < given.size (); ++i)
        if (!given[i].isZero (0.0F))
          normals[i] = given[i];
    }
  }
  if (!own.outliers.empty ())
    writeLists ("renewed", renewed, writer);
  writeLists ("beside", beside_lists, writer);
  writer.add ("beside_reach", beside_reach);
  writer.add ("spacing", spacing);
  addVectors ("normals", normals, writer);
  writer.add ("probes.noise", probes.noise);
  writer.add ("probes.unevenness", probes.unevenness);
  context.store.put (blockFile ("planes", block), writer, context.plan.id);
}

} // namespace pcl::floater
