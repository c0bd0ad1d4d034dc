// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The view of an organized cloud has the triangles of the ordinary Delaunay triangulation.
#include "view/lattice_view.h"

#include "floater/planar_delaunay.h"
#include "view/rays.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
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

void
expectSameTriangles (const Frame& frame)
{
  for (const int threads : {1, 3}) {
    const std::optional<TriangleMesh> mesh =
        triangulateLattice (frame.places, frame.pixels, frame.width, threads);
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
  std::mt19937 random (seed);
  std::uniform_real_distribution<double> uniform (0.0, 1.0);
  std::normal_distribution<double> normal;
  const double w = static_cast<double> (options.width), h = static_cast<double> (options.height);
  struct Hole
  {
    double x, y, radius;
  };
  std::vector<Hole> holes;
  for (int i = 0; i < options.holes; ++i)
    holes.push_back ({w * uniform (random), h * uniform (random), 10.0 * uniform (random)});
  Eigen::Quaterniond turn;
  turn.coeffs () << normal (random), normal (random), normal (random), normal (random);
  turn.normalize ();
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> pixels;
  for (std::size_t row = 0; row < options.height; ++row)
    for (std::size_t column = 0; column < options.width; ++column) {
      const double x = static_cast<double> (column), y = static_cast<double> (row);
      if (uniform (random) < options.lost ||
          std::any_of (holes.begin (), holes.end (), [&] (const Hole& hole) {
            return std::hypot (hole.x - x, hole.y - y) < hole.radius;
          }))
        continue;
      Eigen::Vector2d place ((x - 0.5 * w + options.jitter * normal (random)) / w,
                             (y - 0.5 * h + options.jitter * normal (random)) / w *
                                 options.row_distance);
      place *= 1.0 + options.distortion * place.squaredNorm ();
      const double depth = 1.0 + uniform (random);
      positions.emplace_back (turn *
                              Eigen::Vector3d ((options.is_mirrored ? -depth : depth) * place.x (),
                                               depth * place.y (), depth));
      pixels.push_back (static_cast<Index> (row * options.width + column));
    }
  // The order of the points is not that of the pixels.
  std::vector<std::size_t> order (pixels.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  std::shuffle (order.begin (), order.end (), random);
  Frame frame;
  frame.width = options.width;
  std::vector<Eigen::Vector3d> shuffled;
  for (const std::size_t i : order) {
    shuffled.push_back (positions[i]);
    frame.pixels.push_back (pixels[i]);
  }
  frame.places = makeRays (shuffled, {Eigen::Vector3d::Zero (), false}, 1).places;
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

/// Moves some points towards others by at most a share of the way.
void
movePixels (Frame& frame, double share, std::uint64_t seed)
{
  std::mt19937 random (seed);
  for (int i = 0; i < 12; ++i) {
    const std::size_t p = random () % frame.places.size ();
    const std::size_t q = random () % frame.places.size ();
    frame.places[p] += share * std::uniform_real_distribution<double> () (random) *
                       (frame.places[q] - frame.places[p]);
  }
}

CameraOptions
whole ()
{
  CameraOptions options;
  options.lost = 0.002;
  options.holes = 1;
  return options;
}

/// Where circles through the pixels are not empty, cells are left to the ordinary triangulation.
TEST (LatticeView, PixelsThatAreMovedALittle)
{
  constexpr double BELOW_A_PIXEL = 0.008; // of the diagonal
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE (seed);
    Frame frame = makeFrame (whole (), seed);
    movePixels (frame, BELOW_A_PIXEL, seed);
    expectSameTriangles (frame);
  }
}

/// A point that is moved farther may lie in the cell of other pixels.
TEST (LatticeView, PixelsThatAreMovedFar)
{
  int given_up = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE (seed);
    Frame frame = makeFrame (whole (), seed);
    movePixels (frame, 0.5, seed);
    if (triangulateLattice (frame.places, frame.pixels, frame.width, 1))
      expectSameTriangles (frame);
    else
      ++given_up;
  }
  EXPECT_GT (given_up, 0);
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

/// A point may be at the place of the sensor, which is nowhere in the plane.
TEST (LatticeView, PlacesThatAreNotFinite)
{
  Frame frame = makeFrame (CameraOptions (), 3);
  for (const std::size_t p : {std::size_t{5}, frame.places.size () / 2})
    frame.places[p].setConstant (std::nan (""));
  expectSameTriangles (frame);
}

TEST (LatticeView, GivesUpWherePixelsTellNothing)
{
  // The rays have another order than the pixels.
  Frame frame = makeFrame (CameraOptions (), 1);
  std::shuffle (frame.pixels.begin (), frame.pixels.end (), std::mt19937 (2));
  EXPECT_FALSE (triangulateLattice (frame.places, frame.pixels, frame.width, 1));
  // More pixels are lost than not.
  CameraOptions sparse;
  sparse.lost = 0.7;
  frame = makeFrame (sparse, 1);
  EXPECT_FALSE (triangulateLattice (frame.places, frame.pixels, frame.width, 1));
}

/// The frame of a scanner that turns by more than a full turn sees some of it twice.
TEST (LatticeView, GivesUpWhereTheFrameOverlapsItself)
{
  Frame frame;
  frame.width = 400;
  std::vector<Eigen::Vector3d> positions;
  for (Index pixel = 0; pixel < 400 * 40; ++pixel) {
    const double turn = 0.0173 * (pixel % 400), up = 0.0173 * (pixel / 400) - 0.3; // 6.92 radians
    positions.emplace_back (std::cos (turn) * std::cos (up), std::sin (turn) * std::cos (up),
                            std::sin (up));
    frame.pixels.push_back (pixel);
  }
  frame.places = makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1).places;
  EXPECT_FALSE (triangulateLattice (frame.places, frame.pixels, frame.width, 1));
}

/// A full turn ends where it began; nothing overlaps.
TEST (LatticeView, AFullTurn)
{
  Frame frame;
  frame.width = 360;
  std::vector<Eigen::Vector3d> positions;
  for (Index pixel = 0; pixel < 360 * 40; ++pixel) {
    const double turn = M_PI / 180.0 * (pixel % 360), up = M_PI / 180.0 * (pixel / 360) - 0.3;
    positions.emplace_back (std::cos (turn) * std::cos (up), std::sin (turn) * std::cos (up),
                            std::sin (up));
    frame.pixels.push_back (pixel);
  }
  frame.places = makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1).places;
  expectSameTriangles (frame);
}

} // namespace
} // namespace pcl::floater
