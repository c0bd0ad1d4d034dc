#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""pcl_floater_distributed makes the same mesh as pcl_floater_reconstruct, whatever the processes, the
blocks, and the moments at which it is ended; and tells what is wrong with its files.

--long: all pairs of processes and blocks, all clouds of PCL_FLOATER_DATA, 20 moments."""
import argparse
import contextlib
import ctypes
import json
import math
import os
import pathlib
import random
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

OPTIONS = argparse.Namespace()
USAGE, INPUT, RECONSTRUCTION, OUTPUT, WORK = 1, 2, 3, 4, 7
STEPS = ["neighbors", "planes", "stars"]


def run(command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          timeout=1800, **more)


def mpirun(processes, *more):
    """Open MPI does not bind, so that processes of several tests do not share a core."""
    return [OPTIONS.mpirun, "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", *more, "-n",
            processes]


def write_ply(path, points, more=()):
    fields = ["x", "y", "z", *more]
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n" +
              "".join(f"property float {field}\n" for field in fields) + "end_header\n")
    path.write_bytes(header.encode() + b"".join(struct.pack(f"<{len(fields)}f", *p) for p in points))
    return path


def write_scan(path):
    """A depth camera at the origin: a wavy wall, and a ball before it."""
    points = []
    for v in range(70):
        for u in range(90):
            x, y = (u - 45) / 80.0, (v - 35) / 80.0
            z = 3.0 + 0.2 * math.sin(5 * x) * math.cos(4 * y)
            if x * x + y * y < 0.04:
                z = 1.5 - math.sqrt(0.09 - 2.0 * (x * x + y * y))
            points.append((x * z, y * z, z))
    header = ("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 90\n"
              f"HEIGHT 70\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n")
    path.write_bytes(header.encode() + b"".join(struct.pack("<3f", *p) for p in points))
    return path


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


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pcl_floater_distributed."))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return self.folder / name

    def ok(self, command, **more):
        outcome = run(command, **more)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return outcome

    def generate(self, kind, *options, name="cloud.ply"):
        self.ok([OPTIONS.generate, kind, self.path(name), *options])
        return self.path(name)

    def terrain(self, count):
        return write_ply(self.path("terrain.ply"), terrain_points(count))

    def reference(self, cloud, *options):
        mesh = self.path("reference.ply")
        self.ok([OPTIONS.reconstruct, "-q", *options, cloud, mesh])
        return mesh.read_bytes()

    def command(self, *arguments, work="work"):
        return [OPTIONS.distributed, "--work", self.path(work), *arguments]

    def expect_same(self, expected, clouds, processes, blocks, *options):
        """Returns what the program told."""
        shutil.rmtree(self.path("work"), ignore_errors=True)
        mesh = self.path("mesh.ply")
        mesh.unlink(missing_ok=True)
        start = mpirun(processes) if processes > 1 else []
        outcome = self.ok(start + self.command("--blocks", blocks, *options, *clouds, mesh))
        self.assertTrue(mesh.read_bytes() == expected, f"another mesh on {processes} processes in {blocks} blocks")
        return outcome.stderr

    def expect_failure(self, outcome, code, *words):
        self.assertEqual(outcome.returncode, code, outcome.stderr)
        for word in words:
            self.assertIn(word, outcome.stderr)

    def plan(self, cloud, blocks=3):
        self.ok(self.command("--step", "plan", "--blocks", blocks, cloud, self.path("mesh.ply")))

    def step(self, *arguments):
        return run(self.command("--step", *arguments))

    def steps_of_blocks(self):
        """All that is done before the blocks are joined."""
        for step in STEPS:
            for block in range(3):
                self.ok(self.command("--step", step, "--block", block))
            if step == "neighbors":
                self.ok(self.command("--step", "outliers"))

    def printed_steps(self):
        """Groups of commands; those of a group can run in any order, and are in the reverse one here."""
        groups = self.ok(self.command("--print-steps")).stdout.rstrip("\n").split("\n\n")
        commands = [[line.replace("'", "").split() for line in reversed(group.split("\n"))] for group in groups]
        self.assertEqual({command[0] for group in commands for command in group}, {"pcl_floater_distributed"})
        return [[[OPTIONS.distributed, *command[1:]] for command in group] for group in commands]

    def limited(self, kilobytes, *arguments):
        """Runs with a limit on the size of files, by which writing fails as on a full disk."""
        return run(["sh", "-c", f"ulimit -f {2 * kilobytes}; exec \"$@\"", "sh", *self.command(*arguments)])

    def submit(self, *arguments):
        """Runs submit.sh with an sbatch that runs each job at once. Returns the number of tasks of each
        step."""
        sbatch = self.path("bin") / "sbatch"
        sbatch.parent.mkdir()
        sbatch.write_text("""#!/usr/bin/env bash
set -euo pipefail
tasks=(0)
while (($# > 0)); do
  case "$1" in
    --parsable) ;;
    --dependency=afterok:*) [[ ${1##*:} == "$(cat last)" ]] ;;
    --array=*) range=${1#--array=}; mapfile -t tasks < <(seq "${range%%-*}" "$(cut -d- -f2 <<<"${range%%\\%*}")") ;;
    --wrap) command=$2; shift ;;
    *) exit 1 ;;
  esac
  shift
done
for SLURM_ARRAY_TASK_ID in "${tasks[@]}"; do
  export SLURM_ARRAY_TASK_ID
  sh -c "$command" >&2
  sed 's/.*--step \\([a-z]*\\).*/\\1/' <<<"$command" >>tasks
done
echo "$RANDOM" | tee last
""")
        sbatch.chmod(0o755)
        tools = pathlib.Path(OPTIONS.distributed).resolve().parent
        script = pathlib.Path(__file__).resolve().parent / "submit.sh"
        self.ok([script, self.path("work"), *arguments], cwd=self.folder,
                env=dict(os.environ, PATH=f"{sbatch.parent}:{tools}:{os.environ['PATH']}"))
        steps = self.path("tasks").read_text().split()
        return {step: steps.count(step) for step in steps}


def xxhash(data, seed=0):
    hashed = ctypes.CDLL("libxxhash.so.0").XXH3_64bits_withSeed
    hashed.restype, hashed.argtypes = ctypes.c_uint64, (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64)
    return hashed(data, len(data), seed)


def forge(file, array, value):
    """Sets the first number of 32 bits of an array, and makes its checksum right."""
    data = bytearray(file.read_bytes())
    table = slice(40, 40 + 48 * struct.unpack_from("<I", data, 12)[0])
    for name, element, count, offset in struct.iter_unpack("<24sQQQ", bytes(data[table])):
        if name.rstrip(b"\0").decode() == array and count > 0:
            struct.pack_into("<I", data, offset, value)
            end = offset + min(element * count, 16384)
            struct.pack_into("<Q", data, end, xxhash(bytes(data[offset:end])))
    file.write_bytes(data)


class Surfaces(Case):
    PAIRS = [(1, 5), (2, 5), (3, 64), (7, 5), (1, 64), (2, 64), (3, 5), (7, 64)]

    def test_surfaces(self):
        numbers = random.Random(4)
        bush = [tuple(20.0 + 10.0 * numbers.random() for _ in range(3)) for _ in range(2000)]
        rows = [(0.1 * i + 0.02 * numbers.random(), 1.5 * j, 0.3 * math.sin(0.1 * i))
                for i in range(400) for j in range(15)]
        few = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0.1), (2, 1, 0)]
        height_field = ("height-field", "--points", 9000)
        for cloud, pairs, *options in [
                (self.generate("torus", "--points", 9000, name="torus.ply"), self.PAIRS[:4]),
                (self.generate(*height_field, "--density-ratio", 60, name="uneven.ply"), [(3, 5)]),
                (self.generate(*height_field, "--noise", 0.2, name="weak_noise.ply"), [(2, 64)]),
                (self.generate("sphere", "--points", 9000, "--noise", 0.6, name="noise.ply"), [(2, 5)]),
                (self.generate("folded-sheet", "--points", 9000, "--gap", 2, name="sheets.ply"), [(2, 5)]),
                (self.generate("hemisphere", "--points", 600, name="empty_blocks.ply"), [(3, 64)]),
                (write_ply(self.path("few.ply"), few), [(2, 3)]),
                (self.terrain(9000), [(2, 5), (3, 64)]),
                (self.terrain(9000), [(2, 5)], "--remove-outliers", "off", "-k", "6", "--holes", "close-all",
                 "--normals"),
                (write_ply(self.path("bush.ply"), terrain_points(6000) + bush), [(2, 5)], "--scatter", "drop"),
                (write_ply(self.path("rows.ply"), rows), [(2, 5)]),
                (write_scan(self.path("scan.pcd")), [(2, 5)])]:
            expected = self.reference(cloud, *options)
            for processes, blocks in self.PAIRS if OPTIONS.long else pairs:
                with self.subTest(cloud=cloud.name, processes=processes, blocks=blocks):
                    self.expect_same(expected, [cloud], processes, blocks, *options)

    def test_real_clouds(self):
        data = os.environ.get("PCL_FLOATER_DATA", "")
        if not os.path.isdir(data):
            self.skipTest(f"there is no folder of real clouds: PCL_FLOATER_DATA is '{data}'")
        names = ["raw_milk", "raw_sparse_cat"]
        clouds = sorted(pathlib.Path(data).glob("*.pcd")) if OPTIONS.long else [
            pathlib.Path(data) / f"{name}.pcd" for name in names]
        for cloud in clouds:
            with self.subTest(cloud=cloud.name):
                self.expect_same(self.reference(cloud), [cloud], 2, 9)

    def test_common_fields_of_tiles_stay(self):
        text = ("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                "property double z\n{}property uchar red\nproperty uchar green\nproperty uchar blue\n"
                "end_header\n{}")
        rows = [f"{x + 0.1 * (y % 2)} {y} {0.01 * x * x}" for x in range(20) for y in range(20)]

        def write(name, first, last, extra=""):
            lines = "\n".join(f"{rows[i]}{' 1' if extra else ''} {i % 256} 7 9" for i in range(first, last))
            self.path(name).write_text(text.format(last - first, extra, lines + "\n"))
            return self.path(name)

        expected = self.reference(write("all.ply", 0, 400))
        tiles = [write("a.ply", 0, 150, "property int label\n"), write("b.ply", 150, 400)]
        self.assertIn("'label' was left out", self.expect_same(expected, tiles, 1, 2))


def read_ply(path):
    """Names and types of the vertices' properties, the bytes of each vertex, and the triangles."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    sizes = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}
    counts, properties = {}, []
    for words in map(str.split, data[:end].decode().splitlines()):
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            properties.append((words[2], words[1]))
    width = sum(sizes[kind] for _, kind in properties)
    vertices = [data[end + i * width:end + (i + 1) * width] for i in range(counts["vertex"])]
    faces = data[end + counts["vertex"] * width:]
    assert len(faces) == 13 * counts["face"]
    triangles = []
    for count, *corners in struct.iter_unpack("<B3i", faces):
        assert count == 3
        triangles.append(tuple(corners))
    return properties, vertices, triangles


class TileFiles(Case):
    """--tiles. Joined by the numbers of their vertices, the tiles are the mesh in one piece."""

    def read_tiles(self, folder):
        manifest = json.loads((folder / "tiles.json").read_text())
        tiles = []
        for entry in manifest["tiles"]:
            data = (folder / entry["file"]).read_bytes()
            self.assertEqual(len(data), entry["bytes"])
            self.assertEqual(f"{zlib.crc32(data):08x}", entry["crc32"])
            properties, vertices, triangles = read_ply(folder / entry["file"])
            self.assertEqual(properties[-1], ("vertex_number", "double"))
            numbers = [int(struct.unpack("<d", vertex[-8:])[0]) for vertex in vertices]
            tiles.append((properties[:-1], [vertex[:-8] for vertex in vertices], numbers, triangles))
        return manifest, tiles

    def expect_tiles(self, folder, expected, count):
        """Compares all of a folder with the mesh in one piece. Returns the manifest and, of each tile, the
        numbers of its own points."""
        manifest, tiles = self.read_tiles(folder)
        self.path("expected.ply").write_bytes(expected)
        properties, vertices, triangles = read_ply(self.path("expected.ply"))
        self.assertEqual(sorted(f.name for f in folder.iterdir()),
                         sorted([f"tile.{i}.ply" for i in range(count)] + ["tiles.json"]))
        self.assertEqual((manifest["points"], manifest["triangles"]), (len(vertices), len(triangles)))
        self.assertEqual(len(tiles), count)
        owner = {}
        for i, (entry, (own_properties, records, numbers, _)) in enumerate(zip(manifest["tiles"], tiles)):
            self.assertEqual(own_properties, properties)
            own = entry["own_points"]
            self.assertEqual(entry["points_before"], len(owner))
            self.assertEqual(len(records), own + entry["border_points"])
            self.assertEqual(sorted(numbers[:own]), numbers[:own])
            for number in numbers[:own]:
                self.assertNotIn(number, owner)
                owner[number] = i
            for number, record in zip(numbers, records):
                self.assertTrue(vertices[number] == record)
        self.assertEqual(sorted(owner), list(range(len(vertices))))
        joined = []
        for i, (entry, (_, _, numbers, local)) in enumerate(zip(manifest["tiles"], tiles)):
            self.assertEqual((entry["triangles"], entry["triangles_before"]), (len(local), len(joined)))
            next_border = entry["own_points"]
            for border in entry["borders"]:
                self.assertEqual(border["first"], next_border)
                next_border += border["points"]
                group = numbers[border["first"]:next_border]
                self.assertEqual(sorted(set(group)), group)
                self.assertEqual({owner[number] for number in group}, {border["tile"]})
                self.assertNotEqual(border["tile"], i)
            self.assertEqual(next_border, len(numbers))
            whole = [tuple(numbers[corner] for corner in triangle) for triangle in local]
            self.assertEqual({owner[min(triangle)] for triangle in whole} - {i}, set())
            used = {number for triangle in whole for number in triangle}
            self.assertEqual([n for n in numbers[entry["own_points"]:] if n not in used], [])
            joined += whole
        self.assertTrue(sorted(joined) == sorted(triangles), "other triangles")
        return manifest, [[n for n in range(len(vertices)) if owner[n] == i] for i in range(count)]

    def write_tiles(self, *arguments, folder="tiles"):
        self.ok(mpirun(2) + self.command("--tiles", *arguments, self.path(folder)))

    def test_a_tile_for_each_file(self):
        points = terrain_points(8000)
        expected = self.reference(write_ply(self.path("all.ply"), points), "--normals")
        cuts = [0, 100, 100 + 3000, len(points)]
        inputs = [self.path(f"part{i}.ply") for i in range(3)]
        for path, first, last in zip(inputs, cuts, cuts[1:]):
            write_ply(path, points[first:last])
        self.write_tiles("--normals", "--blocks", 4, *inputs)
        manifest, own = self.expect_tiles(self.path("tiles"), expected, 3)
        self.assertEqual([entry["input"] for entry in manifest["tiles"]], [str(path) for path in inputs])
        finite = [sum(all(map(math.isfinite, p)) for p in points[:cut]) for cut in cuts]
        self.assertEqual(own, [list(range(*pair)) for pair in zip(finite, finite[1:])])

    def test_a_tile_for_each_block(self):
        cloud = self.terrain(6000)
        expected = self.reference(cloud)
        self.write_tiles("--blocks", 5, cloud)
        manifest, own = self.expect_tiles(self.path("tiles"), expected, 5)
        self.assertEqual({entry["input"] for entry in manifest["tiles"]}, {str(cloud)})
        self.assertGreater(min(map(len, own)), 1000)  # blocks have about the same number of points
        # The same from another work folder, without MPI, on top of others: those that are too many go.
        self.path("more").mkdir()
        for name in ("tile.5.ply", "tile.6.ply"):
            self.path("more").joinpath(name).write_text("of an older run")
        self.ok(self.command("--tiles", "--blocks", 5, cloud, f"{self.path('more')}/", work="other"))
        files = [{f.name: f.read_bytes() for f in self.path(name).iterdir()} for name in ("tiles", "more")]
        self.assertTrue(files[0] == files[1])

    def test_doubles_and_shift_in_more_blocks_than_points(self):
        text = "".join(f"{500000 + x} {5500000 + y} {0.1 * x * y}\n" for x in range(12) for y in range(12))
        self.path("map.xyz").write_text(text)
        options = ("--shift", "500000,5500000,0", "--precision", "double")
        expected = self.reference(self.path("map.xyz"), *options)
        self.write_tiles(*options, "--blocks", 7, self.path("map.xyz"))
        manifest, own = self.expect_tiles(self.path("tiles"), expected, 7)
        self.assertEqual(manifest["shift"], [500000, 5500000, 0])
        self.assertIn(0, map(len, own))

    def test_as_steps_after_the_mesh_and_of_a_tile(self):
        cloud = self.generate("torus", "--points", 3000)
        expected = self.reference(cloud)
        tiles = self.path("tiles")
        self.ok(self.command("--step", "plan", "--tiles", "--blocks", 2, cloud, tiles))
        for group in self.printed_steps():
            for command in group:
                self.ok(command)
        self.expect_tiles(tiles, expected, 2)
        # What is known is enough for the mesh in one piece, and the other way round.
        join = self.path("work").joinpath("mesh.bin").stat().st_mtime_ns
        self.ok(self.command("--blocks", 2, cloud, self.path("mesh.ply")))
        self.assertTrue(self.path("mesh.ply").read_bytes() == expected)
        self.write_tiles("--blocks", 2, cloud, folder="more")
        self.expect_tiles(self.path("more"), expected, 2)
        self.assertEqual(join, self.path("work").joinpath("mesh.bin").stat().st_mtime_ns)
        # A field of the name of the numbers is left out.
        self.ok(self.command("--tiles", "--blocks", 1, cloud, self.path("one"), work="one_block"))
        outcome = self.ok(self.command("--tiles", "--blocks", 2, self.path("one") / "tile.0.ply", self.path("again"),
                                       work="other"))
        self.assertIn("the field 'vertex_number' of the points was left out", outcome.stderr)
        self.expect_tiles(self.path("again"), expected, 2)

    def test_folders_that_cannot_be_used(self):
        cloud = self.generate("torus", "--points", 1000)
        for output, code, words in [("no/such/folder", OUTPUT, "no/such"), ("cloud.ply", OUTPUT, "not a folder"),
                                    ("work", USAGE, "work folder"), ("-", OUTPUT, "cannot write '-'")]:
            with self.subTest(output=output):
                path = output if output == "-" else self.path(output)
                self.expect_failure(run(self.command("--tiles", cloud, path)), code, words)
        self.assertFalse(self.path("work").joinpath("tiles.json").exists())

    def test_full_disk(self):
        """Then there is no manifest, also not that of an older run; and the next run writes all."""
        cloud = self.generate("torus", "--points", 20000)
        self.write_tiles("--blocks", 2, cloud)
        self.expect_failure(self.limited(300, "--step", "write"), OUTPUT, "cannot write", "tile.0.ply")
        self.assertEqual(sorted(f.name for f in self.path("tiles").iterdir()), ["tile.0.ply", "tile.1.ply"])
        self.write_tiles("--blocks", 2, cloud)
        self.expect_tiles(self.path("tiles"), self.reference(cloud), 2)


class Steps(Case):
    def files(self):
        return {f.name: (f.stat().st_mtime_ns, f.stat().st_ino) for f in self.path("work").iterdir()}

    def test_a_run_goes_on_where_steps_ended_and_the_other_way_round(self):
        cloud = self.generate("torus", "--points", 3000)
        expected, mesh = self.reference(cloud), self.path("mesh.ply")
        self.plan(cloud)
        groups = self.printed_steps()
        self.assertEqual([len(group) for group in groups], [3, 1, 3, 3, 1, 1])
        for command in groups[0][:2]:
            self.ok(command)
        before = self.files()
        outcome = self.ok(mpirun(2) + self.command("--blocks", 3, cloud, mesh))
        self.assertIn("neighbors: 1 blocks done, 2 finished before", outcome.stderr)
        after = self.files()
        self.assertEqual(before, {name: after[name] for name in before})
        self.assertTrue(mesh.read_bytes() == expected)
        mesh.unlink()
        for group in groups:  # there is nothing left to do but to write
            for command in group:
                self.ok(command)
        self.assertTrue(mesh.read_bytes() == expected)
        self.assertEqual(after, self.files())

    def test_report_and_memory_limit(self):
        cloud = self.generate("torus", "--points", 30000)
        outcome = self.ok(self.command("-q", "--max-memory", "150M", "--report", self.path("report.json"), cloud,
                                       self.path("mesh.ply")))
        self.assertEqual(outcome.stdout, "")
        self.assertNotIn("pcl_floater", outcome.stderr)  # MPI may have something to say of the machine
        self.assertIn('"status": "SUCCESS"', self.path("report.json").read_text())
        self.assertTrue(self.path("mesh.ply").read_bytes() == self.reference(cloud))


class Trimming(Case):
    def test_trimmed_and_by_slurm(self):
        cloud = self.generate("cut-out", "--points", 14000, "--holes", 2)
        trimming = ("--min-component", 7500, "--max-edge-ratio", 4)
        tasks = self.submit("--blocks", 3, *trimming, cloud, self.path("mesh.ply"))
        self.assertEqual(tasks, {"neighbors": 3, "outliers": 1, "planes": 3, "stars": 3, "join": 1, "write": 1})
        self.assertTrue(self.path("mesh.ply").read_bytes() == self.reference(cloud, *trimming))


class Disk(Case):
    def test_files_of_blocks_go(self):
        """Also with messages, and if the join reads the files in part, or not at all."""
        for name, processes, options, cloud in [
                ("torus", 1, [], self.generate("torus", "--points", 5000)),
                ("messages", 2, ["--exchange", "messages"], self.path("cloud.ply")),
                ("noise", 1, [], self.generate("torus", "--points", 5000, "--noise", 0.4, name="noise.ply")),
                ("scan", 1, [], write_scan(self.path("scan.pcd")))]:
            with self.subTest(name=name):
                expected, again = self.reference(cloud), self.path("again.ply")
                self.expect_same(expected, [cloud], processes, 5, "--free-disk", *options)
                left = sorted(f.name for f in self.path("work").iterdir())
                self.assertFalse([file for file in left if file.split(".")[0] in STEPS], left)
                # The mesh is known, so the next run does not make the files of the blocks again.
                outcome = self.ok(self.command("--blocks", 5, *options, cloud, again))
                self.assertNotIn("blocks done", outcome.stderr)
                self.assertTrue(again.read_bytes() == expected)
                self.assertEqual(left, sorted(f.name for f in self.path("work").iterdir()))


class Restart(Case):
    def test_killed_and_started_again(self):
        self.check_killed(self.generate("height-field", "--points", 20000), 6, 4)
        shutil.rmtree(self.path("work"))
        points = 560000 if OPTIONS.long else 14000
        self.check_killed(self.generate("height-field", "--points", points), 3, 3)

    def check_killed(self, cloud, blocks, moments, *options):
        expected = self.reference(cloud, *options)
        mesh = self.path("mesh.ply")
        command = [str(word) for word in mpirun(3) + self.command("--blocks", blocks, *options, cloud, mesh)]
        begin = time.monotonic()
        self.ok(command)
        usual = time.monotonic() - begin
        moments = 20 if OPTIONS.long else moments
        known = {}
        shutil.rmtree(self.path("work"))
        mesh.unlink()
        for i in range(moments):
            if i % 5 == 0:  # else it goes on where the one before was killed
                shutil.rmtree(self.path("work"), ignore_errors=True)
                known = {}
            with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  start_new_session=True) as process:
                try:
                    process.wait(usual * (i + 1) / (moments + 1))
                except subprocess.TimeoutExpired:
                    self.kill_one_of(process, i)
            if not (self.path("work") / "manifest.json").exists():
                continue  # the plan is not finished, and is made again
            files = {f.name: f.stat().st_ino for f in self.path("work").glob("*.bin")}
            for name, inode in known.items():
                self.assertEqual(files.get(name), inode, f"{name} was made again")
            known = files
        self.ok(command)
        self.assertTrue(mesh.read_bytes() == expected)
        for name, inode in known.items():
            self.assertEqual(self.path("work").joinpath(name).stat().st_ino, inode)

    def kill_one_of(self, process, i):
        """Kills one of the processes of the run, or mpirun itself with all."""
        children = [int(child) for child in run(["ps", "-o", "pid=", "--ppid", process.pid]).stdout.split()]
        everything = i % 2 == 0 or not children
        if everything:
            os.killpg(process.pid, signal.SIGKILL)
        for child in children if everything else [children[i % len(children)]]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
        process.wait(60)
        for child in children:
            for _ in range(200):
                if not pathlib.Path(f"/proc/{child}").exists():
                    break
                time.sleep(0.05)


class Errors(Case):
    def setUp(self):
        super().setUp()
        self.cloud = self.generate("torus", "--points", 1000)

    def finish(self, with_mesh=False):
        """All steps. Without the mesh in the work folder, the next run joins the blocks again."""
        self.ok(self.command("--blocks", 3, self.cloud, self.path("mesh.ply")))
        self.path("mesh.ply").unlink()
        if not with_mesh:
            (self.path("work") / "mesh.bin").unlink()

    def again(self, *more):
        return run(self.command("--blocks", 3, *more, self.cloud, self.path("mesh.ply")))

    def expect_no_mesh(self):
        self.assertFalse(self.path("mesh.ply").exists())
        self.assertEqual([f for f in self.folder.iterdir() if f.name.startswith(".")], [])

    def test_wrong_command_lines(self):
        mesh = self.path("mesh.ply")
        for arguments, words in [
                ([self.cloud, mesh], "--work is missing"),
                (["--work", self.path("w"), self.cloud], "one or more files"),
                (["--work", self.path("w"), "--step", "star", self.cloud, mesh], "stars"),
                (["--work", self.path("w"), "--step", "stars"], "--block"),
                (["--work", self.path("w"), "--step", "join", "--block", 1], "--block"),
                (["--work", self.path("w"), "--print-steps", "--step", "join"], "exclude"),
                (["--work", self.path("w"), "-k", "3", self.cloud, mesh], "--neighbors"),
                (["--work", self.path("w"), "-", mesh], "standard input")]:
            self.expect_failure(run([OPTIONS.distributed, *arguments]), USAGE, words)
        self.expect_no_mesh()
        self.plan(self.cloud)
        self.expect_failure(self.step("stars", "--block", 3), USAGE, "numbered from 0")

    def test_input_that_is_missing_or_cannot_be_reconstructed(self):
        missing, mesh = self.path("tile2.ply"), self.path("mesh.ply")
        line = write_ply(self.path("line.ply"), [(i, 0, 0) for i in range(50)])
        for start in ([], mpirun(2)):
            outcome = run(start + self.command(line, mesh))
            self.expect_failure(outcome, RECONSTRUCTION, "on one line")
            self.expect_failure(run(start + self.command(self.cloud, missing, mesh, work="other")), INPUT, str(missing))
            outcome = run(start + self.command(self.cloud, mesh, work="cloud.ply/work"))
            self.expect_failure(outcome, OUTPUT, "work folder")
            outcome = run(start + self.command(self.cloud, "/no/such/folder/mesh.ply", work="third"))
            self.expect_failure(outcome, OUTPUT, "/no/such/folder")
        shutil.rmtree(self.path("work"))
        self.plan(self.cloud)
        self.cloud.unlink()
        self.ok(self.command("--step", "neighbors", "--block", 0))
        self.expect_failure(self.step("join"), INPUT, str(self.cloud))
        self.expect_no_mesh()

    def test_damaged_files(self):
        self.finish()
        for name in ["points.bin", "neighbors.1.bin", "outliers.bin", "stars.2.bin", "manifest.json", "mesh.bin"]:
            if name == "mesh.bin":
                self.assertEqual(self.again().returncode, 0)
                self.path("mesh.ply").unlink()
            file = self.path("work") / name
            good = file.read_bytes()
            places = []
            if name == "points.bin":  # in the head, in the table of arrays, and in each array
                arrays = range(struct.unpack_from("<I", good, 12)[0])
                places = [20] + [40 + 48 * i + 24 for i in arrays]
                places += [struct.unpack_from("<Q", good, 40 + 48 * i + 40)[0] for i in arrays]
            faults = [(good[:len(good) - 3] + bytes([good[-3] ^ 4]) + good[-2:], "damaged"),
                      (good[:len(good) // 2], "truncated"),
                      (good + b"x", "grown"),
                      *((good[:at] + bytes([good[at] ^ 1]) + good[at + 1:], "damaged")
                        for at in places if at < len(good)),
                      (good[:8] + struct.pack("<I", 99) + good[12:], "format version 99"),
                      (b"PLY" + good[3:], "no file of this program"),
                      (b"", "truncated")]
            if name != "points.bin" and not OPTIONS.long:
                # One function reads all files, so every fault is tried on one of them, and one fault on each.
                faults = faults[:1]
            if name == "manifest.json":
                faults = [(good.replace(b'"blocks": 3', b'"blocks": 4'), "damaged"), (good[:100], "damaged"),
                          (b"{}", "damaged"), (good.replace(b"work folder", b"something"), "no manifest"),
                          (re.sub(b'"version": [0-9]+', b'"version": 99', good), "format version 99")]
            for bad, word in faults:
                self.assertNotEqual(good, bad)
                file.write_bytes(bad)
                with self.subTest(name=name, word=word):
                    self.expect_failure(self.again(), WORK, str(file), word)
                    self.expect_no_mesh()
            file.write_bytes(good)
        self.assertEqual(self.again().returncode, 0)

    def test_forged_indices(self):
        self.finish()
        work = self.path("work")
        for name, arrays in [("points.bin", ["cloud_index"]), ("neighbors.1.bin", ["ids"]),
                             ("planes.1.bin", ["beside", "beside.offsets"]),
                             ("stars.1.bin", ["far", "far.offsets", "stars", "stars.offsets"]),
                             ("mesh.bin", ["triangles"])]:
            file = work / name
            if name == "mesh.bin":
                self.assertEqual(self.again().returncode, 0)
            good = file.read_bytes()
            for array in arrays:
                forge(file, array, 0xFFFFFFFE)
                if file.read_bytes() == good:
                    continue  # it has no values
                with self.subTest(name=name, array=array):
                    self.assertEqual(self.again().returncode, WORK)
                file.write_bytes(good)
                if name != "mesh.bin":
                    (work / "mesh.bin").unlink(missing_ok=True)
        self.assertEqual(self.again().returncode, 0)

    def test_files_that_others_can_write(self):
        self.finish()
        self.assertEqual(self.path("work").stat().st_mode & 0o777, 0o700)
        file = self.path("work") / "planes.1.bin"
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        file.chmod(0o620)
        self.expect_failure(self.again(), WORK, str(file), "only this user can write")
        file.chmod(0o600)
        elsewhere = file.rename(self.path("elsewhere.bin"))
        saved = elsewhere.read_bytes()
        file.symlink_to(elsewhere)
        self.expect_failure(self.again(), WORK, str(file), "symbolic link")
        # A link in the place of a file that is written is replaced.
        shutil.rmtree(self.path("work"))
        self.plan(self.cloud)
        (self.path("work") / "neighbors.0.bin").symlink_to(self.path("nothing"))
        self.ok(self.command("--step", "neighbors", "--block", 0))
        self.assertFalse(self.path("nothing").exists())
        self.assertEqual(elsewhere.read_bytes(), saved)

    def test_edited_manifest(self):
        self.finish(with_mesh=True)
        manifest = self.path("work") / "manifest.json"
        plan = json.loads(manifest.read_text())

        def checksum():
            contents = {key: part for key, part in plan.items() if key != "checksum"}
            text = json.dumps(contents, separators=(",", ":"), ensure_ascii=False).encode()
            return xxhash(text)
        self.assertEqual(plan["checksum"], checksum())
        plan["arguments"][-1] = str(self.path("victim.ply"))
        plan["checksum"] = checksum()
        manifest.write_text(json.dumps(plan))
        self.expect_failure(self.step("write"), WORK, "manifest.json")
        self.assertFalse(self.path("victim.ply").exists())

    def test_tile_that_changes_in_its_middle(self):
        self.cloud = self.generate("torus", "--points", 20000)
        self.finish(with_mesh=True)
        with open(self.cloud, "r+b") as file:
            file.seek(self.cloud.stat().st_size // 2)
            file.write(b"\x42\x42\x42\x42")
        self.expect_failure(self.again(), WORK, "input files")
        self.expect_failure(self.step("write"), WORK, "input files")
        self.expect_no_mesh()

    def test_damaged_file_of_a_step(self):
        self.plan(self.cloud)
        self.steps_of_blocks()
        file = self.path("work") / "stars.1.bin"
        saved = file.read_bytes()
        file.write_bytes(saved[:len(saved) // 2] + b"damage" + saved[len(saved) // 2 + 6:])
        outcome = self.step("join")
        self.expect_failure(outcome, WORK, str(file), "damaged", "pcl_floater_distributed: ")
        self.assertNotIn("pcl_floater_reconstruct", outcome.stderr)

    def test_names(self):
        name = "a'; touch PWNED; echo 'b $(c)"
        self.ok(self.command("--step", "plan", "--blocks", 2, self.cloud, self.path("mesh.ply"), work=name))
        lines = self.ok(self.command("--print-steps", work=name)).stdout.split("\n")
        for line in filter(None, lines):
            self.assertEqual(shlex.split(line)[2], str(self.path(name)))
        self.expect_failure(run(self.command("--step", "plan", self.cloud, self.path("m.ply"), work="a\nb")), USAGE,
                            "line break")
        odd = os.fsencode(self.path("odd")) + b"\xff.ply"
        shutil.copy(self.cloud, odd)
        outcome = subprocess.run([os.fsencode(str(word)) for word in self.command("--step", "plan", work="odd")] +
                                 [odd, os.fsencode(self.path("m.ply"))], capture_output=True, check=False)
        self.assertEqual(outcome.returncode, USAGE)
        self.assertIn(b"UTF-8", outcome.stderr)

    def test_file_that_does_not_get_to_the_disk(self):
        """An error of fsync. The file is not there then, and is made again."""
        if not OPTIONS.faults:
            self.skipTest("there is no library that makes calls of the system fail")
        self.plan(self.cloud)
        broken = dict(os.environ, LD_PRELOAD=OPTIONS.faults, PCL_FLOATER_FAULT="fsync:0:EIO")
        outcome = run(self.command("--step", "neighbors", "--block", 1), env=broken)
        self.expect_failure(outcome, OUTPUT, "cannot write", "neighbors.1.bin")
        self.assertFalse((self.path("work") / "neighbors.1.bin").exists())
        self.ok(self.command("--step", "neighbors", "--block", 1))
        self.assertTrue((self.path("work") / "neighbors.1.bin").exists())

    def test_file_of_another_plan(self):
        self.finish()
        other = self.generate("sphere", "--points", 1000, name="other.ply")
        self.ok(self.command("--blocks", 3, other, self.path("o.ply"), work="other"))
        shutil.copy(self.path("other") / "planes.1.bin", self.path("work"))
        self.expect_failure(self.again(), WORK, "planes.1.bin", "another plan")

    def test_other_parameters(self):
        self.finish()
        self.expect_failure(self.again("--holes", "close-all"), WORK, "manifest.json", "the options")
        outcome = run(self.command("--blocks", 4, self.cloud, self.path("mesh.ply")))
        self.expect_failure(outcome, WORK, "manifest.json", "blocks")
        self.generate("torus", "--points", 1001)
        self.expect_failure(self.again(), WORK, "manifest.json", "input files")
        self.expect_no_mesh()

    def test_step_before_its_time(self):
        self.expect_failure(self.step("neighbors", "--block", 0), WORK, "manifest.json")
        self.plan(self.cloud)
        self.expect_failure(self.step("planes", "--block", 0), WORK, "outliers.bin", "--print-steps")
        self.expect_failure(self.step("join"), WORK, "outliers.bin")
        self.expect_failure(self.step("write"), WORK, "mesh.bin")

    def test_full_disk(self):
        self.generate("torus", "--points", 20000)

        def expect_full(kilobytes, file, *arguments):
            self.expect_failure(self.limited(kilobytes, *arguments), OUTPUT, "cannot write", file)
            self.assertEqual([f.name for f in self.path("work").iterdir() if f.name.startswith(".")], [])
            self.assertFalse((self.path("work") / file).exists())
            self.expect_no_mesh()

        expect_full(100, "points.bin", "--step", "plan", "--blocks", 3, self.cloud, self.path("mesh.ply"))
        self.plan(self.cloud)
        expect_full(100, "neighbors.1.bin", "--step", "neighbors", "--block", 1)
        self.steps_of_blocks()
        expect_full(100, "mesh.bin", "--step", "join", "--free-disk")
        self.ok(self.command("--step", "join", "--free-disk"))
        self.assertFalse((self.path("work") / "neighbors.0.bin").exists())
        expect_full(300, "mesh.ply", "--step", "write")
        self.ok(self.command("--step", "write"))
        self.assertTrue(self.path("mesh.ply").read_bytes() == self.reference(self.cloud))

    def test_too_little_memory(self):
        self.expect_failure(self.again("--max-memory", "20M"), USAGE, "--max-memory")
        self.generate("torus", "--points", 400000)
        self.expect_failure(self.again("--max-memory", "30M"), USAGE, "too small", "400000 points")
        self.ok(self.command("--blocks", 3, "--max-memory", "34M", "--step", "plan", self.cloud, self.path("mesh.ply")))
        self.expect_failure(self.step("join", "--max-memory", "34M"), USAGE, "too small", "43M")
        self.expect_no_mesh()


class Messages(Case):
    TCP = ["--mca", "btl", "self,tcp"]

    def nodes(self, cloud, *more):
        """Two nodes: they have no folder in common, and no shared memory."""
        options = ["--blocks", 5, *more, cloud, self.path("mesh.ply")]
        return run([*mpirun(1, *self.TCP), *self.command(*options), ":", "-n", 2,
                    OPTIONS.distributed, "--work", "/no/such/work", *options])

    def test_no_common_folder(self):
        cloud = self.terrain(6000)
        expected = self.reference(cloud)
        outcome = self.nodes(cloud, "--exchange", "messages", "--join-threads", 1)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertIn("stars: 5 blocks done", outcome.stderr)
        self.assertTrue(self.path("mesh.ply").read_bytes() == expected)

    def test_no_common_folder_and_no_messages(self):
        cloud = self.generate("torus", "--points", 6000)
        outcome = self.nodes(cloud)
        if outcome.returncode == 0:  # the first process was so fast that it has done all blocks
            return
        self.expect_failure(outcome, WORK, "/no/such/work", "--exchange messages")
        self.assertFalse(self.path("mesh.ply").exists())

    def test_damaged_file_is_told_by_another_process(self):
        cloud = self.generate("torus", "--points", 6000)
        self.assertEqual(self.nodes(cloud, "--exchange", "messages").returncode, 0)
        for file in [self.path("work") / "mesh.bin", *self.path("work").glob("stars.*")]:
            file.unlink()
        file = self.path("work") / "planes.0.bin"
        good = file.read_bytes()
        file.write_bytes(good[:-3] + bytes([good[-3] ^ 4]) + good[-2:])
        outcome = self.nodes(cloud, "--exchange", "messages")
        self.expect_failure(outcome, WORK, "planes.0.bin", "damaged")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("distributed", "reconstruct", "generate"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--faults", help="library that makes calls of the system fail, see test/tool/system_faults.cpp")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("names", nargs="*")
    parser.parse_args(namespace=OPTIONS)
    program = unittest.main(argv=[sys.argv[0], "-v", *OPTIONS.names], exit=False)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if program.result.testsRun == len(program.result.skipped):
        sys.exit(77)


if __name__ == "__main__":
    main()
