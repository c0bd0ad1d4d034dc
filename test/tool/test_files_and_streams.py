# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run reads, prints and writes: files, the standard streams, terminals. What fails leaves everything as it
was."""
import os
import pty
import subprocess

import numpy as np
import pytest
from conftest import IS_SANITIZED, INPUT, INTERNAL, OUTPUT, RECONSTRUCTION, USAGE
from files import json_of, pcd_text

BEFORE = "what was there before"


def test_inputs_that_cannot_be_read(cloud):
    cloud.path("folder.pcd").mkdir()
    cloud.write("empty.pcd", "")
    for name, *causes in (
            ("missing.pcd", "there is no such file"), ("folder.pcd", "it is a folder"),
            ("empty.pcd", "the file is empty"), ("bad.ply", "cannot read 'bad.ply': it does not begin with 'ply'"),
            ("bad.obj", "it has no points"), ("bad.stl", "it is too short for a binary STL file"),
            ("bad.las", "it is not a LAS file"), ("bad.csv", "it has no points"),
            ("bad.off", "its extension '.off' is unknown; use .pcd, .ply", "or give its format by --input-format"),
            ("bad.e57", "pdal translate a.e57")):
        if name.startswith("bad"):
            cloud.write(name, "hello\n")
        cloud.fail(f"{name} out.ply --report out.json", INPUT, *causes)


def test_clouds_of_which_no_surface_can_be_made(cloud):
    cloud.write("out.ply", BEFORE)
    cloud.write("place.pcd", pcd_text([(1, 2, 3)] * 50))
    cloud.write("nan.pcd", pcd_text([(float("nan"), 2, 3)] * 50))
    for name, status in (("place.pcd", "TOO_FEW_POINTS"), ("nan.pcd", "TOO_FEW_POINTS"), ("line.pcd", "DEGENERATE")):
        cloud.fail(f"{name} out.ply", RECONSTRUCTION, f"({status})")
        outcome = cloud.run(f"{name} out.ply --report out.json --json")
        report = json_of(cloud.text("out.json"))
        assert (outcome.code, json_of(outcome.out)["status"], report["status"]) == (RECONSTRUCTION, status, status)
        assert report["check"] is None  # without a mesh there is nothing to check
        assert cloud.text("out.ply") == BEFORE
        cloud.path("out.json").unlink()


def test_odd_files_are_told(cloud):
    cloud.write("more.pcd", cloud.text("in.pcd") + "7 7 7\n")
    assert "has more data than the 144 points" in cloud.succeed("more.pcd out.ply").err
    cloud.write("odd.pcd", cloud.text("in.pcd").replace("SIZE 4 4 4\n", ""))
    assert "warning: the PCD header has no SIZE" in cloud.succeed("odd.pcd out.ply").err
    assert np.array_equal(cloud.mesh().points, cloud.sample.points)
    cloud.succeed("odd.pcd out.ply --strict")  # the mesh is good


def test_outputs_that_cannot_be_written(cloud):
    cloud.path("folder.ply").mkdir()
    cloud.path("full.ply").symlink_to("/dev/full")
    for output, cause in (("missing/out.ply", "there is no folder '"), ("in.pcd/out.ply", "is not a folder"),
                          ("folder.ply", "it is a folder"), ("full.ply", "it is a device")):
        cloud.fail(f"in.pcd {output}", OUTPUT, f"cannot write '{output}'", cause)
        for option in ("--report", "--html", "--parameterization"):
            cloud.fail(f"in.pcd out.ply {option} {output}", OUTPUT, cause)
    cloud.fail("in.pcd out.xyz", OUTPUT, "its extension '.xyz' is unknown")
    cloud.fail("in.pcd out", OUTPUT, "it has no extension that tells its format")
    cloud.fail("in.pcd out.ply --parameterization out.png", OUTPUT, "'.png' is unknown")
    cloud.fail("in.pcd out.obj --texture nowhere/c.png", OUTPUT, "nowhere")
    # Paths are checked first: with a bad output, the missing input is not even noticed.
    cloud.fail("missing.pcd missing/out.ply", OUTPUT, "there is no folder")
    assert cloud.path("full.ply").is_symlink() and os.path.exists("/dev/full")


def test_write_that_fails_half_way(cloud):
    """As on a full disk: no part of any output is left."""
    cloud.write("out.ply", BEFORE)
    for extension in ("vtk", "ply", "obj", "stl", "off", "glb"):
        cloud.fail(f"in.pcd out.{extension} --report out.json", OUTPUT,
                   f"cannot write 'out.{extension}': File too large", file_limit=1000)
    # The mesh fits, the flat mesh as text does not: neither appears.
    cloud.succeed("in.pcd fits.ply -q --topology disc")
    limit = cloud.path("fits.ply").stat().st_size + 100
    cloud.fail("in.pcd out.ply --parameterization flat.obj", OUTPUT, "cannot write 'flat.obj'", file_limit=limit)
    cloud.fail("in.pcd out.ply --html out.html", OUTPUT, "cannot write 'out.html'", file_limit=limit)
    assert cloud.text("out.ply") == BEFORE


def test_output_is_replaced_and_keeps_link_and_permissions(cloud):
    cloud.write("target.ply", "old")
    cloud.path("target.ply").chmod(0o600)
    cloud.path("out.ply").symlink_to("target.ply")
    cloud.succeed("in.pcd out.ply -q")
    assert cloud.path("out.ply").is_symlink() and cloud.path("target.ply").stat().st_mode & 0o777 == 0o600
    assert np.array_equal(cloud.mesh("target.ply").points, cloud.sample.points)


def test_leftovers_of_killed_runs_are_told(cloud):
    """Where each process has the same number, all names may be taken."""
    take = 'for i in $(seq 0 99); do : > .pcl_floater.$$.$i.tmp; done; exec "$@"'
    outcome = cloud.run("in.pcd out.ply", wrapper=("sh", "-c", take, "sh"))
    assert outcome.code == OUTPUT and "remove the files '.pcl_floater.*.tmp'" in outcome.err


def test_the_summary_names_figures_and_file_unless_it_is_quiet(cloud):
    quiet, loud = cloud.succeed("--quiet in.pcd out.vtk"), cloud.succeed("in.pcd out.vtk")
    assert quiet.out + quiet.err == ""
    assert cloud.names() == {"in.pcd", "line.pcd", "out.vtk"}
    for part in ("points     144", "0 outliers", "triangles", "topology   ", "1 component, genus 0, with boundary",
                 "loops      1 of", "seconds", "warnings   0", "mesh       out.vtk"):
        assert part in loud.out
    assert "{" not in loud.out


def test_names_with_spaces_capitals_and_bytes_that_are_not_utf8(cloud):
    name = os.fsdecode(b"my cloud \xe4")
    cloud.path("in.pcd").rename(cloud.path(name + ".PCD"))
    cloud.succeed(name + ".PCD", name + ".PLY", "--report", name + ".json", "--json")
    cloud.path(name + ".PLY").rename(cloud.path("out.ply"))
    assert np.array_equal(cloud.mesh().points, cloud.sample.points)
    json_of(cloud.text(name + ".json"))


@pytest.fixture
def piped(cloud):
    """With what is to be expected, and the cloud from a pipe."""
    cloud.succeed("in.pcd expected.ply")
    cloud.succeed("in.pcd expected.vtk")
    cloud.expected = cloud.read("expected.ply")
    cloud.pipe = lambda name="in.pcd": {"stdin": subprocess.Popen(
        ["cat", name], cwd=cloud.folder, stdout=subprocess.PIPE).stdout}
    return cloud


def test_a_pipe_is_an_input(piped):
    outcome = piped.succeed("- out.ply --input-format pcd", **piped.pipe())
    assert piped.read("out.ply") == piped.expected and "triangles" in outcome.out
    piped.fail("- out.ply --input-format ply", INPUT, "cannot read the standard input: it does not begin with 'ply'",
               **piped.pipe())
    piped.fail("- out.ply --input-format ply", INPUT, "cannot read the standard input: nothing came from",
               **piped.pipe("/dev/null"))
    piped.fail("- out.ply", USAGE, "INPUT is the standard input: give its format by --input-format")


def test_the_standard_output_takes_the_mesh_and_nothing_else(piped):
    before = piped.names()
    for kind in ("ply", "vtk"):
        outcome = piped.succeed(f"- - --input-format pcd --output-format {kind} --json --strict", **piped.pipe())
        assert outcome.bytes == piped.read("expected." + kind)
        for part in ("triangles  ", "mesh       to the standard output", '{"status":"SUCCESS"'):
            assert part in outcome.err
    assert piped.names() == before
    quiet = piped.succeed("in.pcd - --output-format ply -q")
    assert (quiet.bytes, quiet.err) == (piped.expected, "")
    piped.fail("in.pcd -", USAGE, "OUTPUT is the standard output: give its format by --output-format")


def test_a_failure_of_the_standard_output_leaves_files_as_they_were(piped):
    """Files appear after the summary: what cannot be printed does not change any."""
    to_output = "in.pcd - --output-format ply"
    piped.fail("line.pcd - --output-format ply", RECONSTRUCTION, "(DEGENERATE)")
    piped.fail(to_output, OUTPUT, "cannot write to the standard output: File too large", file_limit=1000)
    piped.write("out.ply", BEFORE)
    with open("/dev/full", "wb") as full:
        outcome = piped.run(to_output, stdout=full)
        assert outcome.code == OUTPUT and "cannot write to the standard output: No space left" in outcome.err
        for arguments in ("in.pcd out.ply --report out.json", "in.pcd out.ply -q --json"):
            piped.fail(arguments, OUTPUT, "standard output", stdout=full)
        assert piped.text("out.ply") == BEFORE
        piped.succeed("in.pcd out.ply --quiet", stdout=full)  # prints nothing
    assert piped.read("out.ply") == piped.expected


def test_format_is_given_by_option(piped):
    piped.path("in.pcd").rename(piped.path("cloud.ply"))  # the option wins over that
    for output in ("mesh", "out.vtk"):
        piped.succeed(f"cloud.ply {output} --input-format pcd --output-format ply")
        assert piped.read(output) == piped.expected
    piped.fail("cloud.ply out --input-format pcd", OUTPUT, "it has no extension that tells its format; use .vtk")


@pytest.mark.skipif(IS_SANITIZED, reason="a sanitizer itself needs more addresses")
def test_few_addresses_do_not_keep_a_run_from_ending(cloud):
    """Below some limit the threads of OpenBLAS find no memory when the program starts, and wait for it. Neither a run
    that needs no linear system nor one that fails may wait for them."""
    for megabytes in (100, 130, 160, 200, 300):
        limit = {"address_limit": megabytes * 10**6}
        for topology in ("surface", "disc"):
            outcome = cloud.run(f"in.pcd out.ply --topology {topology}", **limit)
            if outcome.code == 127:
                continue  # the libraries alone take more
            assert outcome.code in (0, INTERNAL), megabytes
            assert ("out.ply" in cloud.names()) == (outcome.code == 0)
            assert outcome.code == 0 or "not enough memory" in outcome.err
            cloud.path("out.ply").unlink(missing_ok=True)
        assert cloud.run("--version", **limit).code in (0, 127)


@pytest.fixture
def terminal():
    """A terminal: what to write to it by, and what has been shown since the last call."""
    ours, theirs = pty.openpty()
    os.set_blocking(ours, False)

    def shown():
        text = b""
        try:
            while part := os.read(ours, 4096):
                text += part
        except BlockingIOError:
            return text.decode()
    yield theirs, shown
    os.close(ours)
    os.close(theirs)


def test_progress_is_shown_on_terminals_only(cloud, terminal):
    stderr, shown = terminal
    assert cloud.succeed("in.pcd out.ply").err == ""
    cloud.succeed("in.pcd out.ply", stderr=stderr, environment={"TERM": "xterm"})
    text, erase = shown(), "\r\033[K"
    assert text.startswith(erase + "reading ...") and text.endswith(erase)  # nothing is left of it
    assert erase + "writing ..." in text and text.count(" ...") > 2  # and at least one stage of the run
    cloud.succeed("in.pcd out.ply --quiet", stderr=stderr, environment={"TERM": "xterm"})
    cloud.succeed("in.pcd out.ply", stderr=stderr, environment={"TERM": "dumb"})  # cannot erase a line
    assert shown() == ""


def test_a_mesh_is_not_written_to_a_terminal(cloud, terminal):
    cloud.fail("in.pcd - --output-format ply", OUTPUT, "cannot write to the standard output: it is a terminal",
               stdout=terminal[0])
    assert terminal[1]() == ""


def test_escape_sequences_are_shown_as_text(cloud):
    """Names from files do not control the terminal."""
    rows = "".join(f"{i % 10},{i // 10},{i % 3},abc\n" for i in range(100))
    cloud.write("escape.csv", b"x,y,z,\x1b[31mred\xc2\x9b\n" + rows.encode())
    outcome = cloud.succeed("escape.csv out.ply")
    assert not set("\x1b\x9b") & set(outcome.out + outcome.err) and "'\\x1b'" in outcome.err
    cloud.fail("no\x1b[31m.xyz out.ply", INPUT, "no\\x1b[31m.xyz")
