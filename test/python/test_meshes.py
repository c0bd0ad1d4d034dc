# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes out: the mesh of the tool, in memory that nobody has copied; normals and texture coordinates of meshes."""
import copy
import gc
import json
import pickle
import re
import tracemalloc

import numpy as np
import pcl_floater
import pytest
from files import spiral  # of test/tool


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


def test_organized_cloud():
    """A wall and a ball in front of it, from a camera in the origin that sees nothing in one corner."""
    v, u = np.mgrid[:60, :80]
    rays = np.stack([(u - 40) / 80, (v - 30) / 80, np.ones_like(u, float)], -1)
    ball = np.array([0.1, 0.05, 1.5])
    along, square = rays @ ball, np.sum(rays**2, -1)
    under_root = along**2 - square * (ball @ ball - 0.3**2)
    depth = np.where(under_root > 0, (along - np.sqrt(np.maximum(under_root, 0))) / square, 3.0)
    depth[:10, :10] = np.nan
    image = (rays * depth[..., None]).astype(np.float32)
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


CORNERS = np.array([[0, 1, 2]])
POINTS = np.eye(3)


@pytest.fixture(scope="module")
def torus_mesh(torus_points):
    return pcl_floater.reconstruct(torus_points)


def test_normals_and_texture_of_a_torus(torus_points, torus_mesh):
    normals = pcl_floater.vertex_normals(torus_points, torus_mesh.triangles)
    assert normals.dtype == np.float32 and normals.shape == torus_points.shape
    x, y, z = torus_points.T
    ring = 5 / np.hypot(x, y)
    outwards = np.stack([x - ring * x, y - ring * y, z], -1) / 2
    assert np.sum(normals * outwards, axis=1).min() > 0.99

    texture = pcl_floater.texture_coordinates(torus_points, torus_mesh.triangles)
    assert np.array_equal(texture.points[texture.corners], torus_mesh.triangles)
    assert texture.coordinates.min() >= 0 and texture.coordinates.max() <= 1
    report = texture.report
    assert report["flipped"] == 0 and 1 <= report["stretch"] < 1.1
    assert report["charts"] == texture.charts.max() + 1 >= 2
    a, b, c = (texture.coordinates[texture.corners[:, corner]].astype(float) for corner in range(3))
    areas = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    assert report["area_used"] == pytest.approx(areas.sum() / 2, rel=1e-3)
    lengths = np.linalg.norm(np.subtract(*torus_points[texture.seams.T]), axis=1)
    assert report["seam_length"] == pytest.approx(lengths.sum())
    assert repr(texture).startswith(f"<pcl_floater.Texture: {report['charts']} charts, ")
    again = pickle.loads(pickle.dumps(texture))
    assert np.array_equal(again.coordinates, texture.coordinates) and again.report == report


@pytest.mark.parametrize("arguments", [dict(largest_stretch=1.001), dict(whole_discs=True)])
def test_argument_of_the_texture_has_an_effect(arguments):
    points = spiral(800, 1.8)  # of a bowl, nearly a sphere
    triangles = pcl_floater.reconstruct(points).triangles
    plain, other = (pcl_floater.texture_coordinates(points, triangles, **some) for some in ({}, arguments))
    assert other.report["charts"] != plain.report["charts"]


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint8, list])
def test_triangles_of_any_kind(kind):
    triangles = CORNERS.tolist() if kind is list else CORNERS.astype(kind)
    assert pcl_floater.texture_coordinates(POINTS, triangles).report["charts"] == 1
    assert np.allclose(pcl_floater.vertex_normals(POINTS.astype(np.float32), triangles), 3**-0.5)


def test_mesh_without_triangles():
    assert np.array_equal(pcl_floater.vertex_normals(POINTS, np.zeros((0, 3), int)), np.zeros((3, 3)))
    texture = pcl_floater.texture_coordinates(POINTS, np.zeros((0, 3), int))
    assert texture.coordinates.shape == (0, 2) and texture.report["charts"] == 0


WRONG_MESHES = [
    ((POINTS[:, :2], CORNERS), ValueError, "points must have the shape (n, 3), not (3, 2)"),
    ((POINTS.astype(int), CORNERS), TypeError, "points must be an array of float32 or float64"),
    ((POINTS, CORNERS[0]), ValueError, "triangles must have the shape (m, 3), not (3,)"),
    ((POINTS, CORNERS.astype(float)), TypeError, "triangles must be an array of whole numbers, not of float64"),
    ((POINTS, CORNERS - 1), ValueError, "triangles have an index that is negative, or too large"),
    ((POINTS, CORNERS + 1), ValueError, "a triangle names point 3, and there are 3 points"),
]
WRONG_ARGUMENTS = [
    (dict(threads=-1), ValueError, "the number of threads must be 0 (all cores) or more"),
    (dict(largest_stretch=0.5), ValueError, "stretch"),
    (dict(largest_stretch="1"), TypeError, "largest_stretch must be a number, not '1'"),
    (dict(whole_discs=1), TypeError, "whole_discs must be True or False, not 1"),
    (dict(progress=1), TypeError, "progress must be a callable, not 1"),
]


@pytest.mark.parametrize("function, mesh, arguments, kind, text", [
    *((pcl_floater.vertex_normals, mesh, {}, *rest) for mesh, *rest in WRONG_MESHES),
    *((pcl_floater.texture_coordinates, mesh, {}, *rest) for mesh, *rest in WRONG_MESHES),
    *((pcl_floater.texture_coordinates, (POINTS, CORNERS), *rest) for rest in WRONG_ARGUMENTS)])
def test_what_is_wrong_is_refused(function, mesh, arguments, kind, text):
    with pytest.raises(kind, match=re.escape(text)):
        function(*mesh, **arguments)


def test_what_is_no_surface_has_no_texture():
    with pytest.raises(pcl_floater.FloaterError) as raised:
        pcl_floater.texture_coordinates(np.where(POINTS > 0, np.nan, POINTS), CORNERS)
    assert raised.value.status == "INVALID_INDICES" and str(raised.value)


def test_progress_of_the_texture(torus_points, torus_mesh):
    told = []
    pcl_floater.texture_coordinates(torus_points, torus_mesh.triangles,
                                    progress=lambda stage, fraction: told.append((stage, fraction)))
    assert told and {stage for stage, _ in told} == {"texture"}
    fractions = [fraction for _, fraction in told]
    assert fractions == sorted(fractions) and fractions[-1] == 1

    with pytest.raises(ZeroDivisionError):
        pcl_floater.texture_coordinates(torus_points, torus_mesh.triangles, progress=lambda *told: 1 / 0)
