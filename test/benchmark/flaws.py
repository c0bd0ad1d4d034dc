#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many meshes come out without a flaw: of generated surfaces, or of clouds with a truth.

Without FOLDER: surfaces of pcl_floater_generate and boxes, of random size and number of holes, as they are, with
densities of 1 to 30, noisy, or thinned out at random, which leaves gaps. Prints for each kind how many are right, how
many boundary loops were taken for gaps and filled, how many gaps were kept open, how many meshes face the wrong way,
how many have other flaws, and of how many the report says that a loop or the front is not sure.

With FOLDER: all clouds that have a true mesh NAME.gt.ply on the same points beside them. Prints the flaws of each.
Scans (sensor_*) have to be of use. To see what hangs on a limit of a stage: run with --save, change the limit by a
fifth, build, and run with --against, which tells what changed.
"""
import collections
import hashlib
import json
import pathlib
import tempfile

import bench
import numpy as np

KINDS = {"height-field": "sheet", "cut-out": "sheet", "folded-sheet": "", "hemisphere": "body", "finger": "body",
         "sphere": "body", "torus": "body", "box": "body", "open-box": "body"}
VARIANTS = ("even", "uneven", "noisy", "thinned")


def box(random, n, is_open, ratio):
    """Jittered lattices on the faces of a box, with no point on its edges; the last face is its lid. Lengths are in
    spacings, and the spacing of a face is up to the root of the ratio wider than that of another one."""
    sides = random.uniform(1, 3, 3)
    sides *= np.sqrt(n / (2 * (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0])))
    faces = []
    for axis in range(3):
        others = [other for other in range(3) if other != axis]
        for at in (0, sides[axis])[:1 if is_open and axis == 2 else 2]:
            counts = np.maximum(3, (sides[others] / random.uniform(1, np.sqrt(ratio))).astype(int))
            cells = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1).reshape(-1, 2)
            points = np.full((len(cells), 3), float(at))
            points[:, others] = (cells + 0.5 + random.uniform(-0.2, 0.2, cells.shape)) * sides[others] / counts
            faces.append(points)
    return random.permutation(np.concatenate(faces))


def make_points(tools, kind, variant, random, seed, file):
    """Writes a surface; the number of its holes."""
    points, holes = int(random.integers(2000, 12000)), int(random.integers(1, 10)) if kind == "cut-out" else 0
    made, ratio = points * (2 if variant == "thinned" else 1), 30 if variant == "uneven" else 1
    noise = random.uniform(0.05, 0.2) if variant == "noisy" else 0
    if kind.endswith("box"):
        found = box(random, made, kind == "open-box", min(ratio, 4))
        bench.write_ply(file, found + noise * random.normal(size=found.shape))
    else:
        options = {"cut-out": {"holes": holes}, "finger": {"length": random.uniform(1, 10)},
                   "folded-sheet": {"gap": random.uniform(3, 8)}}.get(kind, {})
        tools.generate(kind, file, seed=seed, points=made, density_ratio=ratio, noise=noise, **options)
    if variant == "thinned":
        bench.write_ply(file, random.permutation(bench.read_ply(file)[0])[:points])
    return holes


def is_turned(mesh, shape):
    """Bodies have to face outwards, sheets up. Of a folded sheet, both sides are alike."""
    middles = mesh.points[mesh.triangles].mean(axis=1)
    if shape == "body":
        return ((middles - middles.mean(axis=0)) * mesh.normals).sum() < 0
    return shape == "sheet" and mesh.normals[:, 2].sum() < 0


def generated(tools, kind, variant, seed, folder):
    """Counts of what is wrong with one surface."""
    random = np.random.default_rng([seed, len(kind), VARIANTS.index(variant)])
    holes = make_points(tools, kind, variant, random, seed, folder / "points.ply")
    report = tools.reconstruct(folder / "points.ply", folder / "mesh.ply")
    if report["status"] != "SUCCESS":
        return collections.Counter(other=1)
    mesh, check = bench.Mesh(*bench.read_ply(folder / "mesh.ply")), report["check"]
    loops = holes + 1 if kind not in ("sphere", "torus", "box") else 0
    other = (mesh.components != 1 or mesh.genus != (kind == "torus") or not mesh.manifold or mesh.folds > 0 or
             check["self_intersections"] or len(mesh.used) < 0.999 * len(mesh.points))
    return collections.Counter(loops=loops, filled=max(0, loops - len(mesh.loops)), other=int(bool(other)),
                               kept=max(0, len(mesh.loops) - loops), turned=int(is_turned(mesh, KINDS[kind])),
                               unsure=int(bool(report["loop_decisions"]) or report["facing_certainty"] < 0.9))


def measure_generated(tools, arguments, folder):
    rows, total = [], collections.Counter()
    for kind in KINDS:
        for variant in VARIANTS:
            sums = collections.Counter()
            for seed in range(arguments.first, arguments.first + arguments.each):
                one = generated(tools, kind, variant, seed, folder)
                right = not (one["filled"] or one["kept"] or one["turned"] or one["other"])
                sums.update(one, right=right, cases=1, unsure_wrong=int(bool(one["unsure"]) and not right))
            total.update(sums)
            rows.append((f"{kind}, {variant}", sums))
    columns = ("cases", "right", "loops", "filled", "kept", "turned", "other", "unsure", "unsure_wrong")
    print(bench.markdown(["surfaces", *(name.replace("_", ", ") for name in columns)],
                         [[name, *(int(sums[column]) for column in columns)]
                          for name, sums in rows + [("all", total)]]))


def measure_folder(tools, arguments, folder):
    before = json.loads(arguments.against.read_text()) if arguments.against else {}
    verdicts, clean, changes = {}, collections.Counter(), []
    for file in sorted(arguments.folder.glob("*.gt.ply")):
        name, truth = file.name[:-len(".gt.ply")], bench.Mesh(*bench.read_ply(file))
        if len(truth.points) > arguments.most_points or arguments.only not in name:
            continue
        kind = "scans of use" if name.startswith("sensor_") else "clean"
        cloud = next(path for path in bench.clouds_of(arguments.folder) if path.stem == name)
        report = tools.reconstruct(cloud, folder / "mesh.ply")
        found, digest = [report["status"]], ""
        if report["status"] == "SUCCESS":
            mesh = bench.Mesh(*bench.read_ply(folder / "mesh.ply"))
            digest = hashlib.sha256(mesh.triangles.tobytes()).hexdigest()
            found = (bench.flaws_of_scan if kind != "clean" else bench.flaws)(mesh, truth)
        verdicts[name] = {"flaws": found, "mesh": digest}
        clean.update({f"{kind}": not found, f"of {kind}": 1})
        print(f"{name:28} {', '.join(found) or '-'}", flush=True)
        old = before.get(name)
        if old and old["mesh"] != digest:
            changes.append(f"{name}: {', '.join(old['flaws']) or 'no flaw'} -> {', '.join(found) or 'no flaw'}")
    for kind in ("clean", "scans of use"):
        if clean[f"of {kind}"]:
            print(f"{kind}: {int(clean[kind])} of {clean[f'of {kind}']}")
    if before:
        print(f"other meshes than before: {len(changes)}", *changes, sep="\n")
    if arguments.save:
        arguments.save.write_text(json.dumps(verdicts, indent=1))


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--each", type=int, default=10, metavar="N", help="surfaces of each kind (%(default)s)")
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="of the surfaces (%(default)s)")
    parser.add_argument("--only", default="", metavar="TEXT", help="clouds of FOLDER with this in their name")
    parser.add_argument("--most-points", type=int, default=150000, metavar="N", help="of a cloud (%(default)s)")
    parser.add_argument("--save", type=pathlib.Path, metavar="FILE", help="write the verdicts as JSON")
    parser.add_argument("--against", type=pathlib.Path, metavar="FILE", help="tell what changed since these verdicts")
    arguments = parser.parse_args()
    if arguments.folder and not arguments.folder.is_dir():
        parser.error(f"there is no folder {arguments.folder}")
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate")
    with tempfile.TemporaryDirectory() as folder:
        (measure_folder if arguments.folder else measure_generated)(tools, arguments, pathlib.Path(folder))


if __name__ == "__main__":
    main()
