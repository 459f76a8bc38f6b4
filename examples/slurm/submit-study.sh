#!/usr/bin/env bash
# Submits a study as a job array, and the job that puts its parts together when all have ended.
#
#   ./submit-study.sh study.toml 16 out/study
set -euo pipefail

here=$(dirname "${BASH_SOURCE[0]}")
study=${1:?which study file?} parts=${2:?how many parts?} out=${3:?which folder?}

# A mistake in the file is told here and not by each of the jobs.
agglo check "$study"
array=$(sbatch --parsable --array="1-$parts" "$here/study-part.sh" "$study" "$parts" "$out")
sbatch --dependency="afterok:$array" "$here/study-join.sh" "$out"
