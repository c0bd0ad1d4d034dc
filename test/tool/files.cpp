// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that includes PCL and VTK, which take long to compile.
#include "files.h"

#include "cloud_reader.h"

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

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

namespace pcl::floater {
namespace {
constexpr int PRECISION = std::numeric_limits<double>::max_digits10;

Color
colorOf (const double* channels, double scale)
{
  Color color{};
  for (std::size_t i = 0; i < 3; ++i)
    color[i] = static_cast<std::uint8_t> (std::lround (scale * channels[i]));
  return color;
}

void
copyPolyData (vtkPolyData& data, MeshContent& mesh)
{
  mesh.is_double = data.GetPoints ()->GetDataType () == VTK_DOUBLE;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints (); ++i)
    mesh.points.emplace_back (data.GetPoint (i));
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
  vtkPointData& arrays = *data.GetPointData ();
  for (int a = 0; a < arrays.GetNumberOfArrays (); ++a) {
    vtkDataArray& array = *arrays.GetArray (a);
    const std::string name = array.GetName ();
    const bool are_bytes = array.GetDataType () == VTK_UNSIGNED_CHAR;
    for (vtkIdType i = 0; i < array.GetNumberOfTuples (); ++i) {
      const double* tuple = array.GetTuple (i);
      if (name == "COLOR_0" || (&array == arrays.GetScalars () && are_bytes))
        mesh.colors.push_back (colorOf (tuple, are_bytes ? 1.0 : 255.0));
      else if (&array == arrays.GetNormals ())
        mesh.normals.emplace_back (Eigen::Vector3d (tuple).cast<float> ());
      else if (&array == arrays.GetTCoords ())
        mesh.coordinates.emplace_back (tuple);
      else
        mesh.fields[name].insert (mesh.fields[name].end (), tuple,
                                  tuple + array.GetNumberOfComponents ());
    }
  }
}

// Without the three words, VTK reads only the arrays that it takes for active.
MeshContent
readVtk (const std::string& path)
{
  vtkSmartPointer<vtkPolyDataReader> reader = vtkSmartPointer<vtkPolyDataReader>::New ();
  reader->SetFileName (path.c_str ());
  reader->ReadAllFieldsOn ();
  reader->ReadAllNormalsOn ();
  reader->ReadAllScalarsOn ();
  reader->Update ();
  MeshContent mesh;
  copyPolyData (*reader->GetOutput (), mesh);
  return mesh;
}

// The reader of the tool has tests of its own, with files that others wrote.
MeshContent
readPly (const std::string& path)
{
  Triangles triangles;
  const Cloud cloud = parsePly (FileBytes (std::filesystem::path (path)), false, &triangles);
  MeshContent mesh;
  mesh.is_double = !cloud.single_precision;
  mesh.points = cloud.positions ();
  for (const auto& triangle : triangles)
    mesh.triangles.push_back ({triangle[0], triangle[1], triangle[2]});
  const auto [red, green, blue] = colorFields (cloud);
  const auto [x, y, z] = normalFields (cloud);
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    if (red != nullptr)
      mesh.colors.push_back ({red->value<std::uint8_t> (i), green->value<std::uint8_t> (i),
                              blue->value<std::uint8_t> (i)});
    if (x != nullptr)
      mesh.normals.push_back (
          Eigen::Vector3d (x->asDouble (i), y->asDouble (i), z->asDouble (i)).cast<float> ());
    for (const Field& field : cloud.fields)
      if (&field != red && &field != green && &field != blue && &field != x && &field != y &&
          &field != z)
        mesh.fields[field.name].push_back (field.asDouble (i));
  }
  return mesh;
}

MeshContent
readStl (const std::string& path)
{
  vtkSmartPointer<vtkSTLReader> reader = vtkSmartPointer<vtkSTLReader>::New ();
  reader->SetFileName (path.c_str ());
  reader->MergingOff ();
  reader->Update ();
  MeshContent mesh;
  copyPolyData (*reader->GetOutput (), mesh);
  return mesh;
}

/// The numbers that come next in a text.
template <typename Vector>
Vector
next (std::istream& words)
{
  Vector vector;
  for (auto& number : vector)
    words >> number;
  return vector;
}

// A corner of a face is POINT, POINT//NORMAL, POINT/COORDINATES or POINT/COORDINATES/NORMAL. No
// library reads doubles from these files.
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
      mesh.points.push_back (next<Eigen::Vector3d> (words));
      const auto color = next<Eigen::Vector3d> (words);
      if (words)
        mesh.colors.push_back (colorOf (color.data (), 255.0));
    }
    else if (key == "vn")
      mesh.normals.push_back (next<Eigen::Vector3f> (words));
    else if (key == "vt")
      mesh.coordinates.push_back (next<Eigen::Vector2d> (words));
    else if (key == "mtllib")
      words >> mesh.material_file;
    else if (key == "usemtl")
      words >> mesh.material;
    else if (key == "f") {
      std::array<std::size_t, 3> triangle{}, corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        std::string word;
        words >> word;
        std::istringstream parts (word);
        std::array<std::string, 3> part;
        for (std::string& text : part)
          std::getline (parts, text, '/');
        triangle[c] = std::stoul (part[0]) - 1;
        corners[c] = part[1].empty () ? 0 : std::stoul (part[1]) - 1;
        if (!part[2].empty () && part[2] != part[0])
          throw std::runtime_error ("the normal of another point");
      }
      mesh.triangles.push_back (triangle);
      mesh.corners.push_back (corners);
    }
  }
  return mesh;
}

// No library reads doubles and colours from these files.
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
    mesh.points.push_back (next<Eigen::Vector3d> (words));
    if (kind.find ('N') != std::string::npos)
      mesh.normals.push_back (next<Eigen::Vector3f> (words));
    if (kind.find ('C') != std::string::npos)
      mesh.colors.push_back (colorOf (next<Eigen::Vector4d> (words).data (), 1.0));
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

// Vertices as the file has them, without the transformation of its node.
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
    copyPolyData (*data, mesh);
  }
  return mesh;
}

} // namespace

MeshContent
readMesh (const std::string& path)
{
  static const std::map<std::string, MeshContent (*) (const std::string&)> READERS{
      {".vtk", readVtk}, {".ply", readPly}, {".stl", readStl},
      {".obj", readObj}, {".off", readOff}, {".glb", readGlb}};
  return READERS.at (path.substr (path.size () - 4)) (path);
}

MeshContent
loadWithPcl (const std::string& path)
{
  pcl::PolygonMesh source;
  if (path.substr (path.size () - 4) == ".vtk")
    pcl::io::loadPolygonFileVTK (path, source);
  else if (pcl::io::loadPLYFile (path, source) != 0)
    throw std::runtime_error ("PCL cannot read " + path);
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  pcl::fromPCLPointCloud2 (source.cloud, cloud);
  MeshContent mesh;
  for (const pcl::PointXYZRGBNormal& point : cloud) {
    mesh.points.emplace_back (point.x, point.y, point.z);
    mesh.colors.push_back ({point.r, point.g, point.b});
    mesh.normals.emplace_back (point.normal_x, point.normal_y, point.normal_z);
  }
  for (const pcl::Vertices& polygon : source.polygons) {
    mesh.triangles.emplace_back ();
    for (std::size_t c = 0; c < 3; ++c)
      mesh.triangles.back ()[c] = static_cast<std::size_t> (polygon.vertices.at (c));
  }
  return mesh;
}

// PCL reads a simple file and writes the one that is asked for.
void
writePcd (const std::string& path, const Sample& sample, PcdKind kind)
{
  const std::string size = std::to_string (sample.size ());
  std::string bytes = "FIELDS x y z rgb normal_x normal_y normal_z intensity\nSIZE " +
                      std::string (sample.is_double ? "8 8 8" : "4 4 4") +
                      " 4 4 4 4 4\nTYPE F F F F F F F F\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH " + size +
                      "\nHEIGHT 1\nPOINTS " + size + "\nDATA binary\n";
  const auto append = [&bytes] (const auto value) {
    bytes.append (reinterpret_cast<const char*> (&value), sizeof value);
  };
  for (std::size_t i = 0; i < sample.size (); ++i) {
    for (const double coordinate : sample.points[i])
      sample.is_double ? append (coordinate) : append (static_cast<float> (coordinate));
    const Color& color = sample.colors[i];
    append (static_cast<std::uint32_t> (color[0] << 16 | color[1] << 8 | color[2]));
    for (const float coordinate : sample.normals[i])
      append (coordinate);
    append (sample.intensities[i]);
  }
  std::ofstream (path, std::ios::binary) << bytes;
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf turn;
  int version = 0;
  if (pcl::PCDReader ().read (path, cloud, origin, turn, version) != 0)
    throw std::runtime_error ("PCL cannot read " + path);
  constexpr int DIGITS = 17;
  pcl::PCDWriter writer;
  const int result = kind == PcdKind::ASCII ? writer.writeASCII (path, cloud, origin, turn, DIGITS)
                     : kind == PcdKind::BINARY
                         ? writer.writeBinary (path, cloud, origin, turn)
                         : writer.writeBinaryCompressed (path, cloud, origin, turn);
  if (result != 0)
    throw std::runtime_error ("PCL cannot write " + path);
}

Sample
makeSample (bool is_double, int side)
{
  constexpr unsigned SEED = 7;
  std::mt19937 random (SEED);
  // The distributions of the standard library differ between implementations.
  const auto uniform = [&random] { return static_cast<double> (random ()) / 4294967296.0 - 0.5; };
  // Multiples of 1 / GRAIN are exact floats. A cast to float and back is no way to get them: GCC 12
  // drops it at -O2.
  constexpr double GRAIN = 262144.0;
  Sample sample;
  sample.is_double = is_double;
  const Eigen::Vector3d origin =
      is_double ? Eigen::Vector3d (654321.0, 5123456.0, 120.0) : Eigen::Vector3d::Zero ();
  const double spacing = is_double ? 0.01 : 1.0;
  for (int i = 0; i < side * side; ++i) {
    const int column = i % side;
    const int row = i / side;
    const double x = column + 0.4 * uniform ();
    const double y = row + 0.4 * uniform ();
    Eigen::Vector3d p =
        origin + spacing * Eigen::Vector3d (x, y, std::sin (0.4 * x) * std::cos (0.3 * y));
    if (!is_double)
      p = (GRAIN * p).array ().round () / GRAIN;
    sample.points.push_back (p);
  }
  for (std::size_t i = sample.points.size () - 1; i > 0; --i)
    std::swap (sample.points[i], sample.points[random () % (i + 1)]);
  for (std::size_t i = 0; i < sample.points.size (); ++i) {
    const auto byte = [i] (std::size_t factor) {
      return static_cast<std::uint8_t> (factor * i % 256);
    };
    sample.colors.push_back ({byte (1), byte (7), byte (31)});
    const Eigen::Vector3d normal (0.1 * uniform (), 0.1 * uniform (), 1.0);
    sample.normals.emplace_back (normal.normalized ().cast<float> ());
    sample.intensities.push_back (static_cast<float> (uniform ()));
  }
  return sample;
}

std::string
plyText (const Sample& sample, PlyKind kind, bool is_plain)
{
  const std::string type = sample.is_double ? "double" : "float";
  const std::array<const char*, 3> formats{"ascii", "binary_little_endian", "binary_big_endian"};
  std::ostringstream text;
  text << std::setprecision (PRECISION) << "ply\nformat "
       << formats[static_cast<std::size_t> (kind)] << " 1.0\n";
  const auto add = [&] (const auto number) {
    if (kind == PlyKind::ASCII) {
      text << +number << ' ';
      return;
    }
    std::array<char, sizeof number> bytes{};
    std::memcpy (bytes.data (), &number, sizeof number);
    constexpr bool IS_LITTLE_HOST = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    if ((kind == PlyKind::LITTLE) != IS_LITTLE_HOST)
      std::reverse (bytes.begin (), bytes.end ());
    text.write (bytes.data (), bytes.size ());
  };
  const auto endRow = [&] { text << (kind == PlyKind::ASCII ? "\n" : ""); };
  if (!is_plain)
    text << "comment a sample\nelement camera 2\nproperty list uchar short frames\n"
            "property float focus\n";
  text << "element vertex " << sample.size () << "\nproperty " << type << " x\nproperty " << type
       << " y\nproperty " << type << " z\nproperty float intensity\n";
  if (!is_plain)
    text << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property list uchar int marks\nproperty float nx\nproperty float ny\n"
            "property float nz\nelement face 1\nproperty list uchar int vertex_indices\n";
  text << "end_header\n";
  for (std::uint8_t frames : {std::uint8_t{0}, std::uint8_t{3}}) {
    if (is_plain)
      break;
    add (frames);
    for (std::int16_t frame = 0; frame < frames; ++frame)
      add (frame);
    add (0.5F);
    endRow ();
  }
  for (std::size_t i = 0; i < sample.size (); ++i) {
    for (const double coordinate : sample.points[i])
      sample.is_double ? add (coordinate) : add (static_cast<float> (coordinate));
    add (sample.intensities[i]);
    if (!is_plain) {
      for (const std::uint8_t channel : sample.colors[i])
        add (channel);
      const auto marks = static_cast<std::uint8_t> (i % 3);
      add (marks);
      for (std::int32_t mark = 0; mark < marks; ++mark)
        add (mark);
      for (const float coordinate : sample.normals[i])
        add (coordinate);
    }
    endRow ();
  }
  if (!is_plain) {
    add (std::uint8_t{3});
    for (const std::int32_t corner : {0, 1, 2})
      add (corner);
    endRow ();
  }
  return text.str ();
}

std::string
objText (const Sample& sample)
{
  std::ostringstream text;
  text << std::setprecision (PRECISION) << "# a sample\nmtllib none.mtl\no cloud\n";
  for (std::size_t i = 0; i < sample.size (); ++i) {
    text << "v " << sample.points[i].transpose ();
    for (const std::uint8_t channel : sample.colors[i])
      text << ' ' << channel / 255.0;
    text << '\n';
  }
  for (const Eigen::Vector3f& normal : sample.normals)
    text << "vn " << normal.transpose () << '\n';
  text << "f 1//1 2//2 3//3\n";
  return text.str ();
}

std::string
pcdText (const std::vector<Eigen::Vector3d>& points)
{
  std::ostringstream text;
  text << std::setprecision (PRECISION)
       << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE "
          "F F F\n"
       << "COUNT 1 1 1\nWIDTH " << points.size () << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << points.size () << "\nDATA ascii\n";
  for (const Eigen::Vector3d& p : points)
    text << p.x () << ' ' << p.y () << ' ' << p.z () << '\n';
  return text.str ();
}

std::string
lasBytes (const LasFile& file)
{
  // Tables of the specification, LAS 1.4 - R15: 3 (header), 7 to 17 (points).
  constexpr std::array<std::size_t, 11> SIZES{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  constexpr std::array<std::size_t, 11> COLORS{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  constexpr std::size_t VARIABLE_RECORD = 54;
  const std::size_t header_size = file.minor >= 4 ? 375 : file.minor == 3 ? 235 : 227;
  const auto format = static_cast<std::size_t> (file.format);
  const std::size_t record = SIZES[format] + file.extra_bytes;
  const std::size_t points_at = header_size + file.variable_records * VARIABLE_RECORD;
  std::string bytes (points_at + file.points.size () * record, '\0');
  bytes.replace (0, 4, "LASF");
  putNumber (bytes, 24, std::uint8_t{1});
  putNumber (bytes, 25, static_cast<std::uint8_t> (file.minor));
  putNumber (bytes, 94, static_cast<std::uint16_t> (header_size));
  putNumber (bytes, 96, static_cast<std::uint32_t> (points_at));
  putNumber (bytes, 100, static_cast<std::uint32_t> (file.variable_records));
  putNumber (bytes, 104, static_cast<std::uint8_t> (format));
  putNumber (bytes, 105, static_cast<std::uint16_t> (record));
  const bool has_new_count = file.minor >= 4;
  if (!has_new_count || format < 6)
    putNumber (bytes, 107, static_cast<std::uint32_t> (file.points.size ()));
  if (has_new_count)
    putNumber (bytes, 247, static_cast<std::uint64_t> (file.points.size ()));
  for (int axis = 0; axis < 3; ++axis) {
    putNumber (bytes, 131 + 8 * static_cast<std::size_t> (axis), file.scale[axis]);
    putNumber (bytes, 155 + 8 * static_cast<std::size_t> (axis), file.offset[axis]);
  }
  for (std::size_t p = 0; p < file.points.size (); ++p) {
    const std::size_t at = points_at + p * record;
    for (std::size_t axis = 0; axis < 3; ++axis)
      putNumber (bytes, at + 4 * axis, file.points[p][axis]);
    putNumber (bytes, at + 12, static_cast<std::uint16_t> (7 * p));
    if (COLORS[format] > 0 && !file.colors.empty ())
      for (std::size_t channel = 0; channel < 3; ++channel)
        putNumber (bytes, at + COLORS[format] + 2 * channel, file.colors[p][channel]);
  }
  return bytes;
}

} // namespace pcl::floater
