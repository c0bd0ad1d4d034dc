#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reconstructs clouds with the default options, and puts pictures of all meshes on one sheet.

Writes floater_result/contact_sheet.png in the working directory: each mesh with its figures; for a cloud that fails,
the cause. The meshes, reports and pictures are in floater_result/contact_sheet. A scan is seen from its sensor. Where a
true mesh NAME.gt.ply lies beside a cloud NAME.pcd, it is shown, too. Figures of meshes are counted here, not taken from
the report.
CLOUD: point clouds (.pcd, .ply or .obj); default: all of the folder PCL_FLOATER_DATA
"""
import math
import pathlib
import sys
import textwrap

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "benchmark"))
import bench
import numpy as np

SIDE, CAPTION, COLUMNS_OF_TEXT = 400, 150, 52  # pixels, pixels, characters
INK, WARNING, REFUSAL = "#1e1e1e", "#965500", "#be0a1e"


def counted(number, what):
    return f"{number:,} {what}{'' if number == 1 else 's'}"


def figures(mesh):
    """Lines of a caption, with their colours."""
    lines = [(f"{counted(mesh.components, 'component')}, {counted(len(mesh.loops), 'loop')}, genus {mesh.genus}, "
              f"{counted(mesh.folds, 'fold')}", INK)]
    return lines + ([] if mesh.manifold else [("not an oriented manifold", REFUSAL)])


def wrapped(text, lines, colour):
    return [(line, colour) for line in textwrap.wrap(text, COLUMNS_OF_TEXT)[:lines]]


def cells_of(tools, cloud, folder):
    """Name, picture or None, and lines of the caption: of the mesh, and of the true one."""
    mesh, truth = folder / f"{cloud.stem}.ply", cloud.with_name(f"{cloud.stem}.gt.ply")
    report = tools.reconstruct(cloud, mesh)
    points, view = report["statistics"]["cloud_points"], []
    if report["viewpoint"] and "place" in report["viewpoint"]:
        view = ["--viewpoint=" + ",".join(map(str, report["viewpoint"]["place"]))]
    if report["status"] != "SUCCESS":
        reason = wrapped(f"{report['status']}: {report['message']}", 12, REFUSAL)
        yield cloud.stem, None, [(counted(points, "point"), INK), *reason]
    else:
        unused = f" ({len(report['unused']):,} unused)" if report["unused"] else ""
        lines = [(f"{counted(points, 'point')}{unused}, {counted(report['statistics']['triangles'], 'triangle')}, "
                  f"{report['seconds']['reconstruction']:.2f} s", INK), *figures(bench.Mesh.read(mesh))]
        for warning in report["warnings"]:
            lines += wrapped(warning, 2, WARNING)
        yield cloud.stem, mesh, lines if len(lines) <= 6 else lines[:5] + [("... and more warnings", WARNING)]
        tools.picture(mesh, mesh.with_suffix(".png"), "--height", SIDE, "--flat", *view)
    if truth.exists():
        picture = folder / f"{cloud.stem}.truth.ply"
        yield f"{cloud.stem}: truth", picture, figures(bench.Mesh.read(truth))
        tools.picture(truth, picture.with_suffix(".png"), "--height", SIDE, "--flat", *view)


def draw(sheet, cells):
    """About as wide as high."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    rows = max(1, round(math.sqrt(len(cells) * SIDE / (SIDE + CAPTION))))
    columns = math.ceil(len(cells) / rows)
    size = np.array([columns * SIDE, rows * (SIDE + CAPTION)])
    figure = pyplot.figure(figsize=size / 100, dpi=100)
    for place, (name, mesh, lines) in enumerate(cells):
        left, top = place % columns * SIDE, size[1] - place // columns * (SIDE + CAPTION)
        if mesh:
            axes = figure.add_axes([left / size[0], (top - SIDE) / size[1], SIDE / size[0], SIDE / size[1]])
            axes.imshow(pyplot.imread(mesh.with_suffix(".png")))
            axes.axis("off")
            top -= SIDE
        for row, (text, colour) in enumerate([(name, INK), *lines]):
            figure.text((left + 12) / size[0], (top - 24 - 18 * row) / size[1], text.replace("$", r"\$"), color=colour,
                        fontsize=11 if row == 0 else 8.5, weight="bold" if row == 0 else "normal")
    figure.savefig(sheet)


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("clouds", nargs="*", type=pathlib.Path, metavar="CLOUD")
    arguments = parser.parse_args()
    clouds = bench.chosen_clouds(arguments.clouds)
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_picture")
    folder = pathlib.Path.cwd() / "floater_result/contact_sheet"
    folder.mkdir(parents=True, exist_ok=True)
    cells = []
    for cloud in clouds:
        for cell in cells_of(tools, cloud, folder):
            cells.append(cell)
            print("\n  ".join([cell[0], *(text for text, _ in cell[2])]), flush=True)
    draw(folder.with_suffix(".png"), cells)
    print(folder.with_suffix(".png"))


if __name__ == "__main__":
    main()
