#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the time of pcl_floater.reconstruct () of Python with that of the tool.

Usage: python_call.py [--build FOLDER] [--times N] [CLOUD...]
Prints medians of N runs of each (default: 5), in turns: seconds of the tool from points in memory to
triangles in memory, seconds of the call in Python, which has the copy of the points besides, and the
ratio. The last line has the median of the ratios.
CLOUD: files; default: generated surfaces of 10,000 to 300,000 points
FOLDER: of a build with the tool and the module (default: build/bench of the project)
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def read_vertices(path):
    """Those of a binary PLY file that the tool wrote."""
    import numpy as np
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    count = int(re.search(r"element vertex (\d+)", header)[1])
    types = {"float": "<f4", "double": "<f8", "uchar": "u1", "char": "i1", "ushort": "<u2", "short": "<i2",
             "uint": "<u4", "int": "<i4"}
    vertex_part = header[header.index("element vertex"):header.index("element face")]
    fields = [(name, types[kind]) for kind, name in re.findall(r"property (\w+) (\w+)\n", vertex_part)]
    vertices = np.frombuffer(data, np.dtype(fields), count, end)
    return np.stack([vertices[name] for name in "xyz"], axis=-1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, usage=argparse.SUPPRESS,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "bench")
    parser.add_argument("--times", type=int, default=5)
    parser.add_argument("clouds", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    tool = arguments.build / "tools/reconstruct/pcl_floater_reconstruct"
    sys.path[:0] = [str(arguments.build / "tools/python"), str(ROOT / "test/python")]
    import numpy as np
    import pcl_floater
    from conftest import terrain, torus, write_pcd

    def generated():
        for name, make, sizes in (("torus", torus, ((160, 64), (480, 200), (860, 350))),
                                  ("terrain", terrain, ((100,), (310,), (550,)))):
            for size in sizes:
                yield name, make(*size).astype(np.float32)

    def given(folder):
        for cloud in arguments.clouds:
            subprocess.run([tool, "-q", cloud, folder / "points.ply"], check=True)
            yield cloud.stem, read_vertices(folder / "points.ply")

    ratios = []
    print("| cloud | points | tool | Python | ratio |\n|---|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for name, points in given(folder) if arguments.clouds else generated():
            write_pcd(folder / "cloud.pcd", points)
            by_tool, by_python = [], []
            for _ in range(arguments.times + 1):
                done = subprocess.run([tool, "--json", "-q", folder / "cloud.pcd", folder / "mesh.vtk"], check=True,
                                      stdout=subprocess.PIPE, text=True)
                by_tool.append(json.loads(done.stdout.splitlines()[-1])["recon_seconds"])
                start = time.perf_counter()
                mesh = pcl_floater.reconstruct(points)
                by_python.append(time.perf_counter() - start)
                assert len(mesh.triangles) == json.loads(done.stdout.splitlines()[-1])["triangles"]
            a, b = (statistics.median(seconds[1:]) for seconds in (by_tool, by_python))  # the first warms up
            ratios.append(b / a)
            print(f"| {name} | {len(points):,} | {a:.3f} s | {b:.3f} s | {b / a:.2f} |", flush=True)
    print(f"median of the ratios: {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
