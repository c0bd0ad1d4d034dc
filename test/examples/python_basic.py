# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From an array of points to a mesh, and what is known about it."""
import sys

import numpy as np
import pcl_floater


def make_torus():
    """A closed surface with one handle, where a program of yours would load a file."""
    random = np.random.default_rng(385)
    i, j = np.mgrid[:100, :40] + random.uniform(-0.25, 0.25, (2, 100, 40))
    u, v = 2 * np.pi * i / 100, 2 * np.pi * j / 40
    to_axis = 5 + 2 * np.cos(v)
    return np.stack([to_axis * np.cos(u), to_axis * np.sin(u), 2 * np.sin(v)], axis=-1).reshape(-1, 3)


points = make_torus()  # float64, shape (4000, 3)

try:
    mesh = pcl_floater.reconstruct(points)
except pcl_floater.FloaterError as error:
    sys.exit(f"{error.status}: {error}")
for warning in mesh.warnings:
    print("warning:", warning)

check = mesh.report["check"]
print(f"{len(mesh.triangles)} triangles, components: {check['components']}, handles: {check['genus']}, "
      f"boundary loops: {len(check['loops'])}")

# Each triangle has the indices of three points, so that NumPy computes with whole meshes.
a, b, c = (points[mesh.triangles[:, corner]] for corner in range(3))
normals = np.cross(b - a, c - a)  # twice as long as the triangle is large; they point outwards
area = np.linalg.norm(normals, axis=1).sum() / 2
volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
print(f"area {area:.0f}, volume {volume:.0f}")

is_torus = check["components"] == check["genus"] == 1 and not check["loops"]
sys.exit(0 if is_torus and 380 < area < 400 and 385 < volume < 400 else 1)
