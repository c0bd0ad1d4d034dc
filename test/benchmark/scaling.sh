#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds, and measures how the time and memory of pcl_floater, of
# pcl::GreedyProjectionTriangulation and of CGAL's advancing front grow with the number of points. The
# methods run in turn, each run in a process of its own.
set -euo pipefail

usage () {
  cat <<'END'
Usage: scaling.sh [OPTION...] [CLOUD...]
Writes floater_result/scaling/report.md in the working directory, with charts, tables as CSV files,
and runs.csv, which has a row for every run.
CLOUD: point clouds (.pcd, .ply or .obj); default: some of the folder PCL_FLOATER_DATA (default:
       ../shared/data beside the project), if it exists
  --largest N       leave out clouds with more points (default 3000000; 100000 takes 1 to 2 minutes)
  --repeats N       runs, of which the median is shown (default 3, and 1 above 300000 points)
  --methods LIST    some of floater,floater-disc,gp3,afs (default: all; floater-disc runs on
                    height-field only)
  --surfaces LIST   kinds of pcl_floater_generate (default: height-field,sphere,torus), or none
  --time-limit S    seconds after which a run is ended, and larger ones are left out (default 600)
  --threads N       threads of floater and of the normals of gp3; afs has one (default 0: one for
                    each core)
  --build FOLDER    use the programs in this build folder, instead of building them
END
}

fail () {
  echo "scaling.sh: $*" >&2
  exit 1
}

# number OPTION VALUE...
number () {
  [[ ${2-} =~ ^[0-9]+$ ]] || fail "$1 needs a number"
  echo "$2"
}

# text OPTION VALUE...
text () {
  [[ -n ${2-} ]] || fail "$1 needs a value"
  echo "$2"
}

sizes=(10000 30000 100000 300000 1000000 3000000)
repeated_up_to=300000 # points; the times of larger clouds vary little
largest=3000000
repeats=
methods=(floater floater-disc gp3 afs)
surfaces=(height-field sphere torus)
time_limit=600
threads=0
build=
clouds=()
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --largest) largest=$(number "$@"); shift ;;
    --repeats) repeats=$(number "$@"); shift ;;
    --methods) list=$(text "$@"); IFS=, read -r -a methods <<<"$list"; shift ;;
    --surfaces)
      list=$(text "$@")
      surfaces=()
      [[ $list == none ]] || IFS=, read -r -a surfaces <<<"$list"
      shift
      ;;
    --time-limit) time_limit=$(number "$@"); shift ;;
    --threads) threads=$(number "$@"); shift ;;
    --build) build=$(text "$@"); shift ;;
    -*) usage >&2; exit 1 ;;
    *) clouds+=("$1") ;;
  esac
  shift
done
[[ $repeats != 0 ]] || fail "--repeats must be 1 or more"
for method in "${methods[@]}"; do
  [[ $method =~ ^(floater|floater-disc|gp3|afs)$ ]] || fail "there is no method '$method'"
done

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
result=$PWD/floater_result/scaling
if ((${#clouds[@]} == 0)); then
  data=${PCL_FLOATER_DATA:-$root/../shared/data}
  if [[ -d $data ]]; then
    # Scans without rough noise, closed and open, from 11 to 206 thousand points.
    for name in spot_closed bunny hill_lidar igea field_lidar; do
      clouds+=("$data/$name.pcd")
    done
  else
    echo "Skipped: the real clouds, because there is no folder $data"
  fi
fi
for cloud in "${clouds[@]}"; do
  [[ -r $cloud ]] || fail "cannot read '$cloud'"
done

if [[ -z $build ]]; then
  bash "$root/tools/install_packages.sh" --benchmarks
  build=$root/build/bench
  echo "Building (the first time takes minutes) ..."
  mkdir -p "$build"
  log=$build/scaling.log
  if ! (cd "$root" && cmake --preset bench &&
    cmake --build --preset bench --target pcl_floater_scaling) >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "the build failed; its output is in $log"
  fi
fi
programs=$build/test/benchmark/scaling
generator=$build/tools/generate/pcl_floater_generate

rm -rf "$result"
mkdir -p "$result"
work=$(mktemp -d "$result/points.XXXXXX")
trap 'rm -rf "$work"' EXIT
runs=$result/runs.csv
echo "surface,cloud,points,method,repeat,outcome,$("$programs/pcl_floater_scaling_afs" --columns)" \
  >"$runs"

failures=0
declare -A given_up # by surface, cloud and method: larger clouds would take even longer

# run SURFACE CLOUD POINTS FILE METHOD REPEAT
run () {
  local row outcome=ok code=0
  [[ -z ${given_up[$1,$2,$5]-} ]] || return 0
  row=$(timeout --kill-after=10 "$time_limit" "$programs/pcl_floater_scaling_${5%-disc}" "$4" \
    --method "$5" --threads "$threads" --mesh "$work/mesh.ply") || code=$?
  if ((code == 124)); then
    outcome="over $time_limit s"
    given_up[$1,$2,$5]=1
  elif ((code != 0)); then
    echo "scaling.sh: $5 failed on $2 with $3 points: exit code $code" >&2
    outcome="failed ($code)"
    failures=$((failures + 1))
  fi
  ((code == 0)) || row=,,,,,,,,
  echo "$1,$2,$3,$5,$6,$outcome,$row" >>"$runs"
  printf '%-14s %-14s %8d points  %-13s %s\n' "$1" "$2" "$3" "$5" \
    "$(if ((code == 0)); then echo "${row%%,*} s"; else echo "$outcome"; fi)"
}

# measure SURFACE CLOUD POINTS FILE: runs all methods in turn; each repeat begins with another one
measure () {
  local repeat times=$repeats i method
  if [[ -z $times ]] || (($3 > repeated_up_to)); then
    times=$(($3 > repeated_up_to ? 1 : 3))
  fi
  for ((repeat = 0; repeat < times; ++repeat)); do
    for ((i = 0; i < ${#methods[@]}; ++i)); do
      method=${methods[(i + repeat) % ${#methods[@]}]}
      if [[ $method == floater-disc && $1 != height-field ]]; then
        continue
      fi
      run "$1" "$2" "$3" "$4" "$method" "$repeat"
    done
  done
}

for surface in "${surfaces[@]}"; do
  for size in "${sizes[@]}"; do
    ((size <= largest)) || continue
    "$generator" "$surface" "$work/points.ply" --points "$size"
    measure "$surface" "$surface" "$size" "$work/points.ply"
  done
done
for cloud in "${clouds[@]}"; do
  points=$("$programs/pcl_floater_scaling_afs" --count "$cloud")
  name=$(basename "${cloud%.*}")
  if ((points > largest)); then
    echo "Skipped: $name, because it has $points points"
    continue
  fi
  measure clouds "${name//[^A-Za-z0-9_.-]/_}" "$points" "$cloud"
done

threads_note="Threads: $threads for floater and the normals of gp3"
((threads > 0)) || threads_note="Threads: one for each core for floater and the normals of gp3"
"$root/tools/picture/on_virtual_display.sh" "$programs/pcl_floater_scaling_report" "$runs" \
  --out "$result" --note "$threads_note, 1 for afs." \
  "Load average at the end: $(cut -d ' ' -f 1-3 /proc/loadavg)."
((failures == 0)) || fail "failed runs: $failures; they are named in $runs"
