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
};

struct PlyHeader
{
  std::optional<ByteOrder> byte_order; ///< none if ascii
  std::vector<Element> elements;
  std::string_view rest; ///< of a binary file: what has not been read

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
  for (const auto format : {&TypeNames::ply, &TypeNames::sized_ply})
    if (const auto type = typeCalled (name, format))
      return *type;
  scanner.fail ("'" + std::string (name) + "' is not a type of PLY");
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
        header.byte_order = ByteOrder::little;
      else if (format == "binary_big_endian")
        header.byte_order = ByteOrder::big;
      else if (format != "ascii")
        scanner.fail ("'" + std::string (format) + "' is not a format of PLY");
      has_format = true;
    }
    else if (key == "element") {
      const std::string name (scanner.word ());
      header.elements.push_back ({name, scanner.number<std::size_t> (), {}});
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
      header.rest = scanner.rest ();
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

/// Reads an element, behind those before it. Without lists, binary ones become views of the file.
/// \param scanner of a text: where the element begins
/// \param triangles get the faces; nullptr: only the values of "vertex" are kept, without lists
void
readElement (const FileBytes& file, TextScanner& scanner, PlyHeader& header, Element& element,
             Triangles* triangles)
{
  const std::optional<ByteOrder> order = header.byte_order;
  std::string_view& rest = header.rest;
  const Element* const vertices = header.find ("vertex");
  const std::string what = "rows of the element '" + element.name + "'";
  std::size_t fewest = 0; // bytes of each
  for (const Property& property : element.properties)
    fewest += !order ? 2 : sizeOf (property.is_list ? property.length_type : property.field.type);
  // The last line of a text may end without a newline.
  requireRoom (what, element.count, fewest, order ? rest.size () : scanner.rest ().size () + 1);
  const std::vector<Field*> fields = fieldsOf (element);
  if (order && fields.size () == element.properties.size ()) {
    viewRows (fields, file.at (file.view ().size () - rest.size ()), *order);
    rest.remove_prefix (element.count * rowBytes (fields));
    return;
  }
  const bool keep = triangles != nullptr || &element == vertices;
  char* to = keep ? allocateRows (fields, element.count).get () : nullptr; // the fields keep it
  std::vector<double> list;
  std::size_t row = 0;
  const auto next = [&] (auto number) {
    if (!order)
      return scanner.number<decltype (number)> ();
    if (rest.size () < sizeof number)
      failPromise (what, element.count, row);
    number = readNumber<decltype (number)> (rest.data (), *order);
    rest.remove_prefix (sizeof number);
    return number;
  };
  for (; row < element.count; ++row) {
    if (!order && !scanner.nextFilledLine ())
      failPromise (what, element.count, row);
    if (!order && !keep)
      continue;
    for (const Property& property : element.properties) {
      const std::string& name = property.field.name;
      if (!property.is_list) {
        visitType (property.field.type, [&] (auto value) {
          value = next (value);
          if (to != nullptr)
            to = std::copy_n (reinterpret_cast<const char*> (&value), sizeof value, to);
        });
        continue;
      }
      auto length = visitType (property.length_type,
                               [&] (auto tag) { return static_cast<std::size_t> (next (tag)); });
      list.clear ();
      visitType (property.field.type, [&] (auto tag) {
        for (; length > 0; --length)
          list.push_back (static_cast<double> (next (tag)));
      });
      if (triangles != nullptr && (name == "vertex_indices" || name == "vertex_index"))
        addFan (list, vertices->count, *triangles);
    }
    if (!order && scanner.hasWord ())
      scanner.fail ("it has more values than there are properties");
  }
}

} // namespace

Cloud
parsePly (const FileBytes& file, const ReadOptions& options)
{
  TextScanner scanner (file.view ());
  PlyHeader header = readPlyHeader (scanner);
  Element& vertices = *header.find ("vertex");
  const Element* const faces = header.find ("face");
  Triangles* const triangles = options.faces;
  const bool is_widened =
      options.all_digits && !header.byte_order && widenCoordinates (fieldsOf (vertices));
  const Element* const last =
      triangles != nullptr && faces != nullptr && faces > &vertices ? faces : &vertices;
  for (Element* element = header.elements.data (); element <= last; ++element)
    readElement (file, scanner, header, *element, element == faces ? triangles : nullptr);
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
  return cloud;
}

} // namespace pcl::floater
