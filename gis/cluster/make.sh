#!/usr/bin/env bash
# Separates a layer by make, on this machine:
#
#   make.sh [--plan DIRECTORY] [--jobs J] INPUT OUTPUT N [-- OPTIONS OF separate]
#
# J shards at a time: 1 unless said. If something fails, the same command does what is missing. A makefile of one's own may include shards.mk.
#
#   SUNDER   the program, if it is not on the PATH
usage() { echo "usage: ${0##*/} [--plan DIRECTORY] [--jobs J] INPUT OUTPUT N [-- OPTIONS OF separate]"; }

jobs=1
option() {
    case $1,${2-} in
        --jobs, | -j, | --jobs,*[!0-9]* | -j,*[!0-9]*) return 1 ;;
        --jobs,* | -j,*) jobs=$2 took=2 ;;
        *) return 1 ;;
    esac
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=lib.sh
. "$here/lib.sh" || exit 1
command -v make >/dev/null || cluster_refuse 1 "there is no make here"
cluster_arguments "$here/make.sh" "$@"

cluster_plan || { status=$?; cluster_again "the plan failed (status $status)"; exit "$status"; }
SUNDER=$sunder make --no-print-directory --keep-going --jobs="$jobs" -C "$plan" -f "$here/shards.mk" SHARDS="$shards" ||
    { cluster_again "shards $(cluster_missing | tr '\n' ' ')are missing"; exit 1; }
cluster_merge 1
