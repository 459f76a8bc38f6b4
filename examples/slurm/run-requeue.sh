#!/usr/bin/env bash
# A run or search that takes longer than a job may: it stops in time, is queued again, and goes on from where it was.
#
#   sbatch run-requeue.sh run my.toml out/mine
#   sbatch run-requeue.sh search my-search.toml out/best
#SBATCH --job-name=agglo-run
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

verb=$1 file=$2 folder=$3

# Less than --time, so that there is time left to save.
limits=(--wall-time "${AGGLO_WALL_TIME:-110 min}" --threads "${SLURM_CPUS_PER_TASK:-1}")
code=0
if [[ -e $folder ]]; then
    agglo resume "$folder" "${limits[@]}" || code=$?
else
    agglo "$verb" "$file" -o "$folder" "${limits[@]}" || code=$?
fi

# 3: the wall time is up, and a checkpoint was written.
if [[ $code -eq 3 ]]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit "$code"
