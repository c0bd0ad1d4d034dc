// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the mesh anew where several sheets of the surface are near.
#pragma once

#include "mesh/disturbed_zones.h"

namespace pcl::floater {
/// What remakeZones () has done.
struct RemadeZones
{
  Flags is_remade;  ///< of each point: its triangles were made anew; or empty
  Flags is_noisy;   ///< of each point: the last zone with it was noise, and a large one; or empty
  Flags is_settled; ///< of each point: it is not made anew; or empty
  bool is_noise = false; ///< more than a quarter of the points are in zones that are noise

  std::size_t points () const
  {
    return static_cast<std::size_t> (std::count (is_remade.begin (), is_remade.end (), 1));
  }
};

/// Makes zones anew in space (see findDisturbedZones and remakePlace): wide ones, then those that
/// came out wrong again, narrower by a ring each time. At first, loops that are gaps in part are
/// gaps all along; at last, shorter parts of them are tried (see GapParts). A zone grows by points
/// at which its new triangles do not fit to those around. It stays as it was if its new triangles
/// fit nowhere, have a lid on an opening, or not clearly fewer faults (see PieceInPlace), or if the
/// sides of pieces of the mesh contradict each other; also if it is large and some places in it are
/// noise (see isNoise). If such zones have more than a quarter of the points, no narrower ones are tried. One
/// that is left with faults and is most of its components is tried once more with all of them: what is
/// around may be wrong, too.
/// A zone may have more handles than before: true ones, such as holes through a plate, are often
/// missing there, and cutNecks () cuts false ones. Components may come out with either side as the
/// front. Points of new components by themselves are left without a triangle. O(n), plus some 60
/// microseconds for a point of a zone; zones on all threads.
/// \param[in,out] crossing all crossing pairs of the mesh
/// \param widest    rings around what is disturbed, at first
/// \param[in,out] remade adds what was done to what was done before
/// \param closes_gaps see findDisturbedZones ()
/// \return whether any zone was made anew
bool
remakeZones (TriangleMesh& mesh, const Positions& positions, const LocalGeometry& geometry,
             CrossingPairs& crossing, int widest, RemadeZones& remade, bool closes_gaps,
             const RunContext& run);

} // namespace pcl::floater
