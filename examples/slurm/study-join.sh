#!/usr/bin/env bash
# Puts the parts of a study together, when all have ended.
#SBATCH --job-name=agglo-join
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=00:10:00
set -euo pipefail

out=$1
agglo join "$out"/part-* -o "$out/whole"
