#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# slurm.sh PARTS RESULT OPTIONS...
# Submits a measurement to Slurm: an array of PARTS tasks, and a merge that waits for all of them. The
# folder must be one that all machines see.
#   slurm.sh 100 gold.asperity --surface gaussian:alpha=0.3,size=2048 --material Au
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
export PARTS=$1 RESULT=$2
shift 2
array=$(sbatch --parsable --array="1-$PARTS" "$here/slurm_part.sh" "$@")
sbatch --parsable --dependency="afterok:$array" "$here/slurm_merge.sh"
