#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long clouds take that are hard on a reconstruction, and how much memory.

Prints the user seconds of the tool, the least of some runs, by point in microseconds, the factor to an ordinary cloud
of as many points, the peak memory, the stage that took most, and how the run ended.
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
    return np.indices([round(n ** (1 / 3))] * 3).reshape(3, -1).T.astype(float)


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
    points = np.repeat(terrain(max(n // in_each, 50)), in_each, axis=0)
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


def segments(n, ends):
    """Straight ones, with equal steps."""
    ends, t = np.asarray(ends, float), (np.arange(n // len(ends)) / (n // len(ends)))[:, None]
    return np.concatenate([a * (1 - t) + b * t for a, b in ends])


def quadrilateral(n):
    corners = np.array([[0, 0, 0], [1, 0, 0.4], [1.1, 1, 0], [0, 0.9, 0.5]])
    return segments(n, list(zip(corners, np.roll(corners, -1, axis=0))))


def cube_edges(n):
    corners = lattice(8)
    return np.unique(segments(n, [(a, b) for i, a in enumerate(corners) for b in corners[i + 1:]
                                  if abs(a - b).sum() == 1]), axis=0)


def pencil(n, lines):
    return segments(n, [(np.zeros(3), u) for u in unit(rng().normal(size=(lines, 3)))])


def ball(n):
    i = np.arange(n)
    z = 1 - (2 * i + 1) / n
    return circle(np.pi * (1 + 5 ** 0.5) * i, np.sqrt(1 - z * z), z)


def hair(n, hairs):
    return segments(n, [(u, 1.5 * u) for u in ball(hairs)])


def square(n, height=0.0):
    return np.append(rng().random((n, 2)), np.full((n, 1), height), axis=1)


def planes(n, many):
    turns = np.linalg.qr(rng().normal(size=(many, 3, 3)))[0]
    points = square(n // many * many) - [0.5, 0.5, 0]
    return np.einsum("nij,nj->ni", np.repeat(turns, n // many, axis=0), points)


def pages(n):
    """Of a book: twelve half planes from one edge."""
    turns = np.repeat(TURN * np.arange(12) / 12, n // 12)
    points = square(len(turns))
    return circle(turns, points[:, 0], points[:, 1])


def linked_rings(n):
    ring = circle(TURN * np.arange(n // 2) / (n // 2), 1, 0)
    return np.concatenate([ring, ring[:, [0, 2, 1]] + [1, 0, 0]])


def cube_lattice(n):
    side = round(np.sqrt(n / 6))
    a, b = np.divmod(np.arange(side * side), side)
    return np.unique(np.concatenate([np.stack(np.roll([a, b, np.full_like(a, s)], axis, axis=0), axis=1)
                                     for axis in range(3) for s in (0, side - 1)]), axis=0).astype(float)


def dust(n, corners, ratio):
    """Of an iterated function system."""
    random, at = rng(), np.zeros((n, 3))
    for _ in range(40):
        at = ratio * at + (1 - ratio) * corners[random.integers(len(corners), size=n)]
    return at


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
    ("edges of four", "the edges of a skew quadrilateral", quadrilateral),
    ("cube edges", "the edges of a cube", cube_edges),
    ("body and edges", "a ball beside the skew quadrilateral",
     lambda n: np.concatenate([ball(n // 2) - [2, 0, 0], quadrilateral(n // 2)])),
    ("edges, jitter", "the quadrilateral with a jitter of 1e-6",
     lambda n: quadrilateral(n) + 1e-6 * rng().normal(size=(n // 4 * 4, 3))),
    ("30 segments", "at random places", lambda n: segments(n, rng().random((30, 2, 3)))),
    ("200 segments", "the same, more", lambda n: segments(n, rng().random((200, 2, 3)))),
    ("pencil", "20 segments from one point", lambda n: pencil(n, 20)),
    ("thick pencil", "300 of them", lambda n: pencil(n, 300)),
    ("hair", "segments that stand off a ball without points", lambda n: hair(n, 100)),
    ("hairy ball", "the same with half of the points on the ball",
     lambda n: np.concatenate([ball(n // 2), hair(n // 2, 50)])),
    ("sheet and line", "a segment through a square",
     lambda n: np.concatenate([square(n // 2), segments(n // 2, [((.5, .5, -1), (.6, .5, 1))])])),
    ("moment curve", "all its tetrahedra are Delaunay ones",
     lambda n: np.stack([np.linspace(0, 1, n) ** power for power in (1, 2, 3)], axis=1)),
    ("linked rings", "two circles", linked_rings),
    ("helix", "63 points on each turn", lambda n: circle(0.1 * np.arange(n), 1, 0.001 * np.arange(n))),
    ("even helix", "a cylinder", lambda n: circle(TURN * 1.618 * np.arange(n), 1, np.arange(n) / n)),
    ("fan", "40 segments from a point in a plane",
     lambda n: segments(n, [((0, 0, 0), end) for end in circle(TURN * np.arange(40) / 40, 1, 0)])),
    ("pages", "twelve half planes from one edge", pages),
    ("2 planes", "through one point", lambda n: planes(n, 2)),
    ("10 planes", "through one point", lambda n: planes(n, 10)),
    ("100 planes", "through one point", lambda n: planes(n, 100)),
    ("onion", "20 balls in each other",
     lambda n: np.concatenate([r * ball(n // 20) for r in np.linspace(0.9, 1, 20)])),
    ("stack", "20 squares, a tenth of a spacing apart",
     lambda n: np.concatenate([square(n // 20, h) for h in np.arange(20) / np.sqrt(n / 20) / 10])),
    ("flat lattice", "all on circles",
     lambda n: np.stack([*np.divmod(np.arange(n), round(np.sqrt(n))), np.zeros(n)], axis=1)),
    ("cube lattice", "on the faces of a cube", cube_lattice),
    ("Cantor dust", "of three dimensions", lambda n: dust(n, lattice(8), 1 / 3)),
    ("Sierpinski", "the tetrahedron of that name",
     lambda n: dust(n, np.array([[0, 0, 0], [1, 1, 0], [1, 0, 1], [0, 1, 1]]), 0.5)),
    ("flat box", "random points, a millionth as high", lambda n: rng().random((n, 3)) * [1, 1, 1e-6]),
    ("thin box", "random points, a thousandth as wide and high", lambda n: rng().random((n, 3)) * [1, 1e-3, 1e-3]),
    ("all scales", "a ball of radii from 1e-16 to 1e21", lambda n: ball(n) * 10 ** rng().uniform(-16, 21, (n, 1))),
    ("far cloud", "a ball in a cloud a million times as wide",
     lambda n: np.concatenate([ball(n // 2), 1e5 * rng().normal(size=(n // 2, 3))])),
    ("rings of a cone", "40 of them",
     lambda n: np.concatenate([circle(TURN * np.arange(n // 40) / (n // 40), r, 0.2 * r)
                               for r in np.linspace(0.1, 1, 40)])),
    ("lattice walk", "a random walk on a lattice that is closed in itself",
     lambda n: np.unique(np.eye(3)[rng().integers(3, size=2 * n)].cumsum(axis=0) % 40, axis=0)[:n]),
    ("hyperboloid", "sixteen straight lines on one",
     lambda n: segments(n, [((np.cos(a), np.sin(a), -1), (np.cos(a + 2), np.sin(a + 2), 1))
                            for a in TURN * np.arange(16) / 16])),
    ("far point", "a height field and one point far away",  # less far than what is taken for a gross outlier
     lambda n: np.append(terrain(n - 1), 300 * np.sqrt(n) * np.array([[1, 0.5, 0.2]]), axis=0)),
    ("band", "a narrow ring, all holes filled", band, *CLOSED),
    ("bowl", "half a sphere, all holes filled", lambda n: generated("hemisphere", n), *CLOSED),
    ("random view", "rays with random depths, viewpoint given", random_view, "--viewpoint", "0,0,0"))


def main():
    global TOOLS
    parser = bench.parser(__doc__)
    parser.add_argument("--points", type=int, nargs="+", default=[2000, 8000, 20000], metavar="N",
                        help="of each cloud (2000 8000 20000)")
    parser.add_argument("--times", type=int, default=1, metavar="N", help="runs of each cloud (%(default)s)")
    parser.add_argument("--time-limit", type=int, default=600, metavar="S", help="of a run (%(default)s)")
    parser.add_argument("--only", metavar="NAME", help="one cloud, beside the ordinary one")
    parser.add_argument("--list", action="store_true", help="tell what the clouds are")
    parser.add_argument("--strict", action="store_true",
                        help="end with 1 if a cloud of the largest size takes more than 300 microseconds a point or "
                             "200 MB; limits of small clouds are in seconds")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(f"{name:16} {meaning}" for name, meaning, *_ in CLOUDS))
        return
    TOOLS = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate")
    print(f"{'cloud':16} {'points':>7} {'user s':>8} {'us/point':>8} {'factor':>7} {'MB':>5}   {'slowest':12} "
          f"{'outcome':15} triangles")
    too_much = []
    with tempfile.TemporaryDirectory() as folder:
        cloud, mesh = pathlib.Path(folder) / "points.ply", pathlib.Path(folder) / "mesh.ply"
        for points in arguments.points:
            ordinary = None
            for name, _, make, *options in CLOUDS:
                if arguments.only not in (None, name) and ordinary:
                    continue
                bench.write_ply(cloud, make(points))
                try:
                    runs = [TOOLS.reconstruct(cloud, mesh, *options, seconds=arguments.time_limit)
                            for _ in range(arguments.times)]
                except TimeoutError:
                    print(f"{name:16} {points:7} over {arguments.time_limit} s", flush=True)
                    too_much.append(name)
                    continue
                seconds = min(run["user_seconds"] for run in runs)
                ordinary = ordinary or seconds
                by_point, megabytes = 1e6 * seconds / points, min(run["peak_memory_bytes"] for run in runs) / 1e6
                stages = {stage: value for stage, value in runs[0]["seconds"].items() if stage != "reconstruction"}
                print(f"{name:16} {points:7} {seconds:8.2f} {by_point:8.0f} {seconds / ordinary:7.1f} {megabytes:5.0f}   "
                      f"{max(stages, key=stages.get):12} {runs[0]['status']:15} "
                      f"{runs[0]['statistics']['triangles']:9}", flush=True)
                if points == max(arguments.points) and (by_point > 300 or megabytes > 200):
                    too_much.append(name)
    if arguments.strict and too_much:
        bench.fail("too much for " + ", ".join(sorted(set(too_much))))


if __name__ == "__main__":
    main()
