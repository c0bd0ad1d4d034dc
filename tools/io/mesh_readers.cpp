// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of meshes in OBJ and STL.
#include "cloud_reader.h"
#include "text_scanner.h"

#include <set>

namespace pcl::floater {
namespace {
/// The next word of a line, which a backslash at its end continues; empty behind the last one, and
/// at a comment.
std::string_view
nextWord (TextScanner& scanner)
{
  for (;;) {
    std::string_view word = scanner.word ();
    if (word.empty () || word.front () == '#')
      return {};
    if (word.back () != '\\' || scanner.hasWord ())
      return word;
    word.remove_suffix (1);
    if (!scanner.nextLine () || !word.empty ())
      return word;
  }
}

std::size_t
readNumbers (TextScanner& scanner, std::array<double, 6>& numbers)
{
  std::size_t count = 0;
  for (auto word = nextWord (scanner); !word.empty (); word = nextWord (scanner)) {
    if (count == numbers.size ())
      scanner.fail ("it has more than " + std::to_string (numbers.size ()) + " numbers");
    if (!parseNumber (word, numbers[count++]))
      scanner.fail ("'" + std::string (word) + "' is not a number");
  }
  return count;
}

/// The part of a corner "7/8/9" up to the next slash, as an index from 0; the rest stays in `text`.
/// Negative numbers count back from the last of `size`.
/// \return nothing if that part is empty
std::optional<std::size_t>
takeIndex (const TextScanner& scanner, std::string_view& text, std::size_t size)
{
  const std::string_view part = text.substr (0, text.find ('/'));
  text.remove_prefix (std::min (text.size (), part.size () + 1));
  if (part.empty ())
    return std::nullopt;
  std::int64_t number = 0;
  if (!parseNumber (part, number) || number == 0 || number < -static_cast<std::int64_t> (size))
    scanner.fail ("'" + std::string (part) + "' is not an index");
  return number > 0 ? static_cast<std::size_t> (number - 1)
                    : size - static_cast<std::size_t> (-number);
}

/// The normal of each point: the first that a face gives it, NaN if there is none. With as many
/// normals as points, and no face that tells otherwise, they come in the same order.
/// \param corners (point, its normal), from 0, of faces
/// \return empty if normals and points do not fit together; then there is a warning
std::vector<std::array<double, 3>>
matchNormals (const std::vector<std::array<double, 3>>& normals,
              const std::vector<std::array<std::size_t, 2>>& corners, std::size_t points,
              std::vector<std::string>& warnings)
{
  if (normals.size () == points &&
      std::all_of (corners.begin (), corners.end (),
                   [] (const auto& corner) { return corner[0] == corner[1]; }))
    return normals;
  if (corners.empty ()) {
    if (!normals.empty ())
      warnings.push_back ("normals were left out: there are " +
                          counted (normals.size (), "normal") + " for " +
                          counted (points, "point") + ", and no faces that tell which is whose");
    return {};
  }
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN ();
  std::vector<std::array<double, 3>> matched (points, {NONE, NONE, NONE});
  std::vector<std::uint8_t> has_several (points, 0);
  for (const auto& [point, normal] : corners) {
    if (point >= points || normal >= normals.size ())
      throw ReadError ("a face names point " + std::to_string (point + 1) + " and normal " +
                       std::to_string (normal + 1) + ", one of which the file does not have");
    if (std::isnan (matched[point][0]))
      matched[point] = normals[normal];
    else if (matched[point] != normals[normal])
      has_several[point] = 1;
  }
  if (const auto several = std::count (has_several.begin (), has_several.end (), 1); several > 0)
    warnings.push_back (counted (static_cast<std::size_t> (several), "point") +
                        " had several normals, of which the first was kept");
  return matched;
}

constexpr std::size_t FACET_BYTES = 50; ///< a normal, three corners, two bytes

/// The distinct corners of facets, in the order in which they come first. Corners that have the
/// same coordinates are one point, also those of a NaN. By a set that is a tree, for whose time it
/// does not matter what a file holds.
template <typename Number>
Cloud
cloudOf (std::vector<std::array<Number, 3>> corners)
{
  std::set<std::string_view> known; // bytes of the points
  std::vector<std::array<Number, 3>> points;
  for (std::array<Number, 3>& corner : corners) {
    for (Number& coordinate : corner)
      coordinate += Number{0}; // -0 is 0
    if (known.emplace (reinterpret_cast<const char*> (corner.data ()), sizeof corner).second)
      points.push_back (corner);
  }
  const std::size_t size = points.size ();
  std::vector<Field> fields;
  addColumns ({"x", "y", "z"}, sizeof (Number) == 4 ? ScalarType::FLOAT32 : ScalarType::FLOAT64,
              std::move (points), fields);
  Cloud cloud = makeCloud (std::move (fields), size);
  cloud.warnings.push_back (facesLeftOut (corners.size () / 3));
  return cloud;
}

Cloud
parseBinary (std::size_t facets, std::string_view bytes)
{
  requireRoom ("facets", facets, FACET_BYTES, bytes.size ());
  std::vector<std::array<float, 3>> corners;
  for (std::size_t f = 0; f < facets; ++f)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      std::array<float, 3>& point = corners.emplace_back ();
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = readNumber<float> (bytes.data () + f * FACET_BYTES +
                                         (3 * corner + axis) * sizeof (float));
    }
  Cloud cloud = cloudOf (std::move (corners));
  if (bytes.size () > facets * FACET_BYTES)
    cloud.warnings.push_back ("the input file has more data than the " + counted (facets, "facet") +
                              " of its header; the rest was ignored");
  return cloud;
}

Cloud
parseText (std::string_view text)
{
  std::vector<std::array<double, 3>> corners;
  bool has_ended = false;
  TextScanner scanner (text);
  while (scanner.nextFilledLine ()) {
    const std::string_view key = scanner.word ();
    has_ended =
        isWord (key, "endsolid") || (isWord (key, "end") && isWord (scanner.word (), "solid"));
    if (!isWord (key, "vertex"))
      continue;
    for (double& coordinate : corners.emplace_back ())
      coordinate = scanner.number<double> ();
  }
  if (!has_ended || corners.size () % 3 != 0)
    throw ReadError ("it does not end with 'endsolid' after a whole facet; it is truncated");
  return cloudOf (std::move (corners));
}

} // namespace

Cloud
parseObj (const FileBytes& file, const ReadOptions& /*options*/)
{
  constexpr std::size_t WITH_COLOR = 6;
  std::vector<std::array<double, 3>> coordinates, normals;
  std::vector<std::array<std::size_t, 2>> corners; // with normals: (point, normal)
  std::size_t faces = 0;
  std::vector<float> colors;
  std::array<double, WITH_COLOR> numbers{};
  TextScanner scanner (file.view ());
  while (scanner.nextLine ()) {
    const std::string_view key = nextWord (scanner);
    if (key == "v") {
      const std::size_t count = readNumbers (scanner, numbers);
      if (count != 3 && count != 4 && count != WITH_COLOR)
        scanner.fail ("a point has 3, 4 or 6 numbers, not " + std::to_string (count));
      coordinates.push_back ({numbers[0], numbers[1], numbers[2]});
      if (count == WITH_COLOR)
        for (std::size_t i = 3; i < WITH_COLOR; ++i) {
          if (!(numbers[i] >= 0.0 && numbers[i] <= 255.0))
            scanner.fail ("a colour must be from 0 to 1, or to 255");
          colors.push_back (static_cast<float> (numbers[i]));
        }
    }
    else if (key == "vn") {
      if (readNumbers (scanner, numbers) != 3)
        scanner.fail ("a normal has 3 numbers");
      normals.push_back ({numbers[0], numbers[1], numbers[2]});
    }
    else if (key == "f") {
      ++faces;
      for (auto corner = nextWord (scanner); !corner.empty (); corner = nextWord (scanner)) {
        const auto point = takeIndex (scanner, corner, coordinates.size ());
        takeIndex (scanner, corner, 0); // of a texture
        const auto normal = takeIndex (scanner, corner, normals.size ());
        if (point && normal)
          corners.push_back ({*point, *normal});
      }
    }
    else if (!key.empty ()) // a line that is passed over may go on, too
      while (!nextWord (scanner).empty ()) {}
  }
  if (coordinates.empty ())
    throw ReadError ("it has no points");
  const std::size_t size = coordinates.size ();
  std::vector<Field> fields;
  std::vector<std::string> warnings;
  addColumns ({"x", "y", "z"}, ScalarType::FLOAT64, std::move (coordinates), fields);
  if (colors.size () == 3 * size)
    addColumns ({"red", "green", "blue"}, ScalarType::FLOAT32, std::move (colors), fields);
  else if (!colors.empty ())
    warnings.emplace_back ("not all points have a colour; colours were left out");
  if (auto matched = matchNormals (normals, corners, size, warnings); !matched.empty ())
    addColumns ({"nx", "ny", "nz"}, ScalarType::FLOAT64, std::move (matched), fields);
  if (faces > 0)
    warnings.push_back (facesLeftOut (faces));
  return makeCloud (std::move (fields), size, std::move (warnings));
}

Cloud
parseStl (const FileBytes& file, const ReadOptions& /*options*/)
{
  const std::string_view bytes = file.view ();
  constexpr std::size_t COUNT_AT = 80, FACETS_AT = COUNT_AT + sizeof (std::uint32_t);
  std::optional<std::size_t> facets; // of a binary file
  if (bytes.size () >= FACETS_AT)
    facets = readNumber<std::uint32_t> (bytes.data () + COUNT_AT);
  TextScanner scanner (bytes);
  // Some programs begin binary files with "solid", too: then only the length tells.
  if (scanner.nextFilledLine () && isWord (scanner.word (), "solid") &&
      !(facets && (bytes.size () - FACETS_AT) / FACET_BYTES == *facets))
    return parseText (bytes);
  if (!facets)
    throw ReadError (
        "it is too short for a binary STL file, and a text does not begin with 'solid'");
  return parseBinary (*facets, bytes.substr (FACETS_AT));
}

} // namespace pcl::floater
