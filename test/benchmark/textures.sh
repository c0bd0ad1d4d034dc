#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures the texture coordinates that pcl_floater_reconstruct makes of all clouds of a folder.
set -euo pipefail

usage () {
  cat <<'END'
Usage: textures.sh [FOLDER] [NAME...]
Prints a table, one line for each cloud: what its mesh is, and the charts, the stretch, the share of the square
that is used, flipped triangles and seconds of its texture coordinates. Ends with 1 if a triangle is flipped.
FOLDER: all of its clouds (.pcd) are taken, or those of the NAMEs; default: the folder PCL_FLOATER_DATA
        (default: ../shared/data beside the project)
The environment variable PCL_FLOATER_RECONSTRUCT names the tool (default: that of build/bench)
END
}

fail () {
  echo "textures.sh: $*" >&2
  exit 1
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tool=${PCL_FLOATER_RECONSTRUCT:-$root/build/bench/tools/reconstruct/pcl_floater_reconstruct}
[[ -x $tool ]] || fail "there is no $tool: build it (cmake --preset bench), or set PCL_FLOATER_RECONSTRUCT"
data=${1:-${PCL_FLOATER_DATA:-$root/../shared/data}}
[[ -d $data ]] || fail "there is no folder $data"
shift || true
names=("$@")
if ((${#names[@]} == 0)); then
  for cloud in "$data"/*.pcd; do
    [[ -f $cloud ]] || fail "there is no cloud in $data"
    names+=("$(basename "$cloud" .pcd)")
  done
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The number after a name in the part of the report that begins with another name.
field () {
  sed -n "s/.*\"$1\": *{.*\"$2\": *\([0-9.e+-]*\).*/\1/p" "$folder/report.json" | head -n 1
}

flipped_in=()
echo "| cloud | triangles | components | loops | charts | stretch | area used | flipped | s |"
echo "|---|---:|---:|---:|---:|---:|---:|---:|---:|"
for name in "${names[@]}"; do
  "$tool" --uv --report "$folder/report.json" "$data/$name.pcd" "$folder/mesh.ply" >"$folder/log" 2>&1 ||
    fail "$name: $(tail -n 1 "$folder/log")"
  loops=$(sed -n 's/.*"loops":\[\([^]]*\)\].*/\1/p' "$folder/report.json" | grep -o '"points"' | wc -l || true)
  flipped=$(field texture flipped)
  LC_ALL=C printf '| %s | %s | %s | %s | %s | %.3f | %.0f %% | %s | %.2f |\n' "$name" "$(field statistics triangles)" \
    "$(field check components)" "$loops" "$(field texture charts)" "$(field texture stretch)" \
    "$(awk "BEGIN {print 100 * $(field texture area_used)}")" "$flipped" "$(field seconds texture)"
  [[ $flipped == 0 ]] || flipped_in+=("$name")
done
((${#flipped_in[@]} == 0)) || fail "flipped triangles: ${flipped_in[*]}"
