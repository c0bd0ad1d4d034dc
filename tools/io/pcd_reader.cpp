// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

#ifdef PCL_FLOATER_HAS_LZF
#include <lzf.h>
#endif

namespace pcl::floater {
namespace {
const std::string PADDING = "_";

struct PcdHeader
{
  std::vector<std::string> names, types;
  std::vector<std::uint32_t> sizes, counts;
  std::optional<std::size_t> width, height, points_told;
  std::array<double, 3> viewpoint{};
  std::string_view data;     ///< ascii, binary or binary_compressed
  std::vector<Field> fields; ///< without bytes
  std::size_t points = 0;
  std::vector<std::string> warnings;
};

void
makeFields (const TextScanner& scanner, PcdHeader& lines)
{
  const std::size_t n = lines.names.size ();
  if (n == 0)
    scanner.fail ("the header has no FIELDS");
  std::string missing;
  if (lines.sizes.empty ()) {
    lines.sizes.assign (n, sizeof (float));
    missing = "SIZE";
  }
  if (lines.types.empty ()) {
    lines.types.assign (n, "F");
    missing += missing.empty () ? "TYPE" : " and TYPE";
  }
  if (!missing.empty ())
    lines.warnings.push_back ("the PCD header has no " + missing +
                              ": its fields were taken for floats of 4 bytes");
  if (lines.sizes.size () != n || lines.types.size () != n ||
      (!lines.counts.empty () && lines.counts.size () != n))
    scanner.fail ("FIELDS, SIZE, TYPE and COUNT of the header differ in length");
  for (std::size_t f = 0; f < n; ++f) {
    const std::size_t count = lines.counts.empty () ? 1 : lines.counts[f];
    if (count == 0) { // some programs write padding so
      lines.warnings.push_back ("the field '" + lines.names[f] +
                                "' of the PCD header has COUNT 0 and was left out");
      continue;
    }
    const std::string name = lines.types[f] + std::to_string (lines.sizes[f]);
    const auto type = typeCalled (name == "B1" ? "U1" : name, &TypeNames::pcd);
    if (!type)
      scanner.fail ("field '" + lines.names[f] + "' has TYPE " + lines.types[f] + " and SIZE " +
                    std::to_string (lines.sizes[f]) + ", which is not a type of PCD");
    lines.fields.push_back ({lines.names[f], *type, count});
  }
}

void
countPoints (const TextScanner& scanner, PcdHeader& lines)
{
  if (!lines.width && !lines.points_told)
    scanner.fail ("the header has neither POINTS nor WIDTH");
  if (lines.points_told && lines.width.value_or (1) * lines.height.value_or (1) == 0 &&
      *lines.points_told > 0) {
    lines.warnings.emplace_back (
        "WIDTH or HEIGHT of the PCD header is 0: its POINTS were taken as a list");
    lines.width = lines.points_told;
    lines.height = 1;
  }
  const std::size_t height = lines.height.value_or (1);
  const std::size_t width = lines.width.value_or (height > 0 ? *lines.points_told / height : 0);
  if (height > 0 && width > std::numeric_limits<std::size_t>::max () / height)
    scanner.fail ("WIDTH times HEIGHT is too large");
  lines.points = lines.points_told.value_or (width * height);
  if (lines.points != width * height)
    scanner.fail ("POINTS is " + std::to_string (lines.points) + ", but WIDTH times HEIGHT is " +
                  std::to_string (width * height));
}

PcdHeader
readPcdHeader (TextScanner& scanner)
{
  PcdHeader lines;
  const auto readWords = [&scanner] (std::vector<std::string>& words) {
    while (scanner.hasWord ())
      words.emplace_back (scanner.word ());
  };
  const auto readNumbers = [&scanner] (std::vector<std::uint32_t>& numbers) {
    while (scanner.hasWord ())
      numbers.push_back (scanner.number<std::uint32_t> ());
  };
  while (scanner.nextFilledLine ()) {
    const std::string_view key = scanner.word ();
    if (key.front () == '#' || key == "VERSION")
      continue;
    if (key == "VIEWPOINT")
      for (double& coordinate : lines.viewpoint)
        coordinate = scanner.number<double> ();
    else if (key == "FIELDS" || key == "COLUMNS")
      readWords (lines.names);
    else if (key == "TYPE")
      readWords (lines.types);
    else if (key == "SIZE")
      readNumbers (lines.sizes);
    else if (key == "COUNT")
      readNumbers (lines.counts);
    else if (key == "WIDTH")
      lines.width = scanner.number<std::size_t> ();
    else if (key == "HEIGHT")
      lines.height = scanner.number<std::size_t> ();
    else if (key == "POINTS")
      lines.points_told = scanner.number<std::size_t> ();
    else if (key == "DATA") {
      makeFields (scanner, lines);
      countPoints (scanner, lines);
      lines.data = scanner.word ();
      return lines;
    }
    else
      scanner.fail ("this is not a line of a PCD header");
  }
  throw ReadError ("the PCD header has no DATA line; the file may be truncated");
}

std::vector<Field*>
fieldsToKeep (PcdHeader& header)
{
  std::vector<Field*> fields = pointersTo (header.fields);
  boost::remove_erase_if (fields, [] (const Field* field) { return field->name == PADDING; });
  return fields;
}

bool
readAscii (TextScanner& scanner, PcdHeader& header)
{
  std::size_t words = 0;
  for (const Field& field : header.fields)
    words += field.count;
  // A first point may follow `DATA ascii` on its line, and the last end without a newline.
  bool has_line = scanner.hasWord ();
  requireRoom ("points", header.points, 2 * words, scanner.restWithLine ().size () + 1);
  char* to = allocateRows (fieldsToKeep (header), header.points).get (); // which the fields keep
  for (std::size_t i = 0; i < header.points; ++i) {
    if (!std::exchange (has_line, false) && !scanner.nextFilledLine ())
      failPromise ("points", header.points, i);
    for (const Field& field : header.fields) {
      if (field.name == PADDING)
        for (std::size_t c = 0; c < field.count; ++c)
          scanner.word ();
      else
        to = putValues (field, to, [&scanner] (auto tag, std::size_t) {
          return scanner.number<decltype (tag)> ();
        });
    }
    if (!scanner.word ().empty ())
      scanner.fail ("it has more values than there are fields (" + std::to_string (words) + ")");
  }
  return scanner.nextFilledLine ();
}

/// Two 32-bit numbers, the compressed and the uncompressed size, then all values field by field,
/// compressed with LZF.
void
readCompressed (std::string_view bytes, PcdHeader& header)
{
  constexpr std::size_t SIZES = 2 * sizeof (std::uint32_t);
  constexpr std::size_t MOST_PER_BYTE = 132; // an LZF reference of 2 bytes stands for at most 264
  if (bytes.size () < SIZES)
    throw ReadError ("the compressed data are truncated");
  const auto compressed = readNumber<std::uint32_t> (bytes.data ());
  const auto expected = readNumber<std::uint32_t> (bytes.data () + sizeof (std::uint32_t));
  bytes.remove_prefix (SIZES);
  if (compressed > bytes.size ())
    throw ReadError ("there should be " + counted (compressed, "byte") +
                     " of compressed data, but the file has only " +
                     std::to_string (bytes.size ()) + "; it is truncated");
  const std::vector<Field*> fields = fieldsToKeep (header);
  const std::size_t point_bytes = rowBytes (fields);
  requireRoom ("points", header.points, point_bytes, expected);
  if (header.points * point_bytes != expected || expected / MOST_PER_BYTE > compressed)
    throw ReadError ("the size of the compressed data does not fit the number of points");
  const std::shared_ptr<char> values (new char[expected], std::default_delete<char[]> ());
#ifdef PCL_FLOATER_HAS_LZF
  if (lzf_decompress (bytes.data (), compressed, values.get (), expected) != expected)
    throw ReadError ("the compressed data are damaged");
#else
  throw ReadError ("its data are compressed, and this program was built without liblzf, which "
                   "decompresses them; save it as ascii or binary");
#endif
  std::size_t offset = 0;
  for (Field* field : fields) {
    viewRows ({field}, {values, values.get () + offset}, ByteOrder::little);
    offset += header.points * field->stride;
  }
}

} // namespace

Cloud
parsePcd (const FileBytes& file, const ReadOptions& options)
{
  TextScanner scanner (file.view ());
  PcdHeader header = readPcdHeader (scanner);
  bool has_more = false;
  if (header.points == 0)
    throw ReadError ("it has no points");
  const bool is_widened =
      options.all_digits && header.data == "ascii" && widenCoordinates (fieldsToKeep (header));
  if (header.data == "ascii")
    has_more = readAscii (scanner, header);
  else if (header.data == "binary") {
    const std::vector<Field*> fields = pointersTo (header.fields);
    const std::string_view rest = scanner.rest ();
    requireRoom ("points", header.points, rowBytes (fields), rest.size ());
    viewRows (fields, file.at (file.view ().size () - rest.size ()), ByteOrder::little);
    // PCL's writer fills the last block of the disk with zeros.
    has_more =
        rest.find_first_not_of ('\0', header.points * rowBytes (fields)) != std::string_view::npos;
  }
  else if (header.data == "binary_compressed")
    readCompressed (scanner.rest (), header);
  else
    scanner.fail ("DATA is '" + std::string (header.data) +
                  "'; it must be ascii, binary or binary_compressed");
  boost::remove_erase_if (header.fields, [] (const Field& field) { return field.name == PADDING; });
  Cloud cloud = makeCloud (std::move (header.fields), header.points, std::move (header.warnings));
  cloud.sensor_origin = header.viewpoint;
  cloud.single_precision |= is_widened;
  const std::size_t height = header.height.value_or (1);
  if (height > 1 && header.points > height) // one row, or rows of one point, are a list
    cloud.notes.push_back ("organized in " + counted (height, "row") + " of " +
                           counted (header.points / height, "point") +
                           ": the mesh has them as one list");
  if (has_more)
    cloud.warnings.push_back ("the input file has more data than the " +
                              counted (header.points, "point") +
                              " of its header; the rest was ignored");
  return cloud;
}

} // namespace pcl::floater
