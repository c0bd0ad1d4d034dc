// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

namespace pcl::floater {
namespace {
ScalarType
vtkType (std::string_view name)
{
  if (name == "vtkIdType")
    return ScalarType::INT32;
  if (name == "long")
    return ScalarType::INT64;
  if (const auto type =
          findType ([name] (const TypeNames& names, ScalarType) { return name == names.vtk; }))
    return *type;
  throw ReadError ("it has coordinates or polygons of the type " + quoted (name) +
                   ", which cannot be read");
}

/// Finds sections by their names, so that what is between them need not be understood.
class VtkParser
{
public:
  explicit VtkParser (const FileBytes& file) : file_ (file), bytes_ (file.view ()) {}

  Cloud parse (Triangles& triangles)
  {
    if (bytes_.substr (0, 14) != "# vtk DataFile")
      throw ReadError ("it does not begin with '# vtk DataFile', so it is not a VTK file");
    skipLine ();
    skipLine (); // the title
    is_binary_ = word () == "BINARY";
    const bool has_polygons = find ("DATASET") && word () == "POLYDATA";
    if (!find ("POINTS"))
      throw ReadError ("it has no POINTS");
    const std::size_t points = count ();
    const ScalarType type = vtkType (word ());
    std::vector<Field> fields{{"x", type}, {"y", type}, {"z", type}};
    readArray ({&fields[0], &fields[1], &fields[2]}, points);
    if (has_polygons && find ("POLYGONS"))
      readPolygons (points, triangles);
    const bool has_data = find ("POINT_DATA") && count () == points;
    const std::size_t data = at_;
    // Their order is that of who wrote them.
    const auto findData = [&] (const std::string& section) {
      at_ = data;
      const bool is_found = has_data && find (section);
      if (is_found)
        word (); // its name
      return is_found;
    };
    const auto addColumns = [&] (const std::vector<std::string>& names, std::size_t each,
                                 ScalarType column_type) {
      if (each < names.size ())
        throw ReadError ("its " + section_ + " have fewer than " + std::to_string (names.size ()) +
                         " values for each point");
      std::vector<Field> columns;
      columns.reserve (names.size () + 1);
      for (const std::string& name : names)
        columns.push_back ({name, column_type});
      columns.push_back ({"", column_type, each - names.size ()});
      readArray (pointersTo (columns), points);
      fields.insert (fields.end (), columns.begin (), columns.end () - 1);
    };
    if (findData ("COLOR_SCALARS"))
      addColumns ({"red", "green", "blue"}, count (),
                  is_binary_ ? ScalarType::UINT8 : ScalarType::FLOAT32);
    if (findData ("NORMALS"))
      addColumns ({"nx", "ny", "nz"}, 3, vtkType (word ()));
    if (findData ("TEXTURE_COORDINATES")) {
      const std::size_t each = count ();
      addColumns ({"s", "t"}, each, vtkType (word ()));
    }
    return makeCloud (std::move (fields), points);
  }

private:
  // Two layouts: the length of each polygon before its corners; or, since VTK 9, where each begins.
  void readPolygons (std::size_t points, Triangles& triangles)
  {
    const std::size_t rows = count (), size = count (), before = at_;
    const bool has_offsets = word () == "OFFSETS";
    Field offsets{"", ScalarType::INT32}, corners = offsets;
    if (has_offsets) {
      offsets.type = vtkType (word ());
      readArray ({&offsets}, rows);
      word (); // CONNECTIVITY
      corners.type = vtkType (word ());
    }
    else
      at_ = before;
    readArray ({&corners}, size);
    const auto whole = static_cast<double> (size);
    double end = 0.0;
    std::vector<double> polygon;
    for (std::size_t row = 0; row + (has_offsets ? 1 : 0) < rows; ++row) {
      double begin = end + 1.0;
      if (has_offsets) {
        begin = offsets.asDouble (row);
        end = offsets.asDouble (row + 1);
      }
      else if (end < whole)
        end = begin + corners.asDouble (static_cast<std::size_t> (end));
      if (!(begin >= 0.0 && begin <= end && end <= whole))
        throw ReadError ("the lengths of its polygons are wrong");
      polygon.clear ();
      for (auto i = static_cast<std::size_t> (begin); i < static_cast<std::size_t> (end); ++i)
        polygon.push_back (corners.asDouble (i));
      addFan (polygon, points, triangles);
    }
  }

  // Binary values stay in the file.
  void readArray (const std::vector<Field*>& fields, std::size_t rows)
  {
    if (is_binary_)
      skipLine ();
    const std::size_t row_bytes = rowBytes (fields);
    std::size_t text_bytes = 0; // a value of a text is a digit and a blank, but for the last one
    for (const Field* field : fields)
      text_bytes += 2 * field->count;
    requireRoom ("rows of its " + section_, rows, is_binary_ ? row_bytes : text_bytes,
                 bytes_.size () - at_ + (is_binary_ ? 0 : 1));
    if (is_binary_) {
      viewRows (fields, file_.at (at_), ByteOrder::BIG);
      at_ += rows * row_bytes;
      return;
    }
    char* to = allocateRows (fields, rows).get (); // which the fields keep
    for (std::size_t row = 0; row < rows; ++row)
      for (const Field* field : fields)
        to = putValues (*field, to,
                        [this] (auto tag, std::size_t) { return number<decltype (tag)> (); });
  }

  // Goes on after the name of a section, if there is one after this place.
  bool find (const std::string& section)
  {
    const std::size_t found = bytes_.find ("\n" + section + " ", at_);
    if (found == std::string_view::npos)
      return false;
    section_ = section;
    at_ = found + section.size () + 2;
    return true;
  }

  // The next word, which may be in another line.
  std::string_view word ()
  {
    constexpr const char* BLANKS = " \t\r\n\v\f";
    const std::size_t first = std::min (bytes_.find_first_not_of (BLANKS, at_), bytes_.size ());
    at_ = std::min (bytes_.find_first_of (BLANKS, first), bytes_.size ());
    return bytes_.substr (first, at_ - first);
  }

  void skipLine () { at_ = std::min (bytes_.find ('\n', at_), bytes_.size () - 1) + 1; }

  template <typename T>
  T number ()
  {
    T result;
    const std::string_view text = word ();
    if (!parseNumber (text, result))
      throw ReadError ("in its " + section_ + ", " + quoted (text) +
                       " is not a number of the right type");
    return result;
  }

  // How many there are of something: not more than the file has bytes, so that products with
  // sizes do not overflow.
  std::size_t count ()
  {
    const auto result = number<std::size_t> ();
    if (result > bytes_.size ())
      throw ReadError ("its " + section_ + " promise more than fits into the file");
    return result;
  }

  const FileBytes& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_binary_ = false;
  std::string section_;
};

} // namespace

Cloud
parseVtk (const FileBytes& file, const ReadOptions& options)
{
  Triangles left_out;
  Cloud cloud = VtkParser (file).parse (options.faces != nullptr ? *options.faces : left_out);
  if (!left_out.empty ())
    cloud.warnings.push_back (facesLeftOut (left_out.size ()));
  return cloud;
}

} // namespace pcl::floater
