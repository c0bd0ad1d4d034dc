#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the time of pcl_floater.reconstruct () of Python with that of the tool.

Prints medians of some runs of each, in turns: seconds of the tool from points in memory to triangles in memory, seconds
of the call in Python, which has the copy of the points besides, and the ratio. The last line has the median of the
ratios.
CLOUD: files; default: generated surfaces of 10,000 to 300,000 points
"""
import pathlib
import statistics
import sys
import tempfile
import time

import bench


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("--times", type=int, default=5, metavar="N", help="runs of each cloud (%(default)s)")
    parser.add_argument("clouds", nargs="*", type=pathlib.Path, metavar="CLOUD")
    arguments = parser.parse_args()
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate", "pcl_floater_python")
    sys.path.insert(0, str(tools.build / "tools/python"))
    import pcl_floater
    ratios = []
    print(bench.markdown(["cloud", "points", "tool", "Python", "ratio"], []), end="")
    with tempfile.TemporaryDirectory() as name:
        cloud, mesh = pathlib.Path(name) / "cloud.ply", pathlib.Path(name) / "mesh.ply"
        generated = [(kind, n) for kind in ("torus", "height-field") for n in (10000, 100000, 300000)]
        for made in arguments.clouds or generated:
            if arguments.clouds:
                tools.reconstruct(made, mesh)
                bench.write_ply(cloud, bench.read_ply(mesh)[0])
            else:
                tools.generate(made[0], cloud, points=made[1])
            points, by_tool, by_python = bench.read_ply(cloud)[0], [], []
            for _ in range(arguments.times + 1):
                report = tools.reconstruct(cloud, mesh)
                by_tool.append(report["seconds"]["reconstruction"])
                start = time.perf_counter()
                triangles = pcl_floater.reconstruct(points).triangles
                by_python.append(time.perf_counter() - start)
                assert len(triangles) == report["statistics"]["triangles"]
            a, b = (statistics.median(seconds[1:]) for seconds in (by_tool, by_python))  # the first warms up
            ratios.append(b / a)
            what = made.stem if arguments.clouds else made[0]
            print(f"| {what} | {len(points):,} | {a:.3f} s | {b:.3f} s | {b / a:.2f} |", flush=True)
    print(f"median of the ratios: {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
