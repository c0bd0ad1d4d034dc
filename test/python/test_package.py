# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The stubs, the documentation and the tool say what the module does; the examples run; pip installs it."""
import ast
import doctest
import importlib.util
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import typing

import pcl_floater
import pcl_floater._on_meshes
import pytest

from conftest import ROOT, torus

STUB = pathlib.Path(pcl_floater.__file__).with_name("__init__.pyi")


@pytest.fixture(scope="module")
def stub():
    return {node.name: node for node in ast.parse(STUB.read_text()).body if hasattr(node, "name")}


FUNCTIONS = ("reconstruct", "texture_coordinates", "vertex_normals")


@pytest.mark.parametrize("function", FUNCTIONS)
def test_signature_is_that_of_the_stub(stub, function):
    arguments = stub[function].args
    parameters = inspect.signature(getattr(pcl_floater, function)).parameters
    assert [a.arg for a in arguments.args] == [name for name, p in parameters.items()
                                               if p.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD]
    in_stub = {a.arg: ast.literal_eval(default) for a, default in zip(arguments.kwonlyargs, arguments.kw_defaults)}
    in_module = {name: p.default for name, p in parameters.items() if p.kind is inspect.Parameter.KEYWORD_ONLY}
    assert in_module and list(in_stub.items()) == list(in_module.items())
    assert len(arguments.args) + len(in_stub) == len(parameters)


def test_classes_are_those_of_the_stub(stub, terrain_points):
    assert {name for name in stub if not name.startswith("_")} == set(pcl_floater.__all__)
    mesh = pcl_floater.reconstruct(terrain_points)
    texture = pcl_floater.texture_coordinates(mesh.points, mesh.triangles)
    for made in (mesh, texture):
        members = {getattr(node, "name", None) or node.target.id for node in stub[type(made).__name__].body}
        members = {name for name in members if not name.startswith("_")}
        assert members == {name for name in dir(made) if not name.startswith("_")}
        attributes = inspect.getdoc(type(made))
        for name in members:
            assert re.search(rf"^{name} : ", attributes, re.MULTILINE), name
    in_stub = [a.arg for node in stub["FloaterError"].body if isinstance(node, ast.FunctionDef) for a in node.args.args]
    assert in_stub == list(inspect.signature(pcl_floater.FloaterError.__init__).parameters)


def test_stub_and_page_have_the_table_of_options():
    made = subprocess.run([sys.executable, ROOT / "doc/make_options.py", "--check",
                           pathlib.Path(pcl_floater.__file__).parent.parent], capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stdout + made.stderr
    names = {}
    exec(compile(STUB.read_text(), str(STUB), "exec"), names)  # all in it can be evaluated
    types = typing.get_type_hints(names["reconstruct"])
    assert set(types) == {*inspect.signature(pcl_floater.reconstruct).parameters, "return"}


@pytest.mark.parametrize("function", FUNCTIONS)
def test_every_argument_is_documented(function):
    text = inspect.getdoc(getattr(pcl_floater, function)).partition("\nReturns\n")[0]
    described = [name for line in re.findall(r"^(\w+(?:, \w+)*) : ", text, re.MULTILINE) for name in line.split(", ")]
    assert described == list(inspect.signature(getattr(pcl_floater, function)).parameters)


def test_version_is_that_of_the_project():
    version = re.search(r"project \(pcl_floater VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert pcl_floater.__version__ == version
    assert STUB.with_name("py.typed").is_file()


@pytest.mark.parametrize("example", sorted((ROOT / "test/examples").glob("*.py")), ids=lambda path: path.stem)
def test_example_ends_well(example, tmp_path):
    done = subprocess.run([sys.executable, str(example)], cwd=tmp_path, text=True, capture_output=True)
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stdout + done.stderr


def test_documentation_is_true():
    names = {**vars(pcl_floater), "points": torus(100, 40)}
    for module, examples in ((pcl_floater, 3), (pcl_floater._on_meshes, 6)):
        tested = doctest.testmod(module, extraglobs=names)
        assert (tested.attempted, tested.failed) == (examples, 0)


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
def test_pip_installs_and_removes(tmp_path):
    """Into a new environment, without a network. The module is that of this build, which nothing compiles again."""
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
