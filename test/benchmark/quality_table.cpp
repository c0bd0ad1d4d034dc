// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbourhoods and weights against the quality of the mesh.
#include "mesh_measures.h"
#include "section.h"

#include <pcl/surface/floater/reconstruct.h>

#include <numeric>

namespace pcl
{
namespace floater
{
namespace
{
template <typename Choice>
struct Named
{
  std::string name;
  Choice choice;
};

const std::vector<Named<Neighborhood>>&
neighborhoods ()
{
  static const std::vector<Named<Neighborhood>> all{
      {"nearest, Delaunay", Neighborhood::NEAREST_DELAUNAY},
      {"nearest", Neighborhood::NEAREST},
      {"ball, Delaunay", Neighborhood::BALL_DELAUNAY},
      {"ball", Neighborhood::BALL}};
  return all;
}

const std::vector<Named<Weighting>>&
weightings ()
{
  static const std::vector<Named<Weighting>> all{{"uniform", Weighting::UNIFORM},
                                                 {"inverse distance", Weighting::INVERSE_DISTANCE},
                                                 {"shape preserving", Weighting::SHAPE_PRESERVING},
                                                 {"mean value", Weighting::MEAN_VALUE}};
  return all;
}

Result
run (const Cloud& cloud, const Options& options)
{
  Input input;
  input.positions = cloud.positions ();
  input.cloud_index.resize (cloud.size ());
  std::iota (input.cloud_index.begin (), input.cloud_index.end (), Index{0});
  input.cloud_size = cloud.size ();
  return reconstruct (std::move (input), options);
}

class QualityTable : public Section
{
public:
  explicit QualityTable (const Settings& settings) : settings_ (settings)
  {
    table_.columns = {"cloud",          "neighbours", "weights",        "recall, %",
                      "after flips, %", "turned, %",  "after flips, %", "smallest distance"};
  }

  void measure (const Sample& sample) override
  {
    const std::vector<Triangle> truth = readGroundTruth (sample.path, sample.cloud.size ());
    const Edges true_edges = edgesOf (truth);
    const auto recall = [&] (const Result& result) {
      return percent (commonEdges (true_edges, edgesOf (result.triangles)), true_edges.size (), 2);
    };
    const auto turned = [&] (const Result& result) {
      return truth.empty ()
                 ? std::string ("-")
                 : percent (turnedTriangles (result.triangles, truth, sample.cloud.positions ()),
                            result.triangles.size (), 3);
    };
    bool first = true;
    for (const Named<Neighborhood>& neighborhood : neighborhoods ())
      for (const Named<Weighting>& weighting : weightings ()) {
        Options options;
        options.topology = Topology::DISC;
        options.neighbors.kind = neighborhood.choice;
        options.disc.weighting = weighting.choice;
        options.threads = settings_.threads;
        options.flip_edges = false;
        const Result plain = run (sample.cloud, options);
        options.flip_edges = true;
        const Result flipped = run (sample.cloud, options);
        std::vector<std::string> row{first ? sample.disc.name : "", neighborhood.name,
                                     weighting.name};
        if (plain.report.status == RunStatus::SUCCESS &&
            flipped.report.status == RunStatus::SUCCESS)
          row.insert (row.end (),
                      {recall (plain), recall (flipped), turned (plain), turned (flipped),
                       scientific (smallestDistance (plain.report.parameters))});
        else
          row.insert (row.end (), {statusName (plain.report.status),
                                   statusName (flipped.report.status), "-", "-", "-"});
        table_.rows.push_back (row);
        first = false;
      }
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Neighbourhoods and weights");
    report.paragraph ("Recall: edges of the ground truth (NAME.gt.ply beside the cloud) that "
                      "the mesh has. Turned: triangles that face away from the ground truth. "
                      "Each as the triangulation of the plane gives it, and after the flips on "
                      "the surface. Smallest distance: of two parameters, in a circle of "
                      "radius 1. A row with a word instead of figures failed with that status.");
    report.table ("neighbourhoods_and_weights", table_);
  }

private:
  Settings settings_;
  Table table_;
};

} // namespace

std::unique_ptr<Section>
makeQualityTable (const Settings& settings)
{
  return std::make_unique<QualityTable> (settings);
}

} // namespace floater
} // namespace pcl
