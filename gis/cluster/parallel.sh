#!/usr/bin/env bash
# Separates a layer by GNU parallel, on this machine or on several by ssh:
#
#   parallel.sh [--plan DIRECTORY] [--jobs J] [--host [J/][USER@]HOST]... INPUT OUTPUT N [-- OPTIONS OF separate]
#
# Plan and merge run here. J shards run at a time (on each host): as many as there are processors and as memory allows by the
# plan's estimate, unless said. Hosts must see the program and DIRECTORY (OUTPUT.plan unless said) under the same names; the
# host : is this machine. A shard that fails is tried on another host. If something fails, the same command does what is missing.
#
#   SUNDER            the program, if it is not on the PATH
#   SUNDER_PARALLEL   further words for parallel: "--nice 10 --load 80%"
usage() { echo "usage: ${0##*/} [--plan DIRECTORY] [--jobs J] [--host [J/][USER@]HOST]... INPUT OUTPUT N [-- OPTIONS OF separate]"; }

jobs='' hosts=()
option() {
    [ -n "${2-}" ] || return 1
    case $1 in
        --jobs | -j) jobs=$2 ;;
        --host) hosts+=(--sshlogin "$2") ;;
        *) return 1 ;;
    esac
    took=2
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=lib.sh
. "$here/lib.sh" || exit 1
command -v parallel >/dev/null || cluster_refuse 1 "there is no parallel here (Debian: apt install parallel); make.sh does without"
cluster_arguments "$here/parallel.sh" "$@"
case $plan in /*) ;; *) plan=$PWD/$plan ;; esac # as other hosts see it

cluster_plan || { status=$?; cluster_again "the plan failed (status $status)"; exit "$status"; }

if [ -z "$jobs" ]; then
    jobs=100% # of each host's processors
    if [ ${#hosts[@]} -eq 0 ] && [ -r /proc/meminfo ]; then
        jobs=$(awk -v each="$(cluster_most memory_bytes)" -v most="$(getconf _NPROCESSORS_ONLN)" '
            /^MemAvailable:/ { n = each > 0 ? int($2 * 1024 * 0.9 / each) : most }
            END { if (n > most) n = most; if (n < 1) n = 1; print n }' /proc/meminfo)
    fi
fi

missing=$(cluster_missing)
if [ -n "$missing" ]; then
    failed=0
    # shellcheck disable=SC2086 # words
    parallel --quote --jobs "$jobs" --retries 3 --joblog "$log/joblog" ${hosts[@]+"${hosts[@]}"} ${SUNDER_PARALLEL-} \
        "$sunder" separate --shard '{}' "$plan" --threads 1 <<<"$missing" || failed=$?
    missing=$(cluster_missing | tr '\n' ' ')
    if [ "$failed" -ne 0 ] || [ -n "$missing" ]; then
        cluster_again "shards ${missing% } are missing"
        exit 1
    fi
fi
cluster_merge 1
