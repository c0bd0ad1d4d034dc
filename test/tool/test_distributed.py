# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""pcl_floater_distributed makes the same mesh as pcl_floater_reconstruct, whatever the processes, the blocks, and the
moments at which it is ended. Tiles, joined by the numbers of their vertices, are the mesh in one piece."""
import contextlib
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time
import zlib

import numpy as np
import pytest
from conftest import OUTPUT, USAGE
from distributed import DISTRIBUTED, IS_LONG, STEPS, WORK, Work, flipped, mpirun, ply, terrain_points
from files import pcd_bytes, sample_of

PAIRS = [(1, 5), (2, 5), (3, 64), (7, 5), (1, 64), (2, 64), (3, 5), (7, 64)]


@pytest.fixture
def work(tool):
    return Work(tool.folder)


def write_scan(work):
    """A depth camera at the origin: a wavy wall, and a ball before it."""
    y, x = (np.mgrid[:70, :90].reshape(2, -1) - [[35], [45]]) / 80
    near, wall = 0.09 - 2 * (x * x + y * y), 3 + 0.2 * np.sin(5 * x) * np.cos(4 * y)
    z = np.where(x * x + y * y < 0.04, 1.5 - np.sqrt(np.maximum(near, 0)), wall)
    return work.write("scan.pcd", pcd_bytes(sample_of(np.stack([x * z, y * z, z], -1))))


def test_surfaces(work):
    numbers = random.Random(4)
    bush = [tuple(20.0 + 10.0 * numbers.random() for _ in range(3)) for _ in range(2000)]
    rows = [(0.1 * i + 0.02 * numbers.random(), 1.5 * j, 0.3 * math.sin(0.1 * i)) for i in range(400) for j in range(15)]
    # Overlapping strips, and clusters that are small only without what lies on others.
    strips = [(x, y + 0.02 * numbers.random(), z + 0.2 * numbers.random()) for x, y, z in 2 * terrain_points(2000)]
    strips += [(300 * i + 0.1 * numbers.random(), 300, 0.1 * numbers.random()) for i in (1, 2, 3) for _ in range(9)]
    few = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0.1), (2, 1, 0)]
    height_field = ("height-field", "--points", 9000)
    for cloud, pairs, *options in [
            (work.generate("torus", "--points", 9000, name="torus.ply"), PAIRS[:4]),
            (work.generate(*height_field, "--density-ratio", 60, name="uneven.ply"), [(3, 5)]),
            (work.generate(*height_field, "--noise", 0.2, name="weak_noise.ply"), [(2, 64)]),
            (work.generate("sphere", "--points", 9000, "--noise", 0.6, name="noise.ply"), [(2, 5)]),
            (work.generate("folded-sheet", "--points", 9000, "--gap", 2, name="sheets.ply"), [(2, 5)]),
            (work.generate("hemisphere", "--points", 600, name="empty_blocks.ply"), [(3, 64)]),
            (work.write("few.ply", ply(few)), [(2, 3)]),
            (work.terrain(9000), [(2, 5), (3, 64)]),
            (work.terrain(9000), [(2, 5)], "--remove-outliers", "off", "-k", "6", "--holes", "close-all", "--normals"),
            (work.write("bush.ply", ply(terrain_points(6000) + bush)), [(2, 5)], "--scatter", "drop"),
            (work.write("rows.ply", ply(rows)), [(2, 5)]),
            (work.write("strips.ply", ply(strips)), [(2, 2), (2, 16)]),
            (write_scan(work), [(2, 5)])]:
        expected = work.reference(cloud, *options)
        for processes, blocks in PAIRS if IS_LONG else pairs:
            work.expect_same(expected, [cloud], processes, blocks, *options)


def test_real_clouds(work):
    data = os.environ.get("PCL_FLOATER_DATA", "")
    if not os.path.isdir(data):
        pytest.skip(f"there is no folder of real clouds: PCL_FLOATER_DATA is '{data}'")
    names = ["raw_milk", "raw_sparse_cat"]
    for cloud in sorted(pathlib.Path(data).resolve().glob("*.pcd")):
        if IS_LONG or cloud.stem in names:
            work.expect_same(work.reference(cloud), [cloud], 2, 9)


def test_common_fields_of_tiles_stay(work):
    text = ("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
            "property double z\n{}property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n{}")
    rows = [f"{x + 0.1 * (y % 2)} {y} {0.01 * x * x}" for x in range(20) for y in range(20)]

    def write(name, first, last, extra=""):
        lines = "\n".join(f"{rows[i]}{' 1' if extra else ''} {i % 256} 7 9" for i in range(first, last))
        return work.write(name, text.format(last - first, extra, lines + "\n"))

    expected = work.reference(write("all.ply", 0, 400))
    tiles = [write("a.ply", 0, 150, "property int label\n"), write("b.ply", 150, 400)]
    assert "'label' was left out" in work.expect_same(expected, tiles, 1, 2)


def test_a_run_goes_on_where_steps_ended_and_the_other_way_round(work):
    cloud = work.generate("torus", "--points", 3000)
    expected = work.reference(cloud)
    work.plan(cloud)
    groups = work.printed_steps()
    assert [len(group) for group in groups] == [3, 1, 3, 3, 1, 1]
    for command in groups[0][:2]:
        work.ok(command)
    before = work.work_files()
    outcome = work.ok(mpirun(2) + work.command("--blocks", 3, cloud, "mesh.ply"))
    assert "neighbors: 1 blocks done, 2 finished before" in outcome.stderr
    after = work.work_files()
    assert before.items() <= after.items() and work.read("mesh.ply") == expected
    work.path("mesh.ply").unlink()
    for group in groups:  # there is nothing left to do but to write
        for command in group:
            work.ok(command)
    assert work.read("mesh.ply") == expected and after == work.work_files()


def test_report_and_memory_limit(work):
    cloud = work.generate("torus", "--points", 30000)
    outcome = work.ok(work.command("-q", "--max-memory", "150M", "--report", "report.json", cloud, "mesh.ply"))
    assert outcome.stdout == "" and "pcl_floater" not in outcome.stderr  # MPI may have something to say of the machine
    assert '"status": "SUCCESS"' in work.text("report.json") and work.read("mesh.ply") == work.reference(cloud)


SBATCH = """#!/usr/bin/env bash
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
"""


def test_trimmed_and_by_slurm(work):
    """By submit.sh, with an sbatch that runs each job at once."""
    work.path("bin").mkdir()
    work.write("bin/sbatch", SBATCH)
    work.path("bin/sbatch").chmod(0o755)
    cloud = work.generate("cut-out", "--points", 14000, "--holes", 2)
    trimming = ("--min-component", 7500, "--max-edge-ratio", 4)
    tools = f"{work.path('bin')}:{os.path.dirname(DISTRIBUTED)}:{os.environ['PATH']}"
    work.ok([pathlib.Path(__file__).with_name("submit.sh"), "work", "--blocks", 3, *trimming, cloud, "mesh.ply"],
            env={**os.environ, "PATH": tools})
    tasks = work.text("tasks").split()
    assert {step: tasks.count(step) for step in tasks} == {
        "neighbors": 3, "outliers": 1, "planes": 3, "stars": 3, "join": 1, "write": 1}
    assert work.read("mesh.ply") == work.reference(cloud, *trimming)


def test_files_of_blocks_go(work):
    """Also if the join reads them in part, or not at all."""
    for processes, cloud in [(2, work.generate("torus", "--points", 5000)),
                             (1, work.generate("torus", "--points", 5000, "--noise", 0.4, name="noise.ply")),
                             (1, write_scan(work))]:
        expected = work.reference(cloud)
        work.expect_same(expected, [cloud], processes, 5, "--free-disk")
        left = set(work.work_files())
        assert not [file for file in left if file.split(".")[0] in STEPS]
        # The mesh is known, so the next run does not make the files of the blocks again.
        assert "blocks done" not in work.ok(work.command("--blocks", 5, cloud, "again.ply")).stderr
        assert work.read("again.ply") == expected and left == set(work.work_files())


def kill_one_of(process, i):
    """Kills one of the processes of the run, or mpirun itself with all."""
    told = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True).stdout
    children = [int(child) for child in told.split()]
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


@pytest.mark.parametrize("points, blocks, moments", [
    (20000, 6, 20 if IS_LONG else 4), (560000 if IS_LONG else 14000, 3, 20 if IS_LONG else 3)])
def test_killed_and_started_again(work, points, blocks, moments):
    cloud = work.generate("height-field", "--points", points)
    expected = work.reference(cloud)
    command = [str(word) for word in mpirun(3) + work.command("--blocks", blocks, cloud, "mesh.ply")]
    begin = time.monotonic()
    work.ok(command)
    usual = time.monotonic() - begin
    known = {}
    shutil.rmtree(work.path("work"))
    work.path("mesh.ply").unlink()
    for i in range(moments):
        if i % 5 == 0:  # else it goes on where the one before was killed
            shutil.rmtree(work.path("work"), ignore_errors=True)
            known = {}
        with subprocess.Popen(command, cwd=work.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              start_new_session=True) as process:
            try:
                process.wait(usual * (i + 1) / (moments + 1))
            except subprocess.TimeoutExpired:
                kill_one_of(process, i)
        if not work.path("work/manifest.json").exists():
            continue  # the plan is not finished, and is made again
        files = {name: inode for name, (_, inode) in work.work_files().items() if name.endswith(".bin")}
        assert known.items() <= files.items(), "a file was made again"
        known = files
    work.ok(command)
    assert work.read("mesh.ply") == expected
    assert known.items() <= {name: inode for name, (_, inode) in work.work_files().items()}.items()


def test_no_common_folder(work):
    options = ["--blocks", 5, work.generate("torus", "--points", 6000), "mesh.ply"]
    work.expect([*mpirun(1), DISTRIBUTED, "--work", "work", *options, ":", "-n", 2, DISTRIBUTED, "--work", "/no/such/work",
                 *options], WORK, "/no/such/work", "is not there for all processes")
    assert not work.path("mesh.ply").exists()


def test_damaged_file_is_told_by_another_process(work):
    command = mpirun(2) + work.command("--blocks", 5, work.generate("torus", "--points", 6000), "mesh.ply")
    work.ok(command)
    work.path("work/mesh.bin").unlink()
    work.write("work/planes.1.bin", flipped(work.read("work/planes.1.bin"), -3, 4))
    work.expect(command, WORK, "planes.1.bin", "damaged")


def write_tiles(work, *arguments, folder="tiles"):
    work.ok(mpirun(2) + work.command("--tiles", *arguments, folder))


def expect_tiles(work, folder, expected, count):
    """Compares all of a folder with the mesh in one piece. Returns the manifest and, of each tile, the numbers of its own
    points."""
    manifest = json.loads(work.text(folder + "/tiles.json"))
    work.write("expected.ply", expected)
    whole = work.mesh("expected.ply")
    names = [f"tile.{i}.ply" for i in range(count)]
    assert set(os.listdir(work.path(folder))) == {*names, "tiles.json"}
    assert [entry["file"] for entry in manifest["tiles"]] == names
    assert (manifest["points"], manifest["triangles"]) == (len(whole.rows), len(whole.triangles))
    owner = np.full(len(whole.rows), -1)
    tiles = []  # numbers and triangles
    for i, entry in enumerate(manifest["tiles"]):
        data, tile = work.read(f"{folder}/{names[i]}"), work.mesh(f"{folder}/{names[i]}")
        assert (len(data), f"{zlib.crc32(data):08x}") == (entry["bytes"], entry["crc32"])
        assert tile.rows.dtype.descr == [*whole.rows.dtype.descr, ("vertex_number", "<f8")]
        numbers = tile.rows["vertex_number"].astype(int)
        own = numbers[:entry["own_points"]]
        assert entry["points_before"] == (owner >= 0).sum() and len(numbers) == len(own) + entry["border_points"]
        assert np.array_equal(own, np.unique(own)) and (owner[own] == -1).all()
        owner[own] = i
        for name in whole.rows.dtype.names:
            assert tile.rows[name].tobytes() == whole.rows[name][numbers].tobytes()
        tiles.append((numbers, numbers[tile.triangles]))
    assert (owner >= 0).all()
    for i, (entry, (numbers, triangles)) in enumerate(zip(manifest["tiles"], tiles)):
        assert (entry["triangles"], entry["triangles_before"]) == (len(triangles), sum(len(t) for _, t in tiles[:i]))
        border = entry["own_points"]
        for part in entry["borders"]:
            group = numbers[border:border + part["points"]]
            assert part["first"] == border and part["tile"] != i and (owner[group] == part["tile"]).all()
            assert np.array_equal(group, np.unique(group))
            border += part["points"]
        assert border == len(numbers) and (owner[triangles.min(1)] == i).all()
        assert set(numbers[entry["own_points"]:]) <= set(triangles.ravel())
    joined = np.concatenate([triangles for _, triangles in tiles])
    assert sorted(joined.tolist()) == sorted(whole.triangles.tolist()), "other triangles"
    return manifest, [np.flatnonzero(owner == i) for i in range(count)]


def test_a_tile_for_each_file(work):
    points = terrain_points(8000)
    expected = work.reference(work.write("all.ply", ply(points)), "--normals")
    cuts = [0, 100, 100 + 3000, len(points)]
    inputs = [work.write(f"part{i}.ply", ply(points[cuts[i]:cuts[i + 1]])) for i in range(3)]
    write_tiles(work, "--normals", "--blocks", 4, *inputs)
    manifest, own = expect_tiles(work, "tiles", expected, 3)
    assert [entry["input"] for entry in manifest["tiles"]] == inputs
    finite = [int(np.isfinite(points[:cut]).all(-1).sum()) if cut else 0 for cut in cuts]
    assert [numbers.tolist() for numbers in own] == [list(range(*pair)) for pair in zip(finite, finite[1:])]


def test_a_tile_for_each_block(work):
    cloud = work.terrain(6000)
    write_tiles(work, "--blocks", 5, cloud)
    manifest, own = expect_tiles(work, "tiles", work.reference(cloud), 5)
    assert {entry["input"] for entry in manifest["tiles"]} == {cloud}
    assert min(map(len, own)) > 1000  # blocks have about the same number of points
    # The same from another work folder, without MPI, on top of others: those that are too many go.
    work.path("more").mkdir()
    for name in ("tile.5.ply", "tile.6.ply"):
        work.write("more/" + name, "of an older run")
    work.ok(work.command("--tiles", "--blocks", 5, cloud, "more/", work="other"))
    tiles, more = ({file.name: file.read_bytes() for file in work.path(name).iterdir()} for name in ("tiles", "more"))
    assert tiles == more


def test_doubles_and_shift_in_more_blocks_than_points(work):
    work.write("map.xyz", "".join(f"{500000 + x} {5500000 + y} {0.1 * x * y}\n" for x in range(12) for y in range(12)))
    options = ("--shift", "500000,5500000,0", "--precision", "double")
    write_tiles(work, *options, "--blocks", 7, "map.xyz")
    manifest, own = expect_tiles(work, "tiles", work.reference("map.xyz", *options), 7)
    assert manifest["shift"] == [500000, 5500000, 0] and 0 in map(len, own)


def test_as_steps_after_the_mesh_and_of_a_tile(work):
    cloud = work.generate("torus", "--points", 3000)
    expected = work.reference(cloud)
    work.ok(work.step("plan", "--tiles", "--blocks", 2, cloud, "tiles"))
    for group in work.printed_steps():
        for command in group:
            work.ok(command)
    expect_tiles(work, "tiles", expected, 2)
    # What is known is enough for the mesh in one piece, and the other way round.
    join = work.work_files()["mesh.bin"]
    work.ok(work.command("--blocks", 2, cloud, "mesh.ply"))
    assert work.read("mesh.ply") == expected
    write_tiles(work, "--blocks", 2, cloud, folder="more")
    expect_tiles(work, "more", expected, 2)
    assert join == work.work_files()["mesh.bin"]
    # A field of the name of the numbers is left out.
    work.ok(work.command("--tiles", "--blocks", 1, cloud, "one", work="one_block"))
    outcome = work.ok(work.command("--tiles", "--blocks", 2, "one/tile.0.ply", "again", work="other"))
    assert "the field 'vertex_number' of the points was left out" in outcome.stderr
    expect_tiles(work, "again", expected, 2)


def test_folders_that_cannot_be_used(work):
    cloud = work.generate("torus", "--points", 1000)
    for output, code, words in [("no/such/folder", OUTPUT, "no/such"), ("cloud.ply", OUTPUT, "not a folder"),
                                ("work", USAGE, "work folder"), ("-", OUTPUT, "cannot write '-'")]:
        work.expect(work.command("--tiles", cloud, output), code, words)
    assert not work.path("work/tiles.json").exists()


def test_full_disk_of_tiles(work):
    """Then there is no manifest, also not that of an older run; and the next run writes all."""
    cloud = work.generate("torus", "--points", 20000)
    write_tiles(work, "--blocks", 2, cloud)
    work.expect(work.limited(300, "--step", "write"), OUTPUT, "cannot write", "tile.0.ply")
    assert set(os.listdir(work.path("tiles"))) == {"tile.0.ply", "tile.1.ply"}
    write_tiles(work, "--blocks", 2, cloud)
    expect_tiles(work, "tiles", work.reference(cloud), 2)
