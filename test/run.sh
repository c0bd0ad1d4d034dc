#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds, and runs all tests.
set -euo pipefail

usage () {
  cat <<'END'
Usage: run.sh [--no-install] [-j N] [PRESET]
Builds a configure preset (default: dev; asan-ubsan: with the sanitizers) and runs all tests.
  --no-install  do not install missing packages
  -j N          jobs and tests at a time (default: one for each core)
PCL_FLOATER_DATA: folder with real clouds (default: ../shared/data beside the project). Without it,
                  the tests on real clouds are skipped.
END
}

preset=
installs=yes
jobs=$(nproc)
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --no-install) installs=no ;;
    -j) jobs=${2-}; shift ;;
    -j*) jobs=${1#-j} ;;
    -*) usage >&2; exit 1 ;;
    *)
      if [[ -n $preset ]]; then
        usage >&2
        exit 1
      fi
      preset=$1
      ;;
  esac
  shift || true
done
preset=${preset:-dev}
if ! [[ $jobs =~ ^[1-9][0-9]*$ ]]; then
  echo "run.sh: -j needs a number of jobs, 1 or more" >&2
  exit 1
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
build=build/$preset

# On another system than Debian, CMake tells what is missing.
if [[ $installs == yes ]] && command -v apt-get >/dev/null; then
  bash tools/install_packages.sh --tests
fi

export PCL_FLOATER_DATA=${PCL_FLOATER_DATA:-$root/../shared/data}
mkdir -p "$build"
if ! cmake --preset "$preset" -DBUILD_TESTING=ON >"$build/configure.log" 2>&1; then
  cat "$build/configure.log" >&2
  exit 1
fi
cmake --build --preset "$preset" --parallel "$jobs"

result=0
rm -f "$build/run.xml"
ctest --test-dir "$build" --parallel "$jobs" --output-on-failure --no-tests=error --output-junit run.xml || result=$?
[[ ! -f $build/run.xml ]] || python3 test/skipped.py "$build/run.xml"
exit "$result"
