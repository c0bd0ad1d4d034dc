#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Time, memory and traffic of pcl_floater_distributed, against pcl_floater_reconstruct on the same points.
set -euo pipefail

usage () {
  cat <<'END'
Usage: distributed.sh [--build FOLDER] [--folder FOLDER] [--processes N] [--max-memory SIZE] [--alone] [POINTS...]
Makes height fields of so many points (by default 1000000 10000000 30000000), reconstructs each in memory and on
N processes (2), and prints a table. FOLDER (a temporary one) has to have 600 bytes for each point.
  --max-memory  limit of process 0 for the steps of the whole cloud (no limit)
  --alone       only N processes and files: no reconstruction in memory, which takes 260 bytes for each point
END
}

build=$(dirname "$0")/../../build/dev
folder=
processes=2
limit=()
alone=false
points=()
while (($# > 0)); do
  case "$1" in
    --build) build=$2; shift ;;
    --folder) folder=$2; shift ;;
    --processes) processes=$2; shift ;;
    --max-memory) limit=(--max-memory "$2"); shift ;;
    --alone) alone=true ;;
    -h | --help) usage; exit 0 ;;
    [1-9]*) points+=("$1") ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done
((${#points[@]} > 0)) || points=(1000000 10000000 30000000)
tools=$(cd "$build/tools" && pwd)
if [[ -z $folder ]]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
cd "$folder"

now () { date +%s.%N; }
since () { awk -v from="$1" -v to="$(now)" 'BEGIN { printf "%.1f", to - from }'; }
# The largest number of "process N: peak memory M MB" of a log.
peak () { awk '/peak memory [0-9]+ MB$/ { if ($(NF-1) > most) most = $(NF-1) } END { print most }' "$1"; }

echo "| points | in memory | memory | $processes processes | ratio | memory of a process | files | messages |"
echo "|---|---:|---:|---:|---:|---:|---:|---:|"
for n in "${points[@]}"; do
  "$tools/generate/pcl_floater_generate" height-field cloud.ply --points "$n" >/dev/null
  if ! $alone; then
    start=$(now)
    "$tools/reconstruct/pcl_floater_reconstruct" --json cloud.ply one.ply >one.log
    one=$(since "$start")
    one_memory=$(sed -n 's/.*"peak_memory_bytes":\([0-9]*\).*/\1/p' one.log)
  fi
  start=$(now)
  mpirun --oversubscribe --allow-run-as-root --bind-to none -n "$processes" \
    "$tools/distributed/pcl_floater_distributed" --work work "${limit[@]}" cloud.ply many.ply >many.log 2>&1
  many=$(since "$start")
  cp many.log "many.$n.log"
  files=$(du -sb work | cut -f1)
  if $alone; then
    rm -rf work many.ply
    echo "| $n | - | - | $many s | - | $(peak many.log) MB | $((files / n)) bytes a point | - |"
    continue
  fi
  cmp one.ply many.ply
  rm -rf work many.ply
  mpirun --oversubscribe --allow-run-as-root --bind-to none -n "$processes" \
    "$tools/distributed/pcl_floater_distributed" --work work --exchange messages "${limit[@]}" \
    cloud.ply many.ply >messages.log 2>&1
  cmp one.ply many.ply
  messages=$(sed -n 's/^messages: \([0-9.]*\) MB$/\1/p' messages.log)
  rm -rf work many.ply one.ply
  awk -v n="$n" -v one="$one" -v memory="$one_memory" -v many="$many" -v peak="$(peak many.log)" \
    -v files="$files" -v messages="$messages" 'BEGIN {
      printf "| %d | %.1f s | %.0f MB | %.1f s | %.2f | %d MB | %.0f bytes a point | %.0f bytes a point |\n",
             n, one, memory / 1e6, many, many / one, peak, files / n, 1e6 * messages / n }'
done
