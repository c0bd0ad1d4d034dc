# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What arrives, what is refused, and in which words; how a run fails; progress, and what ends a run early."""
import inspect
import multiprocessing
import pickle
import re
import signal
import subprocess
import sys
import threading

import numpy as np
import pcl_floater
import pytest
from conftest import terrain, torus
from files import OTHER_VALUES, crosses  # of test/tool

SQUARE = np.zeros((9, 3))
BESIDES = {"normals", "use_input_normals", "sensor_origin", "loop", "strict", "progress"}


@pytest.mark.parametrize("name", OTHER_VALUES)
def test_option_arrives(terrain_points, name):
    default = pcl_floater.reconstruct(terrain_points, threads=2).report["options"]
    options = pcl_floater.reconstruct(terrain_points, **{"threads": 2, name: OTHER_VALUES[name]}).report["options"]
    changed = {other: options[other] for other in options if options[other] != default[other]}
    assert changed.pop(name) == OTHER_VALUES[name] and (name == "method" or not changed)


def test_what_is_no_option_arrives(terrain_points):
    assert set(inspect.signature(pcl_floater.reconstruct).parameters) == {"points", *OTHER_VALUES, *BESIDES}
    rim = [*range(0, 30), *range(59, 899, 30), *range(899, 869, -1), *range(840, 0, -30)]
    assert set(pcl_floater.reconstruct(terrain_points, loop=np.array(rim)).loop) == set(rim)
    down = np.tile([[0.5, 0.0, -1.0]], (len(terrain_points), 1))
    for arguments in {}, dict(normals=down), dict(normals=down, use_input_normals=True):
        mesh = pcl_floater.reconstruct(terrain_points, **arguments)
        assert ((crosses(mesh)[:, 2] > 0) == (not arguments)).mean() > 0.9
        assert mesh.report["options"]["use_input_normals"] == ("use_input_normals" in arguments)
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, 48), np.linspace(-0.4, 0.4, 40))
    depth = np.where((abs(u) < 0.2) & (abs(v) < 0.2), 4.0, 6.0) + u  # of a box before a wall
    scan = np.stack([u * depth, v * depth, depth], -1).reshape(-1, 3) + [1.0, 2.0, 3.0]
    viewpoint = pcl_floater.reconstruct(scan, sensor_origin=(1, 2, 3)).report["viewpoint"]
    assert viewpoint["place"] == pytest.approx([1, 2, 3])


@pytest.mark.parametrize("arguments, kind, text", [
    (dict(points=np.zeros((5, 3), int)), TypeError, "points must be an array of float32 or float64, not int64; "
                                                    "numpy.asarray(points, float) converts it"),
    (dict(points=np.zeros((5, 3), ">f4")), TypeError, "not >f4"),
    (dict(points="scan.pcd"), TypeError, "not <U8"),
    (dict(points=np.zeros(5, [("x", "f4"), ("y", "f4"), ("z", "f4")])), TypeError,
     "points is an array with the fields x, y, z; use numpy.column_stack"),
    (dict(points=np.ma.zeros((5, 3))), TypeError, "points is a masked array, whose mask would be lost"),
    (dict(points=np.zeros((5, 4))), ValueError,
     "points must have the shape (n, 3) or (rows, columns, 3), not (5, 4)"),
    (dict(points=np.zeros((2, 2, 5, 3))), ValueError, "not (2, 2, 5, 3)"),
    (dict(points=1.5), ValueError, "not ()"),
    (dict(points=np.broadcast_to(np.zeros((1, 3)), (2**31, 3))), ValueError,  # which takes no memory
     "more than 2147483647 points"),
    (dict(normals=np.zeros((9, 2))), ValueError, "normals must have the shape (n, 3) or (rows, columns, 3), not (9, 2)"),
    (dict(normals=np.zeros((8, 3))), ValueError, "there are 8 normals of 9 points"),
    (dict(normals=np.zeros((9, 3), int)), TypeError, "normals must be an array of float32 or float64"),
    (dict(normals=SQUARE, facing="up"), ValueError, "normals are given, but facing does not ask for them"),
    (dict(use_input_normals=True), ValueError, "use_input_normals=True needs normals"),
    (dict(sensor_origin=(1, 2)), ValueError, "sensor_origin must be three numbers, not (1, 2)"),
    (dict(sensor_origin=(1, 2, np.nan)), ValueError, "sensor_origin must have finite coordinates"),
    (dict(topology="ring"), ValueError, "topology must be one of 'auto', 'disc', 'surface', not 'ring'"),
    (dict(viewpoint=None), TypeError, "'none' says that the cloud is no single scan"),
    (dict(viewpoint="here"), ValueError, "viewpoint must be 'auto', 'none' or three numbers, not 'here'"),
    (dict(neighbors=5), ValueError, "neighbors must be from 6 to 200"),
    (dict(neighbors=20.0), TypeError, "neighbors must be a whole number, not 20.0"),
    (dict(threads=2**31), ValueError, "threads must be a number of 32 bits"),
    (dict(max_edge=False), TypeError, "max_edge must be a number, not False"),
    (dict(holes="by-size", largest_hole=1, largest_hole_length=1), ValueError, "give one of them"),
    (dict(denoise=1), TypeError, "denoise must be True or False, not 1"),
    (dict(strict="yes"), TypeError, "strict must be True or False, not 'yes'"),
    (dict(progress=1), TypeError, "progress must be a callable, not 1"),
    (dict(loop=[[0, 1, 2]]), ValueError, "not an array of the shape (1, 3)"),
    (dict(loop=[0.0, 1.0, 2.0]), TypeError, "loop must be a list of whole numbers, not of float64"),
    (dict(loop=[0, -1, 2]), ValueError, "loop has an index that is negative, or too large"),
    (dict(thread=1), TypeError, "thread"),
])
def test_wrong_arguments(arguments, kind, text):
    with pytest.raises(kind, match=re.escape(text)) as raised:
        pcl_floater.reconstruct(**{"points": SQUARE, **arguments})
    assert not isinstance(raised.value, pcl_floater.FloaterError)


# The memory is limited after all libraries have been loaded.
WITHOUT_MEMORY = """
import resource
import numpy as np
import pcl_floater
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 2**28, used + 2**28))
try:
    pcl_floater.reconstruct(np.broadcast_to(np.zeros((1, 3)), (2**26, 3)))
except MemoryError:
    print("no memory")
i, j = np.mgrid[:9, :9]
print(len(pcl_floater.reconstruct(np.stack([i, j, 0.1 * i], -1).reshape(-1, 3), threads=1).triangles))
"""


def test_no_memory_for_the_points():
    done = subprocess.run([sys.executable, "-c", WITHOUT_MEMORY], stdout=subprocess.PIPE, text=True)
    assert (done.returncode, done.stdout) == (0, "no memory\n128\n")


@pytest.mark.parametrize("points, arguments, status, text", [
    (np.zeros((0, 3)), {}, "NO_INPUT", "the input cloud is empty"),
    (np.full((9, 3), np.nan), {}, "TOO_FEW_POINTS", ""),
    (np.outer(np.arange(9.0), [1, 1, 1]), {}, "DEGENERATE", ""),
    (np.zeros((9, 3)), dict(loop=[0, 1]), "INVALID_LOOP", "fewer than 3 points"),
])
def test_failures(points, arguments, status, text):
    with pytest.raises(pcl_floater.FloaterError, match=text) as raised:
        pcl_floater.reconstruct(points, **arguments)
    error = raised.value
    assert isinstance(error, RuntimeError) and error.status == status
    assert error.report["status"] == status and error.report["message"] == str(error) != ""
    assert error.report["input"]["points"] == len(points)
    assert error.report["non_finite"] == np.flatnonzero(np.isnan(points[:, 0])).tolist()
    clone = pickle.loads(pickle.dumps(error))
    assert (str(clone), clone.status, clone.report) == (str(error), status, error.report)


def test_strict_refuses_lost_points_and_poor_meshes(terrain_points):
    assert pcl_floater.reconstruct(terrain_points, strict=True).report["strict"] is True
    mesh = pcl_floater.reconstruct(terrain_points, kept_loops=3)
    assert len(mesh.warnings) == 1 and mesh.report["strict"] is False
    assert mesh.report["warnings"] == list(mesh.warnings)
    assert mesh.report["verdict"] == {"value": "good", "cause": "", "remedy": ""}
    island = np.array([[1e3 + i, j, 0] for i in range(6) for j in range(6)])
    with pytest.raises(pcl_floater.FloaterError) as raised:
        pcl_floater.reconstruct(np.vstack([terrain_points, island]), topology="disc", strict=np.bool_(True))
    assert raised.value.status == raised.value.report["status"] == "REFUSED"
    assert str(raised.value) == "36 points are in no triangle, which strict does not allow"


# The runs are long enough that all happens within them.
def test_progress_is_told(torus_points):
    told = []
    mesh = pcl_floater.reconstruct(
        torus_points, progress=lambda stage, fraction: told.append((stage, fraction, threading.get_ident())))
    stages, fractions, threads = zip(*told)
    assert fractions == tuple(sorted(fractions)) and fractions[-1] == 1.0
    assert all(type(fraction) is float for fraction in fractions)
    assert set(stages) <= set(mesh.report["seconds"]) and "neighbors" in stages and "check" in stages
    assert set(threads) == {threading.get_ident()}


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
