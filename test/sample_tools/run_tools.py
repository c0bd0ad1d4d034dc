#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs pcl_floater_generate and pcl_floater_picture as a user would: files, exit codes, messages.

Usage: run_tools.py pcl_floater_generate [pcl_floater_picture on_virtual_display.sh]
Without the last two, the tests of pcl_floater_picture are skipped.
"""

import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

GENERATE, PICTURE, ON_DISPLAY = (sys.argv[1:] + ["", ""])[:3]
draws = unittest.skipUnless(PICTURE, "pcl_floater_picture or Xvfb is missing")

SQUARE = ("# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
          "0 0 0\n1 0 0\n1 1 0\n0 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\n")
SQUARE_PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n")
NO_MESH = SQUARE[:SQUARE.index("POLYGONS")]


class Tools(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)

    def path(self, name):
        return os.path.join(self.temporary.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def check(self, code, *command, says=""):
        """Runs a command; checks its exit code, its message, and that no temporary file is left."""
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1800)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(says, done.stdout + done.stderr)
        self.assertFalse([name for name in os.listdir(self.temporary.name) if "tmp" in name])
        return done

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

    def test_generate_refuses_bad_command_lines(self):
        cloud = self.path("a.pcd")
        self.check(1, GENERATE, says="required")
        self.check(1, GENERATE, "torus", says="required")
        self.check(1, GENERATE, "cube", cloud, says="cube")
        self.check(1, GENERATE, "torus", self.path("a.xyz"), says=".pcd or .ply")
        self.check(1, GENERATE, "torus", cloud, "--size", "3", says="--size")
        self.check(1, GENERATE, "torus", cloud, "--points", "-5", says="--points")
        self.check(1, GENERATE, "torus", cloud, "--points", "many", says="--points")
        self.check(1, GENERATE, "torus", cloud, "--noise", "-1", says="noise")
        self.assertFalse(os.path.exists(cloud))
        self.check(0, GENERATE, "--help", says="Exit codes")

    def test_generate_tells_where_it_cannot_write(self):
        self.check(4, GENERATE, "torus", self.path("no/a.pcd"), says="no/a.pcd")
        os.mkdir(self.path("folder.pcd"))
        self.check(4, GENERATE, "torus", self.path("folder.pcd"), says="folder.pcd")

    def picture(self, code, *arguments, says=""):
        self.check(code, ON_DISPLAY, PICTURE, *arguments, says=says)

    def pixels(self, name):
        """Width and height of a picture, and the number of different bytes in it: few if blank."""
        data = self.read(name)
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])
        packed, at = b"", 8
        while at < len(data):
            length = struct.unpack(">I", data[at:at + 4])[0]
            if data[at + 4:at + 8] == b"IDAT":
                packed += data[at + 8:at + 8 + length]
            at += length + 12
        return width, height, len(set(zlib.decompress(packed)))

    @draws
    def test_picture_draws_one_or_two_panels(self):
        mesh = self.write("square.vtk", SQUARE)
        self.picture(0, mesh, self.path("one.png"), "--height", "100")
        width, height, values = self.pixels("one.png")
        self.assertEqual((width, height), (100, 100))
        self.assertGreater(values, 16)
        self.picture(0, mesh, mesh, self.path("two.png"), "--height", "100")
        self.assertEqual(self.pixels("two.png")[:2], (200, 100))

    @draws
    def test_picture_is_seen_from_a_viewpoint(self):
        mesh = self.write("square.vtk", SQUARE)
        for name, viewpoint in (("front.png", "0.5,0.5,3"), ("back.png", "0.5,0.5,-3")):
            self.picture(0, mesh, self.path(name), "--height", "100", "--flat", "--viewpoint", viewpoint)
            self.assertGreater(self.pixels(name)[2], 2)
        self.assertNotEqual(self.read("front.png"), self.read("back.png"))
        self.picture(1, mesh, self.path("none.png"), "--viewpoint", "0.5,0.5", says="--viewpoint")

    @draws
    def test_picture_draws_textures(self):
        vtk = self.write("square.vtk", SQUARE + "POINT_DATA 4\nTEXTURE_COORDINATES TCoords 2 float\n"
                                                "0 0\n1 0\n1 1\n0 1\n")
        ply = self.write("square.ply", SQUARE_PLY)
        for mesh, name in ((vtk, "vtk.png"), (ply, "ply.png")):
            self.picture(0, mesh, self.path(name), "--checkerboard", "--height", "200")
            width, height, values = self.pixels(name)
            self.assertEqual((width, height), (400, 200))
            self.assertGreater(values, 40)
        self.assertEqual(self.read("vtk.png"), self.read("ply.png"))
        # A picture is an image as any other.
        self.picture(0, vtk, self.path("again.png"), "--texture", self.path("vtk.png"), "--height", "200")
        self.assertNotEqual(self.read("again.png"), self.read("vtk.png"))
        out = self.path("out.png")
        plain = self.write("plain.vtk", SQUARE)
        self.picture(2, plain, out, "--checkerboard", says="has no texture coordinates")
        self.picture(2, vtk, out, "--texture", vtk, says="no PNG file")
        self.picture(1, vtk, out, "--texture", self.path("vtk.png"), "--checkerboard", says="--checkerboard")
        self.picture(1, vtk, plain, out, "--checkerboard", says="not both")
        self.assertFalse(os.path.exists(out))

    @draws
    def test_picture_refuses_what_is_not_a_mesh(self):
        mesh, out = self.write("square.vtk", SQUARE), self.path("out.png")
        self.picture(1, mesh, says="required")
        self.picture(1, mesh, out, "--height", "0", says="--height")
        self.picture(2, self.path("none.vtk"), out, says="none.vtk")
        self.picture(2, self.write("no_mesh.vtk", NO_MESH), out, says="no_mesh.vtk")
        self.picture(2, self.write("mesh.stl", "solid"), out, says="mesh.stl")
        self.picture(2, mesh, self.path("none.ply"), out, says="none.ply")
        self.assertFalse(os.path.exists(out))

    @draws
    def test_picture_tells_where_it_cannot_draw_or_write(self):
        mesh = self.write("square.vtk", SQUARE)
        self.check(3, PICTURE, mesh, self.path("out.png"), says="display")
        self.picture(4, mesh, self.path("no/out.png"), says="no/out.png")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
