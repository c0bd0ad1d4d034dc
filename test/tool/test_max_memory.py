# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""--max-memory and --scratch: the mesh is the same as without them, and no files are left."""
import os
import re
import signal

import pytest

from conftest import IS_SANITIZED, INTERNAL, OUTPUT
from files import make_sample, pcd_bytes
from test_faults import ends_when, is_mapped


def test_same_mesh_near_the_limit(tool):
    """With the smallest limit that the tool accepts for this cloud."""
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
        tool.fail("in.pcd out.ply --max-memory 60M", INTERNAL, "no room in the scratch folder '.': File too large",
                  file_limit=1 << 20)


@pytest.mark.skipif(IS_SANITIZED, reason="arrays stay in memory")
def test_signals_leave_no_scratch_file(tool):
    tool.write("in.pcd", pcd_bytes(make_sample(side=200)))
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        ends_when(tool, number, lambda process: is_mapped(process, " (deleted)\n"), "--max-memory", "60M")
