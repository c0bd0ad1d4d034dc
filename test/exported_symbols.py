#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the shared library exports every symbol of a list: programs that were linked with an
earlier build need them. Symbols that are not in the list are named, and are no failure.

usage: exported_symbols.py [--update] LIBRARY LIST

The list has the symbols of the namespace pcl::floater and those of the class for one type of points,
demangled, one a line. --update writes it anew.
"""
import os
import re
import subprocess
import sys

OURS = re.compile(r"(?:(?:vtable|typeinfo|typeinfo name|VTT) for )?"
                  r"pcl::(?:floater::|FloaterReconstruction<pcl::PointXYZ>)")
STRING = re.compile(r"std::(?:__cxx11::)?basic_string<char, std::char_traits<char>, std::allocator<char>\s*>")
ALLOCATOR = ", std::allocator<"


def exported(library):
    nm = os.environ.get("NM", "nm")
    lines = subprocess.run([nm, "-D", "-C", "--defined-only", library], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    names = [line.split(maxsplit=2)[2] for line in lines if len(line.split(maxsplit=2)) == 3]
    return {readable(name) for name in names if OURS.match(name)}


def readable(name):
    """The name without the default arguments of the standard library's templates."""
    name = STRING.sub("std::string", name)
    while ALLOCATOR in name:
        first = name.index(ALLOCATOR)
        last = first + len(ALLOCATOR)
        while name[first:last].count("<") > name[first:last].count(">"):
            last += 1
        name = name[:first] + name[last:]
    return re.sub(r"\s+>", ">", name)


def main():
    arguments = [a for a in sys.argv[1:] if a != "--update"]
    if len(arguments) != 2:
        sys.exit(__doc__)
    library, path = arguments
    found = exported(library)
    if "--update" in sys.argv[1:]:
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(name + "\n" for name in sorted(found))
        return 0
    with open(path, encoding="utf-8") as file:
        wanted = {line.rstrip("\n") for line in file if line.strip()}
    if not wanted:
        sys.exit(f"{path}: no symbols")
    missing = sorted(wanted - found)
    print(*(f"not in the list: {name}" for name in sorted(found - wanted)),
          *(f"no longer exported: {name}" for name in missing), sep="\n")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
