// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates of a triangle mesh. Uses no types of PCL.
#pragma once

#include <pcl/surface/floater/report.h>
#include <pcl_floater/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl::floater {
/// Options of computeTextureCoordinates (). The defaults need no tuning.
struct TextureOptions
{
  /// Mean stretch above which a chart is cut further, where that helps; 1 or more. Larger values
  /// give fewer and larger charts. The default is the stretch of half a sphere.
  double largest_stretch = 1.06;

  /// Each component that is a disc becomes one chart, whatever its stretch: the parameterization of
  /// the disc. Other components are cut as usual.
  bool whole_discs = false;

  int threads = 0; ///< 0 or more; 0: one for each core. Does not change the result

  /// Called with the fraction done, as in Options.
  std::function<void (double)> progress_callback;

  /// Polled for cancellation, as in Options.
  std::function<bool ()> cancelled_callback;
};

/// Texture coordinates and their quality, or why there are none. A chart is a piece of the mesh
/// laid out without cuts; an edge between two is a seam, whose points have several coordinates.
struct TextureCoordinates
{
  RunStatus status = RunStatus::NOT_RUN; ///< SUCCESS, INVALID_OPTION, INVALID_INDICES (also for
                                         ///< positions that are not finite, and triangles that are
                                         ///< no oriented manifold), CANCELLED, OUT_OF_MEMORY or
                                         ///< INTERNAL_ERROR
  std::string message; ///< one sentence: the cause and what to do; empty after SUCCESS
  std::vector<Eigen::Vector2f> coordinates; ///< u and v, 0 to 1; v goes up, as in OBJ files
  std::vector<std::uint32_t> points;        ///< parallel to coordinates: their points
  std::vector<std::array<std::uint32_t, 3>> corners; ///< parallel to the triangles: coordinates of
                                                     ///< their corners; all anti-clockwise
  std::vector<std::uint32_t> charts;                 ///< parallel to the triangles: from 0 on
  std::vector<std::array<std::uint32_t, 2>> seams;   ///< edges between charts: two points each

  std::size_t chart_count = 0;  ///< number of charts
  std::size_t flipped = 0;      ///< triangles that are not anti-clockwise in the texture, by the
                                ///< exact sign of their area. Always 0 unless triangles are too
                                ///< small, relative to the mesh, for single precision
  double stretch = 1.0;         ///< of the whole texture, relative to lengths in it: root mean
                                ///< square (L2 stretch of Sander et al. 2001); 1: none
  double largest_stretch = 1.0; ///< of the worst triangle (L-infinity stretch)
  double area_used = 0.0;       ///< share of the square that triangles cover
  double seam_length = 0.0;     ///< in units of the positions
  double gutter = 0.0;          ///< least distance of two charts, in sides of the square
};

/// Lays a triangle mesh out in the unit square, without overlaps.
///
/// The surface is cut into charts, each a disc: compact, and ended by creases where there are some.
/// A chart is laid out by its projection or by a convex-combination map (Tutte 1963, Floater 1997)
/// whose stretch is evened out, and which is then relaxed to lower distortion in such a way that no
/// triangle is flipped. Charts are scaled by their areas and stretch, and packed.
///
/// Does not throw: a failure is a status and a message. The result does not depend on the number of
/// threads. Takes about 5 microseconds per triangle with two cores, and 1 kB per triangle of the
/// largest charts.
/// \param positions of all points; points in no triangle get no coordinates
/// \param triangles an oriented manifold, such as the result of a reconstruction; corners
///     anti-clockwise seen from the front
PCL_FLOATER_EXPORT TextureCoordinates
computeTextureCoordinates (const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles,
                           const TextureOptions& options = {});

} // namespace pcl::floater
