// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "byte_order.h"
#include "cloud_reader.h"
#include "format.h"
#include "text_scanner.h"

#include <random>
#include <unordered_set>

namespace pcl::floater {
namespace {
constexpr std::size_t STL_HEADER_BYTES = 80;
constexpr std::size_t FACET_BYTES = 50; ///< a normal, three corners, two bytes

/// Distinct points in the order in which they come first. Corners that have the same coordinates
/// are one point, also those of a NaN.
template <typename Number>
class DistinctPoints
{
public:
  using Point = std::array<Number, 3>;

  void add (Point point)
  {
    Bits bits{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] += Number{0}; // -0 is 0
      std::memcpy (&bits[axis], &point[axis], sizeof (Number));
    }
    if (known_.insert (bits).second)
      points_.push_back (point);
  }

  std::vector<Point> take () { return std::move (points_); }

private:
  using Bits = std::array<std::uint64_t, 3>;

  // Of a number that is another one in each run: no file can have corners that share their hashes.
  struct Hash
  {
    std::size_t operator() (const Bits& bits) const
    {
      std::uint64_t hash = seed;
      for (const std::uint64_t coordinate : bits) {
        hash = (hash ^ coordinate) * 0x9E3779B97F4A7C15U; // 2^64 over the golden ratio
        hash ^= hash >> 32U;
      }
      return static_cast<std::size_t> (hash);
    }

    std::uint64_t seed = std::uint64_t{std::random_device () ()} << 32U | std::random_device () ();
  };

  std::unordered_set<Bits, Hash> known_;
  std::vector<Point> points_;
};

template <typename Number>
Cloud
cloudOf (DistinctPoints<Number>& distinct, std::size_t facets)
{
  const auto points = std::make_shared<const std::vector<std::array<Number, 3>>> (distinct.take ());
  if (points->empty ())
    throw ReadError ("it has no points");
  std::vector<Field> fields;
  addColumns ({"x", "y", "z"}, points, points->front ().data (), fields);
  Cloud cloud = makeCloud (std::move (fields), points->size ());
  cloud.warnings.push_back (facesLeftOut (facets));
  return cloud;
}

Cloud
parseBinary (std::string_view bytes)
{
  const std::size_t facets =
      readNumber<std::uint32_t> (bytes.data () + STL_HEADER_BYTES, ByteOrder::LITTLE);
  bytes.remove_prefix (STL_HEADER_BYTES + sizeof (std::uint32_t));
  if (facets > bytes.size () / FACET_BYTES)
    throw ReadError ("the header promises " + counted (facets, "facet") +
                     ", but the file has only " + std::to_string (bytes.size () / FACET_BYTES) +
                     "; it is truncated or its header is wrong");
  DistinctPoints<float> points;
  for (std::size_t f = 0; f < facets; ++f)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      std::array<float, 3> point{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = readNumber<float> (bytes.data () + f * FACET_BYTES +
                                             (3 * corner + axis) * sizeof (float),
                                         ByteOrder::LITTLE);
      points.add (point);
    }
  Cloud cloud = cloudOf (points, facets);
  if (bytes.size () > facets * FACET_BYTES)
    cloud.warnings.push_back ("the input file has more data than the " + counted (facets, "facet") +
                              " of its header; the rest was ignored");
  return cloud;
}

Cloud
parseText (std::string_view text)
{
  DistinctPoints<double> points;
  std::size_t corners = 0;
  bool has_ended = false;
  TextScanner scanner (text);
  while (scanner.nextFilledLine ()) {
    const std::string_view key = scanner.word ();
    has_ended =
        isWord (key, "endsolid") || (isWord (key, "end") && isWord (scanner.word (), "solid"));
    if (!isWord (key, "vertex"))
      continue;
    std::array<double, 3> point{};
    for (double& coordinate : point)
      coordinate = scanner.number<double> ();
    points.add (point);
    ++corners;
  }
  if (!has_ended || corners % 3 != 0)
    throw ReadError ("it does not end with 'endsolid' after a whole facet; it is truncated");
  return cloudOf (points, corners / 3);
}

} // namespace

Cloud
parseStl (const FileBytes& file)
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
    throw ReadError ("it is too short for a binary STL file, and a text does not begin with "
                     "'solid'");
  return parseBinary (bytes);
}

} // namespace pcl::floater
