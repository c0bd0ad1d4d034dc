// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packs shapes that consist of grid cells.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <array>
#include <vector>

namespace pcl::floater {
/// Cells first to last of a row.
struct CellRun
{
  Index first, last;
};

/// A shape of cells: for each row its runs, in order, not adjacent.
struct CellMask
{
  Index width = 0;
  std::vector<std::vector<CellRun>> rows; ///< the lowest first
  std::size_t cells = 0;
};

/// The cells that triangles touch, and all adjacent cells; so the shape begins one cell left of and
/// below the origin. O(triangles + cells).
/// \param uv per vertex, in cells, not negative
CellMask
makeCellMask (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector2d>& uv);

/// Position of a shape: the lower left cell of its box.
struct CellPlace
{
  Index x = 0, y = 0;
  std::uint8_t quarters = 0; ///< which of the four directions of the shape
};

struct CellPacking
{
  std::vector<CellPlace> places;
  Index side = 0; ///< of the square, in cells
};

/// Packs shapes into a small square: largest first, each at the lowest free position in a strip.
/// The width is varied until it equals the height.
/// \param shapes each in four directions
CellPacking
packCells (const std::vector<std::array<CellMask, 4>>& shapes, int attempts, const RunContext& run);

} // namespace pcl::floater
