# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the readers make of the bytes of a file: clouds, warnings, and messages."""
import struct
import time
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import INPUT, USAGE
from files import las_bytes, put, stl_bytes

NAN, MARK, LARGEST = float("nan"), "\ufeff", 2**31 - 1


@pytest.fixture
def read(tool):
    def read(name, content, *options):
        """The cloud, or its error."""
        all_ = tool.read_cloud(tool.write(name, content), *options)
        cloud = SimpleNamespace(**all_)
        if "fields" in all_:
            # Names and values of all fields, such as "red 255 0, green 0 1".
            cloud.values = dict(cloud.fields)
            cloud.text = ", ".join(" ".join([name, *(f"{NAN if v is None else v:.15g}" for v in values)])
                                   for name, values in cloud.fields)
        return cloud
    return read


def is_each(parts, texts):
    """Whether there is one text for each part, with it."""
    return len(parts) == len(texts) and all(any(part in text for text in texts) for part in parts)


def pcd(fields, header, rows):
    return f"FIELDS {fields}\n{header}WIDTH 2\nHEIGHT 1\nDATA ascii\n{rows}"


def ply(properties, faces, rows):
    return ("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
            f"{properties}element face {faces}\nproperty list uchar int vertex_indices\nend_header\n{rows}")


def table(first, second):
    """Rows of a table: what comes after the coordinates of either point."""
    return f"1.5 2 -3 {first}\n4 5e-3 0.1 {second}\n"


XYZ_FLOATS = "SIZE 4 4 4\nTYPE F F F\n"
ROWS, POINTS = "1 2 3\n4 5 6\n", "1.5 2 -3\n4 5e-3 0.1\n"
OBJ_POINTS = "v 1.5 2 -3\nv 4 5e-3 0.1\n"
OBJ_NORMALS = OBJ_POINTS + "vn 0.1 0 1\nvn 0.2 0 1\n"
FIVE_FIELDS = "SIZE 4 4 4 4 4\nTYPE F F F U U\n"
TYPED = "FIELDS x y z\n" + XYZ_FLOATS
WORDS = "property ushort r\nproperty ushort g\nproperty ushort b\n"
DIFFUSE = "property int diffuse_red\nproperty int diffuse_green\nproperty int diffuse_blue\n"
VTK = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET "
VTK_POINTS = "POINTS 2 double\n1.5 2 -3 4 5e-3 0.1\n"
MISSING, FACE = "taken for floats of 4 bytes", "1 face of the input"

# Files of two points: name, content, fields, and a part of each warning.
READABLE = [
    ("a.pcd", pcd("x y z", XYZ_FLOATS, ROWS), ""),
    ("a.pcd", TYPED + "WIDTH 1\nHEIGHT 2\nDATA ascii\n" + ROWS, ""),  # not organized
    ("a.pcd", TYPED + "WIDTH 0\nHEIGHT 0\nPOINTS 2\nDATA ascii\n" + ROWS, "", "as a list"),
    ("a.pcd", TYPED + "WIDTH 2\nHEIGHT 1\nDATA ascii 1 2 3\n4 5 6", ""),
    ("a.pcd", pcd("x y z", XYZ_FLOATS, ROWS + "7 7 7\n"), "", "has more data than the 2 points"),
    ("a.pcd", pcd("x y z _ t", "SIZE 4 4 4 1 4\nTYPE F F F U U\nCOUNT 1 1 1 0 1\n", "1 2 3 7\n4 5 6 8\n"), "t 7 8",
     "field '_' of the PCD header has COUNT 0"),
    ("a.pcd", MARK + pcd("x y z", XYZ_FLOATS, ROWS), ""),
    ("a.pcd", pcd("x y z", "", ROWS), "", MISSING),
    ("a.pcd", pcd("x y z", "SIZE 4 4 4\n", ROWS), "", MISSING),
    ("a.pcd", b"FIELDS x y z\nWIDTH 2\nHEIGHT 1\nDATA binary\n" + struct.pack("<6f", 1, 2, 3, 4, 5, 6), "", MISSING),
    ("a.pcd", pcd("X Y Z", XYZ_FLOATS, ROWS), ""),
    ("a.pcd", pcd("X x y z", "SIZE 4 4 4 4\nTYPE F F F F\n", "9 1 2 3\n9 4 5 6\n"), "X 9 9"),
    ("a.pcd", pcd("x y z i i i_2 x", "SIZE 4 4 4 4 4 4 4\nTYPE F F F F F F F\n",
                  "1 2 3 10 20 30 40\n4 5 6 11 21 31 41\n"), "i 10 11, i_3 20 21, i_2 30 31, x_2 40 41",
     "two fields 'i': the second was renamed 'i_3'", "two fields 'x': the second was renamed 'x_2'"),
    # 0x010203 and 0x01020304
    ("a.pcd", pcd("x y z rgb rgba", FIVE_FIELDS, "1 2 3 66051 16909060\n4 5 6 0 0\n"), "red 1 0, green 2 0, blue 3 0",
     "colour twice: the field 'rgba'"),
    ("a.pcd", pcd("x y z rgba rgb", FIVE_FIELDS, "1 2 3 16909060 66051\n4 5 6 0 0\n"),
     "red 2 0, green 3 0, blue 4 0, alpha 1 0", "the field 'rgb'"),
    ("a.ply", MARK + ply("", "0", ROWS), ""),
    # Colours of every name and scale are bytes.
    ("a.ply", ply(WORDS, "0", "1 2 3 65535 0 514\n4 5 6 255 256 0\n"), "red 255 0, green 0 1, blue 2 0"),
    ("a.ply", ply("property float Red\nproperty float Green\nproperty float Blue\nproperty float alpha\n", "0",
                  "1 2 3 1 0 .2 1\n4 5 6 0 nan 0 .4\n"), "red 255 0, green 0 0, blue 51 0, alpha 255 102"),
    ("a.ply", ply(DIFFUSE, "0", "1 2 3 255 0 7\n4 5 6 1 2 3\n"), "red 255 1, green 0 2, blue 7 3"),
    ("a.ply", ply(DIFFUSE, "0", "1 2 3 255 0 -7\n4 5 6 1 2 3\n"), "red 255 1, green 0 2, blue -7 3", "kept as other"),
    ("a.ply", ply("", "2", ROWS), "", "2 faces of the input file were left out"),
    ("a.ply", ply("property int a\nproperty int a\n", "0", "1 2 3 7 8\n4 5 6 9 10\n"), "a 7 9, a_2 8 10",
     "two fields 'a'"),
    ("a.obj", MARK + OBJ_POINTS, ""),
    ("a.obj", "v 1.5 2 -3\nv 4 5e-3 0.1\\\n", ""),
    ("a.obj", "v 1.5 2 -3 255 0 7 # a comment\nv 4 5e-3 0.1 0 1 128\n", "red 255 0, green 0 1, blue 7 128"),
    ("a.obj", "# c:\\\nv 1.5 \\\n2 \\\r\n  -3\nv 4 5e-3 .1\nvn 0 0 1\nvn 0 1 0\nf 1//1 \\\n 2//2 1//1\n",
     "nx 0 0, ny 0 1, nz 1 0", FACE),
    ("a.obj", OBJ_NORMALS, "nx 0.1 0.2, ny 0 0, nz 1 1"),
    ("a.obj", OBJ_NORMALS + "f 1//2 2/7/1 1//2\n", "nx 0.2 0.1, ny 0 0, nz 1 1", FACE),
    ("a.obj", OBJ_POINTS + "vn 0.5 0 1\nf 1//1 2 2\n", "nx 0.5 nan, ny 0 nan, nz 1 nan", FACE),
    # At a sharp edge a point has several.
    ("a.obj", OBJ_NORMALS + "f 1//1 2//1 2//2\n", "nx 0.1 0.1, ny 0 0, nz 1 1", "1 point had several normals", FACE),
    ("a.obj", OBJ_POINTS + "vn 0.5 0 1\n", "", "1 normal for 2 points"),
    ("a.xyz", "1,5;2;-3\n4;0,005;0,1\n", "", "read as decimal points"),
    ("a.xyz", "1\n" + POINTS, "", "promises 1 points, but there are 2"),
    ("a.xyz", "Made by a scanner\n\x01\x02\nno. of\n" + POINTS, "",
     "3 lines at the beginning of the input file are no points and were left out: 'Made by"),
    # Columns without names are guessed.
    ("a.xyz", table("0.5", "0.75"), "intensity 0.5 0.75",
     "have no names: after x, y and z, 4 for the intensity was taken"),
    ("a.xyz", table("255 0 7", "1 2 3"), "red 255 1, green 0 2, blue 7 3", "4 to 6 for colours"),
    ("a.xyz", table("0 0 1", "0 -1 0"), "nx 0 0, ny 0 -1, nz 1 0", "4 to 6 for normals"),
    ("a.xyz", table("-9 255 0 7", "0.5 1 2 3"), "intensity -9 0.5, red 255 1, green 0 2, blue 7 3",
     "5 to 7 for colours"),
    ("a.pts", table("9 255 0 7", "5 1 2 3"), "intensity 9 5, red 255 1, green 0 2, blue 7 3", "5 to 7 for colours"),
    ("a.xyz", table("9 255 0 7", "5 1 2 3"), "red 9 5, green 255 1, blue 0 2, intensity 7 3", "4 to 6 for colours"),
    ("a.xyz", table("0 0 1 255 0 7", "0 -1 0 1 2 3"), "nx 0 0, ny 0 -1, nz 1 0, red 255 1, green 0 2, blue 7 3",
     "4 to 6 for normals, 7 to 9 for colours"),
    ("a.xyz", table("0.5 300", "0.75 -1"), "column_4 0.5 0.75, column_5 300 -1", "4 for another field"),
    ("a.xyz", table("256 0 7", "1 2 3"), "column_4 256 1, column_5 0 2, column_6 7 3", "6 for another field"),
    # The better name is that of the coordinate.
    ("a.csv", "lat,height,x_m,Y [m],z,lng\n5,6,1.5,2,-3,7\n8,9,4,5e-3,.1,3\n", "lat 5 8, height 6 9, lng 7 3"),
    ("a.csv", "LONGITUDE_M,LATITUDE_M,Z_M,alpha\n1.5,2,-3,.5\n4,5e-3,.1,.5\n", "alpha 0.5 0.5"),
    ("a.csv", '"a","Points:0","Points:1","Points:2"\n7,1.5,2,-3\n8,4,5e-3,.1\n', "a 7 8"),
    # All normals after all points.
    ("a.pwn", "2\n1.5 2 -3\n4 5e-3 0.1\n0 0 1\n0 -1 0\n", "nx 0 0, ny 0 -1, nz 1 0"),
    # Colours of every scale.
    ("a.txt", "x y z r g b\n" + table("0 0.5 1", "0.2 0 0"), "red 0 51, green 128 0, blue 255 0"),
    ("a.txt", "x y z r g b\n" + table("0 65535 257", "0 0 0"), "red 0 0, green 255 0, blue 1 0", "16 bits"),
    ("a.txt", "x y z r g b\n" + table("-1 65535 257", "0 0 0"), "red -1 0, green 65535 0, blue 257 0",
     "kept as other fields"),
    # No alpha without a colour.
    ("a.csv", "x,y,z,class,a\n1.5,2,-3,tree,\n4,5e-3,0.1,grass 2,7\n", "a nan 7",
     "column 4 of the input file, 'class',"),
    # Floats where these hold the digits.
    ("a.asc", "x y z time short exact huge\n" +
     table("413456.123456 0.1 0.1000000014901161193847656 1e300", "413456.123457 12345.678 -0.5 nan"),
     "time 413456.123456 413456.123457, short 0.100000001490116 12345.677734375, exact 0.100000001490116 -0.5, "
     "huge 1e+300 nan"),
    ("a.vtk", VTK + "UNSTRUCTURED_GRID\n" + VTK_POINTS, ""),
    ("a.vtk", VTK + "POLYDATA\n" + VTK_POINTS + "POINT_DATA 2\nNORMALS n float\n0 0 1\n0 1 0\nSCALARS a float\n"
     "LOOKUP_TABLE default\n7 8\nCOLOR_SCALARS rgb 4\n1 0 .2 1\n0 0 0 1\n",
     "red 255 0, green 0 0, blue 51 0, nx 0 0, ny 0 1, nz 1 0"),
    ("a.vtk", VTK + "POLYDATA\n" + VTK_POINTS + "POLYGONS 1 4\n3 0 1 0\n", "", "1 face of"),
    *(("a.xyz", text, "") for text in (
        POINTS, "1.5\t2\t-3\r\n4\t5e-3\t.1\r\n", "  1.5   2  -3  \n\n4 5e-3 0.1", "1.5,2,-3\n4,5e-3,0.1\n",
        "1.5, 2, -3,\n4, 5E-3, +0.1,\n", "1.5;2;-3\n4;0.005;0.1\n", MARK + POINTS,
        "# text\n//\n% more\n1.5 2 -3\n#\n4 5e-3 0.1\n", '"1.5","2","-3"\n"4","5e-3","0.1"\n', "2\n" + POINTS,
        "1.5 2 -3\r\r4 5e-3 0.1\r", "BEGIN\n1.5 2 -3\nEnd\nBegin\n4 5e-3 0.1\nEND\n",
        "1\n1.5 2 -3\n1\n4 5e-3 0.1\n",  # two scans in one file
        # Comments that are no header, and one that is.
        "# x y z are in metres\n" + POINTS, "# the axes x , y , z\n" + POINTS,
        "# columns: y x z\n2 1.5 -3\n5e-3 4 0.1\n")),
    *(("a.csv", header + "255 0 7 1.5 2 -3 12 0.25\n0 1 2 4 5e-3 0.1 -1 0.5\n".replace(" ", separator),
       "red 255 0, green 0 1, blue 7 2, label 12 -1, intensity 0.25 0.5")
      for header in ("red,green,blue,x,y,z,label,Intensity\n", "R;G;B;X;Y;Z;label;I\n",
                     "//R G B X Y Z label Scalar_Intensity\n", "# red green blue X[m] Y[m] Z[m] Label intensity\n",
                     MARK + '"Red","Green","Blue","Easting","Northing","Height (m)","label","reflectance"\r\n')
      for separator in " ,;")]


def test_files_of_two_points(read):
    for name, content, fields, *warnings in READABLE:
        cloud = read(name, content)
        has_types = name in ("a.pcd", "a.ply")
        assert cloud.points == ([[1, 2, 3], [4, 5, 6]] if has_types else [[1.5, 2, -3], [4, 5e-3, 0.1]]), content
        assert (cloud.is_single, cloud.text) == (has_types, fields), content
        assert is_each(warnings, cloud.warnings), (content, cloud.warnings)


def test_columns_are_chosen(tool, read):
    for text, fields in (("0 7 2 1.5 -3\n1 8 5e-3 4 0.1\n", "column_1 0 1, column_2 7 8"),
                         ("id;a;b;c;d\n0;7;2;1.5;-3\n1;8;5e-3;4;.1\n", "id 0 1, a 7 8"),
                         ("# x y z red n\n0 7 2 1.5 -3\n1 8 5e-3 4 0.1\n", "column_1 0 1, column_2 7 8")):
        cloud = read("a.xyz", text, "[4,3,5]")
        assert (cloud.points, cloud.text, cloud.warnings) == ([[1.5, 2, -3], [4, 5e-3, 0.1]], fields, [])
        assert read("a.xyz", text, "[4,3,6]").error
    assert read("a.xyz", "x y z\n0 7 2 1.5 -3 9\n", "[4,5,6]").error  # columns without a name
    tool.fail("--columns 1,2,2 a.xyz o.ply", USAGE, "three different")
    tool.write("a.ply", ply("", "0", ROWS))
    tool.fail("--columns 1,2,3 a.ply o.ply", INPUT, "--columns is for text")


def test_rows_of_an_organized_cloud_are_told(read):
    text = TYPED + "WIDTH 3\nHEIGHT 2\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 0\n"
    assert is_each(["in 2 rows of 3 points"], read("a.pcd", text).notes)


def test_every_encoding_of_vtp(tool, read):
    """As VTK writes them."""
    core, data = pytest.importorskip("vtkmodules.vtkCommonCore"), pytest.importorskip("vtkmodules.vtkCommonDataModel")
    xml = pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    i = np.arange(50)
    points, poly = core.vtkPoints(), data.vtkPolyData()
    points.SetData(numpy_to_vtk(np.stack([0.5 * i, 0 * i + 2, -i], -1), True))
    colors, weights = numpy_to_vtk(np.stack([5 * i, 0 * i + 6, 0 * i + 7], -1).astype("u1"), True), numpy_to_vtk(0.1 * i, True)
    colors.SetName("RGB")
    weights.SetName("weight")
    poly.SetPoints(points)
    poly.GetPointData().SetScalars(colors)
    poly.GetPointData().AddArray(weights)
    for kind in range(24):
        writer = xml.vtkXMLPolyDataWriter()
        writer.SetInputData(poly)
        writer.SetFileName(str(tool.path("a.vtp")))
        writer.SetDataMode(kind % 3)
        writer.SetEncodeAppendedData(kind // 3 % 2)
        if kind // 6 % 2:
            writer.SetBlockSize(64)
        else:
            writer.SetCompressorTypeToNone()
        if kind >= 12:
            writer.SetHeaderTypeToUInt64()
            writer.SetByteOrderToBigEndian()
        writer.Write()
        content = tool.read("a.vtp")
        cloud = read("a.vtp", content)
        assert (len(cloud.points), cloud.points[49]) == (50, [24.5, 2, -49]), kind
        assert cloud.values["red"][49] == 245 and cloud.values["weight"] == (0.1 * i).tolist()
        readable = tool.read_cloud("--prefixes", "a.vtp", "37")
        assert readable[0] == len(content) and readable[-1] > content.index(b"</DataArray"), kind


def test_floats_of_a_lidar(read):
    """KITTI stores four floats of a point, nuScenes five."""
    for count in (4, 5):
        numbers = 0.25 * np.arange(10 * count, dtype="<f4").reshape(10, count)
        numbers[:, 4:] = 7
        cloud = read("a.bin", numbers.tobytes())
        assert np.array_equal(cloud.points, numbers[:, :3])
        assert list(cloud.values) == ["intensity", "ring"][:count - 3]
        assert "does not hold four floats" in read("a.bin", put(numbers.tobytes(), 8, "f", 1e30)).error


def test_points_that_are_not_finite_are_left_out(read):
    cloud = read("a.xyz", "1.5 2 -3\nnan 0 0\n4 5e-3 0.1\n1 inf 0\n")
    assert (len(cloud.points), cloud.not_finite, cloud.kept) == (4, 2, [0, 2])
    many = np.random.default_rng(5).uniform(-1, 1, (1000, 3))
    many[many[:, 0] > 0.8, 1] = NAN
    cloud = read("a.xyz", "".join(f"{x} {y} {z}\n" for x, y, z in many))
    assert cloud.kept == np.flatnonzero(np.isfinite(many[:, 1])).tolist()


SQUARE = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[1, 0, -0.0], [1, 1, 0.5], [0, 1, 0]]]
SQUARE_TEXT = ("solid name\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 0\r\n   vertex 1 0 0\n   vertex 0 1 0\n"
               "  endloop\n endfacet\n facet normal 0 0 0\n  outer loop\n   vertex 1 0 -0\n   vertex 1 1 0.5\n"
               "   vertex 0 1 0\n  endloop\n endfacet\nendsolid name\n")


def test_equal_corners_of_stl_are_one_point(read):
    for content in (stl_bytes(SQUARE), stl_bytes(SQUARE, b"solid, but binary"), SQUARE_TEXT, SQUARE_TEXT.upper()):
        cloud = read("a.stl", content)
        assert cloud.points == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]]
        assert cloud.is_single == isinstance(content, bytes)
        assert is_each(["2 faces of the input file were left"], cloud.warnings)
    assert is_each(["2 faces", "more data than the 2 facets"], read("a.stl", stl_bytes(SQUARE) + b"x" * 120).warnings)
    # The tool leaves such a corner out.
    facets = [[[NAN, 0, 0], [1, 0, 0], [0, 1, 0]], [[NAN, 0, 0], [1, 0, 0], [2, 2, 0]]]
    assert len(read("a.stl", stl_bytes(facets)).points) == 4
    many = np.random.default_rng(1).integers(0, 40, (5000, 3, 3))
    assert read("a.stl", stl_bytes(many)).points == [list(p) for p in dict.fromkeys(map(tuple, many.reshape(-1, 3).tolist()))]


def test_many_fields_of_one_name(read):
    count, start = 20000, time.monotonic()
    cloud = read("a.pcd", f"FIELDS x y z{' a' * count}\nSIZE 4 4 4{' 1' * count}\nTYPE F F F{' U' * count}\nWIDTH 1\n"
                          "HEIGHT 1\nPOINTS 1\nDATA binary\n".encode() + bytes(12 + count))
    assert time.monotonic() - start < 5
    assert cloud.fields[-1][0] == "a_20000" and len(cloud.warnings) < 4
    assert any("and 19998 other fields alike" in warning for warning in cloud.warnings)


LAS = {"points": [(0, 1, -2), (LARGEST, -LARGEST - 1, 3), (7, 7, 7)], "scale": (0.01, 0.001, 0.5),
       "offset": (500000, 5500000, -10), "colors": [(0x1234, 0, 0xFFFF), (255, 256, 257), (0, 0, 0)]}


def test_every_version_and_point_format_of_las(read):
    for minor in range(5):
        for layout in range(11):
            cloud = read("a.las", las_bytes(**LAS, minor=minor, layout=layout, extra_bytes=layout % 3,
                                            variable_records=minor % 3))
            assert np.array_equal(cloud.points, np.array(LAS["points"]) * LAS["scale"] + LAS["offset"])
            assert not cloud.is_single and not cloud.warnings and cloud.values["intensity"] == [0, 7, 14]
            assert cloud.has_colors == (layout in (2, 3, 5, 7, 8, 10))
            if cloud.has_colors:
                assert [cloud.values[c] for c in ("red", "green", "blue")] == [[0x12, 0, 0], [0, 1, 0], [0xFF, 1, 0]]


def test_classes_of_las(tool, read):
    """Points of ground, of noise and withheld, and one that was made up."""
    for is_long in (False, True):
        data = las_bytes([*LAS["points"], (1, 2, 3)], minor=4, layout=6 if is_long else 1)
        record = (len(data) - 375) // 4
        for p, kind in enumerate((2, 7, 6, 5)):
            at, withheld, synthetic = 375 + p * record + 14, p == 2, p == 3
            data = put(data, at, "B", 0x52 if is_long else 0x2A)  # second of five
            data = put(data, at + 1, "B", synthetic + 4 * withheld if is_long else kind + 32 * synthetic + 128 * withheld)
            data = put(data, at + 2, "B", kind) if is_long else data
            data = put(data, at + (6 if is_long else 4), "H", 300 + p)
            data = put(data, at + (8 if is_long else 6), "d", 0.25 * p)
        cloud = read("a.las", data)
        assert cloud.text == ("intensity 0 7 14 21, return_number 2 2 2 2, number_of_returns 5 5 5 5, "
                              "classification 2 7 6 5, synthetic 0 0 0 1, withheld 0 0 1 0, "
                              "point_source_id 300 301 302 303, gps_time 0 0.25 0.5 0.75")
        assert cloud.left_out == [False, True, True, False]
        assert cloud.notes == ["1 point that the file marks as withheld was left out",
                               "1 point of class 7 (1) was left out"]
        assert read("a.las", data, "[0,0,0]", "[7,5]").left_out == [True, False, True, False]
        assert read("a.las", data, "[0,0,0]", "[6]").error  # which is withheld
    assert read("a.las", las_bytes(**LAS)).left_out == []
    tool.write("a.xyz", "1 2 3\n4 5 6\n")
    tool.fail("--classes 2,6 a.xyz o.ply", INPUT, "no field 'classification'")
    tool.fail("--classes 2,six a.xyz o.ply", USAGE, "no numbers of classes")


# A quarter turn about z, and a move; the scans have 2 x 2 and 3 x 1 pixels.
PTX_HEAD = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"


def test_scans_of_ptx(read):
    first = "2\n2\n" + PTX_HEAD + "1 2 3 .5\n0 0 0 .5\n4 5 6 .25\n7 8 9 1\n"
    one = read("a.ptx", first)
    assert (one.sensor_origin, one.points[0]) == ([10, 20, 30], [8, 21, 33])
    assert (one.left_out, one.text) == ([False, True, False, False], "intensity 0.5 0.5 0.25 1")
    assert one.notes == ["1 scan: 2 x 2 pixels from (10, 20, 30)", "1 point without a return was left out"]
    two = read("a.ptx", first + "3\n1\n" + PTX_HEAD + "1 0 0 1\n1 0 1 1\n1 0 2 1\n\n")
    assert (len(two.points), two.towards_sensors, two.values["scan"][4]) == (7, 7, 1)
    assert read("a.ptx", "1\n1\n" + PTX_HEAD + "1 2 3 .5 7 8 9\n").text == "intensity 0.5, red 7, green 8, blue 9"
    assert "truncated" in read("a.ptx", first[:-9]).error
    assert "no number of the rows" in read("a.ptx", "9\n999\n" + PTX_HEAD).error


def test_odd_las_files(read):
    dark = [(255, 0, 3), (1, 2, 3), (0, 0, 0)]  # colours that were written as 8 bits
    assert read("a.las", las_bytes(**{**LAS, "colors": dark}, layout=2)).values["red"] == [255, 1, 0]
    black = read("a.las", las_bytes(**{**LAS, "colors": [(0, 0, 0)] * 3}, layout=2))
    assert not black.has_colors and is_each(["all colours of the input file are black"], black.warnings)
    # The number of 32 bits is 0 where it does not hold all points, and in files of the new formats.
    data = las_bytes(**LAS, minor=4)
    assert len(read("a.las", put(data, 107, "I", 0)).points) == 3
    assert len(read("a.las", put(data, 247, "Q", 0)).points) == 3
    assert len(read("a.las", put(data, 247, "Q", 2)).points) == 2
    # A scale that takes a coordinate beyond all numbers makes a point that is left out.
    assert read("a.las", las_bytes(**{**LAS, "scale": (1e300, 1, 1)})).not_finite == 1
