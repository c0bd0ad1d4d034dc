# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""pcl_floater_distributed in a folder of its own, and clouds for it."""
import math
import os
import random
import shutil
import struct

from conftest import GENERATE, OK, TOOL, Tool
from files import ply_bytes, sample_of

DISTRIBUTED, MPIRUN = (os.environ.get("PCL_FLOATER_" + name, "") for name in ("DISTRIBUTED", "MPIRUN"))
IS_LONG = "PCL_FLOATER_LONG" in os.environ  # all pairs of processes and blocks, all clouds, 20 moments
STEPS = ["neighbors", "planes", "stars"]
WORK = 7  # exit code


def mpirun(processes, *more):
    """Open MPI does not bind, so that processes of several tests do not share a core."""
    return [MPIRUN, "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", *more, "-n", processes]


def ply(points):
    return ply_bytes(sample_of(points), is_plain=True)


def terrain_points(count, seed=1):
    """Hills with boxes on them, points strewn above and far away, and some that are no numbers or
    repeated."""
    numbers = random.Random(seed)
    side = math.sqrt(count)
    points = []
    for _ in range(count):
        x, y = side * numbers.random(), side * numbers.random()
        z = 3.0 * math.sin(0.11 * x) + 2.0 * math.cos(0.07 * y)
        if int(x / 15) % 3 == 1 and int(y / 15) % 3 == 1:
            z += 12.0
        points.append((x, y, z))
    for _ in range(count // 200):
        points.append((side * numbers.random(), side * numbers.random(), 30.0 + 20.0 * numbers.random()))
    points += points[:20]
    points[5] = (math.nan, 0.0, 0.0)
    points.append((1e9, 1e9, 1e9))
    return points


class Work(Tool):
    """With a work folder. The names of files are those in the folder of the test."""

    def ok(self, command, **more):
        return self.expect(command, OK, **more)

    def command(self, *arguments, work="work"):
        return [DISTRIBUTED, "--work", work, *arguments]

    def step(self, *arguments):
        return self.command("--step", *arguments)

    def generate(self, kind, *options, name="cloud.ply"):
        self.ok([GENERATE, kind, name, *options])
        return name

    def terrain(self, count):
        return self.write("terrain.ply", ply(terrain_points(count)))

    def reference(self, cloud, *options):
        """The mesh that pcl_floater_reconstruct makes."""
        self.ok([TOOL, "-q", *options, cloud, "reference.ply"])
        return self.read("reference.ply")

    def expect_same(self, expected, clouds, processes, blocks, *options):
        """Returns what the program told."""
        shutil.rmtree(self.path("work"), ignore_errors=True)
        self.path("mesh.ply").unlink(missing_ok=True)
        start = mpirun(processes) if processes > 1 else []
        outcome = self.ok(start + self.command("--blocks", blocks, *options, *clouds, "mesh.ply"))
        assert self.read("mesh.ply") == expected, f"another mesh on {processes} processes in {blocks} blocks"
        return outcome.stderr

    def plan(self, cloud, blocks=3):
        self.ok(self.step("plan", "--blocks", blocks, cloud, "mesh.ply"))

    def printed_steps(self):
        """Groups of commands; those of a group can run in any order, and are in the reverse one here."""
        groups = self.ok(self.command("--print-steps")).stdout.rstrip("\n").split("\n\n")
        commands = [[line.replace("'", "").split() for line in reversed(group.split("\n"))] for group in groups]
        assert {command[0] for group in commands for command in group} == {"pcl_floater_distributed"}
        return [[[DISTRIBUTED, *command[1:]] for command in group] for group in commands]

    def limited(self, kilobytes, *arguments):
        """With a limit on the size of files, by which writing fails as on a full disk."""
        return ["sh", "-c", f"ulimit -f {2 * kilobytes}; exec \"$@\"", "sh", *self.command(*arguments)]

    def work_files(self):
        """The names of the files in the work folder, and when each was written."""
        return {file.name: (file.stat().st_mtime_ns, file.stat().st_ino) for file in self.path("work").iterdir()}


def flipped(data, at, mask=1):
    """The bytes with bits of one of them turned over."""
    return data[:at] + bytes([data[at] ^ mask]) + data[at:][1:]


def array_table(data):
    """Name, size of an element, number and offset of the arrays of a file."""
    table = data[40:40 + 48 * struct.unpack_from("<I", data, 12)[0]]
    return [(name.rstrip(b"\0").decode(), *more) for name, *more in struct.iter_unpack("<24sQQQ", table)]
