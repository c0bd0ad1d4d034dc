// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "polygon_fans.h"
#include "text_scanner.h"

#include <algorithm>

namespace pcl::floater {
namespace {
ScalarType
vtkType (const std::string& name)
{
  static const std::array<std::pair<const char*, ScalarType>, 14> known{
      {{"char", ScalarType::INT8},
       {"signed_char", ScalarType::INT8},
       {"unsigned_char", ScalarType::UINT8},
       {"short", ScalarType::INT16},
       {"unsigned_short", ScalarType::UINT16},
       {"int", ScalarType::INT32},
       {"vtkidtype", ScalarType::INT32},
       {"unsigned_int", ScalarType::UINT32},
       {"long", ScalarType::INT64},
       {"vtktypeint64", ScalarType::INT64},
       {"unsigned_long", ScalarType::UINT64},
       {"vtktypeuint64", ScalarType::UINT64},
       {"float", ScalarType::FLOAT32},
       {"double", ScalarType::FLOAT64}}};
  for (const auto& [known_name, type] : known)
    if (name == known_name)
      return type;
  throw ReadError ("it has an array of the type '" + name + "', which cannot be read");
}

class VtkParser
{
public:
  explicit VtkParser (const FileBytes& file) : file_ (file), bytes_ (file.view ()) {}

  Cloud parse (Triangles& triangles)
  {
    parseHeader ();
    for (section_ = keyword (); !section_.empty (); section_ = keyword ())
      parseSection (triangles);
    std::vector<Field> fields (points_.begin (), points_.end ());
    fields.insert (fields.end (), texture_.begin (), texture_.end ());
    Cloud cloud = makeCloud (std::move (fields), size_);
    cloud.file = file_;
    return cloud;
  }

private:
  void parseHeader ()
  {
    if (restOfLine ().substr (0, 14) != "# vtk DataFile")
      throw ReadError ("it does not begin with '# vtk DataFile', so it is not a VTK file");
    skipLine ();
    skipLine (); // the title
    const std::string format = keyword ();
    is_binary_ = format == "binary";
    if (!is_binary_ && format != "ascii")
      throw ReadError ("it is neither ASCII nor BINARY");
  }

  void parseSection (Triangles& triangles)
  {
    static const std::array<std::pair<const char*, std::size_t>, 7> plain{{{"vectors", 3},
                                                                           {"normals", 3},
                                                                           {"tensors", 9},
                                                                           {"tensors6", 6},
                                                                           {"global_ids", 1},
                                                                           {"pedigree_ids", 1},
                                                                           {"edge_flags", 1}}};
    const auto* const known = std::find_if (
        plain.begin (), plain.end (), [this] (const auto& name) { return section_ == name.first; });
    if (section_ == "dataset") {
      if (keyword () != "polydata")
        throw ReadError ("its data set is not POLYDATA");
    }
    else if (section_ == "points") {
      if (!points_.empty ())
        throw ReadError ("it has POINTS twice");
      size_ = count ();
      const ScalarType type = vtkType (keyword ());
      points_ = {Field{"x", type}, Field{"y", type}, Field{"z", type}};
      readArray ({&points_[0], &points_[1], &points_[2]}, size_);
    }
    else if (section_ == "polygons")
      readCells (PolygonFans (size_, triangles));
    else if (section_ == "vertices" || section_ == "lines" || section_ == "triangle_strips") {
      Triangles none;
      readCells (PolygonFans (size_, none));
    }
    else if (section_ == "point_data" || section_ == "cell_data") {
      rows_ = count ();
      is_of_points_ = section_ == "point_data";
      if (is_of_points_ && (points_.empty () || rows_ != size_))
        throw ReadError ("its POINT_DATA are not for the points before them");
    }
    else if (section_ == "field") {
      word (); // its name
      for (std::size_t left = count (); left > 0; --left) {
        keyword (); // the name of the array
        const std::size_t values = count (), rows = count ();
        skipArray (vtkType (keyword ()), values, rows);
      }
    }
    else if (section_ == "scalars") {
      word ();
      const ScalarType type = vtkType (keyword ());
      const bool has_count = restOfLine ().find_first_not_of (BLANKS) != std::string_view::npos;
      const std::size_t values = has_count ? count () : 1, before = at_;
      if (keyword () == "lookup_table")
        word ();
      else
        at_ = before;
      skipArray (type, values, rows_);
    }
    else if (section_ == "color_scalars" || section_ == "lookup_table") {
      word ();
      const std::size_t number = count ();
      const ScalarType type = is_binary_ ? ScalarType::UINT8 : ScalarType::FLOAT32;
      if (section_ == "lookup_table")
        skipArray (type, 4, number);
      else
        skipArray (type, number, rows_);
    }
    else if (section_ == "texture_coordinates") {
      word ();
      const std::size_t values = count ();
      const ScalarType type = vtkType (keyword ());
      if (!is_of_points_ || values < 2)
        return skipArray (type, values, rows_);
      texture_ = {Field{"s", type}, Field{"t", type}};
      Field others{"", type, values - 2};
      readArray ({&texture_[0], &texture_[1], &others}, rows_);
    }
    else if (known != plain.end ()) {
      word ();
      skipArray (vtkType (keyword ()), known->second, rows_);
    }
    else
      throw ReadError ("it has a section '" + section_.substr (0, LONGEST) + "', which is unknown");
  }

  // Two layouts: the length of each polygon before its corners; or, since VTK 9, where each begins.
  void readCells (PolygonFans fans)
  {
    const std::size_t cells = count (), size = count (), before = at_;
    const bool has_offsets = keyword () == "offsets";
    Field offsets{"", ScalarType::INT32}, corners = offsets;
    if (has_offsets) {
      offsets.type = vtkType (keyword ());
      readArray ({&offsets}, cells);
      keyword (); // CONNECTIVITY
      corners.type = vtkType (keyword ());
    }
    else
      at_ = before;
    readArray ({&corners}, size);
    double end = 0.0;
    for (std::size_t cell = 0; cell + (has_offsets ? 1 : 0) < cells; ++cell) {
      double begin = end + 1.0;
      if (has_offsets) {
        begin = offsets.asDouble (cell);
        end = offsets.asDouble (cell + 1);
      }
      else if (end < static_cast<double> (size))
        end = begin + corners.asDouble (static_cast<std::size_t> (end));
      if (!(begin >= 0.0 && begin <= end && end <= static_cast<double> (size)))
        throw ReadError ("its " + section_ + " do not have the lengths that they tell");
      fans.begin ();
      for (auto i = static_cast<std::size_t> (begin); i < static_cast<std::size_t> (end); ++i)
        fans.add (corners.asDouble (i));
    }
  }

  void skipArray (ScalarType type, std::size_t values, std::size_t rows)
  {
    Field field{"", type, values};
    readArray ({&field}, rows);
  }

  // Binary values stay in the file.
  void readArray (const std::vector<Field*>& fields, std::size_t rows)
  {
    if (is_binary_)
      skipLine ();
    std::size_t row_bytes = 0, fewest = 0;
    for (const Field* field : fields) {
      row_bytes += field->pointBytes ();
      fewest += is_binary_ ? field->pointBytes () : 2 * field->count; // a digit and a blank
    }
    if (fewest > 0 && rows > (bytes_.size () - at_ + (is_binary_ ? 0 : 1)) / fewest)
      throw ReadError ("its " + section_ + " end before their values do; it is truncated");
    if (is_binary_) {
      viewRows (fields, file_.at (at_), ByteOrder::BIG);
      at_ += rows * row_bytes;
      return;
    }
    char* to = allocateRows (fields, rows).get (); // which the fields keep
    for (std::size_t row = 0; row < rows && row_bytes > 0; ++row)
      for (const Field* field : fields)
        visitType (field->type, [&] (auto tag) {
          for (std::size_t c = 0; c < field->count; ++c, to += sizeof tag) {
            parse (tag);
            std::memcpy (to, &tag, sizeof tag);
          }
        });
  }

  // The next word, which may be in another line.
  std::string_view word ()
  {
    const std::size_t first = std::min (bytes_.find_first_not_of (BLANKS, at_), bytes_.size ());
    at_ = std::min (bytes_.find_first_of (BLANKS, first), bytes_.size ());
    return bytes_.substr (first, at_ - first);
  }

  // The next word in lower case. Blocks of metadata, which end with an empty line, are skipped.
  std::string keyword ()
  {
    for (;;) {
      std::string lower (word ());
      std::transform (lower.begin (), lower.end (), lower.begin (), [] (char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
      });
      if (lower != "metadata")
        return lower;
      for (skipLine (); restOfLine ().find_first_not_of (BLANKS) != std::string_view::npos;)
        skipLine ();
    }
  }

  std::string_view restOfLine () const
  {
    return bytes_.substr (at_, bytes_.find ('\n', at_) - at_);
  }

  void skipLine () { at_ = std::min (at_ + restOfLine ().size () + 1, bytes_.size ()); }

  template <typename T>
  void parse (T& number)
  {
    const std::string_view text = word ();
    if (!parseNumber (text, number))
      throw ReadError ("in its " + section_ + ", '" + std::string (text.substr (0, LONGEST)) +
                       "' is not a number of the right type");
  }

  // How many there are of something: not more than the file has bytes, so that products with
  // sizes do not overflow.
  std::size_t count ()
  {
    std::size_t number = 0;
    parse (number);
    if (number > bytes_.size ())
      throw ReadError ("its " + section_ + " promise more than fits into the file");
    return number;
  }

  static constexpr const char* BLANKS = " \t\r\n\v\f";
  static constexpr std::size_t LONGEST = 40; // of a word in a message

  const FileBytes& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_binary_ = false, is_of_points_ = false;
  std::string section_ = "header";
  std::size_t size_ = 0, rows_ = 0; // of the points; of the arrays of data that follow
  std::vector<Field> points_, texture_;
};

} // namespace

Cloud
parseVtk (const FileBytes& file, Triangles& triangles)
{
  return VtkParser (file).parse (triangles);
}

} // namespace pcl::floater
