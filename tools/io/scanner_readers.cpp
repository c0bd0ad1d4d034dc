// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What scanners write.
// ASPRS LAS 1.0 to 1.4, from its specification (LAS Specification 1.4 - R15, 2019).
// PTX, the text that terrestrial scanners export. For each scan: the number of columns and of rows,
// the place and the axes of the scanner, a matrix that takes a row (x y z 1) to the common frame, and
// a line for each pixel, column by column: x y z intensity, and red green blue if there are colours.
#include "cloud_reader.h"
#include "text_scanner.h"

#include <Eigen/Geometry>

#include <sstream>

namespace pcl::floater {
namespace {
/// Where the header has what is read of it. Its numbers are little endian.
constexpr std::size_t VERSION_AT = 24;
constexpr std::size_t HEADER_SIZE_AT = 94;
constexpr std::size_t POINTS_AT = 96;
constexpr std::size_t FORMAT_AT = 104;
constexpr std::size_t RECORD_SIZE_AT = 105;
constexpr std::size_t LEGACY_COUNT_AT = 107;
constexpr std::size_t SCALES_AT = 131;
constexpr std::size_t OFFSETS_AT = 155;
constexpr std::size_t HEADER_BYTES = 227;
constexpr std::size_t COUNT_AT = 247; ///< in LAS 1.4
constexpr std::size_t HEADER_BYTES_14 = 375;
constexpr std::size_t INTENSITY_AT = 12; ///< in a point
constexpr std::size_t BITS_AT = 14;      ///< two bytes; what they hold depends on the format
constexpr std::size_t FIRST_LONG = 6;    ///< point format from which on the class has a byte

/// Of each format of points: the size of one, and where it has its time and its colour; 0: it has none.
constexpr std::array<std::size_t, 11> POINT_SIZE{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::array<std::size_t, 11> TIME_AT{0, 20, 0, 20, 20, 20, 22, 22, 22, 22, 22};
constexpr std::array<std::size_t, 11> COLOR_AT{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};

struct LasHeader
{
  std::size_t points_at = 0;
  std::size_t record_size = 0;
  unsigned format = 0; ///< of points
  std::uint64_t count = 0;
  std::array<double, 3> scales{}, offsets{};

  bool isLong () const { return format >= FIRST_LONG; }
};

LasHeader
readHeader (std::string_view bytes)
{
  constexpr std::string_view SIGNATURE = "LASF";
  if (bytes.substr (0, SIGNATURE.size ()) != SIGNATURE)
    throw ReadError ("it does not begin with 'LASF', so it is not a LAS file");
  if (bytes.size () < HEADER_BYTES)
    throw ReadError ("its header is truncated");
  const int major = readNumber<std::uint8_t> (bytes.data () + VERSION_AT);
  const int minor = readNumber<std::uint8_t> (bytes.data () + VERSION_AT + 1);
  if (major != 1 || minor > 4)
    throw ReadError ("it is of version " + std::to_string (major) + "." + std::to_string (minor) +
                     " of LAS; 1.0 to 1.4 can be read");
  const std::size_t header_size = readNumber<std::uint16_t> (bytes.data () + HEADER_SIZE_AT);
  const std::size_t least = minor >= 4 ? HEADER_BYTES_14 : HEADER_BYTES;
  if (header_size < least || bytes.size () < least)
    throw ReadError ("its header has " + counted (std::min (header_size, bytes.size ()), "byte") +
                     ", fewer than the " + std::to_string (least) + " that it must have");
  LasHeader header;
  header.points_at = readNumber<std::uint32_t> (bytes.data () + POINTS_AT);
  if (header.points_at < header_size || header.points_at > bytes.size ())
    throw ReadError ("its header tells that the points begin at byte " +
                     std::to_string (header.points_at) +
                     ", where there are none; the file is truncated or its header is wrong");
  header.format = readNumber<std::uint8_t> (bytes.data () + FORMAT_AT);
  constexpr unsigned COMPRESSED = 0xC0; // the bits that compressors set
  if ((header.format & COMPRESSED) != 0)
    throw ReadError (LAZ_ADVICE);
  if (header.format >= POINT_SIZE.size ())
    throw ReadError ("its points are of format " + std::to_string (header.format) +
                     "; 0 to 10 can be read");
  header.record_size = readNumber<std::uint16_t> (bytes.data () + RECORD_SIZE_AT);
  if (header.record_size < POINT_SIZE[header.format])
    throw ReadError ("its header gives each point " + counted (header.record_size, "byte") +
                     ", fewer than the " + std::to_string (POINT_SIZE[header.format]) +
                     " of point format " + std::to_string (header.format));
  header.count = readNumber<std::uint32_t> (bytes.data () + LEGACY_COUNT_AT);
  if (minor >= 4)
    if (const auto count = readNumber<std::uint64_t> (bytes.data () + COUNT_AT); count > 0)
      header.count = count;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scales[axis] = readNumber<double> (bytes.data () + SCALES_AT + axis * sizeof (double));
    header.offsets[axis] = readNumber<double> (bytes.data () + OFFSETS_AT + axis * sizeof (double));
    if (!std::isfinite (header.scales[axis]) || header.scales[axis] == 0.0 ||
        !std::isfinite (header.offsets[axis]))
      throw ReadError (
          "the scale or the offset of its coordinates is no number of use; its header is wrong");
  }
  return header;
}

/// Numbers that share bytes, unpacked: class, return, and what the scanner's software says of it.
void
addBits (const FileBytes& file, const LasHeader& header, std::vector<Field>& fields)
{
  struct Bits
  {
    std::size_t byte, first, count;
  };
  constexpr std::array<std::array<Bits, 5>, 2> BITS{
      {{{{0, 0, 3}, {0, 3, 3}, {1, 0, 5}, {1, 5, 1}, {1, 7, 1}}},
       {{{0, 0, 4}, {0, 4, 4}, {2, 0, 8}, {1, 0, 1}, {1, 2, 1}}}}};
  const auto& all = BITS[header.isLong () ? 1 : 0];
  std::vector<Field> unpacked{
      {"return_number"}, {"number_of_returns"}, {"classification"}, {"synthetic"}, {"withheld"}};
  for (Field& field : unpacked)
    field.type = ScalarType::UINT8;
  char* to = allocateRows (pointersTo (unpacked), header.count).get (); // which the fields keep
  const char* from = file.view ().data () + header.points_at + BITS_AT;
  for (std::size_t p = 0; p < header.count; ++p, from += header.record_size)
    for (const Bits& bits : all)
      *to++ = static_cast<char> (static_cast<unsigned char> (from[bits.byte]) >> bits.first &
                                 ((1U << bits.count) - 1U));
  fields.insert (fields.end (), unpacked.begin (), unpacked.end ());
}

/// What the file says of all pixels, one after the other.
struct PtxPixels
{
  std::vector<double> coordinates;
  std::vector<float> intensities;
  std::vector<std::uint8_t> colors;
  std::vector<std::uint16_t> scans;
  std::vector<bool> lack_return;
};

template <int N>
Eigen::Matrix<double, 1, N>
readLine (TextScanner& scanner)
{
  if (!scanner.nextFilledLine ())
    throw ReadError ("it ends within a scan; it is truncated");
  Eigen::Matrix<double, 1, N> numbers;
  for (double& number : numbers)
    number = scanner.number<double> ();
  return numbers;
}

/// Normals of a scan, towards its sensor, from the pixels before and behind in either direction; zero
/// where one is missing.
void
addNormals (const PtxPixels& pixels, std::size_t first, std::size_t columns, std::size_t rows,
            const Eigen::RowVector3d& sensor, std::vector<Eigen::Vector3f>& normals)
{
  const auto at = [&pixels] (std::size_t pixel) {
    return Eigen::Vector3d (pixels.coordinates.data () + 3 * pixel);
  };
  for (std::size_t i = 0; i < columns * rows; ++i) {
    Eigen::Vector3f& normal = normals.emplace_back (0.0F, 0.0F, 0.0F);
    const std::size_t column = i / rows, row = i % rows, pixel = first + i;
    const auto& lack = pixels.lack_return;
    if (column == 0 || column + 1 == columns || row == 0 || row + 1 == rows || lack[pixel] ||
        lack[pixel - 1] || lack[pixel + 1] || lack[pixel - rows] || lack[pixel + rows])
      continue;
    const Eigen::Vector3d across =
        (at (pixel + 1) - at (pixel - 1)).cross (at (pixel + rows) - at (pixel - rows));
    const double side = across.dot (sensor.transpose () - at (pixel));
    normal = ((side < 0.0 ? -1.0 : 1.0) * across.normalized ()).cast<float> ();
  }
}

} // namespace

Cloud
parseLas (const FileBytes& file, const ReadOptions& /*options*/)
{
  const std::string_view bytes = file.view ();
  const LasHeader header = readHeader (bytes);
  requireRoom ("points", header.count, header.record_size, bytes.size () - header.points_at);
  std::vector<Field> fields;
  const auto add = [&] (const char* name, ScalarType type, std::size_t at) -> Field& {
    return fields.emplace_back (Field{name, type, 1, file.at (header.points_at + at),
                                      header.record_size, ByteOrder::little});
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr std::array<const char*, 3> AXES{"x", "y", "z"};
    Field& field = add (AXES[axis], ScalarType::INT32, axis * sizeof (std::int32_t));
    field.scale = header.scales[axis];
    field.offset = header.offsets[axis];
  }
  add ("intensity", ScalarType::UINT16, INTENSITY_AT);
  addBits (file, header, fields);
  add ("point_source_id", ScalarType::UINT16, header.isLong () ? 20 : 18);
  const std::size_t time_at = TIME_AT[header.format], color_at = COLOR_AT[header.format];
  if (time_at > 0)
    add ("gps_time", ScalarType::FLOAT64, time_at);
  std::vector<std::string> warnings;
  bool are_black = color_at > 0;
  for (std::size_t p = 0; p < header.count && are_black; ++p)
    are_black = bytes.substr (header.points_at + p * header.record_size + color_at, 6)
                    .find_first_not_of ('\0') == std::string_view::npos;
  if (are_black)
    warnings.emplace_back ("all colours of the input file are black: they were left out");
  else if (color_at > 0) { // of 16 bits by the specification, often 8 in fact
    add ("r", ScalarType::UINT16, color_at);
    add ("g", ScalarType::UINT16, color_at + 2);
    add ("b", ScalarType::UINT16, color_at + 4);
  }
  Cloud cloud = makeCloud (std::move (fields), header.count, std::move (warnings));
  // A centimetre of height is 1e-7 degrees.
  constexpr double FINER = 1e3;
  cloud.may_be_degrees = FINER * std::abs (header.scales[0]) <= std::abs (header.scales[2]);
  return cloud;
}

Cloud
parsePtx (const FileBytes& file, const ReadOptions& /*options*/)
{
  TextScanner scanner (file.view ());
  PtxPixels pixels;
  std::vector<Eigen::Vector3f> normals;
  std::size_t scan = 0;
  std::ostringstream scans;
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero ();
  const auto toCount = [&scanner] (double count, std::size_t most) {
    if (!(count >= 1.0 && count <= static_cast<double> (most)))
      scanner.fail ("this is no number of the rows or columns of a scan in this file");
    return static_cast<std::size_t> (count);
  };
  while (scanner.nextFilledLine ()) {
    const std::size_t columns = toCount (scanner.number<double> (), file.view ().size ());
    const std::size_t rows = toCount (readLine<1> (scanner)[0], file.view ().size () / columns);
    for (int line = 0; line < 4; ++line) // of the scanner, as the matrix has them
      readLine<3> (scanner);
    Eigen::Matrix<double, 4, 3> pose;
    for (Eigen::Index row = 0; row < 4; ++row)
      pose.row (row) = readLine<4> (scanner).head<3> ();
    const std::size_t first = pixels.lack_return.size ();
    for (std::size_t pixel = 0; pixel < rows * columns; ++pixel) {
      const Eigen::RowVector3d local = readLine<3> (scanner);
      const Eigen::RowVector3d place = local * pose.topRows<3> () + pose.row (3);
      pixels.coordinates.insert (pixels.coordinates.end (), place.begin (), place.end ());
      pixels.lack_return.push_back (local.isZero (0.0));
      pixels.intensities.push_back (scanner.hasWord () ? scanner.number<float> () : 0.0F);
      pixels.scans.push_back (static_cast<std::uint16_t> (scan));
      while (scanner.hasWord ())
        pixels.colors.push_back (scanner.number<std::uint8_t> ());
    }
    addNormals (pixels, first, columns, rows, pose.row (3), normals);
    sensor = pose.row (3);
    if (++scan > std::size_t{1} << 16U)
      throw ReadError ("it has more than 65536 scans");
    scans << (scan > 1 ? ", " : "") << columns << " x " << rows << " pixels from (" << pose (3, 0)
          << ", " << pose (3, 1) << ", " << pose (3, 2) << ")";
  }
  const std::size_t size = pixels.lack_return.size ();
  std::vector<Field> fields;
  std::vector<std::string> warnings;
  addColumns ({"x", "y", "z"}, ScalarType::FLOAT64, std::move (pixels.coordinates), fields);
  addColumns ({"intensity"}, ScalarType::FLOAT32, std::move (pixels.intensities), fields);
  if (pixels.colors.size () == 3 * size)
    addColumns ({"red", "green", "blue"}, ScalarType::UINT8, std::move (pixels.colors), fields);
  else if (!pixels.colors.empty ())
    warnings.emplace_back ("not all points have a colour; colours were left out");
  if (scan > 1)
    addColumns ({"scan"}, ScalarType::UINT16, std::move (pixels.scans), fields);
  Cloud cloud = makeCloud (std::move (fields), size, std::move (warnings));
  cloud.notes.push_back (counted (scan, "scan") + ": " + scans.str ());
  if (scan == 1)
    Eigen::Map<Eigen::Vector3d> (cloud.sensor_origin.data ()) = sensor;
  else
    cloud.towards_sensors = std::move (normals);
  leaveOut (cloud, pixels.lack_return, "without a return");
  return cloud;
}

Cloud
parseBin (const FileBytes& file, const ReadOptions& /*options*/)
{
  constexpr double FARTHEST = 1e6; // metres
  constexpr double MOST_RINGS = 256.0;
  const std::size_t bytes = file.view ().size ();
  for (const std::size_t count : {std::size_t{5}, std::size_t{4}}) {
    std::vector<Field> fields{{"x"}, {"y"}, {"z"}, {"intensity"}, {"ring"}}; // floats
    fields.resize (count);
    const std::size_t points = bytes / (count * sizeof (float));
    viewRows (pointersTo (fields), file.at (0), ByteOrder::little);
    bool fits = points > 0 && bytes == points * count * sizeof (float);
    for (std::size_t p = 0; p < points && fits; ++p) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        fits &= std::abs (fields[axis].asDouble (p)) < FARTHEST;
      const double ring = fields.back ().asDouble (p);
      fits &= count == 4 || (ring >= 0.0 && ring < MOST_RINGS && ring == std::floor (ring));
    }
    if (fits)
      return makeCloud (std::move (fields), points);
  }
  throw ReadError ("it does not hold four floats for each point, x, y, z and intensity, as KITTI's "
                   "files do, nor five, with a ring");
}

} // namespace pcl::floater
