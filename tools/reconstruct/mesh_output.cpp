// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_output.h"

#include <pcl/surface/floater/vertex_normals.h>

namespace pcl::floater {
void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads)
{
  std::vector<Eigen::Vector3f> normals = vertexNormals (cloud.positions (), triangles, threads);
  giveBackMappedFiles ();
  replaceColumns ({"nx", "ny", "nz"}, ScalarType::FLOAT32, std::move (normals), cloud.fields);
}

namespace {
bool
isObj (const CommandLine& line)
{
  return line.meshFormat () == MeshFormat::OBJ;
}

// The image as the file of materials names it: relative to its own folder, as readers expect it.
std::string
imageName (const CommandLine& line)
{
  if (line.texture.empty ())
    return {};
  const std::filesystem::path folder =
      std::filesystem::absolute (line.output).parent_path ().lexically_normal ();
  return std::filesystem::absolute (line.texture)
      .lexically_normal ()
      .lexically_proximate (folder)
      .generic_string ();
}

} // namespace

std::filesystem::path
materialsOf (const CommandLine& line)
{
  return line.texture_coordinates && isObj (line) ? materialsBeside (line.output)
                                                  : std::filesystem::path ();
}

void
checkTextureOptions (const CommandLine& line)
{
  const std::optional<MeshFormat> format = line.meshFormat ();
  if (line.texture_coordinates &&
      (format == MeshFormat::STL || format == MeshFormat::OFF || format == MeshFormat::GLB))
    throw UsageError ("STL, OFF and GLB are written without texture coordinates; write .vtk, .ply "
                      "or .obj, or leave --uv and --texture out");
  if (line.texture_coordinates && isObj (line) && isStandardStream (line.output))
    throw UsageError ("the file of materials beside an OBJ file has no place on the standard "
                      "output; write .ply or .vtk there, or leave --uv and --texture out");
  if (!line.texture.empty () && lowerExtension (line.texture) != ".png")
    throw UsageError ("--texture: '" + line.texture.string () +
                      "' is no PNG file; give a name that ends with .png");
  if (line.texture_size != 0 && line.texture.empty ())
    throw UsageError ("--texture-size is of no use without --texture");
  if (line.texture_coordinates && line.max_memory > 0)
    throw UsageError ("--max-memory cannot limit the memory of --uv and --texture; leave one of "
                      "them out");
}

void
checkTextureColours (const CommandLine& line, const Cloud& cloud)
{
  if (!line.texture.empty () && !colorFields (cloud)[0])
    throw UsageError (
        "--texture: the points of '" + line.input.string () +
        "' have no colours (red, green, blue of 8 bits, or rgb); use --uv for texture "
        "coordinates alone");
}

TextureCoordinates
computeTexture (const CommandLine& line, const Cloud& cloud, Result& result)
{
  if (!line.texture_coordinates || result.report.status != RunStatus::SUCCESS)
    return {};
  TextureOptions options;
  options.threads = line.options.threads;
  options.whole_discs = result.report.topology == Topology::DISC;
  TextureCoordinates texture =
      computeTextureCoordinates (cloud.positions (), result.triangles, options);
  if (texture.status != RunStatus::SUCCESS) {
    result.report.status = texture.status;
    result.report.message = "texture coordinates: " + texture.message;
    result.triangles.clear ();
  }
  else if (texture.flipped > 0)
    result.report.warnings.push_back (
        counted (texture.flipped, "triangle") + (texture.flipped == 1 ? " is" : " are") +
        " upside down in the texture: too small beside the mesh for 32 bits");
  return texture;
}

std::vector<std::string>
stageTexture (const CommandLine& line, const Cloud& cloud, const Triangles& triangles,
              const TextureCoordinates& texture, OutputFiles& files)
{
  std::vector<std::string> notes;
  if (isObj (line)) {
    stageFile (materialsOf (line), materialsText (imageName (line)), files);
    if ((materialsOf (line).filename ().string () + imageName (line)).find (' ') !=
        std::string::npos)
      notes.emplace_back ("the name of the file of materials or of the texture has a space in it, "
                          "which many readers of OBJ files do not take");
  }
  if (!line.texture.empty ()) {
    const std::size_t side = line.texture_size > 0
                                 ? static_cast<std::size_t> (line.texture_size)
                                 : imageSideFor (texture.coordinates.size (), texture.area_used);
    stageFile (line.texture, pngOf (bakeColours (cloud, triangles, texture, side)), files);
  }
  return notes;
}

} // namespace pcl::floater
