# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the module with CMake, for `pip install ./tools/python`.

All that is made is in the folder build/pip of the project. CMAKE_ARGS of the environment has more
arguments for CMake. PCL_FLOATER_BUILD_DIR names a folder that CMake has configured already, for the
same Python: then the module is built there.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = ROOT / "build" / "pip"


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        configured = os.environ.get("PCL_FLOATER_BUILD_DIR")
        folder = pathlib.Path(configured) if configured else BUILD / sys.implementation.cache_tag
        if not configured:
            subprocess.run(
                ["cmake", "-S", str(ROOT), "-B", str(folder), "-D", "CMAKE_BUILD_TYPE=Release",
                 "-D", "PCL_FLOATER_WITH_PYTHON=ON", "-D", f"PCL_FLOATER_PYTHON={sys.executable}",
                 "-D", "PCL_FLOATER_BUILD_LIBRARY=OFF", "-D", "PCL_FLOATER_BUILD_TOOLS=OFF",
                 "-D", "PCL_FLOATER_BUILD_TESTS=OFF", "-D", "PCL_FLOATER_INSTALL=OFF",
                 *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "pcl_floater_python",
                        "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))],
                       check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        built = folder / "tools" / "python" / "pcl_floater" / target.name
        if not built.is_file():
            raise RuntimeError(f"{built} does not exist: {folder} builds for another Python than "
                               f"{sys.executable}")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built, target)
        if shutil.which("strip"):
            subprocess.run(["strip", "--strip-unneeded", str(target)], check=True)


os.chdir(HERE)
BUILD.mkdir(parents=True, exist_ok=True)
setup(
    version=re.search(r"project \(pcl_floater VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
    packages=["pcl_floater"],
    package_data={"pcl_floater": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("pcl_floater._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": str(BUILD / "setuptools")}, "egg_info": {"egg_base": str(BUILD)}},
    zip_safe=False)
