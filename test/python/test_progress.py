# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress, and what ends a run early. The runs are long enough that all happens within them."""
import contextlib
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pcl_floater
import pytest

from conftest import torus

# As a user would write it.
INTERRUPTED = """
import sys
import pcl_floater
sys.path.insert(0, sys.argv[1])
from conftest import torus

points = torus(2000, 800)  # which takes seconds
try:
    print("begin", flush=True)
    pcl_floater.reconstruct(points)
    print("done", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(5)
"""


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


@pytest.mark.parametrize("at", ["working set", "stars", "check"])
def test_exception_of_progress_ends_the_run(torus_points, at):
    told = []

    def progress(stage, fraction):
        told.append((stage, fraction))
        if stage == at:
            raise Stop(stage)

    with pytest.raises(Stop, match=at) as raised:
        pcl_floater.reconstruct(torus_points, progress=progress)
    assert told[-1][0] == at and [stage for stage, _ in told].count(at) == 1
    assert any("progress" in str(entry) for entry in raised.traceback)  # where it was raised


def test_wrong_progress_is_told(torus_points):
    with pytest.raises(TypeError):
        pcl_floater.reconstruct(torus_points, progress=lambda stage: None)


def test_system_exit_passes_through(torus_points):
    def progress(stage, fraction):
        sys.exit(3)
    with pytest.raises(SystemExit):
        pcl_floater.reconstruct(torus_points, progress=progress)


def test_ctrl_c_ends_a_program():
    child = subprocess.Popen([sys.executable, "-c", INTERRUPTED, str(pathlib.Path(__file__).parent)],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "begin\n"
        time.sleep(0.2)  # within the run, or before it
        child.send_signal(signal.SIGINT)
        output, errors = child.communicate(timeout=1800)
    finally:
        child.kill()
        child.wait()
    assert (child.returncode, output, errors) == (5, "interrupted\n", "")


@contextlib.contextmanager
def alarms(handler):
    """Calls the handler again and again. Alarms that come together are one."""
    previous = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)


def test_signals_are_handled_within_the_run():
    points = torus(400, 160)
    expected = pcl_floater.reconstruct(points).triangles
    calls = []
    with alarms(lambda number, frame: calls.append(number)):
        calls.clear()
        mesh = pcl_floater.reconstruct(points)
        within = len(calls)
    # At the begin, and after the run, they would be handled in any case.
    assert within > 3
    assert np.array_equal(mesh.triangles, expected)


def test_what_a_handler_raises_ends_the_run():
    points = torus(400, 160)
    calls = []

    def handler(number, frame):
        calls.append(number)
        if len(calls) == 4:  # so many are handled within the run only
            raise Stop

    with pytest.raises(Stop):
        with alarms(handler):
            calls.clear()
            pcl_floater.reconstruct(points)


def test_other_threads_run_meanwhile():
    """Another thread waits within the run, which can only end if both proceed."""
    in_run, go_on = threading.Event(), threading.Event()

    def progress(stage, fraction):
        in_run.set()
        assert go_on.wait(60)

    counted = []

    def other():
        assert in_run.wait(60)
        counted.append(len(pcl_floater.reconstruct(torus()).triangles))  # a run within the time of another
        go_on.set()

    thread = threading.Thread(target=other)
    thread.start()
    mesh = pcl_floater.reconstruct(torus(), progress=progress)
    thread.join()
    assert counted == [len(mesh.triangles)]


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


def test_runs_in_threads_give_the_same(torus_points, terrain_points):
    clouds = [torus_points, terrain_points] * 4
    expected = [pcl_floater.reconstruct(cloud).triangles for cloud in clouds[:2]]
    results = [None] * len(clouds)

    def work(number):
        results[number] = pcl_floater.reconstruct(clouds[number], threads=1).triangles

    threads = [threading.Thread(target=work, args=(number,)) for number in range(len(clouds))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, triangles in enumerate(results):
        assert np.array_equal(triangles, expected[number % 2])
