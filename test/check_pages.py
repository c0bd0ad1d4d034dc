#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md and the pages in doc.

check_pages.py           links: every relative link leads to a file, and every #part to a heading.
                         quotes: a block of code after <!-- quote: FILE --> is in FILE, line by line;
                         every program in test/examples is quoted.
                         names: the pages have every option, setter, part of DiscOptions and status.
check_pages.py FOLDER... runs the blocks of commands after <!-- run -->, with the tools in these folders,
                         those of one page in one new folder, in order, where PCL_FLOATER is the folder
                         of the project. Each block must succeed. A block
                         after <!-- output --> follows one: each of its lines must be in that output,
                         where numbers may differ, and "..." stands for any text."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"(?<!\\)\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
MARKED_BLOCK = re.compile(
    r"^<!-- (quote: (?P<file>\S+)|run|output) -->\n\n?```\w*\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")


def headings(path):
    """The anchors that GitHub makes of the headings of a page."""
    anchors = set()
    for heading in re.findall(r"^#+ +(.*?) *$", CODE.sub("", path.read_text()), re.MULTILINE):
        anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        number = 0
        while anchor + (f"-{number}" if number else "") in anchors:
            number += 1
        anchors.add(anchor + (f"-{number}" if number else ""))
    return anchors


def check_links(page):
    for target in LINK.findall(re.sub(r"`[^`\n]*`", "", CODE.sub("", page.read_text()))):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, part = target.partition("#")
        file = page.parent / path if path else page
        if not file.exists():
            yield f"the link {target} is dead"
        elif part and file.suffix == ".md" and part not in headings(file):
            yield f"the link {target} leads to no heading"


def lines_of(text):
    return [line.strip() for line in textwrap.dedent(text).splitlines() if line.strip()]


def check_quotes(page, quoted):
    for block in MARKED_BLOCK.finditer(page.read_text()):
        name = block["file"]
        if not name:
            continue
        file = ROOT / name
        if not file.is_file():
            yield f"{name}, which is quoted, does not exist"
            continue
        quoted.add(file)
        wanted, there = lines_of(block["text"]), lines_of(file.read_text())
        starts = range(len(there) - len(wanted) + 1)
        if not wanted or all(there[i:i + len(wanted)] != wanted for i in starts):
            first = next((line for line in wanted if line not in there), "the order of the lines")
            yield f"the code is not that of {name}: {first}"


def check_names():
    """Whatever a user can set, and how a run can end, has its place in the pages."""
    state, options, report, *tables = ((ROOT / name).read_text() for name in (
        "include/pcl/surface/floater/reconstruction_state.h", "include/pcl/surface/floater/options.h",
        "include/pcl/surface/floater/report.h", "tools/reconstruct/option_table.cpp",
        "tools/reconstruct/command_line.cpp"))

    def body(kind, name, text):
        return re.search(kind + " " + name + r"\n\{(.*?)^\};", text, re.MULTILINE | re.DOTALL)[1]

    def enumerators(name):
        return set(re.findall(r"^  ([A-Z_]+)\b", body("enum class", name, report), re.MULTILINE))
    wanted = {
        "doc/options.md":
            set(re.findall(r'"(?:-\w,)?(--[a-z][a-z-]+)"', "".join(tables))) - {"--help", "--version"} |
            set(re.findall(r"\bvoid (set\w+) \(", state)) |
            set(re.findall(r"^  [\w:<> ]+ (\w+)(?: = [^;]*)?;", "".join(
                body("struct", name, options) for name in ("BoundaryOptions", "DomainOptions", "SolverOptions")),
                re.MULTILINE)),
        "doc/troubleshooting.md": enumerators("RunStatus") | {
            name.lower() for name in enumerators("FindingId") - {"COUNT"}}}
    for page, names in wanted.items():
        text = (ROOT / page).read_text()
        if len(names) < 10:
            yield f"{page}: too few names were found that it should have"
        yield from (f"{page} does not have {name}" for name in sorted(names)
                    if not re.search(rf"(?<![\w-]){name}(?![\w-])", text))


def pattern(line):
    """What a line of an output must match, whatever its numbers are."""
    parts = [NUMBER.sub("0", part) for part in line.strip().split("...")]
    return re.compile(".*".join(re.escape(part) for part in parts))


def check_runs(page, tools):
    environment = dict(os.environ, PATH=os.pathsep.join([*tools, os.environ["PATH"]]), PCL_FLOATER=str(ROOT))
    output = ""
    with tempfile.TemporaryDirectory() as folder:
        for block in MARKED_BLOCK.finditer(page.read_text()):
            kind = block[1]
            if kind == "run":
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", block["text"]], cwd=folder, text=True,
                                      env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                output = [" ".join(NUMBER.sub("0", line).split()) for line in done.stdout.splitlines()]
                if done.returncode != 0:
                    yield f"this fails with exit code {done.returncode}:\n{block['text']}{done.stdout}"
            elif kind == "output":
                for line in lines_of(block["text"]):
                    if not any(pattern(" ".join(line.split())).fullmatch(there) for there in output):
                        yield f"the output does not have this line: {line}"


def main():
    tools = [str(pathlib.Path(folder).resolve()) for folder in sys.argv[1:]]
    wrong, quoted = [], set()
    for page in [ROOT / "README.md"] + sorted((ROOT / "doc").glob("*.md")):
        if tools and page.name == "distributed.md" and not shutil.which("pcl_floater_distributed",
                                                                        path=os.pathsep.join(tools)):
            continue  # it is not built without MPI
        checks = [check_runs(page, tools)] if tools else [check_links(page), check_quotes(page, quoted)]
        wrong += [f"{page.relative_to(ROOT)}: {what}" for check in checks for what in check]
    if not tools:
        wrong += check_names()
        wrong += [f"{file.relative_to(ROOT)} is quoted by no page"
                  for file in sorted((ROOT / "test/examples").iterdir())
                  if file.suffix in (".cpp", ".py") and file not in quoted]
    for what in wrong:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
