# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that is ended by a signal leaves no files. Each call of the system goes wrong once, in every way that it may:
the run succeeds or fails with a message, and the output is the new file or the old one, whole. With --max-memory and
--scratch, the mesh is the same as without them, and no files are left."""
import os
import pathlib
import re
import signal
from types import SimpleNamespace

import pytest
from conftest import FAULTS, IS_SANITIZED, INPUT, INTERNAL, OUTPUT
from files import json_of, make_sample, pcd_bytes

OLD = "what was there before"


def is_mapped(process, name):
    return name in pathlib.Path(f"/proc/{process}/maps").read_text()


def ends_when(tool, number, is_time, *options):
    """Sends a signal when is_time (id of the process): the run must end by that signal, and leave nothing. It may end by
    itself before that is noticed; then it is run again."""
    for _ in range(10):
        tool.write("out.obj", OLD)
        child = tool.start(["in.pcd", "out.obj", *options])
        while child.poll() is None:
            if is_time(child.pid):
                child.send_signal(number)
                break
        out, err = child.communicate()
        assert child.returncode in (0, -number), err
        if child.returncode != 0:
            break
    assert (child.returncode, out) == (-number, b""), "the moment was never noticed"
    assert tool.names() == {"in.pcd", "out.obj"} and tool.text("out.obj") == OLD


def test_signals_leave_no_part_of_a_file(tool):
    tool.write("in.pcd", pcd_bytes(make_sample(side=250)))  # so large that its mesh takes several writes
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        ends_when(tool, number, lambda process: is_mapped(process, "/in.pcd"))
        ends_when(tool, number, lambda _: any(name.startswith(".pcl_floater.") for name in tool.names()))


@pytest.fixture
def faulty(tool):
    """The tool where a call of the system goes wrong."""
    if IS_SANITIZED:
        pytest.skip("the runtime of a sanitizer must be the first library itself")
    sample = pcd_bytes(make_sample())
    tool.write("in.pcd", sample)
    arguments = "in.pcd out.ply --report out.json --parameterization flat.vtk"
    tool.succeed(arguments)
    new = {name: tool.read(name) for name in ("out.ply", "flat.vtk")}

    def restore():
        for name in new:
            tool.write(name, OLD)
        tool.path("out.json").unlink(missing_ok=True)

    def for_each_call(call, kind):
        """All calls of this name go wrong, one after the other. No output may be a part of a file."""
        for n in range(1000):
            restore()
            outcome = tool.run(arguments, environment={
                "LD_PRELOAD": FAULTS, "PCL_FLOATER_FAULT": f"{call}:{n}:{kind}",
                "PCL_FLOATER_FAULT_MARK": str(tool.path("mark")), "PCL_FLOATER_FAULT_FILE": str(tool.path("in.pcd"))})
            has_happened = "mark" in tool.names()
            tool.path("mark").unlink(missing_ok=True)
            for name, content in new.items():
                assert tool.read(name) in (content, OLD.encode()), (call, kind, n)
            if "out.json" in tool.names():
                json_of(tool.text("out.json"))
            rests = [name for name in tool.names() if name.startswith(".pcl_floater.")]
            for name in rests:
                tool.path(name).unlink()
            is_new = tool.read("out.ply") == new["out.ply"]
            if not has_happened:  # there are fewer such calls
                assert outcome.code == 0 and is_new, outcome.err
                return
            yield SimpleNamespace(outcome=outcome, has_rest=bool(rests), is_new=is_new)
            tool.write("in.pcd", sample)
    tool.arguments, tool.restore, tool.for_each_call = arguments, restore, for_each_call
    return tool


def test_errors_are_told_or_do_not_matter(faulty):
    """Either all goes well, or there is a message and all files are as they were."""
    count = 0
    for call in ("open", "read", "mmap", "fchmod", "write", "fsync"):
        for kind in ("EIO", "ENOSPC", "EACCES"):
            for case in faulty.for_each_call(call, kind):
                count += 1
                outcome = case.outcome
                assert not case.has_rest and case.is_new == (outcome.code == 0), (call, kind)
                if outcome.code == 0:
                    continue
                assert outcome.code in (INPUT, OUTPUT, INTERNAL) and "pcl_floater_reconstruct: " in outcome.err
                # The report tells of a reconstruction that has found no memory.
                assert faulty.names() - {"out.json"} == {"in.pcd", "out.ply", "flat.vtk"}
    assert count >= 30


def test_a_failed_rename_is_told(faulty):
    """A file that has appeared stays; the message names the one that could not."""
    cases = list(faulty.for_each_call("rename", "EIO"))
    assert len(cases) == 3
    for case in cases:
        assert not case.has_rest and case.outcome.code == OUTPUT and "cannot write '" in case.outcome.err


def test_interrupted_and_short_writes_are_continued(faulty):
    for call, kind in (("write", "EINTR"), ("write", "short"), ("fsync", "EINTR")):
        cases = list(faulty.for_each_call(call, kind))
        assert len(cases) >= 3
        for case in cases:
            assert case.outcome.code == 0 and case.is_new and not case.has_rest, case.outcome.err


def test_killed_at_any_call(faulty):
    """Nothing but a temporary file may be left."""
    cases = [case for call in ("mmap", "write", "fsync", "rename") for kind in ("kill", "killed")
             for case in faulty.for_each_call(call, kind)]
    assert len(cases) >= 20 and all(case.outcome.code == -signal.SIGKILL for case in cases)


def test_input_that_shrinks_while_outputs_are_written(faulty):
    """The colours and normals of the input are read where it is mapped."""
    for call in ("fsync", "write"):
        for case in faulty.for_each_call(call, "shrink"):
            assert not case.has_rest
            assert case.outcome.code == 0 or (case.outcome.code == INPUT and
                                              "truncated while it was in use" in case.outcome.err)


def test_what_goes_to_the_standard_output_is_nobody_elses(faulty):
    faulty.path("temporary").mkdir()
    faulty.run("in.pcd - --output-format ply", environment={
        "LD_PRELOAD": FAULTS, "PCL_FLOATER_FAULT": "fsync:0:kill", "TMPDIR": "temporary"})
    rest, = faulty.path("temporary").iterdir()
    assert rest.stat().st_mode & 0o777 == 0o600


def test_a_closed_pipe_leaves_nothing(faulty):
    """Nobody reads what is printed: the run ends as programs in a pipe do."""
    faulty.restore()
    reader, writer = os.pipe()
    os.close(reader)
    assert faulty.run(faulty.arguments, stdout=writer).code == -signal.SIGPIPE
    os.close(writer)
    assert faulty.names() == {"in.pcd", "out.ply", "flat.vtk"} and faulty.text("out.ply") == OLD


def test_same_mesh_near_the_limit(tool):
    """--max-memory, with the smallest limit that the tool accepts for this cloud."""
    tool.write("in.pcd", pcd_bytes(make_sample(side=350)))
    tool.path("scratch").mkdir()
    megabytes = re.search(r"122500 points; use (\d+)M or more", tool.run("in.pcd none.ply --max-memory 30M").err)[1]
    assert tool.report("--topology surface")["memory_limit"] is None
    free = tool.read("out.ply")
    limited = tool.report(f"--topology surface --max-memory {megabytes}M --scratch scratch")
    assert tool.read("out.ply") == free and not os.listdir(tool.path("scratch"))
    used, limit = limited["memory_limit"], int(megabytes) * 10**6
    assert (used["bytes"], used["scratch"]) == (limit, "scratch")
    # With a sanitizer, arrays stay in memory.
    assert IS_SANITIZED or used["scratch_peak_bytes"] > 10**6 and limited["peak_memory_bytes"] < 2 * limit


def test_scratch_folder_that_cannot_be_used(tool):
    """A limit on file sizes stands for a full disk."""
    tool.write("in.pcd", pcd_bytes(make_sample(side=300)))
    for folder in ("missing", "in.pcd", "/proc/self"):
        tool.fail(f"in.pcd out.ply --max-memory 2G --scratch {folder}", OUTPUT,
                  f"cannot use the scratch folder '{folder}': ")
    if not IS_SANITIZED:
        tool.fail("in.pcd out.ply --max-memory 60M", INTERNAL, "no room in the scratch folder '.': File too large; it holds ",
                  " MB more are needed; raise the limit on file sizes", file_limit=1 << 20)


@pytest.mark.skipif(IS_SANITIZED, reason="arrays stay in memory")
def test_signals_leave_no_scratch_file(tool):
    tool.write("in.pcd", pcd_bytes(make_sample(side=200)))
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        ends_when(tool, number, lambda process: is_mapped(process, " (deleted)\n"), "--max-memory", "60M")
