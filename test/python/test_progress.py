# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress, and what ends a run early. The runs are long enough that all happens within them."""
import multiprocessing
import signal
import sys
import threading

import numpy as np
import pcl_floater
import pytest

from conftest import terrain, torus


def test_progress_is_told(torus_points):
    told = []
    thread = []

    def progress(stage, fraction):
        told.append((stage, fraction))
        thread.append(threading.get_ident())

    mesh = pcl_floater.reconstruct(torus_points, progress=progress)
    stages, fractions = zip(*told)
    assert fractions == tuple(sorted(fractions)) and fractions[-1] == 1.0
    assert all(type(fraction) is float for fraction in fractions)
    assert set(stages) <= set(mesh.report["seconds"]) and "neighbors" in stages and "check" in stages
    assert set(thread) == {threading.get_ident()}


class Stop(Exception):
    pass


@pytest.mark.parametrize("at, kind", [("working set", Stop), ("stars", SystemExit), ("check", Stop)])
def test_exception_of_progress_ends_the_run(torus_points, at, kind):
    told = []

    def progress(stage, fraction):
        told.append(stage)
        if stage == at:
            raise kind(stage)

    with pytest.raises(kind, match=at) as raised:
        pcl_floater.reconstruct(torus_points, progress=progress)
    assert told[-1] == at and told.count(at) == 1
    assert any("progress" in str(entry) for entry in raised.traceback)  # where it was raised
    with pytest.raises(TypeError):
        pcl_floater.reconstruct(torus_points, progress=lambda stage: None)


def test_signals_are_handled_within_the_run():
    """As Ctrl-C is. Alarms that come together are one. What a handler raises ends the run."""
    points = torus(400, 160)
    expected = pcl_floater.reconstruct(points).triangles
    calls = []

    def handler(number, frame):
        calls.append(number)
        if len(calls) == last:
            raise Stop

    previous = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
        last = 0
        calls.clear()
        mesh = pcl_floater.reconstruct(points)
        # At the begin, and after the run, they would be handled in any case.
        assert len(calls) > 3 and np.array_equal(mesh.triangles, expected)
        last = 4
        with pytest.raises(Stop):
            calls.clear()
            pcl_floater.reconstruct(points)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)


def test_lock_of_the_interpreter_is_free_within_the_run():
    """A thread of Python counts while a run without progress is under way in another."""
    points = torus(600, 240)
    done = threading.Event()
    thread = threading.Thread(target=lambda: (pcl_floater.reconstruct(points), done.set()))
    switch = sys.getswitchinterval()
    thread.start()
    turns = 0
    while not done.wait(switch):
        turns += 1
    thread.join()
    assert turns > 2  # with the lock held, this thread would not wake before the end


def use_every_entry():
    for threads in (1, 2):
        points = torus(120, 50)
        mesh = pcl_floater.reconstruct(points, threads=threads)
        pcl_floater.vertex_normals(points, mesh.triangles, threads=threads)
        pcl_floater.texture_coordinates(points, mesh.triangles, threads=threads)
        pcl_floater.reconstruct(terrain(60), topology="disc", threads=threads)


def test_processes_that_are_forked_later():
    """As multiprocessing does: threads of the parent, also those of libraries, are not in the child."""
    use_every_entry()
    child = multiprocessing.get_context("fork").Process(target=use_every_entry)
    child.start()
    child.join(100)
    is_over = not child.is_alive()
    child.kill()
    assert is_over and child.exitcode == 0
