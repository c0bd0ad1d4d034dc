# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A small cloud with colours, normals and intensities, and files of it, from the specifications of the formats and
from nothing of the readers; and what the files of meshes hold, read by VTK or by NumPy."""
import json
import struct
from types import SimpleNamespace

import numpy as np
import pytest

# A value of each option that is not its default, as the report has it. That it arrives, by the tool or by Python, is
# enough there: what it does is tested in the core.
OTHER_VALUES = dict(
    threads=1, method="tw385", topology="disc", holes="close-all", kept_loops=3, largest_hole=2.5,
    largest_hole_length=2.5, viewpoint=[10, 10, 100], facing="up", max_edge=9.5, max_edge_ratio=9.5, min_component=10,
    remove_outliers=False, scatter="drop", denoise=False, flips=False, uncross=False, open_crossings=True, neighbors=12,
    neighborhood="ball-delaunay", ball_radius=3.5, sheet_filter=False, boundary="two-segments", opening_angle=120.5,
    cluster_tolerance=0.5, cluster_neighbors=5, domain="square", sides=3, spacing="uniform", weights="uniform",
    solver="bicgstab-ilut", ordering="metis", tolerance=1e-6, max_iterations=7, ilut_fill=7, ilut_drop=0.5)


def make_sample(is_double=False, side=12):
    """Points of a wavy square in random order. In single precision every coordinate is a float; in double precision
    the points are a centimetre apart at map coordinates of a million metres, where floats cannot tell them apart."""
    random = np.random.default_rng(7)
    y, x = (k.ravel() + random.uniform(-0.2, 0.2, side * side) for k in np.mgrid[:side, :side])
    points = random.permutation(np.stack([x, y, np.sin(0.4 * x) * np.cos(0.3 * y)], -1))
    points = (654321, 5123456, 12000) + 0.01 * points if is_double else points.astype("f4").astype(float)
    normals = np.append(random.uniform(-0.05, 0.05, (side * side, 2)), np.ones((side * side, 1)), 1)
    return sample_of(points, np.arange(side * side)[:, None] * (1, 7, 31) % 256,
                     normals / np.linalg.norm(normals, axis=1)[:, None], random.uniform(-0.5, 0.5, side * side), is_double)


def sample_of(points, colors=None, normals=None, intensities=None, is_double=False):
    count = len(points)
    return SimpleNamespace(
        points=np.array(points, float), is_double=is_double,
        colors=np.zeros((count, 3), "u1") if colors is None else np.array(colors, "u1"),
        normals=np.zeros((count, 3), "f4") if normals is None else np.array(normals, "f4"),
        intensities=np.zeros(count, "f4") if intensities is None else np.array(intensities, "f4"))


def spiral(count, height):
    """Points spread evenly over the unit sphere, from its top to so far below that."""
    z, angle = 1 - height * (np.arange(count) + 0.5) / count, 2.399963 * np.arange(count)
    return np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], -1)


def pcd_bytes(sample):
    """Binary PCD: x y z, rgb, normals, intensity."""
    rows = np.zeros(len(sample.points), [("at", "<f8" if sample.is_double else "<f4", 3), ("rgb", "<u4"),
                                         ("normal", "<f4", 3), ("intensity", "<f4")])
    rows["at"], rows["normal"], rows["intensity"] = sample.points, sample.normals, sample.intensities
    rows["rgb"] = sample.colors.astype("u4") @ np.array([65536, 256, 1], "u4")
    return (f"FIELDS x y z rgb normal_x normal_y normal_z intensity\nSIZE {' 8' * 3 if sample.is_double else ' 4' * 3}"
            f"{' 4' * 5}\nTYPE{' F' * 8}\nCOUNT{' 1' * 8}\nWIDTH {len(rows)}\nHEIGHT 1\nPOINTS {len(rows)}\n"
            "DATA binary\n").encode() + rows.tobytes()


def pcd_text(points):
    """PCD of ASCII numbers, x y z only."""
    rows = "".join("{!r} {!r} {!r}\n".format(*map(float, p)) for p in points)
    return (f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
            f"COUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\n"
            f"DATA ascii\n{rows}")


def ply_bytes(sample, kind="binary_little_endian", is_plain=False):
    """PLY: x y z, intensity, and unless it is plain red green blue and nx ny nz, with an element before the vertices,
    a list among their properties, and a face."""
    order = ">" if "big" in kind else "<"

    def pack(types, *values):
        if kind == "ascii":
            return (" ".join(str(v) for v in values) + " ").encode()
        return struct.pack(order + types, *values)

    end = b"\n" if kind == "ascii" else b""
    real, code = ("double", "d") if sample.is_double else ("float", "f")
    head = f"ply\nformat {kind} 1.0\n"
    cameras = "comment a sample\nelement camera 2\nproperty list uchar short frames\nproperty float focus\n"
    more = ("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar int marks\n"
            "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
            "property list uchar int vertex_indices\n")
    head += ("" if is_plain else cameras) + f"element vertex {len(sample.points)}\n"
    head += "".join(f"property {real} {axis}\n" for axis in "xyz") + "property float intensity\n"
    parts = [(head + ("" if is_plain else more) + "end_header\n").encode()]
    if not is_plain:
        parts += [pack("B", 0) + pack("f", 0.5) + end, pack("B3h", 3, 0, 1, 2) + pack("f", 0.5) + end]
    for i, point in enumerate(sample.points):
        row = pack("3" + code, *point) + pack("f", sample.intensities[i])
        if not is_plain:
            row += pack("3B", *sample.colors[i]) + pack(f"B{i % 3}i", i % 3, *range(i % 3)) + pack("3f", *sample.normals[i])
        parts.append(row + end)
    return b"".join(parts) + (b"" if is_plain else pack("B3i", 3, 0, 1, 2) + end)


def obj_text(sample):
    """OBJ: points with colours, normals, a face."""
    def line(key, *numbers):
        return " ".join([key, *(repr(float(x)) for x in numbers)]) + "\n"
    return ("# a sample\nmtllib none.mtl\no cloud\n" +
            "".join(line("v", *p, *c / 255) for p, c in zip(sample.points, sample.colors)) +
            "".join(line("vn", *n) for n in sample.normals) + "f 1//1 2//2 3//3\n")


def table_text(sample):
    """Text with all fields in each line."""
    return "x,y,z,red,green,blue,nx,ny,nz,intensity\n" + "".join(
        ",".join(repr(x) for x in [*p.tolist(), *c.tolist(), *n.tolist(), i]) + "\n"
        for p, c, n, i in zip(sample.points, sample.colors, sample.normals, sample.intensities.tolist()))


def put(data, at, kind, number):
    """The bytes with a number of LAS or STL at a place."""
    packed = struct.pack("<" + kind, number)
    return data[:at] + packed + data[at + len(packed):]


def las_bytes(points, colors=None, minor=2, layout=0, scale=(0.01, 0.01, 0.01), offset=(0, 0, 0), extra_bytes=0,
              variable_records=0):
    """LAS 1.minor; the points are whole numbers, before scale and offset. The intensity of point i is 7 i."""
    # Tables of the specification, LAS 1.4 - R15: 3 (header), 7 to 17 (points).
    size = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)[layout] + extra_bytes
    color_at = (0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30)[layout]
    header = 375 if minor >= 4 else 235 if minor == 3 else 227
    first = header + 54 * variable_records
    rows = np.zeros((len(points), size), "u1")
    rows[:, :12] = np.array(points, "<i4").view("u1")
    rows[:, 12:14] = (7 * np.arange(len(points))).astype("<u2").view("u1").reshape(-1, 2)
    if color_at and colors is not None:
        rows[:, color_at:color_at + 6] = np.array(colors, "<u2").view("u1")
    data = b"LASF" + bytes(first - 4) + rows.tobytes()
    numbers = [(24, "B", 1), (25, "B", minor), (94, "H", header), (96, "I", first), (100, "I", variable_records),
               (104, "B", layout), (105, "H", size)]
    numbers += [(107, "I", len(points))] if minor < 4 or layout < 6 else []
    numbers += [(247, "Q", len(points))] if minor >= 4 else []
    numbers += [(131 + 8 * i, "d", x) for i, x in enumerate((*scale, *offset))]
    for number in numbers:
        data = put(data, *number)
    return data


def stl_bytes(facets, header=b"a mesh"):
    """Binary STL of an array of the shape (n, 3, 3)."""
    rows = np.zeros(len(facets), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = np.reshape(facets, (-1, 3, 3))
    return header.ljust(80, b"\0") + struct.pack("<I", len(facets)) + rows.tobytes()


def read_mesh(path):
    """What a file has: points, triangles, colors, normals, is_double, other fields; of a texture coordinates, and of
    OBJ their indices for each triangle (corners) and the materials, of PLY the rows of all properties."""
    mesh = SimpleNamespace(is_double=True, colors=None, normals=None, coordinates=None, fields={})
    READERS[path.suffix](path, mesh)
    return mesh


PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
             "double": "f8"}


def read_ply(path, mesh):
    head, data = path.read_bytes().split(b"end_header\n", 1)
    words = [line.split() for line in head.decode().splitlines()]
    assert words[1] == ["format", "binary_little_endian", "1.0"]
    counts = [int(line[2]) for line in words if line[0] == "element"]
    kind = np.dtype([(line[2], "<" + PLY_TYPES[line[1]]) for line in words if line[0] == "property" and len(line) == 3])
    rows = np.frombuffer(data, kind, counts[0])
    faces = np.frombuffer(data[rows.nbytes:], [("count", "u1"), ("corners", "<i4", 3)])
    assert len(faces) == counts[1] and (faces["count"] == 3).all()

    def columns(*names):
        return np.stack([rows[name] for name in names], -1) if names[0] in rows.dtype.names else None
    mesh.rows, mesh.points, mesh.triangles, mesh.is_double = rows, columns(*"xyz"), faces["corners"], kind["x"] == "f8"
    mesh.colors, mesh.normals = columns("red", "green", "blue"), columns("nx", "ny", "nz")
    mesh.fields = {name: rows[name] for name in kind.names if name not in "x y z red green blue nx ny nz".split()}


def copy_poly_data(data, mesh):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    mesh.points = vtk_to_numpy(data.GetPoints().GetData())
    mesh.is_double = mesh.points.dtype == "f8"
    cells = vtk_to_numpy(data.GetPolys().GetData()).reshape(-1, 4)
    assert (cells[:, 0] == 3).all()
    mesh.triangles = cells[:, 1:]
    arrays = data.GetPointData()
    for i in range(arrays.GetNumberOfArrays()):
        array = arrays.GetArray(i)
        values, name = vtk_to_numpy(array), array.GetName()
        if name == "COLOR_0" or array is arrays.GetScalars() and values.dtype == "u1":
            mesh.colors = values[:, :3] if values.dtype == "u1" else np.round(255 * values[:, :3]).astype("u1")
        elif array is arrays.GetNormals():
            mesh.normals = values
        elif array is arrays.GetTCoords():
            mesh.coordinates = values
        else:
            mesh.fields[name] = values


def by_vtk(module, kind, *settings):
    """A reader of VTK's."""
    def read(path, mesh):
        reader = getattr(pytest.importorskip("vtkmodules." + module), kind)()
        reader.SetFileName(str(path))
        for setting in settings:
            getattr(reader, setting)()
        reader.Update()
        data = reader.GetOutput()
        if kind == "vtkGLTFReader":  # vertices as the file has them, without the transformation of its node
            parts = data.NewIterator()
            parts.InitTraversal()
            data = parts.GetCurrentDataObject()
            parts.GoToNextItem()
            assert parts.IsDoneWithTraversal()
        copy_poly_data(data, mesh)
    return read


def rows_of(lines, key, kind=float):
    return np.array([line.split()[1:] for line in lines if line.startswith(key + " ")], kind)


def read_obj(path, mesh):
    """A corner of a face is POINT, POINT//NORMAL, POINT/COORDINATES or POINT/COORDINATES/NORMAL."""
    lines = path.read_text().splitlines()
    points, normals, coordinates = (rows_of(lines, key) for key in ("v", "vn", "vt"))
    faces = [[corner.split("/") for corner in line.split()[1:]] for line in lines if line.startswith("f ")]
    assert all(len(corner) < 3 or corner[2] in ("", corner[0]) for face in faces for corner in face)
    mesh.points, mesh.triangles = points[:, :3], np.array([[int(c[0]) - 1 for c in face] for face in faces])
    mesh.colors = np.round(255 * points[:, 3:]).astype("u1") if points.shape[1] == 6 else None
    mesh.normals = normals.astype("f4") if len(normals) else None
    if len(coordinates):
        mesh.coordinates, mesh.corners = coordinates, np.array([[int(c[1]) - 1 for c in face] for face in faces])
        mesh.material_file, mesh.material = rows_of(lines, "mtllib", str)[0, 0], rows_of(lines, "usemtl", str)[0, 0]


def read_off(path, mesh):
    kind, *lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    points, faces, _ = map(int, lines[0].split())
    rows = np.array([line.split() for line in lines[1:1 + points]], float)
    cells = np.array([line.split() for line in lines[1 + points:]], int)
    assert len(cells) == faces and (cells[:, 0] == 3).all() and kind in ("OFF", "COFF", "NOFF", "CNOFF")
    mesh.points, mesh.triangles = rows[:, :3], cells[:, 1:]
    mesh.normals = rows[:, 3:6].astype("f4") if "N" in kind else None
    mesh.colors = rows[:, -4:-1].astype("u1") if kind[0] == "C" else None


def crosses(mesh):
    """Normals of the triangles, as long as twice their areas."""
    a, b, c = (mesh.points[mesh.triangles[:, i]].astype(float) for i in range(3))
    return np.cross(b - a, c - a)


READERS = {".ply": read_ply, ".obj": read_obj, ".off": read_off,
           ".vtk": by_vtk("vtkIOLegacy", "vtkPolyDataReader", "ReadAllFieldsOn", "ReadAllNormalsOn", "ReadAllScalarsOn"),
           ".stl": by_vtk("vtkIOGeometry", "vtkSTLReader", "MergingOff"),
           ".glb": by_vtk("vtkIOGeometry", "vtkGLTFReader", "ApplyDeformationsToGeometryOff")}


def json_of(text):
    """JSON as the standard has it: without NaN and Infinity."""
    def refuse(word):
        raise ValueError(word)
    return json.loads(text, parse_constant=refuse)
