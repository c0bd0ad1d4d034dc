# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools for samples and pictures: files, exit codes, messages. The quick start, and the page of --html: what is in
it, and what a browser shows of it."""
import base64
import html.parser
import json
import os
import pathlib
import re
import shutil
import struct

import numpy as np
import pytest
from conftest import BUILD, GENERATE, INPUT, OK, OUTPUT, PICTURE, RECONSTRUCTION, REFUSED, TOOL, USAGE
from files import json_of

CORNERS = (0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
TRIANGLES = (3, 0, 1, 2, 3, 0, 2, 3)


def vtk_text(points, polygons, kind="float"):
    """A mesh from coordinates, and from polygons: the number of corners before the corners of each."""
    count, at = 0, 0
    while at < len(polygons):
        count, at = count + 1, at + polygons[at] + 1
    return (f"# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS {len(points) // 3} {kind}\n"
            f"{' '.join(map(str, points))}\nPOLYGONS {count} {at}\n{' '.join(map(str, polygons))}\n")


SQUARE = vtk_text(CORNERS, TRIANGLES)
BINARY_HEAD = SQUARE[:SQUARE.index("POINTS")].replace("ASCII", "BINARY").encode() + b"POINTS 4 double\n"
SQUARE_BINARY = (BINARY_HEAD + struct.pack(">12d", *CORNERS) + b"\nPOLYGONS 2 8\n" + struct.pack(">8i", *TRIANGLES) +
                 b"\nPOINT_DATA 4\nSCALARS a float\nLOOKUP_TABLE default\n" + bytes(16) +
                 b"\nTEXTURE_COORDINATES TCoords 2 float\n" + struct.pack(">8f", 0, 0, 1, 0, 1, 1, 0, 1) + b"\n")
SQUARE_PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n")


def test_generate_writes_the_same_points_as_pcd_and_ply(tool):
    for name in ("a.pcd", "b.pcd", "a.ply"):
        tool.check(OK, GENERATE, f"torus {name} --points 777 --noise 0.1")
    assert tool.read("a.pcd") == tool.read("b.pcd")
    header, points = tool.read("a.pcd").split(b"DATA binary\n", 1)
    assert b"\nPOINTS 777\n" in header and len(points) == 777 * 12
    header, ply_points = tool.read("a.ply").split(b"end_header\n", 1)
    assert b"\nelement vertex 777\n" in header and ply_points == points
    assert np.abs(np.frombuffer(points, "<f4")).max() < 30


@pytest.fixture
def sample(tool):
    def points(options):
        """The points of a sample, 1500 with a unit of area each."""
        tool.check(OK, GENERATE, f"{options} sample.ply --points 1500")
        return np.frombuffer(tool.read("sample.ply").split(b"end_header\n", 1)[1], "<f4").reshape(-1, 3).astype(float)
    return points


def nearest(points):
    """The distance from each point to its nearest other point, ascending."""
    squares = ((points[:, None] - points) ** 2).sum(2) + 1e9 * np.eye(len(points))
    return np.sort(np.sqrt(squares.min(1)))


def test_samples_are_as_even_as_asked_for(sample):
    for surface in ("height-field", "hemisphere", "finger", "folded-sheet", "cut-out", "sphere", "torus"):
        exact, uneven, noisy = (sample(surface + options) for options in ("", " --density-ratio 25", " --noise 0.3"))
        assert not np.array_equal(exact, sample(surface + " --seed 2"))
        distances = nearest(exact)
        assert 0.25 < distances[0] and distances[-1] < 1.6, surface
        distances = nearest(uneven)
        dense, sparse = distances[75], distances[-8]  # the spacings' ratio is 5 from end to end
        assert dense > 0.2 and sparse / dense > 3, surface
        # The order differs, because the noise uses random numbers first; so moments are compared.
        moments = [(points**2).sum(1).mean() for points in (exact, noisy)]
        assert 0 < abs(moments[1] - moments[0]), surface
        assert abs(moments[1] - moments[0] - 3 * 0.09) < 5 * 2 * 0.3 * (moments[0] / 1500) ** 0.5, surface


def test_holes_are_as_large_as_they_are_to_be(sample):
    """One in the middle, with a radius of 0.3 of the side. The areas of surfaces without holes, and how far a folded sheet
    is from itself, are tested by their meshes, in the core."""
    sheet, side = sample("cut-out --holes 1"), (1500 / (1 - np.pi * 0.09)) ** 0.5
    hole = np.hypot(*(sheet[:, :2] - side / 2).T).min() - 0.3 * side
    assert -1e-4 < hole < 1 and abs(sheet[:, :2].max() - side) < 0.02 * side


def test_generate_refuses_bad_command_lines(tool):
    for arguments, says in (("", "required"), ("torus", "required"), ("cube a.pcd", "cube"),
                            ("torus a.xyz", ".pcd or .ply"), ("torus a.pcd --size 3", "--size"),
                            ("torus a.pcd --points -5", "--points"), ("torus a.pcd --points many", "--points"),
                            ("torus a.pcd --points 49", "--points"), ("torus a.pcd --noise -1", "noise"),
                            ("torus a.pcd --noise nan", "noise"), ("torus a.pcd --density-ratio 0.9", "ratio"),
                            ("torus a.pcd --density-ratio 101", "ratio"),
                            ("finger a.pcd --length -1", "length"), ("finger a.pcd --length 9999", "too long"),
                            ("folded-sheet a.pcd --gap 0", "gap"), ("folded-sheet a.pcd --gap 1e4", "gap"),
                            ("cut-out a.pcd --holes -1", "holes"), ("cut-out a.pcd --holes 9000", "too many holes")):
        tool.check(USAGE, GENERATE, arguments, says=says)
    assert not tool.names()
    tool.check(OK, GENERATE, "--help", says="Exit codes")


def test_samples_and_pictures_tell_where_they_cannot_be_written(tool):
    tool.check(OUTPUT, GENERATE, "torus no/a.pcd", says="no/a.pcd")
    tool.path("folder.pcd").mkdir()
    tool.check(OUTPUT, GENERATE, "torus folder.pcd", says="folder.pcd")
    tool.write("square.vtk", SQUARE)
    tool.check(OUTPUT, PICTURE, "square.vtk no/out.png", says="no/out.png")


@pytest.fixture
def draw(tool):
    pytest.importorskip("matplotlib")

    def pixels(mesh, options=""):
        """Those of a picture of a mesh."""
        tool.check(OK, PICTURE, f"{mesh} drawn.png --height 100 {options}")
        return tool.pixels("drawn.png")
    tool.write("square.vtk", SQUARE)
    return pixels


def middle(draw, mesh, viewpoint):
    """What the middle of a picture shows."""
    red, _, blue = draw(mesh, "--viewpoint " + viewpoint)[40, 60]
    return "front" if blue > red + 20 else "back" if red > blue + 20 else "neither"


def test_picture_draws_one_or_two_panels(tool, draw):
    rows = draw("square.vtk")
    colours = rows.reshape(-1, 3)
    assert rows.shape == (100, 100, 3) and len(np.unique(colours, axis=0)) > 4 and (rows[0, 0] == 255).all()
    assert 200 < ((colours[:, 0] > 180) & (colours[:, 1] < 60)).sum() < 1000  # of the boundary
    both = draw("square.vtk square.vtk")
    assert np.array_equal(both[:, :100], rows)
    wires = both[:, 100:]
    assert wires[90, 10, 0] > 200 and wires[50, :, 0].min() < 200  # beside its lines, the square is empty


def test_picture_is_seen_from_a_viewpoint(tool, draw):
    assert middle(draw, "square.vtk", "0.5,0.5,3") == "front"
    assert middle(draw, "square.vtk", "0.5,0.5,-3") == "back"
    tool.check(USAGE, PICTURE, "square.vtk none.png --viewpoint 0.5,0.5", says="--viewpoint")


def test_picture_shows_what_is_nearer(tool, draw):
    above = tuple(value if i % 3 < 2 else 1 for i, value in enumerate(CORNERS))
    facing_down = (3, 6, 5, 4, 3, 7, 6, 4)
    for polygons in (TRIANGLES + facing_down, facing_down + TRIANGLES):
        tool.write("two.vtk", vtk_text(CORNERS + above, polygons))
        # From both sides, that of the farther one would be the front.
        assert middle(draw, "two.vtk", "0.5,0.5,4") == middle(draw, "two.vtk", "0.5,0.5,-3") == "back"


def test_picture_with_flat_shading_has_one_shade_for_each_triangle(tool, draw):
    tool.write("roof.vtk", vtk_text((0, 0, 0, 4, 0, 0, 2, 0, 3, 2, 5, 0), (3, 0, 2, 3, 3, 2, 1, 3)))
    smooth, flat = (draw("roof.vtk", options).reshape(-1, 3) for options in ("", "--flat"))
    shades = [len(np.unique(colours[colours[:, 2] > colours[:, 0] + 20], axis=0)) for colours in (smooth, flat)]
    assert shades[0] > shades[1]


def test_picture_leaves_out_what_is_no_triangle(tool, draw):
    expected, nan = draw("square.vtk"), float("nan")
    # A polygon; vertices in no triangle, or not finite; triangles without an area; a large offset.
    for points, polygons in ((CORNERS, (4, 0, 1, 2, 3)), (CORNERS + (nan, 0, 0, 9, 9, 9), TRIANGLES + (3, 0, 4, 1)),
                             (CORNERS, TRIANGLES + (3, 1, 1, 1)),
                             (tuple(2**30 + value for value in CORNERS), TRIANGLES)):
        tool.write("odd.vtk", vtk_text(points, polygons, "double"))
        assert np.array_equal(draw("odd.vtk"), expected), points


def test_picture_draws_textures(tool, draw):
    tool.write("textured.vtk", SQUARE_BINARY)
    tool.write("textured.ply", SQUARE_PLY)
    rows = draw("textured.vtk", "--checkerboard")
    assert rows.shape == (100, 200, 3) and len(np.unique(rows.reshape(-1, 3), axis=0)) > 100
    # In the square beside the mesh, there is more red at the right, and more green above.
    corner = rows[5:25, 105:125].sum((0, 1))
    assert 1.5 * corner[0] < rows[5:25, 175:195, 0].sum() and 1.5 * rows[75:95, 105:125, 1].sum() < corner[1]
    assert np.array_equal(draw("textured.ply", "--checkerboard"), rows)
    # A picture is an image as any other.
    tool.check(OK, PICTURE, "textured.ply image.png --height 64")
    again = draw("textured.vtk", "--texture image.png")
    assert not np.array_equal(again, rows) and again[50, 150, 2] > again[50, 150, 0] + 20
    for code, arguments, says in ((INPUT, "square.vtk out.png --checkerboard", "has no texture coordinates"),
                                  (INPUT, "textured.vtk out.png --texture textured.vtk", "no PNG file"),
                                  (USAGE, "textured.vtk out.png --texture image.png --checkerboard", "--checkerboard"),
                                  (USAGE, "textured.vtk square.vtk out.png --checkerboard", "not both")):
        tool.check(code, PICTURE, arguments, says=says)
    assert "out.png" not in tool.names()


def test_picture_refuses_what_is_not_a_mesh(tool):
    tool.write("square.vtk", SQUARE)
    tool.write("no_mesh.vtk", SQUARE[:SQUARE.index("POLYGONS")])
    tool.write("mesh.stl", "solid")
    for code, arguments, says in ((USAGE, "square.vtk", "required"), (USAGE, "square.vtk out.png --height 0", "--height"),
                                  (INPUT, "none.vtk out.png", "none.vtk"),
                                  (INPUT, "no_mesh.vtk out.png", "no_mesh.vtk': it has no polygons"),
                                  (INPUT, "mesh.stl out.png", "mesh.stl"),
                                  (INPUT, "square.vtk none.ply out.png", "none.ply")):
        tool.check(code, PICTURE, arguments, says=says)
    assert "out.png" not in tool.names()


BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
QUICKSTART = pathlib.Path(__file__).resolve().parents[2] / "tools/quickstart.sh"


def results(tool):
    folder = tool.path("floater_result")
    return set(os.listdir(folder)) if folder.is_dir() else set()


def number_of_points(tool):
    return int(re.search(rb"^POINTS (\d+) ", tool.read("floater_result/mesh.vtk"), re.MULTILINE)[1])


def test_clouds_of_the_quick_start_take_the_place_of_each_other(tool):
    said = tool.check(OK, QUICKSTART, "--build", BUILD, says="tum_rabbit.pcd")
    made = {"mesh.vtk", "report.json", "picture.png"}
    assert results(tool) == made and number_of_points(tool) == 10429
    for name in made:
        assert name in said and len(tool.read(f"floater_result/{name}")) > 1000
    report = json_of(tool.text("floater_result/report.json"))
    check = report["check"]
    assert (check["components"], len(check["loops"]), check["genus"], report["warnings"]) == (1, 1, 0, [])

    tool.write("sheet.obj", "".join(f"v {i % 30} {i // 30} {0.3 * ((i * i + i // 30) % 7) / 7}\n" for i in range(900)))
    tool.check(OK, QUICKSTART, "sheet.obj", "--build", BUILD, says="sheet.obj")
    assert results(tool) == made and number_of_points(tool) == 900
    assert "sheet.obj" in str(json_of(tool.text("floater_result/report.json"))["input"])

    tool.write("broken.pcd", "no cloud\n")
    tool.check(2, QUICKSTART, "--build", BUILD, "broken.pcd", says="broken.pcd")
    assert not results(tool)  # nothing of an earlier cloud


def test_wrong_command_lines_of_the_quick_start_are_refused(tool):
    tool.check(OK, QUICKSTART, "--help", says="Usage")
    for arguments, says in ((["--unknown"], "Usage"), (["a.pcd", "b.pcd"], "Usage"), (["--build"], "needs a folder"),
                            (["", "--build", "none"], "name of the cloud is empty"), (["."], "cannot read"),
                            (["none.pcd"], "none.pcd")):
        tool.check(1, QUICKSTART, *arguments, says=says)
    assert not results(tool)


def page(tool, cloud, *options, code=OK, says=""):
    """Writes page.html and report.json. Returns the data of the page, and the report."""
    tool.check(code, TOOL, cloud, "mesh.ply", "-q", "--html", "page.html", "--report", "report.json", *options, says=says)
    text = tool.text("page.html")
    elements, data = [], []

    class Reader(html.parser.HTMLParser):
        def handle_starttag(self, tag, attributes):
            elements.append((tag, dict(attributes)))

        def handle_data(self, text):
            if elements and elements[-1] == ("script", {"type": "application/json", "id": "data"}):
                data.append(text)

    Reader().feed(text)
    # Nothing from outside: no address but the name of a standard, no element or style that loads one.
    assert set(re.findall(r"https?://[^\s\"'<)]*", text)) <= {"http://www.w3.org/2000/svg"}
    assert not {tag for tag, _ in elements} & {"link", "img", "iframe", "object", "embed", "base", "form"}
    assert not [a for _, a in elements if {"src", "href"} & set(a)]
    assert "url(" not in text and "@import" not in text and "default-src 'none'" in text
    assert sum(tag == "script" for tag, _ in elements) == 2
    return json.loads("".join(data)), json.loads(tool.text("report.json"))


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text, validate=True), kind)


@pytest.fixture
def noisy(tool):
    """A cloud with flaws, and with a point far away."""
    tool.check(OK, GENERATE, "torus torus.ply --points 3000 --noise 0.9")
    content = tool.read("torus.ply").replace(b"element vertex 3000", b"element vertex 3002")
    tool.write("noisy.ply", content + np.array([1e9, 0, 0, 300, 300, 300], "<f4").tobytes())
    return tool


LISTS = ("loop", "unused", "outliers", "scatter", "non_finite", "duplicates")


def test_counts_of_the_page_are_those_of_the_report(noisy):
    data, report = page(noisy, "noisy.ply")
    for key in set(report) - {"seconds", "peak_memory_bytes"}:
        assert data["report"][key] == (len(report[key]) if key in LISTS else report[key])
    assert data["sentences"] and set(data["sentences"]) <= set(report["warnings"])
    mesh, used = data["mesh"], report["statistics"]["used_points"]
    assert mesh["triangles"] == mesh["shown"] == report["statistics"]["triangles"]
    corners = numbers(mesh["corners"], "<u4")
    assert len(corners) == 3 * mesh["shown"] and np.array_equal(np.unique(corners), np.arange(used))
    assert len(numbers(mesh["positions"], "<f4")) == 3 * used
    for name, histogram in data["histograms"].items():
        assert sum(histogram["counts"]) == used, name
    for flaw in mesh["flaws"]:
        triangles = numbers(flaw["triangles"], "<u4")
        assert len(set(triangles)) == flaw["count"] and max(triangles, default=0) < mesh["shown"]
        expected = {"crossing": "self_intersections", "folded": "folds", "flat": "degenerate_triangles"}
        if flaw["name"] in expected:
            assert (flaw["count"] > 0) == (report["check"][expected[flaw["name"]]] > 0), flaw["name"]
    dots = {kind["name"]: kind for kind in mesh["dots"]}
    assert {name: kind["count"] for name, kind in dots.items()} == {
        "points": 0, **{name: len(report[name]) for name in ("scatter", "outliers", "unused")}}
    assert dots["outliers"]["shown"] < dots["outliers"]["count"]  # one is too far away to be shown


def test_a_large_mesh_is_thinned_but_for_its_flaws(noisy):
    (whole, _), (some, report) = page(noisy, "noisy.ply"), page(noisy, "noisy.ply", "--page-triangles", "2000")
    mesh = some["mesh"]
    assert mesh["triangles"] == report["statistics"]["triangles"] and 1000 < mesh["shown"] <= 2000
    assert [flaw["count"] for flaw in mesh["flaws"]] == [flaw["count"] for flaw in whole["mesh"]["flaws"]]
    assert some["histograms"] == whole["histograms"]
    triangles = numbers(mesh["corners"], "<u4").reshape(-1, 3)
    assert (len(triangles), triangles.max()) == (mesh["shown"], len(numbers(mesh["positions"], "<f4")) / 3 - 1)
    assert all(len(set(triangle)) == 3 for triangle in triangles)
    few = page(noisy, "noisy.ply", "--page-triangles", "20")[0]["mesh"]  # less than there are flaws
    assert (mesh["all_flaws"], few["all_flaws"]) == (True, False) and 0 < few["shown"] <= 20


def test_no_name_or_text_becomes_html(noisy):
    name = "</script><img src=x onerror=alert(1)>&amp;\"'\u2028.ply"
    noisy.path("<").mkdir()
    noisy.path("noisy.ply").rename(noisy.path(name))
    data, report = page(noisy, name)
    assert data["report"]["input"]["file"] == report["input"]["file"] == name


def test_a_failure_has_a_page_with_the_points(tool):
    tool.write("line.xyz", "".join(f"{i} 0 0\n" for i in range(50)))
    data, report = page(tool, "line.xyz", code=RECONSTRUCTION, says="line.xyz")
    assert data["report"]["message"] == report["message"]
    assert (data["mesh"]["shown"], data["mesh"]["dots"][0]["shown"]) == (0, 50)
    tool.check(OK, GENERATE, "torus torus.ply --points 3000 --noise 2")
    data, report = page(tool, "torus.ply", "--scatter", "keep", "--strict", code=REFUSED, says="--strict")
    assert report["status"] == data["report"]["status"] == "REFUSED" and data["mesh"]["shown"] > 0


@pytest.mark.skipif(BROWSER is None, reason="Chromium is missing")
def test_a_browser_shows_the_mesh_and_goes_to_a_flaw(noisy):
    pytest.importorskip("matplotlib")

    def show(anchor=""):
        """The pixels of the page in a browser."""
        noisy.check(OK, BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
                    "--enable-unsafe-swiftshader", "--hide-scrollbars",
                    "--force-prefers-reduced-motion",  # a busy machine may draw the page before a flight ends
                    f"--user-data-dir={noisy.path('profile')}", "--window-size=1000,700", "--virtual-time-budget=4000",
                    f"--screenshot={noisy.path('page.png')}", f"file://{noisy.path('page.html')}{anchor}")
        return noisy.pixels("page.png").reshape(-1, 3)
    page(noisy, "noisy.ply")
    whole, near = show(), show("#place=1")
    rings = [(pixels == (11, 108, 255)).all(1).sum() for pixels in (whole, near)]
    assert rings[0] == 0 and rings[1] > 100
    assert ((whole[:, 2] > whole[:, 0] + 20) & (whole[:, 0] > 70)).sum() > 20000  # of the front
    assert (near[:, 0] > near[:, 2] + 100).sum() > 500  # of the flaw
