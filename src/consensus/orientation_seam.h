// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces without an orientation, such as a Moebius strip.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Finds where a one-sided surface was cut open: the longest row of contradicting triangles that
/// are connected by edges. An orientation that spreads round such a surface contradicts itself
/// along a whole row across it; a wrong triangle between two sheets stands alone. Fails for strips
/// less than about 4 spacings wide: their rows are too short. O(m log m) for m triangles.
/// \param contradicting see ConsensusMesh::seam
/// \param shortest_seam triangles; see ConsensusLimits
/// \return the triangles of the row, in the order of `contradicting`; empty if it is too short
std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting, std::size_t shortest_seam);

} // namespace pcl::floater
