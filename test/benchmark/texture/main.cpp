// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_textures: charts, stretch and time of texture coordinates, on all clouds of a folder.
#include "../stopwatch.h"
#include "cgal_layouts.h"
#include "cloud_reader.h"
#include "mesh/triangle_mesh.h"
#include "texture/stretch.h"

#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/texture_coordinates.h>

#include <CLI/CLI.hpp>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace
{
using namespace pcl::floater;
namespace files = std::filesystem;

struct Mesh
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
};

Mesh
readMesh (const files::path& file)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName (file.c_str ());
  reader->Update ();
  vtkPolyData* data = reader->GetOutput ();
  Mesh mesh;
  mesh.positions.resize (static_cast<std::size_t> (data->GetNumberOfPoints ()));
  for (std::size_t p = 0; p < mesh.positions.size (); ++p)
    data->GetPoint (static_cast<vtkIdType> (p), mesh.positions[p].data ());
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < data->GetNumberOfCells (); ++t) {
    data->GetCellPoints (t, corners);
    mesh.triangles.push_back ({static_cast<Index> (corners->GetId (0)),
                               static_cast<Index> (corners->GetId (1)),
                               static_cast<Index> (corners->GetId (2))});
  }
  return mesh;
}

bool
isDisc (const Mesh& mesh)
{
  TriangleMesh connected;
  connected.triangles = mesh.triangles;
  if (!connected.connect (mesh.positions.size (), 0))
    return false;
  std::size_t sides = 0, vertices = 0;
  for (const auto& neighbors : connected.neighbors)
    for (const Index other : neighbors)
      sides += other == NONE ? 2 : 1;
  for (const Index t : connected.triangle_of)
    vertices += t != NONE ? 1 : 0;
  return findComponents (connected, 0).count == 1 && boundaryLoops (connected, 0).size () == 1 &&
         vertices + mesh.triangles.size () == sides / 2 + 1;
}

struct Quality
{
  double mean = 0.0;
  std::size_t flipped = 0; ///< by the sign of the area in double precision
};

Quality
qualityOf (const Mesh& mesh, const std::vector<Eigen::Vector2d>& uv)
{
  StretchSums sums;
  Quality quality;
  for (const Triangle& t : mesh.triangles) {
    StretchSums one;
    one.add ({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]},
             {uv[t[0]], uv[t[1]], uv[t[2]]});
    if (one.planeArea () > 0.0)
      sums.add (one);
    else
      ++quality.flipped; // its stretch is infinite, and left out
  }
  quality.mean = sums.mean ();
  return quality;
}

void
printDisc (const std::string& name, const Mesh& mesh)
{
  TextureOptions options;
  options.whole_discs = true;
  Stopwatch own;
  const TextureCoordinates texture =
      computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  std::printf ("| %s | %zu | %zu | %.4f | %zu | %.2f |", name.c_str (), mesh.triangles.size (),
               texture.chart_count, texture.stretch, texture.flipped, own.seconds ());
  for (const CgalMethod method : {CgalMethod::MEAN_VALUE, CgalMethod::ARAP}) {
    Stopwatch other;
    const std::vector<Eigen::Vector2d> uv = layOutByCgal (mesh.positions, mesh.triangles, method);
    const double seconds = other.seconds ();
    if (uv.empty ())
      std::printf (" failed | | %.2f |", seconds);
    else {
      const Quality quality = qualityOf (mesh, uv);
      std::printf (" %.4g | %zu | %.2f |", quality.mean, quality.flipped, seconds);
    }
  }
  std::printf ("\n");
}

void
printSurface (const std::string& name, const Mesh& mesh, double largest_stretch)
{
  TextureOptions options;
  options.largest_stretch = largest_stretch;
  Stopwatch watch;
  const TextureCoordinates texture =
      computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  const double seconds = watch.seconds ();
  std::printf ("| %s | %zu | %zu | %.4f | %.3g | %.0f %% | %zu | %.2f | %.1f |%s\n", name.c_str (),
               mesh.triangles.size (), texture.chart_count, texture.stretch,
               texture.largest_stretch, 100.0 * texture.area_used, texture.flipped, seconds,
               1e6 * seconds / static_cast<double> (mesh.triangles.size ()),
               texture.message.c_str ());
}

} // namespace

int
main (int argc, char** argv)
{
  CLI::App app ("Texture coordinates of all meshes NAME.gt.ply of a folder that are discs, beside "
                "those of CGAL; and of the reconstructions of all clouds NAME.pcd.");
  std::string folder;
  std::vector<std::string> names;
  bool only_discs = false, only_surfaces = false;
  double largest_stretch = TextureOptions ().largest_stretch;
  app.add_option ("FOLDER", folder, "folder of the clouds")->required ();
  app.add_option ("NAMES", names, "only these");
  app.add_flag ("--discs", only_discs, "only the first table");
  app.add_flag ("--surfaces", only_surfaces, "only the second table");
  app.add_option ("--stretch", largest_stretch, "largest stretch of a chart");
  CLI11_PARSE (app, argc, argv);
  if (names.empty ())
    for (const auto& file : files::directory_iterator (folder))
      if (file.path ().extension () == ".pcd")
        names.push_back (file.path ().stem ().string ());
  std::sort (names.begin (), names.end ());
  const files::path root (folder);

  if (!only_surfaces) {
    std::printf (
        "| disc | triangles | charts | stretch | flipped | s | mean value (CGAL) | flipped "
        "| s | ARAP (CGAL) | flipped | s |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|"
        "---:|---:|---:|\n");
    for (const std::string& name : names)
      if (files::exists (root / (name + ".gt.ply"))) {
        const Mesh mesh = readMesh (root / (name + ".gt.ply"));
        if (isDisc (mesh))
          printDisc (name, mesh);
        std::fflush (stdout);
      }
    std::printf ("\n");
  }
  if (!only_discs) {
    std::printf ("| cloud | triangles | charts | stretch | largest | area used | flipped | s | "
                 "microseconds per triangle |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const std::string& name : names) {
      Mesh mesh;
      mesh.positions = readCloud (root / (name + ".pcd")).positions ();
      mesh.triangles = reconstruct (mesh.positions).triangles;
      printSurface (name, mesh, largest_stretch);
      std::fflush (stdout);
    }
  }
  return 0;
}
