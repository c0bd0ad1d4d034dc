#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the points: pcl_floater, pcl::GreedyProjectionTriangulation, CGAL's advancing front.

Prints seconds and memory side by side, and the exponents of their growth. Writes floater_result/scaling/runs.json in
the working directory, which has all runs, with the seconds of their stages. The methods run in turn, each run in a
process of its own. Figures are medians of the repeated runs: the time from the points in memory to the triangles in
memory, the user time of the process (CPU time), and its largest resident set. floater has all defaults; gp3 the settings
in peers.cpp, with the search for its normals; afs runs in one thread.
CLOUD: point clouds (.pcd, .ply or .obj); default: some of the folder PCL_FLOATER_DATA, if it exists
"""
import json
import pathlib
import statistics
import tempfile

import bench

SIZES = (10000, 30000, 100000, 300000, 1000000, 3000000)
REPEATED_UP_TO = 300000  # points; the times of larger clouds vary little
METHODS = ("floater", "floater-disc", "gp3", "afs")
# Scans without rough noise, closed and open, from 11 to 206 thousand points.
CLOUDS = ("spot_closed", "bunny", "hill_lidar", "igea", "field_lidar")
# Merged views, depth cameras, lasers turned by hand, by a car and by an aircraft: doc/memory_and_speed.md says where
# they are from.
SCANS = ("tum_rabbit", "raw_milk", "sensor_office", "sensor_table_rgb", "raw_room_scan", "raw_ring_lidar", "hill_lidar",
         "raw_slope_lidar", "raw_roofs_trees")


def run_once(tools, method, cloud, folder, arguments):
    """Figures of one run, or {"outcome": why there are none}."""
    try:
        if method.startswith("floater"):
            options = ["--threads", arguments.threads] + (["--topology", "disc"] if method == "floater-disc" else [])
            report = tools.reconstruct(cloud, folder / "mesh.ply", *options, seconds=arguments.time_limit)
            if report["status"] != "SUCCESS":
                return {"outcome": report["status"]}
            stages = {name: value for name, value in report["seconds"].items()
                      if value > 0 and name not in ("reading", "reconstruction")}
            return {"seconds": report["seconds"]["reconstruction"], "peak_bytes": report["peak_memory_bytes"],
                    "cpu_seconds": report["user_seconds"], "triangles": report["statistics"]["triangles"],
                    "used_points": report["statistics"]["used_points"], "stages": stages}
        done = bench.run([tools.build / f"test/benchmark/pcl_floater_{method}", cloud, arguments.threads],
                         arguments.time_limit)
        if done.returncode != 0:
            return {"outcome": f"failed ({done.returncode})"}
        return dict(json.loads(done.stdout), cpu_seconds=done.user_seconds)
    except TimeoutError:
        return {"outcome": f"over {arguments.time_limit} s"}


def median(runs):
    """Of each figure of the runs that ended well; else the first outcome that is something else."""
    bad = [run for run in runs if "outcome" in run]
    if bad:
        return bad[0]
    return {"runs": len(runs), **{name: statistics.median(run[name] for run in runs)
                                  for name in runs[0] if name != "stages"}}


def measure(tools, surface, cloud, points, file, folder, arguments, given_up):
    """One measurement of each method; repeats begin with another method."""
    name = pathlib.Path(file).stem if surface == "clouds" else cloud
    methods = [method for method in arguments.methods if (surface, method) not in given_up and
               (method != "floater-disc" or surface == "height-field")]
    repeats = 1 if points > REPEATED_UP_TO else arguments.repeats
    runs = {method: [] for method in methods}
    for repeat in range(repeats):
        for place in range(len(methods)):
            method = methods[(place + repeat) % len(methods)]
            if any("outcome" in run for run in runs[method]):
                continue
            runs[method].append(run_once(tools, method, file, folder, arguments))
            if runs[method][-1].get("outcome", "").startswith("over") and surface != "clouds":
                given_up.add((surface, method))  # larger ones would take even longer
    for method in methods:
        one = median(runs[method])
        print(f"{name:20} {points:9,} points  {method:13}", one.get("outcome") or f"{one['seconds']:.3f} s", flush=True)
        yield dict(one, surface=surface, cloud=name, points=points, method=method, all=runs[method])


def tell(all_of_them, arguments):
    """Writes runs.json; prints seconds and memory side by side, and exponents."""
    folder = pathlib.Path("floater_result/scaling")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "runs.json").write_text(json.dumps(all_of_them, indent=1))
    cells = {(one["cloud"], one["points"]): {} for one in all_of_them}
    for one in all_of_them:
        cells[one["cloud"], one["points"]][one["method"]] = one.get("outcome") or (
            f"{one['seconds']:.2f} s, {one['peak_bytes'] / 1e6:.0f} MB")
    print(bench.markdown(["cloud", "points", *arguments.methods],
                         [[cloud, f"{points:,}", *(row.get(method, "-") for method in arguments.methods)]
                          for (cloud, points), row in cells.items()]))
    exponents = []
    for surface in dict.fromkeys(one["surface"] for one in all_of_them):
        for method in arguments.methods:
            good = [one for one in all_of_them
                    if "outcome" not in one and (one["surface"], one["method"]) == (surface, method)]
            laws = [bench.power_law([one["points"] for one in good], [one[key] for one in good])
                    for key in ("seconds", "cpu_seconds", "peak_bytes")] if good else []
            if good:
                exponents.append([surface, method] + [f"{law[1]:.2f}" if law else "-" for law in laws])
    print("p of the power law c N^p nearest to the figures:\n")
    print(bench.markdown(["surface", "method", "time", "CPU time", "memory"], exponents) + bench.machine())


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("--scans", type=pathlib.Path, nargs="?", const=True, metavar="FOLDER",
                        help="real scans instead, of all methods but floater-disc: all clouds of FOLDER, or those of "
                             "several sensors in PCL_FLOATER_DATA")
    parser.add_argument("--largest", type=int, default=3000000, metavar="N", help="leave out clouds with more points; "
                        "100000 takes 1 to 2 minutes (%(default)s)")
    parser.add_argument("--repeats", type=int, default=3, metavar="N",
                        help="runs, of which the median is shown; above 300000 points, one (%(default)s)")
    parser.add_argument("--methods", default=",".join(METHODS), help="some of %(default)s")
    parser.add_argument("--surfaces", default="height-field,sphere,torus",
                        help="kinds of pcl_floater_generate, or none (%(default)s)")
    parser.add_argument("--time-limit", type=int, default=600, metavar="S",
                        help="seconds after which a run is ended, and larger ones are left out (%(default)s)")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="0: one for each core")
    parser.add_argument("clouds", nargs="*", type=pathlib.Path, metavar="CLOUD")
    arguments = parser.parse_args()
    surfaces = [] if arguments.scans or arguments.surfaces == "none" else arguments.surfaces.split(",")
    arguments.methods = [method for method in arguments.methods.split(",")
                         if not (arguments.scans and method == "floater-disc")]
    if not set(arguments.methods) <= set(METHODS):
        parser.error(f"--methods: some of {', '.join(METHODS)}")
    if isinstance(arguments.scans, pathlib.Path):
        arguments.clouds += bench.clouds_of(arguments.scans)
    if arguments.clouds or arguments.scans or bench.DATA.is_dir():
        arguments.clouds = bench.chosen_clouds(arguments.clouds, SCANS if arguments.scans else CLOUDS)
    else:
        print(f"Skipped: the real clouds, because there is no folder {bench.DATA}")
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate", "pcl_floater_peers")
    measured, given_up = [], set()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for surface in surfaces:
            for size in SIZES:
                if size <= arguments.largest:
                    tools.generate(surface, folder / "points.ply", points=size)
                    measured += measure(tools, surface, surface, size, folder / "points.ply", folder, arguments,
                                        given_up)
        for cloud in arguments.clouds:
            points = tools.reconstruct(cloud, folder / "mesh.ply")["statistics"]["cloud_points"]
            if points > arguments.largest:
                print(f"Skipped: {cloud.stem}, because it has {points} points")
                continue
            measured += measure(tools, "clouds", cloud.stem, points, cloud, folder, arguments, given_up)
    tell(measured, arguments)


if __name__ == "__main__":
    main()
