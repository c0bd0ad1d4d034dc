#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a reconstructed mesh in pcl_viewer, on a virtual display, and looks for it on the screen.

Usage: open_in_viewer.py pcl_floater_generate pcl_floater_reconstruct
"""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

POINTS = 2500  # the height field is then 50 units wide
CAMERA = "1,500/25,25,0/25,25,120/0,1,0/0.5236/600,500/0,0"  # straight down on its middle
WINDOW = (600, 500)
SCREEN = "800x600x24"
SECONDS = 60  # longest wait for anything on the screen
SETTLED = 2.0  # from the first thing on the screen to the control's measurement
MIDDLE = 0.25  # part of the window's width and height that the mesh must fill
FILLED = 0.99  # fraction of the pixels in the middle
EMPTY = 0.01


class Failure(Exception):
    pass


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{command[0]} exited with {done.returncode}: {done.stderr}")


def write_points_only(path):
    """Writes a file without triangles, as a control."""
    with open(path, "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\nno mesh\nASCII\nDATASET POLYDATA\n"
                   "POINTS 3 float\n0 0 0\n50 0 0\n50 50 0\n")


class Display:
    """A virtual X server; its screen is a file in the format of xwd."""

    def __init__(self, folder):
        if shutil.which("Xvfb") is None:
            raise Failure("Xvfb is missing; tools/install_packages.sh --tests installs it")
        self.framebuffer = os.path.join(folder, "Xvfb_screen0")
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", SCREEN, "-fbdir", folder,
             "-nolisten", "tcp"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise Failure("Xvfb did not start")
        self.name = ":" + number

    def close(self):
        self.server.terminate()
        self.server.wait()

    def rows(self):
        """Pixels of the window as rows of (blue, green, red, unused) bytes."""
        with open(self.framebuffer, "rb") as file:
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        header_size, bits_per_pixel, row_bytes, colours = (header[0], header[11], header[12],
                                                           header[19])
        if bits_per_pixel != 32:
            raise Failure(f"unexpected format of the screen: {bits_per_pixel} bits per pixel")
        first = header_size + 12 * colours
        width, height = WINDOW
        return [data[first + y * row_bytes:first + y * row_bytes + 4 * width]
                for y in range(height)]


def lit_share(rows):
    """Fraction of the pixels that are not black."""
    pixels = lit = 0
    for row in rows:
        for x in range(0, len(row), 4):
            pixels += 1
            lit += any(row[x:x + 3])
    return lit / pixels


def middle(rows):
    width, height = WINDOW
    x, y = int(width * (1 - MIDDLE) / 2), int(height * (1 - MIDDLE) / 2)
    return [row[4 * x:4 * (width - x)] for row in rows[y:height - y]]


def view(path, finished):
    """Shows a file until finished(rows, seconds since something appeared) is true.

    Returns the fraction of lit pixels in the middle of the window.
    """
    with tempfile.TemporaryDirectory() as folder:
        display = Display(folder)
        viewer = subprocess.Popen(["pcl_viewer", path, "-cam", CAMERA],
                                  env=dict(os.environ, DISPLAY=display.name, HOME=folder),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            start = time.monotonic()
            appeared = None
            while time.monotonic() - start < SECONDS:
                if viewer.poll() is not None:
                    raise Failure(f"pcl_viewer ended by itself with {viewer.returncode}")
                rows = display.rows()
                if appeared is None and lit_share(rows) > 0:
                    appeared = time.monotonic()
                if appeared is not None and finished(rows, time.monotonic() - appeared):
                    break
                time.sleep(0.2)
            if appeared is None:
                raise Failure(f"pcl_viewer drew nothing within {SECONDS} seconds")
            return lit_share(middle(display.rows()))
        finally:
            viewer.kill()
            viewer.wait()
            display.close()


def main():
    if len(sys.argv) != 3:
        raise Failure(__doc__)
    generate, reconstruct = sys.argv[1:]
    if shutil.which("pcl_viewer") is None:
        raise Failure("pcl_viewer is missing; tools/install_packages.sh --tests installs it")
    with tempfile.TemporaryDirectory() as folder:
        cloud, mesh, control = (os.path.join(folder, name)
                                for name in ("cloud.pcd", "mesh.vtk", "control.vtk"))
        run(generate, "height-field", cloud, "--points", str(POINTS))
        run(reconstruct, "--quiet", cloud, mesh)
        write_points_only(control)

        share = view(mesh, lambda rows, seconds: lit_share(middle(rows)) >= FILLED)
        print(f"mesh: {share:.3f} of the window's middle is filled")
        if share < FILLED:
            raise Failure("the mesh is not on the screen")
        # The same measurement must fail where there is no mesh.
        share = view(control, lambda rows, seconds: seconds > SETTLED)
        print(f"control without a mesh: {share:.3f}")
        if share > EMPTY:
            raise Failure("the screen is not empty without a mesh: the measurement means nothing")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"open_in_viewer.py: {failure}")
