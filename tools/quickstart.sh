#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# From a fresh checkout to a mesh: installs missing packages, builds the tools and reconstructs a
# cloud.
set -euo pipefail

usage () {
  cat <<'END'
Usage: quickstart.sh [--build FOLDER] [CLOUD]
Builds the tools that make and draw meshes, and the library for PCL if PCL is installed.
Reconstructs a point cloud (.pcd, .ply, .las, .xyz and others of doc/formats.md; without one, the scan
tools/sample/tum_rabbit.pcd).
Writes the mesh, a report and a picture to the folder floater_result in the working directory.
  --build FOLDER  use the programs in this build folder, instead of building them
END
}

fail () {
  echo "quickstart.sh: $*" >&2
  exit 1
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=
clouds=()
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --build) build=${2:?quickstart.sh: --build needs a folder}; shift ;;
    -*) usage >&2; exit 1 ;;
    *) clouds+=("$1") ;;
  esac
  shift
done
if ((${#clouds[@]} > 1)); then
  usage >&2
  fail "one cloud at a time, not ${#clouds[@]}"
fi
cloud=${clouds[0]-$root/tools/sample/tum_rabbit.pcd}
[[ -n $cloud ]] || fail "the name of the cloud is empty; without a name, it is tools/sample/tum_rabbit.pcd"
[[ -f $cloud && -r $cloud ]] || fail "cannot read '$cloud': a file with a point cloud is needed"
result=$PWD/floater_result

if [[ -z $build ]]; then
  build=$root/build/release
  # On another system than Debian, CMake tells what is missing.
  if command -v apt-get >/dev/null; then
    bash "$root/tools/install_packages.sh" --tools-only
  fi
  echo "Building the tools that make and draw meshes (some three minutes on two cores) ..."
  mkdir -p "$build"
  log=$build/quickstart.log
  # On a terminal, each line takes the place of the last one.
  if [[ -t 1 ]]; then line='\r  %s'; else line='  %s\n'; fi
  if ! (cd "$root" && cmake --preset release &&
        NINJA_STATUS="step %f of %t " cmake --build --preset release --target quickstart) 2>&1 | tee "$log" |
       awk -v line="$line" '/^step / { printf line, $1 " " $2 " " $3 " " $4; fflush (); any = 1 }
                            END { if (any && line ~ /r/) print "" }'; then
    tail -n 40 "$log" >&2
    fail "the build failed; its output is in $log"
  fi
fi

echo "Reconstructing $cloud ..."
mkdir -p "$result"
# Nothing of an earlier cloud stays beside what is made of this one.
rm -f "$result/mesh.vtk" "$result/report.json" "$result/picture.png"
"$build/tools/reconstruct/pcl_floater_reconstruct" --report "$result/report.json" "$cloud" "$result/mesh.vtk"
"$build/tools/picture/pcl_floater_picture" "$result/mesh.vtk" "$result/picture.png"

cat <<END
Done. In $result:
  mesh.vtk     the mesh; its vertices are the points of the cloud
  report.json  the report on the run
  picture.png  a picture of the mesh
To view the mesh (key r: reset the view, w: edges, q: quit):
  pcl_viewer '$result/mesh.vtk'
END
command -v pcl_viewer >/dev/null || echo "(pcl_viewer is in the Debian package pcl-tools.)"
if [[ ! -e $build/src/libpcl_floater.so && ! -e $build/src/libpcl_floater.a ]]; then
  echo "For the library for PCL, all tools and the Python module: tools/install_packages.sh, then" \
       "'cmake --preset release && cmake --build --preset release'."
fi
