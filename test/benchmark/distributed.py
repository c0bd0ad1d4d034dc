#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time, memory and traffic of pcl_floater_distributed, against pcl_floater_reconstruct on the same points.

Makes height fields, reconstructs each in memory and on some processes, with files and with messages. Prints a table.
"""
import pathlib
import re
import shutil
import tempfile
import time

import bench


def measure(tools, n, folder, arguments):
    """A row of the table."""
    cloud, one, many, work = (folder / name for name in ("cloud.ply", "one.ply", "many.ply", "work"))

    def distributed(*options):
        """Seconds, what it told, and the size of its files."""
        limit = ["--max-memory", arguments.max_memory] if arguments.max_memory else []
        start = time.perf_counter()
        done = bench.run(["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n",
                          arguments.processes, tools.program("distributed"), "--work", work, *limit, *options, cloud,
                          many])
        seconds = time.perf_counter() - start
        if done.returncode != 0 or not arguments.alone and one.read_bytes() != many.read_bytes():
            bench.fail(f"another mesh, or none: {done.stderr}")
        size = sum(file.stat().st_size for file in work.iterdir())
        shutil.rmtree(work)
        return seconds, done.stderr, size

    tools.generate("height-field", cloud, points=n)
    alone, messages = ["-", "-"], "-"
    if not arguments.alone:
        start = time.perf_counter()
        memory = tools.reconstruct(cloud, one)["peak_memory_bytes"]
        in_memory = time.perf_counter() - start
        alone = [f"{in_memory:.1f} s", f"{memory / 1e6:.0f} MB"]
        told = distributed("--exchange", "messages")[1]
        messages = f"{1e6 * float(re.search(r'^messages: ([0-9.]+) MB$', told, re.MULTILINE)[1]) / n:.0f} bytes a point"
    seconds, told, size = distributed()
    peak = max(map(int, re.findall(r"peak memory (\d+) MB$", told, re.MULTILINE)))
    return [n, *alone, f"{seconds:.1f} s", "-" if arguments.alone else f"{seconds / in_memory:.2f}", f"{peak} MB",
            f"{size / n:.0f} bytes a point", messages]


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("--folder", type=pathlib.Path, help="with 600 bytes for each point (default: a temporary one)")
    parser.add_argument("--processes", type=int, default=2, metavar="N", help="(%(default)s)")
    parser.add_argument("--max-memory", metavar="SIZE", help="limit of process 0 for the steps of the whole cloud")
    parser.add_argument("--alone", action="store_true", help="only the processes, with files: no reconstruction in "
                        "memory, which takes 270 bytes for each point")
    parser.add_argument("points", nargs="*", type=int, default=[1000000, 10000000, 30000000], metavar="POINTS")
    arguments = parser.parse_args()
    tools = bench.Tools(arguments.build, "pcl_floater_reconstruct", "pcl_floater_generate", "pcl_floater_distributed")
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        print(bench.markdown(["points", "in memory", "memory", f"{arguments.processes} processes", "ratio",
                              "memory of a process", "files", "messages"],
                             [measure(tools, n, pathlib.Path(folder), arguments) for n in arguments.points]))


if __name__ == "__main__":
    main()
