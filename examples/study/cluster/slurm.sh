#!/usr/bin/env bash
# A study as an array of Slurm: sbatch slurm.sh PROGRAM DIR
# DIR lies on a file system that all nodes see. Jobs that are preempted or run out of time are put back and go on.
#SBATCH --job-name=study
#SBATCH --array=1-100
#SBATCH --cpus-per-task=8
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
"$1" run --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" --threads "$SLURM_CPUS_PER_TASK" --out "$2"
# When all are done: PROGRAM status DIR && PROGRAM merge DIR
