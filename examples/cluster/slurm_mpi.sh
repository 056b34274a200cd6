#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# One measurement on all tasks of a job: sbatch slurm_mpi.sh -o gold.asperity --surface ...
#SBATCH --job-name=asperity-mpi
#SBATCH --ntasks=4
#SBATCH --cpus-per-task=2
set -euo pipefail
mpirun asperity-mpi simulate "$@" --resume --threads "${SLURM_CPUS_PER_TASK:-1}"
