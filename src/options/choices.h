// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Words for the values of options: on the command line, in reports, and in Python.
#pragma once

#include <pcl/surface/floater/options.h>

#include <array>
#include <utility>

namespace pcl::floater {
/// Words for the values of an enumeration, on the command line and in reports.
template <typename Enum, std::size_t N>
using Choices = std::array<std::pair<const char*, Enum>, N>;

constexpr Choices<bool, 2> METHOD_CHOICES{{{"auto", false}, {"tw385", true}}};
constexpr Choices<Topology, 3> TOPOLOGY_CHOICES{
    {{"auto", Topology::AUTO}, {"disc", Topology::DISC}, {"surface", Topology::SURFACE}}};
constexpr Choices<HolePolicy, 5> HOLE_CHOICES{{{"auto", HolePolicy::AUTO},
                                               {"close-all", HolePolicy::CLOSE_ALL},
                                               {"keep-largest", HolePolicy::KEEP_LARGEST},
                                               {"keep-count", HolePolicy::KEEP_COUNT},
                                               {"by-size", HolePolicy::BY_SIZE}}};
constexpr Choices<Facing, 6> FACING_CHOICES{{{"auto", Facing::AUTO},
                                             {"outwards", Facing::OUTWARDS},
                                             {"up", Facing::UP},
                                             {"viewpoint", Facing::VIEWPOINT},
                                             {"normals", Facing::NORMALS},
                                             {"inwards", Facing::INWARDS}}};
constexpr Choices<ScatterPolicy, 3> SCATTER_CHOICES{
    {{"auto", ScatterPolicy::AUTO}, {"keep", ScatterPolicy::KEEP}, {"drop", ScatterPolicy::DROP}}};
constexpr Choices<BoundaryMethod, 3> BOUNDARY_CHOICES{
    {{"spanning-tree", BoundaryMethod::SPANNING_TREE},
     {"consensus", BoundaryMethod::CONSENSUS},
     {"two-segments", BoundaryMethod::TWO_SEGMENTS}}};
constexpr Choices<Neighborhood, 4> NEIGHBORHOOD_CHOICES{
    {{"nearest-delaunay", Neighborhood::NEAREST_DELAUNAY},
     {"nearest", Neighborhood::NEAREST},
     {"ball-delaunay", Neighborhood::BALL_DELAUNAY},
     {"ball", Neighborhood::BALL}}};
constexpr Choices<Domain, 4> DOMAIN_CHOICES{{{"circle", Domain::CIRCLE},
                                             {"square", Domain::SQUARE},
                                             {"polygon", Domain::POLYGON},
                                             {"own-shape", Domain::OWN_SHAPE}}};
constexpr Choices<LoopSpacing, 3> SPACING_CHOICES{{{"chord-length", LoopSpacing::CHORD_LENGTH},
                                                   {"centripetal", LoopSpacing::CENTRIPETAL},
                                                   {"uniform", LoopSpacing::UNIFORM}}};
constexpr Choices<Weighting, 4> WEIGHTING_CHOICES{
    {{"uniform", Weighting::UNIFORM},
     {"inverse-distance", Weighting::INVERSE_DISTANCE},
     {"shape-preserving", Weighting::SHAPE_PRESERVING},
     {"mean-value", Weighting::MEAN_VALUE}}};
constexpr Choices<Solver, 4> SOLVER_CHOICES{{{"umfpack", Solver::UMFPACK},
                                             {"superlu", Solver::SUPERLU},
                                             {"bicgstab-ilut", Solver::BICGSTAB_ILUT},
                                             {"gauss-seidel", Solver::GAUSS_SEIDEL}}};
constexpr Choices<Ordering, 5> ORDERING_CHOICES{
    {{"automatic", Ordering::AUTOMATIC},
     {"amd", Ordering::AMD},
     {"metis", Ordering::METIS},
     {"reverse-cuthill-mckee", Ordering::REVERSE_CUTHILL_MCKEE},
     {"natural", Ordering::NATURAL}}};

constexpr Choices<bool, 2> SWITCH_CHOICES{{{"on", true}, {"off", false}}};

/// The word for a value.
template <typename Enum, std::size_t N>
const char*
choiceName (const Choices<Enum, N>& choices, Enum value)
{
  for (const auto& choice : choices)
    if (choice.second == value)
      return choice.first;
  return "unknown";
}

} // namespace pcl::floater
