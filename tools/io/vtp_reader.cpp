// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of VTK's files in XML (VTK User's Guide, "XML file formats"), without VTK, which takes longer
// to load than most clouds to reconstruct. Of the XML, only the tags and attributes of arrays matter.
#include "cloud_reader.h"
#include "text_scanner.h"

#include <lodepng.h>

namespace pcl::floater {
namespace {
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
class EncodedBytes
{
public:
  EncodedBytes (std::string_view text, bool is_raw) : text_ (text), is_raw_ (is_raw) {}

  std::string read (std::size_t bytes)
  {
    constexpr std::string_view DIGITS =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string decoded (is_raw_ ? text_.substr (0, bytes) : "");
    text_.remove_prefix (decoded.size ());
    for (; decoded.size () < bytes && !is_raw_ && !text_.empty (); text_.remove_prefix (1)) {
      const std::size_t digit = DIGITS.find (text_.front ());
      if (digit == std::string_view::npos) {
        bits_ = text_.front () == '=' ? 0 : bits_;
        continue;
      }
      last_ = last_ << 6U | static_cast<std::uint32_t> (digit);
      bits_ += 6;
      if (bits_ >= 8) {
        bits_ -= 8;
        decoded += static_cast<char> (last_ >> bits_ & 255U);
      }
    }
    if (decoded.size () < bytes)
      throw ReadError ("an array ends before its values do; it is truncated");
    return decoded;
  }

private:
  std::string_view text_;
  bool is_raw_;
  std::uint32_t last_ = 0; // digits
  unsigned bits_ = 0;      // of them that belong to the next byte
};

class VtpParser
{
public:
  explicit VtpParser (std::string_view text) : text_ (text)
  {
    std::size_t at = 0;
    root_ = findTag ("<VTKFile", at);
    if (root_.empty ())
      throw ReadError ("it has no <VTKFile>, so it is not a VTK file in XML");
    order_ = attributeOf (root_, "byte_order") == "BigEndian" ? ByteOrder::BIG : ByteOrder::LITTLE;
    has_long_headers_ = attributeOf (root_, "header_type") == "UInt64";
    const std::string_view compressor = attributeOf (root_, "compressor");
    is_compressed_ = !compressor.empty ();
    if (is_compressed_ && compressor != "vtkZLibDataCompressor")
      throw ReadError ("it is compressed by " + quoted (compressor) +
                       ", which cannot be read; save it without, or with zlib");
  }

  Cloud parse ()
  {
    std::size_t at = 0;
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
    const std::optional<ScalarType> type =
        findType ([of = attributeOf (tag, "type")] (const TypeNames& names, ScalarType) {
          return of == names.vtp;
        });
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
      order = HOST_BYTE_ORDER;
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
    const std::size_t before = fields.size ();
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
    for (std::size_t f = before; f < fields.size (); ++f)
      fields[f].order = order;
  }

  std::string_view text_, root_;
  ByteOrder order_ = ByteOrder::LITTLE;
  bool has_long_headers_ = false, is_compressed_ = false;
  std::size_t points_ = 0;
};

} // namespace

Cloud
parseVtp (const FileBytes& file, const ReadOptions& /*options*/)
{
  return VtpParser (file.view ()).parse ();
}

} // namespace pcl::floater
