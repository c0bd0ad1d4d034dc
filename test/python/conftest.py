# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds of known surfaces, and the command line tool, whose results are the same."""
import json
import os
import pathlib
import subprocess

import numpy as np
import pytest


def torus(around=60, across=24):
    """A closed surface with one handle: points on a torus with the radii 5 and 2, irregular."""
    random = np.random.default_rng(385)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = (2 * np.pi * (k + random.uniform(-0.25, 0.25, k.shape)) / n for k, n in ((i, around), (j, across)))
    to_axis = 5 + 2 * np.cos(v)
    return np.stack([to_axis * np.cos(u), to_axis * np.sin(u), 2 * np.sin(v)], -1).reshape(-1, 3)


def terrain(side=30):
    """A disc: hilly terrain."""
    random = np.random.default_rng(385)
    x, y = (k + random.uniform(-0.25, 0.25, k.shape) for k in np.meshgrid(*[np.arange(float(side))] * 2))
    return np.stack([x, y, 2 * np.sin(0.3 * x) * np.cos(0.2 * y)], -1).reshape(-1, 3)


def write_pcd(path, points):
    """A binary PCD file with the numbers of the array as they are."""
    header = (f"VERSION 0.7\nFIELDS x y z\nSIZE {' '.join([str(points.itemsize)] * 3)}\nTYPE F F F\n"
              f"COUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {len(points)}\nDATA binary\n")
    path.write_bytes(header.encode() + np.ascontiguousarray(points).tobytes())


class Tool:
    def __init__(self, folder):
        self.folder = folder

    def __call__(self, points, *arguments):
        """\\return the triangles, and the report"""
        cloud, mesh, report = (self.folder / name for name in ("cloud.pcd", "mesh.obj", "report.json"))
        write_pcd(cloud, points)
        subprocess.run([os.environ["PCL_FLOATER_TOOL"], "-q", "--report", report, *arguments, cloud, mesh],
                       check=True)
        faces = [line.split()[1:] for line in mesh.read_text().splitlines() if line.startswith("f ")]
        return np.array(faces, dtype=int) - 1, json.loads(report.read_text())


@pytest.fixture
def tool(tmp_path):
    return Tool(tmp_path)


@pytest.fixture(scope="session")
def torus_points():
    points = torus()
    points.setflags(write=False)  # no call changes what it is given
    return points


@pytest.fixture(scope="session")
def terrain_points():
    points = terrain()
    points.setflags(write=False)
    return points


ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
