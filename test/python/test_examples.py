# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run, and the code in the documentation of the functions does."""
import doctest
import subprocess
import sys

import pcl_floater
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
    assert doctest.testmod(pcl_floater, extraglobs=names).attempted == 3
    assert doctest.testmod(pcl_floater, extraglobs=names).failed == 0


def test_examples_were_found():
    assert len(EXAMPLES) == 3
