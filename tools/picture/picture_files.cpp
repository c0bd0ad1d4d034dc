// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_files.h"

#include "cloud_reader.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataReader.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace pcl::floater {
namespace {
constexpr int STRONGEST_COMPRESSION = 9; // of a PNG file

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

} // namespace

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

} // namespace pcl::floater
