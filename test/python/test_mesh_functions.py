# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals and texture coordinates of meshes."""
import pickle

import numpy as np
import pcl_floater
import pytest

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
    z = 1 - 1.8 * (np.arange(800) + 0.5) / 800  # of a bowl, nearly a sphere
    spiral = 2.399963 * np.arange(800)
    points = np.stack([np.sqrt(1 - z * z) * np.cos(spiral), np.sqrt(1 - z * z) * np.sin(spiral), z], -1)
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
    with pytest.raises(kind) as raised:
        function(*mesh, **arguments)
    assert text in str(raised.value)


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
