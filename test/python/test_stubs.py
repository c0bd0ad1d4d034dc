# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The stubs, the documentation and the tool say what the module does."""
import ast
import inspect
import pathlib
import re
import subprocess
import sys
import typing

import numpy as np
import pcl_floater
import pytest

from conftest import ROOT

STUB = pathlib.Path(pcl_floater.__file__).with_name("__init__.pyi")
@pytest.fixture(scope="module")
def stub():
    return {node.name: node for node in ast.parse(STUB.read_text()).body if hasattr(node, "name")}


@pytest.fixture(scope="module")
def annotations():
    names = {}
    exec(compile(STUB.read_text(), str(STUB), "exec"), names)  # all in it can be evaluated
    return typing.get_type_hints(names["reconstruct"])


SIGNATURE = inspect.signature(pcl_floater.reconstruct)
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


def test_words_are_those_of_the_stub(annotations):
    """The message on a wrong word has the right ones."""
    found = 0
    for name, annotation in annotations.items():
        options = [annotation, *typing.get_args(annotation)]
        literals = [typing.get_args(o) for o in options if typing.get_origin(o) is typing.Literal]
        if not literals or name == "viewpoint":
            continue
        with pytest.raises(ValueError) as raised:
            pcl_floater.reconstruct(np.zeros((9, 3)), **{name: "?"})
        words = re.findall(r"'([\w-]+)'", str(raised.value))
        assert tuple(words) == literals[0], name
        found += 1
    assert found == 12


def test_stub_and_page_have_the_table_of_options():
    made = subprocess.run([sys.executable, ROOT / "doc/make_options.py", "--check",
                           pathlib.Path(pcl_floater.__file__).parent.parent], capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stdout + made.stderr


@pytest.mark.parametrize("function", FUNCTIONS)
def test_every_argument_is_documented(function):
    text = inspect.getdoc(getattr(pcl_floater, function)).partition("\nReturns\n")[0]
    described = [name for line in re.findall(r"^(\w+(?:, \w+)*) : ", text, re.MULTILINE) for name in line.split(", ")]
    assert described == list(inspect.signature(getattr(pcl_floater, function)).parameters)


def test_every_argument_has_a_type(annotations):
    assert set(annotations) == set(SIGNATURE.parameters) | {"return"}


def test_version_is_that_of_the_project():
    version = re.search(r"project \(pcl_floater VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert pcl_floater.__version__ == version
    assert STUB.with_name("py.typed").is_file()
