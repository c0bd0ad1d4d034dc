# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds of known surfaces, and the command line tool, whose results are the same."""
import os
import pathlib
import subprocess

import numpy as np
import pytest
from files import json_of, pcd_bytes, read_mesh, sample_of  # of test/tool


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


@pytest.fixture
def tool(tmp_path):
    def run(points, *arguments):
        """\\return the triangles, and the report"""
        cloud, mesh, report = (tmp_path / name for name in ("cloud.pcd", "mesh.obj", "report.json"))
        cloud.write_bytes(pcd_bytes(sample_of(points, is_double=points.itemsize == 8)))
        subprocess.run([os.environ["PCL_FLOATER_TOOL"], "-q", "--report", report, *arguments, cloud, mesh], check=True)
        return read_mesh(mesh).triangles, json_of(report.read_text())
    return run


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
