#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds the benchmark, and reproduces the tables and figures of TW 385.
set -euo pipefail

usage () {
  cat <<'END'
Usage: run.sh [CLOUD...]
Writes floater_result/benchmark/report.md in the working directory, with pictures and CSV files.
CLOUD: point clouds that are discs (.pcd, .ply or .obj); default: seven of the folder
       PCL_FLOATER_DATA (default: ../shared/data beside the project), and a generated finger, whose
       tip is about as dense in the plane as the densest part of the largest model of TW 385
END
}

fail () {
  echo "run.sh: $*" >&2
  exit 1
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  -*) usage >&2; exit 1 ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/bench
result=$PWD/floater_result/benchmark

clouds=("$@")
finger=
if ((${#clouds[@]} == 0)); then
  data=${PCL_FLOATER_DATA:-$root/../shared/data}
  [[ -d $data ]] || fail "there is no folder $data; name clouds, or set PCL_FLOATER_DATA"
  for name in beetle_front man_bust bunny nefertiti face_strip igea field_lidar; do
    clouds+=("$data/$name.pcd")
  done
  finger=$result/finger.pcd
fi
for cloud in "${clouds[@]}"; do
  [[ -r $cloud ]] || fail "cannot read '$cloud'"
done

bash "$root/tools/install_packages.sh" --benchmarks

echo "Building (the first time takes minutes) ..."
mkdir -p "$build" "$result"
log=$build/benchmark.log
if ! (cd "$root" && cmake --preset bench &&
  cmake --build --preset bench --target pcl_floater_benchmark pcl_floater_generate) >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  fail "the build failed; its output is in $log"
fi

if [[ -n $finger ]]; then
  "$build/tools/generate/pcl_floater_generate" finger "$finger" --points 6000 --length 28
  clouds=("$finger" "${clouds[@]}")
fi
"$root/tools/picture/on_virtual_display.sh" "$build/test/benchmark/pcl_floater_benchmark" \
  --out "$result" "${clouds[@]}"
