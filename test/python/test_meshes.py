# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes out: the mesh of the tool, in memory that nobody has copied."""
import copy
import gc
import json
import pickle
import tracemalloc

import numpy as np
import pcl_floater
import pytest


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_mesh_and_report_are_those_of_the_tool(torus_points, tool, dtype):
    points = torus_points.astype(dtype)
    triangles, report = tool(points)
    mesh = pcl_floater.reconstruct(points)
    assert mesh.points is points and mesh.parameters is None and mesh.warnings == ()
    assert repr(mesh) == "<pcl_floater.Mesh: 1440 points, 2880 triangles, 0 warnings>"
    assert mesh.triangles.dtype == np.int32 and np.array_equal(mesh.triangles, triangles)
    of_files = {"tool", "output", "shift", "texture", "peak_memory_bytes", "memory_limit"}
    assert set(report) - set(mesh.report) == of_files
    for key in of_files:
        del report[key]
    for key in ("file", "fields", "notes"):
        del report["input"][key]
    del report["seconds"]["reading"]
    assert list(report) == list(mesh.report)
    assert list(report.pop("seconds")) == list(mesh.report["seconds"])
    assert report == {key: value for key, value in mesh.report.items() if key != "seconds"}
    assert json.loads(json.dumps(mesh.report, allow_nan=False)) == mesh.report
    assert mesh.report is mesh.report and mesh.report["version"] == pcl_floater.__version__


def test_disc_is_that_of_the_tool(terrain_points, tool):
    arguments = dict(method="tw385", boundary="consensus", ordering="metis", threads=2)
    triangles, report = tool(terrain_points, *[f"--{name}={value}" for name, value in arguments.items()])
    mesh = pcl_floater.reconstruct(terrain_points, **arguments)
    assert np.array_equal(mesh.triangles, triangles)
    assert mesh.report["options"] == report["options"]
    assert mesh.loop.tolist() == report["loop"] == mesh.report["loop"]
    assert mesh.parameters.shape == terrain_points.shape[:1] + (2,)


LAYOUTS = {
    "a list": np.ndarray.tolist,
    "one row of an organized cloud": lambda p: p[None],
    "columns of a wider array": lambda p: np.hstack([p, p])[:, 3:],
    "every other row": lambda p: np.repeat(p, 2, axis=0)[::2],
    "column by column": np.asfortranarray,
    "backwards": lambda p: np.ascontiguousarray(p[::-1, ::-1])[::-1, ::-1],
    "a field of unaligned records": lambda p: np.rec.fromarrays(
        [np.zeros(len(p), np.int8), p], dtype=[("ring", np.int8), ("xyz", p.dtype, 3)]).xyz,
    "read only": lambda p: np.frombuffer(p.tobytes(), p.dtype).reshape(p.shape),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_layout_in_memory_does_not_matter(terrain_points, layout):
    for dtype in (np.float32, np.float64):
        points = terrain_points.astype(dtype)
        other = LAYOUTS[layout](points)
        assert np.array_equal(np.reshape(other, points.shape), points)
        assert np.array_equal(pcl_floater.reconstruct(other).triangles, pcl_floater.reconstruct(points).triangles)


def depth_image(rows=60, columns=80):
    """A wall and a ball in front of it, from a camera in the origin that sees nothing in one corner."""
    v, u = np.mgrid[:rows, :columns]
    rays = np.stack([(u - columns / 2) / columns, (v - rows / 2) / columns, np.ones_like(u, float)], -1)
    ball = np.array([0.1, 0.05, 1.5])
    along, square = rays @ ball, np.sum(rays**2, -1)
    under_root = along**2 - square * (ball @ ball - 0.3**2)
    depth = np.where(under_root > 0, (along - np.sqrt(np.maximum(under_root, 0))) / square, 3.0)
    depth[:10, :10] = np.nan
    return (rays * depth[..., None]).astype(np.float32)


def test_organized_cloud():
    image = depth_image()
    mesh = pcl_floater.reconstruct(image, sensor_origin=(0, 0, 0))
    as_list = pcl_floater.reconstruct(image.reshape(-1, 3), sensor_origin=(0, 0, 0))
    assert len(mesh.triangles) > 8000 and np.array_equal(mesh.triangles, as_list.triangles)
    assert mesh.points.shape == (4800, 3) and np.shares_memory(mesh.points, image) and len(mesh.non_finite) == 100


def test_numpy_allocates_nothing(terrain_points):
    """Neither for the points nor for the triangles: NumPy tells tracemalloc what it allocates."""
    points = np.tile(terrain_points, (100, 1))  # repeated points, so that this is quick
    points = np.hstack([points, points])[:, 1:4]
    tracemalloc.start()
    try:
        mesh = pcl_floater.reconstruct(points.astype(np.float32))  # counts itself, as a probe
        assert tracemalloc.get_traced_memory()[1] >= points.size * 4
        del mesh
        gc.collect()
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        mesh = pcl_floater.reconstruct(points)
        assert tracemalloc.get_traced_memory()[1] - before < points.size * 4 // 10
    finally:
        tracemalloc.stop()
    assert len(mesh.duplicates) == len(points) - len(terrain_points) and np.shares_memory(mesh.points, points)


def test_arrays_own_the_memory_of_the_run(terrain_points):
    mesh = pcl_floater.reconstruct(terrain_points, topology="disc")
    for array in (mesh.triangles, mesh.parameters, mesh.loop):
        assert not array.flags.owndata and array.flags.writeable and array.flags.c_contiguous
        assert array.base is not None
    triangles, expected = mesh.triangles, mesh.triangles.copy()
    del mesh
    gc.collect()
    for _ in range(3):  # which would take the memory if it had been freed
        pcl_floater.reconstruct(terrain_points[::-1])
    assert np.array_equal(triangles, expected)
    triangles[:] = triangles[:, ::-1]  # turns the mesh over
    assert np.array_equal(triangles, expected[:, ::-1])


def test_left_out_points_are_listed(torus_points):
    points = np.vstack([torus_points, torus_points[:2], [[np.nan, 0, 0], [0, np.inf, 0], [1e3, 0, 0]]])
    mesh = pcl_floater.reconstruct(points)
    n = len(torus_points)
    assert mesh.non_finite.tolist() == [n + 2, n + 3]
    assert sorted(map(sorted, mesh.duplicates.tolist())) == [[0, n], [1, n + 1]]
    assert mesh.outliers.tolist() == [n + 4]
    assert mesh.triangles.max() < n + 2
    for name in ("loop", "unused", "outliers", "scatter", "non_finite", "duplicates"):
        array = getattr(mesh, name)
        assert array.ndim == 1 + (name == "duplicates") and array.dtype == np.int32
        assert mesh.report[name] == array.tolist()


@pytest.mark.parametrize("clone", [copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_mesh_can_be_copied_and_pickled(terrain_points, clone):
    mesh = pcl_floater.reconstruct(terrain_points, topology="disc")
    other = clone(mesh)
    for name in ("points", "triangles", "parameters", "loop"):
        assert np.array_equal(getattr(other, name), getattr(mesh, name))
        assert not np.shares_memory(getattr(other, name), getattr(mesh, name))
    assert other.report == mesh.report and other.warnings == mesh.warnings
