#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian 12 packages that this project needs. Calls apt only if a package is missing.
set -euo pipefail

usage () {
  cat <<'END'
Usage: install_packages.sh [--tools-only] [--tests] [--benchmarks] [--lint] [--packages] [--docs]
Installs the Debian packages for the library for PCL, its tools and its Python module.
  --tools-only  only those for the tools that make and draw meshes: 120 instead of 700
  --tests       also those for the tests
  --benchmarks  also those for the benchmarks
  --lint        also those for checking the source code
  --packages    also those for making and testing Debian packages
  --docs        also those for the documentation of the headers
END
}

# With libopenblas0-pthread the factorization is 2.5 times as fast as with the reference BLAS.
packages=(g++ cmake ninja-build libeigen3-dev libboost-dev libcgal-dev libsuitesparse-dev
          libopenblas0-pthread libcli11-dev nlohmann-json3-dev liblzf-dev liblodepng-dev)
library=(libpcl-dev libopenmpi-dev openmpi-bin libxxhash-dev pybind11-dev python3-dev python3-numpy)
for argument in "$@"; do
  case "$argument" in
    --tools-only) library=() ;;
    # Files are read back with VTK, and the page of --html is shown by Chromium.
    --tests) packages+=(libgtest-dev libgmock-dev pkg-config
                         python3 python3-numpy python3-vtk9 python3-matplotlib python3-pytest python3-pip
                         python3-setuptools python3-venv python3-wheel chromium) ;;
    --benchmarks) packages+=(python3 python3-numpy python3-scipy python3-matplotlib) ;;
    --lint) packages+=(clang-format-14 clang-tidy-14) ;;
    --packages) packages+=(dpkg-dev lintian debootstrap) ;;
    --docs) packages+=(doxygen) ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 1 ;;
  esac
done
packages+=("${library[@]}")

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_packages.sh: this is not Debian; install the equivalents of: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

as_root=()
((EUID == 0)) || as_root=(sudo)
if ((EUID != 0)) && ! command -v sudo >/dev/null; then
  echo "install_packages.sh: root or sudo is needed for: apt-get install ${missing[*]}" >&2
  exit 1
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt () {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o DPkg::Lock::Timeout=300 \
    -o Acquire::Retries=3 "$@" 2>&1 | tee -a "$log"
}
# Tells how far it is, from what apt writes: each package is unpacked, and set up later.
install () {
  local total
  total=$(apt-get -qq -s install --no-install-recommends "${missing[@]}" | grep -c '^Inst') || true
  apt install --no-install-recommends "${missing[@]}" |
    awk -v all=$((2 * total)) '/^(Unpacking|Setting up)/ && ++step % 20 == 0 { print "  step " step " of " all; fflush () }'
}

echo "Installing these packages, and those that they need: ${missing[*]}"
for attempt in 1 2 3; do
  # Outdated package lists name files that the mirror no longer has.
  if apt update >/dev/null && install; then
    exit 0
  fi
  echo "install_packages.sh: attempt $attempt of 3 failed" >&2
  sleep $((attempt * 5))
done
tail -n 30 "$log" >&2
echo "install_packages.sh: apt-get could not install: ${missing[*]}" >&2
exit 1
