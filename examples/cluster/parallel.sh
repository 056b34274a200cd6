#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# parallel.sh PARTS RESULT OPTIONS...
# A measurement in so many processes of this machine, or of others with GNU parallel's --sshlogin: each
# measures a part, and asperity merge puts them together. Started again after a crash, it goes on.
#   parallel.sh 8 gold.asperity --surface gaussian:alpha=0.3 --material Au --jitter 64
set -euo pipefail
parts=$1 result=$2
shift 2

one_part() {
    local part=$1 parts=$2 result=$3
    shift 3
    asperity simulate "$@" --part "$part/$parts" -o "$result.$part-of-$parts" --resume --threads 1 --quiet
}
export -f one_part

if command -v parallel >/dev/null; then
    seq "$parts" | parallel --will-cite --halt now,fail=1 one_part {} "$parts" "$result" "${*@Q}"
else
    # xargs does the same on one machine
    seq "$parts" | xargs -P "$(nproc)" -I {} bash -c 'one_part "$@"' - {} "$parts" "$result" "$@"
fi
mapfile -t files < <(seq -f "$result.%.0f-of-$parts" "$parts")
asperity merge "${files[@]}" -o "$result"
rm "${files[@]}"
