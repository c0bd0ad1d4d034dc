# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""pcl_floater_distributed tells what is wrong with its command line and with the files of its work folder. There is no
mesh then."""
import ctypes
import json
import os
import re
import shlex
import shutil
import struct

import pytest
from conftest import FAULTS, INPUT, OUTPUT, RECONSTRUCTION, USAGE
from distributed import DISTRIBUTED, IS_LONG, STEPS, WORK, Work, array_table, flipped, mpirun, ply


class Faulty(Work):
    def finish(self, with_mesh=False):
        """All steps. Without the mesh in the work folder, the next run joins the blocks again."""
        self.ok(self.again())
        self.path("mesh.ply").unlink()
        if not with_mesh:
            self.path("work/mesh.bin").unlink()

    def again(self, *more):
        return self.command("--blocks", 3, *more, "cloud.ply", "mesh.ply")

    def expect_no_mesh(self):
        assert not [name for name in self.names() if name == "mesh.ply" or name.startswith(".")]


@pytest.fixture
def work(tool):
    faulty = Faulty(tool.folder)
    faulty.generate("torus", "--points", 1000)
    return faulty


def test_wrong_command_lines(work):
    for arguments, words in [
            (["cloud.ply", "mesh.ply"], "--work is missing"),
            (["--work", "w", "cloud.ply"], "one or more files"),
            (["--work", "w", "--step", "star", "cloud.ply", "mesh.ply"], "stars"),
            (["--work", "w", "--step", "stars"], "--block"),
            (["--work", "w", "--step", "join", "--block", 1], "--block"),
            (["--work", "w", "--print-steps", "--step", "join"], "exclude"),
            (["--work", "w", "-k", "3", "cloud.ply", "mesh.ply"], "--neighbors"),
            (["--work", "w", "-", "mesh.ply"], "standard input")]:
        work.expect([DISTRIBUTED, *arguments], USAGE, words)
    work.expect_no_mesh()
    work.plan("cloud.ply")
    work.expect(work.step("stars", "--block", 3), USAGE, "numbered from 0")


def test_input_that_is_missing_or_cannot_be_reconstructed(work):
    work.write("line.ply", ply([(i, 0, 0) for i in range(50)]))
    for start in ([], mpirun(2)):
        work.expect(start + work.command("line.ply", "mesh.ply"), RECONSTRUCTION, "on one line")
        work.expect(start + work.command("cloud.ply", "tile2.ply", "mesh.ply", work="other"), INPUT, "tile2.ply")
        work.expect(start + work.command("cloud.ply", "mesh.ply", work="cloud.ply/work"), OUTPUT, "work folder")
        work.expect(start + work.command("cloud.ply", "/no/such/folder/mesh.ply", work="third"), OUTPUT, "/no/such/folder")
    shutil.rmtree(work.path("work"))
    work.plan("cloud.ply")
    work.path("cloud.ply").unlink()
    work.ok(work.step("neighbors", "--block", 0))
    work.expect(work.step("join"), INPUT, "cloud.ply")
    work.expect_no_mesh()


def test_damaged_files(work):
    work.finish()
    for name in ["points.bin", "neighbors.1.bin", "outliers.bin", "stars.2.bin", "manifest.json", "mesh.bin"]:
        if name == "mesh.bin":
            work.ok(work.again())
            work.path("mesh.ply").unlink()
        good = work.read("work/" + name)
        places = []
        if name == "points.bin":  # in the head, in the table of arrays, and in each array
            arrays = array_table(good)
            places = [20, *(40 + 48 * i + 24 for i in range(len(arrays))), *(offset for *_, offset in arrays)]
        faults = [(flipped(good, -3, 4), "damaged"), (good[:len(good) // 2], "truncated"), (good + b"x", "grown"),
                  *((flipped(good, at), "damaged") for at in places if at < len(good)),
                  (good[:8] + struct.pack("<I", 99) + good[12:], "format version 99"),
                  (b"PLY" + good[3:], "no file of this program"), (b"", "truncated")]
        if name != "points.bin" and not IS_LONG:
            # One function reads all files, so every fault is tried on one of them, and one fault on each.
            faults = faults[:1]
        if name == "manifest.json":
            faults = [(good.replace(b'"blocks": 3', b'"blocks": 4'), "damaged"), (good[:100], "damaged"),
                      (b"{}", "damaged"), (good.replace(b"work folder", b"something"), "no manifest"),
                      (re.sub(b'"version": [0-9]+', b'"version": 99', good), "format version 99")]
        for bad, word in faults:
            assert good != bad
            work.write("work/" + name, bad)
            told = work.expect(work.again(), WORK, "work/" + name, word, "pcl_floater_distributed: ").stderr
            assert "pcl_floater_reconstruct" not in told
            work.expect_no_mesh()
        work.write("work/" + name, good)
    work.ok(work.again())


def xxhash(data, seed=0):
    hashed = ctypes.CDLL("libxxhash.so.0").XXH3_64bits_withSeed
    hashed.restype, hashed.argtypes = ctypes.c_uint64, (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64)
    return hashed(data, len(data), seed)


def forged(data, array, value):
    """With another first number of 32 bits in an array, and the checksum that is right then."""
    data = bytearray(data)
    for name, element, count, offset in array_table(bytes(data)):
        if name == array and count > 0:
            struct.pack_into("<I", data, offset, value)
            end = offset + min(element * count, 16384)
            struct.pack_into("<Q", data, end, xxhash(bytes(data[offset:end])))
    return bytes(data)


def test_forged_indices(work):
    work.finish()
    for name, arrays in [("points.bin", ["cloud_index"]), ("neighbors.1.bin", ["ids"]),
                         ("planes.1.bin", ["beside", "beside.offsets"]),
                         ("stars.1.bin", ["far", "far.offsets", "stars", "stars.offsets"]), ("mesh.bin", ["triangles"])]:
        if name == "mesh.bin":
            work.ok(work.again())
        good = work.read("work/" + name)
        for array in arrays:
            bad = forged(good, array, 0xFFFFFFFE)
            if bad == good:
                continue  # it has no values
            work.write("work/" + name, bad)
            work.expect(work.again(), WORK)
            work.write("work/" + name, good)
            if name != "mesh.bin":
                work.path("work/mesh.bin").unlink(missing_ok=True)
    work.ok(work.again())


def test_files_that_others_can_write(work):
    work.finish()
    file = work.path("work/planes.1.bin")
    assert [path.stat().st_mode & 0o777 for path in (work.path("work"), file)] == [0o700, 0o600]
    file.chmod(0o620)
    work.expect(work.again(), WORK, "work/planes.1.bin", "only this user can write")
    file.chmod(0o600)
    elsewhere = file.rename(work.path("elsewhere.bin"))
    saved = elsewhere.read_bytes()
    file.symlink_to(elsewhere)
    work.expect(work.again(), WORK, "work/planes.1.bin", "symbolic link")
    # A link in the place of a file that is written is replaced.
    shutil.rmtree(work.path("work"))
    work.plan("cloud.ply")
    work.path("work/neighbors.0.bin").symlink_to(work.path("nothing"))
    work.ok(work.step("neighbors", "--block", 0))
    assert "nothing" not in work.names() and elsewhere.read_bytes() == saved


def test_edited_manifest(work):
    work.finish(with_mesh=True)
    plan = json.loads(work.text("work/manifest.json"))

    def checksum():
        contents = {key: part for key, part in plan.items() if key != "checksum"}
        return xxhash(json.dumps(contents, separators=(",", ":"), ensure_ascii=False).encode())
    assert plan["checksum"] == checksum()
    plan["arguments"][-1] = "victim.ply"
    plan["checksum"] = checksum()
    work.write("work/manifest.json", json.dumps(plan))
    work.expect(work.step("write"), WORK, "manifest.json")
    assert "victim.ply" not in work.names()


def test_tile_that_changes_in_its_middle(work):
    work.generate("torus", "--points", 20000)
    work.finish(with_mesh=True)
    cloud = work.read("cloud.ply")
    work.write("cloud.ply", flipped(cloud, len(cloud) // 2))
    work.expect(work.again(), WORK, "input files")
    work.expect(work.step("write"), WORK, "input files")
    work.expect_no_mesh()


def test_names(work):
    name = "a'; touch PWNED; echo 'b $(c)"
    work.ok(work.command("--step", "plan", "--blocks", 2, "cloud.ply", "mesh.ply", work=name))
    lines = work.ok(work.command("--print-steps", work=name)).stdout.split("\n")
    assert {shlex.split(line)[2] for line in filter(None, lines)} == {name}
    work.expect(work.command("--step", "plan", "cloud.ply", "m.ply", work="a\nb"), USAGE, "line break")
    odd = os.fsdecode(b"odd\xff.ply")
    work.path("cloud.ply").rename(work.path(odd))
    work.expect(work.command("--step", "plan", odd, "m.ply", work="odd"), USAGE, "UTF-8")


@pytest.mark.skipif(not FAULTS, reason="there is no library that makes calls of the system fail")
def test_file_that_does_not_get_to_the_disk(work):
    """An error of fsync. The file is not there then, and is made again."""
    work.plan("cloud.ply")
    broken = {**os.environ, "LD_PRELOAD": FAULTS, "PCL_FLOATER_FAULT": "fsync:0:EIO"}
    work.expect(work.step("neighbors", "--block", 1), OUTPUT, "cannot write", "neighbors.1.bin", env=broken)
    assert "neighbors.1.bin" not in work.work_files()
    work.ok(work.step("neighbors", "--block", 1))
    assert "neighbors.1.bin" in work.work_files()


def test_file_of_another_plan(work):
    work.finish()
    other = work.generate("sphere", "--points", 1000, name="other.ply")
    work.ok(work.command("--blocks", 3, other, "o.ply", work="other"))
    shutil.copy(work.path("other/planes.1.bin"), work.path("work"))
    work.expect(work.again(), WORK, "planes.1.bin", "another plan")


def test_other_parameters(work):
    work.finish()
    work.expect(work.again("--holes", "close-all"), WORK, "manifest.json", "the options")
    work.expect(work.command("--blocks", 4, "cloud.ply", "mesh.ply"), WORK, "manifest.json", "blocks")
    work.generate("torus", "--points", 1001)
    work.expect(work.again(), WORK, "manifest.json", "input files")
    work.expect_no_mesh()


def test_step_before_its_time(work):
    work.expect(work.step("neighbors", "--block", 0), WORK, "manifest.json")
    work.plan("cloud.ply")
    work.expect(work.step("planes", "--block", 0), WORK, "outliers.bin", "--print-steps")
    work.expect(work.step("join"), WORK, "outliers.bin")
    work.expect(work.step("write"), WORK, "mesh.bin")


def test_full_disk(work):
    work.generate("torus", "--points", 20000)

    def expect_full(kilobytes, file, *arguments):
        work.expect(work.limited(kilobytes, *arguments), OUTPUT, "cannot write", file)
        assert not [name for name in work.work_files() if name.startswith(".") or name == file]
        work.expect_no_mesh()

    expect_full(100, "points.bin", "--step", "plan", "--blocks", 3, "cloud.ply", "mesh.ply")
    work.plan("cloud.ply")
    expect_full(100, "neighbors.1.bin", "--step", "neighbors", "--block", 1)
    for step in STEPS:
        for block in range(3):
            work.ok(work.step(step, "--block", block))
        if step == "neighbors":
            work.ok(work.step("outliers"))
    expect_full(100, "mesh.bin", "--step", "join", "--free-disk")
    work.ok(work.step("join", "--free-disk"))
    assert "neighbors.0.bin" not in work.work_files()
    expect_full(300, "mesh.ply", "--step", "write")
    work.ok(work.step("write"))
    assert work.read("mesh.ply") == work.reference("cloud.ply")


def test_too_little_memory(work):
    work.expect(work.again("--max-memory", "20M"), USAGE, "--max-memory")
    work.generate("torus", "--points", 400000)
    work.expect(work.again("--max-memory", "30M"), USAGE, "too small", "400000 points")
    work.ok(work.command("--blocks", 3, "--max-memory", "34M", "--step", "plan", "cloud.ply", "mesh.ply"))
    work.expect(work.step("join", "--max-memory", "34M"), USAGE, "too small", "43M")
    work.expect_no_mesh()
