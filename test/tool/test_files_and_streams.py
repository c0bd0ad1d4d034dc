# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run reads, prints and writes: files, the standard streams, terminals. What fails leaves everything as it
was."""
import os
import pty
import subprocess

import numpy as np
import pytest
from conftest import HAS_LZF, IS_SANITIZED, INPUT, INTERNAL, OUTPUT, RECONSTRUCTION, USAGE
from files import json_of, las_bytes, make_sample, obj_text, pcd_bytes, pcd_text, ply_bytes, put, stl_bytes
from test_readers import LAS, SQUARE, SQUARE_TEXT, TYPED, XYZ_FLOATS, pcd, read

BEFORE = "what was there before"


def test_inputs_that_cannot_be_read(cloud):
    cloud.path("folder.pcd").mkdir()
    for name, *causes in (
            ("missing.pcd", "there is no such file"), ("folder.pcd", "it is a folder"),
            ("bad.ply", "cannot read 'bad.ply': it does not begin with 'ply'"),
            ("bad.off", "its extension '.off' is unknown; use .pcd, .ply", "or give its format by --input-format")):
        if name.startswith("bad"):
            cloud.write(name, "hello\n")
        cloud.fail(f"{name} out.ply --report out.json", INPUT, *causes)


def bad_files():
    """Name, content, and a part of the message."""
    two, zeros, sizes = "WIDTH 2\nHEIGHT 1\n", bytes(12), b"\x05\0\0\0\x18\0\0\0"
    many = TYPED + "WIDTH 4000000000\nHEIGHT 4000000000\nPOINTS 16000000000000000000\n"
    ascii_, compressed = TYPED + two + "DATA ascii\n", (TYPED + two + "DATA binary_compressed\n").encode()
    vertex = "property float x\nproperty float y\nproperty float z\nend_header\n"
    vertices = "ply\nformat ascii 1.0\nelement vertex 2\n" + vertex
    binary = "ply\nformat binary_{}_endian 1.0\nelement vertex {}\n"
    points, las, new_las = "v 0 0 0\nv 1 0 0\nvn 0 0 1\n", las_bytes(**LAS), las_bytes(**LAS, minor=4)
    damaged = "damaged" if HAS_LZF else "liblzf"
    yield from (("a.pcd", content, cause) for content, cause in (
        ("", "the file is empty"),
        (b"\xfe" * 100, "this is not a line of a PCD header"),
        (TYPED + two, "truncated"),
        (ascii_ + "0.00000 0.00000 0.00000\n", "only 1"),
        (ascii_ + "0 0 0\n0 1   \n    \n", "line 8: it has fewer values"),
        (ascii_ + "0 0 0\n0 1 2 3\n", "line 8: it has more values"),
        (ascii_ + "0 0 0\n0 1 high\n", "line 8: 'high' is not a number"),
        ((TYPED + two + "DATA binary\n").encode() + zeros, "truncated"),
        ((many + "DATA binary\n").encode() + zeros, "truncated"),
        (compressed + sizes + b"ab", "truncated"),
        (compressed + sizes + b"\xff" * 5, damaged),
        (TYPED + "WIDTH 18446744073709551615\nHEIGHT 2\nDATA ascii\n", "is too large"),
        (TYPED + two + "DATA hex\n00\n", "'hex'"),
        (TYPED + two + "VIEWPOINT 1 2 north 1 0 0 0\nDATA ascii\n0 0 0\n1 1 1\n", "north"),
        (TYPED + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n", "no points"),
        (TYPED + "WIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n", "POINTS is 5"),
        (TYPED + "WIDTH -3\nHEIGHT 1\nDATA ascii\n", "'-3' is not a number"),
        (pcd("a y z", XYZ_FLOATS, "0 0 0\n1 1 1\n"), "no coordinate 'x' (fields of the file: a, y, z)"),
        (pcd("x y z", "SIZE 4 4 3\nTYPE F F Q\n", "0 0 0\n1 1 1\n"), "TYPE Q and SIZE 3"),
        (pcd("x y z", "SIZE 4 4\nTYPE F F F\n", "0 0 0\n"), "differ in length"),
        (pcd("x y z", XYZ_FLOATS + "COUNT 1 1 -20\n", ""), "'-20'")))
    yield from (("a.ply", content, cause) for content, cause in (
        ("plywood\n", "not a PLY file"),
        ("ply\nformat ascii 1.0\nelement vertex 2\n", "truncated"),
        ("ply\nelement vertex 2\n" + vertex, "no format line"),
        ("ply\nformat ascii 1.0\nelement face 0\n" + vertex, "no element 'vertex'"),
        ("ply\nformat ascii 1.0\nelement vertex 2\nproperty quad x\n" + vertex,
         "line 4: 'quad' is not a type of PLY"),
        ("ply\nformat binary 1.0\nelement vertex 2\n" + vertex, "'binary' is not a format"),
        (vertices + "0.00000 0.00000 0.00000\n", "only 1"),
        (vertices + "0 0 0\n0 high 1\n", "line 9: 'high' is not a number"),
        ((binary.format("big", 2) + vertex).encode() + zeros, "truncated"),
        ("ply\nformat ascii 1.0\nelement vertex 18446744073709551615\n" + vertex + "0 0 0\n", "truncated"),
        ((binary.format("little", 1) + "property list uint double marks\n" + vertex).encode() + b"\xff" * 16,
         "truncated"),
        ("ply\nformat ascii 1.0\nelement vertex 0\n" + vertex, "no points"),
        ("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
         "no coordinate 'z'")))
    yield from (("a.obj", content, cause) for content, cause in (
        ("# nothing\nf 1 2 3\n", "no points"),
        ("v 1 \\\n2 3\n\nv 4 high 6\n", "line 4: 'high' is not a number"),
        ("v 0 0 0\nv 1 2\n", "line 2: a point has 3, 4 or 6 numbers"),
        ("v 0 0 0 256 255 255\n", "a colour must be from 0 to 1"),
        (points + "f 1//2\n", "a face names point 1 and normal 2"),
        (points + "f 3//1\n", "a face names point 3 and normal 1"),
        *((points + f"f {corner}\n", "is not an index") for corner in ("0//1", "-3//1", "1//x"))))
    yield from (("a.stl", content, cause) for content, cause in (
        ("hello", "too short for a binary STL file"),
        ("x" * 200, "promises"),
        (put(stl_bytes(SQUARE), 80, "I", 2**32 - 1), "promises 4294967295 facets of at least 50 bytes each, but the file has only 2"),
        (stl_bytes([]), "no points"),
        ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 high 2\n", "line 4: 'high' is not a number"),
        ("solid a\nvertex 1 2 3\nendsolid\n", "after a whole facet")))
    yield from (("a.las", content, cause) for content, cause in (
        (b"lasf" + las[4:], "does not begin with 'LASF'"),
        (las[:100], "its header is truncated"),
        (put(las, 24, "B", 2), "version 2.2 of LAS"),
        (put(las, 25, "B", 5), "version 1.5 of LAS"),
        (put(las, 94, "H", 226), "its header has 226 bytes"),
        (put(new_las, 94, "H", 227), "its header has 227 bytes, fewer than the 375"),
        (put(las, 96, "I", 100), "the points begin at byte 100"),
        (put(las, 96, "I", 4000000000), "the points begin at byte 4000000000"),
        (put(las, 104, "B", 0x80), "laszip -i a.laz -o a.las, or pdal translate"),
        (put(las, 104, "B", 11), "its points are of format 11; 0 to 10"),
        (put(las, 105, "H", 19), "each point 19 bytes, fewer than the 20"),
        (put(las, 107, "I", 0), "no points"),
        (put(las, 107, "I", 4), "promises 4 points of at least 20 bytes each, but the file has only 3"),
        (put(new_las, 247, "Q", 2**64 - 1), "promises 18446744073709551615 points"),
        (put(las, 131, "d", 0), "the scale or the offset"),
        (put(las, 171, "d", float("-inf")), "the scale or the offset")))
    yield from (
        ("a.e57", las, "convert it: pdal translate a.e57 a.las, or CloudCompare"),
        ("a.laz", las, "it is compressed (LAZ), which cannot be read; decompress it: laszip -i"),
        ("a.xyz", "hello\n", "it has no points: no line has three numbers, x, y and z; it begins with 'hello'"),
        ("a.xyz", "1 2\n3 4\n", "no line has three numbers"),
        ("a.xyz", "1" * 100000 + " 2 3\n", "no line has three"),
        ("a.xyz", "x y z r\n1 2\n", "no line has three numbers"),
        ("a.xyz", "7\n", "no line has three numbers"),
        ("a.xyz", "no point\n" * 1100 + "1 2 3\n", "no line of the first 1000 has three"),
        ("a.xyz", "x y z a\n1 2 3\n", "in the columns that its header names"),
        ("a.asc", "ncols 3\nnrows 2\nxllcorner 0\n1 2 3\n4 5 6\n", "a grid of heights (ESRI ASCII)"),
        ("a.csv", "id,d 1,d2\n1,2,3\n", "its header 'id,d 1,d2' names no x, y and z: name them"),
        ("a.xyz", "id d1 d2 d3\n1 2 3 4\n", "such as --columns 2,3,4"),
        ("a.xyz", "".join(f"{i} 1 2 3\n" for i in range(5, 15)), "its first column counts the points"),
        ("a.xyz", "1 2 3\n4 5\n", "line 2: it does not have 3 columns"),
        ("a.xyz", "1 2 3\n4 5 high\n", "line 2: 'high' is not a number"),
        ("a.csv", "x,y,z,a\n1,2,3,4\n1,2,3,high\n", "line 3: 'high' is not a number"),
        ("a.pts", "3\n1 2 3\n4 5 6\n", "promises 3 points, but the file has only 2"),
        ("a.pts", "18446744073709551615\n1.5 2 -3\n", "has only 1"),
        ("a.xyz", b"\xff\xfe\x31\0 \0", "UTF-16"))


def test_files_that_cannot_be_read(read):
    for name, content, cause in bad_files():
        assert cause in read(name, content).error, content[:300]


def test_every_prefix_is_refused_or_whole(tool):
    """With the sanitizers, this also finds reads beyond the end of a file."""
    sample = make_sample(True, 4)
    table_rows = "3\nx y z red green blue label\n1 2 3 4 5 6 a\n7.8 2 3 4 5 6 b\n1 1 1 1 1 1 c\n"
    scan = "1\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 1\n4 5 6 1"
    las = [las_bytes(**LAS, minor=minor, layout=3) for minor in (2, 4)]
    tool.write("binary.pcd", pcd_bytes(sample))
    pcds = [pcd_bytes(sample)]
    for kind in ("ascii", "compressed")[:1 + HAS_LZF]:
        tool.by_pcl(kind, "binary.pcd", "a.pcd")
        pcds.append(tool.read("a.pcd"))
    for name, content, least in (
            *(("a.pcd", content, 1) for content in pcds),
            *(("a.ply", ply_bytes(sample, kind), 1) for kind in ("ascii", "binary_little_endian", "binary_big_endian")),
            ("a.obj", obj_text(sample), 1), ("a.csv", table_rows, len(table_rows) - 1),
            ("a.stl", stl_bytes(SQUARE), len(stl_bytes(SQUARE))),
            ("a.stl", SQUARE_TEXT, SQUARE_TEXT.rindex("endsolid") + 8), ("a.ptx", scan, len(scan) - 2),
            *(("a.las", data, len(data)) for data in las)):
        readable = tool.read_cloud("--prefixes", tool.write(name, content), "1")
        assert readable[0] == len(content) and least <= readable[-1] and len(readable) < len(content), (name, readable)


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
