#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hashes of meshes, to show that a change of the code changes no mesh.

Clouds: those of the folder PCL_FLOATER_DATA, and samples of the generator. Each cloud with the defaults on one thread
and on two; one smooth and one noisy sample, and two real clouds, with each option that changes a mesh.
"""
import hashlib
import json
import pathlib
import tempfile

import bench

SAMPLES = {"height-field": {}, "hemisphere": {}, "finger": {}, "folded-sheet": {}, "cut-out": {}, "sphere": {},
           "torus": {}, "torus ": {"noise": 0.4}, "cut-out ": {"density_ratio": 20, "noise": 0.1}}
VARIED = ("hemisphere", "torus ", "bunny", "sensor_table_rgb")
OPTIONS = """
--method tw385
--topology disc
--topology disc --boundary consensus
--topology disc --boundary two-segments --domain square
--topology disc --domain polygon --sides 5 --spacing uniform --weights uniform
--topology disc --spacing centripetal --weights shape-preserving
--topology disc --weights inverse-distance --neighborhood nearest
--topology disc --neighborhood ball
--topology disc --neighborhood ball-delaunay
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


def hashes(tools, folder):
    """Each name of a cloud with options, and the hash of its mesh, or why there is none."""
    clouds, mesh = {}, folder / "mesh.ply"
    for kind, options in SAMPLES.items():
        clouds[kind] = folder / f"{len(clouds)}.ply"
        tools.generate(kind.strip(), clouds[kind], points=8000, **options)
    clouds.update((cloud.stem, cloud) for cloud in (bench.clouds_of(bench.DATA) if bench.DATA.is_dir() else []))
    for name, cloud in clouds.items():
        for options in ["-j1", "-j2", *(OPTIONS if name in VARIED else [])]:
            status = tools.reconstruct(cloud, mesh, *options.split())["status"]
            yield f"{name} {options}", hashlib.sha256(mesh.read_bytes()).hexdigest() if status == "SUCCESS" else status


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("mode", choices=("store", "check"), help="write the hashes, or tell which are others now")
    parser.add_argument("file", type=pathlib.Path, metavar="FILE")
    arguments = parser.parse_args()
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate")
    with tempfile.TemporaryDirectory() as folder:
        made = dict(hashes(tools, pathlib.Path(folder)))
    if arguments.mode == "store":
        arguments.file.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
        return
    known = json.loads(arguments.file.read_text(encoding="utf-8"))
    differing = [name for name in sorted(known.keys() | made.keys()) if known.get(name) != made.get(name)]
    print(f"{len(made)} meshes, {len(differing)} differ", *differing, sep="\n  ")
    if differing:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
