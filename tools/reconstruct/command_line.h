// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of pcl_floater_reconstruct.
#pragma once

#include "precision.h"

#include <pcl/surface/floater/options.h>

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pcl
{
namespace floater
{
/// Exit codes, as documented in --help.
enum ExitCode
{
  EXIT_OK = 0,
  EXIT_USAGE = 1,
  EXIT_INPUT = 2,
  EXIT_RECONSTRUCTION = 3,
  EXIT_OUTPUT = 4,
  EXIT_INTERNAL = 5,
  EXIT_WARNINGS = 6
};

/// The command line is wrong, or asks for something impossible.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What the user asked for. Paths that were not given are empty.
struct CommandLine
{
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path parameterization;
  std::filesystem::path loop;
  std::filesystem::path texture;         ///< image of the colours of the points
  int texture_size = 0;                  ///< of its side, in pixels; 0: chosen by the points
  bool texture_coordinates = false;      ///< --uv; also if a texture is asked for
  std::filesystem::path scratch;         ///< folder; used with a limit only
  std::size_t max_memory = 0;            ///< bytes; 0: no limit
  std::optional<Eigen::Vector3d> shift;  ///< --shift x,y,z
  bool auto_shift = false;               ///< --shift auto
  Precision precision = Precision::AUTO; ///< of coordinates in outputs
  bool as_published = false;             ///< --method tw385
  bool use_input_normals = false;        ///< for tangent planes, and so for the facing
  Options options;                       ///< without the loop, which has not been read yet
  bool quiet = false;
  bool json = false;
  bool strict = false;                 ///< write no mesh if there is a warning
  std::vector<std::string> warnings{}; ///< on options that have no effect, whatever the cloud is

  /// Whether the normals of the input are read to find the front of the mesh.
  bool usesNormalsForFacing () const
  {
    return options.facing == Facing::NORMALS ||
           (options.facing == Facing::AUTO && use_input_normals);
  }
};

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
constexpr Choices<Facing, 5> FACING_CHOICES{{{"auto", Facing::AUTO},
                                             {"outwards", Facing::OUTWARDS},
                                             {"up", Facing::UP},
                                             {"viewpoint", Facing::VIEWPOINT},
                                             {"normals", Facing::NORMALS}}};
constexpr Choices<ScatterPolicy, 2> SCATTER_CHOICES{
    {{"keep", ScatterPolicy::KEEP}, {"drop", ScatterPolicy::DROP}}};
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
constexpr Choices<Solver, 6> SOLVER_CHOICES{{{"umfpack", Solver::UMFPACK},
                                             {"umfpack-unsymmetric", Solver::UMFPACK_UNSYMMETRIC},
                                             {"superlu", Solver::SUPERLU},
                                             {"eigen-sparse-lu", Solver::EIGEN_SPARSE_LU},
                                             {"bicgstab-ilut", Solver::BICGSTAB_ILUT},
                                             {"gauss-seidel", Solver::GAUSS_SEIDEL}}};
constexpr Choices<Ordering, 6> ORDERING_CHOICES{
    {{"automatic", Ordering::AUTOMATIC},
     {"amd", Ordering::AMD},
     {"metis", Ordering::METIS},
     {"colamd", Ordering::COLAMD},
     {"reverse-cuthill-mckee", Ordering::REVERSE_CUTHILL_MCKEE},
     {"natural", Ordering::NATURAL}}};

constexpr Choices<Precision, 3> PRECISION_CHOICES{
    {{"auto", Precision::AUTO}, {"single", Precision::SINGLE}, {"double", Precision::DOUBLE}}};

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

/// Parses the command line. Prints the help or the version if asked for.
/// \return the exit code if there is nothing else to do
/// \throws UsageError
std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& command_line);

} // namespace floater
} // namespace pcl
