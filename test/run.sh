#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds, and runs all tests.
set -euo pipefail

usage () {
  cat <<'END'
Usage: run.sh [PRESET]
Builds a configure preset (default: dev; asan-ubsan: with the sanitizers) and runs all tests.
PCL_FLOATER_DATA: folder with real clouds (default: ../shared/data beside the project). Without it,
                  the tests on real clouds are skipped.
END
}

preset=dev
case "${1-}" in
  '') ;;
  -h | --help) usage; exit 0 ;;
  -*) usage >&2; exit 1 ;;
  *) preset=$1 ;;
esac
if (($# > 1)); then
  usage >&2
  exit 1
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
build=build/$preset
jobs=2

bash tools/install_packages.sh --tests

export PCL_FLOATER_DATA=${PCL_FLOATER_DATA:-$root/../shared/data}
mkdir -p "$build"
if ! cmake --preset "$preset" >"$build/configure.log" 2>&1; then
  cat "$build/configure.log" >&2
  exit 1
fi
cmake --build --preset "$preset" --parallel "$jobs"

result=0
ctest --test-dir "$build" --parallel "$jobs" --output-on-failure --no-tests=error || result=$?
if [[ ! -d $PCL_FLOATER_DATA ]]; then
  echo "Skipped: the tests on real clouds, because there is no folder $PCL_FLOATER_DATA"
fi
exit "$result"
