# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every input format gives the same mesh, and every output format holds it to the last bit, with normals and texture
coordinates if these are asked for."""
import struct

import numpy as np
import pytest
from conftest import HAS_LZF, OUTPUT, USAGE
from files import (crosses, las_bytes, make_sample, obj_text, pcd_bytes, pcd_text, ply_bytes, sample_of, spiral,
                   table_text)

NAN, PLY_KINDS = float("nan"), ("ascii", "binary_little_endian", "binary_big_endian")


def same(a, b):
    """Whether arrays are equal; there may be none."""
    return (a is None) == (b is None) and (a is None or np.array_equal(a, b))


def same_floats(a, b):
    return same(np.asarray(a, "f4"), np.asarray(b, "f4"))


def expect_disc(mesh, size):
    """All points are used, no others, and there are about two triangles for each."""
    assert size < len(mesh.triangles) < 2 * size
    assert same(np.unique(mesh.triangles), np.arange(size))


def pcl_mesh(tool, name):
    """Points, colours, normals and triangles as most programs with PCL read them."""
    lines = [line.split() for line in tool.by_pcl("read", name).splitlines()]
    vertices = np.array([line[1:] for line in lines if line[0] == "v"], float)
    return vertices[:, :3], vertices[:, 3:6], vertices[:, 6:], np.array([line[1:] for line in lines if line[0] == "f"], int)


@pytest.mark.parametrize("is_double", (False, True))
def test_points_and_fields_of_every_input_come_back(tool, is_double):
    sample = make_sample(is_double)
    inputs = [("in.ply", ply_bytes(sample, kind)) for kind in PLY_KINDS] + [("in.obj", obj_text(sample))]
    inputs += [(name, table_text(sample)) for name in ("in.xyz", "in.txt", "in.csv", "in.asc", "IN.XYZ")]
    inputs.append(("in.pts", f"{len(sample.points)}\n" + table_text(sample)))
    inputs.append(("in.pcd", pcd_bytes(sample)))
    for kind in ("ascii", "binary", "compressed")[:2 + HAS_LZF]:
        tool.by_pcl(kind, tool.write("binary.pcd", pcd_bytes(sample)), "pcl.pcd")
        inputs.append(("in.pcd", tool.read("pcl.pcd")))
    triangles = None  # of the first
    for name, content in inputs:
        tool.write(name, content)
        warnings = tool.succeed(f"{name} out.ply --precision {'double' if is_double else 'auto'}").err
        mesh = tool.mesh()
        triangles = mesh.triangles if triangles is None else triangles
        assert (mesh.is_double, mesh.triangles.tolist()) == (is_double, triangles.tolist()), name
        assert same(mesh.points, sample.points) and same(mesh.colors, sample.colors), name
        assert same(mesh.normals, sample.normals), name
        assert same(mesh.fields.get("intensity"), None if name == "in.obj" else sample.intensities), name
        expect_disc(mesh, len(sample.points))
        has_list, has_face = name == "in.ply", name in ("in.ply", "in.obj")
        assert ("the list 'marks'" in warnings) == has_list
        assert ("1 face of the input file was left out" in warnings) == has_face
        assert warnings.count("\n") == has_list + has_face


def test_map_coordinates_of_las(tool):
    points = np.round(1000 * make_sample().points).astype(int)
    colors = [(256 * (i % 200), 512, 65535) for i in range(len(points))]
    tool.write("in.las", las_bytes(points, colors, 4, 7, (0.001,) * 3, (654321, 5123456, 0)))
    tool.succeed("in.las out.vtk --strict --precision double")
    mesh = tool.mesh("out.vtk")
    assert mesh.is_double and same(mesh.points, points * 0.001 + (654321.0, 5123456.0, 0.0))
    assert mesh.colors[5].tolist() == [5, 2, 255] and mesh.fields["intensity"][2] == 14
    assert "shift      654330 " in tool.succeed("in.las out.ply --strict").out
    assert not tool.mesh().is_double and same(tool.mesh().triangles, mesh.triangles)


@pytest.fixture(params=(False, True), ids=("float", "double"))
def made(tool, request):
    """The tool with a sample, and what makes a mesh of it."""
    tool.sample = make_sample(request.param)
    tool.write("in.pcd", pcd_bytes(tool.sample))

    def reconstruct_to(name):
        tool.succeed(f"in.pcd {name} --precision {'double' if tool.sample.is_double else 'auto'}")
        return tool.mesh(name)
    tool.reconstruct_to = reconstruct_to
    return tool


def test_outputs_hold_the_cloud_and_the_same_triangles(made):
    sample, vtk = made.sample, made.reconstruct_to("out.vtk")
    expect_disc(vtk, len(sample.points))
    for name, begin in (("out.vtk", b"# vtk"), ("out.ply", b"ply\n"), ("out.obj", b"# "),
                        ("out.off", b"CNOFF\n# written by"), ("out.glb", b"glTF")):
        if name == "out.glb" and sample.is_double:
            continue  # see the next test but one
        mesh = made.reconstruct_to(name)
        assert made.read(name).startswith(begin)
        assert same(mesh.triangles, vtk.triangles) and same(mesh.colors, sample.colors), name
        assert same(mesh.normals, sample.normals) and same_floats(mesh.points, sample.points), name
        assert not sample.is_double or same(mesh.points, sample.points), name
        if name in ("out.vtk", "out.ply"):
            assert mesh.is_double == sample.is_double and list(mesh.fields) == ["intensity"]
            assert same(mesh.fields["intensity"], sample.intensities)


def test_pcl_reads_ply_and_vtk(made):
    if made.sample.is_double:
        return  # PCL's reader of PLY takes doubles for 0 in points of floats
    for name in ("out.ply", "out.vtk"):
        mesh, (points, colors, normals, triangles) = made.reconstruct_to(name), pcl_mesh(made, name)
        assert same(triangles, mesh.triangles) and same(colors, made.sample.colors)
        assert same_floats(points, made.sample.points)
        assert name == "out.vtk" or same_floats(normals, made.sample.normals)


def test_formats_of_floats_are_refused(made):
    """The points of the sample in doubles are nearer to each other than 32-bit floats so far out."""
    sample, vtk = made.sample, made.reconstruct_to("out.vtk")
    for name, kind in (("out.glb", "glTF"), ("out.stl", "STL")):
        if not sample.is_double:
            assert made.succeed(f"in.pcd {name}").err == ""
            continue
        made.fail(f"in.pcd {name} --precision double", OUTPUT, kind + " holds 32-bit floats")
        assert made.succeed(f"in.pcd {name} --shift 600000,5000000,12000").err == ""
        assert len(made.mesh(name).triangles) == len(vtk.triangles)
        assert (b'"shift":"600000 5000000 12000"' in made.read(name)) == (name == "out.glb")
        made.path(name).unlink()
    if sample.is_double:
        return
    stl, glb = made.mesh("out.stl"), made.read("out.glb")
    assert same_floats(stl.points[stl.triangles], sample.points[vtk.triangles])
    size, text = struct.unpack_from("<2I", glb, 8)
    assert (size, text % 4) == (len(glb), 0)
    assert 20 + text + 8 + struct.unpack_from("<I", glb, 20 + text)[0] == len(glb)


def test_parameterization_is_the_mesh_in_the_plane(made):
    for extension in ("vtk", "ply", "obj", "stl", "off"):
        made.succeed(f"in.pcd out.vtk --quiet --parameterization flat.{extension}")
        flat, mesh = made.mesh("flat." + extension), made.mesh("out.vtk")
        assert len(flat.triangles) == len(mesh.triangles)
        assert (flat.points[:, 2] == 0).all() and np.hypot(*flat.points[:, :2].T).max() <= 1 + 1e-6
        if extension != "stl":
            assert same(flat.triangles, mesh.triangles) and same(flat.colors, made.sample.colors)
            assert flat.normals is None


def test_normals_of_the_mesh_are_in_every_format_that_has_them(made):
    sample = made.sample
    sample.points[5, 0] = NAN  # is left out
    sample.points[9, 2] += 1e4  # is in no triangle
    sample.normals[:] = (0, 1, 0)
    made.write("in.pcd", pcd_bytes(sample))
    plain = made.reconstruct_to("plain.ply")
    assert (plain.normals == (0, 1, 0)).all()  # of the input
    expected = np.zeros(plain.points.shape)  # as vertexNormals () has them, by the simplest means
    for i in range(3):
        corner, u, v = (plain.points[plain.triangles[:, (i + k) % 3]].astype(float) for k in range(3))
        u, v = ((x - corner) / np.linalg.norm(x - corner, axis=1)[:, None] for x in (u, v))
        across, angle = np.cross(u, v), np.arccos((u * v).sum(1))
        np.add.at(expected, plain.triangles[:, i], across * (angle / np.linalg.norm(across, axis=1))[:, None])
    expected /= np.maximum(np.linalg.norm(expected, axis=1), 1e-300)[:, None]
    for name in ("out.ply", "out.vtk", "out.obj", "out.off"):
        made.succeed(f"in.pcd {name} --normals --report r.json")
        mesh = made.mesh(name)
        assert same(mesh.triangles, plain.triangles) and same(mesh.colors, plain.colors), name
        if name in ("out.ply", "out.vtk"):
            assert same(mesh.fields["intensity"], plain.fields["intensity"])
        assert len(mesh.normals) == len(sample.points) - 1
        assert np.abs(mesh.normals - expected).max() < 1e-6 and (mesh.normals[8] == 0).all()
        assert '"normals":true' in made.text("r.json")


def test_normals_of_points_that_had_none(cloud):
    """The flat mesh has none: they are those of the surface in space."""
    cloud.succeed("in.pcd out.ply --normals --parameterization flat.ply")
    assert len(cloud.mesh().normals) == len(cloud.sample.points) and cloud.mesh("flat.ply").normals is None
    assert "no effect: --normals; STL has normals of triangles only" in cloud.succeed("in.pcd out.stl --normals").err


def test_glb_holds_every_point(tool):
    """Points in no triangle and equal points are vertices, too; normals are unit vectors."""
    sample = make_sample()
    points = np.concatenate([sample.points, [sample.points[3], (0, 0, 1e5)]])
    normals = np.concatenate([sample.normals, [(0, 0, 2)] * 2])
    normals[:2], normals[2, 0] = [(0, 3, -4), (0, 0, 0)], NAN
    tool.write("in.pcd", pcd_bytes(sample_of(points, normals=normals)))
    tool.succeed("in.pcd out.glb")
    mesh = tool.mesh("out.glb")
    assert same(mesh.points, points) and np.allclose(mesh.normals[0], (0, 0.6, -0.8), atol=1e-6)
    assert (mesh.normals[[1, 2, -1]] == (0, 0, 1)).all()


def test_doubles_are_written_on_demand(tool):
    """Else floats, of which the error is far below the spacing: most programs with PCL read these only."""
    sample, on_map = make_sample(), make_sample(True)
    sample.is_double = True
    sample.points *= 1 + 1e-9  # no float
    tool.write("in.pcd", pcd_bytes(sample))
    tool.write("in.obj", obj_text(sample))
    for name in ("in.pcd", "in.obj"):
        assert "double" not in tool.succeed(f"{name} out.ply").err
        assert same_floats(pcl_mesh(tool, "out.ply")[0], sample.points)
    tool.succeed("in.pcd wide.ply --precision double --strict")
    assert tool.mesh("wide.ply").is_double and same(tool.mesh("wide.ply").points, sample.points)
    tool.write("map.pcd", pcd_bytes(on_map))
    tool.succeed("map.pcd map.ply --precision single")
    assert not tool.mesh("map.ply").is_double and same_floats(tool.mesh("map.ply").points, on_map.points)


def test_doubles_are_written_where_floats_merge_points(tool):
    """A small part of a large cloud."""
    points = make_sample().points
    for size in (1.0, 1e-9):
        both = np.concatenate([100 * points, (500, 400, 300) + size * points])
        tool.write("in.pcd", pcd_bytes(sample_of(both, is_double=True)))
        assert ("written as doubles" in tool.succeed("in.pcd out.ply").err) == tool.mesh().is_double == (size != 1)
    tool.write("in.obj", obj_text(make_sample()) + "v 1e300 0 0 0 0 0\n")  # also of points that no triangle has
    tool.succeed("in.obj out.ply")
    assert tool.mesh().is_double


def test_scans_of_ptx_are_faced_from_their_sensors(tool):
    """A room that two scanners see from inside: without them, a closed body would face outwards."""
    low, high, columns, rows, text = np.array((-3, -2, 0)), np.array((3, 2, 2.6)), 60, 30, ""
    i = np.arange(columns * rows)
    turn, up = 0.01 + 2 * np.pi * (i // rows) / columns, -1.19 + 2.4 * (i % rows) / rows
    rays = np.stack([np.cos(turn) * np.cos(up), np.sin(turn) * np.cos(up), np.sin(up)], -1)
    for sensor in ((-1, 0, 1.2), (1.5, -1, 1.5)):
        ranges = (np.where(rays > 0, high - sensor, low - sensor) / rays).min(1) * (i % 50 != 7)
        text += (f"{columns}\n{rows}\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                 f"{' '.join(map(str, sensor))} 1\n")
        text += "".join("{} {} {} 1\n".format(*p) for p in (ranges[:, None] * rays).round(6))
    tool.write("room.ptx", text)
    assert "72 points without a return were left out" in tool.succeed("room.ptx out.ply").out
    mesh = tool.mesh()
    across = crosses(mesh)
    inwards = (across * (0.5 * (low + high) - mesh.points[mesh.triangles[:, 0]])).sum(1) > 0
    area = np.linalg.norm(across, axis=1)
    assert len(mesh.points) == 3600 - 72 and area[inwards].sum() > 0.99 * area.sum()


def test_normals_that_are_all_zero_are_told(tool):
    tool.write("in.pcd", pcd_bytes(sample_of(make_sample().points)))
    told = "all normals of the input file are zero"
    assert told in tool.succeed("in.pcd out.ply --use-input-normals on").err
    assert told not in tool.succeed("in.pcd out.ply").err


def test_off_names_what_it_holds(cloud):
    cloud.succeed("in.pcd plain.off")
    assert cloud.text("plain.off").startswith("OFF\n")
    cloud.succeed("in.pcd plain.off --normals --shift 1,2,3")
    assert cloud.text("plain.off").startswith("NOFF\n# written by pcl_floater_reconstruct\n# shift 1 2 3\n")


def test_fields_of_every_type_are_kept(tool):
    points = make_sample().points
    text = ("VERSION 0.7\r\nFIELDS a b x y z c d e f _ g h rgba\r\nSIZE 1 1 4 4 4 2 2 4 4 4 8 8 4\r\n"
            "TYPE I U F F F I U I U F I F U\r\nCOUNT 1 1 1 1 1 1 1 1 1 2 1 3 1\r\n"
            f"WIDTH {len(points)}\r\nHEIGHT 1\r\nDATA ascii\r\n")
    text += "".join("-128 255 {!r} {!r} {!r} -32768 65535 -2147483648 4294967295 nan nan 1234567890123 0.1 nan -1e400 {}\r\n"
                    .format(*p, 0x07C86400 + i) for i, p in enumerate(points.tolist()))
    tool.write("in.pcd", text)
    tool.succeed("in.pcd out.vtk")
    vtk = tool.mesh("out.vtk")
    for name, value in (("a", -128), ("b", 255), ("c", -32768), ("d", 65535), ("e", -2**31), ("f", 2**32 - 1),
                        ("g", 1234567890123), ("alpha", 7)):
        assert vtk.fields[name].shape == points.shape[:1] and (vtk.fields[name] == value).all(), name
    assert same(np.nan_to_num(vtk.fields["h"][0], nan=1, neginf=2), [0.1, 1, 2])
    assert vtk.colors[5].tolist() == [200, 100, 5]
    assert "the field 'g' was written as double" in tool.succeed("in.pcd out.ply").err
    ply = tool.mesh().fields
    assert (ply["g"][7], ply["h_0"][7], ply["d"][7]) == (1234567890123, 0.1, 65535)


@pytest.fixture
def body(tool):
    """A closed body, so that there are seams: points of an ellipsoid, coloured by place."""
    unit = spiral(900, 2)
    tool.sample = sample_of(unit * (1, 1, 1.3), 127.5 * (unit + 1), unit)
    tool.write("in.ply", ply_bytes(tool.sample))
    return tool


def areas(coordinates):
    """Twice the signed areas of triangles in the plane."""
    u, v = coordinates[:, 1] - coordinates[:, 0], coordinates[:, 2] - coordinates[:, 0]
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def test_obj_has_texture_coordinates_of_corners(body):
    assert "\ntexture    " in body.succeed("--uv in.ply out.obj").out
    assert body.names() == {"in.ply", "out.mtl", "out.obj"}
    obj = body.mesh("out.obj")
    assert len(obj.points) == len(body.sample.points) < len(obj.coordinates)  # none is doubled
    assert (obj.material_file, obj.material) == ("out.mtl", "surface")
    assert "newmtl surface\n" in body.text("out.mtl") and "map_Kd" not in body.text("out.mtl")
    assert (areas(obj.coordinates[obj.corners]) > 0).all()
    body.succeed("in.ply plain.obj")
    assert same(body.mesh("plain.obj").triangles, obj.triangles)


def test_ply_and_vtk_have_vertices_on_seams_doubled(body):
    body.succeed("--uv in.ply out.obj")
    body.succeed("--uv in.ply out.vtk")
    report = body.report("--uv", "in.ply")
    obj, ply, vtk = (body.mesh("out." + extension) for extension in ("obj", "ply", "vtk"))
    texture = report["texture"]
    assert len(ply.points) == len(obj.coordinates) == report["output"]["vertices"]
    assert texture["charts"] > 1 and texture["flipped"] == 0 and texture["file"] is None and texture["stretch"] < 1.1
    assert same(vtk.triangles, ply.triangles) and same(vtk.colors, ply.colors)
    vertices, points = ply.triangles, obj.triangles
    assert same(ply.points[vertices], ply.points[points]) and same(ply.colors[vertices], ply.colors[points])
    uv = np.stack([ply.fields["s"], ply.fields["t"]], -1)
    assert np.abs(uv[vertices] - obj.coordinates[obj.corners]).max() < 1e-7 and same(vtk.coordinates, uv)
    body.write("sheet.ply", ply_bytes(make_sample()))  # a disc is one chart
    assert body.report("--uv --topology disc", "sheet.ply")["texture"]["charts"] == 1


def test_texture_of_points_that_are_left_out(body):
    """And of points without triangle."""
    sample = body.sample
    sample.points[3, 0] = sample.points[40, 2] = NAN
    sample.points[100] = (50, 0, 0)
    body.write("holes.ply", ply_bytes(sample))
    body.succeed("--uv holes.ply out.ply")
    ply = body.mesh()
    uv = np.stack([ply.fields["s"], ply.fields["t"]], -1)[ply.triangles]
    assert uv.min() >= 0 and (areas(uv) > 0).all()
    assert np.linalg.norm(ply.points[ply.triangles[:, 0]] - ply.points[ply.triangles[:, 1]], axis=1).max() < 0.5
    assert ply.fields["s"][98] == -1  # the point far away, two places on


def test_colours_are_baked(body):
    pytest.importorskip("matplotlib")
    body.path("images").mkdir()
    body.succeed("--texture images/colours.png in.ply out.obj")
    assert "map_Kd images/colours.png\n" in body.text("out.mtl")
    obj, image = body.mesh("out.obj"), body.pixels("images/colours.png")[::-1]  # from below, as v counts
    assert image.shape[0] == image.shape[1] >= 256
    # In the middle of each triangle, the mean of the colours of its corners.
    x, y = (obj.coordinates[obj.corners].mean(1) * len(image)).astype(int).T
    assert np.abs(image[y, x] - body.sample.colors[obj.triangles].mean(1)).max() < 8
    # Its size can be chosen; the same command gives the same bytes.
    first = body.read("images/colours.png")
    body.succeed("-j1 --texture images/colours.png in.ply out.obj")
    assert body.read("images/colours.png") == first
    body.succeed("--texture small.png --texture-size 100 in.ply out.vtk")
    assert body.pixels("small.png").shape == (100, 100, 3)


def test_texture_is_written_with_all_or_not(body):
    body.write("out.mtl", "old")
    body.fail("--texture big.png --texture-size 2048 in.ply out.obj", OUTPUT, "cannot write", file_limit=100000)
    assert body.text("out.mtl") == "old"
    body.succeed("--texture new.png in.ply out.obj")
    assert body.text("out.mtl") != "old"
    assert "has a space in it" in body.succeed("--texture", "my colours.png", "in.ply", "out.obj").err
    body.fail("--uv in.ply out.stl", USAGE, "without texture coordinates")
    body.fail(["--texture", "a\nmap_Kd b.png", "in.ply", "out.obj"], USAGE, "line break")


def test_texture_of_any_size(tool):
    """Sizes whose squares are no numbers, and that no texture can hold together: no triangle is upside down, and the
    stretch is a number."""
    tool.write("large.xyz", "0 0 0\n1e154 0 0\n0 1e154 0\n1e154 1e154 1e153\n")
    sizes = 10 ** np.random.default_rng(21).uniform(-16, 21, (300, 1))
    np.savetxt(tool.path("mixed.xyz"), spiral(300, 1.5) * sizes, "%.9g")
    for name in ("large", "mixed"):
        texture = tool.report("--uv", name + ".xyz")["texture"]
        assert texture["flipped"] == 0 and texture["stretch"] is not None, name  # infinite: null
