#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian packages: the library, its headers, the tools, that for MPI, the Python module and the
# documentation.
set -euo pipefail

usage () {
  cat <<'END'
Usage: package.sh [--no-install] [-j N] [FOLDER]
Builds for release and writes the packages (.deb) to FOLDER (default: build/packages/debs of the
project), from which it takes older ones away.
  --no-install  do not install missing packages
  -j N          jobs at a time (default: one for each core)
END
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/packages
folder=$build/debs
jobs=$(nproc)
installs=yes
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --no-install) installs=no ;;
    -j) jobs=${2:?package.sh: -j needs a number}; shift ;;
    -*) usage >&2; exit 1 ;;
    *) folder=$1 ;;
  esac
  shift
done
mkdir -p "$folder" "$build"
folder=$(cd "$folder" && pwd)
[[ $installs == no ]] || bash "$root/tools/install_packages.sh" --packages

# The date in the packages is that of the sources, so that the same sources make the same packages.
if [[ -z ${SOURCE_DATE_EPOCH-} ]]; then
  SOURCE_DATE_EPOCH=$(git -C "$root" log -1 --format=%ct 2>/dev/null || stat -c %Y "$root/CHANGELOG.md")
fi
export SOURCE_DATE_EPOCH

# Debian's flags, which harden programs against faults; CMake's own for release optimize.
cd "$root"
export DEB_BUILD_MAINT_OPTIONS=hardening=+bindnow DEB_CXXFLAGS_MAINT_STRIP='-g -O2'
flags="$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS)"
link_flags=$(dpkg-buildflags --get LDFLAGS)
log=$build/package.log
echo "Building the packages (the first time takes minutes) ..."
if ! {
  cmake --preset release -B "$build" -D CMAKE_INSTALL_PREFIX=/usr -D PCL_FLOATER_PACKAGES=ON \
    -D PCL_FLOATER_WITH_LZF=ON -D PCL_FLOATER_WITH_MPI=ON \
    -D PCL_FLOATER_WITH_PYTHON=ON -D PCL_FLOATER_PYTHON=/usr/bin/python3 \
    -D CMAKE_MODULE_LINKER_FLAGS="$link_flags" \
    -D CMAKE_CXX_FLAGS="$flags" -D CMAKE_SHARED_LINKER_FLAGS="$link_flags" \
    -D CMAKE_EXE_LINKER_FLAGS="$link_flags" &&
    cmake --build "$build" --parallel "$jobs" &&
    rm -f "$folder"/libpcl-floater*.deb "$folder"/pcl-floater-*.deb "$folder"/python3-pcl-floater_*.deb &&
    (cd "$build" && cpack -G DEB -B "$folder") &&
    rm -rf "$folder/_CPack_Packages"
} >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "package.sh: the packages could not be made; the output is in $log" >&2
  exit 1
fi
ls "$folder"/*.deb
