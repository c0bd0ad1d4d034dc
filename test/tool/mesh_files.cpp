// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that includes PCL and VTK, which take long to compile.
#include "mesh_files.h"

#include "sample.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_lib_io.h>
#include <pcl/point_types.h>

#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace pcl::floater {
namespace {
void
copyTriangles (vtkPolyData& data, MeshContent& mesh)
{
  vtkSmartPointer<vtkIdList> corners = vtkSmartPointer<vtkIdList>::New ();
  data.GetPolys ()->InitTraversal ();
  while (data.GetPolys ()->GetNextCell (corners) != 0) {
    if (corners->GetNumberOfIds () != 3)
      throw std::runtime_error ("not a triangle");
    std::array<std::size_t, 3> triangle{};
    for (vtkIdType c = 0; c < 3; ++c)
      triangle[static_cast<std::size_t> (c)] = static_cast<std::size_t> (corners->GetId (c));
    mesh.triangles.push_back (triangle);
  }
}

void
copyPoints (vtkPolyData& data, MeshContent& mesh)
{
  for (vtkIdType i = 0; i < data.GetNumberOfPoints (); ++i) {
    Eigen::Vector3d p;
    data.GetPoint (i, p.data ());
    mesh.points.push_back (p);
  }
  mesh.is_double = data.GetPoints ()->GetDataType () == VTK_DOUBLE;
}

void
copyFields (vtkPolyData& data, MeshContent& mesh)
{
  vtkPointData& arrays = *data.GetPointData ();
  for (int a = 0; a < arrays.GetNumberOfArrays (); ++a) {
    vtkDataArray& array = *arrays.GetArray (a);
    for (vtkIdType i = 0; i < array.GetNumberOfTuples (); ++i) {
      const double* tuple = array.GetTuple (i);
      if (&array == arrays.GetScalars () && array.GetDataType () == VTK_UNSIGNED_CHAR)
        mesh.colors.push_back ({static_cast<std::uint8_t> (tuple[0]),
                                static_cast<std::uint8_t> (tuple[1]),
                                static_cast<std::uint8_t> (tuple[2])});
      else if (&array == arrays.GetNormals ())
        mesh.normals.emplace_back (static_cast<float> (tuple[0]), static_cast<float> (tuple[1]),
                                   static_cast<float> (tuple[2]));
      else
        for (int c = 0; c < array.GetNumberOfComponents (); ++c)
          mesh.fields[array.GetName ()].push_back (tuple[c]);
    }
  }
}

template <typename T>
T
load (const std::uint8_t* from)
{
  T value;
  std::memcpy (&value, from, sizeof (T));
  return value;
}

double
loadNumber (const std::uint8_t* from, std::uint8_t type)
{
  switch (type) {
  case pcl::PCLPointField::INT8:
    return load<std::int8_t> (from);
  case pcl::PCLPointField::UINT8:
    return load<std::uint8_t> (from);
  case pcl::PCLPointField::INT16:
    return load<std::int16_t> (from);
  case pcl::PCLPointField::UINT16:
    return load<std::uint16_t> (from);
  case pcl::PCLPointField::INT32:
    return load<std::int32_t> (from);
  case pcl::PCLPointField::UINT32:
    return load<std::uint32_t> (from);
  case pcl::PCLPointField::FLOAT32:
    return load<float> (from);
  case pcl::PCLPointField::FLOAT64:
    return load<double> (from);
  default:
    throw std::runtime_error ("unknown type of field");
  }
}

/// All values of a field, or none if there is no such field.
std::vector<double>
takeField (std::map<std::string, std::vector<double>>& fields, const std::string& name)
{
  const auto found = fields.find (name);
  if (found == fields.end ())
    return {};
  std::vector<double> values = std::move (found->second);
  fields.erase (found);
  return values;
}

MeshContent
fromPcl (const pcl::PolygonMesh& source)
{
  MeshContent mesh;
  const pcl::PCLPointCloud2& cloud = source.cloud;
  const std::size_t size = static_cast<std::size_t> (cloud.width) * cloud.height;
  for (const pcl::PCLPointField& field : cloud.fields) {
    mesh.is_double |= field.name == "x" && field.datatype == pcl::PCLPointField::FLOAT64;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint8_t* from = cloud.data.data () + i * cloud.point_step + field.offset;
      if (field.name == "rgb" || field.name == "rgba") {
        const auto packed = load<std::uint32_t> (from);
        mesh.colors.push_back ({static_cast<std::uint8_t> (packed >> 16U),
                                static_cast<std::uint8_t> (packed >> 8U),
                                static_cast<std::uint8_t> (packed)});
      }
      else
        mesh.fields[field.name].push_back (loadNumber (from, field.datatype));
    }
  }
  const std::array<std::vector<double>, 3> xyz{
      takeField (mesh.fields, "x"), takeField (mesh.fields, "y"), takeField (mesh.fields, "z")};
  for (std::size_t i = 0; i < size; ++i)
    mesh.points.emplace_back (xyz[0].at (i), xyz[1].at (i), xyz[2].at (i));
  const std::array<std::vector<double>, 3> normals{takeField (mesh.fields, "normal_x"),
                                                   takeField (mesh.fields, "normal_y"),
                                                   takeField (mesh.fields, "normal_z")};
  for (std::size_t i = 0; i < normals[0].size (); ++i)
    mesh.normals.emplace_back (static_cast<float> (normals[0][i]),
                               static_cast<float> (normals[1][i]),
                               static_cast<float> (normals[2][i]));
  for (const pcl::Vertices& polygon : source.polygons)
    mesh.triangles.push_back ({static_cast<std::size_t> (polygon.vertices.at (0)),
                               static_cast<std::size_t> (polygon.vertices.at (1)),
                               static_cast<std::size_t> (polygon.vertices.at (2))});
  return mesh;
}

} // namespace

MeshContent
readVtk (const std::string& path)
{
  vtkSmartPointer<vtkPolyDataReader> reader = vtkSmartPointer<vtkPolyDataReader>::New ();
  reader->SetFileName (path.c_str ());
  // Without these, VTK reads only the arrays that it takes for active.
  reader->ReadAllFieldsOn ();
  reader->ReadAllNormalsOn ();
  reader->ReadAllScalarsOn ();
  reader->Update ();
  MeshContent mesh;
  copyPoints (*reader->GetOutput (), mesh);
  copyTriangles (*reader->GetOutput (), mesh);
  copyFields (*reader->GetOutput (), mesh);
  return mesh;
}

MeshContent
readVtkWithPcl (const std::string& path)
{
  pcl::PolygonMesh mesh;
  pcl::io::loadPolygonFileVTK (path, mesh);
  return fromPcl (mesh);
}

MeshContent
readPly (const std::string& path)
{
  pcl::PolygonMesh mesh;
  if (pcl::PLYReader ().read (path, mesh) != 0)
    throw std::runtime_error ("PCL cannot read " + path);
  return fromPcl (mesh);
}

std::vector<Eigen::Vector3f>
loadPlyIntoPoints (const std::string& path)
{
  pcl::PCLPointCloud2 fields;
  if (pcl::io::loadPLYFile (path, fields) != 0)
    throw std::runtime_error ("PCL cannot read " + path);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  pcl::fromPCLPointCloud2 (fields, cloud);
  std::vector<Eigen::Vector3f> points;
  for (const pcl::PointXYZ& point : cloud)
    points.emplace_back (point.x, point.y, point.z);
  return points;
}

MeshContent
readStl (const std::string& path)
{
  vtkSmartPointer<vtkSTLReader> reader = vtkSmartPointer<vtkSTLReader>::New ();
  reader->SetFileName (path.c_str ());
  reader->MergingOff ();
  reader->Update ();
  MeshContent mesh;
  copyPoints (*reader->GetOutput (), mesh);
  copyTriangles (*reader->GetOutput (), mesh);
  return mesh;
}

MeshContent
readObj (const std::string& path)
{
  MeshContent mesh;
  mesh.is_double = true;
  std::ifstream file (path);
  for (std::string line; std::getline (file, line);) {
    std::istringstream words (line);
    std::string key;
    words >> key;
    if (key == "v") {
      Eigen::Vector3d p;
      words >> p.x () >> p.y () >> p.z ();
      mesh.points.push_back (p);
      std::array<double, 3> color{};
      if (words >> color[0] >> color[1] >> color[2])
        mesh.colors.push_back ({static_cast<std::uint8_t> (std::lround (255.0 * color[0])),
                                static_cast<std::uint8_t> (std::lround (255.0 * color[1])),
                                static_cast<std::uint8_t> (std::lround (255.0 * color[2]))});
    }
    else if (key == "vn") {
      Eigen::Vector3f n;
      words >> n.x () >> n.y () >> n.z ();
      mesh.normals.push_back (n);
    }
    else if (key == "f") {
      std::array<std::size_t, 3> triangle{};
      for (std::size_t& corner : triangle) {
        std::string word;
        words >> word;
        corner = std::stoul (word) - 1;
      }
      mesh.triangles.push_back (triangle);
    }
  }
  return mesh;
}

MeshContent
readOff (const std::string& path)
{
  MeshContent mesh;
  mesh.is_double = true;
  std::ifstream file (path);
  std::string kind, text, line;
  std::getline (file, kind);
  while (std::getline (file, line))
    if (line.rfind ('#', 0) != 0)
      text += line + "\n";
  std::istringstream words (text);
  std::size_t points = 0, faces = 0, edges = 0;
  words >> points >> faces >> edges;
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::Vector3d p;
    words >> p.x () >> p.y () >> p.z ();
    mesh.points.push_back (p);
    if (kind.find ('N') != std::string::npos) {
      Eigen::Vector3f n;
      words >> n.x () >> n.y () >> n.z ();
      mesh.normals.push_back (n);
    }
    if (kind.find ('C') != std::string::npos) {
      std::array<int, 4> color{};
      words >> color[0] >> color[1] >> color[2] >> color[3];
      mesh.colors.push_back ({static_cast<std::uint8_t> (color[0]),
                              static_cast<std::uint8_t> (color[1]),
                              static_cast<std::uint8_t> (color[2])});
    }
  }
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t corners = 0;
    std::array<std::size_t, 3> triangle{};
    words >> corners >> triangle[0] >> triangle[1] >> triangle[2];
    if (corners != 3)
      throw std::runtime_error ("not a triangle");
    mesh.triangles.push_back (triangle);
  }
  if (!words || (words >> kind))
    throw std::runtime_error ("the file does not end where it should");
  return mesh;
}

MeshContent
readGlb (const std::string& path)
{
  vtkSmartPointer<vtkGLTFReader> reader = vtkSmartPointer<vtkGLTFReader>::New ();
  reader->SetFileName (path.c_str ());
  reader->ApplyDeformationsToGeometryOff ();
  reader->Update ();
  MeshContent mesh;
  vtkSmartPointer<vtkCompositeDataIterator> parts;
  parts.TakeReference (reader->GetOutput ()->NewIterator ());
  for (parts->InitTraversal (); parts->IsDoneWithTraversal () == 0; parts->GoToNextItem ()) {
    auto* const data = vtkPolyData::SafeDownCast (parts->GetCurrentDataObject ());
    if (data == nullptr || !mesh.points.empty ())
      throw std::runtime_error ("not one mesh");
    copyPoints (*data, mesh);
    copyTriangles (*data, mesh);
    vtkDataArray* const colors = data->GetPointData ()->GetArray ("COLOR_0");
    vtkDataArray* const normals = data->GetPointData ()->GetNormals ();
    for (vtkIdType i = 0; i < data->GetNumberOfPoints (); ++i) {
      if (colors != nullptr) {
        std::array<std::uint8_t, 3> color{};
        for (int channel = 0; channel < 3; ++channel) {
          const double value = colors->GetComponent (i, channel);
          const bool is_share = colors->GetDataType () != VTK_UNSIGNED_CHAR;
          color[static_cast<std::size_t> (channel)] =
              static_cast<std::uint8_t> (std::lround (is_share ? 255.0 * value : value));
        }
        mesh.colors.push_back (color);
      }
      if (normals != nullptr)
        mesh.normals.emplace_back (static_cast<float> (normals->GetComponent (i, 0)),
                                   static_cast<float> (normals->GetComponent (i, 1)),
                                   static_cast<float> (normals->GetComponent (i, 2)));
    }
  }
  return mesh;
}

MeshContent
readMesh (const std::string& path)
{
  const std::string extension = path.substr (path.size () - 4);
  if (extension == ".vtk")
    return readVtk (path);
  if (extension == ".ply")
    return readPly (path);
  if (extension == ".glb")
    return readGlb (path);
  if (extension == ".off")
    return readOff (path);
  return extension == ".stl" ? readStl (path) : readObj (path);
}

void
writePcd (const std::string& path, const Sample& sample, PcdKind kind)
{
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t> (sample.size ());
  cloud.height = 1;
  const auto add = [&cloud] (const std::string& name, std::uint8_t type, std::uint32_t size) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = type;
    field.count = 1;
    cloud.fields.push_back (field);
    cloud.point_step += size;
  };
  for (const char* axis : {"x", "y", "z"})
    add (axis, sample.is_double ? pcl::PCLPointField::FLOAT64 : pcl::PCLPointField::FLOAT32,
         sample.is_double ? sizeof (double) : sizeof (float));
  add ("rgb", pcl::PCLPointField::FLOAT32, sizeof (float));
  for (const char* name : {"normal_x", "normal_y", "normal_z", "intensity"})
    add (name, pcl::PCLPointField::FLOAT32, sizeof (float));
  cloud.row_step = cloud.point_step * cloud.width;
  const auto append = [&cloud] (const auto value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*> (&value);
    cloud.data.insert (cloud.data.end (), bytes, bytes + sizeof (value));
  };
  for (std::size_t i = 0; i < sample.size (); ++i) {
    for (const double coordinate : sample.points[i])
      sample.is_double ? append (coordinate) : append (static_cast<float> (coordinate));
    const auto& color = sample.colors[i];
    append (static_cast<std::uint32_t> (color[0] << 16 | color[1] << 8 | color[2]));
    for (const float coordinate : sample.normals[i])
      append (coordinate);
    append (sample.intensities[i]);
  }
  constexpr int DIGITS = 17;
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero ();
  const Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity ();
  pcl::PCDWriter writer;
  int result = -1;
  switch (kind) {
  case PcdKind::ASCII:
    result = writer.writeASCII (path, cloud, origin, orientation, DIGITS);
    break;
  case PcdKind::BINARY:
    result = writer.writeBinary (path, cloud, origin, orientation);
    break;
  case PcdKind::COMPRESSED:
    result = writer.writeBinaryCompressed (path, cloud, origin, orientation);
    break;
  }
  if (result != 0)
    throw std::runtime_error ("PCL cannot write " + path);
}

} // namespace pcl::floater
