#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs when all parts of the array are done.
#SBATCH --job-name=asperity-merge
set -euo pipefail
mapfile -t files < <(seq -f "$RESULT.%.0f-of-$PARTS" "$PARTS")
asperity merge "${files[@]}" -o "$RESULT"
rm "${files[@]}"
