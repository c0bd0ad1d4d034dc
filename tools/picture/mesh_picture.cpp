// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_picture.h"

#include "cloud_reader.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolyDataReader.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <X11/Xlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int SUPERSAMPLING = 2; // pixels drawn per pixel of the picture, in each direction
constexpr vtkIdType MOST_DRAWN_EDGES = 15000; // polygons of a shaded mesh up to which edges show
constexpr int STRONGEST_COMPRESSION = 9;      // of a PNG file
constexpr int COLOUR_STEP = 5;                // of 256 levels of each colour
constexpr double MARGIN = 1.06;               // side of the picture over that of the mesh in it
constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double CLOSED = 1e-3;         // a mesh with a shorter mean normal counts as closed
constexpr double ONE_SIDED = 0.55;      // a mesh with a longer mean normal faces one way ...
constexpr double SHEET = 0.8;           // ... and is a sheet if it is longer than this
constexpr double NEARLY_PARALLEL = 0.8; // cosine
constexpr double TIP_BACK = 50.0, FROM_ABOVE = 15.0, TURN = 20.0; // degrees

using Colour = std::array<double, 3>;
constexpr Colour FRONT{0.56, 0.69, 0.85}, BACK{0.93, 0.66, 0.40}, BOUNDARY{0.83, 0.06, 0.13},
    EDGE{0.18, 0.27, 0.40}, MARK{0.90, 0.0, 0.85}, PAPER{1.0, 1.0, 1.0};

struct View
{
  Eigen::Vector3d towards_viewer, up;
};

std::vector<Eigen::Vector3d>
pointsOf (vtkPolyData* mesh)
{
  std::vector<Eigen::Vector3d> points (static_cast<std::size_t> (mesh->GetNumberOfPoints ()));
  for (std::size_t i = 0; i < points.size (); ++i)
    mesh->GetPoint (static_cast<vtkIdType> (i), points[i].data ());
  return points;
}

Eigen::Vector3d
centreOf (const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    sum += p;
  return sum / static_cast<double> (points.size ());
}

// Mean of the unit normals, weighted by area, on the outer side if the surface bulges. The longer
// it is, the more of the mesh faces one way.
Eigen::Vector3d
meanNormal (vtkPolyData* mesh, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d centre = centreOf (points);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  double area = 0.0, volume = 0.0; // twice the area, six times the volume seen from the centre
  vtkNew<vtkIdList> polygon;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells (); ++cell) {
    mesh->GetCellPoints (cell, polygon);
    for (vtkIdType i = 2; i < polygon->GetNumberOfIds (); ++i) {
      const auto corner = [&] (vtkIdType j) -> const Eigen::Vector3d& {
        return points[static_cast<std::size_t> (polygon->GetId (j))];
      };
      const Eigen::Vector3d normal = (corner (i - 1) - corner (0)).cross (corner (i) - corner (0));
      sum += normal;
      area += normal.norm ();
      volume += normal.dot (corner (0) - centre);
    }
  }
  if (!(area > 0.0))
    return Eigen::Vector3d::Zero ();
  return (volume < 0.0 && sum.norm () < SHEET * area ? -1.0 : 1.0) / area * sum;
}

Eigen::Vector3d
axisOfLeastVariance (const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d centre = centreOf (points);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    covariance += (p - centre) * (p - centre).transpose ();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver (covariance);
  const Eigen::Vector3d axis = solver.eigenvectors ().col (0);
  return axis.sum () < 0.0 ? Eigen::Vector3d (-axis) : axis;
}

// A mesh that faces one way is seen from there, and a sheet is tipped back; up is y, as in scans,
// or z. A mesh that faces all ways is seen along its axis of least variance; if it is open, its
// opening is below, because the mean normal points away from it.
View
chooseView (vtkPolyData* mesh, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d normal = meanNormal (mesh, points);
  Eigen::Vector3d facing = normal.normalized (), up = Eigen::Vector3d::UnitY ();
  if (normal.norm () <= ONE_SIDED) {
    facing = axisOfLeastVariance (points);
    if (normal.norm () > CLOSED)
      up = normal.normalized ();
  }
  if (std::abs (facing.dot (up)) > NEARLY_PARALLEL)
    (normal.norm () <= ONE_SIDED ? facing : up) = Eigen::Vector3d::UnitZ ();
  if (std::abs (facing.dot (up)) > NEARLY_PARALLEL)
    facing = up.unitOrthogonal ();

  const Eigen::Vector3d right = up.cross (facing).normalized ();
  facing = right.cross (up);
  const double tilt = normal.norm () > SHEET ? TIP_BACK : -FROM_ABOVE;
  const Eigen::Vector3d tilted = Eigen::AngleAxisd (tilt * DEGREE, right) * facing;
  return {Eigen::AngleAxisd (TURN * DEGREE, up) * tilted, up};
}

vtkSmartPointer<vtkActor>
makeActor (vtkPolyDataMapper* mapper, const Colour& colour)
{
  mapper->ScalarVisibilityOff ();
  vtkNew<vtkActor> actor;
  actor->SetMapper (mapper);
  actor->GetProperty ()->SetColor (colour[0], colour[1], colour[2]);
  return actor;
}

// Draws lines that lie on the surface.
void
addLines (vtkRenderer* renderer, vtkPolyData* edges, const Colour& colour)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData (edges);
  mapper->SetResolveCoincidentTopologyToPolygonOffset ();
  const vtkSmartPointer<vtkActor> lines = makeActor (mapper, colour);
  lines->GetProperty ()->LightingOff ();
  lines->GetProperty ()->SetLineWidth (2.0F * SUPERSAMPLING);
  renderer->AddActor (lines);
}

void
addBoundary (vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData (mesh);
  edges->BoundaryEdgesOn ();
  edges->FeatureEdgesOff ();
  edges->ManifoldEdgesOff ();
  edges->NonManifoldEdgesOff ();
  edges->ColoringOff ();
  edges->Update ();
  addLines (renderer, edges->GetOutput (), BOUNDARY);
}

bool
edgesShow (vtkPolyData* mesh)
{
  return mesh->GetNumberOfPolys () <= MOST_DRAWN_EDGES;
}

void
addSurface (vtkRenderer* renderer, vtkPolyData* mesh, bool flat_shading)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData (mesh);
  normals->SplittingOff ();
  normals->ConsistencyOff (); // keep the orientation of the mesh
  normals->AutoOrientNormalsOff ();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection (normals->GetOutputPort ());
  const vtkSmartPointer<vtkActor> surface = makeActor (mapper, FRONT);
  if (flat_shading)
    surface->GetProperty ()->SetInterpolationToFlat ();
  surface->GetProperty ()->SetEdgeVisibility (edgesShow (mesh) ? 1 : 0);
  surface->GetProperty ()->SetEdgeColor (EDGE[0], EDGE[1], EDGE[2]);
  vtkNew<vtkProperty> back;
  back->DeepCopy (surface->GetProperty ());
  back->SetColor (BACK[0], BACK[1], BACK[2]);
  surface->SetBackfaceProperty (back);
  renderer->AddActor (surface);
  addBoundary (renderer, mesh);
}

// The mesh with an image on it, both sides alike.
// \param is_lit false: the image as it is
void
addTextured (vtkRenderer* renderer, vtkPolyData* mesh, vtkImageData* image, bool is_lit)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData (mesh);
  normals->SplittingOff ();
  normals->ConsistencyOff ();
  normals->AutoOrientNormalsOff ();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection (normals->GetOutputPort ());
  const vtkSmartPointer<vtkActor> surface = makeActor (mapper, PAPER);
  vtkNew<vtkTexture> texture;
  texture->SetInputData (image);
  texture->InterpolateOn ();
  texture->MipmapOn ();
  surface->SetTexture (texture);
  if (!is_lit)
    surface->GetProperty ()->LightingOff ();
  renderer->AddActor (surface);
}

// The mesh as its texture coordinates place it.
vtkSmartPointer<vtkPolyData>
flattened (vtkPolyData* mesh)
{
  vtkNew<vtkPolyData> flat;
  flat->DeepCopy (mesh);
  vtkDataArray* coordinates = mesh->GetPointData ()->GetTCoords ();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints (); ++i) {
    const double* uv = coordinates->GetTuple2 (i);
    flat->GetPoints ()->SetPoint (i, std::max (uv[0], 0.0), std::max (uv[1], 0.0), 0.0);
  }
  return flat;
}

// VTK does not know s and t of PLY files.
void
readCoordinatesOfPly (const std::string& path, vtkPolyData* mesh)
{
  const Cloud cloud = readCloud (path);
  const Field *s = cloud.find ("s"), *t = cloud.find ("t");
  if (s == nullptr || t == nullptr ||
      cloud.size () != static_cast<std::size_t> (mesh->GetNumberOfPoints ()))
    return;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents (2);
  coordinates->SetNumberOfTuples (mesh->GetNumberOfPoints ());
  for (std::size_t i = 0; i < cloud.size (); ++i)
    coordinates->SetTuple2 (static_cast<vtkIdType> (i), s->asDouble (i), t->asDouble (i));
  mesh->GetPointData ()->SetTCoords (coordinates);
}

void
addWireframe (vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData (mesh);
  const vtkSmartPointer<vtkActor> wires = makeActor (mapper, EDGE);
  wires->GetProperty ()->LightingOff ();
  wires->GetProperty ()->SetRepresentationToWireframe ();
  wires->GetProperty ()->SetOpacity (edgesShow (mesh) ? 1.0 : 0.2);
  renderer->AddActor (wires);
  addBoundary (renderer, mesh);
}

// One light over the left shoulder of the viewer, and a weaker one from the lower right.
void
addLights (vtkRenderer* renderer)
{
  for (const auto& [x, y, z, intensity] :
       {std::array<double, 4>{-0.8, 1.0, 1.0, 0.9}, std::array<double, 4>{1.0, -0.6, 0.8, 0.55}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight ();
    light->SetPosition (x, y, z);
    light->SetFocalPoint (0.0, 0.0, 0.0);
    light->SetIntensity (intensity);
    renderer->AddLight (light);
  }
}

// Parallel projection, scaled so that the points fill the square picture.
void
aimCamera (vtkRenderer* renderer, const View& view, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d right = view.up.cross (view.towards_viewer).normalized ();
  const Eigen::Vector3d up = view.towards_viewer.cross (right).normalized ();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points)
    box.extend (Eigen::Vector3d (right.dot (p), up.dot (p), view.towards_viewer.dot (p)));
  const Eigen::Vector3d middle = box.center ();
  const Eigen::Vector3d focus =
      middle.x () * right + middle.y () * up + middle.z () * view.towards_viewer;
  const Eigen::Vector3d position = focus + box.diagonal ().norm () * view.towards_viewer;
  vtkCamera* camera = renderer->GetActiveCamera ();
  camera->ParallelProjectionOn ();
  camera->SetFocalPoint (focus.data ());
  camera->SetPosition (position.data ());
  camera->SetViewUp (up.data ());
  camera->SetParallelScale (0.5 * MARGIN * std::max (box.sizes ().x (), box.sizes ().y ()));
  renderer->ResetCameraClippingRange ();
}

// Perspective from a viewpoint, along the mean direction to the points. The vertical is z, or -y as
// in depth cameras if they look along z.
// \return whether all points can be seen so
bool
aimFromViewpoint (vtkRenderer* renderer, const Eigen::Vector3d& viewpoint,
                  const std::vector<Eigen::Vector3d>& points)
{
  constexpr double WIDEST = 60.0, ALONG_Z = 0.8; // degrees on either side; a cosine
  Eigen::Vector3d mean = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    mean += (p - viewpoint).normalized ();
  mean.normalize ();
  double least = 1.0;
  for (const Eigen::Vector3d& p : points)
    least = std::min (least, mean.dot ((p - viewpoint).normalized ()));
  const double angle = std::acos (least) / DEGREE;
  if (!(angle < WIDEST))
    return false;
  const Eigen::Vector3d focus = viewpoint + mean;
  vtkCamera* camera = renderer->GetActiveCamera ();
  camera->SetPosition (viewpoint.data ());
  camera->SetFocalPoint (focus.data ());
  if (mean.z () > ALONG_Z)
    camera->SetViewUp (0.0, -1.0, 0.0);
  else
    camera->SetViewUp (0.0, 0.0, 1.0);
  camera->SetViewAngle (2.0 * angle);
  renderer->ResetCameraClippingRange ();
  return true;
}

// Rounds the colours, which is invisible and makes the file a third smaller.
void
coarsenColours (vtkImageData* image)
{
  const vtkIdType values = image->GetNumberOfPoints () * image->GetNumberOfScalarComponents ();
  auto* value = static_cast<unsigned char*> (image->GetScalarPointer ());
  for (vtkIdType i = 0; i < values; ++i)
    value[i] = static_cast<unsigned char> (
        std::min (255, (value[i] + COLOUR_STEP / 2) / COLOUR_STEP * COLOUR_STEP));
}

} // namespace

bool
displayAvailable ()
{
  Display* display = XOpenDisplay (nullptr);
  if (display != nullptr)
    XCloseDisplay (display);
  return display != nullptr;
}

vtkSmartPointer<vtkPolyData>
readMesh (const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file (path, error))
    throw std::runtime_error ("cannot read '" + path + "': there is no such file");
  std::string extension = std::filesystem::path (path).extension ().string ();
  std::transform (extension.begin (), extension.end (), extension.begin (),
                  [] (unsigned char c) { return static_cast<char> (std::tolower (c)); });
  vtkSmartPointer<vtkPolyData> mesh;
  if (extension == ".ply") {
    vtkNew<vtkPLYReader> reader;
    reader->SetFileName (path.c_str ());
    reader->Update ();
    mesh = reader->GetOutput ();
    if (mesh != nullptr && mesh->GetNumberOfPolys () > 0 &&
        mesh->GetPointData ()->GetTCoords () == nullptr)
      readCoordinatesOfPly (path, mesh);
  }
  else if (extension == ".vtk") {
    vtkNew<vtkPolyDataReader> reader;
    reader->SetFileName (path.c_str ());
    reader->Update ();
    mesh = reader->GetOutput ();
  }
  else
    throw std::runtime_error ("cannot read '" + path + "': its extension must be .vtk or .ply");
  if (mesh == nullptr || mesh->GetNumberOfPolys () == 0)
    throw std::runtime_error ("cannot read '" + path + "': it has no polygons");
  return mesh;
}

vtkSmartPointer<vtkImageData>
makeCheckerboard ()
{
  constexpr int SQUARES = 32, FIELDS = 8, PIXELS = 32; // pixels along a square
  constexpr int SIDE = SQUARES * PIXELS;
  vtkNew<vtkImageData> image;
  image->SetDimensions (SIDE, SIDE, 1);
  image->AllocateScalars (VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x) {
      const int field_x = x * FIELDS / SIDE, field_y = y * FIELDS / SIDE;
      const bool is_dark = (x / PIXELS + y / PIXELS) % 2 != 0;
      const std::array<double, 3> colour{0.35 + 0.65 * field_x / (FIELDS - 1),
                                         0.35 + 0.65 * field_y / (FIELDS - 1),
                                         1.0 - 0.5 * (field_x + field_y) / (2.0 * (FIELDS - 1))};
      auto* pixel = static_cast<unsigned char*> (image->GetScalarPointer (x, y, 0));
      for (std::size_t channel = 0; channel < 3; ++channel)
        pixel[channel] =
            static_cast<unsigned char> (255.0 * colour[channel] * (is_dark ? 0.45 : 1.0));
    }
  return image;
}

vtkSmartPointer<vtkImageData>
readPng (const std::string& path)
{
  vtkNew<vtkPNGReader> reader;
  std::error_code error;
  if (!std::filesystem::is_regular_file (path, error) || reader->CanReadFile (path.c_str ()) == 0)
    throw std::runtime_error ("cannot read '" + path + "': it is no PNG file");
  reader->SetFileName (path.c_str ());
  reader->Update ();
  return reader->GetOutput ();
}

vtkSmartPointer<vtkImageData>
drawMesh (vtkPolyData* mesh, int height, const PictureOptions& options)
{
  const int panels = options.parameterization != nullptr || options.texture != nullptr ? 2 : 1;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetMultiSamples (0);
  window->SetSize (panels * height * SUPERSAMPLING, height * SUPERSAMPLING);

  for (int panel = 0; panel < panels; ++panel) {
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport (panel / static_cast<double> (panels), 0.0,
                           (panel + 1) / static_cast<double> (panels), 1.0);
    renderer->SetBackground (PAPER[0], PAPER[1], PAPER[2]);
    window->AddRenderer (renderer);
    if (panel == 0) {
      if (options.texture != nullptr)
        addTextured (renderer, mesh, options.texture, true);
      else
        addSurface (renderer, mesh, options.flat_shading);
      if (options.marked_edges != nullptr)
        addLines (renderer, options.marked_edges, MARK);
      addLights (renderer);
      const std::vector<Eigen::Vector3d> points = pointsOf (mesh);
      if (options.viewpoint == nullptr ||
          !aimFromViewpoint (renderer, Eigen::Map<const Eigen::Vector3d> (options.viewpoint),
                             points))
        aimCamera (renderer, chooseView (mesh, points), points);
    }
    else if (options.texture != nullptr) {
      const vtkSmartPointer<vtkPolyData> flat = flattened (mesh);
      addTextured (renderer, flat, options.texture, false);
      aimCamera (renderer, {Eigen::Vector3d::UnitZ (), Eigen::Vector3d::UnitY ()},
                 {Eigen::Vector3d::Zero (), Eigen::Vector3d (1.0, 1.0, 0.0)});
    }
    else {
      addWireframe (renderer, options.parameterization);
      aimCamera (renderer, {Eigen::Vector3d::UnitZ (), Eigen::Vector3d::UnitY ()},
                 pointsOf (options.parameterization));
    }
  }
  window->Render ();

  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput (window);
  pixels->ReadFrontBufferOff ();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection (pixels->GetOutputPort ());
  shrink->SetShrinkFactors (SUPERSAMPLING, SUPERSAMPLING, 1);
  shrink->MeanOn ();
  shrink->Update ();
  coarsenColours (shrink->GetOutput ());
  return shrink->GetOutput ();
}

std::vector<unsigned char>
toPng (vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData (image);
  writer->WriteToMemoryOn ();
  writer->SetCompressionLevel (STRONGEST_COMPRESSION);
  writer->Write ();
  vtkUnsignedCharArray* bytes = writer->GetResult ();
  if (bytes == nullptr || bytes->GetNumberOfValues () == 0)
    throw std::runtime_error ("VTK could not write the picture");
  return {bytes->Begin (), bytes->End ()};
}

} // namespace floater
} // namespace pcl
