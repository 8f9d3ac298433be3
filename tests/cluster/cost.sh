#!/usr/bin/env bash
# The cost of shards compared with one process: the tables of RECORD.md.
#
#   cost.sh [BUILDINGS [SHARDS]]     by default a town of a million in 16 shards
#
# The steps run one after the other, with one thread each, a gap of 3 m and effort 0: CPU seconds of the user and the
# system, and peak memory. The output of shards is compared with that of one process byte by byte; with WHOLE=no the run
# of one process is left out (for ten million buildings it takes 17 GB). SUNDER_BUILD is the build directory
# (build/release); all files are in TMPDIR, 1.3 kB per building.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$root/build/release}
buildings=${1:-1000000} shards=${2:-16}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export SOURCE_DATE_EPOCH=1700000000
options=(--gap 3 --effort 0 --input-layer buildings)
"$build/sunder-town" --buildings "$buildings" --seed 7 town.gpkg >/dev/null

# step NAME COMMAND...: the status for remaining conflicts is not a failure.
step() {
    local status=0 name=$1
    shift
    /usr/bin/time -q -a -o "$name" -f '%U %S %M' "$@" >/dev/null 2>said || status=$?
    [ $status -eq 0 ] || [ $status -eq 3 ] || { cat said >&2; exit 1; }
}
step plan "$build/sunder" plan "${options[@]}" --shards "$shards" town.gpkg town.plan
for k in $(seq "$shards"); do step shards "$build/sunder" separate --shard "$k" --threads 1 town.plan; done
step merge "$build/sunder" merge --threads 1 town.plan merged.gpkg
if [ "${WHOLE:-yes}" = yes ]; then
    step whole "$build/sunder" separate "${options[@]}" --threads 1 town.gpkg whole.gpkg
    cmp whole.gpkg merged.gpkg || exit 1
fi

echo "$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1), load $(cut -d' ' -f1 /proc/loadavg), $buildings buildings, $shards shards"
for name in plan shards merge whole; do
    [ ! -f $name ] || awk -v name=$name '{ user += $1; sys += $2; if ($3 > most) most = $3 }
        END { printf "%s: %.2f + %.2f s, %.0f MB\n", name, user, sys, most / 1000 }' $name
done
[ ! -f whole ] || awk 'FILENAME == "whole" { whole = $1 + $2; next } { all += $1 + $2 } END { printf "%.2f times one process\n", all / whole }' whole plan shards merge
