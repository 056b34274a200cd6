# SPDX-License-Identifier: Apache-2.0
# Shared by the scripts of tools/: source it, do not run it.
# Leaves the shell in the project's root, wherever the script was called from.
set -euo pipefail

caller_directory=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Threads for compilers and tests: as many as this process may use.
jobs=$(nproc)

say() { printf '\n== %s\n' "$*"; }

die() {
    printf '%s: error: %s\n' "tools/$(basename "$0")" "$*" >&2
    exit 1
}

# help_from_header FILE: prints the comment on top of a script, without the licence line.
help_from_header() { sed -n '2,/^[^#]/{/SPDX/d;s/^# \{0,1\}//p}' "$1" | sed '/^set /d'; }

# absolute PATH: PATH as seen from where the script was called.
absolute() {
    case $1 in
        /*) printf '%s\n' "$1" ;;
        *) printf '%s/%s\n' "$caller_directory" "$1" ;;
    esac
}

# configure PRESET [OPTIONS...]: silent while all goes well, the whole story otherwise.
configure() {
    local log
    log=$(mktemp)
    if ! cmake --preset "$@" >"$log" 2>&1; then
        cat "$log" >&2
        rm -f "$log"
        die "cannot configure the preset '$1'"
    fi
    rm -f "$log"
}
