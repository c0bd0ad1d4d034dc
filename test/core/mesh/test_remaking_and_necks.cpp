// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places in space: the two sides of a surface, and zones of a mesh made anew. Loops around necks, and necks that are
// cut.
#include "mesh/remaking.h"

#include "mesh/known_meshes.h"
#include "mesh/neck_cutting.h"
#include "mesh/piece_in_place.h"
#include "mesh/zone_splicing.h"
#include "mesh_oracle.h"

#include <gtest/gtest.h>

#include <random>

namespace pcl::floater {
namespace {
using namespace samples;

// A place with these points, all of them free.
Place
placeOf (const Positions& positions)
{
  Place place;
  place.positions = positions;
  place.is_free.assign (positions.size (), 1);
  place.is_rim = place.is_boundary = std::vector<std::uint8_t> (positions.size (), 0);
  return place;
}

// Without a frame, the outside is the front.
TEST (TwoSides, OfABodyAreItsInsideAndItsOutside)
{
  const Place place = placeOf (evenSphere (300));
  const RemadePlace made = remakePlace (place, 1);
  EXPECT_TRUE (made.is_right);
  expectTopology (made.triangles, 300, 1, 2, 0);
  double volume = 0.0;
  for (const Triangle& t : made.triangles)
    volume += place.positions[t[0]].dot (place.positions[t[1]].cross (place.positions[t[2]])) / 6.0;
  EXPECT_NEAR (volume, 4.0 / 3.0 * PI, 0.15);
}

// Noise of half a spacing leaves pieces of a side around some points of every second sphere. Sixteen
// of 40 spheres are mended; what cannot be mended is told.
TEST (TwoSides, PiecesAroundAPointAreMended)
{
  std::size_t mended = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random (seed);
    Positions positions = evenSphere (300);
    for (Eigen::Vector3d& p : positions)
      p *= 1.0 + 0.2 * (static_cast<double> (random ()) / 4294967296.0 - 0.5);
    const RemadePlace made = remakePlace (placeOf (positions), 1);
    const MeshTopology topology = topologyOf (made.triangles);
    EXPECT_EQ (made.is_right, topology.manifold && topology.vertices == 300);
    mended += made.flawed > 0 && made.is_right ? 1 : 0;
  }
  EXPECT_GE (mended, 15U);
}

// A new triangle may reach a point of the frame that no old one had.
TEST (Remaking, FindsWhatDoesNotFitBeyondTheRim)
{
  const Mesh flat = sheet (6);
  const Index middle = 24, beside = 25, beyond = 26;
  Place place = placeOf (flat.positions);
  place.is_free.assign (flat.positions.size (), 0);
  place.is_free[middle] = 1;
  place.is_whole.assign (flat.positions.size (), 1);
  Triangles others;
  for (const Triangle& t : flat.triangles)
    if (std::count (t.begin (), t.end (), middle) > 0) {
      others.push_back (t);
      for (const Index p : t)
        place.is_rim[p] = p != middle ? 1 : 0;
    }
    else
      place.frame.push_back (t);
  place.patch_of.assign (place.frame.size (), 0);
  place.patches = 1;
  EXPECT_TRUE (PieceInPlace (place, others, {}, 1).misfits (1).empty ());
  others.push_back ({middle, beside, beyond});
  EXPECT_EQ (PieceInPlace (place, others, {}, 1).misfits (1),
             (std::vector<Index>{middle, beside, beyond}));
}

// The meshes of two spheres beside each other, as one.
struct Spheres
{
  Positions positions;
  LocalGeometry geometry;
  TriangleMesh mesh;

  explicit Spheres (double gap, std::size_t points = 400, bool along_curve = false)
  {
    Positions first = evenSphere (points);
    if (along_curve)
      std::sort (first.begin (), first.end (),
                 [] (const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                   return hilbertCode (p / 4.0) < hilbertCode (q / 4.0);
                 });
    Mesh both;
    for (const Positions& one : {first, placed (first, {2.0 + gap, 0.0, 0.0})})
      append (both, {one, remakePlace (placeOf (one), 1).triangles});
    positions = both.positions;
    mesh = connected (both);
    geometry.neighbors = nearestOf (positions, 20);
    geometry.spacing.assign (positions.size (), 3.4F / std::sqrt (static_cast<float> (points)));
  }

  CrossingPairs crossing () const { return findSelfIntersections (mesh.triangles, positions, 1); }

  RemadeZones remake ()
  {
    CrossingPairs pairs = crossing ();
    RemadeZones remade;
    remakeZones (mesh, positions, geometry, pairs, 3, remade, true, 2);
    EXPECT_EQ (pairs, crossing ());
    return remade;
  }

  // Expects that the flaws are gone by that: two spheres of all their points.
  void expectCured ()
  {
    EXPECT_GT (remake ().points (), 0U);
    EXPECT_TRUE (crossing ().empty ());
    expectTopology (mesh.triangles, 800, 2, 4, 0);
  }
};

TEST (Remaking, LeavesACleanMeshAlone)
{
  Spheres spheres (0.1);
  const std::vector<Triangle> before = spheres.mesh.triangles;
  EXPECT_EQ (spheres.remake ().points (), 0U);
  EXPECT_EQ (spheres.mesh.triangles, before);
}

// Two points that change places make the triangles around them cross.
TEST (Remaking, CuresTrianglesThatCross)
{
  for (const double gap : {0.1, 3.0}) {
    Spheres spheres (gap);
    exchange (spheres.mesh, 100, 121);
    ASSERT_FALSE (spheres.crossing ().empty ());
    spheres.expectCured ();
  }
}

// A zone of all points. A large one is tried in some places first, and left out by the neck search
// if it is noise.
TEST (Remaking, MakesAZoneAnewUnlessItIsNoise)
{
  for (const auto& [is_noisy, points] :
       {std::pair{false, 900}, {true, 900}, {false, 3000}, {true, 3000}}) {
    Spheres spheres (0.1, points, true);
    const std::size_t most = 19 * spheres.positions.size () / 20;
    for (Index p = 0; p < most; p += 25)
      exchange (spheres.mesh, p, p + 21);
    RandomStream random (5);
    for (Eigen::Vector3d& position : spheres.positions)
      position += (is_noisy ? 0.05 : 0.0) * normalVector (random);
    const std::vector<Triangle> before = spheres.mesh.triangles;
    const RemadeZones remade = spheres.remake ();
    EXPECT_EQ (remade.is_noise, is_noisy);
    EXPECT_EQ (std::count (remade.is_noisy.begin (), remade.is_noisy.end (), 1) > 5000,
               is_noisy && points == 3000);
    EXPECT_EQ (remade.points () > most, !is_noisy);
    EXPECT_EQ (spheres.mesh.triangles == before, is_noisy);
    EXPECT_EQ (spheres.crossing ().empty (), !is_noisy);
  }
}

// A point without a triangle, and a hole that its loss left.
TEST (Remaking, BringsPointsBack)
{
  Spheres spheres (0.1);
  auto& triangles = spheres.mesh.triangles;
  const auto hasPoint = [] (const Triangle& t) { return t[0] == 7 || t[1] == 7 || t[2] == 7; };
  triangles.erase (std::remove_if (triangles.begin (), triangles.end (), hasPoint),
                   triangles.end ());
  ASSERT_TRUE (spheres.mesh.connect (spheres.positions.size (), 1));
  spheres.expectCured ();
}

// Four points under the surface are a body of their own, which is no part of it.
TEST (Remaking, LeavesOutIslands)
{
  Spheres spheres (3.0);
  exchange (spheres.mesh, 100, 121);
  const Eigen::Vector3d below = 0.75 * spheres.positions[100];
  spheres.positions.push_back (below);
  for (int k = 0; k < 3; ++k)
    spheres.positions.push_back (below + 0.05 * Eigen::Vector3d::Unit (k));
  ASSERT_TRUE (spheres.mesh.connect (spheres.positions.size (), 1));
  spheres.geometry.neighbors = nearestOf (spheres.positions, 20);
  spheres.geometry.spacing.resize (spheres.positions.size (), spheres.geometry.spacing[0]);
  spheres.expectCured ();
}

// A window has one sheet around it and stays; a loop of five points is none.
TEST (Remaking, KeepsOpenings)
{
  const auto zones = [] (Index around, bool are_settled = false) {
    const Mesh ring = annulus (around);
    LocalGeometry geometry;
    geometry.neighbors = nearestOf (ring.positions, 20);
    geometry.spacing.assign (ring.positions.size (), 0.2F);
    return findDisturbedZones (connected (ring), ring.positions, geometry, {}, 3,
                               GapParts::LONG_PARTS, true,
                               Flags (are_settled ? ring.positions.size () : 0, 1), 1)
        .points.rows ();
  };
  EXPECT_EQ (zones (12), 0U);
  EXPECT_GT (zones (5), 0U);
  EXPECT_EQ (zones (5, true), 0U);
}

// Two meshes differ at three edges. The mesh may face the other side.
TEST (Remaking, TakesChosenPlacesOfAnotherMesh)
{
  for (const bool is_turned : {false, true}) {
    const Mesh flat = cells (20, 20, [] (Index x, Index y) { return Eigen::Vector3d (x, y, 0.0); });
    TriangleMesh before = connected (flat), other = before, expected = before;
    const auto flip = [] (TriangleMesh& mesh, Index x, Index y) {
      mesh.flip ({2 * (20 * y + x), 1}); // the diagonal of a cell
    };
    flip (before, 3, 3);
    flip (before, 3, 15);
    flip (other, 15, 15);
    for (const auto& [x, y] : {std::pair{3U, 15U}, {15U, 15U}})
      flip (expected, x, y);
    for (TriangleMesh* const mesh : {&before, &expected})
      for (Triangle& t : mesh->triangles)
        t = turnedIf (is_turned, t);
    const TriangleMesh mesh = connected (before.triangles, flat.positions.size ());
    Flags is_chosen (flat.positions.size (), 0);
    is_chosen[21 * 3 + 3] = is_chosen[21 * 15 + 15] = is_chosen[21 * 10 + 10] = 1;
    std::vector<std::optional<NewZone>> zones = placesOf (other, mesh, is_chosen);
    EXPECT_EQ (zones.size (), 2U);
    EXPECT_EQ (std::count (is_chosen.begin (), is_chosen.end (), 1), 8);
    const TriangleMesh after = connected (spliceZones (mesh, zones), flat.positions.size ());
    EXPECT_EQ (after.triangles.size (), expected.triangles.size ());
    for (const Triangle& t : expected.triangles) {
      const Index same = after.triangleWith (t);
      ASSERT_NE (same, NONE);
      EXPECT_EQ (areaVectorOf (after.triangles[same], flat.positions),
                 areaVectorOf (t, flat.positions));
    }
  }
}

// Edges of the shortest loop; 0 if there is none.
std::size_t
shortestLoop (const Mesh& mesh, std::size_t longest)
{
  const TriangleMesh connected = samples::connected (mesh);
  const std::vector<std::vector<Index>> loops =
      findNeckLoops (connected, mesh.positions, {}, longest, 1);
  for (const std::vector<Index>& loop : loops)
    for (std::size_t i = 0; i < loop.size (); ++i)
      EXPECT_TRUE (connected.hasEdge (loop[i], loop[(i + 1) % loop.size ()]));
  return loops.empty () ? 0 : loops.front ().size ();
}

TEST (NeckLoops, AreAsLongAsTheTubeIsWide)
{
  EXPECT_EQ (shortestLoop (torus (15, 5), 4), 0U);
  for (const std::size_t longest : {5U, 8U, 12U})
    EXPECT_EQ (shortestLoop (torus (15, 5), longest), 5U);
  for (const Index across : {3U, 4U})
    EXPECT_EQ (shortestLoop (torus (36, across), 12), across);
}

TEST (NeckLoops, GoAroundNoTipAndNoBoundary)
{
  Mesh tip = sheet (14);
  tip.positions[7 * 15 + 7].z () = 0.5;
  EXPECT_EQ (shortestLoop (tip, 12), 0U);
  EXPECT_EQ (shortestLoop (annulus (5), 12), 0U);
  EXPECT_EQ (shortestLoop (tetrahedron (), 12), 0U);
  EXPECT_EQ (shortestLoop (torus (30, 13), 12), 0U); // hardly bent
}

LocalGeometry
geometryOf (const TwoSheets& sheets, double spacing = 0.1)
{
  LocalGeometry geometry;
  geometry.neighbors = sheets.neighbors;
  geometry.spacing.assign (sheets.positions.size (), static_cast<float> (spacing));
  geometry.stars.normals = sheets.normals;
  return geometry;
}

// Two sheets face each other, and are joined by prisms in the places of some of their triangles.
TwoSheets
joinedSheets (const std::vector<std::size_t>& places)
{
  constexpr Index SIDE = 14;
  Mesh lower = sheet (SIDE), upper = lower;
  turnRound (upper);
  for (Eigen::Vector3d& p : upper.positions)
    p.z () = 0.08;
  TwoSheets sheets (lower, upper, 12);
  const std::size_t points = lower.positions.size (), triangles = lower.triangles.size ();
  std::fill (sheets.normals.begin () + static_cast<std::ptrdiff_t> (points), sheets.normals.end (),
             Eigen::Vector3f (0, 0, -1));
  Triangles joined;
  for (std::size_t t = 0; t < 2 * triangles; ++t)
    if (std::count (places.begin (), places.end (), t % triangles) == 0)
      joined.push_back (sheets.mesh.triangles[t]);
  for (const std::size_t t : places)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = lower.triangles[t][i], q = lower.triangles[t][(i + 1) % 3];
      const auto above = [&] (Index r) { return static_cast<Index> (r + points); };
      joined.push_back ({p, q, above (q)});
      joined.push_back ({p, above (q), above (p)});
    }
  sheets.mesh = connected (joined, sheets.positions.size ());
  return sheets;
}

// One bridge makes one component of two; each more makes a handle.
TEST (NeckCutting, CutsBridgesBetweenSheets)
{
  for (const std::vector<std::size_t>& places :
       {std::vector<std::size_t>{}, {180}, {95, 290}, {95, 290, 121, 268}}) {
    TwoSheets sheets = joinedSheets (places);
    EXPECT_EQ (cutNecks (sheets.mesh, sheets.positions, geometryOf (sheets), {}, 1),
               places.size ());
    expectConsistent (sheets.mesh);
    expectTopology (sheets.mesh.triangles, sheets.positions.size (), 2, 2, 2);
  }
}

// A bridge at skipped points stays.
TEST (NeckCutting, LeavesOutWhatIsSkipped)
{
  TwoSheets sheets = joinedSheets ({95, 290});
  std::vector<std::uint8_t> is_skipped (sheets.positions.size (), 0);
  const Eigen::Vector3d bridge = sheets.positions[sheet (14).triangles[290][0]];
  for (Index p = 0; p < is_skipped.size (); ++p)
    is_skipped[p] = (sheets.positions[p] - bridge).norm () < 0.3 ? 1 : 0;
  EXPECT_EQ (cutNecks (sheets.mesh, sheets.positions, geometryOf (sheets), is_skipped, 1), 1U);
  expectTopology (sheets.mesh.triangles, sheets.positions.size (), 1, 0, 2);
}

// Also those whose rings are several times as far apart as they are wide.
TEST (NeckCutting, KeepsThinTubes)
{
  for (const double radius : {1.0, 40.0})
    for (const Index across : {3U, 4U, 6U, 9U, 12U}) {
      Mesh torus = samples::torus (radius > 1.0 ? 80 : 8 * across / 3, across);
      TwoSheets sheets (torus, {}, 12);
      sheets.normals.clear ();
      for (Eigen::Vector3d& p : torus.positions) {
        const Eigen::Vector3d middle = Eigen::Vector3d (p.x (), p.y (), 0.0).normalized ();
        sheets.normals.push_back ((p - middle).normalized ().cast<float> ());
        p += (radius - 1.0) * middle;
      }
      sheets.positions = torus.positions;
      EXPECT_EQ (
          cutNecks (sheets.mesh, sheets.positions, geometryOf (sheets, 0.8 * PI / across), {}, 1),
          0U);
      expectSame (sheets.mesh, connected (torus));
    }
}

} // namespace
} // namespace pcl::floater
