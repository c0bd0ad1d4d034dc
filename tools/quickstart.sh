#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# From a fresh checkout to a mesh: installs missing packages, builds the tools and reconstructs a
# cloud.
set -euo pipefail

usage () {
  cat <<'END'
Usage: quickstart.sh [CLOUD]
Reconstructs a point cloud (.pcd, .ply or .obj; without one, a sample). Writes the mesh, a report, a
picture and, if it is a disc, the parameterization to the folder floater_result in the working
directory.
END
}

fail () {
  echo "quickstart.sh: $*" >&2
  exit 1
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  -*) usage >&2; exit 1 ;;
esac
if (($# > 1)); then
  usage >&2
  exit 1
fi
if (($# == 1)) && [[ ! -r $1 ]]; then
  fail "cannot read '$1'"
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
result=$PWD/floater_result

# On another system than Debian, CMake tells what is missing.
if command -v apt-get >/dev/null; then
  bash "$root/tools/install_packages.sh"
fi

echo "Building (the first time takes minutes) ..."
mkdir -p "$build"
log=$build/quickstart.log
if ! (cd "$root" && cmake --preset release && cmake --build --preset release) >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  fail "the build failed; its output is in $log"
fi

mkdir -p "$result"
cloud=${1-}
if [[ -z $cloud ]]; then
  cloud=$result/cloud.pcd
  "$build/tools/generate/pcl_floater_generate" height-field "$cloud" --points 2500
fi

echo "Reconstructing $cloud ..."
reconstruct=$build/tools/reconstruct/pcl_floater_reconstruct
"$reconstruct" --report "$result/report.json" "$cloud" "$result/mesh.vtk"
"$reconstruct" --quiet "$cloud" "$result/mesh.ply"
# Only a disc can be laid out in the plane.
rm -f "$result/parameterization.ply" "$result/disc.ply"
flat=()
if "$reconstruct" --quiet --parameterization "$result/parameterization.ply" "$cloud" \
  "$result/disc.ply" 2>/dev/null; then
  flat=("$result/parameterization.ply")
fi
# The tool for pictures is not built without VTK and X11.
rm -f "$result/picture.png"
picture=
if [[ -x $build/tools/picture/pcl_floater_picture ]] && command -v Xvfb >/dev/null; then
  picture=yes
  "$root/tools/picture/on_virtual_display.sh" "$build/tools/picture/pcl_floater_picture" \
    "$result/mesh.vtk" "${flat[@]}" "$result/picture.png"
fi

cat <<END
Done. In $result:
  mesh.vtk, mesh.ply    the mesh; its vertices are the points of the cloud
  report.json           the report on the run
${picture:+  picture.png           a picture of the mesh${flat:+ and its parameterization}
}${flat:+  parameterization.ply  the surface laid out in the plane; disc.ply has these triangles in space
}To view the mesh (key r: reset the view, w: edges, q: quit):
  pcl_viewer '$result/mesh.vtk'
END
if ! command -v pcl_viewer >/dev/null; then
  echo "(pcl_viewer is in the Debian package pcl-tools.)"
fi
