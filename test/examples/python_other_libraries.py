# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as an object of other libraries, and in a file that they write: trimesh and Open3D, as far as
they are installed."""
import importlib.util
import sys
import tempfile

import numpy as np
import pcl_floater

x, y = np.meshgrid(np.arange(40.0), np.arange(30.0))
points = np.stack([x, y, 2 * np.sin(0.3 * x)], axis=-1).reshape(-1, 3)
mesh = pcl_floater.reconstruct(points)


def with_trimesh(file):
    import trimesh
    # process=False: the vertices stay the points, in their order.
    other = trimesh.Trimesh(mesh.points, mesh.triangles, process=False)
    other.export(file)
    return len(other.vertices), len(trimesh.load(file, process=False).faces)


def with_open3d(file):
    import open3d
    other = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(mesh.points), open3d.utility.Vector3iVector(mesh.triangles))
    other.compute_vertex_normals()
    open3d.io.write_triangle_mesh(file, other)
    return len(other.vertices), len(open3d.io.read_triangle_mesh(file).triangles)


wrong = 0
for name, convert in (("trimesh", with_trimesh), ("open3d", with_open3d)):
    if importlib.util.find_spec(name) is None:
        print(name, "is not installed")
        continue
    with tempfile.TemporaryDirectory() as folder:
        vertices, triangles = convert(folder + "/mesh.ply")
    print(f"{name}: {vertices} vertices, {triangles} triangles")
    wrong += (vertices, triangles) != (len(points), len(mesh.triangles))
sys.exit(1 if wrong else 0)
