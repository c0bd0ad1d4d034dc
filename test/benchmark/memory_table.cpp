// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Table 1 of TW 385: bytes per point.
#include "points/kd_tree.h"
#include "section.h"
#include "umfpack_sizes.h"

#include <malloc.h>

namespace pcl
{
namespace floater
{
namespace
{
// Bytes per point by TW 385, Table 1.
constexpr double OCTREE_BYTES = 53.0, MATRIX_BYTES = 112.0, PERMUTATION_BYTES = 53.0,
                 FACTOR_BYTES = 84.0;

template <typename T>
std::size_t
bytesOf (const std::vector<T>& v)
{
  return v.size () * sizeof (T);
}

std::size_t
bytesOf (const LinearSystem& system)
{
  return bytesOf (system.point_of_unknown) + bytesOf (system.unknown_of_point) +
         bytesOf (system.row_offsets) + bytesOf (system.columns) + bytesOf (system.values) +
         bytesOf (system.rhs_u) + bytesOf (system.rhs_v);
}

// What the allocator has handed out.
std::size_t
heldBytes ()
{
  const auto info = mallinfo2 ();
  return info.uordblks + info.hblkhd;
}

std::size_t
searchStructureBytes (const DiscStages& disc)
{
  const std::size_t before = heldBytes ();
  const KdTree tree (disc.points.positions);
  return heldBytes () - before;
}

class MemoryTable : public Section
{
public:
  MemoryTable ()
  {
    table_.columns = {"cloud",        "",      "search structure",     "matrix", "L and U",
                      "permutations", "total", "peak of factorization"};
  }

  void measure (const Sample& sample) override
  {
    const auto points = static_cast<double> (sample.disc.points.size ());
    const UmfpackSizes sizes = measureUmfpack (sample.disc.system);
    const double gamma = static_cast<double> (sizes.nnz_factors) /
                         static_cast<double> (sample.disc.system.nonzeros ());
    const std::size_t tree = searchStructureBytes (sample.disc);
    const std::size_t matrix = bytesOf (sample.disc.system);
    const auto perPoint = [points] (std::size_t bytes) {
      return fixed (static_cast<double> (bytes) / points, 0);
    };
    table_.rows.push_back ({sample.disc.name, "measured", perPoint (tree), perPoint (matrix),
                            perPoint (sizes.factors), perPoint (sizes.permutations),
                            perPoint (tree + matrix + sizes.factors + sizes.permutations),
                            perPoint (sizes.peak)});
    table_.rows.push_back (
        {"", "formula", fixed (OCTREE_BYTES, 0), fixed (MATRIX_BYTES, 0),
         fixed (FACTOR_BYTES * gamma, 0), fixed (PERMUTATION_BYTES, 0),
         fixed (OCTREE_BYTES + MATRIX_BYTES + PERMUTATION_BYTES + FACTOR_BYTES * gamma, 0), "-"});
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Table 1: bytes per point");
    report.paragraph ("Measured, and by the formula of TW 385, (218 + 84 gamma) N, with our "
                      "gamma. The search structure is a kd-tree here, measured by what the "
                      "allocator handed out for it, and an octree in TW 385. The matrix "
                      "includes both right-hand sides and the numbering of the unknowns. Factors "
                      "and permutations are what UMFPACK counts after the factorization: its L "
                      "and U share patterns within supernodes, so they need less than the 12 "
                      "bytes per nonzero of the formula. The last column is the peak during "
                      "factorization, which TW "
                      "385 does not count.");
    report.table ("table1_memory", table_);
  }

private:
  Table table_;
};

} // namespace

std::unique_ptr<Section>
makeMemoryTable ()
{
  return std::make_unique<MemoryTable> ();
}

} // namespace floater
} // namespace pcl
