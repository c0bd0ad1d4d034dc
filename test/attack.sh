#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# The long versions of the attacks: hard and random clouds, memory that runs out, and all fuzz targets.
set -euo pipefail

usage () {
  cat <<'END'
Usage: attack.sh [MINUTES [SEED]]
Attacks the library and the tool for about so many minutes (default: 60) after the builds:
a third of the time random clouds from SEED on (default: the date), up to a sixth memory that runs
out on clouds of 5000 points, and for the rest fuzz targets, each from its corpus and what earlier runs
have found. From 60 minutes on, 30 million points with a limit on the memory come first, which take
about 10 GB on the disk, and 54 kinds of hard clouds of 2, 8 and 20 thousand points; of the latter none
may take more than 300 microseconds a point or 200 MB. One process at a time, at the lowest priority.
Needs clang for the fuzz targets.
What is found is left in build/attack. The exit code is 1 if there is anything.
END
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
esac
minutes=${1:-60}
seed=${2:-$(date +%Y%m%d)}
if (($# > 2)) || [[ ! $minutes =~ ^[1-9][0-9]*$ || ! $seed =~ ^[0-9]+$ ]]; then
  usage >&2
  exit 1
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
work=$root/build/attack
mkdir -p "$work"
cmake --preset dev >"$work/configure.log"
cmake --build --preset dev --target test_random_clouds test_memory_faults \
  pcl_floater_generate pcl_floater_reconstruct
cmake --preset fuzz >>"$work/configure.log"
cmake --build --preset fuzz

result=0
seconds=$((60 * minutes))
tests=build/dev/test/fuzz
tool=build/dev/tools/reconstruct/pcl_floater_reconstruct
generate=build/dev/tools/generate/pcl_floater_generate

if ((minutes >= 60)); then
  "$generate" torus "$work/large.ply" --points 30000000
  nice -n 19 "$tool" "$work/large.ply" "$work/large_mesh.ply" --max-memory 3G >"$work/large.txt" 2>&1 ||
    result=1
  grep -E "^(points|triangles|topology|seconds|warning|pcl_floater)" "$work/large.txt" || true
  rm -f "$work/large.ply" "$work/large_mesh.ply"
  nice -n 19 /usr/bin/python3 test/benchmark/worst_cases.py --build build/dev --strict | tee "$work/worst.txt" || result=1
fi
clouds=$((seconds / 12))
for points in 12 60 300 3000; do
  code=0
  PCL_FLOATER_FIRST_SEED=${seed}000 PCL_FLOATER_RANDOM_CLOUDS=1000000000 PCL_FLOATER_LONGEST=2 \
    timeout "$clouds" nice -n 19 "$tests/test_random_clouds" --gtest_also_run_disabled_tests --gtest_brief=1 \
    --gtest_filter="*/$points" >"$work/clouds_$points.txt" 2>&1 || code=$?
  if ((code != 124)) || grep -q Failure "$work/clouds_$points.txt"; then # 124: the time is over
    cat "$work/clouds_$points.txt"
    result=1
  fi
done

memory=0
PCL_FLOATER_MEMORY_POINTS=5000 PCL_FLOATER_MEMORY_FAULTS=143 \
  timeout $((seconds / 6)) nice -n 19 "$tests/test_memory_faults" --gtest_brief=1 >"$work/memory.txt" 2>&1 || memory=$?
if ((memory == 124)) && ! grep -q Failure "$work/memory.txt"; then
  memory=0 # the time is over, which is no fault
fi
if ((memory != 0)); then
  cat "$work/memory.txt"
  result=1
fi

declare -A share=([pcd]=1 [ply]=1 [vtk]=1 [obj]=1 [stl]=1 [las]=1 [table]=1 [reconstruct]=5)
for target in pcd ply vtk obj stl las table reconstruct; do
  # The limit of one input is in wall time, and this process has the lowest priority. On a busy
  # machine, an input that ends took 751 seconds; one that does not end must still be found.
  mkdir -p "$work/corpus/$target" "$work/found/$target"
  time=$((seconds * share[$target] / 24))
  program=build/fuzz/test/fuzz/fuzz_$target
  [[ $target == reconstruct ]] || program=build/fuzz/test/fuzz/fuzz_readers
  FUZZED_FORMAT=$target nice -n 19 "$program" -max_total_time="$time" -timeout=1800 -rss_limit_mb=3000 \
    -print_final_stats=1 -artifact_prefix="$work/found/$target/" \
    "$work/corpus/$target" "test/fuzz/corpus/$target" >"$work/$target.log" 2>&1 || result=1
  grep -E "stat::number_of_executed_units|ERROR|SUMMARY|fault:" "$work/$target.log" | sed "s/^/$target: /" || true
done
exit "$result"
