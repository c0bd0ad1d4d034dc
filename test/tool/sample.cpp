// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>

namespace pcl::floater {
namespace {
constexpr int PRECISION = std::numeric_limits<double>::max_digits10;

/// Appends numbers as text or as bytes of either order.
class PlyBody
{
public:
  explicit PlyBody (PlyKind kind) : kind_ (kind) { text_ << std::setprecision (PRECISION); }

  template <typename T>
  void add (T number)
  {
    if (kind_ == PlyKind::ASCII) {
      text_ << +number << ' ';
      return;
    }
    std::array<char, sizeof (T)> bytes{};
    std::memcpy (bytes.data (), &number, sizeof (T));
    constexpr bool IS_LITTLE_HOST = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    if ((kind_ == PlyKind::LITTLE) != IS_LITTLE_HOST)
      std::reverse (bytes.begin (), bytes.end ());
    text_.write (bytes.data (), bytes.size ());
  }

  void endRow ()
  {
    if (kind_ == PlyKind::ASCII)
      text_ << '\n';
  }

  std::string str () const { return text_.str (); }

private:
  PlyKind kind_;
  std::ostringstream text_;
};

} // namespace

Sample
makeSample (bool is_double, int side)
{
  constexpr unsigned SEED = 7;
  std::mt19937 random (SEED);
  // The distributions of the standard library differ between implementations.
  const auto uniform = [&random] { return static_cast<double> (random ()) / 4294967296.0 - 0.5; };
  // Multiples of 1 / GRAIN are exact floats. A cast to float and back is no way to get them: GCC 12
  // drops it at -O2.
  constexpr double GRAIN = 262144.0;
  Sample sample;
  sample.is_double = is_double;
  const Eigen::Vector3d origin =
      is_double ? Eigen::Vector3d (654321.0, 5123456.0, 120.0) : Eigen::Vector3d::Zero ();
  const double spacing = is_double ? 0.01 : 1.0;
  for (int i = 0; i < side * side; ++i) {
    const int column = i % side;
    const int row = i / side;
    const double x = column + 0.4 * uniform ();
    const double y = row + 0.4 * uniform ();
    Eigen::Vector3d p =
        origin + spacing * Eigen::Vector3d (x, y, std::sin (0.4 * x) * std::cos (0.3 * y));
    if (!is_double)
      p = (GRAIN * p).array ().round () / GRAIN;
    sample.points.push_back (p);
  }
  for (std::size_t i = sample.points.size () - 1; i > 0; --i)
    std::swap (sample.points[i], sample.points[random () % (i + 1)]);
  for (std::size_t i = 0; i < sample.points.size (); ++i) {
    const auto byte = [i] (std::size_t factor) {
      return static_cast<std::uint8_t> (factor * i % 256);
    };
    sample.colors.push_back ({byte (1), byte (7), byte (31)});
    const Eigen::Vector3d normal (0.1 * uniform (), 0.1 * uniform (), 1.0);
    sample.normals.emplace_back (normal.normalized ().cast<float> ());
    sample.intensities.push_back (static_cast<float> (uniform ()));
  }
  return sample;
}

std::string
plyText (const Sample& sample, PlyKind kind)
{
  const std::string type = sample.is_double ? "double" : "float";
  const std::array<const char*, 3> formats{"ascii", "binary_little_endian", "binary_big_endian"};
  std::ostringstream header;
  header << "ply\nformat " << formats[static_cast<std::size_t> (kind)] << " 1.0\ncomment a sample\n"
         << "element camera 2\nproperty list uchar short frames\nproperty float focus\n"
         << "element vertex " << sample.size () << "\n"
         << "property " << type << " x\nproperty " << type << " y\nproperty " << type << " z\n"
         << "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar "
            "int marks\n"
         << "property float nx\nproperty float ny\nproperty float nz\nproperty float intensity\n"
         << "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  PlyBody body (kind);
  for (std::uint8_t frames : {std::uint8_t{0}, std::uint8_t{3}}) {
    body.add (frames);
    for (std::int16_t frame = 0; frame < frames; ++frame)
      body.add (frame);
    body.add (0.5F);
    body.endRow ();
  }
  for (std::size_t i = 0; i < sample.size (); ++i) {
    for (const double coordinate : sample.points[i])
      sample.is_double ? body.add (coordinate) : body.add (static_cast<float> (coordinate));
    for (const std::uint8_t channel : sample.colors[i])
      body.add (channel);
    const auto marks = static_cast<std::uint8_t> (i % 3);
    body.add (marks);
    for (std::int32_t mark = 0; mark < marks; ++mark)
      body.add (mark);
    for (const float coordinate : sample.normals[i])
      body.add (coordinate);
    body.add (sample.intensities[i]);
    body.endRow ();
  }
  body.add (std::uint8_t{3});
  for (const std::int32_t corner : {0, 1, 2})
    body.add (corner);
  body.endRow ();
  return header.str () + body.str ();
}

std::string
objText (const Sample& sample)
{
  std::ostringstream text;
  text << std::setprecision (PRECISION) << "# a sample\nmtllib none.mtl\no cloud\n";
  for (std::size_t i = 0; i < sample.size (); ++i) {
    text << "v " << sample.points[i].transpose ();
    for (const std::uint8_t channel : sample.colors[i])
      text << ' ' << channel / 255.0;
    text << '\n';
  }
  for (const Eigen::Vector3f& normal : sample.normals)
    text << "vn " << normal.transpose () << '\n';
  text << "f 1//1 2//2 3//3\n";
  return text.str ();
}

std::string
pcdText (const std::vector<Eigen::Vector3d>& points)
{
  std::ostringstream text;
  text << std::setprecision (PRECISION)
       << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE "
          "F F F\n"
       << "COUNT 1 1 1\nWIDTH " << points.size () << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << points.size () << "\nDATA ascii\n";
  for (const Eigen::Vector3d& p : points)
    text << p.x () << ' ' << p.y () << ' ' << p.z () << '\n';
  return text.str ();
}

} // namespace pcl::floater
