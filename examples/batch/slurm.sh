#!/bin/bash
# Meshes of all sections of a folder at three Reynolds numbers, divided among ten jobs of Slurm:
#
#     sbatch examples/batch/slurm.sh SECTIONS_FOLDER
#
# Each job makes a tenth of the meshes and has a summary of its own. A job that is ended by its time limit goes on where it
# was when it is submitted again.
#SBATCH --array=1-10
#SBATCH --cpus-per-task=8
#SBATCH --time=00:30:00
set -eu
lamina batch "$1"/*.dat -o 'out/{name}_{reynolds}.su2' --sweep reynolds=1e5,1e6,1e7 \
    --jobs "${SLURM_CPUS_PER_TASK:-0}" --shard "${SLURM_ARRAY_TASK_ID:-1}/${SLURM_ARRAY_TASK_COUNT:-1}" --quiet
