#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian packages, checks them with lintian, and uses them in a clean Debian 12.
# shellcheck disable=SC2016 # what is in single quotes expands in the new system
set -euo pipefail

usage () {
  cat <<'END'
Usage: package.sh [--no-install] [-j N]
As root: makes the packages by tools/package.sh, runs lintian on them, installs them in a new
Debian 12 below a temporary folder, runs the first example of the man page, reconstructs on two processes
of MPI, builds programs against them with CMake, as README.md tells, and with pkg-config, removes them, and
looks for what is left.
  --no-install  do not install missing packages on this system
  -j N          jobs at a time (default: one for each core)
PCL_FLOATER_CHROOT: folder that keeps the downloads for the next run, some GB (default:
                    pcl_floater_chroot in the temporary folder)
END
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
installs=yes
jobs=$(nproc)
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --no-install) installs=no ;;
    -j) jobs=${2:?package.sh: -j needs a number}; shift ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

fail () {
  echo "package.sh: $*" >&2
  exit 1
}

((EUID == 0)) || fail "only root can make a Debian system below a folder"
if [[ $installs == yes ]]; then
  bash "$root/tools/install_packages.sh" --packages
fi
debs=$root/build/packages/debs
bash "$root/tools/package.sh" --no-install -j "$jobs"

echo "lintian:"
lintian --allow-root --no-cfg --tag-display-limit 0 --fail-on error "$debs"/*.deb

cache=${PCL_FLOATER_CHROOT:-${TMPDIR:-/tmp}/pcl_floater_chroot}
mkdir -p "$cache/archives"
system=$(mktemp -d "$cache/system.XXXXXX")
log=$cache/log
: >"$log"
clean_up () {
  umount "$system/proc" 2>/dev/null || true
  # Nothing of this system is removed through a mount that is still there.
  if ! mountpoint -q "$system/proc"; then
    rm -rf --one-file-system "$system"
  fi
}
trap clean_up EXIT

if [[ ! -f $cache/base.tar ]]; then
  echo "Making a Debian 12 in $cache ..."
  if ! debootstrap --variant=minbase bookworm "$system" >>"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "debootstrap failed"
  fi
  rm -f "$system"/var/cache/apt/archives/*.deb
  tar -C "$system" -cf "$cache/base.tar.new" .
  mv "$cache/base.tar.new" "$cache/base.tar"
else
  tar -C "$system" -xf "$cache/base.tar"
fi
mount -t proc proc "$system/proc"
cp /etc/resolv.conf "$system/etc/resolv.conf"
printf '#!/bin/sh\nexit 101\n' >"$system/usr/sbin/policy-rc.d" # starts no services
chmod +x "$system/usr/sbin/policy-rc.d"
# No sync after each file: this system is thrown away.
echo force-unsafe-io >"$system/etc/dpkg/dpkg.cfg.d/unsafe-io"
find "$cache/archives" -name '*.deb' -exec cp -l -t "$system/var/cache/apt/archives" {} + 2>/dev/null ||
  true
mkdir "$system/test" "$system/test/debs"
cp "$debs"/*.deb "$system/test/debs"
cp -r "$root/test/consumer" "$system/test/consumer"

# Runs a command within the new system, in its folder /test.
inside () {
  chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive bash -euo pipefail -c "cd /test; $1"
}
step () {
  echo "$1 ..."
  if ! inside "$2" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "$1: failed; the output is in $log"
  fi
}
apt='apt-get -qq -y --no-install-recommends -o Acquire::Retries=3 -o APT::Keep-Downloaded-Packages=true'

step "Installing the tools" "apt-get -qq update; $apt install ./debs/pcl-floater-tools_*.deb man-db"
# The man page is what a user reads: the lines of its first example, up to an empty one.
step "Running the first example of the man page" '
  mkdir example; cd example
  MANPAGER=cat man pcl_floater_reconstruct >page
  sed -n "/^EXAMPLES/,/^SEE ALSO/p" page | awk "NR > 1 { if (!NF) exit; print }" >commands
  cat commands
  grep -q "^ *pcl_floater_generate" commands; grep -q "^ *pcl_floater_reconstruct" commands
  bash -e ./commands
  test -s torus.vtk
  for tool in reconstruct generate picture; do
    pcl_floater_$tool --help >/dev/null; man -w pcl_floater_$tool
    bash -n /usr/share/bash-completion/completions/pcl_floater_$tool
  done
  test ! -e /usr/include/pcl_floater'
step "Installing the tool for MPI" "$apt install ./debs/pcl-floater-mpi_*.deb"
step "Reconstructing on two processes" '
  mkdir distributed; cd distributed
  pcl_floater_generate torus cloud.ply --points 20000
  pcl_floater_reconstruct -q cloud.ply one.ply
  mpirun --allow-run-as-root --oversubscribe -n 2 pcl_floater_distributed --work work --blocks 5 cloud.ply two.ply
  cmp one.ply two.ply
  pcl_floater_distributed --help >/dev/null; man -w pcl_floater_distributed
  bash -n /usr/share/bash-completion/completions/pcl_floater_distributed'
step "Installing the other packages" "
  $apt install ./debs/libpcl-floater[0-9]*.deb ./debs/libpcl-floater-dev_*.deb ./debs/pcl-floater-doc_*.deb
  test -s /usr/share/doc/pcl-floater-doc/README.md"
find "$system/var/cache/apt/archives" -name '*.deb' -exec cp -nl -t "$cache/archives" {} + 2>/dev/null ||
  true
step "Installing compilers" "$apt install g++ cmake make pkg-config"
find "$system/var/cache/apt/archives" -name '*.deb' -exec cp -nl -t "$cache/archives" {} + 2>/dev/null ||
  true
step "Building and running a program with find_package" "
  cmake -S consumer -B build; cmake --build build --parallel $jobs
  ctest --test-dir build --output-on-failure --no-tests=error"
step "Building and running the program of README.md" '
  mkdir readme; cd readme
  block () { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" /usr/share/doc/pcl-floater-doc/README.md | sed "/^\`\`\`/d"; }
  block cpp >main.cpp
  { echo "cmake_minimum_required (VERSION 3.18)"; echo "project (my_program)"
    echo "add_executable (my_program main.cpp)"; block cmake; } >CMakeLists.txt
  grep -q "int main" main.cpp; grep -q "find_package (pcl_floater" CMakeLists.txt
  cmake -S . -B build; cmake --build build
  pcl_floater_generate torus scan.pcd
  build/my_program
  test -s mesh.ply'
step "Building and running a program with pkg-config" '
  g++ -std=c++17 consumer/own_types.cpp -o own_types $(pkg-config --cflags --libs pcl_floater)
  ./own_types'

step "Installing the Python module" "$apt install ./debs/python3-pcl-floater_*.deb"
step "Using the Python module" '
  /usr/bin/python3 -c "import numpy, pcl_floater; print (pcl_floater.__version__, pcl_floater.__file__)
i, j = numpy.mgrid[:20, :20]
mesh = pcl_floater.reconstruct (numpy.stack ([i, j, numpy.sin (0.3 * i)], -1).reshape (-1, 3))
assert len (mesh.triangles) == 2 * 19 * 19, mesh"
  /usr/bin/python3 -c "import importlib.metadata; print (importlib.metadata.version (\"pcl_floater\"))"
  ls /usr/lib/python3/dist-packages/pcl_floater/__pycache__'

step "Removing the packages" '
  packages=$(dpkg-query -W -f "\${Package}\n" | grep -E "^(lib|python3-)?pcl-floater")
  test "$(wc -l <<<"$packages")" = 6
  # What belongs to them, and not to other packages as well.
  for package in $packages; do dpkg-query -L $package; done | sort -u >owned
  dpkg-query -W -f "\${Package}\n" | grep -vE "^(lib|python3-)?pcl-floater" | xargs dpkg-query -L | sort -u >of_others
  comm -23 owned of_others >only_owned
  test "$(wc -l <only_owned)" -gt 20
  apt-get -qq -y purge $packages'
left=$(inside 'xargs -d "\n" ls -d 2>/dev/null <only_owned || true
  find / -xdev \( -path /proc -o -path /test -o -path /var/cache/apt -o -path /var/cache/man \) -prune -o \
    -iname "*pcl[-_]floater*" -print
  dpkg-query -W -f "\${Package} \${db:Status-Status}\n" | grep -E "^(lib|python3-)?pcl-floater" || true')
[[ -z $left ]] || fail "after the packages were removed, this is left: $left"
echo "The packages install, work and are removed without a trace."
