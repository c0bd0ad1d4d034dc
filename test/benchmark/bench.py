# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: the programs, their reports, meshes, tables and charts."""
import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

try:
    import numpy as np
    from scipy import sparse
    from scipy.sparse import csgraph
except ImportError as error:
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {error}; tools/install_packages.sh --benchmarks installs it for "
             "/usr/bin/python3")

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DATA = pathlib.Path(os.environ.get("PCL_FLOATER_DATA", ROOT.parent / "shared/data"))
FOLD = -0.5  # cosine of 120 degrees: triangles whose normals differ by more are folded


def fail(text):
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {text}")


def parser(doc):
    made = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--build", type=pathlib.Path, metavar="FOLDER",
                      help="use the programs of this build folder, instead of building them")
    return made


def run(command, seconds=0):
    """Ends it after so many seconds, 0: never, and raises TimeoutError. The peak memory of a process is at least that
    of the one that started it, so that a small one comes between. The result has user_seconds, too."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    limit = ["timeout", "--foreground", "--kill-after=10", str(seconds)]
    done = subprocess.run([*limit, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode in (124, 137):
        raise TimeoutError
    done.user_seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return done


def clouds_of(folder):
    """Its clouds in order, without truths."""
    return sorted(file for file in folder.iterdir()
                  if file.suffix in (".pcd", ".ply", ".obj") and not file.name.endswith(".gt.ply"))


def chosen_clouds(given, names=None):
    """What the command line names, or these clouds of the data folder (all of it without names)."""
    if not given and not DATA.is_dir():
        fail(f"there is no folder {DATA}; name clouds, or set PCL_FLOATER_DATA")
    clouds = given or ([DATA / f"{name}.pcd" for name in names] if names else clouds_of(DATA))
    for cloud in clouds:
        if not os.access(cloud, os.R_OK):
            fail(f"cannot read '{cloud}'")
    return clouds


class Tools:
    """The programs of a build folder."""

    def __init__(self, build, *targets):
        self.build = build or ROOT / "build/bench"
        if build:
            return
        subprocess.run(["bash", ROOT / "tools/install_packages.sh", "--benchmarks"], check=True)
        print("Building (the first time takes minutes) ...", flush=True)
        for command in (["cmake", "--preset", "bench"],
                        ["cmake", "--build", "--preset", "bench", "--target", *targets]):
            done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if done.returncode != 0:
                fail("the build failed:\n" + done.stdout[-4000:])

    def program(self, name):
        return self.build / "tools" / name / f"pcl_floater_{name}"

    def generate(self, kind, file, **options):
        values = [part for name, value in options.items() for part in ("--" + name.replace("_", "-"), str(value))]
        subprocess.run([self.program("generate"), kind, file, *values], check=True, stdout=subprocess.DEVNULL)

    def reconstruct(self, cloud, mesh, *options, seconds=0):
        """The report, with user_seconds of the process. Of a cloud that is refused, it tells why."""
        report = pathlib.Path(f"{mesh}.json")
        for old in (report, pathlib.Path(mesh)):
            old.unlink(missing_ok=True)
        done = run([self.program("reconstruct"), "--quiet", "--report", report, *options, cloud, mesh], seconds)
        if not report.exists():
            fail(f"{cloud}: no report, exit code {done.returncode}: {done.stderr.strip()}")
        return dict(json.loads(report.read_text()), user_seconds=done.user_seconds)

    def picture(self, *arguments):
        subprocess.run([self.program("picture"), *map(str, arguments)], check=True)


def write_ply(path, points):
    """In double precision, as some clouds need."""
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(points) +
                   b"".join(b"property double %c\n" % axis for axis in b"xyz") + b"end_header\n")
        file.write(np.ascontiguousarray(points, "<f8").tobytes())


def read_ply(path):
    """Positions, and triangles if there are any."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header, types = data[:end].decode(), {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4", "uint": "<u4",
                                          "float32": "<f4", "float64": "<f8", "uint8": "u1", "int32": "<i4"}
    vertices = int(re.search(r"element vertex (\d+)", header)[1])
    faces = int((re.search(r"element face (\d+)", header) or (0, 0))[1])
    fields = re.findall(r"property (\w+) (\w+)\n", header.split("element face")[0])
    row = np.dtype([(name, types[kind]) for kind, name in fields])
    if "format ascii" in header:
        lines = data[end:].split(b"\n")
        points = np.array([line.split()[:3] for line in lines[:vertices]], float)
        return points, np.array([line.split()[1:4] for line in lines[vertices:vertices + faces]], int).reshape(-1, 3)
    found = np.frombuffer(data, row, vertices, end)
    points = np.stack([found[axis].astype(float) for axis in "xyz"], axis=1)
    triangle = np.dtype([("corners", "u1"), ("points", "<i4", 3)])
    return points, np.frombuffer(data, triangle, faces, end + row.itemsize * vertices)["points"].astype(int)


class Mesh:
    """Triangles on points, and what can be counted on them without the code of the library."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles
        a, b, c = (points[triangles[:, corner]] for corner in range(3))
        self.normals = np.cross(b - a, c - a)  # twice as long as the area
        lengths = np.linalg.norm(self.normals, axis=1)
        self.area = 0.5 * lengths.sum()
        sides = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
        owner = np.tile(np.arange(len(triangles)), 3)
        order = np.lexsort(np.sort(sides, axis=1).T)
        sides, owner = sides[order], owner[order]
        same = (np.sort(sides[1:], axis=1) == np.sort(sides[:-1], axis=1)).all(axis=1)
        pairs = np.flatnonzero(same)
        alone = ~(np.append(same, False) | np.append(False, same))
        self.edges = np.unique(np.sort(sides, axis=1), axis=0)
        self.boundary = sides[alone]
        left, right = owner[pairs], owner[pairs + 1]
        joined = sparse.coo_matrix((np.ones(len(left)), (left, right)), shape=(len(triangles),) * 2)
        self.components, self.component = csgraph.connected_components(joined, False)
        unit = self.normals / np.maximum(lengths, 1e-300)[:, None]
        folded = (unit[left] * unit[right]).sum(axis=1) < FOLD
        self.folds = int((folded & (lengths[left] > 0) & (lengths[right] > 0)).sum())
        self.manifold = bool((np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)[1] <= 2).all() and
                             (sides[pairs] == sides[pairs + 1][:, ::-1]).all())
        self.used = np.unique(triangles)
        self.euler = len(self.used) - len(self.edges) + len(triangles)
        of_loop = csgraph.connected_components(self._graph(self.boundary), False)[1]
        ends = np.unique(self.boundary)
        self.loops = sorted((ends[of_loop[ends] == loop] for loop in np.unique(of_loop[ends])), key=len, reverse=True)
        self.genus = (2 * self.components - self.euler - len(self.loops)) // 2

    def _graph(self, edges):
        return sparse.coo_matrix((np.ones(len(edges)), edges.T), shape=(len(self.points),) * 2)

    def point_normals(self):
        sums = np.zeros_like(self.points)
        for corner in range(3):
            np.add.at(sums, self.triangles[:, corner], self.normals)
        return sums / np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]

    def inside_out(self, normals):
        """Components that face against these normals of the points."""
        agreement = (self.normals * normals[self.triangles].sum(axis=1)).sum(axis=1)
        return int((np.bincount(self.component, agreement) < 0).sum())

    def unmatched_loops(self, truth):
        """Loops that are none of the truth, and loops of the truth that are closed: each of those takes the longest
        loop of which half the points are within two edges of it."""
        spread = truth._graph(truth.edges)
        spread = (spread + spread.T).tocsr()
        free = []
        for loop in truth.loops:
            near = np.zeros(len(truth.points))
            near[loop] = 1
            free.append(near + spread @ near + spread @ (spread @ near) > 0)
        spurious = 0
        for loop in self.loops:
            match = next((i for i, near in enumerate(free) if 2 * near[loop].sum() >= len(loop)), None)
            if match is None:
                spurious += 1
            else:
                del free[match]
        return spurious, len(free)


def flaws(mesh, truth):
    """What is wrong with a mesh on the points of a true one, in a word or two each."""
    spurious, closed = mesh.unmatched_loops(truth)
    found = {"unused points": len(truth.used) - len(mesh.used) > 0.001 * len(truth.points),
             "not manifold": not mesh.manifold, "spurious loops": spurious, "loops closed": closed,
             "components": mesh.components != truth.components, "Euler": mesh.euler != truth.euler,
             "folds": mesh.folds > truth.folds, "inside out": mesh.inside_out(truth.point_normals()),
             "area": abs(mesh.area / truth.area - 1) > 0.01}
    return [name for name, is_wrong in found.items() if is_wrong]


def flaws_of_scan(mesh, truth):
    """The same of a scan, whose truth is the lattice of its sensor: it has to be of use."""
    edges, true_edges = len(mesh.boundary), len(truth.boundary)
    found = {"unused points": len(truth.used) - len(mesh.used) > 0.01 * len(truth.points),
             "not manifold": not mesh.manifold, "components": mesh.components > 2 * truth.components + 10,
             "boundary": edges > 1.5 * true_edges, "folds": mesh.folds > max(truth.folds, len(mesh.triangles) / 2000),
             "area": abs(mesh.area / truth.area - 1) > 0.05}
    return [name for name, is_wrong in found.items() if is_wrong]


def power_law(points, values):
    """Factor and exponent nearest to the figures, by least squares of the logarithms; None if there is no law."""
    if len(set(points)) < 2 or min(values) <= 0:
        return None
    exponent, logarithm = np.polyfit(np.log(points), np.log(values), 1)
    return np.exp(logarithm), exponent


def markdown(columns, rows):
    lines = [columns, ["---"] + ["---:"] * (len(columns) - 1), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"


class ReportFolder:
    """report.md, with pictures beside it."""

    def __init__(self, name):
        self.folder = pathlib.Path.cwd() / "floater_result" / name
        self.folder.mkdir(parents=True, exist_ok=True)
        self.text = ""

    def add(self, text):
        self.text += text + "\n\n"

    def table(self, columns, rows):
        self.add(markdown(columns, rows))

    def picture(self, file, caption):
        self.add(f"![{caption}]({file})\n\n{caption}")

    def chart(self, name, series, quantity):
        """Points and power laws, both axes logarithmic. series: name -> (points, values)"""
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
        figure, axes = pyplot.subplots(figsize=(10, 6.5))
        for label, (points, values) in series.items():
            law = power_law(points, values)
            if law:
                dots = axes.loglog(points, values, "o")[0]
                ends = np.array([min(points), max(points)], float)
                axes.loglog(ends, law[0] * ends ** law[1], color=dots.get_color(), label=f"{label}, N^{law[1]:.2f}")
        if axes.lines:
            axes.set(xlabel="points", ylabel=quantity)
            axes.legend()
            figure.savefig(self.folder / f"{name}.png", bbox_inches="tight")
            self.picture(f"{name}.png", f"{name.replace('_', ' ')}: {quantity} against points")
        pyplot.close(figure)

    def finish(self):
        (self.folder / "report.md").write_text(self.text, encoding="utf-8")
        print(self.folder / "report.md")


def machine():
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return (f"Cores: {os.cpu_count()}." + (f" Processor: {model[1]}." if model else "") +
            f" Load average: {os.getloadavg()[0]:.1f}. {time.strftime('%Y-%m-%d')}.")
