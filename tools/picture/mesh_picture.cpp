// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_picture.h"

#include "mesh_view.h"

#include <vtkActor.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkWindowToImageFilter.h>

#include <X11/Xlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace pcl::floater {
namespace {
constexpr int SUPERSAMPLING = 2; // pixels drawn per pixel of the picture, in each direction
constexpr vtkIdType MOST_DRAWN_EDGES = 15000; // polygons of a shaded mesh up to which edges show
constexpr int COLOUR_STEP = 5;                // of 256 levels of each colour

using Colour = std::array<double, 3>;
constexpr Colour FRONT{0.56, 0.69, 0.85}, BACK{0.93, 0.66, 0.40}, BOUNDARY{0.83, 0.06, 0.13},
    EDGE{0.18, 0.27, 0.40}, PAPER{1.0, 1.0, 1.0};

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

} // namespace pcl::floater
