#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long clouds take that are hard on a reconstruction.

Prints the user seconds of the tool, the least of some runs, the factor to an ordinary cloud of as many points, the
stage that took most, and how the run ended.
"""
import pathlib
import tempfile

import bench
import numpy as np

TURN = 2 * np.pi
TOOLS = None


def rng():
    return np.random.default_rng(1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def generated(kind, n, **options):
    with tempfile.TemporaryDirectory() as folder:
        TOOLS.generate(kind, pathlib.Path(folder) / "points.ply", points=n, **options)
        return bench.read_ply(pathlib.Path(folder) / "points.ply")[0]


def terrain(n, seed=1):
    return generated("height-field", n, seed=seed)


def lattice(n):
    side = np.arange(round(n ** (1 / 3)))
    return np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3).astype(float)


def curves(n):
    """Smooth curves through a box, sampled evenly, with a jitter of the distances of their points."""
    random, step, in_each = rng(), 0.002, 500
    direction = unit(random.normal(size=(n // in_each, 3)))
    at, points = random.random((n // in_each, 3)), []
    for _ in range(in_each):
        points.append(at + 0.1 * step * random.normal(size=at.shape))
        direction = unit(direction + 0.05 * random.normal(size=at.shape))
        at = at + step * direction
    return np.concatenate(points)


def clumps(n, in_each):
    """Around places in a box, a hundredth as wide as their distance."""
    middle = np.repeat(rng().random((n // in_each, 3)), in_each, axis=0)
    return middle + 0.01 / np.cbrt(n / in_each) * np.random.default_rng(2).normal(size=middle.shape)


def groups(n, in_each):
    """Points a millionth of a spacing apart, on a height field."""
    points = np.repeat(terrain(n // in_each), in_each, axis=0)
    return points + 1e-6 * rng().normal(size=points.shape)


def leaves(n, in_each=40, width=0.02):
    random, m = rng(), n // in_each
    u = unit(random.normal(size=(m, 1, 3)))
    v = unit(np.cross(u, random.normal(size=(m, 1, 3))))
    r, angle = width * np.sqrt(random.random((m, in_each, 1))), TURN * random.random((m, in_each, 1))
    return (random.random((m, 1, 3)) + r * np.cos(angle) * u + r * np.sin(angle) * v).reshape(-1, 3)


def circle(angle, radius, height):
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height + 0 * angle], axis=1)


def skew_lines(n):
    """Their Delaunay tetrahedra are quadratic in number."""
    points = np.zeros((n, 3))
    points[0::2, 0] = rng().random(len(points[0::2]))
    points[1::2, 1], points[1::2, 2] = np.random.default_rng(2).random(len(points[1::2])), 1
    return points


def density_jump(n):
    rows = int(np.sqrt(n / 2))
    y, x = np.divmod(np.arange(rows * rows), rows)
    sheet = np.stack([x, y, 0 * x], axis=1) + 0.4 * rng().random((rows * rows, 3)) * [1, 1, 0]
    return np.concatenate([sheet / 100, sheet + [1 + rows / 100, 0, 0]])


def band(n, rows=4):
    i, random, around = np.arange(n), rng(), n // rows
    radius = around / TURN + 0.2 * random.random(n)
    return circle(TURN * (i // rows) / around, radius, i % rows + 0.2 * random.random(n))


def random_view(n):
    random = rng()
    rays = np.append(random.random((n, 2)) - 0.5, np.ones((n, 1)), axis=1)
    return rays * (1 + random.random((n, 1)))


def spike(n, around=50):
    i = np.arange(n)
    radius = 1e-12 ** (i // around * around / n)
    return circle(TURN * (i % around) / around, radius, -10 * radius)


CLOSED = ("--holes", "close-all")
# Name, what it is, points, options of the tool.
CLOUDS = (
    ("ordinary", "a height field", terrain),
    ("noise", "the same with noise of one spacing", lambda n: terrain(n) + rng().normal(size=(n, 3))),
    ("box", "random points in a box", lambda n: rng().random((n, 3))),
    ("lattice", "a cubic lattice", lattice),
    ("wires", "curves with a jitter of a tenth of their spacing", curves),
    ("walk", "a random walk", lambda n: rng().normal(size=(n, 3)).cumsum(axis=0)),
    ("leaves", "discs of 40 points that lie anyhow", leaves),
    ("clumps of 10", "tight clumps at random places", lambda n: clumps(n, 10)),
    ("clumps of 1000", "the same, larger", lambda n: clumps(n, 1000)),
    ("pairs", "a height field of pairs 1e-6 spacings apart", lambda n: groups(n, 2)),
    ("groups of 50", "the same with groups of 50", lambda n: groups(n, 50)),
    ("last bits", "a hundred places, points apart by the last bits",
     lambda n: np.resize(rng().random((100, 3)), (n, 3)) + 1e-15 * np.random.default_rng(2).normal(size=(n, 3))),
    ("sheets", "two sheets a tenth of a spacing apart",
     lambda n: np.concatenate([terrain(n // 2), terrain(n // 2, 2) + [0, 0, 0.1]])),
    ("hub", "a ring around one point",
     lambda n: np.append(circle(TURN * np.arange(n - 1) / (n - 1), 1, 0), [[0, 0, 0.1]], axis=0)),
    ("skew lines", "two of them", skew_lines),
    ("spike", "circles that shrink to the last bits", spike),
    ("density jump", "spacings of 1 and 100 side by side", density_jump),
    ("far point", "a height field and one point far away",  # less far than what is taken for a gross outlier
     lambda n: np.append(terrain(n - 1), 300 * np.sqrt(n) * np.array([[1, 0.5, 0.2]]), axis=0)),
    ("band", "a narrow ring, all holes filled", band, *CLOSED),
    ("bowl", "half a sphere, all holes filled", lambda n: generated("hemisphere", n), *CLOSED),
    ("random view", "rays with random depths, viewpoint given", random_view, "--viewpoint", "0,0,0"))


def main():
    global TOOLS
    parser = bench.parser(__doc__)
    parser.add_argument("--points", type=int, default=50000, metavar="N", help="of each cloud (%(default)s)")
    parser.add_argument("--times", type=int, default=1, metavar="N", help="runs of each cloud (%(default)s)")
    parser.add_argument("--time-limit", type=int, default=600, metavar="S", help="of a run (%(default)s)")
    parser.add_argument("--only", metavar="NAME", help="one cloud, beside the ordinary one")
    parser.add_argument("--list", action="store_true", help="tell what the clouds are")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(f"{name:16} {meaning}" for name, meaning, *_ in CLOUDS))
        return
    TOOLS = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate")
    print(f"{'cloud':16} {'user s':>8} {'factor':>7}   {'slowest':12} {'outcome':15} triangles")
    ordinary = None
    with tempfile.TemporaryDirectory() as folder:
        cloud, mesh = pathlib.Path(folder) / "points.ply", pathlib.Path(folder) / "mesh.ply"
        for name, _, make, *options in CLOUDS:
            if arguments.only not in (None, name) and ordinary:
                continue
            bench.write_ply(cloud, make(arguments.points))
            try:
                runs = [TOOLS.reconstruct(cloud, mesh, *options, seconds=arguments.time_limit)
                        for _ in range(arguments.times)]
            except TimeoutError:
                print(f"{name:16} over {arguments.time_limit} s", flush=True)
                continue
            seconds = min(run["user_seconds"] for run in runs)
            ordinary = ordinary or seconds
            stages = {stage: value for stage, value in runs[0]["seconds"].items() if stage != "reconstruction"}
            print(f"{name:16} {seconds:8.2f} {seconds / ordinary:7.1f}   {max(stages, key=stages.get):12} "
                  f"{runs[0]['status']:15} {runs[0]['statistics']['triangles']:9}", flush=True)


if __name__ == "__main__":
    main()
