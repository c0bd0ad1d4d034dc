// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

#include <numeric>

namespace pcl::floater {
namespace {
constexpr std::size_t STL_HEADER_BYTES = 80;
constexpr std::size_t FACET_BYTES = 50; ///< a normal, three corners, two bytes

/// The distinct corners of facets, in the order in which they come first. Corners that have the
/// same coordinates are one point, also those of a NaN. By sorting, for whose time it does not
/// matter what a file holds.
template <typename Number>
Cloud
cloudOf (std::vector<std::array<Number, 3>> corners)
{
  using Corner = std::array<Number, 3>;
  for (Corner& corner : corners)
    for (Number& coordinate : corner)
      coordinate += Number{0}; // -0 is 0
  std::vector<std::size_t> order (corners.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  const auto bytesOf = [&corners] (std::size_t corner) {
    return std::string_view (reinterpret_cast<const char*> (&corners[corner]), sizeof (Corner));
  };
  std::sort (order.begin (), order.end (), [&bytesOf] (std::size_t a, std::size_t b) {
    return std::pair (bytesOf (a), a) < std::pair (bytesOf (b), b);
  });
  std::vector<bool> repeats (corners.size (), false); // one before
  for (std::size_t i = 1; i < order.size (); ++i)
    repeats[order[i]] = bytesOf (order[i]) == bytesOf (order[i - 1]);
  std::vector<Corner> points;
  for (std::size_t corner = 0; corner < corners.size (); ++corner)
    if (!repeats[corner])
      points.push_back (corners[corner]);
  const std::size_t size = points.size ();
  std::vector<Field> fields;
  addColumns ({"x", "y", "z"}, sizeof (Number) == 4 ? ScalarType::FLOAT32 : ScalarType::FLOAT64,
              std::move (points), fields);
  Cloud cloud = makeCloud (std::move (fields), size);
  cloud.warnings.push_back (facesLeftOut (corners.size () / 3));
  return cloud;
}

Cloud
parseBinary (std::string_view bytes)
{
  const std::size_t facets =
      readNumber<std::uint32_t> (bytes.data () + STL_HEADER_BYTES, ByteOrder::LITTLE);
  bytes.remove_prefix (STL_HEADER_BYTES + sizeof (std::uint32_t));
  requireRoom ("facets", facets, FACET_BYTES, bytes.size ());
  std::vector<std::array<float, 3>> corners;
  for (std::size_t f = 0; f < facets; ++f)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      std::array<float, 3>& point = corners.emplace_back ();
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = readNumber<float> (bytes.data () + f * FACET_BYTES +
                                             (3 * corner + axis) * sizeof (float),
                                         ByteOrder::LITTLE);
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
parseStl (const FileBytes& file, const ReadOptions& /*options*/)
{
  const std::string_view bytes = file.view ();
  const bool is_long = bytes.size () >= STL_HEADER_BYTES + sizeof (std::uint32_t);
  // Some programs begin binary files with "solid", too: then only the length tells.
  const bool fits_binary =
      is_long &&
      (bytes.size () - STL_HEADER_BYTES - sizeof (std::uint32_t)) / FACET_BYTES ==
          readNumber<std::uint32_t> (bytes.data () + STL_HEADER_BYTES, ByteOrder::LITTLE);
  TextScanner scanner (bytes);
  const bool is_solid = scanner.nextFilledLine () && isWord (scanner.word (), "solid");
  if (is_solid && !fits_binary)
    return parseText (bytes);
  if (!is_long)
    throw ReadError (
        "it is too short for a binary STL file, and a text does not begin with 'solid'");
  return parseBinary (bytes);
}

} // namespace pcl::floater
