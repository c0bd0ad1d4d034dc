#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the texture coordinates that pcl_floater_reconstruct makes.

Prints a table, one line for each cloud: what its mesh is, and the charts, the stretch, the share of the square that is
used, flipped triangles and seconds of its texture coordinates. Ends with 1 if a triangle is flipped.
CLOUD: default: all of the folder PCL_FLOATER_DATA
"""
import pathlib
import tempfile

import bench


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("clouds", nargs="*", type=pathlib.Path, metavar="CLOUD")
    arguments = parser.parse_args()
    clouds = bench.chosen_clouds(arguments.clouds)
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct")
    columns = ["cloud", "triangles", "components", "loops", "charts", "stretch", "area used", "flipped", "s"]
    print(bench.markdown(columns, []), end="")
    flipped_in = []
    with tempfile.TemporaryDirectory() as folder:
        for cloud in clouds:
            report = tools.reconstruct(cloud, pathlib.Path(folder) / "mesh.ply", "--uv")
            if report["status"] != "SUCCESS":
                bench.fail(f"{cloud.stem}: {report['message']}")
            texture, check = report["texture"], report["check"]
            print("| " + " | ".join(map(str, (
                cloud.stem, report["statistics"]["triangles"], check["components"], len(check["loops"]),
                texture["charts"], f"{texture['stretch']:.3f}", f"{100 * texture['area_used']:.0f} %",
                texture["flipped"], f"{report['seconds']['texture']:.2f}"))) + " |", flush=True)
            if texture["flipped"]:
                flipped_in.append(cloud.stem)
    if flipped_in:
        bench.fail(f"flipped triangles: {', '.join(flipped_in)}")


if __name__ == "__main__":
    main()
