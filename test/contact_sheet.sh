#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds, reconstructs clouds with the default options, and draws all
# meshes into one picture.
set -euo pipefail

usage () {
  cat <<'END'
Usage: contact_sheet.sh [--build FOLDER] [CLOUD...]
Writes floater_result/contact_sheet.png in the working directory: each mesh with its figures, and
with folds of more than 120 degrees in magenta; for a cloud that fails, the cause. The meshes and
reports are in floater_result/contact_sheet. A scan is seen from its sensor. Where a true mesh
NAME.gt.ply lies beside a cloud NAME.pcd, it is shown, too.
--build: use the programs in this build folder, instead of building them for release
CLOUD:   point clouds (.pcd, .ply or .obj); default: all .pcd files in the folder PCL_FLOATER_DATA
         (default: ../shared/data beside the project)
END
}

fail () {
  echo "contact_sheet.sh: $*" >&2
  exit 1
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=
case "${1-}" in
  -h | --help) usage; exit 0 ;;
  --build) build=${2:?contact_sheet.sh: --build needs a folder}; shift 2 ;;
  -*) usage >&2; exit 1 ;;
esac

clouds=("$@")
if ((${#clouds[@]} == 0)); then
  data=${PCL_FLOATER_DATA:-$root/../shared/data}
  [[ -d $data ]] || fail "there is no folder $data; name clouds, or set PCL_FLOATER_DATA"
  clouds=("$data"/*.pcd)
fi
for cloud in "${clouds[@]}"; do
  [[ -r $cloud ]] || fail "cannot read '$cloud'"
done

if [[ -z $build ]]; then
  bash "$root/tools/install_packages.sh"
  build=$root/build/release
  echo "Building (the first time takes minutes) ..."
  mkdir -p "$build"
  log=$build/contact_sheet.log
  if ! (cd "$root" && cmake --preset release && cmake --build --preset release --target \
    pcl_floater_reconstruct pcl_floater_contact_sheet) >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "the build failed; its output is in $log"
  fi
fi

result=$PWD/floater_result
mkdir -p "$result/contact_sheet"
names=()
for cloud in "${clouds[@]}"; do
  name=$(basename "${cloud%.*}")
  rm -f "$result/contact_sheet/$name."{vtk,json,gt.ply}
  code=0
  "$build/tools/reconstruct/pcl_floater_reconstruct" --quiet \
    --report "$result/contact_sheet/$name.json" "$cloud" "$result/contact_sheet/$name.vtk" || code=$?
  # A cloud that cannot be reconstructed (exit codes 3 and 5) has a report with the cause.
  [[ -e $result/contact_sheet/$name.json ]] || fail "no report on '$cloud': exit code $code"
  [[ ! -e ${cloud%.*}.gt.ply ]] || cp "${cloud%.*}.gt.ply" "$result/contact_sheet/$name.gt.ply"
  names+=("$name")
done
"$root/tools/picture/on_virtual_display.sh" "$build/test/contact_sheet/pcl_floater_contact_sheet" \
  "$result/contact_sheet.png" "$result/contact_sheet" "${names[@]}"
echo "$result/contact_sheet.png"
