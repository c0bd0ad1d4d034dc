// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a mesh to its texture coordinates, on surfaces of all kinds.
#include "mesh/facing_cases.h"
#include "mesh/known_meshes.h"
#include "mesh/level_sets.h"
#include "random_stream.h"
#include "texture_check.h"

#include <pcl/surface/floater/texture_coordinates.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Mesh;

// With nothing wrong with it.
TextureCoordinates
textureOf (const Mesh& mesh, const TextureOptions& options = {}, bool with_distances = false)
{
  TextureCoordinates texture = computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  EXPECT_EQ (samples::flawsOfTexture (mesh.positions, mesh.triangles, texture, with_distances), "");
  return texture;
}

Mesh
sphere (int side, double height = 1.0)
{
  // A cube of six grids, blown up.
  std::map<std::array<int, 3>, Index> numbers;
  Mesh mesh;
  const auto vertex = [&] (const std::array<int, 3>& at) {
    const auto [place, is_new] =
        numbers.try_emplace (at, static_cast<Index> (mesh.positions.size ()));
    if (is_new) {
      Eigen::Vector3d p (at[0], at[1], at[2]);
      p = (2.0 / side * p - Eigen::Vector3d::Ones ()).normalized ();
      mesh.positions.emplace_back (p.x (), p.y (), height * p.z ());
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, side})
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
          const auto at = [&] (int a, int b) {
            std::array<int, 3> place{};
            place[static_cast<std::size_t> (axis)] = end;
            place[static_cast<std::size_t> ((axis + 1) % 3)] = a;
            place[static_cast<std::size_t> ((axis + 2) % 3)] = b;
            return vertex (place);
          };
          std::array<Index, 4> q{at (i, j), at (i + 1, j), at (i + 1, j + 1), at (i, j + 1)};
          if (end == 0)
            std::swap (q[1], q[3]);
          mesh.triangles.push_back ({q[0], q[1], q[2]});
          mesh.triangles.push_back ({q[0], q[2], q[3]});
        }
  return mesh;
}

Mesh
box (int side)
{
  Mesh mesh = sphere (side);
  for (Eigen::Vector3d& p : mesh.positions) // back to the cube, evenly
    p /= p.lpNorm<Eigen::Infinity> ();
  return mesh;
}

Mesh
meshOf (const facing_cases::FacingCase& one)
{
  return {one.positions, one.mesh.triangles};
}

TEST (TextureCoordinates, PlaneIsOneChartWithoutStretch)
{
  const Mesh mesh = samples::sheet (12);
  const TextureCoordinates texture = textureOf (mesh);
  EXPECT_EQ (texture.chart_count, 1U);
  EXPECT_TRUE (texture.seams.empty ());
  EXPECT_EQ (texture.seam_length, 0.0);
  EXPECT_NEAR (texture.stretch, 1.0, 1e-5);
  EXPECT_NEAR (texture.largest_stretch, 1.0, 1e-3);
  EXPECT_GT (texture.area_used, 0.98);
  EXPECT_EQ (texture.coordinates.size (), mesh.positions.size ());
}

TEST (TextureCoordinates, SphereIsTwoCharts)
{
  const TextureCoordinates texture = textureOf (sphere (12), {}, true);
  EXPECT_LE (texture.chart_count, 4U);
  EXPECT_LT (texture.stretch, TextureOptions ().largest_stretch);
  EXPECT_GT (texture.area_used, 0.4);
}

// All cuts are its edges.
TEST (TextureCoordinates, BoxIsCutAlongItsEdges)
{
  for (const int side : {1, 2, 5, 12}) {
    const Mesh mesh = box (side);
    const TextureCoordinates texture = textureOf (mesh, {}, true);
    EXPECT_NEAR (texture.stretch, 1.0, 1e-4);
    for (const auto& seam : texture.seams) {
      const Eigen::Vector3d middle =
          0.5 * (mesh.positions[seam[0]] + mesh.positions[seam[1]]).cwiseAbs ();
      EXPECT_GE ((middle.array () > 1.0 - 1e-9).count (), 2) << middle.transpose ();
    }
  }
}

TEST (TextureCoordinates, TorusAndHolesAndManyComponents)
{
  textureOf (samples::torus (40, 16), {}, true);
  textureOf (samples::annulus (24), {}, true);
  Mesh many = samples::tetrahedron ();
  for (int i = 0; i < 30; ++i)
    many = samples::beside (
        i % 2 == 0 ? samples::sheet (1 + static_cast<Index> (i % 5)) : samples::annulus (5), many);
  const TextureCoordinates texture = textureOf (many, {}, true);
  EXPECT_GE (texture.chart_count, 31U);
}

// A sheet with one point far out of it: the triangles around it stand on edge.
TEST (TextureCoordinates, Spike)
{
  for (const double height : {1.0, 10.0, 1000.0}) {
    Mesh mesh = samples::sheet (10);
    mesh.positions[60].z () = height;
    textureOf (mesh);
  }
}

TEST (TextureCoordinates, TrianglesWithoutAreaAndPointsInOnePlace)
{
  Mesh mesh = samples::sheet (6);
  mesh.positions[24] = 0.5 * (mesh.positions[23] + mesh.positions[25]); // on a line
  mesh.positions[10] = mesh.positions[9];
  mesh.positions[3] = mesh.positions[4];
  textureOf (mesh);
  const Mesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  textureOf (line);
  const Mesh place{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}};
  textureOf (samples::beside (place, line));
}

TEST (TextureCoordinates, PointsWithoutTriangleHaveNone)
{
  Mesh mesh = samples::sheet (3);
  mesh.positions.emplace_back (std::nan (""), 0.0, 0.0);
  EXPECT_EQ (textureOf (mesh).coordinates.size (), 16U);
  const TextureCoordinates none = textureOf ({});
  EXPECT_EQ (none.chart_count, 0U);
  EXPECT_EQ (none.stretch, 1.0);
}

// A disc that would be cut, in one piece.
TEST (TextureCoordinates, WholeDiscs)
{
  Mesh bowl = meshOf (facing_cases::makeBowl (0.9));
  EXPECT_GT (textureOf (bowl).chart_count, 1U);
  TextureOptions options;
  options.whole_discs = true;
  const TextureCoordinates whole = textureOf (bowl, options);
  EXPECT_EQ (whole.chart_count, 1U);
  EXPECT_LT (whole.stretch, 2.0);
  // What is no disc is cut as always.
  const Mesh ring = samples::torus (30, 12);
  EXPECT_EQ (textureOf (ring, options).coordinates, textureOf (ring).coordinates);
}

// Bodies, shells, terrain, torn sheets: open and closed, of one and of many components.
class TextureOfRandomSurfaces : public testing::TestWithParam<int>
{
};

TEST_P (TextureOfRandomSurfaces, HasNoFlaw)
{
  const auto family = static_cast<facing_cases::Family> (GetParam ());
  const Mesh mesh = meshOf (facing_cases::makeFacingCase (family, 3));
  SCOPED_TRACE (std::string (facing_cases::familyName (family)));
  const TextureCoordinates texture = textureOf (mesh);
  EXPECT_LT (texture.stretch, 1.2);
  EXPECT_LT (texture.chart_count, 20U + mesh.triangles.size () / 20U);
}

INSTANTIATE_TEST_SUITE_P (AllFamilies, TextureOfRandomSurfaces,
                          testing::Range (0, static_cast<int> (facing_cases::Family::COUNT)));

// Each vertex is moved along its normal: charts are those of the surface without noise.
TEST (TextureCoordinates, NoiseDoesNotDecideCharts)
{
  const int side = 24;
  Mesh plane = samples::sheet (40);
  for (Eigen::Vector3d& p : plane.positions)
    p *= 10.0; // one unit is a spacing
  Mesh cube = box (side), ball = sphere (side);
  for (std::size_t i = 0; i < cube.positions.size (); ++i) {
    cube.positions[i] *= 0.5 * side;
    ball.positions[i] *= 0.5 * side;
  }
  for (const double noise : {0.1, 0.3, 1.0})
    for (const Mesh& mesh : {plane, cube, ball}) {
      Mesh noisy = mesh;
      RandomStream random (7);
      const bool is_flat = mesh.positions.size () == plane.positions.size ();
      for (Eigen::Vector3d& p : noisy.positions)
        p += noise * random.normal () *
             (is_flat ? Eigen::Vector3d (Eigen::Vector3d::UnitZ ()) : p.normalized ());
      SCOPED_TRACE (std::to_string (noise) + ", points " + std::to_string (mesh.positions.size ()));
      const TextureCoordinates texture = textureOf (noisy);
      EXPECT_LE (texture.chart_count, 2U + textureOf (mesh).chart_count);
      EXPECT_LT (texture.stretch, 1.0 + 0.5 * noise);
    }
}

TEST (TextureCoordinates, BadInputIsRefused)
{
  const Mesh mesh = samples::sheet (3);
  const auto refused = [] (const Mesh& bad, const TextureOptions& options = {}) {
    const TextureCoordinates texture =
        computeTextureCoordinates (bad.positions, bad.triangles, options);
    EXPECT_FALSE (texture.message.empty ());
    EXPECT_TRUE (texture.coordinates.empty ());
    return texture.status;
  };
  Mesh bad = mesh;
  bad.triangles[4][1] = 16;
  EXPECT_EQ (refused (bad), RunStatus::INVALID_INDICES);
  bad = mesh;
  bad.positions[5].y () = std::numeric_limits<double>::infinity ();
  EXPECT_EQ (refused (bad), RunStatus::INVALID_INDICES);
  bad = mesh;
  std::swap (bad.triangles[3][0], bad.triangles[3][1]); // faces the other way
  EXPECT_EQ (refused (bad), RunStatus::INVALID_INDICES);
  bad = mesh;
  bad.triangles.push_back (bad.triangles.front ());
  EXPECT_EQ (refused (bad), RunStatus::INVALID_INDICES);
  bad = mesh;
  bad.triangles[0] = {2, 2, 3};
  EXPECT_EQ (refused (bad), RunStatus::INVALID_INDICES);
  TextureOptions options;
  options.largest_stretch = 0.9;
  EXPECT_EQ (refused (mesh, options), RunStatus::INVALID_OPTION);
  options.largest_stretch = std::nan ("");
  EXPECT_EQ (refused (mesh, options), RunStatus::INVALID_OPTION);
  options = {};
  options.threads = -1;
  EXPECT_EQ (refused (mesh, options), RunStatus::INVALID_OPTION);
}

TEST (TextureCoordinates, ProgressAndCancellation)
{
  const Mesh mesh = sphere (16);
  std::vector<double> fractions;
  TextureOptions options;
  options.progress_callback = [&fractions] (double fraction) { fractions.push_back (fraction); };
  textureOf (mesh, options);
  ASSERT_FALSE (fractions.empty ());
  EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
  EXPECT_GE (fractions.front (), 0.0);
  EXPECT_EQ (fractions.back (), 1.0);

  // At the places where it is asked.
  int calls = 0;
  options = {};
  options.cancelled_callback = [&calls] { return ++calls < 0; };
  textureOf (mesh, options);
  ASSERT_GT (calls, 0);
  for (int last = 1; last <= calls; last += 1 + calls / 10) {
    int count = 0;
    options.cancelled_callback = [&count, last] { return ++count >= last; };
    const TextureCoordinates texture =
        computeTextureCoordinates (mesh.positions, mesh.triangles, options);
    if (texture.status == RunStatus::SUCCESS)
      continue; // it was asked less often this time
    EXPECT_EQ (texture.status, RunStatus::CANCELLED);
    EXPECT_TRUE (texture.coordinates.empty ());
  }
  options.cancelled_callback = [] () -> bool { throw std::runtime_error ("broken"); };
  EXPECT_EQ (computeTextureCoordinates (mesh.positions, mesh.triangles, options).status,
             RunStatus::INTERNAL_ERROR);
}

} // namespace
} // namespace pcl::floater
