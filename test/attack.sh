#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The long versions of the attacks: random clouds, memory that runs out, and all fuzz targets.
set -euo pipefail

usage () {
  cat <<'END'
Usage: attack.sh [MINUTES [SEED]]
Attacks the library and the tool for about so many minutes (default: 60) after the builds:
a third of the time random clouds from SEED on (default: the date), up to a sixth memory that runs
out on clouds of 5000 points, the rest fuzz targets, each from its corpus and what earlier runs have
found. One process at a time, at the lowest priority. Needs clang for the fuzz targets.
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
cmake --build --preset dev --target sweep_clouds test_memory_faults
cmake --preset fuzz >>"$work/configure.log"
cmake --build --preset fuzz

result=0
seconds=$((60 * minutes))
tests=build/dev/test/fuzz
clouds=$((seconds / 9))
for points in 30 400 3000; do
  nice -n 19 "$tests/sweep_clouds" "${seed}000" "$clouds" "$points" | tee "$work/clouds_$points.txt" || result=1
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

declare -A share=([pcd]=1 [ply]=1 [obj]=1 [command_line]=1 [reconstruct]=4)
for target in pcd ply obj command_line reconstruct; do
  mkdir -p "$work/corpus/$target" "$work/found/$target"
  time=$((seconds * share[$target] / 16))
  nice -n 19 "build/fuzz/test/fuzz/fuzz_$target" -max_total_time="$time" -timeout=20 -rss_limit_mb=3000 \
    -print_final_stats=1 -artifact_prefix="$work/found/$target/" \
    "$work/corpus/$target" "test/fuzz/corpus/$target" >"$work/$target.log" 2>&1 || result=1
  grep -E "stat::number_of_executed_units|ERROR|SUMMARY|fault:" "$work/$target.log" | sed "s/^/$target: /" || true
done
exit "$result"
