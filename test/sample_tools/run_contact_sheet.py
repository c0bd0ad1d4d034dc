#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs contact_sheet.py on a cloud that is reconstructed and one that is refused.

Usage: run_contact_sheet.py pcl_floater_generate contact_sheet.py BUILD_FOLDER
"""

import os
import struct
import subprocess
import sys
import tempfile
import unittest

GENERATE, CONTACT_SHEET, BUILD = sys.argv[1:4]


class ContactSheet(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = self.temporary.name

    def run_script(self, *clouds, **environment):
        return subprocess.run([CONTACT_SHEET, "--build", BUILD, *clouds], cwd=self.folder,
                              env={**os.environ, **environment}, capture_output=True, text=True, timeout=1800)

    def test_shows_a_mesh_and_the_reason_for_none(self):
        data = os.path.join(self.folder, "data")
        os.mkdir(data)
        subprocess.run([GENERATE, "height-field", os.path.join(data, "good.pcd"), "--points", "500"],
                       check=True, capture_output=True)
        with open(os.path.join(data, "line.pcd"), "w", encoding="ascii") as file:
            file.write("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 30\n"
                       "HEIGHT 1\nPOINTS 30\nDATA ascii\n")
            file.writelines(f"{i} 0 0\n" for i in range(30))
        done = self.run_script(PCL_FLOATER_DATA=data)
        self.assertEqual(done.returncode, 0, done.stderr)
        good, line = done.stdout.index("good\n"), done.stdout.index("line\n")
        self.assertLess(good, line)
        self.assertIn("500 points", done.stdout[good:line])
        self.assertIn("1 component, 1 loop, genus 0, 0 folds", done.stdout[good:line])
        self.assertIn("DEGENERATE", done.stdout[line:])
        with open(os.path.join(self.folder, "floater_result", "contact_sheet.png"), "rb") as file:
            picture = file.read()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", picture[16:24])
        self.assertGreater(min(width, height), 400)
        self.assertGreater(len(picture), 10000)

    def test_tells_what_it_cannot_read(self):
        done = self.run_script("none.pcd")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("none.pcd", done.stderr)


if __name__ == "__main__":
    # contact_sheet.py is run by this interpreter of Debian.
    needed = subprocess.run(["/usr/bin/python3", "-c", "import matplotlib, numpy, scipy"], stderr=subprocess.DEVNULL)
    if needed.returncode != 0:
        print("NumPy, SciPy or Matplotlib is missing")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
