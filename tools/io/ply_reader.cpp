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

/// Reads the elements of a file, one after the other.
class PlyElements
{
public:
  /// \param scanner behind the header
  /// \param order none: it is a text
  PlyElements (const FileBytes& file, TextScanner& scanner, std::optional<ByteOrder> order)
      : file_ (file), scanner_ (scanner), order_ (order), rest_ (scanner.rest ())
  {
  }

  /// Binary elements without lists become views of the file.
  /// \param keep whether to store the values of others, without lists, in rows of the fields
  /// \param points which the corners of faces are
  /// \param triangles get the faces; may be nullptr
  void read (Element& element, bool keep, std::size_t points, Triangles* triangles)
  {
    std::size_t fewest = 0; // bytes of each
    for (const Property& property : element.properties)
      fewest +=
          !order_ ? 2 : sizeOf (property.is_list ? property.length_type : property.field.type);
    // The last line of a text may end without a newline.
    requireRoom (element.what (), element.count, fewest,
                 order_ ? rest_.size () : scanner_.rest ().size () + 1);
    const std::vector<Field*> fields = fieldsOf (element);
    if (order_ && fields.size () == element.properties.size ()) {
      viewRows (fields, file_.at (file_.view ().size () - rest_.size ()), *order_);
      rest_.remove_prefix (element.count * rowBytes (fields));
      return;
    }
    char* to = keep ? allocateRows (fields, element.count).get () : nullptr; // the fields keep it
    for (std::size_t row = 0; row < element.count; ++row) {
      if (!order_ && !scanner_.nextFilledLine ())
        failPromise (element.what (), element.count, row);
      if (!order_ && !keep)
        continue;
      for (const Property& property : element.properties)
        if (property.is_list)
          readList (property, element, row, points, triangles);
        else
          visitType (property.field.type, [&] (auto value) {
            value = next<decltype (value)> (element, row);
            if (to != nullptr)
              to = std::copy_n (reinterpret_cast<const char*> (&value), sizeof value, to);
          });
      if (!order_ && scanner_.hasWord ())
        scanner_.fail ("it has more values than there are properties");
    }
  }

private:
  void readList (const Property& list, const Element& element, std::size_t row, std::size_t points,
                 Triangles* triangles)
  {
    auto length = visitType (list.length_type, [&] (auto tag) {
      return static_cast<std::size_t> (next<decltype (tag)> (element, row));
    });
    list_.clear ();
    visitType (list.field.type, [&] (auto tag) {
      for (; length > 0; --length)
        list_.push_back (static_cast<double> (next<decltype (tag)> (element, row)));
    });
    const std::string& name = list.field.name;
    if (triangles != nullptr && (name == "vertex_indices" || name == "vertex_index"))
      addFan (list_, points, *triangles);
  }

  template <typename T>
  T next (const Element& element, std::size_t row)
  {
    if (!order_)
      return scanner_.number<T> ();
    if (rest_.size () < sizeof (T))
      failPromise (element.what (), element.count, row);
    const T number = readNumber<T> (rest_.data (), *order_);
    rest_.remove_prefix (sizeof (T));
    return number;
  }

  const FileBytes& file_;
  TextScanner& scanner_;
  std::optional<ByteOrder> order_;
  std::string_view rest_; // of a binary file
  std::vector<double> list_;
};

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
  PlyElements elements (file, scanner, header.byte_order);
  const Element* const last =
      triangles != nullptr && faces != nullptr && faces > &vertices ? faces : &vertices;
  for (Element* element = header.elements.data (); element <= last; ++element) {
    Triangles* const its = element == faces ? triangles : nullptr;
    elements.read (*element, element == &vertices || its != nullptr, vertices.count, its);
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
  return cloud;
}

} // namespace pcl::floater
