#!/usr/bin/env bash
# One part of a study: a task of a job array, which submit-study.sh submits.
#SBATCH --job-name=agglo-part
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

study=$1 parts=$2 out=$3
part=$SLURM_ARRAY_TASK_ID
folder=$out/part-$part

# Less than --time, so that there is time left to save.
limits=(--wall-time "${AGGLO_WALL_TIME:-110 min}" --threads "${SLURM_CPUS_PER_TASK:-1}")
code=0
if [[ -e $folder ]]; then
    agglo resume "$folder" "${limits[@]}" || code=$?
else
    agglo study "$study" --part "$part/$parts" -o "$folder" "${limits[@]}" || code=$?
fi

# 3: the wall time is up and all that was done is kept. The same task goes on later, in its turn.
if [[ $code -eq 3 ]]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$part"
fi
exit "$code"
