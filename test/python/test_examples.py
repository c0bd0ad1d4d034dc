# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run, and the code in the documentation of the functions does."""
import doctest
import subprocess
import sys

import pcl_floater
import pcl_floater._on_meshes
import pytest

from conftest import ROOT, torus

EXAMPLES = sorted((ROOT / "test/examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_ends_well(example, tmp_path):
    done = subprocess.run([sys.executable, str(example)], cwd=tmp_path, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    assert "Traceback" not in done.stdout


def test_documentation_is_true():
    names = {**vars(pcl_floater), "points": torus(100, 40)}
    for module, examples in ((pcl_floater, 3), (pcl_floater._on_meshes, 6)):
        tested = doctest.testmod(module, extraglobs=names)
        assert (tested.attempted, tested.failed) == (examples, 0)


def test_examples_were_found():
    assert len(EXAMPLES) == 3
