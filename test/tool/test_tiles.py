# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""--tiles of pcl_floater_distributed. Joined by the numbers of their vertices, the tiles are the mesh in one piece."""
import json
import os
import zlib

import numpy as np
import pytest
from conftest import OUTPUT, USAGE
from distributed import Work, mpirun, ply, terrain_points


@pytest.fixture
def work(tool):
    return Work(tool.folder)


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


def test_full_disk(work):
    """Then there is no manifest, also not that of an older run; and the next run writes all."""
    cloud = work.generate("torus", "--points", 20000)
    write_tiles(work, "--blocks", 2, cloud)
    work.expect(work.limited(300, "--step", "write"), OUTPUT, "cannot write", "tile.0.ply")
    assert set(os.listdir(work.path("tiles"))) == {"tile.0.ply", "tile.1.ply"}
    write_tiles(work, "--blocks", 2, cloud)
    expect_tiles(work, "tiles", work.reference(cloud), 2)
