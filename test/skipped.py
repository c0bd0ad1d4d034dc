#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells which tests of a run were skipped, and why.

Usage: skipped.py FILE, which ctest --output-junit has written
Prints a line for each reason, with the names of the tests.
"""
import collections
import re
import sys
import xml.etree.ElementTree


def reason(case):
    """What the test said as it was skipped: GoogleTest after a line of its own, other tests last."""
    said = case.findtext("system-out") or ""
    found = re.search(r"^\S+:\d+: Skipped\n+(.+)$", said, re.MULTILINE)
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    return found[1].strip() if found else lines[-1] if lines else "it told no reason"


def main():
    tests = collections.defaultdict(list)
    for case in xml.etree.ElementTree.parse(sys.argv[1]).iter("testcase"):
        if case.find("skipped") is not None:
            tests[reason(case).rstrip(":")].append(case.get("name").split("  # GetParam")[0])
    for why, names in tests.items():
        print(f"Skipped: {len(names)} {'test' if len(names) == 1 else 'tests'}, because {why}: {', '.join(names)}")


main()
