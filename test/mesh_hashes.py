#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hashes of meshes, to show that a change of the code changes no mesh.

Usage: mesh_hashes.py store BUILD FILE   writes the hashes of the meshes that the tools in BUILD make
       mesh_hashes.py check BUILD FILE   makes them again; prints those that differ, and exits with 1 if any does
Clouds: those in PCL_FLOATER_DATA (default: ../shared/data), and samples of the generator in BUILD. Each cloud
with the defaults on one thread and on two; one smooth and one noisy sample, and two real clouds, with each option
that changes a mesh.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SAMPLES = {"height-field": [], "hemisphere": [], "finger": [], "folded-sheet": [], "cut-out": [], "sphere": [],
           "torus": [], "torus ": ["--noise", "0.4"], "cut-out ": ["--density-ratio", "20", "--noise", "0.1"]}
VARIED = ("hemisphere", "torus ", "bunny", "sensor_table_rgb")
OPTIONS = """
--method tw385
--topology disc
--topology disc --boundary consensus
--topology disc --boundary two-segments --domain square
--topology disc --domain polygon --sides 5 --spacing uniform --weights uniform
--topology disc --domain own-shape --spacing centripetal --weights shape-preserving
--topology disc --weights inverse-distance --neighborhood nearest
--topology disc --neighborhood ball
--topology disc --neighborhood ball-delaunay
--topology disc --solver superlu
--topology disc --solver bicgstab-ilut
--topology disc --solver gauss-seidel --tolerance 1e-6
--topology disc --ordering metis
--topology disc --ordering reverse-cuthill-mckee
--topology surface --holes close-all
--holes keep-largest
--holes keep-count --kept-loops 2
--holes by-size --largest-hole 20
--viewpoint none
--viewpoint 0,0,0
--facing outwards
--facing up
--max-edge-ratio 4
--min-component 100
--remove-outliers off
--scatter drop
--denoise off
--flips off
--uncross off
--open-crossings on
--neighbors 12
--sheet-filter off
--uv
--shift auto
--normals
""".strip().splitlines()


def run(tool, cloud, options, folder):
    """Hash of the mesh, or the exit code."""
    output = pathlib.Path(folder, "mesh.ply")
    output.unlink(missing_ok=True)
    done = subprocess.run([tool, "--quiet", *options, cloud, output], capture_output=True, check=False)
    if done.returncode != 0:
        return f"exit code {done.returncode}"
    return hashlib.sha256(output.read_bytes()).hexdigest()


def hashes(build, folder):
    """Each name of a cloud with options, and its hash."""
    clouds = {}
    for kind, options in SAMPLES.items():
        path = os.path.join(folder, f"{len(clouds)}.ply")
        subprocess.run([build / "tools/generate/pcl_floater_generate", kind.strip(), path, "--points", "8000", *options],
                       check=True, capture_output=True)
        clouds[kind] = path
    data = pathlib.Path(os.environ.get("PCL_FLOATER_DATA", ROOT / "../shared/data"))
    clouds.update((path.stem, str(path)) for path in sorted(data.glob("*.pcd")))
    for name, path in clouds.items():
        varied = OPTIONS if name in VARIED else []
        for options in ["-j1", "-j2", *varied]:
            yield f"{name} {options}", run(build / "tools/reconstruct/pcl_floater_reconstruct", path, options.split(), folder)


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in ("store", "check"):
        sys.exit(__doc__)
    mode, build, file = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as folder:
        made = dict(hashes(build, folder))
    if mode == "store":
        file.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
        return
    known = json.loads(file.read_text(encoding="utf-8"))
    differing = [name for name in sorted(known.keys() | made.keys()) if known.get(name) != made.get(name)]
    print(f"{len(made)} meshes, {len(differing)} differ", *differing, sep="\n  ")
    sys.exit(bool(differing))


main()
