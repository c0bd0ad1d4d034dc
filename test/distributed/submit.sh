#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# submit.sh WORK CLOUD... MESH: all steps as jobs of Slurm, each after those before it.
set -euo pipefail
work=$1
shift
pcl_floater_distributed --work "$work" --step plan "$@"
blocks=$(sed -n 's/^ *"blocks": \([0-9]*\).*/\1/p' "$work/manifest.json")
after=()
for step in neighbors outliers planes stars triangles join write; do
  command="pcl_floater_distributed --work '$work' --step $step"
  options=(--parsable "${after[@]}")
  case "$step" in
    outliers | join | write) ;;
    *)
      options+=("--array=0-$((blocks - 1))%64")
      command+=" --block \$SLURM_ARRAY_TASK_ID"
      ;;
  esac
  after=("--dependency=afterok:$(sbatch "${options[@]}" --wrap "$command")")
done
