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
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

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

/// What a layout by CGAL gave. All zero if it was ended, or failed.
struct Rival
{
  Quality quality;
  double seconds = 0.0;
};

/// In a process of its own, which ends after a number of seconds.
Rival
layOutInTime (const Mesh& mesh, CgalMethod method, unsigned seconds)
{
  std::array<int, 2> ends{};
  if (::pipe (ends.data ()) != 0)
    throw std::runtime_error ("no pipe");
  const pid_t child = ::fork ();
  if (child == 0) {
    ::alarm (seconds);
    Rival rival;
    Stopwatch watch;
    const std::vector<Eigen::Vector2d> uv = layOutByCgal (mesh.positions, mesh.triangles, method);
    if (uv.empty ())
      std::_Exit (1);
    rival.seconds = watch.seconds ();
    rival.quality = qualityOf (mesh, uv);
    std::_Exit (::write (ends[1], &rival, sizeof rival) == ssize_t{sizeof rival} ? 0 : 1);
  }
  ::close (ends[1]);
  Rival rival;
  if (::read (ends[0], &rival, sizeof rival) != ssize_t{sizeof rival})
    rival = {};
  ::close (ends[0]);
  ::waitpid (child, nullptr, 0);
  return rival;
}

void
printDisc (const std::string& name, const Mesh& mesh, unsigned limit)
{
  TextureOptions options;
  options.whole_discs = true;
  options.threads = 1; // as many as CGAL has
  Stopwatch own;
  const TextureCoordinates texture =
      computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  std::printf ("| %s | %zu | %zu | %.4f | %zu | %.2f |", name.c_str (), mesh.triangles.size (),
               texture.chart_count, texture.stretch, texture.flipped, own.seconds ());
  std::fflush (stdout);
  for (const CgalMethod method : {CgalMethod::MEAN_VALUE, CgalMethod::ARAP}) {
    const Rival rival = layOutInTime (mesh, method, limit);
    if (rival.seconds == 0.0)
      std::printf (" ended or failed | | |");
    else
      std::printf (" %.4g | %zu | %.2f |", rival.quality.mean, rival.quality.flipped,
                   rival.seconds);
    std::fflush (stdout);
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
  unsigned limit = 60;
  app.add_option ("FOLDER", folder, "folder of the clouds")->required ();
  app.add_option ("NAMES", names, "only these");
  app.add_flag ("--discs", only_discs, "only the first table");
  app.add_flag ("--surfaces", only_surfaces, "only the second table");
  app.add_option ("--stretch", largest_stretch, "largest stretch of a chart");
  app.add_option ("--limit", limit, "seconds after which a layout by CGAL is ended");
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
          printDisc (name, mesh, limit);
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
