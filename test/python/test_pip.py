# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`pip install ./tools/python` into a new virtual environment, without a network. The module is that
of this build, so that nothing is compiled again."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT

needed = {"pip": "python3-pip", "setuptools": "python3-setuptools", "wheel": "python3-wheel",
          "ensurepip": "python3-venv"}
missing = [package for name, package in needed.items() if importlib.util.find_spec(name) is None]
USE = """
import numpy as np
import pcl_floater
i, j = np.mgrid[:20, :20]
mesh = pcl_floater.reconstruct(np.stack([i, j, np.sin(0.3 * i)], -1).reshape(-1, 3))
print(pcl_floater.__version__, pcl_floater.__file__, len(mesh.triangles))
"""


def changed_files():
    """What git tells of the folder of the sources; nothing on a machine without git."""
    command = ["git", "-C", str(ROOT), "status", "--porcelain"]
    return subprocess.run(command, capture_output=True).stdout if shutil.which("git") else None


@pytest.mark.skipif(bool(missing), reason=f"not installed: Debian's {' '.join(missing)}")
def test_install_use_and_remove(tmp_path):
    before = changed_files()
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(environment)], check=True)
    python = environment / "bin" / "python"
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*command):
        done = subprocess.run([str(python), *command], env=variables, cwd=tmp_path, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, done.stdout
        return done.stdout

    run("-m", "pip", "install", "--no-index", "--no-build-isolation", str(ROOT / "tools" / "python"))
    version, file, triangles = run("-c", USE).split()
    package = pathlib.Path(file).parent
    assert environment in package.parents and int(triangles) == 2 * 19 * 19
    assert {"__init__.py", "__init__.pyi", "py.typed"} <= {path.name for path in package.iterdir()}
    assert f"Version: {version}" in run("-m", "pip", "show", "pcl_floater")
    run("-m", "pip", "uninstall", "--yes", "pcl_floater")
    assert not package.exists()
    # Nothing was left in the folders of the sources.
    assert changed_files() == before
