// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The view of an organized cloud has the triangles of the ordinary Delaunay triangulation.
#include "view/lattice_view.h"

#include "floater/planar_delaunay.h"
#include "samples.h"
#include "view/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pcl::floater {
namespace {
/// Places in the plane, in any order, with the pixel of each.
struct Frame
{
  std::vector<Eigen::Vector2d> places;
  std::vector<Index> pixels;
  std::size_t width = 0;
};

std::vector<Triangle>
sorted (const TriangleMesh& mesh)
{
  std::vector<Triangle> triangles;
  for (Triangle t : mesh.triangles) {
    std::rotate (t.begin (), std::min_element (t.begin (), t.end ()), t.end ());
    triangles.push_back (t);
  }
  std::sort (triangles.begin (), triangles.end ());
  return triangles;
}

std::vector<Eigen::Vector2d>
placesOf (const std::vector<Eigen::Vector3d>& positions)
{
  return makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1).places;
}

std::optional<TriangleMesh>
triangulate (const Frame& frame, int threads = 1)
{
  return triangulateLattice (frame.places, frame.pixels, frame.width, threads);
}

void
expectSameTriangles (const Frame& frame)
{
  for (const int threads : {1, 3}) {
    const std::optional<TriangleMesh> mesh = triangulate (frame, threads);
    ASSERT_TRUE (mesh);
    EXPECT_EQ (sorted (*mesh), sorted (triangulateHull (frame.places)));
    // Neighbours as the triangles tell them.
    TriangleMesh connected;
    connected.triangles = mesh->triangles;
    ASSERT_TRUE (connected.connect (frame.places.size (), 1));
    EXPECT_EQ (connected.neighbors, mesh->neighbors);
    for (Index p = 0; p < frame.places.size (); ++p) {
      const Index t = mesh->triangle_of[p];
      ASSERT_EQ (t == NONE, connected.triangle_of[p] == NONE);
      if (t != NONE) {
        EXPECT_EQ (std::count (mesh->triangles[t].begin (), mesh->triangles[t].end (), p), 1);
      }
    }
  }
}

/// A camera that is turned at random looks at a rectangle of pixels; some are lost one by one, and
/// some in round holes.
struct CameraOptions
{
  std::size_t width = 90, height = 70;
  double lost = 0.02;        // share of single pixels
  int holes = 4;             // up to 10 pixels in radius
  double jitter = 0.0;       // standard deviation, in pixels
  double distortion = 0.0;   // of the lens, at the corners
  double row_distance = 1.0; // in columns
  bool is_mirrored = false;
};

Frame
makeFrame (const CameraOptions& options, std::uint64_t seed)
{
  RandomStream random (seed);
  const double w = static_cast<double> (options.width), h = static_cast<double> (options.height);
  std::vector<Eigen::Vector3d> holes; // middles and radii
  for (int i = 0; i < options.holes; ++i)
    holes.emplace_back (w * random.uniform (), h * random.uniform (), 10.0 * random.uniform ());
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), random.normal ())
          .normalized ();
  Frame frame;
  frame.width = options.width;
  std::vector<Eigen::Vector3d> positions;
  // The order of the points is not that of the pixels.
  for (const Index pixel : samples::permutation (options.width * options.height, seed)) {
    const Eigen::Vector2d at (pixel % options.width, pixel / options.width);
    if (random.uniform () < options.lost ||
        std::any_of (holes.begin (), holes.end (), [&at] (const Eigen::Vector3d& hole) {
          return (hole.head<2> () - at).norm () < hole.z ();
        }))
      continue;
    const Eigen::Vector2d jitter (random.normal (), random.normal ());
    Eigen::Vector2d place = (at - 0.5 * Eigen::Vector2d (w, h) + options.jitter * jitter) / w;
    place.y () *= options.row_distance;
    place *= 1.0 + options.distortion * place.squaredNorm ();
    const double depth = 1.0 + random.uniform ();
    if (options.is_mirrored)
      place.x () = -place.x ();
    positions.emplace_back (turn * Eigen::Vector3d (depth * place.homogeneous ()));
    frame.pixels.push_back (pixel);
  }
  frame.places = placesOf (positions);
  return frame;
}

TEST (LatticeView, CamerasOfAllKinds)
{
  std::vector<CameraOptions> kinds (7);
  kinds[1].is_mirrored = true;
  kinds[2].distortion = -0.3;
  kinds[3].jitter = 0.1;
  kinds[4].lost = 0.0;
  kinds[4].holes = 0;
  kinds[5].row_distance = 5.0;
  kinds[6].holes = 12;
  for (std::size_t kind = 0; kind < kinds.size (); ++kind)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      SCOPED_TRACE (std::to_string (kind) + ", seed " + std::to_string (seed));
      expectSameTriangles (makeFrame (kinds[kind], seed));
    }
}

/// All four corners of each cell are on one circle, exactly.
TEST (LatticeView, CirclesOfFourPoints)
{
  Frame frame;
  frame.width = 40;
  for (Index pixel = 0; pixel < 40 * 30; ++pixel)
    if (pixel % 97 != 0) {
      frame.places.emplace_back (pixel % 40, pixel / 40);
      frame.pixels.push_back (pixel);
    }
  expectSameTriangles (frame);
}

TEST (LatticeView, GivesUpWherePixelsTellNothing)
{
  // The rays have another order than the pixels.
  Frame frame = makeFrame (CameraOptions (), 1);
  std::shuffle (frame.pixels.begin (), frame.pixels.end (), std::mt19937 (2));
  EXPECT_FALSE (triangulate (frame));
  // More pixels are lost than not.
  CameraOptions sparse;
  sparse.lost = 0.7;
  frame = makeFrame (sparse, 1);
  EXPECT_FALSE (triangulate (frame));
}

/// The frame of a scanner with one pixel for each degree.
Frame
turningFrame (std::size_t width)
{
  Frame frame;
  frame.width = width;
  std::vector<Eigen::Vector3d> positions;
  for (Index pixel = 0; pixel < width * 40; ++pixel) {
    const double turn = DEGREE * static_cast<double> (pixel % width);
    const double up = DEGREE * static_cast<double> (pixel / width) - 0.3;
    positions.emplace_back (std::cos (turn) * std::cos (up), std::sin (turn) * std::cos (up),
                            std::sin (up));
    frame.pixels.push_back (pixel);
  }
  frame.places = placesOf (positions);
  return frame;
}

/// A full turn ends where it began, and more than that sees some of it twice.
TEST (LatticeView, GivesUpWhereTheFrameOverlapsItself)
{
  expectSameTriangles (turningFrame (360));
  EXPECT_FALSE (triangulate (turningFrame (400)));
}

} // namespace
} // namespace pcl::floater
