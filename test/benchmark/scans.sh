#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures, on real scans, the time and memory of pcl_floater, of pcl::GreedyProjectionTriangulation and
# of CGAL's advancing front, all in the same run of scaling.sh.
set -euo pipefail

usage () {
  cat <<'END'
Usage: scans.sh [FOLDER] [OPTION...]
Prints a table of seconds and memory, medians of three runs, and writes floater_result/scaling/report.md in
the working directory, with all figures.
FOLDER: all of its clouds (.pcd, .ply, .obj; no truths, .gt.ply) are taken; default: scans of several
        sensors in the folder PCL_FLOATER_DATA (default: ../shared/data beside the project)
OPTION: as for scaling.sh
END
}

fail () {
  echo "scans.sh: $*" >&2
  exit 1
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
clouds=()
if (($# > 0)) && [[ $1 != -* ]]; then
  [[ -d $1 ]] || fail "there is no folder $1"
  while IFS= read -r -d '' cloud; do
    clouds+=("$cloud")
  done < <(find -L "$1" -maxdepth 1 -type f \( -name '*.pcd' -o -name '*.ply' -o -name '*.obj' \) \
    ! -name '*.gt.ply' -print0 | sort -z)
  ((${#clouds[@]} > 0)) || fail "there is no cloud in $1"
  shift
else
  data=${PCL_FLOATER_DATA:-$root/../shared/data}
  [[ -d $data ]] || fail "there is no folder $data; name one, or set PCL_FLOATER_DATA"
  # Merged views, depth cameras, lasers turned by hand, by a car and by an aircraft: doc/memory_and_speed.md
  # says where they are from.
  for name in tum_rabbit raw_milk sensor_office sensor_table_rgb raw_room_scan raw_ring_lidar hill_lidar \
    raw_slope_lidar raw_roofs_trees; do
    clouds+=("$data/$name.pcd")
  done
fi
"$root/test/benchmark/scaling.sh" --methods floater,gp3,afs --surfaces none "$@" "${clouds[@]}"
sed -n '/^## *Side by side/,/^## /{/^|/p}' floater_result/scaling/report.md
