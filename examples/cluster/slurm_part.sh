#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# One task of a Slurm job array measures one part; slurm.sh submits it.
#SBATCH --job-name=asperity
#SBATCH --cpus-per-task=2
#SBATCH --requeue
# Started again on another machine after a failure, it goes on from its checkpoint.
set -euo pipefail
asperity simulate "$@" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    -o "$RESULT.$SLURM_ARRAY_TASK_ID-of-$SLURM_ARRAY_TASK_COUNT" --resume \
    --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet
