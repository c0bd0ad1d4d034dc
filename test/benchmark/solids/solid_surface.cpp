// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_surface.h"

#include "random_body.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl
{
namespace floater
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;
namespace processing = CGAL::Polygon_mesh_processing;
namespace simplification = CGAL::Surface_mesh_simplification;

constexpr std::size_t FEWEST = 1500, MOST = 60000; // vertices

enum class Spread
{
  EVEN,           // by isotropic remeshing
  QUADRIC,        // thinned out by the quadric error (Garland and Heckbert 1997)
  MEMORYLESS,     // by Lindstrom and Turk (1998)
  MARCHING_CUBES, // as they come
  COUNT
};

double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

Eigen::Vector3d
toEigen (const Kernel::Point_3& p)
{
  return {p.x (), p.y (), p.z ()};
}

Kernel::Point_3
toCgal (const Eigen::Vector3d& p)
{
  return {p.x (), p.y (), p.z ()};
}

// \return nothing if it is no manifold
std::optional<Mesh>
toMesh (vtkPolyData* surface)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints (); ++i)
    vertices.push_back (mesh.add_vertex (toCgal (Eigen::Vector3d (surface->GetPoint (i)))));
  vtkCellArray* const polygons = surface->GetPolys ();
  polygons->InitTraversal ();
  vtkIdType corners = 0;
  for (const vtkIdType* ids = nullptr; polygons->GetNextCell (corners, ids) != 0;)
    if (mesh.add_face (vertices[static_cast<std::size_t> (ids[0])],
                       vertices[static_cast<std::size_t> (ids[1])],
                       vertices[static_cast<std::size_t> (ids[2])]) == Mesh::null_face ())
      return {};
  return mesh;
}

std::optional<Mesh>
marchingCubes (const RandomBody& body, int cells)
{
  const double step = 3.0 / (cells - 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions (cells, cells, cells);
  image->SetSpacing (step, step, step);
  image->SetOrigin (-1.5, -1.5, -1.5);
  image->AllocateScalars (VTK_FLOAT, 1);
  auto* value = static_cast<float*> (image->GetScalarPointer ());
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        *value++ = static_cast<float> (
            body.distance (Eigen::Vector3d (i, j, k) * step - Eigen::Vector3d::Constant (1.5)));
  vtkNew<vtkFlyingEdges3D> cubes;
  cubes->SetInputData (image);
  cubes->SetValue (0, 1e-5 * step); // seldom a vertex of the grid itself
  cubes->ComputeNormalsOff ();
  cubes->ComputeGradientsOff ();
  cubes->Update ();
  return toMesh (cubes->GetOutput ());
}

void
keepLargestComponent (Mesh& mesh)
{
  mesh.collect_garbage ();
  processing::keep_largest_connected_components (mesh, 1);
  mesh.collect_garbage ();
}

double
meanEdge (const Mesh& mesh)
{
  double sum = 0.0;
  for (const auto edge : mesh.edges ())
    sum += (toEigen (mesh.point (mesh.vertex (edge, 0))) -
            toEigen (mesh.point (mesh.vertex (edge, 1))))
               .norm ();
  return sum / static_cast<double> (mesh.number_of_edges ());
}

bool
cutByPlane (Mesh& mesh, RandomStream& random)
{
  Eigen::Vector3d normal (random.normal (), random.normal (), random.normal ());
  normal.normalize ();
  processing::clip (
      mesh, Kernel::Plane_3 (normal.x (), normal.y (), normal.z (), between (random, -0.2, 0.2)));
  keepLargestComponent (mesh);
  return mesh.number_of_faces () > FEWEST;
}

bool
cutWindow (Mesh& mesh, double radius, RandomStream& random)
{
  auto face = mesh.faces ().begin ();
  std::advance (face, static_cast<std::ptrdiff_t> (random.below (mesh.number_of_faces ())));
  const Eigen::Vector3d centre = toEigen (mesh.point (mesh.target (mesh.halfedge (*face))));
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius (radius);
  sphere->SetCenter (centre.x (), centre.y (), centre.z ());
  sphere->SetThetaResolution (24);
  sphere->SetPhiResolution (16);
  sphere->Update ();
  std::optional<Mesh> ball = toMesh (sphere->GetOutput ());
  if (!ball)
    return false;
  if (processing::is_outward_oriented (*ball))
    processing::reverse_face_orientations (*ball); // what is outside is kept
  processing::clip (mesh, *ball, CGAL::parameters::clip_volume (false));
  keepLargestComponent (mesh);
  return mesh.number_of_faces () > FEWEST;
}

// Remeshing cuts corners: moves the vertices back, along the gradient.
void
moveToSurface (Mesh& mesh, const RandomBody& body, double edge)
{
  constexpr double STEP = 1e-4;
  for (const auto v : mesh.vertices ()) {
    if (mesh.is_border (v))
      continue;
    Eigen::Vector3d at = toEigen (mesh.point (v));
    for (int i = 0; i < 3; ++i) {
      Eigen::Vector3d gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = STEP * Eigen::Vector3d::Unit (axis);
        gradient[axis] = (body.distance (at + step) - body.distance (at - step)) / (2.0 * STEP);
      }
      const double square = gradient.squaredNorm ();
      const Eigen::Vector3d move = gradient * (body.distance (at) / square);
      if (square < 1e-6 || move.norm () > 0.3 * edge)
        break;
      at -= move;
    }
    mesh.point (v) = toCgal (at);
  }
}

void
thinOut (Mesh& mesh, Spread spread, double share)
{
  const simplification::Count_ratio_stop_predicate<Mesh> stop (share);
  if (spread == Spread::QUADRIC) {
    using Policies = simplification::GarlandHeckbert_plane_policies<Mesh, Kernel>;
    const Policies policies (mesh);
    simplification::edge_collapse (mesh, stop,
                                   CGAL::parameters::get_cost (policies.get_cost ())
                                       .get_placement (policies.get_placement ())
                                       .filter (simplification::Bounded_normal_change_filter<> ()));
  }
  else
    simplification::edge_collapse (mesh, stop);
  mesh.collect_garbage ();
}

void
spreadVertices (Mesh& mesh, Spread spread, const RandomBody& body, RandomStream& random)
{
  const double edge = meanEdge (mesh);
  const double even_edge = spread == Spread::EVEN ? between (random, 1.0, 2.0) : 0.9;
  auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool> ("e:sharp", false).first;
  if (body.hasSharpSeams ())
    processing::detect_sharp_edges (mesh, 60.0, is_sharp);
  processing::isotropic_remeshing (mesh.faces (), even_edge * edge, mesh,
                                   processing::parameters::number_of_iterations (4)
                                       .edge_is_constrained_map (is_sharp)
                                       .protect_constraints (false));
  if (!body.hasSharpSeams ())
    moveToSurface (mesh, body, edge);
  if (spread != Spread::EVEN)
    thinOut (mesh, spread, between (random, 0.25, 0.8));
  mesh.collect_garbage ();
}

// Triangles with two edges on the border, until there is none.
void
removeEars (Mesh& mesh)
{
  for (bool has_changed = true; has_changed;) {
    std::vector<Face> ears;
    for (const Face face : mesh.faces ()) {
      int border = 0;
      for (const auto edge : mesh.halfedges_around_face (mesh.halfedge (face)))
        border += mesh.is_border (mesh.opposite (edge)) ? 1 : 0;
      if (border >= 2)
        ears.push_back (face);
    }
    for (const Face face : ears)
      CGAL::Euler::remove_face (mesh.halfedge (face), mesh);
    mesh.collect_garbage ();
    has_changed = !ears.empty ();
  }
}

bool
touchesItself (const Mesh& mesh)
{
  for (const auto v : mesh.vertices ()) {
    int border = 0;
    for (const auto edge : mesh.halfedges_around_target (mesh.halfedge (v)))
      border += mesh.is_border (edge) ? 1 : 0;
    if (border > 1)
      return true;
  }
  return false;
}

SolidSurface
toSurface (const Mesh& mesh)
{
  SolidSurface surface;
  std::vector<Index> place (mesh.num_vertices ());
  for (const auto v : mesh.vertices ()) {
    place[v] = static_cast<Index> (surface.positions.size ());
    // As a file of single precision holds it.
    surface.positions.push_back (toEigen (mesh.point (v)).cast<float> ().cast<double> ());
  }
  for (const Face face : mesh.faces ()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face (mesh.halfedge (face)))
      triangle[corner++] = place[v];
    surface.triangles.push_back (triangle);
  }
  return surface;
}

} // namespace

std::optional<SolidSurface>
makeSolidSurface (std::uint64_t seed)
{
  RandomStream random (seed);
  const auto spread = static_cast<Spread> (random.below (static_cast<std::size_t> (Spread::COUNT)));
  const bool is_thinned_out = spread == Spread::QUADRIC || spread == Spread::MEMORYLESS;
  const RandomBody body (!is_thinned_out, random);
  std::optional<Mesh> made = marchingCubes (body, 80 + static_cast<int> (random.below (90)));
  if (!made || made->number_of_faces () < FEWEST)
    return {};
  Mesh& mesh = *made;
  keepLargestComponent (mesh);
  processing::orient_to_bound_a_volume (mesh);
  std::string description[] = {"even", "quadric", "memoryless", "marching cubes"};
  std::string text = description[static_cast<std::size_t> (spread)];
  text += body.hasSharpSeams () ? ", sharp" : ", smooth";
  if (spread != Spread::MARCHING_CUBES) { // where cuts would leave slivers
    const std::size_t cut = random.below (3);
    const double edge = meanEdge (mesh);
    if (cut == 1) {
      text += ", cut";
      if (!cutByPlane (mesh, random))
        return {};
    }
    const std::size_t windows = cut == 2 ? 1 + random.below (4) : 0;
    for (std::size_t i = 0; i < windows; ++i)
      if (!cutWindow (mesh, edge * between (random, 3.0, 12.0), random))
        return {};
    if (windows > 0)
      text += ", " + std::to_string (windows) + (windows == 1 ? " window" : " windows");
    spreadVertices (mesh, spread, body, random);
  }
  removeEars (mesh);
  keepLargestComponent (mesh);
  if (mesh.number_of_vertices () < FEWEST || mesh.number_of_vertices () > MOST ||
      touchesItself (mesh))
    return {};
  SolidSurface surface = toSurface (mesh);
  surface.description = text;
  return surface;
}

} // namespace floater
} // namespace pcl
