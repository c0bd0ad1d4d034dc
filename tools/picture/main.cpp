// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_picture: draws a mesh and its parameterization into a PNG file.
#include "mesh_picture.h"
#include "small_tool.h"

using pcl::floater::ColourImage;

/// A checkerboard of 32 x 32 squares, of another colour in each of 8 x 8 fields: shows stretch, and
/// what lies where.
static ColourImage
makeCheckerboard ()
{
  constexpr std::size_t SQUARES = 32, FIELDS = 8, PIXELS = 32; // pixels along a square
  constexpr std::size_t SIDE = SQUARES * PIXELS, FIELD = SIDE / FIELDS;
  ColourImage image{SIDE, SIDE, {}};
  for (std::size_t row = 0; row < SIDE; ++row)
    for (std::size_t x = 0; x < SIDE; ++x) {
      const std::size_t y = SIDE - 1 - row, column = x / FIELD, line = y / FIELD; // of fields
      const double right = static_cast<double> (column) / (FIELDS - 1);
      const double up = static_cast<double> (line) / (FIELDS - 1);
      const double shade = 255.0 * ((x / PIXELS + y / PIXELS) % 2 != 0 ? 0.45 : 1.0);
      image.pixels.emplace_back (static_cast<std::uint8_t> (shade * (0.35 + 0.65 * right)),
                                 static_cast<std::uint8_t> (shade * (0.35 + 0.65 * up)),
                                 static_cast<std::uint8_t> (shade * (1.0 - 0.25 * (right + up))));
    }
  return image;
}

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  CLI::App app{
      "Draws a triangle mesh, and beside it its parameterization, into a PNG file.\n"
      "Front sides are blue, back sides orange, boundary edges red.\n"
      "Exit codes: 0 success, 1 usage, 2 an input cannot be read, 3 there is not enough memory,\n"
      "4 the output cannot be written.",
      "pcl_floater_picture"};
  std::vector<std::string> files;
  std::string texture;
  std::vector<double> viewpoint;
  bool has_checkerboard = false, is_flat = false;
  int height = 700;
  app.add_option ("files", files, "meshes as .vtk or .ply, and the picture to write")
      ->option_text ("MESH [PARAMETERIZATION] OUT.png")
      ->required ()
      ->expected (2, 3);
  app.add_option ("--height", height, "height of the picture in pixels")
      ->capture_default_str ()
      ->check (CLI::Range (16, 4000));
  CLI::Option* checkerboard = app.add_flag (
      "--checkerboard", has_checkerboard,
      "put a checkerboard on the mesh, by its texture coordinates, and show it beside");
  app.add_option ("--texture", texture, "put this image on the mesh, as .png")
      ->option_text ("FILE")
      ->excludes (checkerboard);
  app.add_option ("--viewpoint", viewpoint,
                  "show the mesh from this place, such as that of the sensor of a scan")
      ->option_text ("X,Y,Z")
      ->delimiter (',')
      ->expected (3);
  app.add_flag ("--flat", is_flat, "one shade for each triangle, which shows bumps");
  return runSmallTool (app, argc, argv, [&] {
    const bool has_texture = has_checkerboard || !texture.empty ();
    if (has_texture && files.size () == 3)
      throw std::invalid_argument (
          "give a PARAMETERIZATION, or --checkerboard or --texture, not both");
    requireWritable (files.back ());
    PictureOptions options;
    options.shading = is_flat ? Shading::FLAT : Shading::SMOOTH;
    if (!viewpoint.empty ())
      options.viewpoint.emplace (viewpoint[0], viewpoint[1], viewpoint[2]);
    PictureMesh mesh = readNamed (files[0], [&] {
      PictureMesh its = readPictureMesh (files[0]);
      if (has_texture && its.coordinates.empty ())
        throw ReadError ("it has no texture coordinates; pcl_floater_reconstruct --uv writes some");
      return its;
    });
    if (has_checkerboard)
      options.texture = makeCheckerboard ();
    else if (has_texture)
      options.texture = readNamed (
          texture, [&] { return parsePng (FileBytes (std::filesystem::path (texture))); });
    if (files.size () == 3)
      options.parameterization = readNamed (files[1], [&] { return readPictureMesh (files[1]); });
    writeFile (files.back (),
               pngOf (drawMesh (std::move (mesh), static_cast<std::size_t> (height), options)));
  });
}
