# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the real tool in a folder of its own, and in one with a cloud in it."""
import json
import os
import pathlib
import resource
import subprocess
import tempfile
from types import SimpleNamespace

import numpy as np
import pytest
from files import json_of, make_sample, pcd_text, read_mesh

BUILD, TOOL, GENERATE, PICTURE, READ_CLOUD, PCL_FILES, FAULTS = (
    os.environ["PCL_FLOATER_" + name]
    for name in ("BUILD", "TOOL", "GENERATE", "PICTURE", "READ_CLOUD", "PCL_FILES", "FAULTS"))
IS_SANITIZED = not FAULTS
HAS_LZF = os.environ["PCL_FLOATER_HAS_LZF"] == "1"
OK, USAGE, INPUT, RECONSTRUCTION, OUTPUT, INTERNAL, REFUSED = range(7)  # exit codes


def words(arguments):
    """The arguments; of one, the words of it."""
    return arguments[0].split() if len(arguments) == 1 else [str(argument) for argument in arguments]


class Tool:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def path(self, name):
        return self.folder / name

    def write(self, name, content):
        self.path(name).write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def read(self, name):
        return self.path(name).read_bytes()

    def text(self, name):
        return self.read(name).decode()

    def mesh(self, name="out.ply"):
        return read_mesh(self.path(name))

    def names(self):
        """Of everything in the folder, hidden files too."""
        return set(os.listdir(self.folder))

    def read_cloud(self, *arguments):
        """What the reader makes of a file, or of its beginnings."""
        done = subprocess.run([READ_CLOUD, *arguments], cwd=self.folder, check=True, capture_output=True)
        return json.loads(done.stdout)

    def by_pcl(self, *arguments):
        """What a program with PCL prints that writes or reads a file."""
        return subprocess.run([PCL_FILES, *arguments], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def do(self, command, **more):
        """Runs any program."""
        return subprocess.run([str(word) for word in command], cwd=self.folder, capture_output=True, text=True, timeout=1800,
                              **more)

    def expect(self, command, code, *told, **more):
        """Checks the exit code and parts of the messages."""
        outcome = self.do(command, **more)
        messages = outcome.stdout + outcome.stderr
        assert outcome.returncode == code, messages
        for part in told:
            assert part in messages
        return outcome

    def check(self, code, program, *arguments, says=""):
        """Also that no temporary file is left. Returns what the program printed."""
        outcome = self.expect([program, *words(arguments)], code, says)
        assert not [name for name in self.names() if "tmp" in name]
        return outcome.stdout

    def pixels(self, name):
        """Those of a picture, 0 to 255: rows of red, green and blue."""
        from matplotlib import image
        return np.round(255 * image.imread(self.path(name))[:, :, :3]).astype(int)

    def start(self, arguments, file_limit=None, address_limit=None, environment=None, wrapper=(), **streams):
        def limit():
            for kind, bytes_ in ((resource.RLIMIT_FSIZE, file_limit), (resource.RLIMIT_AS, address_limit)):
                if bytes_:
                    resource.setrlimit(kind, (bytes_, bytes_))
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
        return subprocess.Popen([*wrapper, TOOL, *arguments], cwd=self.folder, preexec_fn=limit,
                                env={**os.environ, **(environment or {})}, **streams)

    def run(self, *arguments, **surroundings):
        """\\return exit code, what was printed, and the messages. The code is negative if a signal ended the run"""
        child = self.start(words(arguments), **surroundings)
        out, err = child.communicate(timeout=1800)
        return SimpleNamespace(code=child.returncode, bytes=out, out=(out or b"").decode("utf-8", "replace"),
                               err=(err or b"").decode("utf-8", "replace"))

    def succeed(self, *arguments, **surroundings):
        outcome = self.run(*arguments, **surroundings)
        assert outcome.code == 0, outcome.err
        return outcome

    def report(self, options="", file="in.pcd"):
        self.succeed(*words([options]), file, "out.ply", "--report", "out.json")
        return json_of(self.text("out.json"))

    def fail(self, arguments, code, *causes, **surroundings):
        """The run must name the causes, print nothing else, and leave the folder as it was."""
        before = self.names()
        outcome = self.run(*arguments if isinstance(arguments, list) else [arguments], **surroundings)
        assert outcome.code == code, (arguments, outcome.err)
        told = [line for line in outcome.err.splitlines() if not line.startswith("warning: ")]
        assert told[0].startswith("pcl_floater_reconstruct: ") and outcome.out == ""
        for cause in causes:
            assert cause in outcome.err, arguments
        assert self.names() == before, arguments
        return outcome


@pytest.fixture
def tool():
    """In a folder that is empty at the start."""
    with tempfile.TemporaryDirectory() as folder:
        yield Tool(folder)


@pytest.fixture
def cloud(tool):
    """With a cloud, in.pcd, and one on a line, of which no surface can be made."""
    tool.sample = make_sample()
    tool.write("in.pcd", pcd_text(tool.sample.points))
    tool.write("line.pcd", pcd_text([(i, 0, 0) for i in range(5)]))
    return tool
