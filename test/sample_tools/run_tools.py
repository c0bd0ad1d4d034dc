#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tools for samples and pictures, the quick start and the page of --html as a user would: files, exit
codes, messages.

Usage: run_tools.py pcl_floater_generate pcl_floater_picture BUILD_FOLDER CLASS
CLASS: of tests, below; the scripts take the programs of BUILD_FOLDER
"""

import base64
import html.parser
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
    from matplotlib import image
except ImportError:
    image = None

GENERATE, PICTURE, BUILD = sys.argv[1:4]
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

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
NO_MESH = SQUARE[:SQUARE.index("POLYGONS")]


class Case(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return self.path(name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def check(self, code, *command, says="", **environment):
        """Runs a command; checks its exit code, its message, and that no temporary file is left. Returns its output."""
        done = subprocess.run(command, capture_output=True, text=True, timeout=1800, cwd=self.folder,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(says, done.stdout + done.stderr)
        self.assertFalse([name for name in os.listdir(self.folder) if "tmp" in name])
        return done.stdout

    def pixels(self, name):
        """The rows of a picture, of (red, green, blue)."""
        data = image.imread(self.path(name))[:, :, :3]
        return [list(map(tuple, row)) for row in np.round(255 * data).astype(int).tolist()]


class Generate(Case):
    def test_generate_writes_the_same_points_as_pcd_and_ply(self):
        for name in ("a.pcd", "b.pcd", "a.ply"):
            self.check(0, GENERATE, "torus", self.path(name), "--points", "777", "--noise", "0.1")
        self.assertEqual(self.read("a.pcd"), self.read("b.pcd"))
        header, points = self.read("a.pcd").split(b"DATA binary\n", 1)
        self.assertIn(b"\nPOINTS 777\n", header)
        self.assertEqual(len(points), 777 * 12)
        header, ply_points = self.read("a.ply").split(b"end_header\n", 1)
        self.assertIn(b"\nelement vertex 777\n", header)
        self.assertEqual(ply_points, points)
        self.assertLess(max(map(abs, struct.unpack(f"<{777 * 3}f", points))), 30)

    def points(self, surface, *options):
        """The points of a sample, 1500 with a unit of area each, as NumPy has them."""
        self.check(0, GENERATE, surface, "sample.ply", "--points", "1500", *options)
        return np.frombuffer(self.read("sample.ply").split(b"end_header\n", 1)[1], "<f4").reshape(-1, 3).astype(float)

    def test_samples_are_as_even_as_asked_for(self):
        for surface in ("height-field", "hemisphere", "finger", "folded-sheet", "cut-out", "sphere", "torus"):
            exact, uneven, noisy = (self.points(surface, *options) for options in (
                (), ("--density-ratio", "25"), ("--noise", "0.3")))
            self.assertFalse(np.array_equal(exact, self.points(surface, "--seed", "2")))

            def nearest(points):
                """The distance from each point to its nearest other point, ascending."""
                squares = ((points[:, None] - points) ** 2).sum(2) + 1e9 * np.eye(len(points))
                return np.sort(np.sqrt(squares.min(1)))
            distances = nearest(exact)
            self.assertTrue(0.25 < distances[0] and distances[-1] < 1.6, surface)
            distances = nearest(uneven)
            dense, sparse = distances[75], distances[-8]  # the spacings' ratio is 5 from end to end
            self.assertTrue(dense > 0.2 and sparse / dense > 3, surface)
            # The order differs, because the noise uses random numbers first; so moments are compared.
            moments = [(points**2).sum(1).mean() for points in (exact, noisy)]
            self.assertLess(abs(moments[1] - moments[0] - 3 * 0.09), 5 * 2 * 0.3 * (moments[0] / 1500) ** 0.5, surface)
            self.assertNotEqual(*moments)

    def test_samples_lie_on_their_surfaces(self):
        radius, pi = lambda area: (1500 / area) ** 0.5, np.pi
        x, y, z = self.points("sphere").T
        self.assertLess(np.abs(np.hypot(np.hypot(x, y), z) - radius(4 * pi)).max(), 1e-4)
        x, y, z = self.points("hemisphere").T
        self.assertLess(np.abs(np.hypot(np.hypot(x, y), z) - radius(2 * pi)).max(), 1e-4)
        self.assertGreater(z.min(), -0.5)
        x, y, z = self.points("finger", "--length", "6").T  # a cylinder under a hemisphere
        across = radius(2 * pi * 7)
        self.assertLess(np.abs(np.hypot(np.hypot(x, y), np.maximum(0, z - 6 * across)) - across).max(), 1e-4)
        self.assertGreater(z.min(), -0.5)
        x, y, z = self.points("torus").T
        self.assertLess(np.abs(np.hypot(np.hypot(x, y) - 2.5 * radius(10 * pi * pi), z) - radius(10 * pi * pi)).max(), 1e-4)
        z = self.points("folded-sheet", "--gap", "3")[:, 2]
        self.assertTrue(z.min() > -1e-4 and z.max() < 3 + 1e-4)
        self.assertGreater(min((np.abs(z) < 1e-4).sum(), (np.abs(z - 3) < 1e-4).sum()), 600)
        # One hole in the middle, with a radius of 0.3 of the side.
        sheet, side = self.points("cut-out", "--holes", "1"), (1500 / (1 - pi * 0.09)) ** 0.5
        hole = np.hypot(*(sheet[:, :2] - side / 2).T).min() - 0.3 * side
        self.assertTrue(-1e-4 < hole < 1 and abs(sheet[:, :2].max() - side) < 0.02 * side)

    def test_generate_refuses_bad_command_lines(self):
        for arguments, says in (("", "required"), ("torus", "required"), ("cube a.pcd", "cube"),
                                ("torus a.xyz", ".pcd or .ply"), ("torus a.pcd --size 3", "--size"),
                                ("torus a.pcd --points -5", "--points"), ("torus a.pcd --points many", "--points"),
                                ("torus a.pcd --points 49", "--points"), ("torus a.pcd --noise -1", "noise"),
                                ("torus a.pcd --noise nan", "noise"), ("torus a.pcd --density-ratio 0.9", "ratio"),
                                ("torus a.pcd --density-ratio 101", "ratio"),
                                ("finger a.pcd --length -1", "length"), ("finger a.pcd --length 9999", "too long"),
                                ("folded-sheet a.pcd --gap 0", "gap"), ("folded-sheet a.pcd --gap 1e4", "gap"),
                                ("cut-out a.pcd --holes -1", "holes"), ("cut-out a.pcd --holes 9000", "too many holes")):
            self.check(1, GENERATE, *arguments.split(), says=says)
        self.assertEqual(os.listdir(self.folder), [])
        self.check(0, GENERATE, "--help", says="Exit codes")

    def test_generate_tells_where_it_cannot_write(self):
        self.check(4, GENERATE, "torus", self.path("no/a.pcd"), says="no/a.pcd")
        os.mkdir(self.path("folder.pcd"))
        self.check(4, GENERATE, "torus", self.path("folder.pcd"), says="folder.pcd")


class Picture(Case):
    def picture(self, code, *arguments, says=""):
        self.check(code, PICTURE, *arguments, says=says)

    def draw(self, mesh, *options):
        """The pixels of a picture of a mesh."""
        self.picture(0, mesh, self.path("drawn.png"), "--height", "100", *options)
        return self.pixels("drawn.png")

    def draw_middle(self, mesh, viewpoint):
        """What the middle of a picture shows."""
        red, _, blue = self.draw(mesh, "--viewpoint", viewpoint)[40][60]
        return "front" if blue > red + 20 else "back" if red > blue + 20 else "neither"

    def test_picture_draws_one_or_two_panels(self):
        mesh = self.write("square.vtk", SQUARE)
        rows = self.draw(mesh)
        self.assertEqual((len(rows), len(rows[0])), (100, 100))
        colours = [colour for row in rows for colour in row]
        self.assertGreater(len(set(colours)), 4)
        self.assertEqual(rows[0][0], (255, 255, 255))
        boundary = sum(red > 180 and green < 60 for red, green, _ in colours)
        self.assertTrue(200 < boundary < 1000, boundary)
        self.picture(0, mesh, mesh, self.path("two.png"), "--height", "100")
        both = self.pixels("two.png")
        self.assertEqual([row[:100] for row in both], rows)
        wires = [row[100:] for row in both]
        self.assertGreater(wires[90][10][0], 200)  # beside its lines, the square is empty
        self.assertLess(min(wires[50])[0], 200)

    def test_picture_is_seen_from_a_viewpoint(self):
        mesh = self.write("square.vtk", SQUARE)
        self.assertEqual(self.draw_middle(mesh, "0.5,0.5,3"), "front")
        self.assertEqual(self.draw_middle(mesh, "0.5,0.5,-3"), "back")
        self.picture(1, mesh, self.path("none.png"), "--viewpoint", "0.5,0.5", says="--viewpoint")

    def test_picture_shows_what_is_nearer(self):
        above = tuple(value if i % 3 < 2 else 1 for i, value in enumerate(CORNERS))
        facing_down = (3, 6, 5, 4, 3, 7, 6, 4)
        for polygons in (TRIANGLES + facing_down, facing_down + TRIANGLES):
            mesh = self.write("two.vtk", vtk_text(CORNERS + above, polygons))
            # From both sides, that of the farther one would be the front.
            self.assertEqual(self.draw_middle(mesh, "0.5,0.5,4"), "back")
            self.assertEqual(self.draw_middle(mesh, "0.5,0.5,-3"), "back")

    def test_picture_with_flat_shading_has_one_shade_for_each_triangle(self):
        roof = self.write("roof.vtk", vtk_text((0, 0, 0, 4, 0, 0, 2, 0, 3, 2, 5, 0), (3, 0, 2, 3, 3, 2, 1, 3)))
        shades = [{colour for row in self.draw(roof, *options) for colour in row if colour[2] > colour[0] + 20}
                  for options in ([], ["--flat"])]
        self.assertGreater(len(shades[0]), len(shades[1]))

    def test_picture_leaves_out_what_is_no_triangle(self):
        expected = self.draw(self.write("square.vtk", SQUARE))
        self.assertEqual(self.draw(self.write("polygon.vtk", vtk_text(CORNERS, (4, 0, 1, 2, 3)))), expected)
        # Vertices that are in no triangle, or not finite; triangles without an area; a large offset.
        nan = float("nan")
        for points, polygons in ((CORNERS + (nan, 0, 0, 9, 9, 9), TRIANGLES + (3, 0, 4, 1)),
                                 (CORNERS, TRIANGLES + (3, 1, 1, 1)),
                                 (tuple(2**30 + value for value in CORNERS), TRIANGLES)):
            self.assertEqual(self.draw(self.write("odd.vtk", vtk_text(points, polygons, "double"))), expected, points)

    def test_picture_draws_textures(self):
        vtk = self.write("square.vtk", SQUARE_BINARY)
        ply = self.write("square.ply", SQUARE_PLY)
        rows = self.draw(vtk, "--checkerboard")
        self.assertEqual((len(rows), len(rows[0])), (100, 200))
        self.assertGreater(len({colour for row in rows for colour in row}), 100)
        # In the square beside the mesh, there is more red at the right, and more green above.
        for channel, low, high in ((0, rows, [row[:100] + row[:99:-1] for row in rows]), (1, rows[::-1], rows)):
            self.assertLess(1.5 * sum(row[x][channel] for row in low[5:25] for x in range(105, 125)),
                            sum(row[x][channel] for row in high[5:25] for x in range(105, 125)))
        self.assertEqual(self.draw(ply, "--checkerboard"), rows)
        # A picture is an image as any other.
        self.picture(0, ply, self.path("image.png"), "--height", "64")
        again = self.draw(vtk, "--texture", self.path("image.png"))
        self.assertNotEqual(again, rows)
        self.assertGreater(again[50][150][2], again[50][150][0] + 20)
        out = self.path("out.png")
        plain = self.write("plain.vtk", SQUARE)
        self.picture(2, plain, out, "--checkerboard", says="has no texture coordinates")
        self.picture(2, vtk, out, "--texture", vtk, says="no PNG file")
        self.picture(1, vtk, out, "--texture", self.path("image.png"), "--checkerboard", says="--checkerboard")
        self.picture(1, vtk, plain, out, "--checkerboard", says="not both")
        self.assertFalse(os.path.exists(out))

    def test_picture_refuses_what_is_not_a_mesh(self):
        mesh, out = self.write("square.vtk", SQUARE), self.path("out.png")
        self.picture(1, mesh, says="required")
        self.picture(1, mesh, out, "--height", "0", says="--height")
        self.picture(2, self.path("none.vtk"), out, says="none.vtk")
        self.picture(2, self.write("no_mesh.vtk", NO_MESH), out, says="no_mesh.vtk': it has no polygons")
        self.picture(2, self.write("mesh.stl", "solid"), out, says="mesh.stl")
        self.picture(2, mesh, self.path("none.ply"), out, says="none.ply")
        self.assertFalse(os.path.exists(out))

    def test_picture_tells_where_it_cannot_write(self):
        self.picture(4, self.write("square.vtk", SQUARE), self.path("no/out.png"), says="no/out.png")


class Quickstart(Case):
    def quickstart(self, code, *arguments, says=""):
        return self.check(code, ROOT / "tools/quickstart.sh", *arguments, says=says)

    def files(self):
        result = self.path("floater_result")
        return set(os.listdir(result)) if os.path.isdir(result) else set()

    def points(self):
        """Number of points of the mesh."""
        return int(re.search(rb"^POINTS (\d+) ", self.read("floater_result/mesh.vtk"), re.MULTILINE)[1])

    def test_clouds_take_the_place_of_each_other(self):
        said = self.quickstart(0, "--build", BUILD, says="tum_rabbit.pcd")
        made = {"mesh.vtk", "report.json", "picture.png"}
        self.assertEqual(self.files(), made)
        for name in made:
            self.assertIn(name, said)
            self.assertGreater(len(self.read(f"floater_result/{name}")), 1000)
        self.assertEqual(self.points(), 10429)
        report = json.loads(self.read("floater_result/report.json"))
        self.assertEqual(report["warnings"], [])
        check = report["check"]
        self.assertEqual((check["components"], len(check["loops"]), check["genus"]), (1, 1, 0))

        sheet = "".join(f"v {i % 30} {i // 30} {0.3 * ((i * i + i // 30) % 7) / 7}\n" for i in range(900))
        self.quickstart(0, self.write("sheet.obj", sheet), "--build", BUILD, says="sheet.obj")
        self.assertEqual(self.files(), made)
        self.assertEqual(self.points(), 900)
        self.assertIn("sheet.obj", json.dumps(json.loads(self.read("floater_result/report.json"))["input"]))

        self.quickstart(2, "--build", BUILD, self.write("broken.pcd", "no cloud\n"), says="broken.pcd")
        self.assertEqual(self.files(), set())  # nothing of an earlier cloud

    def test_wrong_command_lines_are_refused(self):
        self.quickstart(0, "--help", says="Usage")
        for arguments, says in ((["--unknown"], "Usage"), (["a.pcd", "b.pcd"], "Usage"),
                                (["--build"], "needs a folder"), ([""], "name of the cloud is empty"),
                                ([self.folder], "cannot read"), (["none.pcd"], "none.pcd")):
            self.quickstart(1, *arguments, says=says)
        self.assertEqual(self.files(), set())


class PageCase(Case):
    """Of the page that --html writes."""
    RECONSTRUCT = os.path.join(BUILD, "tools/reconstruct/pcl_floater_reconstruct")

    def page(self, cloud, *options, code=0, says=""):
        """Writes page.html and report.json. Returns the data of the page, and the report."""
        self.check(code, self.RECONSTRUCT, cloud, "mesh.ply", "-q", "--html", "page.html", "--report", "report.json",
                   *options, says=says)
        text = self.read("page.html").decode()
        elements, data = [], []

        class Reader(html.parser.HTMLParser):
            def handle_starttag(self, tag, attributes):
                elements.append((tag, dict(attributes)))

            def handle_data(self, text):
                if elements and elements[-1] == ("script", {"type": "application/json", "id": "data"}):
                    data.append(text)

        Reader().feed(text)
        # Nothing from outside: no address but the name of a standard, no element or style that loads one.
        self.assertEqual(set(re.findall(r"https?://[^\s\"'<)]*", text)) - {"http://www.w3.org/2000/svg"}, set())
        self.assertFalse({tag for tag, _ in elements} & {"link", "img", "iframe", "object", "embed", "base", "form"})
        self.assertFalse([a for _, a in elements if {"src", "href"} & set(a)])
        self.assertNotIn("url(", text)
        self.assertNotIn("@import", text)
        self.assertEqual(sum(tag == "script" for tag, _ in elements), 2)
        self.assertIn("default-src 'none'", text)
        return json.loads("".join(data)), json.loads(self.read("report.json"))

    def numbers(self, text, kind):
        packed = base64.b64decode(text, validate=True)
        return struct.unpack(f"<{len(packed) // struct.calcsize(kind)}{kind}", packed)

    def noisy(self, *options):
        """A cloud with flaws, and with a point far away."""
        self.check(0, GENERATE, "torus", "torus.ply", "--points", "3000", "--noise", "0.9")
        head, points = self.read("torus.ply").split(b"end_header\n", 1)
        head = head.replace(b"element vertex 3000", b"element vertex 3002")
        return self.write("noisy.ply", head + b"end_header\n" + points + struct.pack("<6f", 1e9, 0, 0, 300, 300, 300))


class Page(PageCase):
    def test_counts_are_those_of_the_report(self):
        data, report = self.page(self.noisy())
        for key in set(report) - {"seconds", "peak_memory_bytes", "loop", "unused", "outliers", "scatter", "non_finite",
                                  "duplicates"}:
            self.assertEqual(data["report"][key], report[key])
        for key in ("loop", "unused", "outliers", "scatter", "non_finite", "duplicates"):
            self.assertEqual(data["report"][key], len(report[key]))
        self.assertTrue(data["sentences"])
        self.assertLessEqual(set(data["sentences"]), set(report["warnings"]))
        mesh = data["mesh"]
        self.assertEqual(mesh["triangles"], report["statistics"]["triangles"])
        corners = self.numbers(mesh["corners"], "I")
        self.assertEqual(len(corners), 3 * mesh["shown"])
        self.assertEqual(mesh["shown"], mesh["triangles"])
        positions = self.numbers(mesh["positions"], "f")
        self.assertEqual(len(positions), 3 * report["statistics"]["used_points"])
        self.assertEqual(set(corners), set(range(len(positions) // 3)))
        for name, histogram in data["histograms"].items():
            self.assertEqual(sum(histogram["counts"]), report["statistics"]["used_points"], name)
        for flaw in mesh["flaws"]:
            triangles = self.numbers(flaw["triangles"], "I")
            self.assertEqual(len(set(triangles)), flaw["count"])
            self.assertLess(max(triangles, default=0), mesh["shown"])
            expected = {"crossing": "self_intersections", "folded": "folds", "flat": "degenerate_triangles"}
            if flaw["name"] in expected:
                self.assertEqual(flaw["count"] > 0, report["check"][expected[flaw["name"]]] > 0, flaw["name"])
        dots = {kind["name"]: kind for kind in mesh["dots"]}
        self.assertEqual({name: kind["count"] for name, kind in dots.items()},
                         {"points": 0, **{name: len(report[name]) for name in ("scatter", "outliers", "unused")}})
        self.assertLess(dots["outliers"]["shown"], dots["outliers"]["count"])  # one is too far away to be shown

    def test_a_large_mesh_is_thinned_but_for_its_flaws(self):
        cloud = self.noisy()
        (whole, _), (some, report) = self.page(cloud), self.page(cloud, "--page-triangles", "2000")
        mesh = some["mesh"]
        self.assertEqual(mesh["triangles"], report["statistics"]["triangles"])
        self.assertTrue(1000 < mesh["shown"] <= 2000)
        self.assertEqual([f["count"] for f in mesh["flaws"]], [f["count"] for f in whole["mesh"]["flaws"]])
        self.assertEqual(some["histograms"], whole["histograms"])
        corners = self.numbers(mesh["corners"], "I")
        triangles = list(zip(*[iter(corners)] * 3))
        self.assertEqual((len(triangles), max(corners)), (mesh["shown"], len(self.numbers(mesh["positions"], "f")) / 3 - 1))
        self.assertTrue(all(len(set(t)) == 3 for t in triangles))
        few = self.page(cloud, "--page-triangles", "20")[0]["mesh"]  # less than there are flaws
        self.assertEqual((mesh["all_flaws"], few["all_flaws"]), (True, False))
        self.assertTrue(0 < few["shown"] <= 20)

    def test_no_name_or_text_becomes_html(self):
        name = "</script><img src=x onerror=alert(1)>&amp;\"'\u2028.ply"
        os.mkdir(self.path("<"))
        os.rename(self.noisy(), self.path(name))
        data, report = self.page(name)
        self.assertEqual(data["report"]["input"]["file"], name)
        self.assertEqual(report["input"]["file"], name)

    def test_a_failure_has_a_page_with_the_points(self):
        self.write("line.xyz", "".join(f"{i} 0 0\n" for i in range(50)))
        data, report = self.page("line.xyz", code=3, says="line.xyz")
        self.assertEqual(data["report"]["message"], report["message"])
        self.assertEqual((data["mesh"]["shown"], data["mesh"]["dots"][0]["shown"]), (0, 50))
        self.check(0, GENERATE, "torus", "torus.ply", "--points", "3000", "--noise", "1.5")
        data, report = self.page("torus.ply", "--scatter", "keep", "--strict", code=6, says="--strict")
        self.assertEqual((report["status"], data["report"]["status"]), ("REFUSED", "REFUSED"))
        self.assertGreater(data["mesh"]["shown"], 0)


class Browser(PageCase):
    def show(self, anchor=""):
        """The pixels of the page in a browser."""
        self.check(0, BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
                   "--force-prefers-reduced-motion",  # a busy machine may draw the page before a flight ends
                   "--user-data-dir=" + self.path("profile"), "--window-size=1000,700", "--virtual-time-budget=4000",
                   "--screenshot=" + self.path("page.png"), "file://" + self.path("page.html") + anchor)
        return [pixel for row in self.pixels("page.png") for pixel in row]

    def test_a_browser_shows_the_mesh_and_goes_to_a_flaw(self):
        self.page(self.noisy())
        front, flaw, ring = (lambda p: p[2] > p[0] + 20 and p[0] > 70), (lambda p: p[0] > p[2] + 100), (11, 108, 255)
        whole, near = self.show(), self.show("#place=1")
        self.assertGreater(sum(map(front, whole)), 20000)
        self.assertEqual(whole.count(ring), 0)
        self.assertGreater(near.count(ring), 100)
        self.assertGreater(sum(map(flaw, near)), 500)


if __name__ == "__main__":
    if sys.argv[4] in ("Generate", "Picture", "Browser") and image is None:
        print("NumPy or Matplotlib is missing")
        sys.exit(77)
    if sys.argv[4] == "Browser" and BROWSER is None:
        print("Chromium is missing")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
