# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every argument reaches the core: it changes the mesh, a figure of the report, or is refused."""
import inspect

import numpy as np
import pcl_floater
import pytest

from conftest import terrain, torus


def sheets():
    """Two sheets of terrain, so near each other that neighbours are on both."""
    lower = terrain(20)
    return np.vstack([lower, lower + [0.2, 0.1, 0.9]])


def noisy():
    random = np.random.default_rng(7)
    points = torus(90, 36)
    return points + 0.12 * random.standard_normal(points.shape)


def with_leaves():
    """Terrain, and a crown of points that lie on no surface."""
    random = np.random.default_rng(7)
    crown = random.standard_normal((600, 3))
    crown *= 3 * random.uniform(0, 1, (600, 1)) ** (1 / 3) / np.linalg.norm(crown, axis=1, keepdims=True)
    return np.vstack([terrain(30), crown + [15, 15, 9]])


def holed(width):
    """Terrain with a hole, and an island far away."""
    points = terrain(30)
    kept = points[np.hypot(points[:, 0] - 15, points[:, 1] - 15) > width / 2]
    return np.vstack([kept, terrain(5) + [60.0, 0.0, 0.0]])


def crossing():
    """Two sheets through each other."""
    points = terrain(24) * [1, 1, 0]
    return np.vstack([points, points @ [[1, 0, 0], [0, 0, 1], [0, -1, 0]] + [0, 11.6, -11.7]])


def scan():
    """A box before a wall, both at an angle, along the rays of a camera at (1, 2, 3)."""
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, 48), np.linspace(-0.4, 0.4, 40))
    depth = np.where((abs(u) < 0.2) & (abs(v) < 0.2), 4.0, 6.0) + u
    return np.stack([u * depth, v * depth, depth], -1).reshape(-1, 3) + [1.0, 2.0, 3.0]


def outlier():
    return np.vstack([terrain(20), [[10, 10, 8.0]]])


def turned_normals(points):
    """Down, where the surface of itself would face up."""
    return np.tile([[0.0, 0.0, -1.0]], (len(points), 1))


DISC = dict(topology="disc")
SEGMENTS = dict(DISC, boundary="two-segments")
ILUT = dict(DISC, solver="bicgstab-ilut")
RIM = [*range(0, 30), *range(59, 899, 30), *range(899, 869, -1), *range(840, 0, -30)]
# The cloud, what both calls have, and what the second one has besides.
CASES = {
    "normals": (terrain, {}, dict(normals=turned_normals(terrain()))),
    "sensor_origin": (scan, dict(facing="viewpoint"), dict(sensor_origin=(1, 2, 3))),
    "topology": (terrain, {}, DISC),
    "holes": (lambda: holed(9), {}, dict(holes="close-all")),
    "kept_loops": (lambda: holed(9), dict(holes="keep-count"), dict(kept_loops=3)),
    "largest_hole": (lambda: holed(9), dict(holes="by-size", largest_hole=2), dict(largest_hole=20)),
    "largest_hole_length": (lambda: holed(9), dict(holes="by-size", largest_hole_length=2),
                            dict(largest_hole_length=20)),
    "viewpoint": (scan, dict(viewpoint="none"), dict(viewpoint=(1, 2, 3))),
    "facing": (lambda: terrain() * [1, 1, -1], dict(facing="normals", normals=turned_normals(terrain())),
               dict(facing="up", normals=None)),
    "max_edge": (terrain, {}, dict(max_edge=1.2)),
    "max_edge_ratio": (terrain, {}, dict(max_edge_ratio=1.2)),
    "min_component": (lambda: holed(0), {}, dict(min_component=100)),
    "remove_outliers": (outlier, {}, dict(remove_outliers=False)),
    "scatter": (with_leaves, {}, dict(scatter="drop")),
    "denoise": (noisy, {}, dict(denoise=False)),
    "flips": (terrain, DISC, dict(flips=False)),
    "uncross": (crossing, {}, dict(uncross=False)),
    "open_crossings": (crossing, dict(uncross=False), dict(open_crossings=True)),
    "neighbors": (sheets, {}, dict(neighbors=8)),
    "neighborhood": (terrain, DISC, dict(neighborhood="ball")),
    "ball_radius": (terrain, dict(DISC, neighborhood="ball"), dict(ball_radius=4)),
    "use_input_normals": (terrain, dict(normals=turned_normals(terrain()) + [[0.5, 0.5, 0.5]]),
                          dict(use_input_normals=True)),
    "sheet_filter": (sheets, {}, dict(sheet_filter=False)),
    "method": (terrain, {}, dict(method="tw385")),
    "boundary": (terrain, DISC, dict(boundary="two-segments")),
    "loop": (terrain, {}, dict(loop=np.array(RIM))),
    "opening_angle": (terrain, SEGMENTS, dict(opening_angle=120)),
    "cluster_tolerance": (terrain, SEGMENTS, dict(cluster_tolerance=0.02)),
    "cluster_neighbors": (terrain, SEGMENTS, dict(cluster_neighbors=1)),
    "domain": (terrain, DISC, dict(domain="own-shape")),
    "sides": (terrain, dict(DISC, domain="polygon"), dict(sides=3)),
    "spacing": (terrain, DISC, dict(spacing="uniform")),
    "weights": (terrain, DISC, dict(weights="uniform")),
    "solver": (terrain, DISC, dict(solver="gauss-seidel", tolerance=1e-6)),
    "ordering": (terrain, DISC, dict(ordering="natural")),
    "tolerance": (terrain, dict(ILUT, tolerance=1e-12), dict(tolerance=1e-3)),
    "max_iterations": (terrain, ILUT, dict(max_iterations=1)),
    "ilut_fill": (terrain, ILUT, dict(ilut_fill=2)),
    "ilut_drop": (terrain, ILUT, dict(ilut_drop=0.5)),
    "strict": (terrain, dict(kept_loops=3), dict(strict=True)),
}
# Of which the documentation says that they change nothing.
WITHOUT_EFFECT = {"threads", "blocks", "progress"}


def outcome(points, arguments):
    """What the arguments can change, but for the times and the options themselves."""
    try:
        mesh = pcl_floater.reconstruct(points, **arguments)
    except pcl_floater.FloaterError as error:
        return error.status
    parameters = None if mesh.parameters is None else mesh.parameters.tolist()
    return mesh.triangles.tolist(), parameters, mesh.report["statistics"]


@pytest.mark.parametrize("name", CASES)
def test_argument_has_an_effect(name):
    cloud, both, second = CASES[name]
    points = cloud()
    assert name in second
    assert outcome(points, both) == outcome(points, both)  # so that a difference means something
    assert outcome(points, {**both, **second}) != outcome(points, both)


def test_all_arguments_are_tried():
    assert set(inspect.signature(pcl_floater.reconstruct).parameters) == {"points", *CASES, *WITHOUT_EFFECT}


def test_option_without_effect_is_told(terrain_points):
    assert pcl_floater.reconstruct(terrain_points).warnings == ()
    mesh = pcl_floater.reconstruct(terrain_points, domain="square")
    assert len(mesh.warnings) == 1 and "effect" in mesh.warnings[0]
