#!/usr/bin/env bash
#SBATCH --job-name=abut-bake
#SBATCH --requeue
#SBATCH --open-mode=append
# Bakes a list as an array job of Slurm, each task a shard:
#   sbatch --array=1-16 bake_slurm.sh LIST --verb VERB --cache DIR [-- OPTION...]
# All nodes must see the list, its files and the cache, or the cache is behind a URL. A task whose node dies starts again
# on another one and does what is missing. Afterwards `abut bake LIST ... --report` merges all results.
# ABUT names the tool; default: the one on the PATH.
set -euo pipefail

: "${SLURM_ARRAY_TASK_ID:?"this is an array job: sbatch --array=1-N"}"
shard=$((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN + 1))
status=0
"${ABUT:-abut}" bake --shard "$shard/$SLURM_ARRAY_TASK_COUNT" "$@" || status=$?
# Something was found (1): the task itself did not fail.
[ "$status" -le 1 ] || exit "$status"
