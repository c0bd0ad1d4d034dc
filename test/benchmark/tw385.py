#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the tables and figures of TW 385 again, from the reports of pcl_floater_reconstruct.

Writes floater_result/benchmark/report.md in the working directory, with pictures.
CLOUD: point clouds that are discs (.pcd, .ply or .obj); default: seven of the folder PCL_FLOATER_DATA, and a generated
       finger, whose tip is about as dense in the plane as the densest part of the largest model of TW 385.
"""
import pathlib
import tempfile

import bench
import numpy as np
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, QhullError, cKDTree

CLOUDS = ("beetle_front", "man_bust", "bunny", "nefertiti", "face_strip", "igea", "field_lidar")
ORDERINGS = ("amd", "metis", "reverse-cuthill-mckee")
SOLVERS = ("umfpack", "bicgstab-ilut")
STAGES = ("neighbours", "boundary", "weights", "UMFPACK")  # up to the parameters
NEIGHBORS = 20
LARGEST_BAND = 50000  # unknowns; the factors after reverse Cuthill-McKee soon fill the memory
# As printed in TW 385, on a Pentium 4 with 2.4 GHz. BUNNY is the same scan as bunny with 101 points more.
PRINTED = """VW_9K 9,121 17,842 0.69 1.06 0.19 0.9 44 4.7 1.94
HEAD_DRAGON 30,610 61,148 2.21 4.1 0.97 6.8 96 7.0 7.28
BUNNY 31,577 62,916 2.4 4.18 1.23 8.9 107 7.2 7.81
HALF_DRAGON_decimated 58,260 116,396 4.2 7.72 2.14 18.1 140 8.5 14.06
FACE_STRIP 59,392 116,163 7.16 9.45 1.36 7.63 50 5.6 17.97
ISIS 185,921 371,691 18.35 30.18 12.64 84.7 223 6.7 61.17
HALF_DRAGON 255,510 510,760 19.35 34.6 11.66 224 433 19.2 65.61
HOUSE 480,852 961,194 40.13 70 39 374 380 9.6 149.13"""


def star(points, ring):
    """Delaunay neighbours of the first point of a ring, in the plane nearest to them all."""
    places = points[ring] - points[ring].mean(axis=0)
    try:
        plane = np.linalg.svd(places, full_matrices=False)[2][:2]
        starts, neighbors = Delaunay(places @ plane.T).vertex_neighbor_vertices
    except QhullError:
        return ring[1:]
    return ring[neighbors[starts[0]:starts[1]]]


def matrix_of(points, loop):
    """A with uniform weights, of which the pattern is looked at. It is computed here anew, since the tool does not
    write it. The tool finds the planes of the points in two steps, and so has some other entries."""
    inner = np.setdiff1d(np.arange(len(points)), loop)
    row_of = np.full(len(points), -1)
    row_of[inner] = np.arange(len(inner))
    nearest = cKDTree(points).query(points[inner], NEIGHBORS + 1)[1]
    stars = [star(points, np.append(p, ring[ring != p])) for p, ring in zip(inner, nearest)]
    rows = np.repeat(np.arange(len(inner)), [len(one) for one in stars])
    columns = row_of[np.concatenate(stars)]
    rows, columns = rows[columns >= 0], columns[columns >= 0]  # those of the loop are known
    entries = sparse.csr_matrix((np.full(len(rows), -1.0), (rows, columns)), shape=(len(inner),) * 2)
    return entries + sparse.diags([float(len(one)) + 1e-3 for one in stars])


def draw_sparsity(axes, matrix, title):
    """A pixel is as dark as the logarithm of its number of nonzeros."""
    side, size = 480, matrix.shape[0]
    rows, columns = matrix.nonzero()
    counts = np.histogram2d(rows, columns, side, [[0, size], [0, size]])[0]
    darkness = np.where(counts > 0, 0.4 + np.log1p(counts) / np.log1p(counts.max()), 0)
    axes.imshow(darkness, cmap="Greys", vmin=0, vmax=1.4)
    axes.set(xticks=[], yticks=[], title=title)


def sparsity_figure(report, name, points, loop, nonzeros):
    from matplotlib import pyplot
    from PIL import Image
    matrix = matrix_of(points, loop).tocsc()
    curve = csgraph.reverse_cuthill_mckee(matrix.tocsr())
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})
    along = splu(matrix[curve][:, curve], permc_spec="NATURAL", diag_pivot_thresh=0, options={"SymmetricMode": True})
    degree = np.argsort(factors.perm_c)
    figure, axes = pyplot.subplots(2, 3, figsize=(12, 8.4))
    for place, (shown, title) in enumerate((
            (matrix, "A in the order of the file"), (matrix[curve][:, curve], "A, reverse Cuthill-McKee"),
            (matrix[degree][:, degree], "A, minimum degree"), (None, ""),
            (along.L + along.U, "L + U, reverse Cuthill-McKee"), (factors.L + factors.U, "L + U, minimum degree"))):
        if shown is None:
            axes.flat[place].axis("off")
        else:
            draw_sparsity(axes.flat[place], shown, f"{title}: {shown.nnz:,}")
    figure.tight_layout()
    file = report.folder / f"figure4_sparsity_{name}.png"
    figure.savefig(file, dpi=80)
    pyplot.close(figure)
    Image.open(file).convert("L").quantize(16).save(file, optimize=True)  # dots compress badly
    report.picture(file.name, f"{name}: nonzeros of A and of its factors, {matrix.shape[0]:,} unknowns; the tool's A "
                   f"has {nonzeros:,} nonzeros")


def measure(tools, cloud, folder, repeats):
    """Rows of the tables of one cloud, its reports by solver, and its seconds by stage."""

    def solve(*options):
        return tools.reconstruct(cloud, folder / "mesh.ply", "--method", "tw385", "--threads", 1, *options)

    # In turns, since a machine may be busy for some while.
    turns = [[solve("--solver", solver) for solver in SOLVERS] for _ in range(repeats)]
    runs = {solver: min(some, key=lambda run: run["seconds"]["solve"]) for solver, some in zip(SOLVERS, zip(*turns))}
    direct, iterative = runs["umfpack"], runs["bicgstab-ilut"]["statistics"]
    if direct["status"] != "SUCCESS":
        bench.fail(f"{cloud.stem}: {direct['status']}: {direct['message']}")
    found, seconds, gamma = direct["statistics"], direct["seconds"], direct["statistics"]["fill_in"]
    used = {"neighbours": seconds["working set"] + seconds["neighbors"], "boundary": seconds["boundary"],
            "weights": seconds["stars"] + seconds["weights"], "UMFPACK": seconds["solve"],
            "BiCGSTAB": runs["bicgstab-ilut"]["seconds"]["solve"],
            "Delaunay": seconds["delaunay"]}
    points, total = found["working_points"], sum(used[stage] for stage in STAGES)
    gammas = [solve("--ordering", ordering)["statistics"]["fill_in"] for ordering in ORDERINGS
              if ordering != ORDERINGS[-1] or found["unknowns"] <= LARGEST_BAND]
    gammas += [None] * (len(ORDERINGS) - len(gammas))
    gammas.append(iterative["fill_in"])
    rows = {
        "memory": [f"{points:,}", f"{found['factorization_bytes'] / points:.0f}", f"{gamma:.1f}",
                   f"{218 + 84 * gamma:.0f}"],
        "fill_in": [f"{found['unknowns']:,}", f"{found['nnz_matrix']:,}",
                    *(f"{one:.1f}" if one else "-" for one in gammas)],
        "times": [f"{points:,}", f"{found['triangles']:,}",
                  *(f"{used[stage]:.2f}" for stage in (*STAGES, "BiCGSTAB")),
                  f"{iterative['iterations_u']}, {iterative['iterations_v']}",
                  f"{used['BiCGSTAB'] / used['UMFPACK']:.1f}",
                  *(f"{value:.2f}" for value in (total, used["Delaunay"]))],
        "residuals": [f"{run['statistics']['relative_residual']:.1e}" if run["status"] == "SUCCESS" else run["status"]
                      for run in runs.values()] + [f"{found['residual']:.1e}", f"{found['reciprocal_condition']:.1e}"]}
    return rows, direct, used


def write_tables(report, rows, repeats):
    report.add("## Table 1: bytes per point\n\nPeak of the factorization by UMFPACK, and the formula of TW 385, "
               "(218 + 84 gamma) N, for all of the run without that peak.")
    report.table(["cloud", "points", "factorization, measured", "gamma", "formula"], rows["memory"])
    report.add("## Table 2: fill-in\n\ngamma = nnz (L + U) / nnz (A): of UMFPACK by ordering, and of the "
               f"incomplete factors of ILUT (15, 1e-2). Reverse Cuthill-McKee: up to {LARGEST_BAND:,} unknowns.")
    report.table(["cloud", "unknowns", "nnz (A)", *ORDERINGS, "ILUT"], rows["fill_in"])
    report.add(f"## Table 3: seconds\n\nWall time, runs: {repeats}, of which the shortest is taken. Neighbours serve "
               "boundary and weights alike. Solvers: ordering, factorization or preconditioner, both right-hand sides. "
               "BiCGSTAB: with ILUT (15, 1e-2), until its residual is 1e-15 of |b|; iterations for u and v. Total: "
               "up to the parameters with UMFPACK, as in TW 385.")
    columns = ["cloud", "points", "triangles", *STAGES, "BiCGSTAB", "iterations", "BiCGSTAB / UMFPACK", "total", "Delaunay"]
    report.table(columns, rows["times"])
    report.add("As printed in TW 385, on a Pentium 4 with 2.4 GHz. BUNNY is the same scan as bunny with 101 points "
               "more; the other models are not ours. BiCGSTAB above is that of Eigen.")
    report.table(["model", *columns[1:3], *columns[4:10], "total"],
                 [line.split() for line in PRINTED.splitlines()])
    report.add("Residuals |b - A u| / |b| computed from the solutions, the larger of both sides; of UMFPACK, also the "
               "largest entry, and the reciprocal condition min |U| / max |U| of the diagonal.")
    report.table(["cloud", *SOLVERS, "max |b - A u|", "condition"], rows["residuals"])


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("--repeats", type=int, default=3, metavar="N", help="runs of which the shortest time is taken")
    parser.add_argument("--only", default="tables,sparsity,mesh", metavar="LIST", help="some of %(default)s")
    parser.add_argument("clouds", nargs="*", type=pathlib.Path, metavar="CLOUD")
    arguments = parser.parse_args()
    only = arguments.only.split(",")
    clouds = bench.chosen_clouds(arguments.clouds, CLOUDS)
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate", "pcl_floater_picture")
    report = bench.ReportFolder("benchmark")
    if not arguments.clouds:
        clouds.insert(0, report.folder / "finger.pcd")
        tools.generate("finger", clouds[0], points=6000, length=28)
    report.add("# The tables and figures of TW 385, measured again")
    report.add(
        "TW 385: *Efficient Triangulation of Point Clouds Using Floater Parameterization*, January 2004. Made by "
        "`pcl_floater_reconstruct --method tw385` in one thread: neighbourhoods are Delaunay stars among the 20 "
        "nearest, weights are mean values, the loop is on a circle. " + bench.machine())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if "tables" in only:
            tables, seconds = {}, {}
            for cloud in clouds:
                print(cloud.stem, "tables", flush=True)
                rows, direct, used = measure(tools, cloud, folder, arguments.repeats)
                for table, row in rows.items():
                    tables.setdefault(table, []).append([cloud.stem, *row])
                for stage, value in used.items():
                    seconds.setdefault(stage, []).append((direct["statistics"]["working_points"], value))
            write_tables(report, tables, arguments.repeats)
            report.add("## Figure 5: time against points\n\nLines are power laws. The clouds differ in more than size: "
                       "the time of the boundary goes with its length.")
            report.chart("figure5_times", {stage: tuple(zip(*some)) for stage, some in seconds.items()}, "seconds")
        if "sparsity" in only:
            report.add("## Figure 4: sparsity\n\nA pixel is as dark as the logarithm of its number of nonzeros. Clouds "
                       f"of up to {LARGEST_BAND:,} unknowns.")
            for cloud in clouds:
                run = tools.reconstruct(cloud, folder / "mesh.ply", "--method", "tw385")
                if run["status"] == "SUCCESS" and run["statistics"]["unknowns"] <= LARGEST_BAND:
                    print(cloud.stem, "sparsity", flush=True)
                    sparsity_figure(report, cloud.stem, bench.read_ply(folder / "mesh.ply")[0], run["loop"],
                                    run["statistics"]["nnz_matrix"])
        if "mesh" in only:
            report.add("## Figure 6: meshes")
            for cloud in clouds:
                print(cloud.stem, "mesh", flush=True)
                drawn = f"figure6_mesh_{cloud.stem}.png"
                tools.reconstruct(cloud, folder / "mesh.vtk", "--topology", "disc", "--parameterization",
                                  folder / "flat.vtk")
                tools.picture(folder / "mesh.vtk", folder / "flat.vtk", report.folder / drawn, "--height", 600)
                report.picture(drawn, f"{cloud.stem}: its mesh and parameterization")
    report.finish()


if __name__ == "__main__":
    main()
