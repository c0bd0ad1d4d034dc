// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

namespace pcl::floater {
namespace {
struct Property
{
  Field field; ///< of a list: name, and type of the entries
  bool is_list = false;
  ScalarType length_type = ScalarType::UINT8;
};

struct Element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  std::string what () const { return "rows of the element '" + name + "'"; }
};

struct PlyHeader
{
  std::optional<ByteOrder> byte_order; ///< none if ascii
  std::vector<Element> elements;

  Element* find (std::string_view name)
  {
    for (Element& element : elements)
      if (element.name == name)
        return &element;
    return nullptr;
  }
};

ScalarType
plyType (const TextScanner& scanner, std::string_view name)
{
  const auto type = findType ([name] (const TypeNames& names, ScalarType) {
    return !name.empty () && (name == names.ply || name == names.sized_ply);
  });
  if (!type)
    scanner.fail ("'" + std::string (name) + "' is not a type of PLY");
  return *type;
}

Property
readProperty (TextScanner& scanner)
{
  Property property;
  std::string_view type = scanner.word ();
  if (type == "list") {
    property.is_list = true;
    property.length_type = plyType (scanner, scanner.word ());
    if (property.length_type == ScalarType::FLOAT32 || property.length_type == ScalarType::FLOAT64)
      scanner.fail ("the length of a list must be a whole number");
    type = scanner.word ();
  }
  property.field.type = plyType (scanner, type);
  property.field.name = std::string (scanner.word ());
  if (property.field.name.empty ())
    scanner.fail ("the property has no name");
  return property;
}

PlyHeader
readPlyHeader (TextScanner& scanner)
{
  if (!scanner.nextLine () || scanner.word () != "ply")
    throw ReadError ("it does not begin with 'ply', so it is not a PLY file");
  PlyHeader header;
  bool has_format = false;
  while (scanner.nextFilledLine ()) {
    const std::string_view key = scanner.word ();
    if (key == "comment" || key == "obj_info")
      continue;
    if (key == "format") {
      const std::string_view format = scanner.word ();
      if (format == "binary_little_endian")
        header.byte_order = ByteOrder::LITTLE;
      else if (format == "binary_big_endian")
        header.byte_order = ByteOrder::BIG;
      else if (format != "ascii")
        scanner.fail ("'" + std::string (format) + "' is not a format of PLY");
      has_format = true;
    }
    else if (key == "element") {
      Element element;
      element.name = std::string (scanner.word ());
      element.count = scanner.number<std::size_t> ();
      header.elements.push_back (std::move (element));
    }
    else if (key == "property") {
      if (header.elements.empty ())
        scanner.fail ("a property before the first element");
      header.elements.back ().properties.push_back (readProperty (scanner));
    }
    else if (key == "end_header") {
      if (!has_format)
        scanner.fail ("the header has no format line");
      if (header.find ("vertex") == nullptr)
        scanner.fail ("the header has no element 'vertex'");
      return header;
    }
    else
      scanner.fail ("this is not a line of a PLY header");
  }
  throw ReadError ("the PLY header has no end; the file may be truncated");
}

std::vector<Field*>
fieldsOf (Element& element)
{
  std::vector<Field*> fields;
  for (Property& property : element.properties)
    if (!property.is_list)
      fields.push_back (&property.field);
  return fields;
}

/// Reads an element.
/// \param keep whether to store its values, without lists, in rows of its fields
/// \param fans get the corners of faces; may be nullptr
/// \param nextRow nextRow (row) goes to the next row
/// \param next next (T{}) is the next value, of the type T
/// \param endRow endRow () is called behind the last value of a row
template <typename NextRow, typename Next, typename EndRow>
void
readRows (Element& element, bool keep, PolygonFans* fans, const NextRow& nextRow, const Next& next,
          const EndRow& endRow)
{
  char* to = keep ? allocateRows (fieldsOf (element), element.count).get () : nullptr;
  for (std::size_t row = 0; row < element.count; ++row) {
    nextRow (row);
    for (const Property& property : element.properties) {
      const std::string& name = property.field.name;
      const bool are_corners = property.is_list && fans != nullptr &&
                               (name == "vertex_indices" || name == "vertex_index");
      std::size_t count = 1;
      if (property.is_list)
        count = visitType (property.length_type,
                           [&] (auto tag) { return static_cast<std::size_t> (next (tag)); });
      if (are_corners)
        fans->begin ();
      visitType (property.field.type, [&] (auto tag) {
        for (; count > 0; --count) {
          const auto value = next (tag);
          if (are_corners)
            fans->add (static_cast<double> (value));
          else if (to != nullptr && !property.is_list) {
            std::memcpy (to, &value, sizeof value);
            to += sizeof value;
          }
        }
      });
    }
    endRow ();
  }
}

/// Reads an element of a text; passes over it if it is not kept.
void
readAscii (TextScanner& scanner, Element& element, bool keep, PolygonFans* fans)
{
  const auto nextRow = [&] (std::size_t row) {
    if (!scanner.nextFilledLine ())
      failPromise (element.what (), element.count, row);
  };
  if (!keep)
    for (std::size_t row = 0; row < element.count; ++row)
      nextRow (row);
  else
    readRows (
        element, keep, fans, nextRow,
        [&scanner] (auto tag) { return scanner.number<decltype (tag)> (); },
        [&scanner] {
          if (scanner.hasWord ())
            scanner.fail ("it has more values than there are properties");
        });
}

/// Reads a binary element. Without lists, the fields are views of the file.
/// \return the bytes that follow it
std::string_view
readBinary (const FileBytes& file, std::string_view bytes, ByteOrder order, Element& element,
            bool keep, PolygonFans* fans)
{
  const std::vector<Field*> fields = fieldsOf (element);
  if (fields.size () == element.properties.size ()) {
    viewRows (fields, file.at (file.view ().size () - bytes.size ()), order);
    return bytes.substr (element.count * rowBytes (fields)); // within the file: see requireRoom
  }
  std::size_t at = 0; // the row
  readRows (
      element, keep, fans, [&at] (std::size_t row) { at = row; },
      [&] (auto tag) {
        if (bytes.size () < sizeof tag)
          failPromise (element.what (), element.count, at);
        tag = readNumber<decltype (tag)> (bytes.data (), order);
        bytes.remove_prefix (sizeof tag);
        return tag;
      },
      [] {});
  return bytes;
}

std::size_t
fewestBytes (const Element& element, bool is_ascii)
{
  std::size_t fewest = 0;
  for (const Property& property : element.properties)
    fewest += is_ascii ? 2 : sizeOf (property.is_list ? property.length_type : property.field.type);
  return fewest;
}

} // namespace

Cloud
parsePly (const FileBytes& file, const ReadOptions& options)
{
  TextScanner scanner (file.view ());
  PlyHeader header = readPlyHeader (scanner);
  std::string_view rest = scanner.rest ();
  Element& vertices = *header.find ("vertex");
  const Element* const faces = header.find ("face");
  Triangles* const triangles = options.faces;
  const bool is_widened =
      options.all_digits && !header.byte_order && widenCoordinates (fieldsOf (vertices));
  Triangles none;
  PolygonFans fans (vertices.count, triangles == nullptr ? none : *triangles);
  const Element* const last =
      triangles != nullptr && faces != nullptr && faces > &vertices ? faces : &vertices;
  for (Element* element = header.elements.data (); element <= last; ++element) {
    PolygonFans* const its_fans = triangles != nullptr && element == faces ? &fans : nullptr;
    const bool keep = element == &vertices || its_fans != nullptr;
    // The last line of a text may end without a newline.
    requireRoom (element->what (), element->count, fewestBytes (*element, !header.byte_order),
                 header.byte_order ? rest.size () : scanner.rest ().size () + 1);
    if (header.byte_order)
      rest = readBinary (file, rest, *header.byte_order, *element, keep, its_fans);
    else
      readAscii (scanner, *element, keep, its_fans);
  }
  std::vector<Field> fields;
  std::vector<std::string> warnings;
  for (Property& property : vertices.properties) {
    if (property.is_list)
      warnings.push_back ("the list '" + property.field.name + "' of the points was left out");
    else
      fields.push_back (std::move (property.field));
  }
  if (triangles == nullptr && faces != nullptr && faces->count > 0)
    warnings.push_back (facesLeftOut (faces->count));
  Cloud cloud = makeCloud (std::move (fields), vertices.count, std::move (warnings));
  cloud.single_precision |= is_widened;
  if (header.byte_order && fieldsOf (vertices).size () == vertices.properties.size ())
    cloud.file = file;
  return cloud;
}

} // namespace pcl::floater
