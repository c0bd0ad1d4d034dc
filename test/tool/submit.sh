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
for step in neighbors outliers planes stars join write; do
  command="pcl_floater_distributed --work $(printf %q "$work") --step $step"
  options=(--parsable "${after[@]}")
  case "$step" in
    neighbors | planes | stars) tasks=$blocks ;;
    *) tasks=0 ;;
  esac
  if ((tasks > 0)); then
    options+=("--array=0-$((tasks - 1))%64")
    command+=" --block \$SLURM_ARRAY_TASK_ID"
  fi
  after=("--dependency=afterok:$(sbatch "${options[@]}" --wrap "$command")")
done
