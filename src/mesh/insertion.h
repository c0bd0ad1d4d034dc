// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Insertion of points that have no triangle.
#pragma once

#include "mesh/flips.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Inserts every point without triangle that has vertices among its nearest neighbours: splits the
/// triangle around these whose split costs least. The cheapest point comes first, since it shows
/// the next ones where the surface is. A point that has only missing neighbours follows when one of
/// these is inserted. O(m log m) for m missing points.
/// \param neighbors of each point, nearest first
/// \param flip      whether edges around each inserted point are flipped at once
/// \return number of points inserted
std::size_t
insertMissingPoints (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
                     bool flip, const RunContext& run);

} // namespace pcl::floater
