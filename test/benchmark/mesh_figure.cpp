// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Figure 6 of TW 385: mesh, parameterization, and what it is like where it is densest.
#include "floater/planar_delaunay.h"
#include "mesh/finish.h"
#include "mesh_measures.h"
#include "mesh_picture.h"
#include "picture_files.h"
#include "points/kd_tree.h"
#include "section.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int HEIGHT = 600;           // pixels
constexpr std::size_t CLOSE_UP = 500; // points of the close-up
constexpr std::size_t DENSITY_K = 7;  // nearest points, the point itself among them

// The triangles with the points that they use, centred and scaled to the size of 1 so that single
// precision of the graphics will do even where points are 1e-12 apart.
vtkSmartPointer<vtkPolyData>
makePolyData (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles)
{
  std::vector<Index> used;
  for (const Triangle& t : triangles)
    used.insert (used.end (), t.begin (), t.end ());
  std::sort (used.begin (), used.end ());
  used.erase (std::unique (used.begin (), used.end ()), used.end ());
  Eigen::AlignedBox3d box;
  for (const Index p : used)
    box.extend (positions[p]);

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble ();
  for (const Index p : used) {
    const Eigen::Vector3d scaled = (positions[p] - box.center ()) / box.sizes ().maxCoeff ();
    points->InsertNextPoint (scaled.data ());
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : triangles) {
    std::array<vtkIdType, 3> corners{};
    std::transform (t.begin (), t.end (), corners.begin (), [&used] (Index p) {
      return std::lower_bound (used.begin (), used.end (), p) - used.begin ();
    });
    cells->InsertNextCell (3, corners.data ());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New ();
  mesh->SetPoints (points);
  mesh->SetPolys (cells);
  return mesh;
}

// Points around the one whose nearest points in the plane are nearest; 1 for those.
std::vector<std::uint8_t>
densestPoints (const std::vector<Eigen::Vector3d>& flat)
{
  const KdTree tree (flat);
  std::vector<Neighbor> nearest;
  std::pair<double, Index> densest{std::numeric_limits<double>::infinity (), 0};
  for (Index p = 0; p < flat.size (); ++p) {
    tree.nearest (flat[p], DENSITY_K, nearest);
    densest = std::min (densest, {nearest.back ().sqr_distance, p});
  }
  tree.nearest (flat[densest.second], CLOSE_UP, nearest);
  std::vector<std::uint8_t> chosen (flat.size (), 0);
  for (const Neighbor& neighbor : nearest)
    chosen[neighbor.point] = 1;
  return chosen;
}

std::vector<unsigned char>
picture (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
         const std::vector<Eigen::Vector3d>& flat, const std::vector<Triangle>& in_plane)
{
  const vtkSmartPointer<vtkPolyData> plane = makePolyData (flat, in_plane);
  PictureOptions options;
  options.parameterization = plane;
  return toPng (drawMesh (makePolyData (positions, triangles), HEIGHT, options));
}

class MeshFigure : public Section
{
public:
  void measure (const Sample& sample) override
  {
    const DiscStages& disc = sample.disc;
    TriangleMesh mesh = triangulatePlane (sample.direct, disc.boundary.loop);
    const std::vector<Triangle> in_plane = mesh.triangles;
    LocalGeometry geometry = disc.geometry;
    finishMesh (mesh, disc.points.positions, geometry, {}, 1);

    // Points that the system leaves out are in no triangle of the plane; far away they do not
    // disturb.
    std::vector<Eigen::Vector3d> flat;
    for (const Eigen::Vector2d& uv : sample.direct)
      flat.emplace_back (
          uv.allFinite ()
              ? Eigen::Vector3d (uv.x (), uv.y (), 0.0)
              : Eigen::Vector3d (FAR_AWAY * static_cast<double> (flat.size () + 2), 0.0, 0.0));
    const std::vector<std::uint8_t> chosen = densestPoints (flat);
    const auto closeUp = [&chosen] (const std::vector<Triangle>& triangles) {
      std::vector<Triangle> inside;
      std::copy_if (triangles.begin (), triangles.end (), std::back_inserter (inside),
                    [&] (const Triangle& t) {
                      return std::all_of (t.begin (), t.end (),
                                          [&] (Index p) { return chosen[p] != 0; });
                    });
      return inside;
    };
    Eigen::AlignedBox3d window;
    for (Index p = 0; p < flat.size (); ++p)
      if (chosen[p] != 0)
        window.extend (flat[p]);

    figures_.push_back ({"figure6_mesh_" + disc.name,
                         picture (disc.points.positions, mesh.triangles, flat, in_plane),
                         disc.name + ": mesh of " + grouped (mesh.triangles.size ()) +
                             " triangles, and its parameterization"});
    figures_.push_back (
        {"figure6_close_up_" + disc.name,
         picture (disc.points.positions, closeUp (mesh.triangles), flat, closeUp (in_plane)),
         disc.name + ": the " + std::to_string (CLOSE_UP) +
             " points where the plane is densest, on the surface and in the plane. The "
             "window in the plane is " +
             scientific (window.sizes ().maxCoeff ()) +
             " wide in a circle of radius 1; the smallest distance of two points is " +
             scientific (smallestDistance (sample.direct))});
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Figure 6: meshes and parameterizations");
    for (const Figure& figure : figures_)
      report.picture (figure.name, figure.png, figure.caption);
  }

private:
  static constexpr double FAR_AWAY = 1e3;
  struct Figure
  {
    std::string name;
    std::vector<unsigned char> png;
    std::string caption;
  };
  std::vector<Figure> figures_;
};

} // namespace

std::unique_ptr<Section>
makeMeshFigure ()
{
  return std::make_unique<MeshFigure> ();
}

} // namespace floater
} // namespace pcl
