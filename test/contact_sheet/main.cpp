// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One picture of many results: pcl_floater_contact_sheet OUT.png FOLDER NAME...
//
// FOLDER has NAME.json, the report of a run of pcl_floater_reconstruct, and NAME.vtk, its mesh,
// unless the cloud was refused. If there is a NAME.gt.ply, the true mesh, it is shown beside. A
// scan is seen from its sensor. Figures of the mesh are counted here, not taken from the report.
#include "atomic_file.h"
#include "canvas.h"
#include "mesh_oracle.h"
#include "mesh_picture.h"
#include "picture_files.h"

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

namespace pcl
{
namespace floater
{
namespace
{
// Pixels.
constexpr int PICTURE = 400, MARGIN = 12, NAME_SIZE = 20, TEXT_SIZE = 15, LINE = 20;
constexpr int CELL_WIDTH = PICTURE + 2 * MARGIN;
constexpr int CAPTION_LINES = 6; // below the name
constexpr int CELL_HEIGHT = PICTURE + 2 * MARGIN + (CAPTION_LINES + 2) * LINE;
// Characters.
constexpr std::size_t LINE_LENGTH = 50;
constexpr std::size_t REASON_LINES = 12;
constexpr Rgb INK{30, 30, 30}, WARNING{150, 85, 0}, REFUSAL{190, 10, 30};

struct Line
{
  std::string text;
  Rgb colour;
};

struct Cell
{
  std::string name;
  vtkSmartPointer<vtkImageData> picture; ///< null if there is no mesh
  std::vector<Line> lines;
};

std::string
grouped (std::size_t number)
{
  std::string digits = std::to_string (number);
  for (std::size_t at = digits.size (); at > 3;)
    digits.insert (at -= 3, ",");
  return digits;
}

std::string
counted (std::size_t number, const std::string& what)
{
  return grouped (number) + " " + what + (number == 1 ? "" : "s");
}

std::vector<Triangle>
trianglesOf (vtkPolyData* mesh)
{
  std::vector<Triangle> triangles;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells (); ++cell) {
    mesh->GetCellPoints (cell, corners);
    triangles.push_back ({static_cast<Index> (corners->GetId (0)),
                          static_cast<Index> (corners->GetId (1)),
                          static_cast<Index> (corners->GetId (2))});
  }
  return triangles;
}

/// The triangles with the points that they use: the others would only make the picture smaller.
vtkSmartPointer<vtkPolyData>
withoutUnusedPoints (const samples::Positions& points, const std::vector<Triangle>& triangles)
{
  std::vector<vtkIdType> vertex (points.size (), -1);
  vtkNew<vtkPoints> used;
  used->SetDataTypeToDouble ();
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : triangles) {
    cells->InsertNextCell (3);
    for (const Index p : t) {
      if (vertex[p] < 0)
        vertex[p] = used->InsertNextPoint (points[p].data ());
      cells->InsertCellPoint (vertex[p]);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New ();
  mesh->SetPoints (used);
  mesh->SetPolys (cells);
  return mesh;
}

vtkSmartPointer<vtkPolyData>
linesOf (const std::vector<std::array<Index, 2>>& edges, vtkPoints* points)
{
  vtkNew<vtkCellArray> lines;
  for (const auto& [a, b] : edges) {
    const std::array<vtkIdType, 2> ends{a, b};
    lines->InsertNextCell (2, ends.data ());
  }
  auto made = vtkSmartPointer<vtkPolyData>::New ();
  made->SetPoints (points);
  made->SetLines (lines);
  return made;
}

// Share of the area in triangles with an edge above 20 times the median edge at either end.
double
areaInLongTriangles (const std::vector<Triangle>& triangles, const samples::Positions& points)
{
  constexpr double LONG = 20.0;
  std::vector<std::vector<double>> lengths (points.size ());
  const auto lengthOf = [&] (const Triangle& t, std::size_t side) {
    return (points[t[(side + 1) % 3]] - points[t[side]]).norm ();
  };
  for (const Triangle& t : triangles)
    for (std::size_t side = 0; side < 3; ++side)
      lengths[t[side]].push_back (lengthOf (t, side));
  const auto isLong = [&] (double length, Index at) {
    std::vector<double>& of_point = lengths[at];
    const auto middle = of_point.begin () + static_cast<std::ptrdiff_t> (of_point.size () / 2);
    std::nth_element (of_point.begin (), middle, of_point.end ());
    return length > LONG * *middle;
  };
  double all = 0.0, in_long = 0.0;
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d& at = points[t[0]];
    const double area = (points[t[1]] - at).cross (points[t[2]] - at).norm ();
    bool is_long = false;
    for (std::size_t side = 0; side < 3; ++side)
      is_long = is_long || (isLong (lengthOf (t, side), t[side]) &&
                            isLong (lengthOf (t, side), t[(side + 1) % 3]));
    all += area;
    in_long += is_long ? area : 0.0;
  }
  return all > 0.0 ? in_long / all : 0.0;
}

void
addMesh (vtkPolyData* file, const double* viewpoint, Cell& cell)
{
  samples::Positions points (static_cast<std::size_t> (file->GetNumberOfPoints ()));
  for (std::size_t p = 0; p < points.size (); ++p)
    file->GetPoint (static_cast<vtkIdType> (p), points[p].data ());
  const std::vector<Triangle> triangles = trianglesOf (file);
  const auto folded = samples::foldedEdges (triangles, points);
  const samples::Topology topology = samples::topologyOf (triangles);

  const vtkSmartPointer<vtkPolyData> marks = linesOf (folded, file->GetPoints ());
  PictureOptions options;
  options.marked_edges = marks;
  options.flat_shading = true;
  options.viewpoint = viewpoint;
  cell.picture = drawMesh (withoutUnusedPoints (points, triangles), PICTURE, options);

  const long handles = 2 * static_cast<long> (topology.components) - topology.euler -
                       static_cast<long> (topology.loops.size ());
  cell.lines.push_back ({counted (topology.components, "component") + ", " +
                             counted (topology.loops.size (), "loop") + ", genus " +
                             std::to_string (handles / 2) + ", " + counted (folded.size (), "fold"),
                         INK});
  const double in_long = 100.0 * areaInLongTriangles (triangles, points);
  if (in_long > 0.0) {
    std::ostringstream text;
    text.precision (2);
    text << in_long << " % of the area in triangles over 20 spacings long";
    cell.lines.push_back ({text.str (), INK});
  }
  if (!topology.manifold)
    cell.lines.push_back ({"not an oriented manifold", REFUSAL});
}

std::optional<std::array<double, 3>>
viewpointOf (const nlohmann::json& report)
{
  const auto& viewpoint = report.at ("viewpoint");
  if (viewpoint.is_null () || viewpoint.at ("is_far"))
    return {};
  return viewpoint.at ("place").get<std::array<double, 3>> ();
}

// The true mesh of a cloud.
Cell
makeTruthCell (const std::filesystem::path& folder, const std::string& name)
{
  std::ifstream file (folder / (name + ".json"));
  const std::optional<std::array<double, 3>> viewpoint = viewpointOf (nlohmann::json::parse (file));
  Cell cell;
  cell.name = name + ": truth";
  addMesh (readMesh ((folder / (name + ".gt.ply")).string ()),
           viewpoint ? viewpoint->data () : nullptr, cell);
  return cell;
}

Cell
makeCell (const std::filesystem::path& folder, const std::string& name)
{
  std::ifstream file (folder / (name + ".json"));
  const auto report = nlohmann::json::parse (file);
  const auto& statistics = report.at ("statistics");
  const std::size_t points = statistics.at ("cloud_points");
  const std::string status = report.at ("status");
  Cell cell;
  cell.name = name;
  if (status != "SUCCESS") {
    cell.lines.push_back ({counted (points, "point"), INK});
    for (const std::string& text :
         wrap (status + ": " + std::string (report.at ("message")), LINE_LENGTH, REASON_LINES))
      cell.lines.push_back ({text, REFUSAL});
    return cell;
  }
  const std::size_t unused = report.at ("unused").size ();
  const double seconds = report.at ("seconds").at ("reconstruction");
  const std::string shown = std::to_string (std::round (100.0 * seconds) / 100.0);
  cell.lines.push_back ({counted (points, "point") +
                             (unused > 0 ? " (" + grouped (unused) + " unused)" : "") + ", " +
                             counted (statistics.at ("triangles"), "triangle") + ", " +
                             shown.substr (0, shown.find ('.') + 3) + " s",
                         INK});
  const std::optional<std::array<double, 3>> viewpoint = viewpointOf (report);
  addMesh (readMesh ((folder / (name + ".vtk")).string ()),
           viewpoint ? viewpoint->data () : nullptr, cell);
  for (const std::string warning : report.at ("warnings"))
    for (const std::string& text : wrap (warning, LINE_LENGTH, 2))
      cell.lines.push_back ({text, WARNING});
  if (cell.lines.size () > CAPTION_LINES) {
    cell.lines.resize (CAPTION_LINES);
    cell.lines.back () = {"... and more warnings", WARNING};
  }
  return cell;
}

void
place (const Cell& cell, int x, int y, Canvas& canvas)
{
  if (cell.picture != nullptr)
    canvas.put (cell.picture, x + MARGIN, y + MARGIN);
  // A reason takes the place of the picture.
  int at = cell.picture != nullptr ? y + PICTURE + 2 * MARGIN : y + PICTURE / 3;
  canvas.write (cell.name, x + MARGIN, at, NAME_SIZE, true, INK);
  at += LINE + LINE / 3;
  for (const Line& line : cell.lines) {
    canvas.write (line.text, x + MARGIN, at, TEXT_SIZE, false, line.colour);
    at += LINE;
  }
}

std::vector<unsigned char>
makeSheet (const std::filesystem::path& folder, const std::vector<std::string>& names)
{
  std::vector<Cell> cells;
  for (const std::string& name : names) {
    cells.push_back (makeCell (folder, name));
    if (std::filesystem::exists (folder / (name + ".gt.ply")))
      cells.push_back (makeTruthCell (folder, name));
  }
  // About as wide as high.
  const int count = static_cast<int> (cells.size ());
  const int rows = std::max (1, static_cast<int> (std::lround (std::sqrt (
                                    static_cast<double> (count) * CELL_WIDTH / CELL_HEIGHT))));
  const int columns = (count + rows - 1) / rows;
  Canvas canvas (columns * CELL_WIDTH, rows * CELL_HEIGHT);
  for (int i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t> (i)];
    place (cell, i % columns * CELL_WIDTH, i / columns * CELL_HEIGHT, canvas);
    std::cout << cell.name;
    for (const Line& line : cell.lines)
      std::cout << "\n  " << line.text;
    std::cout << std::endl;
  }
  return toPng (canvas.image ());
}

} // namespace
} // namespace floater
} // namespace pcl

int
main (int argc, char** argv)
{
  const std::vector<std::string> arguments (argv + 1, argv + argc);
  if (arguments.size () < 3 || !pcl::floater::displayAvailable ()) {
    std::cerr << "Usage: on_virtual_display.sh pcl_floater_contact_sheet OUT.png FOLDER NAME...\n";
    return 1;
  }
  try {
    const std::vector<unsigned char> png =
        pcl::floater::makeSheet (arguments[1], {arguments.begin () + 2, arguments.end ()});
    pcl::floater::AtomicFile file (arguments[0]);
    file.write (png.data (), png.size ());
    file.close ();
    file.publish ();
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_floater_contact_sheet: " << error.what () << "\n";
    return 1;
  }
  return 0;
}
