#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what the table of options (src/options/option_rows.h) says into doc/options.md and the stubs of the Python module.

Usage: make_options.py [--check] FOLDER
FOLDER has the built package pcl_floater: build/dev/tools/python. With --check nothing is written, and the exit code is
1 if something would be.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BY_METHOD = ("boundary", "ordering")  # None in Python: the method chooses


def word(value):
    return f"`{value}`" if isinstance(value, str) else {True: "`on`", False: "`off`"}.get(value, f"{value:g}") \
        if isinstance(value, bool) else f"{value:g}"


def table(rows, group):
    lines = ["| tool | class | default | values | meaning |", "|---|---|---|---|---|"]
    for row in rows:
        if row["group"] == group:
            names = [f"`-{row['letter']}`"] if row["letter"] else []
            names.append("`--" + row["name"].replace("_", "-") + "`")
            values = row["values"]
            values = ", ".join(map(word, values)) if isinstance(values, list) else values
            lines.append(f"| {', '.join(names)} | `{row['class']}` | {word(row['default'])} | {values} | {row['text']} |")
    return "\n".join(lines) + "\n"


def stub(rows):
    lines = []
    for row in rows:
        words = "Literal[%s]" % ", ".join(f'"{value}"' for value in row["values"]) if row["kind"] == "word" else ""
        kind = {"place": 'Union[Literal["auto", "none"], Sequence[float]]', "word": words}.get(row["kind"], row["kind"])
        default = repr(row["default"]).replace("'", '"')
        if row["name"] in BY_METHOD:
            kind, default = f"Optional[{kind}]", "None"
        lines.append(f"    {row['name']}: {kind} = {default},\n")
    return "".join(lines)


def main(arguments):
    is_check = arguments[:1] == ["--check"]
    if len(arguments) != 1 + is_check:
        sys.exit(__doc__)
    sys.path.insert(0, arguments[-1])
    from pcl_floater import _core
    rows = _core.options()
    page, stubs = ROOT / "doc/options.md", ROOT / "tools/python/pcl_floater/__init__.pyi"
    texts = {
        page: re.sub(r"(<!-- options: (.*) -->\n)(?:\|.*\n)*", lambda m: m[1] + table(rows, m[2]), page.read_text()),
        stubs: re.sub(r"(writes these\.\n).*?(?=    # End)", lambda m: m[1] + stub(rows), stubs.read_text(), flags=re.S)}
    changed = [path for path, text in texts.items() if path.read_text() != text]
    for path in changed:
        print(f"{path.relative_to(ROOT)} is not what the table says" if is_check else path.relative_to(ROOT))
        if not is_check:
            path.write_text(texts[path])
    sys.exit(bool(changed) and is_check)


if __name__ == "__main__":
    main(sys.argv[1:])
