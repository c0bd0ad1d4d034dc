// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's legacy format; and its files in XML (VTK User's Guide, "XML file formats"), without VTK, which
// takes longer to load than most clouds to reconstruct. Of the XML, only the tags and attributes of arrays
// matter.
#include "cloud_reader.h"
#include "text_scanner.h"

#include <lodepng.h>

namespace pcl::floater {
namespace {
ScalarType
vtkType (std::string_view name)
{
  if (name == "vtkIdType")
    return ScalarType::INT32;
  if (name == "long")
    return ScalarType::INT64;
  if (const auto type = typeCalled (name, &TypeNames::vtk))
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
    std::vector<Field> fields;
    const auto addColumns = [&] (const std::vector<std::string>& names, std::size_t each,
                                 ScalarType type) {
      if (each < names.size ())
        throw ReadError ("its " + section_ + " have fewer than " + std::to_string (names.size ()) +
                         " values for each point");
      Field all{"", type, each};
      readArray (all, points);
      const char* at = all.first.get ();
      for (const std::string& name : names) {
        fields.push_back ({name, type, 1, {all.first, at}, all.stride, all.order});
        at += sizeOf (type);
      }
    };
    addColumns ({"x", "y", "z"}, 3, vtkType (word ()));
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
      readArray (offsets, rows);
      word (); // CONNECTIVITY
      corners.type = vtkType (word ());
    }
    else
      at_ = before;
    readArray (corners, size);
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
  void readArray (Field& field, std::size_t rows)
  {
    if (is_binary_)
      skipLine ();
    // A value of a text is a digit and a blank, but for the last one.
    requireRoom ("rows of its " + section_, rows,
                 is_binary_ ? field.pointBytes () : 2 * field.count,
                 bytes_.size () - at_ + (is_binary_ ? 0 : 1));
    if (is_binary_) {
      viewRows ({&field}, file_.at (at_), ByteOrder::big);
      at_ += rows * field.stride;
      return;
    }
    char* to = allocateRows ({&field}, rows).get (); // which the field keeps
    for (std::size_t row = 0; row < rows; ++row)
      to = putValues (field, to,
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

std::string_view
attributeOf (std::string_view tag, std::string_view name)
{
  const std::string start = " " + std::string (name) + "=\"";
  const std::size_t found = tag.find (start);
  if (found == std::string_view::npos)
    return {};
  tag.remove_prefix (found + start.size ());
  return tag.substr (0, tag.find ('"'));
}

std::size_t
countIn (std::string_view tag, std::string_view name, std::size_t if_none)
{
  std::size_t count = 0;
  return parseNumber (attributeOf (tag, name), count) ? count : if_none;
}

/// Bytes as they are, or in groups of base64, each of which may end with padding.
struct EncodedBytes
{
  std::string read (std::size_t bytes)
  {
    constexpr std::string_view DIGITS =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string decoded (is_raw ? text.substr (0, bytes) : "");
    text.remove_prefix (decoded.size ());
    for (; decoded.size () < bytes && !is_raw && !text.empty (); text.remove_prefix (1)) {
      const std::size_t digit = DIGITS.find (text.front ());
      if (digit == std::string_view::npos) {
        bits = text.front () == '=' ? 0 : bits;
        continue;
      }
      last = last << 6U | static_cast<std::uint32_t> (digit);
      bits += 6;
      if (bits >= 8) {
        bits -= 8;
        decoded += static_cast<char> (last >> bits & 255U);
      }
    }
    if (decoded.size () < bytes)
      throw ReadError ("an array ends before its values do; it is truncated");
    return decoded;
  }

  std::string_view text;
  bool is_raw;
  std::uint32_t last = 0; ///< digits
  unsigned bits = 0;      ///< of them that belong to the next byte
};

class VtpParser
{
public:
  explicit VtpParser (std::string_view text) : text_ (text) {}

  Cloud parse ()
  {
    std::size_t at = 0;
    const std::string_view root = findTag ("<VTKFile", at);
    if (root.empty ())
      throw ReadError ("it has no <VTKFile>, so it is not a VTK file in XML");
    order_ = attributeOf (root, "byte_order") == "BigEndian" ? ByteOrder::big : ByteOrder::little;
    has_long_headers_ = attributeOf (root, "header_type") == "UInt64";
    const std::string_view compressor = attributeOf (root, "compressor");
    is_compressed_ = !compressor.empty ();
    if (is_compressed_ && compressor != "vtkZLibDataCompressor")
      throw ReadError ("it is compressed by " + quoted (compressor) +
                       ", which cannot be read; save it without, or with zlib");
    at = 0;
    const std::string_view piece = findTag ("<Piece", at);
    points_ = countIn (piece, "NumberOfPoints", 0);
    if (std::size_t next = at; !findTag ("<Piece", next).empty ())
      throw ReadError ("it has several pieces; save it as one");
    const std::size_t end = std::min (text_.find ("</Piece", at), text_.size ());
    std::vector<Field> fields;
    for (const char* section : {"<Points", "<PointData"}) {
      std::size_t begin = at;
      if (findTag (section, begin).empty () || begin > end || text_[begin - 2] == '/')
        continue;
      const std::size_t last =
          std::min (text_.find ("</" + std::string (section + 1), begin), text_.size ());
      for (std::string_view tag = findTag ("<DataArray", begin); !tag.empty () && begin < last;
           tag = findTag ("<DataArray", begin))
        addArray (tag, begin, std::string_view (section) == "<Points", fields);
    }
    std::vector<std::string> warnings;
    if (const std::size_t faces = countIn (piece, "NumberOfPolys", 0))
      warnings.push_back (facesLeftOut (faces));
    return makeCloud (std::move (fields), points_, std::move (warnings));
  }

private:
  /// The next tag of this name, with its attributes; empty if there is none.
  std::string_view findTag (const std::string& name, std::size_t& at) const
  {
    const std::size_t begin = text_.find (name, at);
    const std::size_t end = begin == std::string_view::npos ? begin : text_.find ('>', begin);
    if (end == std::string_view::npos)
      return {};
    at = end + 1;
    return text_.substr (begin, end - begin);
  }

  std::uint64_t header (EncodedBytes& bytes) const
  {
    return has_long_headers_ ? readNumber<std::uint64_t> (bytes.read (8).data (), order_)
                             : readNumber<std::uint32_t> (bytes.read (4).data (), order_);
  }

  std::string decode (EncodedBytes bytes, std::size_t expected) const
  {
    const std::uint64_t first = header (bytes);
    if (!is_compressed_)
      return bytes.read (first == expected ? expected : text_.size () + 1);
    header (bytes); // of a whole block, and of the last one
    header (bytes);
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t block = 0; block < first; ++block)
      sizes.push_back (header (bytes));
    std::string values;
    for (const std::uint64_t size : sizes) {
      const std::string packed = bytes.read (size);
      std::vector<unsigned char> block;
      if (lodepng::decompress (block, reinterpret_cast<const unsigned char*> (packed.data ()),
                               packed.size ()) != 0)
        throw ReadError ("the compressed data are damaged");
      values.append (block.begin (), block.end ());
    }
    return values;
  }

  void addArray (std::string_view tag, std::size_t at, bool is_place, std::vector<Field>& fields)
  {
    const std::optional<ScalarType> type = typeCalled (attributeOf (tag, "type"), &TypeNames::vtp);
    const std::size_t each = countIn (tag, "NumberOfComponents", 1);
    if (!type || each == 0 || each > 256 || points_ > text_.size () * 1100) // what zlib can do
      return;
    const std::size_t bytes = points_ * each * sizeOf (*type);
    const std::string_view format = attributeOf (tag, "format");
    std::string values;
    ByteOrder order = order_;
    if (format == "ascii") {
      TextScanner scanner (text_.substr (at, text_.find ('<', at) - at));
      for (std::size_t i = 0; i < points_ * each; ++i) {
        if (!scanner.hasWord () && !scanner.nextFilledLine ())
          throw ReadError ("an array ends before its values do; it is truncated");
        visitType (*type, [&] (auto number) {
          number = scanner.number<decltype (number)> ();
          values.append (reinterpret_cast<const char*> (&number), sizeof number);
        });
      }
      order = ByteOrder::native;
    }
    else if (format == "appended") {
      std::size_t begin = 0;
      const bool is_raw = attributeOf (findTag ("<AppendedData", begin), "encoding") == "raw";
      begin = std::min (text_.find ('_', begin), text_.size ());
      const std::size_t offset = countIn (tag, "offset", 0);
      const std::size_t left = text_.size () - begin;
      values = decode ({text_.substr (begin + std::min (left, offset + 1)), is_raw}, bytes);
    }
    else
      values = decode ({text_.substr (at, text_.find ('<', at) - at), false}, bytes);
    if (values.size () != bytes)
      throw ReadError ("an array has not as many values as there are points");
    const std::string name (attributeOf (tag, "Name"));
    std::vector<std::string> names{name};
    if (is_place && each >= 3)
      names = {"x", "y", "z"};
    else if (each == 3 && isWord (name, "Normals"))
      names = {"nx", "ny", "nz"};
    else if ((each == 3 || each == 4) && *type == ScalarType::UINT8)
      names = {"red", "green", "blue", "alpha"};
    names.resize (std::min (names.size (), each));
    addColumns (names, *type, std::move (values), fields, each);
    if (names.size () == 1)
      fields.back ().count = each;
    for (std::size_t f = fields.size () - names.size (); f < fields.size (); ++f)
      fields[f].order = order;
  }

  std::string_view text_;
  ByteOrder order_ = ByteOrder::little;
  bool has_long_headers_ = false, is_compressed_ = false;
  std::size_t points_ = 0;
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

Cloud
parseVtp (const FileBytes& file, const ReadOptions& /*options*/)
{
  return VtpParser (file.view ()).parse ();
}

} // namespace pcl::floater
