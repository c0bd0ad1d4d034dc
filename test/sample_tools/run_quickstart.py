#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs quickstart.sh as a user would, but with programs that are built already.

Usage: run_quickstart.py quickstart.sh BUILD_FOLDER
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT, BUILD = sys.argv[1:]
POINTS_OF_SAMPLE = 10429


class Quickstart(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        self.result = os.path.join(self.folder, "floater_result")

    def check(self, code, *arguments, says=""):
        """Runs the script; checks its exit code and what it says."""
        done = subprocess.run([SCRIPT, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=1800)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(says, done.stdout + done.stderr)
        return done.stdout

    def files(self):
        return set(os.listdir(self.result)) if os.path.isdir(self.result) else set()

    def report(self):
        with open(os.path.join(self.result, "report.json"), encoding="utf-8") as file:
            return json.load(file)

    def write_sheet(self):
        """A cloud of its own: 30 x 30 points of a wavy sheet."""
        path = os.path.join(self.folder, "sheet.obj")
        with open(path, "w", encoding="ascii") as file:
            for i in range(900):
                x, y = i % 30, i // 30
                file.write(f"v {x} {y} {0.3 * ((x * x + 3 * y) % 7) / 7}\n")
        return path

    def points(self):
        """Number of points of the mesh."""
        with open(os.path.join(self.result, "mesh.vtk"), "rb") as file:
            return int(re.search(rb"^POINTS (\d+) ", file.read(), re.MULTILINE)[1])

    def test_clouds_take_the_place_of_each_other(self):
        said = self.check(0, "--build", BUILD, says="tum_rabbit.pcd")
        made = {"mesh.vtk", "report.json", "picture.png"}
        self.assertEqual(self.files(), made)
        for name in made:
            self.assertIn(name, said)
            self.assertGreater(os.path.getsize(os.path.join(self.result, name)), 1000)
        self.assertEqual(self.points(), POINTS_OF_SAMPLE)
        report = self.report()
        self.assertEqual(report["warnings"], [])
        check = report["check"]
        self.assertEqual((check["components"], len(check["loops"]), check["genus"]), (1, 1, 0))

        self.check(0, self.write_sheet(), "--build", BUILD, says="sheet.obj")
        self.assertEqual(self.files(), made)
        self.assertEqual(self.points(), 900)
        self.assertIn("sheet.obj", json.dumps(self.report()["input"]))

        broken = os.path.join(self.folder, "broken.pcd")
        with open(broken, "w", encoding="ascii") as file:
            file.write("no cloud\n")
        self.check(2, "--build", BUILD, broken, says="broken.pcd")
        self.assertEqual(self.files(), set())  # nothing of an earlier cloud

    def test_wrong_command_lines_are_refused(self):
        self.check(0, "--help", says="Usage")
        self.check(1, "--unknown", says="Usage")
        self.check(1, "a.pcd", "b.pcd", says="Usage")
        self.check(1, "--build", says="needs a folder")
        self.check(1, "", says="name of the cloud is empty")
        self.check(1, self.folder, says="cannot read")
        self.check(1, os.path.join(self.folder, "none.pcd"), says="none.pcd")
        self.assertEqual(self.files(), set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
