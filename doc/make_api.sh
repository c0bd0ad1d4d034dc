#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the documentation of the headers, and fails on a warning.
set -euo pipefail

usage () {
  cat <<'END'
Usage: make_api.sh
Writes the documentation of the headers to build/api/html. Needs doxygen, which
tools/install_packages.sh --docs installs. The exit code is 1 if there is a warning.
END
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
esac
if (($# > 0)); then
  usage >&2
  exit 1
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
if ! command -v doxygen >/dev/null; then
  echo "make_api.sh: doxygen was not found; install it by tools/install_packages.sh --docs" >&2
  exit 1
fi
log=build/api/warnings.log
mkdir -p build/api
if ! doxygen doc/Doxyfile >/dev/null 2>"$log"; then
  cat "$log" >&2
  echo "make_api.sh: doxygen failed" >&2
  exit 1
fi
if [[ -s $log ]]; then
  cat "$log" >&2
  echo "make_api.sh: $(grep -c 'warning:' "$log" || true) warnings" >&2
  exit 1
fi
echo "build/api/html/index.html"
