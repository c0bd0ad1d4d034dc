// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// PTX, the text that terrestrial scanners export. For each scan: the number of columns and of rows,
// the place and the axes of the scanner, a matrix that takes a row (x y z 1) to the common frame, and
// a line for each pixel, column by column: x y z intensity, and red green blue if there are colours.
#include "cloud_reader.h"
#include "text_scanner.h"

#include <Eigen/Geometry>

#include <sstream>

namespace pcl::floater {
namespace {
/// What the file says of all pixels, one after the other.
struct PtxPixels
{
  std::vector<double> coordinates;
  std::vector<float> intensities;
  std::vector<std::uint8_t> colors;
  std::vector<std::uint16_t> scans;
  std::vector<bool> lack_return;
};

template <std::size_t N>
std::array<double, N>
readLine (TextScanner& scanner)
{
  if (!scanner.nextFilledLine ())
    throw ReadError ("it ends within a scan; it is truncated");
  std::array<double, N> numbers{};
  for (double& number : numbers)
    number = scanner.number<double> ();
  return numbers;
}

std::size_t
readCount (TextScanner& scanner, std::size_t most)
{
  const double count = readLine<1> (scanner)[0];
  if (!(count >= 1.0 && count <= static_cast<double> (most)))
    scanner.fail ("this is no number of the rows or columns of a scan in this file");
  return static_cast<std::size_t> (count);
}

void
readPixel (TextScanner& scanner, const Eigen::Matrix<double, 4, 3>& pose, std::size_t scan,
           PtxPixels& pixels)
{
  const std::array<double, 3> at = readLine<3> (scanner);
  const Eigen::RowVector3d local (at[0], at[1], at[2]);
  const Eigen::RowVector3d place = local * pose.topRows<3> () + pose.row (3);
  pixels.coordinates.insert (pixels.coordinates.end (), place.begin (), place.end ());
  pixels.lack_return.push_back (local.isZero (0.0));
  pixels.intensities.push_back (scanner.hasWord () ? scanner.number<float> () : 0.0F);
  pixels.scans.push_back (static_cast<std::uint16_t> (scan));
  while (scanner.hasWord ())
    pixels.colors.push_back (scanner.number<std::uint8_t> ());
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
    if (column == 0 || column + 1 == columns || row == 0 || row + 1 == rows)
      continue;
    const auto& lack = pixels.lack_return;
    if (lack[pixel] || lack[pixel - 1] || lack[pixel + 1] || lack[pixel - rows] ||
        lack[pixel + rows])
      continue;
    const Eigen::Vector3d across =
        (at (pixel + 1) - at (pixel - 1)).cross (at (pixel + rows) - at (pixel - rows));
    const double side = across.dot (sensor.transpose () - at (pixel));
    normal = ((side < 0.0 ? -1.0 : 1.0) * across.normalized ()).cast<float> ();
  }
}

} // namespace

Cloud
parsePtx (const FileBytes& file, const ReadOptions& /*options*/)
{
  TextScanner scanner (file.view ());
  PtxPixels pixels;
  std::vector<Eigen::Vector3f> normals;
  std::size_t scan = 0;
  std::ostringstream scans;
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero ();
  while (!scanner.restIsBlank ()) {
    const std::size_t columns = readCount (scanner, file.view ().size ());
    const std::size_t rows = readCount (scanner, file.view ().size () / columns);
    for (int line = 0; line < 4; ++line) // of the scanner, as the matrix has them
      readLine<3> (scanner);
    Eigen::Matrix<double, 4, 3> pose;
    for (Eigen::Index row = 0; row < 4; ++row) {
      const std::array<double, 4> numbers = readLine<4> (scanner);
      pose.row (row) << numbers[0], numbers[1], numbers[2];
    }
    const std::size_t first = pixels.lack_return.size ();
    for (std::size_t pixel = 0; pixel < rows * columns; ++pixel)
      readPixel (scanner, pose, scan, pixels);
    addNormals (pixels, first, columns, rows, pose.row (3), normals);
    sensor = pose.row (3);
    if (++scan > std::size_t{1} << 16U)
      throw ReadError ("it has more than 65536 scans");
    scans << (scan > 1 ? ", " : "") << columns << " x " << rows << " pixels from (" << pose (3, 0)
          << ", " << pose (3, 1) << ", " << pose (3, 2) << ")";
  }
  const std::size_t size = pixels.lack_return.size ();
  if (size == 0)
    throw ReadError ("it has no points");
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

} // namespace pcl::floater
