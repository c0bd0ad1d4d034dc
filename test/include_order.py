#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the order of the folders in src/: a file includes only from its own folder and from those
before it, and no chain of includes leads back to where it began. Also checks that each folder of
test/core is one of src/."""
import graphlib
import pathlib
import re
import sys

ORDER = ["core", "points", "local", "mesh", "floater", "consensus", "view", "texture", "options", "report", "input",
         ".", "pcl_class"]
# Parts of the floater folder; each includes only from those before it.
WITHIN_FLOATER = ["floater/boundary", "floater/solvers", "floater"]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)

root = pathlib.Path(__file__).resolve().parent.parent
src = root / "src"


def rank(path):
    folder = str(pathlib.PurePosixPath(path).parent)
    top = folder.split("/")[0]
    if top not in ORDER:
        sys.exit(f"src/{path}: the folder {top} has no place in the order {' '.join(ORDER)}")
    part = WITHIN_FLOATER.index(folder) if folder in WITHIN_FLOATER else 0
    return ORDER.index(top), part


def main():
    files = sorted(p for p in src.rglob("*") if p.suffix in (".h", ".cpp"))
    if not files:
        sys.exit(f"{src}: no sources found")
    wrong = []
    includes = {}
    for file in files:
        name = file.relative_to(src).as_posix()
        includes[name] = [i for i in INCLUDE.findall(file.read_text()) if (src / i).is_file()]
        wrong += [f"src/{name} includes {i}, which comes after it"
                  for i in includes[name] if rank(i) > rank(name)]

    try:
        graphlib.TopologicalSorter(includes).prepare()
    except graphlib.CycleError as error:
        wrong.append("cycle: " + " -> ".join(error.args[1]))
    folders = {d.name for d in src.iterdir() if d.is_dir()}
    wrong += [f"test/core/{d.name} mirrors no folder of src"
              for d in (root / "test" / "core").iterdir() if d.is_dir() and d.name not in folders]
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"include order: {len(files)} files, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
