// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Why TW 385 asks BiCGSTAB for a residual of 1e-15: what the mesh is at larger ones.
#include "floater/planar_delaunay.h"
#include "gmm_bicgstab.h"
#include "mesh/finish.h"
#include "mesh_measures.h"
#include "section.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t MOST_ITERATIONS = 5000;

// Edges of the mesh as it comes from the plane, and as it is after the flips on the surface.
struct MeshEdges
{
  Edges in_plane, on_surface;
};

MeshEdges
meshOf (const DiscStages& disc, const std::vector<Eigen::Vector2d>& uv)
{
  MeshEdges edges;
  TriangleMesh mesh = triangulatePlane (uv, disc.boundary.loop);
  edges.in_plane = edgesOf (mesh.triangles);
  LocalGeometry geometry = disc.geometry;
  finishMesh (mesh, disc.points.positions, geometry, {}, 1);
  edges.on_surface = edgesOf (mesh.triangles);
  return edges;
}

class ResidualTable : public Section
{
public:
  ResidualTable ()
  {
    table_.columns = {"cloud",   "asked",         "reached",      "iterations (u, v)",
                      "seconds", "largest error", "edges off, %", "after flips, %"};
  }

  void measure (const Sample& sample) override
  {
    const DiscStages& disc = sample.disc;
    const MeshEdges direct = meshOf (disc, sample.direct);
    const GmmBicgstab bicgstab (disc.system, ILUT_FILL, ILUT_THRESHOLD);
    bool first = true;
    for (const double asked : {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15}) {
      const IterativeSolution solution = bicgstab.solve (asked, MOST_ITERATIONS);
      const std::vector<Eigen::Vector2d> uv = parametersOf (disc, solution.uv);
      double error = 0.0;
      for (std::size_t p = 0; p < uv.size (); ++p)
        if (uv[p].allFinite ())
          error = std::max (error, (uv[p] - sample.direct[p]).norm ());
      const MeshEdges mesh = meshOf (disc, uv);
      const auto off = [] (const Edges& reference, const Edges& edges) {
        return percent (reference.size () - commonEdges (reference, edges), reference.size (), 2);
      };
      table_.rows.push_back (
          {first ? disc.name : "", scientific (asked), scientific (solution.residual),
           std::to_string (solution.iterations[0]) + ", " +
               std::to_string (solution.iterations[1]) + (solution.converged ? "" : " (not there)"),
           fixed (solution.totalSeconds (), 2), scientific (error),
           off (direct.in_plane, mesh.in_plane), off (direct.on_surface, mesh.on_surface)});
      first = false;
    }
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Residual and mesh");
    report.paragraph (
        "BiCGSTAB + ILUT(15, 1e-2) by GMM++, stopped at the residual asked for. Largest error: "
        "distance of a parameter from that of the direct solution, in a circle of radius 1. "
        "Edges off: edges of the direct solution's mesh that this one has not, before and "
        "after the flips on the surface. Where points are close together in the plane, a small "
        "error changes which of them are neighbours.");
    report.table ("residual_and_mesh", table_);
  }

private:
  Table table_;
};

} // namespace

std::unique_ptr<Section>
makeResidualTable ()
{
  return std::make_unique<ResidualTable> ();
}

} // namespace floater
} // namespace pcl
